"""The names of the package, of Rust: types, units and shapes."""

import builtins
import os
import pathlib
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, Literal, Optional, Union, final

import numpy as np
import numpy.typing as npt
from typing_extensions import TypeAlias

from ._findings import Finding
from ._table import Table

_Array: TypeAlias = npt.NDArray[np.float64]
#: A number in SI units, or a text with its unit: 5e-6 or "5um".
_Quantity: TypeAlias = Union[float, str]
#: A value of a machine file: "80mm", 35, True, ["1mm", "2mm"].
_Value: TypeAlias = Union[str, float, bool, Sequence[Union[str, float]]]
_Path: TypeAlias = Union[str, os.PathLike[str]]
_Formats: TypeAlias = Union[str, Sequence[str]]
_ReadAs: TypeAlias = Literal["cam", "drive", "shaft", "brake"]

__all__ = [
    "Analysis",
    "Cam",
    "Drawing",
    "Law",
    "Machine",
    "Motion",
    "Proven",
    "Study",
    "__version__",
    "analyse",
    "analyses",
    "command",
    "law",
    "laws",
    "machines",
    "write_shard",
]

__version__: str

@final
class Machine:
    """A machine file with overrides, every value in range. Its text is read once."""

    @staticmethod
    def load(name_or_path: _Path, overrides: Optional[Mapping[str, _Value]] = None, *, read_as: _ReadAs = "cam") -> Machine:
        """An embedded machine by its name (see ``machines()``), or a file by its path.

        ``overrides`` has dotted keys: ``{"cam.base_radius": "80mm", "motion.segment[0].to": "20mm"}``. ``read_as`` is for a file that
        describes no cam: the drive of a bed, a shaft alone, a belt brake.

        Raises MachineError with every fault of the file and the overrides.
        """

    @staticmethod
    def from_toml(
        text: str, overrides: Optional[Mapping[str, _Value]] = None, *, name: str = "machine", read_as: _ReadAs = "cam"
    ) -> Machine:
        """A machine of TOML text; ``name`` is what messages and names of files call it."""

    @staticmethod
    def from_dict(
        data: Mapping[str, Any], overrides: Optional[Mapping[str, _Value]] = None, *, name: str = "machine", read_as: _ReadAs = "cam"
    ) -> Machine:
        """A machine of a dictionary with the tables and keys of a machine file; an array of tables is a list of dictionaries."""

    def with_overrides(self, overrides: Mapping[str, _Value]) -> Machine:
        """The same file with more overrides; its text is not read again. A key that was overridden before has the new value."""

    @property
    def name(self) -> str:
        """What reports call it."""

    @property
    def stem(self) -> str:
        """What the names of its files begin with."""

    @property
    def motion(self) -> Optional[Motion]:
        """The motion of the file; None without one."""

    def values(self, kind: Optional[str] = None) -> dict[str, str]:
        """Every value that has an effect on a kind of cam, defaults too, as it was typed; a radius given by its diameter is "Ø20 mm"."""

    def cam(
        self,
        kind: Optional[Literal["make", "rotary", "translating", "conoid", "compensator"]] = None,
        *,
        rpm: Union[float, str, Sequence[float], None] = None,
        motion: Optional[Motion] = None,
        end: Optional[Literal["outer", "inner"]] = None,
        free: Optional[_Formats] = None,
        solver: Literal["ode", "paper"] = "ode",
        stations: Optional[int] = None,
        balance: Literal["braking", "return", "mean"] = "braking",
        residual: Optional[_Quantity] = None,
        cutter_diameter: Optional[_Quantity] = None,
        cutter_radius: Optional[_Quantity] = None,
    ) -> Cam:
        """Solves a cam, as the command of the same name; nothing is drawn yet. Releases the lock.

        ``kind`` is "make" for a file with a motion, and "rotary" otherwise. ``rpm`` is the speed, of a conoid several, or a range "20..35"
        with the largest ``residual`` (N). ``motion`` takes the place of that of the file. ``free`` has "offset" or "pivot_distance", which
        are chosen with the base radius. The path of a cutter (m) is drawn, and the cutter must fit.

        Raises SolveError when there is no such cam.
        """

    def analyse(self, name: str, /, **options: Any) -> Analysis:
        """An analysis by the name of its command (see ``analyses()``). Releases the lock.

        ``options`` are the flags of the command: ``cut_for=30`` is ``--cut-for 30``, a list is joined by commas, True is a flag without a
        value. ``compare`` needs ``measured``, the path of the measured points.
        """

