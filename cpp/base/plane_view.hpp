// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace tricue {

/// A non-owning, read-only view of a plane with one number per pixel: depth, flow, disparity or a reliability. Pixels are packed; rows
/// may be padded (`stride` floats apart). NaN means "not measured".
struct PlaneView {
    const float* data;
    int rows;
    int cols;
    std::ptrdiff_t stride;

    const float* row(int y) const { return data + y * stride; }
};

}  // namespace tricue
