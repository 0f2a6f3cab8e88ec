// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/depth_view.hpp"
#include "base/region.hpp"
#include "cues/depth/cut_sides.hpp"
#include "cues/depth/depth_histogram.hpp"
#include "cues/depth/measure_objects.hpp"

namespace tricue {

/// Where objects are looked for: in a region, except where depth hasn't changed.
struct SearchedPixels {
    Region region;  ///< (x0, y0, x1, y1), pixels: [x0, x1) x [y0, y1), which may extend beyond the image
    /// float32 (H, W), meters: no object is looked for where changed_depth gives 0; (0, 0) for none
    DepthView before;
    double noise, noise_slope;  ///< as noise and slope in changed_depth
};

/// Where one object ends and another begins; each as in the kernels that segment_depth calls.
struct Divisions {
    DepthLevels levels;  ///< (near, far, count), as in depth_histogram
    double gap, slope;   ///< as in depth_edges
    double bandwidth;    ///< of depth_density, levels
    double prominence;   ///< of density_extrema, as a share of the greatest density
    int min_area;        ///< pixels, as in depth_components
};

/// C objects, the largest first.
struct DepthObjects {
    States measured;       ///< float64 (C, 8), as measure_objects gives it
    Flags cut;             ///< bool (C, 4): left, right, top, bottom: whether each may continue there
    Floats columns, rows;  ///< float32 (C, 16), as depth_components gives them
};

/// The objects of a depth image: connected components of the divisions of its range at the minima of its density.
///
/// It is ground_distance (with a floor; else distances are depths), depth_edges, whose pixels belong to no object, changed_depth,
/// depth_histogram, depth_density, density_extrema, divide_depth at near, the middles of the minima's levels (the first 254) and
/// far, depth_components, cut_sides, and measure_objects, one after the other. An object is also cut at a side less than `border`
/// pixels from the edge of the measured rectangle.
///
/// @param depth float32 (H, W), meters, NaN in the background; else in the range of `levels`
/// @param camera float64 (4,): fx, fy, cx, cy, pixels, fx and fy above 0
/// @param measured (x0, y0, x1, y1), pixels: outside of it nothing was measured
/// @throws std::invalid_argument as those kernels
/// Source: Sabeti, Parvizi, Wu 2008, equations (32)-(36), section IV.A; edges, floor and cuts are ours.
DepthObjects segment_depth(const DepthView& depth, const SearchedPixels& searched, VectorRef camera,
                           const Ground& ground, const Region& measured, const Divisions& divisions,
                           const Cut& cut);

}  // namespace tricue
