// SPDX-License-Identifier: MIT
#include "cues/depth/match_object.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/check.hpp"

namespace tricue {
namespace {

using Index = Eigen::Index;

/// The mean total variation distance of an object's distributions from the target's, in [0, 1].
double signature_distance(const ObjectFeatures& objects, Index index, VectorRef signature) {
    const Index bins = objects.columns.cols();
    double sum = 0.0;
    for (Index i = 0; i < bins; ++i) sum += std::abs(double{objects.columns(index, i)} - signature[i]);
    for (Index i = 0; i < bins; ++i) sum += std::abs(double{objects.rows(index, i)} - signature[bins + i]);
    return sum / 4;
}

class Matcher {
public:
    Matcher(const ExpectedBody& expected, const MatchCosts& by) : expected_(expected), by_(by) {
        const auto& [x, y, z, share, base] = by.deviation;
        deviation_ = {x, y, z, share * expected.size[0] + base, share * expected.size[1] + base};
    }

    /// The cost of the distance along the camera's axis alone, which rules out most objects.
    double depth_cost(const RectangleState& state) const {
        const double off = std::abs(state[2] - expected_.state[2]) / deviation_[2];
        return off * off / 2;
    }

    double cost(const RectangleState& state) const {
        RectangleState off;
        for (std::size_t i = 0; i < off.size(); ++i)
            off[i] = (state[i] - expected_.state[static_cast<Index>(i)]) / deviation_[i];
        if (!expected_.known[0]) weigh_unknown(off[0], off[3]);
        if (!expected_.known[1]) weigh_unknown(off[1], off[4]);
        double sum = 0.0;
        for (const double each : off) sum += each * each;
        return sum / 2;
    }

private:
    void weigh_unknown(double& position, double& size) const {
        position *= by_.unknown.center;
        if (size > 0.0) size *= by_.unknown.larger;
    }

    const ExpectedBody& expected_;
    const MatchCosts& by_;
    RectangleState deviation_;
};

void require_arguments(const ObjectFeatures& objects, VectorRef others, const ExpectedBody& expected,
                       VectorRef signature, const MatchCosts& costs) {
    require_objects(objects);
    if (others.size() > 0) require_size(others, objects.measured.rows(), "others");
    require_expected(expected);
    require_size(signature, 2 * objects.columns.cols() + 2, "signature");
    const auto& [x, y, z, share, base] = costs.deviation;
    for (const auto& [value, name] : {std::pair{x, "x"}, std::pair{y, "y"}, std::pair{z, "z"}})
        require_positive(value, name);
    for (const auto& [value, name] : {std::pair{share, "share"}, std::pair{base, "base"}})
        require_not_negative(value, name);
    if (!(share + base > 0.0)) refuse("base", "a number above 0 where share is 0", base);
    for (const auto& [value, name] :
         {std::pair{costs.unknown.center, "center"}, std::pair{costs.unknown.larger, "larger"},
          std::pair{costs.signature_cost, "signature_cost"}})
        if (!std::isfinite(value)) refuse(name, "a finite number", value);
}

}  // namespace

int match_object(const ObjectFeatures& objects, VectorRef others, const ExpectedBody& expected,
                 VectorRef signature, const MatchCosts& costs, bool complete) {
    require_arguments(objects, others, expected, signature, costs);
    const Matcher matcher(expected, costs);
    Index best = -1;
    double least = costs.max_cost;
    for (Index i = 0; i < objects.measured.rows(); ++i) {
        const RectangleState state = rectangle_of(objects, i);
        const double on_top = others.size() > 0 ? others[i] : 0.0;
        const bool adds = on_top >= 0.0 && costs.signature_cost >= 0.0;  // else a part may cost more than all
        if ((adds && matcher.depth_cost(state) >= least) || state[3] * state[4] < costs.min_area) continue;
        const bool* cut = objects.cut.row(i).data();
        double cost =
            matcher.cost(complete ? complete_rectangle(state, cut, expected.state, expected.size) : state);
        if (adds && cost >= least) continue;
        if (std::none_of(cut, cut + 4, [](bool each) { return each; }))
            cost += costs.signature_cost * signature_distance(objects, i, signature);
        cost += on_top;
        if (cost < least) {
            least = cost;
            best = i;
        }
    }
    return static_cast<int>(best);
}

}  // namespace tricue
