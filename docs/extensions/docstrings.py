# SPDX-License-Identifier: MIT
"""Docstrings and signatures as the reference shows them.

The project's docstrings name arguments, fields and errors in plain sentences, ``size: width and height,
pixels. ValueError names the argument.`` Here these become a list. Signatures are those of the source, as the
evaluated types of NumPy take lines.
"""

import ast
import contextlib
import dataclasses
import importlib.util
import inspect
import re
import sys
import textwrap
from collections.abc import Iterator
from enum import Enum
from types import GenericAlias, UnionType
from typing import Any, Union, get_args, get_origin

import numpy as np
from docutils import nodes
from sphinx.addnodes import desc_annotation
from sphinx.application import Sphinx
from tricue.track.base.params import Params

KEPT_ALIASES = {"ArrayLike", "BoxLike", "FrameLike", "NDArray"}
"""Aliases that readers know, or find in the reference; others are spelled out."""
_ERRORS = (
    r"(?:Raises?\s|Warns|(?:\w*(?:Error|Warning)(?:,?\s(?:or|and)\s|,\s)?)+\s"
    r"(?:for|where|names|on|if|before|without|of|as|unless)\b)"
)
_EVALUATED_ARRAY = (
    r"(?:numpy\.)?ndarray\[tuple\[(?:\w+\.)?Any, \.\.\.\], (?:numpy\.)?dtype\[(?:numpy\.)?(\w+)\]\]"
)
_VALUE = r'^("[^"]+"): '


def restructure(lines: list[str], names: set[str]) -> list[str]:
    """The lines of a docstring, with a list of what is said of the names.

    names: of arguments and fields.
    """
    text: list[str] = []
    for paragraph in _paragraphs(lines):
        if all(line.startswith("    ") for line in paragraph):
            text += ["", ".. code-block:: python", "", *paragraph]
        elif paragraph[0].startswith("- ") or _is_definition(paragraph, names):
            text += ["", *paragraph]
        else:
            text += ["", *_paragraph(paragraph, names)]
    return [*text, ""]


def _paragraphs(lines: list[str]) -> Iterator[list[str]]:
    found: list[str] = []
    for line in [*lines, ""]:
        if line.strip():
            found.append(line.rstrip())
        elif found:
            yield found
            found = []


def _is_definition(paragraph: list[str], names: set[str]) -> bool:
    """Whether it is a term, with indented lines that explain it."""
    names_one = paragraph[0].partition(":")[0].split(", ")[0] in names
    return len(paragraph) > 1 and paragraph[1].startswith("    ") and not names_one


def _paragraph(lines: list[str], names: set[str]) -> list[str]:
    """Its sentences; those that say what a name is as items of a list, those on errors by themselves."""
    text: list[str] = []
    for part in _parts(lines, names):
        name, colon, rest = part.partition(": ")
        if colon and set(name.split(", ")) <= names:
            what = ", ".join(f"``{each}``" for each in name.split(", "))
            item = f"- {what}: {_choices(rest)}"
        else:
            item = part
        text += ["", *_mark_errors(item).split("\n")]
    return text


def _mark_errors(text: str) -> str:
    """The text with the names of exceptions as code."""
    parts = re.split(r"(``.*?``)", text, flags=re.DOTALL)
    return "".join(
        part if index % 2 else re.sub(r"(?<![`.])\b([A-Z]\w*(?:Error|Warning))\b(?!`)", r"``\1``", part)
        for index, part in enumerate(parts)
    )


def _parts(lines: list[str], names: set[str]) -> list[str]:
    """A paragraph cut in front of each name that is explained, and of each error."""
    known = "|".join(sorted(map(re.escape, names), key=len, reverse=True)) or r"(?!)"
    explained = rf"(?:{known})(?:, (?:{known}))*: "
    text = "\n".join(line.strip() if index else line for index, line in enumerate(lines))
    cut = re.sub(rf"(?:(?<=\A)|(?<=[.;)])\s|(?<=[^.]\n))(?={explained})", "\0", text)
    cut = re.sub(rf"(?:(?<=\.)\s|(?<=\A))(?={_ERRORS})", "\0", cut)
    return [part.strip() for part in cut.split("\0") if part.strip()]


def _choices(text: str) -> str:
    """What is said of an argument, lines that say one of its values each as a list in the list."""
    lines = text.split("\n")
    first = next((index for index, line in enumerate(lines) if re.match(_VALUE, line)), len(lines))
    items: list[str] = []
    for line in lines[first:]:
        if re.match(_VALUE, line):
            items.append("  - " + re.sub(_VALUE, r"``\1``: ", line))
        else:
            items[-1] += f" {line}"
    return "\n".join([" ".join(lines[:first]), *([""] if items else []), *items])


