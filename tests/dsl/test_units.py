"""Units and values given as text."""

import contextlib
import math
import re

import pytest
from frot.dsl import Log, compile_text, format_text, parse_value
from frot.dsl.catalogue import TYPES
from frot.dsl.quantities.dimensions import ONE, Type, dimension
from frot.dsl.quantities.spelling import corrected
from frot.dsl.quantities.units import PLAIN, PREFIXED, PREFIXES, UnknownUnit, parse_unit
from hypothesis import given
from hypothesis import strategies as st

MULTIPLICATIVE = sorted(n for n in (*PREFIXED, *PLAIN) if n != "1" and "C" not in n[1:])


@pytest.mark.parametrize(
    ("text", "factor", "dim"),
    [
        ("mm", 1e-3, dimension(m=1)),
        ("km/h", 1 / 3.6, dimension(m=1, s=-1)),
        ("kg.m^2", 1.0, dimension(m=2, kg=1)),
        ("m/s^2", 1.0, dimension(m=1, s=-2)),
        ("N.m/A", 1.0, dimension(m=2, kg=1, s=-2, A=-1)),
        ("rpm", math.pi / 30, dimension(s=-1)),
        ("deg", math.pi / 180, ONE),
        ("tour", 2 * math.pi, ONE),
        ("%", 0.01, ONE),
        ("t", 1e3, dimension(kg=1)),
        ("bar", 1e5, dimension(m=-1, kg=1, s=-2)),
        ("L", 1e-3, dimension(m=3)),
        ("1/s", 1.0, dimension(s=-1)),
        ("kOhm", 1e3, dimension(m=2, kg=1, s=-3, A=-2)),
        ("mH", 1e-3, dimension(m=2, kg=1, s=-2, A=-2)),
        ("min", 60.0, dimension(s=1)),
    ],
)
def test_known_units(text: str, factor: float, dim: object) -> None:
    unit = parse_unit(text)
    assert unit.factor == pytest.approx(factor, rel=1e-15)
    assert unit.dimension == dim


MICRO = ("\u00b5", "\u03bc", "u")


@pytest.mark.parametrize("micro", MICRO)
def test_micro_has_two_characters(micro: str) -> None:
    """The micro sign, which keyboards have, and the Greek letter, which NFKC makes of it."""
    text = (
        "model M\n"
        f" parameter Length a = 3 {micro}m;\n"
        f" parameter Real b[2] = (3 {micro}m, 4 {micro}s.m/s)/(1 m);\n"
        f' Length c(unit = "{micro}m");\n Frequency f = 2 {micro}Hz;\n'
        f"equation\n c = a + (b[1] + b[2])*(1 {micro}m);\nend M;\n"
    )
    log = Log()
    model = compile_text(text, log)
    assert model is not None and not log.failed, list(log)
    assert parse_value(f"12 {micro}m", TYPES["Length"]) == pytest.approx(12e-6, rel=1e-15)
    assert f"3 {micro}m" in str(format_text(text))


@pytest.mark.parametrize("text", ["20 deg", "20 °"])
def test_degrees(text: str) -> None:
    assert parse_value(text, TYPES["Angle"]) == pytest.approx(math.pi / 9, rel=1e-15)


@pytest.mark.parametrize("unit", ["m.s^-1", "m/s"])
def test_negative_powers(unit: str) -> None:
    assert parse_value(f"3 {unit}", TYPES["Velocity"]) == 3


@pytest.mark.parametrize(
    ("written", "meant"),
    [
        ("m.s-1", "m.s^-1"),
        ("m.s−1", "m.s^-1"),
        ("m·s⁻¹", "m.s^-1"),
        ("kg.m2", "kg.m^2"),
        ("kg*m**2", "kg.m^2"),
        ("N.m/(rad/s)", "N.m.s/rad"),
        ("J/(kg.K)", "J/kg/K"),
        ("W/(m^2.K)", "W/m^2/K"),
        ("m/s", ""),
        ("furlong-1", ""),
        ("m/(s", ""),
    ],
)
def test_units_of_other_notations(written: str, meant: str) -> None:
    assert corrected(written) == meant
    if meant:
        with pytest.raises(ValueError, match=re.escape(f"did you mean {meant!r}?")):
            parse_value(f"3 {written}", TYPES["Real"])


