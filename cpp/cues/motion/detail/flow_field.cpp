// SPDX-License-Identifier: MIT
#include "cues/motion/detail/flow_field.hpp"

#include <algorithm>

#include "base/row_block.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

TRICUE_INLINE void sort_pair(float& a, float& b) {
    const float less = a < b ? a : b, more = a < b ? b : a;
    a = less;
    b = more;
}

/// n is a whole number of blocks, and rows have one more pixel on each side. Paeth's sorting network (1990), for the median of
/// nine only.
TRICUE_MULTIVERSION
void median_row(const float* __restrict above, const float* __restrict here, const float* __restrict below,
                int n, float* __restrict out) {
    for (int x = 0; x < n; ++x) {
        float a = above[x], b = above[x + 1], c = above[x + 2], d = here[x], e = here[x + 1], f = here[x + 2],
              g = below[x], h = below[x + 1], i = below[x + 2];
        sort_pair(b, c), sort_pair(e, f), sort_pair(h, i), sort_pair(a, b), sort_pair(d, e), sort_pair(g, h),
            sort_pair(b, c), sort_pair(e, f);
        sort_pair(h, i), sort_pair(a, d), sort_pair(f, i), sort_pair(e, h), sort_pair(d, g), sort_pair(b, e),
            sort_pair(c, f), sort_pair(e, h);
        sort_pair(e, c), sort_pair(g, e), sort_pair(e, c);
        out[x] = e;
    }
}

/// Upsamples n pixels, a whole number of blocks, by two, doubling the values: the sum of two rows at even pixels, the mean of two
/// such sums between them.
TRICUE_MULTIVERSION
void upsample_row(const float* __restrict top, const float* __restrict bottom, int n, float* __restrict out) {
    for (int x = 0; x < n; ++x) {
        const float sum = top[x] + bottom[x], next = top[x + 1] + bottom[x + 1];
        out[2 * x] = sum;
        out[2 * x + 1] = 0.5F * (sum + next);
    }
}

PaddedPlane median(const Floats& plane, int cols) {
    const auto rows = static_cast<int>(plane.rows());
    PaddedPlane padded(rows + 2, cols + 2), result(rows, cols);
    for (int y = 0; y < rows + 2; ++y) {
        const float* from = &plane(std::clamp(y - 1, 0, rows - 1), 0);
        std::copy(from, from + cols, padded.row(y) + 1);
        padded.row(y)[0] = from[0];
        padded.repeat_end(y, cols + 1);
    }
    for (int y = 0; y < rows; ++y) {
        median_row(padded.row(y), padded.row(y + 1), padded.row(y + 2), whole_blocks(cols), result.row(y));
        result.repeat_end(y, cols);
    }
    return result;
}

}  // namespace

Region coarser_region(const Region& area, int rows, int cols) {
    return {area.x0 / 2, area.y0 / 2, std::min(area.x1 / 2 + 1, cols), std::min(area.y1 / 2 + 1, rows)};
}

FlowField::FlowField(const Region& part)
    : area(part), u(part.y1 - part.y0, whole_blocks(part.x1 - part.x0)), v(u.rows(), u.cols()) {}

PaddedPlane::PaddedPlane(int height, int width)
    : rows(height),
      cols(width),
      stride(whole_blocks(width) + 2),
      pixels(static_cast<std::size_t>(height) * static_cast<std::size_t>(stride)) {}

// An upsampled row may begin a pixel too far left, and ends in a whole number of pairs of blocks.
FlowGuess::FlowGuess(const Region& area, int margin)
    : area_(area),
      margin_(margin),
      u_(0, 0),
      v_(0, 0),
      u_rows_(margin + kRowBatch, area.x1 - area.x0 + 2 * margin + 2 * kRowBlock + 2),
      v_rows_(margin + kRowBatch, area.x1 - area.x0 + 2 * margin + 2 * kRowBlock + 2) {}

FlowGuess::FlowGuess(const FlowField& coarse, const Region& area, int margin)
    : area_(area),
      margin_(margin),
      x0_(2 * coarse.area.x0),
      y0_(2 * coarse.area.y0),
      u_(median(coarse.u, coarse.area.x1 - coarse.area.x0)),
      v_(median(coarse.v, coarse.area.x1 - coarse.area.x0)),
      u_rows_(margin + kRowBatch, area.x1 - area.x0 + 2 * margin + 2 * kRowBlock + 2),
      v_rows_(margin + kRowBatch, area.x1 - area.x0 + 2 * margin + 2 * kRowBlock + 2) {}

void FlowGuess::advance(int y) {
    const int next = std::max(y, 0);
    if (next != newest_ + 1 || next >= area_.y1 - area_.y0) return;
    newest_ = next;
    if (u_.rows == 0) return;
    upsample(u_, u_rows_.row(next));
    upsample(v_, v_rows_.row(next));
}

void FlowGuess::upsample(PaddedPlane& coarse, float* row) {
    const int skipped = area_.x0 - x0_, width = area_.x1 - area_.x0;
    const int at = area_.y0 + newest_ - y0_, top = at / 2, bottom = std::min(top + at % 2, coarse.rows - 1);
    upsample_row(coarse.row(top), coarse.row(bottom), whole_blocks((width + skipped + 1) / 2),
                 row + margin_ - skipped);
    std::fill_n(row, margin_, row[margin_]);
    std::fill_n(row + margin_ + width, margin_ + kRowBlock, row[margin_ + width - 1]);
}

}  // namespace tricue
