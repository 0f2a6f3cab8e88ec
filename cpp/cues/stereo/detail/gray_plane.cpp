// SPDX-License-Identifier: MIT
#include "cues/stereo/detail/gray_plane.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "base/overlapping_blocks.hpp"
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
template <int kBytes>
TRICUE_INLINE void to_floats_by(const ImageRows& rows, int n, float* __restrict to) {
    const ImageRows from = rows;
    for (int y = 0; y < from.count; ++y) {
        const std::uint8_t* __restrict row = from.data + y * from.stride;
        float* __restrict out = to + std::ptrdiff_t{y} * n;
        if (n < kRowBlock)
            for (int x = 0; x < n; ++x) out[x] = row[x];
        else
            for (int x = 0; x < n; x += kRowBlock) {
                const int begin = std::min(x, n - kRowBlock);
                for (int k = begin; k < begin + kRowBlock; k += kRowLanes<kBytes>) {
                    RowLanes<kBytes> pixels;
                    load_bytes(row + k, pixels);
                    store(pixels, out + k);
                }
            }
    }
}

TRICUE_MULTIWIDTH(to_floats, to_floats_by, (const ImageRows& rows, int n, float* to), (rows, n, to))

/// 8 times the weighted mean of four rows with weights 1, 3, 3, 1.
TRICUE_MULTIVERSION
void smooth_bytes(const std::array<const std::uint8_t*, 4>& rows, int n, std::uint16_t* __restrict out) {
    const std::uint8_t *above = rows[0], *upper = rows[1], *lower = rows[2], *below = rows[3];
    for_overlapping_blocks<32>(n, [=](std::ptrdiff_t x) {
        out[x] = static_cast<std::uint16_t>((above[x] + below[x]) + 3 * (upper[x] + lower[x]));
    });
}

/// The same along a row, for every second pixel from in[1] on. Normalizes both. For a whole number of blocks.
TRICUE_MULTIVERSION
void smooth_byte_pairs(const std::uint16_t* __restrict in, int n, float* __restrict out) {
    using Pairs = Pack<std::uint32_t, kRowBlock>;  // the first of two numbers is in the lower half
    constexpr float kShare = 1.0F / 64.0F;
    for (int i = 0; i < n; i += kRowBlock) {
        Pairs here, next;
        load(in + 2 * i, here);
        load(in + 2 * i + 2, next);
        const Pairs outer = (here & 0xFFFF) + (next >> 16), inner = (here >> 16) + (next & 0xFFFF);
        Pack<std::int32_t, kRowBlock> sum;
        const Pairs total = outer + inner + (inner << 1);
        convert(total, sum);
        Pack<float, kRowBlock> mean;
        convert(sum, mean);
        store(kShare * mean, out + i);
    }
}

/// The same of floats; writes a whole number of blocks.
TRICUE_MULTIVERSION
void smooth_floats(const std::array<const float*, 4>& rows, int n, float* __restrict out) {
    const float* __restrict above = rows[0];
    const float* __restrict upper = rows[1];
    const float* __restrict lower = rows[2];
    const float* __restrict below = rows[3];
    const int end = whole_blocks(n);
    for (int x = 0; x < end; ++x) out[x] = (above[x] + below[x]) + 3 * (upper[x] + lower[x]);
}

TRICUE_MULTIVERSION
void smooth_float_pairs(const float* __restrict in, int n, float* __restrict out) {
    constexpr float kShare = 1.0F / 64.0F;
    for (int i = 0; i < n; ++i)
        out[i] = kShare * ((in[2 * i] + in[2 * i + 3]) + 3.0F * (in[2 * i + 1] + in[2 * i + 2]));
}

/// The part at half the size; row(y) is a picture's, and Sum what holds the sum of four of its rows. `down` and `across` smooth.
template <typename Sum, typename Row, typename Down, typename Across>
GrayPlane downsampled(const Row& row, int rows, int cols, const Region& part, const Down& down,
                      const Across& across) {
    GrayPlane half(part, (rows + 1) / 2, (cols + 1) / 2);
    const Region from = downsample_source(part, rows, cols);
    const int first = 2 * part.x0 - 1, last = 2 * part.x1 + 1;  // columns, possibly beyond the border
    std::vector<Sum> smoothed(static_cast<std::size_t>(last - first) + 2 * kRowBlock);
    Sum* inside = smoothed.data() + (from.x0 - first);
    const int n = from.x1 - from.x0;
    for (int y = part.y0; y < part.y1; ++y) {
        const auto pixels = [&](int k) { return row(std::clamp(2 * y + k, 0, rows - 1)) + from.x0; };
        down({pixels(-1), pixels(0), pixels(1), pixels(2)}, n, inside);
        if (from.x0 > first) smoothed[0] = *inside;
        std::fill_n(inside + n, last - from.x1, inside[n - 1]);
        across(smoothed.data(), whole_blocks(part.x1 - part.x0), half.row(y) + part.x0);
    }
    return half;
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

GrayPlane downsampled(const ImageView& image, const Region& part) {
    const auto row = [&](int y) { return image.row(y); };
    return downsampled<std::uint16_t>(row, image.rows, image.cols, part, smooth_bytes, smooth_byte_pairs);
}

GrayPlane downsampled(const GrayPlane& picture, const Region& part) {
    const auto row = [&](int y) { return picture.row(y); };
    return downsampled<float>(row, picture.rows(), picture.cols(), part, smooth_floats, smooth_float_pairs);
}

}  // namespace tricue
