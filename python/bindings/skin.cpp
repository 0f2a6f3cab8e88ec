// SPDX-License-Identifier: MIT
#include <pybind11/stl.h>

#include <algorithm>

#include "arrays.hpp"
#include "cues/color/skin_blobs.hpp"
#include "cues/color/skin_boundary.hpp"
#include "cues/color/skin_gaussian.hpp"
#include "cues/color/skin_moments.hpp"
#include "cues/color/skin_reference.hpp"
#include "cues/color/skin_rule.hpp"
#include "kernel_docs.hpp"

namespace tricue::bindings {
namespace {

using Bytes = Array<std::uint8_t>;

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
                                  const RegionTuple& region, int step) {
    const auto view = color_image(image, "image");
    const auto color = bgr(reference, "reference");
    const Region corners = region_of(region);
    return give(unlocked(work_in(corners.clipped(view)) / std::max(step, 1),
                         [&] { return skin_moments(view, color, threshold, corners, step); }));
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
    const auto center = vector(mean, "mean");
    const auto inverse = states(precision, "precision");
    return give(unlocked(view.ellipses * view.n, [&] { return skin_gaussian(view, center, inverse); }));
}

}  // namespace

void define_skin(py::module_& m) {
    m.def("skin_reference", skin_reference_arrays, py::arg("patch"), docs::skin_reference);
    m.def("skin_boundary", skin_boundary_arrays, py::arg("image"), py::arg("reference"), docs::skin_boundary);
    m.def("skin_moments", skin_moments_arrays, py::arg("image"), py::arg("reference"), py::arg("threshold"),
          py::arg("region"), py::arg("step"), docs::skin_moments);
    m.def("skin_blobs", skin_blobs_arrays, py::arg("image"), py::arg("reference"), py::arg("threshold"),
          py::arg("min_area"), docs::skin_blobs);
    m.def("skin_rule", skin_rule_arrays, py::arg("samples"), docs::skin_rule);
    m.def("skin_gaussian", skin_gaussian_arrays, py::arg("samples"), py::arg("mean"), py::arg("precision"),
          docs::skin_gaussian);
}

}  // namespace tricue::bindings
