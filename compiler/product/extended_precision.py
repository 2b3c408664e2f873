"""Generated functions in numbers of twice the digits: their C.

What CasADi calls of its own it writes out for compilers before C99: so it holds for any type.
Arguments are numbers of ordinary width: they place bodies to a rounding, and contradict nothing.
Nor may what CasADi takes for granted, that roots have squares and that directions are one unit
long; other functions give numbers of ordinary width, the same wherever they stand.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping

import casadi as ca
from frot.compiler.product.c_tables import record
from frot.compiler.product.casadi_text import (
    BANNER,
    BEFORE_C99,
    BRACES,
    DIRECTIVE,
    EXPORTED,
    FUNCTION_NAME,
)
from frot.compiler.product.split import split_functions

_CALL = re.compile(r"\b(sin|cos|sqrt)\(")
_CALLED = {"sin": "sine", "cos": "cosine", "sqrt": "root"}
# The name of these functions among the others.
WIDE = "wide"
_HEAD = """
#include "numerics/extended_precision.h"
#define wide_real frot_wide
#define wide_int long long int
#define wide_nan NAN
#define wide_inf INFINITY
#ifdef FROT_ONLY_WIDE
#define wide_seen __attribute__((visibility("hidden")))
#else
#define wide_seen static
#endif
"""
_ARGUMENTS = "const double** arg, wide_real** res, wide_int* iw, wide_real* w, int mem"


def write_wide(text: str) -> str:
    """The C of functions that CasADi wrote, in wide numbers."""
    begins = text.index("*/", text.index(BANNER)) + 3
    plain = BEFORE_C99.sub(r"\1", EXPORTED.sub("", text[begins:]))
    plain = split_functions(DIRECTIVE.sub("", plain))
    for braces in BRACES:
        plain = plain.replace(braces, "")
    plain = plain.replace("const casadi_real** arg", "const double** arg")
    plain = _CALL.sub(lambda found: f"frot_wide_{_CALLED[found[1]]}(", plain)
    plain = plain.replace("casadi_", "wide_")
    for name in wide_names(text).values():
        plain = plain.replace(f"static int {name}(", f"wide_seen int {name}(")
    return plain


def in_parts(plain: str, wide: str, names: Iterable[str], rest: str) -> str:
    """The C of a model with functions in `wide` numbers, which have these names in `rest`.

    Two compilers may make it, each with a macro of its own: `FROT_ONLY_PLAIN` leaves out what is
    in wide numbers, `FROT_ONLY_WIDE` all else. Neither: it is whole.
    """
    declared = "\n".join(f"int {name}({_ARGUMENTS});" for name in names)
    return "\n".join(
        (
            _HEAD,
            *("#ifndef FROT_ONLY_WIDE", plain, "#endif"),
            *(
                "/* In wide numbers. */",
                "#ifdef FROT_ONLY_PLAIN",
                declared,
                "#else",
                wide,
                "#endif",
            ),
            *("#ifndef FROT_ONLY_WIDE", rest, "#endif", ""),
        )
    )


def wide_names(text: str) -> dict[str, str]:
    """How the functions of `write_wide(text)` are called there, by their own names."""
    return {name: f"wide_{own}" for name, own in FUNCTION_NAME.findall(text)}


def wide_record(function: ca.Function | None, names: Mapping[str, str]) -> str:
    """The initializer of a `frot_wide_callable`."""
    if function is None:
        return record("0", 0, 0, 0, 0)
    sizes = (function.sz_arg(), function.sz_res(), function.sz_iw(), function.sz_w())
    return record(names[function.name()], *sizes)
