// SPDX-License-Identifier: MIT
#include "cues/motion/pyramid_flow.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/check.hpp"
#include "base/simd.hpp"
#include "cues/motion/detail/flow_constraints.hpp"
#include "cues/motion/detail/flow_field.hpp"
#include "cues/motion/detail/frame_rows.hpp"
#include "cues/motion/detail/gray_pyramid.hpp"
#include "cues/motion/detail/normal_equations.hpp"
#include "cues/motion/detail/row_block.hpp"

namespace tricue {
namespace {

constexpr float kMaxStep = 2;  // pixels along x and y, at a level that isn't the last
constexpr float kMinDivisor = std::numeric_limits<float>::min();

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

TRICUE_INLINE void solve(float xx, float xy, float yy, float xt, float yt, float damping, Step& step) {
    const float product = xx * yy - xy * xy, determinant = product > 0 ? product : 0.0F;
    const float share = 1 / (determinant + damping * (xx + yy + damping));
    step.u = (xy * yt - (yy + damping) * xt) * share;
    step.v = (xy * xt - (xx + damping) * yt) * share;
    step.determinant = determinant;
}

/// The guess of a row, and what becomes of it.
struct GuessRow {
    const float *u, *v;
};

/// n is a number of half blocks.
TRICUE_MULTIVERSION
void add_steps(const NormalEquations& sums, const GuessRow& guess, float damping, int n, float* us,
               float* vs) {
    const float *xx = sums.xx, *xy = sums.xy, *yy = sums.yy, *xt = sums.xt, *yt = sums.yt;
    const float *u0 = guess.u, *v0 = guess.v;
    // no row is another
    TRICUE_INDEPENDENT
    for (int x = 0; x < n; ++x) {
        Step step;
        solve(xx[x], xy[x], yy[x], xt[x], yt[x], damping, step);
        const float u = step.u < kMaxStep ? step.u : kMaxStep;
        const float v = step.v < kMaxStep ? step.v : kMaxStep;
        us[x] = u0[x] + (u > -kMaxStep ? u : -kMaxStep);
        vs[x] = v0[x] + (v > -kMaxStep ? v : -kMaxStep);
    }
}

/// Pixels [begin, end) of a row.
TRICUE_INLINE void finish_pixels(const NormalEquations& sums, const GuessRow& guess, float damping,
                                 const Limits& least, int begin, int end, const FlowRow& out) {
    const float *xx = sums.xx, *xy = sums.xy, *yy = sums.yy, *xt = sums.xt, *yt = sums.yt;
    const float *u0 = guess.u, *v0 = guess.v;
    float *us = out.u, *vs = out.v, *angles = out.angle, *contrasts = out.contrast;
    // no row is another
    TRICUE_INDEPENDENT
    for (int x = begin; x < end; ++x) {
        Step step;
        solve(xx[x], xy[x], yy[x], xt[x], yt[x], damping, step);
        const float contrast = xx[x] + yy[x], size = contrast > kMinDivisor ? contrast : kMinDivisor;
        const float sine = 2 * std::sqrt(step.determinant) / size, angle = sine < 1 ? sine : 1.0F;
        const float square = step.u * step.u + step.v * step.v;
        const bool kept =
            (angle >= least.angle) & (contrast >= least.contrast) & (square <= least.step * least.step);
        us[x] = kept ? u0[x] + step.u : kNoFlow;
        vs[x] = kept ? v0[x] + step.v : kNoFlow;
        angles[x] = angle;
        contrasts[x] = contrast;
    }
}

/// By half blocks, of which the last begins sooner: the planes have no room beyond their rows.
TRICUE_MULTIVERSION
void finish_row(const NormalEquations& sums, const GuessRow& guess, float damping, const Limits& limits,
                int n, const FlowRow& out) {
    const Limits least = limits;
    if (n < kHalfBlock) return finish_pixels(sums, guess, damping, least, 0, n, out);
    for (int x = 0; x < n; x += kHalfBlock) {
        const int begin = std::min(x, n - kHalfBlock);
        finish_pixels(sums, guess, damping, least, begin, begin + kHalfBlock, out);
    }
}

/// Calls done(y, products) for each row y of the guess's area: the constraints of `before`, warped by the guess, and `now`.
template <typename Done>
void measure(const QuadImage& before, const ImageView& now, double sigma, int pool, FlowGuess& guess,
             const Done& done) {
    const auto [x0, y0, x1, y1] = guess.area();
    const int width = x1 - x0;
    ConstraintRows constraints(sigma, width + 2 * pool);
    NormalEquationRows equations(pool, width);
    const int radius = constraints.radius(), margin = radius + pool, length = width + 2 * margin;
    const int whole =
        (length + kHalfBlock - 1) / kHalfBlock * kHalfBlock;  // pixels beyond cost less than a loop's rest
    std::vector<float> warped(static_cast<std::size_t>(whole)), here(warped);
    for (int y = -margin; y < y1 - y0 + margin; ++y) {
        guess.advance(y);
        before.warped_row(y0 + y, x0 - margin, guess.u(y), guess.v(y), whole, warped.data());
        read_frame_row(now, y0 + y, x0 - margin, length, here.data());
        constraints.push(y + pool, warped.data(), here.data());
        if (y < radius - pool) continue;
        equations.push(y - radius, constraints.row(y - radius + pool));
        if (y >= margin) done(y - margin, equations.row(y - margin));
    }
}

/// The first level's first.
struct PyramidPlan {
    std::vector<Region> areas;   ///< that are measured
    std::vector<Region> warped;  ///< the pixels to which the flow may lead from there
    std::vector<Region> stored;  ///< of coarser levels: with those that the next level and interpolation read
};

Region expanded(const Region& region, int reach, const ImageView& image) {
    return Region{region.x0 - reach, region.y0 - reach, region.x1 + reach, region.y1 + reach}.clipped(image);
}

/// A guess is off by no more than twice what the coarser level is off, and its step.
PyramidPlan plan_levels(const ImageView& frame, int levels, int margin, const Region& area) {
    PyramidPlan plan;
    std::vector<ImageView> sizes{{nullptr, frame.rows, frame.cols, 1, 0}};
    plan.areas.push_back(area);
    while (static_cast<int>(sizes.size()) < levels) {
        const ImageView& finer = sizes.back();
        const int rows = (finer.rows + 1) / 2, cols = (finer.cols + 1) / 2;
        plan.areas.push_back(coarser_region(plan.areas.back(), rows, cols));
        sizes.push_back({nullptr, rows, cols, 1, 0});
    }
    int guessed = 0;  // pixels that a guess may be away
    plan.warped.resize(sizes.size());
    plan.stored.resize(sizes.size());
    for (std::size_t k = sizes.size(); k-- > 0;) {
        plan.warped[k] = expanded(plan.areas[k], margin + guessed + 1, sizes[k]);  // one for rounding
        Region& stored = plan.stored[k] = expanded(plan.warped[k], 1, sizes[k]);
        if (k + 1 < sizes.size()) {
            const Region source = finer_source(plan.stored[k + 1], sizes[k].rows, sizes[k].cols);
            stored = {std::min(stored.x0, source.x0), std::min(stored.y0, source.y0),
                      std::max(stored.x1, source.x1), std::max(stored.y1, source.y1)};
        }
        guessed = 2 * (guessed + static_cast<int>(kMaxStep));
    }
    return plan;
}

/// The guess at the first level, from the coarser ones.
FlowGuess coarse_guess(const ImageView& previous, const ImageView& current, double sigma,
                       const FlowPyramid& pyramid, const PyramidPlan& plan) {
    const std::vector<Region>& areas = plan.areas;
    const std::vector<Region> coarser(plan.stored.begin() + 1, plan.stored.end());
    const auto before = coarser_levels(previous, coarser), now = coarser_levels(current, coarser);
    const float damping = rounding_noise(sigma);
    const int margin = GaussianTaps(sigma).radius + pyramid.pool;
    FlowGuess guess(areas.back(), margin);
    for (std::size_t i = now.size(); i > 0; --i) {
        FlowField flow(areas[i]);
        measure(QuadImage(before[i - 1].view(), plan.warped[i]), now[i - 1].view(), sigma, pyramid.pool,
                guess, [&](int y, const NormalEquations& sums) {
                    add_steps(sums, {guess.u(y) + margin, guess.v(y) + margin}, damping,
                              static_cast<int>(flow.u.cols()), &flow.u(y, 0), &flow.v(y, 0));
                });
        guess = FlowGuess(flow, areas[i - 1], margin);
    }
    return guess;
}

}  // namespace

FlowPlanes pyramid_flow(const ImageView& previous, const ImageView& current, double sigma,
                        const FlowPyramid& pyramid, const FlowMinima& minima,
                        const std::optional<Region>& region) {
    require_frames(previous, current, region);
    require_sigma(sigma);
    require_pyramid(pyramid);
    require_minima(minima);
    const Region area = region_or_all(region, current);
    FlowPlanes result(area.y1 - area.y0, area.x1 - area.x0);
    if (result.planes.size() == 0) return result;
    const Limits limits{static_cast<float>(minima.angle),
                        std::max(static_cast<float>(minima.contrast), kRoundingContrast),
                        static_cast<float>(pyramid.max_step)};
    const float damping = rounding_noise(sigma);
    const int margin = GaussianTaps(sigma).radius + pyramid.pool;
    const PyramidPlan plan = plan_levels(current, pyramid.levels, margin, area);
    FlowGuess guess = coarse_guess(previous, current, sigma, pyramid, plan);
    measure(QuadImage(previous, plan.warped[0]), current, sigma, pyramid.pool, guess,
            [&](int y, const NormalEquations& sums) {
                finish_row(sums, {guess.u(y) + margin, guess.v(y) + margin}, damping, limits,
                           area.x1 - area.x0, result.row(y));
            });
    return result;
}

}  // namespace tricue
