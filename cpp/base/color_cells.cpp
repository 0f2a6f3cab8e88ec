// SPDX-License-Identifier: MIT
#include "base/color_cells.hpp"

#include "base/check.hpp"
#include "base/overlapping_blocks.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

TRICUE_MULTIVERSION
void find_cells(const std::uint8_t* __restrict blue, const std::uint8_t* __restrict green,
                const std::uint8_t* __restrict red, std::ptrdiff_t n, int bits,
                std::int32_t* __restrict cells) {
    const int shift = 8 - bits;
    for_overlapping_blocks(n, [=](std::ptrdiff_t k) {
        const std::int32_t b = blue[k] >> shift, g = green[k] >> shift, r = red[k] >> shift;
        cells[k] = (((b << bits) | g) << bits) | r;
    });
}

TRICUE_MULTIVERSION
void find_pixel_cells(const std::uint8_t* __restrict pixels, std::ptrdiff_t n, int bits,
                      std::int32_t* __restrict cells) {
    const int shift = 8 - bits;
    for_overlapping_blocks(n, [=](std::ptrdiff_t k) {
        const std::int32_t b = pixels[3 * k] >> shift, g = pixels[3 * k + 1] >> shift,
                           r = pixels[3 * k + 2] >> shift;
        cells[k] = (((b << bits) | g) << bits) | r;
    });
}

TRICUE_MULTIVERSION
void find_word_cells(const std::uint32_t* __restrict words, std::ptrdiff_t n, int bits,
                     std::int32_t* __restrict cells) {
    const std::uint32_t mask = (1U << bits) - 1U;
    for (std::ptrdiff_t k = 0; k < n; ++k) {
        const std::uint32_t b = words[k] >> (8 - bits) & mask, g = words[k] >> (16 - bits) & mask,
                            r = words[k] >> (24 - bits) & mask;
        cells[k] = static_cast<std::int32_t>((((b << bits) | g) << bits) | r);
    }
}

}  // namespace

void pixel_cells(const std::uint8_t* pixels, std::ptrdiff_t n, int bits, std::int32_t* cells) {
    find_pixel_cells(pixels, n, bits, cells);
}

void word_cells(const std::uint32_t* words, std::ptrdiff_t n, int bits, std::int32_t* cells) {
    find_word_cells(words, n, bits, cells);
}

int bits_of_bins(std::ptrdiff_t bins, const char* name) {
    for (int bits = 0; bits <= 6; ++bits)
        if (bins == 1 << bits) return bits;
    refuse(name, "a power of two from 1 to 64", std::to_string(bins));
}

int bits_of_cube(FloatsRef cube, const char* name) {
    for (int bits = 0; bits <= 6; ++bits)
        if (cube.cols() == 1 << bits && cube.rows() == 1 << (2 * bits)) return bits;
    refuse(name, "shape (B, B, B), B a power of two up to 64", "B = " + std::to_string(cube.cols()));
}

void color_cells(const SampleView& samples, std::ptrdiff_t ellipse, int bits, std::int32_t* cells) {
    find_cells(samples.plane(ellipse, 0), samples.plane(ellipse, 1), samples.plane(ellipse, 2), samples.n,
               bits, cells);
}

}  // namespace tricue
