// SPDX-License-Identifier: MIT
#include "cues/stereo/detail/gaussian_derivative.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/row_block.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

constexpr int kUsualReach = 3;  // of sigma 1, for which filters are compiled separately

/// Rows of a batch, `stride` numbers apart.
struct BatchRows {
    float* data;
    std::ptrdiff_t stride;
    int count;
};

/// `rows` are those of the batch with `reach` more above and below. kReach 0 stands for any reach.
template <int kBytes, int kReach>
TRICUE_INLINE void smooth_by(const float* const* rows, const GaussianDerivative& filter, int n,
                             const BatchRows& to) {
    const BatchRows out = to;
    const float* weights = filter.smooth.data();
    const int reach = kReach > 0 ? kReach : filter.reach;
    for (int i = 0; i < out.count; ++i)
        for (int x = 0; x < n; x += kRowLanes<kBytes>) {
            const float* const* around = rows + i + reach;
            RowLanes<kBytes> middle, above, below;
            load(around[0] + x, middle);
            RowLanes<kBytes> sum = weights[0] * middle;
            for (int k = 1; k <= reach; ++k) {
                load(around[-k] + x, above);
                load(around[k] + x, below);
                add<RowLanes<kBytes>>(weights[k], above + below, sum);
            }
            store(sum, out.data + i * out.stride + x);
        }
}

/// The same for a whole batch, which loads each row once.
template <int kBytes, int kReach>
TRICUE_INLINE void smooth_batch(const float* const* rows, const GaussianDerivative& filter, int n,
                                const BatchRows& to) {
    const BatchRows out = to;
    const float* weights = filter.smooth.data();
    constexpr int kRows = kRowBatch + 2 * kReach;
    for (int x = 0; x < n; x += kRowLanes<kBytes>) {
        RowLanes<kBytes> around[static_cast<std::size_t>(kRows)];
        for (int i = 0; i < kRows; ++i) load(rows[i] + x, around[i]);
        for (int i = 0; i < kRowBatch; ++i) {
            RowLanes<kBytes> sum = weights[0] * around[i + kReach];
            for (int k = 1; k <= kReach; ++k)
                add<RowLanes<kBytes>>(weights[k], around[i + kReach - k] + around[i + kReach + k], sum);
            store(sum, out.data + i * out.stride + x);
        }
    }
}

template <int kBytes>
TRICUE_INLINE void smooth_down_by(const float* const* rows, const GaussianDerivative& filter, int n,
                                  const BatchRows& out) {
    if (filter.reach == kUsualReach && out.count == kRowBatch)
        smooth_batch<kBytes, kUsualReach>(rows, filter, n, out);
    else if (filter.reach == kUsualReach)
        smooth_by<kBytes, kUsualReach>(rows, filter, n, out);
    else
        smooth_by<kBytes, 0>(rows, filter, n, out);
}

template <int kBytes, int kReach>
TRICUE_INLINE void differentiate_by(const BatchRows& from, const GaussianDerivative& filter, int n,
                                    const BatchRows& to) {
    const BatchRows in = from, out = to;
    const float* weights = filter.derivative.data();
    const int reach = kReach > 0 ? kReach : filter.reach;
    for (int i = 0; i < out.count; ++i)
        for (int x = 0; x < n; x += kRowLanes<kBytes>) {
            const float* row = in.data + i * in.stride + x;
            RowLanes<kBytes> left, right;
            load(row - 1, left);
            load(row + 1, right);
            RowLanes<kBytes> sum = weights[1] * (right - left);
            for (int k = 2; k <= reach; ++k) {
                load(row - k, left);
                load(row + k, right);
                add<RowLanes<kBytes>>(weights[k], right - left, sum);
            }
            store(sum, out.data + i * out.stride + x);
        }
}

template <int kBytes>
TRICUE_INLINE void differentiate_across_by(const BatchRows& in, const GaussianDerivative& filter, int n,
                                           const BatchRows& out) {
    if (filter.reach == kUsualReach)
        differentiate_by<kBytes, kUsualReach>(in, filter, n, out);
    else
        differentiate_by<kBytes, 0>(in, filter, n, out);
}

TRICUE_MULTIWIDTH(smooth_down, smooth_down_by,
                  (const float* const* rows, const GaussianDerivative& filter, int n, const BatchRows& out),
                  (rows, filter, n, out))
TRICUE_MULTIWIDTH(differentiate_across, differentiate_across_by,
                  (const BatchRows& in, const GaussianDerivative& filter, int n, const BatchRows& out),
                  (in, filter, n, out))

}  // namespace

GaussianDerivative::GaussianDerivative(double sigma) : reach(static_cast<int>(std::ceil(2.5 * sigma))) {
    std::array<double, kMaxReach + 1> gaussian{};
    double total = 0.0, moment = 0.0;
    for (int k = 0; k <= reach; ++k) {
        const auto at = static_cast<std::size_t>(k);
        gaussian[at] = std::exp(-k * k / (2.0 * sigma * sigma));
        total += (k == 0 ? 1.0 : 2.0) * gaussian[at];
        moment += 2.0 * k * k * gaussian[at];
    }
    smooth.fill(0.0F);
    derivative.fill(0.0F);
    for (std::size_t k = 0; k <= static_cast<std::size_t>(reach); ++k) {
        smooth[k] = static_cast<float>(gaussian[k] / total);
        derivative[k] = static_cast<float>(static_cast<double>(k) * gaussian[k] / moment);
    }
}

DerivativeRows::DerivativeRows(const GrayPlane& plane, const GaussianDerivative& filter, int x0, int x1,
                               int padding)
    : plane_(plane),
      filter_(filter),
      x0_(x0),
      x1_(x1),
      padding_(padding),
      smooth_stride_(x1 - x0 + 2 * filter.reach + kRowBlock),
      derivative_stride_(x1 - x0 + 2 * padding + kRowBlock),
      smooth_(static_cast<std::size_t>(kRowBatch * smooth_stride_)),
      derivative_(static_cast<std::size_t>(kRowBatch * derivative_stride_) + kRowBlock) {}

void DerivativeRows::filter(int begin, int end) {
    first_ = begin;
    const int reach = filter_.reach, count = end - begin, width = x1_ - x0_;
    const int left = std::max(x0_ - reach, 0), right = std::min(x1_ + reach, plane_.cols());
    std::array<const float*, kRowBatch + 2 * GaussianDerivative::kMaxReach> rows;
    for (int i = 0; i < count + 2 * reach; ++i)
        rows[static_cast<std::size_t>(i)] =
            plane_.row(std::clamp(begin - reach + i, 0, plane_.rows() - 1)) + left;
    float* inside = smooth_.data() + (left - (x0_ - reach));
    smooth_down(rows.data(), filter_, whole_blocks(right - left), {inside, smooth_stride_, count});
    for (int i = 0; i < count; ++i) {
        float *row = smooth_.data() + i * smooth_stride_, *inner = inside + i * smooth_stride_;
        std::fill(row, inner, *inner);
        std::fill_n(inner + (right - left), x1_ + reach - right, inner[right - left - 1]);
    }
    differentiate_across({smooth_.data() + reach, smooth_stride_, count}, filter_, whole_blocks(width),
                         {derivative_.data() + padding_, derivative_stride_, count});
    for (int i = 0; i < count; ++i) {
        float* row = derivative_.data() + i * derivative_stride_;
        std::fill_n(row, padding_, row[padding_]);
        std::fill_n(row + padding_ + width, padding_, row[padding_ + width - 1]);
    }
}

}  // namespace tricue
