# SPDX-License-Identifier: MIT
import json
import subprocess
import sys
from pathlib import Path

import pytest
from tricue.export.text_file import TextFile


def test_what_was_put_is_there(tmp_path: Path) -> None:
    """It proves that text is on the disk before the file is closed, as a killed process never closes it."""
    with TextFile(tmp_path / "new" / "o.txt") as file:
        file.put("one\n")
        assert file.path.read_text() == "one\n"
    assert file.about == str(tmp_path / "new" / "o.txt")


def test_a_file_that_vanished_is_told(tmp_path: Path) -> None:
    """It proves that a file that somebody removed isn't taken for written."""
    with (
        pytest.raises(OSError, match=r"o\.txt: was removed while it was written"),
        TextFile(tmp_path / "o.txt") as file,
    ):
        file.path.unlink()


def test_a_full_disk_names_the_file() -> None:
    """It proves that an error of writing has the file's name, and leaves no file open."""
    file = TextFile(Path("/dev/full"))
    with pytest.raises(OSError, match="No space left on device: '/dev/full'"):
        file.put("one\n")
    assert file._file.closed
    with file:
        pass


@pytest.mark.parametrize(
    ("limit", "end"), [*((each, 1) for each in (*range(60, 120, 7), *range(403, 418, 7))), (300, 30)]
)
def test_a_full_disk_keeps_whole_texts(tmp_path: Path, limit: int, end: int) -> None:
    """It proves that a file that may not grow beyond some size gets its end all the same, wherever in a text
    the limit is, even an end that is longer than many texts, and that the error is told.
    """
    program = f"""
import resource
from pathlib import Path
from tricue.export.text_file import TextFile

class Numbers(TextFile):
    def finish(self):
        self.put("0], 'done': [true{", true" * (end - 1)}]}}".replace("'", '"'))

resource.setrlimit(resource.RLIMIT_FSIZE, ({limit}, {limit}))
with Numbers(Path("o.json")) as file:
    file.put('{{"numbers": [')
    for number in range(100):
        file.put(f"{{number}}, ")
"""
    done = subprocess.run(
        [sys.executable, "-c", program], cwd=tmp_path, capture_output=True, text=True, check=False
    )
    assert "File too large: 'o.json'" in done.stderr
    whole = json.loads((tmp_path / "o.json").read_text())
    assert whole["done"]
    assert whole["numbers"] == [*range(len(whole["numbers"]) - 1), 0]
    assert (tmp_path / "o.json").stat().st_size > limit - 25
