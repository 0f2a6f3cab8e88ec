// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/image_view.hpp"
#include "base/region.hpp"

namespace tricue {

/// A part of the left image: a rectangle, or the ellipse inscribed in it.
struct StereoRegion {
    Region place;
    bool ellipse;
};

/// The candidate disparities.
struct DisparityRange {
    int first, last;  ///< range of disparities, both included, at most 4096 of them; first may be negative
};

/// How two images are compared.
struct StereoMatching {
    int window;  ///< side, pixels, odd: 1 to 31 with the prefilter, 1 to 15 without, so that sums fit 16 bits
    int uniqueness;  ///< percent, 0 to 100; 0 rejects nothing
    /// whether x-Sobel responses clipped at ±31, which lighting changes less, are compared instead of gray levels
    bool prefilter;
};

/// Block matching by sums of absolute differences: the disparity d of each pixel of a region, x_right = x_left - d, equations (3),
/// (4).
///
/// The cost of d is the sum of |F_left(x + i, y + j) - F_right(x + i - d, y + j)| over the window around (x, y), with F the gray
/// levels, or the x-Sobel responses, of which each difference counts as at most 31. Images are extended by their edge pixels. A d
/// whose x - d lies outside the right image is no candidate; of equal costs the smallest d wins. The subpixel fraction is where
/// two lines of opposite slope through the costs of d - 1, d, d + 1 meet, in float32; it is 0 where d is the first or last
/// candidate.
///
/// A pixel is NaN outside the ellipse or the left image, without a candidate, or where it is rejected:
/// - by uniqueness, if any d' not next to d costs at most (1 + uniqueness / 100) times as much (as in cv2.StereoBM);
/// - by the left-right check, if the best of the region's pixels in its row with the same x - d (of least cost, of equals the
///   leftmost) has a disparity that differs by more than the tolerance (as in cv2.validateDisparity).
///
/// @param left uint8 (H, W), gray, rectified, at least one pixel
/// @param right uint8 (H, W), gray, rectified, of the same size
/// @param region (x0, y0, x1, y1), pixels of the left image, sides of 1 to 16384; may extend beyond the image
/// @param ellipse whether only pixels whose centers lie in the ellipse inscribed in the region count
/// @param tolerance of the left-right check, pixels; negative for no check
/// @returns float32 (h, w) of the region, pixels
/// @throws std::invalid_argument on images without pixels or of different sizes, or numbers out of range
/// Source: Moreno, Tarrida, Andrade-Cetto, Sanfeliu 2002, section 3.2; prefilter and uniqueness are those of Konolige's block
/// matcher in OpenCV.
Floats sad_disparity(const ImageView& left, const ImageView& right, const StereoRegion& region,
                     const DisparityRange& limits, const StereoMatching& matching, int tolerance);

}  // namespace tricue
