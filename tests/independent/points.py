"""Tables of points, interpolated as their own heads say, against exact curves of a program of its own.

Shares nothing with camgen but the machine file and the chosen prime radius: the law and the path of the roller are those of
disc.py, the profile and the path of a cutter's centre their parallels, sampled so finely that its chords are a thousandth of the
tolerance off. The file is read as a control would read it: rows, and the interpolation that its head names. The largest distance,
both ways, must keep the tolerance and what the head tells, and must not be far below it.

A roller on a straight path is put on the curve that the control makes: C = (h + iε) exp(iθ) with n·C' = 0 and n·C'' = −κ|C'|²
gives velocity and acceleration, n and κ of the parallel of that curve. Their largest errors must be what the head tells, to 1e-3,
and no more than was asked for.

usage: points.py CAMGEN_BINARY DIRECTORY [--count N] [--seed N]
"""
import argparse
import itertools
import json
import math
import random
import subprocess
import sys
from pathlib import Path

import numpy as np
from disc import Disc

# Places of the exact curve on each piece of the law, of the interpolated one in an interval and in a turn, neighbours looked at.
FINE, LEAST, TURN, NEAR = 12000, 16, 60000, 40
# Intervals with errors above that share of the largest, and not more, are looked at closely.
NEARLY, LOOKED_AT = 0.9, 20
# Places in a turn of the law, and in an interval where an error is largest.
PLACES, CLOSE = 1_000_000, 20_000
# So near to the end of an interval, as a share of it, a jump of the acceleration is at the end.
AT_END = 1e-3
# A place at the end of an interval is that share within it.
HAIR = 1e-8
# Chords of the exact curve and rounding, mm, beside the distance itself.
CHORDS = 3e-6


def machine(rng, jumps):
    """A disc under the press that every limit lets pass, as disc.py takes it, and the keys that say so; one whose acceleration jumps."""
    m = dict(
        mass=978.2, r=0.18, k=rng.uniform(1.25, 1.4), q=rng.uniform(1.5, 2.6), column=rng.choice(["matched", "matched", "return"]),
        lead=0.0, kind=rng.choice(["run-up", "run-up", "blend"]), width=math.radians(rng.uniform(10, 35)),
        roller=rng.uniform(0.015, 0.035), offset=rng.choice([0.0, rng.uniform(-0.015, 0.015)]), lever=rng.uniform(0.6, 1.1),
        lobes=rng.choice([1, 1, 1, 2, 3]), ccw=rng.random() < 0.4, bore=0.02, preload=None, follower_mass=None,
    )
    mm = lambda v: f"{v * 1e3!r}mm"
    if jumps:
        m.update(kind="none", column="matched")
    keys = {
        "bed.mass": f"{m['mass']!r}kg", "bed.crank_radius": mm(m["r"]), "buffer.polytropic_exponent": repr(m["k"]),
        "buffer.end_pressure": f"{m['q']!r}at", "buffer.column": m["column"], "buffer.ambient_pressure": "1at",
        "transition.kind": m["kind"], "transition.width": f"{m['width']!r}rad", "follower.roller.radius": mm(m["roller"]),
        "follower.roller.offset": mm(m["offset"]), "cam.lever": repr(m["lever"]), "cam.bore_radius": mm(m["bore"]),
        "cam.cam_turns_per_crank_turn": repr(1 / m["lobes"]), "cam.rotation": "ccw" if m["ccw"] else "cw",
    }
    return m, [word for key, value in keys.items() for word in ("--set", f"{key}={value}")]


def exact(disc, inwards):
    """The parallel of the roller's path so far inwards, mm, once round from any start, of a clockwise cam."""
    law, n = disc.law, disc.n
    pieces = []
    for low, high, sense, f in law.each():
        p = low + (high - low) * np.linspace(0, 1, FINE)
        lift, v, _ = disc.jet(f(p))
        pieces.append((p if sense > 0 else math.pi - p, lift, v))
    rest = np.linspace(math.pi - law.first, 2 * math.pi + law.first, FINE)
    zero = np.zeros_like(rest)
    lift, v, _ = disc.jet((zero + law.dwell, zero, zero))
    pieces.append((rest, lift, v))
    phi, lift, v = (np.concatenate(part) for part in zip(*pieces))
    order = np.argsort(phi % (2 * math.pi), kind="stable")
    theta = np.concatenate([(phi[order] % (2 * math.pi) + 2 * math.pi * lobe) / n for lobe in range(n)])
    lift, v = np.tile(lift[order], n), np.tile(v[order], n)
    along = np.exp(1j * theta)
    centre = (disc.height + lift + 1j * disc.eps) * along
    tangent = (v - disc.eps + 1j * (disc.height + lift)) * along
    curve = 1e3 * (centre + 1j * tangent / np.abs(tangent) * inwards)
    return curve[np.concatenate([[True], np.abs(np.diff(curve)) > 1e-9])]