@given(st.text(alphabet="msNkg./^()-2−·*³", max_size=10))
def test_what_is_meant_is_a_unit(text: str) -> None:
    assert corrected(text) == "" or parse_unit(corrected(text)).factor > 0


@given(st.sampled_from(sorted(PREFIXES)), st.sampled_from(sorted(PREFIXED)))
def test_a_prefix_multiplies(prefix: str, name: str) -> None:
    if prefix + name in PLAIN or prefix + name in PREFIXED:
        return  # `min` is the minute, `Pa` the pascal
    unit, base = parse_unit(prefix + name), parse_unit(name)
    # `dam` can be read with one prefix only, as can every other pair.
    if prefix == "d" and name.startswith("a"):
        return
    assert unit.dimension == base.dimension
    assert unit.factor == pytest.approx(PREFIXES[prefix] * base.factor, rel=1e-14)


@given(st.sampled_from(MULTIPLICATIVE), st.sampled_from(MULTIPLICATIVE), st.integers(-3, 3))
def test_products_quotients_and_powers(a: str, b: str, n: int) -> None:
    one, two = parse_unit(a), parse_unit(b)
    assert parse_unit(f"{a}.{b}").factor == pytest.approx(one.factor * two.factor, rel=1e-12)
    assert parse_unit(f"{a}/{b}").dimension == one.dimension / two.dimension
    assert parse_unit(f"{a}/{b}.{a}").dimension == one.dimension / two.dimension * one.dimension
    assert parse_unit(f"{a}^{n}").factor == pytest.approx(one.factor**n, rel=1e-12)
    assert parse_unit(f"{a}^{n}").dimension == one.dimension**n


@pytest.mark.parametrize(
    "text", ["", "sec", "m/", "/s", "m//s", "m.^2", "m^x", "m^99", "degC/s", "m s"]
)
def test_what_is_no_unit_is_refused(text: str) -> None:
    with pytest.raises(UnknownUnit):
        parse_unit(text)


@given(st.text(max_size=12))
def test_any_text_is_a_unit_or_refused(text: str) -> None:
    with contextlib.suppress(UnknownUnit):
        assert parse_unit(text).factor > 0


@given(st.lists(st.integers(-4, 4), min_size=3, max_size=3))
def test_the_name_of_a_dimension_reads_back(exponents: list[int]) -> None:
    dim = dimension(*exponents)
    assert parse_unit(dim.unit).dimension == dim


@pytest.mark.parametrize(
    ("text", "kind", "wanted"),
    [
        ("0.2", "Real", 0.2),
        ("12 mm", "Length", 0.012),
        ("12mm", "Length", 0.012),
        ("2", "Length", 2.0),
        ("-20 deg", "Angle", -math.pi / 9),
        ("20 degC", "Temperature", 293.15),
        ("false", "Boolean", False),
        ("3", "Integer", 3.0),
        ("left", "String", "left"),
    ],
)
def test_values_on_a_command_line(text: str, kind: str, wanted: object) -> None:
    assert parse_value(text, TYPES[kind]) == pytest.approx(wanted)


def test_a_vector_on_a_command_line() -> None:
    assert parse_value("(1, -2) mm", Type("real", dimension(m=1), (2,))) == (0.001, -0.002)


@pytest.mark.parametrize(
    ("text", "kind"),
    [
        ("12 kg", "Length"),
        ("12 sec", "Time"),
        ("twelve", "Real"),
        ("", "Real"),
        ("1e999", "Real"),
        ("1", "Boolean"),
        ("1.5", "Integer"),
        ("nan", "Real"),
    ],
)
def test_bad_values_are_told_in_a_sentence(text: str, kind: str) -> None:
    with pytest.raises(ValueError, match=r"\w+ \w+"):
        parse_value(text, TYPES[kind])
