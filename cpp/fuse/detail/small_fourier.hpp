// SPDX-License-Identifier: MIT
#pragma once

#include "fuse/detail/padded_rows.hpp"

namespace tricue {

/// Two-dimensional spectra of real planes (R, C) by matrix products. They take C + R / 2 steps a number where a fast transform takes
/// some log(R C), but steps that fill the widest registers: of small planes it is several times as fast.
///
/// Spectra have C / 2 + 1 columns, as numpy.fft.rfft2's, real and imaginary parts apart, contiguous. In float32.
class SmallFourier {
public:
    SmallFourier(int rows, int cols);

    void transform(const float* plane, float* re, float* im);

    /// As numpy.fft.irfft2 it ignores what has to be real in a spectrum of a real plane and isn't.
    void invert(const float* re, const float* im, float* plane);

private:
    /// Of the first columns of lines_: their sums over cosines and over sines of each frequency, the first half of frequencies.
    void multiply_down(int cols);

    int rows_, cols_, half_;
    PaddedRows
        across_;  ///< (C, C): for each frequency along x cosines, behind them minus sines, but for those that are 0
    PaddedRows back_;             ///< the transpose
    PaddedRows cosines_, sines_;  ///< of frequencies along y
    PaddedRows plane_;
    PaddedRows lines_;               ///< of a row along x the real parts, and behind them the imaginary ones
    PaddedRows sums_, differences_;  ///< of lines that mirror each other
    PaddedRows cosine_part_, sine_part_;
};

}  // namespace tricue
