# SPDX-License-Identifier: MIT
import os
from pathlib import Path

import pytest
from tricue.draw.writable import check_writable, naming


def test_nothing_is_touched(tmp_path: Path) -> None:
    """It proves that a file stays as it is, and that none is made, nor a folder."""
    path = tmp_path / "o.csv"
    path.write_bytes(b"before")
    os.utime(path, (1, 1))
    check_writable(path)
    check_writable(tmp_path / "new" / "folder" / "o.csv")
    assert (path.read_bytes(), path.stat().st_mtime) == (b"before", 1)
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize(
    ("name", "error"),
    [(".", "Is a directory"), ("file/o.csv", "Not a directory"), ("n" * 300, "File name too long")],
)
def test_what_cannot_be_written_is_named(tmp_path: Path, name: str, error: str) -> None:
    """It proves that a folder, a place below a file, and a name that no file can have are errors."""
    (tmp_path / "file").touch()
    with pytest.raises(OSError, match=f"{error}: .*{tmp_path.name}"):
        check_writable(tmp_path / name)


@pytest.mark.skipif(not hasattr(os, "geteuid") or os.geteuid() == 0, reason="root may write everywhere")
@pytest.mark.parametrize("name", ["file", "folder/o.csv", "folder/new/o.csv"])
def test_permissions_are_asked_for(tmp_path: Path, name: str) -> None:
    """It proves that a file and a folder that may not be written are errors."""
    (tmp_path / "file").touch(0o444)
    (tmp_path / "folder").mkdir(0o555)
    with pytest.raises(PermissionError, match=name):
        check_writable(tmp_path / name)


def test_pipes_are_left_alone() -> None:
    """It proves that no pipe is opened, which would wait for a reader, or tell it of an end."""
    reading, writing = os.pipe()
    os.close(writing)
    try:
        check_writable(Path(f"/dev/fd/{reading}"))
    finally:
        os.close(reading)
    check_writable(Path(os.devnull))


@pytest.mark.parametrize("error", [OSError(28, "No space left on device"), OSError("encoder error -2")])
def test_a_file_that_is_being_written_is_named(error: OSError) -> None:
    """It proves that the message stays, and gets the file."""
    with pytest.raises(OSError, match=error.strerror or str(error)) as found, naming(Path("results/o.png")):
        raise error
    assert (found.value.errno, found.value.filename) == (error.errno, "results/o.png")
