"""Random lift tables in the forms in which people have them, against the rows they were written from.

Shares nothing with camgen but the files it reads and writes. A lobe of rises, dwells and falls is sampled, rounded, thinned out, turned round,
cut short and written in some unit, order and separator. Whether the file must be refused follows from how it was drawn. Of the others the
motion is read back from the CSV (position, velocity and acceleration, joined by quintics) and compared with the rows: exit 0 only if the curve
leaves no two neighbours by more than `overshoot` allows and no row by more than `smooth`; exit 1 because of `overshoot` only if it does.

With --segments: rows inside of segments, as points of a spline or shares of a table; from rest, behind a moving end with a given state, or
two splines with a state that is found. A segment must begin and end with its given position and state; the rest is held as above. A given
state that a monotonic curve cannot have is refused.

With --laws: known laws at each degree, rounded to 0.001 in and 0.01 mm, smoothed with "auto": the largest acceleration within 10 % of that of
the law, every row within its rounding. Each eighth is a parabola, whose acceleration jumps: that of the curve may be 20 % higher.

usage: tables.py CAMGEN_BINARY DIRECTORY [--count N] [--segments N] [--laws N] [--seed N] [--only N] [--verbose]
The long run: --count 5000 --segments 2000 --laws 200.
"""
import argparse
import csv
import io
import json
import math
import random
import resource
import subprocess
import sys
import time
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np

PI, TAU = math.pi, 2 * math.pi
UNITS = {"mm": 1.0, "in": 25.4, "um": 1e-3, "m": 1e3, "cm": 10.0}
# Every 30th of a degree: rows stand on samples, where no derivative jumps between two of them.
SAMPLES = 10800


def laws():
    """Shapes from 0 to 1 with their largest |s''|."""
    def poly(*c):
        return lambda x: sum(a * x ** k for k, a in enumerate(c))

    def modified_sine(x):
        k = 1 / (4 + PI)
        if x < 1 / 8:
            return k * (PI * x - math.sin(4 * PI * x) / 4)
        if x < 7 / 8:
            return k * (2 + PI * x - 9 / 4 * math.sin((4 * PI * x + PI) / 3))
        return k * (4 + PI * x - math.sin(4 * PI * x) / 4)

    def simpson(line):
        # From the acceleration: a sine up, a line, a sine down, by sums of fine steps.
        n = 4000
        x = (np.arange(n) + 0.5) / n
        a = np.where(x < 0.5, 1.0, -1.0) * np.minimum(1.0, np.sin(PI * np.minimum(2 * np.minimum(x, 1 - x), np.abs(1 - 2 * x)) / 2 / line).clip(0, 1))
        a = np.where(np.minimum(2 * np.minimum(x, 1 - x), np.abs(1 - 2 * x)) > line, np.where(x < 0.5, 1.0, -1.0), a)
        v = np.concatenate([[0], np.cumsum(a) / n])
        s = np.concatenate([[0], np.cumsum((v[1:] + v[:-1]) / 2) / n])
        peak = np.max(np.abs(a)) / s[-1]
        return (lambda x: float(np.interp(x, np.arange(n + 1) / n, s / s[-1]))), float(peak)

    made = [
        (poly(0, 0, 0, 10, -15, 6), 10 / math.sqrt(3)),
        (poly(0, 0, 0, 0, 35, -84, 70, -20), 7.5132),
        (lambda x: x - math.sin(TAU * x) / TAU, TAU),
        (modified_sine, 4 * PI * PI / (4 + PI)),
    ]
    return made + [simpson(line) for line in (0.3, 0.4)]


LAWS = laws()
# Its acceleration jumps where it begins, in the middle and where it ends: rows do not show where, and the curve overshoots the jump.
PARABOLA = (lambda x: 2 * x * x if x < 0.5 else 1 - 2 * (1 - x) ** 2, 4.0)


def machine(motion, limits):
    """A machine file of a motion, whose limits leave the motion alone to be judged."""
    limits = "\n".join(f"{key} = {value}" for key, value in limits.items())
    return f'''name = "rows"
[motion]
start = "0 mm"
{motion}
[follower.roller]
radius = "1 mm"
[cam]
base_radius = "300 mm"
[limits]
pressure_angle = "89 deg"
min_convex_pitch_radius_over_roller = 0
continuity = 0
{limits}
'''


