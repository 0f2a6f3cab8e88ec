// SPDX-License-Identifier: MIT
#include "cues/color/section_distance.hpp"

#include <cmath>
#include <string>

#include "base/check.hpp"

namespace tricue {
namespace {

double squared_distance(const float* a, const float* b, Eigen::Index n) {
    double sum = 0.0;
    for (Eigen::Index i = 0; i < n; ++i) {
        const double difference = static_cast<double>(a[i]) - static_cast<double>(b[i]);
        sum += difference * difference;
    }
    return sum;
}

}  // namespace

Vector section_distance(FloatsRef sections, FloatsRef model) {
    if (sections.cols() != model.cols())
        refuse("model", std::to_string(sections.cols()) + " sections, as in sections",
               static_cast<double>(model.cols()));
    Vector distances = Vector::Zero(sections.rows() / 3);
    for (Eigen::Index i = 0; i < sections.rows(); ++i)
        distances[i / 3] +=
            std::sqrt(squared_distance(sections.row(i).data(), model.row(i % 3).data(), model.cols()));
    return distances / (3.0 * std::sqrt(2.0));
}

}  // namespace tricue
