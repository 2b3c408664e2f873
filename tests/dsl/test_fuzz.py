"""No text raises: examples with random edits, and random words."""

import time
from pathlib import Path

from frot.dsl import CODES, Log, compile_text, default_values, dump, render_log
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

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
    begun = time.perf_counter()
    log = Log()
    model = compile_text(text, log)
    render_log(log)
    assert (model is None) == log.failed
    assert all(d.span is not None for d in log)
    if model is not None:
        default_values(model)
        dump(model)
    assert time.perf_counter() - begun < 2.0


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
