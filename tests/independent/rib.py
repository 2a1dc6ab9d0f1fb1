"""Puts the two rollers of one follower on either side of written ribs, all round, against motions integrated here, and measures the solid with
OpenCASCADE.

Shares nothing with camgen but the motion programs: the laws are those of laws.py, the centres of both rollers come from the geometry of the follower
in complex numbers, half of the distance before and behind the middle in the direction in which the follower moves. Each roller must be as far from
its flank as its radius. The lifts that both flanks really give, found by moving the follower until each roller touches, must differ by what the
check `closure` reports. Faults are planted in the files, and `camgen check` must refuse each.

usage: rib.py CAMGEN_BINARY DIRECTORY [--count N] [--seed S]
"""
import argparse
import json
import sys
from pathlib import Path

import numpy as np
from form_closed import FAULTS, ROUNDING, TOLERANCE, failed, make, plant, program, rise_and_return, volumes
from laws import motion
from outline import Chain, polyline

THICKNESS = 18.0
LAYERS = ["RIB_OUTER", "RIB_INNER"]


def design(random):
    swings = random.random() < 0.5
    stroke = random.uniform(6, 16) if swings else random.uniform(8, 26)
    radius = random.uniform(6, 14)
    found = dict(swings=swings, segments=rise_and_return(random, stroke), radius=radius, ccw=random.random() < 0.3)
    found["distance"] = 2 * radius + random.uniform(8, 20)
    if swings:
        found |= dict(prime=random.uniform(85, 105), arm=random.uniform(95, 115), pivot=random.uniform(135, 150), side=random.choice(["trailing", "leading"]))
    else:
        found |= dict(prime=random.uniform(85, 120), offset=random.uniform(-12, 12))
    return found


def toml(found):
    mm = lambda key, name: f'{name} = "{found[key]!r} mm"'
    lines = program(found["segments"], "deg" if found["swings"] else "mm")
    if found["swings"]:
        lines += ["[follower.swinging-roller]", mm("arm", "arm"), mm("pivot", "pivot_distance"), f'side = "{found["side"]}"', 'inertia = "0.01 kg*m2"']
    else:
        lines += ["[follower.roller]", mm("offset", "offset"), 'mass = "2 kg"']
    lines += [mm("radius", "radius"), "[cam]", 'body = "rib"', f'base_radius = "{found["prime"] - found["radius"]!r} mm"', mm("distance", "roller_distance")]
    lines += [f'thickness = "{THICKNESS} mm"', 'rotation = "ccw"' if found["ccw"] else 'rotation = "cw"']
    return "\n".join(lines + ["[limits]", 'pressure_angle = "60 deg"', "min_convex_pitch_radius_over_roller = 1.0", ""])


def centres(found, theta, moved=0.0):
    """Both centres in the drawing with the follower `moved` (mm or rad) from its place by the motion, complex, mm: the outer one first."""
    position = motion(found["segments"], 0.0, np.degrees(theta))
    u = np.exp(1j * theta)
    if found["swings"]:
        pivot, arm = found["pivot"], found["arm"]
        start = np.arccos((pivot**2 + arm**2 - found["prime"] ** 2) / (2 * pivot * arm))
        side = 1 if found["side"] == "trailing" else -1
        along = np.exp(1j * side * (start + np.radians(position) + moved))
        middle, way = u * (pivot - arm * along), -1j * side * along * u
    else:
        height = np.sqrt(found["prime"] ** 2 - found["offset"] ** 2) + position + moved
        middle, way = u * (height + 1j * found["offset"]), u
    both = [middle + sign * 0.5 * found["distance"] * way for sign in (1, -1)]
    return [centre.conj() if found["ccw"] else centre for centre in both]


def gaps(chains, found, theta, moved=0.0):
    points = centres(found, theta, moved)
    return [chain.distance(np.stack([point.real, point.imag], axis=1)) - found["radius"] for chain, point in zip(chains, points)]


def closure(chains, found, theta):
    """Lift of the outer flank less that of the inner one, as a travel of the outer roller, mm."""
    travels = []
    for which in range(2):
        moved = np.zeros_like(theta)
        for _ in range(8):
            gap, step = gaps(chains, found, theta, moved)[which], 1e-6
            moved = moved - gap * step / (gaps(chains, found, theta, moved + step)[which] - gap)
        travels.append(moved)
    leverage = np.hypot(found["arm"], 0.5 * found["distance"]) if found["swings"] else 1.0
    return leverage * (travels[0] - travels[1])


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("binary")
    parser.add_argument("directory", type=Path)
    parser.add_argument("--count", type=int, default=30)
    parser.add_argument("--seed", type=int, default=1)
    asked = parser.parse_args()
    random = __import__("random").Random(asked.seed)
    folder = asked.directory / "rib"
    folder.mkdir(parents=True, exist_ok=True)
    theta = np.linspace(0, 2 * np.pi, 1440, endpoint=False)
    worst, open_by, made = 0.0, 0.0, 0
    for index in range(asked.count):
        found = design(random)
        done = make(asked.binary, folder, toml(found))
        if done.returncode != 0:
            broken = failed(done)
            assert broken and not broken & {"rolling", "outline", "closure", "tangency"}, (index, broken, done.stderr, toml(found))
            continue
        made += 1
        outer, inner = chains = [Chain(polyline(folder / "cam.dxf", layer)[1]) for layer in LAYERS]
        error = max(np.abs(gap).max() for gap in gaps(chains, found, theta))
        assert error <= TOLERANCE + ROUNDING, (index, error, toml(found))
        apart = np.abs(closure(chains, found, theta)).max()
        (told,) = [check["value"] for check in json.loads(done.stdout)["checks"] if check["check"] == "closure"]
        assert told - 2e-4 < apart < told + 1e-5, (index, told, apart)
        expected = THICKNESS * (abs(outer.area()) - abs(inner.area()))
        (volume,) = volumes(folder / "cam.step")
        assert abs(volume / expected - 1) < 1e-6, (volume, expected)
        worst, open_by = max(worst, error), max(open_by, apart)
        if index % 5 == 0:
            for layer in LAYERS:
                for name, change in FAULTS:
                    refused = plant(asked.binary, folder, "cam.dxf", layer, change, "--design", str(folder / "design.toml"))
                    assert refused & {"rolling", "outline", "closure"}, (layer, name, refused)
    assert made > asked.count // 2, made
    print(f"{made} of {asked.count} ribs: rollers within {1e3 * worst:.4f} um of their flanks, closed within {1e3 * open_by:.4f} um, planted faults refused")


if __name__ == "__main__":
    sys.exit(main())
