"""Rolls the roller of barrel cams past the surfaces of written STEP files as OpenCASCADE has them, and past the unrolled DXF files wound round the
outside again.

Shares nothing with camgen but the motion programs: the laws are those of laws.py, and the roller's centre line at each cam angle comes from the geometry
of the follower. A place of the centre line must be as far from the surfaces of either flank as the roller's radius; a place of the developed view,
wound round the outside, as far from the centre line of the turn. The volume is compared with the sum over cylinders of the area between the flanks, which
come from that distance alone. Programs for four axes are run block by block: the tool as wide as the groove must leave the surfaces within the tolerance, a smaller one
must not cut into them. Files of other cams must be refused: another roller, no clearance, a flank that is moved, the offset of the unrolled centre
line.

usage: barrel.py CAMGEN_BINARY DIRECTORY [--count N] [--seed S]
"""
import argparse
import csv
import json
import re
import subprocess
import sys
from pathlib import Path

import ezdxf
import numpy as np
from form_closed import TOLERANCE, failed, make, program, rise_and_return
from laws import motion

PLACES = 500
ROUNDING = 1e-6  # of OpenCASCADE's search


def design(random):
    swings = random.random() < 0.4
    found = dict(swings=swings, radius=random.uniform(6, 12), ccw=random.random() < 0.4, depth=random.uniform(6, 13), clearance=random.choice([0.0, 0.04]))
    found["share"] = random.choice([0.0, 0.5, 1.0]) if found["clearance"] else 0.0
    stroke = random.uniform(8, 20) if swings else random.uniform(15, 45)
    found["segments"] = rise_and_return(random, stroke)
    if swings:
        arm = random.uniform(90, 140)
        found |= dict(arm=arm, pivot=arm * random.uniform(0.985, 1.0), side=random.choice(["trailing", "leading"]), swing=stroke)
    else:
        found |= dict(offset=random.choice([0.0, 0.0, random.uniform(-5, 5)]))
    found["outer"] = random.uniform(58, 80)
    return found


def toml(found, radius=None, clearance=None):
    mm = lambda value, name: f'{name} = "{value!r} mm"'
    lines = program(found["segments"], "deg" if found["swings"] else "mm")
    if found["swings"]:
        lines += ["[follower.swinging-roller]", mm(found["arm"], "arm"), mm(found["pivot"], "pivot_distance"), f'side = "{found["side"]}"']
    else:
        lines += ["[follower.roller]", mm(found["offset"], "offset")]
    lines += [mm(radius or found["radius"], "radius"), "[cam]", 'body = "barrel"', mm(found["outer"], "outer_radius"), mm(found["depth"], "groove_depth")]
    lines += [mm(found["clearance"] if clearance is None else clearance, "clearance"), f"clearance_share = {found['share']}"]
    lines += ['bore_radius = "12 mm"', 'rotation = "ccw"' if found["ccw"] else 'rotation = "cw"']
    return "\n".join(lines + ["[limits]", 'pressure_angle = "60 deg"', "min_convex_pitch_radius_over_roller = 1.0", ""])


def line(found, theta):
    """Across and along of the roller's centre line at cam angles, mm."""
    position = motion(found["segments"], 0.0, np.degrees(theta))
    if not found["swings"]:
        return np.full_like(theta, found["offset"]), position
    half = np.radians(found["swing"]) / 2
    angle = np.radians(position) - half
    side = 1 if found["side"] == "trailing" else -1
    return side * (found["pivot"] - found["arm"] * np.cos(angle)), found["arm"] * (np.sin(angle) + np.sin(half))


def away(found, points):
    """The least distance of places (seen by a clockwise cam) from the roller's centre line over the turn, mm, and the angle there."""
    polar = np.arctan2(points[:, 1], points[:, 0])
    reach = np.linspace(-0.9, 0.9, 181)

    def square(theta):
        across, along = line(found, theta % (2 * np.pi))
        own = points[:, 1][:, None] * np.cos(theta) - points[:, 0][:, None] * np.sin(theta)
        front = points[:, 0][:, None] * np.cos(theta) + points[:, 1][:, None] * np.sin(theta)
        return np.where(front > 0, (own - across) ** 2 + (points[:, 2][:, None] - along) ** 2, np.inf)

    theta = polar[:, None] + reach
    middle = np.take_along_axis(theta, square(theta).argmin(axis=1)[:, None], axis=1)
    low, high = middle - 0.01, middle + 0.01
    golden = (np.sqrt(5) - 1) / 2
    for _ in range(60):
        a, b = high - golden * (high - low), low + golden * (high - low)
        nearer = square(a) < square(b)
        low, high = np.where(nearer, low, a), np.where(nearer, b, high)
    at = 0.5 * (low + high)
    return np.sqrt(square(at))[:, 0], at[:, 0]


