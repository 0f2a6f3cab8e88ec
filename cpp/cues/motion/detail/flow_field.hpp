// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/region.hpp"

namespace tricue {

/// Flow of an area, not empty, of one level of a pyramid, in that level's pixels.
struct FlowField {
    Region area;
    Floats u, v;
};

/// The area of the next coarser level, of that size, between whose pixels an area lies.
Region coarser_region(const Region& area, int rows, int cols);

/// The initial flow of an area, from the next coarser level: median-filtered (3x3), upsampled linearly, and doubled. Zero without a
/// coarser level.
class FlowGuess {
public:
    explicit FlowGuess(const Region& area) : area_(area) {}
    FlowGuess(const FlowField& coarse, const Region& area);

    const Region& area() const { return area_; }

    /// Of row y of the area, 0 the first, all pixels.
    void row(int y, float* u, float* v);

private:
    void upsample_row(const Floats& plane, int y, float* out);

    Region area_;
    int x0_ = 0, y0_ = 0;  ///< of the coarse planes, in pixels of the finer level
    Floats u_, v_, sum_;
};

}  // namespace tricue
