"""What an FMU says of its author, version, licence and date."""

from __future__ import annotations

import re
from dataclasses import dataclass

_DATE = re.compile(r"\d{4}-\d\d-\d\d(T\d\d:\d\d:\d\dZ)?")


@dataclass(frozen=True, slots=True)
class About:
    """Words of the exporter, empty where there are none.

    `date` is a day `2026-11-27` or an instant `2026-11-27T12:00:00Z`. Without one the archive is
    the same to the last byte whenever it is made.
    """

    author: str = ""
    version: str = ""
    licence: str = ""
    copyright: str = ""
    date: str = ""

    def attributes(self) -> dict[str, str]:
        """By the names of FMI; ValueError for a date that is none."""
        if self.date and not _DATE.fullmatch(self.date):
            raise ValueError(f"'{self.date}' is no date as 2026-11-27 or 2026-11-27T12:00:00Z")
        date = f"{self.date}T00:00:00Z" if self.date and "T" not in self.date else self.date
        named = {
            "author": self.author,
            "version": self.version,
            "copyright": self.copyright,
            "license": self.licence,
            "generationDateAndTime": date,
        }
        return {name: value for name, value in named.items() if value}
