"""Rolls the rollers of turrets past the surfaces of written STEP files of globoid cams as OpenCASCADE has them.

Shares nothing with camgen but the motion programs: the laws are those of laws.py, and the centre lines of the rollers come from the geometry of the turret.
Every place of a flank must be as far from the nearest centre line, over all cam angles and rollers, as the flank's radius, and every place of a centre line
as far from the surfaces of both of its flanks. Each solid must be valid, with the volume of the blank less the grooves, which is integrated torus by torus
from the envelope of the rollers. Files of other cams must be refused: another roller, no clearance, another distance of the axes, a mirrored file.

usage: globoid.py CAMGEN_BINARY DIRECTORY [--count N] [--seed S]
"""
import argparse
import csv
import json
import subprocess
from pathlib import Path

import numpy as np
from barrel import flanks, refused, samples
from form_closed import LAWS, TOLERANCE, failed, make, program
from laws import motion

PLACES = 500
ROUNDING = 1e-6  # of OpenCASCADE's search
BORE = 12.0


def design(random):
    found = dict(rollers=random.randint(6, 16), ccw=random.random() < 0.4, groove=random.random() < 0.4, clearance=random.choice([0.0, 0.03]))
    found["advance"] = 2 if found["rollers"] >= 12 and random.random() < 0.4 else 1
    found["share"] = random.choice([0.0, 0.5, 1.0]) if found["clearance"] else 0.0
    pitch = 360 / found["rollers"]
    found["depth"] = random.uniform(10, 18)
    found["reach"] = found["depth"] * random.uniform(0.85, 1.0)
    found["arm"] = random.uniform(55, 90)
    found["radius"] = (found["arm"] - found["reach"] / 2) * np.sin(np.radians(pitch / 2)) * random.uniform(0.4, 0.62)
    found["distance"] = found["arm"] + found["depth"] + random.uniform(28, 50)
    if found["advance"] == 2 and random.random() < 0.5:
        # Two stops in a turn.
        found["segments"] = [(random.choice(LAWS), 120.0, pitch), ("dwell", random.uniform(20, 80), pitch), (random.choice(LAWS), 130.0, 2 * pitch)]
    else:
        found["segments"] = [(random.choice(LAWS), random.uniform(110, 220), found["advance"] * pitch)]
    rest = 360 - sum(over for _, over, _ in found["segments"])
    found["segments"].append(("dwell", rest, found["segments"][-1][2]))
    return found


def toml(found, **changed):
    found = found | changed
    mm = lambda value, name: f'{name} = "{value!r} mm"'
    lines = program(found["segments"], "deg", 60) + ["[follower.roller]", mm(float(found["radius"]), "radius"), "[cam]", 'body = "globoid"']
    lines += [mm(found["distance"], "turret_distance"), mm(found["arm"], "arm"), f"rollers = {found['rollers']}", f"advance = {found['advance']}"]
    lines += [mm(found["depth"], "groove_depth"), mm(found["reach"], "roller_height"), mm(found["clearance"], "clearance")]
    lines += [f"clearance_share = {found['share']}", 'rests_on = "groove"' if found["groove"] else 'rests_on = "rib"']
    lines += [mm(BORE, "bore_radius"), 'rotation = "ccw"' if found["ccw"] else 'rotation = "cw"']
    return "\n".join(lines + ["[limits]", 'pressure_angle = "75 deg"', ""])


def turret(found, theta):
    """Turret angle of the roller that rests first, rad, at cam angles of any turn."""
    pitch = 360 / found["rollers"]
    first = 0.0 if found["groove"] else -pitch / 2
    turns = np.floor(theta / (2 * np.pi))
    return np.radians(first + motion(found["segments"], 0.0, np.degrees(theta - 2 * np.pi * turns)) + turns * found["advance"] * pitch)


def square(found, points, theta):
    """Squared distance of places (n × 3) from the nearest centre line at cam angles (n × k)."""
    x, y, z = (points[:, i][:, None] for i in range(3))
    out, across = x * np.cos(theta) + y * np.sin(theta), y * np.cos(theta) - x * np.sin(theta)
    off = out - found["distance"]
    pitch = 2 * np.pi / found["rollers"]
    # The roller at this cam angle whose angle about the turret is nearest to that of the place.
    about = np.arctan2(z, -off)
    angle = turret(found, theta)
    angle = angle + pitch * np.round((about - angle) / pitch)
    up = off * np.sin(angle) + z * np.cos(angle)
    return np.where(out > 0, across**2 + up**2, np.inf), up


def away(found, points):
    """The least distance of places (seen by a clockwise cam) from the centre lines, mm, and whether the place lies above the roller."""
    polar = np.arctan2(points[:, 1], points[:, 0])
    theta = polar[:, None] + np.linspace(-0.6, 0.6, 241)
    middle = np.take_along_axis(theta, square(found, points, theta)[0].argmin(axis=1)[:, None], axis=1)
    low, high = middle - 0.006, middle + 0.006
    golden = (np.sqrt(5) - 1) / 2
    for _ in range(60):
        a, b = high - golden * (high - low), low + golden * (high - low)
        nearer = square(found, points, a)[0] < square(found, points, b)[0]
        low, high = np.where(nearer, low, a), np.where(nearer, b, high)
    least, up = square(found, points, 0.5 * (low + high))
    return np.sqrt(least)[:, 0], up[:, 0] > 0


