// SPDX-License-Identifier: MIT
#include "cues/motion/detail/normal_equations.hpp"

#include "base/simd.hpp"

namespace tricue {
namespace {

TRICUE_MULTIVERSION
void multiply_constraints(const Constraints& row, int n, const NormalEquations& out) {
    const float *g_xs = row.g_x, *g_ys = row.g_y, *h_ys = row.h_y, *g_ts = row.g_t, *h_ts = row.h_t;
    float *xx = out.xx, *xy = out.xy, *yy = out.yy, *xt = out.xt, *yt = out.yt;
    const int whole = (n + kHalfBlock - 1) / kHalfBlock * kHalfBlock;
    // no row is another: more than the compiler would compare before the loop
    TRICUE_INDEPENDENT
    for (int x = 0; x < whole; ++x) {
        const float g_x = g_xs[x], g_y = g_ys[x], h_x = g_y, h_y = h_ys[x], g_t = g_ts[x], h_t = h_ts[x];
        xx[x] = g_x * g_x + h_x * h_x;
        xy[x] = g_x * g_y + h_x * h_y;
        yy[x] = g_y * g_y + h_y * h_y;
        xt[x] = g_x * g_t + h_x * h_t;
        yt[x] = g_y * g_t + h_y * h_t;
    }
}

/// `next` gives the start of the i-th of some numbers, one below or beside the other.
template <typename Block, typename Next>
TRICUE_INLINE void average_block(const Next& next, int x, int count, float share, float* out) {
    Block sum{}, block, mean{};
    for (int i = 0; i < count; ++i) {
        load(next(i) + x, block);
        add(1, block, sum);
    }
    add(share, sum, mean);
    store(mean, out + x);
}

template <typename Next>
TRICUE_INLINE void average(const Next& next, int count, float share, int n, float* out) {
    const int blocks = in_row_blocks(n);
    for (int x = 0; x < blocks; x += kRowBlock) average_block<RowBlock>(next, x, count, share, out);
    if (blocks < n) average_block<HalfBlock>(next, blocks, count, share, out);
}

/// The rows of a plane, those that its column means go to, and those for the means of windows.
struct WindowRows {
    const float* const* rows;
    float *columns, *means;
};

/// kSide 0 is any.
template <int kSide>
TRICUE_INLINE void pool_by(const WindowRows* planes, int any_side, int n) {
    const int side = kSide > 0 ? kSide : any_side;
    const float share = 1 / static_cast<float>(side);
    // Each step for all planes before the next: a load that reaches over what was just stored has to wait for it.
    for (int k = 0; k < 5; ++k) {
        const float* const* rows = planes[k].rows;
        average([=](int i) { return rows[i]; }, side, share, n + side - 1, planes[k].columns);
    }
    for (int k = 0; k < 5; ++k) {
        const float* row = planes[k].columns;
        average([=](int i) { return row + i; }, side, share, n, planes[k].means);
    }
}

TRICUE_MULTIVERSION
void pool(const WindowRows* planes, int side, int n) {
    constexpr int kUsualSide = 5;  // of the flow and depth tracker
    if (side == kUsualSide)
        pool_by<kUsualSide>(planes, side, n);
    else
        pool_by<0>(planes, side, n);
}

RowRingBuffer make_ring(int pool, int length) {
    return {2 * pool + 1, length + 2 * pool};
}

}  // namespace

NormalEquationRows::NormalEquationRows(int pool, int length)
    : pool_(pool),
      length_(length),
      products_{make_ring(pool, length), make_ring(pool, length), make_ring(pool, length),
                make_ring(pool, length), make_ring(pool, length)},
      sums_(5, whole_blocks(length) + 2 * pool),
      result_(5, length) {}

void NormalEquationRows::push(int y, const Constraints& constraints) {
    auto& [xx, xy, yy, xt, yt] = products_;
    multiply_constraints(constraints, length_ + 2 * pool_,
                         {xx.row(y), xy.row(y), yy.row(y), xt.row(y), yt.row(y)});
}

NormalEquations NormalEquationRows::row(int y) {
    std::array<WindowRows, 5> planes;
    for (int i = 0; i < 5; ++i) {
        const auto k = static_cast<std::size_t>(i);
        planes[k] = {products_[k].from(y - pool_), sums_.row(i), result_.row(i)};
    }
    tricue::pool(planes.data(), 2 * pool_ + 1, length_);
    return {result_.row(0), result_.row(1), result_.row(2), result_.row(3), result_.row(4)};
}

}  // namespace tricue
