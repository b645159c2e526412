#include "bindings/errors.hpp"

#include <algorithm>

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

bool isOptionLetter(char c) {
    return (c >= 'a' && c <= 'z') || c == '-';
}

// The library speaks of options as the command line has them; here `--allow-outside` is the argument allow_outside.
std::string withArguments(const std::string& text) {
    std::string out;
    std::size_t at = 0;
    while (at < text.size()) {
        const bool isFirst = at == 0 || !isOptionLetter(text[at - 1]);
        if (!isFirst || text.compare(at, 2, "--") != 0 || at + 2 == text.size() || !isOptionLetter(text[at + 2])) {
            out += text[at++];
            continue;
        }
        for (at += 2; at < text.size() && isOptionLetter(text[at]); ++at)
            out += text[at] == '-' ? '_' : text[at];
    }
    return out;
}

// Mostly a file, whose name is left as it is.
std::string placeOf(const std::string& location) {
    const bool isOption = location.starts_with("--") && std::all_of(location.begin(), location.end(), isOptionLetter);
    return isOption ? withArguments(location) : location;
}

}  // namespace

void raise(const Error& error) {
    const py::object type = py::module_::import("lutka._errors").attr(className(error.code));
    const py::object exception =
        type(textOf(error.message), textOf(placeOf(error.location)), textOf(withArguments(error.mend)));
    PyErr_SetObject(type.ptr(), exception.ptr());
    throw py::error_already_set();
}

py::object fromJson(const std::string& text) {
    return py::module_::import("json").attr("loads")(textOf(text));
}

}  // namespace lutka::python
