// SPDX-License-Identifier: MIT
#pragma once

namespace tricue {

/// [x0, x1) x [y0, y1), pixels: the first pixel is [0, 1) x [0, 1). It may extend beyond the image, and is empty where x1 <= x0 or
/// y1 <= y0.
struct Rectangle {
    double x0, y0, x1, y1;
};

}  // namespace tricue
