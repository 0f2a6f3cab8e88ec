// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace tricue {

/// A read-only depth image in metres that somebody else owns: pixels are packed, rows may be padded (`stride` floats apart).
/// NaN, or anything else that isn't above 0 and finite, is no measurement.
struct DepthView {
    const float* data;
    int rows;
    int cols;
    std::ptrdiff_t stride;

    const float* row(int y) const { return data + y * stride; }
};

}  // namespace tricue