@final
class Cam:
    """A solved cam: exact curves, nothing drawn yet; with those that are made with it."""

    @property
    def kind(self) -> str:
        """The command that makes it."""

    @property
    def name(self) -> str:
        """What reports call its machine."""

    @property
    def stem(self) -> str:
        """What the names of its files begin with."""

    @property
    def rpm(self) -> Optional[list[float]]:
        """Its speed, of a conoid all of them; None where the speed does not matter."""

    @property
    def pressure_angle(self) -> Optional[float]:
        """Largest pressure angle, rad."""

    @property
    def pressure_angle_deg(self) -> Optional[float]:
        """Largest pressure angle, degrees."""

    @property
    def prime_radius_mm(self) -> Optional[float]:
        """Prime radius; None of a cam without one."""

    @property
    def base_radius_mm(self) -> Optional[float]:
        """Base radius; None of a cam without one."""

    def finding(self, check: str) -> Optional[Finding]:
        """The finding of one check, as far as it needs no drawing; None where the check does not apply."""

    def figures(self) -> dict[str, Any]:
        """The figures of the report as far as they need no drawing, by its sections; units are in their names."""

    def forces(self) -> dict[str, Any]:
        """The figures of forces and torques, as in the report: the section ``dynamics`` of a motion program, ``force`` of a press."""

    def curves(self, theta: npt.ArrayLike) -> Table:
        """The columns of the table at places of the motion, shape (n,): cam angles in rad, or travels of a plate in m."""

    def table(self, samples: int = 720) -> Table:
        """The point table with so many rows over a turn, or steps over a stroke, without what is only known of a drawing."""

    def check(
        self,
        file: Union[bytes, _Path],
        tolerance: Optional[_Quantity] = None,
        *,
        section_rpm: Optional[float] = None,
        layer: Optional[str] = None,
        cutter_diameter: Optional[_Quantity] = None,
    ) -> dict[str, Any]:
        """Whether a file is this cam, within a tolerance (m, 5 um by default): its report. Releases the lock."""

    def draw(
        self,
        tolerance: Optional[_Quantity] = None,
        *,
        accuracy: Optional[Literal["draft", "standard", "fine"]] = None,
        tolerance_velocity: Optional[_Quantity] = None,
        tolerance_acceleration: Optional[_Quantity] = None,
        side: Literal["both", "inside", "outside"] = "both",
        outline: Literal["arcs", "spline"] = "arcs",
        start: Optional[_Quantity] = None,
        lead_in: Union[str, tuple[str, _Quantity], None] = None,
        formats: Optional[_Formats] = None,
        samples: int = 720,
        dxf_version: Literal["r12", "r2000", "r2010", "r2013"] = "r2000",
        controller: Optional[str] = None,
        ball_diameter: Optional[_Quantity] = None,
        points_of: Optional[str] = None,
        points_as: Optional[str] = None,
        points_step: Optional[str] = None,
        points_between: Optional[str] = None,
    ) -> Drawing:
        """Draws the outline within a tolerance (m), with the defaults of the command line: 5 um, and 5 % of the acceleration as cut.

        A tolerance of velocity or acceleration is a share (0.05 or "5%"), a quantity ("2 mm/rad2") or "none". ``formats`` are those that
        ``write`` writes; tables of points, programs and tables for drives are drawn only if they are among them. Releases the lock.

        Raises DrawError when it cannot be drawn so.
        """

    def plot(self, samples: int = 720) -> Any:
        """Lift, velocity, acceleration and pressure angle: a figure of matplotlib, which must be installed."""

@final
class Drawing:
    """A cam as drawn to a tolerance, not yet proved."""

    def prove(self) -> Proven:
        """Writes the cut files to memory, reads them back, rolls the follower on them, and runs every check. Releases the lock."""

