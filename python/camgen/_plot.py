"""Plots by matplotlib, where it is installed."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

if TYPE_CHECKING:
    from ._camgen import Cam, Proven

#: Points on an arc of a plotted outline.
_ON_ARC = 9


def _title(column: str) -> str:
    return column.replace("_", " ")


def cam(solved: Cam, samples: int = 720) -> Any:
    """Lift, velocity, acceleration and pressure angle over the first column: a figure of matplotlib."""
    from matplotlib.figure import Figure

    table = solved.table(samples)
    along = next(name for name in ("cam_deg", "x_mm", table.columns[0]) if name in table)
    begins = ("lift_", "velocity_", "acceleration_", "pressure_angle_")
    shown = [next((name for name in table.columns if name.startswith(begin)), None) for begin in begins]
    columns = [name for name in shown if name is not None] or [table.columns[1]]
    figure = Figure(figsize=(8, 1.9 * len(columns)), layout="constrained")
    axes = figure.subplots(len(columns), 1, sharex=True, squeeze=False)[:, 0]
    for axis, name in zip(axes, columns):
        axis.plot(table[along], table[name])
        axis.set_ylabel(_title(name), fontsize="small")
        axis.grid(True, alpha=0.3)
    axes[-1].set_xlabel(_title(along))
    axes[0].set_title(solved.name)
    return figure


def points_of(outline: npt.NDArray[np.float64], on_arc: int = _ON_ARC) -> npt.NDArray[np.float64]:
    """Points (n, 2) along an outline of arcs by its vertices (x, y, bulge), closed: on every arc so many, on a line its start."""
    start, end = outline[:, :2], np.roll(outline[:, :2], -1, axis=0)
    # The bulge is the tangent of a quarter of the sweep; t runs along the chord, and the arc is its rational quadratic.
    bulge = np.nan_to_num(outline[:, 2])
    chord = end - start
    left = np.stack([-chord[:, 1], chord[:, 0]], axis=1)
    sweep = 4.0 * np.arctan(bulge)
    share = np.linspace(0.0, 1.0, on_arc, endpoint=False)
    angle = sweep[:, None] * share[None, :]
    with np.errstate(divide="ignore", invalid="ignore"):
        half = 0.5 * sweep[:, None]
        along = np.where(sweep[:, None] == 0.0, share[None, :], np.sin(0.5 * angle) * np.cos(0.5 * angle - half) / np.sin(half))
        across = np.where(sweep[:, None] == 0.0, 0.0, np.sin(0.5 * angle) * np.sin(0.5 * angle - half) / np.sin(half))
    points = start[:, None, :] + along[:, :, None] * chord[:, None, :] + across[:, :, None] * left[:, None, :]
    points = points.reshape(-1, 2)
    closed: npt.NDArray[np.float64] = np.concatenate([points, points[:1]])
    return closed


def proven(cut: Proven) -> Any:
    """The outlines as written, in the drawing plane: a figure of matplotlib."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(6, 6), layout="constrained")
    axis = figure.subplots()
    for outline in cut.outlines:
        points = points_of(outline)
        axis.plot(points[:, 0], points[:, 1])
    axis.plot(0.0, 0.0, "k+")
    axis.set_aspect("equal")
    axis.set_xlabel("x mm")
    axis.set_ylabel("y mm")
    axis.set_title(repr(cut).strip("<>"))
    axis.grid(True, alpha=0.3)
    return figure
