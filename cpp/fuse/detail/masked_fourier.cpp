// SPDX-License-Identifier: MIT
#include "fuse/detail/masked_fourier.hpp"

#include "base/simd.hpp"

namespace tricue {
namespace {

TRICUE_MULTIVERSION
void multiply_by(const float* __restrict mask, std::size_t n, float* __restrict plane) {
    for (std::size_t i = 0; i < n; ++i) plane[i] *= mask[i];
}

/// The mask at row -y, column -x, modulo its sizes.
Floats mirrored(FloatsRef mask) {
    const Eigen::Index rows = mask.rows(), rest = mask.cols() - 1;
    Floats to(rows, mask.cols());
    for (Eigen::Index y = 0; y < rows; ++y) {
        const Eigen::Index from = (rows - y) % rows;
        to(y, 0) = mask(from, 0);
        to.row(y).tail(rest) = mask.row(from).tail(rest).reverse();
    }
    return to;
}

/// The number of the n lines, from the border, that are empty together with their mirror images.
template <typename IsEmpty>
int count_empty(int n, const IsEmpty& is_empty) {
    int count = 0;
    while (count < n / 2 && is_empty(count) && is_empty((n - count) % n)) ++count;
    return count;
}

Margins find_margins(const Floats& mask) {
    return {count_empty(static_cast<int>(mask.rows()), [&](int y) { return (mask.row(y) == 0.0F).all(); }),
            count_empty(static_cast<int>(mask.cols()), [&](int x) { return (mask.col(x) == 0.0F).all(); })};
}

}  // namespace

MaskedFourier::MaskedFourier(FloatsRef mask, PlaneFourier& planes)
    : planes_(planes),
      mask_(mirrored(mask)),
      one_(Floats::Zero(mask.rows(), mask.cols())),  // margins may never be written
      two_(one_) {
    margins_ = find_margins(mask_);
}

void MaskedFourier::multiply(const Spectrum& one, const Spectrum& two, const Spectrum& one_masked,
                             const Spectrum& two_masked) {
    const bool alone = two.re == one.re;
    float *first = one_.data(), *second = alone ? first : two_.data();
    const auto n = static_cast<std::size_t>(mask_.size());
    planes_.invert(one.re, one.im, two.re, two.im, first, second, margins_);
    multiply_by(mask_.data(), n, first);
    if (!alone) multiply_by(mask_.data(), n, second);
    planes_.transform(first, second, one_masked.re, one_masked.im, two_masked.re, two_masked.im, margins_);
}

}  // namespace tricue
