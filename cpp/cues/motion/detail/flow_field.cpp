// SPDX-License-Identifier: MIT
#include "cues/motion/detail/flow_field.hpp"

#include <algorithm>
#include <utility>

#include "base/row_block.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

TRICUE_INLINE void sort_pair(float& a, float& b) {
    const float less = a < b ? a : b, more = a < b ? b : a;
    a = less;
    b = more;
}

/// The medians of the pixels around each pixel of some rows, with Paeth's sorting network (1990), for the median of nine only. A row is
/// `stride` numbers after the one before; n is a whole number of blocks, and there is one more pixel on each side.
TRICUE_MULTIVERSION
void median_rows(const float* __restrict from, int rows, int stride, int n, float* __restrict to) {
    for (int y = 0; y < rows; ++y) {
        const float* here = from + std::ptrdiff_t{y} * stride;
        const float *above = here - stride, *below = here + stride;
        float* __restrict out = to + std::ptrdiff_t{y} * stride;
        for (int x = 0; x < n; ++x) {
            float a = above[x - 1], b = above[x], c = above[x + 1], d = here[x - 1], e = here[x],
                  f = here[x + 1], g = below[x - 1], h = below[x], i = below[x + 1];
            sort_pair(b, c), sort_pair(e, f), sort_pair(h, i), sort_pair(a, b), sort_pair(d, e),
                sort_pair(g, h), sort_pair(b, c), sort_pair(e, f);
            sort_pair(h, i), sort_pair(a, d), sort_pair(f, i), sort_pair(e, h), sort_pair(d, g),
                sort_pair(b, e), sort_pair(c, f), sort_pair(e, h);
            sort_pair(e, c), sort_pair(g, e), sort_pair(e, c);
            out[x] = e;
        }
    }
}

/// The place of an upsampled row: `skipped` pixels before the area, `width` in it, and a margin on both sides.
struct UpsampledPlace {
    int margin, skipped, width;
};

/// Upsamples by two, doubling the values: the sum of two rows at even pixels, the mean of two such sums between them. The margins
/// repeat the area's ends, the right one for a block more.
TRICUE_INLINE void upsample_by(const float* __restrict top, const float* __restrict bottom,
                               const UpsampledPlace& place, float* __restrict row) {
    float* __restrict out = row + place.margin - place.skipped;
    const int n = whole_blocks((place.width + place.skipped + 1) / 2);
    for (int x = 0; x < n; ++x) {
        const float sum = top[x] + bottom[x], next = top[x + 1] + bottom[x + 1];
        out[2 * x] = sum;
        out[2 * x + 1] = 0.5F * (sum + next);
    }
    float *begin = row + place.margin, *end = begin + place.width;
    float first[kRowBlock];
    std::copy_n(begin, kRowBlock, first);  // the left margin's last block covers a part of it
    const float left = *begin, right = *(end - 1);
    for (int x = 0; x < place.margin; x += kRowBlock) std::fill_n(row + x, kRowBlock, left);
    std::copy_n(first, kRowBlock, begin);
    for (int x = 0; x < place.margin + kRowBlock; x += kRowBlock) std::fill_n(end + x, kRowBlock, right);
}

/// Rows of the coarse flow along x and y.
struct CoarseRows {
    const float *top, *bottom;
};

TRICUE_MULTIVERSION
void upsample_rows(const CoarseRows& u, const CoarseRows& v, const UpsampledPlace& place, float* u_row,
                   float* v_row) {
    const UpsampledPlace at = place;
    upsample_by(u.top, u.bottom, at, u_row);
    upsample_by(v.top, v.bottom, at, v_row);
}

/// The plane with a median filter; its last column is repeated once. The pixels around `plane` become copies of its edge.
PaddedPlane median(PaddedPlane& plane) {
    const int rows = plane.rows, cols = plane.cols;
    for (int y = 0; y < rows; ++y) {
        float* row = plane.row(y);
        row[-1] = row[0];
        row[cols] = row[cols - 1];
    }
    for (const auto& [from, to] : {std::pair{0, -1}, std::pair{rows - 1, rows}})
        std::copy_n(plane.row(from) - 1, plane.stride, plane.row(to) - 1);
    PaddedPlane result(rows, cols);
    median_rows(plane.row(0), rows, plane.stride, whole_blocks(cols), result.row(0));
    for (int y = 0; y < rows; ++y) result.row(y)[cols] = result.row(y)[cols - 1];
    return result;
}

}  // namespace

Region coarser_region(const Region& area, int rows, int cols) {
    return {area.x0 / 2, area.y0 / 2, std::min(area.x1 / 2 + 1, cols), std::min(area.y1 / 2 + 1, rows)};
}

PaddedPlane::PaddedPlane(int height, int width)
    : rows(height),
      cols(width),
      stride(whole_blocks(width) + 2),
      pixels(static_cast<std::size_t>(height + 2) * static_cast<std::size_t>(stride)) {}

FlowField::FlowField(const Region& part)
    : area(part), u(part.y1 - part.y0, part.x1 - part.x0), v(u.rows, u.cols) {}

// An upsampled row may begin a pixel too far left, and ends in a whole number of pairs of blocks.
FlowGuess::FlowGuess(const Region& area, int margin)
    : area_(area),
      margin_(margin),
      u_(0, 0),
      v_(0, 0),
      u_rows_(margin + kRowBatch, area.x1 - area.x0 + 2 * margin + 2 * kRowBlock + 2),
      v_rows_(margin + kRowBatch, area.x1 - area.x0 + 2 * margin + 2 * kRowBlock + 2) {}

FlowGuess::FlowGuess(FlowField& coarse, const Region& area, int margin)
    : area_(area),
      margin_(margin),
      x0_(2 * coarse.area.x0),
      y0_(2 * coarse.area.y0),
      u_(median(coarse.u)),
      v_(median(coarse.v)),
      u_rows_(margin + kRowBatch, area.x1 - area.x0 + 2 * margin + 2 * kRowBlock + 2),
      v_rows_(margin + kRowBatch, area.x1 - area.x0 + 2 * margin + 2 * kRowBlock + 2) {}

void FlowGuess::advance(int y) {
    const int next = std::max(y, 0);
    if (next != newest_ + 1 || next >= area_.y1 - area_.y0) return;
    newest_ = next;
    if (u_.rows == 0) return;
    const int at = area_.y0 + next - y0_, top = at / 2, bottom = std::min(top + at % 2, u_.rows - 1);
    upsample_rows({u_.row(top), u_.row(bottom)}, {v_.row(top), v_.row(bottom)},
                  {margin_, area_.x0 - x0_, area_.x1 - area_.x0}, u_rows_.row(next), v_rows_.row(next));
}

}  // namespace tricue
