// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "base/arrays.hpp"
#include "base/region.hpp"

namespace tricue {

/// Flow of an area, not empty, of one level of a pyramid, in that level's pixels. Rows have room up to a whole number of half blocks.
struct FlowField {
    explicit FlowField(const Region& part);

    Region area;
    Floats u, v;
};

/// The area of the next coarser level, of that size, between whose pixels an area lies.
Region coarser_region(const Region& area, int rows, int cols);

/// The initial flow of an area and of a margin around it, which repeats what is at the area's edge: from the next coarser level,
/// median-filtered (3x3), upsampled linearly, and doubled. Zero without a coarser level.
class FlowGuess {
public:
    FlowGuess(const Region& area, int margin);
    FlowGuess(const FlowField& coarse, const Region& area, int margin);

    const Region& area() const { return area_; }

    /// Flow along x and y in row y of the area, 0 the first, from the margin on its left to that on its right, and up to a whole
    /// number of half blocks.
    const float* u(int y) const { return plane(u_, y); }
    const float* v(int y) const { return plane(v_, y); }

private:
    void fill(const Floats& coarse, const Region& of, std::vector<float>& plane) const;
    const float* plane(const std::vector<float>& plane, int y) const {
        return plane.data() + std::clamp(y, 0, area_.y1 - area_.y0 - 1) * stride_;
    }

    Region area_;
    int margin_;
    std::ptrdiff_t stride_;
    std::vector<float> u_, v_;
};

}  // namespace tricue
