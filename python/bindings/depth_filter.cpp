// SPDX-License-Identifier: MIT
#include "arrays.hpp"
#include "fuse/filter_rectangles.hpp"
#include "fuse/rectangle_prior.hpp"
#include "kernel_docs.hpp"
#include "proposal_arguments.hpp"
#include "tuples.hpp"

namespace tricue::bindings {
namespace {

using Doubles = Array<double>;
using LikelihoodTuple =
    Tuple<Doubles, double, double, Tuple<int, int, double, int>, double, double, bool, double, double>;
using MeanSizeTuple = Tuple<Doubles, Doubles>;
using MeasuredStateTuple = Tuple<Doubles, Doubles, double>;

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

MeanSize mean_size_of(const MeanSizeTuple& mean_size) {
    const auto [size, spread] = unpack(mean_size, "mean_size");
    return {vector(size, "size"), vector(spread, "spread")};
}

MeasuredState measured_state(const MeasuredStateTuple& measured) {
    const auto [state, deviation, max_cost] = unpack(measured, "measured");
    return {vector(state, "state"), vector(deviation, "deviation"), max_cost};
}

Doubles rectangle_prior_arrays(const Doubles& rectangles, const MeanSizeTuple& mean_size,
                               const MeasuredStateTuple& measured) {
    const auto each = states(rectangles, "states");
    const MeanSize mean = mean_size_of(mean_size);
    const MeasuredState seen = measured_state(measured);
    return give(unlocked(each.size(), [&] { return rectangle_prior(each, mean, seen); }));
}

std::tuple<Doubles, Doubles, Doubles, Doubles, Doubles, Doubles> filter_rectangles_arrays(
    const Array<float>& depth, const Doubles& camera, const Tuple<Doubles, Doubles, double>& before,
    const Doubles& noise, const DynamicsTuple& dynamics, const BoundsTuple& bounds,
    const DetectionTuple& detection, const Tuple<Doubles, double>& refinement,
    const LikelihoodTuple& likelihood, const Tuple<MeanSizeTuple, MeasuredStateTuple>& prior) {
    const auto image = depth_image(depth, "depth");
    const auto lens = vector(camera, "camera");
    const auto [particles, weights, offset] = unpack(before, "before");
    const WeightedRectangles last{states(particles, "particles"), vector(weights, "weights"), offset};
    const auto draws = stack<double>(noise, "noise", "float64 (S, N, 5)");
    const Dynamics moves = dynamics_of(dynamics);
    const Bounds limits = bounds_of(bounds);
    const Detection seen = detection_of(detection);
    const auto [close_scale, min_size] = unpack(refinement, "refinement");
    const Refinement closer{vector(close_scale, "scale"), min_size};
    const DepthLikelihood by = depth_likelihood(likelihood);
    const auto [mean_size, measured] = unpack(prior, "prior");
    const RectanglePrior known{mean_size_of(mean_size), measured_state(measured)};
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
    m.def("rectangle_prior", rectangle_prior_arrays, py::arg("states"), py::arg("mean_size"),
          py::arg("measured"), docs::rectangle_prior);
}

}  // namespace tricue::bindings
