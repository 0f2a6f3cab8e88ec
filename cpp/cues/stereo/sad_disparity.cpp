// SPDX-License-Identifier: MIT
#include "cues/stereo/sad_disparity.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "base/check.hpp"
#include "cues/stereo/detail/block_matching.hpp"
#include "cues/stereo/detail/disparity_rows.hpp"
#include "cues/stereo/detail/ellipse_rows.hpp"
#include "cues/stereo/detail/stereo_rows.hpp"

namespace tricue {
namespace {

constexpr int kMaxSide = 16384, kMaxCandidates = 4096;
constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

using Costs = std::vector<std::uint16_t>;

void require_between(int value, int least, int most, const char* name) {
    if (value < least || value > most)
        refuse(name, std::to_string(least) + " to " + std::to_string(most), value);
}

void require_arguments(const ImageView& left, const ImageView& right, const StereoRegion& region,
                       const DisparityRange& range, const StereoMatching& matching) {
    const auto size = [](const ImageView& image) {
        return "(" + std::to_string(image.rows) + ", " + std::to_string(image.cols) + ")";
    };
    if (left.rows < 1 || left.cols < 1) refuse("left", "at least one pixel", "none");
    if (size(left) != size(right)) refuse("right", "the left image's shape " + size(left), size(right));
    const auto [x0, y0, x1, y1] = region.place;
    const auto width = std::int64_t{x1} - x0, height = std::int64_t{y1} - y0;
    if (std::min(width, height) < 1 || std::max(width, height) > kMaxSide)
        refuse("region", "a width and height of 1 to 16384",
               std::to_string(width) + " x " + std::to_string(height));
    if (range.first > range.last)
        refuse("last", "at least first, " + std::to_string(range.first), range.last);
    if (std::int64_t{range.last} - range.first >= kMaxCandidates)
        refuse("last", "at most 4095 above first, " + std::to_string(range.first), range.last);
    const int widest = matching.prefilter ? 31 : 15;
    if (matching.window < 1 || matching.window > widest || matching.window % 2 == 0)
        refuse("window", "an odd number, 1 to " + std::to_string(widest), matching.window);
    require_between(matching.uniqueness, 0, 100, "uniqueness");
}

/// Matches the part of a region that the left image shows, `seen`, not empty, row by row. Each candidate lies in the right image for
/// some pixel.
class Matcher {
public:
    Matcher(const ImageView& left, const ImageView& right, const Region& seen, const DisparityRange& range,
            const StereoMatching& matching)
        : seen_(seen),
          window_(matching.window),
          candidates_(range.last - range.first + 1),
          width_(seen.x1 - seen.x0),
          limit_(matching.prefilter ? StereoRows::kClip : 255),
          left_(left, compared(0, 0), matching.prefilter, kMatchPadding),
          right_(right, compared(-range.last, -range.first), matching.prefilter, kMatchPadding),
          stride_((width_ + window_ + 2 * kMatchPadding - 1) / kMatchPadding * kMatchPadding),
          sums_(static_cast<std::size_t>(stride_ * candidates_ + kMatchPadding)),
          blank_(static_cast<std::size_t>(stride_ + candidates_)),
          first_column_(seen.x0 - range.last),
          columns_(right.cols),
          outside_(blank_.size(), kNoCost) {
        const int size = static_cast<int>(outside_.size());
        std::fill(outside_.begin() + std::clamp(-first_column_, 0, size),
                  outside_.begin() + std::clamp(columns_ - first_column_, 0, size), std::uint16_t{0});
        for (auto& costs : costs_) costs.resize(static_cast<std::size_t>(width_ + kMatchPadding));
    }

