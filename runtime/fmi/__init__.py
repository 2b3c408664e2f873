"""Programs as functional mock-up units (FMI 2.0 and FMI 3.0)."""

from frot.runtime.fmi.about import About
from frot.runtime.fmi.export import InvalidFmuError, export
from frot.runtime.fmi.platforms import check_platforms, platform_folder

__all__ = ["About", "InvalidFmuError", "check_platforms", "export", "platform_folder"]
