# SPDX-License-Identifier: MIT
"""Parameters in a notebook: those that aren't the defaults stand out."""

from dataclasses import fields

from tricue.evaluation.report.markup import Html
from tricue.notebook.markup import faint, strong, table
from tricue.track.base.params import Params

HEADS = ("name", "value", "default", "unit", "meaning", "source")


def params_html(params: Params) -> Html:
    """Name, value, default, unit, meaning and source of each; values that aren't the default are bold."""
    rows, changed = [], 0
    for each in fields(params):
        value = getattr(params, each.name)
        words = [each.metadata.get(key, "") for key in ("unit", "doc", "source")]
        if value == each.default:
            rows.append((each.name, str(value), faint(str(each.default)), *words))
        else:
            changed += 1
            rows.append((strong(each.name), strong(str(value)), str(each.default), *words))
    count = f"{changed} of {len(rows)} changed" if changed else "all as by default"
    return table(Html(f"{strong(type(params).__name__)}, {count}"), HEADS, rows)
