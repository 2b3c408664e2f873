"""CasADi's C is what `compiler/product/casadi_text.py` knows; no other module reads that text."""

from __future__ import annotations

import re
from pathlib import Path

import casadi as ca
from frot.compiler.product import casadi_text
from frot.compiler.product.generate import write_c

PRODUCT = Path(__file__).parents[2] / "compiler" / "product"
CHANGED = "CasADi's C has changed: compiler/product/casadi_text.py must follow it"
KNOWN = """\
/* small:(i0[2])->(o0) */
static int casadi_f0(const casadi_real** arg, casadi_real** res, casadi_int* iw, \
casadi_real* w, int mem) {
  casadi_real a0, a1;
  a0=arg[0][0];
  a0=sin(a0);
  a1=arg[0][1];
  a1=casadi_sq(a1);
  a0=(a0*a1);
  a1=3.5000000000000000e+00;
  a0=(a0+a1);
  res[0][0]=a0;
  return 0;
}
"""


def small_function() -> str:
    x = ca.SX.sym("x", 2)
    return write_c([ca.Function("small", [x], [ca.sin(x[0]) * x[1] ** 2 + 3.5])])


def test_a_small_function_is_written_as_it_was() -> None:
    text = small_function()
    begin = text.find("/* small")
    assert text[begin : text.find("}\n", begin) + 2] == KNOWN, CHANGED
    assert "static inline casadi_real casadi_sq(casadi_real x) { return x*x;}" in text, CHANGED
    assert casadi_text.BANNER in text, CHANGED
    assert casadi_text.FUNCTION_NAME.findall(text) == [("small", "f0")], CHANGED


def test_every_statement_is_known() -> None:
    lines = KNOWN.splitlines()[1:]
    assert casadi_text.FUNCTION_HEAD.match(lines[0])
    assert casadi_text.DECLARATION.match(lines[1])
    assert all(casadi_text.ASSIGNMENT.match(line) for line in lines[2:9])
    assert casadi_text.CONSTANT.match(lines[7])
    assert casadi_text.RESULT.match(lines[9])


def test_no_description_of_functions_remains() -> None:
    assert not re.search(r"_n_in|_sparsity_out|_work_bytes|_checkout", small_function()), CHANGED


def test_no_other_module_parses_the_c_text() -> None:
    marks = re.compile(r"re\.compile\([^)]*(?:casadi_|CASADI_|res\\\[|arg\\\[)")
    reading = {path.name for path in PRODUCT.glob("*.py") if marks.search(path.read_text("utf-8"))}
    assert reading == {"casadi_text.py"}
