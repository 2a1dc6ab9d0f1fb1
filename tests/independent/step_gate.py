"""Reads the written STEP files with OpenCASCADE and compares them with the DXF and the report.

Loads without a message, one valid closed solid, no tolerance above 1e-6 mm, volume to 1e-9, section at half height equal
to the outline and holes of the DXF to a nanometre.

usage: step_gate.py CAMGEN_BINARY DIRECTORY
"""
import json
import subprocess
import sys
from pathlib import Path

import ezdxf
import numpy as np
from OCP.BRep import BRep_Tool
from OCP.BRepAdaptor import BRepAdaptor_Curve
from OCP.BRepAlgoAPI import BRepAlgoAPI_Section
from OCP.BRepCheck import BRepCheck_Analyzer
from OCP.BRepGProp import BRepGProp
from OCP.BRepTools import BRepTools
from OCP.GeomAbs import GeomAbs_Circle, GeomAbs_Cylinder, GeomAbs_Line, GeomAbs_Plane
from OCP.BRepAdaptor import BRepAdaptor_Surface
from OCP.GProp import GProp_GProps
from OCP.IFSelect import IFSelect_RetDone
from OCP.gp import gp_Dir, gp_Pln, gp_Pnt
from OCP.ShapeAnalysis import ShapeAnalysis_ShapeTolerance
from OCP.STEPControl import STEPControl_Reader
from OCP.TopAbs import TopAbs_EDGE, TopAbs_FACE, TopAbs_SHELL, TopAbs_SOLID
from OCP.TopExp import TopExp_Explorer
from OCP.TopoDS import TopoDS
from outline import Chain

THICKNESS = 30.0


def each(shape, kind):
    explorer = TopExp_Explorer(shape, kind)
    while explorer.More():
        yield explorer.Current()
        explorer.Next()


def cast(name, shape):
    """TopoDS.Face_s or TopoDS.Face, as the version has it."""
    return getattr(TopoDS, f"{name}_s", None)(shape) if hasattr(TopoDS, f"{name}_s") else getattr(TopoDS, name)(shape)


def contours(path):
    """Every closed chain of a DXF file: outline, bore, holes."""
    chains = []
    for entity in ezdxf.readfile(path).modelspace():
        if entity.dxftype() == "CIRCLE":
            (x, y, _), r = entity.dxf.center, entity.dxf.radius
            chains.append(Chain(np.array([[x + r, y, 1.0], [x - r, y, 1.0]])))
        else:
            chains.append(Chain(np.array(entity.get_points("xyb"), dtype=float)))
    return chains


def gate(binary, directory, name, args):
    command = [binary, *(args if args[:1] == ["translating"] else ["rotary", *args]), "--json", "--format", "dxf,step", "--name", name, "--out", directory]
    run = subprocess.run(command, capture_output=True, text=True)
    assert run.returncode == 0, run.stderr
    report = json.loads(run.stdout)
    reader = STEPControl_Reader()
    assert reader.ReadFile(str(directory / f"{name}.step")) == IFSelect_RetDone, "not read"
    checks = reader.WS().Model().GlobalCheck(True)
    assert checks.NbFails() == 0 and checks.NbWarnings() == 0, "messages on loading"
    assert reader.TransferRoots() == 1
    shape = reader.OneShape()
    solids, shells = list(each(shape, TopAbs_SOLID)), list(each(shape, TopAbs_SHELL))
    assert len(solids) == 1 and len(shells) == 1, f"{len(solids)} solids"
    assert BRep_Tool.IsClosed_s(shells[0]) and BRepCheck_Analyzer(shape).IsValid(), "not valid or not closed"
    worst = ShapeAnalysis_ShapeTolerance().Tolerance(shape, 1)
    assert worst <= 1e-6, f"tolerance {worst}"

    kinds = {BRepAdaptor_Surface(cast("Face", face)).GetType() for face in each(shape, TopAbs_FACE)}
    assert kinds <= {GeomAbs_Plane, GeomAbs_Cylinder}, f"surfaces {kinds}"
    kinds = {BRepAdaptor_Curve(cast("Edge", edge)).GetType() for edge in each(shape, TopAbs_EDGE)}
    assert kinds <= {GeomAbs_Line, GeomAbs_Circle}, f"curves {kinds}"

    # A tight accuracy: the defaults are off by more than the promise on faces bounded by many arcs.
    properties = GProp_GProps()
    BRepGProp.VolumeProperties_s(shape, properties, 1e-12)
    expected = report["cam"]["area_mm2"] * THICKNESS
    volume = abs(properties.Mass() / expected - 1)
    assert volume <= 1e-9, f"volume {properties.Mass()} instead of {expected}"

    section = BRepAlgoAPI_Section(shape, gp_Pln(gp_Pnt(0, 0, THICKNESS / 2), gp_Dir(0, 0, 1)))
    points, length = [], 0.0
    for edge in each(section.Shape(), TopAbs_EDGE):
        curve = BRepAdaptor_Curve(cast("Edge", edge))
        low, high = curve.FirstParameter(), curve.LastParameter()
        for t in np.linspace(low, high, 40):
            p = curve.Value(t)
            points.append((p.X(), p.Y()))
        linear = GProp_GProps()
        BRepGProp.LinearProperties_s(edge, linear)
        length += linear.Mass()
    chains = contours(directory / f"{name}.dxf")
    points = np.array(points)
    apart = np.min([chain.distance(points) for chain in chains], axis=0).max()
    assert apart <= 1e-6, f"the section is {apart} mm off the DXF"
    whole = sum(np.where(c.is_arc, c.radius * np.abs(c.sweep), c.length).sum() for c in chains)
    assert abs(length / whole - 1) < 1e-9, f"the section is {length} mm long, the DXF {whole}"
    size = (directory / f"{name}.step").stat().st_size
    return len(list(each(shape, TopAbs_FACE))), worst, volume, apart, size


def main():
    binary, directory = Path(sys.argv[1]).resolve(), Path(sys.argv[2])
    keyway = ["--set", "cam.keyway.width=8mm", "--set", "cam.keyway.depth=3.3mm", "--set", "cam.keyway.angle=90deg"]
    holes = ["--set", "cam.lever=0.15", "--set", "cam.base_radius=90mm", "--set", "cam.balance=40mm .. 85mm", "--set",
             "limits.contact_stress=3000MPa"]
    cases = {
        "plain": [],
        "fine": ["--tolerance", "0.05um"],
        "keyway": keyway,
        "holes": [*holes, *keyway],
        "corner": ["--set", "buffer.column=return", "--set", "transition.kind=none", "--set", "limits.continuity=0",
                   "--set", "cam.rotation=ccw"],
        "huge": ["dpi-paper"],
        "plate": ["translating"],
        "return plate": ["translating", "--set", "buffer.column=return"],
        "cyrillic": ["--set", "name=Станок 'ДПИ'"],
    }
    print(f"{'solid':10} {'faces':>5} {'tolerance':>10} {'volume':>9} {'section/mm':>11} {'bytes':>7}")
    failed = 0
    for name, args in cases.items():
        try:
            faces, tolerance, volume, apart, size = gate(binary, directory, name, args)
            print(f"{name:10} {faces:5} {tolerance:10.1e} {volume:9.1e} {apart:11.1e} {size:7}")
        except AssertionError as error:
            failed += 1
            print(f"{name:10} FAILED {error}")
    print(f"{len(cases) - failed} passed, {failed} failed")
    sys.exit(failed > 0)


main()
