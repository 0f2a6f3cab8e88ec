// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/image_view.hpp"
#include "cues/color/detail/search_grid.hpp"

namespace tricue {

/// How much of an outline lies on edges, at every place of a grid: the mean |n · ∇I| along an ellipse.
///
/// n is the ellipse's unit normal at a place of its outline, ∇I the central difference at the pixel that the place lies in; at the
/// edge of the image the pixel itself stands for its missing neighbour. Places are counted from the pixel that the centre lies in, so
/// an ellipse moved by whole pixels has the same outline. Those outside the image are left out of the mean, and with none inside it
/// is 0. Sums are of float32.
///
/// @param grey    (H, W) 8 bit, may be empty
/// @param ellipse (4,): centre x, y, semi-axes along x (minor) and along y (major), pixels, finite, above 0, at most 4096
/// @param grid    of places round the ellipse's own
/// @param pattern (n, 2): u, v with u² + v² = 1 within 1e-6, the outline at (x + minor u, y + major v); n at least 1
/// @returns       (rows, cols) grey levels a pixel
/// @throws std::invalid_argument on other shapes or values
/// Source: Birchfield 1998, equation (2), the gradient module that Moreno et al. 2002 leave out; with the normal of the ellipse.
States ellipse_gradient(const ImageView& grey, VectorRef ellipse, const SearchGrid& grid, StatesRef pattern);

}  // namespace tricue
