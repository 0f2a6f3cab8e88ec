// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/depth_view.hpp"
#include "cues/depth/depth_distance.hpp"

namespace tricue {

/// Where an upright rectangle is read: in the middles of rows x columns equal parts of it, and round it, on each side of a
/// rectangle `margin` times as large, in the middles of `along` equal parts of the rectangle's own width or height.
struct Places {
    int rows, columns;
    double margin;
    int along;
};

/// What depth_distance measures of rectangles in metres, and how much round each of them is at its depth too: a tracker's
/// likelihood of all its particles at once.
///
/// A state (X, Y, Z, W, H) is the upright rectangle W x H with the centre (X, Y, Z), seen by the camera: centre
/// (X (fx / Z) + (cx + 1/2), Y (fy / Z) + (cy + 1/2)), W (fx / Z) wide and H (fy / Z) high, where pixel (0, 0) covers
/// [0, 1) x [0, 1); what is so near that this overflows is outside the image. A place at the share u of the half width is in
/// column floor(x + (w / 2) u), likewise rows, in float64. Which depths count, and the distance from the model, are
/// depth_distance's.
///
/// @param depth  metres; may be empty
/// @param camera (4,): fx, fy above 0, cx, cy, pixels, (0, 0) is the centre of the first
/// @param states (N, 5): metres, camera frame; finite, Z above 0
/// @param model  histogram (L,) of sum 1, or all 0, none negative; reach above 0, finite
/// @param places rows, columns, along 1 to 64; margin at least 1, finite
/// @param nearer metres, finite, not negative
/// @returns      (N, 4): distance from the model in [0, 1], 1 where nothing counts; the share of the places inside that count; the
///               share inside whose depth is below Z - nearer; the share of the places round it that count
/// @throws std::invalid_argument on other shapes or values
/// Source: Sabeti, Parvizi, Wu 2008, equation (38), section IV.B; depth relative to Z, what is nearer, and the places round it are
/// ours.
States depth_contrast(const DepthView& depth, VectorRef camera, StatesRef states, const DepthModel& model,
                      const Places& places, double nearer);

}  // namespace tricue
