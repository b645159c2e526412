#pragma once

#include <pybind11/pybind11.h>

#include <string>

namespace lutka::python {

namespace py = pybind11;

// pybind11 gives an object that was made by `X.__new__(X)`, which no constructor has seen, uninitialised memory at the
// first call of a method. So no class of ours lets `__new__` make such a one, and none can be derived from, whose
// `__new__` would.

/// For classes that only functions of ours make: `how` says which.
template <class Class>
void neverMadeByItself(Class& type, const std::string& how) {
    type.def_static("__new__", [how](const py::args&, const py::kwargs&) -> py::object { throw py::type_error(how); });
}

}  // namespace lutka::python
