// SPDX-License-Identifier: MIT
#include "cues/color/gradient_color_cells.hpp"

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "base/check.hpp"
#include "base/simd.hpp"
#include "cues/color/detail/padded_planes.hpp"

namespace tricue {
namespace {

constexpr int kBins = 8, kColors = 3;
constexpr float kMinContrast = 32.0F;  // gray levels; added to the energy of every cell
constexpr float kMaxCell = 0.4F;

TRICUE_MULTIVERSION
void split_row(const std::uint8_t* __restrict pixels, int n, float* __restrict blue, float* __restrict green,
               float* __restrict red) {
    for (int x = 0; x < n; ++x) {
        blue[x] = pixels[3 * x];
        green[x] = pixels[3 * x + 1];
        red[x] = pixels[3 * x + 2];
    }
}

/// A row of each channel and the ones above and below it.
struct Neighbors {
    const float *above[kColors], *here[kColors], *below[kColors];
};

/// Distributes the gradient lengths of a row over kBins orientations, kBins rows of n numbers; kAdd adds to what is there.
template <bool kAdd>
inline void bin_orientations(const Neighbors& rows, int n, float* out) {
    const float *b0 = rows.above[0], *b1 = rows.here[0], *b2 = rows.below[0];
    const float *g0 = rows.above[1], *g1 = rows.here[1], *g2 = rows.below[1];
    const float *r0 = rows.above[2], *r1 = rows.here[2], *r2 = rows.below[2];
    float *right = out, *right_down = out + n, *down = out + 2 * n, *left_down = out + 3 * n;
    float *left = out + 4 * n, *left_up = out + 5 * n, *up = out + 6 * n, *right_up = out + 7 * n;
    const auto assign = [](float& to, float share) { to = kAdd ? to + share : share; };
    TRICUE_INDEPENDENT
    for (int x = 0; x < n; ++x) {
        float dx = b1[x + 1] - b1[x - 1], dy = b2[x] - b0[x];
        float square = dy * dy + dx * dx;
        const auto take_if_longer = [&](float other_x, float other_y) {
            const float other = other_y * other_y + other_x * other_x;
            const bool longer = other > square;
            dx = longer ? other_x : dx;
            dy = longer ? other_y : dy;
            square = longer ? other : square;
        };
        take_if_longer(g1[x + 1] - g1[x - 1], g2[x] - g0[x]);
        take_if_longer(r1[x + 1] - r1[x - 1], r2[x] - r0[x]);
        const float ax = std::fabs(dx), ay = std::fabs(dy), length = std::sqrt(square);
        const bool flat = ax >= ay;
        const float shorter = flat ? ay : ax, longer = flat ? ax : ay;
        const float diagonal = shorter * length / (longer > 1.0F ? longer : 1.0F);
        const float straight = length - diagonal;
        const float across = flat ? straight : 0.0F, along = flat ? 0.0F : straight;
        const float to_right = dx >= 0 ? diagonal : 0.0F, to_left = dx >= 0 ? 0.0F : diagonal;
        assign(right[x], dx >= 0 ? across : 0.0F);
        assign(left[x], dx >= 0 ? 0.0F : across);
        assign(down[x], dy >= 0 ? along : 0.0F);
        assign(up[x], dy >= 0 ? 0.0F : along);
        assign(right_down[x], dy >= 0 ? to_right : 0.0F);
        assign(right_up[x], dy >= 0 ? 0.0F : to_right);
        assign(left_down[x], dy >= 0 ? to_left : 0.0F);
        assign(left_up[x], dy >= 0 ? 0.0F : to_left);
    }
}

/// Sums over two rows.
TRICUE_MULTIVERSION
void bin_two_rows(const Neighbors& upper, const Neighbors& lower, int n, float* out) {
    bin_orientations<false>(upper, n, out);
    bin_orientations<true>(lower, n, out);
}

TRICUE_MULTIVERSION
void sum_pairs(const float* __restrict pairs, int n, float* __restrict sums) {
    for (int x = 0; x < n; ++x) sums[x] = pairs[2 * x] + pairs[2 * x + 1];
}

/// Sums of 2 x 2 of two rows of 2 n.
TRICUE_MULTIVERSION
void sum_cells(const float* __restrict upper, const float* __restrict lower, int n, float* __restrict cells) {
    for (int x = 0; x < n; ++x)
        cells[x] = (upper[2 * x] + lower[2 * x]) + (upper[2 * x + 1] + lower[2 * x + 1]);
}

/// Adds the squares of kBins rows of n.
TRICUE_MULTIVERSION
void add_squares(const float* __restrict cells, int n, float* __restrict energy) {
    for (int k = 0; k < kBins; ++k, cells += n)
        for (int x = 0; x < n; ++x) energy[x] += cells[x] * cells[x];
}

/// The exact sum of integers.
TRICUE_MULTIVERSION
void sum_integers(const float* __restrict numbers, std::ptrdiff_t n, std::int64_t* sum) {
    std::int64_t total = 0;
    for (std::ptrdiff_t i = 0; i < n; ++i) total += static_cast<std::int32_t>(numbers[i]);
    *sum = total;
}

/// Normalization factors from the energy of three rows of cells; `column` holds n + 2 numbers.
TRICUE_MULTIVERSION
void find_scales(const float* __restrict above, const float* __restrict here, const float* __restrict below,
                 int n, float* __restrict column, float* __restrict scales) {
    for (int x = 0; x < n + 2; ++x) column[x] = above[x - 1] + here[x - 1] + below[x - 1];
    for (int x = 0; x < n; ++x)
        scales[x] = 1.0F / std::sqrt(column[x] + column[x + 1] + column[x + 2] + kMinContrast * kMinContrast);
}

/// Writes kBins rows of n to planes that are `plane` numbers apart.
TRICUE_MULTIVERSION
void normalize(const float* __restrict sums, const float* __restrict scales, const float* __restrict taper,
               int n, std::ptrdiff_t plane, float* __restrict cells) {
    for (int k = 0; k < kBins; ++k, sums += n, cells += plane)
        for (int x = 0; x < n; ++x) {
            const float normal = sums[x] * scales[x];
            cells[x] = (normal < kMaxCell ? normal : kMaxCell) * taper[x];
        }
}

TRICUE_MULTIVERSION
void center_color(float mean, const float* __restrict taper, int n, float* __restrict cells) {
    for (int x = 0; x < n; ++x) cells[x] = (cells[x] / 1020.0F - mean) * taper[x];
}

/// The mean of a plane of sums of four levels, in [0, 1].
float mean_level(const float* cells, Eigen::Index count) {
    std::int64_t sum = 0;
    sum_integers(cells, count, &sum);
    return static_cast<float>(static_cast<double>(sum) / (1020.0 * static_cast<double>(count)));
}

/// Sums of the orientations over cells; a row holds kBins numbers for each cell of a row.
Floats sum_orientations(PaddedPlanes& levels, int rows, int cols) {
    const auto around = [&](int y) {
        Neighbors near;
        for (int c = 0; c < kColors; ++c) {
            near.above[c] = levels.row(c, y - 1);
            near.here[c] = levels.row(c, y);
            near.below[c] = levels.row(c, y + 1);
        }
        return near;
    };
    Floats sums(rows, kBins * cols);
    std::vector<float> shares(static_cast<std::size_t>(kBins * 2 * cols));
    for (int y = 0; y < rows; ++y) {
        bin_two_rows(around(2 * y), around(2 * y + 1), 2 * cols, shares.data());
        sum_pairs(shares.data(), kBins * cols, &sums(y, 0));
    }
    return sums;
}

void write_orientations(const Floats& sums, FloatsRef taper, float* cells) {
    const int rows = static_cast<int>(taper.rows()), cols = static_cast<int>(taper.cols());
    PaddedPlanes energy(1, rows, cols);
    for (int y = 0; y < rows; ++y) add_squares(&sums(y, 0), cols, energy.row(0, y));
    energy.replicate_border(0);
    std::vector<float> column(static_cast<std::size_t>(cols + 2)), scales(column.size());
    for (int y = 0; y < rows; ++y) {
        find_scales(energy.row(0, y - 1), energy.row(0, y), energy.row(0, y + 1), cols, column.data(),
                    scales.data());
        const std::ptrdiff_t at = std::ptrdiff_t{y} * cols;
        normalize(&sums(y, 0), scales.data(), taper.data() + at, cols, taper.size(), cells + at);
    }
}

void write_colors(PaddedPlanes& levels, FloatsRef taper, float* cells) {
    const int rows = static_cast<int>(taper.rows()), cols = static_cast<int>(taper.cols());
    for (int c = 0; c < kColors; ++c, cells += taper.size()) {
        for (int y = 0; y < rows; ++y)
            sum_cells(levels.row(c, 2 * y), levels.row(c, 2 * y + 1), cols, cells + std::ptrdiff_t{y} * cols);
        center_color(mean_level(cells, taper.size()), taper.data(), static_cast<int>(taper.size()), cells);
    }
}

void require_arguments(const ImageView& patch, FloatsRef taper) {
    if (taper.size() < 1) refuse("taper", "at least one cell", "none");
    const auto shape = [](Eigen::Index rows, Eigen::Index cols) {
        return "(" + std::to_string(rows) + ", " + std::to_string(cols) + ", 3)";
    };
    if (patch.rows != 2 * taper.rows() || patch.cols != 2 * taper.cols())
        refuse("patch", "shape " + shape(2 * taper.rows(), 2 * taper.cols()) + ", twice the taper's",
               shape(patch.rows, patch.cols));
}

}  // namespace

Floats gradient_color_cells(const ImageView& patch, FloatsRef taper) {
    require_arguments(patch, taper);
    PaddedPlanes levels(kColors, patch.rows, patch.cols);
    for (int y = 0; y < patch.rows; ++y)
        split_row(patch.row(y), patch.cols, levels.row(0, y), levels.row(1, y), levels.row(2, y));
    for (int c = 0; c < kColors; ++c) levels.replicate_border(c);
    const int rows = patch.rows / 2, cols = patch.cols / 2;
    Floats cells((kBins + kColors) * rows, cols);
    write_orientations(sum_orientations(levels, rows, cols), taper, cells.data());
    write_colors(levels, taper, cells.data() + kBins * taper.size());
    return cells;
}

}  // namespace tricue
