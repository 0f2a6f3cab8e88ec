# SPDX-License-Identifier: MIT
"""The report of an evaluation as one self-contained HTML file."""

import base64
import hashlib
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from tricue.draw.writable import naming
from tricue.evaluation import tables
from tricue.evaluation.differences import BETTER, comparison
from tricue.evaluation.evaluate import Evaluation
from tricue.evaluation.report import svg
from tricue.evaluation.report.comparisons import attribute_table, matrix, protocol_table
from tricue.evaluation.report.markup import Html, joined, tag
from tricue.evaluation.report.plot_styles import LineStyle, line_styles
from tricue.evaluation.report.plots import Group, plots
from tricue.evaluation.report.sequences import MAX_PICTURED, RankedSequence, sequences, worst_first
from tricue.evaluation.report.setup import setup, troubles
from tricue.evaluation.report.summary import summary_table
from tricue.evaluation.report.timeline import ABSENT_COLOR, NOT_TRACKED, SHADES

REPORT = "report.html"
_TITLES = {
    "color": "Color video",
    "rgbd": "Color and depth",
    "depth": "Depth",
    "stereo": "Stereo pairs",
}
_FILES = {
    tables.ROWS: "a line per run",
    tables.SUMMARY: "means",
    tables.INTERVALS: "intervals",
    tables.SIGNIFICANCE: "differences",
    tables.SPEEDS: "times",
    tables.JSON: "everything",
}
_ATTRIBUTE_FILES = {tables.ATTRIBUTES: "attributes", tables.BY_ATTRIBUTE: "results by attribute"}


def write_report(evaluation: Evaluation, folder: Path, about: Mapping[str, Any]) -> Path:
    """Write report.html into a folder, beside the files of tables.write, to which it links; return its path.

    about: tables.settings. The same evaluation gives the same bytes. ImportError without matplotlib.
    """
    svg.require()
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / REPORT
    page = _page(evaluation, about)
    with naming(path):
        path.write_text(page, encoding="utf-8", newline="\n")
    return path


def _page(evaluation: Evaluation, about: Mapping[str, Any]) -> str:
    name = Path(about["dataset"]).resolve().name if "dataset" in about else "a data set"
    head = tag(
        "head", _metas(), tag("title", f"{name}, tricue evaluation"), tag("style", _asset("style.css"))
    )
    groups = [Group.of(evaluation, each, _lines(evaluation)) for each in evaluation.groups]
    ranked = worst_first(evaluation)
    pictured = {each.opened.entry.name for each in ranked[:MAX_PICTURED]}
    styles = line_styles(evaluation.trackers)
    sections = [_group(each, evaluation, ranked, pictured, styles) for each in groups]
    main = tag(
        "main", _header(evaluation, name, groups), sections, troubles(evaluation), setup(evaluation, about)
    )
    return (
        "<!DOCTYPE html>\n" + tag("html", head, tag("body", main, tag("script", _script())), lang="en") + "\n"
    )


def _metas() -> Html:
    """The security policy lets the browser load nothing, and run only the script that sorts tables."""
    digest = base64.b64encode(hashlib.sha256(_script().encode()).digest()).decode()
    policy = f"default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'sha256-{digest}'"
    return joined(
        tag("meta", charset="utf-8"),
        tag("meta", http_equiv="Content-Security-Policy", content=policy),
        tag("meta", name="viewport", content="width=device-width, initial-scale=1"),
    )


def _lines(evaluation: Evaluation) -> list[dict[str, Any]]:
    both = zip(tables.summary(evaluation), tables.speeds(evaluation), strict=True)
    return [{**line, **speed} for line, speed in both]


def _header(evaluation: Evaluation, name: str, groups: Sequence[Group]) -> Html:
    files = _FILES | (_ATTRIBUTE_FILES if evaluation.attributes else {})
    links = [tag("span", tag("a", file, href=file), f" ({what})") for file, what in files.items()]
    places = [(each.name, _TITLES.get(each.name, each.name)) for each in groups]
    wrong = [("troubles", "What didn't run")] if troubles(evaluation) else []
    nav = [tag("a", title, href=f"#{place}") for place, title in [*places, *wrong, ("setup", "Setup")]]
    return tag(
        "header",
        tag("p", "tricue evaluation", class_="kicker"),
        tag("h1", name),
        tag("p", _sentence(evaluation), class_="lead"),
        tag("nav", nav, aria_label="parts of this page"),
        tag("p", "The numbers in full: ", [(" ", each) for each in links], class_="files"),
        _how_to_read(),
    )


