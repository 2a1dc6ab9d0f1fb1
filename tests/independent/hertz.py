"""Computes the contact stress of every body anew: discs, rings, grooves, pairs, ribs, yokes, barrels and globoids of random designs.

Shares nothing with camgen but the machine files: the laws are those of laws.py and are differentiated here, the centre of a roller is a point of its
mechanism in the frame of the cam, the force along the normal follows from virtual work, the curvature of a flank from differences of its normals, and the
pressure is that of a half-elliptic strip as wide as Hertz's contact. The contact line is as long as roller and flank really touch: through the
thickness, down to the end of the roller in a groove, between the ends of a globoid. Then a limit below that stress is set: the design must fail, and
each change that the report names must pass.

usage: hertz.py CAMGEN_BINARY DIRECTORY [--count N] [--seed S]
"""
import json
import random
import re
import subprocess

import barrel
import cases
import conjugate
import globoid
import groove
import numpy as np
import rib
import yoke
from disc import compliance
from laws import motion

STEP = np.radians(0.05)  # of differences
MODULUS = 1 / compliance("steel")
BODIES = ["disc", "groove", "ring", "conjugate", "rib", "yoke", "barrel", "globoid"]
# Errors of three points along a contact line instead of many, and of the assumed point of the force.
ROUND = {"barrel": 0.02, "globoid": 0.02}
PLANE = 2e-3


def hertz(force, curvature, length):
    """Largest pressure in MPa from a force in N, a reduced curvature in 1/mm, and a length in mm."""
    half = np.sqrt(4 * force / (np.pi * length * 1e-3 * curvature * 1e3 * MODULUS))
    return 1e-6 * np.where(force > 0, 2 * force / (np.pi * np.where(force > 0, half, 1.0) * length * 1e-3), 0.0)


def load(found, theta, inertia, omega):
    """The generalised force in N or N·m: mass or inertia times the acceleration."""
    unit = np.pi / 180 if found.get("swings") else 1e-3
    at = lambda angle: motion(found["segments"], 0.0, np.degrees(angle) % 360)
    second = (at(theta + STEP) - 2 * at(theta) + at(theta - STEP)) / STEP**2
    return inertia * second * unit * omega**2


def strip(centre, theta, force, contact):
    """Pressure on a plane flank. `centre` gives the roller's centre at cam angles and a move of the follower; `contact` its radius, the distance of the
    flank, the length, and the sign of the force under which it touches."""
    radius, distance, length, sign, unit = contact
    c, before, after = centre(theta, 0.0), centre(theta - STEP, 0.0), centre(theta + STEP, 0.0)
    first, second = (after - before) / (2 * STEP), (after - 2 * c + before) / STEP**2
    way = (centre(theta, 1e-6) - centre(theta, -1e-6)) / 2e-6
    normal = 1j * first / np.abs(first)
    dot = lambda a, b: (a * b.conj()).real
    # From the flank to the centre, so that the flank can give this sign of the force.
    outward = normal * np.sign(dot(normal, way)) * sign
    bend = -dot(second, outward) / np.abs(first) ** 2
    pressed = np.maximum(sign * force, 0.0) / np.abs(dot(outward, way) * unit)
    return hertz(pressed, np.maximum(1 / radius + bend / (1 - bend * distance), 0.0), length).max()


def plane(found, theta, contacts, force, unit):
    return max(strip(centre, theta, force, (*contact, unit)) for centre, contact in contacts)


def single(found):
    """Centre of the roller of a disc, a ring or a groove."""
    def centre(theta, moved):
        position = motion(found["segments"], 0.0, np.degrees(theta) % 360)
        u, place = np.exp(1j * theta), found["place"]
        if not found["swings"]:
            return u * (np.sqrt(found["prime"] ** 2 - place["offset"] ** 2) + position + moved + 1j * place["offset"])
        arm, pivot = place["arm"], place["pivot_distance"]
        start = np.arccos((pivot**2 + arm**2 - found["prime"] ** 2) / (2 * pivot * arm))
        side = 1 if place["side"] == "trailing" else -1
        return u * (pivot - arm * np.exp(1j * side * (start + np.radians(position) + moved)))
    return centre


def one_of(both, found, which):
    """Centre of one of two rollers, seen clockwise."""
    return lambda theta, moved: both(found | {"ccw": False}, theta % (2 * np.pi), moved)[which]


