// SPDX-License-Identifier: MIT
#include "arrays.hpp"
#include "cues/depth/density_extrema.hpp"
#include "cues/depth/depth_density.hpp"

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

}  // namespace

void define_depth_objects(py::module_& m) {
    m.def("depth_density", depth_density_arrays, py::arg("histogram"), py::arg("bandwidth"),
          "p(z) of equation (32), (L,) of sum 1: a histogram (L,) of depth levels, smoothed by a Gaussian.");
    m.def("density_extrema", density_extrema_arrays, py::arg("density"), py::arg("prominence"),
          "Levels (M,) of a density's maxima of at least this prominence, and (M - 1,) of its minima between "
          "them, equations (32)-(34).");
}

}  // namespace tricue::bindings
