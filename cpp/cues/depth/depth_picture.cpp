// SPDX-License-Identifier: MIT
#include "cues/depth/depth_picture.hpp"

#include <cmath>
#include <vector>

#include "base/check.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

/// Gray levels of one row. The order of the operations is that of the twin, so that both have the same bits.
TRICUE_MULTIVERSION
void find_levels(const float* __restrict depth, int n, float z, float low, float high, float per_meter,
                 std::uint8_t* __restrict levels) {
    for (int x = 0; x < n; ++x) {
        const float near = depth[x] <= high ? depth[x] : high;  // what is NaN becomes white
        const float inside = near >= low ? near : low;
        levels[x] = static_cast<std::uint8_t>(static_cast<int>((inside - z) * per_meter + 128.0F));
    }
}

TRICUE_MULTIVERSION
void write_gray(const std::uint8_t* __restrict levels, int n, std::uint8_t* __restrict pixels) {
    for (int x = 0; x < n; ++x)
        for (int channel = 0; channel < 3; ++channel) pixels[3 * x + channel] = levels[x];
}

}  // namespace

PictureBytes depth_picture(const DepthView& depth, double z, double reach) {
    if (!std::isfinite(z)) refuse("z", "a finite number", z);
    if (!(reach > 0.0 && std::isfinite(reach))) refuse("reach", "a finite number above 0", reach);
    PictureBytes picture(Eigen::Index{3} * depth.rows * depth.cols);
    std::vector<std::uint8_t> levels(static_cast<std::size_t>(depth.cols));
    for (int y = 0; y < depth.rows; ++y) {
        find_levels(depth.row(y), depth.cols, static_cast<float>(z), static_cast<float>(z - reach),
                    static_cast<float>(z + reach), static_cast<float>(127 / reach), levels.data());
        write_gray(levels.data(), depth.cols, picture.data() + Eigen::Index{3} * y * depth.cols);
    }
    return picture;
}

}  // namespace tricue
