// SPDX-License-Identifier: MIT
#pragma once
// Kernels without the GIL, so that trackers in several threads run at the same time.

#include <pybind11/pybind11.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <thread>

#include "base/region.hpp"
#include "base/simd.hpp"

namespace tricue::bindings {

/// How much work a kernel has, for `unlocked`, at most a billion: the kernel hasn't checked its arguments yet, and their product may
/// not fit an integer.
template <typename... Factors>
std::ptrdiff_t work_of(Factors... factors) {
    return static_cast<std::ptrdiff_t>(std::clamp((static_cast<double>(factors) * ...), 0.0, 1e9));
}

/// The same of a region's pixels, so many times each; none where its corners are the wrong way round.
template <typename... Factors>
std::ptrdiff_t work_in(const Region& region, Factors... times) {
    const std::ptrdiff_t none = 0;
    return work_of(std::max(none, std::ptrdiff_t{region.x1} - region.x0),
                   std::max(none, std::ptrdiff_t{region.y1} - region.y0), times...);
}

/// Whether the thread that took the GIL last, of those that run kernels, has released it for a kernel again. It may have been released
/// or taken elsewhere: this only decides whether waiting awake may pay. A thread that takes the GIL sets it to false first, so that of
/// several that wait only one does so; the others would fall asleep.
inline std::atomic<bool> gil_is_free{true};

/// Holds no GIL while it exists. Another thread's Python between two of its kernels takes some microseconds, up to a hundred from one
/// frame to the next, but to be woken takes a sleeping thread as long. So it waits awake for the GIL at first.
class WithoutGil {
public:
    WithoutGil() : thread_(PyEval_SaveThread()) { gil_is_free.store(true); }
    WithoutGil(const WithoutGil&) = delete;
    WithoutGil& operator=(const WithoutGil&) = delete;
    ~WithoutGil() {
        if (!gil_is_free.exchange(false)) wait_awake();
        PyEval_RestoreThread(thread_);
        gil_is_free.store(false);
    }

private:
    static void wait_awake() {
        using Clock = std::chrono::steady_clock;
        constexpr std::chrono::microseconds kLongest{200};
        static const bool is_alone = std::thread::hardware_concurrency() == 1;
        if (is_alone) return;
        for (const auto end = Clock::now() + kLongest; Clock::now() < end; pause())
            if (gil_is_free.load() && gil_is_free.exchange(false)) return;
    }

    PyThreadState* thread_;
};

/// Runs a kernel, without the GIL where it has enough work, in pixels or numbers to go through: to release it and to get it back takes
/// longer than a small kernel.
template <typename Kernel>
auto unlocked(std::ptrdiff_t work, Kernel&& kernel) {
    constexpr std::ptrdiff_t kEnough = 512;
    if (work < kEnough) return kernel();
    const WithoutGil meanwhile;
    return kernel();
}

}  // namespace tricue::bindings
