"""Lets OpenCASCADE read camgen's solids and write them again, and `camgen check` judge what it wrote.

The same solid in AP203, AP214 and AP242, with and without curves in the parameters of their surfaces, with faces of one surface
merged, and split by a plane: exit 0. Moved by four tolerances, turned, mirrored, scaled, in inches, with a hole more, fused with
another body, two in one file: exit 1.

Of outlines of splines as well their lower face extruded again, which makes surfaces of extrusion, and bodies cut and joined at
seeded planes, which leaves faces on parts of their surfaces. Against them stand seeded bumps on one control point, through
all the height (another outline, exit 1 by `outline`) or not.

usage: step_check.py CAMGEN_BINARY DIRECTORY [--splines COUNT]
"""
import argparse
import math
import random
import re
import subprocess
import sys
from pathlib import Path

from OCP.BRep import BRep_Builder
from OCP.BRepAdaptor import BRepAdaptor_Surface
from OCP.BRepAlgoAPI import BRepAlgoAPI_Common, BRepAlgoAPI_Cut, BRepAlgoAPI_Fuse
from OCP.BRepBuilderAPI import BRepBuilderAPI_NurbsConvert, BRepBuilderAPI_Transform
from OCP.BRepPrimAPI import BRepPrimAPI_MakeBox, BRepPrimAPI_MakeCylinder, BRepPrimAPI_MakePrism
from OCP.GeomAbs import GeomAbs_Plane
from OCP.Interface import Interface_Static
from OCP.IFSelect import IFSelect_RetDone
from OCP.ShapeUpgrade import ShapeUpgrade_ShapeDivideAngle, ShapeUpgrade_UnifySameDomain
from OCP.STEPControl import STEPControl_AsIs, STEPControl_Reader, STEPControl_Writer
from OCP.TopAbs import TopAbs_FACE
from OCP.TopExp import TopExp_Explorer
from OCP.TopoDS import TopoDS, TopoDS_Compound
from OCP.gp import gp_Ax1, gp_Ax2, gp_Dir, gp_Pnt, gp_Trsf, gp_Vec

KEYWAY = ["--set", "cam.keyway.width=8mm", "--set", "cam.keyway.depth=3.3mm", "--set", "cam.keyway.angle=90deg"]
HOLES = ["--set", "cam.lever=0.15", "--set", "cam.base_radius=90mm", "--set", "cam.balance=40mm .. 85mm"]
CAMS = {
    "disc": ("rotary", ["--rpm", "35"]),
    "keyway": ("rotary", ["--rpm", "35", "--set", "cam.rotation=ccw", *KEYWAY]),
    "holes": ("rotary", ["--rpm", "35", *HOLES]),
    "plate": ("translating", ["--rpm", "35"]),
    "splines": ("rotary", ["--rpm", "35", "--set", "cam.rotation=ccw", *KEYWAY]),
    "splines-plate": ("translating", ["--rpm", "35"]),
    "conoid": ("conoid", ["--rpm", "20,25,30,35"]),
    "conoid-ccw": ("conoid", ["--rpm", "20,35", "--set", "cam.rotation=ccw", *KEYWAY]),
    "conoid-fixed": ("conoid", ["--rpm", "20,27,35", "--set", "conoid.mode=fixed"]),
}


def read(path):
    reader = STEPControl_Reader()
    assert reader.ReadFile(str(path)) == IFSelect_RetDone, path
    reader.TransferRoots()
    return reader.OneShape()


def static(name, value):
    set_value = getattr(Interface_Static, "SetCVal_s", None) or Interface_Static.SetCVal
    assert set_value(name, value), name


def write(shape, path, schema="AP214IS", pcurves="1", unit="MM"):
    writer = STEPControl_Writer()
    static("write.step.schema", schema)
    static("write.step.unit", unit)
    (getattr(Interface_Static, "SetIVal_s", None) or Interface_Static.SetIVal)("write.surfacecurve.mode", int(pcurves))
    writer.Transfer(shape, STEPControl_AsIs)
    assert writer.Write(str(path)) == IFSelect_RetDone, path


def transformed(shape, change):
    transformation = gp_Trsf()
    change(transformation)
    return BRepBuilderAPI_Transform(shape, transformation, True).Shape()


def unified(shape):
    upgrade = ShapeUpgrade_UnifySameDomain(shape, True, True, False)
    upgrade.Build()
    return upgrade.Shape()


def divided(shape):
    """Round faces in pieces of 20° at the most."""
    upgrade = ShapeUpgrade_ShapeDivideAngle(math.radians(20.0), shape)
    upgrade.Perform()
    return upgrade.Result()


