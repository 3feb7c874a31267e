"""Diagnoses every robot file in folders or wheels, and counts: judged, refused and why, crashed, too slow.

    python benchmarks/robot_files.py WHEEL_OR_FOLDER … [--out results.jsonl] [--every N] [--first K]

The wheels of the published sample are those of ``pip download --no-deps gymnasium==1.4.0 dm-control==1.0.50
pybullet==3.2.7 example-robot-data==6.0.0 brax==0.14.2 drake==1.51.1``; others that furiko was not made with are
``gymnasium-robotics==1.4.2 metaworld==3.1.1 robosuite==1.5.2 safety-gymnasium==1.0.0 gym-aloha==0.1.5 gym-hil==0.1.14
gym-xarm==0.1.1 genesis-world==1.4.5 mani-skill==3.0.1 myosuite==3.0.0 mjlab==1.6.0 playground==0.2.0 rtb-data==2.0.0
dm-robotics-moma==0.10.0``. Files with the same content are taken once. Each source's own folder is given with
``--meshes``, for its files include others beside their folder. A file without any joint, that others include only,
or that names a file which is not there, is not counted as complete.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import re
import resource
import statistics
import subprocess
import sys
import tempfile
import time
import zipfile
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Any

TIMEOUT = 60.0  # [s] for one file, all engines together
MODEL = re.compile(rb"<(mujoco|robot)[\s>]")
PART = b"<mujocoinclude"  # of a model, which includes it
JOINT = (b"<joint", b"<freejoint")


def main() -> None:
    """Diagnose the files and print the counts."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sources", nargs="+", type=Path)
    parser.add_argument("--out", type=Path, help="one JSON document a file")
    parser.add_argument("--limit", type=int, default=0, help="no more than this many files")
    parser.add_argument("--every", type=int, default=1, help="only each so many-th file")
    parser.add_argument("--first", type=int, default=0, help="from this one on, counted from 0")
    chosen = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        roots = [unpacked(source, Path(folder)) for source in chosen.sources]
        files = [(file, root) for root in roots for file in model_files(root)][chosen.first :: chosen.every]
        rows = []
        for number, (file, root) in enumerate(files[: chosen.limit or None], 1):
            row = diagnosed(file, root)
            rows.append(row)
            print(
                f"{number}/{len(files)} {row['seconds']:.1f} s {row['outcome']:9} {row['says'][:100]} {file}",
                flush=True,
            )
            if chosen.out:
                with chosen.out.open("a") as stream:
                    stream.write(json.dumps(row) + "\n")
    print_summary(rows)


def unpacked(source: Path, folder: Path) -> Path:
    """The folder itself, or a wheel's content."""
    if source.is_dir():
        return source
    target = folder / source.stem
    with zipfile.ZipFile(source) as wheel:
        wheel.extractall(target)
    return target


def model_files(root: Path) -> Iterator[Path]:
    """MJCF and URDF files with a joint, each content once."""
    seen: set[bytes] = set()
    for path in sorted(root.rglob("*")):
        if path.suffix not in (".xml", ".urdf", ".mjcf") or not path.is_file():
            continue
        content = path.read_bytes()
        digest = hashlib.sha256(content).digest()
        if (
            digest in seen
            or PART in content
            or MODEL.search(content) is None
            or not any(tag in content for tag in JOINT)
        ):
            continue
        seen.add(digest)
        yield path


def diagnosed(path: Path, root: Path) -> dict[str, Any]:
    """What ``furiko diagnose --json`` says of one file, which may include others below ``root``."""
    start, spent = time.perf_counter(), processor_time()
    command = [sys.executable, "-m", "furiko", "diagnose", str(path), "--meshes", str(root), "--json"]
    row: dict[str, Any] = {"file": str(path), "outcome": "hang", "says": ""}
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=TIMEOUT, check=False)
        row |= outcome(done)
    except subprocess.TimeoutExpired:
        row["says"] = f"beyond {TIMEOUT:g} s"
    row |= {"seconds": time.perf_counter() - start, "processor seconds": processor_time() - spent}
    return row


def processor_time() -> float:
    """What the processes that have ended so far have taken, theirs too [s]: other work on the machine counts little."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def outcome(done: subprocess.CompletedProcess[str]) -> dict[str, Any]:
    """Judged, unjudged, refused or crashed, with what was said."""
    try:
        document = json.loads(done.stdout)
    except json.JSONDecodeError:
        return {"outcome": "crash", "says": (done.stderr or done.stdout)[-300:]}
    if "error" in document:
        kind = "refused" if done.returncode == 2 else "crash"
        return {"outcome": kind, "says": str(document["error"])[:300]}
    asked = {name: engine["status"] for name, engine in document["engines"].items()}
    compared = any(status in ("agrees", "differs") for status in asked.values())
    causes = [finding["cause"] for finding in document["findings"]]
    return {
        "outcome": "judged" if compared else "unjudged",
        "says": f"{document['verdict']} {asked} {causes[:4]}",
        "verdict": document["verdict"],
        "engines": asked,
        "findings": document["findings"],
        "without": document.get("without", []),
        "status": done.returncode,
    }


def print_summary(rows: list[dict[str, Any]]) -> None:
    """The counts, times, verdicts and first causes."""
    count = Counter(row["outcome"] for row in rows)
    seconds = [row["seconds"] for row in rows]
    print(f"{len(rows)} files: " + ", ".join(f"{name} {number}" for name, number in count.most_common()))
    if seconds:
        print(f"median {statistics.median(seconds):.2f} s, longest {max(seconds):.1f} s")
        spent = [row["processor seconds"] for row in rows]
        print(f"of processors: median {statistics.median(spent):.2f} s, most {max(spent):.1f} s")
    print("verdicts: ", Counter(row.get("verdict", "none") for row in rows).most_common())
    print("first causes:", Counter(f["cause"] for row in rows for f in row.get("findings", [])[:1]).most_common(40))


if __name__ == "__main__":
    main()