@final
class Proven:
    """A cam whose cut files were written to memory, read back and checked."""

    @property
    def passed(self) -> bool:
        """Whether there is an outline and no check failed."""

    @property
    def no_outline(self) -> Optional[str]:
        """Why there is no outline, where there is none."""

    @property
    def findings(self) -> tuple[Finding, ...]:
        """What every check found, failures first."""

    @property
    def report(self) -> dict[str, Any]:
        """The report, as ``--json`` prints it."""

    @property
    def outline(self) -> _Array:
        """The first outline as written, shape (n, 3), mm: closed, counter-clockwise. Each row has x, y and the bulge of the arc to the next
        vertex, tan(sweep/4), 0 of a line, NaN of a cubic curve (see ``cubics``)."""

    @property
    def outlines(self) -> list[_Array]:
        """Every outline, each as ``outline``: of flanks, of the sections of a conoid."""

    @property
    def cubics(self) -> _Array:
        """The cubic curves of the first outline by their control points, shape (m, 4, 2), mm; m = 0 of an outline of arcs."""

    @property
    def area_mm2(self) -> Optional[float]:
        """Area of the first part, bore taken off, mm²."""

    def table(self, samples: Optional[int] = None) -> Table:
        """The point table as written: that of the cam, with the motion as cut."""

    def bytes(self, ending: str) -> builtins.bytes:
        """The bytes of a file by the end of its name: ".dxf", ".step", "-points.csv". Also of a cam that breaks a limit, whose files say so."""

    def files(self, formats: Optional[_Formats] = None) -> dict[str, builtins.bytes]:
        """Every file by its name, in memory; also of a cam that breaks a limit."""

    def write(
        self,
        directory: _Path,
        *,
        formats: Optional[_Formats] = None,
        name: Optional[str] = None,
        force: bool = False,
        overwrite: bool = False,
    ) -> dict[str, Any]:
        """Writes the files, all or none, and returns the report with their names. Releases the lock.

        ``name`` is what they begin with instead of ``stem``. ``force`` writes although a check failed; ``overwrite`` also replaces files that
        camgen has not written.

        Raises RefusedError, FilesError.
        """

    def plot(self) -> Any:
        """The outlines as written: a figure of matplotlib, which must be installed."""

    def to_build123d(self) -> Any:
        """The solid as a shape of build123d, which must be installed."""

    def to_cadquery(self) -> Any:
        """The solid as a workplane of CadQuery, which must be installed."""

    def _repr_html_(self) -> Optional[str]: ...
    def _repr_svg_(self) -> Optional[str]: ...

@final
class Analysis:
    """The results of an analysis, judged."""

    @property
    def name(self) -> str:
        """The command that makes it."""

    @property
    def passed(self) -> bool:
        """Whether no check failed."""

    @property
    def findings(self) -> tuple[Finding, ...]:
        """What every check found, failures first."""

    @property
    def report(self) -> dict[str, Any]:
        """The report, as ``--json`` prints it."""

    @property
    def tables(self) -> dict[str, Table]:
        """Its tables by what the names of their files end with; the first is ""."""

    def bytes(self, ending: str) -> builtins.bytes:
        """The bytes of a file by the end of its name: ".csv", ".svg"."""

    def write(
        self,
        directory: _Path,
        *,
        formats: Optional[_Formats] = None,
        name: Optional[str] = None,
        force: bool = False,
        overwrite: bool = False,
    ) -> dict[str, Any]:
        """Writes the files, all or none, and returns the report with their names; as ``Proven.write``."""

    def _repr_html_(self) -> str: ...
    def _repr_svg_(self) -> Optional[str]: ...

@final
class Motion:
    """A motion of a follower over one turn of the cam: lifts in m, or in rad of a follower that swings; angles in rad."""

    @staticmethod
    def program(
        segments: Sequence[tuple[Optional[str], _Quantity, _Quantity]],
        *,
        start: Optional[_Quantity] = None,
        quantity: Literal["length", "angle"] = "length",
    ) -> Motion:
        """Segments of law (None or "dwell" rests), cam angle and position at the end, from ``start`` on; together they take one turn.

        Each law leads from rest to rest, and a dwell ends where it begins. What else segments can be (velocities at their ends, points, tables, formulas) has a machine
        file: ``Machine.from_dict({"motion": {"segment": [...]}, ...})``.
        """

    @staticmethod
    def from_function(
        function: Callable[[_Array], Sequence[npt.ArrayLike]],
        *,
        breaks: Optional[npt.ArrayLike] = None,
        quantity: Literal["length", "angle"] = "length",
    ) -> Motion:
        """A function of the cam angle with its derivatives by the angle.

        ``function(theta)`` gets angles of shape (n,), rad, from 0 to a turn, and returns lift, velocity, acceleration and jerk, each of
        shape (n,) or a number: m, m/rad, m/rad², m/rad³. It must be smooth between ``breaks`` (angles, rad). It is asked while the motion is
        made, and never again: between places that are as dense as needed the motion is a polynomial with all four values at both ends. A
        derivative that does not belong to the others is refused.
        """

    @staticmethod
    def from_samples(
        theta: npt.ArrayLike,
        lift: npt.ArrayLike,
        *,
        quantity: Literal["length", "angle"] = "length",
        shape: Literal["natural", "monotonic"] = "natural",
        smooth: Optional[_Quantity] = None,
        degree: Literal[3, 5] = 5,
    ) -> Motion:
        """The closed curve of least jerk through samples, as through the rows of a table: growing angles (n,), rad, that cover a turn, and
        lifts (n,).

        ``shape``, ``smooth`` ("auto", or the largest deviation from a sample) and ``degree`` are the keys of the same names in [motion]. A cam
        of it has the checks ``outlier``, ``overshoot`` and ``noise``.
        """

    @property
    def quantity(self) -> Literal["length", "angle"]:
        """What its lift is."""

    @property
    def pieces(self) -> _Array:
        """First and last angle of each smooth piece, shape (pieces, 2), rad."""

    def __call__(self, theta: npt.ArrayLike) -> _Array:
        """Lift above the lowest point, velocity, acceleration and jerk at angles (n,): shape (4, n)."""

