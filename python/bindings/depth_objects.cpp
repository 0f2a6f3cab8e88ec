// SPDX-License-Identifier: MIT
#include "arrays.hpp"
#include "cues/depth/density_extrema.hpp"
#include "cues/depth/depth_components.hpp"
#include "cues/depth/depth_density.hpp"
#include "cues/depth/depth_distance.hpp"
#include "cues/depth/rectangle_histogram.hpp"

namespace tricue::bindings {
namespace {

Array<double> depth_density_arrays(const Array<double>& histogram, double bandwidth) {
    const auto counts = vector(histogram, "histogram");
    return give(unlocked(counts.size(), [&] { return depth_density(counts, bandwidth); }));
}

std::tuple<Array<std::int64_t>, Array<std::int64_t>> density_extrema_arrays(const Array<double>& density,
                                                                            double prominence) {
    const auto levels = vector(density, "density");
    auto extrema = unlocked(levels.size(), [&] { return density_extrema(levels, prominence); });
    return {give(std::move(extrema.maxima)), give(std::move(extrema.minima))};
}

ImageView label_image(const Array<std::uint8_t>& labels) {
    const auto array = require<std::uint8_t>(labels, "labels", 2, "uint8 labels (H, W)");
    return {contiguous<std::uint8_t>(array, "labels"), static_cast<int>(array.shape(0)),
            static_cast<int>(array.shape(1)), 1, array.shape(1)};
}

std::tuple<Array<double>, Array<float>, Array<float>, Array<float>, Array<std::int32_t>>
depth_components_arrays(const Array<std::uint8_t>& labels, const Array<float>& depth, double near, double far,
                        int levels, int bins, int min_area) {
    const auto regions = label_image(labels);
    const auto metres = depth_image(depth, "depth");
    const Signature signature{near, far, levels, bins};
    auto found = unlocked(std::ptrdiff_t{metres.rows} * metres.cols,
                          [&] { return depth_components(regions, metres, signature, min_area); });
    return {give(std::move(found.table)), give(std::move(found.histograms)), give(std::move(found.columns)),
            give(std::move(found.rows)), give(std::move(found.components))};
}

Array<double> depth_distance_arrays(const Array<float>& depth, const Array<double>& rectangles,
                                    const Array<double>& model, const Array<double>& pattern, double reach,
                                    double nearer) {
    const auto metres = depth_image(depth, "depth");
    const auto each = states(rectangles, "rectangles");
    const DepthModel target{vector(model, "model"), reach};
    const auto places = states(pattern, "pattern");
    return give(unlocked(each.rows() * places.rows(),
                         [&] { return depth_distance(metres, each, target, places, nearer); }));
}

Array<double> rectangle_histogram_arrays(const Array<float>& depth, const Array<double>& rectangle,
                                         int levels, const Array<double>& pattern, double reach) {
    const auto metres = depth_image(depth, "depth");
    const auto numbers = vector(rectangle, "rectangle");
    const auto places = states(pattern, "pattern");
    return give(
        unlocked(places.rows(), [&] { return rectangle_histogram(metres, numbers, levels, places, reach); }));
}

}  // namespace

void define_depth_objects(py::module_& m) {
    m.def("depth_density", depth_density_arrays, py::arg("histogram"), py::arg("bandwidth"),
          "p(z) of equation (32), (L,) of sum 1: a histogram (L,) of depth levels, smoothed by a Gaussian.");
    m.def("density_extrema", density_extrema_arrays, py::arg("density"), py::arg("prominence"),
          "Levels (M,) of a density's maxima of at least this prominence, and (M - 1,) of its minima between "
          "them, equations (32)-(34).");
    m.def(
        "depth_components", depth_components_arrays, py::arg("labels"), py::arg("depth"), py::arg("near"),
        py::arg("far"), py::arg("levels"), py::arg("bins"), py::arg("min_area"),
        "The 8-connected regions of one label, largest first: (C, 7) x, y, width, height, area, mean depth, "
        "label; (C, levels) depth histograms; (C, bins) spread over columns, and over rows; (H, W) which "
        "region has a pixel, from 1.");
    m.def("depth_distance", depth_distance_arrays, py::arg("depth"), py::arg("rectangles"), py::arg("model"),
          py::arg("pattern"), py::arg("reach"), py::arg("nearer"),
          "(N, 3) of each rectangle (N, 5) x, y, width, height, z: equation (38) over sqrt 2 between its "
          "depths "
          "relative to z and the model (L,); the share of the places (n, 2) within reach of z; the share "
          "nearer than z - nearer.");
    m.def("rectangle_histogram", rectangle_histogram_arrays, py::arg("depth"), py::arg("rectangle"),
          py::arg("levels"), py::arg("pattern"), py::arg("reach"),
          "(levels,) of sum 1: the depths in a rectangle (5,) x, y, width, height, z, relative to z, in "
          "[-reach, reach).");
}

}  // namespace tricue::bindings
