// SPDX-License-Identifier: MIT
#pragma once

#include <complex>
#include <cstddef>
#include <optional>
#include <vector>

#include "fuse/detail/small_fourier.hpp"

namespace tricue {

/// Two-dimensional spectra of two real planes (rows, cols): small ones by SmallFourier, others by one complex transform, OpenCV's,
/// where one plane is the real part, the other the imaginary part, and symmetry tells their spectra apart again. These have
/// `half` = cols / 2 + 1 columns, as numpy.fft.rfft2's. In float32; nothing here starts a thread.
///
/// Spectra stand with real and imaginary parts apart, which compilers vectorise: rows x half numbers each, contiguous.
class PlanePair {
public:
    PlanePair(int rows, int cols);

    int half() const { return cols_ / 2 + 1; }
    /// How many numbers a spectrum's real or imaginary part has.
    std::size_t count() const { return static_cast<std::size_t>(rows_) * static_cast<std::size_t>(half()); }

    /// Both planes, contiguous. To transform one alone give it as the second too, and leave out that spectrum.
    void transform(const float* one, const float* two, float* one_re, float* one_im, float* two_re,
                   float* two_im);

    /// The planes of two spectra, contiguous. As numpy.fft.irfft2 it ignores what has to be real in a spectrum of a real plane and
    /// isn't. To invert one alone give it as the second too, and the same plane.
    void invert(const float* one_re, const float* one_im, const float* two_re, const float* two_im,
                float* one, float* two);

private:
    int rows_, cols_;
    std::optional<SmallFourier> small_;
    std::vector<std::complex<float>> pairs_, spectrum_;  ///< of planes that aren't small
};

}  // namespace tricue