def yoke_centres(found, theta, moved):
    lift = motion(found["segments"], 0.0, np.degrees(theta)) + moved
    prime, u = found["base"] + found["radius"], np.exp(1j * theta)
    return [u * (prime + lift), u * (prime + lift - yoke.breadth(found) - 2 * found["radius"])]


def surface(line, axis, v, theta, step=STEP):
    """Points, normals and the velocity of a centre line at places v (mm) and one cam angle, in the frame of the cam."""
    place = line(theta, v)
    velocity = (line(theta + step, v) - line(theta - step, v)) / (2 * step)
    normal = np.cross(axis(theta), velocity)
    return place, normal / np.linalg.norm(normal, axis=-1, keepdims=True)


def bent(line, axis, v, theta, offset):
    """Sum of both principal curvatures of the flank at a signed distance along the normal, 1/mm: rotation of the normal per distance."""
    def at(theta, v):
        place, normal = surface(line, axis, v, theta)
        return place + offset * normal, normal
    step, wide = 4 * STEP, 1e-3
    (p0, n0), (p1, n1) = at(theta - step, v), at(theta + step, v)
    (q0, m0), (q1, m1) = at(theta, v - wide), at(theta, v + wide)
    by_angle, turn_angle = (p1 - p0) / (2 * step), (n1 - n0) / (2 * step)
    by_v, turn_v = (q1 - q0) / (2 * wide), (m1 - m0) / (2 * wide)
    _, normal = at(theta, v)
    triple = lambda a, b: np.einsum("ij,ij->i", np.cross(a, b), normal)
    return (triple(turn_angle, by_v) + triple(by_angle, turn_v)) / triple(by_angle, by_v)


