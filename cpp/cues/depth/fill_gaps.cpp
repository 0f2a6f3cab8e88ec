// SPDX-License-Identifier: MIT
#include "cues/depth/fill_gaps.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "base/check.hpp"
#include "base/depth_pixels.hpp"
#include "base/overlapping_blocks.hpp"
#include "base/simd.hpp"
#include "cues/depth/detail/depth_rows.hpp"

namespace tricue {
namespace {

constexpr float kMaxFloat = std::numeric_limits<float>::max();
constexpr int kMaxPasses = 1000;

TRICUE_MULTIVERSION
void copy_row(const float* __restrict depth, int n, float missing, float* __restrict copy) {
    for_overlapping_blocks(n, [=](std::ptrdiff_t x) { copy[x] = has_depth(depth[x]) ? depth[x] : missing; });
}

/// A depth image with a border of one pixel; infinite there and where nothing was measured, so that those are never the nearest.
struct PaddedDepth {
    int rows, cols;
    std::vector<float> pixels;

    explicit PaddedDepth(const DepthView& depth)
        : rows(depth.rows),
          cols(depth.cols),
          pixels((static_cast<std::size_t>(rows) + 2) * (static_cast<std::size_t>(cols) + 2), kUnmeasured) {
        for (int y = 0; y < rows; ++y) copy_row(depth.row(y), cols, kUnmeasured, row(y));
    }

    /// The first pixel of row y, -1 to `rows`; the border is beside it.
    float* row(int y) { return pixels.data() + (std::ptrdiff_t{y} + 1) * (std::ptrdiff_t{cols} + 2) + 1; }
    DepthView view() { return {row(0), rows, cols, std::ptrdiff_t{cols} + 2}; }
};

constexpr int kWord = 64;  // pixels, a bit for each

/// Of a row. `known` has whole words and one more, all 0 beyond the end of the row: pixels there count as not measured.
TRICUE_MULTIVERSION
void count_gaps(const float* __restrict depth, int n, std::uint8_t* __restrict known, std::int32_t* measured,
                std::int32_t* gaps) {
    for_overlapping_blocks(n, [=](std::ptrdiff_t x) { known[x] = has_depth(depth[x]); });
    std::int32_t all = 0, short_gaps = 0;
    std::uint64_t here = nonzero_bytes(known);
    for (int first = 0; first < n; first += kWord) {
        const std::uint64_t next = nonzero_bytes(known + first + kWord);
        const auto ahead = [=](int pixels) { return here >> pixels | next << (kWord - pixels); };
        all += count_bits(here);
        short_gaps += count_bits(here & ~ahead(1) & (ahead(2) | ahead(3) | ahead(4)));
        here = next;
    }
    *measured = all;
    *gaps = short_gaps;
}

/// A copy, NaN where nothing was measured.
Floats copy_measured(const DepthView& depth) {
    Floats copy(depth.rows, depth.cols);
    for (int y = 0; y < depth.rows; ++y)
        copy_row(depth.row(y), depth.cols, std::numeric_limits<float>::quiet_NaN(),
                 copy.data() + std::ptrdiff_t{y} * depth.cols);
    return copy;
}

/// Unrolled by hand: compilers don't vectorize a loop over the neighbors inside the one over the pixels.
TRICUE_MULTIVERSION
void fill_row(const float* __restrict above, const float* __restrict here, const float* __restrict below,
              int n, float gap, float slope, float* __restrict filled) {
    for_overlapping_blocks(n, [=](std::ptrdiff_t x) {
        const float a = above[x - 1], b = above[x], c = above[x + 1], d = here[x - 1], e = here[x + 1],
                    f = below[x - 1], g = below[x], h = below[x + 1];
        const float nearest =
            smaller(smaller(smaller(a, b), smaller(c, d)), smaller(smaller(e, f), smaller(g, h)));
        // Finite even if the square overflows, so that pixels without a measurement are never on the surface.
        const float reach = smaller(nearest + (gap + slope * (nearest * nearest)), kMaxFloat);
        const auto value = [reach](float z) { return z <= reach ? z : 0.0f; };
        const auto vote = [reach](float z) { return z <= reach ? 1.0f : 0.0f; };
        const float sum =
            value(a) + value(b) + value(c) + value(d) + value(e) + value(f) + value(g) + value(h);
        const float votes = vote(a) + vote(b) + vote(c) + vote(d) + vote(e) + vote(f) + vote(g) + vote(h);
        const float mean = sum / votes, old = here[x];
        filled[x] = old <= kMaxFloat ? old : votes >= 2.0f ? mean : kUnmeasured;
    });
}

/// One pass, in place; rows that will still be read are copied first.
void fill_pass(PaddedDepth& image, float gap, float slope) {
    const auto width = static_cast<std::size_t>(image.cols) + 2;
    std::vector<float> above(width, kUnmeasured), here(width);
    for (int y = 0; y < image.rows; ++y) {
        float* row = image.row(y);
        std::copy_n(row - 1, width, here.begin());
        fill_row(above.data() + 1, here.data() + 1, image.row(y + 1), image.cols, gap, slope, row);
        std::swap(above, here);
    }
}

}  // namespace

void require_gaps(const Gaps& gaps) {
    require_not_negative(gaps.gap, "gap");
    require_not_negative(gaps.slope, "slope");
    if (!(gaps.max_gap_share >= 0.0 && gaps.max_gap_share <= 1.0))
        refuse("max_gap_share", "a share from 0 to 1", gaps.max_gap_share);
    require_count(gaps.passes, 0, kMaxPasses, "passes");
}

bool has_many_gaps(const DepthView& depth, double share) {
    const int words = (depth.cols + kWord - 1) / kWord + 1;
    std::vector<std::uint8_t> known(static_cast<std::size_t>(words) * kWord);
    std::int64_t measured = 0, gaps = 0;
    for (int y = 0; y < depth.rows; ++y) {
        std::int32_t measured_here = 0, gaps_here = 0;
        count_gaps(depth.row(y), depth.cols, known.data(), &measured_here, &gaps_here);
        measured += measured_here;
        gaps += gaps_here;
    }
    return static_cast<double>(gaps) > share * static_cast<double>(measured);
}

Floats run_passes(const DepthView& depth, const Gaps& gaps) {
    PaddedDepth image(depth);
    for (int pass = 0;
         pass == 0 || (pass < gaps.passes && has_many_gaps(image.view(), gaps.max_gap_share / 2)); ++pass)
        fill_pass(image, static_cast<float>(gaps.gap), static_cast<float>(gaps.slope));
    return copy_measured(image.view());
}

Floats fill_gaps(const DepthView& depth, double gap, double slope, double max_gap_share, int passes) {
    const Gaps gaps{gap, slope, max_gap_share, passes};
    require_gaps(gaps);
    return passes > 0 && has_many_gaps(depth, max_gap_share) ? run_passes(depth, gaps) : copy_measured(depth);
}

}  // namespace tricue
