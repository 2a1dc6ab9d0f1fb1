"""Random cams exported as points and tables, imported by camgen, against the cams they were made from.

Shares nothing with camgen but the files it reads and writes: laws, followers and profiles are calculated here anew.

--count N for each of the five followers: the profile at 720 to 1440 places with 1 um of noise along its normal, as centres of a ball in half of the
cases, turned by any angle, and in a third of the cases shifted. The right law must be found for each rise and return, and the profile that
`camgen make` cuts of the imported design must lie within 3 um of the exact one, after the angle (and where it was shifted the centre) that fits
best, which no measuring machine knows. The table that `make` writes of that design, imported again as points, has its base radius.
--tables N: lift tables rounded to 0.01 mm at each degree: the right laws, the largest acceleration within 5 %.
Three tables as people have them, with noise, of which no law is right: the largest acceleration is at most 1.3 times that of the smoothest curve
within the same deviation, the least integral of the squared jerk, found here by quadratic programming on a fine grid.
Rows --long: a table of 3600 rows, and how long it takes.

usage: importing.py CAMGEN_BINARY DIRECTORY [--count N] [--tables N] [--seed N] [--only FOLLOWER] [--verbose]
The long run: --count 20 --tables 40.
"""
import argparse
import csv
import json
import math
import random
import subprocess
import sys
import time
import tomllib
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np

PI, TAU = math.pi, 2 * math.pi


# Laws: value and two derivatives by the share x.

def half(a, b, c, d):
    """Velocity and travel of a half by its share: a sine up, a line, a cosine down, rest."""
    peak = 1 / (2 * a / PI + b + 2 * c / PI)

    def run(y):
        phi, travel, slope = np.zeros_like(y), np.zeros_like(y), np.zeros_like(y)
        v = f = start = 0.0
        for kind, width in (("up", a), ("flat", b), ("down", c), ("rest", d)):
            if width == 0:
                continue
            t = np.clip(y - start, 0, width)
            k = PI / 2 / width
            if kind == "up":
                pv, pf, pa = peak / k * (1 - np.cos(k * t)), peak / k * (t - np.sin(k * t) / k), peak * np.sin(k * t)
            elif kind == "flat":
                pv, pf, pa = peak * t, peak * t * t / 2, peak + 0 * t
            elif kind == "down":
                pv, pf, pa = peak / k * np.sin(k * t), peak / k / k * (1 - np.cos(k * t)), peak * np.cos(k * t)
            else:
                pv, pf, pa = 0 * t, 0 * t, 0 * t
            inside = (y >= start - 1e-15) & (y <= start + width + 1e-15)
            phi = np.where(inside, v + pv, phi)
            travel = np.where(inside, f + v * t + pf, travel)
            slope = np.where(inside, pa, slope)
            end = {"up": (peak / k, peak / k * (width - 1 / k)), "flat": (peak * width, peak * width ** 2 / 2),
                   "down": (peak / k, peak / k / k), "rest": (0.0, 0.0)}[kind]
            f, v = f + v * width + end[1], v + end[0]
            start += width
        return phi, travel, slope
    total = float(run(np.array([1.0]))[1][0])
    return run, total


def pair(first, second, lam):
    (h1, m1), (h2, m2) = half(*first), half(*second)
    mu = 1 - lam
    vm = 1 / (lam * m1 + mu * m2)

    def at(x):
        p1, f1, a1 = h1(np.clip(x / lam, 0, 1))
        p2, f2, a2 = h2(np.clip((1 - x) / mu, 0, 1))
        early = x <= lam
        return (np.where(early, vm * lam * f1, 1 - vm * mu * f2), np.where(early, vm * p1, vm * p2),
                np.where(early, vm * a1 / lam, -vm * a2 / mu))
    return at


def polynomial(*coefficients):
    p = np.polynomial.Polynomial(coefficients)
    return lambda x: (p(x), p.deriv()(x), p.deriv(2)(x))


def sines(*terms):
    def at(x):
        s, v, a = x.copy(), np.ones_like(x), np.zeros_like(x)
        for k, b in terms:
            w = TAU * k
            s, v, a = s - b * np.sin(w * x), v - b * w * np.cos(w * x), a + b * w * w * np.sin(w * x)
        return s, v, a
    return at


