// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

namespace tricue {

/// A non-owning, read-only view of the pixels sampled under N ellipses, (N, 3, n) uint8, contiguous: for every ellipse a plane of n
/// samples of blue, one of green and one of red. A whole image counts as one ellipse.
struct SampleView {
    const std::uint8_t* data;
    std::ptrdiff_t ellipses;
    std::ptrdiff_t n;

    const std::uint8_t* plane(std::ptrdiff_t ellipse, int channel) const {
        return data + (3 * ellipse + channel) * n;
    }
};

}  // namespace tricue
