// SPDX-License-Identifier: MIT
#include "fuse/temporal_window.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "base/bit_image.hpp"
#include "base/check.hpp"
#include "base/pixel_runs.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

using Counts = std::vector<std::int64_t>;

/// Adds up to three bits at each place of a word: the sums, and what is carried.
struct AddedBits {
    std::uint64_t sum, carry;
};

AddedBits add_bits(std::uint64_t a, std::uint64_t b, std::uint64_t c = 0) {
    return {a ^ b ^ c, (a & b) | (c & (a ^ b))};
}

/// The set pixels of a word with enough set neighbors, which are counted for all of them at once.
std::uint64_t dense_pixels(const BitImage& mask, int y, int i, int enough) {
    const auto around = mask.neighbors(y, i);
    const AddedBits first = add_bits(around[0], around[1], around[2]),
                    second = add_bits(around[3], around[4], around[5]),
                    third = add_bits(around[6], around[7]), ones = add_bits(first.sum, second.sum, third.sum),
                    pairs = add_bits(first.carry, second.carry, third.carry),
                    twos = add_bits(pairs.sum, ones.carry), fours = add_bits(pairs.carry, twos.carry);
    const std::uint64_t count[] = {ones.sum, twos.sum, fours.sum, fours.carry};
    std::uint64_t more = 0, equal = ~std::uint64_t{0};
    for (int k = 3; k >= 0; --k) {
        const std::uint64_t wanted = enough >> k & 1 ? ~std::uint64_t{0} : 0;
        more |= equal & count[k] & ~wanted;
        equal &= ~(count[k] ^ wanted);
    }
    return mask.word(y, i) & (more | equal);
}

/// The runs of set pixels with enough neighbors.
PixelRuns find_dense_runs(const ImageView& mask, int neighbors) {
    BitImage set(mask.rows, mask.cols);
    for (int y = 0; y < mask.rows; ++y) set.read(y, mask.row(y));
    PixelRuns runs(mask.cols);
    for (int y = 0; y < mask.rows; ++y) {
        int begin = -1;  // of a run that hasn't ended
        std::uint64_t before = 0;
        for (int i = 0; i < set.words(); ++i) {
            const std::uint64_t kept = dense_pixels(set, y, i, neighbors);
            for (std::uint64_t edges = kept ^ (kept << 1 | before >> 63); edges != 0; edges &= edges - 1) {
                const int x = i * BitImage::kWord + lowest_bit(edges);
                if (begin >= 0) runs.add(begin, x, 1);
                begin = begin < 0 ? x : -1;
            }
            before = kept;
        }
        if (begin >= 0) runs.add(begin, mask.cols, 1);
        runs.end_row();
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
