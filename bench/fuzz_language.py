"""Bad input: mutated files and random token strings, on all cores.

Every text must end in a model or in messages: no traceback, no text over 5 s, no process over 1 GB.

    python bench/fuzz_language.py --count 100000 --seed 1
"""

from __future__ import annotations

import argparse
import contextlib
import os
import random
import re
import resource
import sys
import time
import traceback
from concurrent.futures import ProcessPoolExecutor, as_completed
from dataclasses import dataclass, field
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
SLOWEST, LARGEST = 5.0, 1024.0
WORDS = """planar partial model connector record function package shape end initial equation
parameter constant input output flow final import extends type liaison joint body corps frame
repère curve surface force with driven when then elsewhen if else elseif for in loop and or not
true false as on at rotated Real Integer Boolean Length Voltage Torque Pin r c p v i x y z n M
TwoPin Resistor time
der connect reinit pre edge sample assert terminate friction sum size zeros transpose enumeration
min max floor mod noEvent smooth mode stick kinematic geometric
guess world experiment ground line G rod ring rotoide coulomb mu 0 1 2.5 1e400 99999999 kg m/s deg
degC °C N.m ; ; ; ( ) ( ) , , = = . . [ ] : + - * / ^ < <= == <> "text" // /* */ { } % ∞ é \\ \0"""


@dataclass(slots=True)
class Outcome:
    """What a batch of texts did: counts, the slowest, faults of ours with their texts."""

    texts: int = 0
    models: int = 0
    seconds: float = 0.0
    slowest: float = 0.0
    slowest_text: str = ""
    memory: float = 0.0
    faults: list[tuple[str, str]] = field(default_factory=list)


def sources() -> list[str]:
    """Texts to begin with: examples, models and the faulty texts of the tests."""
    folders = ["tests/dsl/examples", "tests/dsl/diagnostics", "models", "tests/dsl/sound"]
    found = [p for folder in folders for p in sorted((ROOT / folder).rglob("*.frot"))]
    return [p.read_text(encoding="utf-8") for p in found]


_KEYWORDS = """planar partial model connector record function package end initial equation
parameter constant input output flow final import extends type liaison body frame curve surface
force with when then elsewhen if else elseif for in loop and or not true false on at rotated"""
KEYWORDS = set(_KEYWORDS.split())
NUMBERS = ("0", "-1", "1", "2", "3", "2.5", "1e9", "100000", "n", "x", "1:2")


def exchanged(text: str, draw: random.Random, others: list[str]) -> str:
    """A text with names, numbers, operators and lines exchanged: its syntax mostly stays."""
    for _ in range(draw.randint(1, 3)):
        words = [m for m in re.finditer(r"[^\W\d]\w*", text) if m[0] not in KEYWORDS]
        kind = draw.randrange(6)
        if kind < 3 and words:
            one, put = draw.choice(words), draw.choice(words)[0]
        elif kind == 3 and (found := list(re.finditer(r"\b\d[\d.]*", text))):
            one, put = draw.choice(found), draw.choice(NUMBERS)
        elif kind == 4 and (found := list(re.finditer(r" [-+*<>/] |[*/^]", text))):
            one, put = draw.choice(found), draw.choice((" + ", " - ", "*", "/", " < ", "^", ", "))
        else:
            lines = text.splitlines(keepends=True)
            whole = [line for line in lines if line.rstrip().endswith(";") and "end" not in line]
            if draw.random() < 0.3:
                whole = [x for x in draw.choice(others).splitlines(keepends=True) if ";" in x]
            if whole:
                here = draw.randrange(len(lines))
                line = draw.choice(whole)
                if draw.random() < 0.5 or lines[here] not in whole:
                    lines.insert(here, line)
                else:
                    lines[here] = line
            text = "".join(lines)
            continue
        text = text[: one.start()] + put + text[one.end() :]
    return text


def mutated(text: str, draw: random.Random, others: list[str]) -> str:
    """A text with a few edits: pieces left out, doubled, exchanged, words put in."""
    words = WORDS.split()
    for _ in range(draw.randint(1, 6)):
        start = draw.randrange(len(text) + 1)
        length = draw.choice((1, 1, 3, 10, 40, 200))
        match draw.randrange(7):
            case 0:
                text = text[:start] + text[start + length :]
            case 1:
                text = text[:start] + text[start : start + length] * 2 + text[start + length :]
            case 2:
                text = text[:start] + f" {draw.choice(words)} " + text[start:]
            case 3:
                text = text[:start] + f" {draw.choice(words)} " + text[start + length :]
            case 4:
                text = text[:start] + chr(draw.randrange(0x2FF)) + text[start + 1 :]
            case 5:
                other = draw.choice(others)
                place = draw.randrange(len(other) + 1)
                text = text[:start] + other[place : place + length] + text[start:]
            case _:
                lines = text.splitlines(keepends=True)
                draw.shuffle(lines) if draw.random() < 0.1 else lines.reverse()
                text = "".join(lines) if draw.random() < 0.2 else text
    return text


