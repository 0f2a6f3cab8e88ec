// SPDX-License-Identifier: MIT
#include "cues/depth/depth_histogram.hpp"

#include <cmath>
#include <cstdint>
#include <vector>

#include "base/check.hpp"
#include "base/depth_pixels.hpp"
#include "base/marked_words.hpp"
#include "base/overlapping_blocks.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

// Neighbors mostly share a level, and reading a count that was just written is slow, so neighbors are counted in
// different tables.
constexpr std::size_t kTables = 4;

/// Whether each pixel of a row is counted, and its level; `levels.count` for pixels that aren't.
TRICUE_MULTIVERSION
void find_levels(const float* __restrict depth, const std::uint8_t* __restrict mask, int n,
                 const DepthLevels& levels, std::uint8_t* __restrict counted,
                 std::int32_t* __restrict level) {
    const float least = round_up_to_float(levels.near), end = round_up_to_float(levels.far);
    const auto near = static_cast<float>(levels.near);
    const auto scale = static_cast<float>(levels.count / (levels.far - levels.near));
    const auto top = static_cast<float>(levels.count - 1);
    const std::int32_t none = levels.count;
    for_overlapping_blocks(n, [=](std::ptrdiff_t x) {
        const float z = depth[x], place = (z - near) * scale;
        const bool counts = has_depth(z) & (mask[x] != 0) & (z >= least) & (z < end);
        const float within = counts & (place < top) ? place : top;
        level[x] = counts ? static_cast<std::int32_t>(within) : none;
        counted[x] = counts;
    });
}

}  // namespace

void require_levels(const DepthLevels& levels) {
    if (!std::isfinite(levels.near)) refuse("near", "a finite number", levels.near);
    if (!(std::isfinite(levels.far) && levels.far > levels.near))
        refuse("far", "a finite number above near", levels.far);
    if (levels.count < 1 || levels.count > 65536)
        refuse("levels", "1 to 65536", std::to_string(levels.count));
}

Vector depth_histogram(const DepthView& depth, const ImageView& mask, const DepthLevels& levels) {
    require_same_shape(mask, depth, "mask");
    require_levels(levels);
    const auto bins = static_cast<std::size_t>(levels.count) + 1;
    std::vector<std::int64_t> counts(kTables * bins);
    std::vector<std::int32_t> level(whole_words(depth.cols), levels.count);
    std::vector<std::uint8_t> counted(level.size());
    for (int y = 0; y < depth.rows; ++y) {
        find_levels(depth.row(y), mask.row(y), depth.cols, levels, counted.data(), level.data());
        // Most pixels of a segmented image are not counted.
        for_marked_words(counted, [&](std::size_t x) {
            ++counts[(x % kTables) * bins + static_cast<std::size_t>(level[x])];
        });
    }
    Vector histogram = Vector::Zero(levels.count);
    for (std::size_t t = 0; t < kTables; ++t)
        for (Eigen::Index i = 0; i < histogram.size(); ++i)
            histogram[i] += static_cast<double>(counts[t * bins + static_cast<std::size_t>(i)]);
    return histogram;
}

}  // namespace tricue
