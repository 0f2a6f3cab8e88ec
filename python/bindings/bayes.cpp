// SPDX-License-Identifier: MIT
#include <pybind11/stl.h>

#include <limits>
#include <optional>

#include "arrays.hpp"
#include "base/check.hpp"
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

namespace tricue::bindings {
namespace {

using Corners = std::tuple<double, double, double, double>;
using Bytes = Array<std::uint8_t>;

PlaneView plane(const py::object& object, const char* name) {
    return plane_view(object, name, "a float32 plane (H, W)");
}

ImageView mask_view(const py::object& object, const char* name) {
    return byte_image(object, name, "a uint8 mask (H, W)");
}

Rectangle rectangle(const Corners& corners) {
    const auto [x0, y0, x1, y1] = corners;
    return {x0, y0, x1, y1};
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
    const Rectangle part = rectangle(region);
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
    const TargetPlace place{rectangle(window), rectangle(candidate)};
    const auto work = each.empty() ? 0 : pixels(each[0].values);
    auto target = unlocked(work, [&] { return target_pixels(each, place, threshold); });
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

std::tuple<Counts, Counts, Counts, Array<bool>, Counts, Counts> block_votes_arrays(
    const Counts& states, const Counts& votes, const Counts& against, const Array<bool>& core,
    const Counts& trusted, const Counts& without_pixels, const Counts& pixels, const Counts& targets,
    const Counts& measured, const Array<double>& mean, const Counts& similar,
    const std::tuple<double, double, double>& disparities, double min_share,
    const std::tuple<std::int64_t, std::int64_t, std::int64_t, std::int64_t>& frames) {
    const auto counts = [](const Counts& numbers, const char* name) {
        return list<std::int64_t>(numbers, name, "int64 (N,)");
    };
    const BlockVotes blocks{counts(states, "states"),   counts(votes, "votes"),
                            counts(against, "against"), list<bool>(core, "core", "bool (N,)"),
                            counts(trusted, "trusted"), counts(without_pixels, "without_pixels")};
    const BlockCounts seen{counts(pixels, "pixels"), counts(targets, "targets"), counts(measured, "measured"),
                           vector(mean, "mean"), counts(similar, "similar")};
    const auto [target, tolerance, occluder] = disparities;
    const auto [to_add, to_remove, to_release, max_without_pixels] = frames;
    const VoteRules rules{target, tolerance, occluder,   min_share,
                          to_add, to_remove, to_release, max_without_pixels};
    auto after = unlocked(blocks.states.size(), [&] { return block_votes(blocks, seen, rules); });
    return {give(std::move(after.states)),  give(std::move(after.votes)),
            give(std::move(after.against)), give(std::move(after.core)),
            give(std::move(after.trusted)), give(std::move(after.without_pixels))};
}

using Place = std::tuple<double, double, double, double, double>;

BlockGrid grid_of(const Array<double>& corners, const Place& place) {
    const auto [size, x, y, left, top] = place;
    return {states(corners, "corners"), {size, x, y, left, top}};
}

using Maps = std::vector<std::pair<Array<float>, Array<float>>>;
using Peaks = std::vector<std::tuple<double, double, double>>;
using Blocks = std::tuple<Array<double>, Place, Counts, Counts>;
using Former = std::tuple<Array<double>, std::vector<double>, std::vector<double>>;

std::optional<FormerModel> former_model(const std::optional<Former>& before) {
    if (!before) return {};
    const auto& [densities, lows, peaks] = *before;
    return FormerModel{states(densities, "before"), lows, peaks};
}

std::optional<TargetBlocks> target_blocks(const std::optional<Blocks>& blocks) {
    if (!blocks) return {};
    const auto& [corners, place, of_blocks, trusted] = *blocks;
    return TargetBlocks{grid_of(corners, place), list<std::int64_t>(of_blocks, "states", "int64 (N,)"),
                        list<std::int64_t>(trusted, "trusted", "int64 (N,)")};
}

std::tuple<Array<double>, Array<double>, Array<double>> target_model_arrays(
    const Maps& maps, const Peaks& expected, const Corners& window, const std::optional<Blocks>& blocks,
    const std::optional<std::pair<double, double>>& depth, const std::optional<Former>& before,
    const std::tuple<int, double, double, double, double>& rules) {
    std::vector<CueMap> each;
    std::vector<ExpectedPeak> at;
    for (const auto& [values, weights] : maps)
        each.push_back({plane(values, "maps"), plane(weights, "maps")});
    for (const auto& [value, deviation, half_range] : expected) at.push_back({value, deviation, half_range});
    const auto mine = target_blocks(blocks);
    const auto former = former_model(before);
    std::optional<DepthLimit> limit;
    if (depth) limit = {depth->first, depth->second};
    const auto [bins, smoothing, min_prominence, density_memory, surround_weight] = rules;
    const HistogramRules how{bins, smoothing, min_prominence, density_memory, surround_weight};
    const auto work = each.empty() ? 0 : pixels(each[0].values);
    auto model =
        unlocked(work, [&] { return target_model(each, at, rectangle(window), mine, limit, former, how); });
    return {give(std::move(model.densities)), give(std::move(model.alternatives)),
            give(std::move(model.peaks))};
}

using Seen = std::tuple<Counts, Counts, Counts, Array<double>, Counts>;

std::tuple<RegionTuple, std::int64_t, Bytes, Seen, double> observe_target_arrays(
    const std::vector<Array<float>>& planes, const Array<double>& densities,
    const std::vector<std::pair<double, double>>& ranges, const Array<double>& alternatives,
    const Corners& window, const Corners& candidate, double threshold,
    const std::tuple<int, double, double>& clean, const std::optional<Array<float>>& disparity,
    const Array<double>& corners, const Place& place, const Counts& of_blocks,
    const std::tuple<double, double, double>& limits) {
    const auto target = states(densities, "densities"), others = states(alternatives, "alternatives");
    const auto count = static_cast<Eigen::Index>(planes.size());
    require_shape(target, count, target.cols(), "densities");
    require_shape(others, count, target.cols(), "alternatives");
    if (ranges.size() != planes.size()) refuse("ranges", "as many as planes", std::to_string(ranges.size()));
    std::vector<Cue> cues;
    for (Eigen::Index i = 0; i < count; ++i) {
        const auto k = static_cast<std::size_t>(i);
        const auto row = [&](const auto& all) {
            return Eigen::Map<const Vector>(all.data() + i * all.cols(), all.cols());
        };
        cues.push_back(
            {plane(planes[k], "planes"), row(target), ranges[k].first, ranges[k].second, row(others)});
    }
    std::optional<PlaneView> distances;
    if (disparity) distances = plane(*disparity, "disparity");
    const BlockGrid grid = grid_of(corners, place);
    const auto numbers = list<std::int64_t>(of_blocks, "states", "int64 (N,)");
    const auto [neighbors, share, trim] = clean;
    const auto [similar, tolerance, occluder] = limits;
    auto found = unlocked(cues.empty() ? 0 : pixels(cues[0].values),
                          [&, neighbors = neighbors, share = share, trim = trim, similar = similar,
                           tolerance = tolerance, occluder = occluder] {
                              return observe_target(cues, {rectangle(window), rectangle(candidate)},
                                                    threshold, {neighbors, share, trim}, distances, grid,
                                                    numbers, {similar, tolerance, occluder});
                          });
    auto& [kept, counts, occluded] = found;
    return {
        tuple_of(kept.box), kept.count, give(std::move(kept.mask)),
        Seen{give(std::move(counts.pixels)), give(std::move(counts.targets)),
             give(std::move(counts.measured)), give(std::move(counts.mean)), give(std::move(counts.similar))},
        occluded};
}

std::tuple<RegionTuple, std::int64_t> target_outline_numbers(const Bytes& mask, const Array<float>& disparity,
                                                             const Array<double>& corners, const Place& place,
                                                             const Counts& of_blocks, double target,
                                                             double tolerance) {
    const auto set = mask_view(mask, "mask");
    const auto distances = plane(disparity, "disparity");
    const BlockGrid grid = grid_of(corners, place);
    const auto numbers = list<std::int64_t>(of_blocks, "states", "int64 (N,)");
    const auto found = unlocked(pixels(distances), [&] {
        return target_outline(set, distances, grid, numbers, static_cast<float>(target),
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
    m.def("block_votes", block_votes_arrays, py::arg("states"), py::arg("votes"), py::arg("against"),
          py::arg("core"), py::arg("trusted"), py::arg("without_pixels"), py::arg("pixels"),
          py::arg("targets"), py::arg("measured"), py::arg("mean"), py::arg("similar"),
          py::arg("disparities"), py::arg("min_share"), py::arg("frames"), docs::block_votes);
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
    m.def("observe_target", observe_target_arrays, py::arg("planes"), py::arg("densities"), py::arg("ranges"),
          py::arg("alternatives"), py::arg("window"), py::arg("candidate"), py::arg("threshold"),
          py::arg("clean"), py::arg("disparity"), py::arg("corners"), py::arg("place"), py::arg("states"),
          py::arg("limits"), docs::observe_target);
    m.def("target_model", target_model_arrays, py::arg("maps"), py::arg("expected"), py::arg("window"),
          py::arg("blocks"), py::arg("depth"), py::arg("before"), py::arg("rules"), docs::target_model);
    m.def("target_outline", target_outline_numbers, py::arg("mask"), py::arg("disparity"), py::arg("corners"),
          py::arg("place"), py::arg("states"), py::arg("target"), py::arg("tolerance"), docs::target_outline);
    m.def("weighted_histogram", weighted_histogram_arrays, py::arg("values"), py::arg("weights"),
          py::arg("region"), py::arg("low"), py::arg("high"), py::arg("bins"), py::arg("mask") = py::none(),
          docs::weighted_histogram);
}

}  // namespace tricue::bindings
