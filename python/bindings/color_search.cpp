// SPDX-License-Identifier: MIT
#include <pybind11/stl.h>

#include <optional>

#include "arrays.hpp"
#include "color_space.hpp"
#include "cues/color/best_ellipse.hpp"
#include "cues/color/color_bins.hpp"
#include "cues/color/ellipse_search.hpp"
#include "cues/color/histogram_mean.hpp"
#include "cues/color/image_mean.hpp"
#include "cues/color/learn_histogram.hpp"
#include "cues/color/shift_histogram.hpp"
#include "kernel_docs.hpp"

namespace tricue::bindings {
namespace {

using Triple = std::tuple<int, int, int>;

Array<double> image_mean_array(const Array<std::uint8_t>& image) {
    const auto view = color_image(image, "image");
    return give(unlocked(std::ptrdiff_t{view.rows} * view.cols, [&] { return image_mean(view); }));
}

Array<std::uint16_t> color_bins_arrays(const Array<std::uint8_t>& image, const RegionTuple& region,
                                       const SpaceTuple& space, int step,
                                       const std::optional<Array<double>>& gains) {
    const auto view = color_image(image, "image");
    const Region corners = region_of(region);
    const ColorSpace axes = color_space(space);
    const auto light = gains ? std::optional(channel_gains(*gains)) : std::nullopt;
    return give(unlocked(work_in(corners.clipped(view)),
                         [&] { return color_bins(view, corners, axes, step, light ? &*light : nullptr); }));
}

BinsView bins_image(const Array<std::uint16_t>& bins) {
    const auto array = require<std::uint16_t>(bins, "bins", 2, "uint16 bins (H, W)");
    return {contiguous<std::uint16_t>(array, "bins"), image_side(array, 0, "bins"),
            image_side(array, 1, "bins")};
}

/// Without a mask a view without data.
ImageView marks_or_none(const std::optional<Array<std::uint8_t>>& mask, const BinsView& bins) {
    return mask ? mask_image(*mask, "mask") : ImageView{nullptr, bins.rows, bins.cols, 1, 0};
}

Array<double> ellipse_search_arrays(const Array<std::uint16_t>& bins, const Array<double>& ellipse,
                                    const Triple& grid, const Array<double>& model, double margin,
                                    const std::optional<Array<std::uint8_t>>& mask) {
    const auto view = bins_image(bins);
    const auto numbers = vector(ellipse, "ellipse");
    const auto [rows, cols, step] = grid;
    const SearchGrid places{rows, cols, step};
    const SearchModel target{vector(model, "model"), margin};
    const auto marks = marks_or_none(mask, view);
    auto found = unlocked(std::ptrdiff_t{view.rows} * view.cols,
                          [&] { return ellipse_search(view, numbers, places, target, marks); });
    return give(std::move(found), {rows, cols, 4});
}

using Weights = std::tuple<double, double, double>;

std::tuple<int, int, double, double, double, Array<double>> best_ellipse_arrays(
    const Array<std::uint16_t>& bins, const Array<double>& ellipse, const Triple& grid,
    const Array<double>& model, double margin, const Array<std::uint8_t>& mask, const Weights& weights,
    int min_marked) {
    const auto view = bins_image(bins);
    const auto numbers = vector(ellipse, "ellipse");
    const auto [rows, cols, step] = grid;
    const SearchGrid places{rows, cols, step};
    const SearchModel target{vector(model, "model"), margin};
    const auto marks = mask_image(mask, "mask");
    const auto [ring, depth, depth_ring] = weights;
    const ScoreWeights terms{ring, depth, depth_ring};
    auto found = unlocked(std::ptrdiff_t{view.rows} * view.cols, [&] {
        return best_ellipse(view, numbers, places, target, marks, terms, min_marked);
    });
    return {found.row,          found.col,    found.score,
            found.intersection, found.marked, give(std::move(found.histogram))};
}

Array<double> histogram_mean_arrays(const Array<double>& histogram, const SpaceTuple& space) {
    const auto masses = vector(histogram, "histogram");
    const ColorSpace axes = color_space(space);
    return give(unlocked(masses.size(), [&] { return histogram_mean(masses, axes); }));
}

std::tuple<Array<double>, Array<double>, Array<double>> learn_histogram_arrays(
    const Array<double>& histogram, const Array<double>& measured, double rate, const Array<double>& first,
    double weight, const SpaceTuple& space) {
    const auto before = vector(histogram, "histogram"), seen = vector(measured, "measured");
    const FirstColors kept{vector(first, "first"), weight};
    const ColorSpace axes = color_space(space);
    auto learned = unlocked(before.size(), [&] { return learn_histogram(before, seen, rate, kept, axes); });
    return {give(std::move(learned.histogram)), give(std::move(learned.model)),
            give(std::move(learned.color))};
}

Array<double> shift_histogram_arrays(const Array<double>& histogram, const SpaceTuple& space,
                                     const Array<double>& mean) {
    const auto masses = vector(histogram, "histogram");
    const ColorSpace axes = color_space(space);
    const auto target = vector(mean, "mean");
    return give(unlocked(masses.size(), [&] { return shift_histogram(masses, axes, target); }));
}

}  // namespace

void define_color_search(py::module_& m) {
    m.def("color_bins", color_bins_arrays, py::arg("image"), py::arg("region"), py::arg("space"),
          py::arg("step"), py::arg("gains") = py::none(), docs::color_bins);
    m.def("image_mean", image_mean_array, py::arg("image"), docs::image_mean);
    m.def("ellipse_search", ellipse_search_arrays, py::arg("bins"), py::arg("ellipse"), py::arg("grid"),
          py::arg("model"), py::arg("margin"), py::arg("mask"), docs::ellipse_search);
    m.def("best_ellipse", best_ellipse_arrays, py::arg("bins"), py::arg("ellipse"), py::arg("grid"),
          py::arg("model"), py::arg("margin"), py::arg("mask"), py::arg("weights"), py::arg("min_marked"),
          docs::best_ellipse);
    m.def("histogram_mean", histogram_mean_arrays, py::arg("histogram"), py::arg("space"),
          docs::histogram_mean);
    m.def("learn_histogram", learn_histogram_arrays, py::arg("histogram"), py::arg("measured"),
          py::arg("rate"), py::arg("first"), py::arg("weight"), py::arg("space"), docs::learn_histogram);
    m.def("shift_histogram", shift_histogram_arrays, py::arg("histogram"), py::arg("space"), py::arg("mean"),
          docs::shift_histogram);
}

}  // namespace tricue::bindings
