# SPDX-License-Identifier: MIT
"""The documentation holds: samples run, commands exist, links lead somewhere, tables are whole."""

import importlib
import importlib.util
import inspect
import re
import shlex
import subprocess
import sys
from collections.abc import Iterator
from importlib.metadata import EntryPoint
from pathlib import Path
from types import ModuleType
from typing import Any

import cv2
import numpy as np
import pytest
from tricue import _core
from tricue.cli import program
from tricue.data.open_source import open_source
from tricue.data.source import Source
from tricue.data.streams import Video
from tricue.track.base import registry

from tools import tracker_table

ROOT = Path(__file__).parents[1]
PAGES = sorted(
    [
        *ROOT.glob("*.md"),
        *(ROOT / "docs").glob("*.md"),
        *(ROOT / "examples").glob("*.md"),
        *(ROOT / "benchmarks").rglob("*.md"),
    ]
)
README = (ROOT / "README.md").read_text(encoding="utf-8")
KERNELS = sorted(name for name in dir(_core) if not name.startswith("_"))
FORMER = {"tricue.trax"}
"""Modules whose old names are told of beside the new."""
MAX_README_WORDS = 1200
MAX_PROSE = 140  # characters of a line
MAX_CODE = 110  # of a line of Python; a command stays in one line
FRAMES, HEIGHT, WIDTH = 12, 240, 320

pages = pytest.mark.parametrize("page", PAGES, ids=lambda page: page.relative_to(ROOT).as_posix())


def prose(page: Path) -> Iterator[tuple[int, str]]:
    """The numbered lines of a page that are outside its blocks of code."""
    inside = False
    for number, line in enumerate(page.read_text(encoding="utf-8").splitlines(), 1):
        if line.lstrip().startswith("```"):
            inside = not inside
        elif not inside:
            yield number, line


def blocks(text: str, language: str) -> list[str]:
    """What stands in the blocks of code of a language."""
    return re.findall(rf"^```{language}\n(.*?)^```", text, re.DOTALL | re.MULTILINE)


def samples(*names: str) -> list[Any]:
    """The samples of Python of pages in docs/, each with its page."""
    texts = ((name, (ROOT / "docs" / name).read_text(encoding="utf-8")) for name in names)
    return [
        pytest.param(name, sample, id=f"{name}-{index}")
        for name, text in texts
        for index, sample in enumerate(blocks(text, "python"))
    ]


TRACKERS = blocks((ROOT / "docs" / "trackers.md").read_text(encoding="utf-8"), "python")


def commands(page: Path) -> Iterator[list[str]]:
    """The words of each command of a page's blocks of shell, continued lines in one, without comments."""
    for block in blocks(page.read_text(encoding="utf-8"), "sh"):
        for line in block.replace("\\\n", " ").splitlines():
            for part in re.split(r"\s(?:&&|\|)\s", line):
                if words := shlex.split(part.replace(" & ", " "), comments=True):
                    yield words


def inline_commands(page: Path) -> Iterator[list[str]]:
    """The words of each Python module, script or target of make that a page names in backticks."""
    for _, line in prose(page):
        for command in re.findall(r"`((?:python -m \S|python \w+/|make \w)[^`]*)`", line):
            yield shlex.split(command)


def anchors(page: Path) -> set[str]:
    """The anchors that a page's headings get: lower case, blanks as hyphens, no other marks."""
    heads = [line.lstrip("#").strip() for _, line in prose(page) if line.startswith("#")]
    return {re.sub(r"[^\w\- ]", "", head.lower()).replace(" ", "-") for head in heads}


def attribute(dotted: str) -> object:
    """What a dotted name says: a module, or something in one. Raises where there is none."""
    parts = dotted.split(".")
    for count in range(len(parts), 0, -1):
        try:
            value: Any = importlib.import_module(".".join(parts[:count]))
        except ModuleNotFoundError:
            continue
        for name in parts[count:]:
            value = getattr(value, name)
        return value
    raise ModuleNotFoundError(dotted)


def test_readme_is_short() -> None:
    """A newcomer reads it in a few minutes."""
    assert len(README.split()) <= MAX_README_WORDS


@pages
def test_lines_are_short(page: Path) -> None:
    """No line of prose is too long to read; rows of tables and addresses can't be wrapped."""
    long = [
        f"{page.name}:{number}: {len(line)} characters"
        for number, line in prose(page)
        if len(line) > MAX_PROSE and not line.startswith("|") and "http" not in line
    ]
    code = "\n".join(blocks(page.read_text(encoding="utf-8"), "python"))
    long += [f"{page.name}: {line}" for line in code.splitlines() if len(line) > MAX_CODE]
    assert not long


