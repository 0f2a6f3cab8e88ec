// SPDX-License-Identifier: MIT
#include "cues/stereo/detail/box_filter.hpp"

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
TRICUE_INLINE void filter_by(const float* const* rows, int n, float* __restrict column,
                             float* __restrict mean) {
    sum_down<Count>(rows, n + Count - 1, column);
    sum_across<Count>(column, 1.0F / static_cast<float>(Count * Count), n, mean);
}

TRICUE_MULTIVERSION
void filter_row(const float* const* rows, int count, int n, float* __restrict column,
                float* __restrict mean) {
    switch (count) {
        case 1:
            return filter_by<1>(rows, n, column, mean);
        case 3:
            return filter_by<3>(rows, n, column, mean);
        case 5:
            return filter_by<5>(rows, n, column, mean);
        case 7:
            return filter_by<7>(rows, n, column, mean);
        case 9:
            return filter_by<9>(rows, n, column, mean);
        case 11:
            return filter_by<11>(rows, n, column, mean);
        case 13:
            return filter_by<13>(rows, n, column, mean);
        default:
            return filter_by<kMaxWindow>(rows, n, column, mean);
    }
}

}  // namespace

void box_filter_row(const float* const* rows, int count, int n, float* column, float* mean) {
    filter_row(rows, count, n, column, mean);
}

}  // namespace tricue
