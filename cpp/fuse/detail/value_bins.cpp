// SPDX-License-Identifier: MIT
#include "fuse/detail/value_bins.hpp"

#include <cmath>
#include <string>

#include "base/check.hpp"
#include "base/depth_pixels.hpp"
#include "base/overlapping_blocks.hpp"
#include "base/simd.hpp"

namespace tricue {

TRICUE_MULTIVERSION
void find_value_bins(const float* __restrict values, int n, const ValueRange& range,
                     std::int32_t* __restrict bin) {
    const float least = round_up_to_float(range.low), end = round_up_to_float(range.high);
    const auto low = static_cast<float>(range.low);
    const auto scale = static_cast<float>(range.bins / (range.high - range.low));
    const auto top = static_cast<float>(range.bins - 1);
    const std::int32_t none = range.bins;
    for_overlapping_blocks<16>(n, [=](std::ptrdiff_t x) {
        const float value = values[x], place = (value - low) * scale;
        const bool counts = (value >= least) & (value < end);
        const float within = counts & (place < top) ? place : top;
        bin[x] = counts ? static_cast<std::int32_t>(within) : none;
    });
}

void require_range(const ValueRange& range) {
    if (!std::isfinite(range.low)) refuse("low", "a finite number", range.low);
    if (!(std::isfinite(range.high) && range.high > range.low))
        refuse("high", "a finite number above low", range.high);
    if (range.bins < 1 || range.bins > 65536) refuse("bins", "1 to 65536", std::to_string(range.bins));
}

}  // namespace tricue
