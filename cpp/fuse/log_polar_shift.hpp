// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/image_view.hpp"
#include "base/stack_view.hpp"
#include "cues/color/pick_pixels.hpp"

namespace tricue {

/// How far from the middle a peak is searched for, and the penalty on peaks that are farther off.
struct ShiftRange {
    int max_right;   ///< columns to either side of column C // 2, all of which have to exist
    int max_down;    ///< rows to either side of row R // 2, likewise
    double penalty;  ///< on a response, per squared column, finite
};

/// A shift to the right, in cells, and the filter's response to what has shifted.
struct Shift {
    double right, response;
};

/// The shift of a patch to the right in other coordinates, in cells: in log-polar ones the logarithm of a change of size, or a
/// turn. One stage of the frame, in one call: pick_pixels, hog_color_cells, and correlation_response, whose peak near the middle
/// gives the shift.
///
/// The peak is where the response minus `penalty` times the squared columns to the middle is greatest, in float32, the first of
/// equal ones. Its place between columns is the top of the parabola through the logarithms of the response there and of its
/// neighbors, at most half a cell off (exact for a Gaussian). Neighbors count as at least a twentieth of the peak. At the ends of
/// the range, and where the response isn't above 0, it is the column itself.
///
/// @param patch uint8 (H, W, 3) BGR, without padding between its rows
/// @param places int64 (2R, 2C): as pick_pixels takes them
/// @param taper float32 (R, C)
/// @param filter complex64 (1, 19, R, C // 2 + 1)
/// @returns right columns to the right
/// @returns response of the filter, in the cell of the peak
/// @throws std::invalid_argument on other shapes, or numbers out of range
/// Source: Reddy and Chatterji 1996; Li, Zhu, Hoi, Song, Wang, Liu 2019 (LDES).
Shift log_polar_shift(const ImageView& patch, PlacesRef places, FloatsRef taper, const FilterStack& filter,
                      const ShiftRange& range);

}  // namespace tricue
