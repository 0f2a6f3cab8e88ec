// SPDX-License-Identifier: MIT
#pragma once

#include "base/image_view.hpp"

namespace tricue {

/// Pixels (x0 to x0 + n, y) of a gray image as floats; beyond the image its border is replicated.
void read_frame_row(const ImageView& image, int y, int x0, int n, float* out);

}  // namespace tricue
