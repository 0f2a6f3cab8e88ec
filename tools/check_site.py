# SPDX-License-Identifier: MIT
"""Check a built site: all links and pictures lead to files and anchors in it, and nothing is fetched from
elsewhere.

python tools/check_site.py build/site
"""

import argparse
import sys
from collections.abc import Iterator
from functools import cache
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

LOADED = {("script", "src"), ("link", "href"), ("img", "src"), ("video", "src"), ("video", "poster")} | {
    ("source", "src"),
    ("iframe", "src"),
}
"""Tags and attributes whose addresses a browser fetches to show a page; others are links for the reader."""
NOT_FETCHED = {"canonical", "prev", "next", "index", "search", "genindex"}
"""Kinds of <link> that a browser doesn't fetch."""


class Page(HTMLParser):
    """The anchors of a page, and its addresses, each with whether the browser fetches it."""

    def __init__(self, file: Path) -> None:
        super().__init__()
        self.anchors: set[str] = set()
        self.addresses: list[tuple[str, bool]] = []
        self.feed(file.read_text(encoding="utf-8"))

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        values = dict(attrs)
        self.anchors |= {name for key in ("id", "name") if (name := values.get(key))}
        for key, value in attrs:
            if value and key in {"href", "src", "poster"}:
                fetched = (tag, key) in LOADED and values.get("rel") not in NOT_FETCHED
                self.addresses.append((value, fetched))


@cache
def read(file: Path) -> Page:
    """A page; cached."""
    return Page(file)


def faults(site: Path) -> Iterator[str]:
    """What is wrong, one line each."""
    for file in sorted(site.rglob("*.html")):
        for address, fetched in read(file).addresses:
            if fault := _fault(site, file, address, fetched):
                yield f"{file.relative_to(site)}: {address}: {fault}"


def _fault(site: Path, file: Path, address: str, fetched: bool) -> str:
    parts = urlsplit(address)
    if parts.scheme == "data" or (parts.scheme and not fetched):
        return ""
    if parts.scheme or parts.netloc:
        return "is fetched from elsewhere"
    target = (file.parent / unquote(parts.path)).resolve() if parts.path else file
    if not target.is_relative_to(site) or not target.is_file():
        return "no such file"
    anchor = unquote(parts.fragment)
    if anchor and target.suffix == ".html" and anchor not in read(target).anchors:
        return "no such anchor"
    return ""


def main() -> int:
    """Print what is wrong; the exit code is 1 if anything is."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("site", type=Path)
    site = parser.parse_args().site.resolve()
    if not (site / "index.html").is_file():
        parser.error(f"{site}: expected a built site with an index.html; make docs builds one")
    found = list(faults(site))
    print("\n".join(found) or f"{len(list(site.rglob('*.html')))} pages, all links lead somewhere")
    return int(bool(found))


if __name__ == "__main__":
    sys.exit(main())