def radii(found):
    """Of the flanks above and below the roller."""
    below = found["radius"] + found["clearance"] * found["share"]
    return 2 * found["radius"] + found["clearance"] - below, below


def mirrored(found, points):
    return points * np.array([1.0, -1.0, 1.0]) if found["ccw"] else points


def off_flanks(found, points):
    """How far places of flanks are off, mm: positive where metal is missing; and which of them are above."""
    distance, above = away(found, mirrored(found, points))
    return distance - np.where(above, *radii(found)), above


def tubes(found):
    outside = found["arm"] - found["reach"] / 2
    return outside, outside + found["depth"]


def axis_distances(found, surfaces, end, random):
    """From places of centre lines to the nearest place of each flank, as OpenCASCADE finds it, less its radius: the largest size."""
    from OCP.GeomAPI import GeomAPI_ProjectPointOnSurf
    from OCP.gp import gp_Pnt

    coarse = [samples(surface, random, 24) for surface in surfaces]
    above = [off_flanks(found, places)[1].mean() > 0.5 for places in coarse]
    outside, floor = tubes(found)
    worst, count, pitch = 0.0, 0, 2 * np.pi / found["rollers"]
    inside = end - np.arcsin(max(radii(found)) / outside) - 0.03
    # Of the places whose contact lies between outside and floor.
    last = np.sqrt(floor**2 - max(radii(found)) ** 2)
    while count < PLACES:
        theta, v = 2 * np.pi * random.random(), random.uniform(outside + 0.5, last - 0.3)
        angle = float(turret(found, np.array([theta]))[0])
        near = [angle + k * pitch for k in range(-12, 13) if abs(angle + k * pitch) < inside]
        if not near:
            continue
        angle = random.choice(near)
        radius, z = found["distance"] - v * np.cos(angle), v * np.sin(angle)
        place = mirrored(found, np.array([[radius * np.cos(theta), radius * np.sin(theta), z]]))[0]
        for side, due in zip((True, False), radii(found)):
            of = [index for index, is_above in enumerate(above) if is_above == side]
            least = np.inf
            for index in sorted(of, key=lambda index: np.linalg.norm(coarse[index] - place, axis=1).min())[:4]:
                projected = GeomAPI_ProjectPointOnSurf(gp_Pnt(*place), surfaces[index])
                if projected.NbPoints():
                    least = min(least, projected.LowerDistance())
            worst = max(worst, abs(least - due))
        count += 1
    return worst


def volume(found, end):
    """Of the blank less its grooves and bore, mm³."""
    outside, floor = tubes(found)
    distance, pitch, advance = found["distance"], 2 * np.pi / found["rollers"], found["advance"]
    # The blank between its two tubes, and within that of the floor, by rings.
    nodes, weights = np.polynomial.legendre.leggauss(40)
    about = end * nodes
    radius = distance - floor * np.cos(about)
    whole = end * np.sum(weights * np.pi * radius**2 * floor * np.cos(about))
    # From before the first flank enters to behind the last that leaves.
    first, last = np.floor((-end - 0.5) / (advance * pitch)), np.ceil((end + 0.5 + (advance - 0.5) * pitch) / (advance * pitch))
    turns, start = int(last - first), 2 * np.pi * first
    theta = start + np.linspace(0, 2 * np.pi * turns, 12000 * turns + 1)
    step = 1e-5
    rate = (turret(found, theta + step) - turret(found, theta - step)) / (2 * step)
    cut = 0.0
    few, few_weights = np.polynomial.legendre.leggauss(5)
    for node, weight in zip(few, few_weights):
        tube = outside + found["depth"] * (node + 1) / 2
        ring = lambda phi: tube * (distance * phi - tube * np.sin(phi))
        cut += weight / 2 * found["depth"] * 2 * np.pi * 2 * ring(end)
    for (node, weight), start in ((pair, start) for pair in zip(few, few_weights) for start in range(advance)):
        tube = outside + found["depth"] * (node + 1) / 2
        ring = lambda phi: tube * (distance * phi - tube * np.sin(phi))
        angle = turret(found, theta) - start * pitch
        areas = []
        for sign, radius in zip((1, -1), radii(found)):
            v = np.full_like(theta, tube)
            for _ in range(80):
                run = distance - v * np.cos(angle)
                size = np.hypot(run, v * rate)
                across, up = -sign * radius * v * rate / size, sign * radius * run / size
                out = run + up * np.sin(angle)
                z = v * np.sin(angle) + up * np.cos(angle)
                rho = np.hypot(out, across)
                v = v - (np.hypot(distance - rho, z) - tube)
            phi = np.clip(np.arctan2(z, distance - rho), -end, end)
            polar = theta + np.arctan2(across, out)
            areas.append(np.sum(0.5 * (ring(phi[1:]) + ring(phi[:-1])) * np.diff(polar)))
        cut -= weight / 2 * found["depth"] * (areas[0] - areas[1])
    return whole + cut - np.pi * BORE**2 * 2 * floor * np.sin(end)


