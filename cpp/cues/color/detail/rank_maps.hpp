// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <variant>
#include <vector>

#include "base/arrays.hpp"
#include "base/sample_view.hpp"

namespace tricue {

/// @throws std::invalid_argument unless M x 3n numbers are ranks in [0, 1] and n >= 1, naming `models` and `samples`
void require_rank_maps(FloatsRef models, std::ptrdiff_t n);

/// M rank maps for comparison with the samples of ellipses.
class RankMaps {
public:
    /// @param models M x 3n ranks in [0, 1], n >= 1
    /// @throws std::invalid_argument on ranks outside [0, 1], another size, or n < 1, naming `models` and `samples`
    RankMaps(FloatsRef models, std::ptrdiff_t n);

    std::ptrdiff_t size() const { return size_; }

    /// Writes the distances between each ellipse's n samples and each map: size() numbers in [0, 1] per ellipse.
    void compare(const SampleView& samples, double* distances);

private:
    /// Ranks in units of 1/2n, in the smallest type that fits: those of the maps, and a buffer for two ellipses' ranks.
    template <typename Count>
    struct Counts {
        using Number = Count;
        std::vector<Count> models, ranks;
    };

    std::ptrdiff_t size_;
    std::vector<std::uint8_t> places_;  ///< of two ellipses' samples in their rank tables
    std::variant<Counts<std::uint8_t>, Counts<std::uint16_t>, Counts<std::uint32_t>> counts_;
};

}  // namespace tricue
