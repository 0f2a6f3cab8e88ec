// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/plane_view.hpp"

namespace tricue {

/// P(target | two cues) of every pixel, from the posteriors p and q of two independent cues, with equal priors:
///     p q / max(p q + (1 - p) (1 - q), 1e-9)
///
/// The odds p / (1 - p) and q / (1 - q) multiply, so that 1/2 changes nothing. In float32, and to the last bit as written.
///
/// @param first, second float32 (H, W), p and q, of one shape; in [0, 1]
/// @returns float32 (H, W)
/// @throws std::invalid_argument on planes of different shapes
/// Source: Okada, Shirai, Miura 1996, equations (11) and (12), for the two classes target and rest.
Floats combine_posteriors(const PlaneView& first, const PlaneView& second);

}  // namespace tricue
