#include "bindings/errors.hpp"

namespace lutka::python {
namespace {

const char* className(ErrorCode code) {
    switch (code) {
        case ErrorCode::usage:
            return "UsageError";
        case ErrorCode::input:
        case ErrorCode::findings:
            return "InputError";
        case ErrorCode::output:
            return "OutputError";
        case ErrorCode::noDisplay:
        case ErrorCode::internal:
            break;
    }
    return "InternalError";
}

// Messages quote names of files, which are bytes of any encoding.
py::str textOf(const std::string& bytes) {
    PyObject* text = PyUnicode_DecodeUTF8(bytes.data(), static_cast<Py_ssize_t>(bytes.size()), "replace");
    if (text == nullptr) throw py::error_already_set();
    return py::reinterpret_steal<py::str>(text);
}

}  // namespace

void raise(const Error& error) {
    const py::object type = py::module_::import("lutka._errors").attr(className(error.code));
    const py::object exception = type(textOf(error.message), textOf(error.location), textOf(error.mend));
    PyErr_SetObject(type.ptr(), exception.ptr());
    throw py::error_already_set();
}

py::object fromJson(const std::string& text) {
    return py::module_::import("json").attr("loads")(textOf(text));
}

}  // namespace lutka::python
