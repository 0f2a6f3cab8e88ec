// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "base/arrays.hpp"
#include "base/depth_view.hpp"

namespace tricue {

using Flags = Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// When an object may go on beyond a side of its box.
struct Cut {
    int border;     ///< pixels from the image's edge within which it may go on outside
    double beside;  ///< metres from the side, where something in front of it is looked for,
    double nearer;  ///< so many metres nearer than the object,
    double share;   ///< on more than this share of the side
};

/// At which sides of its box a segmented object may go on: at the image's border, or behind something that is nearer.
///
/// Beside a side, `beside` metres away at the object's depth, 12 pixels are read, in the middles of 12 equal parts of it (of
/// the box that is larger by `beside` all round). Pixels outside the image, or not measured, are not nearer.
///
/// @param depth  metres
/// @param table  (C, 7): x, y, width, height, pixels; area; depth z, metres; label: depth_components' table; sizes, z above 0
/// @param camera (4,): fx, fy above 0, cx, cy, pixels
/// @param cut    border not negative; beside, nearer finite, not negative; share in [0, 1]
/// @returns      (C, 4): left, right, top, bottom
/// @throws std::invalid_argument on an argument that isn't what is said here
/// Source: ours.
Flags cut_sides(const DepthView& depth, StatesRef table, VectorRef camera, const Cut& cut);

}  // namespace tricue
