"""Rolls the follower of random plates on the written flank, out and back, against motions integrated here, and measures the solid with
OpenCASCADE.

Shares nothing with camgen but the motion programs: the laws are those of laws.py over the travel of the plate, and the centre of the roller is
found in complex numbers in the frame of the plate: after a travel x it is x along the plate and s along its own inclined path from where it began.
The roller must be as far from the outline as its radius at every place of run-in and stroke, on no side nearer, and the lift that the flank really
gives, found by moving the roller along its path until it touches, must be that of the motion. The ends, the back and the size are those that the
report names. The steepest place of the flank gives the pressure angle. Faults are planted in the files, and `camgen check` must refuse each.

usage: wedge.py CAMGEN_BINARY DIRECTORY [--count N] [--seed S]
"""
import argparse
import json
import sys
from pathlib import Path

import numpy as np
from form_closed import LAWS, ROUNDING, TOLERANCE, failed, make, plant, volumes
from laws import motion
from outline import Chain, polyline

THICKNESS = 16.0
# A flank that only the back and the ends hold in place.
DOWN = -1.3j * TOLERANCE


def design(random):
    first, second = random.uniform(8, 30), random.uniform(-8, 18)
    lengths = [random.uniform(1.9, 4) * first, random.uniform(5, 25), random.uniform(1.9, 4) * abs(second) + 5]
    segments = [(random.choice(LAWS), lengths[0], first), ("dwell", lengths[1], first), (random.choice(LAWS), lengths[2], first + second)]
    if random.random() < 0.3:
        segments = segments[:1]
    return dict(
        segments=segments,
        start=random.choice([0.0, random.uniform(-5, 5)]),
        radius=random.uniform(5, 15),
        drive=random.choice([0.0, random.uniform(-15, 20)]),
        run_in=random.choice([None, random.uniform(10, 40)]),
        given=random.random() < 0.4,
        spare=random.uniform(5, 30),
    )


def stroke(found):
    return sum(over for _, over, _ in found["segments"])


def toml(found, length=None, height=None):
    start = found["start"]
    lines = ['name = "random"', "[motion]", f'stroke = "{stroke(found)!r} mm"', f'start = "{start!r} mm"']
    for index, (law, over, to) in enumerate(found["segments"]):
        last = index + 1 == len(found["segments"])
        lines += ["[[motion.segment]]", f'law = "{law}"'] + ([] if last else [f'over = "{over!r} mm"'])
        lines += [] if law == "dwell" else [f'to = "{start + to!r} mm"']
    lines += ["[follower.roller]", f'radius = "{found["radius"]!r} mm"', 'preload = "200 N"']
    lines += ["[cam]", 'body = "wedge"', f'drive_angle = "{found["drive"]!r} deg"', f'thickness = "{THICKNESS} mm"', 'material = "steel"']
    lines += [f'run_in = "{found["run_in"]!r} mm"'] if found["run_in"] else []
    lines += [f'length = "{length!r} mm"', f'height = "{height!r} mm"'] if length else []
    return "\n".join(lines + ["[limits]", 'pressure_angle = "60 deg"', "min_convex_pitch_radius_over_roller = 1.0", ""])


def lift(found, x):
    """Lift above the lowest position, mm, on run-in and stroke."""
    segments, inside = found["segments"], np.clip(x, 0, stroke(found))
    every = np.linspace(0, stroke(found), 4001)
    return motion(segments, 0.0, inside) - motion(segments, 0.0, every).min()


def centres(found, x, moved=0.0):
    """The roller's centre in the frame of the plate, complex, mm."""
    way = np.exp(1j * np.radians(found["drive"] - 90))
    return x + (lift(found, x) + moved) * way


def gaps(chain, found, x, moved=0.0):
    at = centres(found, x, moved)
    return chain.distance(np.stack([at.real, at.imag], axis=1)) - found["radius"]


def lift_error(chain, found, x):
    """How far the roller is to be moved along its path until it touches, mm."""
    moved, step = np.zeros_like(x), 1e-6
    for _ in range(8):
        gap = gaps(chain, found, x, moved)
        moved = moved - gap * step / (gaps(chain, found, x, moved + step) - gap)
    return moved


def steepest(found, x):
    """The largest and the least pressure angle, degrees: of the tangent of the path of the roller, by differences of the positions."""
    step = 1e-4
    tangent = (centres(found, x + step) - centres(found, x - step)) / (2 * step)
    # The normal out of the metal is the tangent turned by -90 deg, as the path is the direction across turned by the drive angle.
    angle = found["drive"] - np.degrees(np.angle(tangent))
    return angle.max(), angle.min()


