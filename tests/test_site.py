# SPDX-License-Identifier: MIT
"""The site is whole: pages are in its navigation, public names in its reference, links lead somewhere.

``make docs`` builds it, with warnings as errors.
"""

import dataclasses
import fnmatch
import importlib
import re
import runpy
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType

import pytest
import tricue
from tricue import _core, draw, scenes
from tricue.track.base.registry import tracker_class

pytest.importorskip("sphinx")

ROOT = Path(__file__).parents[1]
DOCS = ROOT / "docs"
PAGES = sorted(page.relative_to(DOCS).with_suffix("").as_posix() for page in DOCS.rglob("*.md"))
TRACKERS = ("color-particle", "depth-particle", "flow-depth", "fused", "stereo-head")


@pytest.fixture
def extension(monkeypatch: pytest.MonkeyPatch) -> Iterator[dict[str, ModuleType]]:
    """The site's extensions, and the tools that they need, importable as when it is built."""
    monkeypatch.syspath_prepend(str(DOCS / "extensions"))
    monkeypatch.syspath_prepend(str(ROOT / "tools"))
    names = ("docstrings", "pages", "gallery")
    yield {name: importlib.import_module(name) for name in names}
    for name in names:
        sys.modules.pop(name, None)


def entries(page: str) -> Iterator[str]:
    """The pages that a page's toctrees name."""
    folder = Path(page).parent
    text = (DOCS / f"{page}.md").read_text(encoding="utf-8")
    for block in re.findall(r"^```\{toctree\}\n(.*?)^```", text, re.DOTALL | re.MULTILINE):
        for line in block.splitlines():
            name = re.sub(r".*<(.*)>", r"\1", line.strip())
            if name == "self" or not name or name.startswith(":"):
                continue
            pattern = (folder / name).as_posix()
            yield from fnmatch.filter(PAGES, pattern) if "*" in name else [pattern]


def test_every_page_is_in_the_navigation() -> None:
    """Each page of docs/ can be reached from the start page by the sidebar, which names no page twice."""
    found, waiting = ["index"], ["index"]
    while waiting:
        new = list(entries(waiting.pop()))
        found, waiting = [*found, *new], [*waiting, *new]
    assert sorted(found) == PAGES


def reference() -> str:
    """All that the pages of the reference say to document."""
    return "\n".join(page.read_text(encoding="utf-8") for page in sorted((DOCS / "api").rglob("*.md")))


def test_every_public_name_is_in_the_reference() -> None:
    """What ``tricue`` exports is documented by itself, what its packages export by them."""
    text = reference()
    named = set(re.findall(r"^\.\. auto(?:class|function):: (?:tricue\.)?(\w+)$", text, re.MULTILINE))
    assert set(tricue.__all__) - {"__version__"} <= named
    for package in (scenes, draw, importlib.import_module("tricue.errors")):
        assert f".. automodule:: {package.__name__}\n   :members:\n" in text


def test_every_documented_name_exists() -> None:
    """No page documents a module that is gone."""
    for module in re.findall(r"^\.\. automodule:: (\S+)$", reference(), re.MULTILINE):
        importlib.import_module(module)


def test_every_kernel_is_in_the_reference(extension: dict[str, ModuleType]) -> None:
    """The folders of the pages hold all kernels, each with its types, its contract and its twin's code."""
    pages = extension["pages"]
    folders = re.findall(r"^```\{kernels\} (.+)$", reference(), re.MULTILINE)
    contracts = [contract for contract in pages._contracts() if contract.folder.as_posix() in folders]
    assert {contract.name for contract in contracts} == {n for n in dir(_core) if not n.startswith("_")}
    for contract in contracts:
        assert "NDArray[" in pages._signature(contract)


@pytest.mark.parametrize("tracker", TRACKERS)
def test_tables_have_every_parameter(extension: dict[str, ModuleType], tracker: str) -> None:
    """Each parameter has a row with its default, that of paper() if it differs, its unit and its source."""
    assert f"```{{parameters}} {tracker}\n```" in reference()
    rows = extension["pages"]._parameters(None, tracker, DOCS / "index.md").splitlines()[2:]
    kind = tracker_class(tracker).Params
    printed, fields = getattr(kind, "paper", kind)(), dataclasses.fields(kind)
    assert len(rows) == len(fields)
    for row, field in zip(rows, fields, strict=True):
        value = getattr(printed, field.name)
        other = "" if value == field.default else f"<br>`paper()`: `{value!r}`"
        assert row.startswith(f"| `{field.name}` | `{field.default!r}`{other} |")
        assert extension["pages"]._cell(field.metadata["source"]) in row


