# SPDX-License-Identifier: MIT
"""Run tricue's trackers on the recorded sequences, and pack their boxes for publication: ``make results``.

Writes benchmarks/results/tricue-VERSION.tar.xz, in GOT-10k's format with a manifest, and the table in
docs/results.md. The sequences are in the folder TRICUE_DATA, by default ../shared/data. Finished runs are
kept in build/published, so that the same command continues after an interruption.
"""

import argparse
import io
import json
import math
import os
import re
import tarfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import tricue
from tricue.doctor.install import commit
from tricue.evaluation import raw_results, tables
from tricue.evaluation.evaluate import Evaluation, Options, evaluate

ROOT = Path(__file__).parents[1]
DATA = Path(os.environ.get("TRICUE_DATA", ROOT.parent / "shared" / "data"))
WORK = ROOT / "build" / "published"
FOLDER, PAGE = ROOT / "benchmarks" / "results", ROOT / "docs" / "results.md"
TRACKERS = ("color-particle", "depth-particle", "flow-depth", "fused", "stereo-head")
SEEDS = 3
TERMS = "MIT, as tricue; boxes alone, no images and no true boxes"
TABLE = re.compile(r"(?<=<!-- by make results -->\n).*?(?=<!-- end -->)", re.DOTALL)


def pack(raw: Path, archive: Path) -> None:
    """Pack GOT-10k's files reproducibly, without times, which depend on the machine."""
    manifest = json.loads((raw / raw_results.MANIFEST).read_text(encoding="utf-8"))
    manifest["conventions"] = {
        "boxes": manifest["conventions"]["boxes"],
        raw_results.GOT10K: "TRACKER/SEQUENCE/SEQUENCE_00N.txt from seed N - 1",
    }
    archive.parent.mkdir(parents=True, exist_ok=True)
    with tarfile.open(archive, "w:xz", preset=9, format=tarfile.PAX_FORMAT) as packed:
        _add(packed, raw_results.MANIFEST, f"{json.dumps(manifest, indent=1)}\n".encode())
        for path in sorted((raw / raw_results.GOT10K).rglob("*.txt")):
            if not path.name.endswith("_time.txt"):
                _add(packed, path.relative_to(raw).as_posix(), path.read_bytes())


def _add(packed: tarfile.TarFile, name: str, content: bytes) -> None:
    about = tarfile.TarInfo(name)
    about.size = len(content)
    packed.addfile(about, io.BytesIO(content))


def table(evaluation: Evaluation) -> str:
    """Mean success AUC by tracker and group of sequences; "-" if a tracker can't run on them."""
    lines = {(line["tracker"], line["group"]): line for line in tables.summary(evaluation)}
    groups = evaluation.groups
    counts = {group: sum(each.group == group for each in evaluation.opened) for group in groups}
    rows = [f"| tracker | {' | '.join(f'{group}, {counts[group]}' for group in groups)} |"]
    rows.append(f"| --- |{' --- |' * len(groups)}")
    rows += [f"| {name} | {' | '.join(_cells(name, groups, lines))} |" for name in TRACKERS]
    return "\n".join(rows) + "\n"


def _cells(name: str, groups: tuple[str, ...], lines: dict[tuple[str, str], dict[str, Any]]) -> Iterator[str]:
    for group in groups:
        auc = lines.get((name, group), {}).get("auc", math.nan)
        yield "-" if math.isnan(auc) else f"{auc:.3f}"


def main() -> None:
    """Evaluate, pack, and write the table; refuses uncommitted changes, as the manifest names the commit."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--jobs", type=int, default=1, metavar="N", help="processes, default %(default)s")
    jobs = parser.parse_args().jobs
    if commit().endswith("+"):
        raise SystemExit("files are changed: commit them first, since the manifest names the commit")
    options = Options(trackers=TRACKERS, seeds=SEEDS, restarts=False)
    evaluation = evaluate(DATA, WORK, options, jobs=jobs)
    if evaluation.failed:
        raise SystemExit(f"failed: {dict(evaluation.failed)}")
    manifest = raw_results.write_raw(evaluation, WORK, WORK / "raw", tables.settings(evaluation), TERMS)
    archive = FOLDER / f"tricue-{tricue.__version__}.tar.xz"
    pack(manifest.parent, archive)
    text = PAGE.read_text(encoding="utf-8")
    PAGE.write_text(TABLE.sub(lambda _: f"\n{table(evaluation)}\n", text), encoding="utf-8")
    print(f"wrote {archive} ({archive.stat().st_size:,} bytes) and the table of {PAGE}")


if __name__ == "__main__":
    main()
