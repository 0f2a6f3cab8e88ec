// SPDX-License-Identifier: MIT
#include "cues/stereo/detail/cell_disparities.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "base/check.hpp"
#include "base/gray_cells.hpp"
#include "cues/stereo/detail/block_matching.hpp"
#include "cues/stereo/detail/disparity_refinement.hpp"
#include "cues/stereo/detail/prefiltered_rows.hpp"

namespace tricue {
namespace {

constexpr int kMaxSide = 16384, kMaxCandidates = 4096;
/// Columns times candidates matched at a time, so that their sums of costs stay in the cache.
constexpr int kMaxSums = 1 << 19, kMinColumns = 256;
constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

using Costs = std::vector<std::uint16_t>;

/// The pixels of a row whose centers lie in the ellipse inscribed in a rectangle, by integers and so the same on every machine:
/// (2 x + 1 - width)² height² + (2 y + 1 - height)² width² <= width² height², for sides up to 16384.
struct EllipseRows {
    int width, height;

    /// The number of columns outside at each end of row y; width / 2, rounded up, if all are.
    int margin(int y) const {
        const std::int64_t w = width, h = height, v = 2 * std::int64_t{y} + 1 - h;
        const std::int64_t room = (h * h - v * v) * w * w;
        const auto outside = [&](int x) {
            const std::int64_t u = 2 * std::int64_t{x} + 1 - w;
            return u * u * h * h > room;
        };
        // A close guess, then corrected exactly.
        int x = static_cast<int>(
            (1.0 - std::sqrt(static_cast<double>(h * h - v * v)) / static_cast<double>(h)) * width / 2.0);
        while (x > 0 && !outside(x - 1)) --x;
        while (2 * x < width && outside(x)) ++x;
        return x;
    }
};

void require_arguments(const CellPair& pair, const Region& place, const DisparityRange& limits,
                       const StereoMatching& matching) {
    const auto& [left, right, step] = pair;
    const auto size = [](const ImageView& image) { return shape_text(image.rows, image.cols); };
    if (left.rows < 1 || left.cols < 1) refuse("left", "at least one pixel", "none");
    if (size(left) != size(right)) refuse("right", "the left image's shape " + size(left), size(right));
    if (step < 1 || step > std::min(left.rows, left.cols))
        refuse("step", "1 to the image's smaller side", step);
    const auto [x0, y0, x1, y1] = place;
    const auto width = std::int64_t{x1} - x0, height = std::int64_t{y1} - y0;
    if (std::min(width, height) < 1 || std::max(width, height) > kMaxSide)
        refuse("region", "a width and height of 1 to 16384",
               std::to_string(width) + " x " + std::to_string(height));
    if (limits.first > limits.last)
        refuse("last", "at least first, " + std::to_string(limits.first), limits.last);
    if (std::int64_t{limits.last} - limits.first >= kMaxCandidates)
        refuse("last", "at most 4095 above first, " + std::to_string(limits.first), limits.last);
    const int widest = matching.prefilter ? 31 : 15;
    if (matching.window < 1 || matching.window > widest || matching.window % 2 == 0)
        refuse("window", "an odd number, 1 to " + std::to_string(widest), matching.window);
    require_count(matching.uniqueness, 0, 100, "uniqueness");
}

/// Matches the part of a region inside the left image, `visible`, not empty, row by row. Each candidate lies in the right image for at
/// least one pixel.
class Matcher {
public:
    Matcher(const GrayCells& left, const GrayCells& right, const Region& visible,
            const DisparityRange& limits, const StereoMatching& matching)
        : visible_(visible),
          window_(matching.window),
          candidates_(limits.last - limits.first + 1),
          width_(visible.x1 - visible.x0),
          limit_(matching.prefilter ? PrefilteredRows::kClip : 255),
          left_(left, compared(0, 0), matching.prefilter, kMatchPadding),
          right_(right, compared(-limits.last, -limits.first), matching.prefilter, kMatchPadding),
          stride_((width_ + window_ + 2 * kMatchPadding - 1) / kMatchPadding * kMatchPadding),
          sums_(static_cast<std::size_t>(stride_ * candidates_ + kMatchPadding)),
          blank_(static_cast<std::size_t>(stride_ + candidates_)),
          first_column_(visible.x0 - limits.last),
          columns_(right.cols()),
          outside_(blank_.size(), kNoCost) {
        const int size = static_cast<int>(outside_.size());
        std::fill(outside_.begin() + std::clamp(-first_column_, 0, size),
                  outside_.begin() + std::clamp(columns_ - first_column_, 0, size), std::uint16_t{0});
        costs_.resize(5 * room());
    }

    /// Calls done(y, x0, x1, matches) for each row, where [x0, x1), span(y) clipped to the image, is not empty.
    template <typename Span, typename Done>
    void run(bool second, const Span& span, const Done& done) {
        const ColumnSums sums{aligned(sums_), stride_, candidates_};
        const auto row = [&](std::size_t k) { return costs_.data() + k * room(); };
        const Matches matches{row(0), row(1), row(2), row(3), row(4)};
        const RowPair blank{blank_.data(), blank_.data() + candidates_ - 1};
        const int radius = window_ / 2, top = visible_.y0 - radius;
        for (int y = top; y < visible_.y1 + radius; ++y) {
            move_down(rows(y), y - window_ < top ? blank : rows(y - window_), width_ + window_ - 1, limit_,
                      sums);
            if (y - radius < visible_.y0) continue;
            const auto [begin, end] = span(y - radius);
            const int x0 = std::max(begin, visible_.x0), x1 = std::min(end, visible_.x1);
            if (x0 >= x1) continue;
            find_matches({sums.data + (x0 - visible_.x0), stride_, candidates_}, search(x0, x1, second),
                         x1 - x0, matches);
            done(y - radius, x0, x1, matches);
        }
    }

private:
    std::size_t room() const { return static_cast<std::size_t>(width_ + kMatchPadding); }

