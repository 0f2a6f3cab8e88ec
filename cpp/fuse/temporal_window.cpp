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

TRICUE_MULTIVERSION
void mark_row(const std::uint8_t* __restrict mask, int n, std::uint8_t* __restrict set) {
    in_blocks(n, [=](std::ptrdiff_t x) { set[x] = mask[x] != 0; });
}

/// Pixels [0, n) of `here`, 1 where set, that have enough neighbours; each row goes on by one pixel on either side.
TRICUE_MULTIVERSION
void keep_row(const std::uint8_t* __restrict above, const std::uint8_t* __restrict here,
              const std::uint8_t* __restrict below, int n, std::uint8_t neighbours,
              std::uint8_t* __restrict kept) {
    in_blocks(n, [=](std::ptrdiff_t x) {
        const auto count = static_cast<std::uint8_t>(above[x - 1] + above[x] + above[x + 1] + here[x - 1] +
                                                     here[x + 1] + below[x - 1] + below[x] + below[x + 1]);
        kept[x] = here[x] & static_cast<std::uint8_t>(count >= neighbours);
    });
}

/// The runs of set pixels with enough neighbours.
Runs cleaned(const ImageView& mask, int neighbours) {
    const auto padded = static_cast<std::size_t>(mask.cols) + 2;
    std::vector<std::uint8_t> rows[3], kept(static_cast<std::size_t>(mask.cols));
    for (auto& row : rows) row.assign(padded, 0);
    Runs runs(mask.cols);
    if (mask.rows > 0) mark_row(mask.row(0), mask.cols, rows[1].data() + 1);
    for (int y = 0; y < mask.rows; ++y) {
        if (y + 1 < mask.rows)
            mark_row(mask.row(y + 1), mask.cols, rows[2].data() + 1);
        else
            std::fill(rows[2].begin(), rows[2].end(), std::uint8_t{0});
        keep_row(rows[0].data() + 1, rows[1].data() + 1, rows[2].data() + 1, mask.cols,
                 static_cast<std::uint8_t>(neighbours), kept.data());
        runs.add_row(kept.data());
        std::rotate(rows, rows + 1, rows + 3);
    }
    return runs;
}

/// How many pixels the region has of which each run is the first; 0 for other runs.
Counts areas(Runs& runs) {
    Counts areas(runs.size());
    for (std::size_t i = 0; i < runs.size(); ++i) areas[runs.root(i)] += runs[i].length();
    return areas;
}

/// What is left, by column and by row. A run adds 1 to the columns from where it begins, and takes it back where it ends.
struct Tally {
    Counts columns, rows;
    std::int64_t count = 0;

    Tally(int width, int height)
        : columns(static_cast<std::size_t>(width) + 1), rows(static_cast<std::size_t>(height)) {}

    void add(const Run& run) {
        ++columns[static_cast<std::size_t>(run.begin)];
        --columns[static_cast<std::size_t>(run.end)];
        rows[static_cast<std::size_t>(run.row)] += run.length();
        count += run.length();
    }
};

/// Places of the `out`-th pixel, counted from 0, and of that many from the last, plus 1.
std::pair<int, int> trimmed(const Counts& counts, std::int64_t count, std::int64_t out) {
    const auto place_of = [&](std::int64_t pixel) {
        int place = 0;
        while ((pixel -= counts[static_cast<std::size_t>(place)]) >= 0) ++place;
        return place;
    };
    return {place_of(out), place_of(count - 1 - out) + 1};
}

void require(int neighbours, double share, double trim) {
    if (neighbours < 0 || neighbours > 8) refuse("neighbors", "0 to 8", std::to_string(neighbours));
    if (!(share >= 0.0 && share <= 1.0)) refuse("share", "a number in [0, 1]", share);
    if (!(trim >= 0.0 && trim < 0.5)) refuse("trim", "a number in [0, 0.5)", trim);
}

}  // namespace

TemporalWindow temporal_window(const ImageView& mask, int neighbours, double share, double trim) {
    require(neighbours, share, trim);
    TemporalWindow window{{0, 0, 0, 0}, 0, Labels::Zero(mask.rows, mask.cols)};
    Runs runs = cleaned(mask, neighbours);
    if (runs.size() == 0) return window;
    const Counts area = areas(runs);
    const double least = share * static_cast<double>(*std::max_element(area.begin(), area.end()));
    Tally left(mask.cols, mask.rows);
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
