# SPDX-License-Identifier: MIT
"""Run the commands in docs/experiments.md, and replace the tables below each by its output.

If several commands are above one table, the last one counts.

python tools/experiment_tables.py [--jobs N] [NAME ...]      all experiments, or those with these names
"""

import argparse
import re
import shlex
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).parents[1]
PAGE = ROOT / "docs" / "experiments.md"
RESULTS = ROOT / "build" / "results"
COMMAND = re.compile(r"^tricue reproduce (?P<arguments>(?P<name>\S+).*)$", re.MULTILINE)
TABLE = re.compile(r"(?:^\|.*\n)+", re.MULTILINE)


def measure(arguments: str, jobs: int) -> list[str]:
    """The tables that the command prints."""
    words = shlex.split(arguments, comments=True)
    command = [sys.executable, "-m", "tricue", "reproduce", *words, "--jobs", str(jobs)]
    printed = subprocess.run(
        [*command, "--output", str(RESULTS)], check=True, stdout=subprocess.PIPE, text=True, cwd=ROOT
    ).stdout
    found = TABLE.findall(printed)
    if not found:
        raise SystemExit(f"tricue reproduce {arguments}: expected a table, got\n{printed}")
    return list(found)


def renewed(text: str, names: list[str], jobs: int) -> Iterator[str]:
    """The page's text after each experiment."""
    for command in commands(text):
        if names and command["name"] not in names:
            continue
        place = text.index(command.group())
        for table in measure(command["arguments"], jobs):
            old = TABLE.search(text, place)
            if old is None:
                raise SystemExit(f"{PAGE.name}: expected a table after {command.group()}")
            text = text[: old.start()] + table + text[old.end() :]
            place = old.start() + len(table)
        yield text


def commands(text: str) -> list["re.Match[str]"]:
    """The last command before each table."""
    found = list(COMMAND.finditer(text))
    ends = [*(each.start() for each in found[1:]), len(text)]
    return [each for each, end in zip(found, ends, strict=True) if TABLE.search(text, each.end(), end)]


def main() -> None:
    """Rewrite the page after each experiment."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="NAME")
    parser.add_argument("--jobs", type=int, default=1)
    options = parser.parse_args()
    for text in renewed(PAGE.read_text(encoding="utf-8"), options.names, options.jobs):
        PAGE.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
