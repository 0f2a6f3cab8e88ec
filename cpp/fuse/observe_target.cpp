// SPDX-License-Identifier: MIT
#include "fuse/observe_target.hpp"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include "base/check.hpp"
#include "fuse/detail/count_blocks.hpp"

namespace tricue {
namespace {

/// The share of the target's blocks in the image whose mean disparity is above the occluder's.
double occluded_share(const BlockCounts& counts, BlockNumbers states, double occluder) {
    std::int64_t mine = 0, hidden = 0;
    for (Eigen::Index i = 0; i < states.size(); ++i) {
        const auto pixels = static_cast<double>(counts.pixels[i]);
        const bool here = (states[i] != 0) & (counts.pixels[i] > 0);
        const bool has_mean = static_cast<double>(counts.measured[i]) >= kMinMeasuredShare * pixels;
        mine += here;
        hidden += here & has_mean & (counts.mean[i] > occluder);
    }
    return static_cast<double>(hidden) / static_cast<double>(std::max(mine, std::int64_t{1}));
}

/// The observations with their densities, row by row.
std::vector<Cue> cues_of(const std::vector<PlaneView>& planes, const CueDensities& model) {
    const auto count = static_cast<Eigen::Index>(planes.size());
    require_shape(model.densities, count, model.densities.cols(), "densities");
    require_shape(model.alternatives, count, model.densities.cols(), "alternatives");
    if (model.ranges.size() != planes.size())
        refuse("ranges", "as many as planes", std::to_string(model.ranges.size()));
    const auto row = [](const StatesRef& all, Eigen::Index i) {
        return Eigen::Map<const Vector>(all.data() + i * all.cols(), all.cols());
    };
    std::vector<Cue> cues;
    for (Eigen::Index i = 0; i < count; ++i) {
        const auto k = static_cast<std::size_t>(i);
        const auto [low, high] = model.ranges[k];
        cues.push_back({planes[k], row(model.densities, i), low, high, row(model.alternatives, i)});
    }
    return cues;
}

}  // namespace

TargetObservation observe_target(const std::vector<PlaneView>& planes, const CueDensities& model,
                                 const TargetPrior& prior, double threshold, const CleanUp& clean,
                                 const std::optional<PlaneView>& disparity, const BlockGrid& grid,
                                 BlockNumbers states, const DisparityLimits& limits) {
    require_numbers(grid, states, "states");
    const Labels found = target_pixels(cues_of(planes, model), prior, threshold).mask;
    const auto rows = static_cast<int>(found.rows()), cols = static_cast<int>(found.cols());
    const auto view = [=](const Labels& mask) { return ImageView{mask.data(), rows, cols, 1, cols}; };
    TemporalWindow window = temporal_window(view(found), clean.neighbors, clean.share, clean.trim);
    const Floats none = Floats::Constant(disparity ? 0 : rows, cols, std::numeric_limits<float>::quiet_NaN());
    const PlaneView disparities = disparity.value_or(PlaneView{none.data(), rows, cols, cols});
    require_shape(disparities.rows, disparities.cols, rows, cols, "disparity");
    BlockCounts counts =
        count_blocks(view(window.mask), disparities, block_pixels(grid, rows, cols),
                     static_cast<float>(limits.target), static_cast<float>(limits.tolerance));
    if (!disparity) counts.measured = counts.pixels;
    const double share = occluded_share(counts, states, limits.occluder);
    return {std::move(window), std::move(counts), share};
}

}  // namespace tricue
