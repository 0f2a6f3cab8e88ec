// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "fuse/detail/aligned_matrix.hpp"

namespace tricue {

/// Half of the spectra along S scales, as numpy.fft.rfft's, of D channels: S / 2 + 1 rows of real and of imaginary parts.
///
/// The definition, X_u = sum_s x_s exp(-2 pi i s u / S), as a product with the matrix of cosines and sines: for a few scales, often an
/// odd or prime count, and hundreds of channels that is several times faster than a fast transform of every channel. In float32.
class ScaleSpectra {
public:
    explicit ScaleSpectra(FloatsRef looks);

    int half() const { return half_; }
    const float* re(Eigen::Index u) const { return numbers_.row(static_cast<int>(u)); }
    const float* im(Eigen::Index u) const { return numbers_.row(half_ + static_cast<int>(u)); }

private:
    int half_;
    AlignedMatrix numbers_;  ///< all real parts above all imaginary ones
};

/// The inverse for one spectrum: like numpy.fft.irfft it ignores imaginary parts that have to be 0.
Eigen::Array<float, Eigen::Dynamic, 1> invert_scale_spectrum(const Eigen::ArrayXf& re,
                                                             const Eigen::ArrayXf& im, int scales);

}  // namespace tricue
