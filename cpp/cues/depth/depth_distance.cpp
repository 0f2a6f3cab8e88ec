// SPDX-License-Identifier: MIT
#include "cues/depth/depth_distance.hpp"

#include "base/check.hpp"
#include "cues/depth/detail/depth_reader.hpp"
#include "cues/depth/detail/relative_histogram.hpp"

namespace tricue {

States depth_distance(const DepthView& depth, StatesRef rectangles, const ReferenceHistogram& model,
                      StatesRef pattern, double occluder_margin) {
    require_shape(rectangles, rectangles.rows(), 5, "rectangles");
    require_finite(rectangles, "rectangles");
    DepthReader reader(depth, pattern);
    RelativeHistogram histogram(model.histogram.size(), model.reach, reader.places());
    require_model(model.histogram);
    require_occluder_margin(occluder_margin);

    States measured(rectangles.rows(), 3);
    for (Eigen::Index i = 0; i < rectangles.rows(); ++i) {
        const float* depths = reader.read(rectangles.row(i).data());
        const double z = rectangles(i, 4);
        histogram.count(depths, z);
        measured.row(i) << histogram.distance(model.histogram), histogram.total() / histogram.samples(),
            count_below(depths, reader.places(), z - occluder_margin) / histogram.samples();
    }
    return measured;
}

}  // namespace tricue