def two_axes(found, folder, binary, random):
    """A tool as wide as the groove follows the rollers."""
    done = make(binary, folder, toml(found), "csv")
    assert done.returncode == 0, done.stderr
    rows = list(csv.DictReader((folder / "cam-two-axes.csv").open()))
    sense = -1 if found["ccw"] else 1
    theta = np.radians([sense * float(row["a_deg"]) for row in rows])
    pitch = 360 / found["rollers"]
    due = np.degrees(turret(found, theta))
    off = (np.array([float(row["b_deg"]) for row in rows]) - due) / pitch
    assert np.abs(off - np.round(off)).max() < 1e-7, np.abs(off - np.round(off)).max()
    assert {int(row["groove"]) for row in rows} == set(range(1, found["advance"] + 1))


def faults(binary, folder, found):
    """Files of other cams, each with the checks that must refuse it."""
    (folder / "right.toml").write_text(toml(found))
    asked = ["--design", str(folder / "right.toml")]
    others = [("another roller", dict(radius=float(found["radius"]) + 1.3 * TOLERANCE)), ("another distance", dict(distance=found["distance"] + 0.02))]
    others += [("no clearance", dict(clearance=0.0))] if found["clearance"] else []
    others += [("turned the other way", dict(ccw=not found["ccw"]))]
    for name, changed in others:
        done = make(binary, folder, toml(found, **changed), "step")
        assert done.returncode == 0, (name, done.stderr)
        assert {"flank_surface", "solid_shell", "solid_volume"} & refused(binary, folder / "cam.step", *asked), name
    assert make(binary, folder, toml(found), "step").returncode == 0
    done = subprocess.run([binary, "check", str(folder / "cam.step"), *asked], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout
    text = (folder / "cam.step").read_text()
    minor = text.split("TOROIDAL_SURFACE('', ")[1].split(");")[0].split(", ")
    planted = {
        "cone": text.replace("CONICAL_SURFACE('', ", "CONICAL_SURFACE('', ", 1).replace(text.split("CONICAL_SURFACE('', ")[1].split(");")[0], ", ".join(text.split("CONICAL_SURFACE('', ")[1].split(");")[0].split(", ")[:2] + ["0.3"]), 1),
        "torus": text.replace(", ".join(minor), ", ".join([*minor[:2], repr(float(minor[2]) + 0.02)]), 1),
        "unit": text.replace(".MILLI.", ".CENTI.", 1),
    }
    for name, other in planted.items():
        assert other != text, name
        (folder / "planted.step").write_text(other)
        assert refused(binary, folder / "planted.step", *asked), name


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("binary")
    parser.add_argument("directory", type=Path)
    parser.add_argument("--count", type=int, default=20)
    parser.add_argument("--seed", type=int, default=1)
    asked = parser.parse_args()
    random = __import__("random").Random(asked.seed)
    folder = asked.directory / "globoid"
    folder.mkdir(parents=True, exist_ok=True)
    made, worst, axis, share, causes = 0, 0.0, 0.0, 0.0, {}
    for index in range(asked.count):
        found = design(random)
        done = make(asked.binary, folder, toml(found), "step")
        if done.returncode != 0:
            broken = failed(done)
            files = {"flank_surface", "solid_shell", "solid_volume", "groove_width"}
            assert done.returncode in (1, 2) and not broken & files, (index, found, broken, done.stderr)
            cause = ", ".join(sorted(broken)) or done.stderr.splitlines()[0][:80]
            causes[cause] = causes.get(cause, 0) + 1
            continue
        report = json.loads(done.stdout)
        end = np.radians(report["globoid"]["end_angle_deg"])
        surfaces, solid = flanks(folder / "cam.step")
        points = np.concatenate([samples(surface, random, 40) for surface in surfaces])
        worst = max(worst, np.abs(off_flanks(found, points)[0]).max())
        assert worst < TOLERANCE + ROUNDING, (index, found, worst)
        due = volume(found, end)
        share = max(share, abs(solid / due - 1))
        assert share < 1e-6, (index, found, solid, due)
        if made % 5 == 0:
            axis = max(axis, axis_distances(found, surfaces, end, random))
            assert axis < TOLERANCE + ROUNDING, (index, found, axis)
            two_axes(found, folder, asked.binary, random)
            faults(asked.binary, folder, found)
        made += 1
    assert made > asked.count // 2, (made, causes)
    print(f"{made} of {asked.count} globoids: flanks within {1e3 * worst:.2f} um of the rolled rollers, centre lines within {1e3 * axis:.2f} um, volumes within {share:.1e}; not made: {causes}")


if __name__ == "__main__":
    main()
