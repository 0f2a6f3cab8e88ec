// SPDX-License-Identifier: MIT
#include "cues/depth/rectangle_histogram.hpp"

#include "base/check.hpp"
#include "cues/depth/detail/depth_reader.hpp"
#include "cues/depth/detail/relative_histogram.hpp"

namespace tricue {

Vector rectangle_histogram(const DepthView& depth, VectorRef rectangle, int levels, StatesRef pattern,
                           double reach) {
    require_size(rectangle, 5, "rectangle");
    require_finite(rectangle, "rectangle");
    if (levels < 1 || levels > 65536) refuse("levels", "1 to 65536", levels);
    DepthReader reader(depth, pattern);
    RelativeHistogram histogram(levels, reach, reader.places());

    histogram.count(reader.read(rectangle.data()), rectangle[4]);
    return histogram.shares();
}

}  // namespace tricue
