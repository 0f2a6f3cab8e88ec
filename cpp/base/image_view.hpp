// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace tricue {

/// One color: blue, green, red.
using Bgr = std::array<std::uint8_t, 3>;

/// A non-owning, read-only view of an 8-bit image. Pixels are packed; rows may be padded (`stride` bytes apart).
struct ImageView {
    const std::uint8_t* data;
    int rows;
    int cols;
    int channels;
    std::ptrdiff_t stride;

    const std::uint8_t* row(int y) const { return data + y * stride; }
};

}  // namespace tricue
