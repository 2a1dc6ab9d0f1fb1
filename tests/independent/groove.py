"""Puts the roller of grooves and rings between the flanks of written DXF files, all round, against motions integrated here, and measures the
solid with OpenCASCADE.

Shares nothing with camgen but the motion programs below: the laws are those of laws.py, integrated twice by Gauss' rule, the roller's centre
comes from the geometry of its mechanism in complex numbers, the flanks are what ezdxf reads on their layers. Each flank must be as far from
the roller's centre as its radius and its share of the clearance say, wherever the roller is; the groove is nowhere narrower than the roller
with its clearance. Faults are planted in the files, and `camgen check` must refuse each by the right check.

usage: groove.py CAMGEN_BINARY DIRECTORY [--count N] [--seed S]
"""
import argparse
import json
import subprocess
import sys
from pathlib import Path

import ezdxf
import numpy as np
from laws import motion
from outline import Chain

LAWS = ["modified-sine", "3-4-5", "4-5-6-7", "cycloidal"]
TOLERANCE = 5e-3
# Rounding of twelve decimals and of the integration above.
ROUNDING = 2e-8


def design(random):
    """A random groove or ring, as a dictionary."""
    swings = random.random() < 0.4
    body = "ring" if random.random() < 0.3 else "groove"
    rise, rest, back = random.uniform(90, 140), random.uniform(0, 40), random.uniform(90, 140)
    stroke = random.uniform(8, 20) if swings else random.uniform(8, 30)
    first, second = random.choice(LAWS), random.choice(LAWS)
    segments = [(first, rise, stroke), ("dwell", rest, stroke), (second, back, 0.0)]
    segments.append(("dwell", 360 - rise - rest - back, 0.0))
    segments = [segment for segment in segments if segment[1] > 0]
    radius = random.uniform(6, 16)
    prime = random.uniform(75, 110) if not swings else random.uniform(85, 110)
    clearance = random.uniform(0.02, 0.2)
    share = random.choice([0.0, 0.5, 1.0, random.random()])
    place = {"offset": random.uniform(-15, 15)} if not swings else {
        "arm": random.uniform(95, 115), "pivot_distance": random.uniform(130, 150), "side": random.choice(["trailing", "leading"])}
    return dict(body=body, swings=swings, segments=segments, radius=radius, prime=prime, clearance=clearance, share=share, place=place,
                ccw=random.random() < 0.3)


def toml(found):
    unit = "deg" if found["swings"] else "mm"
    lines = ['name = "random"', "[motion]", "rpm = 150", f'start = "0 {unit}"']
    for law, over, to in found["segments"]:
        lines += ["[[motion.segment]]", f'law = "{law}"', f'over = "{over!r} deg"']
        lines += [] if law == "dwell" else [f'to = "{to!r} {unit}"']
    lines += ["[follower.swinging-roller]" if found["swings"] else "[follower.roller]", f'radius = "{found["radius"]!r} mm"']
    for key, value in found["place"].items():
        lines.append(f'{key} = "{value}"' if key == "side" else f'{key} = "{value!r} mm"')
    lines += ['inertia = "0.01 kg*m2"' if found["swings"] else 'mass = "2 kg"']
    groove = found["body"] == "groove"
    base = found["prime"] + (-found["radius"] if groove else found["radius"])
    lines += ["[cam]", f'body = "{found["body"]}"', f'base_radius = "{base!r} mm"', 'thickness = "20 mm"']
    if groove:
        lines += [f'clearance = "{found["clearance"]!r} mm"', f'clearance_share = {found["share"]!r}', 'groove_depth = "12 mm"',
                  'bore_radius = "10 mm"']
    lines += [] if not found["ccw"] else ['rotation = "ccw"']
    lines += ["[limits]", 'pressure_angle = "60 deg"', "min_convex_pitch_radius_over_roller = 1.0"]
    return "\n".join(lines) + "\n"


def centres(found, theta):
    """The roller's centre in the drawing at cam angles (rad), complex, mm."""
    degrees = np.degrees(theta)
    position = motion(found["segments"], 0.0, degrees)
    u = np.exp(1j * theta)
    place = found["place"]
    if found["swings"]:
        arm, pivot = place["arm"], place["pivot_distance"]
        # The triangle of shaft, pivot and roller at the lowest lift.
        start = np.arccos((pivot**2 + arm**2 - found["prime"] ** 2) / (2 * pivot * arm))
        side = 1 if place["side"] == "trailing" else -1
        centre = u * (pivot - arm * np.exp(1j * side * (start + np.radians(position))))
    else:
        height = np.sqrt(found["prime"] ** 2 - place["offset"] ** 2)
        centre = u * (height + position + 1j * place["offset"])
    return centre.conj() if found["ccw"] else centre


def flank(document, layer):
    """The one closed outline on a layer."""
    (line,) = [entity for entity in document.modelspace() if entity.dxf.layer == layer]
    assert line.dxftype() == "LWPOLYLINE" and line.closed, line
    return Chain(np.array(line.get_points("xyb"), dtype=float))


def distances(document, layer, points):
    """Distance of points from the outline of a layer, mm."""
    return flank(document, layer).distance(np.stack([points.real, points.imag], axis=1))


def radius_of_circle(document, layer):
    (circle,) = [entity for entity in document.modelspace() if entity.dxf.layer == layer]
    return circle.dxf.radius


def run(binary, folder, text, *rest):
    (folder / "design.toml").write_text(text)
    command = [binary, "make", str(folder / "design.toml"), "--out", str(folder), "--name", "cam", "--json", "--format", "dxf,step", *rest]
    done = subprocess.run(command, capture_output=True, text=True)
    return done, (json.loads(done.stdout) if done.stdout.strip() else None)