def flanks(path):
    """The spline surfaces of a STEP file, their boxes of places, and volume and validity of its one solid."""
    from OCP.BRep import BRep_Tool
    from OCP.BRepCheck import BRepCheck_Analyzer
    from OCP.BRepGProp import BRepGProp
    from OCP.Geom import Geom_BSplineSurface
    from OCP.GProp import GProp_GProps
    from OCP.STEPControl import STEPControl_Reader
    from OCP.TopAbs import TopAbs_FACE, TopAbs_SOLID
    from OCP.TopExp import TopExp_Explorer
    from OCP.TopoDS import TopoDS

    reader = STEPControl_Reader()
    assert reader.ReadFile(str(path)) == 1, path
    reader.TransferRoots()
    shape = reader.OneShape()
    assert BRepCheck_Analyzer(shape).IsValid(), path
    solids, explorer = 0, TopExp_Explorer(shape, TopAbs_SOLID)
    while explorer.More():
        solids += 1
        explorer.Next()
    assert solids == 1, (path, solids)
    measured = GProp_GProps()
    BRepGProp.VolumeProperties_s(shape, measured, 1e-9)
    surfaces, explorer = [], TopExp_Explorer(shape, TopAbs_FACE)
    while explorer.More():
        surface = BRep_Tool.Surface_s(TopoDS.Face_s(explorer.Current()))
        if isinstance(surface, Geom_BSplineSurface):
            surfaces.append(surface)
        explorer.Next()
    return surfaces, measured.Mass()


def samples(surface, random, count):
    """Places of a surface."""
    u0, u1, v0, v1 = surface.Bounds()
    found = []
    for _ in range(count):
        point = surface.Value(u0 + (u1 - u0) * random.random(), v0 + (v1 - v0) * random.random())
        found.append((point.X(), point.Y(), point.Z()))
    return np.array(found)


def radii(found):
    """Of the flanks above and below the roller."""
    below = found["radius"] + found["clearance"] * found["share"]
    return 2 * found["radius"] + found["clearance"] - below, below


def mirrored(found, points):
    return points * np.array([1.0, -1.0, 1.0]) if found["ccw"] else points


def off_flanks(found, points):
    """How far places of flanks are off, mm: positive where metal is missing; and which of them are above."""
    points = mirrored(found, points)
    distance, theta = away(found, points)
    above = points[:, 2] > line(found, theta % (2 * np.pi))[1]
    return distance - np.where(above, *radii(found)), above


def axis_distances(found, surfaces, random):
    """From places of the centre line to the nearest place of each flank, as OpenCASCADE finds it, less its radius: the largest size."""
    from OCP.GeomAPI import GeomAPI_ProjectPointOnSurf
    from OCP.gp import gp_Pnt

    coarse = [samples(surface, random, 24) for surface in surfaces]
    above = [off_flanks(found, places)[1].mean() > 0.5 for places in coarse]
    worst = 0.0
    for _ in range(PLACES):
        theta, v = 2 * np.pi * random.random(), found["outer"] - found["depth"] * random.uniform(0.05, 0.95)
        across, along = (float(value[0]) for value in line(found, np.array([theta])))
        place = np.array([[v * np.cos(theta) - across * np.sin(theta), v * np.sin(theta) + across * np.cos(theta), along]])
        place = mirrored(found, place)[0]
        for side, radius in zip((True, False), radii(found)):
            of = [index for index, is_above in enumerate(above) if is_above == side]
            near = sorted(of, key=lambda index: np.linalg.norm(coarse[index] - place, axis=1).min())[:3]
            least = np.inf
            for index in near:
                projected = GeomAPI_ProjectPointOnSurf(gp_Pnt(*place), surfaces[index])
                if projected.NbPoints():
                    least = min(least, projected.LowerDistance())
            worst = max(worst, abs(least - radius))
    return worst


def developed(path, layer):
    """Places of the arcs and lines of a layer."""
    found = []
    for entity in ezdxf.readfile(path).modelspace():
        if entity.dxf.layer != layer:
            continue
        share = np.linspace(0, 1, 9)
        if entity.dxftype() == "LINE":
            a, b = np.array(entity.dxf.start.xyz[:2]), np.array(entity.dxf.end.xyz[:2])
            found.append(a + share[:, None] * (b - a))
        else:
            start, end = np.radians([entity.dxf.start_angle, entity.dxf.end_angle])
            angle = start + share * ((end - start) % (2 * np.pi))
            centre = np.array(entity.dxf.center.xyz[:2])
            found.append(centre + entity.dxf.radius * np.stack([np.cos(angle), np.sin(angle)], axis=1))
    return np.concatenate(found)


def wound(found, places):
    angle = places[:, 0] / found["outer"]
    return np.stack([found["outer"] * np.cos(angle), found["outer"] * np.sin(angle), places[:, 1]], axis=1)


