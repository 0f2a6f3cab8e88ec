// SPDX-License-Identifier: MIT
#include "arrays.hpp"
#include "fuse/filter_rectangles.hpp"
#include "kernel_docs.hpp"
#include "tuples.hpp"

namespace tricue::bindings {
namespace {

using Doubles = Array<double>;
using LikelihoodTuple =
    Tuple<Doubles, double, double, Tuple<int, int, double, int>, double, double, bool, double, double>;
using PriorTuple = Tuple<Tuple<Doubles, Doubles>, Tuple<Doubles, Doubles, double>>;

DepthLikelihood depth_likelihood(const LikelihoodTuple& likelihood) {
    const auto [model, middle, span, places, reach, occluder_margin, linear, sharpness, contrast] =
        unpack(likelihood, "likelihood");
    return {vector(model, "model"),
            middle,
            span,
            unpack_as<RectanglePattern>(places, "places"),
            reach,
            occluder_margin,
            linear,
            sharpness,
            contrast};
}

RectanglePrior rectangle_prior_of(const PriorTuple& prior) {
    const auto [mean_size, measured] = unpack(prior, "prior");
    const auto [size, spread] = unpack(mean_size, "mean_size");
    const auto [state, deviation, max_cost] = unpack(measured, "measured");
    return {{vector(size, "size"), vector(spread, "spread")},
            {vector(state, "state"), vector(deviation, "deviation"), max_cost}};
}

std::tuple<Doubles, Doubles, Doubles, Doubles, Doubles, Doubles> filter_rectangles_arrays(
    const Array<float>& depth, const Doubles& camera, const Tuple<Doubles, Doubles, double>& before,
    const Doubles& noise, const Tuple<Doubles, Doubles>& dynamics, const Tuple<Doubles, Doubles>& bounds,
    const Tuple<Doubles, Doubles, double>& detection, const Tuple<Doubles, double>& refinement,
    const LikelihoodTuple& likelihood, const PriorTuple& prior) {
    const auto image = depth_image(depth, "depth");
    const auto lens = vector(camera, "camera");
    const auto [particles, weights, offset] = unpack(before, "before");
    const WeightedRectangles last{states(particles, "particles"), vector(weights, "weights"), offset};
    const auto draws = stack<double>(noise, "noise", "float64 (S, N, 5)");
    const auto [drift, scale] = unpack(dynamics, "dynamics");
    const Dynamics moves{vector(drift, "drift"), vector(scale, "scale")};
    const auto [lower, upper] = unpack(bounds, "bounds");
    const Bounds limits{vector(lower, "lower"), vector(upper, "upper")};
    const auto [mean, root, share] = unpack(detection, "detection");
    const Detection seen{vector(mean, "mean"), states(root, "root"), share};
    const auto [close_scale, least] = unpack(refinement, "refinement");
    const Refinement closer{vector(close_scale, "scale"), least};
    const DepthLikelihood by = depth_likelihood(likelihood);
    const RectanglePrior known = rectangle_prior_of(prior);
    const auto work = work_of(draws.planes, draws.rows, by.places.rows, by.places.columns);
    auto after = unlocked(work, [&] {
        return filter_rectangles(image, lens, last, draws, moves, limits, seen, closer, by, known);
    });
    return {give(std::move(after.particles)), give(std::move(after.weights)),
            give(std::move(after.mean)),      give(std::move(after.covariance)),
            give(std::move(after.observed)),  give(std::move(after.histogram))};
}

}  // namespace

void define_depth_filter(py::module_& m) {
    m.def("filter_rectangles", filter_rectangles_arrays, py::arg("depth"), py::arg("camera"),
          py::arg("before"), py::arg("noise"), py::arg("dynamics"), py::arg("bounds"), py::arg("detection"),
          py::arg("refinement"), py::arg("likelihood"), py::arg("prior"), docs::filter_rectangles);
}

}  // namespace tricue::bindings
