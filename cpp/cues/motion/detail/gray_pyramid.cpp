// SPDX-License-Identifier: MIT
#include "cues/motion/detail/gray_pyramid.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <iterator>

#include "base/overlapping_blocks.hpp"
#include "base/row_block.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

TRICUE_MULTIVERSION
void smooth_down(const std::array<const std::uint8_t*, 5>& rows, int n, std::uint16_t* __restrict out) {
    const std::uint8_t *a = rows[0], *b = rows[1], *c = rows[2], *d = rows[3], *e = rows[4];
    for_overlapping_blocks<32>(n, [=](std::ptrdiff_t x) {
        out[x] = static_cast<std::uint16_t>(a[x] + e[x] + 4 * (b[x] + d[x]) + 6 * c[x]);
    });
}

/// Every second pixel of `in`, which has two more pixels on each side, for a whole number of blocks. Two neighbors are read as one
/// number, the first of them in its lower half.
TRICUE_MULTIVERSION
void smooth_across(const std::uint16_t* __restrict in, int n, std::uint8_t* __restrict out) {
    using Pairs = Pack<std::uint32_t, kRowBlock>;
    for (int x = 0; x < n; x += kRowBlock) {
        Pairs before, here, after;
        load(in + 2 * x, before);
        load(in + 2 * x + 2, here);
        load(in + 2 * x + 4, after);
        const Pairs outer = (before & 0xFFFF) + (after & 0xFFFF), inner = (before >> 16) + (here >> 16),
                    middle = here & 0xFFFF;
        const Pairs sum = outer + (inner << 2) + (middle << 2) + (middle << 1) + 128;
        Pack<std::uint16_t, kRowBlock> levels;
        Pack<std::uint8_t, kRowBlock> bytes;
        convert(sum, levels);
        levels >>= 8;
        convert(levels, bytes);
        store(bytes, out + x);
    }
}

/// Each pixel of a block, and in the next higher byte its right neighbor.
TRICUE_INLINE void pair_neighbors(const std::uint8_t* row, Pack<std::uint32_t, kRowBlock>& pairs) {
    Pack<std::uint8_t, kRowBlock> bytes, next_bytes;
    Pack<std::uint16_t, kRowBlock> here, next;
    load(row, bytes);
    load(row + 1, next_bytes);
    convert(bytes, here);
    convert(next_bytes, next);
    const Pack<std::uint16_t, kRowBlock> both = here | next << 8;
    convert(both, pairs);
}

TRICUE_INLINE void pack_block(const std::uint8_t* upper, const std::uint8_t* lower, std::uint32_t* quads) {
    Pack<std::uint32_t, kRowBlock> above, below;
    pair_neighbors(upper, above);
    pair_neighbors(lower, below);
    store(above | below << 16, quads);
}

/// Packs the quads of n pixels of two rows, which have one more. The last block may begin earlier.
TRICUE_MULTIVERSION
void pack(const std::uint8_t* __restrict upper, const std::uint8_t* __restrict lower, int n,
          std::uint32_t* __restrict quads) {
    if (n >= kRowBlock)
        for (int x = 0; x < n; x += kRowBlock) {
            const int begin = std::min(x, n - kRowBlock);
            pack_block(upper + begin, lower + begin, quads + begin);
        }
    else
        for (int x = 0; x < n; ++x)
            quads[x] = std::uint32_t{upper[x]} | std::uint32_t{upper[x + 1]} << 8 |
                       std::uint32_t{lower[x]} << 16 | std::uint32_t{lower[x + 1]} << 24;
}

/// The pixels that the quads cover, and the last column and row of the whole image.
struct QuadPlace {
    Region part;
    int last_column, last_row;
};

/// The weights of a block between the pixels of its quads in the previous frame.
struct WarpedBlock {
    float right[kRowBlock], down[kRowBlock];
};

