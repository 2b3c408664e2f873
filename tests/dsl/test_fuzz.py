"""No text raises: examples with random edits, and random words. More in bench/fuzz_language.py."""

import random
import sys
import time
from pathlib import Path

from frot.dsl import CODES, Log, compile_text, default_values, dump, render_log
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

sys.path.insert(0, str(Path(__file__).parents[2] / "bench"))
from fuzz_language import exchanged, mutated, sources

TEXTS = [
    p.read_text(encoding="utf-8") for p in sorted((Path(__file__).parent / "examples").glob("*"))
] + [c.example for c in CODES.values() if c.example]
_WORDS = """planar model M end ; ( ) , = . [ ] : + - * / ^ < == and not if then else for in loop
when body ring rod mass 1 2.5 kg m/s (0,0) m 1e400 é ∞ \0 \ud800 " /* // initial equation world
experiment liaison joint force on at rotated with coulomb mu ground line G der true parameter Length
Real input output flow import extends type shape law package connector partial guess 5 degC % { @ :=
repère"""
WORDS = _WORDS.split()
QUIET = settings(max_examples=150, deadline=None, suppress_health_check=list(HealthCheck))


def survives(text: str) -> None:
    begun = time.process_time()
    log = Log()
    model = compile_text(text, log)
    render_log(log)
    assert (model is None) == log.failed
    assert all(d.span is not None for d in log)
    if model is not None:
        default_values(model)
        dump(model)
    assert time.process_time() - begun < 2.0


@QUIET
@given(st.data())
def test_edited_examples(data: st.DataObject) -> None:
    text = data.draw(st.sampled_from(TEXTS))
    for _ in range(data.draw(st.integers(1, 5))):
        start = data.draw(st.integers(0, len(text)))
        stop = min(len(text), start + data.draw(st.integers(0, 10)))
        put = data.draw(st.one_of(st.just(""), st.sampled_from(WORDS), st.characters()))
        text = text[:start] + put + text[stop:]
    survives(text)


@QUIET
@given(st.lists(st.sampled_from(WORDS), max_size=60), st.booleans())
def test_random_words(words: list[str], inside: bool) -> None:
    text = " ".join(words)
    survives(f"planar model M\n{text}\nend M;\n" if inside else text)


def test_exchanged_words_and_lines() -> None:
    texts = sources()
    sound = [t for t in texts if "//! " not in t]
    draw = random.Random(7)
    for _ in range(150):
        survives(exchanged(draw.choice(sound), draw, sound))
        survives(mutated(draw.choice(texts), draw, texts))


def test_texts_that_would_grow_without_bound_are_refused_by_name() -> None:
    calls = "".join(
        f"function f{k}\n input Real x;\n output Real y = f{k + 1}(x + 1) + f{k + 1}(x);\n"
        f"end f{k};\n"
        for k in range(40)
    )
    nested = "".join(f"model A{k}\n A{k + 1} a, b;\nend A{k};\n" for k in range(40))
    loop = "model M\n Real x;\nequation\n for i in 1:{0} loop\n x = i;\n end for;\nend M;\n"
    texts = [
        f"{calls}function f40\n input Real x;\n output Real y = x;\nend f40;\n"
        "model M\n Real x = f0(time/(1 s));\nend M;\n",
        f"{nested}model A40\n Real x = 1;\nend A40;\n",
        loop.format("1000000000000"),
        "model M\n Real x[100000, 100000];\nend M;\n",
        "model M\n Real x = sum(fill(1, 1000, 1000));\nend M;\n",
    ]
    for text in texts:
        begun = time.process_time()
        log = Log()
        assert compile_text(text, log, model="A0" if "A40" in text else None) is None
        assert [d.code for d in log] == ["E0109"], render_log(log)
        assert time.process_time() - begun < 15