HALVES = {
    "cycloidal": (0.5, 0, 0.5, 0), "modified-sine": (0.25, 0, 0.75, 0), "modified-trapezoid": (0.25, 0.5, 0.25, 0),
    "modified-sine-cv33": (1 / 6, 0, 1 / 2, 1 / 3), "modified-sine-cv50": (1 / 8, 0, 3 / 8, 1 / 2), "cycloidal-cv50": (0.25, 0, 0.25, 0.5),
}
FIXED = {
    "3-4-5": polynomial(0, 0, 0, 10, -15, 6), "4-5-6-7": polynomial(0, 0, 0, 0, 35, -84, 70, -20),
    "5-6-7-8-9": polynomial(0, 0, 0, 0, 0, 126, -420, 540, -315, 70),
    "gutman-1-3": sines((1, 15 / 32 / PI), (3, 1 / 96 / PI)),
    "freudenstein-1-3": sines((1, 27 / 28 / TAU), (3, 1 / 84 / TAU)),
}


class Motion:
    """Rise, dwell, return, dwell: positions in mm or rad with two derivatives by the angle; every number a draughtsman would write, or any."""

    def __init__(self, rng, lift):
        self.lift = lift
        even = rng.random() < 0.6
        angle = (lambda low, high: float(rng.randint(low, high))) if even else rng.uniform
        self.widths = [angle(70, 125), rng.choice([angle(15, 60), angle(15, 60), 0.0]), angle(70, 125)]
        self.laws = []
        for _ in range(2):
            name = rng.choice(list(HALVES) + list(FIXED))
            lam = 0.5
            if name in HALVES and rng.random() < 0.35:
                lam = round(rng.uniform(0.38, 0.62), 2)
            shape = pair(HALVES[name], HALVES[name], lam) if name in HALVES else FIXED[name]
            self.laws.append((name, lam, shape))

    def at(self, degrees):
        """By the angle from the start of the rise, degrees."""
        x = np.asarray(degrees) % 360
        rise, top, fall = self.widths
        s, v, a = np.zeros_like(x), np.zeros_like(x), np.zeros_like(x)
        up, down = x < rise, (x >= rise + top) & (x < rise + top + fall)
        s = np.where((x >= rise) & (x < rise + top), self.lift, s)
        for where, start, width, sign, base, (_, _, shape) in (
                (up, 0, rise, 1, 0, self.laws[0]), (down, rise + top, fall, -1, self.lift, self.laws[1])):
            share = np.clip((x - start) / width, 0, 1)
            f, g, h = shape(share)
            w = math.radians(width)
            s = np.where(where, base + sign * self.lift * f, s)
            v = np.where(where, sign * self.lift * g / w, v)
            a = np.where(where, sign * self.lift * h / w / w, a)
        return s, v, a

    def peak(self):
        fine = np.linspace(0, 360, 72001)
        return float(np.max(np.abs(self.at(fine)[2])))


# Followers: profile and outward normal (mm) of a cam that turns clockwise.

def direction(angle):
    return np.stack([np.cos(angle), np.sin(angle)], 1), np.stack([-np.sin(angle), np.cos(angle)], 1)


def offset_inwards(centre, speed, radius):
    tangent = speed / np.linalg.norm(speed, axis=1)[:, None]
    normal = np.stack([tangent[:, 1], -tangent[:, 0]], 1)
    return centre - radius * normal, normal


class Roller:
    unit, flag = "mm", "roller"

    def exists(self):
        return True

    def __init__(self, rng, knife=False):
        self.radius = 0.0 if knife else round(rng.uniform(8, 20), 1)
        self.offset = 0.0 if rng.random() < 0.5 else round(rng.uniform(-12, 12), 1)
        self.base = float(rng.randint(45, 80))
        self.lift = round(rng.uniform(5, 22), 1)
        self.knife = knife

    def argument(self):
        if self.knife:
            return f"knife,offset={self.offset}mm"
        return f"roller,radius={self.radius}mm,offset={self.offset}mm"

    def profile(self, angle, s, v):
        u, n = direction(angle)
        height = math.sqrt((self.base + self.radius) ** 2 - self.offset ** 2) + s
        centre = u * height[:, None] + n * self.offset
        speed = u * (v - self.offset)[:, None] + n * height[:, None]
        return offset_inwards(centre, speed, self.radius)


class Flat:
    unit = "mm"

    def exists(self):
        return True

    def __init__(self, rng):
        self.base = float(rng.randint(60, 110))
        self.lift = round(rng.uniform(4, 12), 1)

    def argument(self):
        return "flat"

    def profile(self, angle, s, v):
        u, n = direction(angle)
        return u * (self.base + s)[:, None] + n * v[:, None], u


