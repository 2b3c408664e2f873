"""Libraries: the files that `import` names, each read once.

A file is a package of its definitions, or holds a package of its own name; a folder is a package of
its files. `import_scan.py` says where they lie.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

from frot.dsl.files.import_scan import SUFFIX, locate, member, plain_path
from frot.dsl.files.reading import read_text
from frot.dsl.messages.diagnostics import Label, Log
from frot.dsl.messages.source import Source
from frot.dsl.names.classes import Class, Imported, Namespace, built_in, library, namespace
from frot.dsl.names.near import did_you_mean
from frot.dsl.text import tree
from frot.dsl.text.parsing import parse

# Files that import one another in a chain.
LONGEST = 50


@dataclass(slots=True, eq=False)
class Folder(Namespace):
    """A folder as a package: its files and folders are read when they are first used."""

    path: Path = field(default_factory=Path)
    libraries: Libraries | None = None

    def own(self, name: str) -> Class | None:
        """The member of that name: a folder, a file, or the definition of that name in it."""
        if name not in self.classes:
            path = member(self.path, name)
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
        if target is not None and not statement.all:
            self._once(statement, target, space)
        if target is not None and isinstance(target, tuple):
            space.constants[(statement.alias or statement.path[-1]).text] = target
            return
        imported = Imported(target, statement)
        self.imports.append(imported)
        if target is None:
            space.open = space.open or statement.all
            space.lost |= {(statement.alias or statement.path[-1]).text}
        elif statement.all:
            space.stars.append(imported)
        else:
            space.imports[(statement.alias or statement.path[-1]).text] = imported

    def _once(
        self, statement: tree.Import, target: Class | tuple[Class, str], space: Namespace
    ) -> None:
        """Report a name under which something else is imported already."""
        name = (statement.alias or statement.path[-1]).text
        first = space.imports.get(name)
        other = space.constants.get(name) if first is None else first.target
        if other is not None and other != target:
            self.log.report(
                "E0212",
                f"{name!r} is imported twice, and not the same",
                statement.span,
                labels=() if first is None else (Label(first.statement.span, "first here"),),
                help=f"give one of them another name: 'import {_dotted(statement)} as Name;'",
            )

    def _target(self, statement: tree.Import, space: Namespace) -> Class | tuple[Class, str] | None:
        """The definition an import names, or the package and name of a constant."""
        head, *rest = statement.path
        found = space.find(head.text) or self._library(head, space)
        for word in rest:
            if found is None:
                return None
            inner = found.space.own(word.text)
            if inner is None:
                if word is rest[-1] and not statement.all and _holds(found, word.text):
                    return found, word.text
                if found.space.knows(word.text):
                    names = _names(found.space)
                    near = did_you_mean(word.text, names, self.log)
                    own = f"{word.text!r} is a word of the language: leave the import out"
                    self.log.report(
                        "E0210",
                        f"{found.name!r} has no member {word.text!r}",
                        word.span,
                        notes=(f"there are: {', '.join(names)}",) if names else (),
                        help=own if built_in(word.text) else near,
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


def enter(klass: Class, libraries: Libraries) -> Namespace:
    """The namespace inside of a class, its imports and bases read."""
    space = klass.space
    libraries.read_imports(klass.elements, space)
    return space


def tell_clashes(libraries: Libraries) -> None:
    """Report names in use that two packages give by `.*`."""
    for imported in libraries.imports:
        for name, other in imported.clashes.items():
            packages = [i.target.name for i in (other, imported) if i.target is not None]
            libraries.log.report(
                "E0212",
                f"{name!r} is in both {packages[0]!r} and {packages[1]!r}: which one is not said",
                imported.statement.span,
                labels=(Label(other.statement.span, "here too"),),
                help=f"import the one that is meant by its name: 'import {packages[0]}.{name};'",
            )


def _dotted(statement: tree.Import) -> str:
    return ".".join(word.text for word in statement.path)


def _holds(package: Class, name: str) -> bool:
    """Whether a package declares a value of that name."""
    return package.kind == "package" and any(
        item.name.text == name
        for element in package.elements
        if isinstance(element, tree.Component)
        for item in element.declared
    )


def _names(space: Namespace) -> list[str]:
    if isinstance(space, Folder):
        return sorted({p.stem for p in space.path.iterdir() if _is_member(p)})
    return list(space.definitions)


def _is_member(path: Path) -> bool:
    return path.suffix == SUFFIX or (path.is_dir() and path.stem.isidentifier())


def _path(source: Source) -> Path | None:
    """The file of a source; None for a text that has none."""
    return None if source.name.startswith("<") else plain_path(source.name)
