#pragma once

// What Python gives and takes for our plain types: vectors and quaternions as sequences of numbers (a list, a tuple, a
// NumPy array), quaternions as (x, y, z, w) like in every file of ours.

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <array>
#include <span>
#include <vector>

#include "core/rigid_transform.hpp"

namespace lutka::python {

namespace py = pybind11;

// A frame as NumPy sees it: seven numbers in a row, rotation (x, y, z, w) first.
inline constexpr py::ssize_t kFrameNumbers = 7;
static_assert(sizeof(RigidTransform) == kFrameNumbers * sizeof(float) && offsetof(RigidTransform, translation) == 16 &&
              offsetof(quat, x) == 0 && offsetof(quat, w) == 12);

/// Numbers that lie in `owner`, without a copy: read-only, and the owner lives at least as long.
[[nodiscard]] inline py::array viewOf(const void* numbers, std::vector<py::ssize_t> shape, py::handle owner) {
    py::array_t<float> array(std::move(shape), static_cast<const float*>(numbers), owner);
    array.attr("setflags")(py::arg("write") = false);
    return array;
}
[[nodiscard]] inline py::array viewOf(std::span<const RigidTransform> frames, py::handle owner) {
    return viewOf(frames.data(), {static_cast<py::ssize_t>(frames.size()), kFrameNumbers}, owner);
}

/// Of so many columns, as floats whatever it held before; a TypeError or ValueError names what it is for.
[[nodiscard]] inline py::array_t<float, py::array::c_style | py::array::forcecast> rowsOf(const py::object& numbers,
                                                                                          py::ssize_t rows,
                                                                                          py::ssize_t columns,
                                                                                          const std::string& what) {
    using Array = py::array_t<float, py::array::c_style | py::array::forcecast>;
    const Array array = Array::ensure(numbers);
    if (!array) {
        PyErr_Clear();
        throw py::type_error(what + ": expected an array of numbers");
    }
    if (array.ndim() != 2 || array.shape(0) != rows || array.shape(1) != columns)
        throw py::value_error(what + ": expected an array of " + std::to_string(rows) + " rows and " +
                              std::to_string(columns) + " columns");
    return array;
}

}  // namespace lutka::python

namespace pybind11::detail {

/// A sequence of as many numbers as the type has.
template <class Value, std::size_t count>
struct NumbersCaster {
    bool load(handle source, bool /*convert*/) {
        if (!PySequence_Check(source.ptr()) || PyUnicode_Check(source.ptr()) || PyBytes_Check(source.ptr()))
            return false;
        const Py_ssize_t length = PySequence_Size(source.ptr());
        if (length != static_cast<Py_ssize_t>(count)) {
            PyErr_Clear();
            return false;
        }
        for (std::size_t i = 0; i < count; ++i) {
            const auto item = reinterpret_steal<object>(PySequence_GetItem(source.ptr(), static_cast<Py_ssize_t>(i)));
            const double number = item ? PyFloat_AsDouble(item.ptr()) : -1.0;
            if (PyErr_Occurred() != nullptr) {
                PyErr_Clear();
                return false;
            }
            value[static_cast<int>(i)] = static_cast<float>(number);
        }
        return true;
    }
    static handle cast(const Value& source, return_value_policy /*policy*/, handle /*parent*/) {
        tuple numbers(count);
        for (std::size_t i = 0; i < count; ++i)
            numbers[i] = static_cast<double>(source[static_cast<int>(i)]);
        return numbers.release();
    }

    static constexpr auto name = const_name("Sequence[float]");
    template <class T>
    using cast_op_type = movable_cast_op_type<T>;
    operator Value*() { return &value; }                // NOLINT(google-explicit-constructor)
    operator Value&() { return value; }                 // NOLINT(google-explicit-constructor)
    operator Value&&() && { return std::move(value); }  // NOLINT(google-explicit-constructor)

    Value value{};
};

template <>
struct type_caster<lutka::vec3> : NumbersCaster<lutka::vec3, 3> {};
template <>
struct type_caster<lutka::quat> : NumbersCaster<lutka::quat, 4> {};

}  // namespace pybind11::detail
