// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "fuse/detail/plane_fourier.hpp"

namespace tricue {

/// Separate real and imaginary parts of a spectrum.
struct Spectrum {
    float *re, *im;
};

/// Multiplies planes by a mask, given and returning their spectra. Border lines where the mask is 0 become 0 in the planes, which
/// saves time. The planes are filters, so the window's mask is mirrored.
class MaskedFourier {
public:
    /// `planes` has the mask's size, and must outlive this.
    MaskedFourier(FloatsRef mask, PlaneFourier& planes);

    /// Multiplies two spectra; to multiply only one, pass it as the second, too, and ignore that result.
    void multiply(const Spectrum& one, const Spectrum& two, const Spectrum& one_masked,
                  const Spectrum& two_masked);

private:
    PlaneFourier& planes_;
    Margins margins_;
    Floats mask_, one_, two_;
};

}  // namespace tricue
