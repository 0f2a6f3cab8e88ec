# SPDX-License-Identifier: MIT
"""An HTTP server on 127.0.0.1, at a chosen or a free port, until it is stopped."""

import errno
import logging
import secrets
import socket
import tempfile
import threading
import webbrowser
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path

import uvicorn
from starlette.types import ASGIApp

ADDRESS = "127.0.0.1"
DEFAULT_PORT, MAX_PORT = 8765, 65535
CLOSING_TIME = 2  # seconds for open connections to finish at the end


@dataclass(kw_only=True)
class Served:
    """What is served: its token, a folder for temporary files, and a function that stops it.

    word: puts an error into the words of whoever reads the page.
    """

    token: str = field(default_factory=lambda: secrets.token_urlsafe(24))
    folder: Path = field(default_factory=lambda: Path(tempfile.gettempdir()))
    finish: Callable[[], None] = lambda: None
    word: Callable[[str], str] = str


def serve_until_ended(
    served: Served,
    application: ASGIApp,
    port: int | None,
    browser: bool,
    say: Callable[[str], None],
    announce: Callable[[str], None] = lambda url: None,
) -> None:
    """Serve until Ctrl-C or ``finish``.

    port: None for DEFAULT_PORT, or a free one if that is in use. browser: whether to open a browser. say:
    gets the line with the address, announce: the address. OSError if the port is in use.
    """
    with listening(port) as listener, tempfile.TemporaryDirectory(prefix="tricue-") as folder:
        served.folder = Path(folder)
        url = f"http://{ADDRESS}:{listener.getsockname()[1]}/{served.token}/"
        config = uvicorn.Config(
            application,
            log_level="error",
            ws="websockets-sansio",
            lifespan="off",
            proxy_headers=False,
            timeout_graceful_shutdown=CLOSING_TIME,
        )
        server = uvicorn.Server(config)
        served.finish = lambda: setattr(server, "should_exit", True)
        announce(url)
        say(f"open {url}  (Ctrl-C ends it)")
        threading.Thread(
            target=show, args=(url, browser), daemon=True
        ).start()  # some browsers run until closed
        with _quiet_at_the_end(server):
            server.run(sockets=[listener])


@contextmanager
def _quiet_at_the_end(server: uvicorn.Server) -> Iterator[None]:
    """Keep uvicorn from logging the requests that it aborts at its end; other errors are logged."""

    def is_told(_: logging.LogRecord) -> bool:
        return not server.should_exit

    log = logging.getLogger("uvicorn.error")
    log.addFilter(is_told)
    try:
        yield
    finally:
        log.removeFilter(is_told)


def listening(port: int | None) -> socket.socket:
    """A socket at this port; for None at the default one, or at a free one if that is in use."""
    if port is not None and not 0 <= port <= MAX_PORT:
        raise ValueError(f"port={port}: expected a port from 0 to {MAX_PORT}")
    try:
        return socket.create_server((ADDRESS, DEFAULT_PORT if port is None else port))
    except OSError as error:
        if port is None:
            return socket.create_server((ADDRESS, 0))
        why = {errno.EADDRINUSE: "the port is in use", errno.EACCES: "you have no permission for it"}
        reason = why.get(error.errno or 0, error.strerror)
        raise OSError(f"port={port}: {reason}; give another, or leave it out") from None


def show(url: str, browser: bool) -> None:
    """Open the page, if requested."""
    if browser:
        webbrowser.open(url)
