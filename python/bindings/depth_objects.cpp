// SPDX-License-Identifier: MIT
#include "arrays.hpp"
#include "cues/depth/depth_density.hpp"

namespace tricue::bindings {
namespace {

Array<double> depth_density_arrays(const Array<double>& histogram, double bandwidth) {
    const auto counts = vector(histogram, "histogram");
    return give(unlocked(counts.size(), [&] { return depth_density(counts, bandwidth); }));
}

}  // namespace

void define_depth_objects(py::module_& m) {
    m.def("depth_density", depth_density_arrays, py::arg("histogram"), py::arg("bandwidth"),
          "p(z) of equation (32), (L,) of sum 1: a histogram (L,) of depth levels, smoothed by a Gaussian.");
}

}  // namespace tricue::bindings
