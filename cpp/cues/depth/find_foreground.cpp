// SPDX-License-Identifier: MIT
#include "cues/depth/find_foreground.hpp"

#include "base/check.hpp"
#include "base/depth_pixels.hpp"
#include "base/simd.hpp"
#include "cues/depth/detail/depth_rows.hpp"
#include "cues/depth/plane_support.hpp"

namespace tricue {
namespace {

DepthView view_of(const Floats& image) {
    return {image.data(), static_cast<int>(image.rows()), static_cast<int>(image.cols()), image.cols()};
}

/// A step may be as large as the largest int, so that sums and products of it don't fit an int.
Floats thin(const DepthView& depth, std::ptrdiff_t step) {
    constexpr std::ptrdiff_t kAhead = 4;  // rows
    Floats thinned((depth.rows + step - 1) / step, (depth.cols + step - 1) / step);
    const auto row = [&](std::ptrdiff_t y) { return depth.row(static_cast<int>(y * step)); };
    for (std::ptrdiff_t y = 0; y < thinned.rows(); ++y) {
        if ((y + kAhead) * step < depth.rows) prefetch_bytes(row(y + kAhead), std::ptrdiff_t{depth.cols} * 4);
        thin_row(row(y), thinned.cols(), step, thinned.row(y).data());
    }
    return thinned;
}

/// A line of pixels along a side of the image.
struct Line {
    const float* first;
    std::ptrdiff_t step;
    int size;

    bool has_any_depth() const {
        if (size > 0 && has_depth(first[size / 2 * step])) return true;  // usually true
        for (int i = 0; i < size; ++i)
            if (has_depth(first[i * step])) return true;
        return false;
    }
};

struct Span {
    int first, end;
};

/// The start and end of the lines with depth; if one is farther than `share` from the image's edge, that edge instead.
template <typename LineAt>
Span measured_span(int count, double share, LineAt line) {
    Span span{0, count};
    while (span.first < count && !line(span.first).has_any_depth()) ++span.first;
    if (span.first == count) return {0, count};
    while (!line(span.end - 1).has_any_depth()) --span.end;
    const double margin = share * count;
    return {span.first <= margin ? span.first : 0, count - span.end <= margin ? span.end : count};
}

Region find_measured(const DepthView& depth, double margin) {
    const Span rows =
        measured_span(depth.rows, margin, [&](int y) { return Line{depth.row(y), 1, depth.cols}; });
    const Span columns = measured_span(
        depth.cols, margin, [&](int x) { return Line{depth.row(0) + x, depth.stride, depth.rows}; });
    return {columns.first, rows.first, columns.end, rows.end};
}

}  // namespace

DepthForeground find_foreground(const DepthView& depth, int step, const Gaps& gaps, VectorRef camera,
                                VectorRef plane, const FloorTest& floor, const Space& space, double margin) {
    if (step < 1) refuse("step", "at least 1", step);
    if (!(margin >= 0.0 && margin <= 1.0)) refuse("margin", "a number in [0, 1]", margin);
    require_gaps(gaps);
    const Floats thinned = step > 1 ? thin(depth, step) : Floats();
    const DepthView whole = step > 1 ? view_of(thinned) : depth;
    const bool filling = gaps.passes > 0 && has_many_gaps(whole, gaps.max_gap_share);
    const Floats filled = filling ? run_passes(whole, gaps) : Floats();
    const DepthView seen = filling ? view_of(filled) : whole;
    return {above_floor(seen, camera, plane, space),
            plane_support(seen, camera, plane, floor.tolerance, floor.step), find_measured(seen, margin)};
}

}  // namespace tricue
