// SPDX-License-Identifier: MIT
#include "cues/stereo/detail/box_filter.hpp"

#include "base/simd.hpp"
#include "cues/stereo/detail/gray_plane.hpp"

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

/// All columns first: a load that reaches over what was just stored has to wait for it.
template <int Count>
TRICUE_INLINE void filter_by(const BoxFilter* filters, int planes, int n) {
    for (int i = 0; i < planes; ++i)
        sum_down<Count>(filters[i].rows, whole_lines(n + Count - 1), filters[i].column);
    for (int i = 0; i < planes; ++i)
        sum_across<Count>(filters[i].column, 1.0F / static_cast<float>(Count * Count), whole_lines(n),
                          filters[i].mean);
}

TRICUE_MULTIVERSION
void filter_rows(const BoxFilter* filters, int planes, int count, int n) {
    switch (count) {
        case 1:
            return filter_by<1>(filters, planes, n);
        case 3:
            return filter_by<3>(filters, planes, n);
        case 5:
            return filter_by<5>(filters, planes, n);
        case 7:
            return filter_by<7>(filters, planes, n);
        case 9:
            return filter_by<9>(filters, planes, n);
        case 11:
            return filter_by<11>(filters, planes, n);
        case 13:
            return filter_by<13>(filters, planes, n);
        default:
            return filter_by<kMaxWindow>(filters, planes, n);
    }
}

}  // namespace

void box_filter_rows(const BoxFilter* filters, int planes, int count, int n) {
    filter_rows(filters, planes, count, n);
}

}  // namespace tricue
