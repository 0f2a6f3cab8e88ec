// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/image_view.hpp"
#include "base/stack_view.hpp"
#include "cues/color/pick_pixels.hpp"

namespace tricue {

/// How far from the middle a peak is looked for, and how much less one counts that is farther off.
struct ShiftRange {
    int most_right;  ///< columns either way, at least 0
    int most_down;   ///< rows either way, at least 0
    double penalty;  ///< on a response, per squared column, finite
};

/// A shift to the right, in cells, and the filter's response to what has shifted.
struct Shift {
    double right, response;
};

/// By how many cells a patch has shifted to the right in other coordinates: in log-polar ones by the logarithm of a change of size, or
/// by a turn. One stage of the frame, in one call: pick_pixels, hog_color_cells, and correlation_response, of which the peak near the
/// middle counts.
///
/// The peak is the greatest response less `penalty` times the squared columns to the middle, in float32, the first of equal ones. The
/// place between the columns is that of the parabola through the logarithms of the response and its neighbors, at most half a cell
/// off (a Gaussian's peak exactly). Neighbors count as a twentieth of the peak at least. At the ends of the range, and where the
/// response isn't above 0, it is the column's own.
///
/// @param patch uint8 (H, W, 3) BGR, without padding between its rows
/// @param places int64 (2R, 2C): as pick_pixels has them
/// @param taper float32 (R, C)
/// @param filter complex64 (1, 19, R, C // 2 + 1)
/// @param most_right, most_down cells from column C // 2 and row R // 2, where all of them have to be cells
/// @param penalty finite
/// @returns right columns to the right
/// @returns response of the filter, in the cell of the peak
/// @throws std::invalid_argument on other shapes, or numbers out of range
/// Source: Reddy and Chatterji 1996; Li, Zhu, Hoi, Song, Wang, Liu 2019 (LDES).
Shift log_polar_shift(const ImageView& patch, PlacesRef places, FloatsRef taper, const FilterStack& filter,
                      const ShiftRange& range);

}  // namespace tricue
