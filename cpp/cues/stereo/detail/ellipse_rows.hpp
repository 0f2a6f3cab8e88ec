// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>

namespace tricue {

/// The pixels of a row whose centres lie in the ellipse inscribed in a rectangle, in whole numbers and so the same everywhere:
/// (2 x + 1 - width)² height² + (2 y + 1 - height)² width² <= width² height², for sides up to 16384.
struct EllipseRows {
    int width, height;

    /// How many columns of row y are outside at either end; width / 2, rounded up, where all are.
    int margin(int y) const {
        const std::int64_t w = width, h = height, v = 2 * std::int64_t{y} + 1 - h;
        const std::int64_t room = (h * h - v * v) * w * w;
        const auto outside = [&](int x) {
            const std::int64_t u = 2 * std::int64_t{x} + 1 - w;
            return u * u * h * h > room;
        };
        // Nearly right already; then exactly.
        int x = static_cast<int>(
            (1.0 - std::sqrt(static_cast<double>(h * h - v * v)) / static_cast<double>(h)) * width / 2.0);
        while (x > 0 && !outside(x - 1)) --x;
        while (2 * x < width && outside(x)) ++x;
        return x;
    }
};

}  // namespace tricue
