// SPDX-License-Identifier: MIT
#include "cues/motion/pyramid_flow.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "base/check.hpp"
#include "base/row_block.hpp"
#include "base/simd.hpp"
#include "cues/motion/detail/flow_constraints.hpp"
#include "cues/motion/detail/flow_field.hpp"
#include "cues/motion/detail/frame_rows.hpp"
#include "cues/motion/detail/gray_pyramid.hpp"
#include "cues/motion/detail/normal_equations.hpp"

namespace tricue {
namespace {

constexpr float kMaxStep = 2;  // pixels along x and y, at all levels but the last
constexpr float kMinDivisor = std::numeric_limits<float>::min();

/// The limits of valid flow at the last level.
struct Limits {
    float angle, contrast, step;
};

void require_pyramid(const FlowPyramid& pyramid) {
    if (pyramid.levels < 2 || pyramid.levels > 8) refuse("levels", "2 to 8", pyramid.levels);
    if (pyramid.pool < 0 || pyramid.pool > 16) refuse("pool", "0 to 16 pixels", pyramid.pool);
    if (!(pyramid.max_step > 0)) refuse("max_step", "a number above 0", pyramid.max_step);
}

/// The contrast (6) of the mean of two frames that are only rounding noise, variance 1/12 each: by the integral of the squared
/// filters.
float rounding_noise(double sigma) {
    constexpr double kPi = 3.14159265358979323846;
    return static_cast<float>(1 / (48 * kPi * std::pow(sigma, 6)));
}

/// What is the same at every level: the filters of constraints, the windows' radius, and the damping of their equations.
struct FlowFilters {
    FlowFilters(double sigma, int windows) : taps(sigma), pool(windows), damping(rounding_noise(sigma)) {}

    int margin() const { return taps.radius + pool; }  ///< pixels around an area that are read in it