def check_size(found, chain, report):
    """Extents, the level run-in, the straight back, and how thin the plate is."""
    plate = report["cam"]
    length, height = chain.extents()
    assert abs(length - plate["length_mm"]) < 1e-5 and abs(height - plate["height_mm"]) < TOLERANCE + 1e-5, (length, height, plate)
    run_in = found["run_in"] or max(found["radius"], 5.0)
    assert abs(plate["run_in_mm"] - run_in) < 1e-9, plate
    top, left = chain.start[:, 1].max(), chain.start[:, 0].min()
    first = lift(found, np.array([0.0]))[0] * np.exp(1j * np.radians(found["drive"] - 90)) + 1j * found["radius"]
    assert abs(left - (first.real - run_in)) < 1e-5, (left, first)
    on_top = chain.start[np.abs(chain.start[:, 1] - top) < 1e-9]
    assert len(on_top) == 2 and abs(np.ptp(on_top[:, 0]) - length) < 1e-9, on_top
    assert abs((top - chain.flattened(1e-3)[:, 1].min()) - plate["height_mm"]) < TOLERANCE + 1e-5, (top, plate)
    return top


def faults(found, top):
    """What only a plate can have wrong: its flank, its back, an end, its run-in, and the path of its follower on the other side."""
    flank = lambda z: z + DOWN if z.imag < top - 1e-6 else z
    end = max(0.0, stroke(found)) - 1e-6
    return [
        ("flank shifted by 1.3 tolerances", flank),
        ("back lowered by 1.3 tolerances", lambda z: z if z.imag < top - 1e-6 else z + DOWN),
        ("flank moved along by 0.1 mm", lambda z: z + 0.1 if z.imag < top - 1e-6 else z),
        ("turned by 0.1 deg", lambda z: z * np.exp(0.1j * np.pi / 180)),
        ("shorter by 0.1 %", lambda z: complex(z.real * 0.999, z.imag)),
        ("end cut off by 0.02 mm", lambda z: z - 0.02 if z.real > end + 2 else z),
    ]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("binary")
    parser.add_argument("directory", type=Path)
    parser.add_argument("--count", type=int, default=30)
    parser.add_argument("--seed", type=int, default=1)
    asked = parser.parse_args()
    random = __import__("random").Random(asked.seed)
    folder = asked.directory / "wedge"
    folder.mkdir(parents=True, exist_ok=True)
    worst, of_lift, made = 0.0, 0.0, 0
    for index in range(asked.count):
        found = design(random)
        done = make(asked.binary, folder, toml(found))
        if done.returncode != 0:
            broken = failed(done)
            assert broken and ("undercut" in broken or not broken & {"rolling", "outline", "tangency", "ends"}), (index, broken, done.stderr, toml(found))
            continue
        report = json.loads(done.stdout)
        if found["given"]:
            sizes = [report["cam"][key] + found["spare"] for key in ("length_mm", "height_mm")]
            done = make(asked.binary, folder, toml(found, *sizes))
            assert done.returncode == 0, (index, done.stderr, toml(found, *sizes))
            report = json.loads(done.stdout)
            assert all(abs(report["cam"][key] - size) < 1e-9 for key, size in zip(("length_mm", "height_mm"), sizes)), report["cam"]
        made += 1
        chain = Chain(polyline(folder / "cam.dxf")[1])
        run_in = found["run_in"] or max(found["radius"], 5.0)
        x = np.linspace(-run_in, stroke(found), 1200)
        error = np.abs(gaps(chain, found, x)).max()
        assert error <= TOLERANCE + ROUNDING, (index, error, toml(found))
        top = check_size(found, chain, report)
        told = {check["check"]: check["value"] for check in report["checks"]}
        inside = np.linspace(0.01, stroke(found) - 0.01, 4000)
        angles = steepest(found, inside)
        assert abs(max(map(abs, angles)) - told["pressure_angle"]) < 2e-2, (index, angles, told["pressure_angle"])
        off = np.abs(lift_error(chain, found, x)).max()
        assert off <= (TOLERANCE + ROUNDING) / np.cos(np.radians(told["pressure_angle"])) * 1.001, (index, off, toml(found))
        (volume,) = volumes(folder / "cam.step")
        expected = THICKNESS * abs(chain.area())
        assert abs(volume / expected - 1) < 1e-6, (volume, expected)
        worst, of_lift = max(worst, error), max(of_lift, off)
        if index % 5 == 0:
            for name, change in faults(found, top):
                refused = plant(asked.binary, folder, "cam.dxf", "CAM_PROFILE", change, "--design", str(folder / "design.toml"))
                assert refused & {"rolling", "outline", "ends", "tangency"}, (name, refused)
    assert made > asked.count // 2, made
    print(f"{made} of {asked.count} plates: roller within {1e3 * worst:.4f} um of the flank, lift within {1e3 * of_lift:.4f} um, planted faults refused")


if __name__ == "__main__":
    sys.exit(main())
