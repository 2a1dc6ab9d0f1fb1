"""Searches the smallest cam of random motion programs on a grid of its own, and compares it with `camgen size`.

Shares nothing with camgen: textbook laws with their derivatives, the pressure angle and the curvature of the pitch curve from the
velocity of the roller's centre in the frame that turns with the follower, and places by trying them. A place that breaks a limit at
a sampled cam angle breaks it for certain; one that seems to keep them all is looked at again at finer angles.

usage: size.py CAMGEN_BINARY DIRECTORY [--count N] [--seed N] [--only NUMBER]
"""
import argparse
import collections
import csv
import json
import subprocess
import sys
import time
from pathlib import Path

import numpy as np

LAWS = ["cycloidal", "modified-sine", "modified-trapezoid", "3-4-5", "4-5-6-7"]
NAMES = ["pressure_angle", "pressure_angle_return", "curvature", "bore"]
KEPT = 1e-6
BELOW = 1e-3


def modified_sine(x):
    """Quarter sine waves of 1/8, 3/4 and 1/8 of the segment."""
    k = np.pi + 4
    middle, wave = 4 / 3 * np.pi * x + np.pi / 3, 4 * np.pi * x
    inner = [(2 + np.pi * x - 2.25 * np.sin(middle)) / k, np.pi / k * (1 - 3 * np.cos(middle)), 4 * np.pi**2 / k * np.sin(middle)]
    head = np.where(x < 0.5, 0, 4)
    outer = [(head + np.pi * x - np.sin(wave) / 4) / k, np.pi / k * (1 - np.cos(wave)), 4 * np.pi**2 / k * np.sin(wave)]
    return [np.where((x > 1 / 8) & (x < 7 / 8), one, other) for one, other in zip(inner, outer)]


def modified_trapezoid(x):
    """The first half in three pieces, the second by its symmetry."""
    peak, late = 8 * np.pi / (2 + np.pi), x > 0.5
    y = np.where(late, 1 - x, x)
    w, t, z = 4 * np.pi, y - 1 / 8, y - 3 / 8
    first = [(y - np.sin(w * y) / w) / w, (1 - np.cos(w * y)) / w, np.sin(w * y)]
    second = [(1 / 8 - 1 / w) / w + t / w + t * t / 2, 1 / w + t, np.ones_like(y)]
    third_start = (1 / 8 - 1 / w) / w + 1 / (4 * w) + 1 / 32
    third = [third_start + (1 / w + 1 / 4) * z + (1 - np.cos(w * z)) / w**2, 1 / w + 1 / 4 + np.sin(w * z) / w, np.cos(w * z)]
    s, v, a = (peak * np.where(t < 0, f, np.where(z < 0, g, h)) for f, g, h in zip(first, second, third))
    return np.where(late, 1 - s, s), v, np.where(late, -a, a)


def law(name, x):
    """s, s' and s'' of a law from 0 to 1."""
    pi = np.pi
    if name == "cycloidal":
        return x - np.sin(2 * pi * x) / (2 * pi), 1 - np.cos(2 * pi * x), 2 * pi * np.sin(2 * pi * x)
    if name == "harmonic":
        return (1 - np.cos(pi * x)) / 2, pi / 2 * np.sin(pi * x), pi**2 / 2 * np.cos(pi * x)
    if name == "3-4-5":
        s = x**3 * (10 - 15 * x + 6 * x * x)
        return s, 30 * x**2 * (1 - x) ** 2, 60 * x * (1 - x) * (1 - 2 * x)
    if name == "4-5-6-7":
        s = x**4 * (35 - 84 * x + 70 * x**2 - 20 * x**3)
        return s, 140 * (x * (1 - x)) ** 3, 420 * (x * (1 - x)) ** 2 * (1 - 2 * x)
    return modified_sine(x) if name == "modified-sine" else modified_trapezoid(x)


