// SPDX-License-Identifier: MIT
#include "cues/color/detail/color_space.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "base/check.hpp"
#include "base/simd.hpp"
#include "cues/color/detail/histogram_sum.hpp"

namespace tricue {
namespace {

/// Sums over the bins (i, j, k) of each k: of their numbers, and of these times i, and times j.
struct Moments {
    double *all, *first, *second;
};

/// kThird is the number of bins of the third axis, or 0 for any number: with a known number, sums stay in registers.
template <int kThird>
TRICUE_INLINE void add_moments_of(const double* __restrict numbers, int first, int second, int any_third,
                                  const Moments& moments) {
    const int third = kThird > 0 ? kThird : any_third;
    constexpr std::size_t kRoom = kThird > 0 ? kThird : 256;
    double times_i[kRoom] = {}, times_j[kRoom] = {}, all[kRoom] = {};
    for (int i = 0; i < first; ++i) {
        double plane[kRoom];
        for (int k = 0; k < third; ++k) plane[k] = 0.0;
        for (int j = 0; j < second; ++j, numbers += third)
            for (int k = 0; k < third; ++k) {
                plane[k] += numbers[k];
                times_j[k] += j * numbers[k];
            }
        for (int k = 0; k < third; ++k) {
            all[k] += plane[k];
            times_i[k] += i * plane[k];
        }
    }
    for (int k = 0; k < third; ++k) {
        moments.all[k] = all[k];
        moments.first[k] = times_i[k];
        moments.second[k] = times_j[k];
    }
}

TRICUE_MULTIVERSION
void add_moments(const double* numbers, int first, int second, int third, const Moments& moments) {
    third == 8 ? add_moments_of<8>(numbers, first, second, third, moments)
               : add_moments_of<0>(numbers, first, second, third, moments);
}

}  // namespace

void require_space(const ColorSpace& space) {
    const auto [least, most] = std::minmax_element(space.bins.begin(), space.bins.end());
    if (*least < 1 || *most > 256 || space.size() > 65535)
        refuse("bins", "1 to 256 on each axis and at most 65535 in all",
               "(" + std::to_string(space.bins[0]) + ", " + std::to_string(space.bins[1]) + ", " +
                   std::to_string(space.bins[2]) + ")");
    if (space.chroma < 1 || space.chroma > 255) refuse("chroma", "1 to 255", space.chroma);
}

double require_histogram(VectorRef histogram, const ColorSpace& space) {
    require_space(space);
    require_size(histogram, space.size(), "histogram");
    return require_histogram_sum(histogram, "histogram");
}

Vector mean_color(VectorRef histogram, double sum, const ColorSpace& space) {
    const auto [first, second, third] = space.bins;
    std::vector<double> numbers(3 * static_cast<std::size_t>(third), 0.0);
    const Moments moments{numbers.data(), numbers.data() + third, numbers.data() + 2 * third};
    add_moments(histogram.data(), first, second, third, moments);
    std::array<double, 3> places{};
    for (int k = 0; k < third; ++k) {
        places[0] += moments.first[k];
        places[1] += moments.second[k];
        places[2] += k * moments.all[k];
    }
    Vector mean(3);
    for (std::size_t axis = 0; axis < 3; ++axis)
        mean[static_cast<Eigen::Index>(axis)] = space.first(axis) + places[axis] / sum * space.width(axis);
    return mean;
}

}  // namespace tricue
