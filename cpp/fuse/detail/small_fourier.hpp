// SPDX-License-Identifier: MIT
#pragma once

#include "fuse/detail/aligned_matrix.hpp"

namespace tricue {

/// The margins of a plane (R, C): the rows y with min(y, R - y) < `rows`, and the columns x with min(x, C - x) < `cols`. The rest
/// surrounds row R / 2 and column C / 2.
struct Margins {
    int rows = 0, cols = 0;  ///< at most R / 2, C / 2
};

/// Two-dimensional spectra of real planes (R, C) by matrix products. They take C + R / 2 steps per number where a fast transform
/// takes about log(R C), but steps that fill the widest registers: for small planes they are several times faster.
///
/// Spectra have C / 2 + 1 columns, as numpy.fft.rfft2's, real and imaginary parts apart, contiguous. In float32.
class SmallFourier {
public:
    SmallFourier(int rows, int cols);

    /// Treats the margins as 0, regardless of their content.
    void transform(const float* plane, float* re, float* im, const Margins& margins = {});

    /// Like numpy.fft.irfft2, it ignores imaginary parts that must be 0 in the spectrum of a real plane. Rows in the margins are
    /// left unchanged.
    void invert(const float* re, const float* im, float* plane, const Margins& margins = {});

private:
    /// Multiplies sums_ and differences_ of lines, from a first one on, into the first rows of cosine_part_ and sine_part_.
    void multiply_down(int first_input, int first_output);

    int rows_, cols_, half_;
    /// (C, C), for each x: the frequencies' cosines, followed by negative sines without those that are 0.
    AlignedMatrix row_basis_;
    AlignedMatrix inverse_row_basis_;  ///< the transpose, times the frequencies' weights
    AlignedMatrix column_basis_;       ///< (R / 2 + 1, R), like row_basis_
    /// For each row along x the real parts, followed by the imaginary parts that aren't 0.
    AlignedMatrix lines_;
    AlignedMatrix sums_, differences_;  ///< of lines that mirror each other
    AlignedMatrix cosine_part_, sine_part_;
    AlignedMatrix plane_;
};

}  // namespace tricue
