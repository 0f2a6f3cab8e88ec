// SPDX-License-Identifier: MIT
#include "camera/rectify_verged.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "base/check.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

constexpr int kSubpixels = 2048;  // positions are rounded to 1 / kSubpixels of a pixel
constexpr int kMaxSide = std::numeric_limits<int>::max() / kSubpixels;
constexpr double kPi = 3.14159265358979323846;

void require_arguments(const ImageView& right, const VergedCamera& camera, double shift) {
    if (right.rows < 1 || right.cols < 1) refuse("right", "at least one pixel", "none");
    if (std::max(right.rows, right.cols) > kMaxSide)
        refuse("right", "at most " + std::to_string(kMaxSide) + " rows and columns",
               shape_text(right.rows, right.cols));
    if (!(std::abs(camera.angle) < kPi / 2)) refuse("angle", "radians between -pi/2 and pi/2", camera.angle);
    require_positive(camera.focal, "focal");
    if (!std::isfinite(camera.cx)) refuse("center", "finite numbers", camera.cx);
    if (!std::isfinite(camera.cy)) refuse("center", "finite numbers", camera.cy);
    if (!std::isfinite(shift)) refuse("shift", "a finite number", shift);
}

/// The source columns of the pixels in each column.
struct Columns {
    std::vector<double> stretch;  ///< y_R / y; NaN where the turned camera sees nothing
    std::vector<int> first;       ///< bytes into a row
    std::vector<int> next;        ///< bytes to the pixel on the right
    std::vector<int> across;      ///< its weight
};

Columns find_columns(const ImageView& right, const VergedCamera& camera, double shift, bool rows_only) {
    const auto n = static_cast<std::size_t>(right.cols);
    const double turn_cos = std::cos(camera.angle), turn_sin = std::sin(camera.angle), f = camera.focal;
    Columns columns{std::vector<double>(n, std::numeric_limits<double>::quiet_NaN()), std::vector<int>(n),
                    std::vector<int>(n), std::vector<int>(n)};
    for (std::size_t i = 0; i < n; ++i) {
        const double x = static_cast<double>(i) - shift - camera.cx, ahead = f * turn_cos - x * turn_sin;
        if (!rows_only && !(ahead > 0.0)) continue;
        const double stretch = rows_only ? turn_cos + x * turn_sin / f : f / ahead;
        const double at = camera.cx + (rows_only ? x : (x * turn_cos + f * turn_sin) * stretch);
        const double fixed = at * kSubpixels + 0.5;
        if (!(fixed >= 0.0 && fixed < (right.cols - 1.0) * kSubpixels + 1.0)) continue;
        const int place = static_cast<int>(fixed), whole = place / kSubpixels;
        columns.stretch[i] = stretch;
        columns.first[i] = whole * right.channels;
        columns.next[i] = whole + 1 < right.cols ? right.channels : 0;
        columns.across[i] = place % kSubpixels;
    }
    return columns;
}

/// The source rows of the pixels in one row, -1 for none, and the weights of the rows after them.
TRICUE_MULTIVERSION
void find_rows(const double* __restrict stretch, double y, double cy, int rows, int n, int* __restrict row,
               int* __restrict down) {
    const double end = (rows - 1.0) * kSubpixels + 1.0;
    for (int i = 0; i < n; ++i) {
        const double fixed = (cy + y * stretch[i]) * kSubpixels + 0.5;
        const bool inside = (fixed >= 0.0) & (fixed < end);
        const int place = static_cast<int>(inside ? fixed : 0.0);
        row[i] = inside ? place / kSubpixels : -1;
        down[i] = place % kSubpixels;
    }
}

template <int Channels>
void blend_row(const ImageView& image, const Columns& columns, const int* row, const int* down,
               std::uint8_t* out) {
    constexpr unsigned kWhole = kSubpixels;
    for (std::size_t i = 0; i < columns.first.size(); ++i, out += Channels) {
        if (row[i] < 0) continue;
        const auto across = static_cast<unsigned>(columns.across[i]);
        const auto under = static_cast<unsigned>(down[i]);
        const std::uint8_t* upper = image.row(row[i]) + columns.first[i];
        const std::uint8_t* lower = row[i] + 1 < image.rows ? upper + image.stride : upper;
        const std::uint8_t *upper_next = upper + columns.next[i], *lower_next = lower + columns.next[i];
        for (int c = 0; c < Channels; ++c) {
            const unsigned above = upper[c] * (kWhole - across) + upper_next[c] * across;
            const unsigned below = lower[c] * (kWhole - across) + lower_next[c] * across;
            const unsigned sum = above * (kWhole - under) + below * under;
            out[c] = static_cast<std::uint8_t>((sum + kWhole * kWhole / 2) / (kWhole * kWhole));
        }
    }
}

}  // namespace

ImageBytes rectify_verged(const ImageView& right, const VergedCamera& camera, double shift, bool rows_only) {
    require_arguments(right, camera, shift);
    const Columns columns = find_columns(right, camera, shift, rows_only);
    const Eigen::Index bytes = Eigen::Index{right.cols} * right.channels;
    ImageBytes turned = ImageBytes::Zero(right.rows * bytes);
    std::vector<int> row(columns.first.size()), down(row.size());
    for (int y = 0; y < right.rows; ++y) {
        find_rows(columns.stretch.data(), y - camera.cy, camera.cy, right.rows, right.cols, row.data(),
                  down.data());
        std::uint8_t* out = turned.data() + y * bytes;
        if (right.channels == 1)
            blend_row<1>(right, columns, row.data(), down.data(), out);
        else
            blend_row<3>(right, columns, row.data(), down.data(), out);
    }
    return turned;
}

}  // namespace tricue
