"""camgen: cam profiles a CNC shop can cut.

A cam is solved exactly, drawn within a tolerance, and proved on its own bytes: the file is written to memory, read back, and the follower
is rolled on what was read. Only what was proved can be written.

    >>> import camgen
    >>> machine = camgen.Machine.load("feeder", {"cam.thickness": "20mm"})
    >>> cam = machine.cam(rpm=120)
    >>> cam.base_radius_mm, round(cam.pressure_angle_deg, 2)
    (17.0, 29.17)
    >>> proven = cam.draw("5um").prove()
    >>> proven.passed
    True

A number is in SI units (metres, radians, newtons); a text has its unit (``"5um"``, ``"30 deg"``). What is not SI ends in its unit.
Solving, drawing, proving and writing release the interpreter's lock, and every object can be used from several threads.
"""

from ._camgen import (
    Analysis,
    Cam,
    Drawing,
    Law,
    Machine,
    Motion,
    Proven,
    Study,
    __version__,
    analyse,
    analyses,
    law,
    laws,
    machines,
)
from ._errors import (
    CamgenError,
    DrawError,
    Fault,
    FilesError,
    MachineError,
    OptionError,
    ProofError,
    ReadError,
    RefusedError,
    SolveError,
)
from ._findings import Finding
from ._table import Table

__all__ = [
    "Analysis",
    "Cam",
    "CamgenError",
    "DrawError",
    "Drawing",
    "Fault",
    "FilesError",
    "Finding",
    "Law",
    "Machine",
    "MachineError",
    "Motion",
    "OptionError",
    "ProofError",
    "Proven",
    "ReadError",
    "RefusedError",
    "SolveError",
    "Study",
    "Table",
    "__version__",
    "analyse",
    "analyses",
    "law",
    "laws",
    "machines",
]