class Motion:
    """A program of segments (law, degrees, target), lifts counted from the lowest position; an angle is kept in radians."""

    def __init__(self, segments, start, at, repeat, scale):
        ends = [start] + [to for _, _, to in segments]
        lowest = min(ends)
        self.segments, self.at, self.repeat = segments, at, repeat
        self.begin = [scale * (value - lowest) for value in ends[:-1]]
        self.travel = [scale * (b - a) for a, b in zip(ends, ends[1:])]
        self.over = np.radians([over for _, over, _ in segments])
        self.knots = at + np.cumsum([0.0] + [over for _, over, _ in segments])
        self.top = scale * (max(ends) - lowest)

    def at_points(self, segment, x):
        """Lift and its first two derivatives by the cam angle, at places x of segments."""
        out = np.zeros((3, *np.shape(x)))
        for i, (name, _, _) in enumerate(self.segments):
            inside = segment == i
            out[0][inside] = self.begin[i]
            if name != "dwell" and inside.any():
                for k, value in enumerate(law(name, x[inside])):
                    out[k][inside] += self.travel[i] * value / self.over[i] ** k
        return out

    def samples(self, count):
        """Places in the segments, ends included from both sides; a dwell is the same all along."""
        share = self.over / self.over.sum()
        numbers = [2 if name == "dwell" else max(24, int(count * part)) for (name, _, _), part in zip(self.segments, share)]
        segment = np.concatenate([np.full(n + 1, i) for i, n in enumerate(numbers)])
        return segment, np.concatenate([np.linspace(0, 1, n + 1) for n in numbers])

    def degrees(self, segment, x):
        return self.knots[segment] + np.degrees(self.over[segment]) * x

    def places(self, degrees):
        """Segments and x of a cam angle; two at the ends of segments."""
        turn = self.knots[-1] - self.knots[0]
        angle = self.knots[0] + (degrees - self.knots[0]) % turn
        for i, over in enumerate(np.degrees(self.over)):
            for shift in (-turn, 0, turn):
                x = (angle + shift - self.knots[i]) / over
                if -1e-6 < x < 1 + 1e-6:
                    yield i, min(max(x, 0.0), 1.0)


