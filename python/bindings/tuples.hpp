// SPDX-License-Identifier: MIT
#pragma once
// Tuples as arguments of kernels: they are structs in C++, and in Python mostly named tuples.

#include <pybind11/pybind11.h>

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace tricue::bindings {

namespace py = pybind11;

/// Takes any tuple; `unpack` says what is wrong with it, and takes less time than the cast to a std::tuple. Shows in signatures
/// as tuple[Parts].
template <typename... Parts>
class Tuple : public py::tuple {
public:
    PYBIND11_OBJECT(Tuple, py::tuple, PyTuple_Check)
};

[[noreturn]] inline void refuse_part(const char* name, const char* expected, PyObject* got) {
    throw py::type_error(std::string(name) + ": expected " + expected + ", got " + Py_TYPE(got)->tp_name);
}

/// A part of the tuple `name`. Whether an object is an array is checked where its type is.
template <typename Part>
struct Unpacked {
    static Part from(PyObject* object, const char*) { return py::reinterpret_borrow<Part>(object); }
};

template <typename... Parts>
struct Unpacked<Tuple<Parts...>> {
    static Tuple<Parts...> from(PyObject* object, const char* name) {
        if (!PyTuple_Check(object)) refuse_part(name, "a tuple in it", object);
        return py::reinterpret_borrow<Tuple<Parts...>>(object);
    }
};

template <>
struct Unpacked<double> {
    static double from(PyObject* object, const char* name) {
        const double number = PyFloat_AsDouble(object);
        if (number == -1.0 && PyErr_Occurred()) {
            PyErr_Clear();
            refuse_part(name, "a number in it", object);
        }
        return number;
    }
};

template <typename Integer>
struct UnpackedInteger {
    static Integer from(PyObject* object, const char* name) {
        int overflow = 0;
        const long long number = PyLong_AsLongLongAndOverflow(object, &overflow);
        if (number == -1 && PyErr_Occurred()) {
            PyErr_Clear();
            refuse_part(name, "an integer in it", object);
        }
        using Limits = std::numeric_limits<Integer>;
        if (overflow != 0 || number < Limits::min() || number > Limits::max())
            throw py::value_error(std::string(name) + ": expected integers of at most " +
                                  std::to_string(Limits::digits + 1) + " bits in it, got a larger one");
        return static_cast<Integer>(number);
    }
};

template <>
struct Unpacked<int> : UnpackedInteger<int> {};

template <>
struct Unpacked<std::int64_t> : UnpackedInteger<std::int64_t> {};

template <>
struct Unpacked<bool> {
    static bool from(PyObject* object, const char* name) {
        if (!PyBool_Check(object)) refuse_part(name, "True or False in it", object);
        return object == Py_True;
    }
};

/// A list or a tuple of such parts. To convert one of them may run Python, which may shorten the list.
template <typename Item>
struct Unpacked<std::vector<Item>> {
    static std::vector<Item> from(PyObject* object, const char* name) {
        if (!PyList_Check(object) && !PyTuple_Check(object))
            refuse_part(name, "a list or tuple in it", object);
        std::vector<Item> items;
        items.reserve(static_cast<std::size_t>(PySequence_Fast_GET_SIZE(object)));
        for (py::ssize_t i = 0; i < PySequence_Fast_GET_SIZE(object); ++i) {
            const auto item = py::reinterpret_borrow<py::object>(PySequence_Fast_GET_ITEM(object, i));
            items.push_back(Unpacked<Item>::from(item.ptr(), name));
        }
        return items;
    }
};

template <typename Part>
struct Unpacked<std::optional<Part>> {
    static std::optional<Part> from(PyObject* object, const char* name) {
        if (object == Py_None) return {};
        return Unpacked<Part>::from(object, name);
    }
};

template <typename... Parts, std::size_t... kPlaces>
std::tuple<Parts...> unpack_places(PyObject* tuple, const char* name, std::index_sequence<kPlaces...>) {
    return {Unpacked<Parts>::from(PyTuple_GET_ITEM(tuple, static_cast<py::ssize_t>(kPlaces)), name)...};
}

/// The parts of a tuple. ValueError if there are fewer or more, or for an integer out of range; TypeError for what isn't a
/// number, a bool or a tuple.
template <typename... Parts>
std::tuple<Parts...> unpack(const Tuple<Parts...>& tuple, const char* name) {
    constexpr std::size_t kParts = sizeof...(Parts);
    if (tuple.size() != kParts)
        throw py::value_error(std::string(name) + ": expected a tuple of " + std::to_string(kParts) +
                              ", got one of " + std::to_string(tuple.size()));
    return unpack_places<Parts...>(tuple.ptr(), name, std::index_sequence_for<Parts...>{});
}

/// The struct whose fields are the parts of a tuple.
template <typename Struct, typename... Parts>
Struct unpack_as(const Tuple<Parts...>& tuple, const char* name) {
    return std::apply([](const Parts&... parts) { return Struct{parts...}; }, unpack(tuple, name));
}

}  // namespace tricue::bindings

template <typename... Parts>
struct pybind11::detail::handle_type_name<tricue::bindings::Tuple<Parts...>> {
    static constexpr auto name = const_name("tuple[") + concat(make_caster<Parts>::name...) + const_name("]");
};
