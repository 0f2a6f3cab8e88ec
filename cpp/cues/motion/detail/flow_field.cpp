// SPDX-License-Identifier: MIT
#include "cues/motion/detail/flow_field.hpp"

#include <algorithm>

#include "base/simd.hpp"
#include "cues/motion/detail/row_block.hpp"

namespace tricue {
namespace {

TRICUE_INLINE void sort_pair(float& a, float& b) {
    const float less = a < b ? a : b, more = a < b ? b : a;
    a = less;
    b = more;
}

/// n is a number of half blocks, and rows have one pixel more on both sides. Sorting network of Paeth 1990, for the middle one of
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

/// Upsamples n pixels, a number of half blocks, by two, with the numbers doubled: of two rows the sum at even pixels, between them
/// the mean of two sums.
TRICUE_MULTIVERSION
void upsample_row(const float* __restrict top, const float* __restrict bottom, int n, float* __restrict out) {
    for (int x = 0; x < n; ++x) {
        const float sum = top[x] + bottom[x], next = top[x + 1] + bottom[x + 1];
        out[2 * x] = sum;
        out[2 * x + 1] = 0.5F * (sum + next);
    }
}

int whole_halves(int n) {
    return (n + kHalfBlock - 1) / kHalfBlock * kHalfBlock;
}

/// A plane with rows that end in a number of half blocks and one pixel more; what is beyond the plane repeats its end.
struct PaddedPlane {
    int rows, cols, stride;
    std::vector<float> pixels;

    PaddedPlane(int height, int width)
        : rows(height),
          cols(width),
          stride(whole_halves(width) + 2),
          pixels(static_cast<std::size_t>(height) * static_cast<std::size_t>(stride)) {}

    float* row(int y) { return pixels.data() + std::ptrdiff_t{y} * stride; }
    void repeat_end(int y, int end) { std::fill(row(y) + end, row(y) + stride, row(y)[end - 1]); }
};

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
        median_row(padded.row(y), padded.row(y + 1), padded.row(y + 2), whole_halves(cols), result.row(y));
        result.repeat_end(y, cols);
    }
    return result;
}

}  // namespace

Region coarser_region(const Region& area, int rows, int cols) {
    return {area.x0 / 2, area.y0 / 2, std::min(area.x1 / 2 + 1, cols), std::min(area.y1 / 2 + 1, rows)};
}

FlowField::FlowField(const Region& part)
    : area(part), u(part.y1 - part.y0, whole_halves(part.x1 - part.x0)), v(u.rows(), u.cols()) {}

FlowGuess::FlowGuess(const Region& area, int margin)
    : area_(area),
      margin_(margin),
      // An upsampled row may begin a pixel too far left, and ends in a whole number of blocks.
      stride_(whole_halves(area.x1 - area.x0 + 2 * margin) + 2 * kHalfBlock + 2),
      u_(static_cast<std::size_t>(stride_) * static_cast<std::size_t>(area.y1 - area.y0)),
      v_(u_.size()) {}

FlowGuess::FlowGuess(const FlowField& coarse, const Region& area, int margin) : FlowGuess(area, margin) {
    fill(coarse.u, coarse.area, u_);
    fill(coarse.v, coarse.area, v_);
}

void FlowGuess::fill(const Floats& coarse, const Region& of, std::vector<float>& plane) const {
    PaddedPlane smooth = median(coarse, of.x1 - of.x0);
    const int skipped = area_.x0 - 2 * of.x0, width = area_.x1 - area_.x0, rows = area_.y1 - area_.y0;
    for (int y = 0; y < rows; ++y) {
        const int at = area_.y0 + y - 2 * of.y0, top = at / 2,
                  bottom = std::min(top + at % 2, smooth.rows - 1);
        float* row = plane.data() + std::ptrdiff_t{y} * stride_;
        upsample_row(smooth.row(top), smooth.row(bottom), whole_halves((width + skipped + 1) / 2),
                     row + margin_ - skipped);
        std::fill_n(row, margin_, row[margin_]);
        std::fill(row + margin_ + width, row + stride_, row[margin_ + width - 1]);
    }
}

}  // namespace tricue
