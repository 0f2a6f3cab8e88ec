// SPDX-License-Identifier: MIT
#include "cues/color/rank_window.hpp"

#include <vector>

#include "base/check.hpp"
#include "cues/color/detail/compare_window.hpp"
#include "cues/color/detail/ellipse_sampler.hpp"
#include "cues/color/detail/rank_maps.hpp"

namespace tricue {

RankWindow rank_window(const ImageView& image, VectorRef ellipse, StatesRef pattern, FloatsRef models,
                       double flat) {
    require_size(ellipse, 4, "ellipse");
    require_finite(ellipse, "ellipse");
    if (pattern.rows() < 1) refuse("pattern", "at least one place", "none");
    EllipseSampler sampler(image, pattern, "pattern");
    require_rank_maps(models, sampler.size());

    std::vector<std::uint8_t> planes(static_cast<std::size_t>(3 * sampler.size()));
    sampler.read(ellipse.data(), 1, planes.data());
    return compare_window(planes.data(), sampler.size(), models, flat);
}

}  // namespace tricue