    GaussianTaps taps;
    int pool;
    float damping;
};

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

/// The inputs for solving a row: means down the columns of windows `side` pixels wide, and the flow so far.
struct StepRow {
    NormalEquations columns;
    const float *u, *v;
    int side;
};

/// The destination of a row's flow at a coarse level.
struct CoarseRow {
    float *u, *v;
};

/// n is a number of blocks. kSide is the window's side, or 0 for any.
template <int kBytes, int kSide>
TRICUE_INLINE void add_steps_by(const StepRow& row, float damping, int n, const CoarseRow& out) {
    const StepRow from = row;
    float *us = out.u, *vs = out.v;
    for (int x0 = 0; x0 < n; x0 += kRowBlock) {
        MeanBlock sums;
        average_across<kBytes>(from.columns, kSide > 0 ? kSide : from.side, x0, sums);
        // the rows don't overlap
        TRICUE_INDEPENDENT
        for (int x = 0; x < kRowBlock; ++x) {
            Step step;
            solve(sums.xx[x], sums.xy[x], sums.yy[x], sums.xt[x], sums.yt[x], damping, step);
            const float u = step.u < kMaxStep ? step.u : kMaxStep;
            const float v = step.v < kMaxStep ? step.v : kMaxStep;
            us[x0 + x] = from.u[x0 + x] + (u > -kMaxStep ? u : -kMaxStep);
            vs[x0 + x] = from.v[x0 + x] + (v > -kMaxStep ? v : -kMaxStep);
        }
    }
}

/// For `count` rows.
template <int kBytes>
TRICUE_INLINE void add_steps_of(const StepRow* rows, int count, float damping, int n, const CoarseRow* out) {
    for (int i = 0; i < count; ++i)
        if (rows[i].side == kDefaultFlowSide)
            add_steps_by<kBytes, kDefaultFlowSide>(rows[i], damping, n, out[i]);
        else
            add_steps_by<kBytes, 0>(rows[i], damping, n, out[i]);
}

TRICUE_MULTIWIDTH(add_steps, add_steps_of,
                  (const StepRow* rows, int count, float damping, int n, const CoarseRow* out),
                  (rows, count, damping, n, out))

/// The block from x0 on, of which `count` pixels are in the result.
template <int kBytes, int kSide>
TRICUE_INLINE void finish_block(const StepRow& row, float damping, const Limits& least, int x0, int count,
                                const FlowRow& out) {
    MeanBlock sums;
    average_across<kBytes>(row.columns, kSide > 0 ? kSide : row.side, x0, sums);
    const float *u0 = row.u + x0, *v0 = row.v + x0;
    float *us = out.u + x0, *vs = out.v + x0, *angles = out.angle + x0, *contrasts = out.contrast + x0;
    // the rows don't overlap
    TRICUE_INDEPENDENT
    for (int x = 0; x < count; ++x) {
        Step step;
        solve(sums.xx[x], sums.xy[x], sums.yy[x], sums.xt[x], sums.yt[x], damping, step);
        const float contrast = sums.xx[x] + sums.yy[x];
        const float size = contrast > kMinDivisor ? contrast : kMinDivisor;
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

/// In blocks; the last one may begin earlier, because the planes have no room beyond their rows.
template <int kBytes, int kSide>
TRICUE_INLINE void finish_row_by(const StepRow& row, float damping, const Limits& limits, int n,
                                 const FlowRow& to) {
    const StepRow from = row;
    const Limits least = limits;
    const FlowRow out = to;
    if (n < kRowBlock) return finish_block<kBytes, kSide>(from, damping, least, 0, n, out);
    for (int x = 0; x < n; x += kRowBlock)
        finish_block<kBytes, kSide>(from, damping, least, std::min(x, n - kRowBlock), kRowBlock, out);
}

/// For `count` rows.
template <int kBytes>
TRICUE_INLINE void finish_rows_by(const StepRow* rows, int count, float damping, const Limits& limits, int n,
                                  const FlowRow* out) {
    for (int i = 0; i < count; ++i)
        if (rows[i].side == kDefaultFlowSide)
            finish_row_by<kBytes, kDefaultFlowSide>(rows[i], damping, limits, n, out[i]);
        else
            finish_row_by<kBytes, 0>(rows[i], damping, limits, n, out[i]);
}

TRICUE_MULTIWIDTH(finish_rows, finish_rows_by,
                  (const StepRow* rows, int count, float damping, const Limits& limits, int n,
                   const FlowRow* out),
                  (rows, count, damping, limits, n, out))

/// Calls done(y, rows, count) for `count` rows from y on, a batch or fewer, until all of the guess's area are done, after
/// compare(y, here, n, out) has compared each row y of `now` with the previous frame.
template <typename Compare, typename Done>
void measure(const ImageView& now, const FlowFilters& filters, FlowGuess& guess, const Compare& compare,
             const Done& done) {
    const auto [x0, y0, x1, y1] = guess.area();
    const int width = x1 - x0, height = y1 - y0;
    const int pool = filters.pool, radius = filters.taps.radius, margin = filters.margin();
    ConstraintRows constraints(filters.taps, width + 2 * pool);
    NormalEquationRows equations(pool, width);
    const int length = whole_blocks(width + 2 * margin);
    FrameRows here(now, x0 - margin, length);
    for (int y = -margin; y < height + margin; y += kRowBatch) {
        const int end = std::min(y + kRowBatch, height + margin);
        for (int row = y; row < end; ++row) {
            guess.advance(row);
            compare(row, here.row(y0 + row), length, {constraints.mean(row), constraints.change(row)});
        }
        constraints.push(y, end);
        std::array<NormalEquations, kRowBatch> products;
        const int first = std::max(y - radius, -pool);
        for (int row = first; row < end - radius; ++row)
            products[static_cast<std::size_t>(row - first)] = equations.row(row);
        constraints.multiply(first, end - radius - first, products.data());
        const int solved = std::max(y - margin, 0);
        equations.average_down(solved, end - margin);
        std::array<StepRow, kRowBatch> steps;
        for (int row = solved; row < end - margin; ++row)
            steps[static_cast<std::size_t>(row - solved)] = {equations.means_down(row), guess.u(row) + margin,
                                                             guess.v(row) + margin, 2 * pool + 1};
        if (solved < end - margin) done(solved, steps.data(), end - margin - solved);
    }
}

/// The same at the coarsest level, where there is no flow yet.
template <typename Done>
void measure_still(const ImageView& before, const ImageView& now, const FlowFilters& filters,
                   FlowGuess& guess, const Done& done) {
    const Region& area = guess.area();
    const int margin = filters.margin();
    FrameRows there(before, area.x0 - margin, whole_blocks(area.x1 - area.x0 + 2 * margin));
    measure(
        now, filters, guess,
        [&](int y, const std::uint8_t* here, int n, const ComparedRow& out) {
            compare_rows(there.row(area.y0 + y), here, n, out);
        },
        done);
}

/// The same with `before` warped by the guess; it holds all pixels that the guess leads to.
template <typename Done>
void measure_warped(const QuadImage& before, const ImageView& now, const FlowFilters& filters,
                    FlowGuess& guess, const Done& done) {
    const Region& area = guess.area();
    const int margin = filters.margin();
    measure(
        now, filters, guess,
        [&](int y, const std::uint8_t* here, int n, const ComparedRow& out) {
            before.compare_row(area.y0 + y, area.x0 - margin, {guess.u(y), guess.v(y)}, here, n, out);
        },
        done);
}

/// The regions of each level, the first level first.
struct PyramidPlan {
    std::vector<Region> areas;   ///< the regions that are measured
    std::vector<Region> warped;  ///< the pixels to which the flow may lead from these
    std::vector<Region> stored;  ///< of coarser levels: with those that the next level and interpolation read
};

Region expanded(const Region& region, int reach, const ImageView& image) {
    return Region{region.x0 - reach, region.y0 - reach, region.x1 + reach, region.y1 + reach}.clipped(image);
}

/// The error of a guess is at most twice the sum of the coarser level's error and its step.
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
    int guessed = 0;  // largest displacement of a guess, pixels
    plan.warped.resize(sizes.size());
    plan.stored.resize(sizes.size());
    for (std::size_t k = sizes.size(); k-- > 0;) {
        plan.warped[k] = expanded(plan.areas[k], margin + guessed + 1, sizes[k]);  // 1 for rounding
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
FlowGuess coarse_guess(const ImageView& previous, const ImageView& current, const FlowFilters& filters,
                       const PyramidPlan& plan) {
    const std::vector<Region>& areas = plan.areas;
    const std::vector<Region> coarser(plan.stored.begin() + 1, plan.stored.end());
    const auto before = coarser_levels(previous, coarser), now = coarser_levels(current, coarser);
    FlowGuess guess(areas.back(), filters.margin());
    for (std::size_t i = now.size(); i > 0; --i) {
        FlowField flow(areas[i]);
        const ImageView first = before[i - 1].view(), second = now[i - 1].view();
        const auto add = [&](int y, const StepRow* rows, int count) {
            std::array<CoarseRow, kRowBatch> out;
            for (int k = 0; k < count; ++k)
                out[static_cast<std::size_t>(k)] = {flow.u.row(y + k), flow.v.row(y + k)};
            add_steps(rows, count, filters.damping, whole_blocks(flow.u.cols), out.data());
        };
        if (i == now.size())
            measure_still(first, second, filters, guess, add);
        else
            measure_warped(QuadImage(first, plan.warped[i]), second, filters, guess, add);
        guess = FlowGuess(flow, areas[i - 1], filters.margin());
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
    const FlowFilters filters(sigma, pyramid.pool);
    const PyramidPlan plan = plan_levels(current, pyramid.levels, filters.margin(), area);
    FlowGuess guess = coarse_guess(previous, current, filters, plan);
    measure_warped(QuadImage(previous, plan.warped[0]), current, filters, guess,
                   [&](int y, const StepRow* rows, int count) {
                       std::array<FlowRow, kRowBatch> out;
                       for (int k = 0; k < count; ++k) out[static_cast<std::size_t>(k)] = result.row(y + k);
                       finish_rows(rows, count, filters.damping, limits, area.x1 - area.x0, out.data());
                   });
    return result;
}

}  // namespace tricue
