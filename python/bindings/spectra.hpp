// SPDX-License-Identifier: MIT
#pragma once
// The arrays of correlation filters, which the bindings of two topics take.

#include "arrays.hpp"

namespace tricue::bindings {

using Floating = Array<float>;
using Complex = Array<std::complex<float>>;

// What they are expected to be.
inline constexpr const char* kSpectrum = "complex64 (R, C // 2 + 1)";
inline constexpr const char* kFilter = "complex64 (K, R, C // 2 + 1)";
inline constexpr const char* kHalf = "float32 (R, C // 2 + 1)";

}  // namespace tricue::bindings
