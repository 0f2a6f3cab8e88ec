// SPDX-License-Identifier: MIT
#include "cues/depth/depth_components.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numeric>
#include <string>
#include <vector>

#include "base/check.hpp"
#include "base/depth_pixels.hpp"
#include "base/pixel_runs.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

using Counts = std::vector<std::int32_t>;

/// Neighbors in a row are mostly of one level: they count in different tables, so that they don't wait for each other.
constexpr std::size_t kLanes = 4;
constexpr int kMaxSignature = 4096;

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

PixelRuns label_runs(const ImageView& labels) {
    PixelRuns runs(labels.cols);
    for (int row = 0; row < labels.rows; ++row) runs.add_row(labels.row(row));
    return runs;
}

/// Which pixels of a row have a label: bit x % 64 of word x / 64. There is one more word at either end, 0.
class RowBits {
public:
    explicit RowBits(int cols) : cols_(cols), words_(static_cast<std::size_t>((cols + 63) / 64) + 2) {}

    std::size_t size() const { return words_.size() - 2; }
    std::uint64_t operator[](std::size_t i) const { return words_[i + 1]; }

    void read(const std::uint8_t* labels) {
        for (int x = 0; x < cols_; x += 64) words_[static_cast<std::size_t>(x / 64) + 1] = word(labels, x);
    }
    void clear() { std::fill(words_.begin(), words_.end(), 0); }

    /// Bits of word i that have a bit left or right of them.
    std::uint64_t beside(std::size_t i) const {
        return words_[i + 1] << 1 | words_[i] >> 63 | words_[i + 1] >> 1 | words_[i + 2] << 63;
    }

private:
    std::uint64_t word(const std::uint8_t* labels, int first) const {
        std::uint64_t bits = 0;
        for (int i = 0; i < 64 && first + i < cols_; i += 8) {
            std::uint64_t bytes = 0;
            if (first + i + 8 <= cols_)
                std::memcpy(&bytes, labels + first + i, 8);
            else
                std::memcpy(&bytes, labels + first + i, static_cast<std::size_t>(cols_ - first - i));
            if (bytes != 0) bits |= nonzero_bytes(bytes) << i;
        }
        return bits;
    }

    int cols_;
    std::vector<std::uint64_t> words_;
};

/// Adds the runs of pixels [begin, end), all of which have a label. Eight of the same label are skipped at once.
void add_labeled(PixelRuns& runs, const std::uint8_t* labels, int begin, int end) {
    for (int x = begin + 1; x < end;) {
        std::uint64_t other = labels[x] ^ labels[begin];
        int step = 1;
        if (end - x >= 8) {
            std::uint64_t bytes;
            std::memcpy(&bytes, labels + x, 8);
            other = nonzero_bytes(bytes ^ (0x0101010101010101 * labels[begin]));
            step = 8;
        }
        if (other == 0) {
            x += step;
            continue;
        }
        if (step == 8) x += lowest_bit(other);
        runs.add(begin, x, labels[begin]);
        begin = x++;
    }
    runs.add(begin, end, labels[begin]);
}

/// The same without pixels that are alone: noise is mostly that, and each would be a run and a component.
PixelRuns label_joined_runs(const ImageView& labels) {
    PixelRuns runs(labels.cols);
    std::array<RowBits, 3> rows{RowBits(labels.cols), RowBits(labels.cols), RowBits(labels.cols)};  // in turn
    const auto read_row = [&](int y) {
        RowBits& row = rows[static_cast<std::size_t>(y) % 3];
        y < labels.rows ? row.read(labels.row(y)) : row.clear();
    };
    if (labels.rows > 0) read_row(0);
    for (int y = 0; y < labels.rows; ++y) {
        read_row(y + 1);
        const auto at = static_cast<std::size_t>(y);
        const RowBits &above = rows[(at + 2) % 3], &here = rows[at % 3], &below = rows[(at + 1) % 3];
        int begin = -1, end = -1;  // of pixels that follow one another, to which the next word may add
        for (std::size_t i = 0; i < here.size(); ++i) {
            std::uint64_t kept =
                here[i] & (here.beside(i) | above[i] | above.beside(i) | below[i] | below.beside(i));
            const int first = static_cast<int>(i) * 64;
            while (kept != 0) {
                const int from = lowest_bit(kept);
                const std::uint64_t rest = ~(kept >> from);  // 1 where the run has ended
                const int length = rest != 0 ? lowest_bit(rest) : 64;
                if (first + from != end) {
                    if (end > begin) add_labeled(runs, labels.row(y), begin, end);
                    begin = first + from;
                }
                end = first + from + length;
                kept = from + length < 64 ? kept & (~std::uint64_t{0} << (from + length)) : 0;
            }
        }
        if (end > begin) add_labeled(runs, labels.row(y), begin, end);
        runs.end_row();
    }
    return runs;
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

/// All components; sets for every run the index of its component.
std::vector<Component> collect_components(PixelRuns& runs, std::vector<std::int32_t>& component) {
    std::vector<Component> components;
    components.reserve(runs.size());
    component.resize(runs.size());
    for (std::size_t i = 0; i < runs.size(); ++i) {
        const std::size_t first = runs.root(i);
        const PixelRun& run = runs[i];
        if (first == i) {
            component[i] = static_cast<std::int32_t>(components.size());
            components.push_back({run.begin, run.row, run.end, run.row, 0, run.label});
        }
        component[i] = component[first];
        components[static_cast<std::size_t>(component[i])].add(run);
    }
    return components;
}

Grouping group(PixelRuns& runs, int min_area) {
    Grouping groups;
    const auto all = collect_components(runs, groups.component);
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < all.size(); ++i)
        if (all[i].area >= min_area) order.push_back(i);
    std::stable_sort(order.begin(), order.end(),
                     [&all](std::size_t a, std::size_t b) { return all[a].area > all[b].area; });

    std::vector<std::int32_t> component(all.size(), -1);
    for (const std::size_t i : order) {
        component[i] = static_cast<std::int32_t>(groups.components.size());
        groups.components.push_back(all[i]);
    }
    for (auto& each : groups.component) each = component[static_cast<std::size_t>(each)];
    return groups;
}

