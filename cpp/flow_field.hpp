// SPDX-License-Identifier: MIT
#pragma once

#include "camera/arrays.hpp"
#include "camera/region.hpp"

namespace tricue {

/// Flow of an area, not empty, of one level of a pyramid, in that level's pixels.
struct FlowField {
    explicit FlowField(const Region& of) : area(of), u(Floats::Zero(of.y1 - of.y0, of.x1 - of.x0)), v(u) {}

    Region area;
    Floats u, v;
};

/// What of the next coarser level, of that size, an area lies between.
Region halved(const Region& area, int rows, int cols);

/// The flow at the next finer level, smoothed by the median of 3x3: between its pixels linear, in finer pixels twice as long.
FlowField doubled(const FlowField& flow, const Region& finer);

}  // namespace tricue
