// SPDX-License-Identifier: MIT
#include "cues/depth/fill_gaps.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "blocks.hpp"
#include "check.hpp"
#include "depth_pixels.hpp"
#include "simd.hpp"

namespace tricue {
namespace {

constexpr float kFar = std::numeric_limits<float>::infinity();
constexpr float kLargest = std::numeric_limits<float>::max();

/// A depth image with a rim of one pixel, infinite there and where nothing was measured: so that is never the nearest.
struct Padded {
    int rows, cols;
    std::vector<float> pixels;

    Padded(int height, int width)
        : rows(height),
          cols(width),
          pixels((static_cast<std::size_t>(height) + 2) * (static_cast<std::size_t>(width) + 2), kFar) {}

    /// From the first pixel of row y on, which is between -1 and `rows`; the rim's pixels are beside it.
    float* row(int y) { return pixels.data() + (std::ptrdiff_t{y} + 1) * (std::ptrdiff_t{cols} + 2) + 1; }
};

struct Count {
    std::int64_t measured = 0, ends = 0;

    bool exceeds(double ragged) const {
        return static_cast<double>(ends) > ragged * static_cast<double>(measured);
    }
};

TRICUE_MULTIVERSION
void load_row(const float* __restrict depth, int n, float* __restrict padded) {
    in_blocks(n, [=](std::ptrdiff_t x) { padded[x] = has_depth(depth[x]) ? depth[x] : kFar; });
}

TRICUE_MULTIVERSION
void store_row(const float* __restrict padded, int n, float* __restrict depth) {
    in_blocks(n, [=](std::ptrdiff_t x) {
        depth[x] = padded[x] <= kLargest ? padded[x] : std::numeric_limits<float>::quiet_NaN();
    });
}

/// The last pixel of a row ends nothing: what is beyond isn't known.
TRICUE_MULTIVERSION
void count_row(const float* padded, int n, std::int32_t* measured, std::int32_t* ends) {
    std::int32_t all = 0, last = 0;
    for (int x = 0; x < n; ++x) all += padded[x] <= kLargest;
    for (int x = 0; x + 1 < n; ++x) last += (padded[x] <= kLargest) & !(padded[x + 1] <= kLargest);
    *measured = all;
    *ends = last;
}

Count count(Padded& image) {
    Count sum;
    for (int y = 0; y < image.rows; ++y) {
        std::int32_t measured = 0, ends = 0;
        count_row(image.row(y), image.cols, &measured, &ends);
        sum.measured += measured;
        sum.ends += ends;
    }
    return sum;
}

inline float least(float a, float b) {
    return a < b ? a : b;
}

/// Written out: compilers don't vectorise a loop over the neighbours inside the one over the pixels.
TRICUE_MULTIVERSION
void fill_row(const float* __restrict above, const float* __restrict here, const float* __restrict below,
              int n, float gap, float slope, float* __restrict filled) {
    in_blocks(n, [=](std::ptrdiff_t x) {
        const float a = above[x - 1], b = above[x], c = above[x + 1], d = here[x - 1], e = here[x + 1],
                    f = below[x - 1], g = below[x], h = below[x + 1];
        const float nearest = least(least(least(a, b), least(c, d)), least(least(e, f), least(g, h)));
        // Where the square overflows, what wasn't measured still isn't on the surface.
        const float reach = least(nearest + (gap + slope * (nearest * nearest)), kLargest);
        const auto value = [reach](float z) { return z <= reach ? z : 0.0f; };
        const auto vote = [reach](float z) { return z <= reach ? 1.0f : 0.0f; };
        const float sum =
            value(a) + value(b) + value(c) + value(d) + value(e) + value(f) + value(g) + value(h);
        const float votes = vote(a) + vote(b) + vote(c) + vote(d) + vote(e) + vote(f) + vote(g) + vote(h);
        const float mean = sum / votes, old = here[x];
        filled[x] = old <= kLargest ? old : votes >= 2.0f ? mean : kFar;
    });
}

void require_step(double value, const char* name) {
    if (!(value >= 0.0 && std::isfinite(value))) refuse(name, "a finite number, not negative", value);
}

}  // namespace

Floats fill_gaps(const DepthView& depth, double gap, double slope, double ragged, int passes) {
    require_step(gap, "gap");
    require_step(slope, "slope");
    if (!(ragged >= 0.0 && ragged <= 1.0)) refuse("ragged", "a share from 0 to 1", ragged);
    if (passes < 0) refuse("passes", "at least 0", passes);
    Padded image(depth.rows, depth.cols);
    for (int y = 0; y < depth.rows; ++y) load_row(depth.row(y), depth.cols, image.row(y));
    for (int pass = 0; pass < passes && count(image).exceeds(ragged); ++pass) {
        Padded filled(depth.rows, depth.cols);
        for (int y = 0; y < depth.rows; ++y)
            fill_row(image.row(y - 1), image.row(y), image.row(y + 1), depth.cols, static_cast<float>(gap),
                     static_cast<float>(slope), filled.row(y));
        std::swap(image, filled);
    }
    Floats result(depth.rows, depth.cols);
    for (int y = 0; y < depth.rows; ++y)
        store_row(image.row(y), depth.cols, result.data() + std::ptrdiff_t{y} * depth.cols);
    return result;
}

}  // namespace tricue
