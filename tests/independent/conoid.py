"""Checks the conoid's solid and sections with OpenCASCADE and a surface of its own.

Shares nothing with camgen but the machine file and the chosen base radius. The law is equation (10) with the columns of
(14); through four sections the not-a-knot spline is one cubic, found here by a Vandermonde system; normals are
differences; the sphere of the roller is moved in along them. Its points of contact must lie on the flank OpenCASCADE
reads, and where the flank is cut at a section's height it must be the outline of that section's DXF.

usage: conoid.py CAMGEN_BINARY DIRECTORY
"""
import json
import subprocess
import sys
from pathlib import Path

import numpy as np
from OCP.BRep import BRep_Tool
from OCP.BRepAdaptor import BRepAdaptor_Curve
from OCP.BRepAlgoAPI import BRepAlgoAPI_Section
from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeVertex
from OCP.BRepCheck import BRepCheck_Analyzer
from OCP.BRepExtrema import BRepExtrema_DistShapeShape
from OCP.BRepGProp import BRepGProp
from OCP.gp import gp_Dir, gp_Pln, gp_Pnt
from OCP.GProp import GProp_GProps
from OCP.STEPControl import STEPControl_Reader
from OCP.TopAbs import TopAbs_EDGE, TopAbs_SHELL, TopAbs_SOLID
from OCP.TopExp import TopExp_Explorer
from OCP.TopoDS import TopoDS
from outline import Chain, polyline

R, K, ROLLER, TRAVEL = 180.0, 1.35, 30.0, 120.0
SPEEDS = np.array([20.0, 25.0, 30.0, 35.0])


def cast(name, shape):
    for suffix in ("", "_s"):
        if hasattr(TopoDS, name + suffix):
            return getattr(TopoDS, name + suffix)(shape)
    raise AttributeError(name)


def each(shape, kind):
    explorer = TopExp_Explorer(shape, kind)
    while explorer.More():
        yield explorer.Current()
        explorer.Next()


class Surface:
    """Pitch surface within the reversal, mm and rad."""

    def __init__(self, prime, mode, shift):
        loading = SPEEDS**2 / 35.0**2 / R
        design = K * R
        shortening = R + (design * (1 - 2 ** (-1 / K)) - R)
        self.A = loading
        self.L = np.full(4, design) if mode == "fixed" else shortening / (1 - (1 + loading * R) ** (-1 / K))
        square = SPEEDS if shift == "linear" else SPEEDS**2
        self.z = TRAVEL * (square - square[0]) / (square[-1] - square[0])
        self.inverse = np.linalg.inv(np.vander(self.z / TRAVEL, 4))
        self.lowest = min(self.bottom(np.pi / 2).min(), 0.0)
        self.prime = prime

    def bottom(self, theta):
        x = R * np.sin(theta)
        return self.L * (1 - (self.A * x + 1) ** (-1 / K)) - x

    def pitch(self, theta, z):
        weights = np.vander([z / TRAVEL], 4)[0] @ self.inverse
        radius = self.prime + weights @ self.bottom(theta) - self.lowest
        return np.array([radius * np.cos(theta), radius * np.sin(theta), z])

    def contact(self, theta, z, h=1e-4):
        by_theta = (self.pitch(theta + h, z) - self.pitch(theta - h, z)) / (2 * h)
        by_z = (self.pitch(theta, z + h * 100) - self.pitch(theta, z - h * 100)) / (200 * h)
        normal = np.cross(by_theta, by_z)
        return self.pitch(theta, z) - ROLLER * normal / np.linalg.norm(normal)


