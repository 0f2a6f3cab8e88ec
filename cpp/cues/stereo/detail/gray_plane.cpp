// SPDX-License-Identifier: MIT
#include "cues/stereo/detail/gray_plane.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "base/row_block.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

/// Rows of an image, `stride` bytes apart.
struct ImageRows {
    const std::uint8_t* data;
    std::ptrdiff_t stride;
    int count;
};

/// The last block of a row may begin earlier, since an image has no room beyond its rows.
TRICUE_MULTIVERSION
void to_floats(const ImageRows& rows, int n, float* __restrict to) {
    const ImageRows from = rows;
    for (int y = 0; y < from.count; ++y) {
        const std::uint8_t* __restrict row = from.data + y * from.stride;
        float* __restrict out = to + std::ptrdiff_t{y} * n;
        if (n < kRowBlock)
            for (int x = 0; x < n; ++x) out[x] = row[x];
        else
            for (int x = 0; x < n; x += kRowBlock) {
                const int begin = std::min(x, n - kRowBlock);
                RowBlock block;
                load_bytes(row + begin, block);
                store(block, out + begin);
            }
    }
}

/// 8 times the weighted mean of four rows with weights 1, 3, 3, 1, for a whole number of blocks.
TRICUE_MULTIVERSION
void smooth(const std::array<const float*, 4>& rows, int n, float* __restrict out) {
    const float* __restrict above = rows[0];
    const float* __restrict upper = rows[1];
    const float* __restrict lower = rows[2];
    const float* __restrict below = rows[3];
    for (int x = 0; x < n; ++x) out[x] = (above[x] + below[x]) + 3 * (upper[x] + lower[x]);
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
                        kRowBlock]) {}

Region downsample_source(const Region& part, int rows, int cols) {
    return {std::max(2 * part.x0 - 1, 0), std::max(2 * part.y0 - 1, 0), std::min(2 * part.x1 + 1, cols),
            std::min(2 * part.y1 + 1, rows)};
}

GrayPlane gray_plane(const ImageView& image, const Region& part) {
    GrayPlane plane(part, image.rows, image.cols);
    to_floats({image.row(part.y0) + part.x0, image.stride, part.y1 - part.y0}, part.x1 - part.x0,
              plane.row(part.y0) + part.x0);
    return plane;
}

GrayPlane downsampled(const GrayPlane& picture, const Region& part) {
    const int rows = picture.rows(), cols = picture.cols();
    GrayPlane half(part, (rows + 1) / 2, (cols + 1) / 2);
    const Region from = downsample_source(part, rows, cols);
    const int first = 2 * part.x0 - 1, last = 2 * part.x1 + 1;  // columns, possibly beyond the border
    std::vector<float> smoothed(static_cast<std::size_t>(last - first) + 2 * kRowBlock);
    float* inside = smoothed.data() + (from.x0 - first);
    const int n = from.x1 - from.x0;
    for (int y = part.y0; y < part.y1; ++y) {
        const auto pixels = [&](int k) { return picture.row(std::clamp(2 * y + k, 0, rows - 1)) + from.x0; };
        smooth({pixels(-1), pixels(0), pixels(1), pixels(2)}, whole_blocks(n), inside);
        std::fill(smoothed.data(), inside, *inside);
        std::fill(inside + n, smoothed.data() + smoothed.size(), inside[n - 1]);
        smooth_pairs(smoothed.data(), whole_blocks(part.x1 - part.x0), half.row(y) + part.x0);
    }
    return half;
}

}  // namespace tricue
