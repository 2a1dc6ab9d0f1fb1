"""Tables of points, interpolated as their own heads say, against exact curves of a program of its own.

Shares nothing with camgen but the machine file and the chosen prime radius: the law and the path of the roller are those of
disc.py, the profile and the path of a cutter's centre their parallels, sampled so finely that its chords are a thousandth of the
tolerance off. The file is read as a control would read it: rows, and the interpolation that its head names. The largest distance,
both ways, must keep the tolerance and what the head tells, and must not be far below it.

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
# Chords of the exact curve and rounding, mm, beside the distance itself.
CHORDS = 3e-6


def machine(rng):
    """A disc under the press that every limit lets pass, as disc.py takes it, and the keys that say so."""
    m = dict(
        mass=978.2, r=0.18, k=rng.uniform(1.25, 1.4), q=rng.uniform(1.5, 2.6), column=rng.choice(["matched", "matched", "return"]),
        lead=0.0, kind=rng.choice(["run-up", "run-up", "blend"]), width=math.radians(rng.uniform(10, 35)),
        roller=rng.uniform(0.015, 0.035), offset=rng.choice([0.0, rng.uniform(-0.015, 0.015)]), lever=rng.uniform(0.6, 1.1),
        lobes=rng.choice([1, 1, 1, 2, 3]), ccw=rng.random() < 0.4, bore=0.02, preload=None, follower_mass=None,
    )
    mm = lambda v: f"{v * 1e3!r}mm"
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


def second_derivatives(knots, values):
    """Of the periodic cubic spline at its knots but the last, by the full matrix of its conditions."""
    h, n = np.diff(knots), len(knots) - 1
    slope = np.diff(values) / h
    matrix = np.zeros((n, n))
    for i in range(n):
        matrix[i, (i - 1) % n] += h[i - 1]
        matrix[i, i] += 2 * (h[i - 1] + h[i])
        matrix[i, (i + 1) % n] += h[i]
    second = np.linalg.solve(matrix, 6 * (slope - np.roll(slope, 1)))
    return np.append(second, second[0])


def between(knots, values, way):
    """Values at many places of each interval."""
    h = np.diff(knots)
    count = LEAST + np.ceil(TURN * h / (knots[-1] - knots[0])).astype(int)
    which = np.repeat(np.arange(len(h)), count)
    t = (np.arange(len(which)) - np.repeat(np.cumsum(count) - count, count)) / count[which]
    a, b, h = values[which], values[which + 1], h[which]
    straight = a + (b - a) * t
    if way == "linear":
        return straight
    m = second_derivatives(knots, values)
    bend = ((1 - t) ** 3 - (1 - t)) * m[which] + (t**3 - t) * m[which + 1]
    return straight + bend * h * h / 6


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


def curve(columns, rows, way):
    if columns == "cam_deg,radius_mm":
        angle = np.radians(rows[:, 0])
        radius = between(angle, rows[:, 1], way)
        return radius * np.exp(1j * between(angle, angle, "linear"))
    assert columns == "x_mm,y_mm", columns
    s = np.concatenate([[0], np.cumsum(np.hypot(*np.diff(rows, axis=0).T))])
    return between(s, rows[:, 0], way) + 1j * between(s, rows[:, 1], way)


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


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("binary"), parser.add_argument("directory")
    parser.add_argument("--count", type=int, default=20), parser.add_argument("--seed", type=int, default=14)
    args = parser.parse_args()
    binary, directory = str(Path(args.binary).resolve()), Path(args.directory) / "points"
    directory.mkdir(parents=True, exist_ok=True)
    rng = random.Random(args.seed)
    passed, failed, discs, shares = 0, 0, 0, []
    ways = list(itertools.product(("profile", "centre", "cutter"), ("polar", "xy"), ("angle", "chord"), ("linear", "cubic")))
    while discs < args.count:
        m, keys = machine(rng)
        cutter, tolerance = rng.choice([0.004, 0.008]), rng.choice([0.005, 0.02, 0.001])
        curves = {}
        refused = False
        for of, form, step, way in ways:
            command = [binary, "rotary", *keys, "--json", "--out", str(directory), "--name", "table", "--format", "points"]
            command += ["--cutter", f"{cutter!r}m", "--tolerance", f"{tolerance!r}mm", "--points-of", of, "--points-as", form]
            run = subprocess.run([*command, "--points-step", step, "--points-between", way], capture_output=True, text=True)
            if run.returncode == 1 or "turns back" in run.stderr:
                refused = True
                break
            assert run.returncode == 0, f"{' '.join(command)}\n{run.stderr}{run.stdout}"
            report = json.loads(run.stdout)
            if of not in curves:
                disc = Disc(m, 35, 1e-3 * report["cam"]["prime_radius_mm"])
                curves[of] = exact(disc, {"profile": disc.rf, "centre": 0.0, "cutter": disc.rf - cutter}[of])
            found = [name for name in report["files"] if name.endswith("-points.csv")]
            head, columns, rows = read(found[0])
            assert head["interpolation"].split(",")[0] == way, head
            turned = rows * [1, -1] if m["ccw"] and form == "xy" else rows
            made = curve(columns, turned, way)
            off = max(farthest(made, curves[of]), farthest(curves[of], made))
            told = float(head["error_mm"])
            # A row moved by three tolerances is seen.
            moved = turned.copy()
            moved[len(rows) // 3] *= 1 + 3 * tolerance / np.hypot(*moved[len(rows) // 3]) * np.array([form == "xy", 1])
            seen = farthest(curve(columns, moved, way), curves[of]) > tolerance
            even = form == "xy" or step == "chord" or np.ptp(np.diff(rows[:, 0])) < 1e-10
            slack = CHORDS + sagitta(curves[of], made)
            good = off <= told + slack and told <= tolerance and off >= 0.98 * told - slack and seen and even
            shares.append(told / tolerance)
            passed, failed = passed + good, failed + (not good)
            if not good:
                print(f"FAILED {of} {form} {step} {way}: {off} mm, told {told}, tolerance {tolerance}; {' '.join(keys)}")
        discs += not refused
    print(f"{discs} discs: {passed} tables passed, {failed} failed; told {np.mean(shares):.3f} of the tolerance in the mean")
    sys.exit(failed > 0)


main()
