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

/// A place of the outline: its pixel, and the unit normal, halved as central differences are taken over two pixels.
struct Edge {
    int x, y;
    float u, v;
};

/// ∇I, not yet halved, of a part of the image; 0 outside it.
class Gradient {
public:
    Gradient(const ImageView& grey, const Region& area)
        : area_(area), cols_(area.x1 - area.x0), values_(2 * plane()) {
        const Region seen = area.clipped(grey);
        for (int y = seen.y0; y < seen.y1; ++y) {
            const std::uint8_t *above = grey.row(std::max(y - 1, 0)), *row = grey.row(y),
                               *below = grey.row(std::min(y + 1, grey.rows - 1));
            float* out = values_.data() + offset(0, y);
            for (int x = seen.x0; x < seen.x1; ++x) {
                out[x] = static_cast<float>(row[std::min(x + 1, grey.cols - 1)] - row[std::max(x - 1, 0)]);
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

/// Adds |n · ∇I| of one place of the outline for a row of the grid.
TRICUE_MULTIVERSION
void add(const float* __restrict right, const float* __restrict down, float u, float v, int n, int step,
         float* __restrict sums) {
    if (step == 1) {
        for (int j = 0; j < n; ++j) sums[j] += std::abs(u * right[j] + v * down[j]);
    } else {
        for (int j = 0; j < n; ++j) sums[j] += std::abs(u * right[j * step] + v * down[j * step]);
    }
}

/// The pixels follow from where in its own pixel the centre is, so that an ellipse moved by whole pixels has the same outline: added
/// to x itself, places at the border of two pixels would be rounded to one or the other.
std::vector<Edge> outline(VectorRef ellipse, StatesRef pattern) {
    const Place origin(ellipse.data());
    const double x = ellipse[0] - std::floor(ellipse[0]), y = ellipse[1] - std::floor(ellipse[1]);
    std::vector<Edge> edges;
    edges.reserve(static_cast<std::size_t>(pattern.rows()));
    for (Eigen::Index k = 0; k < pattern.rows(); ++k) {
        const double place[] = {x + ellipse[2] * pattern(k, 0), y + ellipse[3] * pattern(k, 1)};
        const double u = pattern(k, 0) / ellipse[2], v = pattern(k, 1) / ellipse[3];
        const double twice = 2.0 * std::sqrt(u * u + v * v);
        const Place pixel(place);
        edges.push_back({origin.x + pixel.x, origin.y + pixel.y, static_cast<float>(u / twice),
                         static_cast<float>(v / twice)});
    }
    return edges;
}

Region bounds(const std::vector<Edge>& edges) {
    Region all{edges[0].x, edges[0].y, edges[0].x + 1, edges[0].y + 1};
    for (const Edge& edge : edges)
        all = {std::min(all.x0, edge.x), std::min(all.y0, edge.y), std::max(all.x1, edge.x + 1),
               std::max(all.y1, edge.y + 1)};
    return all;
}

/// At which places j in [0, n) of a row the pixel x + step j is inside [0, cols).
Region inside(int x, int step, int n, int cols) {
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

States ellipse_gradient(const ImageView& grey, VectorRef ellipse, const SearchGrid& grid, StatesRef pattern) {
    require_size(ellipse, 4, "ellipse");
    require_ellipses(Eigen::Map<const States>(ellipse.data(), 1, 4), 1.0, "ellipse");
    require_grid(grid);
    require_pattern(pattern);

    States found = States::Zero(grid.rows, grid.cols);
    const std::vector<Edge> edges = outline(ellipse, pattern);
    const Region area = swept(bounds(edges), grid), seen = area.clipped(grey);
    if (seen.x0 >= seen.x1 || seen.y0 >= seen.y1) return found;

    const Gradient gradient(grey, area);
    Eigen::ArrayXf sums(grid.cols), counts(grid.cols);
    for (int i = 0; i < grid.rows; ++i) {
        sums.setZero();
        counts.setZero();
        for (const Edge& edge : edges) {
            const int x = edge.x - grid.cols / 2 * grid.step, y = edge.y + (i - grid.rows / 2) * grid.step;
            if (y < 0 || y >= grey.rows) continue;
            add(gradient.right(x, y), gradient.down(x, y), edge.u, edge.v, grid.cols, grid.step, sums.data());
            const Region there = inside(x, grid.step, grid.cols, grey.cols);
            counts.segment(there.x0, std::max(there.x1 - there.x0, 0)) += 1.0F;
        }
        found.row(i) = (sums / counts.max(1.0F)).cast<double>();
    }
    return found;
}

}  // namespace tricue