class Lobe:
    """Rise, dwell, fall, dwell over a turn of `fill` degrees; positions in mm."""

    def __init__(self, rng, fill=360.0, laws=LAWS):
        self.lift = rng.uniform(2, 20)
        cuts = [rng.uniform(0.2, 0.35), rng.choice([0, rng.uniform(0.05, 0.2)]), rng.uniform(0.2, 0.35)]
        self.rise, self.top, self.fall = (fill * cut for cut in cuts)
        self.start = rng.uniform(0.02, 0.1) * fill
        self.laws = [rng.choice(laws), rng.choice(laws)]
        self.fill = fill

    def at(self, deg):
        x = deg % self.fill - self.start
        if x <= 0 or x >= self.rise + self.top + self.fall:
            return 0.0
        if x < self.rise:
            return self.lift * self.laws[0][0](x / self.rise)
        if x <= self.rise + self.top:
            return self.lift
        return self.lift * self.laws[1][0](1 - (x - self.rise - self.top) / self.fall)

    def peak(self):
        """Largest |s''|, mm/rad²."""
        both = zip(self.laws, (self.rise, self.fall))
        return max(self.lift * law[1] / math.radians(width) ** 2 for law, width in both)


def rounded(value, step):
    return round(value / step) * step


def number(value, decimals, comma):
    text = f"{value:.{decimals}f}"
    return text.replace(".", ",") if comma else text