class Cam:
    """What a cam must keep, and by how much it breaks that with its follower at a place and of a prime radius."""

    def __init__(self, motion, roller, swinging, limits, convex, least):
        self.motion, self.roller, self.swinging = motion, roller, swinging
        self.tangents, self.convex, self.least = np.tan(np.radians(limits)), convex, least
        self.coarse = motion.at_points(*motion.samples(500))
        self.points = motion.samples(2000)
        self.fine = motion.at_points(*self.points)

    def figures(self, place, radius, lifts):
        """Tangent of the pressure angle, infinite where the follower does not reach, and curvature of the pitch curve."""
        s, v, a = lifts
        if self.swinging is None:
            u = np.sqrt(np.maximum(radius**2 - place**2, 0)) + s
            g, h = (v - place, u), (a - u, 2 * v - place)
            across, along = g[0], u
        else:
            arm, side = self.swinging
            cosine = (place**2 + arm**2 - radius**2) / (2 * place * arm)
            sine = np.sqrt(np.maximum(1 - cosine**2, 0))
            cs, sn = np.cos(s), np.sin(s)
            c, n = arm * (cosine * cs - sine * sn), arm * (sine * cs + cosine * sn)
            # Velocity and acceleration of the roller's centre seen from the cam, along u and across it.
            g = (n * (v + side), place - c * (1 + side * v))
            h = (c * v * (v + side) + n * a - g[1], n * v * (1 + side * v) - side * c * a + g[0])
            across, along = g[0] * n - side * c * g[1], g[1] * n + side * c * g[0]
        with np.errstate(all="ignore"):
            tangent = np.where(along > 0, across / along, np.inf)
            square = g[0] ** 2 + g[1] ** 2
            return tangent, (g[0] * h[1] - g[1] * h[0]) / (square * np.sqrt(square))

    def measures(self, place, radius, lifts):
        """By how much each limit along the turn is broken, as a share of it, at every lift."""
        tangent, curvature = self.figures(place, radius, lifts)
        rising, falling = self.tangents
        falls = np.where(np.isinf(tangent), np.inf, -tangent / falling - 1)
        return tangent / rising - 1, falls, curvature * self.convex - 1

    def excess(self, places, radii, lifts, which=NAMES):
        """The largest excess over the limits for each pair of a place and a prime radius, at sampled angles."""
        places, radii = np.broadcast_arrays(np.asarray(places, float), np.asarray(radii, float))
        found = np.empty(places.shape)
        for i in range(0, len(places), 16):
            p, r = places[i : i + 16, None], radii[i : i + 16, None]
            all_three = self.measures(p, r, lifts[:, None, :])
            chosen = [value.max(axis=1) for name, value in zip(NAMES, all_three) if name in which]
            found[i : i + 16] = np.max(chosen, axis=0)
        low, high = self.places(radii)
        found[(places <= low) | (places >= high)] = np.inf
        return np.maximum(found, self.least / radii - 1) if "bore" in which else found

    def places(self, radius):
        """Between which places a prime radius is possible."""
        if self.swinging is None:
            return -radius, +radius
        return np.abs(self.swinging[0] - radius), self.swinging[0] + radius

    def radii(self, place):
        """Between which prime radii a place is possible."""
        if self.swinging is None:
            return abs(place), np.inf
        return abs(self.swinging[0] - place), self.swinging[0] + place

    def exact(self, place, radius):
        """Excess of each limit by name with its cam angle in degrees, refined about the worst of the samples."""
        result = {"bore": (self.least / radius - 1, None)}
        segment, x = self.points
        low, high = self.places(radius)
        sampled = self.measures(place, radius, self.fine) if low < place < high else [np.full(len(x), np.inf)] * 3
        for k, name in enumerate(NAMES[:3]):
            values = sampled[k]
            worst = values.max()
            if not np.isfinite(worst):
                result[name] = (np.inf, None)
                continue
            near = np.flatnonzero(values >= worst - 0.01 * (1 + abs(worst)))
            # The neighbours within the same segment; the ends of a segment have one only.
            before, after = np.maximum(near - 1, 0), np.minimum(near + 1, len(x) - 1)
            before = np.where(segment[before] == segment[near], before, near)
            after = np.where(segment[after] == segment[near], after, near)
            highest = (values[near] >= values[before]) & (values[near] >= values[after])
            near, left, right = near[highest], x[before[highest]], x[after[highest]]
            own = segment[near]
            at, best = x[near], values[near]
            for _ in range(8):
                grid = left[:, None] + (right - left)[:, None] * np.linspace(0, 1, 13)
                finer = self.measures(place, radius, self.motion.at_points(np.repeat(own[:, None], 13, 1), grid))[k]
                top, rows = finer.argmax(axis=1), np.arange(len(own))
                at, best = grid[rows, top], finer[rows, top]
                left, right = grid[rows, np.maximum(top - 1, 0)], grid[rows, np.minimum(top + 1, 12)]
            i = best.argmax()
            result[name] = (best[i], self.motion.degrees(own[i], at[i]))
        return result

    def broken(self, place, radius, which=NAMES):
        """The largest exact excess over some of the limits."""
        return max(value for name, (value, _) in self.exact(place, radius).items() if name in which)

    def lowest(self, of, grid, zooms=4):
        """The least of a sampled excess over a grid, refined about its three lowest minima: (excess, where)."""
        values = of(grid, self.coarse)
        around = np.concatenate([[np.inf], values, [np.inf]])
        minima = np.flatnonzero((values <= around[:-2]) & (values <= around[2:]) & np.isfinite(values))
        best = (np.inf, np.nan)
        for i in sorted(minima, key=lambda i: values[i])[:3]:
            low, high = grid[max(i - 1, 0)], grid[min(i + 1, len(grid) - 1)]
            if values[i] > 0.6:
                break
            for _ in range(zooms):
                finer = np.linspace(low, high, 13)
                here = of(finer, self.fine)
                k = here.argmin()
                low, high = finer[max(k - 1, 0)], finer[min(k + 1, 12)]
                best = min(best, (here[k], finer[k]))
                if here[k] <= 0:
                    break
        return best

    def smaller(self, radius, which=NAMES):
        """A place at which a cam of this prime radius keeps the limits, or None."""
        low, high = self.places(radius)
        grid = low + (high - low) * (1 - np.cos(np.linspace(0, np.pi, 123)[1:-1])) / 2
        excess, place = self.lowest(lambda places, lifts: self.excess(places, radius, lifts, which), grid)
        return place if excess <= 0 and self.broken(place, radius, which) <= 0 else None

    def smaller_here(self, place, below, which=NAMES):
        """A prime radius below another one that keeps the limits with the follower at a place, or None."""
        low, high = self.radii(place)
        low, high = max(low, self.least if "bore" in which else 0.1), min(high, below)
        if low >= high:
            return None
        grid = low + (high - low) * np.linspace(0, 1, 161) ** 1.5
        excess, radius = self.lowest(lambda radii, lifts: self.excess(place, radii, lifts, which), grid)
        return radius if excess <= 0 and self.broken(place, radius, which) <= 0 else None