def compound(*shapes):
    result, builder = TopoDS_Compound(), BRep_Builder()
    builder.MakeCompound(result)
    for shape in shapes:
        builder.Add(result, shape)
    return result


def cylinder(radius, x, height):
    return BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(x, 3.0, -1.0), gp_Dir(0, 0, 1)), radius, height).Shape()


def extruded(shape, height):
    """The face at z = 0 extruded: walls over splines are surfaces of linear extrusion."""
    faces = TopExp_Explorer(shape, TopAbs_FACE)
    while faces.More():
        face = TopoDS.Face_s(faces.Current())
        surface = BRepAdaptor_Surface(face)
        if surface.GetType() == GeomAbs_Plane:
            plane = surface.Plane()
            if abs(plane.Axis().Direction().Z()) > 0.9 and abs(plane.Location().Z()) < 1e-9:
                return BRepPrimAPI_MakePrism(face, gp_Vec(0, 0, height)).Shape()
        faces.Next()
    raise AssertionError("no face at z = 0")


def cut_and_joined(shape, choose, level):
    """Parted at a plane across or at a level one, and put together again: faces on parts of their surfaces."""
    size, at = 2000.0, choose.uniform(5.0, 25.0) if level else choose.uniform(-120.0, 120.0)
    box = BRepPrimAPI_MakeBox(gp_Pnt(-size, -size, -size), gp_Pnt(size, size, at)).Shape()
    if not level:
        turned = gp_Trsf()
        turned.SetRotation(gp_Ax1(gp_Pnt(0, 0, 0), gp_Dir(1, choose.uniform(-1, 1), 0)), math.radians(90))
        box = BRepBuilderAPI_Transform(box, turned, True).Shape()
    return BRepAlgoAPI_Fuse(BRepAlgoAPI_Cut(shape, box).Shape(), BRepAlgoAPI_Common(shape, box).Shape()).Shape()


def bumped(text, choose, through):
    """A control point within a span of a surface moved outwards: by 50 µm with all above and below it, by 20 µm alone."""
    points = {number: tuple(map(float, triple.split(","))) for number, triple in
              re.findall(r"#(\d+) = CARTESIAN_POINT\('', \(([^)]*)\)\);", text)}
    net = choose.choice(re.findall(r"B_SPLINE_SURFACE_WITH_KNOTS\('', 3, 3, \((.*?)\)\), ", text))
    row = re.findall(r"#(\d+)", net.split("), (")[choose.choice([1, 2])])
    x, y, _ = points[row[0]]
    moved = [n for n, p in points.items() if p[:2] == (x, y)] if through else [choose.choice(row)]
    grown = 1 + (0.05 if through else 0.02) / math.hypot(x, y)
    for number in moved:
        line = re.search(rf"#{number} = CARTESIAN_POINT\('', \([^)]*\)\);", text)[0]
        text = text.replace(line, f"#{number} = CARTESIAN_POINT('', ({x * grown!r}, {y * grown!r}, {points[number][2]!r}));")
    return text


def judge(binary, path, kind, args, expected):
    run = subprocess.run([binary, "check", path, *kind, *args, "-v"], capture_output=True, text=True)
    assert run.returncode == expected, f"{path}: {run.returncode}\n{run.stdout}{run.stderr}"
    return run.stdout


