// SPDX-License-Identifier: MIT
#include "fuse/detail/count_blocks.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include "base/simd.hpp"

namespace tricue {
namespace {

constexpr int kLanes = 4;  // floats in one register, on every machine
using Floats4 = Pack<float, kLanes>;
using Ints4 = Pack<std::int32_t, kLanes>;
using Doubles4 = Pack<double, kLanes>;

constexpr float kMaxFloat = std::numeric_limits<float>::max();
constexpr std::uint32_t kByteOnes = 0x01010101;  // in each byte

/// The pixels of a block.
struct Pixels {
    const float* disparity;
    std::ptrdiff_t disparity_stride;
    const std::uint8_t* mask;
    std::ptrdiff_t mask_stride;
    int rows;
    float expected, tolerance;
};

struct Totals {
    double sum = 0.0;
    std::int64_t readings = 0, targets = 0, similar = 0;
};

/// 0xff in the first bytes of four, 0 in others, for any byte order.
TRICUE_INLINE std::uint32_t first_bytes(int count) {
    std::uint8_t bytes[kLanes] = {};
    std::memset(bytes, 0xff, static_cast<std::size_t>(count));
    std::uint32_t word;
    std::memcpy(&word, bytes, sizeof word);
    return word;
}

/// How many bytes of four aren't 0, without those that are skipped (0xff, else 0).
TRICUE_INLINE std::uint32_t count_set(const std::uint8_t* mask, std::uint32_t skipped_bytes) {
    std::uint32_t bytes;
    std::memcpy(&bytes, mask, sizeof bytes);
    bytes &= ~skipped_bytes;
    const std::uint32_t set = (((bytes & ~(kByteOnes << 7)) + ~(kByteOnes << 7)) | bytes) >> 7 & kByteOnes;
    return set * kByteOnes >> 24;
}

/// Adds four columns side by side, down the rows, without the first `skipped` of them.
TRICUE_INLINE void add_columns(const Pixels& pixels, int x, int skipped, Totals& totals) {
    Doubles4 sums = {};
    Ints4 readings = {}, similar = {};
    std::uint32_t targets = 0;  // not in `totals`, which would be stored at each row
    const Ints4 counted = skipped <= Ints4{0, 1, 2, 3};
    const std::uint32_t skipped_bytes = first_bytes(skipped);
    const float* disparity = pixels.disparity + x;
    const std::uint8_t* mask = pixels.mask + x;
    for (int y = 0; y < pixels.rows; ++y) {
        Floats4 values;
        load(disparity, values);
        const Ints4 finite = (values >= -kMaxFloat) & (values <= kMaxFloat) & counted;
        readings -= finite;
        const Floats4 off = values - pixels.expected;
        similar -= (off < pixels.tolerance) & (off > -pixels.tolerance) & finite;
        Ints4 bits;
        load(&values, bits);
        bits &= finite;
        load(&bits, values);
        Doubles4 wide;
        convert(values, wide);
        sums += wide;
        targets += count_set(mask, skipped_bytes);
        disparity += pixels.disparity_stride;
        mask += pixels.mask_stride;
    }
    totals.sum += sum(sums);
    totals.targets += targets;
    totals.readings += readings[0] + readings[1] + readings[2] + readings[3];
    totals.similar += similar[0] + similar[1] + similar[2] + similar[3];
}

/// Adds columns one by one, if there are fewer than four.
inline void add_column(const Pixels& pixels, int x, Totals& totals) {
    for (int y = 0; y < pixels.rows; ++y) {
        const float value = pixels.disparity[y * pixels.disparity_stride + x];
        const bool finite = std::abs(value) <= kMaxFloat;
        totals.sum += static_cast<double>(finite ? value : 0.0f);
        totals.readings += finite;
        totals.similar += finite && std::abs(value - pixels.expected) < pixels.tolerance;
        totals.targets += pixels.mask[y * pixels.mask_stride + x] != 0;
    }
}

/// The remainder is read as the last four columns, without those already counted.
TRICUE_MULTIVERSION
void add_block(const Pixels& pixels, int cols, Totals& totals) {
    int x = 0;
    for (; x + kLanes <= cols; x += kLanes) add_columns(pixels, x, 0, totals);
    if (x < cols && cols >= kLanes)
        add_columns(pixels, cols - kLanes, kLanes - (cols - x), totals);
    else
        for (; x < cols; ++x) add_column(pixels, x, totals);
}

}  // namespace

BlockCounts count_blocks(const ImageView& mask, const PlaneView& disparity, const std::vector<Region>& blocks,
                         float expected, float tolerance) {
    const auto count = static_cast<Eigen::Index>(blocks.size());
    BlockCounts counts{Indices(count), Indices(count), Indices(count), Vector(count), Indices(count)};
    for (Eigen::Index i = 0; i < count; ++i) {
        const Region& part = blocks[static_cast<std::size_t>(i)];
        const int rows = part.y1 - part.y0, cols = part.x1 - part.x0;
        Totals totals;
        if (rows > 0 && cols > 0)
            add_block({disparity.row(part.y0) + part.x0, disparity.stride, mask.row(part.y0) + part.x0,
                       mask.stride, rows, expected, tolerance},
                      cols, totals);
        const auto readings = static_cast<double>(totals.readings);
        counts.pixels[i] = std::int64_t{rows} * cols;
        counts.targets[i] = totals.targets;
        counts.readings[i] = totals.readings;
        counts.similar[i] = totals.similar;
        counts.mean[i] = readings > 0.0 ? totals.sum / readings : std::numeric_limits<double>::quiet_NaN();
    }
    return counts;
}

}  // namespace tricue
