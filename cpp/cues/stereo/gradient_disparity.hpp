// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/image_view.hpp"
#include "base/region.hpp"

namespace tricue {

struct GradientMatching {
    int levels;    ///< of the pyramid, 1 to 6; 1 is the paper's
    double sigma;  ///< of the Gaussian, pixels of each level, 0.5 to 6
    int radius;    ///< of the square window that an equation is solved over, 0 to 7; 0 is the paper's
    double min_reliability;  ///< of (9), (gray levels / px²)²
    double
        max_residual;  ///< of a window's difference, as a share of both images' power in it; not with radius 0
    double max_step;   ///< pixels that the finest level may find the disparity away from where it began
};

/// Disparities round a predicted one, by the gradient method: x_right = x_left - d.
///
/// Of images shifted by a disparity d0 that is known so far, each pixel gives one equation
///     s (d - d0) = f_R(x - d0) - f_L(x),  s = (f_x^R(x - d0) + f_x^L(x)) / 2                     (7)
/// (as printed it equates slopes with slopes; the difference of brightness is meant), and the d of a pixel is the one that leaves
/// the least squares in its window. f is the x-derivative of the Gaussian, which light changes less than the brightness itself, and
/// which errs a third as much; f_x its central difference. Between columns f is linear.
///
/// d0 is the prediction at the coarsest level of a pyramid, then the d of the coarser level, of which each may lead 1.5 of its own
/// pixels away: with three levels 9 px at most, and what is 6 px off is still read well; with one level 1 to 2 px. Little contrast in the
/// window leaves d0 as it is.
///
/// NaN is a pixel outside the left picture, one whose x - d0 isn't in the right one, and one rejected: for its reliability
///     R_d = (f_x^R)² + (f_x^L)²                                                                  (9)
/// for the differences that d leaves in its window (occlusion, noise, what is farther than the levels reach), or its last step.
///
/// @param left, right rectified gray images of one size
/// @param predicted   disparity, pixels
/// @param region      of the left image; it may reach over its edge: there is reliability 0. The result is that part of the result
///                    of the whole image, to the last bit, whose other parts aren't computed.
/// @returns           (2 height, width) of the region: disparities, pixels, and under them the reliabilities (9), means of the
///                    windows, also where the disparity is rejected. In one array, since the system takes back the memory of two.
/// @throws std::invalid_argument on images without pixels or of unlike sizes, and on numbers out of range
/// Source: Okada, Shirai, Miura 1996, section 3; levels, windows and the residual are ours.
Floats gradient_disparity(const ImageView& left, const ImageView& right, double predicted,
                          const GradientMatching& matching, const Region& region);

}  // namespace tricue
