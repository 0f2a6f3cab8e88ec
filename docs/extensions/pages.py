# SPDX-License-Identifier: MIT
"""Text that the site's pages take from elsewhere in the tree, and links that lead there.

Files in the root of the tree are shown by a page in docs/project, parts of README.md by a block ``readme``
with a heading, a tracker's parameters by a block ``parameters``, a folder of kernels by a block ``kernels``.
"""

import ast
import dataclasses
import importlib
import os
import re
import sys
from functools import cache
from pathlib import Path
from typing import Any

from sphinx.application import Sphinx

ROOT = Path(__file__).parents[2]
DOCS = ROOT / "docs"
SHOWN = {
    "project/contributing": "CONTRIBUTING.md",
    "project/changelog": "CHANGELOG.md",
    "project/security": "SECURITY.md",
    "project/benchmarks": "benchmarks/README.md",
    "project/quality": "benchmarks/quality/README.md",
}
"""Pages of the site by their names, and the files of the tree that they show."""
_PAGE_OF = {ROOT / file: DOCS / f"{page}.md" for page, file in SHOWN.items()} | {
    ROOT / "README.md": DOCS / "index.md"
}
_LINK = re.compile(r"(\]\()([^)\s#]+)([^)\s]*\))")
_WHOLE_LINK = re.compile(r"(?<!!)\[([^\[\]]+)\]\((?!\w+:)([^)\s#]+)[^)\s]*\)")
_NAMED_LIKE_FILE = re.compile(r"\[[\w./-]+\.md\]\(")
"""Links that code hosts show by the name of a page's file; here they get the page's title."""
_PATTERN = re.compile(r"^([\w/]+\*)\n", re.MULTILINE)
"""Of a toctree: pages that a tree may not have, such as notebooks."""
_BLOCK = re.compile(r"^```\{(readme|parameters|kernels)\} (.+)\n```$", re.MULTILINE)


def fill(app: Sphinx, page: str, source: list[str]) -> None:
    """Put into a page what it takes from elsewhere."""
    place = DOCS / f"{page}.md"
    if page in SHOWN:
        file = ROOT / SHOWN[page]
        app.env.note_dependency(str(file))
        source[0] = relink(file.read_text(encoding="utf-8"), file, place)
    elif place.is_file():
        text = relink(source[0], place, place)
        app.env.note_dependency(__file__)
        makers = {"readme": _readme, "parameters": _parameters, "kernels": _kernels}
        text = _BLOCK.sub(lambda found: makers[found[1]](app, found[2], place), text)
        source[0] = _PATTERN.sub(lambda found: found[0] if list(DOCS.glob(found[1])) else "", text)


def relink(text: str, file: Path, page: Path) -> str:
    """The text of a file, with its relative links as a page of the site needs them.

    Links to folders, and to pages that the site doesn't show, become text; other files are downloads.
    """

    def target(address: str) -> Path:
        found = Path(os.path.normpath(file.parent / address))
        return _PAGE_OF.get(found, found)

    def moved(found: re.Match[str]) -> str:
        if re.match(r"\w+:", found[2]):
            return found[0]
        return f"{found[1]}{Path(os.path.relpath(target(found[2]), page.parent)).as_posix()}{found[3]}"

    def shown(found: re.Match[str]) -> str:
        place = target(found[2])
        hidden = not place.is_relative_to(DOCS) and (place.suffix == ".md" or place.is_dir())
        return found[1] if hidden else found[0]

    def rewritten(text: str) -> str:
        return _LINK.sub(moved, _NAMED_LIKE_FILE.sub("[](", _WHOLE_LINK.sub(shown, text)))

    parts = re.split(r"(^```.*?^```$)", text, flags=re.DOTALL | re.MULTILINE)
    return "".join(part if index % 2 else rewritten(part) for index, part in enumerate(parts))


def _readme(app: Sphinx, heading: str, page: Path) -> str:
    """A section of README.md, without its heading."""
    file = ROOT / "README.md"
    app.env.note_dependency(str(file))
    sections = re.split(r"^## (.+)\n", file.read_text(encoding="utf-8"), flags=re.MULTILINE)
    found = dict(zip(sections[1::2], sections[2::2], strict=True))
    if heading not in found:
        raise ValueError(f"{page.name}: README.md has no section {heading!r}; it has {', '.join(found)}")
    return relink(found[heading], file, page)


