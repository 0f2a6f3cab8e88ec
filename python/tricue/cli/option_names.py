# SPDX-License-Identifier: MIT
"""The library's messages as users of the command line read them: with options in place of arguments."""

import re
from collections.abc import Iterator
from contextlib import contextmanager

OPENING = {name: f"--{name.replace('_', '-')}" for name in ("depth_scale", "fps", "port", "topics", "unit")}
"""The options of arguments that several commands take, and that no message begins with otherwise."""

_VALUE = re.compile(r"(^|beside )(depth|fps|port|right)=")  # elsewhere it may be a recording's depth=/topic
_SCALE = re.compile(r"(?<![\w/.-])depth_scale=(?=[\w.])")
_TOPICS = re.compile(r"(?<![\w/.-])topics=\{([^}]*)\}")
_TOPIC = re.compile(r"'([^']*)': '([^']*)'")
_NAME = re.compile(r"(?<![\w/.-])(?:(depth_scale|time_limit)\b(?![/.-])|topics=)")
ADVICE = {
    "rectify the raw images by tricue.camera.rectification.Rectification": "give the raw images and "
    "--calibration FILE --rectify",
    "(tricue.camera.registration.Registration)": "(tricue.camera.registration.Registration, or "
    "--calibration FILE)",
    "m is wide; is it in meters?": "m is wide; is the calibration in meters (--unit)?",
}
"""What the command line has in place of, or beside, what messages advise."""


def by_options(text: str, **options: str) -> str:
    """A message that names the options by which its arguments are set.

    options: those of further arguments, where a message begins with one of these names.
    """
    name, colon, rest = text.partition(":")
    text = f"{(OPENING | options).get(name, name)}{colon}{rest}"
    text = _VALUE.sub(lambda found: f"{found[1]}--{found[2]} ", text)
    text = _SCALE.sub("--depth-scale ", text)
    text = _TOPICS.sub(lambda found: f"--topics {','.join(map('='.join, _TOPIC.findall(found[1])))}", text)
    text = _NAME.sub(lambda found: f"--{(found[1] or 'topics').replace('_', '-')}", text)
    for advice, option in ADVICE.items():
        text = text.replace(advice, option)
    return text


@contextmanager
def naming_options(**options: str) -> Iterator[None]:
    """Errors about these arguments of the library name the options by which users set them."""
    try:
        yield
    except ValueError as error:
        message = by_options(str(error), **options)
        if message == str(error):
            raise
        raise ValueError(message) from error
