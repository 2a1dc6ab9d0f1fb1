"""Exceptions. Each knows its faults: what is wrong, of which key, where, and what would be right."""

from __future__ import annotations

from typing import NamedTuple, Optional


class Fault(NamedTuple):
    """One fault."""

    #: What is wrong.
    message: str
    #: The dotted path of the key of the machine file, or the parameter of the call; None where it is of no single one.
    key: Optional[str]
    #: FILE:LINE:COLUMN in a machine file, or the place on the cam.
    place: Optional[str]
    #: What would be right.
    remedy: Optional[str]


class CamgenError(Exception):
    """Something is refused. ``str(error)`` is the message of the command line; ``faults`` has its parts."""

    #: At least one.
    faults: tuple[Fault, ...]

    def __init__(self, text: str, faults: tuple[Fault, ...] = ()) -> None:
        super().__init__(text)
        self.faults = faults

    def __reduce__(self) -> tuple[type[CamgenError], tuple[str, tuple[Fault, ...]]]:
        return type(self), (str(self), self.faults)


class MachineError(CamgenError, ValueError):
    """A machine file, or an override, has faults; all of them are told at once."""


class OptionError(CamgenError, ValueError):
    """A parameter of a call is wrong."""


class SolveError(CamgenError):
    """There is no such cam, or no such analysis."""


class DrawError(CamgenError):
    """The cam cannot be drawn as it is asked for."""


class ProofError(CamgenError):
    """The file as written does not hold what was drawn: a fault of camgen."""


class ReadError(CamgenError):
    """A file to be checked cannot be read."""


class RefusedError(CamgenError):
    """A check failed, and nothing is written without ``force=True``; or there is no outline at all."""


class FilesError(CamgenError, OSError):
    """Files cannot be made or written; those that were there are as they were."""

    def __init__(self, text: str, faults: tuple[Fault, ...] = ()) -> None:
        OSError.__init__(self, text)
        self.faults = faults
