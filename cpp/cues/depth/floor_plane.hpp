// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "base/arrays.hpp"
#include "base/depth_view.hpp"

namespace tricue {

/// Candidates, one a row: three pixels, each by its flat index, row * cols + col.
using Triples = Eigen::Array<std::int64_t, Eigen::Dynamic, 3, Eigen::RowMajor>;
using TriplesRef = Eigen::Ref<const Triples>;

/// What counts as level: planes with n · up >= least_cosine. `up` is a unit vector; (0, -1, 0) for a level camera.
struct Level {
    VectorRef up;
    double least_cosine;
};

/// The floor by RANSAC, whose random numbers are an argument, and three rounds of least squares.
///
/// A triple gives the plane n · X + d = 0 through its points, |n| = 1, the camera above it: d > 0. It is skipped where a
/// pixel wasn't measured, where the points are on a line (|a x b| <= 0.01 |a| |b| for the edges a, b from the first point p), as
/// repeated ones are, where the camera is in the plane (d <= 0.001 |p|), and where it isn't level. The best has the highest
/// score #(|h| <= t) - 3 #(h < -3 t) of all measured pixels, h = n · X + d, t the tolerance; it has to be above 0, and of
/// equals the first is taken. A floor has little below it: so a table loses against the floor round it.
///
/// A round of least squares takes the pixels within tolerance, their mean, and the eigenvector of the smallest eigenvalue of
/// their covariance. It isn't made where there are fewer than three, or where its plane would have been skipped.
///
/// Points are (x z, y z, z) in float32, where (x, y, 1) is the ray of the pixel, (u - cx) / fx and (v - cy) / fy in
/// float64, rounded to float32. Heights are counted in float32, ((nx X + ny Y) + nz Z) + d, with n, d, t and -3 t rounded to it;
/// everything else is float64. Cost: triples x pixels; callers thin the image out.
///
/// @param depth     metres
/// @param camera    (4,): fx, fy above 0, cx, cy, pixels
/// @param triples   K x 3, indices of pixels
/// @param tolerance t, metres, finite, above 0
/// @param level     |up| = 1 but for 1e-6, least_cosine in [-1, 1]
/// @returns         (6,): nx, ny, nz, d (metres; camera frame: x right, y down, z forward), share of the measured pixels within
///                  tolerance of the plane, share below it (h < -3 t); zeros where no plane was found
/// @throws std::invalid_argument on an argument that isn't what is said here
/// Source: ours; RANSAC after Fischler, Bolles 1981.
Vector floor_plane(const DepthView& depth, VectorRef camera, TriplesRef triples, double tolerance,
                   const Level& level);

}  // namespace tricue
