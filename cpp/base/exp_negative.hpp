// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace tricue {

/// exp(x) for x <= 0, vectorizable with every instruction set: 2^k times a polynomial of the remainder, at most
/// ln(2)/2. Relative error below 1e-6; 0 where exp(x) is below the normal floats.
inline float exp_negative(float x) {
    const float clamped = std::max(x, -87.0F);
    // 1.5 * 2^23: after adding it only the nearest integer is left.
    constexpr float kRounder = 12582912.0F;
    const float shifted = clamped * 1.44269504F + kRounder;
    const float k = shifted - kRounder;
    const float r = (clamped - k * 0.693359375F) + k * 2.12194440e-4F;  // ln 2 in two parts
    const float series =
        1.0F +
        r * (1.0F + r * (1 / 2.0F + r * (1 / 6.0F + r * (1 / 24.0F + r * (1 / 120.0F + r * (1 / 720.0F))))));
    const std::int32_t bits = (static_cast<std::int32_t>(k) + 127) << 23;
    float power;
    std::memcpy(&power, &bits, sizeof power);
    return x < -87.0F ? 0.0F : series * power;
}

}  // namespace tricue
