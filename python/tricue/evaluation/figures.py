# SPDX-License-Identifier: MIT
"""Figures for papers, drawn by matplotlib: one file each, one column wide, with embedded fonts.

Colors are those of the report, which color-blind readers can distinguish; baselines also differ by dashes.
"""

import math
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from tricue.draw.writable import naming
from tricue.evaluation import tables
from tricue.evaluation.attributes.definitions import BY_KEY
from tricue.evaluation.attributes.results import sequences_with, tracker_lines
from tricue.evaluation.differences import comparison, signed
from tricue.evaluation.evaluate import Evaluation
from tricue.evaluation.report.plot_styles import LineStyle, line_styles
from tricue.evaluation.report.plots import Group, Plot, by_number, dash_pattern, plots_of
from tricue.evaluation.significance import Pair, TrackerComparison

FOLDER = "figures"
FORMATS = ("pdf", "svg", "png")
WIDTH = 3.3  # inches, the column width of a two-column page
_HEIGHT = 2.5  # without a legend
_LEGEND_LINE = 0.15
_DPI = 300  # of PNG
_STYLE: dict[str, Any] = {
    "font.family": "DejaVu Sans",  # comes with matplotlib, so figures look the same everywhere
    "font.size": 7.5,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.linewidth": 0.6,
    "axes.grid": True,
    "grid.color": "#e4e4e4",
    "grid.linewidth": 0.5,
    "lines.solid_capstyle": "butt",
    "pdf.fonttype": 42,  # TrueType, embedded; many publishers reject Type 3
    "svg.fonttype": "path",
    "svg.hashsalt": "tricue",
}
_SCALE = 0.6  # of the line widths and point sizes of the report
MAX_TRACKERS = 6  # in the figure by attribute
MAX_NAMED_CELLS = 8  # trackers up to which the matrix has room for numbers


def check_formats(formats: Sequence[str]) -> None:
    """ValueError for a format that can't be written."""
    for each in formats:
        if each not in FORMATS:
            raise ValueError(f"formats: expected some of {', '.join(FORMATS)}, got {each!r}")


def write_figures(evaluation: Evaluation, folder: Path, formats: Sequence[str]) -> list[Path]:
    """Write each figure of each group as folder/GROUP-NAME.FORMAT; return their paths. The same evaluation
    gives the same bytes, except for measured times.
    """
    check_formats(formats)
    styles = {
        name: LineStyle(style.color, style.dashes, style.width * _SCALE)
        for name, style in line_styles(evaluation.trackers).items()
    }
    lines = [
        {**line, **speed}
        for line, speed in zip(tables.summary(evaluation), tables.speeds(evaluation), strict=True)
    ]
    folder.mkdir(parents=True, exist_ok=True)
    written = []
    for name in evaluation.groups:
        group = Group.of(evaluation, name, lines)
        for plot in plots_of(group, styles):
            key = "success" if plot.key == "auc" else plot.key
            legend = 0 if plot.labeled else math.ceil(len(plot.numbers) / 2)
            size = WIDTH, _HEIGHT + _LEGEND_LINE * legend
            written += _save(folder / f"{name}-{key}", formats, size, _with_legend(plot, styles))
        found = comparison(evaluation, name)
        if found.telling and len(found.means) > 1:
            draw = _matrix(found)
            written += _save(folder / f"{name}-significance", formats, (WIDTH, WIDTH), draw)
        if rows := [line for line in tracker_lines(evaluation) if line["group"] == name]:
            attributes = list(dict.fromkeys(line["attribute"] for line in rows))
            shown = _best(group)
            size = WIDTH, 0.6 + 0.26 * len(attributes) + _LEGEND_LINE * math.ceil(len(shown) / 2)
            counts = {each: len(sequences_with(evaluation, name, each)) for each in attributes}
            draw = _by_attribute(rows, counts, shown, styles)
            written += _save(folder / f"{name}-attributes", formats, size, draw)
    return written


def _save(
    path: Path, formats: Sequence[str], size: tuple[float, float], draw: Callable[[Any], None]
) -> list[Path]:
    from matplotlib import rc_context
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    written = []
    for each in formats:
        style: dict[Any, Any] = {**_STYLE}
        with rc_context(style):
            figure = Figure(figsize=size, layout="constrained")
            FigureCanvasAgg(figure)
            draw(figure.subplots())
            file = path.with_name(f"{path.name}.{each}")
            metadata = {"pdf": {"CreationDate": None}, "svg": {"Date": None}}.get(each)
            with naming(file):
                figure.savefig(file, format=each, dpi=_DPI, metadata=metadata)
            written.append(file)
    return written


