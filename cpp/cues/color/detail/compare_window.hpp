// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "cues/color/rank_window.hpp"

namespace tricue {

/// What rank_window returns of the planes of blue, green and red, n each, of an ellipse, for M x 3n valid rank maps;
/// throws std::invalid_argument unless `flat` is a number from 0.
RankWindow compare_window(const std::uint8_t* planes, std::ptrdiff_t n, FloatsRef models, double flat);

}  // namespace tricue
