"""The C text that CasADi writes: every pattern by which the compiler reads it stands here.

CasADi promises nothing about this text. `tests/architecture/test_casadi_text.py` compares what it
writes for a small function with what is known, and fails with "CasADi's C has changed".
"""

from __future__ import annotations

import re

# Parameters of a function, and its first line; its name as it was given, in the comment before it.
ARGUMENTS = "const casadi_real** arg, casadi_real** res, casadi_int* iw, casadi_real* w, int mem"
FUNCTION_HEAD = re.compile(r"^static int (casadi_f\d+)\(" + re.escape(ARGUMENTS) + r"\) \{$")
FUNCTION_NAME = re.compile(r"^/\* (\w+):.*\n^static int casadi_(f\d+)\(", re.MULTILINE)
# Local variables; a statement that sets one, or an item of a result.
DECLARATION = re.compile(r"^  casadi_real a\d+[a\d, ]*;$")
VARIABLE = re.compile(r"\ba(\d+)\b")
ASSIGNMENT = re.compile(r"^  a(\d+)=(.*);$")
RESULT = re.compile(r"^  res\[(\d+)\]\[(\d+)\]=(a\d+);$")
# Lines of such statements alone; names and values of all assignments of such lines.
STRAIGHT = re.compile(r"(?:  (?:a\d+=.*|res\[\d+\]\[\d+\]=a\d+);(?:\n|$))*")
ASSIGNED = re.compile(r"^  a(\d+)=(.*);$", re.MULTILINE)
# Values of an assignment: an operand, an item of an argument or a number, a number alone.
OPERAND = re.compile(r"\ba(\d+)\b|\barg\[(\d+)\]\[(\d+)\]")
GIVEN = re.compile(r"arg\[\d+\]\[\d+\]$|-?[\d.]+(e[-+]?\d+)?$")
CONSTANT = re.compile(r"^(  a\d+=)-?[\d.]+(?:e[-+]?\d+)?;$")
# Tests whether an argument is given and a result wanted. The kernel gives and wants all: without
# the tests a function is a straight line, which C compilers take in proportion to its length.
ABSENT_ARGUMENT = re.compile(r"(arg\[\d+\])\? (\1\[\d+\]) : 0")
UNWANTED_RESULT = re.compile(r"if \(res\[\d+\]!=0\) (?=res\[)")
# Helper functions, for a square and the like.
HELPER = re.compile(r"^(casadi_real casadi_\w+\(casadi_real )", re.MULTILINE)
# Exported functions that describe others (sizes, names, sparsity): the kernel's tables have that.
DESCRIPTION = re.compile(
    r"^CASADI_SYMBOL_EXPORT [^\n]*_(?:checkout|release|incref|decref|n_in|n_out|default_in|name_in|"
    r"name_out|sparsity_in|sparsity_out|work|work_bytes|casadi_version|casadi_int_size|"
    r"casadi_real_size)\([^\n]*\{(?:[^\n]*\}|.*?^\})\n+",
    re.MULTILINE | re.DOTALL,
)
EXPORTED = re.compile(r"^CASADI_SYMBOL_EXPORT [^\n]*(?:\}|\{\n(?:[^}\n].*\n)*\})\n", re.MULTILINE)
# What is written twice, first for compilers before C99; other lines of the preprocessor.
BEFORE_C99 = re.compile(
    r"^#if __STDC_VERSION__ < 199901L\n((?:[^#\n].*\n)*)#else\n(?:[^#\n].*\n)*#endif\n",
    re.MULTILINE,
)
DIRECTIVE = re.compile(r"^ *#.*\n", re.MULTILINE)
BANNER = "automatically generated"
BRACES = ('extern "C" {\n', '} /* extern "C" */\n')


def straightened(text: str) -> str:
    """The functions of `text` as straight lines, with their helpers inline, described nowhere."""
    text = DESCRIPTION.sub("", text)
    text = UNWANTED_RESULT.sub("", ABSENT_ARGUMENT.sub(r"\2", text))
    return HELPER.sub(r"static inline \1", text)
