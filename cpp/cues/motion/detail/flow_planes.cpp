// SPDX-License-Identifier: MIT
#include "cues/motion/detail/flow_planes.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/check.hpp"

namespace tricue {
namespace {

constexpr int kMaxSide = 16384;

std::string size(const ImageView& image) {
    return shape_text(image.rows, image.cols);
}

}  // namespace

void require_frames(const ImageView& previous, const ImageView& current,
                    const std::optional<Region>& region) {
    if (previous.rows < 1 || previous.cols < 1) refuse("previous", "at least one pixel", "none");
    if (std::max(previous.rows, previous.cols) > kMaxSide)
        refuse("previous", "at most 16384 pixels a side", size(previous));
    if (size(current) != size(previous))
        refuse("current", "the previous frame's shape " + size(previous), size(current));
    if (region) require_region(*region, current.rows, current.cols);
}

void require_minima(const FlowMinima& minima) {
    if (!(minima.angle >= 0 && minima.angle <= 1)) refuse("min_angle", "0 to 1", minima.angle);
    if (!(minima.contrast >= 0 && std::isfinite(minima.contrast)))
        refuse("min_contrast", "a finite number, not negative", minima.contrast);
}

Region region_or_all(const std::optional<Region>& region, const ImageView& frame) {
    return region.value_or(Region{0, 0, frame.cols, frame.rows});
}

}  // namespace tricue