def _with_legend(plot: Plot, styles: Mapping[str, LineStyle]) -> Callable[[Any], None]:
    def draw(axes: Any) -> None:
        plot.draw(axes)
        for line in axes.lines:
            line.set_markersize(line.get_markersize() * _SCALE)
        if not plot.labeled:
            names = by_number(plot.numbers)
            texts = [f"{name} {plot.numbers[name]:.{plot.digits}f}" for name in names]
            _legend(axes, [styles[name] for name in names], texts)

    return draw


def _legend(axes: Any, styles: Sequence[LineStyle], texts: Sequence[str], marker: str = "") -> None:
    """Draw it beneath the axes, in two columns."""
    from matplotlib.lines import Line2D

    handles = []
    for style, text in zip(styles, texts, strict=True):
        handle = Line2D([], [], color=style.color, linewidth=style.width, label=text, marker=marker)
        handle.set_markersize(3)
        if style.dashes:
            handle.set_linestyle(dash_pattern(style))
        handles.append(handle)
    axes.figure.legend(
        handles=handles,
        loc="outside lower center",
        ncols=2,
        frameon=False,
        handlelength=2.4,
        columnspacing=1.2,
        labelspacing=0.25,
        borderaxespad=0.1,
    )


def _matrix(found: TrackerComparison) -> Callable[[Any], None]:
    """Differences of the mean AUC, row minus column. Colored: different, adjusted for all pairs; pale: only
    the pair's own interval excludes 0; white: neither.
    """
    names = by_number({name: each.mean for name, each in found.means.items()})

    def draw(axes: Any) -> None:
        axes.grid(visible=False)
        axes.set(xlim=(0, len(names)), ylim=(len(names), 0))
        for row, first in enumerate(names):
            for column, second in enumerate(names):
                pair = None if first == second else found.pair(first, second)
                across = [column, column + 1, column + 1, column]
                axes.fill(across, [row, row, row + 1, row + 1], _shade(pair))
                if pair is not None and len(names) <= MAX_NAMED_CELLS:
                    text = signed(pair.difference.mean, 2)
                    ink = "white" if pair.different else "#222222"
                    axes.text(column + 0.5, row + 0.5, text, ha="center", va="center", color=ink)
        middles = [index + 0.5 for index in range(len(names))]
        axes.set_xticks(middles, names, rotation=45, ha="right")
        axes.set_yticks(middles, names)
        axes.tick_params(length=0)
        for each in axes.spines.values():
            each.set_visible(True)

    return draw


def _shade(pair: Pair | None) -> str:
    if pair is None:
        return "#f2f2f2"
    strong, pale = ("#2166ac", "#d6e6f2") if pair.difference.mean > 0 else ("#b35806", "#fbe6cf")
    return strong if pair.different else pale if pair.difference.excludes_zero else "#ffffff"


def _best(group: Group) -> list[str]:
    """The trackers with the best AUC."""
    numbers = {line["tracker"]: line["auc"] for line in group.lines if not math.isnan(line["auc"])}
    return by_number(numbers)[:MAX_TRACKERS]


def _by_attribute(
    rows: Sequence[dict[str, Any]],
    counts: Mapping[str, int],
    trackers: Sequence[str],
    styles: Mapping[str, LineStyle],
) -> Callable[[Any], None]:
    """AUC with intervals, a line of points per attribute. counts: of the sequences that have it."""
    found = {(line["attribute"], line["tracker"]): line for line in rows}

    def draw(axes: Any) -> None:
        step = 0.7 / max(1, len(trackers))
        for row, attribute in enumerate(counts):
            for index, tracker in enumerate(trackers):
                line = found.get((attribute, tracker))
                if line is None or math.isnan(line["auc"]):
                    continue
                y = row + (index - (len(trackers) - 1) / 2) * step
                color = styles[tracker].color
                if not math.isnan(line["low"]):
                    axes.plot([line["low"], line["high"]], [y, y], color=color, linewidth=0.8)
                axes.plot(line["auc"], y, "o", color=color, markersize=2.5)
        names = [f"{BY_KEY[each].title} ({count})" for each, count in counts.items()]
        axes.set_yticks(range(len(counts)), names)
        axes.set(xlim=(0, 1), ylim=(len(counts) - 0.5, -0.5), xlabel="AUC")
        _legend(axes, [styles[name] for name in trackers], trackers, "o")

    return draw
