// SPDX-License-Identifier: MIT
#include "arrays.hpp"
#include "fuse/filter_rectangles.hpp"
#include "kernel_docs.hpp"

namespace tricue::bindings {
namespace {

using Doubles = Array<double>;

std::tuple<Doubles, Doubles, Doubles, Doubles, Doubles, Doubles> filter_rectangles_arrays(
    const Array<float>& depth, const Doubles& camera, const Doubles& particles, const Doubles& weights,
    double offset, const Doubles& noise, std::pair<Doubles, Doubles> dynamics,
    std::pair<Doubles, Doubles> bounds, std::tuple<Doubles, Doubles, double> detection,
    std::pair<Doubles, double> refinement, const Doubles& model, std::pair<double, double> levels,
    std::pair<int, int> grid, std::pair<double, int> ring, double reach, double occluder_margin,
    std::tuple<bool, double, double> likelihood, std::pair<Doubles, Doubles> mean_size,
    std::tuple<Doubles, Doubles, double> measured) {
    const auto image = depth_image(depth, "depth");
    const auto lens = vector(camera, "camera");
    const WeightedRectangles before{states(particles, "particles"), vector(weights, "weights"), offset};
    const auto draws = stack<double>(noise, "noise", "float64 (S, N, 5)");
    const Dynamics moves{vector(dynamics.first, "drift"), vector(dynamics.second, "scale")};
    const Bounds limits{vector(bounds.first, "lower"), vector(bounds.second, "upper")};
    const auto& [mean, root, share] = detection;
    const Detection seen{vector(mean, "mean"), states(root, "root"), share};
    const Refinement closer{vector(refinement.first, "scale"), refinement.second};
    const auto [linear, sharpness, contrast] = likelihood;
    const DepthLikelihood by{{vector(model, "model"), levels.second},
                             levels.first,
                             {grid.first, grid.second, ring.first, ring.second},
                             reach,
                             occluder_margin,
                             linear,
                             sharpness,
                             contrast};
    const MeanSize sizes{vector(mean_size.first, "size"), vector(mean_size.second, "spread")};
    const auto& [state, deviation, max_cost] = measured;
    const MeasuredState object{vector(state, "state"), vector(deviation, "deviation"), max_cost};
    const auto work = work_of(draws.planes, draws.rows, grid.first, grid.second);
    auto after = unlocked(work, [&] {
        return filter_rectangles(image, lens, before, draws, moves, limits, seen, closer, by, sizes, object);
    });
    return {give(std::move(after.particles)), give(std::move(after.weights)),
            give(std::move(after.mean)),      give(std::move(after.covariance)),
            give(std::move(after.observed)),  give(std::move(after.histogram))};
}

}  // namespace

void define_depth_filter(py::module_& m) {
    m.def("filter_rectangles", filter_rectangles_arrays, py::arg("depth"), py::arg("camera"),
          py::arg("particles"), py::arg("weights"), py::arg("offset"), py::arg("noise"), py::arg("dynamics"),
          py::arg("bounds"), py::arg("detection"), py::arg("refinement"), py::arg("model"), py::arg("levels"),
          py::arg("grid"), py::arg("ring"), py::arg("reach"), py::arg("occluder_margin"),
          py::arg("likelihood"), py::arg("mean_size"), py::arg("measured"), docs::filter_rectangles);
}

}  // namespace tricue::bindings
