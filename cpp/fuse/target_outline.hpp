// SPDX-License-Identifier: MIT
#pragma once

#include "fuse/detail/block_grid.hpp"
#include "fuse/temporal_window.hpp"

namespace tricue {

/// The rectangle around the target in its blocks: around its target pixels, and those at its disparity.
///
/// The temporal_window, without clean-up and with a trim of 0.02, of the pixels in blocks of state 1 that are set in the mask or whose
/// disparity differs by at most the tolerance from the target's.
///
/// @param mask uint8 (H, W): target pixels, those that are not 0
/// @param disparity float32 (H, W), pixels, NaN where there is none
/// @param states int64 (N,)
/// @param target the target's disparity, pixels
/// @param tolerance pixels
/// @returns box (x0, y0, x1, y1), pixels; all 0 without any such pixel
/// @returns count of these pixels
/// @throws std::invalid_argument on different shapes and sizes, and corners that are not finite
/// Source: ours.
TemporalWindow target_outline(const ImageView& mask, const PlaneView& disparity, const BlockGrid& grid,
                              BlockNumbers states, float target, float tolerance);

}  // namespace tricue