def any_program(rng, swinging):
    """Random moves that come back to the start, with dwells between some of them."""
    moves, repeat = int(rng.integers(2, 5)), int(rng.choice([1, 1, 1, 1, 2, 3]))
    size = float(rng.choice([3, 8, 20, 40, 60]) * rng.uniform(0.7, 1.3))
    start = round(float(rng.choice([0, 0, rng.uniform(-20, 20)])), 2)
    targets = [start]
    while len(targets) < moves:
        to = round(start + size * float(rng.choice([1, 1, rng.uniform(0.1, 0.9), -rng.uniform(0.1, 0.6)])), 2)
        targets += [to] if abs(to - targets[-1]) > 0.05 * size else []
    targets = targets[1:] + [start]
    pieces, harmonic = [], rng.random() < 0.2
    for i, to in enumerate(targets):
        name = "harmonic" if harmonic and i < 2 else str(rng.choice(LAWS))
        pieces.append((name, to, rng.uniform(0.25, 1) if rng.random() < 0.8 else rng.uniform(0.1, 0.3)))
        if len(pieces) + moves - i - 1 < 6 and rng.random() < 0.5 and not (harmonic and i == 0):
            pieces.append(("dwell", to, rng.uniform(0.05, 0.6)))
    turn, total = 360 / repeat, sum(piece[2] for piece in pieces)
    overs = [round(turn * share / total, 1) for _, _, share in pieces]
    overs[-1] = turn - sum(overs[:-1])
    segments = [(name, over, to) for (name, to, _), over in zip(pieces, overs)]
    at = round(float(rng.choice([0, 0, rng.uniform(-90, 200)])), 1)
    return Motion(segments, start, at, repeat, np.pi / 180 if swinging else 1.0), start


def any_case(rng):
    """A random machine file, and what it says."""
    swinging = rng.random() < 0.5
    motion, start = any_program(rng, swinging)
    unit = "deg" if swinging else "mm"
    text = ['name = "sized"', "[motion]", "rpm = 60", f"repeat = {motion.repeat}"]
    text += [f'start = "{start} {unit}"', f'at = "{motion.at} deg"']
    for i, (name, over, to) in enumerate(motion.segments):
        text += ["[[motion.segment]]", f'law = "{name}"']
        text += [f'over = "{over} deg"'] if i + 1 < len(motion.segments) else []
        text += [f'to = "{to} {unit}"'] if name != "dwell" else []
    knife = not swinging and rng.random() < 0.2
    roller = 0.0 if knife else round(float(rng.choice([4, 8, 15, 25]) * rng.uniform(0.8, 1.2)), 2)
    kind = "knife" if knife else "swinging-roller" if swinging else "roller"
    text += [f"[follower.{kind}]"] + ([] if knife else [f'radius = "{roller} mm"'])
    lever = None
    if swinging:
        lever = (round(float(rng.uniform(40, 200)), 1), int(rng.choice([1, -1])))
        side = "trailing" if lever[1] > 0 else "leading"
        text += [f'arm = "{lever[0]} mm"', f'pivot_distance = "{round(lever[0] * 1.2, 1)} mm"', f'side = "{side}"']
    text += ["[cam]", 'base_radius = "auto"', f'rotation = "{rng.choice(["cw", "ccw"])}"']
    least = 1.0
    wall = round(float(rng.uniform(1, 12)), 2) if rng.random() < 0.3 else 0.0
    if rng.random() < 0.7:
        bore = round(float(rng.choice([4, 12, 30]) * rng.uniform(0.8, 1.3)), 2)
        text.append(f'bore_radius = "{bore} mm"')
        least = bore + (wall or max(3.0, 0.15 * bore))
    limits = [round(float(rng.uniform(10, 60)), 1)] * 2
    text += ["[limits]", f'pressure_angle = "{limits[0]} deg"'] + ([f'wall = "{wall} mm"'] if wall else [])
    if rng.random() < 0.4:
        limits[1] = round(float(rng.uniform(10, 60)), 1)
        text.append(f'pressure_angle_return = "{limits[1]} deg"')
    ratio, sharp = 2.0, 0.0
    if rng.random() < 0.6:
        ratio = float(rng.choice([0, 1, 1.2, 1.5, 3]))
        text.append(f"min_convex_pitch_radius_over_roller = {ratio}")
    if rng.random() < 0.4:
        sharp = round(float(rng.uniform(1, 40)), 1)
        text.append(f'min_convex_radius = "{sharp} mm"')
    convex = max(ratio * roller, sharp + roller if sharp else 0.0, roller)
    cam = Cam(motion, roller, lever, limits, convex, least + roller)
    cam.same_limit = "pressure_angle_return" not in "\n".join(text)
    profile = bool(sharp) and sharp + roller > ratio * roller
    cam.curvature_name = "min_convex_radius" if profile else "min_convex_pitch_radius_over_roller"
    return cam, kind, "\n".join(text) + "\n"


