// SPDX-License-Identifier: MIT
#include "cues/motion/detail/normal_equations.hpp"

#include "base/simd.hpp"

namespace tricue {
namespace {

TRICUE_MULTIVERSION
void multiply_constraints(const Constraints& row, int n, const NormalEquations& out) {
    const float *g_xs = row.g_x, *g_ys = row.g_y, *h_ys = row.h_y, *g_ts = row.g_t, *h_ts = row.h_t;
    float *xx = out.xx, *xy = out.xy, *yy = out.yy, *xt = out.xt, *yt = out.yt;
    // no row is another: more than the compiler would compare before the loop
    TRICUE_INDEPENDENT
    for (int x = 0; x < n; ++x) {
        const float g_x = g_xs[x], g_y = g_ys[x], h_x = g_y, h_y = h_ys[x], g_t = g_ts[x], h_t = h_ts[x];
        xx[x] = g_x * g_x + h_x * h_x;
        xy[x] = g_x * g_y + h_x * h_y;
        yy[x] = g_y * g_y + h_y * h_y;
        xt[x] = g_x * g_t + h_x * h_t;
        yt[x] = g_y * g_t + h_y * h_t;
    }
}

TRICUE_MULTIVERSION
void mean_down(const float* const* rows, int count, float share, int n, float* out) {
    for (int x = 0; x < n; x += kRowBlock) {
        RowBlock sum{}, block, mean{};
        for (int i = 0; i < count; ++i) {
            load(rows[i] + x, block);
            add(1, block, sum);
        }
        add(share, sum, mean);
        store(mean, out + x);
    }
}

TRICUE_MULTIVERSION
void mean_across(const float* row, int count, float share, int n, float* out) {
    for (int x = 0; x < n; x += kRowBlock) {
        RowBlock sum{}, block, mean{};
        for (int i = 0; i < count; ++i) {
            load(row + x + i, block);
            add(1, block, sum);
        }
        add(share, sum, mean);
        store(mean, out + x);
    }
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
    const int side = 2 * pool_ + 1;
    const float share = 1 / static_cast<float>(side);
    // Each step for all rows before the next: a load that reaches over what was just stored has to wait for it.
    for (int i = 0; i < 5; ++i)
        mean_down(products_[static_cast<std::size_t>(i)].from(y - pool_), side, share, length_ + 2 * pool_,
                  sums_.row(i));
    for (int i = 0; i < 5; ++i) mean_across(sums_.row(i), side, share, length_, result_.row(i));
    return {result_.row(0), result_.row(1), result_.row(2), result_.row(3), result_.row(4)};
}

}  // namespace tricue
