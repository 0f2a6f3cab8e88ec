// SPDX-License-Identifier: MIT
#include "cues/stereo/detail/gray_plane.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "base/simd.hpp"

namespace tricue {
namespace {

/// 8 times the weighted mean of four rows, weights 1, 3, 3, 1.
template <typename Pixel>
TRICUE_INLINE void smooth(const std::array<const Pixel*, 4>& rows, int n, float* __restrict out) {
    const Pixel* __restrict above = rows[0];
    const Pixel* __restrict upper = rows[1];
    const Pixel* __restrict lower = rows[2];
    const Pixel* __restrict below = rows[3];
    for (int x = 0; x < n; ++x)
        out[x] = static_cast<float>((above[x] + below[x]) + 3 * (upper[x] + lower[x]));
}

TRICUE_MULTIVERSION
void smooth_floats(const std::array<const float*, 4>& rows, int n, float* out) {
    smooth(rows, n, out);
}

TRICUE_MULTIVERSION
void smooth_bytes(const std::array<const std::uint8_t*, 4>& rows, int n, float* out) {
    smooth(rows, n, out);
}

/// The same along a row, for every second pixel from in[1] on. Normalizes both.
TRICUE_MULTIVERSION
void smooth_pairs(const float* __restrict in, int n, float* __restrict out) {
    constexpr float kShare = 1.0F / 64.0F;
    for (int i = 0; i < n; ++i)
        out[i] = kShare * ((in[2 * i] + in[2 * i + 3]) + 3.0F * (in[2 * i + 1] + in[2 * i + 2]));
}

}  // namespace

GrayPlane::GrayPlane(const Region& part, int rows, int cols)
    : part_(part),
      rows_(rows),
      cols_(cols),
      pixels_(new float[static_cast<std::size_t>(part.x1 - part.x0) *
                            static_cast<std::size_t>(part.y1 - part.y0) +
                        kRowLine]) {}

Region downsample_source(const Region& part, int rows, int cols) {
    return {std::max(2 * part.x0 - 1, 0), std::max(2 * part.y0 - 1, 0), std::min(2 * part.x1 + 1, cols),
            std::min(2 * part.y1 + 1, rows)};
}

GrayPlane downsampled(const GrayLevel& level, const Region& part) {
    const int rows = level.rows(), cols = level.cols();
    GrayPlane half(part, (rows + 1) / 2, (cols + 1) / 2);
    const Region from = downsample_source(part, rows, cols);
    const int first = 2 * part.x0 - 1, last = 2 * part.x1 + 1;  // columns, possibly beyond the border
    std::vector<float> smooth(static_cast<std::size_t>(last - first) + 2 * kRowLine);
    float* inside = smooth.data() + (from.x0 - first);
    const int n = from.x1 - from.x0;
    for (int y = part.y0; y < part.y1; ++y) {
        const auto four = [&](const auto& picture) {
            const auto pixels = [&](int k) {
                return picture.row(std::clamp(2 * y + k, 0, rows - 1)) + from.x0;
            };
            return std::array{pixels(-1), pixels(0), pixels(1), pixels(2)};
        };
        if (level.image != nullptr)
            smooth_bytes(four(*level.image), n, inside);
        else
            smooth_floats(four(*level.plane), n, inside);
        std::fill(smooth.data(), inside, *inside);
        std::fill(inside + n, smooth.data() + smooth.size(), inside[n - 1]);
        smooth_pairs(smooth.data(), whole_lines(part.x1 - part.x0), half.row(y) + part.x0);
    }
    return half;
}

}  // namespace tricue
