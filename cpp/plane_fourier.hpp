// SPDX-License-Identifier: MIT
#pragma once

#include "fourier_columns.hpp"

namespace tricue {

/// Rows of real and of imaginary parts, a spectrum's.
struct ComplexRow {
    float *re, *im;
};

/// Two-dimensional spectra of two real planes (rows, cols) at a time: one is the real part, the other the imaginary part of what
/// is transformed along the rows, and symmetry tells them apart again. They have cols / 2 + 1 columns, as numpy.fft.rfft2's.
class PlaneFourier {
public:
    PlaneFourier(int rows, int cols);

    /// Row y of both planes; all are to be written before each transform.
    void write_row(int y, const float* one, const float* two);
    void transform();

    /// Row u of the first (0) or second (1) plane's spectrum.
    ComplexRow spectrum(int plane, int u) {
        return {down_.real(u) + plane * half_, down_.imag(u) + plane * half_};
    }

private:
    int rows_, cols_, half_;
    FourierColumns along_, down_;
};

/// The way back, of one plane.
class PlaneInverse {
public:
    PlaneInverse(int rows, int cols);

    /// A place for row u of the spectrum, cols / 2 + 1 numbers.
    ComplexRow spectrum(int u) { return {down_.real(u), down_.imag(u)}; }
    void transform();

    /// rows times cols times the plane's column x; as numpy.fft.irfft2's it doesn't depend on what has to be real in the spectrum
    /// and isn't.
    const float* column(int x) { return along_.real(x); }

private:
    int rows_, cols_, half_;
    FourierColumns down_, along_;
};

}  // namespace tricue