class SwingingRoller:
    unit = "deg"

    def exists(self):
        """Whether the arm reaches the roller at its lowest place."""
        prime = self.base + self.radius
        return abs(self.pivot - self.arm) < prime < self.pivot + self.arm

    def __init__(self, rng):
        self.radius = round(rng.uniform(8, 18), 1)
        self.arm, self.pivot = float(rng.randint(90, 130)), float(rng.randint(120, 160))
        self.side = rng.choice([1, -1])
        self.base = float(rng.randint(45, 70))
        self.lift = math.radians(round(rng.uniform(5, 14), 1))

    def argument(self):
        side = "trailing" if self.side > 0 else "leading"
        return f"swinging-roller,radius={self.radius}mm,arm={self.arm}mm,pivot_distance={self.pivot}mm,side={side}"

    def profile(self, angle, s, v):
        u, n = direction(angle)
        a, l, prime, t = self.pivot, self.arm, self.base + self.radius, self.side
        psi = math.acos((a * a + l * l - prime * prime) / (2 * a * l)) + s
        c, d = np.cos(psi), np.sin(psi)
        along, across = a - l * c, -l * t * d
        centre = u * along[:, None] + n * across[:, None]
        speed = u * (l * d * v - across)[:, None] + n * (-l * t * c * v + along)[:, None]
        return offset_inwards(centre, speed, self.radius)


class SwingingFlat:
    unit = "deg"

    def exists(self):
        return self.base + self.face < self.pivot

    def __init__(self, rng):
        self.pivot = float(rng.randint(140, 190))
        self.face = round(rng.uniform(-8, 8), 1)
        self.side = rng.choice([1, -1])
        self.base = float(rng.randint(55, 75))
        self.lift = math.radians(round(rng.uniform(3, 7), 1))

    def argument(self):
        side = "trailing" if self.side > 0 else "leading"
        return f"swinging-flat,pivot_distance={self.pivot}mm,face_offset={self.face}mm,side={side}"

    def profile(self, angle, s, v):
        a, f, t = self.pivot, self.face, self.side
        psi = math.asin((self.base + f) / a) + s
        heading = angle + t * (psi - PI / 2)
        normal, along = direction(heading)
        p, q = a * np.sin(psi) - f, a * np.cos(psi) * v / (1 + t * v)
        return normal * p[:, None] + along * q[:, None], normal


FOLLOWERS = {"knife": lambda rng: Roller(rng, True), "roller": Roller, "flat": Flat, "swinging-roller": SwingingRoller, "swinging-flat": SwingingFlat}


def dense(follower, motion, count=72000):
    angle = np.linspace(0, TAU, count, endpoint=False)
    s, v, _ = motion.at(np.degrees(angle))
    return follower.profile(angle, s, v)


def is_sound(follower, motion):
    """Convex enough everywhere: the profile runs forwards and has no sharp place."""
    profile, normal = dense(follower, motion, 3600)
    step = np.roll(profile, -1, 0) - profile
    tangent = np.stack([-normal[:, 1], normal[:, 0]], 1)
    speed = np.sum(step * tangent, 1)
    turn = np.arctan2(normal[:, 0] * np.roll(normal, -1, 0)[:, 1] - normal[:, 1] * np.roll(normal, -1, 0)[:, 0],
                      np.sum(normal * np.roll(normal, -1, 0), 1))
    radius = speed / np.where(np.abs(turn) < 1e-9, 1e-9, turn)
    return np.min(speed) > 0.02 and np.min(np.where(radius > 0, radius, 1e9)) > 4


def camgen(binary, *words):
    start = time.perf_counter()
    run = subprocess.run([binary, *map(str, words)], capture_output=True, text=True)
    return run, time.perf_counter() - start


def nearest(exact, normal, points):
    """Distances of points from a dense closed curve along its normal, mm: from the polar angle along the curve to the foot."""
    polar = np.arctan2(exact[:, 1], exact[:, 0])
    order = np.argsort(polar)
    at = order[np.searchsorted(polar[order], np.arctan2(points[:, 1], points[:, 0])) % len(order)]
    step = np.linalg.norm(np.roll(exact, -1, 0) - exact, axis=1)
    for _ in range(30):
        tangent = np.stack([-normal[at][:, 1], normal[at][:, 0]], 1)
        ahead = np.sum((points - exact[at]) * tangent, 1) / np.maximum(step[at], 1e-6)
        at = (at + np.clip(np.rint(0.7 * ahead), -400, 400).astype(int)) % len(exact)
    return np.sum((points - exact[at]) * normal[at], 1), at


