// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/image_view.hpp"
#include "base/region.hpp"

namespace tricue {

/// A part of the left image, sides of 1 to 16384, which may reach over its edge; of it either all pixels count or those whose centres
/// lie in the inscribed ellipse.
struct StereoRegion {
    Region place;
    bool ellipse;
};

/// The disparities looked for, both included, at most 4096 of them; first may be negative.
struct DisparityRange {
    int first, last;
};

struct StereoMatching {
    int window;      ///< side, odd: 1 to 31 with the prefilter, 1 to 15 without, so that sums fit 16 bits
    int uniqueness;  ///< percent, 0 to 100: 0 rejects nothing
    bool prefilter;  ///< x-Sobel clipped at ±31, which light doesn't change; else gray levels are compared
    int tolerance;   ///< pixels that left and right disparity may differ by; negative: not compared
};

/// The disparity of each pixel of a region: x_right = x_left - d, the d whose window differs least (equation (3), (4)).
///
/// The cost of d is the sum of |F_left(x + i, y + j) - F_right(x + i - d, y + j)| over the window round (x, y), F the gray levels
/// or the x-Sobel filter; of that the difference counts up to 31 only, so that edges of depth and occlusion weigh less. Beyond an image its last row or column goes on, under filter and window. A d whose x - d lies outside
/// the right image is no candidate. Of equal costs the smallest d wins. The fraction of a pixel is where two lines of
/// opposite slope through the costs of d - 1, d, d + 1 meet, in float32; none where d is the first or last candidate.
///
/// A pixel is NaN that is outside the ellipse or the left image, that has no candidate, or is rejected:
/// - by uniqueness, if any d' not next to d costs at most (1 + uniqueness / 100) times as much (as cv2.StereoBM);
/// - by the left-right check, if the best pixel of the region that claims the same x - d in its row (the least cost, of
///   equal ones the leftmost) has a disparity further from d than the tolerance (as cv2.validateDisparity).
///
/// @param left, right rectified gray images of one size: of color the rows needed, by cv2.cvtColor
/// @returns           (height, width) of the region, pixels
/// @throws std::invalid_argument on images without pixels or of unlike sizes, and on numbers out of range
/// Source: Moreno, Tarrida, Andrade-Cetto, Sanfeliu 2002, section 3.2; the prefilter and uniqueness are those of Konolige's
/// block matcher in OpenCV.
Floats sad_disparity(const ImageView& left, const ImageView& right, const StereoRegion& region,
                     const DisparityRange& range, const StereoMatching& matching);

}  // namespace tricue