def _names(what: str, value: Any) -> set[str]:
    """The arguments of a callable, or those and the fields of a class."""
    found: set[str] = set()
    if inspect.isclass(value):
        found |= {name for name in dir(value) if not name.startswith("_")}
        found |= {name for each in value.__mro__ for name in vars(each).get("__annotations__", ())}
    with contextlib.suppress(TypeError, ValueError):
        found |= set(inspect.signature(value).parameters)
    return found


def process_docstring(_: Sphinx, what: str, name: str, value: Any, options: Any, lines: list[str]) -> None:
    """Restructure what autodoc read."""
    if what == "class" and value.__doc__ in (Enum.__doc__, None):
        lines.clear()
    lines[:] = restructure(lines, _names(what, value))


def process_signature(
    _: Sphinx, what: str, name: str, value: Any, options: Any, signature: str | None, returns: str | None
) -> tuple[str, str | None] | None:
    """The signature as it stands in the source."""
    if signature is None:  # autodoc found none, as of many exceptions
        return None
    if what in {"class", "exception"}:
        return _class_signature(value)
    if what in {"function", "method"} and (tree := _definition(value)) is not None:
        assert isinstance(tree, ast.FunctionDef)
        return _function_signature(tree, value, bound=what == "method")
    return None


def _definition(value: Any) -> ast.AST | None:
    """The syntax tree of a function or class; None for what has no source of its own."""
    value = inspect.unwrap(getattr(value, "__func__", value))
    try:
        source = textwrap.dedent(inspect.getsource(value))
    except (OSError, TypeError):
        return None
    return ast.parse(source).body[0]


def _class_signature(cls: Any) -> tuple[str, None]:
    if issubclass(cls, Params):  # their pages have tables
        return "(**parameters: Any)", None
    if issubclass(cls, (Enum, BaseException)) or getattr(cls, "_is_protocol", False):
        return "", None
    init = vars(cls).get("__init__") or inspect.getattr_static(cls, "__init__")
    tree = _definition(init)
    if isinstance(tree, ast.FunctionDef):  # written by hand; a dataclass's has no source
        return _function_signature(tree, init, bound=True)[0], None
    return _fields(cls) if dataclasses.is_dataclass(cls) or issubclass(cls, tuple) else "", None


def _fields(cls: Any) -> str:
    """The signature of a class that is made of its annotated fields."""
    parts = []
    for base in reversed(cls.__mro__):
        tree = _definition(base) if base.__module__.startswith("tricue") else None
        for node in tree.body if isinstance(tree, ast.ClassDef) else ():
            if isinstance(node, ast.AnnAssign) and "ClassVar" not in ast.unparse(node.annotation):
                default = f" = {_default(node.value)}" if node.value is not None else ""
                kind = _annotation(node.annotation, sys.modules[base.__module__])
                parts.append(f"{ast.unparse(node.target)}: {kind}{default}")
    return f"({', '.join(parts)})"


def _default(node: ast.expr) -> str:
    """A default as it stands; ``field(default_factory=dict)`` as what it makes."""
    text = ast.unparse(node)
    made = re.fullmatch(r"field\(default_factory=(\w+)\)", text)
    return f"{made[1]}()" if made else text


def _function_signature(tree: ast.FunctionDef, value: Any, *, bound: bool) -> tuple[str, str | None]:
    module = sys.modules[inspect.unwrap(getattr(value, "__func__", value)).__module__]
    arguments = tree.args
    static = any(isinstance(each, ast.Name) and each.id == "staticmethod" for each in tree.decorator_list)
    if bound and not static:
        (arguments.posonlyargs or arguments.args).pop(0)
    every = [
        *arguments.posonlyargs,
        *arguments.args,
        *arguments.kwonlyargs,
        arguments.vararg,
        arguments.kwarg,
    ]
    for argument in every:
        if argument is not None and argument.annotation is not None:
            argument.annotation = ast.parse(_annotation(argument.annotation, module), mode="eval").body
    returns = None if tree.returns is None else _annotation(tree.returns, module)
    return f"({ast.unparse(arguments)})", returns


