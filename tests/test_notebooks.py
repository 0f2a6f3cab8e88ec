# SPDX-License-Identifier: MIT
"""The notebooks run: their cells one after the other, as plain Python, and what they show can be shown."""

import ast
import json
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import matplotlib as mpl
import matplotlib.pyplot as plt
import pytest

ROOT = Path(__file__).parents[1]
FOLDER = ROOT / "docs" / "notebooks"
TOOL = ROOT / "tools" / "notebooks.py"
NOTEBOOKS = sorted(FOLDER.glob("*.md"))
MAX_CODE, MAX_PROSE = 110, 140  # characters of a line

notebooks = pytest.mark.parametrize("notebook", NOTEBOOKS, ids=lambda path: path.stem)


def cells(notebook: Path) -> list[str]:
    """The cells of code."""
    text = notebook.read_text(encoding="utf-8")
    return re.findall(r"^```\{code-cell\} python\n(.*?)^```$", text, re.DOTALL | re.MULTILINE)


@pytest.fixture
def figures() -> Iterator[list[int]]:
    """Counts the figures of the cells; nothing opens a window."""
    mpl.use("Agg")
    with mpl.rc_context():
        yield []
    plt.close("all")


def run(code: str, names: dict[str, Any]) -> Any:
    """Run a cell; the value of its last expression, which a notebook would show."""
    tree = ast.parse(code)
    last = tree.body.pop() if isinstance(tree.body[-1], ast.Expr) else None
    exec(compile(tree, "cell", "exec"), names)
    if last is None:
        return None
    assert isinstance(last, ast.Expr)
    return eval(compile(ast.Expression(last.value), "cell", "eval"), names)


@notebooks
def test_it_runs(notebook: Path, figures: list[int]) -> None:
    """It proves that every cell runs, that there are figures, and that values show themselves as HTML."""
    names: dict[str, Any] = {"__name__": notebook.stem}
    shown = 0
    for code in cells(notebook):
        value = run(code, names)
        if hasattr(value, "_repr_html_"):
            shown += len(value._repr_html_()) > 0
        for number in plt.get_fignums():
            figure = plt.figure(number)
            figure.canvas.draw()
            figures.append(number)
            plt.close(figure)
    assert len(figures) >= 3
    assert shown >= 1


@notebooks
def test_it_is_a_notebook(notebook: Path) -> None:
    """It proves that Jupyter and the site can read the header, and that code is as wide as elsewhere."""
    _, head, body = notebook.read_text(encoding="utf-8").split("---\n", 2)
    assert re.search(r"^kernelspec:\n(  .+\n)*  name: python3$", head, re.MULTILINE)
    assert "    format_name: myst\n" in head
    assert body.lstrip().startswith("# ")
    assert cells(notebook)
    code = "\n".join(cells(notebook))
    assert not [line for line in code.splitlines() if len(line) > MAX_CODE]
    prose = re.sub(r"^```.*?^```$", "", body, flags=re.DOTALL | re.MULTILINE)
    assert not [line for line in prose.splitlines() if len(line) > MAX_PROSE]


@notebooks
def test_its_links_lead_somewhere(notebook: Path) -> None:
    """It proves that the pages that it names exist."""
    targets = re.findall(r"\]\(([^)#\s]+\.md)", notebook.read_text(encoding="utf-8"))
    assert not [name for name in targets if not (FOLDER / name).exists()]


def test_the_five_are_there() -> None:
    """It proves that none was lost."""
    expected = {"compare", "depth-path", "own-video", "particle-filter", "stereo-head"}
    assert {path.stem for path in NOTEBOOKS} == expected


def test_make_notebooks_writes_them_and_tells_errors(tmp_path: Path) -> None:
    """It proves that a notebook is run by Jupyter and written, and that an error fails."""
    pytest.importorskip("jupytext", reason="needs the extra notebooks")
    head = NOTEBOOKS[0].read_text(encoding="utf-8").split("# ", 1)[0]
    cell = "```{code-cell} python\nprint(6 * 7)\n```\n"
    (tmp_path / "good.md").write_text(head + cell, encoding="utf-8")
    (tmp_path / "wrong.md").write_text(head + cell + cell.replace("6 * 7", "1 / 0"), encoding="utf-8")
    command = [sys.executable, TOOL, "--folder", tmp_path, "--output", tmp_path / "out"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 1
    assert re.search(r"^good: \d+ s$", done.stdout, re.MULTILINE)
    assert "ZeroDivisionError" in done.stdout
    for name in ("good", "wrong"):
        written = json.loads((tmp_path / "out" / f"{name}.ipynb").read_text(encoding="utf-8"))
        assert written["cells"][0]["outputs"][0]["text"] == ["42\n"]
