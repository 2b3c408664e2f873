"""What the files of shared libraries say: for whom they are, what they export and need."""

from __future__ import annotations

import re
import struct
import subprocess
from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Said:
    """What a library's file says."""

    machine: str
    exported: frozenset[str]
    needed: frozenset[str]
    oldest: tuple[int, ...]  # version of the system it wants
    signed: bool = False


def _tool(*words: str | Path) -> str:
    return subprocess.run(words, check=True, capture_output=True, text=True).stdout


def elf(path: Path) -> Said:
    """Of Linux: the version is the latest of glibc that a symbol is bound to."""
    text = _tool("readelf", "-hdW", "--dyn-syms", path)
    machine = re.search(r"Machine:\s+(.*)", text)
    assert machine is not None
    rows = re.findall(r"^\s*\d+: \S+ +\d+ \S+ +(?:GLOBAL|WEAK) +\S+ +(\S+) (\S+)", text, re.M)
    versions = [(0,), *(_version(v) for v in re.findall(r"@+GLIBC_([\d.]+)", text))]
    return Said(
        machine[1],
        frozenset(name for section, name in rows if section != "UND"),
        frozenset(re.findall(r"NEEDED.*\[(.*)\]", text)),
        max(versions),
    )


def _version(text: str) -> tuple[int, ...]:
    return tuple(map(int, text.split(".")))


def pe(path: Path) -> Said:
    """Of Windows."""
    text = _tool("objdump", "-p", path)
    table = text.partition("[Ordinal/Name Pointer] Table")[2].partition("\n\n")[0]
    machine = re.search(r"file format (\S+)", text)
    version = re.search(
        r"MajorSubsystemVersion\s+(\d+)\n?.*?\n?MinorSubsystemVersion\s+(\d+)", text
    )
    assert machine is not None and version is not None
    exported = re.findall(r"^\s*\[ *\d+\] (?:\+base\[ *\d+\] )?(?:[0-9a-f]+ )?(\S+)$", table, re.M)
    return Said(
        machine[1],
        frozenset(exported),
        frozenset(re.findall(r"DLL Name: (\S+)", text)),
        (int(version[1]), int(version[2])),
    )


_SYMBOLS, _LIBRARY, _SIGNATURE, _BUILD, _OLDER = 0x2, 0xC, 0x1D, 0x32, 0x24
_CPUS = {0x01000007: "x86_64", 0x0100000C: "arm64"}


def mach_o(path: Path) -> Said:
    """Of macOS, 64 bits."""
    data = path.read_bytes()
    magic, cpu, _, kind, count = struct.unpack_from("<5I", data)
    assert (magic, kind) == (0xFEEDFACF, 6), "not a dynamic library of 64 bits"
    exported, needed, oldest, signed = set(), set(), (0,), False
    at = 32
    for _ in range(count):
        command, size = struct.unpack_from("<2I", data, at)
        if command == _SYMBOLS:
            exported = set(_mach_o_symbols(data, *struct.unpack_from("<4I", data, at + 8)))
        elif command == _LIBRARY:
            start = at + struct.unpack_from("<I", data, at + 8)[0]
            needed.add(data[start : data.index(b"\0", start)].decode())
        elif command in (_BUILD, _OLDER):
            least = struct.unpack_from("<I", data, at + (12 if command == _BUILD else 8))[0]
            oldest = (least >> 16, least >> 8 & 255)
        signed = signed or command == _SIGNATURE
        at += size
    return Said(_CPUS[cpu], frozenset(exported), frozenset(needed), oldest, signed)


def _mach_o_symbols(data: bytes, symbols: int, count: int, names: int, _: int) -> list[str]:
    """External ones that are defined and not private."""
    found = []
    for i in range(count):
        name, kind = struct.unpack_from("<IB", data, symbols + 16 * i)
        if kind & 0x01 and not kind & 0x10 and kind & 0x0E:
            start = names + name
            found.append(data[start : data.index(b"\0", start)].decode().removeprefix("_"))
    return found
