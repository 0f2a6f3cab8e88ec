// SPDX-License-Identifier: MIT
#include "fourier_columns.hpp"

#include <algorithm>
#include <cmath>

#include "simd.hpp"

namespace tricue {
namespace {

constexpr double kTurn = 6.283185307179586;

/// Rows of n complex numbers.
struct In {
    const float *re, *im;
};
struct Out {
    float *re, *im;
};

/// A complex number of size 1.
struct Turn {
    float re, im;
};

TRICUE_MULTIVERSION
void butterfly_2(In a, In b, Turn turn, int n, Out sum, Out difference) {
    TRICUE_INDEPENDENT
    for (int x = 0; x < n; ++x) {
        const float re = a.re[x] - b.re[x], im = a.im[x] - b.im[x];
        sum.re[x] = a.re[x] + b.re[x];
        sum.im[x] = a.im[x] + b.im[x];
        difference.re[x] = re * turn.re - im * turn.im;
        difference.im[x] = re * turn.im + im * turn.re;
    }
}

TRICUE_MULTIVERSION
void butterfly_4(const In* in, const Turn* turns, int n, const Out* out) {
    const In a = in[0], b = in[1], c = in[2], d = in[3];
    const Out to0 = out[0], to1 = out[1], to2 = out[2], to3 = out[3];
    const Turn t1 = turns[1], t2 = turns[2], t3 = turns[3];
    TRICUE_INDEPENDENT
    for (int x = 0; x < n; ++x) {
        const float even_re = a.re[x] + c.re[x], even_im = a.im[x] + c.im[x];
        const float odd_re = b.re[x] + d.re[x], odd_im = b.im[x] + d.im[x];
        const float a_c_re = a.re[x] - c.re[x], a_c_im = a.im[x] - c.im[x];
        const float b_d_re = b.re[x] - d.re[x], b_d_im = b.im[x] - d.im[x];
        const float re1 = a_c_re + b_d_im, im1 = a_c_im - b_d_re;  // a - c - i (b - d)
        const float re2 = even_re - odd_re, im2 = even_im - odd_im;
        const float re3 = a_c_re - b_d_im, im3 = a_c_im + b_d_re;
        to0.re[x] = even_re + odd_re;
        to0.im[x] = even_im + odd_im;
        to1.re[x] = re1 * t1.re - im1 * t1.im;
        to1.im[x] = re1 * t1.im + im1 * t1.re;
        to2.re[x] = re2 * t2.re - im2 * t2.im;
        to2.im[x] = re2 * t2.im + im2 * t2.re;
        to3.re[x] = re3 * t3.re - im3 * t3.im;
        to3.im[x] = re3 * t3.im + im3 * t3.re;
    }
}

TRICUE_MULTIVERSION
void add_turned(In in, Turn turn, int n, Out out) {
    TRICUE_INDEPENDENT
    for (int x = 0; x < n; ++x) {
        out.re[x] += in.re[x] * turn.re - in.im[x] * turn.im;
        out.im[x] += in.re[x] * turn.im + in.im[x] * turn.re;
    }
}

int next_radix(int length) {
    if (length % 4 == 0) return 4;
    for (int p = 2; p * p <= length; ++p)
        if (length % p == 0) return p;
    return length;
}

}  // namespace

FourierColumns::FourierColumns(int n, int width)
    : n_(n),
      width_(width),
      turns_(2 * static_cast<std::size_t>(n)),
      real_(static_cast<std::size_t>(n) * static_cast<std::size_t>(width)),
      imag_(real_.size()),
      next_real_(real_.size()),
      next_imag_(real_.size()) {
    for (int k = 0; k < n; ++k) {
        turns_[2 * static_cast<std::size_t>(k)] = static_cast<float>(std::cos(kTurn * k / n));
        turns_[2 * static_cast<std::size_t>(k) + 1] = static_cast<float>(-std::sin(kTurn * k / n));
    }
}

/// One step of sequences of `length`, of which `stride` stand side by side: every radix-th of their numbers become one.
void FourierColumns::pass(int radix, int length, int stride) {
    const int rest = length / radix, n = stride * width_;
    const auto in = [&](int k) { return In{real(stride * k), imag(stride * k)}; };
    const auto out = [&](int k) {
        const std::ptrdiff_t start = std::ptrdiff_t{k} * n;
        return Out{next_real_.data() + start, next_imag_.data() + start};
    };
    const auto turn = [&](std::ptrdiff_t k) {  // exp(-2 pi i k / length)
        const auto at = static_cast<std::size_t>(2 * (k % length * stride));
        return Turn{turns_[at], turns_[at + 1]};
    };
    for (int p = 0; p < rest; ++p) {
        if (radix == 2) {
            butterfly_2(in(p), in(p + rest), turn(p), n, out(2 * p), out(2 * p + 1));
        } else if (radix == 4) {
            const In from[] = {in(p), in(p + rest), in(p + 2 * rest), in(p + 3 * rest)};
            const Out to[] = {out(4 * p), out(4 * p + 1), out(4 * p + 2), out(4 * p + 3)};
            const Turn turns[] = {turn(0), turn(p), turn(2 * p), turn(3 * p)};
            butterfly_4(from, turns, n, to);
        } else {
            for (int k = 0; k < radix; ++k) {
                const Out to = out(radix * p + k);
                std::fill_n(to.re, n, 0.0F);
                std::fill_n(to.im, n, 0.0F);
                for (int j = 0; j < radix; ++j)
                    add_turned(in(p + j * rest), turn(std::ptrdiff_t{k} * (p + j * rest)), n, to);
            }
        }
    }
    real_.swap(next_real_);
    imag_.swap(next_imag_);
}

void FourierColumns::forward() {
    for (int stride = 1, length = n_; length > 1;) {
        const int radix = next_radix(length);
        pass(radix, length, stride);
        stride *= radix;
        length /= radix;
    }
}

void FourierColumns::inverse() {
    real_.swap(imag_);
    forward();
    real_.swap(imag_);
}

}  // namespace tricue
