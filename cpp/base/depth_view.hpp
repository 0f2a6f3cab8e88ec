// SPDX-License-Identifier: MIT
#pragma once

#include "base/plane_view.hpp"

namespace tricue {

/// A depth image in meters. NaN, and any other number that isn't finite and above 0, means "not measured".
using DepthView = PlaneView;

}  // namespace tricue
