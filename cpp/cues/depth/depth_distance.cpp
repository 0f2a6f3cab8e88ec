// SPDX-License-Identifier: MIT
#include "cues/depth/depth_distance.hpp"

#include "base/check.hpp"
#include "cues/depth/detail/depth_reader.hpp"
#include "cues/depth/detail/level_counter.hpp"

namespace tricue {

States depth_distance(const DepthView& depth, StatesRef rectangles, const DepthModel& model,
                      StatesRef pattern, double nearer) {
    require_shape(rectangles, rectangles.rows(), 5, "rectangles");
    require_finite(rectangles, "rectangles");
    DepthReader reader(depth, pattern);
    LevelCounter counter(model.histogram.size(), model.reach, reader.places());
    require_model(model.histogram);
    require_nearer(nearer);

    States measured(rectangles.rows(), 3);
    for (Eigen::Index i = 0; i < rectangles.rows(); ++i) {
        const float* seen = reader.read(rectangles.row(i).data());
        const double z = rectangles(i, 4);
        counter.count(seen, z);
        measured.row(i) << counter.distance(model.histogram), counter.counted() / counter.places(),
            count_below(seen, reader.places(), z - nearer) / counter.places();
    }
    return measured;
}

}  // namespace tricue
