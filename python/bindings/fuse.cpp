// SPDX-License-Identifier: MIT
#include <pybind11/stl.h>

#include <optional>
#include <tuple>

#include "arrays.hpp"
#include "fuse/rank_filter.hpp"
#include "fuse/resample.hpp"
#include "fuse/reweight.hpp"
#include "fuse/summarize.hpp"
#include "kernel_docs.hpp"
#include "proposal_arguments.hpp"
#include "rank_arguments.hpp"

namespace tricue::bindings {
namespace {

Array<std::int64_t> resample_arrays(const Array<double>& weights, double offset) {
    const auto view = vector(weights, "weights");
    return give(unlocked(view.size(), [&] { return resample(view, offset); }));
}

Array<double> propose_arrays(const Array<double>& particles, const DynamicsTuple& dynamics,
                             const Array<double>& noise, const DetectionTuple& detection,
                             const BoundsTuple& bounds) {
    const auto from = states(particles, "particles");
    const Dynamics moves = dynamics_of(dynamics);
    const auto draws = states(noise, "noise");
    const Detection seen = detection_of(detection);
    const Bounds limits = bounds_of(bounds);
    return give(unlocked(from.size(), [&] { return propose(from, moves, draws, seen, limits); }));
}

std::tuple<Array<double>, double> reweight_arrays(const Array<double>& log_likelihood,
                                                  const Array<double>& proposed,
                                                  const Array<double>& previous,
                                                  const DynamicsTuple& dynamics,
                                                  const DetectionTuple& detection) {
    const auto likelihood = vector(log_likelihood, "log_likelihood");
    const auto to = states(proposed, "proposed");
    const auto from = states(previous, "previous");
    const Dynamics moves = dynamics_of(dynamics);
    const Detection seen = detection_of(detection);
    auto result = unlocked(to.size(), [&] { return reweight(likelihood, to, from, moves, seen); });
    return {give(std::move(result.weights)), result.log_evidence};
}

std::tuple<Array<double>, Array<double>, double> summarize_arrays(const Array<double>& particles,
                                                                  const Array<double>& weights) {
    const auto points = states(particles, "particles");
    const auto masses = vector(weights, "weights");
    auto result = unlocked(points.size(), [&] { return summarize(points, masses); });
    return {give(std::move(result.mean)), give(std::move(result.covariance)), result.effective};
}

using Pair = Tuple<double, double>;
using Triangle = Tuple<double, double, double>;
using Four = Tuple<double, double, double, double>;

/// A tuple's numbers, one after the other.
template <typename... Numbers>
Vector numbers(const Tuple<Numbers...>& tuple, const char* name) {
    Vector each(sizeof...(Numbers));
    Eigen::Index place = 0;
    std::apply([&](auto... number) { ((each[place++] = number), ...); }, unpack(tuple, name));
    return each;
}

/// The lower triangle of a matrix, by rows.
States lower_triangle(const Triangle& triangle) {
    const auto [first, cross, second] = unpack(triangle, "root");
    States matrix(2, 2);
    matrix << first, 0.0, cross, second;
    return matrix;
}

std::tuple<Array<double>, Array<double>, double, Array<double>, double, Array<float>, Array<double>>
rank_filter_arrays(const Array<std::uint8_t>& image,
                   const Tuple<Array<double>, Array<double>, std::optional<double>>& last,
                   const Tuple<Array<double>, double>& noise, const Tuple<Four, Four>& dynamics,
                   const Tuple<Four, Four>& bounds, const Tuple<Pair, Triangle, double>& detection,
                   const PatternTuple& pattern, const AppearanceTuple& appearance,
                   const FactorsTuple& factors, double flat) {
    const auto view = color_image(image, "image");
    const auto [particles, weights, offset] = unpack(last, "last");
    const WeightedEllipses before{states(particles, "particles"), vector(weights, "weights"), offset};
    const auto [white, correlation] = unpack(noise, "noise");
    const EllipseNoise draws{states(white, "white"), correlation};
    const auto [drift, scale] = unpack(dynamics, "dynamics");
    const auto [lower, upper] = unpack(bounds, "bounds");
    const auto [mean, root, share] = unpack(detection, "detection");
    const Vector moves[] = {numbers(drift, "drift"), numbers(scale, "scale"), numbers(lower, "lower"),
                            numbers(upper, "upper"), numbers(mean, "mean")};
    const States factor = lower_triangle(root);
    const Detection detected{moves[4], factor, share};
    const EllipsePattern places = ellipse_pattern(pattern);
    const auto n = places.inside.rows();
    const ColorAppearance target = color_appearance(appearance, n);
    const LikelihoodFactors nats = likelihood_factors(factors);
    auto result = unlocked(before.particles.rows() * n, [&] {
        return rank_filter(view, before, draws, {moves[0], moves[1]}, {moves[2], moves[3]}, detected, places,
                           target, nats, flat);
    });
    return {give(std::move(result.particles)),
            give(std::move(result.weights)),
            result.effective,
            give(std::move(result.ellipse)),
            result.log_likelihood,
            give(std::move(result.ranks), {3, n}),
            give(std::move(result.correlations))};
}

}  // namespace

void define_fuse(py::module_& m) {
    m.def("resample", resample_arrays, py::arg("weights"), py::arg("offset"), docs::resample);
    m.def("propose", propose_arrays, py::arg("particles"), py::arg("dynamics"), py::arg("noise"),
          py::arg("detection"), py::arg("bounds"), docs::propose);
    m.def("rank_filter", rank_filter_arrays, py::arg("image"), py::arg("last"), py::arg("noise"),
          py::arg("dynamics"), py::arg("bounds"), py::arg("detection"), py::arg("pattern"),
          py::arg("appearance"), py::arg("factors"), py::arg("flat"), docs::rank_filter);
    m.def("reweight", reweight_arrays, py::arg("log_likelihood"), py::arg("proposed"), py::arg("previous"),
          py::arg("dynamics"), py::arg("detection"), docs::reweight);
    m.def("summarize", summarize_arrays, py::arg("particles"), py::arg("weights"), docs::summarize);
}

}  // namespace tricue::bindings