def law_of(disc):
    """Velocity and acceleration of the lift by the cam angle, mm."""
    pieces, n = [], disc.n
    for low, high, sense, f in disc.law.each():
        start, end = (low, high) if sense > 0 else (math.pi - high, math.pi - low)
        pieces.append((start / n, end / n, sense, f))
    first = min(start for start, *_ in pieces)

    def law(theta):
        inside = first + (theta - first) % (2 * math.pi / n)
        v, a = np.zeros_like(theta), np.zeros_like(theta)
        for start, end, sense, f in pieces:
            here = (start <= inside) & (inside < end)
            phi = n * inside[here]
            _, v[here], a[here] = disc.jet(f(phi if sense > 0 else math.pi - phi))
        return 1e3 * v, 1e3 * a

    return law


def second_derivatives(knots, values, periodic):
    """Of the cubic spline at its knots by the full matrix of its conditions: periodic, or not-a-knot at both ends."""
    h, n = np.diff(knots), len(knots) - 1
    slope = np.diff(values) / h
    if periodic:
        matrix = np.zeros((n, n))
        for i in range(n):
            matrix[i, (i - 1) % n] += h[i - 1]
            matrix[i, i] += 2 * (h[i - 1] + h[i])
            matrix[i, (i + 1) % n] += h[i]
        second = np.linalg.solve(matrix, 6 * (slope - np.roll(slope, 1)))
        return np.append(second, second[0])
    if n < 3:
        # A line, or a parabola.
        return np.full(n + 1, 0.0 if n == 1 else 2 * (slope[1] - slope[0]) / (h[0] + h[1]))
    matrix, right = np.zeros((n + 1, n + 1)), np.zeros(n + 1)
    for i in range(1, n):
        matrix[i, i - 1:i + 2] = h[i - 1], 2 * (h[i - 1] + h[i]), h[i]
        right[i] = 6 * (slope[i] - slope[i - 1])
    matrix[0, :3] = h[1], -(h[0] + h[1]), h[0]
    matrix[n, -3:] = h[-1], -(h[-2] + h[-1]), h[-2]
    return np.linalg.solve(matrix, right)


def evenly(knots):
    """Places in each interval that has a length."""
    h = np.diff(knots)
    return LEAST + np.ceil(TURN * h[h > 0] / (knots[-1] - knots[0])).astype(int)


def between(knots, values, way, counts):
    """Value, first and second derivative at so many places of each interval, up to a hair from its ends."""
    double = np.flatnonzero((np.diff(knots) == 0) & (np.diff(values) == 0))
    bounds = np.concatenate([[0], double + 1, [len(knots)]])
    runs = [slice(low, high) for low, high in zip(bounds[:-1], bounds[1:]) if high - low > 1]
    parts, done = [[], [], []], 0
    for run in runs:
        x, y = knots[run], values[run]
        h = np.diff(x)
        count, done = counts[done:done + len(h)], done + len(h)
        which = np.repeat(np.arange(len(h)), count)
        t = (np.arange(len(which)) - np.repeat(np.cumsum(count) - count, count)) / (count[which] - 1)
        t = HAIR + (1 - 2 * HAIR) * t
        a, b, h = y[which], y[which + 1], h[which]
        m = np.zeros(len(x)) if way == "linear" else second_derivatives(x, y, len(runs) == 1 and len(double) == 0)
        p, q = m[which], m[which + 1]
        parts[0].append(a + (b - a) * t + (((1 - t) ** 3 - (1 - t)) * p + (t**3 - t) * q) * h * h / 6)
        parts[1].append((b - a) / h + ((1 - 3 * (1 - t) ** 2) * p + (3 * t**2 - 1) * q) * h / 6)
        parts[2].append((1 - t) * p + t * q)
    return [np.concatenate(part) for part in parts]


def read(path):
    """Head, rows and the curve that a control makes of them, as complex numbers."""
    lines = Path(path).read_text().splitlines()
    head = dict(line[2:].split(": ", 1) for line in lines if line.startswith("# "))
    rest = [line for line in lines if not line.startswith("#")]
    rows = np.array([[float(cell) for cell in line.split(",")] for line in rest[1:]])
    assert all("e" not in cell for line in rest[1:] for cell in line), "an exponent"
    assert head["closed"].startswith("yes") and head["corners"] == "none", head
    assert int(head["rows"]) == len(rows)
    return head, rest[0], rows


