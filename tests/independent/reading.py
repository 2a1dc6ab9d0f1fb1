"""Compares what `camgen check` reads of a DXF file with what ezdxf makes of the same file.

Cams are put into blocks that are turned, mirrored, scaled alike and not alike and nested, and written as splines. ezdxf takes
the blocks apart and flattens what is in them to chords within 1e-4 mm; camgen must find the same largest gap of its roller and the
same distance of the bore, right or wrong as they are, in the file as it was and in the chords.

usage: reading.py CAMGEN_BINARY DIRECTORY
"""
import json
import random
import re
import subprocess
import sys
from pathlib import Path

import ezdxf
from ezdxf import disassemble
from ezdxf.math import fit_points_to_cad_cv, rational_bspline_from_arc
from outline import polyline

# Chords lie that near to the curves, mm.
SAGITTA = 1e-4
# Two chords, two roundings of coordinates, and the search of the worst place, which ends within its own thousandth.
SAME = 2.5e-4


def check(binary, path):
    run = subprocess.run(
        [binary, "check", str(path), "dpi", "--json", "--tolerance", "5um"], capture_output=True, text=True, check=False
    )
    assert run.returncode in (0, 1), run.stderr
    return run.returncode, json.loads(run.stdout)


def finding(report, name):
    return next(c for c in report["checks"] if c["check"] == name)


def new():
    document = ezdxf.new("R2010", setup=False)
    document.header["$INSUNITS"] = 4
    return document


def flat(document):
    """The same drawing as closed chains of chords, entity by entity joined by ezdxf's own points."""
    flattened = new()
    space = flattened.modelspace()
    for entity in disassemble.recursive_decompose(document.modelspace()):
        kind, layer = entity.dxftype(), entity.dxf.layer
        if kind in ("LWPOLYLINE", "POLYLINE"):
            parts = list(entity.virtual_entities())
        else:
            parts = [entity]
        for part in parts:
            if part.dxftype() == "LINE":
                points = [part.dxf.start, part.dxf.end]
            elif part.dxftype() in ("ARC", "CIRCLE"):
                points = list(part.flattening(SAGITTA))
            else:
                points = list(part.flattening(SAGITTA, 64))
            assert all(abs(p.z) < 1e-9 for p in points), "in the plane"
            # Ends differ by rounding; chords shorter than that are none.
            kept = [points[0]]
            for point in points[1:]:
                if point.distance(kept[-1]) > 1e-5:
                    kept.append(point)
            for a, b in zip(kept, kept[1:]):
                space.add_line(a, b, dxfattribs={"layer": layer})
    return flattened


def blocks(rng, vertices):
    """The cam, some tenths of a millimetre off, in blocks of every sort."""
    for case in range(6):
        document = new()
        inner = document.blocks.new("INNER", base_point=(rng.uniform(-9, 9), rng.uniform(-9, 9)))
        inner.add_lwpolyline(vertices, format="xyb", close=True, dxfattribs={"layer": "CAM_PROFILE"})
        hole = document.blocks.new("HOLE")
        hole.add_circle((0, 0), 25, dxfattribs={"layer": "BORE"})
        base = inner.block.dxf.base_point
        middle = document.blocks.new("MIDDLE")
        turn, scale = rng.uniform(0, 360), rng.uniform(0.5, 2)
        oblong = rng.uniform(0.5, 2) if case % 2 else scale
        upside = rng.choice([1, -1])
        middle.add_blockref(
            "INNER", base, {"layer": "0", "xscale": scale, "yscale": oblong * upside, "zscale": scale}
        )
        space = document.modelspace()
        mirrored = -1 if case in (3, 4) else 1
        off = (rng.uniform(-0.3, 0.3), rng.uniform(-0.3, 0.3))
        # Almost back to where it was, by a place of its own; what base point and scale move is undone by ezdxf's own matrix.
        insert = space.add_blockref(
            "MIDDLE",
            (0, 0),
            {
                "layer": "CAM_PROFILE",
                "xscale": 1 / scale,
                "yscale": upside / oblong * rng.uniform(0.999, 1.001),
                "zscale": 1,
                "rotation": turn if case == 5 else 0.0,
                "extrusion": (0, 0, mirrored),
            },
        )
        origin = insert.matrix44().transform(base)
        there = (off[0] - origin.x) * mirrored, off[1] - origin.y
        insert.dxf.insert = (*there, 0)
        space.add_blockref(
            "HOLE", (rng.uniform(-3, 3), 1), {"layer": "BORE", "xscale": 1.02, "yscale": rng.choice([1.02, 0.97]), "rotation": turn}
        )
        yield f"block-{case}", document


