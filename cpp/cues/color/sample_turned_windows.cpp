// SPDX-License-Identifier: MIT
#include "cues/color/sample_turned_windows.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "base/check.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

constexpr int kSubpixels = 16;   // places are rounded to 1 / kSubpixels of a pixel
constexpr int kMaxSide = 4;      // pixels, of the square that a sample is the mean of
constexpr int kChunk = 64;       // samples whose places are found at once
constexpr int kLinePixels = 21;  // whole pixels in a cache line
constexpr int kRowsAhead = 3;    // rows of samples whose pixels are loaded ahead
constexpr int kLanes = 8;        // numbers of two neighboring pixels, and two unused ones

using Bytes = Pack<std::uint8_t, 2 * kLanes>;
using Words = Pack<std::uint16_t, kLanes>;
using Sums = Pack<std::uint32_t, kLanes / 2>;

/// The places of some samples in a row: the top left pixels of their squares, and the offsets from these in subpixels.
struct Places {
    std::int32_t x[kChunk], y[kChunk], right[kChunk], down[kChunk];
};

/// One coordinate of n squares in an image of `size` pixels: at most that of the pixel `side` before the last, so that the
/// square's last pixel has a next one.
TRICUE_MULTIVERSION
void find_places(double start, double apart, double offset, int n, int size, int side,
                 std::int32_t* __restrict pixels, std::int32_t* __restrict fractions) {
    const double most = size - side;
    const std::int32_t last = size - side - 1;
    for (int i = 0; i < n; ++i) {
        const double place = start + (i + offset) * apart;
        const double positive = place > 0.0 ? place : 0.0, inside = positive < most ? positive : most;
        const auto fixed = static_cast<std::int32_t>(inside * kSubpixels + 0.5);
        const std::int32_t pixel = fixed / kSubpixels < last ? fixed / kSubpixels : last;
        pixels[i] = pixel;
        fractions[i] = fixed - pixel * kSubpixels;
    }
}

/// The pixels that a square covers, from the top left one on, kSide + 1 per row.
struct Square {
    const std::uint8_t* pixels;
    std::ptrdiff_t stride;
};

/// Pairs of pixels in a row of a square.
template <int kSide>
constexpr int kPairs = kSide / 2 + 1;

/// Bytes of a row that are read.
template <int kSide>
constexpr int kRowBytes = 6 * (kPairs<kSide> - 1) + kLanes;

/// The numbers of a row of a square, pair by pair.
template <int kSide>
struct Row {
    Words pairs[kPairs<kSide>];
};

template <int kSide>
TRICUE_INLINE void load_row(const std::uint8_t* pixels, Row<kSide>& row) {
    for (Words& pair : row.pairs) {
        std::uint64_t numbers;
        std::memcpy(&numbers, pixels, kLanes);
        const Pack<std::uint64_t, 2> wide = {numbers, 0};
        Bytes bytes, lower, upper;
        load(&wide, bytes);
        interleave(bytes, Bytes{}, lower, upper);  // each byte with a 0 is a word
        load(&lower, pair);
        pixels += 6;
    }
}

/// Sums of kSide + 1 rows; the first and the last are weighted by the part that the square covers.
template <int kSide>
TRICUE_INLINE void sum_rows(const Square& square, std::int32_t down, Row<kSide>& sum) {
    Row<kSide> first, row, last;
    load_row<kSide>(square.pixels, first);
    load_row<kSide>(square.pixels + kSide * square.stride, last);
    const auto share = static_cast<std::uint16_t>(down), rest = static_cast<std::uint16_t>(kSubpixels - down);
    for (int pair = 0; pair < kPairs<kSide>; ++pair)
        sum.pairs[pair] = first.pairs[pair] * rest + last.pairs[pair] * share;
    for (int y = 1; y < kSide; ++y) {
        load_row<kSide>(square.pixels + y * square.stride, row);
        for (int pair = 0; pair < kPairs<kSide>; ++pair)
            sum.pairs[pair] += row.pairs[pair] * static_cast<std::uint16_t>(kSubpixels);
    }
}

/// Three numbers of a pixel, and an unused one.
template <int kSide, int kPixel>
TRICUE_INLINE void take_pixel(const Row<kSide>& row, Sums& numbers) {
    Words words = row.pairs[kPixel / 2], lower, upper;
    if constexpr (kPixel % 2 == 1) permute<3, 4, 5, 3, 3, 3, 3, 3>(row.pairs[kPixel / 2], words);
    interleave(words, Words{}, lower, upper);
    load(&lower, numbers);
}

