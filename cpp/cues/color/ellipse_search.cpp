// SPDX-License-Identifier: MIT
#include "cues/color/ellipse_search.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <vector>

#include "base/check.hpp"
#include "base/simd.hpp"
#include "cues/color/detail/histogram_sum.hpp"
#include "cues/color/detail/sliding_histogram.hpp"

namespace tricue {
namespace {

using Counts = std::vector<std::int32_t>;

/// Rounds n M_i to integers.
TRICUE_MULTIVERSION
void set_targets(const double* __restrict shares, std::size_t n, double units,
                 std::int32_t* __restrict targets) {
    for (std::size_t i = 0; i < n; ++i) targets[i] = static_cast<std::int32_t>(shares[i] * units + 0.5);
}

struct Sums {
    std::int32_t inside, around;
};

/// Σ min(C_i, n M_i) of ellipse and ring; the ring is the larger ellipse minus the ellipse.
TRICUE_MULTIVERSION
Sums intersect(const std::int32_t* __restrict inner, const std::int32_t* __restrict outer, std::size_t n,
               const std::int32_t* __restrict inside, const std::int32_t* __restrict around) {
    std::int32_t first = 0, second = 0;
    for (std::size_t i = 0; i < n; ++i) {
        first += std::min(inner[i], inside[i]);
        second += std::min(outer[i] - inner[i], around[i]);
    }
    return {first, second};
}

/// By how much the number of marked pixels under a shape changes with each of n steps to the right; `masked` is at its center.
TRICUE_MULTIVERSION
void count_steps(const std::uint8_t* masked, const SlidingHistogram::Boundary& boundary, int n,
                 std::int32_t* more) {
    constexpr int kLanes = static_cast<int>(CompactBins::kMaskPadding);
    const std::int32_t *leave = boundary.leave.data(), *enter = boundary.enter.data();
    const std::size_t rows = boundary.leave.size();
    for (int x = 0; x < n; x += kLanes) {
        Pack<std::int16_t, kLanes> sum{}, in, out;
        Pack<std::uint8_t, kLanes> bytes;
        for (std::size_t k = 0; k < rows; ++k) {
            load(masked + enter[k] + x, bytes);
            convert(bytes, in);
            load(masked + leave[k] + x, bytes);
            convert(bytes, out);
            sum += in - out;
        }
        for (int i = 0; i < std::min(kLanes, n - x); ++i) more[x + i] = sum[i];
    }
}

/// The pixels that a mask marks under a shape, at all places of a row of the grid at once.
class MaskedCounts {
public:
    /// @param start the offset of the pixel that the shape is relative to
    /// @param steps to the right
    MaskedCounts(const EllipseShape& shape, const SlidingHistogram& moves, const CompactBins& image,
                 std::ptrdiff_t start, int steps)
        : moves_(moves), image_(image), center_(start), counts_(static_cast<std::size_t>(steps) + 1) {
        if (image_.masked.empty()) return;
        const std::uint8_t* row = image.masked.data() + start + std::ptrdiff_t{shape.top} * image.cols;
        for (const auto& run : shape.runs) {
            first_ = std::accumulate(row + run.begin, row + run.end, first_);
            row += image.cols;
        }
        count_row();
    }

    void move_down(int steps) {
        if (image_.masked.empty()) return;
        const auto& [leave, enter] = moves_.vertical();
        for (; steps > 0; --steps, center_ += image_.cols) {
            const std::uint8_t* masked = image_.masked.data() + center_;
            for (std::size_t k = 0; k < leave.size(); ++k) first_ += masked[enter[k]] - masked[leave[k]];
        }
        count_row();
    }

    /// The number of pixels after so many steps to the right.
    std::int32_t at(int steps) const { return counts_[static_cast<std::size_t>(steps)]; }

private:
    void count_row() {
        counts_[0] = first_;
        count_steps(image_.masked.data() + center_, moves_.horizontal(), static_cast<int>(counts_.size()) - 1,
                    counts_.data() + 1);
        std::partial_sum(counts_.begin(), counts_.end(), counts_.begin());
    }

    const SlidingHistogram& moves_;
    const CompactBins& image_;
    std::ptrdiff_t center_;
    std::int32_t first_ = 0;
    Counts counts_;
};

/// Equation (1) and the share of masked pixels, of the ellipse and of the ring.
class Scorer {
public:
    Scorer(const CompactBins& image, std::int32_t unit)
        : shares_(image.shares), unit_(unit), inside_(shares_.size()), around_(shares_.size()) {}

