// SPDX-License-Identifier: MIT
#include "fuse/detail/count_blocks.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include "base/simd.hpp"

namespace tricue {
namespace {

constexpr int kLanes = 4;  // floats in one register, on every machine
constexpr int kColumns = 2 * kLanes;
using Floats4 = Pack<float, kLanes>;
using Ints4 = Pack<std::int32_t, kLanes>;
using Doubles4 = Pack<double, kLanes>;

constexpr float kMaxFloat = std::numeric_limits<float>::max();
constexpr std::uint64_t kByteOnes = 0x0101010101010101;  // in each byte

/// The rows of a block, from the image's first column on.
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
    std::int64_t measured = 0, targets = 0, similar = 0;
};

/// Sums down four columns.
struct ColumnSums {
    Doubles4 sum = {};
    Ints4 measured = {}, similar = {};
};

TRICUE_INLINE void add_four(const float* disparity, const Pixels& pixels, const Ints4& counted,
                            ColumnSums& sums) {
    Floats4 values;
    load(disparity, values);
    const Ints4 finite = (values >= -kMaxFloat) & (values <= kMaxFloat) & counted;
    sums.measured -= finite;
    const Floats4 off = values - pixels.expected;
    sums.similar -= (off <= pixels.tolerance) & (off >= -pixels.tolerance) & finite;
    Ints4 bits;
    load(&values, bits);
    bits &= finite;
    load(&bits, values);
    Doubles4 wide;
    convert(values, wide);
    sums.sum += wide;
}

TRICUE_INLINE std::int64_t sum_of(const Ints4& counts) {
    return counts[0] + counts[1] + counts[2] + counts[3];
}

/// Adds eight columns side by side, down the rows, of which those from `begin` to before `end` are counted.
TRICUE_INLINE void add_columns(const Pixels& pixels, int x, int begin, int end, Totals& totals) {
    constexpr Ints4 kLeft = {0, 1, 2, 3}, kRight = {4, 5, 6, 7};
    const Ints4 left_counted = (kLeft >= begin) & (kLeft < end),
                right_counted = (kRight >= begin) & (kRight < end);
    std::uint8_t counted[kColumns] = {};
    std::memset(counted + begin, 1, static_cast<std::size_t>(end - begin));
    std::uint64_t counted_ones;
    std::memcpy(&counted_ones, counted, sizeof counted_ones);
    ColumnSums left, right;
    std::uint64_t targets = 0;  // not in `totals`, which would be stored at each row
    const float* disparity = pixels.disparity + x;
    const std::uint8_t* mask = pixels.mask + x;
    for (int y = 0; y < pixels.rows; ++y) {
        add_four(disparity, pixels, left_counted, left);
        add_four(disparity + kLanes, pixels, right_counted, right);
        std::uint64_t bytes;
        std::memcpy(&bytes, mask, sizeof bytes);
        const std::uint64_t low = ~(kByteOnes << 7),
                            set = (((bytes & low) + low) | bytes) >> 7 & counted_ones;
        targets += set * kByteOnes >> 56;
        disparity += pixels.disparity_stride;
        mask += pixels.mask_stride;
    }
    totals.sum += sum(left.sum) + sum(right.sum);
    totals.targets += static_cast<std::int64_t>(targets);
    totals.measured += sum_of(left.measured) + sum_of(right.measured);
    totals.similar += sum_of(left.similar) + sum_of(right.similar);
}

/// Adds a column, if the image has fewer than eight.
inline void add_column(const Pixels& pixels, int x, Totals& totals) {
    for (int y = 0; y < pixels.rows; ++y) {
        const float value = pixels.disparity[y * pixels.disparity_stride + x];
        const bool finite = std::abs(value) <= kMaxFloat;
        totals.sum += static_cast<double>(finite ? value : 0.0f);
        totals.measured += finite;
        totals.similar += finite && std::abs(value - pixels.expected) <= pixels.tolerance;
        totals.targets += pixels.mask[y * pixels.mask_stride + x] != 0;
    }
}

/// Columns [x0, x1) of an image of `cols`; eight of them may begin to the left of those that are counted.
TRICUE_MULTIVERSION
void add_block(const Pixels& pixels, int x0, int x1, int cols, Totals& totals) {
    if (cols < kColumns)
        for (int x = x0; x < x1; ++x) add_column(pixels, x, totals);
    else
        for (int x = x0; x < x1; x += kColumns) {
            const int first = std::min(x, cols - kColumns);
            add_columns(pixels, first, x - first, std::min(x1 - first, kColumns), totals);
        }
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
            add_block({disparity.row(part.y0), disparity.stride, mask.row(part.y0), mask.stride, rows,
                       expected, tolerance},
                      part.x0, part.x1, disparity.cols, totals);
        const auto measured = static_cast<double>(totals.measured);
        counts.pixels[i] = std::int64_t{rows} * cols;
        counts.targets[i] = totals.targets;
        counts.measured[i] = totals.measured;
        counts.similar[i] = totals.similar;
        counts.mean[i] = measured > 0.0 ? totals.sum / measured : std::numeric_limits<double>::quiet_NaN();
    }
    return counts;
}

}  // namespace tricue