def curve(columns, rows, way, counts=evenly):
    """Points, first and second derivatives of what the control makes, at so many places of each interval by its knots."""
    if columns == "cam_deg,radius_mm":
        angle = np.radians(rows[:, 0])
        counts = counts(angle)
        (r, r1, r2), phi = between(angle, rows[:, 1], way, counts), between(angle, angle, "linear", counts)[0]
        assert len(phi) == len(r)
        along = np.exp(1j * phi)
        return r * along, (r1 + 1j * r) * along, (r2 - r + 2j * r1) * along
    assert columns == "x_mm,y_mm", columns
    s = np.concatenate([[0], np.cumsum(np.hypot(*np.diff(rows, axis=0).T))])
    counts = counts(s)
    return [x + 1j * y for x, y in zip(between(s, rows[:, 0], way, counts), between(s, rows[:, 1], way, counts))]


def felt(disc, law, made, out, counts):
    """Errors of velocity and acceleration of a roller whose centre is so far out of the curve, mm, κ by n·C''."""
    point, first, second = made
    speed = np.abs(first)
    normal, curvature = -1j * first / speed, (first.conj() * second).imag / speed**3
    centre, curvature = point + normal * out, curvature / (1 + curvature * out)
    eps = 1e3 * disc.eps
    h = np.sqrt(np.abs(centre) ** 2 - eps**2)
    theta = np.angle(centre) - np.arctan2(eps, h)
    turned = normal * np.exp(-1j * theta)
    h1 = eps - h * turned.imag / turned.real
    h2 = h - (turned.imag * (2 * h1 - eps) + curvature * ((h1 - eps) ** 2 + h**2)) / turned.real
    v, a = law(on_own_side(theta, counts, disc.n) if disc.m["kind"] == "none" else theta)
    return np.abs([h1 - v, h2 - a])


