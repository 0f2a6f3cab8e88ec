// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "base/image_view.hpp"

namespace tricue {

using Boundary = Eigen::Array<std::int16_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The boundary value of every pixel in 255ths: 255 Δ = max(b, g, r) - max(|b - b0|, |g - g0|, |r - r0|).
///
/// A pixel is skin where Δ > threshold. On colors of 8 bits the value is a whole number in [-255, 255], so it
/// is kept exactly; the paper writes it on colors in [0, 1].
///
/// @param image     BGR pixels (H, W)
/// @param reference the reference color c0
/// @returns         (H, W) of 255 Δ
/// Source: Sabeti, Parvizi, Wu 2008, equations (4)-(10).
Boundary skin_boundary(const ImageView& image, const Bgr& reference);

/// The same for `n` packed pixels of one row: what the other kernels of skin classify with.
void skin_boundary_row(const std::uint8_t* pixels, int n, const Bgr& reference, std::int16_t* boundary);

/// The least value of 255 Δ that is skin, so that `boundary >= least` is Δ > threshold for whole numbers.
/// @throws std::invalid_argument unless the threshold is in [-1, 1]
int least_skin(double threshold);

}  // namespace tricue
