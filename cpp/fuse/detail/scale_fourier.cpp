// SPDX-License-Identifier: MIT
#include "fuse/detail/scale_fourier.hpp"

#include <algorithm>
#include <cmath>

#include "fuse/detail/matrix_product.hpp"

namespace tricue {
namespace {

constexpr double kTwoPi = 6.283185307179586;

/// Writes (S / 2 + 1, S) cosines above as many minus sines of 2 pi u s / S.
void write_fourier_matrix(int scales, AlignedMatrix& weights) {
    const int half = scales / 2 + 1;
    Eigen::ArrayXf cosines(scales), sines(scales);
    for (int k = 0; k < scales; ++k) {
        const double angle = kTwoPi * static_cast<double>(k) / static_cast<double>(scales);
        cosines[k] = static_cast<float>(std::cos(angle));
        sines[k] = static_cast<float>(std::sin(angle));
    }
    for (int u = 0; u < half; ++u)
        for (int s = 0; s < scales; ++s) {
            weights.row(u)[s] = cosines[u * s % scales];
            weights.row(half + u)[s] = -sines[u * s % scales];
        }
}

}  // namespace

ScaleSpectra::ScaleSpectra(FloatsRef looks)
    : half_(static_cast<int>(looks.rows()) / 2 + 1), numbers_(2 * half_, static_cast<int>(looks.cols())) {
    const int scales = static_cast<int>(looks.rows()), channels = numbers_.cols();
    AlignedMatrix weights(2 * half_, scales), padded(scales, channels);
    write_fourier_matrix(scales, weights);
    for (int s = 0; s < scales; ++s)
        std::copy_n(looks.data() + looks.outerStride() * s, channels, padded.row(s));
    multiply(weights, padded, channels, numbers_);
}

Eigen::Array<float, Eigen::Dynamic, 1> invert_scale_spectrum(const Eigen::ArrayXf& re,
                                                             const Eigen::ArrayXf& im, int scales) {
    // x_s = sum_u X_u exp(2 pi i s u / S) / S, where all frequencies but 0 and S / 2 count twice, for their mirror image.
    Eigen::VectorXf parts(2 * re.size());
    parts << re.matrix(), im.matrix();
    const Eigen::Index doubled = (scales - 1) / 2;
    parts.segment(1, doubled) *= 2;
    parts.segment(re.size() + 1, doubled) *= 2;
    AlignedMatrix weights(static_cast<int>(parts.size()), scales);
    write_fourier_matrix(scales, weights);
    Eigen::ArrayXf signal = Eigen::ArrayXf::Zero(scales);
    for (int u = 0; u < weights.rows(); ++u)
        for (int s = 0; s < scales; ++s) signal[s] += parts[u] * weights.row(u)[s];
    return signal / static_cast<float>(scales);
}

}  // namespace tricue
