// SPDX-License-Identifier: MIT
#include "fuse/detail/small_fourier.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/simd.hpp"
#include "fuse/detail/matrix_product.hpp"

namespace tricue {
namespace {

/// Cosines and negative sines of the multiples of 2 pi / parts.
class TwiddleFactors {
public:
    explicit TwiddleFactors(int parts) : parts_(parts) {
        constexpr double kTwoPi = 6.283185307179586;
        cosines_.reserve(static_cast<std::size_t>(parts));
        sines_.reserve(cosines_.capacity());
        for (int k = 0; k < parts; ++k) {
            cosines_.push_back(static_cast<float>(std::cos(kTwoPi * k / parts)));
            sines_.push_back(static_cast<float>(-std::sin(kTwoPi * k / parts)));
        }
    }

    /// n numbers of frequency u, from index `first` on.
    void cosines(int u, int first, int n, float* out) const { write(cosines_, u, first, n, out); }
    void sines(int u, int first, int n, float* out) const { write(sines_, u, first, n, out); }

private:
    void write(const std::vector<float>& numbers, int u, int first, int n, float* out) const {
        int at = u * first % parts_;
        for (int i = 0; i < n; ++i) {
            out[i] = numbers[static_cast<std::size_t>(at)];
            at = at + u < parts_ ? at + u : at + u - parts_;
        }
    }

    int parts_;
    std::vector<float> cosines_, sines_;
};

/// How many of n numbers (or frequencies) have a mirror image among the others.
constexpr int mirrored_count(int n) {
    return (n - 1) / 2;
}

TRICUE_MULTIVERSION
void fold_lines(const float* __restrict line, const float* __restrict mirror, int n, float* __restrict sums,
                float* __restrict differences) {
    for (int x = 0; x < n; ++x) {
        sums[x] = line[x] + mirror[x];
        differences[x] = line[x] - mirror[x];
    }
}

/// A row of a spectrum.
struct SpectrumRow {
    float *re, *im;
};

/// A row of a spectrum and the mirrored row. Imaginary parts of a line begin at `half`, with the first that isn't 0.
TRICUE_MULTIVERSION
void combine(const float* cosine_part, const float* sine_part, int half, int pairs, const SpectrumRow& row,
             const SpectrumRow& mirror) {
    const float *cosine_im = cosine_part + half - 1, *sine_im = sine_part + half - 1;
    const SpectrumRow to = row, opposite = mirror;
    TRICUE_INDEPENDENT
    for (int v = 0; v < half; ++v) {
        const bool paired = v >= 1 && v <= pairs;
        const float re = cosine_part[v], im = paired ? cosine_im[v] : 0.0F;
        const float re_turned = paired ? sine_im[v] : 0.0F, im_turned = sine_part[v];
        opposite.re[v] = re + re_turned;
        opposite.im[v] = im - im_turned;
        to.re[v] = re - re_turned;
        to.im[v] = im + im_turned;
    }
}

/// A line from a row of a spectrum and the mirrored row; imaginary parts begin at `half`. A frequency with a mirror image counts twice.
TRICUE_MULTIVERSION
void combine_inverse(const float* __restrict cosine_part, const float* __restrict sine_part, float sign,
                     float scale, int half, int pairs, float* __restrict line) {
    for (int v = 0; v < half; ++v) {
        const float weight = v >= 1 && v <= pairs ? 2 * scale : scale;
        line[v] = weight * (cosine_part[v] + sign * sine_part[half + v]);
    }
    for (int v = 1; v <= pairs; ++v)
        line[half + v - 1] = 2 * scale * (cosine_part[half + v] - sign * sine_part[v]);
}

}  // namespace

SmallFourier::SmallFourier(int rows, int cols)
    : rows_(rows),
      cols_(cols),
      half_(cols / 2 + 1),
      row_basis_(cols, cols),
      inverse_row_basis_(cols, cols),
      cosines_(rows / 2 + 1, rows / 2 + 1),
      sines_(rows / 2 + 1, mirrored_count(rows)),
      plane_(rows, cols),
      lines_(rows, 2 * half_),
      sums_(rows / 2 + 1, 2 * half_),
      differences_(mirrored_count(rows), 2 * half_),
      cosine_part_(rows / 2 + 1, 2 * half_),
      sine_part_(rows / 2 + 1, 2 * half_) {
    const TwiddleFactors along_x(cols), along_y = rows == cols ? along_x : TwiddleFactors(rows);
    for (int v = 0; v < half_; ++v) along_x.cosines(v, 0, cols, inverse_row_basis_.row(v));
    for (int v = 1; v <= mirrored_count(cols); ++v)
        along_x.sines(v, 0, cols, inverse_row_basis_.row(half_ + v - 1));
    for (int x = 0; x < cols; ++x) {
        along_x.cosines(x, 0, half_, row_basis_.row(x));
        along_x.sines(x, 1, mirrored_count(cols), row_basis_.row(x) + half_);
    }
    for (int u = 0; u < cosines_.rows(); ++u) {
        along_y.cosines(u, 0, cosines_.cols(), cosines_.row(u));
        along_y.sines(u, 1, sines_.cols(), sines_.row(u));
    }
}

void SmallFourier::multiply_down(int cols) {
    std::copy_n(lines_.row(0), cols, sums_.row(0));
    for (int y = 1; y <= mirrored_count(rows_); ++y)
        fold_lines(lines_.row(y), lines_.row(rows_ - y), cols, sums_.row(y), differences_.row(y - 1));
    if (rows_ % 2 == 0) std::copy_n(lines_.row(rows_ / 2), cols, sums_.row(rows_ / 2));
    multiply(cosines_, sums_, cols, cosine_part_);
    multiply(sines_, differences_, cols, sine_part_);
}

void SmallFourier::transform(const float* plane, float* re, float* im) {
    multiply({plane, cols_, rows_}, row_basis_, cols_, lines_);
    multiply_down(cols_);
    const auto row = [&](int u) {
        return SpectrumRow{re + std::ptrdiff_t{u} * half_, im + std::ptrdiff_t{u} * half_};
    };
    const SpectrumRow unassigned{lines_.row(0), lines_.row(0) + half_};
    for (int u = 0; u <= rows_ / 2; ++u)
        combine(cosine_part_.row(u), sine_part_.row(u), half_, mirrored_count(cols_), row(u),
                u >= 1 && u <= mirrored_count(rows_) ? row(rows_ - u) : unassigned);
}

void SmallFourier::invert(const float* re, const float* im, float* plane) {
    for (int u = 0; u < rows_; ++u, re += half_, im += half_) {
        std::copy_n(re, half_, lines_.row(u));
        std::copy_n(im, half_, lines_.row(u) + half_);
    }
    multiply_down(2 * half_);
    const float scale = 1.0F / static_cast<float>(rows_ * cols_);
    for (int y = 0; y < rows_; ++y) {
        const int from = std::min(y, rows_ - y);
        combine_inverse(cosine_part_.row(from), sine_part_.row(from), y == from ? 1.0F : -1.0F, scale, half_,
                        mirrored_count(cols_), lines_.row(y));
    }
    multiply(lines_, inverse_row_basis_, cols_, plane_);
    for (int y = 0; y < rows_; ++y) std::copy_n(plane_.row(y), cols_, plane + std::ptrdiff_t{y} * cols_);
}

}  // namespace tricue
