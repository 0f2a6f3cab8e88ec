// SPDX-License-Identifier: MIT
#include "cues/color/ellipse_gradient.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/check.hpp"
#include "base/simd.hpp"
#include "cues/color/detail/ellipse_shape.hpp"

namespace tricue {
namespace {

/// A point of the outline: its pixel, and half the unit normal, since central differences span two pixels.
struct OutlinePoint {
    int x, y;
    float u, v;
};

/// Twice ∇I of a part of the image; 0 outside it.
class Gradient {
public:
    Gradient(const ImageView& gray, const Region& area)
        : area_(area), cols_(area.x1 - area.x0), values_(2 * plane()) {
        const Region visible = area.clipped(gray);
        for (int y = visible.y0; y < visible.y1; ++y) {
            const std::uint8_t *above = gray.row(std::max(y - 1, 0)), *row = gray.row(y),
                               *below = gray.row(std::min(y + 1, gray.rows - 1));
            float* out = values_.data() + offset(0, y);
            for (int x = visible.x0; x < visible.x1; ++x) {
                out[x] = static_cast<float>(row[std::min(x + 1, gray.cols - 1)] - row[std::max(x - 1, 0)]);
                out[x + static_cast<std::ptrdiff_t>(plane())] = static_cast<float>(below[x] - above[x]);
            }
        }
    }

    const float* right(int x, int y) const { return values_.data() + offset(x, y); }
    const float* down(int x, int y) const { return right(x, y) + plane(); }

private:
    std::size_t plane() const {
        return static_cast<std::size_t>(cols_) * static_cast<std::size_t>(area_.y1 - area_.y0);
    }
    std::ptrdiff_t offset(int x, int y) const { return std::ptrdiff_t{y - area_.y0} * cols_ + x - area_.x0; }

    Region area_;
    int cols_;
    std::vector<float> values_;
};

/// Adds |n · ∇I| of one point of the outline for a row of the grid.
TRICUE_MULTIVERSION
void add_gradients(const float* __restrict right, const float* __restrict down, float u, float v, int n,
                   int step, float* __restrict sums) {
    if (step == 1) {
        for (int j = 0; j < n; ++j) sums[j] += std::abs(u * right[j] + v * down[j]);
    } else {
        for (int j = 0; j < n; ++j) sums[j] += std::abs(u * right[j * step] + v * down[j * step]);
    }
}

/// Points are computed relative to the pixel that contains the center, so that an ellipse moved by whole pixels has the same outline.
/// Relative to the image, rounding would move points at the border of two pixels.
std::vector<OutlinePoint> outline(VectorRef ellipse, StatesRef pattern) {
    const CenterPixel origin(ellipse.data());
    const double x = ellipse[0] - std::floor(ellipse[0]), y = ellipse[1] - std::floor(ellipse[1]);
    std::vector<OutlinePoint> points;
    points.reserve(static_cast<std::size_t>(pattern.rows()));
    for (Eigen::Index k = 0; k < pattern.rows(); ++k) {
        const double place[] = {x + ellipse[2] * pattern(k, 0), y + ellipse[3] * pattern(k, 1)};
        const double u = pattern(k, 0) / ellipse[2], v = pattern(k, 1) / ellipse[3];
        const double twice = 2.0 * std::sqrt(u * u + v * v);
        const CenterPixel pixel(place);
        points.push_back({origin.x + pixel.x, origin.y + pixel.y, static_cast<float>(u / twice),
                          static_cast<float>(v / twice)});
    }
    return points;
}

Region bounds(const std::vector<OutlinePoint>& points) {
    Region all{points[0].x, points[0].y, points[0].x + 1, points[0].y + 1};
    for (const OutlinePoint& point : points)
        all = {std::min(all.x0, point.x), std::min(all.y0, point.y), std::max(all.x1, point.x + 1),
               std::max(all.y1, point.y + 1)};
    return all;
}

/// The positions j in [0, n) of a row at which the pixel x + step j is inside [0, cols).
Region places_inside(int x, int step, int n, int cols) {
    const auto first = [&](int limit) { return std::clamp((limit - x + step - 1) / step, 0, n); };
    return {x < 0 ? first(0) : 0, 0, x < cols ? first(cols) : 0, 1};
}

void require_pattern(StatesRef pattern) {
    require_shape(pattern, pattern.rows(), 2, "pattern");
    if (pattern.rows() == 0) refuse("pattern", "at least one place", "none");
    require_finite(pattern, "pattern");
    const auto radii = (pattern.col(0).square() + pattern.col(1).square()).eval();
    for (const double radius : radii)
        if (!(std::abs(radius - 1.0) <= 1e-6))
            refuse("pattern", "places on the unit circle", std::sqrt(radius));
}

}  // namespace

States ellipse_gradient(const ImageView& gray, VectorRef ellipse, const SearchGrid& grid, StatesRef pattern) {
    require_size(ellipse, 4, "ellipse");
    require_ellipses(Eigen::Map<const States>(ellipse.data(), 1, 4), 1.0, "ellipse");
    require_grid(grid);
    require_pattern(pattern);

    States found = States::Zero(grid.rows, grid.cols);
    const std::vector<OutlinePoint> points = outline(ellipse, pattern);
    const Region area = swept_region(bounds(points), grid), visible = area.clipped(gray);
    if (visible.x0 >= visible.x1 || visible.y0 >= visible.y1) return found;

    const Gradient gradient(gray, area);
    Eigen::ArrayXf sums(grid.cols), counts(grid.cols);
    for (int i = 0; i < grid.rows; ++i) {
        sums.setZero();
        counts.setZero();
        for (const OutlinePoint& point : points) {
            const int x = point.x - grid.cols / 2 * grid.step, y = point.y + (i - grid.rows / 2) * grid.step;
            if (y < 0 || y >= gray.rows) continue;
            add_gradients(gradient.right(x, y), gradient.down(x, y), point.u, point.v, grid.cols, grid.step,
                          sums.data());
            const Region inside = places_inside(x, grid.step, grid.cols, gray.cols);
            counts.segment(inside.x0, std::max(inside.x1 - inside.x0, 0)) += 1.0F;
        }
        found.row(i) = (sums / counts.max(1.0F)).cast<double>();
    }
    return found;
}

}  // namespace tricue
