# SPDX-License-Identifier: MIT
"""A release's notes: its section of CHANGELOG.md.

    python tools/release_notes.py v0.2.0

Unless the tag, pyproject.toml and the changelog have the same version, it prints why, and the exit code is 1.
"""

import argparse
import re
import sys
from pathlib import Path

ROOT = Path(__file__).parents[1]


def notes(tag: str, project: str, changelog: str) -> str:
    """The changelog's section for a tag such as v0.2.0; ValueError says which versions differ."""
    if not re.fullmatch(r"v\d+\.\d+\.\d+", tag):
        raise ValueError(f"expected a tag like v0.2.0, got {tag}")
    version = tag.removeprefix("v")
    written = re.search(r'^version = "(.+)"$', project, re.MULTILINE)
    if written is None or written[1] != version:
        raise ValueError(f"pyproject.toml: expected version {version}, got {written and written[1]}")
    sections = re.split(r"^## (.+)\n", changelog, flags=re.MULTILINE)
    texts = dict(zip(sections[1::2], sections[2::2], strict=True))
    if not texts.get(version, "").strip():
        raise ValueError(f"CHANGELOG.md: expected a section ## {version}, got {', '.join(texts)}")
    if texts.get("Unreleased", "").strip():
        raise ValueError(
            f"CHANGELOG.md: what is under ## Unreleased belongs to {version}, or to no release yet"
        )
    return texts[version].strip() + "\n"


def main() -> None:
    """Print the notes for the given tag."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("tag", help="such as v0.2.0")
    tag = parser.parse_args().tag
    try:
        files = [(ROOT / name).read_text(encoding="utf-8") for name in ("pyproject.toml", "CHANGELOG.md")]
        print(notes(tag, *files), end="")
    except ValueError as error:
        sys.exit(f"release notes: {error}")


if __name__ == "__main__":
    main()
