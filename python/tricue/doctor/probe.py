# SPDX-License-Identifier: MIT
"""Runs code in a separate process, so that a crash or a hang is just another answer."""

import json
import signal
import subprocess
import sys
from dataclasses import dataclass
from typing import Any

SECONDS = 60.0
"""After this an import counts as hanging, even on a slow and busy machine."""
_FRAME = """\
import sys
sys.path[:] = {path!r}
import json
def report(**values):
    print({mark!r} + json.dumps(values), flush=True)
try:
{code}
except BaseException as error:
    report(error=type(error).__name__ + ": " + " ".join(str(error).split()))
"""
_MARK = "tricue doctor: "
MAX_ERROR = 300  # characters of an error that are shown


@dataclass(frozen=True)
class ProbeAnswer:
    """The code's report, or why there is none."""

    values: dict[str, Any]
    error: str = ""


def probe(code: str, seconds: float = SECONDS) -> ProbeAnswer:
    """Run code that calls ``report(name=value, ...)`` once, by this Python and on its path."""
    indented = "".join(f"    {line}\n" for line in code.strip().splitlines())
    script = _FRAME.format(path=[*map(str, sys.path)], mark=_MARK, code=indented)
    try:
        done = subprocess.run(
            [sys.executable, "-W", "ignore", "-c", script],
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            errors="replace",
            timeout=seconds,
            check=False,
        )
    except subprocess.TimeoutExpired:
        return ProbeAnswer({}, f"gives no answer for {seconds:g} s")
    except OSError as error:
        return ProbeAnswer({}, f"no process can be started: {error.strerror}")
    return _read(done)


def _read(done: "subprocess.CompletedProcess[str]") -> ProbeAnswer:
    reports = [line for line in done.stdout.splitlines() if line.startswith(_MARK)]
    if not reports:
        return ProbeAnswer({}, _ended(done.returncode))
    values: dict[str, Any] = json.loads(reports[-1].removeprefix(_MARK))
    error = str(values.pop("error", ""))
    return ProbeAnswer(values, error if len(error) <= MAX_ERROR else f"{error[:MAX_ERROR]}...")


def _ended(code: int) -> str:
    if code < 0:
        try:
            return f"ends the process with {signal.Signals(-code).name}"
        except ValueError:
            return f"ends the process with signal {-code}"
    return f"ends the process with exit code {code}"
