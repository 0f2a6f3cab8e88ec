// SPDX-License-Identifier: MIT
#include "cues/color/learn_patch_colors.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "base/check.hpp"
#include "base/color_cells.hpp"
#include "cues/color/detail/learn_histograms.hpp"

namespace tricue {
namespace {

/// Distances of pixels' centers from the middle of an axis, in halves of the box.
std::vector<double> find_distances(int size, double length) {
    std::vector<double> distances(static_cast<std::size_t>(size));
    const double half = std::max(length / 2, 1.0);
    for (int i = 0; i < size; ++i)
        distances[static_cast<std::size_t>(i)] = std::abs(i + 0.5 - size / 2.0) / half;
    return distances;
}

/// Pixels [first, end) of a row.
struct Run {
    int first, end;
};

/// The part of a row around its middle; distances from the middle grow in both directions.
template <typename IsInside>
Run find_middle(int size, const IsInside& is_inside) {
    int first = 0;
    while (first < (size + 1) / 2 && !is_inside(first)) ++first;
    return first < (size + 1) / 2 ? Run{first, size - first} : Run{0, 0};
}

/// Counts pixels as the target's or the surround's.
class PixelCounts {
public:
    PixelCounts(const ImageView& patch, const PlaneView& other, const LearnedPixels& pixels, int bits)
        : patch_(patch), other_(other), bits_(bits), own(bits), around(bits) {
        const std::vector<double> across = find_distances(patch.cols, pixels.width),
                                  down = find_distances(patch.rows, pixels.height);
        for (int y = 0; y < patch.rows; ++y) {
            const double v = down[static_cast<std::size_t>(y)];
            const auto u = [&](int x) { return across[static_cast<std::size_t>(x)]; };
            ellipse_.push_back(find_middle(patch.cols, [&](int x) { return u(x) * u(x) + v * v <= 1.0; }));
            box_.push_back(find_middle(patch.cols,
                                       [&](int x) { return std::max(u(x), v) <= pixels.min_surround_size; }));
        }
        count(pixels);
    }

private:
    const ImageView& patch_;
    const PlaneView& other_;
    int bits_;
    std::vector<Run> ellipse_, box_;  ///< of each row

    void count(const LearnedPixels& pixels) {
        count_around(box_);
        if (around.pixels == 0) count_around(ellipse_);
        if (!is_seen(pixels)) {
            for_ellipse([&](int y, int x) { add(own, y, x); });
            return;
        }
        for_ellipse([&](int y, int x) {
            const float share = other_.row(y)[x];
            if (share > static_cast<float>(pixels.min_target_posterior)) add(own, y, x);
            if (share < static_cast<float>(pixels.max_surround_posterior)) add(around, y, x);
        });
    }

    /// Whether, by another cue, more than half of the ellipse's pixels are the target's.
    bool is_seen(const LearnedPixels& pixels) const {
        if (other_.rows == 0) return false;
        std::ptrdiff_t all = 0, seen = 0;
        for_ellipse([&](int y, int x) {
            ++all;
            seen += other_.row(y)[x] > static_cast<float>(pixels.min_target_posterior);
        });
        return 2 * seen > all;
    }

    void count_around(const std::vector<Run>& runs) {
        for (int y = 0; y < patch_.rows; ++y) {
            const Run run = runs[static_cast<std::size_t>(y)];
            for (int x = 0; x < run.first; ++x) add(around, y, x);
            for (int x = run.end; x < patch_.cols; ++x) add(around, y, x);
        }
    }

    template <typename Use>
    void for_ellipse(const Use& use) const {
        for (int y = 0; y < patch_.rows; ++y)
            for (int x = ellipse_[static_cast<std::size_t>(y)].first;
                 x < ellipse_[static_cast<std::size_t>(y)].end; ++x)
                use(y, x);
    }

    void add(ColorCounts& counts, int y, int x) { counts.add(patch_.row(y) + 3 * std::ptrdiff_t{x}, bits_); }

public:
    ColorCounts own, around;
};

void require_arguments(const ImageView& patch, const PlaneView& other, const LearnedPixels& pixels) {
    if (other.rows > 0 && (other.rows != patch.rows || other.cols != patch.cols))
        refuse("other", "the patch's rows and columns",
               std::to_string(other.rows) + ", " + std::to_string(other.cols));
    for (const auto& [name, number] : {std::pair{"width", pixels.width}, {"height", pixels.height}})
        require_not_negative(number, name);
    if (!(pixels.min_surround_size >= 1.0 && std::isfinite(pixels.min_surround_size)))
        refuse("min_surround_size", "a finite number, at least 1", pixels.min_surround_size);
    for (const auto& [name, number] : {std::pair{"min_target_posterior", pixels.min_target_posterior},
                                       {"max_surround_posterior", pixels.max_surround_posterior}})
        if (!(number >= 0.0 && number <= 1.0)) refuse(name, "a number in [0, 1]", number);
}

constexpr double kUnseen = 0.5;  // P(target) of a color that neither target nor surround has

}  // namespace

ColorContrast learn_patch_colors(const ImageView& patch, const PlaneView& other, const LearnedPixels& pixels,
                                 FloatsRef target, FloatsRef surround, double rate, double rare) {
    require_arguments(patch, other, pixels);
    require_histograms(target, surround, rate, rare);
    const PixelCounts counts(patch, other, pixels, bits_of_cube(target, "target"));
    return learn_histograms(counts.own.shares(target.rows()), counts.around.shares(target.rows()), target,
                            surround, rate, rare, kUnseen);
}

}  // namespace tricue
