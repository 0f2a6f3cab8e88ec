// SPDX-License-Identifier: MIT
#include "plane_fourier.hpp"

namespace tricue {

PlaneFourier::PlaneFourier(int rows, int cols)
    : rows_(rows), cols_(cols), half_(cols / 2 + 1), along_(cols, rows), down_(rows, 2 * half_) {}

void PlaneFourier::write_row(int y, const float* one, const float* two) {
    for (int x = 0; x < cols_; ++x) {
        along_.real(x)[y] = one[x];
        along_.imag(x)[y] = two[x];
    }
}

void PlaneFourier::transform() {
    along_.forward();
    for (int v = 0; v < half_; ++v) {
        // Z = A + i B, and of real planes A(-v) is A's conjugate.
        const int opposite = (cols_ - v) % cols_;
        const ComplexRow z{along_.real(v), along_.imag(v)},
            mirror{along_.real(opposite), along_.imag(opposite)};
        for (int y = 0; y < rows_; ++y) {
            const ComplexRow one = spectrum(0, y), two = spectrum(1, y);
            one.re[v] = 0.5F * (z.re[y] + mirror.re[y]);
            one.im[v] = 0.5F * (z.im[y] - mirror.im[y]);
            two.re[v] = 0.5F * (z.im[y] + mirror.im[y]);
            two.im[v] = 0.5F * (mirror.re[y] - z.re[y]);
        }
    }
    down_.forward();
}

PlaneInverse::PlaneInverse(int rows, int cols)
    : rows_(rows), cols_(cols), half_(cols / 2 + 1), down_(rows, half_), along_(cols, rows) {}

void PlaneInverse::transform() {
    down_.inverse();
    for (int v = 0; v < half_; ++v) {
        const int mirror = (cols_ - v) % cols_;
        for (int y = 0; y < rows_; ++y) {
            const float re = down_.real(y)[v], im = down_.imag(y)[v];
            along_.real(mirror)[y] = re;
            along_.imag(mirror)[y] = -im;
            along_.real(v)[y] = re;
            along_.imag(v)[y] = im;
        }
    }
    along_.inverse();
}

}  // namespace tricue