class Case:
    """A file, its keys and what must come of it: 2, or rows (deg of the cam, mm) to stay near."""

    def __init__(self, rng):
        self.keys, self.limits, self.refused, self.smooth = {}, {}, None, 0.0
        repeat = rng.choice([1, 1, 1, 1, 2, 3])
        fill = 360 / repeat
        if repeat > 1:
            self.keys["repeat"] = repeat
        lobe = Lobe(rng, fill)
        step = rng.choice([0.5, 1, 2, 2.5, 5, 10]) / (repeat if repeat > 1 else 1)
        count = round(fill / step)
        # A table is of numbers: what is rounded is written with as many decimals.
        unit = rng.choice(["mm", "mm", "mm", "in", "um"])
        exponent = rng.choice([1, 2, 3, 4])
        grain = 10.0 ** -exponent                      # mm
        decimals = max(0, math.ceil(exponent + math.log10(UNITS[unit]) - 1e-9))
        grain = UNITS[unit] * 10.0 ** -decimals
        self.grain = grain
        rows = [(i * step, rounded(lobe.at(i * step), grain)) for i in range(count)]
        self.lift = lobe.lift
        # Dwells by their two ends, and rows left out.
        if rng.random() < 0.4:
            same = [i for i in range(1, count - 1) if rows[i - 1][1] == rows[i][1] == rows[i + 1][1]]
            rows = [row for i, row in enumerate(rows) if i not in set(same)]
        if rng.random() < 0.3 and len(rows) > 12:
            first = rng.randrange(2, len(rows) - 5)
            del rows[first:first + rng.randrange(1, 5)]
        rows.append((fill, rows[0][1]))
        closing = rng.random() < 0.7
        kind = rng.choice(["whole"] * 6 + ["cut", "rest", "mirror"])
        if kind == "whole" and not closing:
            rows.pop()
            # Without the row that closes it, the last gap must be no wider than a spacing.
            widths = [b[0] - a[0] for a, b in zip(rows, rows[1:]) if a[1] != b[1]]
            gap = fill - rows[-1][0]
            if gap > max(widths) * (1.0001 if max(widths) <= 1.2 * min(widths) else 1.5):
                self.refused = "without rows"
        elif kind in ("cut", "rest"):
            rows.pop()
            moving = [i for i in range(len(rows)) if rows[i][1] != 0]
            rows = rows[max(0, moving[0] - 1):moving[-1] + 2]
            if rows[0][1] == rows[-1][1] and len(rows) < count - 3:
                widths = [b[0] - a[0] for a, b in zip(rows, rows[1:]) if a[1] != b[1]]
                gap = fill - rows[-1][0] + rows[0][0]
                if gap > 1.5 * max(widths) + 1e-6:
                    if kind == "rest":
                        self.keys["rest"] = '"dwell"'
                    else:
                        self.refused = "without rows"
                elif kind == "rest" or gap > max(widths):
                    self.refused = "?"
            else:
                self.refused = "?"
        elif kind == "mirror":
            half = lobe.start + lobe.rise
            xs = [half * i / 20 for i in range(21)]
            xs = [x for x in xs if x >= lobe.start * 0.5]
            rows = [(round(x, 4), rounded(lobe.at(x), grain)) for x in xs]
            nose = rows[-1][0]
            self.keys["mirror"] = "true"
            self.expected = rows + [(2 * nose - x, y) for x, y in rows[-2::-1]]
            self.spans = False
        if kind != "mirror":
            self.expected = list(rows)
        self.kind = kind
        self.fill = fill
        # Where it begins, in which order, in which units.
        shift = rng.choice([0, 0, 0, -fill / 2, 30.0])
        written = [(x + shift, y) for x, y in rows]
        self.expected = [(x + shift, y) for x, y in self.expected]
        angle_unit, ratio = rng.choice(["deg", "deg", "deg", "rad"]), rng.choice([1, 1, 1, 2])
        if repeat > 1 or kind == "mirror":
            angle_unit = "deg"
        in_heading = rng.random() < 0.6
        swapped = rng.random() < 0.2
        if angle_unit == "rad":
            self.angle_slack = 0.5e-8
        else:
            self.angle_slack = 0.5e-6
        factor = math.degrees(1) if angle_unit == "rad" else 1.0
        lines = [[x * ratio / factor, y / UNITS[unit]] for x, y in written]
        if rng.random() < 0.15:
            lines.reverse()
        comma = rng.random() < 0.3
        separator = rng.choice([";", "\t", "  "]) if comma else rng.choice([",", ";", "\t", " ", ", "])
        cells = [[number(x, 8 if angle_unit == "rad" else 6, comma), number(y, decimals, comma)] for x, y in lines]
        heads = [f"angle ({angle_unit})", f"lift ({unit})"]
        extra = rng.random() < 0.15 and separator.strip() not in ("",) and in_heading
        if ratio != 1:
            self.keys["ratio"] = ratio
        if swapped:
            cells, heads = [cell[::-1] for cell in cells], heads[::-1]
        if extra:
            cells, heads = [["7", *cell] for cell in cells], ["number", *heads]
        text = ""
        if in_heading:
            text += separator.join(heads) + "\n"
        else:
            named = [unit] if unit != "mm" else []
            if angle_unit == "rad":
                named.insert(0, "rad")
            if named:
                self.keys["unit"] = json.dumps(", ".join(named))
        if extra:
            self.keys["columns"] = '["angle", "lift"]'
        elif swapped and not in_heading:
            self.keys["columns"] = "[2, 1]"
        if rng.random() < 0.05 and in_heading and self.refused is None:
            # The key contradicts the heading.
            self.keys["unit"] = '"cm"'
            self.refused = "but the heading"
        if rng.random() < 0.05 and angle_unit == "rad" and not in_heading and kind == "whole" and ratio == 1 and self.refused is None and unit == "mm":
            del self.keys["unit"]
            self.refused = "radians"
        self.text = text + "\n".join(separator.join(cell) for cell in cells) + "\n"
        if rng.random() < 0.4:
            self.smooth = rng.choice([0.5 * grain, grain, 2 * grain])
            self.keys["smooth"] = '"auto"' if self.smooth == 0.5 * grain else json.dumps(f"{self.smooth * 1e3:.9g} um")
        if rng.random() < 0.25:
            self.keys["shape"] = '"monotonic"'
        if rng.random() < 0.2:
            allowed = rng.choice([0.002, 0.05, 0.5])
            self.limits["overshoot"] = json.dumps(f"{allowed} mm")
        self.allowed = float(self.limits["overshoot"].strip('"').split()[0]) if self.limits else None
        self.monotonic = "shape" in self.keys

    def design(self, table):
        keys = "\n".join(f"{key} = {value}" for key, value in self.keys.items())
        return machine(f'table = "{table}"\n{keys}', self.limits)


