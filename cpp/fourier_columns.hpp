// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

namespace tricue {

/// Discrete Fourier transforms of all columns of n x width complex numbers at once: F_k = sum_j f_j exp(-2 pi i j k / n).
///
/// Real and imaginary parts are apart, so every step works on whole rows, which compilers vectorise: for many short transforms
/// that is several times faster than one after the other, as FFT libraries for one long signal do them.
///
/// Stockham's algorithm of mixed radix (Van Loan 1992, section 1.7): factors 4 and 2 have their butterflies, any other prime p costs p
/// products a number. All in float32, in an order that depends on n alone; the relative error is about 6e-8 log2(n).
class FourierColumns {
public:
    FourierColumns(int n, int width);

    /// Row k, to be written before a transform and read after it, which puts the rows elsewhere.
    float* real(int k) { return real_.data() + std::ptrdiff_t{k} * width_; }
    float* imag(int k) { return imag_.data() + std::ptrdiff_t{k} * width_; }

    void forward();
    /// n times the inverse.
    void inverse();

private:
    int n_, width_;
    std::vector<float> turns_;  ///< cos and -sin of 2 pi k / n
    std::vector<float> real_, imag_, next_real_, next_imag_;

    void pass(int radix, int length, int stride);
};

}  // namespace tricue
