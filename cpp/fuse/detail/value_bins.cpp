// SPDX-License-Identifier: MIT
#include "fuse/detail/value_bins.hpp"

#include <cmath>
#include <string>

#include "base/check.hpp"
#include "base/depth_pixels.hpp"
#include "base/overlapping_blocks.hpp"
#include "base/simd.hpp"

namespace tricue {

FloatRange::FloatRange(const ValueRange& range)
    : least(round_up_to_float(range.low)),
      end(round_up_to_float(range.high)),
      low(static_cast<float>(range.low)),
      scale(static_cast<float>(range.bins / (range.high - range.low))),
      top(static_cast<float>(range.bins - 1)),
      none(range.bins) {}

TRICUE_MULTIVERSION
void find_value_bins(const float* __restrict values, int n, const FloatRange& range,
                     std::int32_t* __restrict bin) {
    const FloatRange bins = range;
    for_overlapping_blocks<16>(n, [=](std::ptrdiff_t x) { bin[x] = value_bin(values[x], bins); });
}

void require_range(const ValueRange& range) {
    if (!std::isfinite(range.low)) refuse("low", "a finite number", range.low);
    if (!(std::isfinite(range.high) && range.high > range.low))
        refuse("high", "a finite number above low", range.high);
    if (range.bins < 1 || range.bins > 65536) refuse("bins", "1 to 65536", std::to_string(range.bins));
}

}  // namespace tricue