    /// Calls done(y, x0, x1, matches) for each row, [x0, x1) being span(y) as far as it is seen, where that is something.
    template <typename Span, typename Done>
    void run(bool second, const Span& span, const Done& done) {
        const ColumnSums sums{aligned(sums_), stride_, candidates_};
        const Matches matches{costs_[0].data(), costs_[1].data(), costs_[2].data(), costs_[3].data(),
                              costs_[4].data()};
        const RowPair blank{blank_.data(), blank_.data() + candidates_ - 1};
        const int radius = window_ / 2, top = seen_.y0 - radius;
        for (int y = top; y < seen_.y1 + radius; ++y) {
            move_down(rows(y), y - window_ < top ? blank : rows(y - window_), width_ + window_ - 1, limit_,
                      sums);
            if (y - radius < seen_.y0) continue;
            const auto [begin, end] = span(y - radius);
            const int x0 = std::max(begin, seen_.x0), x1 = std::min(end, seen_.x1);
            if (x0 >= x1) continue;
            find_matches({sums.data + (x0 - seen_.x0), stride_, candidates_}, search(x0, x1, second), x1 - x0,
                         matches);
            done(y - radius, x0, x1, matches);
        }
    }

private:
    /// Where a cache line begins: registers that reach over the end of one take twice as long to store.
    static std::uint16_t* aligned(Costs& costs) {
        void* begin = costs.data();
        std::size_t room = costs.size() * sizeof costs[0];
        return static_cast<std::uint16_t*>(std::align(2 * kMatchPadding, 1, begin, room));
    }

    Region compared(int more_left, int more_right) const {
        const int radius = window_ / 2;
        return {seen_.x0 - radius + more_left, seen_.y0 - radius, seen_.x1 + radius + more_right,
                seen_.y1 + radius};
    }

    RowPair rows(int y) const { return {left_.row(y), right_.row(y) + candidates_ - 1}; }

    Search search(int x0, int x1, bool second) const {
        const int last = first_column_ + x0 - seen_.x0, first = last + candidates_ - 1;  // where x0 may be
        const bool inside = last >= 0 && first + x1 - x0 <= columns_;
        return {window_, second, inside, outside_.data() + (first - first_column_)};
    }

    Region seen_;
    int window_, candidates_, width_;
    std::uint8_t limit_;
    StereoRows left_, right_;
    std::ptrdiff_t stride_;
    Costs sums_;
    std::vector<std::uint8_t> blank_;
    int first_column_, columns_;  ///< of outside_ in the right image; of that
    Costs outside_;
    std::array<Costs, 5> costs_;
};

}  // namespace

Floats sad_disparity(const ImageView& left, const ImageView& right, const StereoRegion& region,
                     const DisparityRange& range, const StereoMatching& matching) {
    require_arguments(left, right, region, range, matching);
    const auto [left_end, top, right_end, bottom] = region.place;
    const int width = right_end - left_end, height = bottom - top;
    Floats disparity = Floats::Constant(height, width, kNone);
    const Region seen = region.place.clipped(left);
    const DisparityRange near{std::max(range.first, seen.x0 - (left.cols - 1)),
                              std::min(range.last, seen.x1 - 1)};
    if (seen.x0 >= seen.x1 || seen.y0 >= seen.y1 || near.first > near.last) return disparity;

    const EllipseRows ellipse{width, height};
    const auto span = [&](int y) {
        const int margin = region.ellipse ? ellipse.margin(y - region.place.y0) : 0;
        return std::pair(region.place.x0 + margin, region.place.x1 - margin);
    };
    const int candidates = near.last - near.first + 1;
    const auto uniqueness = static_cast<unsigned>(matching.uniqueness);
    Matcher matcher(left, right, seen, near, matching);
    Claims claims(seen.x0 - near.last, seen.x1 - near.first);
    matcher.run(uniqueness > 0, span, [&](int y, int x0, int x1, const Matches& matches) {
        float* row = &disparity(y - region.place.y0, x0 - region.place.x0);
        refine_matches(matches, x1 - x0, near.first, candidates, uniqueness, row);
        if (matching.tolerance >= 0) claims.check(matches, x0, x1, near.first, matching.tolerance, row);
    });
    return disparity;
}

}  // namespace tricue
