// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "base/arrays.hpp"

namespace tricue {

/// The pixel that contains an ellipse's center, clamped to ±2^30, which is beyond any image.
struct CenterPixel {
    int x, y;

    explicit CenterPixel(const double* ellipse);
};

/// The pixels whose centers lie in an axis-aligned ellipse, one run per row, relative to the pixel that contains the ellipse's center.
///
/// They depend on the center's place in that pixel, so an ellipse moved by whole pixels has the same shape. Row r, with its
/// center at v = (r + 1/2 - y) / major, has the pixels whose centers are within minor sqrt(1 - v²) of x.
struct EllipseShape {
    struct Run {
        int begin, end;
    };

    int top = 0;            ///< of the first run
    std::vector<Run> runs;  ///< none is empty; toward top and bottom each lies within the next
    int area = 0;           ///< number of pixels

    /// @param ellipse x, y, minor, major, checked by require_ellipse
    /// @param scale   of both semi-axes; a larger one gives a shape that contains a smaller one's
    EllipseShape(const double* ellipse, double scale);

    int bottom() const { return top + static_cast<int>(runs.size()); }
    Run column_range() const;
};

/// Throws std::invalid_argument unless an ellipse (4,) is finite, with semi-axes in (0, 4096 / margin], and margin is in [1, 16].
void require_ellipse(VectorRef ellipse, double margin = 1.0);

}  // namespace tricue
