// SPDX-License-Identifier: MIT
#include "cues/stereo/gradient_disparity.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "base/check.hpp"
#include "base/row_block.hpp"
#include "base/simd.hpp"
#include "cues/stereo/detail/gradient_level.hpp"

namespace tricue {
namespace {

constexpr int kMaxSide = 16384;
constexpr double kMaxCoarseStep = 1.5;  // the most that a coarse level changes, in its own pixels
constexpr float kRidge = 0.01F;         // (gray levels / px²)²: with less contrast, d0 hardly changes
constexpr float kMinPower = 1e-6F;      // (gray levels / px)²: makes the residual 0 without any power
/// Pixels that are measured at once, so that the coarser levels stay in the cache.
constexpr int kBandPixels = 65536;
constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

void require_between(double value, double least, double most, const char* name, const char* range) {
    if (!(value >= least && value <= most)) refuse(name, range, value);
}

void require_arguments(const ImageView& left, const ImageView& right, double predicted,
                       const GradientMatching& matching, const Region& region) {
    const auto size = [](const ImageView& image) { return shape_text(image.rows, image.cols); };
    if (left.rows < 1 || left.cols < 1) refuse("left", "at least one pixel", "none");
    if (size(left) != size(right)) refuse("right", "the left image's shape " + size(left), size(right));
    require_count(matching.levels, 1, 6, "levels");
    require_count(matching.radius, 0, 7, "radius");
    const auto in_range = [](int begin, int end) {
        return begin < end && std::int64_t{end} - begin <= kMaxSide;
    };
    if (!in_range(region.x0, region.x1) || !in_range(region.y0, region.y1))
        refuse("region", "x0 < x1 and y0 < y1, at most 16384 apart",
               "(" + std::to_string(region.x0) + ", " + std::to_string(region.y0) + ", " +
                   std::to_string(region.x1) + ", " + std::to_string(region.y1) + ")");
    require_between(predicted, -kMaxSide, kMaxSide, "disparity", "-16384 to 16384");
    require_between(matching.sigma, 0.5, 6.0, "sigma", "0.5 to 6");
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    const char* positive = "a number that isn't negative";
    require_between(matching.min_reliability, 0.0, kInfinity, "min_reliability", positive);
    require_between(matching.max_residual, 0.0, kInfinity, "max_residual", positive);
    require_between(matching.max_step, 0.0, kInfinity, "max_step", positive);
}

/// n is a number of blocks. kSide is the window's side, or 0 for any.
template <int kBytes, int kSide>
TRICUE_INLINE void refine_by(const WindowColumns& row, const float* __restrict offset, int n,
                             float* __restrict next) {
    constexpr auto kMaxStep = static_cast<float>(kMaxCoarseStep);
    const WindowColumns columns = row;
    const int side = kSide > 0 ? kSide : columns.side;
    for (int x0 = 0; x0 < n; x0 += kRowBlock) {
        WindowMeans means;
        mean_of<kBytes>(columns, 0, side, x0, means.ss);
        mean_of<kBytes>(columns, 1, side, x0, means.st);
        for (int x = 0; x < kRowBlock; ++x) {
            const float known = offset[x0 + x];
            const float step = (means.st[x] - means.ss[x] * known) / (means.ss[x] + kRidge);
            next[x0 + x] = known + std::min(std::max(step, -kMaxStep), kMaxStep);
        }
    }
}

template <int kBytes>
TRICUE_INLINE void refine_rows_by(const LevelRow* rows, int count, int n, float* const* next) {
    for (int i = 0; i < count; ++i)
        if (rows[i].columns.side == kDefaultDisparitySide)
            refine_by<kBytes, kDefaultDisparitySide>(rows[i].columns, rows[i].known.offset, n, next[i]);
        else
            refine_by<kBytes, 0>(rows[i].columns, rows[i].known.offset, n, next[i]);
}

/// Adds the step of each pixel to its offset, at a coarse level, in `count` rows.
TRICUE_MULTIWIDTH(refine, refine_rows_by, (const LevelRow* rows, int count, int n, float* const* next),
                  (rows, count, n, next))

struct Limits {
    float base, min_reliability, max_residual, max_step;
};

/// The destination of a row of the result.
struct ResultRow {
    float *disparity, *reliability;
};

/// The block from x0 on, of which `count` pixels are in the result.
template <int kBytes, int kSide>
TRICUE_INLINE void finalize_block(const WindowColumns& columns, const WarpedRow& known, const Limits& most,
                                  int x0, int count, const ResultRow& out) {
    const int side = kSide > 0 ? kSide : columns.side;
    WindowMeans means;
    mean_of<kBytes>(columns, 0, side, x0, means.ss);
    mean_of<kBytes>(columns, 1, side, x0, means.st);
    mean_of<kBytes>(columns, 2, side, x0, means.tt);
    mean_of<kBytes>(columns, 3, side, x0, means.power);
    mean_of<kBytes>(columns, 4, side, x0, means.reliability);
    const float *offset = known.offset + x0, *visible = known.visible + x0;
    float *disparity = out.disparity + x0, *reliability = out.reliability + x0;
    TRICUE_INDEPENDENT
    for (int x = 0; x < count; ++x) {
        const float ss = means.ss[x], st = means.st[x];
        const float step = (st - ss * offset[x]) / (ss + kRidge), d = offset[x] + step;
        const float left_over = means.tt[x] - 2.0F * d * st + d * d * ss;
        const bool kept = (visible[x] != 0.0F) & (means.reliability[x] >= most.min_reliability) &
                          (left_over <= most.max_residual * (means.power[x] + kMinPower)) &
                          (std::abs(step) <= most.max_step);
        disparity[x] = kept ? most.base + d : kNone;
        reliability[x] = means.reliability[x];
    }
}

/// In blocks; the last one may begin earlier, because the result has no room beyond its rows.
template <int kBytes, int kSide>
TRICUE_INLINE void finalize_by(const WindowColumns& row, const WarpedRow& known, const Limits& limits, int n,
                               const ResultRow& to) {
    const WindowColumns columns = row;
    const WarpedRow at = known;
    const Limits most = limits;
    const ResultRow out = to;
    if (n < kRowBlock) return finalize_block<kBytes, kSide>(columns, at, most, 0, n, out);
    for (int x = 0; x < n; x += kRowBlock)
        finalize_block<kBytes, kSide>(columns, at, most, std::min(x, n - kRowBlock), kRowBlock, out);
}

template <int kBytes>
TRICUE_INLINE void finalize_rows_by(const LevelRow* rows, int count, const Limits& limits, int n,
                                    const ResultRow* out) {
    for (int i = 0; i < count; ++i)
        if (rows[i].columns.side == kDefaultDisparitySide)
            finalize_by<kBytes, kDefaultDisparitySide>(rows[i].columns, rows[i].known, limits, n, out[i]);
        else
            finalize_by<kBytes, 0>(rows[i].columns, rows[i].known, limits, n, out[i]);
}

/// For `count` rows.
TRICUE_MULTIWIDTH(finalize, finalize_rows_by,
                  (const LevelRow* rows, int count, const Limits& limits, int n, const ResultRow* out),
                  (rows, count, limits, n, out))

struct Level {
    LevelRegions parts;
    int base;
    double predicted;
    GrayPlane left, right;
};

Region bounding_region(const Region& one, const Region& other) {
    return {std::min(one.x0, other.x0), std::min(one.y0, other.y0), std::max(one.x1, other.x1),
            std::max(one.y1, other.y1)};
}

/// The regions that must be measured at each level, the finest level first.
std::vector<Level> plan_levels(const Region& visible, int rows, int cols, double predicted, int reach,
                               const GradientMatching& matching) {
    std::vector<Level> levels;
    Region wanted = visible;
    double uncertainty = 0.0;  // of all coarser levels together, in pixels of this one
    for (int k = 1; k < matching.levels; ++k) uncertainty += std::ldexp(kMaxCoarseStep, k);
    for (int k = 0; k < matching.levels; ++k) {
        const LevelRegions parts =
            find_level_regions(wanted, rows, cols, matching.radius, reach, predicted, uncertainty);
        levels.push_back({parts, static_cast<int>(std::floor(predicted + 0.5)), predicted, {}, {}});
        const Region& under = parts.pooled;
        wanted = {under.x0 / 2, under.y0 / 2, (under.x1 + 1) / 2, (under.y1 + 1) / 2};
        rows = (rows + 1) / 2;
        cols = (cols + 1) / 2;
        predicted /= 2.0;
        uncertainty = std::max(uncertainty / 2.0 - kMaxCoarseStep, 0.0);
    }
    return levels;
}

/// One image's pyramid. The parts that filters read grow by the sources of the next coarser level, which the second level reads in
/// the image itself.
void build_pyramid(const ImageView& image, std::vector<Level>& levels, Region LevelRegions::* part,
                   GrayPlane Level::* plane) {
    std::vector<Region> parts;
    for (const Level& level : levels) parts.push_back(level.parts.*part);
    const auto size = [](int full, std::size_t k) { return ((full - 1) >> k) + 1; };
    for (std::size_t k = levels.size() - 1; k > 1; --k)
        parts[k - 1] = bounding_region(
            parts[k - 1], downsample_source(parts[k], size(image.rows, k - 1), size(image.cols, k - 1)));
    levels[0].*plane = gray_plane(image, parts[0]);
    for (std::size_t k = 1; k < levels.size(); ++k)
        levels[k].*plane =
            k == 1 ? downsampled(image, parts[k]) : downsampled(levels[k - 1].*plane, parts[k]);
}

DisparityPrior prior_for(const Level& level, const Level* coarser, const GrayPlane& found) {
    if (coarser == nullptr) return {level.base, static_cast<float>(level.predicted - level.base), nullptr};
    return {level.base, static_cast<float>(2 * coarser->base - level.base), &found};
}

Limits limits_of(const GradientMatching& matching, int base) {
    const float any = std::numeric_limits<float>::infinity();
    const float most_left = matching.radius > 0 ? static_cast<float>(matching.max_residual) : any;
    return {static_cast<float>(base), static_cast<float>(matching.min_reliability), most_left,
            static_cast<float>(matching.max_step)};
}

/// Measures `visible`, a nonempty part of the left image; result(y) is the destination of its rows.
template <typename Result>
void measure(const ImageView& left, const ImageView& right, double predicted,
             const GradientMatching& matching, const Region& visible, const Result& result) {
    const GaussianDerivative filter(matching.sigma);
    auto levels = plan_levels(visible, left.rows, left.cols, predicted, filter.reach, matching);
    build_pyramid(left, levels, &LevelRegions::left, &Level::left);
    build_pyramid(right, levels, &LevelRegions::right, &Level::right);
    GrayPlane found;
    for (std::size_t k = levels.size(); k-- > 0;) {
        const Level& level = levels[k];
        const Region& wanted = level.parts.wanted;
        const int n = wanted.x1 - wanted.x0;
        const Level* coarser = k + 1 < levels.size() ? &levels[k + 1] : nullptr;
        GradientLevel rows(level.left, level.right, level.parts, filter, matching.radius,
                           prior_for(level, coarser, found), k == 0);
        if (k > 0) {
            GrayPlane next(wanted, level.left.rows(), level.left.cols());
            rows.run([&](int y, const LevelRow* done, int count) {
                std::array<float*, kRowBatch> out;
                for (int i = 0; i < count; ++i)
                    out[static_cast<std::size_t>(i)] = next.row(y + i) + wanted.x0;
                refine(done, count, whole_blocks(n), out.data());
            });
            found = std::move(next);
            continue;
        }
        const Limits limits = limits_of(matching, level.base);
        rows.run([&](int y, const LevelRow* done, int count) {
            std::array<ResultRow, kRowBatch> out;
            for (int i = 0; i < count; ++i) out[static_cast<std::size_t>(i)] = result(y + i);
            finalize(done, count, limits, n, out.data());
        });
    }
}

}  // namespace

Floats gradient_disparity(const ImageView& left, const ImageView& right, double predicted,
                          const GradientMatching& matching, const Region& region) {
    require_arguments(left, right, predicted, matching, region);
    const int height = region.y1 - region.y0, width = region.x1 - region.x0;
    Floats result(2 * height, width);
    const Region visible = region.clipped(left);
    if (visible.x1 - visible.x0 < width || visible.y1 - visible.y0 < height) {
        result.topRows(height) = kNone;
        result.bottomRows(height) = 0.0F;
    }
    if (visible.x0 >= visible.x1 || visible.y0 >= visible.y1) return result;
    const int j = visible.x0 - region.x0;
    const auto row = [&](int y) {
        return ResultRow{&result(y - region.y0, j), &result(height + y - region.y0, j)};
    };
    const int band = std::max(kBandPixels / width, 32);
    for (int y = visible.y0; y < visible.y1; y += band)
        measure(left, right, predicted, matching, {visible.x0, y, visible.x1, std::min(y + band, visible.y1)},
                row);
    return result;
}

}  // namespace tricue
