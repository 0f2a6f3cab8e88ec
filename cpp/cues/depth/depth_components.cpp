// SPDX-License-Identifier: MIT
#include "cues/depth/depth_components.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include "base/check.hpp"
#include "base/depth_pixels.hpp"
#include "base/pixel_runs.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

using Counts = std::vector<std::int32_t>;

/// Neighbors in a row mostly have the same level: they are counted in different tables, so that they don't wait for each other.
constexpr std::size_t kLanes = 4;
constexpr int kMaxBins = 4096;

/// Levels of a row's pixels, `levels` where nothing was measured, and their depths, 0 there.
TRICUE_MULTIVERSION
void find_levels(const float* __restrict depth, int n, double near, double scale, int levels,
                 std::int32_t* __restrict level, double* __restrict meters) {
    const double last = levels - 1;
    for (int x = 0; x < n; ++x) {
        const bool measured = has_depth(depth[x]);
        const double z = measured ? static_cast<double>(depth[x]) : 0.0;
        const auto clamped = static_cast<std::int32_t>(std::min(std::max(0.0, (z - near) * scale), last));
        level[x] = measured ? clamped : levels;
        meters[x] = z;
    }
}

/// The starts and ends of a row's runs. Returns the number of runs.
TRICUE_MULTIVERSION
std::ptrdiff_t list_runs(const BitImage& labeled, const BitImage& changes, int y, bool single,
                         std::int32_t* begins, std::int32_t* ends) {
    std::int32_t *begin = begins, *end = ends;
    std::uint64_t before = 0;
    for (int i = 0; i <= labeled.words(); ++i) {  // the last run may end with the last word
        const bool inside = i < labeled.words();
        const std::uint64_t change = inside ? changes.word(y, i) : 0;
        const std::uint64_t kept = !inside ? 0 : single ? labeled.word(y, i) : labeled.joined(y, i);
        const std::uint64_t left = kept << 1 | before >> 63;
        begin = list_bits<4>(kept & (~left | change), std::int32_t{i * BitImage::kWord}, begin);
        end = list_bits<4>(left & (~kept | change), std::int32_t{i * BitImage::kWord}, end);
        before = kept;
    }
    return begin - begins;
}

}  // namespace

PixelRuns label_runs(const BitImage& labeled, const BitImage& changes, const ImageView& labels, bool single) {
    PixelRuns runs(labels.cols);
    const std::size_t most = static_cast<std::size_t>(labels.cols) + BitImage::kWord;
    std::vector<std::int32_t> begins(most), ends(most);
    for (int y = 0; y < labels.rows; ++y) {
        if (labeled.is_empty(y)) {
            runs.end_row();
            continue;
        }
        const auto count =
            static_cast<std::size_t>(list_runs(labeled, changes, y, single, begins.data(), ends.data()));
        for (std::size_t i = 0; i < count; ++i) runs.add(begins[i], ends[i], labels.row(y)[begins[i]]);
        runs.end_row();
    }
    return runs;
}

namespace {

PixelRuns label_runs(const ImageView& labels, bool single) {
    BitImage labeled(labels.rows, labels.cols), changes(labels.rows, labels.cols);
    std::vector<std::uint8_t> changed(static_cast<std::size_t>(labels.cols));
    for (int y = 0; y < labels.rows; ++y) {
        labeled.read(y, labels.row(y));
        if (mark_changes(labels.row(y), labels.cols, changed.data())) changes.read(y, changed.data());
    }
    return label_runs(labeled, changes, labels, single);
}

struct Component {
    int x0, y0, x1, y1;
    std::int64_t area;
    std::uint8_t label;

    void add(const PixelRun& run) {
        x0 = std::min(x0, run.begin);
        x1 = std::max(x1, run.end);
        y1 = run.row + 1;
        area += run.length();
    }
};

/// The components that are large enough, in order, and for every run the index of its component among them, -1 without.
struct Grouping {
    std::vector<Component> components;
    std::vector<std::int32_t> component;
};

/// The box and area of each component, at its first run. No branch depends on which runs are joined, which can't be predicted.
std::vector<Component> collect_components(PixelRuns& runs) {
    runs.flatten();
    std::vector<Component> components(runs.size());
    for (std::size_t i = 0; i < runs.size(); ++i) {
        const PixelRun& run = runs[i];
        components[i] = {run.begin, run.row, run.end, run.row, 0, run.label};
        components[run.parent].add(run);
    }
    return components;
}

Grouping group(PixelRuns& runs, int min_area) {
    const auto all = collect_components(runs);
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < all.size(); ++i)
        if (all[i].area >= min_area) order.push_back(i);
    std::stable_sort(order.begin(), order.end(),
                     [&all](std::size_t a, std::size_t b) { return all[a].area > all[b].area; });

