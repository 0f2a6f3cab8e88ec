// SPDX-License-Identifier: MIT
#include "cues/color/rank_distance.hpp"

#include "cues/color/detail/rank_maps.hpp"

namespace tricue {

States rank_distance(const SampleView& samples, FloatsRef models) {
    RankMaps maps(models, samples.n);
    States distances(samples.ellipses, maps.size());
    maps.compare(samples, distances.data());
    return distances;
}

}  // namespace tricue
