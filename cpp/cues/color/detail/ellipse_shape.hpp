// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "base/arrays.hpp"

namespace tricue {

/// The pixel that a place lies in: where a shape is put. Beyond 2^30 no image has pixels, and all places are alike.
struct Place {
    int x, y;

    explicit Place(const double* ellipse);
};

/// The pixels whose centres lie in an axis-aligned ellipse, as one run a row, relative to the pixel that its own centre lies in.
///
/// They follow from where in that pixel the centre is, so an ellipse moved by whole pixels has the same shape. Row r, its centre
/// at v = (r + 1/2 - y) / major, has the pixels whose centres are within minor sqrt(1 - v²) of x.
struct EllipseShape {
    struct Run {
        int begin, end;
    };

    int top = 0;            ///< of the first run
    std::vector<Run> runs;  ///< none is empty; one lies within the other towards the ends
    int area = 0;           ///< how many pixels

    /// @param ellipse x, y, minor, major that require_ellipses has seen
    /// @param scale   of both semi-axes; a larger one gives a shape that contains a smaller one's
    EllipseShape(const double* ellipse, double scale);

    int bottom() const { return top + static_cast<int>(runs.size()); }
    Run widest() const;
};

/// Throws std::invalid_argument unless ellipses (N, 4) are finite, with semi-axes in (0, 4096 / margin], and margin is in [1, 16].
void require_ellipses(StatesRef ellipses, double margin, const char* name);

}  // namespace tricue