class Rows:
    """The rows of a segment, in its file; positions in mm."""

    def __init__(self, rng, law, places, start, end, grain):
        """Along a law from one position to another, at places (deg) from its start; its ends are kept."""
        self.over, rise = places[-1], end - start
        at = lambda deg: start + rise * law[0](deg / self.over)
        self.start, self.end, self.keys, self.smooth = start, end, {}, 0.0
        shares = rng.random() < 0.4
        # What is rounded is written with as many decimals.
        self.grain = grain if not shares else 10.0 ** round(math.log10(grain / abs(rise))) * abs(rise)
        inner = places[1:-1]
        if shares:
            decimals = round(-math.log10(self.grain / abs(rise)))
            values = [round(law[0](x / self.over), decimals) for x in inner]
            self.rows = [(0.0, start), *((x, start + rise * y) for x, y in zip(inner, values)), (self.over, end)]
            comma = rng.random() < 0.3
            separator = rng.choice([";", "\t", "  "]) if comma else rng.choice([",", ";", "\t", " "])
            lines = [(0.0, 0.0), *zip((x / self.over for x in inner), values), (1.0, 1.0)]
            self.text = "\n".join(separator.join([number(x, 9, comma), number(y, decimals, comma)]) for x, y in lines) + "\n"
            self.slack = 0.5e-9 * self.over
        else:
            self.rows = [(0.0, start), *((x, rounded(at(x), self.grain)) for x in inner), (self.over, end)]
            self.text, self.slack = None, 0.5e-6
        self.monotonic = rng.random() < 0.35
        if self.monotonic:
            self.keys["shape"] = '"monotonic"'
        if rng.random() < 0.4:
            self.smooth = rng.choice([0.5, 1, 2]) * self.grain
            self.keys["smooth"] = '"auto"' if self.smooth == 0.5 * self.grain else json.dumps(f"{self.smooth * 1e3:.9g} um")
            if self.smooth == 0.5 * self.grain and not shares:
                # Few points may all have fewer decimals than they are rounded to.
                shown = next(d for d in range(-2, 10) if all(abs(y - round(y, d)) < 1e-9 for _, y in self.rows[1:-1]))
                self.smooth = max(self.smooth, 0.5 * 10.0 ** -shown)

    def segment(self, name, at, end=""):
        keys = "\n".join(f"{key} = {value}" for key, value in self.keys.items())
        head = f'[[motion.segment]]\nover = "{self.over:.9f} deg"\nto = "{self.end:.9f} mm"\n{end}\n{keys}\n'
        if self.text is not None:
            return head + f'law = "table"\ntable = "{name}"\n'
        points = ", ".join(f'["{at + x:.9f} deg", "{y:.9f} mm"]' for x, y in self.rows[1:-1])
        return head + f'law = "spline"\npoints = [{points}]\n'


def stands(rise, width, velocity, acceleration):
    """Whether a monotonic curve may begin so: the differences of the Bernstein coefficients of a quintic, as the manual says."""
    up = math.copysign(1, rise)
    v, a = up * velocity * width, up * acceleration * width ** 2
    return rise != 0 and v >= 0 and v + a / 4 >= 0 and 2 * v + a / 4 < 5 * abs(rise)


