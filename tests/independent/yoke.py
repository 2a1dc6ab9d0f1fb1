"""Puts the two faces or rollers of a yoke on written discs, all round, against motions integrated here.

Shares nothing with camgen but the first half turn of the motion: the laws are those of laws.py, the second half turn is the first one upside down. A
face must touch where the outline reaches farthest in its direction, a roller must be as far from the outline as its radius; both together must leave
the breadth of the yoke. Faults are planted in the files, and `camgen check` must refuse each. A motion of a whole turn whose halves do not belong
together must be refused.

usage: yoke.py CAMGEN_BINARY DIRECTORY [--count N] [--seed S]
"""
import argparse
import sys
from pathlib import Path

import numpy as np
from form_closed import FAULTS, LAWS, ROUNDING, TOLERANCE, failed, make, plant, program, volumes
from laws import motion
from outline import Chain, polyline

THICKNESS = 15.0


def design(random):
    flat = random.random() < 0.5
    first, rise = random.uniform(5, 30), random.uniform(100, 140)
    stroke, law = random.uniform(10, 40), random.choice(LAWS)
    half = [("dwell", first, 0.0), (law, rise, stroke), ("dwell", 180 - first - rise, stroke)]
    other = [("dwell", first, stroke), (law, rise, 0.0), ("dwell", 180 - first - rise, 0.0)]
    found = dict(flat=flat, half=half, segments=half + other, stroke=stroke, ccw=random.random() < 0.3, whole=random.random() < 0.2)
    found |= dict(base=random.uniform(50, 80), by_breadth=random.random() < 0.5)
    found |= dict(tilt=random.choice([0.0, random.uniform(-15, 15)])) if flat else dict(radius=random.uniform(8, 16))
    return found


def breadth(found):
    return 2 * found["base"] + found["stroke"] * (np.cos(np.radians(found["tilt"])) if found["flat"] else 1.0)


def toml(found, segments=None):
    lines = program(segments or (found["segments"] if found["whole"] else found["half"]), "mm")
    lines += ["[follower.flat]", f'tilt = "{found["tilt"]!r} deg"'] if found["flat"] else ["[follower.roller]", f'radius = "{found["radius"]!r} mm"']
    lines += ['mass = "3 kg"', "[cam]", 'body = "yoke"', f'thickness = "{THICKNESS} mm"', 'rotation = "ccw"' if found["ccw"] else 'rotation = "cw"']
    lines += [f'breadth = "{float(breadth(found))!r} mm"' if found["by_breadth"] else f'base_radius = "{found["base"]!r} mm"']
    return "\n".join(lines + ["[limits]", 'pressure_angle = "60 deg"', "min_convex_pitch_radius_over_roller = 1.0", ""])


def support(chain, angles):
    """How far a chain of arcs reaches in some directions (rad), mm."""
    ways = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    farthest = (ways @ chain.start.T).max(axis=1)
    first = np.arctan2(*(chain.start - chain.centre).T[::-1])
    along = (angles[:, None] - first) * np.sign(chain.sweep) % (2 * np.pi)
    on = chain.is_arc & (chain.sweep > 0) & (along <= np.abs(chain.sweep))
    reach = np.where(on, ways @ np.where(chain.is_arc[:, None], chain.centre, 0).T + np.where(chain.is_arc, chain.radius, 0), -np.inf)
    return np.maximum(farthest, reach.max(axis=1))


def off(found, chain, theta):
    """By how much either face or roller is off its place, mm."""
    mirror = -1 if found["ccw"] else 1
    lift = motion(found["segments"], 0.0, np.degrees(theta))
    if found["flat"]:
        tilt = np.radians(found["tilt"])
        first = support(chain, mirror * (theta + tilt)) - (found["base"] + lift * np.cos(tilt))
        both = support(chain, mirror * (theta + tilt)) + support(chain, mirror * (theta + tilt + np.pi)) - breadth(found)
        return first, both
    prime = found["base"] + found["radius"]
    place = lambda radius: np.stack([radius * np.cos(theta), mirror * radius * np.sin(theta)], axis=1)
    first = chain.distance(place(prime + lift)) - found["radius"]
    # The second roller, so far behind the first as the breadth and both radii say.
    second = chain.distance(place(prime + lift - breadth(found) - 2 * found["radius"])) - found["radius"]
    return first, second


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("binary")
    parser.add_argument("directory", type=Path)
    parser.add_argument("--count", type=int, default=30)
    parser.add_argument("--seed", type=int, default=1)
    asked = parser.parse_args()
    random = __import__("random").Random(asked.seed)
    folder = asked.directory / "yoke"
    folder.mkdir(parents=True, exist_ok=True)
    theta = np.linspace(0, 2 * np.pi, 1440, endpoint=False)
    worst, made = 0.0, 0
    for index in range(asked.count):
        found = design(random)
        done = make(asked.binary, folder, toml(found))
        if done.returncode != 0:
            broken = failed(done)
            assert broken and not broken & {"rolling", "outline", "closure", "tangency"}, (index, broken, done.stderr, toml(found))
            continue
        made += 1
        chain = Chain(polyline(folder / "cam.dxf")[1])
        first, both = off(found, chain, theta)
        error = max(np.abs(first).max(), np.abs(both).max() / (2 if found["flat"] else 1))
        assert error <= TOLERANCE + ROUNDING, (index, error, toml(found))
        (volume,) = volumes(folder / "cam.step")
        assert abs(volume / (THICKNESS * abs(chain.area())) - 1) < 1e-6
        worst = max(worst, error)
        if index % 5 == 0:
            for name, change in FAULTS:
                refused = plant(asked.binary, folder, "cam.dxf", "CAM_PROFILE", change, "--design", str(folder / "design.toml"))
                assert refused & {"rolling", "outline", "closure"}, (name, refused)
            (a, b, c), (d, e, f) = found["half"], found["segments"][3:]
            other = [a, b, c, (d[0], d[1] + 2, d[2]), (e[0], e[1] - 4, e[2]), (f[0], f[1] + 2, f[2])]
            done = make(asked.binary, folder, toml(found, other))
            assert done.returncode == 2 and "half a turn apart" in done.stderr, (done.returncode, done.stderr)
    assert made > asked.count // 2, made
    print(f"{made} of {asked.count} yokes: faces and rollers within {1e3 * worst:.4f} um of their places, planted faults refused")


if __name__ == "__main__":
    sys.exit(main())
