// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tricue {

/// Marks, from a row's second pixel on, the pixels whose label differs from that of the previous pixel. Returns whether any does.
bool mark_changes(const std::uint8_t* labels, int n, std::uint8_t* changes);

/// Pixels [begin, end) of one row with the same label, not 0. `parent` is an earlier run of the same component, or the run itself.
struct PixelRun {
    int row, begin, end;
    std::uint8_t label;
    std::size_t parent;

    int length() const { return end - begin; }
};

/// Connected components of equal labels (8 neighbors), found from the runs of an image in reading order by union-find. Joining runs
/// is faster than joining pixels.
class PixelRuns {
public:
    explicit PixelRuns(int cols);

    /// Adds the next row of `cols` labels and joins its runs with those of the previous row.
    void add_row(const std::uint8_t* labels);

    /// The same, run by run from left to right: add() each run of a row, then end_row().
    void add(int begin, int end, std::uint8_t label) {
        // In place: copying numbers that have just been written takes longer than everything else, as stores can't be forwarded.
        const std::size_t parent = runs_.size();
        PixelRun& run = runs_.emplace_back();
        run.row = row_;
        run.begin = begin;
        run.end = end;
        run.label = label;
        run.parent = parent;
    }
    void end_row();

    std::size_t size() const { return runs_.size(); }
    const PixelRun& operator[](std::size_t i) const { return runs_[i]; }

    /// The first run of a run's component.
    std::size_t root(std::size_t i);

    /// Makes the first run of its component the parent of every run.
    void flatten();

private:
    std::size_t find_edges(const std::uint8_t* labels);
    void join_with_previous_row();

    int cols_, row_ = 0;
    std::size_t previous_row_ = 0, current_row_ = 0;  ///< indices of the first runs of two rows
    std::vector<std::uint8_t> changes_;
    std::vector<int> edges_;
    std::vector<PixelRun> runs_;
};

}  // namespace tricue
