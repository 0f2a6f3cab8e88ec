// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

#include "base/image_view.hpp"

namespace tricue {

/// The pixels [x0, x1) x [y0, y1). It may extend beyond the image, and is empty where x1 <= x0 or y1 <= y0.
struct Region {
    int x0, y0, x1, y1;

    Region clipped(const ImageView& image) const {
        return {std::max(x0, 0), std::max(y0, 0), std::min(x1, image.cols), std::min(y1, image.rows)};
    }
};

}  // namespace tricue