    /// The first cache line: stores that cross a line take twice as long.
    static std::uint16_t* aligned(Costs& costs) {
        void* begin = costs.data();
        std::size_t room = costs.size() * sizeof costs[0];
        return static_cast<std::uint16_t*>(std::align(2 * kMatchPadding, 1, begin, room));
    }

    Region compared(int more_left, int more_right) const {
        const int radius = window_ / 2;
        return {visible_.x0 - radius + more_left, visible_.y0 - radius, visible_.x1 + radius + more_right,
                visible_.y1 + radius};
    }

    RowPair rows(int y) const { return {left_.row(y), right_.row(y) + candidates_ - 1}; }

    Search search(int x0, int x1, bool second) const {
        const int last = first_column_ + x0 - visible_.x0,
                  first = last + candidates_ - 1;  // columns of the candidates of x0
        const bool inside = last >= 0 && first + x1 - x0 <= columns_;
        return {window_, second, inside, outside_.data() + (first - first_column_)};
    }

    Region visible_;
    int window_, candidates_, width_;
    std::uint8_t limit_;
    PrefilteredRows left_, right_;
    std::ptrdiff_t stride_;
    Costs sums_;
    std::vector<std::uint8_t> blank_;
    int first_column_, columns_;  ///< where outside_ begins in the right image; its width
    Costs outside_;
    Costs costs_;  ///< the rows of Matches
};

/// span(y) gives the columns [begin, end) of row y that are matched.
template <typename Span>
Floats match_rows(const CellPair& pair, const Region& place, const DisparityRange& limits,
                  const StereoMatching& matching, int tolerance, const Span& span) {
    require_arguments(pair, place, limits, matching);
    const GrayCells left(pair.left, pair.step), right(pair.right, pair.step);
    Floats disparity = Floats::Constant(place.y1 - place.y0, place.x1 - place.x0, kNone);
    const Region visible = place.clipped({nullptr, left.rows(), left.cols(), 1, 0});
    const auto in_view = [&](const Region& part) {
        return DisparityRange{std::max(limits.first, part.x0 - (left.cols() - 1)),
                              std::min(limits.last, part.x1 - 1)};
    };
    const DisparityRange visible_range = in_view(visible);
    if (visible.x0 >= visible.x1 || visible.y0 >= visible.y1 || visible_range.first > visible_range.last)
        return disparity;

    const auto uniqueness = static_cast<unsigned>(matching.uniqueness);
    const bool checked = tolerance >= 0;
    const auto match = [&](const Region& part) {
        const DisparityRange within = in_view(part);
        if (within.first > within.last) return;
        const int candidates = within.last - within.first + 1;
        Matcher matcher(left, right, part, within, matching);
        std::optional<LeftRightCheck> left_right;
        if (checked) left_right.emplace(part.x0 - within.last, part.x1 - within.first);
        matcher.run(uniqueness > 0, span, [&](int y, int x0, int x1, const Matches& matches) {
            float* row = &disparity(y - place.y0, x0 - place.x0);
            refine_matches(matches, x1 - x0, within.first, candidates, uniqueness, row);
            if (left_right) left_right->check(matches, x0, x1, within.first, tolerance, row);
        });
    };
    const int candidates = visible_range.last - visible_range.first + 1;
    // The left-right check needs whole rows.
    const int strip = checked ? visible.x1 - visible.x0 : std::max(kMaxSums / candidates, kMinColumns);
    for (int x = visible.x0; x < visible.x1; x += strip)
        match({x, visible.y0, std::min(x + strip, visible.x1), visible.y1});
    return disparity;
}

}  // namespace

Floats cell_disparities(const CellPair& pair, const StereoRegion& region, const DisparityRange& limits,
                        const StereoMatching& matching, int tolerance) {
    const Region& place = region.place;
    return match_rows(pair, place, limits, matching, tolerance, [&](int y) {
        const EllipseRows ellipse{place.x1 - place.x0, place.y1 - place.y0};
        const int margin = region.ellipse ? ellipse.margin(y - place.y0) : 0;
        return std::pair(place.x0 + margin, place.x1 - margin);
    });
}

Floats cell_disparities(const CellPair& pair, const EllipseShape& shape, const CenterPixel& center,
                        const DisparityRange& limits, const StereoMatching& matching) {
    const auto [begin, end] = shape.column_range();
    const int top = center.y + shape.top;
    const Region place{center.x + begin, top, center.x + end, center.y + shape.bottom()};
    return match_rows(pair, place, limits, matching, kNoLeftRightCheck, [&](int y) {
        const EllipseShape::Run& run = shape.runs[static_cast<std::size_t>(y - top)];
        return std::pair(center.x + run.begin, center.x + run.end);
    });
}

}  // namespace tricue
