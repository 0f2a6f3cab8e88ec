// SPDX-License-Identifier: MIT
#pragma once

#include "base/plane_view.hpp"

namespace tricue {

/// A depth image in meters. NaN, and any other number that isn't above 0 and finite, is no measurement.
using DepthView = PlaneView;

}  // namespace tricue
