// SPDX-License-Identifier: MIT
#include "fuse/detail/rectangle_pixels.hpp"

#include <algorithm>
#include <cmath>

#include "base/check.hpp"

namespace tricue {
namespace {

/// The least pixel of [0, size) whose centre isn't below an edge; size if none is.
int pixel_at(double edge, int size) {
    return static_cast<int>(std::clamp(std::ceil(edge - 0.5), 0.0, static_cast<double>(size)));
}

}  // namespace

void require_corners(const Rectangle& rectangle, const char* name) {
    for (const double corner : {rectangle.x0, rectangle.y0, rectangle.x1, rectangle.y1})
        if (!std::isfinite(corner)) refuse(name, "finite corners", corner);
}

Region rectangle_pixels(const Rectangle& rectangle, int rows, int cols, const char* name) {
    require_corners(rectangle, name);
    const int x0 = pixel_at(rectangle.x0, cols), y0 = pixel_at(rectangle.y0, rows);
    return {x0, y0, std::max(x0, pixel_at(rectangle.x1, cols)), std::max(y0, pixel_at(rectangle.y1, rows))};
}

}  // namespace tricue
