// SPDX-License-Identifier: MIT
#pragma once

#include "camera/arrays.hpp"

namespace tricue {

/// Half of the spectra along S scales, as numpy.fft.rfft's, of D channels: rows of real and of imaginary parts.
struct ScaleSpectra {
    Floats numbers;  ///< 2 (S / 2 + 1) x D: all real parts above all imaginary ones

    Eigen::Index half() const { return numbers.rows() / 2; }
    const float* re(Eigen::Index u) const { return numbers.data() + u * numbers.cols(); }
    const float* im(Eigen::Index u) const { return re(half() + u); }
};

/// The definition, X_u = sum_s x_s exp(-2 pi i s u / S), as a product with the matrix of cosines and sines: for a few scales, often an
/// odd or prime count, and hundreds of channels Eigen's product is several times faster than a fast transform of every channel.
/// In float32.
ScaleSpectra scale_spectra(FloatsRef looks);

/// The way back, of one spectrum: as numpy.fft.irfft it ignores what has to be real and isn't.
Eigen::Array<float, Eigen::Dynamic, 1> scale_signal(const Eigen::ArrayXf& re, const Eigen::ArrayXf& im,
                                                    int scales);

}  // namespace tricue