    /// @param marked_inside, marked_both masked pixels of the ellipse, and of ellipse and ring
    void score(const SlidingHistogram& inner, const SlidingHistogram& outer, std::int32_t marked_inside,
               std::int32_t marked_both, double* out) {
        update_targets(inner.visible(), units_inside_, inside_);
        update_targets(outer.visible() - inner.visible(), units_around_, around_);
        const Sums sums =
            intersect(inner.counts(), outer.counts(), inside_.size(), inside_.data(), around_.data());
        const auto share = [](double part, double whole) { return whole > 0.0 ? part / whole : 0.0; };
        out[0] = share(sums.inside, units_inside_);
        out[1] = share(sums.around, units_around_);
        out[2] = share(unit_ * marked_inside, units_inside_);
        out[3] = share(unit_ * (marked_both - marked_inside), units_around_);
    }

private:
    /// The number of pixels changes only at the border of the image.
    void update_targets(std::int32_t visible, std::int32_t& units, Counts& targets) {
        if (visible == units) return;
        units = visible;
        set_targets(shares_.data(), targets.size(), units, targets.data());
    }

    const std::vector<double>& shares_;
    std::int32_t unit_, units_inside_ = 0, units_around_ = 0;
    Counts inside_, around_;
};

/// All pixels that a shape covers at the positions of the grid, relative to the image.
Region covered_area(const EllipseShape& shape, const CenterPixel& place, const SearchGrid& grid) {
    const auto [begin, end] = shape.column_range();
    return swept_region({place.x + begin, place.y + shape.top, place.x + end, place.y + shape.bottom()},
                        grid);
}

/// The largest power of two whose product with a shape's number of pixels fits 31 bits.
std::int32_t find_unit(const EllipseShape& shape) {
    std::int32_t unit = 1;
    while (unit <= std::numeric_limits<std::int32_t>::max() / 2 / std::max(shape.area, 1)) unit *= 2;
    return unit;
}

/// Visits every position, to the right in even rows and to the left in odd ones, moving one pixel at a time.
template <typename Visit, typename Move>
void walk(const SearchGrid& grid, Visit visit, Move move) {
    const auto repeat = [&](auto direction) {
        for (int pixel = 0; pixel < grid.step; ++pixel) move(direction);
    };
    for (int row = 0; row < grid.rows; ++row) {
        if (row > 0) repeat(&SlidingHistogram::move_down);
        const bool rightward = row % 2 == 0;
        for (int k = 0; k < grid.cols; ++k) {
            if (k > 0) repeat(rightward ? &SlidingHistogram::move_right : &SlidingHistogram::move_left);
            visit(row, rightward ? k : grid.cols - 1 - k);
        }
    }
}

}  // namespace

States ellipse_search(const BinsView& bins, VectorRef ellipse, const SearchGrid& grid,
                      const SearchModel& model, const ImageView& mask) {
    require_ellipse(ellipse, model.margin);
    require_grid(grid);
    const double total = require_histogram_sum(model.histogram, "model");
    require_bins(bins, model.histogram.size());

    require_mask(mask, bins);

    States found = States::Zero(Eigen::Index{grid.rows} * grid.cols, 4);
    const EllipseShape shape(ellipse.data(), 1.0), larger(ellipse.data(), model.margin);
    const Region area = covered_area(larger, CenterPixel(ellipse.data()), grid);
    const Region visible = area.clipped({nullptr, bins.rows, bins.cols, 1, 0});
    if (visible.x0 >= visible.x1 || visible.y0 >= visible.y1) return found;

    const CompactBins image(bins, model.histogram, total, mask, area);
    const std::ptrdiff_t corner = -larger.top * std::ptrdiff_t{image.cols} - larger.column_range().begin;
    const std::int32_t unit = find_unit(larger);
    SlidingHistogram inner(shape, image, corner, unit), outer(larger, image, corner, unit);
    Scorer scorer(image, unit);
    const int steps = (grid.cols - 1) * grid.step;
    MaskedCounts marked(shape, inner, image, corner, steps),
        marked_larger(larger, outer, image, corner, steps);
    int last_row = 0;
    walk(
        grid,
        [&](int row, int col) {
            if (row != last_row) {
                marked.move_down(grid.step);
                marked_larger.move_down(grid.step);
                last_row = row;
            }
            scorer.score(inner, outer, marked.at(col * grid.step), marked_larger.at(col * grid.step),
                         found.row(row * grid.cols + col).data());
        },
        [&](void (SlidingHistogram::*move)()) {
            (inner.*move)();
            (outer.*move)();
        });
    return found;
}

}  // namespace tricue
