// SPDX-License-Identifier: MIT
#include "fuse/log_polar_shift.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/check.hpp"
#include "fuse/correlation_response.hpp"
#include "fuse/detail/parabola.hpp"
#include "fuse/detail/picked_cells.hpp"

namespace tricue {
namespace {

constexpr double kMinShare = 0.05;  // of the maximum: lower bound for logarithms
constexpr double kMaxPenalty = std::numeric_limits<float>::max();  // infinity times 0 columns isn't a number

/// `row` has the columns from -reach to reach off the middle.
double peak_offset(const float* row, int column, int reach) {
    const double top = row[column];
    if (column == -reach || column == reach || !(top > 0.0)) return 0.0;
    const double lowest = kMinShare * top, before = std::log(std::max(double{row[column - 1]}, lowest)),
                 after = std::log(std::max(double{row[column + 1]}, lowest));
    return parabola_offset(before, std::log(top), after);
}

Shift find_shift(const Floats& response, const ShiftRange& range) {
    const Eigen::Index middle = response.cols() / 2;
    const auto penalty = static_cast<float>(std::clamp(range.penalty, -kMaxPenalty, kMaxPenalty));
    const float* best_row = nullptr;
    int best = 0;
    float greatest = 0.0F;
    for (int down = -range.max_down; down <= range.max_down; ++down) {
        const float* row = &response(response.rows() / 2 + down, middle);
        for (int right = -range.max_right; right <= range.max_right; ++right) {
            const float evidence = row[right] - penalty * static_cast<float>(right * right);
            if (best_row != nullptr && !(evidence > greatest)) continue;
            best_row = row;
            best = right;
            greatest = evidence;
        }
    }
    return {best + peak_offset(best_row, best, range.max_right), best_row[best]};
}

void require_range(int reach, Eigen::Index count, const char* name) {
    require_count(reach, 0, static_cast<int>((count - 1) / 2), name);
}

}  // namespace

Shift log_polar_shift(const ImageView& patch, PlacesRef places, FloatsRef taper, const FilterStack& filter,
                      const ShiftRange& range) {
    require_range(range.max_right, taper.cols(), "max_right");
    require_range(range.max_down, taper.rows(), "max_down");
    if (!std::isfinite(range.penalty)) refuse("penalty", "a finite number", range.penalty);
    if (filter.filters != 1) refuse("filter", "one filter", std::to_string(filter.filters));
    const FloatPlanes cells = picked_cells(patch, places, taper);
    return find_shift(correlation_response(cells.view(), filter), range);
}

}  // namespace tricue
