// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "base/arrays.hpp"
#include "base/depth_view.hpp"
#include "cues/depth/depth_distance.hpp"

namespace tricue {

/// Where an upright rectangle is read: on a grid inside it, and on a ring around it.
struct RectanglePattern {
    int rows, columns;  ///< 1 to 64: inside, the middles of rows x columns equal parts are read
    double margin;      ///< the ring is the rectangle scaled by this, finite, at least 1
    int along;  ///< 1 to 64: on each side of the ring, the middles of so many equal parts of the rectangle's own side are read
};

/// The measurements of depth_distance for upright rectangles in meters, and the share around each of them that is at its depth,
/// too.
///
/// A state (X, Y, Z, W, H) is a rectangle of W x H around the point (X, Y, Z). In the image its center is (X (fx / Z) + (cx +
/// 1/2), Y (fy / Z) + (cy + 1/2)) and its size W (fx / Z) by H (fy / Z), where pixel (0, 0) covers [0, 1) x [0, 1); a rectangle
/// so near that this overflows is outside the image. The place at u half widths from the center is in column floor(x + (w / 2)
/// u), rows likewise, in float64. Which depths count, and the distance, are those of depth_distance.
///
/// @param depth float32 (H, W), meters; may be empty
/// @param camera float64 (4,): fx, fy, cx, cy, pixels, fx and fy above 0; (0, 0) is the center of the first pixel
/// @param states float64 (N, 5): X, Y, Z, W, H, meters, camera frame; finite, Z above 0
/// @param occluder_margin meters, finite, at least 0
/// @returns float64 (N, 4): distance from the model in [0, 1], 1 where nothing counts; share of the places inside that count; share
///     inside with a depth below Z - occluder_margin; share of the places around that count
/// @throws std::invalid_argument on other shapes or values
/// Source: Sabeti, Parvizi, Wu 2008, equation (38), section IV.B; depth relative to Z, the share in front and the ring are ours.
States depth_contrast(const DepthView& depth, VectorRef camera, StatesRef states,
                      const ReferenceHistogram& model, const RectanglePattern& places,
                      double occluder_margin);

/// The same for several sets of rectangles, one after the other, with memory that is reused.
class RectangleContrast {
public:
    /// Camera and model must outlive it.
    RectangleContrast(const DepthView& depth, VectorRef camera, const ReferenceHistogram& model,
                      const RectanglePattern& places, double occluder_margin);
    ~RectangleContrast();

    /// (N, 4), as by depth_contrast; the share that is nearer only if wanted, else 0.
    States measure(StatesRef states, bool with_nearer);

    /// The histogram (L,) of the rectangle, where one was measured: of sum 1; all 0 where nothing counts.
    Vector shares() const;

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

/// The histogram of the depths inside one such rectangle, relative to any depth z, as by rectangle_histogram.
///
/// @param state (5,), finite, Z above 0
/// @returns (levels,) of sum 1; all 0 where nothing counts
Vector depth_shares(const DepthView& depth, VectorRef camera, const double* state,
                    const RectanglePattern& places, double z, double reach, Eigen::Index levels);

}  // namespace tricue
