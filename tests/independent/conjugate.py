"""Puts both rollers of one rigid follower on the two written DXF files of conjugate discs, all round, and reads the pair as OpenCASCADE does.

Shares nothing with camgen but the motion programs below: the laws are those of laws.py, the centres of both rollers come from one follower in
complex numbers: a rod with two rollers at a distance, or two arms about one pivot. Each roller must be as far from its disc as its radius; and the
lifts that the two files really give, found by moving each roller until it touches, add up to the largest lift.

usage: conjugate.py CAMGEN_BINARY DIRECTORY [--count N] [--seed S]
"""
import argparse
import json
import subprocess
import sys
from pathlib import Path

import numpy as np
from laws import motion
from outline import Chain, polyline

LAWS = ["modified-sine", "3-4-5", "4-5-6-7", "cycloidal"]
TOLERANCE = 5e-3
ROUNDING = 2e-8


def design(random):
    swings = random.random() < 0.5
    rise, rest, back = random.uniform(90, 140), random.uniform(5, 40), random.uniform(90, 140)
    stroke = random.uniform(6, 18) if swings else random.uniform(8, 28)
    segments = [(random.choice(LAWS), rise, stroke), ("dwell", rest, stroke), (random.choice(LAWS), back, 0.0)]
    segments.append(("dwell", 360 - rise - rest - back, 0.0))
    found = dict(swings=swings, segments=segments, stroke=stroke, ccw=random.random() < 0.3, radius=random.uniform(8, 16))
    found["other"] = random.uniform(8, 16)
    if swings:
        found |= dict(prime=random.uniform(85, 105), arm=random.uniform(95, 115), pivot=random.uniform(130, 150))
        found |= dict(side=random.choice(["trailing", "leading"]), other_arm=random.uniform(95, 115))
        start = np.arccos((found["pivot"] ** 2 + found["arm"] ** 2 - found["prime"] ** 2) / (2 * found["pivot"] * found["arm"]))
        found["included"] = 2 * start + np.radians(stroke) + np.radians(random.uniform(-2, 4))
    else:
        found |= dict(prime=random.uniform(75, 110), offset=random.uniform(-15, 15))
        height = np.sqrt(found["prime"] ** 2 - found["offset"] ** 2)
        found["distance"] = 2 * height + stroke + random.uniform(-10, 20)
    return found


def toml(found):
    unit = "deg" if found["swings"] else "mm"
    lines = ['name = "random"', "[motion]", "rpm = 150", f'start = "0 {unit}"']
    for law, over, to in found["segments"]:
        lines += ["[[motion.segment]]", f'law = "{law}"', f'over = "{over!r} deg"']
        lines += [] if law == "dwell" else [f'to = "{to!r} {unit}"']
    mm = lambda key, name: f'{name} = "{found[key]!r} mm"'
    if found["swings"]:
        lines += ["[follower.swinging-roller]", mm("arm", "arm"), mm("pivot", "pivot_distance"), f'side = "{found["side"]}"', 'inertia = "0.01 kg*m2"']
    else:
        lines += ["[follower.roller]", mm("offset", "offset"), 'mass = "2 kg"']
    lines += [mm("radius", "radius"), "[cam]", 'body = "conjugate"', f'base_radius = "{found["prime"] - found["radius"]!r} mm"']
    lines += ['thickness = "10 mm"', 'bore_radius = "12 mm"', 'keyway = "auto"', 'rotation = "ccw"' if found["ccw"] else 'rotation = "cw"']
    lines += ["[cam.counter]", mm("other", "radius")]
    if found["swings"]:
        lines += [mm("other_arm", "arm"), f'included_angle = "{float(found["included"])!r} rad"']
    else:
        lines += [f'distance = "{float(found["distance"])!r} mm"']
    return "\n".join(lines + ["[limits]", 'pressure_angle = "60 deg"', "min_convex_pitch_radius_over_roller = 1.0", ""])


def centres(found, theta, moved=0.0):
    """Both centres in the drawing with the follower `moved` (mm or rad) from its place by the motion, complex, mm."""
    position = motion(found["segments"], 0.0, np.degrees(theta))
    u = np.exp(1j * theta)
    if found["swings"]:
        pivot, arm = found["pivot"], found["arm"]
        start = np.arccos((pivot**2 + arm**2 - found["prime"] ** 2) / (2 * pivot * arm))
        side = 1 if found["side"] == "trailing" else -1
        # Both arms are one body: the second is turned by the included angle towards the other side.
        angle = side * (start + np.radians(position) + moved)
        both = [u * (pivot - arm * np.exp(1j * angle)), u * (pivot - found["other_arm"] * np.exp(1j * (angle - side * found["included"])))]
    else:
        height = np.sqrt(found["prime"] ** 2 - found["offset"] ** 2) + position + moved
        both = [u * (height + 1j * found["offset"]), u * (height - found["distance"] + 1j * found["offset"])]
    return [centre.conj() if found["ccw"] else centre for centre in both]


def gaps(chains, found, theta, moved=0.0):
    points = centres(found, theta, moved)
    radii = [found["radius"], found["other"]]
    return [chain.distance(np.stack([point.real, point.imag], axis=1)) - radius for chain, point, radius in zip(chains, points, radii)]


