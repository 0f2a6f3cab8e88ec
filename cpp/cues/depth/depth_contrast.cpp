// SPDX-License-Identifier: MIT
// A rectangle is sampled on a grid: its columns and rows are found once, not for each sample. All depths are gathered before they
// are used, so that the loops over them are vectorized. Several rectangles are gathered together, because a vector that has just
// been written number by number can't be loaded yet.
#include "cues/depth/depth_contrast.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/check.hpp"
#include "base/depth_pixels.hpp"
#include "base/simd.hpp"
#include "cues/depth/detail/relative_histogram.hpp"

namespace tricue {
namespace {

using Offsets = std::vector<double>;

constexpr int kMaxSamples = 64;
constexpr int kBlock = 16;  // places, so that loops over them have no remainder
constexpr std::size_t kBatch =
    8;  // rectangles that take each step together: their samples and counts fit the L1 cache

/// The centers of n equal parts of [-1, 1].
Offsets part_centers(int n) {
    Offsets places;
    for (int i = 0; i < n; ++i) places.push_back((2 * i + 1) / static_cast<double>(n) - 1.0);
    return places;
}

std::size_t places_inside(const RectanglePattern& places) {
    return static_cast<std::size_t>(places.rows) * static_cast<std::size_t>(places.columns);
}

std::size_t places_around(const RectanglePattern& places) {
    return 4 * static_cast<std::size_t>(places.along);
}

/// Depths of the places in the image, inside a rectangle and then around it; each padded with zeros as RelativeHistogram needs it.
class DepthSamples {
public:
    explicit DepthSamples(const RectanglePattern& places)
        : inside_(RelativeHistogram::padded(places_inside(places))),
          depths_(inside_ + RelativeHistogram::padded(places_around(places))) {}

    float* inside() { return depths_.data(); }
    float* around() { return inside() + inside_; }
    std::size_t inside_size() const { return inside_; }
    std::size_t around_size() const { return depths_.size() - inside_; }

private:
    std::size_t inside_;
    std::vector<float> depths_;
};

struct ProjectedRectangle {
    double x, y, half_width, half_height, z;
};

ProjectedRectangle project(VectorRef camera, const double* state) {
    const double z = state[2], per_x = camera[0] / z, per_y = camera[1] / z;
    return {state[0] * per_x + (camera[2] + 0.5), state[1] * per_y + (camera[3] + 0.5),
            0.5 * (state[3] * per_x), 0.5 * (state[4] * per_y), z};
}

/// Pixels of places along one axis: floor(center + half u); -1 outside the image.
TRICUE_MULTIVERSION
void find_pixels(const double* __restrict offsets, std::ptrdiff_t n, double center, double half, double size,
                 std::int32_t* __restrict pixel) {
    for (std::ptrdiff_t first = 0; first < n; first += kBlock)
        for (std::ptrdiff_t i = 0; i < kBlock; ++i) {
            const double x = center + half * offsets[first + i];
            pixel[first + i] = static_cast<std::int32_t>((x >= 0.0) & (x < size) ? x : -1.0);
        }
}

/// Consecutive places in the image, along one axis.
struct Pixels {
    const std::int32_t *first, *last;

    const std::int32_t* begin() const { return first; }
    const std::int32_t* end() const { return last; }
};

/// Reads the depths of places on a line of pixels that are `step` apart. Returns the end of what is written.
TRICUE_INLINE float* read_line(const float* line, std::ptrdiff_t step, const Pixels& places, float* depths) {
    for (const std::int32_t pixel : places) *depths++ = line[pixel * step];
    return depths;
}

/// The places along one axis of a rectangle: those inside, its sides, and those along a side.
class Axis {
public:
    Axis(int inside, double margin, int along) : along_(part_centers(along)) {
        offsets_ = part_centers(inside);
        inside_ = offsets_.size();
        offsets_.insert(offsets_.end(), {-margin, margin});
        offsets_.insert(offsets_.end(), along_.begin(), along_.end());
        offsets_.resize((offsets_.size() + kBlock - 1) / kBlock * kBlock);
        pixel_.resize(offsets_.size());
    }

    void find(double center, double half, int size) {
        find_pixels(offsets_.data(), static_cast<std::ptrdiff_t>(offsets_.size()), center, half, size,
                    pixel_.data());
    }

    /// Whether all places are in the image: those of the sides are the outermost.
    bool is_inside() const { return (pixel_[inside_] >= 0) & (pixel_[inside_ + 1] >= 0); }

    Pixels inside() const { return part(0, inside_); }
    Pixels sides() const { return part(inside_, 2); }
    Pixels along() const { return part(inside_ + 2, along_.size()); }

private:
    /// Places ascend or descend, so those in the image are consecutive.
    Pixels part(std::size_t first, std::size_t n) const {
        Pixels pixels{pixel_.data() + first, pixel_.data() + first + n};
        if (is_inside()) return pixels;
        while (pixels.first != pixels.last && *pixels.first < 0) ++pixels.first;
        while (pixels.first != pixels.last && pixels.last[-1] < 0) --pixels.last;
        return pixels;
    }

    Offsets offsets_, along_;
    std::size_t inside_;
    std::vector<std::int32_t> pixel_;
};

/// Reads the depths of one rectangle after the other, inside and around it.
class GridReader {
public:
    GridReader(const DepthView& depth, const RectanglePattern& places)
        : depth_(depth),
          x_(places.columns, places.margin, places.along),
          y_(places.rows, places.margin, places.along) {}

