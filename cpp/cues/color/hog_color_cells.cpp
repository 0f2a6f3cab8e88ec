// SPDX-License-Identifier: MIT
#include "cues/color/hog_color_cells.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "base/check.hpp"
#include "base/simd.hpp"
#include "cues/color/detail/padded_planes.hpp"

namespace tricue {
namespace {

constexpr int kBins = 8, kUnsigned = 4, kBlocks = 4, kColors = 3;
constexpr int kContrasts = kBins + kUnsigned + kBlocks;
constexpr float kMinContrast = 102.0F;  // gray levels; added to the energy of every block
constexpr float kMaxShare = 0.2F;       // of a block's contrast in one orientation of one cell
constexpr float kTexture = 0.2357F;     // 1 / sqrt(18), as in Felzenszwalb et al.

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

/// Distributes the gradient lengths of a row over kBins orientations: rows of n numbers that are `pitch` apart.
TRICUE_MULTIVERSION
void bin_orientations(const Neighbors& rows, int n, int pitch, float* out) {
    const float *b0 = rows.above[0], *b1 = rows.here[0], *b2 = rows.below[0];
    const float *g0 = rows.above[1], *g1 = rows.here[1], *g2 = rows.below[1];
    const float *r0 = rows.above[2], *r1 = rows.here[2], *r2 = rows.below[2];
    float *right = out, *right_down = right + pitch, *down = right_down + pitch, *left_down = down + pitch;
    float *left = left_down + pitch, *left_up = left + pitch, *up = left_up + pitch, *right_up = up + pitch;
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
        const float diagonal = shorter / (longer > 1.0F ? longer : 1.0F) * length;
        const float straight = length - diagonal;
        const float across = flat ? straight : 0.0F, along = flat ? 0.0F : straight;
        const float to_right = dx >= 0 ? diagonal : 0.0F, to_left = dx >= 0 ? 0.0F : diagonal;
        right[x] = dx >= 0 ? across : 0.0F;
        left[x] = dx >= 0 ? 0.0F : across;
        down[x] = dy >= 0 ? along : 0.0F;
        up[x] = dy >= 0 ? 0.0F : along;
        right_down[x] = dy >= 0 ? to_right : 0.0F;
        right_up[x] = dy >= 0 ? 0.0F : to_right;
        left_down[x] = dy >= 0 ? to_left : 0.0F;
        left_up[x] = dy >= 0 ? 0.0F : to_left;
    }
}

/// Weights (1, 3, 3, 1) for n numbers of four rows.
TRICUE_MULTIVERSION
void blend_rows(const float* __restrict first, const float* __restrict second, const float* __restrict third,
                const float* __restrict fourth, int n, float* __restrict sums) {
    for (int x = 0; x < n; ++x) sums[x] = (first[x] + fourth[x]) + 3.0F * (second[x] + third[x]);
}

/// Weights (1, 3, 3, 1) / 16 for the numbers 2 x - 1 to 2 x + 2 of kBins rows that are `pitch` apart: kBins rows of n cells.
TRICUE_MULTIVERSION
void blend_columns(const float* __restrict rows, int pitch, int n, float* __restrict cells) {
    for (int k = 0; k < kBins; ++k, rows += pitch, cells += n)
        for (int x = 0; x < n; ++x) {
            const float outer = rows[2 * x - 1] + rows[2 * x + 2], inner = rows[2 * x] + rows[2 * x + 1];
            cells[x] = (outer + 3.0F * inner) * 0.0625F;
        }
}

/// Sums of 2 x 2 of two rows of 2 n.
TRICUE_MULTIVERSION
void sum_cells(const float* __restrict upper, const float* __restrict lower, int n, float* __restrict cells) {
    for (int x = 0; x < n; ++x)
        cells[x] = (upper[2 * x] + lower[2 * x]) + (upper[2 * x + 1] + lower[2 * x + 1]);
}

/// The energy of n cells, from their kBins rows of sums.
TRICUE_MULTIVERSION
void find_energy(const float* __restrict sums, int n, float* __restrict energy) {
    const float *s0 = sums, *s1 = s0 + n, *s2 = s1 + n, *s3 = s2 + n;
    const float *s4 = s3 + n, *s5 = s4 + n, *s6 = s5 + n, *s7 = s6 + n;
    for (int x = 0; x < n; ++x) {
        const float u0 = s0[x] + s4[x], u1 = s1[x] + s5[x], u2 = s2[x] + s6[x], u3 = s3[x] + s7[x];
        energy[x] = u0 * u0 + u1 * u1 + u2 * u2 + u3 * u3;
    }
}

/// The exact sum of integers.
TRICUE_MULTIVERSION
void sum_integers(const float* __restrict numbers, std::ptrdiff_t n, std::int64_t* sum) {
    std::int64_t total = 0;
    for (std::ptrdiff_t i = 0; i < n; ++i) total += static_cast<std::int32_t>(numbers[i]);
    *sum = total;
}

/// Normalization factors of the n + 1 blocks between two rows of n cells with their borders.
TRICUE_MULTIVERSION
void find_scales(const float* __restrict above, const float* __restrict below, int n,
                 float* __restrict scales) {
    for (int x = 0; x <= n; ++x) {
        const float left = above[x - 1] + below[x - 1], right = above[x] + below[x];
        scales[x] = 1.0F / std::sqrt(left + right + kMinContrast * kMinContrast);
    }
}

/// Writes the normalized orientations and the texture of a row of n cells to planes that are `pitch` numbers apart. `upper` and
/// `lower` are the scales of the blocks above and below: those of cell x are at x, to the left, and x + 1, to the right.
TRICUE_MULTIVERSION
void normalize(const float* __restrict sums, const float* __restrict upper, const float* __restrict lower,
               const float* __restrict taper, int n, std::ptrdiff_t pitch, float* __restrict cells) {
    float* texture = cells + (kBins + kUnsigned) * pitch;
    TRICUE_INDEPENDENT
    for (int x = 0; x < n; ++x) {
        const float n0 = upper[x], n1 = upper[x + 1], n2 = lower[x], n3 = lower[x + 1], weight = taper[x];
        float t0 = 0, t1 = 0, t2 = 0, t3 = 0;
        const auto cut = [](float share) { return share < kMaxShare ? share : kMaxShare; };
        const auto put_signed = [&](int k) {
            const float sum = sums[k * n + x];
            const float c0 = cut(sum * n0), c1 = cut(sum * n1), c2 = cut(sum * n2), c3 = cut(sum * n3);
            t0 += c0, t1 += c1, t2 += c2, t3 += c3;
            cells[k * pitch + x] = 0.5F * (c0 + c1 + c2 + c3) * weight;
        };
        const auto put_unsigned = [&](int k) {
            const float sum = sums[k * n + x] + sums[(k + kUnsigned) * n + x];
            const float c0 = cut(sum * n0), c1 = cut(sum * n1), c2 = cut(sum * n2), c3 = cut(sum * n3);
            cells[(kBins + k) * pitch + x] = 0.5F * (c0 + c1 + c2 + c3) * weight;
        };
        // Unrolled by hand, because the compiler vectorizes only the innermost loop.
        put_signed(0), put_signed(1), put_signed(2), put_signed(3);
        put_signed(4), put_signed(5), put_signed(6), put_signed(7);
        put_unsigned(0), put_unsigned(1), put_unsigned(2), put_unsigned(3);
        texture[x] = kTexture * t0 * weight;
        texture[pitch + x] = kTexture * t1 * weight;
        texture[2 * pitch + x] = kTexture * t2 * weight;
        texture[3 * pitch + x] = kTexture * t3 * weight;
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

/// The four rows of a patch that a row of cells is made of, in kBins orientations, with a zero to the left and to the right.
class OrientationRows {
public:
    OrientationRows(PaddedPlanes& levels, int rows, int cols)
        : levels_(levels),
          rows_(rows),
          cols_(cols),
          numbers_(kRows * std::size_t(kBins) * std::size_t(pitch())) {}

    int pitch() const { return cols_ + 2; }
    int size() const { return kBins * pitch(); }

    /// Row y, with its zeros, while it is one of the last four that were computed; before any is, all are zero.
    float* row(int y) { return numbers_.data() + std::ptrdiff_t{(y + kRows) % kRows} * size(); }

    /// Outside the patch, everything is zero.
    void compute(int y) {
        if (y >= rows_) {
            std::fill_n(row(y), size(), 0.0F);
            return;
        }
        Neighbors near;
        for (int c = 0; c < kColors; ++c) {
            near.above[c] = levels_.row(c, y - 1);
            near.here[c] = levels_.row(c, y);
            near.below[c] = levels_.row(c, y + 1);
        }
        bin_orientations(near, cols_, pitch(), row(y) + 1);
    }

private:
    static constexpr int kRows = 4;

    PaddedPlanes& levels_;
    int rows_, cols_;
    std::vector<float> numbers_;
};

/// Sums of the orientations over cells; a row holds kBins numbers for each cell of a row.
Floats sum_orientations(PaddedPlanes& levels, int rows, int cols) {
    Floats sums(rows, kBins * cols);
    OrientationRows each(levels, 2 * rows, 2 * cols);
    std::vector<float> blended(static_cast<std::size_t>(each.size()));
    each.compute(0);
    for (int y = 0; y < rows; ++y) {
        each.compute(2 * y + 1);
        each.compute(2 * y + 2);
        blend_rows(each.row(2 * y - 1), each.row(2 * y), each.row(2 * y + 1), each.row(2 * y + 2),
                   each.size(), blended.data());
        blend_columns(blended.data() + 1, each.pitch(), cols, &sums(y, 0));
    }
    return sums;
}

void write_orientations(const Floats& sums, FloatsRef taper, FloatPlanes& cells) {
    const int rows = static_cast<int>(taper.rows()), cols = static_cast<int>(taper.cols());
    PaddedPlanes energy(1, rows, cols);
    for (int y = 0; y < rows; ++y) find_energy(&sums(y, 0), cols, energy.row(0, y));
    energy.replicate_border(0);
    Floats scales(rows + 1, cols + 1);
    for (int y = 0; y <= rows; ++y) find_scales(energy.row(0, y - 1), energy.row(0, y), cols, &scales(y, 0));
    for (int y = 0; y < rows; ++y) {
        const std::ptrdiff_t at = std::ptrdiff_t{y} * cols;
        normalize(&sums(y, 0), &scales(y, 0), &scales(y + 1, 0), taper.data() + at, cols, cells.pitch(),
                  cells.plane(0) + at);
    }
}

void write_colors(PaddedPlanes& levels, FloatsRef taper, FloatPlanes& cells) {
    const int rows = static_cast<int>(taper.rows()), cols = static_cast<int>(taper.cols());
    for (int c = 0; c < kColors; ++c) {
        float* plane = cells.plane(kContrasts + c);
        for (int y = 0; y < rows; ++y)
            sum_cells(levels.row(c, 2 * y), levels.row(c, 2 * y + 1), cols, plane + std::ptrdiff_t{y} * cols);
        center_color(mean_level(plane, taper.size()), taper.data(), static_cast<int>(taper.size()), plane);
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

FloatPlanes hog_color_cells(const ImageView& patch, FloatsRef taper) {
    require_arguments(patch, taper);
    PaddedPlanes levels(kColors, patch.rows, patch.cols);
    for (int y = 0; y < patch.rows; ++y)
        split_row(patch.row(y), patch.cols, levels.row(0, y), levels.row(1, y), levels.row(2, y));
    for (int c = 0; c < kColors; ++c) levels.replicate_border(c);
    const int rows = patch.rows / 2, cols = patch.cols / 2;
    FloatPlanes cells(kContrasts + kColors, rows, cols);
    write_orientations(sum_orientations(levels, rows, cols), taper, cells);
    write_colors(levels, taper, cells);
    return cells;
}

}  // namespace tricue
