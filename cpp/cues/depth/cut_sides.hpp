// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "base/arrays.hpp"
#include "base/depth_view.hpp"

namespace tricue {

using Flags = Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// When an object may continue beyond a side of its box.
struct Cut {
    int border;  ///< pixels from the image's edge within which an object may continue outside, at least 0
    /// distance from the side at which something nearer is looked for, meters, finite, at least 0
    double beside;
    double occluder_margin;  ///< how much nearer than the object that must be, meters, finite, at least 0
    double share;            ///< share of the side on more than which it must be nearer, in [0, 1]
};

/// The sides of its box at which a segmented object may continue: at the image's border, or behind something nearer.
///
/// Beside each side 12 pixels are read: those at the middles of 12 equal parts of that side of the box enlarged by `beside`
/// meters, at the object's depth, all around. Pixels outside the image, or not measured, don't count as nearer.
///
/// @param depth float32 (H, W), meters
/// @param table float64 (C, 7), as depth_components gives it: x, y, width, height, area, depth z, label; sizes and z above 0
/// @param camera float64 (4,): fx, fy, cx, cy, pixels, fx and fy above 0
/// @returns bool (C, 4): left, right, top, bottom
/// @throws std::invalid_argument on other shapes or values
/// Source: ours.
Flags cut_sides(const DepthView& depth, StatesRef table, VectorRef camera, const Cut& cut);

}  // namespace tricue
