// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "cues/color/rank_window.hpp"

namespace tricue {

/// The result of rank_window for an ellipse's planes of blue, green and red, n numbers each, and M x 3n valid rank maps; throws
/// std::invalid_argument unless `flat` is a number from 0.
RankWindow compare_window(const std::uint8_t* planes, std::ptrdiff_t n, FloatsRef models, double flat);

}  // namespace tricue
