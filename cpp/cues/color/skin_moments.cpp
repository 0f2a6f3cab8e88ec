// SPDX-License-Identifier: MIT
#include "cues/color/skin_moments.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "base/check.hpp"
#include "base/overlapping_blocks.hpp"
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

/// In bytes as far as possible: |a - b| as max - min, and a difference limited to at least 0.
inline std::uint8_t distance(std::uint8_t a, std::uint8_t b) {
    return static_cast<std::uint8_t>(std::max(a, b) - std::min(a, b));
}

inline std::uint8_t difference(std::uint8_t a, std::uint8_t b) {
    return static_cast<std::uint8_t>(std::max(a, b) - b);
}

/// Marks the pixels of a row whose boundary value, eta - delta of skin_boundary, is at least `least`, below 256.
TRICUE_MULTIVERSION
void mark_skin(const std::uint8_t* __restrict pixels, int n, const Bgr& reference, int least,
               std::uint8_t* __restrict skin) {
    const std::uint8_t b0 = reference[0], g0 = reference[1], r0 = reference[2];
    const auto eta = [=](std::ptrdiff_t x) {
        return std::max(pixels[3 * x], std::max(pixels[3 * x + 1], pixels[3 * x + 2]));
    };
    const auto delta = [=](std::ptrdiff_t x) {
        return std::max(distance(pixels[3 * x], b0),
                        std::max(distance(pixels[3 * x + 1], g0), distance(pixels[3 * x + 2], r0)));
    };
    const auto limit = static_cast<std::uint8_t>(std::abs(least));
    if (least > 0)
        for_overlapping_blocks<kBlock>(
            n, [=](std::ptrdiff_t x) { skin[x] = difference(eta(x), delta(x)) >= limit ? kSkin : 0; });
    else
        for_overlapping_blocks<kBlock>(
            n, [=](std::ptrdiff_t x) { skin[x] = difference(delta(x), eta(x)) <= limit ? kSkin : 0; });
}

/// Adds the marks of a strip, `height` rows from row `top` of the tile, to the tile's columns, n in whole blocks, and counts the marks
/// of each row.
template <int kBytes>
TRICUE_INLINE void add_strip_by(const std::uint8_t* marks, int height, int top, int n, std::int32_t* count,
                                std::int32_t* rows, int* found) {
    using Register = Pack<std::uint8_t, kBytes>;
    Register in_row[kStrip] = {};  // at most kTile / 16 marks a lane
    std::uint8_t lanes[2][std::size_t{kBytes}];
    for (int x = 0; x < n; x += kBytes) {
        Register in_column = {}, their_rows = {}, mark;
        for (int row = 0; row < height; ++row) {
            load(marks + kTile * row + x, mark);
            in_column -= mark;
            their_rows += mark & static_cast<std::uint8_t>(row);
            in_row[row] -= mark;
        }
        store(in_column, lanes[0]);
        store(their_rows, lanes[1]);
        for (int lane = 0; lane < kBytes; ++lane) {
            count[x + lane] += lanes[0][lane];
            rows[x + lane] += top * lanes[0][lane] + lanes[1][lane];
        }
    }
    for (int row = 0; row < height; ++row) {
        store(in_row[row], lanes[0]);
        found[row] = 0;
        for (int lane = 0; lane < kBytes; ++lane) found[row] += lanes[0][lane];
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
    for (int row = 0; row < kStrip; ++row)
        std::fill(marks.begin() + kTile * row + width, marks.begin() + kTile * row + padded, std::uint8_t{0});
    std::fill_n(counts.begin(), padded, 0);
    std::fill_n(rows.begin(), padded, 0);
    for (int first = 0; first < height; first += kStrip) {
        const int strip = std::min(kStrip, height - first);
        for (int row = first; row < first + strip; ++row) {
            const std::ptrdiff_t begin = 3 * std::ptrdiff_t{tile.x0};
            if (row + kPrefetchRows < height)
                prefetch_bytes(image.row(tile.y0 + row + kPrefetchRows) + begin, 3 * width);
            mark_skin(image.row(tile.y0 + row) + begin, width, reference, least,
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
        const auto at = static_cast<std::size_t>(column);
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
