// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "fuse/detail/plane_fourier.hpp"

namespace tricue {

/// Real and imaginary parts of a spectrum, apart.
struct Spectrum {
    float *re, *im;
};

/// Multiplies planes by a mask, from their spectra to their spectra. Where lines at the borders of the mask are 0, so are the planes',
/// which saves some of the time. The planes are those of filters: the mask of the window is mirrored.
class MaskedFourier {
public:
    /// `planes`: of the mask's size, and lives as long.
    MaskedFourier(FloatsRef mask, PlaneFourier& planes);

    /// Two spectra; to multiply one alone give it as the second too, and leave out that result.
    void multiply(const Spectrum& one, const Spectrum& two, const Spectrum& one_masked,
                  const Spectrum& two_masked);

private:
    PlaneFourier& planes_;
    Margins margins_;
    Floats mask_, one_, two_;
};

}  // namespace tricue
