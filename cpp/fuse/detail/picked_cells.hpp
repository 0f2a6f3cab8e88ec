// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/float_planes.hpp"
#include "base/image_view.hpp"
#include "cues/color/pick_pixels.hpp"

namespace tricue {

/// The hog_color_cells of the image that pick_pixels gives.
FloatPlanes picked_cells(const ImageView& patch, PlacesRef places, FloatsRef taper);

}  // namespace tricue
