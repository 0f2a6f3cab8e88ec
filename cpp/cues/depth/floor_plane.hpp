// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "base/arrays.hpp"
#include "base/depth_view.hpp"

namespace tricue {

/// Candidates, one a row: three pixels, each by its flat index, row * cols + col.
using Triples = Eigen::Array<std::int64_t, Eigen::Dynamic, 3, Eigen::RowMajor>;
using TriplesRef = Eigen::Ref<const Triples>;

/// Which planes count as level.
struct LevelRule {
    VectorRef up;  ///< float64 (3,): unit vector, within 1e-6, camera frame; (0, -1, 0) for a level camera
    double min_cosine;  ///< a plane is level where n · up is at least this, in [-1, 1]
};

/// The floor by RANSAC, with its random triples as an argument, and three rounds of least squares.
///
/// A triple gives the plane n · X + d = 0 through its points, |n| = 1, d > 0: the camera is above it. It is skipped where a pixel
/// was not measured, where the points are on a line (|a x b| <= 0.01 |a| |b| for the edges a, b from the first point p), where the
/// camera is in the plane (d <= 0.001 |p|), or where it is not level (n · up < min_cosine). The best has the highest score #(|h|
/// <= t) - 3 #(h < -3 t) over all measured pixels, h = n · X + d, t the tolerance; it must be above 0, and of equals the first is
/// taken. A floor has little below it, so a table loses against the floor around it.
///
/// A round of least squares takes the pixels within the tolerance, their mean, and the eigenvector of the smallest eigenvalue of
/// their covariance. It is left out with fewer than three pixels, or where its plane would have been skipped.
///
/// Points are (x z, y z, z) in float32, with (x, y, 1) the ray ((u - cx) / fx, (v - cy) / fy, 1) in float64, rounded to float32.
/// Heights are float32, ((nx X + ny Y) + nz Z) + d, with n, d, t and -3 t rounded; all else is float64. Cost: triples times pixels;
/// callers thin the image out.
///
/// @param depth float32 (H, W), meters
/// @param camera float64 (4,): fx, fy, cx, cy, pixels, fx and fy above 0
/// @param triples int64 (K, 3): three pixels each, by row * cols + col
/// @param tolerance t, meters, finite, above 0
/// @returns float64 (6,): nx, ny, nz, d (meters; camera frame: x right, y down, z forward), share of the measured pixels within the
///     tolerance of the plane, share below it (h < -3 t); zeros where no plane was found
/// @throws std::invalid_argument on other shapes or values
/// Source: ours; RANSAC after Fischler, Bolles 1981.
Vector floor_plane(const DepthView& depth, VectorRef camera, TriplesRef triples, double tolerance,
                   const LevelRule& level);

}  // namespace tricue
