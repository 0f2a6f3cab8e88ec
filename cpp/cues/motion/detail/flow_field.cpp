// SPDX-License-Identifier: MIT
#include "cues/motion/detail/flow_field.hpp"

#include <algorithm>

#include "base/arrays.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

TRICUE_INLINE void sort_pair(float& a, float& b) {
    const float less = a < b ? a : b, more = a < b ? b : a;
    a = less;
    b = more;
}

/// Rows with one pixel more on both sides. Sorting network of Paeth 1990, for the middle one of nine only.
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

/// Twice the mean of two rows.
TRICUE_MULTIVERSION
void add_rows(const float* __restrict a, const float* __restrict b, int n, float* __restrict out) {
    for (int x = 0; x < n; ++x) out[x] = a[x] + b[x];
}

/// Upsamples by two: sum[x] at even pixels, the mean of two neighbors between them.
TRICUE_MULTIVERSION
void interpolate_row(const float* __restrict sum, int n, float* __restrict out) {
    for (int x = 0; x < n / 2; ++x) {
        out[2 * x] = sum[x];
        out[2 * x + 1] = 0.5F * (sum[x] + sum[x + 1]);
    }
    if (n % 2 == 1) out[n - 1] = sum[n / 2];
}

Floats median(const Floats& plane) {
    Floats padded(plane.rows() + 2, plane.cols() + 2), result(plane.rows(), plane.cols());
    padded.block(1, 1, plane.rows(), plane.cols()) = plane;
    padded.row(0) = padded.row(1);
    padded.row(plane.rows() + 1) = padded.row(plane.rows());
    padded.col(0) = padded.col(1);
    padded.col(plane.cols() + 1) = padded.col(plane.cols());
    const int cols = static_cast<int>(plane.cols());
    for (Eigen::Index y = 0; y < plane.rows(); ++y)
        median_row(&padded(y, 0), &padded(y + 1, 0), &padded(y + 2, 0), cols, &result(y, 0));
    return result;
}

}  // namespace

Region coarser_region(const Region& area, int rows, int cols) {
    return {area.x0 / 2, area.y0 / 2, std::min(area.x1 / 2 + 1, cols), std::min(area.y1 / 2 + 1, rows)};
}

FlowGuess::FlowGuess(const FlowField& coarse, const Region& area)
    : area_(area),
      x0_(2 * coarse.area.x0),
      y0_(2 * coarse.area.y0),
      u_(median(coarse.u)),
      v_(median(coarse.v)),
      sum_(1, u_.cols() + 1) {}

void FlowGuess::row(int y, float* u, float* v) {
    if (u_.size() == 0) {
        std::fill_n(u, area_.x1 - area_.x0, 0.0F);
        std::fill_n(v, area_.x1 - area_.x0, 0.0F);
    } else {
        upsample_row(u_, y, u);
        upsample_row(v_, y, v);
    }
}

void FlowGuess::upsample_row(const Floats& plane, int y, float* out) {
    const int at = area_.y0 + y - y0_, skipped = area_.x0 - x0_, width = area_.x1 - area_.x0;
    const Eigen::Index top = at / 2, bottom = std::min<Eigen::Index>(top + at % 2, plane.rows() - 1);
    float* sum = sum_.data();
    add_rows(&plane(top, 0), &plane(bottom, 0), static_cast<int>(plane.cols()), sum);
    sum[plane.cols()] = sum[plane.cols() - 1];
    if (skipped == 1) *out++ = 0.5F * (sum[0] + sum[1]);
    interpolate_row(sum + skipped, width - skipped, out);
}

}  // namespace tricue