class Segments:
    """A motion of segments, of which some are rows, and what must come of it."""

    def __init__(self, rng, name):
        self.refused, self.limits, self.files = None, {}, {}
        self.kind = rng.choice(["rest", "rest", "moving", "found"])
        step, count = rng.choice([0.5, 1, 2, 2.5, 5, 10]), rng.randrange(8, 60)
        count = min(count, int(130 / step))
        places = [i * step for i in range(count + 1)]
        if rng.random() < 0.3 and count > 12:
            first = rng.randrange(2, len(places) - 6)
            del places[first:first + rng.randrange(1, 4)]
        lift, law = rng.uniform(2, 20), rng.choice(LAWS)
        lift, grain = round(lift, 3), 10.0 ** -rng.choice([1, 2, 3, 4])
        before, self.states = 30.0, []
        if self.kind == "moving":
            # A polynomial up to a place on the way, with the state of a ramp there.
            low = round(0.25 * lift, 3)
            mean = (lift - low) / math.radians(places[-1])
            velocity, acceleration = round(mean * rng.choice([-0.5, 0.3, 0.7, 1.5, 4, 9]), 6), round(mean * rng.choice([0, 0, -1, 2]), 6)
            self.rows = [Rows(rng, law, places, low, lift, grain)]
            if self.rows[0].text is not None:
                # A table determines its own states.
                self.kind, self.rows[0].start, velocity = "rest", 0.0, None
                self.rows = [Rows(rng, law, places, 0.0, lift, grain)]
            else:
                head = f'[[motion.segment]]\nover = "30 deg"\nto = "{low} mm"\nlaw = "polynomial"\nvelocity = "{velocity} mm/rad"\nacceleration = "{acceleration} mm/rad2"\n'
                self.states.append((30.0, low, velocity, acceleration))
                first = self.rows[0]
                if first.monotonic and not first.smooth:
                    (x0, y0), (x1, y1) = first.rows[:2]
                    if not stands(y1 - y0, math.radians(x1 - x0), velocity, acceleration):
                        self.refused = "contradicts the state"
                elif first.monotonic:
                    # Whether smoothed rows allow it is theirs to say.
                    self.refused = "contradicts the state?"
        if self.kind != "moving":
            head = '[[motion.segment]]\nlaw = "dwell"\nover = "30 deg"\n'
            if self.kind == "rest":
                self.rows = [Rows(rng, law, places, 0.0, lift, grain)]
        if self.kind == "found":
            while True:
                middle = round(rng.uniform(0.3, 0.7) * lift, 3)
                half = round(len(places) / 2)
                first, second = places[:half], [x - places[half - 1] for x in places[half - 1:]]
                # Each half of a law that begins and ends at rest is steep in the middle: two straight ramps are not.
                line = (lambda x: x, 0.0)
                self.rows = [Rows(rng, line, first, 0.0, middle, grain), Rows(rng, line, second, middle, lift, grain)]
                if all(rows.text is None for rows in self.rows):
                    break
            self.states = []
        at, body = before, ""
        self.runs = []
        for index, rows in enumerate(self.rows):
            table = f"{name}-{index}.csv"
            if rows.text is not None:
                self.files[table] = rows.text
            found = self.kind == "found" and index == 0
            body += rows.segment(table, at, 'velocity = "auto"\n' if found else "")
            self.runs.append(([(at + x, y) for x, y in rows.rows], rows))
            at += rows.over
            if self.kind == "found" or rows.text is None:
                if not found:
                    self.states.append((at, rows.end, 0.0, 0.0))
        if self.kind != "moving" and self.rows[0].text is None:
            self.states.append((30.0, 0.0, 0.0, 0.0))
        tail = '[[motion.segment]]\nlaw = "dwell"\nover = "20 deg"\n[[motion.segment]]\nlaw = "cycloidal"\nover = "100 deg"\nto = "0 mm"\n'
        if self.kind != "moving":
            tail += '[[motion.segment]]\nlaw = "dwell"\n'
        else:
            tail = tail.replace('over = "100 deg"\n', "")
        self.body = head + body + tail
        if rng.random() < 0.4:
            self.share = rng.choice([0.001, 0.05, 0.5])
            self.limits["overshoot"] = json.dumps(f"{100 * self.share:.9g} %")
        else:
            self.share = None

    def design(self):
        return machine(self.body, self.limits)


def run(binary, directory, name, design, samples=SAMPLES):
    path = directory / f"{name}.toml"
    path.write_text(design)
    out = directory / name
    words = ["make", str(path), "--json", "--out", str(out), "--name", "cam", "--format", "csv", "--samples", str(samples), "--force", "--overwrite"]
    # A limit of processor time does not depend on what else the machine does.
    limit = lambda: resource.setrlimit(resource.RLIMIT_CPU, (120, 120))
    done = subprocess.run([binary, *words], capture_output=True, text=True, timeout=1800, preexec_fn=limit)
    table = out / "cam.csv"
    rows = list(csv.DictReader(io.StringIO(table.read_text()))) if table.exists() else []
    if table.exists():
        for file in out.iterdir():
            file.unlink()
        out.rmdir()
    report = json.loads(done.stdout) if done.stdout.startswith("{") else None
    return done.returncode, report, rows, done.stderr


