// SPDX-License-Identifier: MIT
#include "cues/stereo/detail/window_mean.hpp"

#include "base/simd.hpp"

namespace tricue {
namespace {

template <int Count>
TRICUE_INLINE void sum_down(const float* const* rows, int n, float* __restrict out) {
    TRICUE_INDEPENDENT
    for (int x = 0; x < n; ++x) {
        float sum = rows[0][x];
        for (int k = 1; k < Count; ++k) sum += rows[k][x];
        out[x] = sum;
    }
}

template <int Count>
TRICUE_INLINE void sum_across(const float* __restrict in, float share, int n, float* __restrict out) {
    for (int x = 0; x < n; ++x) {
        float sum = in[x];
        for (int k = 1; k < Count; ++k) sum += in[x + k];
        out[x] = share * sum;
    }
}

template <int Count>
TRICUE_INLINE void mean_of(const float* const* rows, int n, float* __restrict column,
                           float* __restrict mean) {
    sum_down<Count>(rows, n + Count - 1, column);
    sum_across<Count>(column, 1.0F / static_cast<float>(Count * Count), n, mean);
}

TRICUE_MULTIVERSION
void find_means(const float* const* rows, int count, int n, float* __restrict column,
                float* __restrict mean) {
    switch (count) {
        case 1:
            return mean_of<1>(rows, n, column, mean);
        case 3:
            return mean_of<3>(rows, n, column, mean);
        case 5:
            return mean_of<5>(rows, n, column, mean);
        case 7:
            return mean_of<7>(rows, n, column, mean);
        case 9:
            return mean_of<9>(rows, n, column, mean);
        case 11:
            return mean_of<11>(rows, n, column, mean);
        case 13:
            return mean_of<13>(rows, n, column, mean);
        default:
            return mean_of<kWidestWindow>(rows, n, column, mean);
    }
}

}  // namespace

void mean_rows(const float* const* rows, int count, int n, float* column, float* mean) {
    find_means(rows, count, n, column, mean);
}

}  // namespace tricue