def off_after_fit(exact, normal, points, centre):
    """The largest distance after the turn, and shift, that fit best."""
    moved = points.copy()
    for _ in range(6):
        off, at = nearest(exact, normal, moved)
        n = normal[at]
        columns = [n[:, 1] * moved[:, 0] - n[:, 0] * moved[:, 1]]
        columns += [n[:, 0], n[:, 1]] if centre else []
        step, *_ = np.linalg.lstsq(np.stack(columns, 1), -off, rcond=None)
        c, s = math.cos(step[0]), math.sin(step[0])
        moved = moved @ np.array([[c, s], [-s, c]]) + (step[1:] if centre else 0)
    off, _ = nearest(exact, normal, moved)
    return float(np.max(np.abs(off)))


def check_points(binary, folder, kind, seed):
    rng = random.Random(f"{kind} {seed}")
    noise = np.random.default_rng(rng.randrange(2 ** 32))
    while True:
        follower = FOLLOWERS[kind](rng)
        motion = Motion(rng, follower.lift)
        if follower.exists() and is_sound(follower, motion):
            break
    count = rng.choice([720, 1000, 1440])
    angle = np.linspace(0, TAU, count, endpoint=False)
    s, v, _ = motion.at(np.degrees(angle))
    profile, normal = follower.profile(angle, s, v)
    ball = rng.choice([0.0, 0.0, 1.0, 2.5])
    points = profile + normal * (ball + noise.normal(0, 1e-3, count))[:, None]
    turn = rng.uniform(0, TAU)
    shifted = rng.random() < 1 / 3
    shift = np.array([rng.uniform(-0.4, 0.4), rng.uniform(-0.4, 0.4)]) if shifted else np.zeros(2)
    c, d = math.cos(turn), math.sin(turn)
    points = points @ np.array([[c, d], [-d, c]]) + shift
    stem = f"{kind}-{seed}"
    table = folder / f"{stem}.csv"
    order = list(range(count))
    table.write_text("x_mm,y_mm\n" + "\n".join(f"{points[i, 0]:.6f},{points[i, 1]:.6f}" for i in order) + "\n")
    words = ["import", table, "--from", "points", "--follower", follower.argument(), "--out", folder, "--name", stem, "--overwrite",
             "--format", "toml", "--json", "--set", "limits.pressure_angle=85 deg", "--set", "limits.min_convex_pitch_radius_over_roller=0"]
    words += ["--ball", f"{ball}mm"] if ball else []
    words += ["--fit", "centre"] if shifted else []
    run, _ = camgen(binary, *words)
    where = f"{stem} {[law[:2] for law in motion.laws]} {motion.widths}"
    if run.returncode != 0:
        return f"{where}: exit {run.returncode}: {run.stderr[:300]}"
    section = json.loads(run.stdout)["import"]
    moving = [segment for segment in section["segments"] if segment["law"] != "dwell"]
    names = [segment["law"] for segment in moving]
    wanted = [law[0] for law in motion.laws]
    if names != wanted:
        return f"{where}: found {names}: {[segment['others'] for segment in moving]}"
    for segment, (_, lam, _) in zip(moving, motion.laws):
        found = segment.get("inflection", 0.5)
        if abs(found - lam) > 0.01:
            return f"{where}: inflection {found} instead of {lam}"
    run, _ = camgen(binary, "make", folder / f"{stem}.toml", "--format", "csv", "--out", folder, "--name", f"{stem}-made", "--overwrite", "--samples", 1440,
                    "--force", "--quiet")
    made = folder / f"{stem}-made.csv"
    if not made.exists():
        return f"{where}: no table: {run.stderr[:300]}"
    with made.open() as file:
        cut = np.array([[float(row["profile_x_mm"]), float(row["profile_y_mm"])] for row in csv.DictReader(file)])
    exact, exact_normal = dense(follower, motion)
    off = off_after_fit(exact, exact_normal, cut, shifted)
    # The table that camgen makes has the path of the roller's centre beside the profile; only the profile is read.
    run, _ = camgen(binary, "import", made, "--from", "points", "--follower", follower.argument(), "--json", "--dry-run")
    if run.returncode != 0:
        return f"{where}: its own table: exit {run.returncode}: {run.stderr[:300]}"
    radii = [json.loads(run.stdout)["import"]["base_radius_mm"], section["base_radius_mm"]]
    made.unlink()
    if abs(radii[0] - radii[1]) > 3e-3:
        return f"{where}: base radius {radii[0]} mm of its own table, {radii[1]} mm of the points"
    if off > 3e-3:
        return f"{where}: the profile is off by {1e3 * off:.2f} um ({'shifted, ' if shifted else ''}{count} points)"
    return off