/// The counts of one component. A run adds 1 to `columns` where it begins and subtracts 1 where it ends; finish() adds them up.
struct ComponentCounts {
    Component box;
    Counts levels, columns, rows;
    std::array<double, kLanes> meters{};
    std::int64_t measured = 0;  ///< pixels; by level only after finish()

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

    /// Completes the counts of columns and levels. Returns how many pixels were measured.
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

void write_shares(const Counts& counts, std::int64_t total, float* shares) {
    if (total == 0) return;
    for (std::size_t i = 0; i < counts.size(); ++i)
        shares[i] = static_cast<float>(static_cast<double>(counts[i]) / static_cast<double>(total));
}

/// Counts of the columns (or rows) of a box, summed in `bins` equal parts of it.
Counts rebin(const Counts& counts, int bins) {
    Counts parts(static_cast<std::size_t>(bins));
    for (std::size_t i = 0; i < counts.size(); ++i)
        parts[(2 * i + 1) * parts.size() / (2 * counts.size())] += counts[i];
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
                                              const DepthView& depth, const Signature& signature) {
    const double scale = signature.levels / (signature.far - signature.near);
    std::vector<std::int32_t> level(static_cast<std::size_t>(depth.cols));
    std::vector<double> meters(level.size());
    std::vector<ComponentCounts> tallies;
    for (const Component& each : groups.components) tallies.emplace_back(each, signature.levels);
    int row = -1;
    for (std::size_t i = 0; i < runs.size(); ++i) {
        const std::int32_t component = groups.component[i];
        if (component < 0) continue;
        const PixelRun& run = runs[i];
        const auto length = static_cast<std::size_t>(run.length());
        ComponentCounts& tally = tallies[static_cast<std::size_t>(component)];
        tally.add_box(run);
        if (signature.levels == 0) {
            tally.add_depth(depth.row(run.row) + run.begin, length);
            continue;
        }
        if (run.row != row) {
            row = run.row;
            find_levels(depth.row(row), depth.cols, signature.near, scale, signature.levels, level.data(),
                        meters.data());
        }
        tally.add_depth(level.data() + run.begin, meters.data() + run.begin, length);
    }
    return tallies;
}

std::string shape(int rows, int cols) {
    return "(" + std::to_string(rows) + ", " + std::to_string(cols) + ")";
}

void require_arguments(const ImageView& labels, const DepthView& depth, const Signature& signature,
                       int min_area) {
    if (labels.rows != depth.rows || labels.cols != depth.cols)
        refuse("labels", "shape " + shape(depth.rows, depth.cols), shape(labels.rows, labels.cols));
    if (!(signature.near >= 0.0 && std::isfinite(signature.near)))
        refuse("near", "a finite number, not negative", signature.near);
    if (!(signature.far > signature.near && std::isfinite(signature.far)))
        refuse("far", "a finite number above near", signature.far);
    require_count(signature.levels, 0, kMaxSignature, "levels");
    require_count(signature.bins, 1, kMaxSignature, "bins");
    if (min_area < 1) refuse("min_area", "at least 1", min_area);
}

}  // namespace

DepthComponents depth_components(const ImageView& labels, const DepthView& depth, const Signature& signature,
                                 int min_area, bool image) {
    require_arguments(labels, depth, signature, min_area);
    PixelRuns runs = min_area > 1 ? label_joined_runs(labels) : label_runs(labels);
    const Grouping groups = group(runs, min_area);
    const auto C = static_cast<Eigen::Index>(groups.components.size());
    DepthComponents result{States(C, 7), Floats::Zero(C, signature.levels), Floats::Zero(C, signature.bins),
                           Floats::Zero(C, signature.bins),
                           image ? label_pixels(runs, groups, depth) : LabelImage()};
    auto tallies = count_components(runs, groups, depth, signature);
    for (Eigen::Index i = 0; i < C; ++i) {
        ComponentCounts& tally = tallies[static_cast<std::size_t>(i)];
        const Component& box = tally.box;
        const std::int64_t measured = tally.finish();
        const double sum = std::accumulate(tally.meters.begin(), tally.meters.end(), 0.0);
        result.table.row(i) << box.x0, box.y0, box.x1 - box.x0, box.y1 - box.y0,
            static_cast<double>(box.area), sum / static_cast<double>(measured), box.label;
        write_shares(tally.levels, measured, result.histograms.row(i).data());
        write_shares(rebin(tally.columns, signature.bins), box.area, result.columns.row(i).data());
        write_shares(rebin(tally.rows, signature.bins), box.area, result.rows.row(i).data());
    }
    return result;
}

}  // namespace tricue