def closure(chains, found, theta):
    """Sum of both lifts less the largest, as a travel of the first roller, mm: by moving the follower until each roller touches."""
    travels = []
    for which in range(2):
        moved = np.zeros_like(theta)
        for _ in range(8):
            gap = gaps(chains, found, theta, moved)[which]
            step = 1e-6
            slope = (gaps(chains, found, theta, moved + step)[which] - gap) / step
            moved = moved - gap / slope
        travels.append(moved)
    leverage = found["arm"] if found["swings"] else 1.0
    # The lift of the counter roller grows as the follower goes down.
    return leverage * (travels[0] - travels[1])


def faults(binary, found, folder):
    import ezdxf

    for name, change in [("shifted by 1.3 tolerances", lambda z: z + 1.3 * TOLERANCE), ("turned by 0.1 deg", lambda z: z * np.exp(0.1j * np.pi / 180))]:
        for file in ["main", "counter"]:
            document = ezdxf.readfile(folder / f"cam-{file}.dxf")
            (line,) = [entity for entity in document.modelspace() if entity.dxf.layer == "CAM_PROFILE"]
            moved = [(change(complex(x, y)), bulge) for x, y, bulge in line.get_points("xyb")]
            line.set_points([(z.real, z.imag, bulge) for z, bulge in moved], format="xyb")
            document.saveas(folder / f"cam-{file}-planted.dxf")
            command = [binary, "check", str(folder / f"cam-{file}-planted.dxf"), "--json"]
            done = subprocess.run(command, capture_output=True, text=True)
            assert done.stdout, (file, name, done.stderr)
            failed = {check["check"] for check in json.loads(done.stdout)["checks"] if check["verdict"] == "fail"}
            assert done.returncode == 1 and failed & {"rolling", "outline"}, (file, name, failed)


def solids(folder):
    from OCP.BRepCheck import BRepCheck_Analyzer
    from OCP.BRepGProp import BRepGProp
    from OCP.GProp import GProp_GProps
    from OCP.STEPControl import STEPControl_Reader
    from OCP.TopAbs import TopAbs_SOLID
    from OCP.TopExp import TopExp_Explorer

    def volumes(name):
        reader = STEPControl_Reader()
        assert reader.ReadFile(str(folder / name)) == 1, name
        reader.TransferRoots()
        shape = reader.OneShape()
        assert BRepCheck_Analyzer(shape).IsValid(), name
        explorer, found = TopExp_Explorer(shape, TopAbs_SOLID), []
        while explorer.More():
            properties = GProp_GProps()
            BRepGProp.VolumeProperties_s(explorer.Current(), properties)
            found.append(properties.Mass())
            explorer.Next()
        return found

    alone = volumes("cam-main.step") + volumes("cam-counter.step")
    pair = volumes("cam-pair.step")
    assert len(pair) == 2 and np.allclose(alone, pair, rtol=1e-9), (alone, pair)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("binary")
    parser.add_argument("directory", type=Path)
    parser.add_argument("--count", type=int, default=30)
    parser.add_argument("--seed", type=int, default=1)
    asked = parser.parse_args()
    random = __import__("random").Random(asked.seed)
    folder = asked.directory / "conjugate"
    folder.mkdir(parents=True, exist_ok=True)
    theta = np.linspace(0, 2 * np.pi, 1441)
    worst, open_by, made = 0.0, 0.0, 0
    for index in range(asked.count):
        found = design(random)
        (folder / "design.toml").write_text(toml(found))
        command = [asked.binary, "make", str(folder / "design.toml"), "--out", str(folder), "--name", "cam", "--json", "--format", "dxf,step"]
        done = subprocess.run(command + ["--overwrite", "--tolerance-acceleration", "none"], capture_output=True, text=True)
        if done.returncode != 0:
            failed = {check["check"] for check in json.loads(done.stdout)["checks"] if check["verdict"] == "fail"} if done.stdout else set()
            assert not failed & {"rolling", "outline", "closure", "bore", "tangency"}, (index, failed, toml(found))
            continue
        made += 1
        chains = [Chain(polyline(folder / f"cam-{file}.dxf")[1]) for file in ["main", "counter"]]
        error = max(np.abs(gap).max() for gap in gaps(chains, found, theta))
        assert error <= TOLERANCE + ROUNDING, (index, error, toml(found))
        total = closure(chains, found, theta)
        told = json.loads(done.stdout)["conjugate"]["closure"]
        assert told["play_mm"] - 1e-5 <= total.min() and total.max() <= told["pinch_mm"] + 1e-5, (index, told, total.min(), total.max())
        assert abs(total.max() - told["pinch_mm"]) < 2e-4 and abs(total.min() - told["play_mm"]) < 2e-4, (index, told, total.min(), total.max())
        worst, open_by = max(worst, error), max(open_by, np.abs(total).max())
        solids(folder)
        if index % 5 == 0:
            faults(asked.binary, found, folder)
    assert made > asked.count // 2, made
    print(f"{made} of {asked.count} pairs: rollers within {1e3 * worst:.4f} um of their discs, closed within {1e3 * open_by:.4f} um, planted faults refused")


if __name__ == "__main__":
    sys.exit(main())