def gate(binary, directory, name, mode, shift, extra):
    args = ["--rpm", "20,25,30,35", "--set", f"conoid.mode={mode}", "--set", f"conoid.shift={shift}", *extra]
    command = [binary, "conoid", *args, "--json", "--format", "dxf,step", "--name", name, "--out", directory]
    run = subprocess.run(command, capture_output=True, text=True)
    assert run.returncode == 0, run.stderr + run.stdout[-900:]
    report = json.loads(run.stdout)
    turned = any("ccw" in word for word in extra)
    surface = Surface(report["cam"]["prime_radius_mm"], mode, shift)
    assert np.allclose([s["z_mm"] for s in report["sections"]], surface.z, atol=1e-9)

    reader = STEPControl_Reader()
    reader.ReadFile(str(directory / f"{name}.step"))
    assert reader.WS().Model().GlobalCheck(True).NbFails() == 0 and reader.TransferRoots() == 1
    shape = reader.OneShape()
    shells = list(each(shape, TopAbs_SHELL))
    assert len(list(each(shape, TopAbs_SOLID))) == 1 and len(shells) == 1
    assert BRep_Tool.IsClosed_s(shells[0]) and BRepCheck_Analyzer(shape).IsValid(), "not valid or not closed"

    # OpenCASCADE's volume over faces of many spans is good to its own tolerance only; an honest one is asked for.
    properties = GProp_GProps()
    BRepGProp.VolumePropertiesGK_s(shape, properties, 1e-7)
    volume = abs(properties.Mass() / report["cam"]["volume_mm3"] - 1)
    low, high = report["cam"]["z_min_mm"], report["cam"]["z_max_mm"]
    areas = np.array([s["area_mm2"] for s in report["sections"]])
    integral = np.polyint(np.polyfit(surface.z, areas, 3))
    by_areas = abs((np.polyval(integral, high) - np.polyval(integral, low)) / report["cam"]["volume_mm3"] - 1)

    worst = 0.0
    for theta in np.radians(np.linspace(2, 178, 23)):
        for z in np.linspace(low + 15, high - 15, 5):
            x, y, zc = surface.contact(theta, z)
            vertex = BRepBuilderAPI_MakeVertex(gp_Pnt(x, -y if turned else y, zc)).Vertex()
            worst = max(worst, BRepExtrema_DistShapeShape(vertex, shells[0]).Value())

    apart = 0.0
    for speed, z in list(zip(SPEEDS, surface.z))[1:-1]:
        section = BRepAlgoAPI_Section(shape, gp_Pln(gp_Pnt(0, 0, float(z)), gp_Dir(0, 0, 1)))
        points = []
        for edge in each(section.Shape(), TopAbs_EDGE):
            curve = BRepAdaptor_Curve(cast("Edge", edge))
            for t in np.linspace(curve.FirstParameter(), curve.LastParameter(), 60):
                p = curve.Value(t)
                if np.hypot(p.X(), p.Y()) > 26:
                    points.append((p.X(), p.Y()))
        _, vertices = polyline(directory / f"{name}-{speed:g}rpm.dxf")
        apart = max(apart, Chain(vertices).distance(np.array(points)).max())

    assert volume < 1e-6, f"volume off by {volume}"
    assert by_areas < 2e-4, f"areas integrate to another volume: {by_areas}"
    assert worst < 0.005, f"contact {worst} mm off the flank"
    assert apart < 0.01, f"sections {apart} mm off the flank"
    return volume, by_areas, worst, apart


def main():
    binary, directory = Path(sys.argv[1]).resolve(), Path(sys.argv[2])
    cases = {
        "adjusted": ("adjusted", "linear", []),
        "fixed": ("fixed", "linear", []),
        "square-ccw": ("adjusted", "square", ["--set", "cam.rotation=ccw", "--set", "conoid.overhang=3mm"]),
    }
    print(f"{'conoid':12} {'volume':>9} {'by areas':>9} {'contact/mm':>11} {'sections/mm':>12}")
    failed = 0
    for name, (mode, shift, extra) in cases.items():
        try:
            volume, by_areas, worst, apart = gate(binary, directory, f"conoid-{name}", mode, shift, extra)
            print(f"{name:12} {volume:9.1e} {by_areas:9.1e} {worst:11.5f} {apart:12.5f}")
        except AssertionError as error:
            failed += 1
            print(f"{name}: {error}")
    sys.exit(bool(failed))


main()
