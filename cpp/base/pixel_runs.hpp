// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tricue {

/// Pixels [begin, end) of one row that have one label, not 0; `parent` is a run of the same component, never a later one.
struct Run {
    int row, begin, end;
    std::uint8_t label;
    std::size_t parent;

    int length() const { return end - begin; }
};

/// The runs of an image, in reading order, joined to components of one label (8 neighbours): what depth_components and
/// skin_blobs are made of. To join runs, not pixels, is the quickest way on a row of bytes.
class Runs {
public:
    explicit Runs(int cols);

    /// Takes the image's next row of `cols` labels, and joins its runs with those of the row before.
    void add_row(const std::uint8_t* labels);

    std::size_t size() const { return runs_.size(); }
    const Run& operator[](std::size_t i) const { return runs_[i]; }

    /// The first run of a run's component.
    std::size_t root(std::size_t i);

private:
    std::size_t find_edges(const std::uint8_t* labels);
    void join(std::size_t current);

    int cols_, row_ = 0;
    std::size_t above_ = 0;  ///< the first run of the row before
    std::vector<std::uint8_t> changes_;
    std::vector<int> edges_;
    std::vector<Run> runs_;
};

}  // namespace tricue
