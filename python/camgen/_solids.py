"""Solids of other packages, read from the STEP file of a proven cam."""

from __future__ import annotations

import os
import tempfile
from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ._camgen import Proven


def _step_of(proven: Proven, read: Any) -> Any:
    with tempfile.TemporaryDirectory() as directory:
        path = os.path.join(directory, "cam.step")
        with open(path, "wb") as file:
            file.write(proven.bytes(".step"))
        return read(path)


def to_build123d(proven: Proven) -> Any:
    """The solid as a shape of build123d."""
    return _step_of(proven, import_module("build123d").import_step)


def to_cadquery(proven: Proven) -> Any:
    """The solid as a workplane of CadQuery."""
    return _step_of(proven, import_module("cadquery").importers.importStep)