def random_words(draw: random.Random) -> str:
    """A string of words, half of them inside of a model."""
    words = WORDS.split()
    text = " ".join(draw.choice(words) for _ in range(draw.randint(0, 120)))
    return text if draw.random() < 0.5 else f"model M\n{text}\nend M;\n"


def batch(seed: int, count: int) -> Outcome:
    """Check `count` texts made from a seed."""
    from frot.dsl import Log, compile_text, default_values, format_text, render_log
    from frot.dsl.checked.show import show_model

    draw = random.Random(seed)
    texts = sources()
    sound = [t for t in texts if "//! " not in t]
    result = Outcome()
    for _ in range(count):
        kind = draw.random()
        if kind < 0.2:
            text = random_words(draw)
        elif kind < 0.65:
            text = exchanged(draw.choice(sound), draw, sound)
        else:
            text = mutated(draw.choice(texts), draw, texts)
        begun = time.perf_counter()
        try:
            log = Log()
            model = compile_text(text, log)
            render_log(log)
            if (model is None) != log.failed:
                raise AssertionError("a model beside errors, or neither")
            if model is not None:
                result.models += 1
                show_model(model)
                with contextlib.suppress(ValueError):
                    default_values(model)
            format_text(text)
        except Exception:
            result.faults.append((traceback.format_exc(), text))
        spent = time.perf_counter() - begun
        result.texts += 1
        result.seconds += spent
        if spent > result.slowest:
            result.slowest, result.slowest_text = spent, text
    result.memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    return result


def main() -> int:
    """Run the batches; the status is 1 where a limit was passed."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=100_000, help="number of texts")
    parser.add_argument("--seed", type=int, default=0, help="of the random numbers")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="processes")
    parser.add_argument("--keep", type=Path, help="folder for the texts that failed")
    options = parser.parse_args()
    size = 250
    seeds = [options.seed * 1_000_003 + k for k in range(-(-options.count // size))]
    whole = Outcome()
    begun = time.perf_counter()
    with ProcessPoolExecutor(options.jobs) as pool:
        for done in as_completed([pool.submit(batch, seed, size) for seed in seeds]):
            part = done.result()
            whole.texts += part.texts
            whole.models += part.models
            whole.seconds += part.seconds
            whole.memory = max(whole.memory, part.memory)
            whole.faults += part.faults
            if part.slowest > whole.slowest:
                whole.slowest, whole.slowest_text = part.slowest, part.slowest_text
            print(
                f"\r{whole.texts} texts, {len(whole.faults)} faults, slowest {whole.slowest:.2f} s"
                f", memory {whole.memory:.0f} MB, {time.perf_counter() - begun:.0f} s",
                end="",
                file=sys.stderr,
                flush=True,
            )
    print(file=sys.stderr)
    print(f"texts     {whole.texts}, of which {whole.models} are models")
    print(f"time      {1000 * whole.seconds / whole.texts:.2f} ms a text")
    print(f"slowest   {whole.slowest:.2f} s (limit {SLOWEST:g} s)")
    print(f"memory    {whole.memory:.0f} MB (limit {LARGEST:g} MB)")
    print(f"faults    {len(whole.faults)}")
    kinds: dict[str, int] = {}
    for fault, _ in whole.faults:
        key = fault.strip().splitlines()[-1][:150] + " | " + fault.strip().splitlines()[-3].strip()
        kinds[key] = kinds.get(key, 0) + 1
    for key, number in sorted(kinds.items(), key=lambda k: -k[1]):
        print(f"  {number} x {key}")
    if options.keep is not None:
        options.keep.mkdir(parents=True, exist_ok=True)
        for k, (fault, text) in enumerate(whole.faults[:50]):
            (options.keep / f"{k}.frot").write_text(text, encoding="utf-8", errors="replace")
            (options.keep / f"{k}.txt").write_text(fault, encoding="utf-8")
        slow = options.keep / "slowest.frot"
        slow.write_text(whole.slowest_text, encoding="utf-8", errors="replace")
    passed = not whole.faults and whole.slowest < SLOWEST and whole.memory < LARGEST
    return 0 if passed else 1


if __name__ == "__main__":
    sys.exit(main())
