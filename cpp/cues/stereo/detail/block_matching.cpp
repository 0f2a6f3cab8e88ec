// SPDX-License-Identifier: MIT
// One register holds as many neighbouring pixels as it can, and the candidates are gone through one after the other: so
// a search range of any length is done at full width, and a pixel's best, second best and so on stay in registers.
#include "cues/stereo/detail/block_matching.hpp"

#include <type_traits>

#include "base/lanes.hpp"

namespace tricue {
namespace {

/// What is left after whole registers is done with half as many lanes, down to the fewest.
template <int N, typename Body>
[[gnu::always_inline]] inline void in_lanes(int x, int n, const Body& body) {
    constexpr bool kFewest = N == kLanes128;
    for (; n - x > (kFewest ? 0 : N / 2); x += N) body(std::integral_constant<int, N>{}, x);
    if constexpr (!kFewest) in_lanes<N / 2>(x, n, body);
}

template <int N>
[[gnu::always_inline]] inline void read_cost(const std::uint8_t* from, const std::uint8_t* other,
                                             std::uint8_t limit, typename Lanes<N>::Bytes& cost) {
    const auto most = typename Lanes<N>::Bytes{} + limit;
    typename Lanes<N>::Bytes left, right;
    read(from, left);
    read(other, right);
    cost = (left > right ? left : right) - (left > right ? right : left);
    cost = cost < most ? cost : most;
}

template <int N>
[[gnu::always_inline]] inline void move_by(const RowPair& in, const RowPair& out, int n, std::uint8_t limit,
                                           const ColumnSums& sums) {
    const std::uint8_t *left = in.left, *old_left = out.left;  // nothing that is written may be one of these
    for (int k = 0; k < sums.candidates; ++k) {
        const std::uint8_t *right = in.right - k, *old_right = out.right - k;
        std::uint16_t* row = sums.data + k * sums.stride;
        in_lanes<N>(0, n, [=](auto lanes, int x) {
            typename Lanes<lanes>::Bytes added, removed;
            typename Lanes<lanes>::Words sum;
            read_cost<lanes>(left + x, right + x, limit, added);
            read_cost<lanes>(old_left + x, old_right + x, limit, removed);
            read(row + x, sum);
            sum += __builtin_convertvector(added, typename Lanes<lanes>::Words) -
                   __builtin_convertvector(removed, typename Lanes<lanes>::Words);
            write(sum, row + x);
        });
    }
}

/// What find_block is compiled for. kWindow 0: known only at run time.
template <int kWindow_, bool kOutside_, bool kSecond_>
struct Case {
    static constexpr int kWindow = kWindow_;
    static constexpr bool kOutside = kOutside_, kSecond = kSecond_;
};

template <int N, typename Case>
[[gnu::always_inline]] inline void find_block(const ColumnSums& sums, const Search& search,
                                              const Matches& matches, int x) {
    using Words = typename Lanes<N>::Words;
    const int window = Case::kWindow ? Case::kWindow : search.window;
    const std::uint16_t *row = sums.data + x, *outside = search.outside + x;
    const Words none = Words{} + kNoCost;
    Words best = none, below = none, above = none, second = none, at = {}, k = {};
    Words before = none, last = none;  // the cost of the candidate before, and its number
    Words earlier = none;              // the least cost of all before that one
    for (int candidate = 0; candidate < sums.candidates; ++candidate, row += sums.stride) {
        Words cost, term;
        read(row, cost);
        for (int column = 1; column < window; ++column) {
            read(row + column, term);
            cost += term;
        }
        if (Case::kOutside) {
            read(outside - candidate, term);
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
    write(best, matches.best + x);
    write(at, matches.at + x);
    write(below, matches.below + x);
    write(above, matches.above + x);
    write(second, matches.second + x);
}

template <int N, typename Case>
[[gnu::always_inline]] inline void find_row(const ColumnSums& sums, const Search& search, int n,
                                            const Matches& matches) {
    in_lanes<N>(0, n, [&](auto lanes, int x) { find_block<lanes, Case>(sums, search, matches, x); });
}

template <int N, bool kOutside, bool kSecond>
[[gnu::always_inline]] inline void find_window(const ColumnSums& sums, const Search& search, int n,
                                               const Matches& matches) {
    if (search.window == 5) return find_row<N, Case<5, kOutside, kSecond>>(sums, search, n, matches);
    if (search.window == 7) return find_row<N, Case<7, kOutside, kSecond>>(sums, search, n, matches);
    if (search.window == 9) return find_row<N, Case<9, kOutside, kSecond>>(sums, search, n, matches);
    find_row<N, Case<0, kOutside, kSecond>>(sums, search, n, matches);
}

template <int N>
[[gnu::always_inline]] inline void find_by(const ColumnSums& sums, const Search& search, int n,
                                           const Matches& matches) {
    if (search.all_inside && search.second) return find_window<N, false, true>(sums, search, n, matches);
    if (search.all_inside) return find_window<N, false, false>(sums, search, n, matches);
    find_window<N, true, true>(sums, search, n, matches);
}

TRICUE_VERSION("default")
void move(const RowPair& in, const RowPair& out, int n, std::uint8_t limit, const ColumnSums& sums) {
    move_by<kLanes128>(in, out, n, limit, sums);
}

TRICUE_VERSION("default")
void find(const ColumnSums& sums, const Search& search, int n, const Matches& matches) {
    find_by<kLanes128>(sums, search, n, matches);
}

#ifdef TRICUE_VERSIONS
TRICUE_VERSION("arch=x86-64-v3")
void move(const RowPair& in, const RowPair& out, int n, std::uint8_t limit, const ColumnSums& sums) {
    move_by<kLanes256>(in, out, n, limit, sums);
}

TRICUE_VERSION("arch=x86-64-v3")
void find(const ColumnSums& sums, const Search& search, int n, const Matches& matches) {
    find_by<kLanes256>(sums, search, n, matches);
}

TRICUE_VERSION("arch=x86-64-v4")
void move(const RowPair& in, const RowPair& out, int n, std::uint8_t limit, const ColumnSums& sums) {
    move_by<kLanes512>(in, out, n, limit, sums);
}

TRICUE_VERSION("arch=x86-64-v4")
void find(const ColumnSums& sums, const Search& search, int n, const Matches& matches) {
    find_by<kLanes512>(sums, search, n, matches);
}
#endif

}  // namespace

void move_down(const RowPair& in, const RowPair& out, int n, std::uint8_t limit, const ColumnSums& sums) {
    move(in, out, n, limit, sums);
}

void find_matches(const ColumnSums& sums, const Search& search, int n, const Matches& matches) {
    find(sums, search, n, matches);
}

}  // namespace tricue