    Grouping groups;
    std::vector<std::int32_t> component(all.size(), -1);
    for (const std::size_t i : order) {
        component[i] = static_cast<std::int32_t>(groups.components.size());
        groups.components.push_back(all[i]);
    }
    groups.component.reserve(runs.size());
    for (std::size_t i = 0; i < runs.size(); ++i) groups.component.push_back(component[runs[i].parent]);
    return groups;
}

/// The counts of one component. A run adds 1 to `columns` where it begins and subtracts 1 where it ends; finish() adds them up.
struct ComponentCounts {
    Component box;
    Counts levels, columns, rows;
    std::array<double, kLanes> meters{};
    std::int64_t measured = 0;  ///< pixels; counted by level only after finish()

    ComponentCounts(const Component& component, int level_count)
        : box(component),
          levels(kLanes * (static_cast<std::size_t>(level_count) + 1)),
          columns(static_cast<std::size_t>(box.x1 - box.x0) + 1),
          rows(static_cast<std::size_t>(box.y1 - box.y0)) {}

    void add_box(const PixelRun& run) {
        ++columns[static_cast<std::size_t>(run.begin - box.x0)];
        --columns[static_cast<std::size_t>(run.end - box.x0)];
        rows[static_cast<std::size_t>(run.row - box.y0)] += run.length();
    }

    void add_depth(const std::int32_t* level, const double* depth, std::size_t n) {
        std::int32_t* counts = levels.data();
        auto sums = meters;
        std::size_t x = 0;
        for (; x + kLanes <= n; x += kLanes)
            for (std::size_t lane = 0; lane < kLanes; ++lane) {
                ++counts[kLanes * static_cast<std::size_t>(level[x + lane]) + lane];
                sums[lane] += depth[x + lane];
            }
        for (std::size_t lane = 0; x < n; ++x, ++lane) {
            ++counts[kLanes * static_cast<std::size_t>(level[x]) + lane];
            sums[lane] += depth[x];
        }
        meters = sums;
    }

    /// Adds depths without counting levels.
    void add_depth(const float* depth, std::size_t n) {
        for (std::size_t x = 0; x < n; ++x) {
            const bool counts = has_depth(depth[x]);
            meters[x % kLanes] += counts ? static_cast<double>(depth[x]) : 0.0;
            measured += counts;
        }
    }

    /// Completes the counts of columns and levels. Returns the number of measured pixels.
    std::int64_t finish() {
        std::partial_sum(columns.begin(), columns.end(), columns.begin());
        columns.pop_back();
        for (std::size_t level = 0; level + 1 < levels.size() / kLanes; ++level) {
            const auto first = levels.begin() + static_cast<std::ptrdiff_t>(kLanes * level);
            measured += levels[level] = std::accumulate(first, first + kLanes, 0);
        }
        levels.resize(levels.size() / kLanes - 1);
        return measured;
    }
};

template <class Numbers>
void write_shares(const Numbers& counts, std::int64_t total, float* shares) {
    if (total == 0) return;
    for (std::size_t i = 0; i < counts.size(); ++i)
        shares[i] = static_cast<float>(static_cast<double>(counts[i]) / static_cast<double>(total));
}

/// Counts of the columns (or rows) of a box, summed in `bins` equal parts of it: `bins` for each pixel.
std::vector<std::int64_t> rebin(const Counts& counts, int bins) {
    std::vector<std::int64_t> parts(static_cast<std::size_t>(bins));
    const auto part_length = static_cast<std::int64_t>(counts.size());
    std::int64_t place = 0, part_end = part_length, column_end = 0;
    auto part = parts.begin();
    for (const std::int64_t count : counts) {
        for (column_end += bins; part_end < column_end; ++part, part_end += part_length) {
            *part += count * (part_end - place);
            place = part_end;
        }
        *part += count * (column_end - place);
        place = column_end;
    }
    return parts;
}

