"""Signs and words of other keyboards and languages, with their spellings in Frot."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

# Characters of a bracket that a message repeats.
_SHOWN = 60
_MODES = ("open", "stick", "slip")


class Lexeme(Protocol):
    """A token: its terminal and its place."""

    type: str
    start: int
    end: int


# Signs of other keyboards and of word processors, and what is meant by them.
MEANT = {
    **dict.fromkeys("\u2212\u2010\u2011\u2012\u2013\u2014\uff0d", "-"),
    **dict.fromkeys("×·⋅∙∗＊", "*"),
    **dict.fromkeys("÷∕⁄", "/"),
    **dict.fromkeys("“”„«»″＂", '"'),
    **dict.fromkeys("，、", ","),
    "；": ";",
    "：": ":",
    "（": "(",
    "）": ")",
    "＝": "=",
    "＋": "+",
    "≤": "<=",
    "≥": ">=",
    "≠": "<>",
    "⩵": "==",
}
# Signs of other languages, and how the same is said in this one.
FOREIGN = {
    "#": "comments are written '// ...' or '/* ... */'",
    "!": "a condition is negated by 'not', and 'a <> b' says that two values differ",
    "&": "conditions are joined by 'and'",
    "|": "conditions are joined by 'or'; the size of a value is 'abs(x)'",
    "?": "a choice is written 'if c then a else b'",
    "\\": "a quotient is written 'a/b'",
    "@": "a product of matrices is written 'A*B'",
    "~": "a condition is negated by 'not'",
    **dict.fromkeys("°˚", "leave a space between a number and its unit: '20 °', or write '20 deg'"),
    "$": "names have letters, digits and '_'",
}
# Words of Modelica that have no place here, and how the same is said.
MODELICA = {
    "discrete": "leave the word out: a variable that a 'when' gives its values keeps them between",
    "algorithm": "there are equations only: write 'equation', and 'left = right;' without order",
    "protected": "leave the word out: every declaration can be read from outside",
    "public": "leave the word out: every declaration can be read from outside",
    "inner": "leave the word out, and hand the value down as a parameter of the part",
    "outer": "leave the word out, and declare the value as a parameter of this model",
    "replaceable": "leave the word out, and choose the part where it is declared",
    "redeclare": "declare the part in the model that is built, by its own type",
    "annotation": "leave it out; a run is described by 'experiment(stop = 1 s);'",
    "block": "write 'model'",
    "class": "write 'model'",
    "within": "leave it out: a file is a member of the folder it lies in",
    "encapsulated": "leave the word out",
    "each": "leave the word out: a value of one item is given to all of them",
    "elif": "write 'elseif'",
    "elsif": "write 'elseif'",
}
RAISED = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹", "0123456789")
IN_UNIT = dict.fromkeys("·⋅", ", or '.' in a unit: 'N.m'")


def of_modelica(
    text: str, previous: Lexeme | None, token: Lexeme, statement: Sequence[Lexeme]
) -> Lexeme | None:
    """The word of Modelica that the token, or what stands before it, is."""
    first = statement[0] if statement and previous is not None else None
    followed = len(statement) > 1 and text[statement[1].start].isalpha()
    for place in (token, previous, first if followed else None):
        if place is not None and text[place.start : place.end].rpartition(" ")[2] in MODELICA:
            return place
    return None


def declared_by_equals(text: str, statement: Sequence[Lexeme]) -> tuple[str, str] | None:
    """Kind and form of a statement that declares by `=` in place of `:` or `on`; or None.

    `body block = box(...)`; the name may be a word of Modelica.
    """
    if len(statement) != 2:
        return None
    word, name = (text[t.start : t.end] for t in statement)
    if word in ("body", "corps", "liaison", "joint", "force", "effort"):
        return word, f"write ':' after the name: '{word} {name}: ...'"
    if word in ("curve", "surface"):
        return word, f"write '{word} {name} on ground: ...', or the name of a body for 'ground'"
    if word in ("frame", "rep\u00e8re", "repere", "repe\u0300re"):
        return word, f"write '{word} {name} on ground at ...', or the name of a body for 'ground'"
    return None


def in_parentheses(text: str, start: int) -> str:
    """The help for a `[` where a value is expected: what it opens, in parentheses."""
    depth, end = 0, start
    for end in range(start, min(len(text), start + _SHOWN)):
        depth += {"[": 1, "]": -1}.get(text[end], 0)
        if depth == 0 or text[end] in ";\n":
            break
    if depth or not text[start + 1 : end].strip():
        return "an array is written '(1, 2, 3)', a matrix '((1, 2), (3, 4))'"
    meant = text[start : end + 1].replace("[", "(").replace("]", ")")
    return f"an array is written in parentheses: '{meant}'"


def as_text(text: str, token: Lexeme, statement: Sequence[Lexeme]) -> str:
    """The help for a string that is compared with a mode, or empty."""
    before = [text[t.start : t.end] for t in statement[-3:]]
    if len(before) < 3 or before[-1] not in ("==", "<>"):
        return ""
    word = text[token.start + 1 : token.end - 1]
    if before[-2] == "mode" and word not in _MODES:
        return f"a mode is one of {', '.join(_MODES)}, written without quotes: 'l.mode == stick'"
    if before[-2] == "mode":
        return f"a mode is compared with its name, without quotes: 'mode {before[-1]} {word}'"
    return "texts are not compared: write the literal of an enumeration, as 'Colour.red'"
