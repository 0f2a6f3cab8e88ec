// SPDX-License-Identifier: MIT
#include "fuse/detail/small_fourier.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/simd.hpp"
#include "fuse/detail/matrix_product.hpp"

namespace tricue {
namespace {

/// How many of n numbers (or frequencies) have a mirror image among the others.
constexpr int mirrored_count(int n) {
    return (n - 1) / 2;
}

/// The numbers of n outside the margins.
struct Inside {
    Inside(int n, int margin) : first(margin), count(margin > 0 ? n - 2 * margin + 1 : n) {}

    int first, count;
};

TRICUE_MULTIVERSION
void look_up(const float* __restrict table, const int* __restrict index, int n, float* __restrict out) {
    for (int i = 0; i < n; ++i) out[i] = table[index[i]];
}

TRICUE_MULTIVERSION
void advance(int period, int n, int* __restrict products) {
    for (int v = 0; v < n; ++v) {
        const int next = products[v] + v;
        products[v] = next < period ? next : next - period;
    }
}

/// For each number x, the cosines of the nonnegative ones of n frequencies, followed by negative sines without those that are 0.
void write_basis(int n, AlignedMatrix& basis) {
    constexpr double kTwoPi = 6.283185307179586;
    const auto count = static_cast<std::size_t>(n);
    std::vector<float> cosines(count), sines(count);
    for (std::size_t k = 0; k < count; ++k) {
        const double angle = kTwoPi * static_cast<double>(k) / n;
        cosines[k] = static_cast<float>(std::cos(angle));
        sines[k] = static_cast<float>(-std::sin(angle));
    }
    const int half = n / 2 + 1;
    std::vector<int> products(static_cast<std::size_t>(half));  // of x and each frequency, modulo n
    for (int x = 0; x < basis.rows(); ++x) {
        look_up(cosines.data(), products.data(), half, basis.row(x));
        look_up(sines.data(), products.data() + 1, mirrored_count(n), basis.row(x) + half);
        advance(n, half, products.data());
    }
}

/// The transpose of a basis, times `scale`, and twice that for a frequency with a mirror image.
void write_inverse(const AlignedMatrix& basis, float scale, AlignedMatrix& inverse) {
    const int n = basis.cols(), half = n / 2 + 1;
    for (int part = 0; part < n; ++part) {
        const bool single = part == 0 || (n % 2 == 0 && part == half - 1);
        const float weight = single ? scale : 2 * scale;
        for (int x = 0; x < n; ++x) inverse.row(part)[x] = weight * basis.row(x)[part];
    }
}

/// Sums and differences of the rows `first` to `last` and their mirror images; all matrices have the same pitch.
TRICUE_MULTIVERSION
void fold(const float* __restrict lines, std::ptrdiff_t pitch, int rows, int cols, int first, int last,
          float* __restrict sums, float* __restrict differences) {
    for (int y = first; y <= last; ++y) {
        const float *line = lines + pitch * y, *mirror = lines + pitch * (rows - y);
        float *sum = sums + pitch * y, *difference = differences + pitch * y;
        TRICUE_INDEPENDENT
        for (int x = 0; x < cols; ++x) {
            sum[x] = line[x] + mirror[x];
            difference[x] = line[x] - mirror[x];
        }
    }
}

/// The rows `first` to `last` and their mirror images from sums and differences.
TRICUE_MULTIVERSION
void unfold(const float* __restrict sums, const float* __restrict differences, std::ptrdiff_t pitch, int rows,
            int cols, int first, int last, float* __restrict lines) {
    for (int y = first; y <= last; ++y) {
        const float *sum = sums + pitch * y, *difference = differences + pitch * y;
        float *line = lines + pitch * y, *mirror = lines + pitch * (rows - y);
        TRICUE_INDEPENDENT
        for (int x = 0; x < cols; ++x) {
            line[x] = sum[x] + difference[x];
            mirror[x] = sum[x] - difference[x];
        }
    }
}

/// Like fold, of a spectrum's rows. Columns are as in lines: sums of real parts, behind them of imaginary ones; what each is turned
/// into by a sine stands in the same place of `differences`. Whatever the middle frequency of an even count has there is behind all.
TRICUE_MULTIVERSION
void fold_spectrum(const float* __restrict re, const float* __restrict im, std::ptrdiff_t pitch, int rows,
                   int half, int last, float* __restrict sums, float* __restrict differences) {
    for (int u = 1; u <= last; ++u) {
        const float *row_re = re + std::ptrdiff_t{half} * u, *row_im = im + std::ptrdiff_t{half} * u;
        const float *mirror_re = re + std::ptrdiff_t{half} * (rows - u),
                    *mirror_im = im + std::ptrdiff_t{half} * (rows - u);
        float *sum = sums + pitch * u, *difference = differences + pitch * u;
        TRICUE_INDEPENDENT
        for (int v = 0; v < half; ++v) {
            sum[v] = row_re[v] + mirror_re[v];
            difference[v] = row_im[v] - mirror_im[v];
        }
        TRICUE_INDEPENDENT
        for (int v = 1; v < half; ++v) {
            sum[half - 1 + v] = row_im[v] + mirror_im[v];
            difference[half - 1 + v] = mirror_re[v] - row_re[v];
        }
    }
}

/// A spectrum from the products of lines with cosines and sines.
TRICUE_MULTIVERSION
void combine(const float* __restrict cosine_part, const float* __restrict sine_part, std::ptrdiff_t pitch,
             int rows, int half, int pairs, float* __restrict re, float* __restrict im) {
    for (int u = 0; u <= rows / 2; ++u) {
        const float *cosine = cosine_part + pitch * u, *sine = sine_part + pitch * u;
        const float *cosine_im = cosine + half - 1, *sine_im = sine + half - 1;
        const bool mirrored = u >= 1 && 2 * u < rows;
        float *row_re = re + std::ptrdiff_t{half} * u, *row_im = im + std::ptrdiff_t{half} * u;
        // A row without a mirror image is written twice, the correct one last.
        float* mirror_re = mirrored ? re + std::ptrdiff_t{half} * (rows - u) : row_re;
        float* mirror_im = mirrored ? im + std::ptrdiff_t{half} * (rows - u) : row_im;
        TRICUE_INDEPENDENT
        for (int v = 0; v < half; ++v) {
            const bool paired = v >= 1 && v <= pairs;
            const float own_re = cosine[v], own_im = paired ? cosine_im[v] : 0.0F;
            const float turned_re = paired ? sine_im[v] : 0.0F, turned_im = sine[v];
            mirror_re[v] = own_re + turned_re;
            mirror_im[v] = own_im - turned_im;
            row_re[v] = own_re - turned_re;
            row_im[v] = own_im + turned_im;
        }
    }
}

}  // namespace

SmallFourier::SmallFourier(int rows, int cols)
    : rows_(rows),
      cols_(cols),
      half_(cols / 2 + 1),
      row_basis_(cols, cols),
      inverse_row_basis_(cols, cols),
      column_basis_(rows / 2 + 1, rows),
      lines_(rows, 2 * half_),
      sums_(rows / 2 + 1, 2 * half_),
      differences_(rows / 2 + 1, 2 * half_),
      cosine_part_(rows / 2 + 1, 2 * half_),
      sine_part_(rows / 2 + 1, 2 * half_),
      plane_(rows, cols) {
    write_basis(cols, row_basis_);
    write_inverse(row_basis_, 1.0F / static_cast<float>(rows * cols), inverse_row_basis_);
    if (rows == cols)
        for (int y = 0; y < column_basis_.rows(); ++y)
            std::copy_n(row_basis_.row(y), rows, column_basis_.row(y));
    else
        write_basis(rows, column_basis_);
}

void SmallFourier::multiply_down(int first_input, int first_output) {
    const int half = rows_ / 2 + 1;
    multiply({column_basis_.row(first_output) + first_input, column_basis_.pitch(), half - first_output},
             {sums_.row(first_input), sums_.pitch(), half - first_input}, cols_, cosine_part_, first_output);
    // Sines of 0 are 0, and so is the first row of sine_part_.
    const int from = std::max(first_input, 1), to = std::max(first_output, 1);
    multiply({column_basis_.row(to) + half + from - 1, column_basis_.pitch(), half - to},
             {differences_.row(from), differences_.pitch(), mirrored_count(rows_) - from + 1}, cols_,
             sine_part_, to);
}

void SmallFourier::transform(const float* plane, float* re, float* im, const Margins& margins) {
    const Inside inside(rows_, margins.rows), across(cols_, margins.cols);
    multiply({plane + std::ptrdiff_t{cols_} * inside.first + across.first, cols_, inside.count},
             {row_basis_.row(across.first), row_basis_.pitch(), across.count}, cols_, lines_, inside.first);
    if (inside.first == 0) std::copy_n(lines_.row(0), cols_, sums_.row(0));
    if (rows_ % 2 == 0) std::copy_n(lines_.row(rows_ / 2), cols_, sums_.row(rows_ / 2));
    fold(lines_.row(0), lines_.pitch(), rows_, cols_, std::max(inside.first, 1), mirrored_count(rows_),
         sums_.row(0), differences_.row(0));
    multiply_down(inside.first, 0);
    combine(cosine_part_.row(0), sine_part_.row(0), cosine_part_.pitch(), rows_, half_, mirrored_count(cols_),
            re, im);
}

void SmallFourier::invert(const float* re, const float* im, float* plane, const Margins& margins) {
    const Inside inside(rows_, margins.rows);
    const auto copy_row = [&](int u) {
        std::copy_n(re + std::ptrdiff_t{half_} * u, half_, sums_.row(u));
        std::copy_n(im + std::ptrdiff_t{half_} * u + 1, half_ - 1, sums_.row(u) + half_);
    };
    copy_row(0);
    if (rows_ % 2 == 0) copy_row(rows_ / 2);
    fold_spectrum(re, im, sums_.pitch(), rows_, half_, mirrored_count(rows_), sums_.row(0),
                  differences_.row(0));
    multiply_down(0, inside.first);
    if (inside.first == 0) std::copy_n(cosine_part_.row(0), cols_, lines_.row(0));
    if (rows_ % 2 == 0) std::copy_n(cosine_part_.row(rows_ / 2), cols_, lines_.row(rows_ / 2));
    unfold(cosine_part_.row(0), sine_part_.row(0), lines_.pitch(), rows_, cols_, std::max(inside.first, 1),
           mirrored_count(rows_), lines_.row(0));
    multiply({lines_.row(inside.first), lines_.pitch(), inside.count}, inverse_row_basis_, cols_, plane_,
             inside.first);
    for (int y = inside.first; y < inside.first + inside.count; ++y)
        std::copy_n(plane_.row(y), cols_, plane + std::ptrdiff_t{y} * cols_);
}

}  // namespace tricue
