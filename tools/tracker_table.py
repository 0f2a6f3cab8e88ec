# SPDX-License-Identifier: MIT
"""Write the tables of trackers in README.md and docs/trackers.md from their traits, or --check them."""

import sys
from pathlib import Path

from tricue.track.base import registry
from tricue.track.base.registry import traits
from tricue.track.base.traits import Channels, Traits

ROOT = Path(__file__).parents[1]
BEGIN, END = "<!-- from the trackers' traits: make stubs -->", "<!-- end -->"
CHANNELS = {
    frozenset({"color"}): "color",
    frozenset({"depth"}): "depth",
    frozenset({"color", "depth"}): "color and depth",
    frozenset({"color", "right"}): "a stereo pair",
}


def names() -> list[str]:
    """The names of tricue's own trackers; those of other packages may be installed, too."""
    return [name for name in registry.names() if registry.is_built_in(name)]


def overview() -> list[list[str]]:
    """The README's table: what each tracker needs and follows, and its paper."""
    rows = [[f"`{name}`", needs(traits(name)), traits(name).follows, traits(name).source] for name in names()]
    return [["tracker", "needs", "follows", "paper"], *rows]


def requirements() -> list[list[str]]:
    """The table of docs/trackers.md: what each tracker needs to start and to run."""
    rows = [[f"[`{name}`](#{name})", needs(traits(name)), *_start(traits(name))] for name in names()]
    return [["tracker", "needs", "initial box", "camera", "random"], *rows]


def needs(its: Traits) -> str:
    """A tracker's sets of channels in words, with the parameters that a set needs."""
    return "; ".join(_set(each) for each in its.channels)


def _set(channels: Channels) -> str:
    params = ", ".join(f"`{name}={value!r}`" for name, value in channels.params.items())
    return CHANNELS[channels.names] + (f" alone with {params}" if params else "")


def _start(its: Traits) -> list[str]:
    box = f"needed, or it finds a {its.detects}" if its.detects else "needed"
    camera = " or ".join(f"`{name}=`" for name in sorted(its.camera)) or "none"
    return [box, camera, "by its seed" if its.random else "no"]


def markdown(rows: list[list[str]]) -> str:
    """A Markdown table; its first row is the head."""
    head, *others = (f"| {' | '.join(row)} |" for row in rows)
    return "\n".join([head, "|" + " --- |" * len(rows[0]), *others])


PAGES = {ROOT / "README.md": overview, ROOT / "docs" / "trackers.md": requirements}


def updated(page: Path) -> str:
    """The page's text with its table updated."""
    before, _, rest = page.read_text(encoding="utf-8").partition(BEGIN)
    _, _, after = rest.partition(END)
    return f"{before}{BEGIN}\n\n{markdown(PAGES[page]())}\n\n{END}{after}"


def main() -> int:
    """Write the pages, or print which are out of date."""
    stale = [page for page in PAGES if updated(page) != page.read_text(encoding="utf-8")]
    for page in stale:
        if "--check" in sys.argv[1:]:
            print(f"{page.relative_to(ROOT)}: its table of trackers is out of date; make stubs")
        else:
            page.write_text(updated(page), encoding="utf-8")
    return int(bool(stale) and "--check" in sys.argv[1:])


if __name__ == "__main__":
    sys.exit(main())
