// SPDX-License-Identifier: MIT
#pragma once

namespace tricue {

constexpr int kFastSide = 32;  ///< of planes with a fast transform, those of trackers' windows

/// The spectrum of a real plane (kFastSide, kFastSide), in SmallFourier's form, by fast transforms of real lines along each axis:
/// as many lines at a time as a register has lanes, with a transposition between the axes.
void fast_transform(const float* plane, float* re, float* im);

/// Like numpy.fft.irfft2, it ignores imaginary parts that must be 0 in the spectrum of a real plane.
void fast_invert(const float* re, const float* im, float* plane);

}  // namespace tricue