def test_docstrings_become_lists(extension: dict[str, ModuleType]) -> None:
    """What a sentence says of a name is an item, what it says of an error stands by itself; code is code."""
    lines = """\
Draw a box.

size: width and height,
    pixels. near, far: meters; kind: one of
    "a": the first,
        and more
    "b": the second
The rest: no name. ValueError for ``TypeError`` in
a box.

    box = draw(size)
""".splitlines()
    text = "\n".join(extension["docstrings"].restructure(lines, {"size", "near", "far", "kind"}))
    assert "- ``size``: width and height, pixels." in text
    assert "- ``near``, ``far``: meters;" in text
    assert '  - ``"a"``: the first, and more\n  - ``"b"``: the second' in text
    assert "\n``ValueError`` for ``TypeError`` in\na box." in text
    assert ".. code-block:: python\n\n    box = draw(size)" in text


def test_signatures_are_readable(extension: dict[str, ModuleType]) -> None:
    """Arrays are NDArray, defaults are as in the source, and self isn't shown."""
    signature = extension["docstrings"].process_signature
    shown = signature(None, "function", "", draw.depth_overlay, None, "()", None)
    assert shown[0].startswith("(depth: NDArray[float32], track: Track, *, particles: ArrayLike | None=None")
    assert shown[1] == "NDArray[uint8]"
    shown = signature(None, "class", "", tricue.FusedTracker, None, "()", None)[0]
    assert "kernels: Literal['native', 'reference']='native'" in shown
    assert "self" not in shown
    assert (
        "position: NDArray[float64] | None = None"
        in signature(None, "class", "", tricue.Track, None, "()", None)[0]
    )


def test_links_are_those_of_the_site(extension: dict[str, ModuleType]) -> None:
    """Links lead to the pages that show files of the tree, titles are those of pages, code stays.

    What the site doesn't show is no link.
    """
    relink = extension["pages"].relink
    text = "[docs/fused.md](docs/fused.md#sources), [how](CONTRIBUTING.md#style), [x](https://x.org/a.md)\n"
    text += "[tree](python/), [other](other/README.md#a), [code](Makefile)\n"
    code = "```sh\n[a](docs/a.md)\n```\n"
    found = relink(text + code, ROOT / "README.md", DOCS / "project" / "changelog.md")
    wanted = "[](../fused.md#sources), [how](contributing.md#style), [x](https://x.org/a.md)\n"
    wanted += "tree, other, [code](../../Makefile)\n"
    assert found == wanted + code


def test_every_shown_file_has_its_page(extension: dict[str, ModuleType]) -> None:
    """The files of the tree that the site shows exist, and the pages in their place lead to them."""
    for page, file in extension["pages"].SHOWN.items():
        assert (ROOT / file).is_file()
        assert f"[{file}](../../{file})" in (DOCS / f"{page}.md").read_text(encoding="utf-8")


def test_every_clip_is_in_the_gallery(extension: dict[str, ModuleType]) -> None:
    """Each clip is shown with its still, and has a text for those who don't see it."""
    text = " ".join((DOCS / "gallery.md").read_text(encoding="utf-8").split())
    for name in extension["gallery"].CLIPS:
        clip = (
            rf'<video src="_static/{name}\.webm" poster="_static/{name}\.jpg" [^>]*aria-label="[^"]{{40,}}"'
        )
        assert re.search(clip, text), name
    assert len(re.findall("<video", text)) == len(extension["gallery"].CLIPS)
    assert re.findall(r'<img [^>]*alt="[^"]{40,}"', text) == re.findall(r"<img [^>]*\"", text)


def test_configuration_can_be_read(monkeypatch: pytest.MonkeyPatch) -> None:
    """docs/conf.py runs with what the extra ``docs`` installs, and says the package's version."""
    monkeypatch.setattr(sys, "path", list(sys.path))
    values = runpy.run_path(str(DOCS / "conf.py"))
    assert values["release"] == tricue.__version__
    assert values["nitpicky"]


@pytest.mark.parametrize(
    ("body", "fault"),
    [
        ('<a href="other.html#there">ok</a><a href="https://x.org">ok</a><h1 id="top"></h1>', ""),
        ('<a href="other.html#gone">x</a>', "no such anchor"),
        ('<a href="gone.html">x</a>', "no such file"),
        ('<img src="gone.png">', "no such file"),
        ('<script src="https://x.org/a.js"></script>', "is fetched from elsewhere"),
        ('<link rel="stylesheet" href="//x.org/a.css">', "is fetched from elsewhere"),
    ],
)
def test_built_links_are_checked(tmp_path: Path, body: str, fault: str) -> None:
    """The check of the built site finds what leads nowhere and what would be fetched."""
    (tmp_path / "index.html").write_text(body, encoding="utf-8")
    (tmp_path / "other.html").write_text('<p id="there"><a href="#there">x</a></p>', encoding="utf-8")
    command = [sys.executable, ROOT / "tools" / "check_site.py", tmp_path]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert (done.returncode, fault in done.stdout) == (int(bool(fault)), True), done.stdout + done.stderr
