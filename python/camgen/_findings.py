"""What a check found."""

from __future__ import annotations

from typing import NamedTuple, Optional


class Finding(NamedTuple):
    """The result of a check: its value against its limit at the worst place."""

    #: Name of the check, as in ``camgen explain``.
    check: str
    #: The value in ``unit``; NaN where there is nothing to measure.
    value: float
    #: Its limit in ``unit``; None without one.
    limit: Optional[float]
    #: On which side of the limit the value must be: "at most", "at least", "above", "exactly".
    bound: Optional[str]
    #: Unit of both.
    unit: str
    #: The worst place as a cam angle, degrees; None where it is none.
    cam_deg: Optional[float]
    #: The worst place as an overrun of the bed or a travel of a plate, mm.
    x_mm: Optional[float]
    #: "pass", "fail", "warn" or "info".
    verdict: str
    #: What the check means.
    about: Optional[str]
    #: A remedy, or what the figure means.
    note: Optional[str]
