// SPDX-License-Identifier: MIT
#pragma once
// The color space of kernels that bin colors.

#include <array>

#include "cues/color/detail/color_space.hpp"
#include "tuples.hpp"

namespace tricue::bindings {

using SpaceTuple = Tuple<Tuple<int, int, int>, int>;

inline ColorSpace color_space(const SpaceTuple& space) {
    const auto [bins, chroma] = unpack(space, "space");
    return {unpack_as<std::array<int, 3>>(bins, "bins"), chroma};
}

}  // namespace tricue::bindings