class Curve:
    """The motion of a CSV, joined by quintics."""

    def __init__(self, rows):
        read = lambda name: np.array([float(row[name]) for row in rows])
        self.s, self.v, self.a = read("position_mm"), read("velocity_mm_per_rad"), read("acceleration_mm_per_rad2")
        self.n, self.h = len(rows), TAU / len(rows)

    def lift(self):
        """Lift of the samples, and by which share either end may lie beyond them: a parabola of the largest acceleration."""
        lift = float(np.max(self.s) - np.min(self.s))
        return lift, float(np.max(np.abs(self.a)) * self.h**2 / 4) / max(lift, 1e-9)

    def at(self, deg):
        x = np.radians(np.asarray(deg, float)) % TAU / self.h
        i = np.floor(x).astype(int) % self.n
        j, t = (i + 1) % self.n, x - np.floor(x)
        s0, s1 = self.s[i], self.s[j]
        v0, v1, a0, a1 = (value * power for value, power in ((self.v[i], self.h), (self.v[j], self.h), (self.a[i], self.h ** 2), (self.a[j], self.h ** 2)))
        b = [s0, s0 + v0 / 5, s0 + 2 * v0 / 5 + a0 / 20, s1 - 2 * v1 / 5 + a1 / 20, s1 - v1 / 5, s1]
        return sum(math.comb(5, k) * t ** k * (1 - t) ** (5 - k) * b[k] for k in range(6))


def held(curve, expected, smooth, slack):
    """Faults of rows that the curve must be near, how far it leaves the range of two neighbours, and how well that is known."""
    wrong = []
    slope = np.max(np.abs(curve.v))
    x = np.array([row[0] for row in expected])
    y = np.array([row[1] for row in expected])
    off = np.abs(curve.at(x) - y)
    near = smooth + 5e-6 + slope * math.radians(slack) * 2
    if off.max() > near:
        at = int(off.argmax())
        wrong.append(f"{off.max():.6f} mm from the row at {x[at]:.3f} deg, at most {near:.6f}")
    # Between neighbours, of what the curve makes of the rows.
    own = curve.at(x)
    beyond = 0.0
    for left in range(len(x) - 1):
        inner = curve.at(np.linspace(x[left], x[left + 1], 65))
        low, high = sorted((own[left], own[left + 1]))
        beyond = max(beyond, float(np.max(inner) - high), low - float(np.min(inner)))
    width = float(np.max(np.diff(x)))
    coarse = np.max(np.abs(curve.a)) * math.radians(width / 64) ** 2 / 8 + 1e-6
    return wrong, beyond, coarse


def verdicts(found, code, report, limit, unseen):
    """Faults of the verdict on an overshoot; of the lift so much may lie between the samples, over itself."""
    wrong, told = [], found["value"]
    if abs(found["limit"] - limit) > (1e-4 + unseen) * limit + 1e-6:
        wrong.append(f"limit {found['limit']} instead of {limit}")
    if (found["verdict"] == "fail") != (told > found["limit"]):
        wrong.append(f"verdict {found['verdict']} of {told} at {found['limit']}")
    failed = [check["check"] for check in report["checks"] if check["verdict"] == "fail"]
    if (code == 0) == bool(failed):
        wrong.append(f"exit {code} with {failed}")
    return wrong


def judge(case, code, report, rows, err):
    if case.refused == "?":
        return []
    if case.refused:
        return [] if code == 2 and case.refused in err else [f"exit {code} instead of 2 for {case.refused}: {err[:300]}"]
    if code == 2:
        return [f"refused: {err[:400]}"]
    checks = {check["check"]: check for check in report["checks"]}
    found = checks.get("overshoot")
    if not found:
        return ["no check overshoot"]
    curve = Curve(rows)
    expected = sorted(case.expected)
    if expected[-1][0] - expected[0][0] < case.fill - 1e-6:
        expected.append((expected[0][0] + case.fill, expected[0][1]))
    wrong, beyond, coarse = held(curve, expected, case.smooth, case.angle_slack)
    told = found["value"]
    if not -1e-6 <= told - beyond <= coarse:
        wrong.append(f"overshoot told {told:.6f}, is {beyond:.6f} (to {coarse:.6f})")
    lift, unseen = curve.lift()
    wrong += verdicts(found, code, report, case.allowed if case.allowed is not None else max(0.01 * lift, 0.005), unseen)
    if case.monotonic and told > 1e-9:
        wrong.append(f"monotonic, but {told} beyond")
    return wrong


