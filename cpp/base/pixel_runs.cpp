// SPDX-License-Identifier: MIT
#include "base/pixel_runs.hpp"

#include <algorithm>

#include "base/marked_words.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

constexpr std::size_t kReservedRuns = 2048;  // runs for which memory is reserved at once

}  // namespace

TRICUE_MULTIVERSION
bool mark_changes(const std::uint8_t* __restrict labels, int n, std::uint8_t* __restrict changes) {
    std::uint8_t any = 0;
    for (int x = 1; x < n; ++x) any |= changes[x] = labels[x] != labels[x - 1];
    return any != 0;
}

PixelRuns::PixelRuns(int cols) : cols_(cols), changes_(whole_words(cols)), edges_(changes_.size() + 1) {
    runs_.reserve(kReservedRuns);
}

/// The places where one run ends and the next begins. Each pixel near a change is written, and overwritten by the next one unless a
/// run ends there, because a branch would be mispredicted.
std::size_t PixelRuns::find_edges(const std::uint8_t* labels) {
    mark_changes(labels, cols_, changes_.data());
    std::size_t count = 0;
    for_marked_words(changes_, [&](std::size_t x) {
        edges_[count] = static_cast<int>(x);
        count += changes_[x];
    });
    edges_[count] = cols_;
    return count + 1;
}

void PixelRuns::add_row(const std::uint8_t* labels) {
    const std::size_t edges = find_edges(labels);
    int begin = 0;
    for (std::size_t i = 0; i < edges; begin = edges_[i++])
        if (begin < edges_[i] && labels[begin]) add(begin, edges_[i], labels[begin]);
    end_row();
}

void PixelRuns::end_row() {
    join_with_previous_row();
    previous_row_ = current_row_;
    current_row_ = runs_.size();
    ++row_;
}

void PixelRuns::join_with_previous_row() {
    std::size_t above = previous_row_;
    for (std::size_t c = current_row_; c < runs_.size(); ++c) {
        while (above < current_row_ && runs_[above].end < runs_[c].begin) ++above;
        for (std::size_t a = above; a < current_row_ && runs_[a].begin <= runs_[c].end; ++a) {
            if (runs_[a].label != runs_[c].label) continue;
            const auto [first, second] = std::minmax({root(a), root(c)});
            runs_[second].parent = first;
        }
    }
}

std::size_t PixelRuns::root(std::size_t i) {
    while (runs_[i].parent != i) i = runs_[i].parent = runs_[runs_[i].parent].parent;
    return i;
}

/// A parent comes before its children, so its own parent is already the first run.
void PixelRuns::flatten() {
    for (PixelRun& run : runs_) run.parent = runs_[run.parent].parent;
}

}  // namespace tricue
