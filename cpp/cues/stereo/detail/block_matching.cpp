// SPDX-License-Identifier: MIT
// A register holds neighboring pixels, and the loop runs over the candidates: a search range of any length uses the full width, and a
// pixel's best and second best costs stay in registers.
#include "cues/stereo/detail/block_matching.hpp"

#include <type_traits>

#include "base/simd.hpp"

namespace tricue {
namespace {

/// Whole registers first, then the remainder with half as many lanes, down to the fewest.
template <int N, typename Body>
TRICUE_INLINE void in_lanes(int x, int n, const Body& body) {
    constexpr bool kFewest = N == 8;  // a register of 16 bytes
    for (; n - x > (kFewest ? 0 : N / 2); x += N) body(std::integral_constant<int, N>{}, x);
    if constexpr (!kFewest) in_lanes<N / 2>(x, n, body);
}

template <int N>
TRICUE_INLINE void read_cost(const std::uint8_t* from, const std::uint8_t* other, std::uint8_t limit,
                             Pack<std::uint8_t, N>& cost) {
    const auto most = Pack<std::uint8_t, N>{} + limit;
    Pack<std::uint8_t, N> left, right;
    load(from, left);
    load(other, right);
    cost = (left > right ? left : right) - (left > right ? right : left);
    cost = cost < most ? cost : most;
}

template <int kBytes>
TRICUE_INLINE void move_by(const RowPair& in, const RowPair& out, int n, std::uint8_t limit,
                           const ColumnSums& sums) {
    const std::uint8_t *left = in.left, *old_left = out.left;  // locals, so that stores don't force reloading
    for (int k = 0; k < sums.candidates; ++k) {
        const std::uint8_t *right = in.right - k, *old_right = out.right - k;
        std::uint16_t* row = sums.data + k * sums.stride;
        in_lanes<kBytes / 2>(0, n, [=](auto lanes, int x) {
            Pack<std::uint8_t, lanes> added, removed;
            Pack<std::uint16_t, lanes> more, less, sum;
            read_cost<lanes>(left + x, right + x, limit, added);
            read_cost<lanes>(old_left + x, old_right + x, limit, removed);
            convert(added, more);
            convert(removed, less);
            load(row + x, sum);
            sum += more - less;
            store(sum, row + x);
        });
    }
}

/// The variants for which find_block is compiled. kWindow 0: the window is known only at run time.
template <int kWindow_, bool kOutside_, bool kSecond_>
struct Case {
    static constexpr int kWindow = kWindow_;
    static constexpr bool kOutside = kOutside_, kSecond = kSecond_;
};

template <int N, typename Case>
TRICUE_INLINE void find_block(const ColumnSums& sums, const Search& search, const Matches& matches, int x) {
    using Words = Pack<std::uint16_t, N>;
    const int window = Case::kWindow ? Case::kWindow : search.window;
    const std::uint16_t *row = sums.data + x, *outside = search.outside + x;
    const Words none = Words{} + kNoCost;
    Words best = none, below = none, above = none, second = none, at = {}, k = {};
    Words before = none, last = none;  // the previous candidate's cost and number
    Words earlier = none;              // the least cost of all candidates before that one
    for (int candidate = 0; candidate < sums.candidates; ++candidate, row += sums.stride) {
        Words cost, term;
        load(row, cost);
        for (int column = 1; column < window; ++column) {
            load(row + column, term);
            cost += term;
        }
        if (Case::kOutside) {
            load(outside - candidate, term);
            cost |= term;
        }
        const Words least = cost < best ? cost : best;
        const auto better = least != best;
        const auto next = at == last;
        if (Case::kSecond) {
            const Words others = cost < second ? cost : second;
            second = better ? earlier : (next ? second : others);
            earlier = best;
        }
        above = next ? cost : above;
        below = better ? before : below;
        at = better ? k : at;
        best = least;
        before = cost;
        last = k;
        k += 1;
    }
    store(best, matches.best + x);
    store(at, matches.at + x);
    store(below, matches.below + x);
    store(above, matches.above + x);
    store(second, matches.second + x);
}

template <int N, typename Case>
TRICUE_INLINE void find_row(const ColumnSums& sums, const Search& search, int n, const Matches& matches) {
    in_lanes<N>(0, n, [&](auto lanes, int x) { find_block<lanes, Case>(sums, search, matches, x); });
}

template <int N, bool kOutside, bool kSecond>
TRICUE_INLINE void find_window(const ColumnSums& sums, const Search& search, int n, const Matches& matches) {
    if (search.window == 5) return find_row<N, Case<5, kOutside, kSecond>>(sums, search, n, matches);
    if (search.window == 7) return find_row<N, Case<7, kOutside, kSecond>>(sums, search, n, matches);
    if (search.window == 9) return find_row<N, Case<9, kOutside, kSecond>>(sums, search, n, matches);
    find_row<N, Case<0, kOutside, kSecond>>(sums, search, n, matches);
}

template <int kBytes>
TRICUE_INLINE void find_by(const ColumnSums& sums, const Search& search, int n, const Matches& matches) {
    if (search.all_inside && search.second)
        return find_window<kBytes / 2, false, true>(sums, search, n, matches);
    if (search.all_inside) return find_window<kBytes / 2, false, false>(sums, search, n, matches);
    find_window<kBytes / 2, true, true>(sums, search, n, matches);
}

TRICUE_MULTIWIDTH(move, move_by,
                  (const RowPair& in, const RowPair& out, int n, std::uint8_t limit, const ColumnSums& sums),
                  (in, out, n, limit, sums))
TRICUE_MULTIWIDTH(find, find_by,
                  (const ColumnSums& sums, const Search& search, int n, const Matches& matches),
                  (sums, search, n, matches))

}  // namespace

void move_down(const RowPair& in, const RowPair& out, int n, std::uint8_t limit, const ColumnSums& sums) {
    move(in, out, n, limit, sums);
}

void find_matches(const ColumnSums& sums, const Search& search, int n, const Matches& matches) {
    find(sums, search, n, matches);
}

}  // namespace tricue
