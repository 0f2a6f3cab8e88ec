// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "base/arrays.hpp"
#include "base/image_view.hpp"

namespace tricue {

/// Samples an image at the places of a pattern under many ellipses. The image must outlive the sampler.
class EllipseSampler {
public:
    /// @throws std::invalid_argument on a pattern that isn't n x 2 or not finite, and on an image without pixels
    EllipseSampler(const ImageView& image, StatesRef pattern, const char* name);

    std::ptrdiff_t size() const { return u_.size(); }

    /// Writes the planes of blue, green and red, 3 x size(), of each ellipse, four finite numbers.
    void read(const double* ellipses, std::ptrdiff_t count, std::uint8_t* planes);

    /// How many ellipses are read at once.
    static constexpr std::ptrdiff_t kBatch = 8;

    /// The samples of at most kBatch ellipses as words, size() an ellipse, valid until the next call: the lowest byte is blue,
    /// then green, red, and an unused one.
    const std::uint32_t* read_words(const double* ellipses, std::ptrdiff_t count);

    /// Writes the planes of `count` ellipses' words.
    void split(const std::uint32_t* words, std::ptrdiff_t count, std::uint8_t* planes) const;

private:
    ImageView image_;
    std::int32_t last_word_;        ///< the offset of the last word that can be read
    std::uint8_t single_pixel_[4];  ///< an image of a single pixel, too short for a word
    Eigen::ArrayXf u_, v_;
    Eigen::Array<std::int32_t, Eigen::Dynamic, 1> offsets_;
    Eigen::Array<std::uint32_t, Eigen::Dynamic, 1> words_;
};

}  // namespace tricue
