"""Lets OpenCASCADE read camgen's solids and write them again, and `camgen check` judge what it wrote.

The same solid in AP203, AP214 and AP242, with and without curves in the parameters of their surfaces, with faces of one surface
merged, and split by a plane: exit 0. Moved by four tolerances, turned, mirrored, scaled, in inches, with a hole more, fused with
another body, two in one file: exit 1.

usage: step_check.py CAMGEN_BINARY DIRECTORY
"""
import math
import subprocess
import sys
from pathlib import Path

from OCP.BRep import BRep_Builder
from OCP.BRepAlgoAPI import BRepAlgoAPI_Cut, BRepAlgoAPI_Fuse
from OCP.BRepBuilderAPI import BRepBuilderAPI_Transform
from OCP.BRepPrimAPI import BRepPrimAPI_MakeCylinder
from OCP.Interface import Interface_Static
from OCP.IFSelect import IFSelect_RetDone
from OCP.ShapeUpgrade import ShapeUpgrade_ShapeDivideAngle, ShapeUpgrade_UnifySameDomain
from OCP.STEPControl import STEPControl_AsIs, STEPControl_Reader, STEPControl_Writer
from OCP.TopoDS import TopoDS_Compound
from OCP.gp import gp_Ax1, gp_Ax2, gp_Dir, gp_Pnt, gp_Trsf, gp_Vec

KEYWAY = ["--set", "cam.keyway.width=8mm", "--set", "cam.keyway.depth=3.3mm", "--set", "cam.keyway.angle=90deg"]
HOLES = ["--set", "cam.lever=0.15", "--set", "cam.base_radius=90mm", "--set", "cam.balance=40mm .. 85mm"]
CAMS = {
    "disc": ("rotary", ["--rpm", "35"]),
    "keyway": ("rotary", ["--rpm", "35", "--set", "cam.rotation=ccw", *KEYWAY]),
    "holes": ("rotary", ["--rpm", "35", *HOLES]),
    "plate": ("translating", ["--rpm", "35"]),
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


def main():
    binary, directory = Path(sys.argv[1]).resolve(), Path(sys.argv[2])
    up = gp_Ax1(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1))
    count = 0
    for name, (command, args) in CAMS.items():
        made = [binary, command, *args, "--force", "--quiet", "--format", "step", "--name", f"check-{name}", "--out", directory]
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
                run = subprocess.run([binary, "check", path, *kind, *args], capture_output=True, text=True)
                assert run.returncode == expected, f"{path}: {run.returncode}\n{run.stdout}{run.stderr}"
                count += 1
    print(f"step_check.py: {count} solids written by OpenCASCADE are judged as they should be")


if __name__ == "__main__":
    main()