def volume(found, length):
    """Of the cylinder less its groove and bore, mm³: on each cylinder the area of what is nearer to the centre line than the radius of a flank."""
    nodes, weights = np.polynomial.legendre.leggauss(4)
    floor = found["outer"] - found["depth"]
    groove = 0.0
    theta = np.linspace(0, 2 * np.pi, 20001)[:-1]
    for node, weight in zip(nodes, weights):
        radius = floor + found["depth"] * (node + 1) / 2
        edges = []
        for sign, distance in zip((1, -1), radii(found)):
            # The envelope on this cylinder: places at the distance from the line, and nearest to it at this angle.
            across, along = line(found, theta)
            step = 1e-5
            (a1, l1), (a0, l0) = line(found, (theta + step) % (2 * np.pi)), line(found, (theta - step) % (2 * np.pi))
            run, rise = (a1 - a0) / (2 * step), (l1 - l0) / (2 * step)
            v = np.full_like(theta, radius)
            for _ in range(40):
                size = np.hypot(v + run, rise)
                y = across - sign * distance * rise / size
                v = np.sqrt(radius**2 - y**2)
            z = along + sign * distance * (v + run) / np.hypot(v + run, rise)
            phi = theta + np.arctan2(y, v)
            edges.append(np.sum(0.5 * (z + np.roll(z, -1)) * (np.roll(phi, -1) - phi + np.where(np.arange(len(phi)) == len(phi) - 1, 2 * np.pi, 0))))
        groove += weight / 2 * found["depth"] * radius * (edges[0] - edges[1])
    return np.pi * (found["outer"] ** 2 - 12.0**2) * length - groove


def four_axes(found, binary, folder, surfaces, random):
    """A smaller tool along both flanks must not cut into them, and leave what the table says at most."""
    tool = 0.6 * found["radius"]
    done = make(binary, folder, toml(found), "csv", "--cutter-diameter", f"{2 * tool!r}mm")
    assert done.returncode == 0, done.stderr
    rows = list(csv.DictReader((folder / "cam-four-axes.csv").open()))
    assert {row["pass"] for row in rows} == {"1", "2"}
    sense = -1 if found["ccw"] else 1
    points = np.concatenate([samples(surface, random, 6) for surface in surfaces])
    off, above = off_flanks(found, points)
    points = mirrored(found, points)
    cut = []
    for number, mask in (("1", above), ("2", ~above)):
        own = [row for row in rows if row["pass"] == number]
        theta = np.radians([sense * float(row["a_deg"]) for row in own])
        y, z = (np.array([float(row[name]) for row in own]) for name in ("y_mm", "z_mm"))
        here = points[mask]
        across = here[:, 1][:, None] * np.cos(theta) - here[:, 0][:, None] * np.sin(theta) - sense * y
        front = here[:, 0][:, None] * np.cos(theta) + here[:, 1][:, None] * np.sin(theta)
        distance = np.where(front > 0, np.hypot(across, here[:, 2][:, None] - z), np.inf).min(axis=1) - tool
        cut.append((distance.min(), distance.max()))
    least, most = min(low for low, _ in cut), max(high for _, high in cut)
    told = max(float(row["missed_mm"]) for row in rows)
    # Half a degree between two rows leaves scallops.
    assert least > -TOLERANCE and most < told + 0.02, (least, most, told)
    return most


def moves(path):
    """Angle of A, X and Y, degrees and mm, along the straight moves of a program below the outside."""
    words, at, found = re.compile(r"([A-Z])(-?[0-9.]+)"), {"A": None, "X": None, "Y": None, "Z": None}, []
    for block in re.sub(r"\([^)]*\)", "", path.read_text()).splitlines():
        new = {letter: float(number) for letter, number in words.findall(block) if letter in at}
        before, at = at, at | new
        if "A" in new and at["Z"] < 0:
            count = max(2, int(abs(at["A"] - before["A"]) / 0.02))
            share = np.linspace(0, 1, count)[:, None]
            start, end = (np.array([place[axis] for axis in "AXY"]) for place in (before, at))
            found.append(start + share * (end - start))
    return np.concatenate(found)


def programmed(found, binary, folder, surfaces, random):
    """What the tool of a program leaves of the surfaces, mm: as wide as the groove, then smaller."""
    points = np.concatenate([samples(surface, random, 6) for surface in surfaces])
    left = []
    for tool in (None, 0.7 * found["radius"]):
        asked = [] if tool is None else ["--cutter-diameter", f"{2 * tool!r}mm"]
        done = make(binary, folder, toml(found), "gcode", *asked)
        assert done.returncode == 0, done.stderr
        places = moves(folder / "cam.ngc")
        # A counts as if the tool went about the cam by the right hand; Y is against the angle of the drawing.
        angle, x, y = np.radians(places[:, 0]), places[:, 1], places[:, 2]
        across = points[:, 1][:, None] * np.cos(angle) - points[:, 0][:, None] * np.sin(angle) + y
        front = points[:, 0][:, None] * np.cos(angle) + points[:, 1][:, None] * np.sin(angle)
        distance = np.where(front > 0, np.hypot(across, points[:, 2][:, None] - x), np.inf).min(axis=1)
        left.append(distance - (tool or sum(radii(found)) / 2))
    assert np.abs(left[0]).max() < 1.1 * TOLERANCE, np.abs(left[0]).max()
    assert left[1].min() > -1.1 * TOLERANCE, left[1].min()
    return np.abs(left[0]).max()


