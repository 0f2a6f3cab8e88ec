// SPDX-License-Identifier: MIT
#include "cues/color/pick_pixels.hpp"

#include <algorithm>
#include <cstring>
#include <string>

#include "base/check.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

struct Range {
    std::int64_t least = 0, most = -1;
};

TRICUE_MULTIVERSION
void find_range(const std::int64_t* places, std::ptrdiff_t n, Range* range) {
    std::int64_t least = places[0], most = places[0];
    for (std::ptrdiff_t k = 1; k < n; ++k) {
        least = places[k] < least ? places[k] : least;
        most = places[k] > most ? places[k] : most;
    }
    *range = {least, most};
}

}  // namespace

PixelBytes pick_pixels(const ImageView& image, PlacesRef places) {
    const std::int64_t pixels = std::int64_t{image.rows} * image.cols;
    if (image.rows > 1 && pixels > 0 && image.stride != 3 * std::ptrdiff_t{image.cols})
        refuse("image", "rows without padding", std::to_string(image.stride) + " bytes a row");
    PixelBytes picked(3 * places.size());
    if (places.size() == 0) return picked;
    Range range;
    find_range(places.data(), places.size(), &range);
    if (range.least < 0 || range.most >= pixels)
        refuse("places", "0 to " + std::to_string(pixels - 1),
               std::to_string(range.least < 0 ? range.least : range.most));

    // Words of four bytes, whose fourth byte the next pixel overwrites; except the image's last pixel, and the last one picked.
    const std::int64_t* place = places.data();
    std::uint8_t* out = picked.data();
    const std::ptrdiff_t words = range.most < pixels - 1 ? places.size() - 1 : 0;
    for (std::ptrdiff_t k = 0; k < words; ++k, out += 3) std::memcpy(out, image.data + 3 * place[k], 4);
    for (std::ptrdiff_t k = words; k < places.size(); ++k, out += 3)
        std::copy_n(image.data + 3 * place[k], 3, out);
    return picked;
}

}  // namespace tricue
