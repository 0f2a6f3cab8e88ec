# SPDX-License-Identifier: MIT
"""Runs the notebooks of docs/notebooks and writes them, with what they show, to build/notebooks.

    python tools/notebooks.py                # all
    python tools/notebooks.py compare        # by name

The exit code is 1 where one fails; its error is in what was written, too.
"""

import argparse
import sys
import time
from pathlib import Path

import jupytext
import nbformat
from nbclient import NotebookClient
from nbclient.exceptions import CellExecutionError

ROOT = Path(__file__).parents[1]
SOURCES = ROOT / "docs" / "notebooks"
OUTPUT = ROOT / "build" / "notebooks"
MAX_SECONDS = 600  # of a cell


def main() -> int:
    """Run them one after the other; each error is told, and the others go on."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("names", nargs="*", help="by default all")
    names = parser.parse_args().names or sorted(path.stem for path in SOURCES.glob("*.md"))
    OUTPUT.mkdir(parents=True, exist_ok=True)
    failed = 0
    for name in names:
        start = time.perf_counter()
        error = run(SOURCES / f"{name}.md", OUTPUT / f"{name}.ipynb")
        failed += bool(error)
        print(f"{name}: {error or f'{time.perf_counter() - start:.0f} s'}", flush=True)
    return 1 if failed else 0


def run(source: Path, target: Path) -> str:
    """Run a notebook and write it, also where it fails; the error, or "" """
    notebook = jupytext.read(source)
    client = NotebookClient(notebook, timeout=MAX_SECONDS, kernel_name="python3")
    try:
        client.execute(cwd=str(target.parent))
    except CellExecutionError as error:
        return str(error)
    finally:
        nbformat.write(notebook, target)
    return ""


if __name__ == "__main__":
    sys.exit(main())
