// SPDX-License-Identifier: MIT
#include "fuse/detail/fast_fourier.hpp"

#include <cstddef>

#include "base/simd.hpp"

// The spectrum of a line of N real numbers is packed into N numbers: real parts of the frequencies 0 to N / 2, behind them imaginary
// parts of the frequencies 1 to N / 2 - 1. A plane is transformed along y, then along x, each packed row by itself: of a frequency u
// along y that leaves the spectra A and B of its real and imaginary parts, and A + i B is the plane's at u, A - i B at -u.

namespace tricue {
namespace {

constexpr int kSide = kFastSide, kHalf = kSide / 2;
constexpr std::size_t kCount = std::size_t{kSide} * kSide;

/// cos(2 π k / kSide), k from 0 to kSide / 4.
constexpr float kCosines[] = {1.0F,
                              0.98078528040323044913F,
                              0.92387953251128675613F,
                              0.83146961230254523708F,
                              0.70710678118654752440F,
                              0.55557023301960222474F,
                              0.38268343236508977173F,
                              0.19509032201612826785F,
                              0.0F};

constexpr float cosine(int n, int k) {
    return kCosines[k * (kSide / n)];
}

constexpr float sine(int n, int k) {
    return kCosines[kSide / 4 - k * (kSide / n)];
}

/// The packed spectrum of kN registers of real numbers that are `step` registers apart: those of the even and of the odd ones
/// (Cooley and Tukey), E + w^k O, where w^k O with the opposite sign gives the other half.
template <int kN, typename Register>
TRICUE_INLINE void transform_line(const Register* line, int step, Register* packed) {
    if constexpr (kN == 2) {
        packed[0] = line[0] + line[step];
        packed[1] = line[0] - line[step];
    } else {
        constexpr int kMiddle = kN / 2, kQuarter = kN / 4;
        Register even[std::size_t{kMiddle}], odd[std::size_t{kMiddle}];
        transform_line<kMiddle>(line, 2 * step, even);
        transform_line<kMiddle>(line + step, 2 * step, odd);
        packed[0] = even[0] + odd[0];
        packed[kMiddle] = even[0] - odd[0];
        packed[kQuarter] = even[kQuarter];
        packed[kMiddle + kQuarter] = -odd[kQuarter];
        for (int k = 1; k < kQuarter; ++k) {
            const Register re = cosine(kN, k) * odd[k] + sine(kN, k) * odd[kQuarter + k],
                           im = cosine(kN, k) * odd[kQuarter + k] - sine(kN, k) * odd[k];
            packed[k] = even[k] + re;
            packed[kMiddle - k] = even[k] - re;
            packed[kMiddle + k] = even[kQuarter + k] + im;
            packed[kN - k] = im - even[kQuarter + k];
        }
    }
}

/// The reverse, times kN.
template <int kN, typename Register>
TRICUE_INLINE void invert_line(const Register* packed, Register* line, int step) {
    if constexpr (kN == 2) {
        line[0] = packed[0] + packed[1];
        line[step] = packed[0] - packed[1];
    } else {
        constexpr int kMiddle = kN / 2, kQuarter = kN / 4;
        Register even[std::size_t{kMiddle}], odd[std::size_t{kMiddle}];
        even[0] = packed[0] + packed[kMiddle];
        odd[0] = packed[0] - packed[kMiddle];
        even[kQuarter] = 2.0F * packed[kQuarter];
        odd[kQuarter] = -2.0F * packed[kMiddle + kQuarter];
        for (int k = 1; k < kQuarter; ++k) {
            even[k] = packed[k] + packed[kMiddle - k];
            even[kQuarter + k] = packed[kMiddle + k] - packed[kN - k];
            const Register re = packed[k] - packed[kMiddle - k], im = packed[kMiddle + k] + packed[kN - k];
            odd[k] = cosine(kN, k) * re - sine(kN, k) * im;
            odd[kQuarter + k] = cosine(kN, k) * im + sine(kN, k) * re;
        }
        invert_line<kMiddle>(even, line, 2 * step);
        invert_line<kMiddle>(odd, line + step, 2 * step);
    }
}

/// Transforms all columns of a plane; `to` may be the plane itself.
template <typename Register>
TRICUE_INLINE void transform_columns(const float* plane, float* to) {
    constexpr int kLanes = sizeof(Register) / sizeof(float);
    for (int x = 0; x < kSide; x += kLanes) {
        Register line[std::size_t{kSide}], packed[std::size_t{kSide}];
        for (int y = 0; y < kSide; ++y) load(plane + y * kSide + x, line[y]);
        transform_line<kSide>(line, 1, packed);
        for (int y = 0; y < kSide; ++y) store(packed[y], to + y * kSide + x);
    }
}

template <typename Register>
TRICUE_INLINE void invert_columns(const float* plane, float* to) {
    constexpr float kScale = 1.0F / kSide;
    constexpr int kLanes = sizeof(Register) / sizeof(float);
    for (int x = 0; x < kSide; x += kLanes) {
        Register packed[std::size_t{kSide}], line[std::size_t{kSide}];
        for (int y = 0; y < kSide; ++y) load(plane + y * kSide + x, packed[y]);
        invert_line<kSide>(packed, line, 1);
        for (int y = 0; y < kSide; ++y) {
            const Register scaled = kScale * line[y];
            store(scaled, to + y * kSide + x);
        }
    }
}

/// Transposes kLanes rows and columns: interleaves each row with the one half a block below, log2(kLanes) times.
template <typename Register>
TRICUE_INLINE void transpose_block(const float* from, float* to) {
    constexpr int kLanes = sizeof(Register) / sizeof(float);
    Register rows[std::size_t{kLanes}], mixed[std::size_t{kLanes}];
    for (int i = 0; i < kLanes; ++i) load(from + i * kSide, rows[i]);
    for (int done = 1; done < kLanes; done *= 2) {
        for (int i = 0; i < kLanes / 2; ++i)
            interleave(rows[i], rows[kLanes / 2 + i], mixed[2 * i], mixed[2 * i + 1]);
        for (int i = 0; i < kLanes; ++i) rows[i] = mixed[i];
    }
    for (int i = 0; i < kLanes; ++i) store(rows[i], to + i * kSide);
}

template <typename Register>
TRICUE_INLINE void transpose(const float* from, float* to) {
    constexpr int kLanes = sizeof(Register) / sizeof(float);
    for (int y = 0; y < kSide; y += kLanes)
        for (int x = 0; x < kSide; x += kLanes)
            transpose_block<Register>(from + y * kSide + x, to + x * kSide + y);
}

/// A row of kHalf + 1 frequencies, from the packed spectrum of a line.
TRICUE_INLINE void unpack(const float* packed, float* re, float* im) {
    for (int v = 0; v <= kHalf; ++v) re[v] = packed[v];
    for (int v = 1; v < kHalf; ++v) im[v] = packed[kHalf + v];
    im[0] = im[kHalf] = 0.0F;
}

TRICUE_INLINE void pack(const float* re, const float* im, float* packed) {
    for (int v = 1; v < kHalf; ++v) packed[kHalf + v] = im[v];
    for (int v = 0; v <= kHalf; ++v) packed[v] = re[v];
}

/// A + i B in one row, A - i B in the other; both packed. The imaginary parts of the first and last frequencies are 0.
TRICUE_INLINE void unpack_pair(const float* __restrict a, const float* __restrict b, float* __restrict re,
                               float* __restrict im, float* __restrict other_re, float* __restrict other_im) {
    for (int v = 0; v < kHalf; ++v) {
        re[v] = a[v] - b[kHalf + v];
        im[v] = a[kHalf + v] + b[v];
        other_re[v] = a[v] + b[kHalf + v];
        other_im[v] = a[kHalf + v] - b[v];
    }
    for (const int v : {0, kHalf}) {
        re[v] = other_re[v] = a[v];
        im[v] = b[v];
        other_im[v] = -b[v];
    }
}

/// The reverse.
TRICUE_INLINE void pack_pair(const float* __restrict re, const float* __restrict im,
                             const float* __restrict other_re, const float* __restrict other_im,
                             float* __restrict a, float* __restrict b) {
    for (int v = 0; v < kHalf; ++v) {
        a[kHalf + v] = 0.5F * (im[v] + other_im[v]);
        b[kHalf + v] = 0.5F * (other_re[v] - re[v]);
    }
    for (int v = 0; v <= kHalf; ++v) {
        a[v] = 0.5F * (re[v] + other_re[v]);
        b[v] = 0.5F * (im[v] - other_im[v]);
    }
}

template <int kBytes>
TRICUE_INLINE void transform_by(const float* plane, float* re, float* im) {
    using Register = Pack<float, kBytes / int{sizeof(float)}>;
    alignas(64) float lines[kCount], turned[kCount];
    transform_columns<Register>(plane, lines);
    transpose<Register>(lines, turned);
    transform_columns<Register>(turned, turned);
    transpose<Register>(turned, lines);
    constexpr int kRow = kHalf + 1;
    for (const int u : {0, kHalf}) unpack(lines + u * kSide, re + u * kRow, im + u * kRow);
    for (int u = 1; u < kHalf; ++u)
        unpack_pair(lines + u * kSide, lines + (kHalf + u) * kSide, re + u * kRow, im + u * kRow,
                    re + (kSide - u) * kRow, im + (kSide - u) * kRow);
}

template <int kBytes>
TRICUE_INLINE void invert_by(const float* re, const float* im, float* plane) {
    using Register = Pack<float, kBytes / int{sizeof(float)}>;
    alignas(64) float lines[kCount], turned[kCount];
    constexpr int kRow = kHalf + 1;
    for (const int u : {0, kHalf}) pack(re + u * kRow, im + u * kRow, lines + u * kSide);
    for (int u = 1; u < kHalf; ++u)
        pack_pair(re + u * kRow, im + u * kRow, re + (kSide - u) * kRow, im + (kSide - u) * kRow,
                  lines + u * kSide, lines + (kHalf + u) * kSide);
    transpose<Register>(lines, turned);
    invert_columns<Register>(turned, turned);
    transpose<Register>(turned, lines);
    invert_columns<Register>(lines, plane);
}

TRICUE_MULTIWIDTH(transform_plane, transform_by, (const float* plane, float* re, float* im), (plane, re, im))
TRICUE_MULTIWIDTH(invert_plane, invert_by, (const float* re, const float* im, float* plane), (re, im, plane))

}  // namespace

void fast_transform(const float* plane, float* re, float* im) {
    transform_plane(plane, re, im);
}

void fast_invert(const float* re, const float* im, float* plane) {
    invert_plane(re, im, plane);
}

}  // namespace tricue
