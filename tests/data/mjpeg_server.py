# SPDX-License-Identifier: MIT
"""A camera in the network: an HTTP server that sends JPEG images one after the other, and can be stopped."""

import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from threading import Event, Thread

import cv2
import numpy as np

SIZE = 64, 48


class MjpegServer:
    """Sends images whose levels count the frames, ``fps`` a second, while it is started."""

    def __init__(self, fps: float = 50.0) -> None:
        self.fps, self.port = fps, 0
        self.begin = time.monotonic()

    def start(self) -> None:
        """Begin to listen; at the same port as before."""
        self._stopped = Event()
        handler = type("Handler", (_Handler,), {"owner": self})
        ThreadingHTTPServer.allow_reuse_address = True
        self._server = ThreadingHTTPServer(("127.0.0.1", self.port), handler)
        self._server.daemon_threads = True
        self.port = self._server.server_address[1]
        self._thread = Thread(target=self._server.serve_forever, args=(0.02,), daemon=True)
        self._thread.start()

    def stop(self) -> None:
        """End all connections, and listen no more."""
        self._stopped.set()
        self._server.shutdown()
        self._server.server_close()
        self._thread.join()

    @property
    def url(self) -> str:
        """Where the stream is."""
        return f"http://127.0.0.1:{self.port}/stream"

    def level(self) -> int:
        """The level of the image that is sent now: 20 more each second, from 20 on."""
        return 20 + int(20 * (time.monotonic() - self.begin)) % 200

    def images(self) -> Iterator[bytes]:
        """JPEG images until the server stops."""
        while not self._stopped.wait(1 / self.fps):
            image = np.full((SIZE[1], SIZE[0], 3), self.level(), np.uint8)
            yield cv2.imencode(".jpg", image)[1].tobytes()


class _Handler(BaseHTTPRequestHandler):
    owner: MjpegServer

    def do_GET(self) -> None:
        self.send_response(200)
        self.send_header("Content-Type", "multipart/x-mixed-replace; boundary=frame")
        self.end_headers()
        with suppress(OSError):  # the reader is gone
            for jpeg in self.owner.images():
                head = f"--frame\r\nContent-Type: image/jpeg\r\nContent-Length: {len(jpeg)}\r\n\r\n"
                self.wfile.write(head.encode() + jpeg + b"\r\n")

    def log_message(self, *_: object) -> None:
        """Stay silent."""


@contextmanager
def mjpeg_server(fps: float = 50.0) -> Iterator[MjpegServer]:
    """A started server."""
    server = MjpegServer(fps)
    server.start()
    try:
        yield server
    finally:
        with suppress(OSError):
            server.stop()