def judge_segments(case, code, report, rows, err):
    if code == 2:
        fits = case.refused and case.refused.rstrip("?") in err
        return [] if fits else [f"refused: {err[:400]}"]
    if case.refused and not case.refused.endswith("?"):
        return [f"exit {code} instead of 2 for {case.refused}"]
    checks = {check["check"]: check for check in report["checks"]}
    found = checks.get("overshoot")
    if not found:
        return ["no check overshoot"]
    curve, wrong, most, coarse = Curve(rows), [], 0.0, 0.0
    for expected, own in case.runs:
        faults, beyond, known = held(curve, expected, own.smooth, own.slack)
        wrong += faults
        if own.monotonic and beyond > 1e-6:
            wrong.append(f"monotonic, but {beyond} beyond")
        most, coarse = max(most, beyond), max(coarse, known)
    if not -1e-6 <= found["value"] - most <= coarse:
        wrong.append(f"overshoot told {found['value']:.6f}, is {most:.6f} (to {coarse:.6f})")
    # The states at ends, as given.
    for deg, s, v, a in case.states:
        at = round(deg / 360 * curve.n)
        jerk = max(abs(curve.a[(at + 1) % curve.n] - curve.a[at]), abs(curve.a[at] - curve.a[at - 1]))
        for what, value, wanted, near in (
            ("position", curve.s[at], s, 1e-6),
            ("velocity", curve.v[at], v, 1e-6 + 1e-9 * np.max(np.abs(curve.v))),
            ("acceleration", curve.a[at], a, 1e-6 * np.max(np.abs(curve.a)) + 1e-6),
        ):
            # A sample beside the joint where rounding of the angle leads.
            slack = {"position": 0.0, "velocity": 0.0, "acceleration": 1e-6 * jerk}[what]
            if abs(value - wanted) > near + slack:
                wrong.append(f"{what} {value:.9f} at {deg:.3f} deg instead of {wanted:.9f}")
    if case.kind == "found":
        at = round(case.runs[0][0][-1][0] / 360 * curve.n)
        left, here, right = (curve.a[(at + by) % curve.n] for by in (-1, 0, 1))
        if max(abs(left - here), abs(right - here)) > 0.2 * np.max(np.abs(curve.a)):
            wrong.append(f"acceleration {left:.3f} {here:.3f} {right:.3f} at the state that is found")
    lift, unseen = curve.lift()
    wrong += verdicts(found, code, report, case.share * lift if case.share is not None else max(0.01 * lift, 0.005), unseen)
    return wrong


def segments(binary, directory, seed, index):
    rng = random.Random(f"segments-{seed}-{index}")
    name = f"segments-{seed}-{index}"
    case = Segments(rng, name)
    for file, text in case.files.items():
        (directory / file).write_text(text)
    code, report, rows, err = run(binary, directory, name, case.design())
    wrong = judge_segments(case, code, report, rows, err)
    if not wrong:
        for file in [f"{name}.toml", *case.files]:
            (directory / file).unlink()
    return f"exit {code}, segments, {case.kind}" + (", contradiction" if code == 2 else ""), wrong, name, 0.0


def table(binary, directory, seed, index):
    rng = random.Random(f"{seed}-{index}")
    case = Case(rng)
    name = f"case-{seed}-{index}"
    (directory / f"{name}.csv").write_text(case.text)
    # Half of a quarter of a degree stands between the samples.
    samples = 2 * SAMPLES if case.keys.get("repeat") == 2 else SAMPLES
    code, report, rows, err = run(binary, directory, name, case.design(f"{name}.csv"), samples)
    wrong = judge(case, code, report, rows, err)
    if not wrong:
        (directory / f"{name}.toml").unlink()
        (directory / f"{name}.csv").unlink()
    return f"exit {code}" + (f", {case.refused}" if code == 2 else "") + f", {case.kind}", wrong, name, 0.0


