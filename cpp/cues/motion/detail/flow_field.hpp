// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "base/region.hpp"
#include "base/row_ring_buffer.hpp"

namespace tricue {

/// A plane with room for one more pixel around it. Rows have room for whole blocks.
struct PaddedPlane {
    PaddedPlane(int height, int width);

    float* row(int y) { return pixels.data() + std::ptrdiff_t{y + 1} * stride + 1; }
    const float* row(int y) const { return pixels.data() + std::ptrdiff_t{y + 1} * stride + 1; }

    int rows, cols, stride;
    std::vector<float> pixels;
};

/// Flow of a nonempty area of one pyramid level, in that level's pixels.
struct FlowField {
    explicit FlowField(const Region& part);

    Region area;
    PaddedPlane u, v;
};

/// The area of the next coarser level, with this size, whose pixels enclose an area.
Region coarser_region(const Region& area, int rows, int cols);

/// The initial flow of an area and of a margin around it, which repeats the area's edge: from the next coarser level,
/// median-filtered (3x3), upsampled linearly, and doubled. Zero without a coarser level. It holds the rows of a margin and of a
/// batch.
class FlowGuess {
public:
    FlowGuess(const Region& area, int margin);
    FlowGuess(FlowField& coarse, const Region& area, int margin);

    const Region& area() const { return area_; }

    /// Computes row y of the area, from 0, or its edge row if y is beyond it; each y must be one more than the last.
    void advance(int y);

    /// Flow along x and y in row y of the area, one of the newest, from its left margin to its right one, and up to a whole
    /// number of blocks.
    const float* u(int y) { return u_rows_.row(std::clamp(y, 0, newest_)); }
    const float* v(int y) { return v_rows_.row(std::clamp(y, 0, newest_)); }

private:
    Region area_;
    int margin_, newest_ = -1;
    int x0_ = 0, y0_ = 0;  ///< of the coarse planes, in pixels of the finer level
    PaddedPlane u_, v_;
    RowRingBuffer u_rows_, v_rows_;
};

}  // namespace tricue