@final
class Law:
    """A law of motion."""

    @property
    def name(self) -> str:
        """Its name in files."""

    @property
    def aliases(self) -> list[str]:
        """Its other names."""

    @property
    def formula(self) -> str:
        """Its formula between two rests."""

    @property
    def continuity(self) -> int:
        """How many of its derivatives are continuous between two rests."""

    def __call__(self, x: npt.ArrayLike) -> _Array:
        """Lift, velocity, acceleration and jerk between two rests, over travel 1 and width 1, at x (n,) from 0 to 1: shape (4, n)."""

def laws() -> list[Law]:
    """Every law of motion."""

def law(name: str) -> Law:
    """The law of a name."""

def machines() -> list[str]:
    """The names of the machine files in the package."""

def analyses() -> list[str]:
    """The names of the analyses."""

def analyse(name: str, machine: Optional[Machine] = None, /, **options: Any) -> Analysis:
    """An analysis by the name of its command: as ``machine.analyse``; ``laws`` needs no machine."""

def command(typed: Sequence[str]) -> int:
    """Runs a command line, the name of the program first, and returns its exit code."""

def write_shard(folder: _Path, name: str, data: bytes, alone: bool = False) -> None:
    """Writes a file whole into a folder, made if missing: a link, a pipe or a folder of its name is refused. Unless it is written ``alone``, other
    processes may write other files there at the same time.

    Raises FilesError.
    """

@final
class Study:
    """A study file: many designs of one machine file, a row of figures for each. Row i depends on the file and on i alone."""

    @staticmethod
    def load(name_or_path: _Path) -> Study:
        """An embedded study by its name, or a study file; its base is found from the folder of the file.

        Raises MachineError with every fault of the study file or of its base.
        """

    @staticmethod
    def from_toml(text: str, *, name: str = "study") -> Study:
        """A study of TOML text; its base is an embedded machine or is found from the working folder."""

    @property
    def name(self) -> str:
        """What the file calls it."""

    @property
    def stem(self) -> str:
        """What the names of its files begin with."""

    @property
    def kind(self) -> str:
        """sweep, monte-carlo or pareto."""

    @property
    def digest(self) -> str:
        """SHA-256 of all that determines its rows: its text, its base and the version of camgen."""

    @property
    def proves(self) -> bool:
        """Whether a column needs the cam to be drawn and proved."""

    @property
    def header(self) -> bytes:
        """The first line of its table."""

    def __len__(self) -> int: ...
    def file_stem(self, name: Optional[str] = None) -> str:
        """What the names of its files begin with. Raises OptionError for a name that files cannot have."""

    def design(self, row: int) -> tuple[list[str], Optional[float]]:
        """The overrides of a design as ``--set`` takes them, ``KEY=VALUE`` each, and its speed in rpm where one is given."""

    def rows(self, start: int, end: int) -> bytes:
        """The lines of the rows from ``start`` up to and without ``end``. The interpreter's lock is released."""

    def collect(
        self, stretches: Iterable[bytes], out: _Path, *, name: Optional[str] = None, page: bool = False, overwrite: bool = False
    ) -> tuple[str, list[pathlib.Path]]:
        """Puts stretches of rows, in their order, together to the files of ``camgen study``; every row must come once.

        Returns the summary as JSON text, and the files.
        """