def check_table(binary, folder, seed):
    rng = random.Random(f"table {seed}")
    motion = Motion(rng, round(rng.uniform(8, 30), 1))
    motion.widths = [round(width) for width in motion.widths]
    start = rng.randint(0, 359)
    rows = [(degree, round(float(motion.at(np.array([degree - start]))[0][0]), 2)) for degree in range(360)]
    table = folder / f"table-{seed}.csv"
    table.write_text("angle_deg;lift_mm\n" + "\n".join(f"{a};{s:.2f}" for a, s in rows) + "\n")
    run, _ = camgen(binary, "import", table, "--follower", "roller,diameter=20mm", "--out", folder, "--format", "toml", "--overwrite", "--json")
    where = f"table {seed} {[law[:2] for law in motion.laws]} lift {motion.lift} over {motion.widths}"
    if run.returncode != 0:
        return f"{where}: exit {run.returncode}: {run.stderr[:300]}"
    section = json.loads(run.stdout)["import"]
    moving = [segment for segment in section["segments"] if segment["law"] != "dwell"]
    names, wanted = [segment["law"] for segment in moving], [law[0] for law in motion.laws]
    if names != wanted:
        return f"{where}: found {names}: {[segment['others'] for segment in moving]}"
    ratio = section["largest_acceleration_per_rad2"] / motion.peak()
    if abs(ratio - 1) > 0.05:
        return f"{where}: largest acceleration {ratio:.3f} times the right one"
    return ratio


def public_tables():
    """Tables like those that are passed on: valve lifts with ramps, a feed that was drawn by hand, a harmonic sum; mm by the degree of the cam."""
    rng = np.random.default_rng(12)

    # A nose and flanks of the form 2-6-10-14, which meets a ramp of constant velocity without a step of acceleration, and a parabola to the base circle.
    exponents, half, height, velocity = np.array([2, 6, 10, 14]), 62.0, 9.2, 0.02
    rows = [exponents ** 0, exponents, exponents * (exponents - 1), exponents * (exponents - 1) * (exponents - 2)]
    shares = np.linalg.solve(np.array(rows, float), [-1, -velocity * half / height, 0, 0])

    def lobe(degree):
        away = np.abs(((degree + 180) % 360) - 180)
        x = np.minimum(away / half, 1)
        main = height * (1 + sum(c * x ** e for c, e in zip(shares, exponents)))
        ramp = np.clip(away - half, 0, 10)
        end = np.clip(away - half - 10, 0, 16)
        foot = velocity * (10 + 8)
        return main + foot - velocity * ramp - velocity * (end - end ** 2 / 32)

    def feed(degree):
        t = np.radians(degree)
        return 14 * (1 - np.cos(t)) / 2 + 2.1 * np.sin(t) ** 3 + 1.2 * (1 - np.cos(2 * t)) / 2

    def needle(degree):
        t = np.radians(degree)
        return 6 + 4 * np.sin(t) + 1.4 * np.cos(2 * t + 0.6) + 0.3 * np.sin(3 * t)
    return [("valve", 1.0, 3e-3, lobe, rng), ("feed", 2.0, 5e-3, feed, rng), ("needle", 2.5, 10e-3, needle, rng)]


def smoothest(degrees, values, deviation):
    """Largest acceleration of the periodic curve of least squared jerk within a deviation of rows, on a grid of fine differences."""
    count, fine = len(values), 4
    n = count * fine
    h = math.radians(degrees) / fine
    shift = lambda k: np.roll(np.eye(n), k, 1)
    third = (-shift(-1) + 3 * np.eye(n) - 3 * shift(1) + shift(2)) / h ** 3
    energy = third.T @ third
    energy /= np.mean(np.diag(energy))
    chosen = np.arange(count) * fine
    # Alternating directions: the curve of least jerk near targets, and targets within the deviation.
    rho = 1e-3
    whole = energy.copy()
    whole[chosen, chosen] += rho
    spread = np.linalg.solve(whole, rho * np.eye(n)[:, chosen])
    near = spread[chosen]
    target, dual = values.copy(), np.zeros(count)
    for _ in range(20000):
        at = near @ (target - dual)
        target = np.clip(at + dual, values - deviation, values + deviation)
        dual = dual + at - target
    curve = spread @ (target - dual)
    off = float(np.max(np.abs(curve[chosen] - values)))
    assert off < 1.02 * deviation, f"the smoothest curve is not found: {off} of {deviation}"
    second = (np.roll(curve, -1) - 2 * curve + np.roll(curve, 1)) / h ** 2
    return float(np.max(np.abs(second)))


