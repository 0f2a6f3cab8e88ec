// SPDX-License-Identifier: MIT
// Only this file uses OpenCV.
#include "fuse/detail/plane_fourier.hpp"

#include <algorithm>
#include <opencv2/core.hpp>

#include "base/simd.hpp"
#include "fuse/detail/fast_fourier.hpp"

namespace tricue {
namespace {

using Complex = std::complex<float>;

constexpr int kMaxSmallSide = 64;  // cells per side, up to which matrix products are faster with AVX2

void transform_plane(std::vector<Complex>& from, int rows, int cols, int flags, std::vector<Complex>& to) {
    const cv::Mat in(rows, cols, CV_32FC2, from.data());
    cv::Mat out(rows, cols, CV_32FC2, to.data());
    cv::dft(in, out, flags);
}

TRICUE_MULTIVERSION
void interleave(const float* __restrict one, const float* __restrict two, std::size_t n,
                float* __restrict pairs) {
    for (std::size_t i = 0; i < n; ++i) {
        pairs[2 * i] = one[i];
        pairs[2 * i + 1] = two[i];
    }
}

TRICUE_MULTIVERSION
void widen(const float* __restrict plane, std::size_t n, float* __restrict pairs) {
    for (std::size_t i = 0; i < n; ++i) {
        pairs[2 * i] = plane[i];
        pairs[2 * i + 1] = 0.0F;
    }
}

/// A and B from a row of Z = A + i B and the mirrored row: for real planes A(-u, -v) is the conjugate of A(u, v).
TRICUE_MULTIVERSION
void separate_spectra(const float* __restrict z, const float* __restrict mirror, int half,
                      float* __restrict one_re, float* __restrict one_im, float* __restrict two_re,
                      float* __restrict two_im) {
    for (int v = 0; v < half; ++v) {
        const float re = z[2 * v], im = z[2 * v + 1], other_re = mirror[2 * v], other_im = mirror[2 * v + 1];
        one_re[v] = 0.5F * (re + other_re);
        one_im[v] = 0.5F * (im - other_im);
        two_re[v] = 0.5F * (im + other_im);
        two_im[v] = 0.5F * (other_re - re);
    }
}

TRICUE_MULTIVERSION
void deinterleave(const float* __restrict pairs, float whole, std::size_t n, float* __restrict one,
                  float* __restrict two) {
    for (std::size_t i = 0; i < n; ++i) {
        one[i] = whole * pairs[2 * i];
        two[i] = whole * pairs[2 * i + 1];
    }
}

/// One part of every pair: the real parts of `pairs`, or the imaginary parts from the second number on.
TRICUE_MULTIVERSION
void take_part(const float* __restrict pairs, float whole, std::size_t n, float* __restrict plane) {
    for (std::size_t i = 0; i < n; ++i) plane[i] = whole * pairs[2 * i];
}

/// A row of A + i B, and of the mirrored row conj(A) + i conj(B).
TRICUE_MULTIVERSION
void combine_spectra(const float* __restrict one_re, const float* __restrict one_im,
                     const float* __restrict two_re, const float* __restrict two_im, int half,
                     float* __restrict z, float* __restrict mirror) {
    for (int v = 0; v < half; ++v) {
        z[2 * v] = one_re[v] - two_im[v];
        z[2 * v + 1] = one_im[v] + two_re[v];
        mirror[2 * v] = one_re[v] + two_im[v];
        mirror[2 * v + 1] = two_re[v] - one_im[v];
    }
}

}  // namespace

bool PlaneFourier::is_fast() const {
    return rows_ == kFastSide && cols_ == kFastSide;
}

PlaneFourier::PlaneFourier(int rows, int cols) : rows_(rows), cols_(cols) {
    if (is_fast()) return;
    if (std::max(rows, cols) <= kMaxSmallSide) {
        small_.emplace(rows, cols);
    } else {
        pairs_.resize(static_cast<std::size_t>(rows) * static_cast<std::size_t>(cols));
        spectrum_.resize(pairs_.size());
    }
}

void PlaneFourier::transform(const float* one, const float* two, float* one_re, float* one_im, float* two_re,
                             float* two_im, const Margins& margins) {
    if (is_fast()) {
        fast_transform(one, one_re, one_im);
        if (two != one) fast_transform(two, two_re, two_im);
        return;
    }
    if (small_) {
        small_->transform(one, one_re, one_im, margins);
        if (two != one) small_->transform(two, two_re, two_im, margins);
        return;
    }
    const int half = this->half();
    if (two == one) {
        widen(one, pairs_.size(), as_floats(pairs_.data()));
        transform_plane(pairs_, rows_, cols_, 0, spectrum_);
        for (std::ptrdiff_t u = 0; u < rows_; ++u)
            deinterleave(as_floats(spectrum_.data() + u * cols_), 1.0F, static_cast<std::size_t>(half),
                         one_re + u * half, one_im + u * half);
        return;
    }
    interleave(one, two, pairs_.size(), as_floats(pairs_.data()));
    transform_plane(pairs_, rows_, cols_, 0, spectrum_);
    std::vector<Complex> mirror(static_cast<std::size_t>(half));
    for (int u = 0; u < rows_; ++u) {
        const Complex *row = spectrum_.data() + std::ptrdiff_t{u} * cols_,
                      *opposite = spectrum_.data() + std::ptrdiff_t{(rows_ - u) % rows_} * cols_;
        mirror[0] = opposite[0];
        std::reverse_copy(opposite + cols_ - half + 1, opposite + cols_, mirror.begin() + 1);
        const std::ptrdiff_t to = std::ptrdiff_t{u} * half;
        separate_spectra(as_floats(row), as_floats(mirror.data()), half, one_re + to, one_im + to,
                         two_re + to, two_im + to);
    }
}

void PlaneFourier::invert(const float* one_re, const float* one_im, const float* two_re, const float* two_im,
                          float* one, float* two, const Margins& margins) {
    if (is_fast()) {
        fast_invert(one_re, one_im, one);
        if (two != one) fast_invert(two_re, two_im, two);
        return;
    }
    if (small_) {
        small_->invert(one_re, one_im, one, margins);
        if (two != one) small_->invert(two_re, two_im, two, margins);
        return;
    }
    const int half = this->half();
    const int mirrored =
        (cols_ - 1) / 2;           // columns with a mirror image; the first, and for an even count the
    const int middle = cols_ / 2;  // middle one, are their own
    const auto row = [&](int u) { return spectrum_.data() + std::ptrdiff_t{u} * cols_; };
    std::vector<Complex> mirror(static_cast<std::size_t>(half)), first(static_cast<std::size_t>(rows_)),
        other(first.size());
    for (int u = 0; u < rows_; ++u) {
        const std::ptrdiff_t from = std::ptrdiff_t{u} * half;
        const int opposite = (rows_ - u) % rows_;
        combine_spectra(one_re + from, one_im + from, two_re + from, two_im + from, half, as_floats(row(u)),
                        as_floats(mirror.data()));
        std::reverse_copy(mirror.begin() + 1, mirror.begin() + 1 + mirrored,
                          row(opposite) + cols_ - mirrored);
        first[static_cast<std::size_t>(opposite)] = mirror.front();
        other[static_cast<std::size_t>(opposite)] = mirror.back();
    }
    for (int u = 0; u < rows_; ++u) {
        row(u)[0] = 0.5F * (row(u)[0] + first[static_cast<std::size_t>(u)]);
        if (middle > mirrored) row(u)[middle] = 0.5F * (row(u)[middle] + other[static_cast<std::size_t>(u)]);
    }
    transform_plane(spectrum_, rows_, cols_, cv::DFT_INVERSE, pairs_);
    const float* pairs = as_floats(pairs_.data());
    const float whole = 1.0F / static_cast<float>(pairs_.size());
    if (two == one)
        take_part(pairs + 1, whole, pairs_.size(), two);
    else
        deinterleave(pairs, whole, pairs_.size(), one, two);
}

}  // namespace tricue