@pages
def test_tables_are_tables(page: Path) -> None:
    """A table has one number of columns, as otherwise it is shown as text."""
    wrong, before = [], ""
    for number, line in prose(page):
        if line.startswith("|") and before.startswith("|"):
            columns = [len(re.findall(r"(?<!\\)\|", row)) for row in (before, line)]
            wrong += [f"{page.name}:{number}"] * (columns[0] != columns[1])
        before = line
    assert not wrong


@pages
def test_links_lead_somewhere(page: Path) -> None:
    """The file of each relative link exists, and so does the heading of its anchor."""
    wrong = []
    for number, line in prose(page):
        for target in re.findall(r"\]\(([^)\s]+)\)", line):
            if target.startswith("http"):
                continue
            name, _, anchor = target.partition("#")
            file = (page.parent / name).resolve() if name else page
            if not file.exists() or (anchor and anchor not in anchors(file)):
                wrong.append(f"{page.name}:{number}: {target}")
    assert not wrong


@pages
def test_named_files_exist(page: Path) -> None:
    """Paths of the tree that a page names in backticks are there; the changelog also tells of what was."""
    if page.name == "CHANGELOG.md":
        pytest.skip("it names what was moved")
    text = "\n".join(line for _, line in prose(page))
    folders = "cpp|python|tests|benchmarks|docs|tools|examples"
    named = re.findall(rf"`((?:{folders})/[\w/.*-]+)`", text)
    missing = [name for name in named if not list(ROOT.glob(name.rstrip("/")))]
    assert not missing


@pages
def test_named_modules_exist(page: Path) -> None:
    """What a page calls ``tricue.something`` can be imported; the changelog also tells of what was."""
    if page.name == "CHANGELOG.md":
        pytest.skip("it names what was moved")
    wrong = []
    for name in sorted(
        set(re.findall(r"(?<![\w/.])tricue(?:\.[A-Za-z_]\w*)+", page.read_text(encoding="utf-8")))
    ):
        if name.startswith("tricue.trackers") or name in FORMER:  # the group of entry points
            continue
        try:
            attribute(name)
        except (AttributeError, ModuleNotFoundError):
            wrong.append(name)
    assert not wrong


@pages
def test_commands_exist(page: Path) -> None:
    """Each command of a page has the options that it is given; scripts, modules and targets exist."""
    if page.name == "CHANGELOG.md":
        pytest.skip("it names what was moved")
    makefile = (ROOT / "Makefile").read_text(encoding="utf-8")
    for words in [*commands(page), *inline_commands(page)]:
        if words[0] == "tricue":
            program.parser(words[1]).parse_args([word for word in words[1:] if word != "&"])
        elif words[:2] == ["python", "-m"]:
            assert words[2] in FORMER or importlib.util.find_spec(words[2]), words
        elif words[0] == "python":
            assert (ROOT / words[1]).is_file(), words
        elif words[0] == "make":
            assert re.search(rf"^{words[1]}:", makefile, re.MULTILINE), words


