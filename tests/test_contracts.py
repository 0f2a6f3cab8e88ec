# SPDX-License-Identifier: MIT
"""A kernel's contract is written in its header alone, and reaches binding, stub, twin and docs from there."""

import ast
import inspect
import pickle
import re
import subprocess
import sys
from pathlib import Path

import pytest
from tricue import _core, reference

ROOT = Path(__file__).parents[1]
TOOL = ROOT / "tools" / "kernel_docs.py"
STUB = {
    node.name: node
    for node in ast.parse((ROOT / "python" / "tricue" / "_core.pyi").read_text()).body
    if isinstance(node, ast.FunctionDef)
}
KERNELS = sorted(STUB)
WIDTH = 140
MAX_ARGUMENTS = 10


def contract(name: str) -> str:
    """The docstring of a native kernel, without the line of its signature."""
    return (getattr(_core, name).__doc__ or "").partition("\n\n")[2].strip()


def entries(text: str, section: str) -> list[str]:
    """The names that a section of a docstring describes, "" where a text has none."""
    (lines,) = re.findall(rf"(?m)^{section}:\n((?:    .*\n?)+)", text)
    found = re.findall(r"(?m)^    (?! )((?:\w+(?:, \w+)*)(?=: )|)", lines)
    return [name for names in found for name in names.split(", ")]


def run(*arguments: str) -> subprocess.CompletedProcess[str]:
    """Run another Python in the tree."""
    command = [sys.executable, *arguments]
    return subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)


@pytest.mark.parametrize("name", KERNELS)
def test_contract_is_whole(name: str) -> None:
    """It describes every parameter in the signature's order, each array returned, and has a source."""
    text = contract(name)
    assert entries(text, "Args") == [argument.arg for argument in STUB[name].args.args]
    returned = STUB[name].returns
    is_tuple = isinstance(returned, ast.Subscript) and ast.unparse(returned.value) == "tuple"
    described = entries(text, "Returns")
    assert described
    if is_tuple and isinstance(returned, ast.Subscript) and isinstance(returned.slice, ast.Tuple):
        assert len(described) == len(returned.slice.elts)
        assert all(described)
    assert "\nSource: " in text
    assert "std::" not in text


@pytest.mark.parametrize("name", KERNELS)
def test_reaches_stub_and_twin(name: str) -> None:
    """The stub says the same; the twin's help is one line on how it computes, then the contract."""
    text = contract(name)
    assert ast.get_docstring(STUB[name]) == text
    how, _, rest = (inspect.getdoc(getattr(reference, name)) or "").partition("\n\n")
    assert how
    assert "\n" not in how
    assert rest.strip() == text


@pytest.mark.parametrize("source", sorted((ROOT / "python" / "bindings").glob("*.cpp")), ids=lambda f: f.stem)
def test_bindings_describe_nothing(source: Path) -> None:
    """What a binding says of a kernel is docs::NAME; its only strings are names."""
    for definition in re.findall(r"m\.def\(.*?\);\n", source.read_text(), re.DOTALL):
        name, *others = re.findall(r'"([^"]*)"', definition)
        assert others == re.findall(r'py::arg\("(\w+)"\)', definition), f"{name}: a docstring"
        assert definition.endswith(f"docs::{name});\n")


def test_reference_alone_has_contracts() -> None:
    """It's enough to import tricue.reference; its functions are pickled as functions of modules are."""
    code = "import tricue.reference as r; assert 'Args:' in r.resample.__doc__, r.resample.__doc__"
    assert run("-c", code).returncode == 0
    assert pickle.loads(pickle.dumps(reference.resample)) is reference.resample


def test_page_has_not_drifted() -> None:
    """docs/kernels.md says what the headers say; `make kernel-docs` writes it anew."""
    found = run(str(TOOL), "--check")
    assert found.returncode == 0, found.stdout + found.stderr


def test_lines_can_be_read() -> None:
    """No line of the page, the headers' contracts or the stub is longer than 140 characters."""
    headers = [file for file in (ROOT / "cpp").rglob("*.hpp") if file.stem in KERNELS]
    for file in (*headers, ROOT / "docs" / "kernels.md", ROOT / "python" / "tricue" / "_core.pyi"):
        assert not [line for line in file.read_text().splitlines() if len(line) > WIDTH], file.name


WHOLE = """
struct Range {
    double low, high;  ///< of the values, meters

    /// The middle.
    double middle() const { return (low + high) / 2; }
};

/// Adds an offset.
///
/// @param values float64 (N,)
/// @returns float64 (N,)
/// @throws std::invalid_argument on no values
Vector shift(VectorRef values, const Range& range);
"""
BINDING = """
    m.def("shift", shift_arrays, py::arg("values"), py::arg("low"), py::arg("high") = 1.0, docs::shift);
"""


