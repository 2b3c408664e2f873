"""Libraries: the files that `import` names, read once, and found again without reading the language.

`import Library.Name;` looks for `Library.frot`, which holds `package Library` or plain definitions,
or for a folder `Library` with `Name.frot`: beside the importing file, then around it where that
file lies in a folder `Library` itself, then among the libraries that come with Frot.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from importlib.resources import files
from pathlib import Path

from frot.dsl import tree
from frot.dsl.classes import Class, Imported, Namespace, library, namespace
from frot.dsl.diagnostics import Log
from frot.dsl.reading import read_text
from frot.dsl.scope import did_you_mean
from frot.dsl.source import Source

SUFFIX = ".frot"
# Files that import one another in a chain.
LONGEST = 50


@dataclass(slots=True, eq=False)
class Folder(Namespace):
    """A folder as a package: its files and folders are read when they are asked for."""

    path: Path = field(default_factory=Path)
    libraries: Libraries | None = None

    def own(self, name: str) -> Class | None:
        """The member of that name: a folder, a file, or the definition of that name in it."""
        if name not in self.classes:
            path = _member(self.path, name)
            assert self.libraries is not None
            found = None if path is None else self.libraries.read(name, path)
            if found is None:
                return None
            self.classes[name] = found
        return self.classes[name]


@dataclass(slots=True)
class Libraries:
    """The files read so far, and the sources in the order in which they were read."""

    log: Log
    sources: list[Source] = field(default_factory=list)
    loading: list[Path] = field(default_factory=list)
    known: dict[Path, Class | None] = field(default_factory=dict)
    done: set[int] = field(default_factory=set)
    imports: list[Imported] = field(default_factory=list)

    def main(self, file: tree.Tree) -> Namespace:
        """The namespace of the file that is checked."""
        space = namespace(file.elements, file.source, lost=file.lost)
        path = _path(file.source)
        if path is not None:
            self.loading.append(path)
        self.sources.append(file.source)
        self.read_imports(file.elements, space)
        return space

    def read_imports(self, elements: tuple[tree.Element, ...], space: Namespace) -> None:
        """Find what the `import`s among the elements name; once for each namespace."""
        if id(space) in self.done:
            return
        self.done.add(id(space))
        for element in elements:
            if isinstance(element, tree.Import):
                self._import(element, space)

    def _import(self, statement: tree.Import, space: Namespace) -> None:
        target = self._target(statement, space)
        imported = Imported(target, statement)
        self.imports.append(imported)
        if target is None:
            space.open = space.open or statement.all
            space.lost |= {(statement.alias or statement.path[-1]).text}
        elif statement.all:
            space.stars.append(imported)
        else:
            space.imports[(statement.alias or statement.path[-1]).text] = imported

    def _target(self, statement: tree.Import, space: Namespace) -> Class | None:
        head, *rest = statement.path
        found = space.find(head.text) or self._library(head, space)
        for word in rest:
            if found is None:
                return None
            inner = found.space.own(word.text)
            if inner is None:
                if found.space.knows(word.text):
                    names = _names(found.space)
                    self.log.report(
                        "E0210",
                        f"{found.name!r} has no member {word.text!r}",
                        word.span,
                        notes=(f"there are: {', '.join(names)}",) if names else (),
                        help=did_you_mean(word.text, names, self.log),
                    )
                return None
            found = inner
        return found

    def _library(self, head: tree.Word, space: Namespace) -> Class | None:
        path = locate(head.text, space.source.name)
        if path is None:
            self.log.report(
                "E0210",
                f"no library {head.text!r}",
                head.span,
                help=f"put '{head.text}{SUFFIX}' or a folder '{head.text}' beside this file",
            )
            return None
        if path in self.loading:
            circle = [*self.loading[self.loading.index(path) :], path]
            shown = " -> ".join(p.name for p in circle)
            self.log.report("E0211", f"files import each other in a circle: {shown}", head.span)
            return None
        if len(self.loading) > LONGEST:
            message = f"more than {LONGEST} files import one another in a chain"
            self.log.report("E0211", message, head.span)
            return None
        return self.read(head.text, path)

    def read(self, name: str, path: Path) -> Class | None:
        """The package in a file or folder; None after a message."""
        if path not in self.known:
            self.known[path] = self._read(name, path)
        return self.known[path]

    def _read(self, name: str, path: Path) -> Class | None:
        from frot.dsl.parsing import parse

        if path.is_dir():
            source = Source(str(path / f"{name}{SUFFIX}"), "")
            return library(name, Folder(source, path=path, libraries=self))
        text = read_text(path, self.log)
        if text is None:
            return None
        file = parse(Source(str(path), text), self.log)
        self.sources.append(file.source)
        space = namespace(file.elements, file.source, lost=file.lost)
        self.loading.append(path)
        self.read_imports(file.elements, space)
        self.loading.pop()
        return space.own(name) or library(name, space)


def _names(space: Namespace) -> list[str]:
    if isinstance(space, Folder):
        return sorted({p.stem for p in space.path.iterdir() if _is_member(p)})
    return list(space.definitions)


def _is_member(path: Path) -> bool:
    return path.suffix == SUFFIX or (path.is_dir() and path.stem.isidentifier())


# ------------------------------------------------------------------ where things lie


def _path(source: Source) -> Path | None:
    """The file of a source; None for a text that has none."""
    return None if source.name.startswith("<") else Path(source.name).absolute()


def _member(folder: Path, name: str) -> Path | None:
    """The file, else the folder, of that name in a folder."""
    try:
        file = folder / f"{name}{SUFFIX}"
        if file.is_file():
            return file
        inner = folder / name
        return inner if inner.is_dir() else None
    except (OSError, ValueError):
        return None


def locate(head: str, importing: str) -> Path | None:
    """Where the library lies that a file names; `importing` is that file's name."""
    here = Path.cwd() if importing.startswith("<") else Path(importing).absolute().parent
    around = [folder.parent for folder in (here, *here.parents) if folder.name == head]
    for folder in (here, *around, installed()):
        found = _member(folder, head)
        if found is not None:
            return found
    return None


def installed() -> Path:
    """The folder of the libraries that come with Frot."""
    return Path(str(files("frot.models")))


# ------------------------------------------------------------------ what a text reads

_IMPORT = re.compile(
    r'//[^\n]*|/\*.*?\*/|"(?:[^"\\\n]|\\[^\n])*"'
    r"|\bimport\s+(?P<path>[^\W\d][\w\u0300-\u036f]*(?:\s*\.\s*[^\W\d][\w\u0300-\u036f]*)*)",
    re.DOTALL,
)


def imported_files(text: str, name: str) -> list[Path]:
    """The files a text may read by its imports and theirs, found without the grammar."""
    found: dict[Path, None] = {}
    pending = [(text, name)]
    while pending:
        content, importing = pending.pop()
        for words in _paths(content):
            for path in _files(words, importing):
                if path in found:
                    continue
                found[path] = None
                try:
                    pending.append((path.read_text(encoding="utf-8", errors="replace"), str(path)))
                except OSError:
                    continue
    return sorted(found)


def _paths(text: str) -> Iterator[list[str]]:
    if "import" not in text:
        return
    for match in _IMPORT.finditer(text):
        if match["path"]:
            yield [w.strip() for w in match["path"].split(".")]


def _files(words: list[str], importing: str) -> Iterator[Path]:
    path = locate(words[0], importing)
    for word in words[1:]:
        if path is None or path.is_file():
            break
        path = _member(path, word)
    if path is not None:
        yield from sorted(path.rglob(f"*{SUFFIX}")) if path.is_dir() else [path]