TRICUE_INLINE void warp_block(const QuadPlace& place, float x0, float y, const float* u, const float* v,
                              std::int32_t* at, WarpedBlock& out) {
    constexpr float kColumns[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
    static_assert(std::size(kColumns) == kRowBlock);
    const auto last = static_cast<float>(place.last_column), bottom = static_cast<float>(place.last_row);
    const int first_column = place.part.x0, first_row = place.part.y0, cols = place.part.x1 - first_column;
    const int columns = cols - 1, rows = place.part.y1 - first_row - 1;
    for (int i = 0; i < kRowBlock; ++i) {
        float x = (x0 + kColumns[i]) - u[i], down = y - v[i];
        x = x > 0 ? x : 0;  // NaN becomes 0, too
        x = x > last ? last : x;
        down = down > 0 ? down : 0;
        down = down > bottom ? bottom : down;
        const int left = static_cast<int>(x), top = static_cast<int>(down);
        out.right[i] = x - static_cast<float>(left);
        out.down[i] = down - static_cast<float>(top);
        const int j = std::min(std::max(left - first_column, 0), columns);
        const int k = std::min(std::max(top - first_row, 0), rows);
        at[i] = k * cols + j;
    }
}

/// Interpolates between the four pixels of each quad, and compares the result with this frame's pixels.
template <int kBytes>
TRICUE_INLINE void interpolate_block(const std::uint32_t* quads, const WarpedBlock& warped,
                                     const std::uint8_t* now, float* means, float* changes) {
    // A separate loop: with bytes in it, the compiler would give the other loop only four lanes.
    float after[kRowBlock];
    for (int i = 0; i < kRowBlock; i += kRowLanes<kBytes>) {
        RowLanes<kBytes> pixels;
        load_bytes(now + i, pixels);
        store(pixels, after + i);
    }
    // the rows don't overlap
    TRICUE_INDEPENDENT
    for (int i = 0; i < kRowBlock; ++i) {
        const auto quad = static_cast<std::int32_t>(quads[i]);
        const auto p = static_cast<float>(quad & 255), q = static_cast<float>(quad >> 8 & 255);
        const auto r = static_cast<float>(quad >> 16 & 255), s = static_cast<float>(quad >> 24 & 255);
        const float upper = p + warped.right[i] * (q - p), lower = r + warped.right[i] * (s - r);
        const float before = upper + warped.down[i] * (lower - upper);
        means[i] = 0.5F * (before + after[i]);
        changes[i] = after[i] - before;
    }
}

/// Blocks that take each step together, because data just stored can't be loaded at once.
constexpr int kTogether = 4;

/// n is a whole number of blocks.
template <int kBytes>
TRICUE_INLINE void compare_by(const std::uint32_t* __restrict all, const QuadPlace& all_place, int x0, int y,
                              const FlowPointers& flow, const std::uint8_t* __restrict now, int n,
                              const ComparedRow& out) {
    const QuadPlace place = all_place;
    const float *u = flow.u, *v = flow.v;
    float *means = out.mean, *changes = out.change;
    const auto row = static_cast<float>(y);
    WarpedBlock warped[kTogether];
    std::int32_t places[kTogether * kRowBlock];
    std::uint32_t quads[kTogether * kRowBlock];
    for (int x = 0; x < n; x += kTogether * kRowBlock) {
        const int count = std::min((n - x) / kRowBlock, kTogether);
        for (int k = 0; k < count; ++k) {
            const int at = x + k * kRowBlock;
            warp_block(place, static_cast<float>(x0 + at), row, u + at, v + at, places + k * kRowBlock,
                       warped[k]);
        }
        pick<kRowBlock>(all, places, count * kRowBlock, quads);
        for (int k = 0; k < count; ++k) {
            const int at = x + k * kRowBlock;
            interpolate_block<kBytes>(quads + k * kRowBlock, warped[k], now + at, means + at, changes + at);
        }
    }
}

TRICUE_MULTIWIDTH(compare, compare_by,
                  (const std::uint32_t* all, const QuadPlace& place, int x0, int y, const FlowPointers& flow,
                   const std::uint8_t* now, int n, const ComparedRow& out),
                  (all, place, x0, y, flow, now, n, out))

GrayLevel downsampled(const ImageView& image, const Region& part) {
    const int width = part.x1 - part.x0, height = part.y1 - part.y0;
    GrayLevel half{(image.rows + 1) / 2, (image.cols + 1) / 2, part, {}};
    half.pixels.resize(static_cast<std::size_t>(height) * static_cast<std::size_t>(width) + kRowBlock);
    const int first = 2 * part.x0 - 2;
    const Region source = finer_source(part, image.rows, image.cols);
    std::vector<std::uint16_t> smooth(2 * static_cast<std::size_t>(whole_blocks(width)) + 4);
    const auto begin = smooth.begin() + (source.x0 - first), end = smooth.begin() + (source.x1 - first),
               last = smooth.begin() + 2 * width + 3;
    std::array<const std::uint8_t*, 5> rows{};
    for (int y = 0; y < height; ++y) {
        int at = 2 * (part.y0 + y) - 2;
        for (auto& row : rows) row = image.row(std::clamp(at++, 0, image.rows - 1)) + source.x0;
        smooth_down(rows, source.x1 - source.x0, &*begin);
        std::fill(smooth.begin(), begin, *begin);
        std::fill(end, last, *(end - 1));
        smooth_across(smooth.data(), whole_blocks(width), half.pixels.data() + std::ptrdiff_t{y} * width);
    }
    return half;
}

}  // namespace

Region finer_source(const Region& part, int rows, int cols) {
    return {std::max(2 * part.x0 - 2, 0), std::max(2 * part.y0 - 2, 0), std::min(2 * part.x1 + 1, cols),
            std::min(2 * part.y1 + 1, rows)};
}

std::vector<GrayLevel> coarser_levels(const ImageView& image, const std::vector<Region>& parts) {
    std::vector<GrayLevel> images;
    for (const Region& part : parts)
        images.push_back(downsampled(images.empty() ? image : images.back().view(), part));
    return images;
}

QuadImage::QuadImage(const ImageView& image, const Region& part)
    : rows_(image.rows),
      cols_(image.cols),
      part_(part),
      quads_(static_cast<std::size_t>(part.y1 - part.y0) * static_cast<std::size_t>(part.x1 - part.x0)) {
    constexpr std::uint32_t kTwice = 0x0101;
    const int width = part.x1 - part.x0;
    const bool at_edge = part.x1 == cols_;
    for (int y = part.y0; y < part.y1; ++y) {
        const std::uint8_t *upper = image.row(y), *lower = image.row(std::min(y + 1, rows_ - 1));
        std::uint32_t* quads = quads_.data() + std::ptrdiff_t{y - part.y0} * width;
        pack(upper + part.x0, lower + part.x0, at_edge ? width - 1 : width, quads);
        if (at_edge) quads[width - 1] = kTwice * upper[cols_ - 1] | (kTwice * lower[cols_ - 1]) << 16;
    }
}

void QuadImage::compare_row(int y, int x0, const FlowPointers& flow, const std::uint8_t* now, int n,
                            const ComparedRow& out) const {
    compare(quads_.data(), {part_, cols_ - 1, rows_ - 1}, x0, y, flow, now, n, out);
}

}  // namespace tricue
