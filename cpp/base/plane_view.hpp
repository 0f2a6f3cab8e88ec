// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace tricue {

/// A read-only plane of one number a pixel that somebody else owns, flow, disparity or how reliable they are: pixels are packed, rows
/// may be padded (`stride` floats apart). NaN is no reading.
struct PlaneView {
    const float* data;
    int rows;
    int cols;
    std::ptrdiff_t stride;

    const float* row(int y) const { return data + y * stride; }
};

}  // namespace tricue
