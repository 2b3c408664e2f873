"""Whether two versions of Frot record the same bits: all models, scenes of tests and documents.

`python bench/recorded_bits.py keep FILE` runs them and writes a digest of each run: its segments,
its events and its fault. `compare FILE` runs them again and names those that differ; the exit
status is then 1. Runs that take longer than `--seconds` are left out and named.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import os
import re
import signal
import sys
from collections.abc import Iterator
from multiprocessing import Pool
from pathlib import Path

# All bits are the same without optimisation, and most models run shorter than they compile.
os.environ.setdefault("FROT_OPTIMIZE", "0")

import frot

ROOT = Path(__file__).parents[1]
FOLDERS = ("models", "tests/scenes", "bench/models", "bench/models/stiff")
DOCUMENTS = ("README.md", "docs/*.md", "docs/design/*.md")
_BLOCK = re.compile(r"^```frot\n(.*?)^```", re.MULTILINE | re.DOTALL)
_MODEL = re.compile(r"^(?:planar )?model ", re.MULTILINE)
TOO_LONG = "too long"


def texts() -> Iterator[tuple[str, str]]:
    """Name and text of each model: those of files and those of documents."""
    for folder in FOLDERS:
        for path in sorted((ROOT / folder).glob("*.frot")):
            text = path.read_text("utf-8")
            if _MODEL.search(text):
                yield str(path.relative_to(ROOT)), text
    for pattern in DOCUMENTS:
        for path in sorted(ROOT.glob(pattern)):
            for k, text in enumerate(_BLOCK.findall(path.read_text("utf-8"))):
                if _MODEL.search(text):
                    yield f"{path.relative_to(ROOT)}#{k + 1}", text


def _stop(*_: object) -> None:
    raise TimeoutError


def digest(job: tuple[str, str, int]) -> tuple[str, str]:
    """The name of a run and the digest of all that it recorded, or why there is none."""
    name, text, seconds = job
    signal.signal(signal.SIGALRM, _stop)
    signal.alarm(seconds)
    try:
        path = ROOT / name
        model = frot.load(path) if path.is_file() else frot.compile(text)
        result = model.simulate()
        found = hashlib.sha256(result._record.tobytes())
        found.update(repr(result.events).encode())
        return name, found.hexdigest()[:16]
    except TimeoutError:
        return name, TOO_LONG
    except frot.SimulationError as error:
        record = error.result._record if error.result is not None else None
        found = hashlib.sha256(record.tobytes() if record is not None else b"")
        found.update(str(error).encode())
        return name, found.hexdigest()[:16]
    except frot.FrotError as error:
        return name, hashlib.sha256(str(error).encode()).hexdigest()[:16]
    finally:
        signal.alarm(0)


def main() -> int:
    """Keep or compare the digests."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("action", choices=["keep", "compare"])
    parser.add_argument("file", type=Path)
    parser.add_argument("--seconds", type=int, default=60, help="longest run, compiling included")
    options = parser.parse_args()
    jobs = [(name, text, options.seconds) for name, text in texts()]
    with Pool(os.cpu_count()) as pool:
        found = dict(pool.imap(digest, jobs))
    for name, value in found.items():
        if value == TOO_LONG:
            print(f"{name}: longer than {options.seconds} s, left out")
    if options.action == "keep":
        options.file.write_text(json.dumps(found, indent=1) + "\n", "utf-8")
        print(f"{len(found)} runs kept")
        return 0
    kept = json.loads(options.file.read_text("utf-8"))
    both = kept.keys() & found.keys()
    compared = {name for name in both if TOO_LONG not in (kept[name], found[name])}
    other = sorted(name for name in compared if kept[name] != found[name])
    print(*(f"{name}: other bits" for name in other), sep="\n")
    print(f"{len(compared) - len(other)} of {len(compared)} runs have the same bits")
    return 1 if other or not compared else 0


if __name__ == "__main__":
    sys.exit(main())
