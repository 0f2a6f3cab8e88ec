// SPDX-License-Identifier: MIT
#include "cues/depth/depth_distance.hpp"

#include "check.hpp"
#include "depth_levels.hpp"
#include "depth_reader.hpp"

namespace tricue {

States depth_distance(const DepthView& depth, StatesRef rectangles, const DepthModel& model,
                      StatesRef pattern, double nearer) {
    require_shape(rectangles, rectangles.rows(), 5, "rectangles");
    require_finite(rectangles, "rectangles");
    DepthReader reader(depth, pattern);
    DepthLevels levels(model.histogram.size(), model.reach, reader.places());
    require_model(model.histogram);
    require_nearer(nearer);

    States measured(rectangles.rows(), 3);
    for (Eigen::Index i = 0; i < rectangles.rows(); ++i) {
        const float* seen = reader.read(rectangles.row(i).data());
        const double z = rectangles(i, 4);
        levels.count(seen, z);
        measured.row(i) << levels.distance(model.histogram), levels.counted() / levels.places(),
            count_below(seen, reader.places(), z - nearer) / levels.places();
    }
    return measured;
}

}  // namespace tricue