def splines(table):
    points = [tuple(row) for row in table]
    closed = [*points, points[0]]
    spline = fit_points_to_cad_cv(closed)
    for name in ("fit", "controls", "tangents"):
        document = new()
        space = document.modelspace()
        if name == "controls":
            entity = space.add_spline(dxfattribs={"layer": "CAM_PROFILE"})
            entity.apply_construction_tool(spline)
        else:
            entity = space.add_spline(closed, dxfattribs={"layer": "CAM_PROFILE"})
        if name == "tangents":
            entity.dxf.start_tangent = (0.1, 1, 0)
            entity.dxf.end_tangent = (0, 2, 0)
        # A rational curve of its own for the bore: an arc by ezdxf's NURBS.
        space.add_spline(dxfattribs={"layer": "BORE"}).apply_construction_tool(
            rational_bspline_from_arc((0.5, 0), 25.0, 0, 360)
        )
        yield f"spline-{name}", document


def arrays(binary, directory, vertices):
    """Each hole of an array lies where ezdxf puts it."""
    document = new()
    space = document.modelspace()
    space.add_lwpolyline(vertices, format="xyb", close=True, dxfattribs={"layer": "CAM_PROFILE"})
    space.add_circle((0, 0), 25, dxfattribs={"layer": "BORE"})
    document.blocks.new("HOLE").add_circle((1, 2), 3)
    insert = space.add_blockref(
        "HOLE",
        (40, 30),
        {
            "rotation": 33, "xscale": -1, "yscale": 1.5, "layer": "HOLES",
            "row_count": 2, "column_count": 2, "row_spacing": 14, "column_spacing": -17,
        },
    )
    expected = sorted(tuple(i.matrix44().transform((1, 2, 0)))[:2] for i in insert.multi_insert())
    path = directory / "reading-array.dxf"
    document.saveas(path)
    code, report = check(binary, path)
    note = finding(report, "bore")["note"]
    found = sorted((float(x), float(y)) for x, y in re.findall(r"ELLIPSE|at \((-?[\d.]+), (-?[\d.]+)\) mm", note) if x)
    assert code == 1 and len(found) == len(expected) == 4, note
    for a, b in zip(found, expected):
        assert abs(a[0] - b[0]) < 1e-3 and abs(a[1] - b[1]) < 1e-3, (found, expected)


def main():
    binary, directory = str(Path(sys.argv[1]).resolve()), Path(sys.argv[2])
    subprocess.run(
        [binary, "rotary", "--quiet", "--name", "reading", "--out", str(directory), "--format", "dxf,csv"], check=True
    )
    _, chain = polyline(directory / "reading.dxf")
    vertices = [tuple(row) for row in chain]
    lines = (directory / "reading.csv").read_text().splitlines()
    x, y = (lines[0].split(",").index(name) for name in ("profile_x_mm", "profile_y_mm"))
    table = [(float(row[x]), float(row[y])) for row in (line.split(",") for line in lines[1:])]
    worst, compared = 0.0, 0
    for name, document in [*blocks(random.Random(13), vertices), *splines(table)]:
        path, flattened = directory / f"reading-{name}.dxf", directory / f"reading-{name}-flat.dxf"
        document.saveas(path)
        flat(document).saveas(flattened)
        (_, ours), (_, theirs) = check(binary, path), check(binary, flattened)
        for of in ("layer", "readable", "duplicates", "contours", "closed"):
            assert finding(ours, of)["verdict"] in ("pass", "info"), (name, finding(ours, of))
            assert finding(theirs, of)["verdict"] in ("pass", "info"), (name, "flat", finding(theirs, of))
        values = [(r["rolling"]["gap_mm"], finding(r, "bore")["value"]) for r in (ours, theirs)]
        for mine, other in zip(*values):
            assert mine is not None and other is not None, (name, values)
            assert abs(mine - other) <= SAME, (name, values)
            worst, compared = max(worst, abs(mine - other)), compared + 1
    arrays(binary, directory, vertices)
    print(f"reading: {compared} distances as ezdxf flattens them, {worst:.1e} mm apart at most")


if __name__ == "__main__":
    main()
