// SPDX-License-Identifier: MIT
#include <pybind11/stl.h>

#include <limits>
#include <optional>

#include "arrays.hpp"
#include "fuse/block_counts.hpp"
#include "fuse/block_mask.hpp"
#include "fuse/block_votes.hpp"
#include "fuse/combine_posteriors.hpp"
#include "fuse/observe_target.hpp"
#include "fuse/target_distribution.hpp"
#include "fuse/target_model.hpp"
#include "fuse/target_outline.hpp"
#include "fuse/target_pixels.hpp"
#include "fuse/temporal_window.hpp"
#include "fuse/weighted_histogram.hpp"
#include "kernel_docs.hpp"
#include "tuples.hpp"

namespace tricue::bindings {
namespace {

using Corners = Tuple<double, double, double, double>;
using Bytes = Array<std::uint8_t>;

PlaneView plane(const py::object& object, const char* name) {
    return plane_view(object, name, "a float32 plane (H, W)");
}

ImageView mask_view(const py::object& object, const char* name) {
    return byte_image(object, name, "a uint8 mask (H, W)");
}

Rectangle rectangle(const Corners& corners, const char* name) {
    return unpack_as<Rectangle>(corners, name);
}

Array<float> combine_posteriors_arrays(const Array<float>& first, const Array<float>& second) {
    const auto p = plane(first, "first"), q = plane(second, "second");
    return give(unlocked(pixels(p), [&] { return combine_posteriors(p, q); }));
}

Array<double> weighted_histogram_arrays(const Array<float>& values, const Array<float>& weights,
                                        const Corners& region, double low, double high, int bins,
                                        const std::optional<Bytes>& mask) {
    const auto observed = plane(values, "values"), reliability = plane(weights, "weights");
    const ImageView counted = mask ? mask_view(*mask, "mask") : ImageView{nullptr, 0, 0, 1, 0};
    const Rectangle part = rectangle(region, "region");
    return give(unlocked(pixels(observed), [&] {
        return weighted_histogram(observed, reliability, part, {low, high, bins}, counted);
    }));
}

std::tuple<Array<double>, double> target_distribution_arrays(const Array<double>& histogram, double smoothing,
                                                             double min_prominence, double expected,
                                                             double spread) {
    const auto weights = vector(histogram, "histogram");
    auto found = unlocked(weights.size(), [&] {
        return target_distribution(weights, smoothing, min_prominence, expected, spread);
    });
    return {give(std::move(found.density)), found.peak};
}

using Densities = std::vector<Array<double>>;

std::vector<Cue> cues(const std::vector<Array<float>>& planes, const Densities& densities,
                      const std::vector<std::pair<double, double>>& ranges,
                      const std::optional<Densities>& alternatives) {
    const auto as_many = [&](std::size_t count, const char* name) {
        if (count != planes.size())
            throw py::value_error(std::string(name) + ": expected " + std::to_string(planes.size()) +
                                  ", as many as planes, got " + std::to_string(count));
    };
    as_many(densities.size(), "densities");
    as_many(ranges.size(), "ranges");
    if (alternatives) as_many(alternatives->size(), "alternatives");
    std::vector<Cue> cues;
    for (std::size_t k = 0; k < planes.size(); ++k)
        cues.push_back({plane(planes[k], "planes"), vector(densities[k], "densities"), ranges[k].first,
                        ranges[k].second});
    for (std::size_t k = 0; alternatives && k < planes.size(); ++k)
        cues[k].alternative.emplace(vector((*alternatives)[k], "alternatives"));
    return cues;
}

std::tuple<Bytes, Array<float>> target_pixels_arrays(const std::vector<Array<float>>& planes,
                                                     const Densities& densities,
                                                     const std::vector<std::pair<double, double>>& ranges,
                                                     const Corners& window, const Corners& candidate,
                                                     double threshold,
                                                     const std::optional<Densities>& alternatives) {
    const auto each = cues(planes, densities, ranges, alternatives);
    const TargetPrior prior{rectangle(window, "window"), rectangle(candidate, "candidate")};
    const auto work = each.empty() ? 0 : pixels(each[0].values);
    auto target = unlocked(work, [&] { return target_pixels(each, prior, threshold); });
    return {give(std::move(target.mask)), give(std::move(target.posterior))};
}

std::tuple<RegionTuple, std::int64_t, Bytes> temporal_window_arrays(const Bytes& mask, int neighbors,
                                                                    double share, double trim) {
    const auto set = mask_view(mask, "mask");
    auto window = unlocked(std::ptrdiff_t{set.rows} * set.cols,
                           [&] { return temporal_window(set, neighbors, share, trim); });
    return {tuple_of(window.box), window.count, give(std::move(window.mask))};
}

using Counts = Array<std::int64_t>;

std::tuple<Counts, Counts, Counts, Array<double>, Counts> block_counts_arrays(const Bytes& mask,
                                                                              const Array<float>& disparity,
                                                                              const Array<double>& blocks,
                                                                              double expected,
                                                                              double tolerance) {
    const auto set = mask_view(mask, "mask");
    const auto distances = plane(disparity, "disparity");
    const auto each = states(blocks, "blocks");
    auto seen = unlocked(pixels(distances), [&] {
        return block_counts(set, distances, each, static_cast<float>(expected),
                            static_cast<float>(tolerance));
    });
    return {give(std::move(seen.pixels)), give(std::move(seen.targets)), give(std::move(seen.measured)),
            give(std::move(seen.mean)), give(std::move(seen.similar))};
}

template <typename Scalar>
Eigen::Map<const Eigen::Array<Scalar, Eigen::Dynamic, 1>> list(const Array<Scalar>& numbers, const char* name,
                                                               const char* expected) {
    const auto array = require<Scalar>(numbers, name, 1, expected);
    return {contiguous<Scalar>(array, name), array.shape(0)};
}

Eigen::Map<const Indices> counts(const Counts& numbers, const char* name) {
    return list<std::int64_t>(numbers, name, "int64 (N,)");
}

using VotesTuple = Tuple<Counts, Counts, Counts, Array<bool>, Counts, Counts>;
using CountsTuple = Tuple<Counts, Counts, Counts, Array<double>, Counts>;
using DisparityLimitsTuple = Tuple<double, double, double>;
using RulesTuple = Tuple<double, std::int64_t, std::int64_t, std::int64_t, std::int64_t>;

BlockVotes votes_of(const VotesTuple& blocks) {
    const auto [states, votes, against, core, trusted, without_pixels] = unpack(blocks, "blocks");
    return {counts(states, "states"),   counts(votes, "votes"),
            counts(against, "against"), list<bool>(core, "core", "bool (N,)"),
            counts(trusted, "trusted"), counts(without_pixels, "without_pixels")};
}

BlockCounts counts_of(const CountsTuple& seen) {
    const auto [pixels, targets, measured, mean, similar] = unpack(seen, "seen");
    return {counts(pixels, "pixels"), counts(targets, "targets"), counts(measured, "measured"),
            vector(mean, "mean"), counts(similar, "similar")};
}

std::tuple<Counts, Counts, Counts, Array<bool>, Counts, Counts> block_votes_arrays(
    const VotesTuple& blocks, const CountsTuple& seen, const DisparityLimitsTuple& limits,
    const RulesTuple& rules) {
    const BlockVotes before = votes_of(blocks);
    const BlockCounts observed = counts_of(seen);
    const auto disparities = unpack_as<DisparityLimits>(limits, "limits");
    const auto needed = unpack_as<VoteRules>(rules, "rules");
    auto after =
        unlocked(before.states.size(), [&] { return block_votes(before, observed, disparities, needed); });
    return {give(std::move(after.states)),  give(std::move(after.votes)),
            give(std::move(after.against)), give(std::move(after.core)),
            give(std::move(after.trusted)), give(std::move(after.without_pixels))};
}

using BlockGridTuple = Tuple<Array<double>, Tuple<double, double, double, double, double>>;

BlockGrid block_grid(const BlockGridTuple& grid) {
    const auto [corners, place] = unpack(grid, "grid");
    return {states(corners, "corners"), unpack_as<GridPlace>(place, "place")};
}

using CueMapTuple = Tuple<Array<float>, Array<float>>;
using PeakTuple = Tuple<double, double, double>;
using BlocksTuple = Tuple<BlockGridTuple, Counts, Counts>;
using FormerTuple = Tuple<Array<double>, std::vector<double>, std::vector<double>>;

std::optional<FormerModel> former_model(const std::optional<FormerTuple>& before) {
    if (!before) return {};
    const auto [densities, lows, peaks] = unpack(*before, "before");
    return FormerModel{states(densities, "before"), lows, peaks};
}

std::optional<TargetBlocks> target_blocks(const std::optional<BlocksTuple>& blocks) {
    if (!blocks) return {};
    const auto [grid, of_blocks, trusted] = unpack(*blocks, "blocks");
    return TargetBlocks{block_grid(grid), counts(of_blocks, "states"), counts(trusted, "trusted")};
}

std::tuple<Array<double>, Array<double>, Array<double>> target_model_arrays(
    const std::vector<CueMapTuple>& maps, const std::vector<PeakTuple>& expected, const Corners& window,
    const std::optional<BlocksTuple>& blocks, const std::optional<Tuple<double, double>>& depth,
    const std::optional<FormerTuple>& before, const Tuple<int, double, double, double, double>& rules) {
    std::vector<CueMap> each;
    std::vector<ExpectedPeak> at;
    for (const CueMapTuple& map : maps) {
        const auto [values, weights] = unpack(map, "maps");
        each.push_back({plane(values, "maps"), plane(weights, "maps")});
    }
    for (const PeakTuple& peak : expected) at.push_back(unpack_as<ExpectedPeak>(peak, "expected"));
    const Rectangle place = rectangle(window, "window");
    const auto mine = target_blocks(blocks);
    const auto former = former_model(before);
    std::optional<DepthLimit> limit;
    if (depth) limit = unpack_as<DepthLimit>(*depth, "depth");
    const auto how = unpack_as<HistogramRules>(rules, "rules");
    const auto work = each.empty() ? 0 : pixels(each[0].values);
    auto model = unlocked(work, [&] { return target_model(each, at, place, mine, limit, former, how); });
    return {give(std::move(model.densities)), give(std::move(model.alternatives)),
            give(std::move(model.peaks))};
}

using Seen = std::tuple<Counts, Counts, Counts, Array<double>, Counts>;

using DensitiesTuple = Tuple<Array<double>, std::vector<Tuple<double, double>>, Array<double>>;

CueDensities cue_densities(const DensitiesTuple& model) {
    const auto [densities, ranges, alternatives] = unpack(model, "model");
    std::vector<BinRange> bins;
    for (const auto& range : ranges) bins.push_back(unpack_as<BinRange>(range, "ranges"));
    return {states(densities, "densities"), bins, states(alternatives, "alternatives")};
}

TargetPrior target_prior(const Tuple<Corners, Corners>& prior) {
    const auto [window, candidate] = unpack(prior, "prior");
    return {rectangle(window, "window"), rectangle(candidate, "candidate")};
}

std::tuple<RegionTuple, std::int64_t, Bytes, Seen, double> observe_target_arrays(
    const std::vector<Array<float>>& planes, const DensitiesTuple& model,
    const Tuple<Corners, Corners>& prior, double threshold, const Tuple<int, double, double>& clean,
    const std::optional<Array<float>>& disparity, const BlockGridTuple& grid, const Counts& of_blocks,
    const DisparityLimitsTuple& limits) {
    std::vector<PlaneView> each;
    for (const auto& values : planes) each.push_back(plane(values, "planes"));
    const CueDensities densities = cue_densities(model);
    const TargetPrior place = target_prior(prior);
    const auto kept_pixels = unpack_as<CleanUp>(clean, "clean");
    std::optional<PlaneView> distances;
    if (disparity) distances = plane(*disparity, "disparity");
    const BlockGrid blocks = block_grid(grid);
    const auto numbers = counts(of_blocks, "states");
    const auto disparities = unpack_as<DisparityLimits>(limits, "limits");
    auto found = unlocked(each.empty() ? 0 : pixels(each[0]), [&] {
        return observe_target(each, densities, place, threshold, kept_pixels, distances, blocks, numbers,
                              disparities);
    });
    auto& [kept, observed, occluded] = found;
    return {tuple_of(kept.box), kept.count, give(std::move(kept.mask)),
            Seen{give(std::move(observed.pixels)), give(std::move(observed.targets)),
                 give(std::move(observed.measured)), give(std::move(observed.mean)),
                 give(std::move(observed.similar))},
            occluded};
}

std::tuple<RegionTuple, std::int64_t> target_outline_numbers(const Bytes& mask, const Array<float>& disparity,
                                                             const BlockGridTuple& grid,
                                                             const Counts& of_blocks, double target,
                                                             double tolerance) {
    const auto set = mask_view(mask, "mask");
    const auto distances = plane(disparity, "disparity");
    const BlockGrid blocks = block_grid(grid);
    const auto numbers = counts(of_blocks, "states");
    const auto found = unlocked(pixels(distances), [&] {
        return target_outline(set, distances, blocks, numbers, static_cast<float>(target),
                              static_cast<float>(tolerance));
    });
    return {tuple_of(found.box), found.count};
}

Bytes block_mask_array(const Array<double>& blocks, int height, int width) {
    const auto each = states(blocks, "blocks");
    return give(unlocked(work_of(height, width), [&] { return block_mask(each, height, width); }));
}

}  // namespace

void define_bayes(py::module_& m) {
    m.def("block_counts", block_counts_arrays, py::arg("mask"), py::arg("disparity"), py::arg("blocks"),
          py::arg("expected") = std::numeric_limits<double>::quiet_NaN(), py::arg("tolerance") = 0.0,
          docs::block_counts);
    m.def("block_votes", block_votes_arrays, py::arg("blocks"), py::arg("seen"), py::arg("limits"),
          py::arg("rules"), docs::block_votes);
    m.def("block_mask", block_mask_array, py::arg("blocks"), py::arg("height"), py::arg("width"),
          docs::block_mask);
    m.def("combine_posteriors", combine_posteriors_arrays, py::arg("first"), py::arg("second"),
          docs::combine_posteriors);
    m.def("target_distribution", target_distribution_arrays, py::arg("histogram"), py::arg("smoothing"),
          py::arg("min_prominence") = 0.05, py::arg("expected") = std::numeric_limits<double>::quiet_NaN(),
          py::arg("spread") = 1.0, docs::target_distribution);
    m.def("target_pixels", target_pixels_arrays, py::arg("planes"), py::arg("densities"), py::arg("ranges"),
          py::arg("window"), py::arg("candidate"), py::arg("threshold") = 0.5,
          py::arg("alternatives") = py::none(), docs::target_pixels);
    m.def("temporal_window", temporal_window_arrays, py::arg("mask"), py::arg("neighbors"), py::arg("share"),
          py::arg("trim") = 0.02, docs::temporal_window);
    m.def("observe_target", observe_target_arrays, py::arg("planes"), py::arg("model"), py::arg("prior"),
          py::arg("threshold"), py::arg("clean"), py::arg("disparity"), py::arg("grid"), py::arg("states"),
          py::arg("limits"), docs::observe_target);
    m.def("target_model", target_model_arrays, py::arg("maps"), py::arg("expected"), py::arg("window"),
          py::arg("blocks"), py::arg("depth"), py::arg("before"), py::arg("rules"), docs::target_model);
    m.def("target_outline", target_outline_numbers, py::arg("mask"), py::arg("disparity"), py::arg("grid"),
          py::arg("states"), py::arg("target"), py::arg("tolerance"), docs::target_outline);
    m.def("weighted_histogram", weighted_histogram_arrays, py::arg("values"), py::arg("weights"),
          py::arg("region"), py::arg("low"), py::arg("high"), py::arg("bins"), py::arg("mask") = py::none(),
          docs::weighted_histogram);
}

}  // namespace tricue::bindings
