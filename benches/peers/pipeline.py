"""The job of `camgen rotary` as a capable Python user would do it: numpy, shapely, ezdxf, OpenCASCADE by way of OCP.

The cam is the embedded machine `dpi` at 35 rpm with its base radius given, lengths in millimetres, angles in radians.

usage: pipeline.py normals|shapely|spline TOLERANCE_MM DIRECTORY
"""
import importlib
import json
import math
import os
import sys
import time
from pathlib import Path

# Libraries but numpy are imported where they are used: the measured process must load only what its way needs.
import numpy as np

A, K, CRANK = 1 / 180, 1.35, 180.0
L = K / A
ROLLER, PRIME, BORE, THICKNESS, WIDTH = 30.0, 99.0, 25.0, 30.0, math.radians(20)
# Nodes of the spline on reversal, each run-up and dwell, the fewest of a coarse search beforehand.
SPLINE_NODES = {0.005: (48, 14, 10), 0.001: (82, 27, 12)}


# --- the cam ---------------------------------------------------------------------


def law(x):
    """Equation (10), as the paper prints it."""
    return L * (1 - (A * x + 1) ** (-1 / K)) - x


def bottom(theta):
    """Δx and its first two derivatives by the cam angle: dwell, run-up, reversal, and their mirror images."""
    phi = np.mod(theta + math.pi / 2, 2 * math.pi) - math.pi / 2
    side = np.where(phi > math.pi / 2, -1.0, 1.0)
    phi = np.minimum(phi, math.pi - phi)
    x, dx = CRANK * np.sin(np.maximum(phi, 0)), CRANK * np.cos(np.maximum(phi, 0))
    base = 1 + A * x
    slope, second = base ** (-1 / K - 1) - 1, -A * (1 / K + 1) * base ** (-1 / K - 2)
    reversal = law(x), slope * dx, second * dx**2 - slope * x
    # Quintic from rest without jerk to value 0, slope 0 and the reversal's first curvature: t⁴ and t⁵ only.
    end = -A * (1 / K + 1) * CRANK**2 * WIDTH**2
    t = np.clip(phi / WIDTH + 1, 0, 1)
    run_up = end * (1 / 20 - t**4 / 4 + t**5 / 5), end * (t**4 - t**3) / WIDTH, end * (4 * t**3 - 3 * t**2) / WIDTH**2
    value, first, curvature = (np.where(phi >= 0, a, b) for a, b in zip(reversal, run_up))
    return value, side * first, curvature


def pitch(theta):
    """Pitch curve and its first two derivatives, as complex numbers."""
    value, first, second = bottom(theta)
    u, turn = PRIME + value - law(CRANK), np.exp(1j * theta)
    return u * turn, (first + 1j * u) * turn, (second - u + 2j * first) * turn


def curvature(first, second):
    return (first.conj() * second).imag / np.abs(first) ** 3


def profile(theta):
    """Profile by the analytic normal, and its curvature."""
    point, first, second = pitch(theta)
    kappa = curvature(first, second)
    return point + 1j * ROLLER * first / np.abs(first), kappa / (1 - ROLLER * kappa)


def shares(points, kappa, theta, sagitta, more):
    """Cam angles of the fewest chords with this sagitta: equal shares of ∫√(κ/8·sagitta) ds."""
    density = np.sqrt(np.maximum(np.abs(kappa), 1e-4) / (8 * sagitta))
    sums = np.concatenate([[0], np.cumsum((density[1:] + density[:-1]) / 2 * np.abs(np.diff(points)))])
    return np.interp(np.linspace(0, sums[-1], math.ceil(sums[-1] * more) + 1)[:-1], sums, theta)


def chord_error(theta, nodes):
    """Largest distance of the profile from its chords, at a few places of every chord."""
    chord, ahead = np.roll(nodes, -1) - nodes, np.append(theta[1:], theta[0] + 2 * math.pi)
    places = (profile(theta + f * (ahead - theta))[0] for f in (0.0, 0.15, 0.3, 0.5, 0.7, 0.85))
    return max(np.abs(((p - nodes) * chord.conj()).imag / np.abs(chord)).max() for p in places)


def outline_normals(tolerance):
    """The fewest chords found: nodes one tolerance outside the metal's curve, middles one inside."""
    grid = np.linspace(0, 2 * math.pi, 20001)
    points, kappa = profile(grid)
    for more in np.arange(1.0, 2.0, 0.005):
        theta = shares(points, kappa, grid, 2 * tolerance, more)
        on_curve, bend = profile(theta)
        _, first, _ = pitch(theta)
        nodes = on_curve - 1j * first / np.abs(first) * tolerance * np.sign(bend) * 0.995
        if chord_error(theta, nodes) <= tolerance:
            return nodes
    sys.exit("no polyline within the tolerance")


