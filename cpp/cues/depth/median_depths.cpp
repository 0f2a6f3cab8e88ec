// SPDX-License-Identifier: MIT
#include "cues/depth/median_depths.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/check.hpp"
#include "base/simd.hpp"
#include "cues/depth/detail/sample_pixels.hpp"

namespace tricue {
namespace {

constexpr float kNear = 0.001F, kFar = 1000.0F;  // meters
constexpr double kMadToSigma = 1.4826;
constexpr int kMaxSamples = 1024;
constexpr int kBins = 512;  // between the smallest and the largest number, in the search for the median
constexpr float kLast = kBins - 1;
// Neighbors mostly share a bin, and reading a count that was just written is slow, so they are counted in different tables.
constexpr std::size_t kTables = 4;

using Numbers = std::vector<float>;

/// The measured depths of a box, and the number of its samples; reused for the next box.
struct Samples {
    Numbers depths, chosen, deviations;
    std::size_t count = 0;
};

TRICUE_MULTIVERSION
void find_bins(const float* __restrict numbers, std::size_t n, float low, float per_bin,
               std::uint16_t* __restrict bins) {
    for (std::size_t i = 0; i < n; ++i) {
        const float bin = (numbers[i] - low) * per_bin;
        bins[i] = static_cast<std::uint16_t>(static_cast<int>(bin < kLast ? bin : kLast));
    }
}

std::array<std::uint32_t, kBins> count_bins(const std::vector<std::uint16_t>& bins) {
    std::array<std::array<std::uint32_t, kBins>, kTables> tables{};
    const std::size_t whole = bins.size() / kTables * kTables;
    for (std::size_t i = 0; i < whole; i += kTables)
        for (std::size_t t = 0; t < kTables; ++t) ++tables[t][bins[i + t]];
    for (std::size_t i = whole; i < bins.size(); ++i) ++tables[0][bins[i]];
    std::array<std::uint32_t, kBins> counts{};
    for (const auto& table : tables)
        for (std::size_t bin = 0; bin < kBins; ++bin) counts[bin] += table[bin];
    return counts;
}

/// The median of numbers that aren't below `low`, and mostly not above `high`; of an even count, the mean of the middle two.
///
/// Numbers are first distributed over bins between low and high, so that only those in the middle's bin have to be sorted.
float find_median(const Numbers& numbers, float low, float high) {
    const std::size_t n = numbers.size(), first = (n - 1) / 2, second = n / 2;
    const float per_bin = static_cast<float>(kBins) / (high - low);
    std::vector<std::uint16_t> bins(n);
    find_bins(numbers.data(), n, low, per_bin > 0.0F && std::isfinite(per_bin) ? per_bin : 0.0F, bins.data());
    const std::array<std::uint32_t, kBins> counts = count_bins(bins);
    std::size_t from = 0, before = 0;
    while (before + counts[from] <= first) before += counts[from++];
    std::size_t to = from, end = before + counts[from];
    while (end <= second) end += counts[++to];
    Numbers middle(end - before +
                   1);  // without a branch: the next number overwrites one that isn't in the middle
    std::size_t count = 0;
    for (std::size_t i = 0; i < n; ++i) {
        middle[count] = numbers[i];
        count += static_cast<std::size_t>((bins[i] >= from) & (bins[i] <= to));
    }
    middle.pop_back();
    const auto at = middle.begin() + static_cast<std::ptrdiff_t>(first - before);
    std::nth_element(middle.begin(), at, middle.end());
    return first == second ? *at : (*at + *std::min_element(at + 1, middle.end())) / 2;
}

float find_center(const Numbers& depths) {
    const auto [low, high] = std::minmax_element(depths.begin(), depths.end());
    return find_median(depths, *low, *high);
}

bool is_measured(float z) {
    return (z > kNear) & (z < kFar);
}

/// Squared offset of each sample from the center, in halves of a box's side.
std::vector<double> square_offsets(int samples, double square, double side) {
    std::vector<double> squared(static_cast<std::size_t>(samples));
    for (int i = 0; i < samples; ++i) {
        const double offset = std::abs((i + 0.5) / samples - 0.5) * 2 * square / side;
        squared[static_cast<std::size_t>(i)] = offset * offset;
    }
    return squared;
}

/// Reads the measured depths of a box, in its ellipse or in the whole square around it.
void read_samples(const DepthView& depth, const double* box, int samples, bool in_ellipse, Samples& read) {
    const double x = box[0], y = box[1], width = box[2], height = box[3];
    const double square = std::max(width, height), step = square / samples;
    const SamplePixels across = find_sample_pixels(x - square / 2, step, samples, depth.cols),
                       down = find_sample_pixels(y - square / 2, step, samples, depth.rows);
    const auto columns = square_offsets(samples, square, width),
               rows = square_offsets(samples, square, height);
    const double limit = in_ellipse ? 1.0 : std::numeric_limits<double>::infinity();
    read.depths.resize(across.pixels.size() * down.pixels.size());
    std::size_t measured = 0;
    for (std::size_t i = 0; i < kPrefetchSamples; ++i) prefetch_samples(depth, across, down, i);
    for (std::size_t i = 0; i < down.pixels.size(); ++i) {
        prefetch_samples(depth, across, down, i + kPrefetchSamples);
        const float* row = depth.row(down.pixels[i]);
        for (std::size_t j = 0; j < across.pixels.size(); ++j) {
            const float z = row[across.pixels[j]];
            read.depths[measured] = z;
            const bool inside = rows[down.first + i] + columns[across.first + j] <= limit;
            measured += static_cast<std::size_t>(inside & is_measured(z));
        }
    }
    read.depths.resize(measured);
    read.count = measured;
    if (!in_ellipse) return;
    read.count = 0;
    for (const double row : rows)
        for (const double column : columns) read.count += static_cast<std::size_t>(row + column <= limit);
}

void measure_box(const DepthView& depth, const double* box, int samples, const DepthGate& gate, Samples& read,
                 double* measured) {
    const bool known = !std::isnan(gate.expected);
    std::fill_n(measured, 3, std::numeric_limits<double>::quiet_NaN());
    read_samples(depth, box, samples, known, read);
    if (read.depths.empty()) return;
    const float center = known ? static_cast<float>(gate.expected) : find_center(read.depths);
    const auto most = static_cast<float>(gate.max_offset);
    read.chosen.resize(read.depths.size());
    std::size_t chosen = 0;
    for (const float z : read.depths) {
        read.chosen[chosen] = z;
        chosen += static_cast<std::size_t>(std::abs(z - center) < most);
    }
    read.chosen.resize(chosen);
    const auto count = static_cast<double>(chosen), all = static_cast<double>(read.count);
    if (chosen == 0 || count < gate.min_share * all) return;
    const float z = find_median(read.chosen, std::max(kNear, center - most), std::min(kFar, center + most));
    read.deviations.resize(chosen);
    for (std::size_t i = 0; i < chosen; ++i) read.deviations[i] = std::abs(read.chosen[i] - z);
    measured[0] = z;
    measured[1] = kMadToSigma * find_median(read.deviations, 0.0F, std::min(kFar, most));
    measured[2] = count / all;
}

void require_arguments(StatesRef boxes, int samples, const DepthGate& gate) {
    require_shape(boxes, boxes.rows(), 4, "boxes");
    require_finite(boxes, "boxes");
    for (Eigen::Index i = 0; i < boxes.rows(); ++i)
        for (const double size : {boxes(i, 2), boxes(i, 3)})
            if (!(size > 0.0)) refuse("boxes", "widths and heights above 0", size);
    if (samples < 1 || samples > kMaxSamples) refuse("samples", "1 to 1024", samples);
    if (std::isinf(gate.expected)) refuse("expected", "a finite number or NaN", gate.expected);
    require_positive(gate.max_offset, "max_offset");
    if (!(gate.min_share >= 0.0 && gate.min_share <= 1.0)) refuse("min_share", "0 to 1", gate.min_share);
}

}  // namespace

States median_depths(const DepthView& depth, StatesRef boxes, int samples, const DepthGate& gate) {
    require_arguments(boxes, samples, gate);
    States measured(boxes.rows(), 3);
    Samples read;
    for (Eigen::Index i = 0; i < boxes.rows(); ++i)
        measure_box(depth, boxes.row(i).data(), samples, gate, read, measured.row(i).data());
    return measured;
}

}  // namespace tricue