def spline_solids(binary, directory, count):
    """Seeded: discs of splines in as many machines, rewritten in every way, and bumped."""
    choose, done = random.Random(14), 0
    for index in range(count):
        args = ["--rpm", f"{choose.choice([25, 30, 35])}", "--set", f"cam.rotation={choose.choice(['cw', 'ccw'])}",
                "--set", f"follower.roller.offset={choose.choice([0, 5, 12])}mm", "--tolerance", f"{choose.choice([1, 2, 5])}um"]
        stem = f"check-spline-{index}"
        subprocess.run([binary, "rotary", *args, "--outline", "spline", "--force", "--quiet", "--format", "step", "--name", stem,
                        "--out", directory])
        path = directory / f"{stem}.step"
        judge(binary, path, [], args, 0)
        solid = read(path)
        level, across = cut_and_joined(solid, choose, True), cut_and_joined(solid, choose, False)
        prism = extruded(solid, 30.0)
        for name, shape in [("written", solid), ("level", level), ("across", across), ("across-unified", unified(across)),
                            ("prism", prism), ("prism-across", cut_and_joined(prism, choose, False))]:
            other = directory / f"{stem}-{name}.step"
            write(shape, other, pcurves=choose.choice("01"))
            judge(binary, other, [], args, 0)
            done += 1
        # Rational splines that are exact circles, lines, cylinders and planes are read as these.
        for name, shape, code in [("long", extruded(solid, 30.03), 1), ("nurbs", BRepBuilderAPI_NurbsConvert(solid).Shape(), 0)]:
            other = directory / f"{stem}-{name}.step"
            write(shape, other)
            judge(binary, other, [], args, code)
            done += 1
        tight = [*args[:-1], "5um"]
        for through in (True, False):
            other = directory / f"{stem}-bumped-{through}.step"
            other.write_text(bumped(path.read_text(), choose, through))
            told = judge(binary, other, [], tight, 1)
            assert f"FAIL  {'outline' if through else 'walls'}" in told, told
            done += 1
            # The same after OpenCASCADE has read and written it.
            if through:
                again = directory / f"{stem}-bumped-again.step"
                write(read(other), again)
                told = judge(binary, again, [], tight, 1)
                assert "FAIL  outline" in told and "pass  shell" in told, told
                done += 1
    return done


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("binary", type=Path)
    parser.add_argument("directory", type=Path)
    parser.add_argument("--splines", type=int, default=4, help="seeded discs of splines")
    asked = parser.parse_args()
    binary, directory = asked.binary.resolve(), asked.directory
    directory.mkdir(parents=True, exist_ok=True)
    up = gp_Ax1(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1))
    count = 0
    for name, (command, args) in CAMS.items():
        made = [binary, command, *args, "--force", "--quiet", "--format", "step", "--name", f"check-{name}", "--out", directory,
                *(["--outline", "spline"] if name.startswith("splines") else [])]
        # Whether the cam is a good one does not matter here: a solid that keeps to it is asked for.
        assert subprocess.run(made).returncode in (0, 1), made
        solid = read(directory / f"check-{name}.step")
        same = {
            **{f"{schema}-{pcurves}": (solid, {"schema": schema, "pcurves": pcurves})
               for schema in ["AP203", "AP214IS", "AP242DIS"] for pcurves in "01"},
            "unified": (unified(solid), {}),
            "unified-plain": (unified(solid), {"pcurves": "0"}),
            "compound": (compound(solid), {}),
        }
        if command != "conoid":
            same["divided"] = (divided(solid), {})
        if name == "splines":
            same["extruded"] = (extruded(solid, 30.0), {})
        others = {
            "moved-x": (transformed(solid, lambda t: t.SetTranslation(gp_Vec(0.02, 0, 0))), {}),
            "moved-z": (transformed(solid, lambda t: t.SetTranslation(gp_Vec(0, 0, 0.02))), {}),
            "turned": (transformed(solid, lambda t: t.SetRotation(up, math.radians(0.05))), {}),
            "half-turned": (transformed(solid, lambda t: t.SetRotation(gp_Ax1(gp_Pnt(0, 0, 15), gp_Dir(1, 0, 0)), math.pi)), {}),
            "mirrored": (transformed(solid, lambda t: t.SetMirror(gp_Ax2(gp_Pnt(0, 0, 0), gp_Dir(1, 1, 0)))), {}),
            "scaled": (transformed(solid, lambda t: t.SetScale(gp_Pnt(0, 0, 0), 1.0003)), {}),
            "inches": (solid, {"unit": "INCH"}),
            "metres": (solid, {"unit": "M"}),
            "drilled": (BRepAlgoAPI_Cut(solid, cylinder(2.0, 60.0, 200.0)).Shape(), {}),
            "sunk": (BRepAlgoAPI_Cut(solid, cylinder(2.0, 60.0, 5.0)).Shape(), {}),
            "fused": (BRepAlgoAPI_Fuse(solid, cylinder(2.0, 60.0, 200.0)).Shape(), {}),
            "two": (compound(solid, transformed(solid, lambda t: t.SetTranslation(gp_Vec(2000, 0, 0)))), {}),
        }
        if command == "translating":
            # A plate is its own mirror image about X: turned about X it lies as before, but for its height.
            del others["half-turned"]
        kind = [] if command == "rotary" else ["--cam", command]
        for expected, variants in [(0, same), (1, others)]:
            for variant, (shape, options) in variants.items():
                path = directory / f"check-{name}-{variant}.step"
                write(shape, path, **options)
                judge(binary, path, kind, args, expected)
                count += 1
    count += spline_solids(binary, directory, asked.splines)
    print(f"step_check.py: {count} solids written by OpenCASCADE are judged as they should be")


if __name__ == "__main__":
    main()
