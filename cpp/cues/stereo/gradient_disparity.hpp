// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/image_view.hpp"
#include "base/region.hpp"

namespace tricue {

struct GradientMatching {
    int levels;    ///< levels of the pyramid, 1 to 6
    double sigma;  ///< of the Gaussian, pixels of each level, 0.5 to 6
    int radius;    ///< of the square window that an equation is solved over, pixels, 0 to 7
    /// smallest reliability (9) of a valid disparity, (gray levels / pixel²)², at least 0
    double min_reliability;
    /// largest difference that may remain in a window with its d, as a share of both images' power in it, at least 0; not used
    /// with radius 0
    double max_residual;
    /// how far from its start the finest level may find the disparity, pixels, at least 0
    double max_step;
};

/// Disparities around a predicted one, by the gradient method: x_right = x_left - d.
///
/// With the images shifted by the disparity d0 known so far, each pixel gives one equation
///     s (d - d0) = f_R(x - d0) - f_L(x),  s = (f_x^R(x - d0) + f_x^L(x)) / 2                     (7)
///
/// and the d of a pixel is the least-squares solution in its window. f is the image filtered by the x-derivative of a Gaussian, which
/// lighting changes less than brightness: so f_R - f_L is the difference of slopes that is printed, and f_x, the central difference
/// of f, is a second derivative (printed as the slope of brightness, with which (7) would equate slopes with slopes). Between
/// columns f is linear.
///
/// At the coarsest level of a pyramid d0 is the prediction, at the others the d of the coarser level; each level may change it by
/// 1.5 of its own pixels. Three levels reach 9 pixels at most, and are accurate up to 6; one level 1 to 2. With little contrast
/// in the window, d0 stays. levels = 1 with radius = 0 is the paper's method, with this f.
///
/// A pixel is NaN outside the left image, where x - d0 is not in the right one, and where it is rejected: by its last step, by
/// the differences that remain with d in its window (occlusion, noise, disparities that the levels do not reach), or by its
/// reliability
///     R_d = (f_x^R)² + (f_x^L)²                                                                  (9)
///
/// @param left uint8 (H, W), gray, rectified, at least one pixel
/// @param right uint8 (H, W), gray, rectified, of the same size
/// @param disparity the predicted disparity, pixels, -16384 to 16384
/// @param region (x0, y0, x1, y1), pixels of the left image, sides of 1 to 16384; None for all of it. It may extend beyond the
///     image, where reliability is 0. The result is, to the last bit, that part of the result for the whole image
/// @returns disparity float32 (h, w), pixels
/// @returns reliability float32 (h, w): the mean of (9) over the window, also where the disparity is rejected
/// @throws std::invalid_argument on images without pixels or of different sizes, or numbers out of range
/// Source: Okada, Shirai, Miura 1996, section 3; levels, windows and the residual are ours.
Floats gradient_disparity(const ImageView& left, const ImageView& right, double disparity,
                          const GradientMatching& matching, const Region& region);

}  // namespace tricue
