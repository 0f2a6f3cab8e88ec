# SPDX-License-Identifier: MIT
from pathlib import Path

import pytest
from tricue.cli.text_file import TextFile


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
