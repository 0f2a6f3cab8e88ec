// SPDX-License-Identifier: MIT
// A rectangle is sampled on a grid: its columns and rows are found once, not for each sample. All depths are gathered before they are
// used, so that the loops over them are vectorized.
#include "cues/depth/depth_contrast.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "base/check.hpp"
#include "base/depth_pixels.hpp"
#include "cues/depth/detail/relative_histogram.hpp"

namespace tricue {
namespace {

using Offsets = std::vector<double>;

constexpr int kMaxSamples = 64;
constexpr std::ptrdiff_t kOutside = -1;

/// The centers of n equal parts of [-1, 1].
Offsets part_centers(int n) {
    Offsets places;
    for (int i = 0; i < n; ++i) places.push_back((2 * i + 1) / static_cast<double>(n) - 1.0);
    return places;
}

/// Depths, 0 outside the image.
struct DepthSamples {
    std::vector<float> inside, around;
};

struct Rectangle {
    double x, y, half_width, half_height, z;
};

Rectangle project(VectorRef camera, const double* state) {
    const double z = state[2], per_x = camera[0] / z, per_y = camera[1] / z;
    return {state[0] * per_x + (camera[2] + 0.5), state[1] * per_y + (camera[3] + 0.5),
            0.5 * (state[3] * per_x), 0.5 * (state[4] * per_y), z};
}

/// Pixels along one axis: floor(center + half u), kOutside where the image has none.
void find_pixels(const Offsets& offsets, double center, double half, int size, std::ptrdiff_t* pixels) {
    for (const double u : offsets) {
        const double x = center + half * u;
        *pixels++ = (x >= 0.0) & (x < size) ? static_cast<std::ptrdiff_t>(x) : kOutside;
    }
}

/// Reads the depths of one rectangle after the other, inside and round it.
class GridReader {
public:
    GridReader(const DepthView& depth, const Places& places)
        : depth_(depth),
          across_(part_centers(places.columns)),
          down_(part_centers(places.rows)),
          along_(part_centers(places.along)),
          sides_{-places.margin, places.margin},
          column_(kMaxSamples),
          row_(kMaxSamples),
          samples_{std::vector<float>(across_.size() * down_.size()), std::vector<float>(4 * along_.size())} {
    }

    std::size_t inside() const { return samples_.inside.size(); }  ///< samples

    const DepthSamples& read(const Rectangle& rectangle) {
        read_grid(rectangle, across_, down_, samples_.inside.data());
        read_grid(rectangle, sides_, along_, samples_.around.data());
        read_grid(rectangle, along_, sides_, samples_.around.data() + samples_.around.size() / 2);
        return samples_;
    }

private:
    void read_grid(const Rectangle& rectangle, const Offsets& across, const Offsets& down, float* samples) {
        find_pixels(across, rectangle.x, rectangle.half_width, depth_.cols, column_.data());
        find_pixels(down, rectangle.y, rectangle.half_height, depth_.rows, row_.data());
        for (std::size_t v = 0; v < down.size(); ++v) {
            if (row_[v] == kOutside) {
                samples = std::fill_n(samples, across.size(), 0.0f);
                continue;
            }
            const float* from = depth_.data + row_[v] * depth_.stride;
            for (std::size_t u = 0; u < across.size(); ++u)
                *samples++ = column_[u] == kOutside ? 0.0f : from[column_[u]];
        }
    }

    DepthView depth_;
    Offsets across_, down_, along_, sides_;
    std::vector<std::ptrdiff_t> column_, row_;
    DepthSamples samples_;
};

void require_count(int count, const char* name) {
    if (count < 1 || count > kMaxSamples) refuse(name, "1 to " + std::to_string(kMaxSamples), count);
}

void require_arguments(VectorRef camera, StatesRef states, const DepthModel& model, const Places& places,
                       double nearer) {
    require_camera(camera);
    require_shape(states, states.rows(), 5, "states");
    require_finite(states, "states");
    for (Eigen::Index i = 0; i < states.rows(); ++i)
        if (!(states(i, 2) > 0.0)) refuse("states", "Z above 0", states(i, 2));
    require_count(places.rows, "rows");
    require_count(places.columns, "columns");
    require_count(places.along, "along");
    if (!(places.margin >= 1.0 && std::isfinite(places.margin)))
        refuse("margin", "a finite number of at least 1", places.margin);
    require_model(model.histogram);
    require_nearer(nearer);
}

}  // namespace

States depth_contrast(const DepthView& depth, VectorRef camera, StatesRef states, const DepthModel& model,
                      const Places& places, double nearer) {
    require_arguments(camera, states, model, places, nearer);
    GridReader reader(depth, places);
    RelativeHistogram histogram(model.histogram.size(), model.reach, reader.inside());
    States measured(states.rows(), 4);
    for (Eigen::Index i = 0; i < states.rows(); ++i) {
        const Rectangle rectangle = project(camera, states.row(i).data());
        const auto& [inside, around] = reader.read(rectangle);
        const auto inner = static_cast<double>(inside.size()), outer = static_cast<double>(around.size());
        histogram.count(inside.data(), rectangle.z);
        measured.row(i) << histogram.distance(model.histogram), histogram.total() / inner,
            count_below(inside.data(), inside.size(), rectangle.z - nearer) / inner,
            count_within(around.data(), around.size(), rectangle.z, model.reach) / outer;
    }
    return measured;
}

}  // namespace tricue
