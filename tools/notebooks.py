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
from nbclient import NotebookClient
from nbclient.exceptions import CellExecutionError

ROOT = Path(__file__).parents[1]
MAX_SECONDS = 600  # of a cell


def main() -> int:
    """Run them one after the other; each error is told, and the others go on."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("names", nargs="*", help="by default all")
    parser.add_argument("--folder", type=Path, default=ROOT / "docs" / "notebooks")
    parser.add_argument("--output", type=Path, default=ROOT / "build" / "notebooks")
    options = parser.parse_args()
    options.output.mkdir(parents=True, exist_ok=True)
    failed = 0
    for name in options.names or sorted(path.stem for path in options.folder.glob("*.md")):
        start = time.perf_counter()
        error = run(options.folder / f"{name}.md", options.output / f"{name}.ipynb")
        failed += bool(error)
        print(f"{name}: {error or f'{time.perf_counter() - start:.0f} s'}", flush=True)
    return 1 if failed else 0


def run(source: Path, target: Path) -> str:
    """Run a notebook and write it, also where it fails; its error, "" if there is none."""
    notebook = jupytext.read(source)
    client = NotebookClient(notebook, timeout=MAX_SECONDS, kernel_name="python3")
    try:
        client.execute(cwd=str(target.parent))
    except CellExecutionError as error:
        return str(error)
    finally:
        jupytext.write(notebook, target)
    return ""


if __name__ == "__main__":
    sys.exit(main())