/// The sum of kSide + 1 columns, as of rows.
template <int kSide>
TRICUE_INLINE void sum_columns(const Row<kSide>& row, std::int32_t right, Sums& sum) {
    const auto share = static_cast<std::uint32_t>(right),
               rest = static_cast<std::uint32_t>(kSubpixels) - share;
    Sums first, last, inner = {};
    take_pixel<kSide, 0>(row, first);
    take_pixel<kSide, kSide>(row, last);
    if constexpr (kSide > 1) take_pixel<kSide, 1>(row, inner);
    if constexpr (kSide > 2) {
        Sums next;
        take_pixel<kSide, 2>(row, next);
        inner += next;
    }
    if constexpr (kSide > 3) {
        Sums next;
        take_pixel<kSide, 3>(row, next);
        inner += next;
    }
    sum = first * rest + last * share + inner * static_cast<std::uint32_t>(kSubpixels);
}

/// A copy of a square at the end of the image's memory, so that no bytes beyond it are read.
template <int kSide>
Square copy_square(const std::uint8_t* pixels, std::ptrdiff_t stride, std::uint8_t* copy) {
    for (int y = 0; y <= kSide; ++y)
        std::memcpy(copy + y * kRowBytes<kSide>, pixels + y * stride, 3 * (kSide + 1));
    return {copy, kRowBytes<kSide>};
}

/// Sums over the squares of n samples. `sums` has room for 3 numbers per sample and one more.
template <int kSide>
TRICUE_INLINE void sum_squares(const ImageView& image, const Places& places, int n, std::uint32_t* sums) {
    std::uint8_t copy[(kSide + 1) * kRowBytes<kSide>] = {};
    const std::uint8_t* first = image.data;
    const std::ptrdiff_t stride = image.stride,
                         size = (image.rows - 1) * stride + 3 * std::ptrdiff_t{image.cols};
    const std::ptrdiff_t most = size - kSide * stride - kRowBytes<kSide>;
    for (int i = 0; i < n; ++i, sums += 3) {
        const std::ptrdiff_t at = places.y[i] * stride + 3 * std::ptrdiff_t{places.x[i]};
        Square square = {first + at, stride};
        if (at > most) square = copy_square<kSide>(first + at, stride, copy);
        Row<kSide> row;
        Sums sum;
        sum_rows<kSide>(square, places.down[i], row);
        sum_columns<kSide>(row, places.right[i], sum);
        store(sum, sums);
    }
}

TRICUE_MULTIVERSION
void sum_samples(const ImageView& image, const Places& places, int n, int side, std::uint32_t* sums) {
    if (side == 1)
        sum_squares<1>(image, places, n, sums);
    else if (side == 2)
        sum_squares<2>(image, places, n, sums);
    else if (side == 3)
        sum_squares<3>(image, places, n, sums);
    else
        sum_squares<kMaxSide>(image, places, n, sums);
}

/// A quotient is exactly a half or at least 1 / (2 whole) away from it, which is more than both rounding errors.
TRICUE_MULTIVERSION
void divide(const std::uint32_t* __restrict sums, float whole, int n, std::uint8_t* __restrict bytes) {
    for (int x = 0; x < n; ++x) {
        const auto sum = static_cast<float>(static_cast<std::int32_t>(sums[x]));
        bytes[x] = static_cast<std::uint8_t>(static_cast<int>(sum / whole + 0.5F));
    }
}

/// The step between n samples along a vector.
double find_step(double x, double y, int n) {
    return std::sqrt(x * x + y * y) / n;
}

/// The side of the squares in pixels; squares one pixel larger are still in the image.
int find_side(const ImageView& image, const double* window, int rows, int columns) {
    const double step =
        std::min(find_step(window[2], window[3], columns), find_step(window[4], window[5], rows));
    const int side = static_cast<int>(std::min(std::max(step + 0.5, 1.0), double{kMaxSide}));
    return std::min({side, image.rows - 1, image.cols - 1});
}

/// A window's samples: the top left corner of the square at the window's center, and the steps from one sample to the next in a
/// row and in a column, pixels.
struct TurnedGrid {
    int rows, columns, side;
    double left, top, right_x, right_y, down_x, down_y;

    double below(int y) const { return y + 0.5 - 0.5 * rows; }
    double beside(int x) const { return x + 0.5 - 0.5 * columns; }
};

TurnedGrid find_grid(const ImageView& image, const double* window, int rows, int columns) {
    const int side = find_side(image, window, rows, columns);
    return {rows,
            columns,
            side,
            window[0] - 0.5 * side,
            window[1] - 0.5 * side,
            window[2] / columns,
            window[3] / columns,
            window[4] / rows,
            window[5] / rows};
}