def law(binary, directory, seed, index):
    """A known law at each degree: what smoothing makes of its acceleration."""
    rng = random.Random(f"law-{seed}-{index}")
    jumps = index % 8 == 7
    lobe = Lobe(rng, laws=[PARABOLA] if jumps else LAWS)
    grain = rng.choice([0.0254, 0.01])
    name = f"law-{seed}-{index}"
    rows = [(i, rounded(lobe.at(i), grain)) for i in range(360)]
    (directory / f"{name}.csv").write_text("deg,mm\n" + "\n".join(f"{x},{y:.4f}" for x, y in rows) + "\n")
    case = Case.__new__(Case)
    case.keys, case.limits = {"smooth": '"auto"'}, {}
    code, report, table, err = run(binary, directory, name, case.design(f"{name}.csv"), 7200)
    if code == 2 or not table:
        return "laws", [f"exit {code}: {err[:300]}"], name, 0.0
    curve = Curve(table)
    share = float(np.max(np.abs(curve.a))) / lobe.peak()
    off = max(abs(float(curve.at(x)) - y) for x, y in rows)
    wrong = []
    if not (0.95 < share < 1.2 if jumps else abs(share - 1) <= 0.1):
        wrong.append(f"{share:.4f} of the acceleration of the law (grain {grain}, lift {lobe.lift:.2f}, {lobe.rise:.0f}/{lobe.top:.0f}/{lobe.fall:.0f} deg)")
    if off > 0.5 * grain + 1e-6:
        wrong.append(f"{off:.6f} mm from a row, rounded to {grain}")
    if not wrong:
        (directory / f"{name}.toml").unlink()
        (directory / f"{name}.csv").unlink()
    return "laws that jump" if jumps else "laws", wrong, name, abs(share - 1)


def speed(binary, directory):
    """Processor times of a design with many rows, to be seen; cost.py holds such designs to a limit."""
    times = []
    for command in ("make", "size"):
        for count in (1000, 10000):
            path = directory / f"many-{count}.toml"
            text = "".join(f"{360 * i / count!r},{10 - 10 * math.cos(TAU * i / count)!r}\n" for i in range(count))
            (directory / f"many-{count}.csv").write_text(text)
            head = f'name = "many"\n[motion]\nrpm = 500\nstart = "0 mm"\ntable = "many-{count}.csv"\n'
            path.write_text(head + '[follower.roller]\nradius = "8 mm"\n[cam]\nbase_radius = "auto"\n')
            before = resource.getrusage(resource.RUSAGE_CHILDREN)
            words = [binary, command, str(path), "--dry-run"] + (["--format", "dxf"] if command == "make" else [])
            subprocess.run(words, capture_output=True, timeout=300, check=True)
            after = resource.getrusage(resource.RUSAGE_CHILDREN)
            times.append(after.ru_utime - before.ru_utime)
    print("make and size of 1000 and 10 000 rows: " + ", ".join(f"{value:.2f} s" for value in times))


def main():
    words = argparse.ArgumentParser()
    words.add_argument("binary")
    words.add_argument("directory", type=Path)
    words.add_argument("--count", type=int, default=120)
    words.add_argument("--segments", type=int, default=60)
    words.add_argument("--laws", type=int, default=12)
    words.add_argument("--seed", type=int, default=1)
    words.add_argument("--only", type=int, help="one table of the seed, by its number (--segments 0 and --laws 0 leave out the others)")
    words.add_argument("--verbose", action="store_true")
    given = words.parse_args()
    directory = given.directory / "tables"
    directory.mkdir(parents=True, exist_ok=True)
    binary = str(Path(given.binary).resolve())
    for shape, peak in LAWS:
        # The peaks by second differences.
        x = np.linspace(0, 1, 2001)
        s = np.array([shape(value) for value in x])
        assert abs(s[0]) < 1e-12 and abs(s[-1] - 1) < 1e-12 and abs(np.max(np.abs(np.diff(s, 2))) * 2000 ** 2 / peak - 1) < 0.01, peak
    started, tally, failures, worst = time.monotonic(), Counter(), 0, Counter()
    tables = range(given.count) if given.only is None else [given.only]
    rest = lambda count: range(count if given.only is None else 0)
    jobs = [(table, index) for index in tables] + [(segments, index) for index in rest(given.segments)] + [(law, index) for index in rest(given.laws)]
    with ThreadPoolExecutor(2) as pool:
        for what, wrong, name, share in pool.map(lambda job: job[0](binary, directory, given.seed, job[1]), jobs):
            tally[what] += 1
            worst[what] = max(worst[what], share)
            if wrong:
                failures += 1
                print(f"{name}: " + "; ".join(wrong if given.verbose else wrong[:2]))
    if given.only is None:
        speed(binary, directory)
    print("\n".join(f"{count:6} {what}" for what, count in sorted(tally.items())))
    print(f"smoothed laws: acceleration within {100 * worst['laws']:.2f} %, of those that jump {100 * worst['laws that jump']:.2f} %")
    seconds = time.monotonic() - started
    print(f"{len(jobs)} designs, {failures} wrong, {len(jobs) / seconds:.1f} a second")
    sys.exit(failures > 0)


main()
