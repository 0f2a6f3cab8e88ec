// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "base/arrays.hpp"
#include "base/depth_view.hpp"

namespace tricue {

/// Reads the depths of rectangles at the places of a pattern, as defined by depth_distance.hpp. The image must outlive it.
class DepthReader {
public:
    /// @throws std::invalid_argument on a pattern that isn't (n, 2), n at least 1, or not finite
    DepthReader(const DepthView& depth, StatesRef pattern);

    /// Reads a rectangle of four finite numbers or more: center x, y, width, height. Returns the depths, 0 outside the image,
    /// zero-padded for RelativeHistogram.
    const float* read(const double* rectangle);

    std::size_t places() const { return row_.size(); }

private:
    DepthView depth_;
    Vector u_, v_;
    std::vector<std::int32_t> column_, row_;
    std::vector<float> depths_;
};

}  // namespace tricue