def _parameters(app: Sphinx, tracker: str, page: Path) -> str:
    """A table of a tracker's parameters."""
    from tricue.track.base.registry import tracker_class

    kind = tracker_class(tracker).Params
    printed = kind.paper() if hasattr(kind, "paper") else None
    rows = [["parameter", "default", "unit, range", "meaning, and source"], ["---"] * 4]
    for field in dataclasses.fields(kind):
        default = f"`{field.default!r}`"
        if printed is not None and getattr(printed, field.name) != field.default:
            default += f"<br>`paper()`: `{getattr(printed, field.name)!r}`"
        unit, meaning, origin = (_cell(str(field.metadata.get(key, ""))) for key in ("unit", "doc", "source"))
        limits = ", ".join(part for part in (unit, _bounds(field)) if part not in ("", "-"))
        source = f"<small>{origin}</small>"
        text = f"{meaning}<br>{source}" if meaning else source
        rows.append([f"`{field.name}`", default, limits, text])
    return "\n".join(f"| {' | '.join(row)} |" for row in rows)


def _bounds(field: "dataclasses.Field[Any]") -> str:
    """What a parameter may be."""
    data = field.metadata
    if data.get("choices"):
        return ", ".join(f"`{choice!r}`" for choice in data["choices"])
    words = {"low": "≥", "above": ">", "high": "≤", "below": "<"}
    return ", ".join(
        f"{sign}\N{NO-BREAK SPACE}{data[key]:g}" for key, sign in words.items() if data.get(key) is not None
    )


def _cell(text: str) -> str:
    return re.sub(r"([|*_<])", r"\\\1", text)


def _kernels(app: Sphinx, folder: str, _: Path) -> str:
    """The kernels of a folder: signature, contract, and their twins in NumPy."""
    contracts = [each for each in _contracts() if each.folder.as_posix() == folder]
    if not contracts:
        raise ValueError(f"kernels: no folder {folder!r}")
    return "\n".join(_kernel(app, contract) for contract in contracts)


@cache
def _contracts() -> list[Any]:
    return list(_kernel_docs().read_contracts(ROOT))


@cache
def _kernel_docs() -> Any:
    sys.path.append(str(ROOT / "tools"))
    return importlib.import_module("kernel_docs")


@cache
def _stub() -> dict[str, ast.FunctionDef]:
    """The kernels as the stub types them."""
    tree = ast.parse((ROOT / "python" / "tricue" / "_core.pyi").read_text(encoding="utf-8"))
    return {node.name: node for node in tree.body if isinstance(node, ast.FunctionDef)}


def _signature(contract: Any) -> str:
    """The types of the stub, with the defaults of the contract, which the stub may leave out."""
    typed = _stub()[contract.name]
    call = ast.parse(contract.signature, mode="eval").body
    assert isinstance(call, ast.Call)
    typed.args.defaults = [keyword.value for keyword in call.keywords]
    assert typed.returns is not None
    text = f"{typed.name}({ast.unparse(typed.args)}) -> {ast.unparse(typed.returns)}"
    return re.sub(r"\b(?:numpy\.typing|numpy|collections\.abc|typing)\.", "", text)


def _kernel(app: Sphinx, contract: Any) -> str:
    twin = ROOT / "python" / "tricue" / "reference" / contract.folder / f"{contract.name}.py"
    app.env.note_dependency(str(twin))
    section: str = _kernel_docs()._section(contract)
    heading, rest = section.split("\n\n", 1)
    body = rest.split("```\n", 1)[1]  # without the plain signature
    code = twin.read_text(encoding="utf-8").partition("\n")[2]
    return "\n".join(
        [
            heading.replace("### ", "## "),
            "",
            f"````{{py:function}} {_signature(contract)}",
            ":module: tricue._core",
            "",
            body,
            "````",
            "",
            f"::::{{dropdown}} The twin in NumPy: reference/{contract.folder.as_posix()}/{twin.name}",
            "```python",
            code.strip(),
            "```",
            "::::",
            "",
        ]
    )


def setup(app: Sphinx) -> dict[str, bool]:
    """Sphinx calls this."""
    app.connect("source-read", fill)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