def outline_shapely(tolerance):
    """The pitch curve in chords, offset by shapely."""
    import shapely

    # GEOS snaps and simplifies what it buffers: chords of the whole tolerance miss it by up to 15 %.
    sagitta = 0.85 * tolerance
    grid = np.linspace(0, 2 * math.pi, 20001)
    points, first, second = pitch(grid)
    theta = shares(points, curvature(first, second), grid, sagitta, 1.0)
    nodes = pitch(theta)[0]
    quarter = math.ceil(math.pi / 4 / math.acos(1 - sagitta / ROLLER))
    ring = shapely.Polygon(np.c_[nodes.real, nodes.imag]).buffer(-ROLLER, quad_segs=quarter)
    xy = shapely.get_coordinates(ring.exterior)[:-1]
    return xy[:, 0] + 1j * xy[:, 1]


# --- the files, like camgen's ----------------------------------------------------


def write_dxf(nodes, path):
    import ezdxf

    document = ezdxf.new("R2000")
    space = document.modelspace()
    layer = {"layer": "CAM_PROFILE"}
    space.add_lwpolyline(np.c_[nodes.real, nodes.imag].tolist(), close=True, dxfattribs=layer)
    space.add_circle((0, 0), BORE, dxfattribs={"layer": "BORE"})
    document.saveas(path)


def polyline_wire(nodes):
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakePolygon
    from OCP.gp import gp_Pnt

    polygon = BRepBuilderAPI_MakePolygon()
    for node in nodes:
        polygon.Add(gp_Pnt(node.real, node.imag, 0))
    polygon.Close()
    return polygon.Wire()


def spline_wire(tolerance):
    """Periodic cubic spline through points of the exact profile, nodes on the joints of the law."""
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeEdge, BRepBuilderAPI_MakeWire
    from OCP.GeomAPI import GeomAPI_Interpolate
    from OCP.gp import gp_Pnt
    from OCP.TColgp import TColgp_HArray1OfPnt
    from OCP.TColStd import TColStd_HArray1OfReal

    reversal, run_up, dwell = SPLINE_NODES[tolerance]
    pieces = [(0, 180, reversal), (180, 200, run_up), (200, 340, dwell), (340, 360, run_up)]
    theta = np.radians(np.concatenate([np.linspace(a, b, n, endpoint=False) for a, b, n in pieces]))
    points, parameters = TColgp_HArray1OfPnt(1, len(theta)), TColStd_HArray1OfReal(1, len(theta) + 1)
    for i, (node, angle) in enumerate(zip(profile(theta)[0], theta), 1):
        points.SetValue(i, gp_Pnt(node.real, node.imag, 0))
        parameters.SetValue(i, float(angle))
    parameters.SetValue(len(theta) + 1, 2 * math.pi)
    fit = GeomAPI_Interpolate(points, parameters, True, 1e-9)
    fit.Perform()
    return BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(fit.Curve()).Edge()).Wire()


def write_step(wire, path):
    """Face with the bore as a hole, then a prism: quicker than cutting the bore from the solid."""
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeEdge, BRepBuilderAPI_MakeFace, BRepBuilderAPI_MakeWire
    from OCP.BRepPrimAPI import BRepPrimAPI_MakePrism
    from OCP.gp import gp_Ax2, gp_Circ, gp_Dir, gp_Pnt, gp_Vec
    from OCP.STEPControl import STEPControl_AsIs, STEPControl_Writer
    from OCP.TopoDS import TopoDS

    bore = gp_Circ(gp_Ax2(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1)), BORE)
    hole = BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(bore).Edge()).Wire()
    face = BRepBuilderAPI_MakeFace(wire, True)
    face.Add(TopoDS.Wire_s(hole.Reversed()))
    writer = STEPControl_Writer()
    writer.Transfer(BRepPrimAPI_MakePrism(face.Face(), gp_Vec(0, 0, THICKNESS)).Shape(), STEPControl_AsIs)
    writer.Write(str(path))


def write_table(path, rows=720):
    theta = np.arange(rows) * (2 * math.pi / rows)
    (value, first, second), point, (flank, kappa) = bottom(theta), pitch(theta)[0], profile(theta)
    columns = theta, value, first, second, point.real, point.imag, flank.real, flank.imag, kappa
    np.savetxt(path, np.c_[columns], "%.17g", ",", header="cam,dx,d1,d2,pitch_x,pitch_y,profile_x,profile_y,kappa")


def pipeline(kind, tolerance, directory):
    """Writes DXF, STEP and CSV, syncs them as camgen does, and prints what each stage took, in ms."""
    took, start = {}, time.perf_counter()

    def lap(stage):
        nonlocal start
        took[stage] = (time.perf_counter() - start) * 1e3
        start = time.perf_counter()

    for name in ("ezdxf", "OCP.STEPControl", "OCP.BRepPrimAPI", *(["shapely"] if kind == "shapely" else [])):
        importlib.import_module(name)
    lap("imports")
    nodes = (outline_shapely if kind == "shapely" else outline_normals)(tolerance)
    lap("outline")
    write_dxf(nodes, directory / "cam.dxf")
    lap("dxf")
    write_step(spline_wire(tolerance) if kind == "spline" else polyline_wire(nodes), directory / "cam.step")
    lap("step")
    write_table(directory / "cam.csv")
    for file in directory.iterdir():
        with open(file, "rb") as handle:
            os.fsync(handle.fileno())
    lap("csv, sync")
    print(json.dumps(took))


if __name__ == "__main__":
    pipeline(sys.argv[1], float(sys.argv[2]), Path(sys.argv[3]))
