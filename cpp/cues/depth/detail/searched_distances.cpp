// SPDX-License-Identifier: MIT
#include "cues/depth/detail/searched_distances.hpp"

#include <algorithm>
#include <array>
#include <cstring>

#include "base/depth_pixels.hpp"
#include "base/overlapping_blocks.hpp"
#include "base/simd.hpp"
#include "cues/depth/depth_components.hpp"
#include "cues/depth/detail/depth_rows.hpp"

namespace tricue {
namespace {

constexpr int kBlock = 64;  ///< pixels, so that loops over them have no remainder
/// At most an eighth of an image's pixels are searched with a camera that doesn't move.
constexpr int kUsualShare = 8;

/// A row is listed if at most a fourth of it is searched.
constexpr int kListedShare = 4;

/// Neighbors mostly share a level, and reading a count just written is slow, so they count in different tables.
constexpr std::size_t kTables = 4;

/// A histogram's levels, as depth_histogram finds them.
struct LevelScale {
    float least, end, near, scale, top;
    std::int32_t none;

    explicit LevelScale(const DepthLevels& levels)
        : least(round_up_to_float(levels.near)),
          end(round_up_to_float(levels.far)),
          near(static_cast<float>(levels.near)),
          scale(static_cast<float>(levels.count / (levels.far - levels.near))),
          top(static_cast<float>(levels.count - 1)),
          none(levels.count) {}
};

/// The levels of a block, `none` for pixels that don't count.
TRICUE_MULTIVERSION
void find_levels(const float* __restrict distance, const LevelScale& levels, std::int32_t* __restrict level) {
    const float least = levels.least, end = levels.end, near = levels.near, scale = levels.scale,
                top = levels.top;
    const std::int32_t none = levels.none;
    for (int x = 0; x < kBlock; ++x) {
        const float z = distance[x], place = (z - near) * scale;
        const bool counts = (z >= least) & (z < end);
        const float within = counts & (place < top) ? place : top;
        level[x] = counts ? static_cast<std::int32_t>(within) : none;
    }
}

/// The labels of a block, 0 beyond the dividers. These ascend, so a distance gets the label of the last one it has reached.
TRICUE_MULTIVERSION
void divide(const float* __restrict distance, const float* __restrict dividers, int divisions,
            std::uint8_t* __restrict labels) {
    const float end = dividers[divisions];
    for (int x = 0; x < kBlock; ++x) labels[x] = 0;
    for (int k = 0; k < divisions; ++k) {
        const float least = dividers[k];
        const auto label = static_cast<std::uint8_t>(k + 1);
        for (int x = 0; x < kBlock; ++x) labels[x] = distance[x] >= least ? label : labels[x];
    }
    for (int x = 0; x < kBlock; ++x) labels[x] = distance[x] < end ? labels[x] : std::uint8_t{0};
}

TRICUE_MULTIVERSION
int count_pixels(const BitImage& mask, int y) {
    int count = 0;
    for (int i = 0; i < mask.words(); ++i) count += count_bits(mask.word(y, i));
    return count;
}

/// Lists the columns of a row's set pixels, and their distances.
TRICUE_MULTIVERSION
void list_pixels(const BitImage& mask, int y, const float* distance, std::int32_t* columns, float* to) {
    std::int32_t* end = columns;
    for (int i = 0; i < mask.words(); ++i) end = list_bits<8>(mask.word(y, i), std::int32_t{i * kBlock}, end);
    for (; columns != end; ++columns, ++to) *to = distance[*columns];
}

/// The distances of a whole row, infinite where its mask is 0.
TRICUE_MULTIVERSION
void mask_distances(const float* __restrict distance, const std::uint8_t* __restrict mask, int n,
                    float* __restrict to) {
    for_overlapping_blocks(n, [=](std::ptrdiff_t x) { to[x] = mask[x] ? distance[x] : kUnmeasured; });
}

/// Like mark_changes, for listed pixels: whether the left neighbor is also listed and has another label.
TRICUE_MULTIVERSION
bool mark_listed_changes(const std::uint8_t* __restrict labels, const std::int32_t* __restrict columns, int n,
                         std::uint8_t* __restrict changes) {
    std::uint8_t any = 0;
    for (int i = 1; i < n; ++i)
        any |= changes[i] = (labels[i] != labels[i - 1]) & (columns[i] == columns[i - 1] + 1);
    return any != 0;
}

/// Memory grows as needed, with an additional block; memory for a whole image would be requested from the system in every frame.
template <typename Numbers>
void make_room(std::ptrdiff_t pixels, Numbers& numbers) {
    if (pixels + kBlock > numbers.size())
        numbers.conservativeResize(std::max(pixels + kBlock, 2 * numbers.size()));
}

}  // namespace

SearchedDistances::SearchedDistances(int rows, int cols)
    : rows_(rows), cols_(cols), bits_(rows, cols), counts_(static_cast<std::size_t>(rows)) {
    const std::ptrdiff_t usual = rows * std::ptrdiff_t{cols} / kUsualShare;
    make_room(usual, columns_);
    make_room(usual, distances_);
}

void SearchedDistances::add_row(int y, const float* distance, const std::uint8_t* mask) {
    bits_.read(y, mask);
    int count = count_pixels(bits_, y);
    make_room(size_ + cols_, distances_);
    float* to = distances_.data() + size_;
    if (count > cols_ / kListedShare) {
        mask_distances(distance, mask, count = cols_, to);
    } else {
        make_room(listed_ + count, columns_);
        list_pixels(bits_, y, distance, columns_.data() + listed_, to);
        listed_ += count;
    }
    counts_[static_cast<std::size_t>(y)] = count;
    size_ += count;
}

Vector SearchedDistances::histogram(const DepthLevels& levels) {
    const LevelScale scale(levels);
    const auto bins = static_cast<std::size_t>(levels.count) + 1;
    std::vector<std::int32_t> counts(kTables * bins);
    std::array<std::int32_t, kBlock> level;
    fill_last_block();
    for (std::ptrdiff_t first = 0; first < size_; first += kBlock) {
        find_levels(distances_.data() + first, scale, level.data());
        for (std::size_t i = 0; i < kBlock; ++i)
            ++counts[(i % kTables) * bins + static_cast<std::size_t>(level[i])];
    }
    Vector histogram = Vector::Zero(levels.count);
    for (std::size_t t = 0; t < kTables; ++t)
        for (Eigen::Index i = 0; i < histogram.size(); ++i)
            histogram[i] += static_cast<double>(counts[t * bins + static_cast<std::size_t>(i)]);
    return histogram;
}

PixelRuns SearchedDistances::runs(VectorRef dividers, bool single) {
    std::vector<float> limits;
    for (const double s : dividers) limits.push_back(round_up_to_float(s));
    const auto label = [&limits](const float* distances, int count, std::uint8_t* labels) {
        for (int first = 0; first < count; first += kBlock)
            divide(distances + first, limits.data(), static_cast<int>(limits.size()) - 1, labels + first);
    };
    const std::size_t pixels = static_cast<std::size_t>(rows_) * static_cast<std::size_t>(cols_);
    std::vector<std::uint8_t> image(pixels + kBlock), changed(static_cast<std::size_t>(cols_) + kBlock),
        few(changed.size());
    BitImage changes(rows_, cols_);
    fill_last_block();
    const float* distances = distances_.data();
    const std::int32_t* columns = columns_.data();
    for (int y = 0; y < rows_; ++y) {
        const int count = counts_[static_cast<std::size_t>(y)];
        if (count == 0) continue;
        std::uint8_t* row = image.data() + y * std::ptrdiff_t{cols_};
        if (count == cols_) {
            label(distances, count, row);
            bits_.read(y, row);
            if (mark_changes(row, cols_, changed.data())) changes.read(y, changed.data());
        } else {
            label(distances, count, few.data());
            add_labels(y, few.data(), columns, count, row);
            if (mark_listed_changes(few.data(), columns, count, changed.data()))
                for (int i = 0; i < count; ++i)
                    if (changed[static_cast<std::size_t>(i)]) changes.set(y, columns[i]);
            columns += count;
        }
        distances += count;
    }
    return label_runs(bits_, changes, {image.data(), rows_, cols_, 1, cols_}, single);
}

void SearchedDistances::add_labels(int y, const std::uint8_t* labels, const std::int32_t* columns, int count,
                                   std::uint8_t* row) {
    const bool all = std::memchr(labels, 0, std::size_t{static_cast<unsigned>(count)}) == nullptr;
    if (!all) std::fill_n(row, cols_, std::uint8_t{0});
    for (int i = 0; i < count; ++i) row[columns[i]] = labels[i];
    if (!all) bits_.read(y, row);
}

void SearchedDistances::fill_last_block() {
    distances_.segment(size_, kBlock) = kUnmeasured;
}

}  // namespace tricue
