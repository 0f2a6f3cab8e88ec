// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "base/arrays.hpp"
#include "cues/color/learn_contrast.hpp"

namespace tricue {

/// The number of pixels of each color, in a cube of 2^bits bins per channel.
struct ColorCounts {
    explicit ColorCounts(int bits) : cells(std::size_t{1} << (3 * bits)) {}

    void add(const std::uint8_t* pixel, int bits) {
        const int shift = 8 - bits;
        ++cells[(((static_cast<std::size_t>(pixel[0]) >> shift) << bits | pixel[1] >> shift) << bits) |
                pixel[2] >> shift];
        ++pixels;
    }

    /// The cube in `rows` rows, with sum 1, or all 0 if there are no pixels.
    Floats shares(Eigen::Index rows) const;

    std::vector<std::int32_t> cells;
    std::int32_t pixels = 0;
};

/// Throws std::invalid_argument as learn_contrast says.
void require_histograms(FloatsRef target, FloatsRef surround, double rate, double rare);

/// The result of learn_contrast from observed histograms; `unseen` is P(target) of a color that neither side has.
ColorContrast learn_histograms(Floats within, Floats without, FloatsRef target, FloatsRef surround,
                               double rate, double rare, double unseen);

}  // namespace tricue
