// SPDX-License-Identifier: MIT
#include "cues/motion/pyramid_flow.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "check.hpp"
#include "float_image.hpp"
#include "flow_constraints.hpp"
#include "flow_field.hpp"
#include "pooled_rows.hpp"
#include "simd.hpp"

namespace tricue {
namespace {

constexpr float kLongestStep = 2;  // pixels along x and y, at a level that isn't the last
constexpr float kSmallest = std::numeric_limits<float>::min();

/// What is kept at the last level.
struct Limits {
    float angle, contrast, step;
};

void require_pyramid(const FlowPyramid& pyramid) {
    if (pyramid.levels < 2 || pyramid.levels > 8) refuse("levels", "2 to 8", pyramid.levels);
    if (pyramid.pool < 0 || pyramid.pool > 16) refuse("pool", "0 to 16 pixels", pyramid.pool);
    if (!(pyramid.max_step > 0)) refuse("max_step", "a number above 0", pyramid.max_step);
}

/// The contrast (6) of the mean of two frames of nothing but rounding, variance 1/12 each: by the integral of the filters squared.
float rounding_noise(double sigma) {
    constexpr double kPi = 3.14159265358979323846;
    return static_cast<float>(1 / (48 * kPi * std::pow(sigma, 6)));
}

/// Solutions (u, v) of the damped normal equations.
struct Step {
    float u, v, determinant;  ///< the determinant without damping
};

[[gnu::always_inline]] inline void solve(float xx, float xy, float yy, float xt, float yt, float damping,
                                         Step& step) {
    const float product = xx * yy - xy * xy, determinant = product > 0 ? product : 0.0F;
    const float share = 1 / (determinant + damping * (xx + yy + damping));
    step.u = (xy * yt - (yy + damping) * xt) * share;
    step.v = (xy * xt - (xx + damping) * yt) * share;
    step.determinant = determinant;
}

TRICUE_MULTIVERSION
void add_steps(const Products& sums, float damping, int n, float* us, float* vs) {
    const float *xx = sums.xx, *xy = sums.xy, *yy = sums.yy, *xt = sums.xt, *yt = sums.yt;
#pragma GCC ivdep  // no row is another
    for (int x = 0; x < n; ++x) {
        Step step;
        solve(xx[x], xy[x], yy[x], xt[x], yt[x], damping, step);
        const float u = step.u < kLongestStep ? step.u : kLongestStep;
        const float v = step.v < kLongestStep ? step.v : kLongestStep;
        us[x] += u > -kLongestStep ? u : -kLongestStep;
        vs[x] += v > -kLongestStep ? v : -kLongestStep;
    }
}

TRICUE_MULTIVERSION
void finish_row(const Products& sums, float damping, const Limits& limits, int n, const float* u_before,
                const float* v_before, const FlowRow& out) {
    const float *xx = sums.xx, *xy = sums.xy, *yy = sums.yy, *xt = sums.xt, *yt = sums.yt;
    float *us = out.u, *vs = out.v, *angles = out.angle, *contrasts = out.contrast;
    const Limits least = limits;
#pragma GCC ivdep  // no row is another
    for (int x = 0; x < n; ++x) {
        Step step;
        solve(xx[x], xy[x], yy[x], xt[x], yt[x], damping, step);
        const float contrast = xx[x] + yy[x], size = contrast > kSmallest ? contrast : kSmallest;
        const float sine = 2 * std::sqrt(step.determinant) / size, angle = sine < 1 ? sine : 1.0F;
        const float square = step.u * step.u + step.v * step.v;
        const bool kept =
            (angle >= least.angle) & (contrast >= least.contrast) & (square <= least.step * least.step);
        const float u = u_before[x] + step.u, v = v_before[x] + step.v;
        us[x] = kept ? u : kNoFlow;
        vs[x] = kept ? v : kNoFlow;
        angles[x] = angle;
        contrasts[x] = contrast;
    }
}

/// The row of the area nearest to y, with a margin on both sides that repeats its ends.
void flow_row(const Floats& plane, int y, int margin, std::vector<float>& out) {
    const float* row = &plane(std::clamp<Eigen::Index>(y, 0, plane.rows() - 1), 0);
    std::copy_n(row, plane.cols(), std::fill_n(out.begin(), margin, row[0]));
    std::fill_n(out.end() - margin, margin, row[plane.cols() - 1]);
}

/// Calls done(y, products) for each row y of the flow's area. It may write that row of the flow: none is read later that is written.
template <typename Done>
void measure(const FloatImage& before, const FloatImage& now, double sigma, int pool, const FlowField& flow,
             const Done& done) {
    const auto [x0, y0, x1, y1] = flow.area;
    const int width = x1 - x0;
    ConstraintRows constraints(sigma, width + 2 * pool);
    PooledRows pooled(pool, width);
    const int radius = constraints.radius(), margin = radius + pool, length = width + 2 * margin;
    std::vector<float> u(static_cast<std::size_t>(length)), v(u), warped(u), here(u);
    for (int y = -margin; y < y1 - y0 + margin; ++y) {
        flow_row(flow.u, y, margin, u);
        flow_row(flow.v, y, margin, v);
        warped_row(before, y0 + y, x0 - margin, u.data(), v.data(), length, warped.data());
        image_row(now, y0 + y, x0 - margin, length, here.data());
        constraints.push(y + pool, warped.data(), here.data());
        if (y < radius - pool) continue;
        pooled.push(y - radius, constraints.row(y - radius + pool));
        if (y >= margin) done(y - margin, pooled.row(y - margin));
    }
}

std::vector<FloatImage> image_pyramid(const ImageView& frame, int levels) {
    std::vector<FloatImage> images;
    images.emplace_back(frame);
    while (static_cast<int>(images.size()) < levels) images.push_back(halved(images.back()));
    return images;
}

}  // namespace

FlowPlanes pyramid_flow(const ImageView& previous, const ImageView& current, double sigma,
                        const FlowPyramid& pyramid, const FlowMinima& minima,
                        const std::optional<Region>& region) {
    require_frames(previous, current, region);
    require_sigma(sigma);
    require_pyramid(pyramid);
    require_minima(minima);
    std::vector<Region> areas{region_or_all(region, current)};
    FlowPlanes result(areas[0].y1 - areas[0].y0, areas[0].x1 - areas[0].x0);
    if (result.planes.size() == 0) return result;
    const auto before = image_pyramid(previous, pyramid.levels), now = image_pyramid(current, pyramid.levels);
    for (std::size_t i = 1; i < now.size(); ++i)
        areas.push_back(halved(areas.back(), now[i].rows(), now[i].cols()));

    const float damping = rounding_noise(sigma);
    FlowField flow(areas.back());
    for (std::size_t i = now.size() - 1; i > 0; --i) {
        measure(before[i], now[i], sigma, pyramid.pool, flow, [&](int y, const Products& sums) {
            add_steps(sums, damping, static_cast<int>(flow.u.cols()), &flow.u(y, 0), &flow.v(y, 0));
        });
        flow = doubled(flow, areas[i - 1]);
    }
    const Limits limits{static_cast<float>(minima.angle),
                        std::max(static_cast<float>(minima.contrast), kRoundingContrast),
                        static_cast<float>(pyramid.max_step)};
    measure(before[0], now[0], sigma, pyramid.pool, flow, [&](int y, const Products& sums) {
        finish_row(sums, damping, limits, static_cast<int>(flow.u.cols()), &flow.u(y, 0), &flow.v(y, 0),
                   result.row(y));
    });
    return result;
}

}  // namespace tricue
