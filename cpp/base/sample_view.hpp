// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

namespace tricue {

/// The pixels read under each ellipse, (N, 3, n) uint8 that somebody else owns: for every ellipse a plane of
/// n samples of blue, one of green and one of red, all contiguous. A whole image is one such "ellipse".
struct SampleView {
    const std::uint8_t* data;
    std::ptrdiff_t ellipses;
    std::ptrdiff_t n;

    const std::uint8_t* plane(std::ptrdiff_t ellipse, int channel) const {
        return data + (3 * ellipse + channel) * n;
    }
};

}  // namespace tricue
