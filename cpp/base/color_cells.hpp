// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "base/arrays.hpp"
#include "base/sample_view.hpp"

namespace tricue {

/// log2 of the bins per channel; throws std::invalid_argument, which names the argument, unless they are a power of two up to 64.
int bits_of_bins(std::ptrdiff_t bins, const char* name);

/// log2 of the side of a cube (B^2, B); throws std::invalid_argument unless that is a power of two up to 64.
int bits_of_cube(FloatsRef cube, const char* name);

/// The cell of every sample of one ellipse in a cube of 2^bits bins per channel: index (b bins + g) bins + r.
void color_cells(const SampleView& samples, std::ptrdiff_t ellipse, int bits, std::int32_t* cells);

/// The same for n pixels.
void pixel_cells(const std::uint8_t* pixels, std::ptrdiff_t n, int bits, std::int32_t* cells);

/// The same for n words, whose bytes are b, g, r from the lowest on.
void word_cells(const std::uint32_t* words, std::ptrdiff_t n, int bits, std::int32_t* cells);

}  // namespace tricue
