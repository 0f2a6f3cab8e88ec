// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/depth_pixels.hpp"
#include "base/depth_view.hpp"
#include "cues/depth/depth_posterior.hpp"

namespace tricue {

/// A target in the middle of a grid.
struct SupportedTarget {
    double width, height;  ///< of its box, squares of the grid, finite, above 0
    double z;              ///< its depth, meters, finite, above 0
};

/// The pixels of a target's surround, and of its box, that lie on one plane: the one it stands on, lies on or leans against.
///
/// The depths under the centers of a grid's squares are read as by depth_posterior; those of 2 z and more count as not measured.
/// The measured squares of every second row and column vote, outside of the box taken 1.05 times as wide and high: floor_plane,
/// with every plane counted as level, takes triples of these n squares; in their order from top left, a draw u is number floor(u
/// n). Then square (i, j) is on the plane where
///     |(nx X + ny Y + nz) z_ij + d| < t,  X = (x0 + j step - cx) / fx,  Y = (y0 + i step - cy) / fy
///
/// in float64. There is no such square if fewer than 60 squares vote, if the plane has less than 0.15 of them, or if it has more
/// than half of the measured ones in the inner 0.8 of the box: such a target is as flat as the plane. A scaled box holds the
/// squares whose centers are nearer to the middle than half its width and half its height, each half at least 1.
///
/// @param depth float32 (H, W), meters; may be empty
/// @param camera float64 (4,): fx, fy, cx, cy of the depth image, pixels, fx and fy above 0
/// @param draws float64 (K, 3), random numbers in [0, 1): a triple each
/// @param tolerance t, meters, finite, above 0
/// @returns uint8 (rows, columns): 1 on the plane, else 0
/// @throws std::invalid_argument on other shapes, or numbers out of range
/// Source: ours; RANSAC after Fischler, Bolles 1981.
Labels support_pixels(const DepthView& depth, const SampleGrid& grid, const SupportedTarget& target,
                      VectorRef camera, StatesRef draws, double tolerance);

}  // namespace tricue