def none_found(cam):
    """No place on a wide grid keeps the limits."""
    scale = cam.swinging[0] if cam.swinging else cam.motion.top
    for radius in np.geomspace(cam.least, 1000 * (scale + cam.least), 100):
        place = cam.smaller(radius)
        if place is not None:
            yield f"no place told, but {place:.6g} with a prime radius of {radius:.6g} keeps every limit"
            return


def of_best(cam, place, radius, which, what):
    """The optimum keeps its limits and no smaller cam does."""
    kept = cam.broken(place, radius, which)
    if not kept <= KEPT:
        yield f"{what}: the best, {place:.8g} with {radius:.8g}, breaks a limit by {kept:.3g} of it"
    floor = cam.least if "bore" in which else 0.1
    shares = BELOW * np.array([1, 2, 5, 10, 20, 40, 70, 100, 150, 200, 260, 330, 400, 480, 560, 650, 750, 850, 930])
    smaller = [(cam.smaller(least, which), least) for least in radius * (1 - shares) if least > floor]
    keeping = [pair for pair in smaller if pair[0] is not None]
    if keeping:
        other, least = keeping[-1]
        yield f"{what}: best {place:.8g} with {radius:.8g}, but {other:.8g} with {least:.8g} keeps them"


def of_choice(cam, size, place, best):
    """The rounded place, the base radius as `make` takes it, and what binds."""
    base, least = size["base_radius_mm"], size["smallest_prime_radius_mm"]
    kept = cam.broken(place, base + cam.roller)
    if not kept <= KEPT:
        yield f"chosen {place:.8g} with base radius {base:.8g} breaks a limit by {kept:.3g} of it"
    if abs(place - best) > 0.5 + 1e-9 or abs(2 * place - round(2 * place)) > 1e-9 and place != best:
        yield f"chosen {place:.8g} is not a half millimetre beside the best, {best:.8g}"
    up = np.ceil(least - cam.roller - 1e-3)
    if abs(base - up) > 1e-9 and cam.broken(place, up + cam.roller) <= 0:
        yield f"base radius {base:.8g} instead of {up:.8g}"
    other = cam.smaller_here(place, least * (1 - BELOW))
    if other is not None:
        yield f"at the chosen {place:.8g} a prime radius of {other:.8g} will do instead of {least:.8g}"
    yield from of_binding(cam, size, place, least)


def of_binding(cam, size, place, least):
    """What binds is what a slightly smaller cam breaks, and where."""
    below, told = cam.exact(place, least * (1 - 2e-6)), size["binding"]
    own = {"bore": ["bore"], "wall": ["bore"], "pressure_angle_return": ["pressure_angle_return"], "undercut": ["curvature"]}
    own["pressure_angle"] = NAMES[:2] if cam.same_limit else NAMES[:1]
    own[cam.curvature_name] = ["curvature"]
    if told == "reach":
        if np.isfinite(below["pressure_angle"][0]):
            yield f"binding reach, but {place:.8g} with {least * (1 - 2e-6):.8g} is reached"
        return
    broken = [name for name in own.get(told, []) if below[name][0] > 0]
    if not broken:
        figures = {name: float(f"{value:.3g}") for name, (value, _) in below.items()}
        yield f"binding {told}, but a smaller cam at {place:.8g} with {least:.8g} has {figures}"
    elif (degrees := size.get("binding_cam_deg")) is not None and broken[0] != "bore":
        points = list(cam.motion.places(degrees))
        lifts = cam.motion.at_points(np.array([i for i, _ in points]), np.array([x for _, x in points]))
        here = [max(cam.measures(place, least, lifts)[NAMES.index(name)]) for name in broken]
        if max(here) < -1e-5:
            really = cam.exact(place, least)[broken[0]][1] % 360
            yield f"binding {told} told at {degrees:.6g} deg, but {broken[0]} binds at {really:.6g} deg"


