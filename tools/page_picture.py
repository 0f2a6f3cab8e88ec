# SPDX-License-Identifier: MIT
"""Take the picture of tricue open's page: a rendered room with depth, in which two people are tracked.

python tools/page_picture.py docs/open.jpg

It needs Chromium, which TRICUE_CHROMIUM names if it isn't on the path.
"""

import argparse
import os
import re
import shutil
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from tricue.scenes import room_scene
from tricue.scenes.files import write_sequence

NAME, SIZE = "walkers", (640, 480)
GUEST = (282, 76, 92, 232)  # around the other person in the first frame, whose boxes no scene has
FRAME = 36  # the one that is shown
WIDTH, HEIGHT, SCALE = 1366, 768, 0.8  # a laptop's, and the picture's pixels per pixel of it
QUALITY = 88
PATIENCE = 60.0  # seconds for each step
CHROMIUMS = ("chromium", "chromium-browser", "google-chrome")


@contextmanager
def served(folder: Path) -> Iterator[str]:
    """The address of the page in which ``tricue open`` shows a folder."""
    command = [sys.executable, "-m", "tricue", "open", str(folder), "--no-browser", "--port", "0"]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    try:
        assert process.stdout is not None
        found = next(filter(None, (re.search(r"http://\S+", line) for line in process.stdout)), None)
        if found is None:
            raise RuntimeError(f"{' '.join(command)}: expected an address; it ended without one")
        yield found[0]
    finally:
        process.terminate()
        process.wait()


def prepare(page: Any, url: str, boxes: dict[str, tuple[float, ...]]) -> None:
    """Track these targets, choose the first one, and go to the frame."""

    def do(command: str, **values: Any) -> None:
        answer = page.request.post(f"{url}do", data={"do": command, **values})
        if not answer.ok:
            raise RuntimeError(f"{command}: {answer.text()}")

    for number, (name, box) in enumerate(boxes.items(), 1):
        do("add", frame=0, box=box, tracker="fused")
        do("rename", target=number, name=name)
    do("track", frame=0)
    until = time.monotonic() + PATIENCE
    while (state := page.request.get(f"{url}state").json())["run"] or not state["saved"]:
        if time.monotonic() > until:
            raise TimeoutError(f"expected an end of the run within {PATIENCE:.0f} s")
        time.sleep(0.05)
    page.goto(url)
    page.locator("html[data-page='shown 0']").wait_for(state="attached")
    page.select_option("#who", "all")
    page.check("#trail")
    page.fill("#frame", str(FRAME))
    page.keyboard.press("Enter")
    page.locator(f"html[data-page='shown {FRAME}']").wait_for(state="attached")
    page.locator(f"#view-depth img[src*='frame/{FRAME}.jpg']").evaluate("(image) => image.decode()")
    page.locator("#saved", has_text=re.compile("^saved")).wait_for()


def take(path: Path) -> None:
    """Write the picture, a JPEG."""
    from playwright.sync_api import sync_playwright

    found = os.environ.get("TRICUE_CHROMIUM") or next(filter(None, map(shutil.which, CHROMIUMS)), None)
    scene = room_scene("walker", seed=0, size=SIZE, channels="rgbd")
    boxes = {"Walker": tuple(scene.boxes[0].tolist()), "Guest": GUEST}
    with TemporaryDirectory() as place, sync_playwright() as driver:
        write_sequence(scene, Path(place) / NAME)
        browser = driver.chromium.launch(executable_path=found, args=["--no-sandbox"])
        viewport: Any = {"width": WIDTH, "height": HEIGHT}
        page = browser.new_context(viewport=viewport, device_scale_factor=SCALE).new_page()
        page.set_default_timeout(1000 * PATIENCE)
        with served(Path(place) / NAME) as url:
            prepare(page, url, boxes)
            page.screenshot(path=path, type="jpeg", quality=QUALITY)
            browser.close()


def main() -> None:
    """Take the picture."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("path", type=Path)
    take(parser.parse_args().path)


if __name__ == "__main__":
    main()
