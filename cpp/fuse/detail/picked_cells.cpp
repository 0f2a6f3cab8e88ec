// SPDX-License-Identifier: MIT
#include "fuse/detail/picked_cells.hpp"

#include "cues/color/hog_color_cells.hpp"

namespace tricue {

FloatPlanes picked_cells(const ImageView& patch, PlacesRef places, FloatsRef taper) {
    const PixelBytes picked = pick_pixels(patch, places);
    const int rows = static_cast<int>(places.rows()), cols = static_cast<int>(places.cols());
    return hog_color_cells({picked.data(), rows, cols, 3, 3 * std::ptrdiff_t{cols}}, taper);
}

}  // namespace tricue
