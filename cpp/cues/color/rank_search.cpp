// SPDX-License-Identifier: MIT
#include "cues/color/rank_search.hpp"

#include "base/check.hpp"

namespace tricue {
namespace {

/// The ellipse, and then one window for each offset.
States windows_around(VectorRef ellipse, StatesRef offsets) {
    const double x = ellipse[0], y = ellipse[1], minor = ellipse[2], major = ellipse[3];
    States windows(offsets.rows() + 1, 4);
    windows.row(0) << x, y, minor, major;
    for (Eigen::Index k = 0; k < offsets.rows(); ++k) {
        const auto offset = offsets.row(k);
        windows.row(k + 1) << x + minor * offset[0], y + major * offset[1], minor * offset[2],
            major * offset[3];
    }
    return windows;
}

}  // namespace

FoundEllipse rank_search(const ImageView& image, VectorRef ellipse, StatesRef offsets,
                         const EllipsePattern& pattern, const ColorAppearance& appearance,
                         const LikelihoodFactors& factors) {
    require_size(ellipse, 4, "ellipse");
    require_finite(ellipse, "ellipse");
    require_shape(offsets, offsets.rows(), 4, "offsets");
    require_finite(offsets, "offsets");
    const States windows = windows_around(ellipse, offsets);
    const Vector log_likelihood = rank_likelihood(image, windows, pattern, appearance, factors);
    Eigen::Index best = 0;
    const double highest = log_likelihood.maxCoeff(&best);
    return {windows.row(best).transpose(), highest, log_likelihood[0]};
}

}  // namespace tricue
