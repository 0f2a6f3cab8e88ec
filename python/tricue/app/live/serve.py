# SPDX-License-Identifier: MIT
"""Serves a camera's page on 127.0.0.1 until it is stopped, then releases the camera."""

import os
from collections.abc import Callable
from contextlib import closing
from pathlib import Path

from tricue.app.live.server import LiveServing, make_live_app
from tricue.app.live.session import LiveSession, Opened
from tricue.app.local_server import serve_until_ended
from tricue.app.project_file import data_folder


def serve_camera(
    open_: Callable[[], Opened],
    name: str,
    *,
    port: int | None = None,
    browser: bool = True,
    tracker: str = "",
    seed: int = 0,
    say: Callable[[str], None] = print,
    word: Callable[[str], str] = str,
) -> None:
    """Serve a camera until Ctrl-C. The page is served at once, even before the camera is open.

    Recordings go to the working folder, if it can be written to.

    open_: opens it, in a thread. name: shown in the page. port: None for the default one, or a free one if
    that is in use. tracker: the default for new targets. say: gets the lines for the user. word: puts an
    error into the words of whoever reads the page. OSError if the port is in use.
    """
    place = Path.cwd()
    if not os.access(place, os.W_OK):
        place = data_folder()
    with closing(LiveSession(open_, name, place, seed, say)) as session:
        serving = LiveServing(session, tracker=tracker, word=word)
        serve_until_ended(serving, make_live_app(serving), port, browser, say, lambda _: session.start())
