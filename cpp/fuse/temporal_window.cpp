// SPDX-License-Identifier: MIT
#include "fuse/temporal_window.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "base/check.hpp"
#include "base/overlapping_blocks.hpp"
#include "base/pixel_runs.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

using Counts = std::vector<std::int64_t>;

/// Calls body for n pixels in large blocks, or in small ones if a row is shorter than a large one.
template <typename Body>
TRICUE_INLINE void for_row(int n, Body body) {
    constexpr int kLarge = 64, kSmall = 16;
    if (n < kLarge)
        for_overlapping_blocks<kSmall>(n, body);
    else
        for_overlapping_blocks<kLarge>(n, body);
}

TRICUE_MULTIVERSION
void mark_row(const std::uint8_t* __restrict mask, int n, std::uint8_t* __restrict set) {
    for_row(n, [=](std::ptrdiff_t x) { set[x] = mask[x] != 0; });
}

/// Pixels [0, n) of `here`, 1 where set, that have enough neighbors; rows have one more pixel on either side.
TRICUE_MULTIVERSION
void keep_row(const std::uint8_t* __restrict above, const std::uint8_t* __restrict here,
              const std::uint8_t* __restrict below, int n, std::uint8_t neighbors,
              std::uint8_t* __restrict kept) {
    for_row(n, [=](std::ptrdiff_t x) {
        const auto count = static_cast<std::uint8_t>(above[x - 1] + above[x] + above[x + 1] + here[x - 1] +
                                                     here[x + 1] + below[x - 1] + below[x] + below[x + 1]);
        kept[x] = here[x] & static_cast<std::uint8_t>(count >= neighbors);
    });
}

/// The runs of set pixels with enough neighbors.
PixelRuns find_dense_runs(const ImageView& mask, int neighbors) {
    const auto padded = static_cast<std::size_t>(mask.cols) + 2;
    std::vector<std::uint8_t> rows[3], kept(static_cast<std::size_t>(mask.cols));
    for (auto& row : rows) row.assign(padded, 0);
    PixelRuns runs(mask.cols);
    if (mask.rows > 0) mark_row(mask.row(0), mask.cols, rows[1].data() + 1);
    for (int y = 0; y < mask.rows; ++y) {
        if (y + 1 < mask.rows)
            mark_row(mask.row(y + 1), mask.cols, rows[2].data() + 1);
        else
            std::fill(rows[2].begin(), rows[2].end(), std::uint8_t{0});
        keep_row(rows[0].data() + 1, rows[1].data() + 1, rows[2].data() + 1, mask.cols,
                 static_cast<std::uint8_t>(neighbors), kept.data());
        runs.add_row(kept.data());
        std::rotate(rows, rows + 1, rows + 3);
    }
    return runs;
}

/// The area of each region, at the index of its first run; 0 for other runs.
Counts areas(PixelRuns& runs) {
    Counts areas(runs.size());
    for (std::size_t i = 0; i < runs.size(); ++i) areas[runs.root(i)] += runs[i].length();
    return areas;
}

/// Kept pixels by column and by row. A run adds 1 to `columns` where it begins and subtracts 1 where it ends.
struct MaskProfile {
    Counts columns, rows;
    std::int64_t count = 0;

    MaskProfile(int width, int height)
        : columns(static_cast<std::size_t>(width) + 1), rows(static_cast<std::size_t>(height)) {}

    void add(const PixelRun& run) {
        ++columns[static_cast<std::size_t>(run.begin)];
        --columns[static_cast<std::size_t>(run.end)];
        rows[static_cast<std::size_t>(run.row)] += run.length();
        count += run.length();
    }
};

/// The positions of the `out`-th pixel from the start, and of the `out`-th from the end plus 1; counted from 0.
std::pair<int, int> trimmed(const Counts& counts, std::int64_t count, std::int64_t out) {
    const auto place_of = [&](std::int64_t pixel) {
        int place = 0;
        while ((pixel -= counts[static_cast<std::size_t>(place)]) >= 0) ++place;
        return place;
    };
    return {place_of(out), place_of(count - 1 - out) + 1};
}

void require_arguments(int neighbors, double share, double trim) {
    if (neighbors < 0 || neighbors > 8) refuse("neighbors", "0 to 8", std::to_string(neighbors));
    if (!(share >= 0.0 && share <= 1.0)) refuse("share", "a number in [0, 1]", share);
    if (!(trim >= 0.0 && trim < 0.5)) refuse("trim", "a number in [0, 0.5)", trim);
}

}  // namespace

TemporalWindow temporal_window(const ImageView& mask, int neighbors, double share, double trim) {
    require_arguments(neighbors, share, trim);
    TemporalWindow window{{0, 0, 0, 0}, 0, Labels::Zero(mask.rows, mask.cols)};
    PixelRuns runs = find_dense_runs(mask, neighbors);
    if (runs.size() == 0) return window;
    const Counts area = areas(runs);
    const double least = share * static_cast<double>(*std::max_element(area.begin(), area.end()));
    MaskProfile left(mask.cols, mask.rows);
    for (std::size_t i = 0; i < runs.size(); ++i) {
        if (static_cast<double>(area[runs.root(i)]) < least) continue;
        left.add(runs[i]);
        std::fill_n(window.mask.row(runs[i].row).data() + runs[i].begin, runs[i].length(), std::uint8_t{1});
    }
    std::partial_sum(left.columns.begin(), left.columns.end(), left.columns.begin());
    const auto out = static_cast<std::int64_t>(std::floor(trim * static_cast<double>(left.count)));
    const auto [x0, x1] = trimmed(left.columns, left.count, out);
    const auto [y0, y1] = trimmed(left.rows, left.count, out);
    window.box = {x0, y0, x1, y1};
    window.count = left.count;
    return window;
}

}  // namespace tricue
