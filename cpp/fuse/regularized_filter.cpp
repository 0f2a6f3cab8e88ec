// SPDX-License-Identifier: MIT
#include "fuse/regularized_filter.hpp"

#include <algorithm>
#include <utility>

#include "base/check.hpp"
#include "base/simd.hpp"
#include "fuse/detail/aligned_matrix.hpp"
#include "fuse/detail/correlation_checks.hpp"
#include "fuse/detail/masked_fourier.hpp"
#include "fuse/detail/plane_fourier.hpp"

// A's closed form, written so that rounding doesn't grow. R is what A would be without cells and label; C corrects it by the
// difference of its response from the label:
//     R = (μ P + γ (G − H)) / (γ + μ)
//     C = (Y − Σ_k X_k R_k) / (Σ_k |X_k|² + γ + μ)
//     A = R + conj(X) C

namespace tricue {
namespace {

constexpr double kGrowth = 10.0;  ///< of γ from one iteration to the next

/// The weights of P and of G − H in R, and γ + μ.
struct Weights {
    Weights(double temporal, double penalty)
        : previous(static_cast<float>(temporal / (penalty + temporal))),
          masked(static_cast<float>(penalty / (penalty + temporal))),
          sum(static_cast<float>(penalty + temporal)) {}

    float previous, masked, sum;
};

/// Spectra of several planes.
class Spectra {
public:
    Spectra(int planes, std::size_t count)
        : re_(planes, static_cast<int>(count)), im_(planes, static_cast<int>(count)) {}

    Spectrum operator[](int plane) { return {re_.row(plane), im_.row(plane)}; }

private:
    AlignedMatrix re_, im_;
};

/// Adds |X|², and X times R of the first iteration. `previous` holds pairs of a real and an imaginary part, as do `label` and `pairs`
/// below.
TRICUE_MULTIVERSION
void add_channel(Spectrum x, const float* previous, float weight, std::size_t n, float* energy,
                 Spectrum sum) {
    TRICUE_INDEPENDENT
    for (std::size_t i = 0; i < n; ++i) {
        const float a = weight * previous[2 * i], b = weight * previous[2 * i + 1];
        energy[i] += x.re[i] * x.re[i] + x.im[i] * x.im[i];
        sum.re[i] += x.re[i] * a - x.im[i] * b;
        sum.im[i] += x.re[i] * b + x.im[i] * a;
    }
}

/// Computes C, in place of the sum of X R.
TRICUE_MULTIVERSION
void find_correction(const float* label, const float* energy, float weights, std::size_t n, Spectrum sum) {
    TRICUE_INDEPENDENT
    for (std::size_t i = 0; i < n; ++i) {
        const float share = 1.0F / (energy[i] + weights);
        sum.re[i] = (label[2 * i] - sum.re[i]) * share;
        sum.im[i] = (label[2 * i + 1] - sum.im[i]) * share;
    }
}

/// Computes R of the first iteration.
TRICUE_MULTIVERSION
void write_weighted(const float* previous, float weight, std::size_t n, Spectrum filter) {
    TRICUE_INDEPENDENT
    for (std::size_t i = 0; i < n; ++i) {
        filter.re[i] = weight * previous[2 * i];
        filter.im[i] = weight * previous[2 * i + 1];
    }
}

/// Adds conj(X) C.
TRICUE_MULTIVERSION
void correct(Spectrum x, Spectrum correction, std::size_t n, Spectrum filter) {
    TRICUE_INDEPENDENT
    for (std::size_t i = 0; i < n; ++i) {
        filter.re[i] += x.re[i] * correction.re[i] + x.im[i] * correction.im[i];
        filter.im[i] += x.re[i] * correction.im[i] - x.im[i] * correction.re[i];
    }
}

/// Between the iterations: computes, from A and G, with H = A − G, R + H in place of A; adds X times R.
TRICUE_MULTIVERSION
void begin_again(Spectrum x, const float* previous, Spectrum masked, Weights weights, std::size_t n,
                 Spectrum filter, Spectrum sum) {
    TRICUE_INDEPENDENT
    for (std::size_t i = 0; i < n; ++i) {
        const float dual_re = filter.re[i] - masked.re[i], dual_im = filter.im[i] - masked.im[i];
        const float a = weights.previous * previous[2 * i] + weights.masked * (masked.re[i] - dual_re);
        const float b = weights.previous * previous[2 * i + 1] + weights.masked * (masked.im[i] - dual_im);
        sum.re[i] += x.re[i] * a - x.im[i] * b;
        sum.im[i] += x.re[i] * b + x.im[i] * a;
        filter.re[i] = a + dual_re;
        filter.im[i] = b + dual_im;
    }
}

TRICUE_MULTIVERSION
void write_pairs(Spectrum spectrum, std::size_t n, float* pairs) {
    TRICUE_INDEPENDENT
    for (std::size_t i = 0; i < n; ++i) {
        pairs[2 * i] = spectrum.re[i];
        pairs[2 * i + 1] = spectrum.im[i];
    }
}

/// Passes over the channels three times, two channels at a time, so that most data stay in the caches.
class Learner {
public:
    Learner(const FloatStack& cells, FloatsRef mask, const ComplexStack& previous)
        : cells_(cells),
          previous_(previous),
          planes_(cells.rows, cells.cols),
          mask_(mask, planes_),
          n_(planes_.count()),
          channels_(cells.planes, n_),
          masked_(2, n_),
          corrections_(2, n_),
          energy_(1, static_cast<int>(n_)),
          filter_(Eigen::Index{cells.planes} * cells.rows, planes_.half()) {}

