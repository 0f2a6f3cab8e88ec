# SPDX-License-Identifier: MIT
"""What a run depends on, so that it is run again after a change of that."""

import ast
from pathlib import Path

import pytest
import tricue
from tricue.evaluation import tasks
from tricue.evaluation.evaluate import Options, evaluate
from tricue.evaluation.tasks import perform

PACKAGE = Path(tricue.__file__).parent
OTHERS = ("notebook", "doctor", "evaluation/protocols.py")
"""Pictures of values, which no run shows; what to install where a run ends with an error; and what counts for
its own runs alone.
"""


def imported(file):
    """The package's files that a file of it imports, also in functions."""
    names = set()
    for node in ast.walk(ast.parse(file.read_text())):
        if isinstance(node, ast.ImportFrom) and node.module:
            names |= {node.module, *(f"{node.module}.{alias.name}" for alias in node.names)}
        elif isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
    places = [PACKAGE.parent.joinpath(*name.split(".")) for name in names if name.startswith("tricue.")]
    files = [each for place in places for each in (place.with_suffix(".py"), place / "__init__.py")]
    return {each for each in files if each.is_file()}


def has_code(file):
    """Whether there is more in it than a docstring."""
    return len(ast.parse(file.read_text()).body) > 1


def test_all_that_decides_a_run_is_in_its_fingerprint():
    """All modules that performing a task imports, here and in the processes of others' trackers, are hashed:
    a change of any of them repeats the runs.
    """
    found, new = set(), {PACKAGE / "evaluation/tasks.py", *(PACKAGE / "evaluation/foreign").glob("*.py")}
    while new:
        found |= new
        new = {each for file in new for each in imported(file)} - found
        new = {each for each in new if not each.relative_to(PACKAGE).as_posix().startswith(OTHERS)}
    hashed = {path for pattern in tasks._RESULT_SOURCES for path in PACKAGE.glob(pattern)}
    assert PACKAGE / "draw/depth_pictures.py" in found
    assert not {str(file.relative_to(PACKAGE)) for file in found - hashed if has_code(file)}
    assert {file.suffix for file in hashed} > {".py"}  # the kernels


def test_every_pattern_of_the_sources_names_files():
    """A file that was renamed isn't forgotten."""
    patterns = [each for each in tasks._RESULT_SOURCES if not each.startswith("_core")]
    assert not [pattern for pattern in patterns if not list(PACKAGE.glob(pattern))]


@pytest.mark.parametrize("name", ["color-particle", "still-box"])
@pytest.mark.parametrize("library", ["cv2", "numpy"])
def test_another_version_of_a_library_repeats_the_runs(folders, tmp_path, monkeypatch, name, library):
    """cv2 decodes the images of all trackers, NumPy draws random numbers: ours and others' run again."""
    ran = []

    def counted(task):
        ran.append(task.tracker.name)
        return perform(task)

    options = Options((name,), restarts=False)
    evaluate(folders / "there", tmp_path, options, work=counted)
    evaluate(folders / "there", tmp_path, options, work=counted)
    assert ran == [name]
    monkeypatch.setattr(f"{library}.__version__", "0.1")
    evaluate(folders / "there", tmp_path, options, work=counted)
    assert ran == [name, name]
