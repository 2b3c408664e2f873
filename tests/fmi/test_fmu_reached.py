"""An FMU carries what it may call, and nothing else: sources, and functions of its library."""

from __future__ import annotations

import subprocess
import zipfile
from pathlib import Path

import pytest
from c_objects import c_objects
from frot.compiler.toolchain.compiler_choice import KERNEL_FLAGS
from frot.runtime.fmi.reached import reached
from frot.runtime.fmi.sources import source_files, to_compile
from frot.runtime.program import Program

import frot

MODELS = Path(__file__).parents[2] / "models"
# Of a platform's library in the archive, in bytes.
MOST = 400_000

SMALL = {
    "first.c": """#include "a/first.h"
int frot_first(void) { return frot_second() + FROT_TWICE; }
""",
    "first.h": """#include "b/both.h"
int frot_first(void);
int frot_alone(int x,
               int y);
""",
    "second.c": """/* as frot_alone(x) does */
int frot_second(void) {
  return frot_table[0];
}
""",
    "both.h": """#define FROT_TWICE frot_third(2)
int frot_second(void);
extern const int frot_table[];
static inline int frot_inline(void) { return frot_fourth(); }
""",
    "third.c": """static int alone(void) { return 0; }
int frot_third(int x) { return x; }
""",
    "fourth.c": """double *frot_fourth(const int *x,
                    int y) {
  return 0;
}
""",
    "table.c": """#include "table.h"
const int frot_table[] = {1};
""",
    "table.h": "int frot_table_size(void);\n",
    "alone.c": """#include "alone.h"
int frot_alone(int x, int y) { return x + y; }
""",
    "alone.h": "int frot_alone(int x, int y);\n",
}


def test_files_are_reached_by_calls_tables_macros_and_inline_functions() -> None:
    texts = {name: text.encode() for name, text in SMALL.items()}
    found = reached(texts, ["first.c"])
    assert found == tuple(name for name in SMALL if not name.startswith("alone"))
    assert reached(texts, ["alone.c"]) == ("alone.c", "alone.h")
    assert reached(texts, ["third.c", "none.c"]) == ("third.c",)


def test_the_list_of_motions_is_left_out(program: Program) -> None:
    """Nothing in an FMU calls `frot_motions`; the search that a run shares with it is there."""
    for version in ("2.0", "3.0"):
        sources = source_files(program, version)
        assert not {"list_motions.c", "describe_motion.c"} & set(sources)
        assert {"model.c", "fmu_table.c", "instance.c", "step.c", "frot.h"} <= set(sources)


def test_all_that_is_called_is_there(version: int, program: Program, tmp_path: Path) -> None:
    """The linker knows every name, and finds no file without a function that is called."""
    sources = source_files(program, f"{version}.0")
    for name, content in sources.items():
        (tmp_path / name).write_bytes(content)
    objects = c_objects([tmp_path / n for n in to_compile(sources)], [tmp_path], KERNEL_FLAGS)
    script = tmp_path / "seen.map"
    script.write_text("{ global: fmi*; local: *; };\n")
    words = [f"-Wl,--version-script={script}", "-Wl,-z,defs", "-Wl,--gc-sections", "-lm"]
    words.append("-Wl,--print-gc-sections")
    command = ["cc", "-shared", *map(str, objects), *words, "-o", str(tmp_path / "a.so")]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    dropped = [line for line in done.stderr.splitlines() if ".text.frot_" in line]
    names = {line.split(".text.")[1].split("'")[0] for line in dropped}
    # what other callers of the kernel have besides
    assert len(names) < 40, names


@pytest.mark.parametrize("version", ["2.0", "3.0"])
@pytest.mark.parametrize("name", ["double_pendulum", "rocking_block"])
def test_a_library_is_small(name: str, version: str, tmp_path: Path) -> None:
    frot.load(MODELS / f"{name}.frot").export_fmu(tmp_path / "a.fmu", version, "native")
    with zipfile.ZipFile(tmp_path / "a.fmu") as archive:
        (library,) = (one for one in archive.infolist() if one.filename.startswith("binaries/"))
    assert library.compress_size < MOST
