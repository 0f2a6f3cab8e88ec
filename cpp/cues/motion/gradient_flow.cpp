// SPDX-License-Identifier: MIT
#include "cues/motion/gradient_flow.hpp"

#include <cmath>
#include <vector>

#include "base/row_block.hpp"
#include "base/simd.hpp"
#include "cues/motion/detail/flow_constraints.hpp"
#include "cues/motion/detail/frame_rows.hpp"

namespace tricue {
namespace {

constexpr double kMaxFlowSigmas = 2.221441469079183;  // pi / sqrt(2) sigmas: see the header

/// Cramer's rule on (4).
TRICUE_MULTIVERSION
void solve_row(const Constraints& row, float min_angle, float min_contrast, float max_flow, int n,
               const FlowRow& out) {
    const float *g_xs = row.g_x, *g_ys = g_xs + row.stride, *h_ys = g_ys + row.stride;
    const float *g_ts = h_ys + row.stride, *h_ts = g_ts + row.stride;
    float *us = out.u, *vs = out.v;
    float *angles = out.angle, *contrasts = out.contrast;
    // eight arrays: too many for the compiler to check for overlap before the loop
    TRICUE_INDEPENDENT
    for (int x = 0; x < n; ++x) {
        const float g_x = g_xs[x], g_y = g_ys[x], h_x = g_y, h_y = h_ys[x];
        const float g_t = g_ts[x], h_t = h_ts[x];
        const float cross = g_x * h_y - g_y * h_x;  // G x H
        const float g = g_x * g_x + g_y * g_y, h = h_x * h_x + h_y * h_y;
        const float norms = std::sqrt(g * h);
        const float sine = std::fabs(cross) / (norms > kRoundingContrast ? norms : kRoundingContrast);
        const float bounded = sine < 1 ? sine : 1.0F;
        const bool clear = (g >= kRoundingContrast) & (h >= kRoundingContrast);
        const float angle = clear ? bounded : 0.0F;
        const float contrast = g + h;
        const float u = (g_y * h_t - h_y * g_t) / cross, v = (h_x * g_t - g_x * h_t) / cross;
        const bool kept = (angle > 0) & (angle >= min_angle) & (contrast >= min_contrast) &
                          (u * u + v * v <= max_flow * max_flow);
        us[x] = kept ? u : kNoFlow;
        vs[x] = kept ? v : kNoFlow;
        angles[x] = angle;
        contrasts[x] = contrast;
    }
}

}  // namespace

FlowPlanes gradient_flow(const ImageView& previous, const ImageView& current, double sigma,
                         const FlowMinima& minima, const std::optional<Region>& region) {
    require_frames(previous, current, region);
    require_sigma(sigma);
    require_minima(minima);
    const auto [x0, y0, x1, y1] = region_or_all(region, current);
    const int width = x1 - x0;
    FlowPlanes flow(y1 - y0, width);
    if (flow.planes.size() == 0) return flow;

    const auto min_angle = static_cast<float>(minima.angle);
    const auto min_contrast = static_cast<float>(minima.contrast);
    const auto max_flow = static_cast<float>(kMaxFlowSigmas * sigma);
    const GaussianTaps taps(sigma);
    ConstraintRows constraints(taps, width);
    const int radius = taps.radius, length = whole_blocks(width + 2 * radius);
    FrameRows before(previous, x0 - radius, length), now(current, x0 - radius, length);
    std::vector<float> room(5 * static_cast<std::size_t>(whole_blocks(width)));
    const Constraints row{room.data(), whole_blocks(width)};
    for (int y = -radius; y < y1 - y0 + radius; ++y) {
        compare_rows(before.row(y0 + y), now.row(y0 + y), length,
                     {constraints.mean(y), constraints.change(y)});
        constraints.push(y, y + 1);
        const int done = y - radius;
        if (done < 0) continue;
        constraints.write(done, row);
        solve_row(row, min_angle, min_contrast, max_flow, width, flow.row(done));
    }
    return flow;
}

}  // namespace tricue