@pytest.fixture
def recordings(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with a video of a textured picture that moves, in which the test runs, a stack and a track."""
    noise = np.random.default_rng(0).integers(0, 256, (HEIGHT // 4, WIDTH // 4, 3), np.uint8)
    picture = cv2.GaussianBlur(cv2.resize(noise, (WIDTH, HEIGHT)), (0, 0), 2)
    writer = cv2.VideoWriter(
        str(tmp_path / "video.mp4"), cv2.VideoWriter.fourcc(*"mp4v"), 30, (WIDTH, HEIGHT)
    )
    for index in range(FRAMES):
        writer.write(np.roll(picture, 2 * index, axis=1))
    writer.release()
    stack = [np.roll(picture[..., 0].astype(np.uint16) + 900, index, axis=1) for index in range(3)]
    cv2.imwritemulti(str(tmp_path / "stack.tif"), stack)
    rows = (f"{number},{number / 10},tracked,0.9,{3 * number},20,8,9,," for number in range(3))
    names = "frame,time_s,status,score,x,y,width,height,X_m,Y_m"
    (tmp_path / "track.csv").write_text("\n".join([names, *rows]))
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.usefixtures("recordings")
def test_readme_samples_run(capsys: pytest.CaptureFixture[str]) -> None:
    """The samples of Python, one after the other in one session, follow the target of a small video."""
    samples = blocks(README, "python")
    assert samples
    names: dict[str, Any] = {}
    for sample in samples:
        exec(compile(sample, "README.md", "exec"), names)
    assert names["track"].status == "tracked"
    assert len(capsys.readouterr().out.splitlines()) >= FRAMES - 1


@pytest.mark.parametrize("index", range(len(TRACKERS)))
def test_samples_of_the_trackers_run(index: int) -> None:
    """Each sample of docs/trackers.md runs by itself, and the tracker holds its target."""
    names: dict[str, Any] = {}
    exec(compile(TRACKERS[index], "docs/trackers.md", "exec"), names)
    assert "track" not in names or names["track"].status == "tracked"


@pytest.mark.usefixtures("recordings")
@pytest.mark.parametrize(("page", "sample"), samples("data.md", "fused.md"))
def test_samples_about_data_and_fused_run(page: str, sample: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Each sample runs by itself, with a small video for its cameras and recordings, and without Rerun."""

    def opened(place: str, **options: Any) -> Source:
        source = Source(place, {"color": Video(Path("video.mp4"))})
        assert set(options) <= set(inspect.signature(open_source).parameters)
        return source

    viewer = ModuleType("rerun")
    monkeypatch.setattr(viewer, "init", lambda name, spawn: None, raising=False)
    monkeypatch.setattr("tricue.rerun.log", lambda frame, track, name, number: None)
    monkeypatch.setattr("tricue.rerun.log_path", lambda tracks, name: None)
    monkeypatch.setitem(sys.modules, "rerun", viewer)
    monkeypatch.setattr("tricue.open_source", opened)
    monkeypatch.setattr("tricue.data.open_source.open_source", opened)
    names: dict[str, Any] = {}
    exec(compile(sample, f"docs/{page}", "exec"), names)
    assert "track" not in names or names["track"].status == "tracked"


@pytest.mark.usefixtures("recordings")
def test_a_stack_becomes_a_folder_of_images() -> None:
    """The sample for gray images of 16 bits writes a page each, in their order, with all of the contrast."""
    page = (ROOT / "docs" / "data.md").read_text("utf-8")
    (sample,) = (text for text in blocks(page, "python") if "multi" in text)
    exec(compile(sample, "docs/data.md", "exec"), {})
    first, *others = (frame.color for frame in open_source("frames"))
    assert first is not None
    assert (first.dtype, first.min(), first.max()) == (np.uint8, 0, 255)
    assert all(np.array_equal(np.roll(first, at, axis=1), image) for at, image in enumerate(others, 1))


@pytest.mark.usefixtures("recordings")
def test_speeds_are_those_of_the_table(capsys: pytest.CaptureFixture[str]) -> None:
    """The sample for paths in pixels prints the speed of a target that moves 3 pixels in 0.1 s."""
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("agg")
    (sample,) = blocks((ROOT / "docs" / "command-line.md").read_text("utf-8"), "python")
    exec(compile(sample, "docs/command-line.md", "exec"), {})
    assert capsys.readouterr().out == "median speed 30.0 pixels/s\n"
    assert Path("path.png").stat().st_size > 1000


@pages
def test_samples_compile_and_import(page: Path) -> None:
    """Every sample of Python is Python, and what it imports from the package is there."""
    for sample in blocks(page.read_text(encoding="utf-8"), "python"):
        compile(sample, page.name, "exec")
        for module, names in re.findall(r"^from (tricue[\w.]*) import (.+)$", sample, re.MULTILINE):
            for name in names.split(","):
                attribute(f"{module}.{name.strip()}")


def test_every_kernel_has_a_row_of_times() -> None:
    """docs/benchmarks.md, which ``make bench`` writes, leaves no kernel out, and names none that is gone."""
    text = (ROOT / "docs" / "benchmarks.md").read_text(encoding="utf-8")
    table = text.split("\n## Kernels\n")[1].split("\n## ")[0]
    rows = {row.split(",")[0].strip() for row in re.findall(r"^\| ([a-z_0-9]+[^|]*)\|", table, re.MULTILINE)}
    assert rows - {"kernel"} == set(KERNELS)


def test_every_command_is_described() -> None:
    """docs/command-line.md has a section for each command."""
    text = (ROOT / "docs" / "command-line.md").read_text(encoding="utf-8")
    assert not [name for name in program.COMMANDS if f"## tricue {name}" not in text]


def test_the_tables_of_trackers_are_their_traits() -> None:
    """What README.md and docs/trackers.md say of the trackers is what the trackers say themselves."""
    command = [sys.executable, ROOT / "tools" / "tracker_table.py", "--check"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr


def test_the_tables_of_trackers_leave_out_what_else_is_installed(monkeypatch: pytest.MonkeyPatch) -> None:
    """A package that registers a tracker changes no page."""
    theirs = EntryPoint("theirs", "package:Theirs", registry.GROUP)
    monkeypatch.setattr(registry, "_installed_entry_points", lambda: {"theirs": theirs})
    assert [row[0] for row in tracker_table.overview()[1:]] == [f"`{name}`" for name in registry._BUILT_IN]
