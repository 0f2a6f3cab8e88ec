// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/image_view.hpp"
#include "cues/color/detail/search_grid.hpp"

namespace tricue {

/// Mean |n · ∇I| along the outline of an ellipse, at each place of a grid: how much of the outline lies on image edges.
///
/// n is the ellipse's unit normal, ∇I the central difference at the pixel that an outline point lies in; at the image's edge the
/// pixel itself stands for its missing neighbor. Points are placed relative to the pixel that the center lies in, so an ellipse
/// that moves by whole pixels keeps its outline. Points outside the image are left out; with none inside the mean is 0. Sums are
/// float32.
///
/// @param gray uint8 (H, W), may be empty
/// @param ellipse float64 (4,): center x, y, semi-axes along x (minor) and y (major), pixels, finite, axes above 0 and at most 4096
/// @param grid (rows, cols, step), 1 to 1024 each: place (i, j) is (j - cols // 2) step to the right of the ellipse and (i - rows
///     // 2) step below it, pixels
/// @param pattern float64 (n, 2), n at least 1: u, v with u² + v² = 1 within 1e-6, for the outline points (x + minor u, y + major
///     v)
/// @returns float64 (rows, cols), gray levels per pixel
/// @throws std::invalid_argument on other shapes or values, or a grid that reaches over more than 16384 pixels
/// Source: Birchfield 1998, equation (2), the gradient module, which Moreno et al. 2002 leave out; with the normal of the ellipse.
States ellipse_gradient(const ImageView& gray, VectorRef ellipse, const SearchGrid& grid, StatesRef pattern);

}  // namespace tricue
