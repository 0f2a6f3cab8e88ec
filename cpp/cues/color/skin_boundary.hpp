// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "base/image_view.hpp"

namespace tricue {

using Boundary = Eigen::Array<std::int16_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Boundary value of each pixel in 255ths: 255 Δ = max(b, g, r) - max(|b - b0|, |g - g0|, |r - r0|).
///
/// A pixel is skin where Δ > threshold. The paper writes Δ on colors in [0, 1]; on colors of 8 bits 255 Δ is exact.
/// (9) is max(b, g, r), each pixel's largest channel, as its indices have it. The text calls it "the maximum
/// RGB value in the image", which is another classifier, with other thresholds.
///
/// @param image uint8 (H, W, 3) BGR
/// @param reference uint8 (3,): the reference color c0, B, G, R
/// @returns int16 (H, W): 255 Δ, in [-255, 255]
/// Source: Sabeti, Parvizi, Wu 2008, equations (4)-(10).
Boundary skin_boundary(const ImageView& image, const Bgr& reference);

/// The same for `n` packed pixels of one row; the other skin kernels classify with it.
void skin_boundary_row(const std::uint8_t* pixels, int n, const Bgr& reference, std::int16_t* boundary);

/// The least value of 255 Δ that is skin, so that `boundary >= least` is Δ > threshold for whole numbers.
/// @throws std::invalid_argument unless the threshold is in [-1, 1]
int least_skin(double threshold);

}  // namespace tricue
