// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace tricue {

/// out[k] = table[indices[k]] for n indices. Processors with byte permutations (AVX-512 VBMI) do 64 at a time; `out` must not
/// overlap the others.
void look_up(const std::array<std::uint8_t, 256>& table, const std::uint8_t* indices, std::size_t n,
             std::uint8_t* out);

}  // namespace tricue
