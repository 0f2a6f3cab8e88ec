// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "base/arrays.hpp"
#include "base/rectangle.hpp"
#include "base/region.hpp"

namespace tricue {

/// The pixels of an image whose centers lie in a rectangle; never x1 < x0 nor y1 < y0.
///
/// @throws std::invalid_argument on corners that aren't finite; `name` is the argument's
Region rectangle_pixels(const Rectangle& rectangle, int rows, int cols, const char* name);

/// The same for N rectangles (N, 4): x0, y0, x1, y1.
std::vector<Region> rectangle_pixels(StatesRef rectangles, int rows, int cols, const char* name);

/// @throws std::invalid_argument likewise
void require_corners(const Rectangle& rectangle, const char* name);

}  // namespace tricue
