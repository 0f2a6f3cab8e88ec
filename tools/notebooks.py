# SPDX-License-Identifier: MIT
"""Runs the notebooks in docs/notebooks and writes them, with their output, to build/notebooks.

    python tools/notebooks.py                # all
    python tools/notebooks.py compare        # by name

The exit code is 1 if one fails; its error is also in the file.
"""

import argparse
import sys
import time
from pathlib import Path

import jupytext
from nbclient import NotebookClient
from nbclient.exceptions import CellExecutionError

ROOT = Path(__file__).parents[1]
MAX_SECONDS = 600  # per cell


def main() -> int:
    """Run the notebooks one after the other; errors are printed, and don't stop the others."""
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
    """Run a notebook and write it, even if it fails; returns its error, or ""."""
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
