// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "fuse/detail/plane_fourier.hpp"

namespace tricue {

/// Real and imaginary parts of a spectrum, apart.
struct Spectrum {
    float *re, *im;
};

/// Multiplies planes by a mask, from their spectra to their spectra. Where lines at the borders of the mask are 0, the planes'
/// lines become 0, too, which saves time. The planes are those of filters: the mask of the window is mirrored.
class MaskedFourier {
public:
    /// `planes` has the mask's size, and must outlive this.
    MaskedFourier(FloatsRef mask, PlaneFourier& planes);

    /// Multiplies two spectra; to multiply only one, give it as the second, too, and ignore that result.
    void multiply(const Spectrum& one, const Spectrum& two, const Spectrum& one_masked,
                  const Spectrum& two_masked);

private:
    PlaneFourier& planes_;
    Margins margins_;
    Floats mask_, one_, two_;
};

}  // namespace tricue
