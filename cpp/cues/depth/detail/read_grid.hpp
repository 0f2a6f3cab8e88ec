// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/depth_view.hpp"
#include "cues/depth/depth_posterior.hpp"

namespace tricue {

/// Depths of the pixels under the centers of a grid's squares, 0 outside the image.
Floats read_grid(const DepthView& depth, const SampleGrid& grid);

constexpr int kMaxGridSide = 4096;

/// @throws std::invalid_argument unless the grid's numbers are in their ranges
void require_grid(const SampleGrid& grid);

}  // namespace tricue
