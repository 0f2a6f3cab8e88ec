// SPDX-License-Identifier: MIT
#include "scale_fourier.hpp"

#include <cmath>

namespace tricue {
namespace {

constexpr double kTurn = 6.283185307179586;

using Matrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// (S / 2 + 1, S) cosines above as many minus sines of 2 pi u s / S.
Matrix fourier_matrix(Eigen::Index scales) {
    const Eigen::Index half = scales / 2 + 1;
    Eigen::ArrayXf cosines(scales), sines(scales);
    for (Eigen::Index k = 0; k < scales; ++k) {
        const double angle = kTurn * static_cast<double>(k) / static_cast<double>(scales);
        cosines[k] = static_cast<float>(std::cos(angle));
        sines[k] = static_cast<float>(std::sin(angle));
    }
    Matrix weights(2 * half, scales);
    for (Eigen::Index u = 0; u < half; ++u)
        for (Eigen::Index s = 0; s < scales; ++s) {
            weights(u, s) = cosines[u * s % scales];
            weights(half + u, s) = -sines[u * s % scales];
        }
    return weights;
}

}  // namespace

ScaleSpectra scale_spectra(FloatsRef looks) {
    ScaleSpectra spectra{Floats(2 * (looks.rows() / 2 + 1), looks.cols())};
    spectra.numbers.matrix().noalias() = fourier_matrix(looks.rows()) * looks.matrix();
    return spectra;
}

Eigen::Array<float, Eigen::Dynamic, 1> scale_signal(const Eigen::ArrayXf& re, const Eigen::ArrayXf& im,
                                                    int scales) {
    // x_s = sum_u X_u exp(2 pi i s u / S) / S, where all frequencies but 0 and S / 2 stand for their mirror too.
    Eigen::VectorXf parts(2 * re.size());
    parts << re.matrix(), im.matrix();
    const Eigen::Index doubled = (scales - 1) / 2;
    parts.segment(1, doubled) *= 2;
    parts.segment(re.size() + 1, doubled) *= 2;
    return (fourier_matrix(scales).transpose() * parts).array() / static_cast<float>(scales);
}

}  // namespace tricue
