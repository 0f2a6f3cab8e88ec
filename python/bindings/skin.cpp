// SPDX-License-Identifier: MIT
#include <pybind11/stl.h>

#include "arrays.hpp"
#include "cues/color/skin_blobs.hpp"
#include "cues/color/skin_boundary.hpp"
#include "cues/color/skin_gaussian.hpp"
#include "cues/color/skin_moments.hpp"
#include "cues/color/skin_reference.hpp"
#include "cues/color/skin_rule.hpp"

namespace tricue::bindings {
namespace {

using Bytes = Array<std::uint8_t>;
using Corners = std::tuple<int, int, int, int>;

Bytes skin_reference_arrays(const Bytes& patch) {
    const auto view = color_image(patch, "patch");
    const Bgr color = unlocked(std::ptrdiff_t{view.rows} * view.cols, [&] { return skin_reference(view); });
    return py::array_t<std::uint8_t>(3, color.data());
}

Array<std::int16_t> skin_boundary_arrays(const Bytes& image, const Bytes& reference) {
    const auto view = color_image(image, "image");
    const auto color = bgr(reference, "reference");
    return give(unlocked(std::ptrdiff_t{view.rows} * view.cols, [&] { return skin_boundary(view, color); }));
}

Array<double> skin_moments_arrays(const Bytes& image, const Bytes& reference, double threshold,
                                  const Corners& region) {
    const auto view = color_image(image, "image");
    const auto color = bgr(reference, "reference");
    const auto [x0, y0, x1, y1] = region;
    const Region corners{x0, y0, x1, y1};
    return give(unlocked(std::ptrdiff_t{view.rows} * view.cols,
                         [&] { return skin_moments(view, color, threshold, corners); }));
}

Array<double> skin_blobs_arrays(const Bytes& image, const Bytes& reference, double threshold, int min_area) {
    const auto view = color_image(image, "image");
    const auto color = bgr(reference, "reference");
    return give(unlocked(std::ptrdiff_t{view.rows} * view.cols,
                         [&] { return skin_blobs(view, color, threshold, min_area); }));
}

Array<float> skin_rule_arrays(const Bytes& pixels) {
    const auto view = samples(pixels, "samples");
    return give(unlocked(view.ellipses * view.n, [&] { return skin_rule(view); }));
}

Array<float> skin_gaussian_arrays(const Bytes& pixels, const Array<double>& mean,
                                  const Array<double>& precision) {
    const auto view = samples(pixels, "samples");
    const auto centre = vector(mean, "mean");
    const auto inverse = states(precision, "precision");
    return give(unlocked(view.ellipses * view.n, [&] { return skin_gaussian(view, centre, inverse); }));
}

}  // namespace

void define_skin(py::module_& m) {
    m.def("skin_reference", skin_reference_arrays, py::arg("patch"),
          "Reference color (3,) of a BGR patch: the mode of its histogram of 32 levels a channel, refined by "
          "the mean there.");
    m.def("skin_boundary", skin_boundary_arrays, py::arg("image"), py::arg("reference"),
          "255 max(b, g, r) - 255 max|c - c0| of every pixel, (H, W) int16, equations (5)-(10).");
    m.def("skin_moments", skin_moments_arrays, py::arg("image"), py::arg("reference"), py::arg("threshold"),
          py::arg("region"),
          "(6,) count, mean x, mean y, var xx, var yy, cov xy of the skin pixels in region (x0, y0, x1, y1), "
          "equations "
          "(5)-(16) divided by the count; zeros where there are none.");
    m.def("skin_blobs", skin_blobs_arrays, py::arg("image"), py::arg("reference"), py::arg("threshold"),
          py::arg("min_area"),
          "(M, 7) x, y, width, height, area, cx, cy of the 8-connected regions of skin, largest first.");
    m.def("skin_rule", skin_rule_arrays, py::arg("samples"),
          "1 where a sample is skin by the explicit rule of Peer et al. 2003, else 0: (N, n).");
    m.def("skin_gaussian", skin_gaussian_arrays, py::arg("samples"), py::arg("mean"), py::arg("precision"),
          "exp(-d^2 / 2) of every sample, d the Mahalanobis distance of its (Cb, Cr) to the mean: (N, n).");
}

}  // namespace tricue::bindings
