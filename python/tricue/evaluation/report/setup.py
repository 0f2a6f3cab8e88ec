# SPDX-License-Identifier: MIT
"""The setup of an evaluation: parameters, versions, machine; and what couldn't be run."""

import dataclasses
import shlex
from collections.abc import Mapping
from typing import Any

from tricue.evaluation.evaluate import Evaluation, Options
from tricue.evaluation.foreign.spec import DEFAULT_TIME_LIMIT
from tricue.evaluation.protocols import ONE_PASS, RESTARTS
from tricue.evaluation.report.markup import Html, joined, scrolled, tag
from tricue.track.base.registry import tracker_class

_VERSIONS = ("tricue", "opencv", "numpy", "python", "machine")
_READING = {"depth_scale": "--depth-scale", "fps": "--fps", "unit": "--unit", "truth": "--truth"}
_MAX_NAMES = 12  # in a sentence; longer lists are folded


def troubles(evaluation: Evaluation) -> Html | None:
    """Unsupported sequences, runs that ended with an error, unreadable sequences; None without any."""
    unsupported: dict[tuple[str, str], list[str]] = {}
    for (tracker, sequence), why in evaluation.left_out.items():
        unsupported.setdefault((tracker, why), []).append(sequence)
    stopped = [each.row for each in evaluation.results if each.row.trouble]
    lists = [
        _list(
            "Not run",
            [
                [tag("b", tracker), f": {why}, {_count(names)}", _names(names)]
                for (tracker, why), names in unsupported.items()
            ],
        ),
        _list(
            "Frames without a box, all from an error on; they count as missed",
            [
                [tag("b", row.tracker), f" on {row.sequence}, {row.run}, seed {row.seed}: {row.trouble}"]
                for row in stopped
            ],
        ),
        _list(
            "Unreadable sequences, not part of any number above",
            [[tag("b", name), f": {error}"] for name, error in evaluation.failed.items()],
        ),
    ]
    lists.append(_list("Notes", [[note] for note in evaluation.notes]))
    return tag("section", tag("h2", "What didn't run"), lists, id="troubles") if any(lists) else None


def setup(evaluation: Evaluation, about: Mapping[str, Any]) -> Html:
    """Parameters, versions, seeds, machine, reading options, and the command that repeats the evaluation."""
    options = evaluation.options
    reading = ", ".join(
        f"{name} {value}" for name, value in dataclasses.asdict(options.reading).items() if value is not None
    )
    facts = {
        **{name: about[name] for name in _VERSIONS if name in about},
        "seeds": f"{options.seeds}, counted from 0; deterministic trackers ran once",
        "protocols": ", ".join(options.orders),
        "restarts": "each run also with restarts after failures" if options.restarts else "none",
        "reading options": reading or "none, as in the files",
        "command": tag("code", command(options, str(about.get("dataset", "DATASET")))),
    }
    listed = [(tag("dt", name), tag("dd", value)) for name, value in facts.items()]
    ours = [
        _parameters(name, values, about.get("changed", {}).get(name, {}))
        for name, values in about.get("parameters", {}).items()
    ]
    return tag(
        "section",
        tag("h2", "Setup"),
        tag("dl", listed, class_="facts"),
        tag("h3", "Parameters"),
        ours,
        id="setup",
    )


def command(options: Options, dataset: str) -> str:
    """The command line that repeats the evaluation."""
    words = ["tricue", "evaluate", dataset]
    plain = [name for name in options.trackers or () if "," not in name and "trax:" not in name]
    words += ["--trackers", ",".join(plain)] if plain else []
    for name in options.trackers or ():
        words += [] if name in plain else ["--trackers", name]
    for results in options.results:
        words += ["--results", results]
    words += [] if options.time_limit == DEFAULT_TIME_LIMIT else ["--time-limit", f"{options.time_limit:g}"]
    words += ["--seeds", str(options.seeds)]
    words += [] if options.restarts or options.protocols else ["--no-restarts"]
    if options.protocols:
        restarts = [RESTARTS] if options.restarts else []
        words += ["--protocols", ",".join((ONE_PASS, *restarts, *options.protocols))]
    for tracker, values in options.settings.items():
        for name, value in values.items():
            words += ["--set", f"{tracker}.{name}={_plain(value)}"]
    for name, flag in _READING.items():
        value = getattr(options.reading, name)
        words += [] if value is None else [flag, str(value)]
    return shlex.join(words)


def _parameters(tracker: str, values: Mapping[str, Any], changed: Mapping[str, Any]) -> Html:
    kind = values.get("tracker", tracker)
    params = tracker_class(kind).Params  # None for a third-party class, whose parameters are unknown
    fields = {} if params is None else {field.name: field for field in dataclasses.fields(params)}
    rows = []
    for name, value in values.items():
        if (field := fields.get(name)) is None:
            continue
        default = tag("small", f" default {_plain(field.default)}") if name in changed else None
        cell = tag("td", tag("strong", _plain(value)) if default else _plain(value), default)
        row = tag("th", name, scope="row"), cell, tag("td", field.metadata.get("unit", ""))
        rows.append(tag("tr", row, class_="changed" if default else None))
    heading = tag("tr", [tag("th", each, scope="col") for each in ("parameter", "value", "unit")])
    table = tag("table", tag("thead", heading), tag("tbody", rows), class_="parameters")
    summary = f"{len(changed)} changed: {', '.join(changed)}" if changed else "all defaults"
    summary = summary if kind == tracker else f"{kind}, {summary}"
    return tag(
        "details",
        tag("summary", tag("b", tracker), f" {summary}"),
        scrolled(table, f"parameters of {tracker}"),
    )


def _list(title: str, items: list[list[Any]]) -> Html | None:
    return joined(tag("h3", title), tag("ul", [tag("li", item) for item in items])) if items else None


def _count(names: list[str]) -> str:
    return "1 sequence" if len(names) == 1 else f"{len(names)} sequences"


def _names(names: list[str]) -> Html:
    text = ", ".join(names)
    if len(names) <= _MAX_NAMES:
        return tag("span", f" ({text})")
    return tag("details", tag("summary", "their names"), tag("p", text))


def _plain(value: Any) -> str:
    return ",".join(map(str, value)) if isinstance(value, (list, tuple)) else str(value)
