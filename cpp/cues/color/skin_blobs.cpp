// SPDX-License-Identifier: MIT
// Runs of skin, not pixels, are joined. OpenCV's connectedComponentsWithStats is slower, and no choice in a
// kernel: with 32-bit labels it starts threads, and 16-bit labels are too few for a frame of 640x480.
#include "cues/color/skin_blobs.hpp"

#include <algorithm>
#include <cstring>
#include <tuple>
#include <vector>

#include "check.hpp"
#include "cues/color/skin_boundary.hpp"
#include "simd.hpp"

namespace tricue {
namespace {

/// Skin pixels [begin, end) of one row; `parent` is a run of the same blob, never a later one.
struct Run {
    int row, begin, end;
    std::size_t parent;
};

struct Blob {
    int x0, y0, x1, y1;
    std::int64_t area, twice_x, twice_y;

    void add(const Run& run) {
        const std::int64_t length = run.end - run.begin;
        x0 = std::min(x0, run.begin);
        x1 = std::max(x1, run.end);
        y1 = run.row + 1;
        area += length;
        twice_x += length * (run.begin + run.end);
        twice_y += length * (2 * run.row + 1);
    }
};

TRICUE_MULTIVERSION
void mark_skin(const std::int16_t* __restrict boundary, int n, std::int16_t least,
               std::uint8_t* __restrict skin) {
    for (int x = 0; x < n; ++x) skin[x] = boundary[x] >= least;
}

/// The first pixel from `x` on that is (or isn't) skin; `n` if there is none.
int find(const std::vector<std::uint8_t>& skin, int x, bool wanted) {
    const auto* found = static_cast<const std::uint8_t*>(
        std::memchr(skin.data() + x, wanted, skin.size() - static_cast<std::size_t>(x)));
    return found ? static_cast<int>(found - skin.data()) : static_cast<int>(skin.size());
}

std::size_t root(std::vector<Run>& runs, std::size_t i) {
    while (runs[i].parent != i) i = runs[i].parent = runs[runs[i].parent].parent;
    return i;
}

/// Joins the row's runs, from `current` on, with those of the row above, from `above` on, that they touch.
void join(std::vector<Run>& runs, std::size_t above, std::size_t current) {
    for (std::size_t a = above, c = current; a < current && c < runs.size();) {
        if (runs[a].begin <= runs[c].end && runs[c].begin <= runs[a].end) {
            const auto [first, second] = std::minmax({root(runs, a), root(runs, c)});
            runs[second].parent = first;
        }
        if (runs[a].end < runs[c].end)
            ++a;
        else
            ++c;
    }
}

std::vector<Run> skin_runs(const ImageView& image, const Bgr& reference, std::int16_t least) {
    std::vector<std::int16_t> boundary(static_cast<std::size_t>(image.cols));
    std::vector<std::uint8_t> skin(boundary.size());
    std::vector<Run> runs;
    if (image.cols == 0) return runs;
    std::size_t above = 0;
    for (int row = 0; row < image.rows; ++row) {
        skin_boundary_row(image.row(row), image.cols, reference, boundary.data());
        mark_skin(boundary.data(), image.cols, least, skin.data());
        const std::size_t current = runs.size();
        for (int x = find(skin, 0, true); x < image.cols;) {
            const int end = find(skin, x, false);
            runs.push_back({row, x, end, runs.size()});
            x = find(skin, end, true);
        }
        join(runs, above, current);
        above = current;
    }
    return runs;
}

std::vector<Blob> gather(std::vector<Run>& runs, int min_area) {
    std::vector<Blob> blobs;
    std::vector<std::size_t> blob_of(runs.size());
    for (std::size_t i = 0; i < runs.size(); ++i) {
        const Run run = runs[i];
        const std::size_t first = root(runs, i);
        if (first == i) {
            blob_of[i] = blobs.size();
            blobs.push_back({run.begin, run.row, run.end, run.row, 0, 0, 0});
        }
        blobs[blob_of[first]].add(run);
    }
    const auto small = [min_area](const Blob& blob) { return blob.area < min_area; };
    blobs.erase(std::remove_if(blobs.begin(), blobs.end(), small), blobs.end());
    std::stable_sort(blobs.begin(), blobs.end(), [](const Blob& a, const Blob& b) {
        return std::tie(b.area, a.y0, a.x0) < std::tie(a.area, b.y0, b.x0);
    });
    return blobs;
}

}  // namespace

States skin_blobs(const ImageView& image, const Bgr& reference, double threshold, int min_area) {
    if (min_area < 1) refuse("min_area", "at least 1", min_area);
    auto runs = skin_runs(image, reference, static_cast<std::int16_t>(least_skin(threshold)));
    const auto blobs = gather(runs, min_area);
    States rows(static_cast<Eigen::Index>(blobs.size()), 7);
    for (Eigen::Index i = 0; i < rows.rows(); ++i) {
        const Blob& blob = blobs[static_cast<std::size_t>(i)];
        const auto twice_area = static_cast<double>(2 * blob.area);
        rows.row(i) << blob.x0, blob.y0, blob.x1 - blob.x0, blob.y1 - blob.y0, static_cast<double>(blob.area),
            static_cast<double>(blob.twice_x) / twice_area, static_cast<double>(blob.twice_y) / twice_area;
    }
    return rows;
}

}  // namespace tricue
