// SPDX-License-Identifier: MIT
// OpenCV's connectedComponentsWithStats is slower than joining runs, and can't be used in a kernel: with 32-bit labels it starts
// threads, and 16-bit labels are too few for a frame of 640x480.
#include "cues/color/skin_blobs.hpp"

#include <algorithm>
#include <tuple>
#include <vector>

#include "base/check.hpp"
#include "base/pixel_runs.hpp"
#include "base/simd.hpp"
#include "cues/color/skin_boundary.hpp"

namespace tricue {
namespace {

struct Blob {
    int x0, y0, x1, y1;
    std::int64_t area, twice_x, twice_y;

    void add(const PixelRun& run) {
        const std::int64_t length = run.length();
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

PixelRuns skin_runs(const ImageView& image, const Bgr& reference, std::int16_t least) {
    std::vector<std::int16_t> boundary(static_cast<std::size_t>(image.cols));
    std::vector<std::uint8_t> skin(boundary.size());
    PixelRuns runs(image.cols);
    for (int row = 0; row < image.rows; ++row) {
        skin_boundary_row(image.row(row), image.cols, reference, boundary.data());
        mark_skin(boundary.data(), image.cols, least, skin.data());
        runs.add_row(skin.data());
    }
    return runs;
}

std::vector<Blob> collect_blobs(PixelRuns& runs, int min_area) {
    std::vector<Blob> blobs;
    std::vector<std::size_t> blob_of(runs.size());
    for (std::size_t i = 0; i < runs.size(); ++i) {
        const std::size_t first = runs.root(i);
        const PixelRun& run = runs[i];
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
    const auto blobs = collect_blobs(runs, min_area);
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