/// The label image: 1 + the index of each component.
LabelImage label_pixels(const PixelRuns& runs, const Grouping& groups, const DepthView& depth) {
    LabelImage image = LabelImage::Zero(depth.rows, depth.cols);
    for (std::size_t i = 0; i < runs.size(); ++i)
        std::fill_n(image.row(runs[i].row).data() + runs[i].begin, runs[i].length(), groups.component[i] + 1);
    return image;
}

/// Counts all components in a second pass over the runs, in reading order.
std::vector<ComponentCounts> count_components(const PixelRuns& runs, const Grouping& groups,
                                              const DepthView& depth, const HistogramLayout& layout) {
    const double scale = layout.levels / (layout.far - layout.near);
    std::vector<std::int32_t> level(static_cast<std::size_t>(depth.cols));
    std::vector<double> meters(level.size());
    std::vector<ComponentCounts> tallies;
    for (const Component& each : groups.components) tallies.emplace_back(each, layout.levels);
    int row = -1;
    for (std::size_t i = 0; i < runs.size(); ++i) {
        const std::int32_t component = groups.component[i];
        if (component < 0) continue;
        const PixelRun& run = runs[i];
        const auto length = static_cast<std::size_t>(run.length());
        ComponentCounts& tally = tallies[static_cast<std::size_t>(component)];
        tally.add_box(run);
        if (layout.levels == 0) {
            tally.add_depth(depth.row(run.row) + run.begin, length);
            continue;
        }
        if (run.row != row) {
            row = run.row;
            find_levels(depth.row(row), depth.cols, layout.near, scale, layout.levels, level.data(),
                        meters.data());
        }
        tally.add_depth(level.data() + run.begin, meters.data() + run.begin, length);
    }
    return tallies;
}

void require_arguments(const ImageView& labels, const DepthView& depth, const HistogramLayout& layout,
                       int min_area) {
    require_same_shape(labels, depth, "labels");
    require_not_negative(layout.near, "near");
    if (!(layout.far > layout.near && std::isfinite(layout.far)))
        refuse("far", "a finite number above near", layout.far);
    require_count(layout.levels, 0, kMaxBins, "levels");
    require_count(layout.bins, 1, kMaxBins, "bins");
    if (min_area < 1) refuse("min_area", "at least 1", min_area);
}

}  // namespace

DepthComponents describe_components(PixelRuns& runs, const DepthView& depth, const HistogramLayout& layout,
                                    int min_area, bool image) {
    const Grouping groups = group(runs, min_area);
    const auto C = static_cast<Eigen::Index>(groups.components.size());
    DepthComponents result{States(C, 7), Floats::Zero(C, layout.levels), Floats::Zero(C, layout.bins),
                           Floats::Zero(C, layout.bins),
                           image ? label_pixels(runs, groups, depth) : LabelImage()};
    auto tallies = count_components(runs, groups, depth, layout);
    for (Eigen::Index i = 0; i < C; ++i) {
        ComponentCounts& tally = tallies[static_cast<std::size_t>(i)];
        const Component& box = tally.box;
        const std::int64_t measured = tally.finish();
        const double sum = std::accumulate(tally.meters.begin(), tally.meters.end(), 0.0);
        result.table.row(i) << box.x0, box.y0, box.x1 - box.x0, box.y1 - box.y0,
            static_cast<double>(box.area), sum / static_cast<double>(measured), box.label;
        write_shares(tally.levels, measured, result.histograms.row(i).data());
        const std::int64_t total = box.area * layout.bins;
        write_shares(rebin(tally.columns, layout.bins), total, result.columns.row(i).data());
        write_shares(rebin(tally.rows, layout.bins), total, result.rows.row(i).data());
    }
    return result;
}

DepthComponents depth_components(const ImageView& labels, const DepthView& depth,
                                 const HistogramLayout& layout, int min_area, bool image) {
    require_arguments(labels, depth, layout, min_area);
    PixelRuns runs = label_runs(labels, min_area == 1);
    return describe_components(runs, depth, layout, min_area, image);
}

}  // namespace tricue
