// SPDX-License-Identifier: MIT
#pragma once

#include "fuse/detail/aligned_matrix.hpp"

namespace tricue {

/// Two-dimensional spectra of real planes (R, C) by matrix products. They take C + R / 2 steps per number where a fast transform
/// takes about log(R C), but steps that fill the widest registers: for small planes they are several times faster.
///
/// Spectra have C / 2 + 1 columns, as numpy.fft.rfft2's, real and imaginary parts apart, contiguous. In float32.
class SmallFourier {
public:
    SmallFourier(int rows, int cols);

    void transform(const float* plane, float* re, float* im);

    /// Like numpy.fft.irfft2 it ignores imaginary parts that have to be 0 in the spectrum of a real plane.
    void invert(const float* re, const float* im, float* plane);

private:
    /// Multiplies the first columns of lines_ by the cosines and the sines of the first half of the frequencies.
    void multiply_down(int cols);

    int rows_, cols_, half_;
    /// (C, C): for each frequency along x cosines, behind them minus sines, but for those that are 0.
    AlignedMatrix row_basis_;
    AlignedMatrix inverse_row_basis_;  ///< the transpose
    AlignedMatrix cosines_, sines_;    ///< of frequencies along y
    AlignedMatrix plane_;
    AlignedMatrix lines_;  ///< of a row along x the real parts, and behind them the imaginary ones
    AlignedMatrix sums_, differences_;  ///< of lines that mirror each other
    AlignedMatrix cosine_part_, sine_part_;
};

}  // namespace tricue
