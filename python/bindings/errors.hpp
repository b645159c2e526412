#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <utility>

#include "core/result.hpp"

namespace lutka::python {

namespace py = pybind11;

/// Throws the Python exception that stands for the error: a subclass of lutka.Error with its message, location and
/// mend. Needs the GIL.
[[noreturn]] void raise(const Error& error);

/// The value, or raise() with the error.
template <class T>
[[nodiscard]] T orRaise(Result<T> result) {
    if (!result) raise(result.error());
    return std::move(result).value();
}
inline void orRaise(const Result<void>& result) {
    if (!result) raise(result.error());
}

/// Calls `work`, which touches no Python object, without the GIL.
template <class Work>
auto withoutGil(const Work& work) {
    const py::gil_scoped_release released;
    return work();
}

/// Throws what a signal handler has raised (KeyboardInterrupt, as a rule), now or while the GIL was held elsewhere.
/// Needs the GIL.
inline void heedSignals() {
    if (PyErr_Occurred() != nullptr || PyErr_CheckSignals() != 0) throw py::error_already_set();
}

/// The Python value of a JSON document.
[[nodiscard]] py::object fromJson(const std::string& text);

}  // namespace lutka::python