def _sentence(evaluation: Evaluation) -> str:
    ours = [each.name for each in evaluation.trackers if each.ours]
    baselines = [each.name for each in evaluation.trackers if not each.ours]
    frames = {each.row.sequence: each.row.frames for each in evaluation.one_pass}
    seeds = evaluation.options.seeds
    seeded = f"; those that draw random numbers ran with {seeds} seeds" if seeds > 1 else ""
    beside = f"{', beside ' if ours else ''}{_listed(baselines)}" if baselines else ""
    count = len(evaluation.opened)
    sequences_ = "one sequence" if count == 1 else f"{count} sequences"
    trackers = f"{len(ours) + len(baselines)} trackers" if len(ours) + len(baselines) > 1 else "One tracker"
    return f"{trackers} on {sequences_}, {sum(frames.values()):,} frames: {_listed(ours)}{beside}{seeded}."


def _listed(names: Sequence[str]) -> str:
    return ", ".join(names[:-1]) + (" and " if len(names) > 1 else "") + names[-1] if names else ""


def _how_to_read() -> Html:
    scale = [tag("span", style=f"background:{shade}") for shade in SHADES]
    keys = [
        tag(
            "li",
            tag("span", "0", scale, "1", class_="scale"),
            " overlap (IoU) with the true box, the lowest in each interval",
        ),
        tag("li", tag("span", class_="key", style=f"background:{ABSENT_COLOR}"), " the target is absent"),
        tag(
            "li",
            tag("span", class_="key", style=f"background:{NOT_TRACKED}"),
            " below: the status is not TRACKED",
        ),
        tag("li", tag("span", class_="key truth"), " white and dashed in pictures: the true box"),
    ]
    return tag(
        "section",
        tag("h2", "How to read this"),
        tag(
            "p",
            "Every tracker starts on the first true box and runs to the end without help. Arrows in the"
            " tables show whether higher or lower is better, the best numbers are marked, and a click on a"
            " heading sorts. tricue's trackers have solid lines, all others dashed ones; a tracker has the"
            " same color everywhere. In timelines, time runs to the right:",
        ),
        tag("ul", keys, class_="keys"),
        class_="how",
    )


def _group(
    group: Group,
    evaluation: Evaluation,
    ranked: Sequence[RankedSequence],
    pictured: set[str],
    styles: Mapping[str, LineStyle],
) -> Html:
    mine = [each for each in ranked if each.opened.group == group.name]
    ours = set(group.ours)
    count = "one sequence" if len(mine) == 1 else f"{len(mine)} sequences"
    parts: list[Any] = [tag("h2", _TITLES.get(group.name, group.name), tag("small", count))]
    if group.lines:
        compared = {key: comparison(evaluation, group.name, key) for key in BETTER}
        parts += [
            summary_table(group.name, group.lines, len(mine), ours, styles, compared),
            protocol_table(evaluation, group.name, styles),
            matrix(evaluation, group.name),
            attribute_table(evaluation, group.name),
            plots(group, styles),
        ]
    else:
        parts.append(tag("p", "No run on these sequences finished.", class_="note"))
    parts += [tag("h3", "Sequences, worst first"), _order(len(ranked))]
    parts.append(sequences(mine, pictured, ours, styles, evaluation.options.seeds > 1))
    return tag("section", parts, id=group.name)


def _order(total: int) -> Html:
    """A text on how the list is sorted and what its pictures show."""
    words = (
        "By the AUC of tricue's best tracker on each. The pictures show its first and its worst frames, with"
        " the boxes of tricue's trackers and of the two best baselines."
    )
    few = f" Of all {total} sequences the {MAX_PICTURED} worst have pictures." if total > MAX_PICTURED else ""
    return tag("p", words + few, class_="note")


def _script() -> Html:
    return _asset("sort.js")


def _asset(name: str) -> Html:
    return Html(Path(__file__).with_name(name).read_text(encoding="utf-8"))
