// SPDX-License-Identifier: MIT
#include "cues/color/detail/color_space.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/check.hpp"

namespace tricue {

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
    require_finite(histogram, "histogram");
    const double least = histogram.minCoeff(), sum = histogram.sum();
    if (least < 0.0) refuse("histogram", "no negative number", least);
    if (!(sum > 0.0 && std::isfinite(sum))) refuse("histogram", "a finite sum above 0", sum);
    return sum;
}

Vector mean_color(VectorRef histogram, double sum, const ColorSpace& space) {
    const auto [first, second, third] = space.bins;
    const Eigen::Map<const Eigen::MatrixXd> bins(histogram.data(), third, Eigen::Index{first} * second);
    const Eigen::VectorXd light = bins.rowwise().sum();
    const Eigen::VectorXd chroma = bins.colwise().sum().transpose();
    const Eigen::Map<const Eigen::MatrixXd> plane(chroma.data(), second, first);
    const std::array<Eigen::VectorXd, 3> marginals{plane.colwise().sum().transpose(), plane.rowwise().sum(),
                                                   light};

    Vector mean(3);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto& marginal = marginals[axis];
        const double place = marginal.dot(
            Eigen::VectorXd::LinSpaced(marginal.size(), 0.0, static_cast<double>(marginal.size() - 1)));
        mean[static_cast<Eigen::Index>(axis)] = space.first(axis) + place / sum * space.width(axis);
    }
    return mean;
}

}  // namespace tricue