def check_public(binary, folder):
    faults, told = [], []
    for name, step, size, shape, rng in public_tables():
        degrees = np.arange(0, 360, step)
        values = shape(degrees) + rng.uniform(-size, size, len(degrees))
        table = folder / f"{name}.csv"
        table.write_text("angle_deg,lift_mm\n" + "\n".join(f"{a:g},{s:.4f}" for a, s in zip(degrees, values)) + "\n")
        run, _ = camgen(binary, "import", table, "--follower", "roller,diameter=20mm", "--out", folder, "--format", "toml", "--overwrite", "--json",
                        "--deviation", f"{1.0 * size}mm")
        if run.returncode != 0:
            faults.append(f"{name}: exit {run.returncode}: {run.stderr[:300]}")
            continue
        section = json.loads(run.stdout)["import"]
        least = smoothest(step, np.round(values, 4), size)
        ratio = section["largest_acceleration_per_rad2"] / least
        told.append(f"{name} {ratio:.3f}")
        if ratio > 1.3:
            faults.append(f"{name}: largest acceleration {section['largest_acceleration_per_rad2']:.2f}, {ratio:.3f} times that of the smoothest curve")
        if not tomllib.loads((folder / f"{name}-import.toml").read_text()).get("motion"):
            faults.append(f"{name}: no motion in the design")
    return faults, told


def long_table(binary, folder):
    motion = Motion(random.Random(5), 20.0)
    degrees = np.arange(0, 360, 0.1)
    values = motion.at(degrees)[0]
    table = folder / "long.csv"
    table.write_text("deg,mm\n" + "\n".join(f"{a:.1f},{s:.6f}" for a, s in zip(degrees, values)) + "\n")
    times = []
    for _ in range(5):
        run, seconds = camgen(binary, "import", table, "--follower", "roller,diameter=20mm", "--out", folder, "--format", "toml", "--overwrite", "--quiet")
        times.append(seconds)
    return run.returncode, min(times)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("binary")
    parser.add_argument("directory")
    parser.add_argument("--count", type=int, default=3)
    parser.add_argument("--tables", type=int, default=8)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only")
    parser.add_argument("--verbose", action="store_true")
    given = parser.parse_args()
    folder = Path(given.directory) / "importing"
    folder.mkdir(parents=True, exist_ok=True)
    faults = []
    kinds = [given.only] if given.only else list(FOLLOWERS)
    with ThreadPoolExecutor(2) as pool:
        for kind in kinds:
            if kind not in FOLLOWERS:
                continue
            found = list(pool.map(lambda seed: check_points(given.binary, folder, kind, seed), range(given.seed, given.seed + given.count)))
            wrong = [one for one in found if isinstance(one, str)]
            good = [one for one in found if not isinstance(one, str)]
            faults += wrong
            print(f"{kind}: {len(good)} of {len(found)} cams with 1 um of noise have their laws, the profile within {1e3 * max(good, default=0):.2f} um")
        if given.only in (None, "tables"):
            found = list(pool.map(lambda seed: check_table(given.binary, folder, seed), range(given.seed, given.seed + given.tables)))
            wrong = [one for one in found if isinstance(one, str)]
            good = [abs(one - 1) for one in found if not isinstance(one, str)]
            faults += wrong
            print(f"tables: {len(good)} of {len(found)} rounded to 0.01 mm at 1 deg have their laws, the largest acceleration within {100 * max(good, default=0):.2f} %")
    if given.only in (None, "public"):
        wrong, told = check_public(given.binary, folder)
        faults += wrong
        print(f"tables as people have them, largest acceleration over that of the smoothest curve: {', '.join(told)}")
    if given.only in (None, "long"):
        code, seconds = long_table(given.binary, folder)
        print(f"3600 rows: {1e3 * seconds:.0f} ms")
        if code != 0:
            faults.append(f"3600 rows: exit {code}")
    for fault in faults:
        print(f"FAIL {fault}")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
