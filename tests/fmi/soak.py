"""Random calls on FMUs built with a sanitizer: a million of them, or as many as are asked for.

Usage: PYTHONPATH=tests python tests/fmi/soak.py [CALLS [address|thread [SEED]]]

`address` finds errors of memory and undefined behaviour, `thread` data races of four instances in
threads. Each report ends the run with another status than zero. A model with dry friction and
events is called in both versions, for co-simulation and model exchange.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path

from c_objects import SANITIZED, c_objects
from fmu_fuzz import CALLS
from fmu_host import MOST_WORK
from frot.runtime.fmi.scalars import scalars
from frot.runtime.fmi.sources import MOST_WORK as USUAL
from frot.runtime.fmi.sources import source_files, to_compile
from frot.runtime.program import Program
from made_once import FOLDER

import frot

HERE = Path(__file__).parent
TEXT = """planar model Soaked
  parameter Real mu = 0.3;
  parameter Mass m = 1 kg;
  parameter Velocity v0 = 1 m/s;
  input Force push(start = 0 N);
  body b: particle(mass = m);
  curve floor on ground: line(through = (0, 0) m, direction = (1, 0));
  liaison c: contact_ponctuel(b, floor) with coulomb(mu);
  force f: on(b, value = (push + 4 N*sin(8*time/(1 s)), 0 N));
  output Length x = b.position.x;
  Integer k(start = 0);
initial
  b.position = (0, 0) m;
  b.velocity = (v0, 0 m/s);
equation
when sample(0.1 s, 0.1 s) then
  k = pre(k) + 1;
end when;
  experiment(stop = 2 s);
end Soaked;
"""
FLAGS = {
    "address": SANITIZED,
    "thread": ("-std=c99", "-g1", "-O0", "-ffp-contract=off", "-fPIC", "-fsanitize=thread"),
}
RUNTIMES = {"address": ("libasan.so", "libubsan.so"), "thread": ("libtsan.so",)}


def build(program: Program, version: int, sanitizer: str, folder: Path) -> Path:
    """The library with the sanitizer; steps are given up soon."""
    folder.mkdir()
    sources = source_files(program, f"{version}.0")
    for name, content in sources.items():
        (folder / name).write_bytes(content.replace(b"= %d;" % USUAL, b"= %d;" % MOST_WORK))
    files = [folder / name for name in to_compile(sources)]
    flags = FLAGS[sanitizer]
    objects = c_objects(files, [folder], flags)
    library = folder / "soaked.so"
    command = ["cc", "-shared", *flags, "-o", str(library), *map(str, objects), "-lm"]
    subprocess.run(command, check=True)
    return library


def preloaded(sanitizer: str) -> Mapping[str, str]:
    """The environment of a process whose libraries have the sanitizer, but not itself."""
    found = [
        subprocess.run(
            ["cc", f"-print-file-name={name}"], capture_output=True, text=True, check=True
        ).stdout.strip()
        for name in RUNTIMES[sanitizer]
    ]
    return os.environ | {
        "LD_PRELOAD": " ".join(found),
        "ASAN_OPTIONS": "detect_leaks=0:allocator_may_return_null=1",
        "TSAN_OPTIONS": "halt_on_error=1",
        "PYTHONPATH": os.pathsep.join(sys.path),
    }


def soak(
    calls: int,
    sanitizer: str,
    seed: int,
    versions: Sequence[int] = (2, 3),
    instances: int = 4,
) -> int:
    """The status of the first process that a report ends, 0 where none does.

    `instances`: those in threads of one process, for the sanitizer of threads.
    """
    program = frot.compile(TEXT).program()
    _, variables = scalars(program)
    threads = instances if sanitizer == "thread" else 1
    with tempfile.TemporaryDirectory() as folder:
        os.environ.setdefault(FOLDER, folder)
        for version in versions:
            library = build(program, version, sanitizer, Path(folder) / str(version))
            sequences = calls // (len(versions) * CALLS)
            words = (HERE / "fmu_fuzz.py", library, version, seed, sequences, threads)
            command = [sys.executable, *map(str, words), program.key, str(len(variables))]
            done = subprocess.run(command, check=False, env=preloaded(sanitizer))
            print(f"FMI {version}.0, {sanitizer}: {sequences * CALLS} calls, {done.returncode}")
            if done.returncode != 0:
                return done.returncode
    return 0


def main() -> int:
    """As the command line says."""
    calls = int(sys.argv[1]) if len(sys.argv) > 1 else 1_000_000
    sanitizer = sys.argv[2] if len(sys.argv) > 2 else "address"
    seed = int(sys.argv[3]) if len(sys.argv) > 3 else 1
    return soak(calls, sanitizer, seed)


if __name__ == "__main__":
    sys.exit(main())
