// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <optional>

#include "base/arrays.hpp"
#include "base/image_view.hpp"
#include "base/region.hpp"

namespace tricue {

/// Of one row.
struct FlowRow {
    float *u, *v;     ///< pixels per frame, NaN where unreliable
    float* angle;     ///< equation (5), 0 to 1
    float* contrast;  ///< equation (6), (gray levels per pixel squared) squared
};

/// u, v, angle and contrast (rows, cols) one below the other. One block of memory is allocated and freed faster than four.
struct FlowPlanes {
    FlowPlanes(Eigen::Index height, Eigen::Index width) : rows(height), planes(4 * height, width) {}

    FlowRow row(Eigen::Index y) {
        return {&planes(y, 0), &planes(rows + y, 0), &planes(2 * rows + y, 0), &planes(3 * rows + y, 0)};
    }

    Eigen::Index rows;
    Floats planes;
};

/// The smallest reliabilities of valid flow.
struct FlowMinima {
    double angle, contrast;
};

constexpr float kNoFlow = std::numeric_limits<float>::quiet_NaN();
constexpr float kRoundingContrast = 1e-6F;  ///< the contrast that float32 rounding leaves in a uniform image

/// Throw std::invalid_argument unless frames have pixels and the same size, at most 16384 per side, a region's corners are in
/// order and within them, the angle is 0 to 1 and the contrast finite and nonnegative.
void require_frames(const ImageView& previous, const ImageView& current, const std::optional<Region>& region);
void require_minima(const FlowMinima& minima);

/// The region, or all of the frame.
Region region_or_all(const std::optional<Region>& region, const ImageView& frame);

}  // namespace tricue
