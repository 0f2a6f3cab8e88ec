# SPDX-License-Identifier: MIT
"""Checks that builds of the native kernels give the same bits: `make levels`, `make sanitize`.

As a pytest plugin (``-p kernel_hashes``) it hashes everything that each kernel returns or raises while the
tests run, and writes the hashes to the file that TRICUE_HASHES names. As a program it compares such files,
and fails if they differ.
"""

import functools
import hashlib
import json
import os
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
from tricue import _core

HASHES = {name: hashlib.sha256() for name in dir(_core) if not name.startswith("_")}


def flat(result: Any) -> Iterator[bytes]:
    """The bytes of all arrays and numbers in a result, with types and shapes."""
    if isinstance(result, tuple):
        for part in result:
            yield from flat(part)
    else:
        array = np.asarray(result)
        yield f"{array.dtype}{array.shape}".encode()
        yield array.tobytes()


def hashed(name: str, kernel: Callable[..., Any]) -> Callable[..., Any]:
    """A wrapper of a kernel that adds its results and errors to its hash."""

    @functools.wraps(kernel)
    def call(*args: Any, **kwargs: Any) -> Any:
        try:
            result = kernel(*args, **kwargs)
        except Exception as error:
            HASHES[name].update(str(error).encode())
            raise
        for part in flat(result):
            HASHES[name].update(part)
        return result

    return call


def pytest_configure() -> None:
    """Replace the kernels by the hashing functions."""
    for name in HASHES:
        setattr(_core, name, hashed(name, getattr(_core, name)))


def pytest_unconfigure() -> None:
    """Write each kernel's hash."""
    hashes = {name: value.hexdigest() for name, value in HASHES.items()}
    Path(os.environ["TRICUE_HASHES"]).write_text(json.dumps(hashes, indent=1))


def main(files: list[str]) -> None:
    """Exit with the names of the kernels whose hashes differ from those of the first file."""
    first, *others = (json.loads(Path(file).read_text()) for file in files)
    different = sorted({name for other in others for name in first if other[name] != first[name]})
    if different:
        sys.exit(f"{', '.join(files)} differ in {', '.join(different)}")
    print(f"{len(first)} kernels give the same bits in {len(files)} builds")


if __name__ == "__main__":
    main(sys.argv[1:])
