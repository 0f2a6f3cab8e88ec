// SPDX-License-Identifier: MIT
#include "fuse/log_polar_shift.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/check.hpp"
#include "cues/color/hog_color_cells.hpp"
#include "fuse/correlation_response.hpp"

namespace tricue {
namespace {

constexpr double kMaxOffset = 0.5;    // cells; a peak farther off would be in the next cell
constexpr double kLeastShare = 0.05;  // of the maximum: lower bound for logarithms
constexpr double kMaxPenalty = std::numeric_limits<float>::max();  // infinity times 0 columns isn't a number

/// `row` has the columns from -most to most off the middle.
double peak_offset(const float* row, int column, int most) {
    const double top = row[column];
    if (column == -most || column == most || !(top > 0.0)) return 0.0;
    const double least = kLeastShare * top, before = std::log(std::max(double{row[column - 1]}, least)),
                 after = std::log(std::max(double{row[column + 1]}, least));
    const double bend = before - 2 * std::log(top) + after;
    return bend < 0 ? std::min(std::max(0.5 * (before - after) / bend, -kMaxOffset), kMaxOffset) : 0.0;
}

Shift find_shift(const Floats& response, const ShiftRange& range) {
    const Eigen::Index middle = response.cols() / 2;
    const auto penalty = static_cast<float>(std::clamp(range.penalty, -kMaxPenalty, kMaxPenalty));
    const float* best_row = nullptr;
    int best = 0;
    float most = 0.0F;
    for (int down = -range.most_down; down <= range.most_down; ++down) {
        const float* row = &response(response.rows() / 2 + down, middle);
        for (int right = -range.most_right; right <= range.most_right; ++right) {
            const float evidence = row[right] - penalty * static_cast<float>(right * right);
            if (best_row != nullptr && !(evidence > most)) continue;
            best_row = row;
            best = right;
            most = evidence;
        }
    }
    return {best + peak_offset(best_row, best, range.most_right), best_row[best]};
}

void require_range(int most, Eigen::Index count, const char* name) {
    require_count(most, 0, static_cast<int>((count - 1) / 2), name);
}

}  // namespace

Shift log_polar_shift(const ImageView& patch, PlacesRef places, FloatsRef taper, const FilterStack& filter,
                      const ShiftRange& range) {
    require_range(range.most_right, taper.cols(), "most_right");
    require_range(range.most_down, taper.rows(), "most_down");
    if (!std::isfinite(range.penalty)) refuse("penalty", "a finite number", range.penalty);
    if (filter.filters != 1) refuse("filter", "one filter", std::to_string(filter.filters));
    const PixelBytes picked = pick_pixels(patch, places);
    const int rows = static_cast<int>(places.rows()), cols = static_cast<int>(places.cols());
    const FloatPlanes cells =
        hog_color_cells({picked.data(), rows, cols, 3, 3 * std::ptrdiff_t{cols}}, taper);
    return find_shift(correlation_response(cells.view(), filter), range);
}

}  // namespace tricue