/// Begins to load the pixels that a row of samples, if it exists, reads and the previous rows didn't: a turned row's pixels are
/// in so many cache lines that the hardware doesn't prefetch them. Some neighboring samples share a cache line in each row of
/// pixels; the new lines are the lowest ones, or the uppermost if the rows of samples go up. Few windows are turned by more than
/// 45 degrees: for these nothing is loaded ahead.
void prefetch_row(const ImageView& image, const TurnedGrid& grid, int y) {
    if (y >= grid.rows || std::abs(grid.right_x) <= std::abs(grid.right_y)) return;
    const int samples = std::max(static_cast<int>(kLinePixels / std::max(std::abs(grid.right_x), 1.0)), 1);
    const double slant = (samples - 1) * grid.right_y, height = grid.side + 1 + std::abs(slant);
    const double advance = std::abs(grid.down_y - grid.down_x * grid.right_y / grid.right_x);
    const double rows = std::ceil(std::min(advance, height));
    const double first =
        grid.down_y > 0.0 ? std::max(slant, 0.0) + grid.side + 1 - rows : std::min(slant, 0.0);
    const double last_column = image.cols - 1.0, last_row = image.rows - 1.0;
    for (int x = 0; x < grid.columns; x += samples) {
        const double right = grid.left + grid.below(y) * grid.down_x + grid.beside(x) * grid.right_x;
        const double down = grid.top + grid.below(y) * grid.down_y + grid.beside(x) * grid.right_y + first;
        const std::ptrdiff_t at =
            3 * static_cast<std::ptrdiff_t>(std::min(std::max(0.0, right), last_column));
        const int begin = static_cast<int>(std::min(std::max(0.0, down), last_row));
        const int end = static_cast<int>(std::min(std::max(0.0, down + rows), last_row));
        for (int row = begin; row <= end; ++row) prefetch(image.row(row) + at);
    }
}

void sample_window(const ImageView& image, const double* window, int rows, int columns, std::uint8_t* bytes) {
    const TurnedGrid grid = find_grid(image, window, rows, columns);
    const auto whole = static_cast<float>(grid.side * grid.side * kSubpixels * kSubpixels);
    Places places;
    std::uint32_t sums[3 * kChunk + 1];
    for (int y = 0; y < rows; ++y) {
        prefetch_row(image, grid, y + kRowsAhead);
        const double x0 = grid.left + grid.below(y) * grid.down_x,
                     y0 = grid.top + grid.below(y) * grid.down_y;
        for (int x = 0; x < columns; x += kChunk) {
            const int n = std::min(columns - x, kChunk);
            find_places(x0, grid.right_x, grid.beside(x), n, image.cols, grid.side, places.x, places.right);
            find_places(y0, grid.right_y, grid.beside(x), n, image.rows, grid.side, places.y, places.down);
            sum_samples(image, places, n, grid.side, sums);
            divide(sums, whole, 3 * n, bytes);
            bytes += 3 * std::ptrdiff_t{n};
        }
    }
}

/// The pixels of an image whose only row or column is repeated.
std::vector<std::uint8_t> repeat_edge(const ImageView& image, int rows, int cols) {
    std::vector<std::uint8_t> pixels;
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < cols; ++x) {
            const std::uint8_t* pixel =
                image.row(std::min(y, image.rows - 1)) + 3 * std::ptrdiff_t{std::min(x, image.cols - 1)};
            pixels.insert(pixels.end(), pixel, pixel + 3);
        }
    return pixels;
}

void require_arguments(const ImageView& image, StatesRef windows, int rows, int columns) {
    if (image.rows < 1 || image.cols < 1) refuse("image", "at least one pixel", "none");
    require_shape(windows, windows.rows(), 6, "windows");
    require_finite(windows, "windows");
    for (Eigen::Index i = 0; i < windows.rows(); ++i)
        for (const int side : {2, 4})
            if (windows(i, side) == 0.0 && windows(i, side + 1) == 0.0)
                refuse("windows", "sides that aren't 0", 0.0);
    require_count(rows, 1, kMaxImageSide, "rows");
    require_count(columns, 1, kMaxImageSide, "columns");
}

}  // namespace

WindowBytes sample_turned_windows(const ImageView& image, StatesRef windows, int rows, int columns) {
    require_arguments(image, windows, rows, columns);
    ImageView read = image;
    std::vector<std::uint8_t> repeated;
    if (image.rows == 1 || image.cols == 1) {
        read.rows = std::max(image.rows, 2);
        read.cols = std::max(image.cols, 2);
        repeated = repeat_edge(image, read.rows, read.cols);
        read.data = repeated.data();
        read.stride = 3 * std::ptrdiff_t{read.cols};
    }
    const Eigen::Index each = Eigen::Index{3} * rows * columns;
    WindowBytes samples(windows.rows() * each);
    for (Eigen::Index i = 0; i < windows.rows(); ++i)
        sample_window(read, windows.data() + i * windows.outerStride(), rows, columns,
                      samples.data() + i * each);
    return samples;
}

}  // namespace tricue
