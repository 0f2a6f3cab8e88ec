# SPDX-License-Identifier: MIT
"""Checks that nothing is slower on newer processors: `make level-speeds`.

Reads what pytest-benchmark wrote for builds of tricue, each for one level of x86-64 and the lowest first,
and prints the shortest times of each kernel and tracker. Fails if one takes clearly longer at a level than
at the one before. So it finds loops that the compiler does badly at one width of registers, which no
benchmark on the newest processor shows.
"""

import itertools
import json
import sys
from pathlib import Path

LONGER = 1.3  # times that benchmarks of two builds in turn never differ by


def shortest_times(path: Path) -> dict[str, float]:
    """Microseconds of each benchmark."""
    benchmarks = json.loads(path.read_text())["benchmarks"]
    return {each["fullname"].split("::")[-1]: 1e6 * each["stats"]["min"] for each in benchmarks}


def slower(times: list[float]) -> bool:
    """Whether a level takes longer than the one before."""
    return any(later > LONGER * earlier for earlier, later in itertools.pairwise(times))


def main(paths: list[str]) -> int:
    """Prints the table; the exit code."""
    levels = [shortest_times(Path(path)) for path in paths]
    rows = {name: [level[name] for level in levels] for name in levels[0]}
    for name, times in rows.items():
        mark = " <- slower" if slower(times) else ""
        print(f"{name:60}" + "".join(f"{time:10.1f}" for time in times) + mark)
    found = sum(map(slower, rows.values()))
    print(f"{len(rows)} benchmarks of {len(paths)} builds in microseconds, {found} slower at a higher level")
    return int(found > 0 or not rows)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
