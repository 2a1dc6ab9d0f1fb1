"""Puts both rollers of one rigid follower on the two written DXF files of conjugate discs, all round, and reads the pair as OpenCASCADE does.

Shares nothing with camgen but the motion programs below: the laws are those of laws.py, the centres of both rollers come from one follower in
complex numbers: a rod with two rollers at a distance, or two arms about one pivot. Each roller must be as far from its disc as its radius; and the
lifts that the two files really give, found by moving each roller until it touches, add up to the largest lift.

usage: conjugate.py CAMGEN_BINARY DIRECTORY [--count N] [--seed S]
"""
import argparse
import json
import sys
from pathlib import Path

import numpy as np
from form_closed import FAULTS, ROUNDING, TOLERANCE, failed, make, plant, program, rise_and_return, volumes
from laws import motion
from outline import Chain, polyline


def design(random):
    swings = random.random() < 0.5
    stroke = random.uniform(6, 18) if swings else random.uniform(8, 28)
    segments = rise_and_return(random, stroke)
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
    lines = program(found["segments"], unit)
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


def faults(binary, folder):
    for name, change in FAULTS:
        for file in ["cam-main.dxf", "cam-counter.dxf"]:
            refused = plant(binary, folder, file, "CAM_PROFILE", change)
            assert refused & {"rolling", "outline"}, (file, name, refused)


def solids(folder):
    alone = volumes(folder / "cam-main.step") + volumes(folder / "cam-counter.step")
    pair = volumes(folder / "cam-pair.step")
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
    theta = np.linspace(0, 2 * np.pi, 1440, endpoint=False)
    worst, open_by, made = 0.0, 0.0, 0
    for index in range(asked.count):
        found = design(random)
        done = make(asked.binary, folder, toml(found))
        if done.returncode != 0:
            broken = failed(done)
            assert not broken & {"rolling", "outline", "closure", "bore", "tangency"}, (index, broken, toml(found))
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
            faults(asked.binary, folder)
    assert made > asked.count // 2, made
    print(f"{made} of {asked.count} pairs: rollers within {1e3 * worst:.4f} um of their discs, closed within {1e3 * open_by:.4f} um, planted faults refused")


if __name__ == "__main__":
    sys.exit(main())