GROUPED = 'm.def("shift", shift_arrays, py::arg("values"), py::arg("range"), docs::shift);\n'


def build(folder: Path, header: str, binding: str = BINDING) -> subprocess.CompletedProcess[str]:
    """Run the tool on a tree with one kernel, as the build does."""
    (folder / "cpp" / "fuse").mkdir(parents=True)
    (folder / "python" / "bindings").mkdir(parents=True)
    (folder / "cpp" / "fuse" / "shift.hpp").write_text(header)
    (folder / "python" / "bindings" / "fuse.cpp").write_text(binding)
    return run(str(TOOL), "--root", str(folder), "--header", str(folder / "kernel_docs.hpp"))


def test_struct_fields_become_parameters(tmp_path: Path) -> None:
    """Fields of a struct that the binding flattens are described by their comments; errors are Python's."""
    found = build(tmp_path, WHOLE)
    assert found.returncode == 0, found.stderr
    text = (tmp_path / "kernel_docs.hpp").read_text()
    assert 'shift = R"doc(Adds an offset.\n' in text
    assert "Args:\n    values: float64 (N,)\n    low, high: of the values, meters\n" in text
    assert "Raises:\n    ValueError: on no values)doc" in text


def test_structs_become_tuples(tmp_path: Path) -> None:
    """A struct that the binding takes whole is a tuple, described field by field."""
    found = build(tmp_path, WHOLE, GROUPED)
    assert found.returncode == 0, found.stderr
    text = (tmp_path / "kernel_docs.hpp").read_text()
    wanted = "    range: a tuple (low, high):\n        - low, high: of the values, meters\n"
    assert f"Args:\n    values: float64 (N,)\n{wanted}\nReturns:" in text


def test_structs_in_structs_become_tuples_in_tuples(tmp_path: Path) -> None:
    """A field without a comment that is a struct is described by its own fields."""
    inner = "struct Ends {\n    double low;   ///< meters\n    double high;  ///< above it\n};\n"
    outer = WHOLE.replace("    double low, high;  ///< of the values, meters\n", "    Ends ends;\n")
    found = build(tmp_path, inner + outer, GROUPED)
    assert found.returncode == 0, found.stderr
    wanted = """
    range: a tuple (ends):
        - ends: a tuple (low, high):
            - low: meters
            - high: above it
"""
    assert wanted in (tmp_path / "kernel_docs.hpp").read_text()


def tuple_types(annotation: ast.expr | None) -> list[ast.expr]:
    """The types of a tuple's parts."""
    assert isinstance(annotation, ast.Subscript)
    assert isinstance(annotation.slice, ast.Tuple)
    return annotation.slice.elts


@pytest.mark.parametrize("name", KERNELS)
def test_kernels_take_few_arguments(name: str) -> None:
    """At most ten: a struct in C++ is a tuple in Python."""
    assert len(STUB[name].args.args) + len(STUB[name].args.kwonlyargs) <= MAX_ARGUMENTS


@pytest.mark.parametrize("name", KERNELS)
def test_tuples_have_the_parts_that_are_described(name: str) -> None:
    """The signature, which is the binding's, has as many types in a tuple as the text has names."""
    annotations = {each.arg: each.annotation for each in STUB[name].args.args}
    described = re.findall(r"(?m)^    (\w+): a tuple \(([^)]*)\):\n((?: {8}.*\n)*)", f"{contract(name)}\n")
    for parameter, names, inside in described:
        labels = re.findall(r"\w+", names)
        types = dict(zip(labels, tuple_types(annotations[parameter]), strict=True))
        for part, its_names in re.findall(r"(?m)^ {8}- (\w+): a tuple \(([^)]*)\):$", inside):
            assert len(tuple_types(types[part])) == len(re.findall(r"\w+", its_names)), f"{parameter}, {part}"


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        (r"(?m)^/// .*\n|^///\n", "", "no contract: a /// comment is needed in front of the declaration"),
        (r"shift\(", "move(", "the header declares no function of this name"),
        (r"///< .*", "", "parameter low is described neither by @param nor by a struct's field"),
        (
            r"double low",
            "double low;  ///< of others\n    double low",
            "parameter low is described more than once: it needs one @param",
        ),
        (r"@param values", "@param value", "@param of what the binding doesn't take: value"),
        (r"/// @returns .*\n", "", "no @returns, and no struct with commented fields is returned"),
    ],
)
def test_build_fails_without_contract(old: str, new: str, message: str, tmp_path: Path) -> None:
    """A bound kernel without a whole contract stops the build, and says what is missing where."""
    found = build(tmp_path, re.sub(old, new, WHOLE))
    assert found.returncode == 1
    assert found.stderr == f"kernel_docs: shift (cpp/fuse/shift.hpp): {message}\n"
    assert not (tmp_path / "kernel_docs.hpp").exists()