    void read(const ProjectedRectangle& rectangle, DepthSamples& samples) {
        x_.find(rectangle.x, rectangle.half_width, depth_.cols);
        y_.find(rectangle.y, rectangle.half_height, depth_.rows);
        const Pixels columns = x_.inside(), across = x_.along(), down = y_.along();
        float *inside = samples.inside(), *around = samples.around();
        for (const std::int32_t row : y_.inside()) inside = read_line(depth_.row(row), 1, columns, inside);
        for (const std::int32_t row : y_.sides()) around = read_line(depth_.row(row), 1, across, around);
        for (const std::int32_t column : x_.sides())
            around = read_line(depth_.data + column, depth_.stride, down, around);
        std::fill(inside, samples.around(), 0.0f);
        std::fill(around, samples.around() + samples.around_size(), 0.0f);
    }

private:
    DepthView depth_;
    Axis x_, y_;
};

void require_states(StatesRef states) {
    require_shape(states, states.rows(), 5, "states");
    require_finite(states, "states");
    for (Eigen::Index i = 0; i < states.rows(); ++i)
        if (!(states(i, 2) > 0.0)) refuse("states", "Z above 0", states(i, 2));
}

void require_arguments(VectorRef camera, const ReferenceHistogram& model, const RectanglePattern& places,
                       double occluder_margin) {
    require_camera(camera);
    require_count(places.rows, 1, kMaxSamples, "rows");
    require_count(places.columns, 1, kMaxSamples, "columns");
    require_count(places.along, 1, kMaxSamples, "along");
    if (!(places.margin >= 1.0 && std::isfinite(places.margin)))
        refuse("margin", "a finite number of at least 1", places.margin);
    require_model(model.histogram);
    require_occluder_margin(occluder_margin);
}

}  // namespace

struct RectangleContrast::Parts {
    GridReader reader;
    VectorRef camera;
    ReferenceHistogram model;
    double occluder_margin, inside, around;  ///< meters, and numbers of places
    std::vector<DepthSamples> samples;
    std::vector<RelativeHistogram> histograms;
};

RectangleContrast::RectangleContrast(const DepthView& depth, VectorRef camera,
                                     const ReferenceHistogram& model, const RectanglePattern& places,
                                     double occluder_margin) {
    require_arguments(camera, model, places, occluder_margin);
    const std::size_t inside = places_inside(places), around = places_around(places);
    const DepthSamples samples(places);
    const RelativeHistogram histogram(model.histogram.size(), model.reach, inside);
    parts_.reset(new Parts{GridReader(depth, places), camera, model, occluder_margin,
                           static_cast<double>(inside), static_cast<double>(around),
                           std::vector<DepthSamples>(kBatch, samples),
                           std::vector<RelativeHistogram>(kBatch, histogram)});
}

RectangleContrast::~RectangleContrast() = default;

States RectangleContrast::measure(StatesRef states, bool with_nearer) {
    require_states(states);
    auto& [reader, camera, model, occluder_margin, inside, around, samples, histograms] = *parts_;
    States measured(states.rows(), 4);
    for (Eigen::Index first = 0; first < states.rows(); first += Eigen::Index{kBatch}) {
        const auto n = std::min(kBatch, static_cast<std::size_t>(states.rows() - first));
        const double* state = states.row(first).data();
        for (std::size_t i = 0; i < n; ++i) reader.read(project(camera, state + 5 * i), samples[i]);
        for (std::size_t i = 0; i < n; ++i) histograms[i].read(samples[i].inside(), state[5 * i + 2]);
        for (std::size_t i = 0; i + 1 < n; i += 2) histograms[i].count_beside(histograms[i + 1]);
        if (n % 2 == 1) histograms[n - 1].count();
        std::array<double, kBatch> squares{}, totals{}, distances{};
        for (std::size_t i = 0; i < n; ++i) {
            histograms[i].finish();
            squares[i] = histograms[i].squared_differences(model.histogram);
            totals[i] = histograms[i].total();
        }
        find_distances(squares.data(), totals.data(), kBatch, distances.data());
        for (std::size_t i = 0; i < n; ++i) {
            const float *within = samples[i].inside(), *beside = samples[i].around();
            const double z = state[5 * i + 2];
            double* to = measured.row(first + static_cast<Eigen::Index>(i)).data();
            to[0] = distances[i];
            to[1] = totals[i] / inside;
            to[2] = with_nearer ? count_below(within, samples[i].inside_size(), z - occluder_margin) / inside
                                : 0.0;
            to[3] = count_within(beside, samples[i].around_size(), z, model.reach) / around;
        }
    }
    return measured;
}

Vector RectangleContrast::shares() const {
    return parts_->histograms.front().shares();
}

States depth_contrast(const DepthView& depth, VectorRef camera, StatesRef states,
                      const ReferenceHistogram& model, const RectanglePattern& places,
                      double occluder_margin) {
    require_states(states);
    return RectangleContrast(depth, camera, model, places, occluder_margin).measure(states, true);
}

Vector depth_shares(const DepthView& depth, VectorRef camera, const double* state,
                    const RectanglePattern& places, double z, double reach, Eigen::Index levels) {
    DepthSamples samples(places);
    GridReader(depth, places).read(project(camera, state), samples);
    RelativeHistogram histogram(levels, reach, places_inside(places));
    histogram.count(samples.inside(), z);
    return histogram.shares();
}

}  // namespace tricue