def proved(found, folder, theta):
    """Largest errors of the flanks, mm."""
    document = ezdxf.readfile(folder / "cam.dxf")
    points = centres(found, theta)
    inside = found["clearance"] * found["share"]
    if found["body"] == "ring":
        off = distances(document, "CAM_PROFILE", points) - found["radius"]
        assert radius_of_circle(document, "BLANK") > np.abs(points).max() + found["radius"]
        return float(np.abs(off).max())
    inner = distances(document, "GROOVE_INNER", points) - (found["radius"] + inside)
    outer = distances(document, "GROOVE_OUTER", points) - (found["radius"] + found["clearance"] - inside)
    width = (inner + outer).min() + 2 * found["radius"] + found["clearance"]
    assert width >= 2 * found["radius"] + found["clearance"] - 2 * TOLERANCE - ROUNDING, width
    assert abs(radius_of_circle(document, "BORE") - 10) < 1e-9
    return float(max(np.abs(inner).max(), np.abs(outer).max()))


def volume(found, folder):
    """The solid as OpenCASCADE reads it: closed, valid, with the volume of the drawing."""
    from OCP.BRepCheck import BRepCheck_Analyzer
    from OCP.BRepGProp import BRepGProp
    from OCP.GProp import GProp_GProps
    from OCP.STEPControl import STEPControl_Reader

    reader = STEPControl_Reader()
    assert reader.ReadFile(str(folder / "cam.step")) == 1
    reader.TransferRoots()
    shape = reader.OneShape()
    assert BRepCheck_Analyzer(shape).IsValid()
    properties = GProp_GProps()
    BRepGProp.VolumeProperties_s(shape, properties)
    document = ezdxf.readfile(folder / "cam.dxf")
    blank = np.pi * radius_of_circle(document, "BLANK") ** 2
    if found["body"] == "ring":
        expected = 20 * (blank - abs(flank(document, "CAM_PROFILE").area()))
    else:
        groove = abs(flank(document, "GROOVE_OUTER").area()) - abs(flank(document, "GROOVE_INNER").area())
        expected = 20 * (blank - np.pi * 10**2) - 12 * groove
    assert abs(properties.Mass() / expected - 1) < 1e-6, (properties.Mass(), expected)


def faults(binary, found, folder):
    """Files with a planted fault, each refused by its check."""
    planted = []
    for layer in ["GROOVE_INNER", "GROOVE_OUTER"] if found["body"] == "groove" else ["CAM_PROFILE"]:
        planted.append((f"{layer} shifted by 1.3 tolerances", layer, lambda z: z + 1.3 * TOLERANCE, {"rolling", "outline"}))
        planted.append((f"{layer} turned by 0.1 deg", layer, lambda z: z * np.exp(0.1j * np.pi / 180), {"rolling", "outline"}))
    if found["body"] == "groove":
        narrower = 1 - found["clearance"] / (found["prime"] + found["radius"])
        planted.append(("the outer flank without its clearance", "GROOVE_OUTER", lambda z: z * narrower, {"groove_width"}))
    for name, layer, change, checks in planted:
        document = ezdxf.readfile(folder / "cam.dxf")
        (line,) = [entity for entity in document.modelspace() if entity.dxf.layer == layer]
        moved = [(change(complex(x, y)), bulge) for x, y, bulge in line.get_points("xyb")]
        line.set_points([(z.real, z.imag, bulge) for z, bulge in moved], format="xyb")
        document.saveas(folder / "planted.dxf")
        command = [binary, "check", str(folder / "planted.dxf"), "--design", str(folder / "design.toml"), "--json"]
        done = subprocess.run(command, capture_output=True, text=True)
        failed = {check["check"] for check in json.loads(done.stdout)["checks"] if check["verdict"] == "fail"}
        assert done.returncode == 1 and failed & checks, (name, failed, done.stderr)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("binary")
    parser.add_argument("directory", type=Path)
    parser.add_argument("--count", type=int, default=30)
    parser.add_argument("--seed", type=int, default=1)
    asked = parser.parse_args()
    random = __import__("random").Random(asked.seed)
    folder = asked.directory / "groove"
    folder.mkdir(parents=True, exist_ok=True)
    theta = np.linspace(0, 2 * np.pi, 2881)
    worst, made, refused = 0.0, 0, 0
    for index in range(asked.count):
        found = design(random)
        done, report = run(asked.binary, folder, toml(found), "--overwrite", "--tolerance-acceleration", "none")
        if done.returncode != 0:
            failed = {check["check"] for check in report["checks"] if check["verdict"] == "fail"} if report else {done.stderr}
            # A random cam may be too small for its motion, or lack the force of a ring; never may a flank be wrong.
            assert report and not failed & {"rolling", "outline", "groove_width", "bore", "tangency"}, (index, failed, toml(found))
            refused += 1
            if failed - {"force_closure"} or report["checks"] is None:
                continue
            done, report = run(asked.binary, folder, toml(found), "--overwrite", "--force", "--tolerance-acceleration", "none")
            assert done.returncode == 1, done.stderr
        made += 1
        error = proved(found, folder, theta)
        assert error <= TOLERANCE + ROUNDING, (index, error, toml(found))
        worst = max(worst, error)
        volume(found, folder)
        if index % 5 == 0:
            faults(asked.binary, found, folder)
    assert made > asked.count // 2, (made, refused)
    print(f"{made} of {asked.count} grooves and rings: flanks within {1e3 * worst:.4f} um of the roller, solids valid, planted faults refused")


if __name__ == "__main__":
    sys.exit(main())
