// SPDX-License-Identifier: MIT
// How fast this machine does one kind of work when nothing else limits it. limits/machine.py compiles this file for the
// processor that it runs on. Each probe returns operations per second: the best of several runs, as other work only adds time.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace {

constexpr int kRuns = 60;
constexpr int kRegisters = 12;  // independent results: enough to hide any latency
#if defined(__AVX512F__)
constexpr int kWidth = 64;  // bytes of a register
#elif defined(__AVX__)
constexpr int kWidth = 32;
#else
constexpr int kWidth = 16;
#endif
using Bytes [[gnu::vector_size(kWidth)]] = std::uint8_t;
using Words [[gnu::vector_size(kWidth)]] = std::uint64_t;
using Floats [[gnu::vector_size(kWidth)]] = float;
using Doubles [[gnu::vector_size(kWidth)]] = double;

volatile std::uint64_t sink;

/// Hides a variable's value from the compiler, so that it can't compute results in advance.
template <typename Value>
void hide(Value& value) {
    asm volatile("" : "+m"(value));
}

/// The same for a number in a register.
inline void hide_register(std::uint32_t& number) {
    asm volatile("" : "+r"(number));
}

template <typename Run>
double rate(double operations, Run run) {
    double best = 1e300;
    for (int i = 0; i < kRuns; ++i) {
        const auto start = std::chrono::steady_clock::now();
        run();
        best =
            std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
    return operations / best;
}

template <typename Vector>
void keep(const Vector& vector) {
    std::uint64_t word;
    std::memcpy(&word, &vector, sizeof word);
    sink = word;
}

/// The rate of steps on registers that don't depend on each other; `step` changes one register.
template <typename Vector, typename Step>
double vector_rate(double operations, int steps, Step step) {
    return rate(operations * kRegisters * steps, [&] {
        Vector registers[kRegisters] = {};
        for (Vector& each : registers) hide(each);
        for (int i = 0; i < steps; ++i)
#pragma GCC unroll 12
            for (int k = 0; k < kRegisters; ++k) step(registers[k]);
        Vector total = registers[0];
        for (int k = 1; k < kRegisters; ++k) total += registers[k];
        keep(total);
    });
}

}  // namespace

extern "C" {

/// Bytes read, or read and written, in data of this size, whichever is faster.
double bytes_per_second(std::size_t size) {
    const std::size_t words = std::max<std::size_t>(size / kWidth / 16 * 16, 16);
    std::vector<Words> data(words, Words{}), other(words / 2, Words{});
    const auto passes = static_cast<int>(std::max<std::size_t>(1, (1 << 21) / size));
    const double read = rate(double(words) * kWidth * passes, [&] {
        Words totals[8] = {};
        for (int pass = 0; pass < passes; ++pass) {
            for (std::size_t i = 0; i < words; i += 8)
#pragma GCC unroll 8
                for (std::size_t k = 0; k < 8; ++k) totals[k] |= data[i + k];
            asm volatile("" ::: "memory");
        }
        Words total = totals[0];
        for (int k = 1; k < 8; ++k) total |= totals[k];
        keep(total);
    });
    const std::size_t half = words / 2;
    const double copy = rate(2.0 * double(half) * kWidth * passes, [&] {
        for (int pass = 0; pass < passes; ++pass) {
            for (std::size_t i = 0; i < half; i += 8)
#pragma GCC unroll 8
                for (std::size_t k = 0; k < 8; ++k) other[i + k] = data[i + k];
            asm volatile("" ::: "memory");
        }
        keep(other[0]);
    });
    return std::max(read, copy);
}

/// Operations on bytes: additions, comparisons, maxima.
double ops8_per_second() {
    Bytes one = Bytes{} + 1, two = Bytes{} + 2;
    hide(one);
    hide(two);
    return vector_rate<Bytes>(2.0 * kWidth, 4000, [&](Bytes& x) { x = (x + one) ^ two; });
}

/// Floating-point operations of 32 bits: a fused multiply-add is two.
double flops32_per_second() {
    Floats factor = Floats{} + 0.999f, summand = Floats{} + 0.5f;
    hide(factor);
    hide(summand);
    return vector_rate<Floats>(2.0 * kWidth / 4, 4000, [&](Floats& x) { x = x * factor + summand; });
}

/// The same of 64 bits.
double flops64_per_second() {
    Doubles factor = Doubles{} + 0.999, summand = Doubles{} + 0.5;
    hide(factor);
    hide(summand);
    return vector_rate<Doubles>(2.0 * kWidth / 8, 4000, [&](Doubles& x) { x = x * factor + summand; });
}

/// Divisions of 32 bits; square roots take as long or longer.
double divs32_per_second() {
    Floats dividend = Floats{} + 3.0f;
    hide(dividend);
    return vector_rate<Floats>(kWidth / 4, 1000, [&](Floats& x) { x = dividend / (x + 1.0f); });
}

/// The same of 64 bits.
double divs64_per_second() {
    Doubles dividend = Doubles{} + 3.0;
    hide(dividend);
    return vector_rate<Doubles>(kWidth / 8, 1000, [&](Doubles& x) { x = dividend / (x + 1.0); });
}

/// Numbers read from random places in a table of 16 KB, one by one; many processors' gathers are no faster.
double lookups_per_second() {
    constexpr int kCount = 4096;
    std::vector<std::uint32_t> table(4096);
    std::vector<std::uint16_t> places(kCount);
    for (int i = 0; i < kCount; ++i) {
        places[i] = static_cast<std::uint16_t>(i * 2654435761u >> 20);
        table[i] = static_cast<std::uint32_t>(i);
    }
    return rate(kCount * 8.0, [&] {
        std::uint32_t a = 0, b = 0, c = 0, d = 0;
        for (int pass = 0; pass < 8; ++pass) {
            for (int i = 0; i < kCount; i += 4) {
                a += table[places[i]];
                hide_register(a);
                b += table[places[i + 1]];
                hide_register(b);
                c += table[places[i + 2]];
                hide_register(c);
                d += table[places[i + 3]];
                hide_register(d);
            }
            asm volatile("" ::: "memory");
        }
        sink = a + b + c + d;
    });
}

/// Increments of bins in histograms of 1 KB; there are eight of them, so that one increment seldom waits for the last.
double counts_per_second() {
    constexpr int kCount = 4096;
    std::vector<std::uint32_t> bins(8 * 256);
    std::vector<std::uint8_t> places(kCount);
    for (int i = 0; i < kCount; ++i) places[i] = static_cast<std::uint8_t>(i * 2654435761u >> 24);
    return rate(kCount * 8.0, [&] {
        std::uint32_t* counts = bins.data();
        for (int pass = 0; pass < 8; ++pass) {
            for (int i = 0; i < kCount; i += 8) {
                std::uint64_t eight;
                std::memcpy(&eight, &places[i], sizeof eight);
#pragma GCC unroll 8
                for (int k = 0; k < 8; ++k) ++counts[256 * k + (eight >> 8 * k & 0xff)];
            }
            asm volatile("" ::: "memory");
        }
        sink = counts[0];
    });
}

/// Additions of 64 bits, each of which needs the previous one.
double in_turn_per_second() {
    double summand = 0.5;
    hide(summand);
    return rate(20000.0, [&] {
        double total = 0.0;
        for (int i = 0; i < 20000; ++i) total += summand;
        sink = static_cast<std::uint64_t>(total);
    });
}

}  // extern "C"
