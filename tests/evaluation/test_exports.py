# SPDX-License-Identifier: MIT
"""Tables and figures for papers."""

import dataclasses
import re
import shutil
import subprocess
from unittest import mock

import cv2
import pytest
from tricue.evaluation import figures, latex
from tricue.evaluation.attributes.measure import measure_all
from tricue.evaluation.evaluate import Options, evaluate
from tricue.evaluation.latex import escape, write_latex

DOCUMENT = r"\documentclass{{article}}\usepackage{{booktabs}}\begin{{document}}\input{{{}}}\end{{document}}"


@pytest.fixture(scope="module")
def evaluation(folders, tmp_path_factory):
    """Three baselines on seven sequences, with a further protocol and attributes."""
    root, out = tmp_path_factory.mktemp("seven"), tmp_path_factory.mktemp("out")
    for index, name in enumerate(("there", "back", "gap", "there", "back", "gap", "there")):
        shutil.copytree(folders / name, root / f"a_{index}% & #")
    options = Options(("still-box", "meanShift", "color-particle"), protocols=("every-3",))
    found = evaluate(root, out, options)
    return dataclasses.replace(found, attributes=measure_all(found.opened, out))


def test_latex_has_the_numbers(evaluation, tmp_path):
    """A table of all, one by protocol; the best bold with its interval."""
    text = write_latex(evaluation, tmp_path / "new" / "table.tex").read_text()
    auc = next(line for line in text.splitlines() if line.startswith("color-particle &"))
    assert re.search(r"^color-particle & \\textbf\{0\.\d{3}\} \{\\scriptsize \[0\.\d\d, 0\.\d\d\]\} & ", auc)
    assert "AUC by protocol" in text
    assert "every-3" in text
    for table in text.split(r"\begin{tabular}")[1:]:
        columns = len(re.match(r"\{(\w+)\}", table)[1])
        rows = [line for line in table.split(r"\end{tabular}")[0].splitlines() if line.endswith(r"\\")]
        assert {row.count(" & ") for row in rows} == {columns - 1}
    assert text.count("{") == text.count("}")
    assert "7 sequences of the group ``color''." in text
    (one, *_) = evaluation.opened
    alone = dataclasses.replace(evaluation, opened=(one,), attributes={})
    assert "1 sequence of the group" in write_latex(alone, tmp_path / "one.tex").read_text()


def test_latex_compiles(evaluation, tmp_path):
    """In a document with booktabs and nothing else."""
    if shutil.which("pdflatex") is None:
        pytest.skip("needs pdflatex: apt-get install texlive-latex-base texlive-latex-recommended")
    write_latex(evaluation, tmp_path / "table.tex")
    (tmp_path / "paper.tex").write_text(DOCUMENT.format("table.tex"))
    command = ["pdflatex", "-interaction=nonstopmode", "-halt-on-error", "paper.tex"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout[-2000:]
    assert (tmp_path / "paper.pdf").stat().st_size > 10_000


def test_any_name_is_text():
    """What LaTeX would take for a command is shown as it is."""
    assert escape(r"a_b%&{x}\y~") == r"a\_b\%\&\{x\}\textbackslash{}y\textasciitilde{}"


@pytest.mark.parametrize("format_", figures.FORMATS)
def test_each_figure_is_a_file_of_a_columns_width(evaluation, tmp_path, format_):
    """Success, precision, robustness, significance and the others; fonts are inside; the same bytes again."""
    written = figures.write_figures(evaluation, tmp_path / "one", [format_])
    names = {path.stem for path in written}
    shown = ("success", "precision", "norm_precision", "speed", "robustness", "significance", "attributes")
    assert {f"color-{each}" for each in shown} <= names
    for path in written:
        content = path.read_bytes()
        if format_ == "png":
            width = cv2.imread(str(path)).shape[1]
            assert width == pytest.approx(figures.WIDTH * 300, abs=2)
        elif format_ == "svg":
            assert f'width="{figures.WIDTH * 72:g}'.encode() in content
            assert b"<text" not in content  # letters are outlines
        else:
            assert b"/FontFile2" in content
            assert b"/Type3" not in content
    again = figures.write_figures(evaluation, tmp_path / "two", [format_])
    assert [path.read_bytes() for path in again] == [path.read_bytes() for path in written]


def test_attributes_count_sequences_not_a_trackers_results(folders, tmp_path):
    """Results for only one sequence don't change how many sequences have an attribute."""
    (tmp_path / "theirs").mkdir()
    truth = folders / "there" / "groundtruth_rect.txt"
    shutil.copy(truth, tmp_path / "theirs" / "there.txt")
    options = Options(("still-box",), results=(f"theirs={tmp_path / 'theirs'}",), restarts=False)
    found = evaluate(folders, tmp_path, options)
    found = dataclasses.replace(found, attributes=measure_all(found.opened, tmp_path))
    text = latex.write_latex(found, tmp_path / "table.tex").read_text()
    assert re.search(r"^light change & 1 & ", text, re.MULTILINE)
    with mock.patch("matplotlib.axes.Axes.set_yticks") as ticks:
        figures.write_figures(found, tmp_path / "figures", ["svg"])
    assert "light change (1)" in ticks.call_args.args[1]


def test_an_unknown_format_is_told():
    """The error names those that there are."""
    with pytest.raises(ValueError, match=r"^formats: expected some of pdf, svg, png, got 'eps'"):
        figures.check_formats(["pdf", "eps"])


def test_few_recordings_have_no_matrix(folders, tmp_path):
    """Of three sequences no difference can be told, so none is drawn, and nothing is bold."""
    evaluation = evaluate(folders, tmp_path, Options(("still-box", "meanShift"), restarts=False))
    names = {path.stem for path in figures.write_figures(evaluation, tmp_path / "figures", ["svg"])}
    assert "color-success" in names
    assert "color-significance" not in names
    text = latex.write_latex(evaluation, tmp_path / "table.tex").read_text()
    assert "Too few recordings" in text
    assert r"\textbf" not in text