def refused(binary, path, *design):
    done = subprocess.run([binary, "check", str(path), "--json", *design], capture_output=True, text=True)
    assert done.returncode == 1, (path, done.returncode, done.stderr)
    return failed(done)


def faults(binary, folder, found):
    """Files of other cams, each with the checks that must refuse it."""
    original = toml(found)
    asked = ["--design", str(folder / "right.toml")]
    (folder / "right.toml").write_text(original)
    others = [("another roller", toml(found, radius=found["radius"] + 1.3 * TOLERANCE))]
    others += [("no clearance", toml(found, clearance=0.0))] if found["clearance"] else []
    for name, text in others:
        done = make(binary, folder, text)
        assert done.returncode == 0, (name, done.stderr)
        for file, check in (("cam.step", "flank_surface"), ("cam-unrolled.dxf", "unrolled")):
            assert check in refused(binary, folder / file, *asked), (name, file)
    assert make(binary, folder, original).returncode == 0
    document = ezdxf.readfile(folder / "cam-unrolled.dxf")
    for entity in document.modelspace():
        if entity.dxf.layer == "FLANK_UPPER":
            entity.translate(0, 1.3 * TOLERANCE, 0)
    document.saveas(folder / "moved.dxf")
    assert "unrolled" in refused(binary, folder / "moved.dxf", *asked)
    text = (folder / "cam.step").read_text()
    (folder / "cut.step").write_text(text.replace("ADVANCED_FACE('', (#", "ADVANCED_FACE('', (#", 1).replace(".MILLI.", ".CENTI.", 1))
    assert refused(binary, folder / "cut.step", *asked)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("binary")
    parser.add_argument("directory", type=Path)
    parser.add_argument("--count", type=int, default=30)
    parser.add_argument("--seed", type=int, default=1)
    asked = parser.parse_args()
    random = __import__("random").Random(asked.seed)
    folder = asked.directory / "barrel"
    folder.mkdir(parents=True, exist_ok=True)
    made, worst, axis, rolled, share, left, cut = 0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for index in range(asked.count):
        found = design(random)
        done = make(asked.binary, folder, toml(found))
        if done.returncode != 0:
            broken = failed(done)
            files = {"unrolled", "flank_surface", "solid_shell", "solid_volume", "groove_width"}
            assert not broken & files and (broken or done.returncode == 2), (index, broken, done.stderr, toml(found))
            continue
        made += 1
        report = json.loads(done.stdout)
        surfaces, mass = flanks(folder / "cam.step")
        off, _ = off_flanks(found, np.concatenate([samples(surface, random, 40) for surface in surfaces]))
        worst = max(worst, np.abs(off).max())
        assert worst <= TOLERANCE, (index, worst, toml(found))
        axis = max(axis, axis_distances(found, surfaces, random))
        assert axis <= TOLERANCE + ROUNDING, (index, axis, toml(found))
        for layer, distance in zip(("FLANK_UPPER", "FLANK_LOWER"), radii(found)):
            places = mirrored(found, wound(found, developed(folder / "cam-unrolled.dxf", layer)))
            rolled = max(rolled, np.abs(away(found, places)[0] - distance).max())
        assert rolled <= TOLERANCE + ROUNDING, (index, rolled, toml(found))
        expected = volume(found, report["barrel"]["blank_length_mm"])
        share = max(share, abs(mass / expected - 1))
        assert share < 1e-6, (index, mass, expected, toml(found))
        if index % 5 == 0:
            left = max(left, four_axes(found, asked.binary, folder, surfaces, random))
            cut = max(cut, programmed(found, asked.binary, folder, surfaces, random))
            faults(asked.binary, folder, found)
    assert made > asked.count // 2, made
    print(
        f"{made} of {asked.count} barrels: surfaces within {1e3 * worst:.4f} um of the rolled roller, centre lines within {1e3 * axis:.4f} um, developed "
        f"views within {1e3 * rolled:.4f} um, volumes within {share:.1e}, a smaller tool leaves {1e3 * left:.2f} um at most, "
        f"programs cut within {1e3 * cut:.2f} um, other cams refused"
    )


if __name__ == "__main__":
    sys.exit(main())
