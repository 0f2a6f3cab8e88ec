// SPDX-License-Identifier: MIT
#include "flow_field.hpp"

#include <algorithm>
#include <vector>

#include "simd.hpp"

namespace tricue {
namespace {

[[gnu::always_inline]] inline void sort(float& a, float& b) {
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
        sort(b, c), sort(e, f), sort(h, i), sort(a, b), sort(d, e), sort(g, h), sort(b, c), sort(e, f);
        sort(h, i), sort(a, d), sort(f, i), sort(e, h), sort(d, g), sort(b, e), sort(c, f), sort(e, h);
        sort(e, c), sort(g, e), sort(e, c);
        out[x] = e;
    }
}

/// Twice the mean of two rows.
TRICUE_MULTIVERSION
void add_rows(const float* __restrict a, const float* __restrict b, int n, float* __restrict out) {
    for (int x = 0; x < n; ++x) out[x] = a[x] + b[x];
}

TRICUE_MULTIVERSION
void spread_row(const float* __restrict coarse, int n, float* __restrict pairs) {
    for (int x = 0; x < n; ++x) {
        pairs[2 * x] = coarse[x];
        pairs[2 * x + 1] = 0.5F * (coarse[x] + coarse[x + 1]);
    }
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

Floats doubled(const Floats& plane, const Region& area, const Region& finer) {
    const int cols = static_cast<int>(plane.cols()), width = finer.x1 - finer.x0;
    Floats result(finer.y1 - finer.y0, width);
    std::vector<float> sum(static_cast<std::size_t>(cols) + 1), pairs(2 * static_cast<std::size_t>(cols));
    for (int y = finer.y0; y < finer.y1; ++y) {
        const Eigen::Index top = y / 2 - area.y0, bottom = std::min(top + y % 2, plane.rows() - 1);
        add_rows(&plane(top, 0), &plane(bottom, 0), cols, sum.data());
        sum.back() = sum[sum.size() - 2];
        spread_row(sum.data(), cols, pairs.data());
        std::copy_n(pairs.data() + (finer.x0 - 2 * area.x0), width, &result(y - finer.y0, 0));
    }
    return result;
}

}  // namespace

Region halved(const Region& area, int rows, int cols) {
    return {area.x0 / 2, area.y0 / 2, std::min(area.x1 / 2 + 1, cols), std::min(area.y1 / 2 + 1, rows)};
}

FlowField doubled(const FlowField& flow, const Region& finer) {
    FlowField result(finer);
    result.u = doubled(median(flow.u), flow.area, finer);
    result.v = doubled(median(flow.v), flow.area, finer);
    return result;
}

}  // namespace tricue
