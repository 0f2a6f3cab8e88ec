// SPDX-License-Identifier: MIT
#pragma once
// The one place where NumPy arrays become C++ views. Strict: a wrong dtype, rank or layout raises and names the argument;
// nothing is converted or copied behind the caller's back.

#include <pybind11/complex.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "base/arrays.hpp"
#include "base/depth_view.hpp"
#include "base/image_view.hpp"
#include "base/plane_view.hpp"
#include "base/region.hpp"
#include "base/sample_view.hpp"
#include "base/stack_view.hpp"
#include "unlocked.hpp"

namespace tricue::bindings {

namespace py = pybind11;

/// Takes any object, as `require` says more than pybind11 about what is wrong with it; shows in signatures as NDArray[Scalar].
template <typename Scalar>
class Array : public py::object {
    static bool anything(PyObject*) { return true; }

public:
    PYBIND11_OBJECT(Array, py::object, anything)
};

inline std::string describe(const py::array& array) {
    return std::string(py::str(array.dtype())) + " " + std::string(py::str(array.attr("shape")));
}

/// Wrong type raises TypeError, wrong shape or layout ValueError; both say what was expected and what came.
template <typename Scalar>
py::array require(const py::object& object, const char* name, int rank, const char* expected) {
    if (!py::isinstance<py::array>(object))
        throw py::type_error(std::string(name) + ": expected a NumPy array, " + expected + ", got " +
                             Py_TYPE(object.ptr())->tp_name);
    auto array = py::reinterpret_borrow<py::array>(object);
    if (!py::isinstance<py::array_t<Scalar>>(array))
        throw py::type_error(std::string(name) + ": expected " + expected + ", got " + describe(array));
    if (array.ndim() != rank)
        throw py::value_error(std::string(name) + ": expected " + expected + ", got " + describe(array));
    return array;
}

/// NumPy takes any byte but 0 for True, as in a mask of 0 and 255 that is viewed as bool; C++ knows no bool but 0 and 1.
inline void require_bools(const py::array& array, const char* name) {
    const auto* bytes = static_cast<const std::uint8_t*>(array.data());
    const py::ssize_t size = array.size();
    std::uint8_t bits = 0;
    for (py::ssize_t i = 0; i < size; ++i) bits |= bytes[i];
    if (bits > 1)
        throw py::value_error(std::string(name) +
                              ": expected bool of bytes 0 and 1, got others; mask != 0 makes it");
}

template <typename Scalar>
const Scalar* contiguous(const py::array& array, const char* name) {
    constexpr int wanted = py::array::c_style | py::detail::npy_api::NPY_ARRAY_ALIGNED_;
    if ((array.flags() & wanted) != wanted)
        throw py::value_error(std::string(name) +
                              ": expected a C-contiguous, aligned array; numpy.require makes one");
    if constexpr (std::is_same_v<Scalar, bool>) require_bools(array, name);
    return static_cast<const Scalar*>(array.data());
}

/// Beyond it float32 doesn't hold whole numbers, and kernels read elsewhere.
constexpr py::ssize_t kMaxInputSide = 1 << 24;

/// Rows (axis 0) or columns (axis 1) of an image.
inline int image_side(const py::array& array, int axis, const char* name) {
    if (array.shape(axis) > kMaxInputSide)
        throw py::value_error(std::string(name) + ": expected at most " + std::to_string(kMaxInputSide) +
                              " rows and columns, got " + describe(array));
    return static_cast<int>(array.shape(axis));
}

inline ImageView color_image(const py::object& object, const char* name) {
    const auto array = require<std::uint8_t>(object, name, 3, "a uint8 BGR image (H, W, 3)");
    if (array.shape(2) != 3)
        throw py::value_error(std::string(name) + ": expected a uint8 BGR image (H, W, 3), got " +
                              describe(array));
    // NumPy leaves the stride of an axis of length 1 (and all of them in an empty array) undefined.
    const bool packed = array.strides(2) == 1 && (array.shape(1) == 1 || array.strides(1) == 3);
    const bool downward = array.shape(0) == 1 || array.strides(0) >= 0;
    if (array.size() > 0 && !(packed && downward))
        throw py::value_error(std::string(name) +
                              ": expected packed pixels; numpy.ascontiguousarray makes them");
    return {static_cast<const std::uint8_t*>(array.data()), image_side(array, 0, name),
            image_side(array, 1, name), 3, array.strides(0)};
}

/// Pixels packed, rows maybe padded: a view of a part of an image works as the image does.
template <typename Scalar>
py::array packed_rows(const py::object& object, const char* name, const char* expected) {
    auto array = require<Scalar>(object, name, 2, expected);
    constexpr py::ssize_t kSize = sizeof(Scalar);
    constexpr int kAligned = py::detail::npy_api::NPY_ARRAY_ALIGNED_;
    // NumPy leaves the stride of an axis of length 1 (and all of them in an empty array) undefined.
    const bool packed = (array.flags() & kAligned) && (array.shape(1) == 1 || array.strides(1) == kSize);
    const bool downward = array.shape(0) == 1 || (array.strides(0) >= 0 && array.strides(0) % kSize == 0);
    if (array.size() > 0 && !(packed && downward))
        throw py::value_error(std::string(name) +
                              ": expected packed pixels; numpy.ascontiguousarray makes them");
    return array;
}

inline ImageView byte_image(const py::object& object, const char* name, const char* expected) {
    const auto array = packed_rows<std::uint8_t>(object, name, expected);
    return {static_cast<const std::uint8_t*>(array.data()), image_side(array, 0, name),
            image_side(array, 1, name), 1, array.strides(0)};
}

inline ImageView gray_image(const py::object& object, const char* name) {
    return byte_image(object, name, "a uint8 gray image (H, W)");
}

/// BGR, or gray.
inline ImageView any_image(const py::object& object, const char* name) {
    const bool gray =
        py::isinstance<py::array>(object) && py::reinterpret_borrow<py::array>(object).ndim() == 2;
    return gray ? gray_image(object, name) : color_image(object, name);
}

inline PlaneView plane_view(const py::object& object, const char* name, const char* expected) {
    const auto array = packed_rows<float>(object, name, expected);
    return {static_cast<const float*>(array.data()), image_side(array, 0, name), image_side(array, 1, name),
            array.strides(0) / py::ssize_t{sizeof(float)}};
}

inline DepthView depth_image(const py::object& object, const char* name) {
    return plane_view(object, name, "a float32 depth image (H, W)");
}

inline std::ptrdiff_t pixels(const PlaneView& plane) {
    return std::ptrdiff_t{plane.rows} * plane.cols;
}

inline ImageView mask_image(const py::object& object, const char* name,
                            const char* expected = "a uint8 mask (H, W)") {
    const auto array = require<std::uint8_t>(object, name, 2, expected);
    return {contiguous<std::uint8_t>(array, name), image_side(array, 0, name), image_side(array, 1, name), 1,
            array.shape(1)};
}

inline SampleView samples(const py::object& object, const char* name) {
    const char* expected = "uint8 samples (N, 3, n)";
    const auto array = require<std::uint8_t>(object, name, 3, expected);
    if (array.shape(1) != 3)
        throw py::value_error(std::string(name) + ": expected " + expected + ", got " + describe(array));
    return {contiguous<std::uint8_t>(array, name), array.shape(0), array.shape(2)};
}

inline Eigen::Map<const States> states(const py::object& object, const char* name) {
    const auto array = require<double>(object, name, 2, "float64 (N, D)");
    return {contiguous<double>(array, name), array.shape(0), array.shape(1)};
}

inline Eigen::Map<const Vector> vector(const py::object& object, const char* name) {
    const auto array = require<double>(object, name, 1, "float64 (N,)");
    return {contiguous<double>(array, name), array.shape(0)};
}

/// A float array of a given shape (-1: any size), seen as rows of its last dimension.
inline Eigen::Map<const Floats> floats(const py::object& object, const char* name,
                                       const std::vector<py::ssize_t>& shape, const char* expected) {
    const auto array = require<float>(object, name, static_cast<int>(shape.size()), expected);
    py::ssize_t rows = 1;
    for (std::size_t i = 0; i < shape.size(); ++i) {
        const auto size = array.shape(static_cast<py::ssize_t>(i));
        if (shape[i] >= 0 && size != shape[i])
            throw py::value_error(std::string(name) + ": expected " + expected + ", got " + describe(array));
        if (i + 1 < shape.size()) rows *= size;
    }
    return {contiguous<float>(array, name), rows, array.shape(array.ndim() - 1)};
}

/// Rank maps (M, 3, n), seen as M rows.
inline Eigen::Map<const Floats> rank_maps(const py::object& models, py::ssize_t n) {
    const auto maps = floats(models, "models", {-1, 3, n}, "float32 (M, 3, n)");
    return {maps.data(), maps.rows() / 3, 3 * maps.cols()};
}

/// A table over colors (B, B, B), seen as B² rows.
inline Eigen::Map<const Floats> color_cube(const py::object& table, const char* name = "table") {
    const char* expected = "float32 (B, B, B)";
    const auto side = require<float>(table, name, 3, expected).shape(0);
    return floats(table, name, {side, side, side}, expected);
}

inline Eigen::Map<const Complexes> complexes(const py::object& object, const char* name,
                                             const char* expected) {
    const auto array = require<std::complex<float>>(object, name, 2, expected);
    return {contiguous<std::complex<float>>(array, name), array.shape(0), array.shape(1)};
}

template <typename Scalar>
StackView<Scalar> stack(const py::object& object, const char* name, const char* expected) {
    const auto array = require<Scalar>(object, name, 3, expected);
    return {contiguous<Scalar>(array, name), static_cast<int>(array.shape(0)),
            static_cast<int>(array.shape(1)), static_cast<int>(array.shape(2))};
}

inline FilterStack filter_stack(const py::object& object, const char* name) {
    const auto array = require<std::complex<float>>(object, name, 4, "complex64 (F, K, R, C // 2 + 1)");
    const auto size = [&](int axis) { return static_cast<int>(array.shape(axis)); };
    return {contiguous<std::complex<float>>(array, name), size(0), size(1), size(2), size(3)};
}

inline Bgr bgr(const py::object& object, const char* name) {
    const char* expected = "a uint8 color (3,): blue, green, red";
    const auto array = require<std::uint8_t>(object, name, 1, expected);
    if (array.shape(0) != 3)
        throw py::value_error(std::string(name) + ": expected " + expected + ", got " + describe(array));
    const auto* data = contiguous<std::uint8_t>(array, name);
    return {data[0], data[1], data[2]};
}

/// x0, y0, x1, y1, pixels.
using RegionTuple = std::tuple<int, int, int, int>;

inline Region region_of(const RegionTuple& corners) {
    const auto [x0, y0, x1, y1] = corners;
    return {x0, y0, x1, y1};
}

inline std::optional<Region> region_of(const std::optional<RegionTuple>& corners) {
    if (!corners) return {};
    return region_of(*corners);
}

inline RegionTuple tuple_of(const Region& region) {
    return {region.x0, region.y0, region.x1, region.y1};
}

/// Factors of blue, green and red.
inline std::array<double, 3> channel_gains(const Array<double>& gains) {
    const auto each = vector(gains, "gains");
    if (each.size() != 3)
        throw py::value_error("gains: expected float64 (3,), got (" + std::to_string(each.size()) + ",)");
    return {each[0], each[1], each[2]};
}

/// A new array, C-contiguous; without the steps by which pybind11 makes arrays of any layout, which take as long again.
template <typename Scalar>
py::array empty(const py::ssize_t* shape, int rank) {
    auto& numpy = py::detail::npy_api::get();
    PyObject* type = numpy.PyArray_DescrFromType_(py::detail::npy_format_descriptor<Scalar>::value);
    const auto made = py::reinterpret_steal<py::array>(
        numpy.PyArray_NewFromDescr_(numpy.PyArray_Type_, type, rank, shape, nullptr, nullptr, 0, nullptr));
    if (!made) throw py::error_already_set();
    return made;
}

/// Hands a result's memory to NumPy, in the shape given, without a copy where that takes longer than to make an owner.
template <typename Result>
Array<typename Result::Scalar> give(Result&& result, const py::ssize_t* shape, int rank) {
    static_assert(!std::is_lvalue_reference_v<Result>, "give(std::move(result))");
    using Scalar = typename Result::Scalar;
    constexpr std::size_t kSmall = 4096;  // bytes
    const auto size = static_cast<std::size_t>(result.size());
    if (size * sizeof(Scalar) <= kSmall) {
        py::array copy = empty<Scalar>(shape, rank);
        std::copy_n(result.data(), size, static_cast<Scalar*>(copy.mutable_data()));
        return py::reinterpret_steal<Array<Scalar>>(copy.release());
    }
    auto* owned = new Result(std::forward<Result>(result));
    const py::capsule owner(owned, [](void* pointer) { delete static_cast<Result*>(pointer); });
    return py::array_t<Scalar>(std::vector<py::ssize_t>(shape, shape + rank), owned->data(), owner);
}

template <typename Result>
Array<typename Result::Scalar> give(Result&& result, const std::vector<py::ssize_t>& shape) {
    return give(std::forward<Result>(result), shape.data(), static_cast<int>(shape.size()));
}

/// In its own shape.
template <typename Result>
Array<typename Result::Scalar> give(Result&& result) {
    const py::ssize_t shape[] = {result.rows(), result.cols()};
    return give(std::forward<Result>(result), shape, Result::ColsAtCompileTime == 1 ? 1 : 2);
}

}  // namespace tricue::bindings

template <typename Scalar>
struct pybind11::detail::handle_type_name<tricue::bindings::Array<Scalar>> {
    static constexpr auto name =
        const_name("numpy.typing.NDArray[") + npy_format_descriptor<Scalar>::name + const_name("]");
};