def on_own_side(theta, counts, lobes):
    """The jumps of the acceleration, at crank angles 0 and π, come a little early or late: an interval that ends there is held
    against the law on its own side."""
    ends = np.cumsum(counts)
    middle, last, first = (np.repeat(theta[index], counts) for index in (ends - counts // 2 - 1, ends - 1, ends - counts))
    turn = lambda angle: (lobes * angle + math.pi) % (2 * math.pi) - math.pi
    within = (lobes * middle) % (2 * math.pi)
    start = math.pi * np.floor(within / math.pi)
    at = within + turn(theta - middle)
    held = np.clip(at, start + 1e-9, start + math.pi - 1e-9)
    near = np.abs(at - held) < AT_END * np.abs(turn(last - first))
    return np.where(near, held / lobes, theta)


def largest(disc, law, columns, rows, way, out):
    """The largest errors: of all intervals, and close up of those where they are found, since the third derivative of the law
    may jump within."""
    knots = np.radians(rows[:, 0]) if columns == "cam_deg,radius_mm" else np.append(0, np.cumsum(np.hypot(*np.diff(rows, axis=0).T)))
    counts = evenly(knots)
    errors = felt(disc, law, curve(columns, rows, way), out, counts)
    found = []
    for error in errors:
        worst = np.maximum.reduceat(error, np.cumsum(counts) - counts)
        close = np.where(worst > NEARLY * worst.max(), CLOSE, 3)
        # An error that is the same everywhere needs no closer look everywhere.
        close[np.argsort(worst)[:-LOOKED_AT]] = 3
        found.append(felt(disc, law, curve(columns, rows, way, lambda _: close), out, close)[len(found)].max())
    return found


def sagitta(exact, made):
    """How far the chords of one curve lie off it, by the largest curvature of the other, mm."""
    step = np.diff(exact)
    length = np.abs(step)
    bend = np.abs(np.angle(step[1:] / step[:-1])) / np.minimum(length[1:], length[:-1])
    curvature = np.quantile(bend[np.minimum(length[1:], length[:-1]) > 1e-5], 0.9999)
    return curvature * np.abs(np.diff(made)).max() ** 2 / 8


def farthest(points, chain):
    """Largest distance of points from a closed chain of chords, both once round the shaft."""
    chain = chain[np.argsort(np.angle(chain))]
    at = np.searchsorted(np.angle(chain), np.angle(points))
    best = np.full(len(points), np.inf)
    for step in range(-NEAR, NEAR):
        a, b = chain[(at + step) % len(chain)], chain[(at + step + 1) % len(chain)]
        chord = b - a
        t = np.clip(((points - a) * chord.conj()).real / np.maximum(np.abs(chord) ** 2, 1e-300), 0, 1)
        best = np.minimum(best, np.abs(points - a - t * chord))
    return best.max()


def agrees(head, name, unit, found, asked):
    """Whether an error is what the head tells, to 1e-3, and no more than was asked for."""
    told = float(head[f"{name}_error_{unit}"])
    if asked is not None:
        limit = float(head[f"{name}_tolerance_{unit}"])
        # The largest rate of the law is that of places.
        if not (abs(limit / asked - 1) < 1e-3 and told <= limit * (1 + 1e-6) and name in head["keeps"]):
            return False
    return abs(found - told) <= 1e-3 * told + 1e-9


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("binary"), parser.add_argument("directory")
    parser.add_argument("--count", type=int, default=20), parser.add_argument("--seed", type=int, default=14)
    args = parser.parse_args()
    binary, directory = str(Path(args.binary).resolve()), Path(args.directory) / "points"
    directory.mkdir(parents=True, exist_ok=True)
    rng = random.Random(args.seed)
    passed, failed, discs, doubles, shares = 0, 0, 0, 0, []
    ways = list(itertools.product(("profile", "centre", "cutter"), ("polar", "xy"), ("angle", "chord"), ("linear", "cubic")))
    while discs < args.count:
        m, keys = machine(rng, discs % 4 == 3)
        # Of velocity and acceleration, as shares of the largest.
        shares_asked = rng.choice([(None, 0.05), (0.002, 0.02), (None, 0.01)])
        cutter, tolerance = rng.choice([0.004, 0.008]), rng.choice([0.005, 0.02, 0.001])
        curves = {}
        refused = False
        for of, form, step, way in ways:
            command = [binary, "rotary", *keys, "--json", "--out", str(directory), "--name", "table", "--format", "points"]
            command += ["--cutter-diameter", f"{2 * cutter!r}m"] if of == "cutter" else []
            command += ["--tolerance", f"{tolerance!r}mm", "--points-of", of, "--points-as", form]
            command += ["--points-step", step, "--points-between", way]
            velocity, acceleration = shares_asked
            if way == "linear":
                velocity, acceleration = rng.choice([None, 0.01]), None
            command += ["--tolerance-velocity", f"{100 * velocity}%"] if velocity else []
            command += ["--tolerance-acceleration", f"{100 * acceleration}%" if acceleration else "none"]
            run = subprocess.run(command, capture_output=True, text=True)
            if run.returncode == 1 or "turns back" in run.stderr:
                refused = True
                break
            assert run.returncode == 0, f"{' '.join(command)}\n{run.stderr}{run.stdout}"
            report = json.loads(run.stdout)
            if of not in curves:
                disc = Disc(m, 35, 1e-3 * report["cam"]["prime_radius_mm"])
                inwards = {"profile": disc.rf, "centre": 0.0, "cutter": disc.rf - cutter}
                curves[of], law = exact(disc, inwards[of]), law_of(disc)
                most_v, most_a = (np.abs(rate).max() for rate in law(np.linspace(0, 2 * math.pi, PLACES)))
            found = [name for name in report["files"] if name.endswith("-points.csv")]
            head, columns, rows = read(found[0])
            assert head["interpolation"].split(",")[0] == way, head
            turned = rows * [1, -1] if m["ccw"] and form == "xy" else rows
            made = curve(columns, turned, way)[0]
            off = max(farthest(made, curves[of]), farthest(curves[of], made))
            told = float(head["error_mm"])
            # A row moved by three tolerances is seen.
            moved = turned.copy()
            other = (np.diff(rows, axis=0) != 0).any(axis=1)
            single = 1 + np.flatnonzero(other[:-1] & other[1:])
            third = single[len(single) // 3]
            moved[third] *= 1 + 3 * tolerance / np.hypot(*moved[third]) * np.array([form == "xy", 1])
            seen = farthest(curve(columns, moved, way)[0], curves[of]) > tolerance
            even = form == "xy" or step == "chord" or "jumps" in head or np.ptp(np.diff(rows[:, 0])) < 1e-10
            slack = CHORDS + sagitta(curves[of], made)
            good = off <= told + slack and told <= tolerance and off >= 0.98 * told - slack and seen and even
            v, a = largest(disc, law, columns, turned, way, 1e3 * inwards[of])
            felt_as_told = agrees(head, "velocity", "mm_per_rad", v, velocity and velocity * most_v)
            if way == "cubic":
                felt_as_told &= agrees(head, "acceleration", "mm_per_rad2", a, acceleration and acceleration * most_a)
            else:
                felt_as_told &= "acceleration" in head["not_kept"] and "acceleration_error_mm_per_rad2" not in head
            good &= felt_as_told
            doubles += "jumps" in head
            shares.append(told / tolerance)
            passed, failed = passed + good, failed + (not good)
            if not good:
                print(f"FAILED {of} {form} {step} {way}: {off} mm, told {told}, tolerance {tolerance}; felt {v} {a}, "
                      f"asked {shares_asked} of {most_v} {most_a}: {head}; {' '.join(keys)}")
        discs += not refused
    print(f"{discs} discs: {passed} tables passed, {failed} failed; told {np.mean(shares):.3f} of the tolerance in the mean; "
          f"{doubles} with rows that stand twice")
    sys.exit(failed > 0)


main()
