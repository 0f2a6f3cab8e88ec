# SPDX-License-Identifier: MIT
"""The comparison of two evaluations as one self-contained HTML file."""

from pathlib import Path

from tricue.draw.writable import naming
from tricue.evaluation.bootstrap import Interval
from tricue.evaluation.compare import Change, Comparison
from tricue.evaluation.differences import signed
from tricue.evaluation.report.columns import COLUMNS
from tricue.evaluation.report.markup import Html, joined, number, scrolled, tag

POLICY = "default-src 'none'; style-src 'unsafe-inline'"
_HEADINGS = {column.key: column.heading for column in COLUMNS}
_SHADES = {"better": "higher", "worse": "lower"}
MAX_LISTED = 12
"""Listed sequences per tracker, those that got worse most."""


def write_compare_page(found: Comparison, old: Path, new: Path, path: Path) -> Path:
    """Write the page; return its path. The same comparison gives the same bytes."""
    style = Html(Path(__file__).with_name("style.css").read_text(encoding="utf-8"))
    head = tag(
        "head",
        tag("meta", charset="utf-8"),
        tag("meta", http_equiv="Content-Security-Policy", content=POLICY),
        tag("meta", name="viewport", content="width=device-width, initial-scale=1"),
        tag("title", "tricue comparison"),
        tag("style", style),
    )
    lead = f"Differences of {_HEADINGS[found.number]}, new minus old, paired by sequence."
    header = tag(
        "header",
        tag("p", "tricue compare", class_="kicker"),
        tag("h1", f"{new.name} against {old.name}"),
        tag("p", lead, class_="lead"),
        [tag("p", note, class_="note") for note in found.notes],
    )
    main = tag("main", header, _overview(found), [_sequences(each) for each in found.changes])
    path.parent.mkdir(parents=True, exist_ok=True)
    page = "<!DOCTYPE html>\n" + tag("html", head, tag("body", main), lang="en") + "\n"
    with naming(path):
        path.write_text(page, encoding="utf-8", newline="\n")
    return path


def _overview(found: Comparison) -> Html:
    heads = ("tracker", "group", "protocol", "sequences", "old", "new", "difference", "")
    rows = [
        tag(
            "tr",
            tag("th", each.tracker, scope="row"),
            [tag("td", text) for text in (each.group, each.protocol, len(each.by_sequence))],
            [tag("td", number(value)) for value in (each.old, each.new)],
            tag(
                "td",
                signed(each.difference.mean, 3),
                _ends(each.difference),
                class_=_SHADES.get(each.verdict),
            ),
            tag("td", each.verdict),
        )
        for each in found.changes
    ]
    head = tag("tr", [tag("th", each, scope="col") for each in heads])
    table = tag("table", tag("thead", head), tag("tbody", rows), class_="pairs")
    note = (
        "95 % bootstrap intervals over recordings; better or worse: p under 0.05 in a paired sign-flip test,"
        " by Holm's correction for all lines."
    )
    return joined(tag("h2", "Trackers"), scrolled(table, "trackers"), tag("p", note, class_="note"))


def _ends(difference: Interval) -> Html | None:
    """The ends of the interval in small print; None if unknown."""
    if not difference.known:
        return None
    ends = f"[{signed(difference.low, 3)}, {signed(difference.high, 3)}]"
    return tag("small", ends, class_="interval")


def _sequences(change: Change) -> Html:
    lines = change.worst_first()
    rows = [
        tag(
            "tr",
            tag("th", name, scope="row"),
            [tag("td", number(value)) for value in (old, new)],
            tag("td", signed(new - old, 3)),
        )
        for name, old, new in lines[:MAX_LISTED]
    ]
    head = tag("tr", [tag("th", each, scope="col") for each in ("sequence", "old", "new", "difference")])
    table = tag("table", tag("thead", head), tag("tbody", rows), class_="pairs")
    more = f", the {MAX_LISTED} that lost most of {len(lines)}" if len(lines) > MAX_LISTED else ""
    title = f"{change.tracker}, {change.group}, {change.protocol}{more}"
    return tag(
        "details", tag("summary", tag("b", title)), scrolled(table, title), open=change.verdict == "worse"
    )
