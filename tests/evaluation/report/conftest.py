# SPDX-License-Identifier: MIT
"""A small evaluation with its report, and headless Chromium to open it in."""

import json
import os
import select
import shutil
import subprocess
import sys
import time

import cv2
import numpy as np
import pytest
from tricue.evaluation import tables
from tricue.evaluation.evaluate import Options, evaluate
from tricue.evaluation.report.page import write_report
from tricue.scenes import walker

HOSTILE = '<script>alert(1)</script> & "quoted"'  # a folder in a folder
TRACKERS = ("color-particle", "depth-particle", "meanShift", "still-box")
CHROMIUMS = ("chromium", "chromium-browser", "google-chrome")
PATIENCE = 60.0  # seconds that a busy machine may take to answer


@pytest.fixture(scope="session")
def hostile():
    """The name of a sequence that must not become HTML."""
    return HOSTILE


@pytest.fixture(scope="session")
def mixed(folders, tmp_path_factory):
    """A data set of the three color sequences, one of a hostile name, one of depth, and an unreadable one."""
    root = tmp_path_factory.mktemp("mixed")
    for place in folders.iterdir():
        shutil.copytree(place, root / place.name)
    shutil.copytree(folders / "there", root / HOSTILE)
    write_depth(root / "walk", walker(0, 24))
    (root / "broken" / "img").mkdir(parents=True)
    (root / "broken" / "groundtruth_rect.txt").write_text("1,2,three,4\n")
    return root


def write_depth(folder, scene):
    """A depth sequence as VOT lays it out; the target is absent in frames 10 to 13, which say so."""
    (folder / "depth").mkdir(parents=True)
    for index, frame in enumerate(scene.frames, 1):
        picture = np.nan_to_num(frame.depth * 1000).astype(np.uint16)
        cv2.imwrite(str(folder / "depth" / f"{index:08d}.png"), picture)
    (folder / "sequence").write_text("channels.depth=depth/%08d.png\nfps=15\n")
    boxes = [",".join(f"{value:.2f}" for value in box) for box in scene.boxes]
    boxes[10:14] = ["nan,nan,nan,nan"] * 4
    (folder / "groundtruth.txt").write_text("\n".join(boxes) + "\n")


@pytest.fixture(scope="session")
def evaluation(mixed, tmp_path_factory):
    """Two trackers of tricue and two baselines on the mixed data set, from two seeds."""
    options = Options(TRACKERS, settings={"color-particle": {"particles": 60}}, seeds=2)
    return evaluate(mixed, tmp_path_factory.mktemp("evaluation"), options)


@pytest.fixture(scope="session")
def about(evaluation, mixed):
    """Its settings, as the command writes them."""
    return tables.settings(evaluation, dataset=str(mixed), jobs=1)


@pytest.fixture(scope="session")
def report(evaluation, about, tmp_path_factory):
    """The path of its report, the tables beside it."""
    folder = tmp_path_factory.mktemp("report")
    tables.write(evaluation, folder, about)
    return write_report(evaluation, folder, about)


@pytest.fixture(scope="session")
def chromium(tmp_path_factory):
    """A headless Chromium without network; TRICUE_CHROMIUM names another than that on the path."""
    found = os.environ.get("TRICUE_CHROMIUM") or next(filter(None, map(shutil.which, CHROMIUMS)), None)
    if found is None:
        pytest.skip("needs chromium: apt-get install chromium")
    with Chromium(found, tmp_path_factory.mktemp("chromium")) as browser:
        yield browser


class Chromium:
    """The DevTools protocol over two pipes: JSON messages, each ended by a zero byte."""

    def __init__(self, program, profile):
        (theirs, self._out), (self._in, other) = os.pipe(), os.pipe()
        # Chromium reads from descriptor 3 and writes to 4.
        place = (
            f"import os, sys; os.dup2({theirs}, 3); os.dup2({other}, 4); os.execvp(sys.argv[1], sys.argv[1:])"
        )
        switches = [
            "--headless",
            "--no-sandbox",
            "--disable-gpu",
            "--disable-dev-shm-usage",
            "--remote-debugging-pipe",
        ]
        offline = ["--host-resolver-rules=MAP * ~NOTFOUND", f"--user-data-dir={profile}"]
        self._process = subprocess.Popen(
            [sys.executable, "-c", place, program, *switches, *offline],
            pass_fds=(theirs, other),
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        os.close(theirs)
        os.close(other)
        self._count, self._rest, self.events = 0, b"", []

    def __enter__(self):
        return self

    def __exit__(self, *_):
        os.close(self._out)
        os.close(self._in)
        self._process.terminate()
        self._process.wait(PATIENCE)

    def open(self, path, width, height=800):
        """A page that has loaded the file, ``width`` pixels wide."""
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        page = Page(self, session)
        for domain in ("Page", "Runtime", "Log", "Network"):
            page.call(f"{domain}.enable")
        size = {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 500}
        page.call("Emulation.setDeviceMetricsOverride", **size)
        page.call("Page.navigate", url=path.as_uri())
        self._until(lambda message: page.is_event(message, "Page.loadEventFired"))
        return page

    def call(self, method, session=None, **params):
        """The answer to a command."""
        self._count += 1
        message = {"id": self._count, "method": method, "params": params}
        os.write(
            self._out, json.dumps(message | ({"sessionId": session} if session else {})).encode() + b"\0"
        )
        answer = self._until(lambda message: message.get("id") == self._count)
        assert "error" not in answer, answer
        return answer["result"]

    def _until(self, wanted):
        while True:
            message = self._read()
            if wanted(message):
                return message
            self.events.append(message)

    def _read(self):
        until = time.monotonic() + PATIENCE
        while b"\0" not in self._rest:
            ready, _, _ = select.select([self._in], [], [], max(0.0, until - time.monotonic()))
            assert ready, "chromium doesn't answer"
            data = os.read(self._in, 1 << 16)
            assert data, "chromium ended"
            self._rest += data
        message, _, self._rest = self._rest.partition(b"\0")
        return json.loads(message)


class Page:
    """A tab."""

    def __init__(self, browser, session):
        self._browser, self._session = browser, session

    def call(self, method, **params):
        return self._browser.call(method, self._session, **params)

    def is_event(self, message, *methods):
        """Whether a message is one of these events of this page."""
        return message.get("sessionId") == self._session and message.get("method") in methods

    def events(self, *methods):
        """The parameters of these events so far."""
        return [each["params"] for each in self._browser.events if self.is_event(each, *methods)]

    def evaluate(self, script):
        """The value of an expression, promises awaited."""
        answer = self.call("Runtime.evaluate", expression=script, returnByValue=True, awaitPromise=True)
        assert "exceptionDetails" not in answer, answer
        return answer["result"].get("value")
