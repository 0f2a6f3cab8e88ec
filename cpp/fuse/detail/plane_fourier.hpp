// SPDX-License-Identifier: MIT
#pragma once

#include <complex>
#include <cstddef>
#include <optional>
#include <vector>

#include "fuse/detail/small_fourier.hpp"

namespace tricue {

/// Alternating real and imaginary parts.
inline const float* as_floats(const std::complex<float>* numbers) {
    return reinterpret_cast<const float*>(numbers);
}

inline float* as_floats(std::complex<float>* numbers) {
    return reinterpret_cast<float*>(numbers);
}

/// Two-dimensional spectra of two real planes (rows, cols): of the size of trackers' windows by fast_transform, other small ones by
/// SmallFourier, others by one complex transform, OpenCV's, with one plane as the real part and the other as the imaginary part, whose
/// spectra symmetry separates again. Spectra have `half` = cols / 2 + 1 columns, as numpy.fft.rfft2's. In float32; nothing here starts
/// a thread.
///
/// Real and imaginary parts of a spectrum are separate, which compilers vectorize: rows x half numbers each, contiguous.
class PlaneFourier {
public:
    PlaneFourier(int rows, int cols);

    int half() const { return cols_ / 2 + 1; }
    /// The size of a spectrum's real or imaginary part, in numbers.
    std::size_t count() const { return static_cast<std::size_t>(rows_) * static_cast<std::size_t>(half()); }

    /// Transforms both planes, contiguous, with 0 in the margins. To transform only one, pass it as the second, too, and ignore
    /// that spectrum.
    void transform(const float* one, const float* two, float* one_re, float* one_im, float* two_re,
                   float* two_im, const Margins& margins = {});

    /// Computes the planes of two spectra, contiguous; the margins are then unspecified. Like numpy.fft.irfft2, it ignores
    /// imaginary parts that must be 0 in the spectrum of a real plane. To invert only one, pass it as the second, too, with the
    /// same plane.
    void invert(const float* one_re, const float* one_im, const float* two_re, const float* two_im,
                float* one, float* two, const Margins& margins = {});

private:
    /// Whether planes have the most frequent side, kFastSide.
    bool is_fast() const;

    int rows_, cols_;
    std::optional<SmallFourier> small_;
    std::vector<std::complex<float>> pairs_, spectrum_;  ///< of planes that aren't small
};

}  // namespace tricue
