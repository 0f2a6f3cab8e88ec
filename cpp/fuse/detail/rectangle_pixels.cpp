// SPDX-License-Identifier: MIT
#include "fuse/detail/rectangle_pixels.hpp"

#include <algorithm>
#include <cmath>

#include "base/check.hpp"

namespace tricue {
namespace {

/// The first pixel of [0, size) whose center isn't below an edge; size if there is none.
int first_pixel_from(double edge, int size) {
    return static_cast<int>(std::clamp(std::ceil(edge - 0.5), 0.0, static_cast<double>(size)));
}

}  // namespace

void require_corners(const Rectangle& rectangle, const char* name) {
    for (const double corner : {rectangle.x0, rectangle.y0, rectangle.x1, rectangle.y1})
        if (!std::isfinite(corner)) refuse(name, "finite corners", corner);
}

Region rectangle_pixels(const Rectangle& rectangle, int rows, int cols, const char* name) {
    require_corners(rectangle, name);
    const int x0 = first_pixel_from(rectangle.x0, cols), y0 = first_pixel_from(rectangle.y0, rows);
    return {x0, y0, std::max(x0, first_pixel_from(rectangle.x1, cols)),
            std::max(y0, first_pixel_from(rectangle.y1, rows))};
}

std::vector<Region> rectangle_pixels(StatesRef rectangles, int rows, int cols, const char* name) {
    require_shape(rectangles, rectangles.rows(), 4, name);
    std::vector<Region> regions;
    for (Eigen::Index i = 0; i < rectangles.rows(); ++i) {
        const auto each = rectangles.row(i);
        regions.push_back(rectangle_pixels({each[0], each[1], each[2], each[3]}, rows, cols, name));
    }
    return regions;
}

}  // namespace tricue
