// SPDX-License-Identifier: MIT
// A target in a patch around it: stages of a frame.
#include "arrays.hpp"
#include "cues/color/learn_patch_colors.hpp"
#include "fuse/learn_place_filter.hpp"
#include "fuse/learn_size_filter.hpp"
#include "fuse/localize_target.hpp"
#include "fuse/log_polar_shift.hpp"
#include "kernel_docs.hpp"
#include "spectra.hpp"
#include "tuples.hpp"

namespace tricue::bindings {
namespace {

using Bytes = Array<std::uint8_t>;

constexpr const char* kTaper = "float32 (R, C)";

Eigen::Map<const Floats> plane(const Floating& numbers, const char* name, const char* expected) {
    return floats(numbers, name, {-1, -1}, expected);
}

Eigen::Map<const PixelPlaces> pixel_places(const Array<std::int64_t>& places) {
    const auto array = require<std::int64_t>(places, "places", 2, "int64 (2R, 2C)");
    return {contiguous<std::int64_t>(array, "places"), array.shape(0), array.shape(1)};
}

PlaneView posterior(const Floating& other) {
    return plane_view(other, "other", "a float32 posterior (H, W)");
}

std::ptrdiff_t work(const ImageView& patch) {
    return std::ptrdiff_t{patch.rows} * patch.cols;
}

using SearchTuple = Tuple<double, double, double, double, double, double, double>;

std::tuple<Array<double>, Floating> localize_target_arrays(
    const Bytes& patch, const Floating& taper, const Tuple<Complex, Floating, Array<double>>& appearance,
    const Floating& other, const SearchTuple& search) {
    const auto view = color_image(patch, "patch");
    const auto weights = plane(taper, "taper", kTaper);
    const auto [filters, table, roots] = unpack(appearance, "appearance");
    const TargetAppearance target{filter_stack(filters, "filters"), color_cube(table),
                                  vector(roots, "roots")};
    const auto others = posterior(other);
    const auto wanted = unpack_as<TargetSearch>(search, "search");
    auto place = unlocked(work(view), [&] { return localize_target(view, weights, target, others, wanted); });
    return {give(std::move(place.found)),
            give(std::move(place.responses), {target.filters.filters, weights.rows(), weights.cols()})};
}

std::tuple<double, double> log_polar_shift_arrays(const Bytes& patch, const Array<std::int64_t>& places,
                                                  const Floating& taper, const Complex& filter,
                                                  const Tuple<int, int, double>& range) {
    const auto view = color_image(patch, "patch");
    const auto pixels = pixel_places(places);
    const auto weights = plane(taper, "taper", kTaper);
    const auto model = filter_stack(filter, "filter");
    const auto near = unpack_as<ShiftRange>(range, "range");
    const Shift shift =
        unlocked(work(view), [&] { return log_polar_shift(view, pixels, weights, model, near); });
    return {shift.right, shift.response};
}

std::tuple<Complex, Complex> learn_place_filter_arrays(const Bytes& patch, const Floating& taper,
                                                       const Floating& mask, const Complex& label,
                                                       const Complex& previous, const Complex& first,
                                                       double temporal_weight, double penalty,
                                                       double first_weight) {
    const auto view = color_image(patch, "patch");
    const auto weights = plane(taper, "taper", kTaper);
    const auto part = plane(mask, "mask", kTaper);
    const auto wanted = complexes(label, "label", kSpectrum);
    const auto before = stack<std::complex<float>>(previous, "previous", kFilter);
    const auto oldest = stack<std::complex<float>>(first, "first", kFilter);
    auto filter = unlocked(work(view), [&] {
        return learn_place_filter(view, weights, part, wanted, before, oldest, temporal_weight, penalty,
                                  first_weight);
    });
    const py::ssize_t planes = before.planes, rows = before.rows, cols = before.cols;
    return {give(std::move(filter.learned), {planes, rows, cols}),
            give(std::move(filter.applied), {2, planes, rows, cols})};
}

using FilterTuple = Tuple<Complex, Floating>;

FilterParts filter_parts(const FilterTuple& filter, const char* name, const char* numerator,
                         const char* denominator) {
    const auto [upper, lower] = unpack(filter, name);
    return {stack<std::complex<float>>(upper, numerator, kFilter), plane(lower, denominator, kHalf)};
}

std::tuple<std::tuple<Complex, Floating>, Complex> learn_size_filter_arrays(
    const Bytes& patch, const Array<std::int64_t>& places, const Floating& taper, const Complex& label,
    const FilterTuple& learned, const FilterTuple& first, double rate, double first_weight, double ridge) {
    const auto view = color_image(patch, "patch");
    const auto pixels = pixel_places(places);
    const auto weights = plane(taper, "taper", kTaper);
    const auto wanted = complexes(label, "label", kSpectrum);
    const FilterParts before = filter_parts(learned, "learned", "numerator", "denominator"),
                      oldest = filter_parts(first, "first", "first_numerator", "first_denominator");
    auto filter = unlocked(work(view), [&] {
        return learn_size_filter(view, pixels, weights, wanted, before, oldest, rate, first_weight, ridge);
    });
    const py::ssize_t planes = before.numerator.planes, rows = before.numerator.rows,
                      cols = before.numerator.cols;
    return {{give(std::move(filter.learned.numerator), {planes, rows, cols}),
             give(std::move(filter.learned.denominator))},
            give(std::move(filter.applied), {1, planes, rows, cols})};
}

std::tuple<Floating, Floating, Floating> learn_patch_colors_arrays(
    const Bytes& patch, const Floating& other, const Tuple<double, double, double, double, double>& pixels,
    const Floating& target, const Floating& surround, double rate, double rare) {
    const auto view = color_image(patch, "patch");
    const auto others = posterior(other);
    const auto own = color_cube(target, "target"), around = color_cube(surround, "surround");
    const auto learned = unpack_as<LearnedPixels>(pixels, "pixels");
    auto [within, without, table] = unlocked(
        work(view), [&] { return learn_patch_colors(view, others, learned, own, around, rate, rare); });
    const std::vector<py::ssize_t> shape(3, own.cols());
    return {give(std::move(within), shape), give(std::move(without), shape), give(std::move(table), shape)};
}

}  // namespace

void define_target(py::module_& m) {
    m.def("localize_target", localize_target_arrays, py::arg("patch"), py::arg("taper"),
          py::arg("appearance"), py::arg("other"), py::arg("search"), docs::localize_target);
    m.def("log_polar_shift", log_polar_shift_arrays, py::arg("patch"), py::arg("places"), py::arg("taper"),
          py::arg("filter"), py::arg("range"), docs::log_polar_shift);
    m.def("learn_place_filter", learn_place_filter_arrays, py::arg("patch"), py::arg("taper"),
          py::arg("mask"), py::arg("label"), py::arg("previous"), py::arg("first"),
          py::arg("temporal_weight"), py::arg("penalty"), py::arg("first_weight"), docs::learn_place_filter);
    m.def("learn_size_filter", learn_size_filter_arrays, py::arg("patch"), py::arg("places"),
          py::arg("taper"), py::arg("label"), py::arg("learned"), py::arg("first"), py::arg("rate"),
          py::arg("first_weight"), py::arg("ridge"), docs::learn_size_filter);
    m.def("learn_patch_colors", learn_patch_colors_arrays, py::arg("patch"), py::arg("other"),
          py::arg("pixels"), py::arg("target"), py::arg("surround"), py::arg("rate"), py::arg("rare"),
          docs::learn_patch_colors);
}

}  // namespace tricue::bindings