def _annotation(node: ast.expr, module: Any) -> str:
    """A type as written, without quotes, and with the module's own aliases spelled out."""

    class Spelled(ast.NodeTransformer):
        def visit_Constant(self, constant: ast.Constant) -> ast.AST:
            if not isinstance(constant.value, str) or not constant.value.isidentifier():
                return constant
            spelled: ast.AST = self.visit(ast.parse(constant.value, mode="eval").body)
            return spelled

        def visit_Subscript(self, subscript: ast.Subscript) -> ast.AST:
            if ast.unparse(subscript.value) == "Literal":
                return subscript
            return self.generic_visit(subscript)

        def visit_Name(self, name: ast.Name) -> ast.AST:
            return _spelled(name, vars(module).get(name.id), name.id)

        def visit_Attribute(self, attribute: ast.Attribute) -> ast.AST:
            owner = vars(module).get(ast.unparse(attribute.value))
            if attribute.attr in {"Any", "Path"} or owner is np:
                return ast.Name(attribute.attr)
            return _spelled(attribute, getattr(owner, attribute.attr, None), attribute.attr)

    return ast.unparse(Spelled().visit(node))


def _spelled(node: ast.expr, value: Any, name: str) -> ast.expr:
    is_alias = isinstance(value, (GenericAlias, UnionType)) or get_origin(value) is not None
    if not is_alias or name in KEPT_ALIASES:
        return node
    return ast.parse(spell(value), mode="eval").body


def spell(kind: Any) -> str:
    """A type as one writes it: ``NDArray[float64]``, ``str | None``."""
    if kind is type(None) or kind is None:
        return "None"
    origin, inside = get_origin(kind), get_args(kind)
    if origin is np.ndarray:
        scalar = get_args(inside[1])[0]
        return f"NDArray[{spell(scalar)}]"
    if origin in (Union, UnionType):
        return " | ".join(map(spell, inside))
    if origin is None:
        return "..." if kind is Ellipsis else getattr(kind, "__name__", str(kind))
    if isinstance(inside[0], list):
        return f"{origin.__name__}[[{', '.join(map(spell, inside[0]))}], {spell(inside[1])}]"
    name = getattr(origin, "__name__", str(origin).rpartition(".")[2])
    if name == "Literal":
        return f"Literal[{', '.join(map(repr, inside))}]"
    return f"{name}[{', '.join(map(spell, inside))}]"


def shorten_arrays(_: Sphinx, domain: str, kind: str, content: nodes.Element) -> None:
    """Types of attributes, which autodoc evaluates, as ``NDArray[float64]``; their many values left out."""
    for node in content.parent[0].findall(desc_annotation):
        text = re.sub(_EVALUATED_ARRAY, r"NDArray[\1]", node.astext())
        text = re.sub(r"^ = array\(.*", "", text, flags=re.DOTALL)
        if text != node.astext():
            node.clear()
            node.append(nodes.Text(text))


def skip_field_numbers(_: Sphinx, what: str, name: str, value: Any, skip: bool, options: Any) -> bool | None:
    """Leave out what Python says of the fields of a named tuple."""
    return True if str(getattr(value, "__doc__", "")).startswith("Alias for field number") else None


def resolve_by_last_name(
    app: Sphinx, env: Any, node: nodes.Element, content: nodes.Element
) -> nodes.Element | None:
    """A link to the one documented thing of a name, however its module is written.

    What isn't ours, such as NumPy's types, is left as text: the site needs no network.
    """
    if node.get("refdomain") != "py":
        return None
    target = node["reftarget"]
    last = target.rpartition(".")[2]
    objects = env.domains.python_domain.objects
    found = [name for name in objects if name.rpartition(".")[2] == last and not objects[name].aliased]
    in_class = [
        name for name in found if target.count(".") and name.split(".")[-2:] == target.split(".")[-2:]
    ]
    found = in_class or [name for name in found if objects[name].objtype not in {"method", "property"}]
    if len(found) == 1:
        from sphinx.util.nodes import make_refnode

        entry = objects[found[0]]
        return make_refnode(app.builder, node["refdoc"], entry.docname, entry.node_id, content, found[0])
    is_module = node.get("reftype") == "mod" and importlib.util.find_spec(target) is not None
    is_foreign = node.get("reftype") in {"class", "obj"} and not target.startswith("tricue")
    return content if is_module or is_foreign else None


def setup(app: Sphinx) -> dict[str, bool]:
    """Sphinx calls this."""
    app.connect("autodoc-process-docstring", process_docstring)
    app.connect("autodoc-process-signature", process_signature)
    app.connect("autodoc-skip-member", skip_field_numbers)
    app.connect("object-description-transform", shorten_arrays)
    app.connect("missing-reference", resolve_by_last_name)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
