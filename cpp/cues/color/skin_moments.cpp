// SPDX-License-Identifier: MIT
#include "cues/color/skin_moments.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "base/check.hpp"
#include "base/simd.hpp"
#include "cues/color/skin_boundary.hpp"

namespace tricue {
namespace {

constexpr int kTile = 1024;  // pixels, of a side: sums over a column and its rows fit into 32 bits
constexpr int kStrip = 16;   // rows: sums of a column's rows fit into bytes
constexpr int kBlock = 64;   // pixels; a tile's width is padded to whole blocks
constexpr int kPrefetchRows = 4;
constexpr std::uint8_t kSkin = 255;

/// Raw moments of integer pixel indices, relative to the region's corner; exact.
struct Sums {
    std::int64_t count = 0, x = 0, y = 0, xx = 0, yy = 0, xy = 0;
};

/// In bytes as far as possible: a difference limited to at least 0, and |a - b|, of which one part is 0.
inline std::uint8_t difference(std::uint8_t a, std::uint8_t b) {
    return static_cast<std::uint8_t>(std::max(a, b) - b);
}

inline std::uint8_t distance(std::uint8_t a, std::uint8_t b) {
    const std::uint8_t larger = std::max(a, b);
    return static_cast<std::uint8_t>((larger - a) + (larger - b));
}

/// The order in which a block's pixels are marked. Of its bytes j, j + 64 and j + 128 one is blue: that of the pixel in lane j, whose
/// green and red follow. So a channel is picked without moving bytes from lane to lane, which takes longer than all the rest.
struct BlockOrder {
    std::uint8_t pixel[kBlock] = {};     ///< in each lane
    std::uint8_t lane[kBlock] = {};      ///< of each pixel
    std::uint8_t third[3][kBlock] = {};  ///< 255 in the lanes whose blue byte is in that third of the block
};

constexpr BlockOrder order_of_block() {
    BlockOrder order;
    for (int lane = 0; lane < kBlock; ++lane)
        for (int third = 0; third < 3; ++third) {
            const int byte = kBlock * third + lane;
            if (byte % 3 != 0) continue;
            order.pixel[lane] = static_cast<std::uint8_t>(byte / 3);
            order.lane[byte / 3] = static_cast<std::uint8_t>(lane);
            order.third[third][lane] = 255;
        }
    return order;
}

constexpr BlockOrder kOrder = order_of_block();
constexpr int kBlockBytes = 3 * kBlock + 2;  // that are read; the last two don't count

template <bool kPositive>
TRICUE_INLINE void mark_block(const std::uint8_t* __restrict bytes, const Bgr& reference, std::uint8_t limit,
                              std::uint8_t* __restrict marks) {
    const std::uint8_t b0 = reference[0], g0 = reference[1], r0 = reference[2];
    const auto pick = [bytes](int lane, int channel) {
        const auto part = [=](int third) {
            return bytes[kBlock * third + lane + channel] & kOrder.third[third][lane];
        };
        return static_cast<std::uint8_t>(part(0) | part(1) | part(2));
    };
    for (int lane = 0; lane < kBlock; ++lane) {
        const std::uint8_t b = pick(lane, 0), g = pick(lane, 1), r = pick(lane, 2);
        const std::uint8_t eta = std::max(b, std::max(g, r));
        const std::uint8_t delta = std::max(distance(b, b0), std::max(distance(g, g0), distance(r, r0)));
        if constexpr (kPositive)
            marks[lane] = difference(eta, delta) >= limit ? kSkin : 0;
        else
            marks[lane] = difference(delta, eta) <= limit ? kSkin : 0;
    }
}

template <bool kPositive>
TRICUE_INLINE void mark_row(const std::uint8_t* pixels, int n, const std::uint8_t* end, const Bgr& reference,
                            std::uint8_t limit, std::uint8_t* marks) {
    for (; n > kBlock; n -= kBlock, pixels += 3 * kBlock, marks += kBlock)
        mark_block<kPositive>(pixels, reference, limit, marks);
    std::array<std::uint8_t, kBlockBytes> copy;
    if (end - pixels < kBlockBytes) {
        std::fill(std::copy_n(pixels, 3 * n, copy.begin()), copy.end(), std::uint8_t{0});
        pixels = copy.data();
    }
    mark_block<kPositive>(pixels, reference, limit, marks);
    const auto rest = static_cast<std::uint8_t>(n);
    for (int lane = 0; lane < kBlock; ++lane) marks[lane] = kOrder.pixel[lane] < rest ? marks[lane] : 0;
}

/// Marks the pixels of a row, at least one, whose boundary value, eta - delta of skin_boundary, is at least `least`, below 256: in
/// whole blocks, each in kOrder. Nothing at or after the image's `end` is read.
TRICUE_MULTIVERSION
void mark_skin(const std::uint8_t* pixels, int n, const std::uint8_t* end, const Bgr& reference, int least,
               std::uint8_t* marks) {
    const auto limit = static_cast<std::uint8_t>(std::abs(least));
    if (least > 0)
        mark_row<true>(pixels, n, end, reference, limit, marks);
    else
        mark_row<false>(pixels, n, end, reference, limit, marks);
}

/// Adds the marks of a strip, `height` rows from row `top` of the tile, to the tile's columns, n in whole blocks, and counts the marks
/// of each row.
template <int kBytes>
TRICUE_INLINE void add_strip_by(const std::uint8_t* marks, int height, int top, int n, std::int32_t* count,
                                std::int32_t* rows, int* found) {
    using Register = Pack<std::uint8_t, kBytes>;
    std::uint8_t in_row[kStrip][std::size_t{kBytes}] = {};  // at most kTile / 16 marks a lane
    std::uint8_t lanes[2][std::size_t{kBytes}];
    for (int x = 0; x < n; x += kBytes) {
        Register in_column = {}, their_rows = {}, mark, before;
        for (int row = 0; row < height; ++row) {
            load(marks + kTile * row + x, mark);
            in_column -= mark;
            their_rows += mark & static_cast<std::uint8_t>(row);
            load(in_row[row], before);
            store(before - mark, in_row[row]);
        }
        store(in_column, lanes[0]);
        store(their_rows, lanes[1]);
        for (int lane = 0; lane < kBytes; ++lane) {
            count[x + lane] += lanes[0][lane];
            rows[x + lane] += top * lanes[0][lane] + lanes[1][lane];
        }
    }
    for (int row = 0; row < height; ++row) {
        found[row] = 0;
        for (int lane = 0; lane < kBytes; ++lane) found[row] += in_row[row][lane];
    }
}

TRICUE_MULTIWIDTH(add_strip, add_strip_by,
                  (const std::uint8_t* marks, int height, int top, int n, std::int32_t* count,
                   std::int32_t* rows, int* found),
                  (marks, height, top, n, count, rows, found))

void add_tile(const ImageView& image, const Bgr& reference, int least, const Region& region,
              const Region& tile, Sums& sums) {
    const int width = tile.x1 - tile.x0, height = tile.y1 - tile.y0;
    const int padded = (width + kBlock - 1) / kBlock * kBlock;
    const std::int64_t left = tile.x0 - region.x0, top = tile.y0 - region.y0;
    alignas(kBlock) std::array<std::uint8_t, std::size_t{kStrip} * kTile> marks;
    alignas(kBlock) std::array<std::int32_t, kTile> counts,
        rows;  // of each column: skin, and sum of its rows
    const std::uint8_t* const end = image.row(image.rows - 1) + 3 * std::ptrdiff_t{image.cols};
    std::fill_n(counts.begin(), padded, 0);
    std::fill_n(rows.begin(), padded, 0);
    for (int first = 0; first < height; first += kStrip) {
        const int strip = std::min(kStrip, height - first);
        for (int row = first; row < first + strip; ++row) {
            const std::ptrdiff_t begin = 3 * std::ptrdiff_t{tile.x0};
            if (row + kPrefetchRows < height)
                prefetch_bytes(image.row(tile.y0 + row + kPrefetchRows) + begin, 3 * width);
            mark_skin(image.row(tile.y0 + row) + begin, width, end, reference, least,
                      marks.data() + kTile * (row - first));
        }
        int found[kStrip];
        add_strip(marks.data(), strip, first, padded, counts.data(), rows.data(), found);
        for (int row = 0; row < strip; ++row) {
            const std::int64_t y = top + first + row;
            sums.yy += y * y * found[row];
        }
    }
    for (int column = 0; column < width; ++column) {
        const auto at = static_cast<std::size_t>(column / kBlock * kBlock + kOrder.lane[column % kBlock]);
        const std::int64_t x = left + column, count = counts[at], y = rows[at] + top * count;
        sums.count += count;
        sums.x += x * count;
        sums.y += y;
        sums.xx += x * x * count;
        sums.xy += x * y;
    }
}

}  // namespace

Vector skin_moments(const ImageView& image, const Bgr& reference, double threshold, const Region& region,
                    int step) {
    const int least = least_skin(threshold);
    if (step < 1) refuse("step", "at least 1", step);
    const Region all = region.clipped(image);
    const int top = std::min(all.y0, image.rows);  // so that sums don't overflow
    const int first = top + std::min(step / 2, image.rows - top);
    const int height = all.y1 > first ? (all.y1 - first - 1) / step + 1 : 0;
    if (least > 255 || height == 0) return Vector::Zero(6);
    const ImageView rows{image.row(first), height, image.cols, 3, step * image.stride};
    const Region visible{all.x0, 0, all.x1, height};
    Sums sums;
    for (int y = visible.y0; y < visible.y1; y += kTile)
        for (int x = visible.x0; x < visible.x1; x += kTile) {
            const Region tile{x, y, std::min(x + kTile, visible.x1), std::min(y + kTile, visible.y1)};
            add_tile(rows, reference, least, visible, tile, sums);
        }

    Vector moments = Vector::Zero(6);
    if (sums.count == 0) return moments;
    const auto count = static_cast<double>(sums.count);
    const auto average = [count](std::int64_t sum) { return static_cast<double>(sum) / count; };
    const double x = average(sums.x), y = average(sums.y);
    const double xx = average(sums.xx) - x * x, yy = average(sums.yy) - y * y, xy = average(sums.xy) - x * y;
    const double down = step;
    moments << down * count, visible.x0 + x + 0.5, first + down * y + 0.5, xx, down * down * yy, down * xy;
    return moments;
}

}  // namespace tricue