def of_rows(cam, rows, picked, swinging):
    """Some rows of the trade: each the smallest with its place, and its figures."""
    for row in (rows[i] for i in picked):
        values = [float(value) for value in row.values()]
        place, radius, _, inclined, angle, convex = values
        for value, which in [(radius, NAMES), (inclined, NAMES[:2])]:
            what = f"row {place:.8g}" + (" by pressure angle" if which != NAMES else "")
            kept = cam.broken(place, value, which) if np.isfinite(value) else 0.0
            if not kept <= KEPT:
                yield f"{what}: prime radius {value:.8g} breaks a limit by {kept:.3g} of it"
            scale = cam.swinging[0] + place if swinging else 1000 * (cam.least + cam.motion.top)
            other = cam.smaller_here(place, value * (1 - BELOW) if np.isfinite(value) else scale, which)
            if other is not None:
                yield f"{what}: a prime radius of {other:.8g} will do instead of {value:.8g}"
        if np.isfinite(radius):
            exact = cam.exact(place, radius)
            most = max(np.arctan((exact[name][0] + 1) * t) for name, t in zip(NAMES, cam.tangents))
            sharp = cam.convex / (exact["curvature"][0] + 1) if cam.convex else convex
            if abs(np.degrees(most) - angle) > 1e-5 or abs(sharp / convex - 1) > 1e-6:
                yield f"row {place:.8g}: {angle} deg and {convex} mm instead of {np.degrees(most)} and {sharp}"


def checked(rng, binary, directory, number):
    """One random case: its kind and the list of what is wrong with it."""
    cam, kind, text = any_case(rng)
    path = directory / "sized.toml"
    path.write_text(text)
    free = "pivot-distance" if cam.swinging else "offset"
    out = ["--json", "--out", str(directory), "--format", "csv", "--overwrite", "--force"]
    run = subprocess.run([binary, "size", str(path), "--free", free, *out], capture_output=True, text=True)
    if run.returncode:
        none = "no place of the follower" in run.stderr or "no base radius" in run.stderr
        wrong = list(none_found(cam)) if none else [f"exit code {run.returncode}: {run.stderr.strip()}"]
        return (kind, "no place"), wrong, text
    report = json.loads(run.stdout)
    size = report["size"]
    key = "pivot_distance_mm" if cam.swinging else "offset_mm"
    best, least = size["best"], size["least_by_pressure_angle"]
    wrong = list(of_best(cam, best[key], best["prime_radius_mm"], NAMES, "every limit"))
    wrong += of_best(cam, least[key], least["prime_radius_mm"], NAMES[:2], "pressure angle alone")
    wrong += of_choice(cam, size, size[key], best[key])
    rows = list(csv.DictReader((directory / Path(report["files"][0]).name).open()))
    picked = np.random.default_rng(number).choice(len(rows), 4, replace=False)
    wrong += of_rows(cam, rows, picked, cam.swinging is not None)
    return (kind, size["binding"]), wrong, text


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("binary")
    parser.add_argument("directory")
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", type=int)
    asked = parser.parse_args()
    binary, directory = str(Path(asked.binary).resolve()), Path(asked.directory) / "size"
    directory.mkdir(parents=True, exist_ok=True)
    kinds, failed, begun = collections.Counter(), 0, time.time()
    numbers = range(asked.count) if asked.only is None else [asked.only]
    for number in numbers:
        kind, wrong, text = checked(np.random.default_rng([asked.seed, number]), binary, directory, number)
        kinds[kind] += 1
        failed += bool(wrong)
        for line in wrong:
            print(f"case {number} ({', '.join(map(str, kind))}): {line}", flush=True)
        if wrong:
            (directory / f"wrong-{asked.seed}-{number}.toml").write_text(text)
    told = ", ".join(f"{kind} {binding} {number}" for (kind, binding), number in sorted(kinds.items(), key=str))
    print(f"{len(numbers) - failed} passed, {failed} failed; {told}; {len(numbers) / (time.time() - begun):.2f} cases/s")
    sys.exit(failed > 0)


main()