def swept(line, axis, way, theta, force, reach, touching, contact):
    """Pressure of a roller on a flank in space at a cam angle, over the part of its reach selected by `touching`; `way` is the move of its centre line per unit of the lift."""
    radius, distances = contact
    if force == 0:
        return 0.0
    v = np.linspace(*reach, 201)
    _, normal = surface(line, axis, v, theta)
    ways = way(theta, v)
    side = np.sign(force) * np.sign(np.einsum("ij,ij->i", normal, ways)[len(v) // 2])
    distance = distances[0 if side < 0 else 1]
    offset = -side * distance
    on = touching(line(theta, v) + offset * normal)
    if not on.any():
        return 0.0
    length = on.mean() * (reach[1] - reach[0])
    middle = np.flatnonzero(on)[on.sum() // 2]
    pressed = abs(force) / abs(np.dot(normal[middle], ways[middle])) * 1e3
    curvature = 1 / radius - offset / abs(offset) * bent(line, axis, v, theta, offset)
    return float(hertz(pressed, max(curvature[on].max(), 0.0), length))


def of_barrel(found, theta, force, reach):
    """Distances: of the flank above, then below."""
    below = found["radius"] + found["clearance"] * found["share"]
    distances = (2 * found["radius"] + found["clearance"] - below, below)

    def frame(angle):
        return np.array([np.cos(angle), np.sin(angle), 0.0]), np.array([-np.sin(angle), np.cos(angle), 0.0]), np.array([0.0, 0.0, 1.0])

    def line(angle, v, moved=0.0):
        shifted = found | {"lift": moved}
        across, along = moved_line(shifted, angle)
        out, by, up = frame(angle)
        return v[:, None] * out + across * by + along * up

    axis = lambda angle: frame(angle)[0]
    way = lambda angle, v: (line(angle, v, 1e-6) - line(angle, v, -1e-6)) / 2e-6
    most = 0.0
    for angle, pressing in zip(theta, force):
        across = moved_line(found | {"lift": 0.0}, angle)[0]
        inner = np.sqrt((found["outer"] - reach) ** 2 - across**2)
        within = lambda point: (np.hypot(point[:, 0], point[:, 1]) <= found["outer"]) & (np.hypot(point[:, 0], point[:, 1]) >= found["outer"] - found["depth"])
        value = swept(line, axis, way, angle, pressing, (inner, found["outer"]), within, (found["radius"], distances))
        most = max(most, value)
    return most


def moved_line(found, angle):
    """Centre line of a barrel's roller, across and along, with the follower moved by `lift` (mm or rad)."""
    position = motion(found["segments"], 0.0, np.degrees(np.atleast_1d(angle)) % 360)[0]
    if not found["swings"]:
        return found["offset"], position + found["lift"]
    half, side = np.radians(found["swing"]) / 2, 1 if found["side"] == "trailing" else -1
    turned = np.radians(position) - half + found["lift"]
    return side * (found["pivot"] - found["arm"] * np.cos(turned)), found["arm"] * (np.sin(turned) + np.sin(half))


def of_globoid(found, theta, force, end):
    distances, pitch = globoid.radii(found), 2 * np.pi / found["rollers"]
    outside = found["arm"] - found["reach"] / 2
    reach = (outside, outside + found["reach"])
    most = 0.0
    for angle, pressing in zip(theta, force):
        for roller in range(-3, 4 + found["advance"]):
            def place(at, v, moved=0.0):
                turn = globoid.turret(found, np.atleast_1d(at))[0] - roller * pitch + moved
                out = found["distance"] - v * np.cos(turn)
                return np.stack([out * np.cos(at), out * np.sin(at), v * np.sin(turn)], axis=1), turn
            line = lambda at, v: place(at, v)[0]
            axis = lambda at: np.array([-np.cos(place(at, np.zeros(1))[1]) * np.cos(at), -np.cos(place(at, np.zeros(1))[1]) * np.sin(at), np.sin(place(at, np.zeros(1))[1])])
            way = lambda at, v: (place(at, v, 1e-6)[0] - place(at, v, -1e-6)[0]) / 2e-6

            def touching(points):
                off = found["distance"] - np.hypot(points[:, 0], points[:, 1])
                between = np.abs(np.arctan2(points[:, 2], off)) <= end + 1e-9
                inside = np.hypot(off, points[:, 2]) >= outside * (1 - 1e-9)
                # An entering roller carries no force yet.
                return between & inside if between.all() else np.zeros(len(points), bool)
            if abs(place(angle, np.zeros(1))[1]) > end + 0.3:
                continue
            value = swept(line, axis, way, angle, pressing, reach, touching, (found["radius"], distances))
            most = max(most, value)
    return most


def with_material(text, more=""):
    return text.replace("[cam]\n", f'[cam]\nmaterial = "steel"\n{more}', 1)


def case(body, rng):
    """The text of a machine file, and a function that computes its contact stresses, of the first cam and of the others made with it, MPa."""
    theta = np.radians(np.arange(0.125, 360, 0.25))
    if body in ("groove", "ring", "disc"):
        found = groove.design(rng) | {"body": body if body != "disc" else "disc", "ccw": False}
        inertia, omega = (0.01 if found["swings"] else 2.0), 150 * 2 * np.pi / 60
        text = groove.toml(found)
        if body == "disc":
            text = text.replace(f'base_radius = "{found["prime"] + found["radius"]!r} mm"', f'base_radius = "{found["prime"] - found["radius"]!r} mm"')
        reach = rng.choice([None, rng.uniform(6, 11)]) if body == "groove" else None
        text = with_material(text, f'roller_height = "{reach!r} mm"\n' if reach else "")
        constant = 0.0
        if body != "groove":
            constant = rng.uniform(20, 60) if found["swings"] else rng.uniform(300, 900)
            text += f'[spring]\npreload = "{constant!r} {"N*m" if found["swings"] else "N"}"\n'
        inside = found["clearance"] * found["share"]
        r, c, width = found["radius"], single(found), {"groove": reach or 12.0}.get(body, 20.0)
        contacts = {
            "groove": [(c, (r, r + inside, width, 1)), (c, (r, r + found["clearance"] - inside, width, -1))],
            "ring": [(c, (r, r, width, -1))],
            "disc": [(c, (r, r, width, 1))],
        }[body]
        sign = -1 if body == "ring" else 1
        unit = 1e-3 if found["swings"] else 1.0
        return text, lambda report: [plane(found, theta, contacts, load(found, theta, inertia, omega) + sign * constant, unit)]
    if body in ("conjugate", "rib", "yoke"):
        module = {"conjugate": conjugate, "rib": rib, "yoke": yoke}[body]
        found = module.design(rng)
        while found.get("flat"):
            found = module.design(rng)
        found |= {"ccw": False}
        inertia = 3.0 if body == "yoke" else (0.01 if found["swings"] else 2.0)
        both = yoke_centres if body == "yoke" else module.centres
        width = {"conjugate": 10.0, "rib": 18.0, "yoke": 15.0}[body]
        radii = [found["radius"], found.get("other", found["radius"])]
        parts = [(one_of(both, found, which), (radii[which], radii[which], width, sign)) for which, sign in ((0, 1), (1, -1))]
        unit = 1e-3 if found.get("swings") else 1.0
        text = with_material(module.toml(found))

        def found_stress(report):
            force = load(found, theta, inertia, 150 * 2 * np.pi / 60)
            values = [plane(found, theta, [part], force, unit) for part in parts]
            return values if body == "conjugate" else [max(values)]
        return text, found_stress
    if body == "barrel":
        found = barrel.design(rng)
        reach = found["depth"] * rng.choice([1.0, 0.8])
        more = f'roller_height = "{reach!r} mm"\n'
        inertia = 0.01 if found["swings"] else 2.0
        text = with_material(barrel.toml(found), more)
        key = 'inertia = "0.01 kg*m2"' if found["swings"] else 'mass = "2 kg"'
        text = text.replace("\n[cam]", f"\n{key}\n[cam]", 1)
        coarse = theta[::4]
        # A move of the follower is in mm or rad, and work in N·m.
        unit = 1.0 if found["swings"] else 1e-3
        force = lambda: load(found, coarse, inertia, 150 * 2 * np.pi / 60)
        return text, lambda report: [of_barrel(found, coarse, force() * unit, reach)]
    found = globoid.design(rng)
    text = with_material(globoid.toml(found), 'turret_inertia = "0.4 kg*m2"\n')
    coarse = theta[::4]

    def of_report(report):
        end = np.radians(report["globoid"]["end_angle_deg"])
        return [of_globoid(found, coarse, load(found | {"swings": True}, coarse, 0.4, 60 * 2 * np.pi / 60), end)]
    return text, of_report


def run(binary, path, *more):
    command = [binary, "make", str(path), "--dry-run", *more]
    done = subprocess.run([*command, "--json"], capture_output=True, text=True)
    return done, json.loads(done.stdout) if done.stdout.strip() else None


def stress_of(report, checks="checks"):
    (found,) = [check for check in report[checks] if check["check"] == "contact_stress"]
    return found


def remedies(note):
    """The changes that would pass by a note: lists of --set."""
    found = []
    for clause in (note or "").split("; "):
        if " would " in clause:
            found += [[f"{key}={value}" for key, value in re.findall(r'(\S+) = "([^"]+)"', part)] for part in clause.split(" or ")]
    return [sets for sets in found if sets]


def judge(words, number, rng, tried):
    body = BODIES[number % len(BODIES)]
    path = words.directory / f"{number}-{body}.toml"
    text, stresses = case(body, rng)
    path.write_text(text)
    done, report = run(words.binary, path)
    command = f"{words.binary} make {path} --dry-run"
    if report is None:
        return "refused", [] if done.returncode == 2 else [done.stderr], command
    if any(check["check"] in ("undercut", "meshing") and check["verdict"] == "fail" for check in report["checks"]):
        return "folds", [], command
    due, wrong = stresses(report), []
    values = [stress_of(report)["value"]]
    if body == "conjugate":
        values.append(stress_of(report, "other_checks")["value"])
    for value, expected in zip(values, due):
        if not abs(value / expected - 1) <= ROUND.get(body, PLANE):
            wrong.append(f"{body}: {value} MPa in the report, {expected} computed")
    limit = 0.8 * values[0]
    set_limit = f"limits.contact_stress={limit} MPa"
    done, report = run(words.binary, path, "--set", set_limit)
    check = stress_of(report)
    if check["verdict"] != "fail":
        wrong.append(f"{body}: a limit of {limit} MPa is kept")
    for sets in remedies(check.get("note")):
        tried.append(sets)
        _, changed = run(words.binary, path, *[word for item in [set_limit, *sets] for word in ("--set", item)])
        if changed is None or stress_of(changed)["verdict"] != "pass":
            wrong.append(f"{body}: {sets} does not keep {limit} MPa")
    return body, wrong, command


def main():
    words = cases.given("hertz", 20)
    tried = []
    states, failed = cases.judged(words, lambda number, rng: judge(words, number, rng, tried))
    cases.finish(states, failed, f"; {len(tried)} remedies applied")


if __name__ == "__main__":
    main()