    Complexes learn(const float* label, double temporal, double penalty) {
        const Weights first(temporal, penalty), second(temporal, kGrowth * penalty);
        transform(first);
        find_correction(label, energy_.row(0), first.sum, n_, corrections_[0]);
        iterate(first, second);
        find_correction(label, energy_.row(0), second.sum, n_, corrections_[1]);
        finish();
        return std::move(filter_);
    }

private:
    void transform(const Weights& weights) {
        for_pairs([&](int k, int last) {
            const Spectrum one = channels_[k], two = channels_[last];
            planes_.transform(cells_.row(k, 0), cells_.row(last, 0), one.re, one.im, two.re, two.im);
            for (int i = k; i <= last; ++i)
                add_channel(channels_[i], previous(i), weights.previous, n_, energy_.row(0), corrections_[0]);
        });
    }

    void iterate(const Weights& weights, const Weights& next) {
        for_pairs([&](int k, int last) {
            for (int i = k; i <= last; ++i) {
                write_weighted(previous(i), weights.previous, n_, filter(i));
                correct(channels_[i], corrections_[0], n_, filter(i));
            }
            mask_.multiply(filter(k), filter(last), masked_[0], masked_[1]);
            for (int i = k; i <= last; ++i)
                begin_again(channels_[i], previous(i), masked_[i - k], next, n_, filter(i), corrections_[1]);
        });
    }

    void finish() {
        for_pairs([&](int k, int last) {
            for (int i = k; i <= last; ++i) correct(channels_[i], corrections_[1], n_, filter(i));
            mask_.multiply(filter(k), filter(last), masked_[0], masked_[1]);
            for (int i = k; i <= last; ++i) write_pairs(masked_[i - k], n_, filter(i).re);
        });
    }

    template <typename Use>
    void for_pairs(const Use& use) {
        for (int k = 0; k < cells_.planes; k += 2) use(k, std::min(k + 1, cells_.planes - 1));
    }

    const float* previous(int k) const { return as_floats(previous_.row(k, 0)); }
    Spectrum filter(int k) {
        float* numbers = as_floats(&filter_(Eigen::Index{k} * cells_.rows, 0));
        return {numbers, numbers + n_};
    }

    const FloatStack& cells_;
    const ComplexStack& previous_;
    PlaneFourier planes_;
    MaskedFourier mask_;
    std::size_t n_;         ///< frequencies
    Spectra channels_;      ///< X
    Spectra masked_;        ///< G of two channels
    Spectra corrections_;   ///< C of both iterations
    AlignedMatrix energy_;  ///< Σ_k |X_k|²
    /// At the end G. Before that, with real and imaginary parts of each channel apart, A; then R + H, and A + H of the
    /// second iteration.
    Complexes filter_;
};

}  // namespace

Complexes regularized_filter(const FloatStack& cells, FloatsRef mask, ComplexesRef label,
                             const ComplexStack& previous, double temporal_weight, double penalty) {
    require_cells(cells);
    require_shape(mask.rows(), mask.cols(), cells.rows, cells.cols, "mask");
    require_shape(label.rows(), label.cols(), cells.rows, cells.cols / 2 + 1, "label");
    require_filter("previous", previous, cells);
    require_not_negative(temporal_weight, "temporal_weight");
    require_positive(penalty, "penalty");
    const double size = static_cast<double>(cells.rows) * cells.cols;
    Learner learner(cells, mask, previous);
    return learner.learn(as_floats(label.data()), temporal_weight * size, penalty * size);
}

}  // namespace tricue
