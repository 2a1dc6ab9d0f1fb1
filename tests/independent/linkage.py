"""Crank-sliders and six-bars: the drive of the bed, the cam that balances it at either end, and the cam as it is cut.

Shares nothing with camgen but the keys of the machine file. Joints are intersections of circles, their derivatives truncated power
series in 80-bit floats; no angle of a linkage is ever computed but for the two that are told. The reversal is the stretch between the
two changes of sign of the bed's acceleration about the end; air follows p·v^k = const from ambient pressure at its start. Extremes
are searched by scanning and zooming in. The cut cam is read by ezdxf: on each arc the roller's centre runs on a circle, and of all the
crossings of its path with such circles the highest is where the roller stands.

usage: linkage.py CAMGEN_BINARY DIRECTORY [--count N] [--seed N] [--jobs N]
"""
import csv
import json
import math
import random
import re
import subprocess
import sys
import time
import traceback
from collections import Counter, defaultdict
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import cases
import numpy as np
from outline import Chain, polyline

X = np.longdouble
PI = X("3.14159265358979323846264338327950288")
DEG, AT = PI / 180, X("98066.5")
# A double's rounding, 1e-16, times the few hundred operations from the machine file to a figure; 500 machines came to 3e-15.
CLOSE = 1e-13
# Each derivative of the law takes one more of the bed, and each of those divides once more by what is small near a dead point: a power
# of ten an order; 500 machines came to 3e-14, 6e-14 and 8e-14 of the largest.
SLOPES = {1: 3e-13, 2: 2e-12, 3: 1e-11}
# The place of an extreme that is searched by value is known to the root of the rounding of the value only.
PLACE = 3e-8


# ---- power series in one variable, a row for each order, a column for each place


def product(a, b):
    return np.array([sum(a[i] * b[n - i] for i in range(n + 1)) for n in range(len(a))])


def quotient(a, b):
    c = np.zeros_like(a)
    for n in range(len(a)):
        c[n] = (a[n] - sum(c[i] * b[n - i] for i in range(n))) / b[0]
    return c


def root(a):
    c = np.zeros_like(a)
    c[0] = np.sqrt(a[0])
    for n in range(1, len(a)):
        c[n] = (a[n] - sum(c[i] * c[n - i] for i in range(1, n))) / (2 * c[0])
    return c


def power(a, exponent):
    c = np.zeros_like(a)
    c[0] = a[0] ** exponent
    for n in range(1, len(a)):
        c[n] = sum((exponent * i - (n - i)) * a[i] * c[n - i] for i in range(1, n + 1)) / (n * a[0])
    return c


def constant(value, like):
    c = np.zeros_like(like)
    c[0] = value
    return c


def crossing(p, rp, q, rq):
    """Where the circles about p and q cross, on the left of the way from p to q."""
    d = q[0] - p[0], q[1] - p[1]
    squared = product(d[0], d[0]) + product(d[1], d[1])
    along = (squared + constant(rp**2 - rq**2, squared)) / 2
    beside = root(product(squared, constant(rp**2, squared)) - product(along, along))
    along, beside = quotient(along, squared), quotient(beside, squared)
    return (p[0] + product(along, d[0]) - product(beside, d[1]), p[1] + product(along, d[1]) + product(beside, d[0]))


FACTORIAL = np.array([math.factorial(n) for n in range(12)], dtype=X)


class Drive:
    """Shaft of the driving crank to bed; mm."""

    def __init__(self, m):
        self.m, self.r = m, m["r"]
        self.rod, self.offset = m["rod"] * self.r, m["offset"] * self.r
        self.memo = {}

    def joints(self, crank, order):
        """Series of A, B (of a six-bar), C and the bed's way from the shaft of its crank, by the angle of the driving crank."""
        crank = np.atleast_1d(np.asarray(crank, dtype=X))
        wave = lambda shift: np.array([np.cos(crank + (n + shift) * PI / 2) / FACTORIAL[n] for n in range(order + 1)])
        a = wave(0), wave(-1)
        if self.m["kind"] == "crank-slider":
            b, c = None, (self.r * a[0], self.r * a[1])
        else:
            base, coupler, driven = self.m["base"], self.m["coupler"], self.m["follower"]
            o = constant(base * np.cos(self.m["base_angle"]), a[0]), constant(base * np.sin(self.m["base_angle"]), a[0])
            b = crossing(o, driven, a, coupler)
            u, v = (b[0] - o[0]) / driven, (b[1] - o[1]) / driven
            cos, sin = np.cos(self.m["follower_angle"]), np.sin(self.m["follower_angle"])
            c = self.r * (cos * u - sin * v), self.r * (sin * u + cos * v)
            b = b, o
        away = c[1] - constant(self.offset, c[1])
        bed = c[0] + root(constant(self.rod**2, away) - product(away, away))
        return a, b, c, bed

    def bed(self, crank, order=3):
        """The bed's way and its derivatives."""
        return self.joints(crank, order)[3] * FACTORIAL[: order + 1, None]

    def angles(self, crank):
        """Transmission angle of the drag link and angle of the rod, from the joints."""
        a, b, c, bed = self.joints(crank, 0)
        rod = np.arctan2(c[1][0] - self.offset, bed[0] - c[0][0])
        if b is None:
            return None, rod
        b, o = b
        e, f = (a[0][0] - b[0][0], a[1][0] - b[1][0]), (o[0][0] - b[0][0], o[1][0] - b[1][0])
        turn = np.abs(np.arctan2(e[0] * f[1] - e[1] * f[0], e[0] * f[0] + e[1] * f[1]))
        return np.minimum(turn, PI - turn), rod

    def roots(self, order):
        """Places within a turn where a derivative is 0: changes of sign of a scan, then Newton's steps on the series."""
        if order not in self.memo:
            grid = 2 * PI * (np.arange(1441, dtype=X) / 1440 + X(1) / 9999)
            values = self.bed(grid, order)[order]
            at = grid[:-1][(values[:-1] < 0) != (values[1:] < 0)] + PI / 1440
            for _ in range(7):
                d = self.bed(at, order + 1)
                at = at - np.clip(d[order] / d[order + 1], -PI / 1440, PI / 1440)
            self.memo[order] = at
        return self.memo[order]


def largest(f, low, high, cells=1200):
    """Largest of f and its place, f on arrays: a scan, then about the best place again and again."""
    low, high = X(low), X(high)
    least, most, best = low, high, None
    for _ in range(7):
        at = low + (high - low) * np.arange(cells + 1, dtype=X) / cells
        values = f(at)
        i = int(np.argmax(values))
        if best is None or values[i] > best[0]:
            best = values[i], at[i]
        cell = (high - low) / cells
        low, high = max(least, best[1] - 2 * cell), min(most, best[1] + 2 * cell)
        cells = 60
        if cell < 1e-10:
            break
    return best


class End:
    """The reversal of the bed at one end, by the angle from its start; SI but for the memo."""

    def __init__(self, m, drive, end):
        self.m, self.drive, self.sign = m, drive, 1 if end == "outer" else -1
        zeros, dead = drive.roots(2), drive.roots(1)
        self.changes = len(zeros)
        if len(zeros) != 2 or len(dead) != 2:
            return
        # This end is where the bed is farthest its way; its reversal is the stretch between the zeros around it.
        y = self.sign * drive.bed(dead, 0)[0]
        dead = dead[np.argmax(y)]
        before = [(dead - z) % (2 * PI) for z in zeros]
        self.start, self.end = dead - min(before), dead - max(before) + 2 * PI
        self.dead, self.whole = dead - self.start, self.end - self.start
        self.y0 = self.sign * drive.bed(self.start, 0)[0][0]
        extremes = drive.roots(3)
        a = -self.sign * drive.bed(extremes, 2)[2]
        self.hardest, self.most = (extremes[np.argmax(a)] - self.start) % (2 * PI), a.max() / 1000
        self.omega = lambda rpm: m["turns"] * X(rpm) * 2 * PI / 60
        # The pair of cylinders has its end pressure at the largest deceleration at the design speed.
        self.both = m["mass"] * self.omega(m["rpm"]) ** 2 * self.most / (m["p1"] - m["p0"])

    def way(self, angle, order=3):
        """Way from the start of the reversal and its derivatives, m."""
        y = self.sign * self.drive.bed(self.start + np.asarray(angle, dtype=X), order)
        y[0] -= self.y0
        return y / 1000

    def inertia(self, rpm, way):
        return -self.m["mass"] * self.omega(rpm) ** 2 * way[2]

    def air(self, column, shorter):
        return self.both * self.m["p0"] * np.expm1(-self.m["k"] * np.log1p(-shorter / column))

    def shorter(self, force, share=1):
        """By how much a column is shorter that bears a force."""
        return -share * np.expm1(-np.log1p(force / self.both / self.m["p0"]) / self.m["k"])

    def column(self, rpm):
        """Column of the cam cut for a speed."""
        if not isinstance(self.m["column"], str):
            return self.m["column"]
        if self.m["column"] == "return":
            return self.returning(rpm)
        # The bottom stands still at the start: the stiffness of the air times the bed's speed is the growth of the inertia force.
        way = self.way(X(0))[:, 0]
        return self.both * self.m["k"] * self.m["p0"] * way[1] / (-self.m["mass"] * self.omega(rpm) ** 2 * way[3])

    def returning(self, rpm):
        """At the dead point the bottom is where it was when the reversal began: the bed alone shortens the column."""
        way = self.way(self.dead)[:, 0]
        return way[0] / self.shorter(self.inertia(rpm, way))

    def reset(self, rpm, cut):
        """Column with which the cam cut for a speed has the right pressure at the largest deceleration at another."""
        most = lambda n: self.m["mass"] * self.omega(n) ** 2 * self.most
        return self.shorter(most(cut), self.column(cut)) / self.shorter(most(rpm))

    def bottom(self, angle, rpm, column, orders=4):
        """Way of the bottom and its derivatives, m, by the crank angle."""
        y = self.way(angle, orders + 1)
        series = y / FACTORIAL[: orders + 2, None]
        bend = y[2:] / FACTORIAL[:orders, None]
        ratio = constant(1, bend) - bend * (self.m["mass"] * self.omega(rpm) ** 2 / self.both / self.m["p0"])
        shorter = column * (constant(1, ratio) - power(ratio, -1 / self.m["k"]))
        s = shorter - series[:orders]
        s[0] -= self.m["lead"]
        return s * FACTORIAL[:orders, None]


class Wrong(list):
    def __init__(self):
        super().__init__()
        self.largest, self.notes = defaultdict(float), []

    def close(self, told, true, what, relative=CLOSE, absolute=0.0):
        told, true = np.broadcast_arrays(np.asarray(told, dtype=X), np.asarray(true, dtype=X))
        off = np.abs(told - true)
        slack = np.broadcast_to(relative * np.abs(true) + absolute, off.shape)
        used = off / np.maximum(slack, X(1e-300))
        if off.size:
            i = int(np.argmax(np.where(np.isfinite(off), used, np.inf)))
            self.largest[what] = max(self.largest[what], float(used.flat[i]))
            if not off.flat[i] <= slack.flat[i]:
                place = f", {i} of {off.size}" if off.size > 1 else ""
                self.append(f"{what} told {float(told.flat[i])!r}, is {float(true.flat[i])!r} (off {float(off.flat[i]):.1e}, "
                            f"allowed {float(slack.flat[i]):.1e}{place})")

    def below(self, value, limit, what):
        self.largest[what] = max(self.largest[what], float(value / limit) if limit else float(value))
        if not value <= limit:
            self.append(f"{what}: {float(value):.6g}, above {float(limit):.6g}")


def run(binary, command, words, directory, name, formats):
    got = subprocess.run([binary, command, *words, "--json", "--out", str(directory), "--name", name, "--overwrite", "--force",
                          "--format", formats], capture_output=True, text=True)
    return got, json.loads(got.stdout) if got.stdout.startswith("{") else None


def table(path):
    with open(path, newline="") as file:
        rows = list(csv.reader(file))
    columns = list(zip(*rows[1:]))
    number = lambda cell: float(cell) if cell else math.nan
    return {name: np.array([number(c) for c in column]) for name, column in zip(rows[0], columns)}


# ---- machines


def settings(m):
    """The --set words of a machine, as decimals that are the very numbers used here."""
    of = lambda value, unit="": f"{float(value)!r}{unit}"
    pairs = {
        "bed.mass": of(m["mass"], "kg"), "bed.crank_radius": of(m["r"], "mm"),
        "bed.crank_turns_per_main_shaft_turn": of(m["turns"]),
        "linkage.rod_ratio": of(m["rod"]), "linkage.offset_ratio": of(m["offset"]), "design.rpm": of(m["rpm"]),
        "buffer.polytropic_exponent": of(m["k"]), "buffer.ambient_pressure": of(m["p0"] / AT, "at"),
        "buffer.end_pressure": of(m["p1"] / AT, "at"),
        "buffer.column": m["column"] if isinstance(m["column"], str) else of(1000 * m["column"], "mm"),
        "buffer.lead": of(1000 * m["lead"], "mm"), "cam.cam_turns_per_crank_turn": repr(1 / m["lobes"]),
        "cam.lever": of(m["lever"]), "cam.rotation": m["rotation"], "transition.kind": m["transition"],
        "transition.width": of(m["width"] / DEG, "deg"), "follower.roller.radius": of(m["roller"], "mm"),
        "follower.roller.offset": of(m["side"], "mm"), "conoid.mode": m["mode"],
    }
    if m["kind"] == "six-bar":
        pairs |= {"linkage.base_ratio": of(m["base"]), "linkage.coupler_ratio": of(m["coupler"]),
                  "linkage.follower_ratio": of(m["follower"]),
                  "linkage.follower_angle": of(m["follower_angle"] / DEG, "deg"),
                  "linkage.base_angle": of(m["base_angle"] / DEG, "deg")}
    return [m["file"], *(word for key, value in pairs.items() for word in ("--set", f"{key}={value}"))]


EMBEDDED = dict(mass=978.2, r=180.0, turns=3.0, rod=3.0, offset=0.0, rpm=35.0, k=1.35, q=2.0, p0=1.0, column="matched", lead=0.0,
                lobes=1, lever=1.0, rotation="cw", transition="run-up", width=20.0, roller=30.0, side=0.0, mode="adjusted")
DRAG = dict(kind="six-bar", file="dpi-six-bar", base=0.1, coupler=0.8, follower=0.6, follower_angle=180.0, base_angle=0.0)
SLIDER = dict(kind="crank-slider", file="dpi-crank-slider")


# 4: a bed that is beyond the lead when the air is at rest again, 8.66 mm before where it began: the bottom must not jump there.
# 5, 6: a lead without a run-up. No outline follows that corner; it may be refused, but in words a user understands.
CORNERS = {4: dict(SLIDER, ends="outer", offset=-0.4, lead=3.0), 5: dict(DRAG, ends="outer", lead=3.0, transition="none"),
           6: dict(SLIDER, ends="inner", lead=20.0, transition="none")}


def machine(number, rng):
    """The embedded ones at both ends, by their plain machine files, a few odd ones, then random ones."""
    if number < 4:
        m = dict(EMBEDDED, **(DRAG if number < 2 else SLIDER), ends=["outer", "inner"][number % 2], embedded=True)
    elif number in CORNERS:
        m = dict(EMBEDDED, **{"embedded": False}) | CORNERS[number]
    else:
        near = lambda low, high, digits=3: float(round(rng.uniform(low, high), digits))
        m = dict(DRAG if rng.random() < 0.6 else SLIDER)
        m |= dict(mass=near(50, 4000), r=near(40, 300), turns=rng.choice([1.0, 3.0, near(0.5, 5)]), rod=near(1.7, 6), rpm=near(8, 80),
                  offset=rng.choice([0.0, 0.0, near(-0.6, 0.6)]), k=rng.choice([1.35, 1.0, near(1.0, 1.7)]),
                  p0=rng.choice([1.0, near(0.5, 2)]),
                  q=rng.choice([2.0, 5.0, near(1.1, 6)]), column=rng.choice(["matched", "matched", "return", "length"]), lead=0.0,
                  lobes=rng.choice([1, 1, 1, 2, 3]), lever=rng.choice([1.0, near(0.4, 1.6)]), rotation=rng.choice(["cw", "ccw"]),
                  transition=rng.choice(["run-up", "run-up", "none", "blend"]), width=near(8, 30), roller=near(12, 40),
                  side=rng.choice([0.0, near(-20, 20)]), mode=rng.choice(["adjusted", "fixed"]), ends=rng.choice(["outer", "inner"]),
                  embedded=False)
        # A lead is refused with a blend.
        if m["transition"] != "blend" and rng.random() < 0.25:
            m["lead"] = near(1, 0.1 * m["r"])
        if m["kind"] == "six-bar":
            # Links that turn: base shortest, and Grashof; with half of the margin left at the least.
            m["base"] = near(0.02, 0.3)
            m["follower"] = near(0.55, 1.3)
            gap = 0.75 * (1 - m["base"])
            low = max(1 + m["base"] - m["follower"] + 0.1, m["follower"] - gap, 0.5)
            m["coupler"] = near(low, max(min(m["follower"] + gap, 1.4), low + 0.01))
            m["follower_angle"], m["base_angle"] = near(110, 230), rng.choice([0.0, near(-180, 180)])
    m = {key: X(value) if isinstance(value, float) else value for key, value in m.items()}
    for key in ("follower_angle", "base_angle", "width"):
        if key in m:
            m[key] *= DEG
    m["lead"] /= 1000
    m["p0"], m["p1"] = m["p0"] * AT, m["p0"] * m["q"] * AT
    # The decimals camgen is told.
    m["p1"] = X(float(m["p1"] / AT)) * AT
    m["lead"] = X(float(1000 * m["lead"])) / 1000
    if m["column"] == "length":
        # From half to double of what a column of the whole stroke would be.
        m["column"] = X(float(m["r"] * X(rng.uniform(0.8, 2.2)) / -np.expm1(-np.log(m["p1"] / m["p0"]) / m["k"]))) / 1000
        m["column"] = X(float(1000 * m["column"])) / 1000
    return m


# ---- the commands


def judge_linkage(m, drive, report, wrong, rpm):
    told, rows = report["linkage"], table(report["files"][0])
    omega = m["turns"] * X(rpm) * 2 * PI / 60
    crank = rows["crank_deg"].astype(X) * DEG
    d = drive.bed(crank, 3)
    scale = [np.abs(v).max() for v in d]
    # Every derivative is judged against its largest: the rounding of a sum does not shrink with it.
    for n, name in enumerate(["x_mm", "velocity_mm_per_rad", "acceleration_mm_per_rad2", "jerk_mm_per_rad3"]):
        wrong.close(rows[name], d[n], f"linkage {name}", 0, SLOPES.get(n, CLOSE) * scale[n])
    force, mass = -m["mass"] * omega**2 * d[2] / 1000, m["mass"]
    wrong.close(rows["velocity_m_per_s"], omega * d[1] / 1000, "linkage velocity", 0, CLOSE * omega * scale[1] / 1000)
    wrong.close(rows["acceleration_m_per_s2"], omega**2 * d[2] / 1000, "linkage acceleration", 0,
                SLOPES[2] * omega**2 * scale[2] / 1000)
    wrong.close(rows["inertia_n"], force, "linkage inertia", 0, SLOPES[2] * np.abs(force).max())
    # The drive gives what the inertia takes: power is what it works against the bed a second.
    power_ = -force * omega * d[1] / 1000
    wrong.close(rows["power_w"], power_, "linkage power", 0, SLOPES[2] * np.abs(power_).max())
    wrong.close(rows["torque_nm"], power_ / omega, "linkage torque", 0, SLOPES[2] * np.abs(power_ / omega).max())
    transmission, rod = drive.angles(crank)
    wrong.close(rows["rod_deg"], rod / DEG, "linkage rod_deg", 0, CLOSE * 90)
    if transmission is not None:
        # An arc cosine in doubles near 90° and an arc tangent differ by roundings only.
        wrong.close(rows["transmission_deg"], transmission / DEG, "linkage transmission_deg", 0, CLOSE * 90)
    elif "transmission_deg" in rows and not np.isnan(rows["transmission_deg"]).all():
        wrong.append("a crank-slider with a transmission angle of a drag link")
    if "air_n" in rows:
        judge_both_ends(m, drive, rows, crank, force, wrong, rpm)
    figures, peaks = drive_figures(m, drive)
    for key in ("c_plus", "c_minus", "k_c", "w", "velocity_coefficient", "stroke_mm"):
        wrong.close(told[key], figures[key], f"linkage {key}", CLOSE)
    wrong.close(told["k_phi"], figures["k_phi"], "linkage k_phi", 1e-12)
    for key in ("outer_deg", "inner_deg"):
        turn = (X(told[key]) * DEG - figures[key] + PI) % (2 * PI) - PI
        wrong.close(turn, 0, f"linkage {key}", 0, 1e-12)
    zeros = drive.roots(2)
    for one in told["zero_deg"]:
        off = np.abs((zeros - X(one) * DEG + PI) % (2 * PI) - PI).min()
        wrong.close(off, 0, "linkage zero_deg", 0, 1e-12)
    if len(told["zero_deg"]) != len(zeros):
        wrong.append(f"{len(told['zero_deg'])} zeros told, there are {len(zeros)}")
    wrong.close(told["inertia_max_n"], mass * omega**2 * peaks["a"] / 1000, "linkage inertia_max_n", CLOSE)
    wrong.close(told["torque_max_nm"], mass * omega**2 * peaks["va"] / 1e6, "linkage torque_max_nm", CLOSE)
    wrong.close(told["power_max_w"], mass * omega**3 * peaks["va"] / 1e6, "linkage power_max_w", CLOSE)
    rod_most = largest(lambda f: np.abs(drive.angles(f)[1]), 0, 2 * PI)[0]
    wrong.close(told["rod_angle_max_deg"], rod_most / DEG, "linkage rod_angle_max_deg", CLOSE)
    if transmission is not None:
        least = -largest(lambda f: -drive.angles(f)[0], 0, 2 * PI)[0]
        wrong.close(told["transmission_min_deg"], least / DEG, "linkage transmission_min_deg", CLOSE)
        plain, _ = drive_figures(m, Drive(dict(m, kind="crank-slider")))
        c, c0 = (max(f["c_plus"], f["c_minus"]) for f in (figures, plain))
        wrong.close(told["compared"]["c"], c / c0 - 1, "linkage compared c", 0, CLOSE)
        wrong.close(told["compared"]["w"], figures["w"] / plain["w"] - 1, "linkage compared w", 0, CLOSE)
        wrong.close(told["compared"]["speed"], np.sqrt(c0 / c) - 1, "linkage compared speed", 0, CLOSE)
    check = {c["check"]: c for c in report["checks"]}
    wrong.close(check["reversals"]["value"], len(zeros), "linkage reversals", 0, 0)
    if (check["reversals"]["verdict"] == "pass") != (len(zeros) == 2):
        wrong.append(f"reversals {check['reversals']['verdict']} with {len(zeros)} changes of sign")
    wrong.close(X(check["dead_points"]["value"]) * DEG, figures["outward"], "linkage dead_points", 0, 1e-12)


def judge_both_ends(m, drive, rows, crank, force, wrong, rpm):
    """The air of the end whose reversal a row stands in, as a force along the bed's way, and the bottom that cam would need."""
    ends = [End(m, drive, name) for name in ("outer", "inner")]
    if ends[0].changes != 2:
        if not np.isnan(rows["air_n"]).all():
            wrong.append(f"air told of a bed whose acceleration changes its sign {ends[0].changes} times")
        return
    left = np.ones(len(crank), dtype=bool)
    for end in ends:
        angle = (crank - end.start) % (2 * PI)
        # A row at the very change of sign has no force in either.
        mine = (angle > 1e-9) & (angle < end.whole - 1e-9)
        left &= ~mine
        column, way = end.column(rpm), end.way(angle[mine], 2)
        bottom = end.bottom(angle[mine], rpm, column, 1)[0]
        told = rows["dx_mm"][mine].astype(X) / 1000
        air = end.sign * end.air(column, way[0] + told + m["lead"])
        slack = 1e-12 * np.abs(force).max()
        wrong.close(told, bottom, "linkage dx", 0, 1e-13 * (column + 2 * m["r"] / 1000))
        wrong.close(air, force[mine], "linkage air and inertia", 0, 1e-11 * np.abs(force).max())
        wrong.close(rows["air_n"][mine], air, "linkage air_n", 0, slack)
        wrong.close(rows["residual_n"][mine], force[mine] - air, "linkage residual_n", 0, slack)
    if left.sum() > 2:
        wrong.append(f"{left.sum()} rows in no reversal")


def drive_figures(m, drive):
    if "figures" in drive.memo:
        return drive.memo["figures"]
    dead, extremes = drive.roots(1), drive.roots(3)
    ways = drive.bed(dead, 0)[0]
    outer, inner = dead[np.argmax(ways)], dead[np.argmin(ways)]
    stroke = ways.max() - ways.min()
    a = drive.bed(extremes, 2)[2]
    va = largest(lambda f: np.abs(np.prod(drive.bed(f, 2)[1:3], axis=0)), 0, 2 * PI)[0]
    speed = np.abs(drive.bed(drive.roots(2), 1)[1]).max()
    out = (inner - outer) % (2 * PI)
    plus, minus = PI**2 * -a.min() / stroke, PI**2 * a.max() / stroke
    figures = dict(c_plus=plus, c_minus=minus, k_c=plus / minus, w=PI**3 * va / stroke**2, velocity_coefficient=PI * speed / stroke,
                   stroke_mm=stroke, k_phi=out / (2 * PI - out), outer_deg=outer, inner_deg=inner, outward=out)
    drive.memo["figures"] = figures, dict(a=np.abs(a).max(), va=va)
    return drive.memo["figures"]


def between(at, nodes, values, width=16):
    """Values between equally spaced ones by the polynomial through the nearest sixteen."""
    step = nodes[1] - nodes[0]
    first = np.clip(np.floor((at - nodes[0]) / step).astype(int) - width // 2 + 1, 0, len(nodes) - width)
    t = (at - nodes[first]) / step
    total = np.zeros_like(t)
    for i in range(width):
        weight = np.ones_like(t)
        for j in range(width):
            if i != j:
                weight *= (t - j) / X(i - j)
        total += weight * values[first + i]
    return total


def ends_of(nodes, values, low, high):
    """Value and slope at both ends of a stretch of a table, from the polynomial that fits its rows best, and how well it fits."""
    inside = (nodes > low + 1e-9) & (nodes < high - 1e-9)
    if inside.sum() < 10:
        return None
    fit = np.polynomial.Chebyshev.fit(nodes[inside].astype(float), values[inside].astype(float), min(9, int(inside.sum()) - 3),
                                      domain=[float(low), float(high)])
    slope = fit.deriv()
    misfit = np.abs(fit(nodes[inside].astype(float)) - values[inside].astype(float)).max()
    return [(fit(float(e)), slope(float(e))) for e in (low, high)], misfit


def judge_balance(m, end, rows, rpm, column, wrong, what, lobes):
    """The table of one cam or one section against the linkage and the gas."""
    turn = rows["crank_deg"].astype(X) * DEG
    force_most = m["mass"] * end.omega(rpm) ** 2 * end.most
    lead, length = m["lead"], column
    # The start of the reversal is a root: a place known to a few ulp, so rows within that of its ends may lie on either side.
    inside = (turn <= end.whole - 1e-12) | (turn < 1e-12)
    outside = turn > end.whole + 1e-12
    blend = np.zeros_like(inside)
    if m["transition"] == "blend":
        half = m["width"] / 2
        blend = (turn < half) | (np.abs(turn - end.whole) < half) | (2 * PI - turn < half)
    way = end.way(turn, 2)
    inertia = np.where(inside, end.inertia(rpm, way), 0)
    told_bottom = rows["dx_mm"].astype(X) / 1000
    shorter = way[0] + told_bottom + lead
    air = np.where(inside, end.air(length, np.where(inside, shorter, 0)), 0)
    stroke = m["r"] / 1000 * 2
    wrong.close(rows["x_mm"] / 1000, way[0], f"{what} x", 0, 1e-13 * (m["rod"] + 2) * stroke)
    exact = inside & ~blend
    bottom = end.bottom(turn[exact], rpm, length)
    # The law is a difference of the column and the way: roundings of both.
    size = length + stroke
    wrong.close(told_bottom[exact], bottom[0], f"{what} dx", 0, 1e-13 * size)
    # Equal forces at every angle: the gas at the told bottom, the bed by the linkage.
    wrong.close(air[exact], inertia[exact], f"{what} air and inertia", 0, 1e-11 * force_most)
    # The rounding of the way, through the slope of the force.
    slack = 1e-12 * force_most
    wrong.close(rows["inertia_n"], inertia, f"{what} inertia_n", 0, slack)
    wrong.close(rows["air_n"], air, f"{what} air_n", 0, slack)
    wrong.close(rows["residual_n"], inertia - air, f"{what} residual_n", 0, slack)
    # A buffer with a fixed bottom has a column of its own, with which it balances the bed at the dead point.
    plain = end.returning(rpm)
    fixed = np.where(inside, end.air(plain, np.where(inside, way[0], 0)), 0)
    wrong.close(rows["air_fixed_bottom_n"], fixed, f"{what} fixed bottom", 0, slack)
    wrong.close(rows["air_n"][outside], 0, f"{what} air outside", 0, 0)
    wrong.close(rows["roller_force_n"], rows["air_n"] / m["lever"], f"{what} roller_force_n", 1e-14)
    # Outside the reversal nothing is compressed, so that the pressure is ambient when it begins; a blend rounds just that.
    if m["transition"] != "blend":
        wrong.close(np.maximum(shorter[outside], 0), 0, f"{what} compressed outside", 0, 1e-12 * size)
    if lead:
        # On the lead the bottom goes before the piston, and behind it on the way back.
        on_lead = outside & (turn > PI) & (turn > 2 * PI - (lead / end.way(X(0))[1][0]) * X(0.999)) & (way[0] > -lead)
        wrong.close(shorter[on_lead], 0, f"{what} lead", 0, 1e-12 * size)
        behind = outside & (turn < PI + end.whole / 2) & (way[0] > -lead)
        wrong.close(shorter[behind], 0, f"{what} lead back", 0, 1e-12 * size)
    # Slopes of the lift, by the angle of the cam.
    lever = m["lever"]
    size_of = [1000 * lever * lobes**n * np.abs(bottom[n]).max() for n in range(4)]
    for n, name in [(1, "velocity_mm_per_rad"), (2, "acceleration_mm_per_rad2"), (3, "jerk_mm_per_rad3")]:
        true = 1000 * lever * lobes**n * bottom[n]
        rounding = 1e-13 * 1000 * float(lever) * size * lobes**n
        wrong.close(rows[name][exact], true, f"{what} {name}", 0, SLOPES[n] * size_of[n] + rounding)
    wrong.close(rows["torque_nm"], rows["roller_force_n"] * rows["velocity_mm_per_rad"] / 1000, f"{what} torque_nm", 1e-12,
                1e-13 * float(force_most * stroke))
    at_rest(m, end, rpm, length, turn, told_bottom, wrong, what, lobes, size)
    if m["transition"] != "blend":
        # Equal work: what the air takes over the braking half is the energy of the bed at the start of the reversal.
        count = int(inside[: len(inside) // lobes].sum())
        nodes, weights = np.polynomial.legendre.leggauss(40)
        nodes, weights = nodes.astype(X), weights.astype(X)
        pieces = 6
        at = (end.dead / pieces * ((nodes[None, :] + 1) / 2 + np.arange(pieces)[:, None])).ravel()
        weight = np.tile(weights * end.dead / pieces / 2, pieces)
        told = between(at, turn[:count], told_bottom[:count])
        there = end.way(at, 1)
        work = (weight * end.air(length, there[0] + told + lead) * there[1]).sum()
        energy = m["mass"] * (end.omega(rpm) * end.way(X(0))[1][0]) ** 2 / 2
        wrong.close(work, energy, f"{what} work and energy", 1e-9)


def at_rest(m, end, rpm, column, turn, told, wrong, what, lobes, size):
    """Between two reversals: the bottom comes back to where it began, without a jump, nor a kink where there is a transition."""
    one = len(turn) // lobes
    for lobe in range(1, lobes):
        wrong.close(told[lobe * one:(lobe + 1) * one], told[:one], f"{what} lobes", 0, 1e-12 * size)
    turn, told = turn[:one], told[:one]
    width, lead, whole = m["width"], m["lead"], 2 * PI
    law = lambda angle: end.bottom(X(angle), rpm, column)[:2, 0]
    kinds = m["transition"]
    if kinds == "blend":
        half = width / 2
        knots = [(end.whole - half, *law(end.whole - half)), (end.whole + half, None, None), (whole - half, None, None),
                 (whole + half, *law(half))]
        turn, told = np.concatenate([turn, turn + whole]), np.concatenate([told, told])
    else:
        first, last = X(0), end.whole
        start, stop = law(0), law(end.whole)
        if lead:
            # From where the piston is a lead away from the start of the reversal.
            for _ in range(8):
                way = end.way(np.array([first, last]), 1)
                first, last = first - (way[0][0] + lead) / way[1][0], last - (way[0][1] + lead) / way[1][1]
            start = stop = None
            way = end.way(np.array([first, last]), 1)
            start, stop = (X(0), -way[1][0]), (X(0), -way[1][1])
            if end.way(end.whole)[0][0] < -lead:
                # The bed has gone beyond the lead when the air is at rest: no way back on the lead. Whether the bottom goes on with
                # its law or with the piston is camgen's to choose; it cannot jump.
                last, stop = end.whole, (law(end.whole)[0], None)
        ramp = width if kinds == "run-up" else X(0)
        knots = [(last, *stop), (last + ramp, None, None), (whole + first - ramp, None, None), (whole + first, *start)]
        if kinds == "none":
            knots = [(last, stop[0], None), (whole + first, start[0], None)]
    before = None
    for (low, v0, s0), (high, v1, s1) in zip(knots, knots[1:]):
        got = ends_of(turn, told, low, high)
        if got is None:
            before = None
            continue
        ((a, sa), (b, sb)), misfit = got
        # A polynomial's slope at its end is worse than its misfit by the square of its degree over the width.
        fits = 1e-12 * size
        wrong.close(misfit, 0, f"{what} polynomial at rest", 0, fits)
        slopes = 400 * fits / float(high - low)
        for known, slope, value, its in [(v0, s0, a, sa), (v1, s1, b, sb)]:
            if known is not None:
                wrong.close(value, known, f"{what} continuous", 0, 10 * fits)
            if slope is not None:
                wrong.close(its, slope, f"{what} no kink", 0, slopes)
        if before is not None and v0 is None:
            wrong.close(a, before[0], f"{what} continuous", 0, 10 * fits)
            if kinds != "none":
                wrong.close(sa, before[1], f"{what} no kink", 0, slopes + before[2])
        before = b, sb, slopes


class Rolled:
    """Height of a roller's centre along its path, by the angle of the cam, on an outline of arcs and lines."""

    def __init__(self, path, roller, side, ccw):
        _, vertices = polyline(path)
        chain = Chain(vertices)
        mirror = -1.0 if ccw else 1.0
        turn = 1.0 if chain.area() > 0 else -1.0
        self.mirror, self.side = mirror, side
        out = chain.sweep * turn > 0
        arc = chain.is_arc
        # The centre runs outside: farther from the middle of a convex arc, nearer to that of a hollow one.
        self.centre, self.radius = chain.centre[arc], chain.radius[arc] + np.where(out[arc], roller, -roller)
        spoke = chain.start[arc] - chain.centre[arc]
        self.from_ = np.arctan2(spoke[:, 1], spoke[:, 0]) + chain.sweep[arc] / 2
        self.half = np.abs(chain.sweep[arc]) / 2
        keep = self.radius > 1e-9
        self.centre, self.radius, self.from_, self.half = (v[keep] for v in (self.centre, self.radius, self.from_, self.half))
        line = ~arc
        along = (chain.end - chain.start)[line] / chain.length[line][:, None]
        normal = turn * np.stack([along[:, 1], -along[:, 0]], axis=1)
        self.line, self.along, self.length = chain.start[line] + roller * normal, along, chain.length[line]

    def height(self, theta):
        u = np.stack([np.cos(theta), np.sin(theta) * self.mirror], axis=1)
        foot = self.side * np.stack([-np.sin(theta), np.cos(theta) * self.mirror], axis=1)
        best = np.full(len(theta), -np.inf)
        d = foot[:, None, :] - self.centre
        b = d[..., 0] * u[:, None, 0] + d[..., 1] * u[:, None, 1]
        c = (d**2).sum(axis=2) - self.radius**2
        square = b * b - c
        with np.errstate(invalid="ignore"):
            step = np.sqrt(square)
            for sign in (1, -1):
                h = -b + sign * step
                p = d + h[..., None] * u[:, None, :]
                off = np.arctan2(p[..., 1], p[..., 0]) - self.from_
                off = np.abs((off + np.pi) % (2 * np.pi) - np.pi)
                # On the arc, or a hair beyond its ends, which touch the next arc's.
                fits = (square >= 0) & (off <= self.half + 1e-9 + 1e-9 / self.radius)
                best = np.maximum(best, np.where(fits, h, -np.inf).max(axis=1))
        for q, along, length in zip(self.line, self.along, self.length):
            d = foot - q
            cross = u[:, 0] * along[1] - u[:, 1] * along[0]
            with np.errstate(divide="ignore", invalid="ignore"):
                h = -(d[:, 0] * along[1] - d[:, 1] * along[0]) / cross
                t = (d + h[:, None] * u) @ along
            fits = np.isfinite(h) & (t >= -1e-9) & (t <= length + 1e-9)
            best = np.maximum(best, np.where(fits, h, -np.inf))
        return best


def judge_rotary(m, end, report, wrong, rpm, embedded):
    law, lobes = report["law"], m["lobes"]
    rows = table(next(f for f in report["files"] if f.endswith(".csv")))
    column = end.column(rpm)
    wrong.close(law["column_length_mm"], 1000 * column, "rotary column", CLOSE)
    area = end.both / 2
    wrong.close(law["piston_area_mm2"], area * 1e6, "rotary piston area", CLOSE)
    wrong.close(law["bore_mm"], 2000 * np.sqrt(area / PI), "rotary bore", CLOSE)
    force_most = m["mass"] * end.omega(rpm) ** 2 * end.most
    wrong.close(report["force"]["inertia_max_n"], force_most, "rotary inertia_max_n", CLOSE)
    judge_balance(m, end, rows, rpm, column, wrong, "rotary", lobes)
    one = len(rows["cam_deg"]) // lobes
    wrong.close(rows["crank_deg"], (rows["cam_deg"] * lobes) % 360 % (360 - 1e-9), "rotary crank_deg", 0, 1e-9)
    # Lift: the way of the bottom times the lever, above its lowest place anywhere.
    raised = rows["lift_mm"].astype(X) - m["lever"] * rows["dx_mm"].astype(X)
    size = float(1000 * column + 2 * m["r"])
    wrong.close(raised, raised[0], "rotary lift", 0, 1e-12 * size)
    lowest = -raised[0] / m["lever"]
    low = (X(rows["dx_mm"].min()) - lowest) * m["lever"]
    gap = 2 * PI / one
    bend = np.abs(rows["acceleration_mm_per_rad2"]).max()
    # The rows are half an angle of the table from the lowest place at most; at a corner without a transition, by the slope.
    steep = np.abs(rows["velocity_mm_per_rad"]).max() if m["transition"] == "none" or m["lead"] else 0
    if not -1e-12 * size <= low <= gap / lobes * steep + bend * (gap / lobes) ** 2:
        wrong.append(f"lowest place {float(low)} mm below the lowest row")
    if m["transition"] != "blend":
        worst = largest(lambda f: -end.bottom(f, rpm, column, 1)[0], 0, end.whole)[0]
        if -worst * 1000 < lowest - 1e-11 * size:
            wrong.append(f"lowest place told {float(lowest)} mm, the law goes to {float(-worst * 1000)}")
        way, slack = lambda f: end.way(f, 2), 1e-12 * float(force_most)
        torque = lambda f: np.abs(end.inertia(rpm, way(f)) * end.bottom(f, rpm, column, 2)[1]) * lobes
        wrong.close(report["force"]["torque_max_nm"], largest(torque, 0, end.whole)[0], "rotary torque_max_nm", 1e-12)
        wrong.close(report["force"]["roller_force_max_n"], force_most / m["lever"], "rotary roller_force_max_n", CLOSE)
        plain = end.returning(rpm)
        left = lambda f: np.abs(end.inertia(rpm, way(f)) - end.air(plain, way(f)[0]))
        most_left = largest(left, 0, end.whole)[0]
        wrong.close(report["force"]["residual_fixed_bottom_max_n"], most_left, "rotary fixed bottom max", CLOSE, slack)
        moved = lambda f: np.abs(end.bottom(f, rpm, column, 1)[0])
        most, place = largest(moved, 0, end.whole)
        if np.abs(rows["dx_mm"][rows["crank_deg"] > end.whole / DEG]).max() < most * 1000:
            there = end.bottom(place, rpm, column, 1)[0][0]
            wrong.close(law["dx_max_mm"], 1000 * there, "rotary dx_max_mm", CLOSE, 1e-12 * size)
            if np.abs(there) < most * (1 - 1e-9) or end.whole > place > 0:
                # A place that is told by the way: as flat there as the largest is.
                wrong.close(law["dx_max_at_x_mm"], 1000 * way(place)[0][0], "rotary dx_max_at_x", 0, PLACE * float(m["r"]) * 10)
        # Where the reversal begins or ends the bottom runs before the piston on a lead, rests without a transition, is met by a run-up.
        jumps = []
        for place in (X(0), end.whole):
            slope, way_ = end.bottom(place, rpm, column, 2)[1][0], end.way(place, 1)[:, 0]
            beside = -way_[1] if m["lead"] and way_[0] > -m["lead"] else slope if m["transition"] == "run-up" else X(0)
            jumps.append(np.abs(slope - beside))
        if not m["lead"] or end.way(end.whole)[0][0] >= -m["lead"]:
            wrong.close(abs(law["velocity_jump_mm_per_rad"]), 1000 * max(jumps), "rotary velocity jump", CLOSE, 1e-11 * size)
        wrong.close(law["start_slope"], end.bottom(X(0), rpm, column, 2)[1][0] / end.way(X(0))[1][0], "rotary start_slope", 0, 1e-11)
    # The roller's centre and the contact angle: from the lift and its slope.
    prime = X(report["cam"]["prime_radius_mm"])
    height = np.sqrt(prime**2 - m["side"] ** 2) + rows["lift_mm"]
    theta = rows["cam_deg"].astype(X) * DEG
    ccw = m["rotation"] == "ccw"
    along, across = np.array([np.cos(theta), np.sin(theta)]), np.array([-np.sin(theta), np.cos(theta)])
    centre = along * height + across * m["side"]
    if ccw:
        centre[1] *= -1
    wrong.close(rows["pitch_x_mm"], centre[0], "rotary pitch x", 0, 1e-13 * float(height.max()))
    wrong.close(rows["pitch_y_mm"], centre[1], "rotary pitch y", 0, 1e-13 * float(height.max()))
    # Along the path the roller goes v a radian, while the cam's own point goes height across and −side along it.
    slope = np.arctan2(np.abs(rows["velocity_mm_per_rad"] - m["side"]), height) / DEG
    wrong.close(np.abs(rows["pressure_angle_deg"]), slope, "rotary pressure angle", 0, CLOSE * 90)
    wrong.close(rows["contact_force_n"], np.maximum(rows["roller_force_n"], 0.0) / np.cos(slope * DEG), "rotary contact_force_n", 1e-12)
    values = {c["check"]: c["value"] for c in report["checks"]}
    if m["transition"] != "blend":
        # The least air is at the largest deceleration.
        wrong.close(values["air"], 1000 * (column - end.shorter(force_most, column)), "rotary least air", CLOSE, 1e-13 * size)
    wrong.close(values["residual"], report["force"]["residual_max_n"] / force_most, "rotary residual share", 1e-12)
    highest = X(report["cam"]["max_lift_mm"]) - X(rows["lift_mm"].max())
    if not -1e-13 * size <= highest <= gap / lobes * steep + bend * (gap / lobes) ** 2:
        wrong.append(f"largest lift told {float(highest)} mm above the highest row")
    checks = {c["check"]: c["verdict"] for c in report["checks"]}
    if checks.get("undercut") == "fail":
        wrong.notes.append("not rolled: undercut")
        return
    for check in ("outline", "rolling", "tangency"):
        if checks.get(check) == "fail":
            wrong.append(f"{check} fails, though no motion is lost to an undercut")
            return
    judge_cut(m, end, report, rows, wrong, rpm, column, prime, lowest, embedded)


def judge_cut(m, end, report, rows, wrong, rpm, column, prime, lowest, embedded):
    """The DXF as it is: lift, bottom, force and work of what is cut."""
    lobes, lever = m["lobes"], m["lever"]
    path = next(f for f in report["files"] if f.endswith(".dxf"))
    rolled = Rolled(path, float(m["roller"]), float(m["side"]), m["rotation"] == "ccw")
    base = float(np.sqrt(prime**2 - m["side"] ** 2))
    force_most = float(m["mass"] * end.omega(rpm) ** 2 * end.most)

    def cut(angle, lobe=0):
        """Bottom, m, by the crank's angle; the lobes are alike, but not their arcs."""
        height = rolled.height((np.asarray(angle, dtype=float) + 2 * np.pi * lobe) / lobes)
        return ((height - base) / float(lever) + float(lowest)) / 1000

    def force(angle, bottom):
        way = end.way(angle, 2)
        return end.inertia(rpm, way), end.air(column, way[0] + bottom + m["lead"])

    told = report["rolling"]
    theta = np.radians(rows["cam_deg"])
    height = rolled.height(theta)
    if not np.isfinite(height).all():
        wrong.append(f"the roller finds no outline at {np.degrees(theta[~np.isfinite(height)][:3])}")
        return
    off = np.abs(height - base - rows["lift_mm"])
    # The worst place may lie between the rows; none of them may be beyond it. DXF coordinates have twelve decimals.
    wrong.below(off.max(), told["lift_error_max_mm"] * (1 + 1e-4) + 1e-9, "cut lift error over the told one")
    tolerance = report["outline"]["tolerance_mm"]
    steep = np.cos(np.radians(np.abs(rows["pressure_angle_deg"])))
    # Along the normal; the normal turns a little over the tolerance.
    wrong.below((off * steep).max(), tolerance * 1.01, "cut gap over the tolerance")
    inside = np.degrees(float(end.whole)) - 1e-9 >= rows["crank_deg"]
    if "residual_cut_n" in rows:
        i, a = force(rows["crank_deg"][inside].astype(X) * DEG, (height[inside] - base) / lever / 1000 + lowest / 1000)
        stiff = float((end.both * m["k"] * (m["p0"] + force_most / end.both) / (column - end.shorter(force_most, column))))
        # A lift that is found from coordinates of 1e-12 mm and of a size of meters, times the stiffness of the air.
        slack = 1e-9 * force_most + stiff / 1000 * 2e-10 * float(prime)
        wrong.close(rows["residual_cut_n"][inside], np.abs(i - a), "cut residual_cut_n", 0, slack)
    at = np.linspace(0, float(end.whole), 2401)[:-1]
    at = at + (at[1] - at[0]) * 0.37
    lobe = np.arange(len(at)) % lobes
    i, a = force(at.astype(X), cut(at, lobe))
    most = np.abs(i - a).max()
    # Told is the largest at the places it was rolled at, of which there are as many as arcs and more; mine are others.
    wrong.below(most, told["residual_max_n"] * 1.001 + 1e-7 * force_most, "cut residual over the told one")
    lobe, place = np.divmod(told["residual_cam_deg"] * lobes, 360)
    place = np.radians([place])
    # With a blend it is often at the very start or end.
    if 2 * np.pi - place[0] < 1e-12:
        place[0] = 0
    if place[0] < end.whole + 1e-12:
        i, a = force(place.astype(X), cut(place, lobe))
        wrong.close(told["residual_max_n"], np.abs(i - a)[0], "cut residual at its place", 1e-6, 1e-7 * force_most)
    else:
        ends = float(end.whole / DEG)
        wrong.append(f"largest residual as cut told at {np.degrees(place[0])}° of the crank, the reversal ends at {ends}°")
    wrong.close(report["force"]["residual_max_n"], told["residual_max_n"], "cut residual in force", 1e-12)
    if m["transition"] == "blend":
        return
    # Work over the braking half, by trapezoids; forces bend by nothing sharper than the arcs, 1500 of them leave 1e-6.
    at = np.linspace(0, float(end.dead), 1501)
    bottom = cut(np.concatenate([at[:1] + 1e-12, at[1:]]))
    way = end.way(at.astype(X), 1)
    shorter = way[0] + bottom + m["lead"]
    air = end.air(column, shorter)
    speed = way[1]
    step = X(at[1] - at[0])
    integrate = lambda f: step * (f.sum() - (f[0] + f[-1]) / 2)
    work = integrate(air * speed)
    energy = m["mass"] * (end.omega(rpm) * speed[0]) ** 2 / 2
    # At the worst all of the lift is off one way, as far as is told.
    stiffness = m["k"] * (end.both * m["p0"] + air) / (column - shorter)
    bound = integrate(stiffness * speed) * told["lift_error_max_mm"] / lever / 1000 / energy
    share = float(np.abs(work / energy - 1))
    wrong.below(share, float(bound) * 1.01 + 1e-6, "cut work beyond its bound")
    # Not judged by itself: a short column is stiff, and 5 µm are more force there.
    wrong.largest["(cut work off, of 0.02 %)"] = max(wrong.largest["(cut work off, of 0.02 %)"], share / 2e-4)
    if embedded:
        wrong.below(share, 2e-4, "cut work of an embedded press")
    elif share > 2e-4:
        wrong.notes.append("cut work off by more than 0.02 %")


def judge_conoid(m, end, report, wrong, speeds):
    rows = table(next(f for f in report["files"] if f.endswith(".csv")))
    # The cam is laid out at the design speed; a reset column has the right pressure at the largest deceleration at the others.
    for section in report["sections"]:
        rpm = X(section["rpm"])
        column = end.column(m["rpm"]) if m["mode"] == "fixed" else end.reset(rpm, m["rpm"])
        wrong.close(section["column_length_mm"], 1000 * column, "conoid column", CLOSE)
        wrong.close(section["inertia_max_n"], m["mass"] * end.omega(rpm) ** 2 * end.most, "conoid inertia", CLOSE)
        slope = end.bottom(X(0), rpm, column, 2)[1][0] / end.way(X(0))[1][0]
        if m["transition"] != "blend":
            wrong.close(section["start_slope"], slope, "conoid start_slope", 0, 1e-11)
        mine = np.abs(rows["rpm"] - section["rpm"]) < 1e-9
        judge_balance(m, end, {k: v[mine] for k, v in rows.items()}, rpm, column, wrong, "conoid", m["lobes"])
    if sorted(X(s["rpm"]) for s in report["sections"]) != sorted(speeds):
        wrong.append(f"sections at {[s['rpm'] for s in report['sections']]}, asked for {[float(s) for s in speeds]}")


def judge_regimes(m, end, report, wrong, speeds, cut):
    told, lobes = report["regimes"], m["lobes"]
    wrong.close(told["cam_rpm"], cut, "regimes cam_rpm", 1e-15)
    column = end.column(cut)
    wrong.close(told["column_length_mm"], 1000 * column, "regimes column", CLOSE)
    most_cut = m["mass"] * end.omega(cut) ** 2 * end.most
    way = lambda f: end.way(f, 2)
    seen = {}
    for row in told["speeds"]:
        rpm = X(row["rpm"])
        same = rpm == cut
        reset = column if same else end.reset(rpm, cut)
        most = m["mass"] * end.omega(rpm) ** 2 * end.most
        slack = 1e-13 * float(max(most, most_cut))
        wrong.close(row["column_length_mm"], 1000 * reset, "regimes reset column", CLOSE)
        wrong.close(row["lambda"], reset / column, "regimes lambda", CLOSE)
        wrong.close(row["a_per_mm"], most / (m["p0"] * end.both * end.most) / 1000, "regimes a", CLOSE)
        added, volume = (reset - column) * end.both * 1e9, float(column * end.both * 1e9)
        wrong.close(row["added_volume_mm3"], added, "regimes added volume", 1e-12, 1e-13 * volume)

        def left(f):
            w = way(f)
            # As the cam has it cut: the air is as much shorter as the inertia of the cut speed asks for.
            return end.inertia(rpm, w) - end.air(reset, end.shorter(end.inertia(cut, w), column))

        residual, place = largest(lambda f: np.abs(left(f)), 0, end.whole)
        at_hardest = left(end.hardest)[0]
        wrong.close(at_hardest, 0, "regimes my end residual", 0, slack)
        wrong.close(row["end_residual_n"], 0, "regimes end residual", 0, slack)
        pressure = m["p0"] + end.air(reset, end.shorter(most_cut, column)) / end.both
        wrong.close(row["end_pressure_pa"], pressure, "regimes end pressure", CLOSE)
        wrong.close(pressure, m["p0"] + most / end.both, "regimes my end pressure", CLOSE)
        wrong.close(row["residual_max_n"], 0 if same else residual, "regimes residual", 1e-11, slack)
        wrong.close(row["residual_share"], 0 if same else residual / most, "regimes residual share", 1e-11, slack / float(most))
        if not same and residual > 1e-3 * most:
            # The ways out and back have equal forces at different places: on one of the two it must be the worst.
            x = X(row["residual_at_mm"]) / 1000
            f = np.linspace(0, 1, 2001).astype(X) * end.whole
            w = way(f)[0] - x
            places = f[:-1][(w[:-1] <= 0) != (w[1:] <= 0)] + end.whole / 4000
            for _ in range(6):
                there = way(places)
                places = places - (there[0] - x) / there[1]
            there = np.abs(left(places)).max() if len(places) else X(0)
            wrong.close(there, residual, "regimes residual at its place", 1e-10)
        speed = lambda f: way(f)[1]
        crank = largest(lambda f: np.abs(left(f) * speed(f)), 0, end.whole)[0]
        wrong.close(row["crank_torque_max_nm"], 0 if same else crank, "regimes crank torque", 1e-11, slack * float(m["r"]) / 100)

        def shaft(f):
            w = way(f)
            return np.abs(end.air(reset, end.shorter(end.inertia(cut, w), column)) * end.bottom(f, cut, column, 2)[1]) * lobes

        wrong.close(row["camshaft_torque_max_nm"], largest(shaft, 0, end.whole)[0], "regimes camshaft torque", 1e-11)
        seen[float(rpm)] = reset, left, slack, most
    if sorted(seen) != sorted(float(s) for s in speeds):
        wrong.append(f"speeds {sorted(seen)}, asked for {sorted(float(s) for s in speeds)}")
    rows = table(report["files"][1])
    for rpm, (reset, left, slack, most) in seen.items():
        mine = rows["rpm"] == rpm
        f = rows["crank_deg"][mine].astype(X) * DEG
        if f.max() < end.whole * X(1 - 1e-12):
            wrong.append(f"the curve ends at {float(f.max() / DEG)}°, the reversal at {float(end.whole / DEG)}°")
        w = way(f)
        ulps = 1e-12 * float(max(most, most_cut))
        wrong.close(rows["x_mm"][mine], 1000 * w[0], "regimes curve x", 0, 1e-12 * float(m["r"] * (2 + m["rod"])))
        wrong.close(rows["inertia_n"][mine], end.inertia(rpm, w), "regimes curve inertia", 0, ulps)
        wrong.close(rows["residual_n"][mine], 0 if X(rpm) == cut else left(f), "regimes curve residual", 0, ulps)
        wrong.close(rows["air_n"][mine], end.inertia(rpm, w) - (0 if X(rpm) == cut else left(f)), "regimes curve air", 0, ulps)


def synthesis(binary, directory):
    """What is designed does what it is designed for, and no random drag link within the limits is better than the least."""
    wrong, rng, least = Wrong(), random.Random("synthesis"), {}
    for goal, more in [("equal", []), ("symmetric", []), ("least", []), ("least", ["--keep", "symmetric"])]:
        name = f"{goal}{len(more)}"
        got, report = run(binary, "linkage", ["dpi-six-bar", "--synthesize", goal, *more], directory, name, "csv")
        if got.returncode or not report:
            wrong.append(f"{goal}: exit {got.returncode}: {got.stderr.strip()[:200]}")
            continue
        d = report["design"]
        m = dict(machine(0, None), base=X(d["base_ratio"]), coupler=X(d["coupler_ratio"]), follower=X(d["follower_ratio"]))
        # An angle, as a number of degrees or a text that has its unit.
        told = d.get("follower_angle_deg", d.get("follower_angle"))
        m["follower_angle"] = X(str(told).split()[0]) * DEG
        drive = Drive(m)
        judge_linkage(m, drive, report, wrong, m["rpm"])
        figures, _ = drive_figures(m, drive)
        # Solved to rounding, or by steps until 1e-10 of the links.
        if goal != "least":
            wrong.close(figures["k_c"], 1, f"synthesis {goal} K_c", 1e-9)
        if goal == "symmetric" or more:
            wrong.close(figures["k_phi"], 1, f"synthesis {goal} K_φ", 1e-9)
        if goal == "least":
            angle = -largest(lambda f: -drive.angles(f)[0], 0, 2 * PI)[0] / DEG
            wrong.below(45 - angle, 1e-9, "synthesis transmission angle below 45°")
            wrong.below(X("0.5") - min(m["coupler"], m["follower"]), 1e-12, "synthesis link below its limit")
            if not more:
                least = dict(m, c=max(figures["c_plus"], figures["c_minus"]))
    for _ in range(150 if least else 0):
        # Half of them anywhere, half of them close to the told one.
        near = rng.random() < 0.5
        around = lambda key, low, high, by: least[key] * X(1 + rng.uniform(-by, by)) if near else X(rng.uniform(low, high))
        m = dict(least, base=around("base", 0.02, 0.3, 0.03), coupler=around("coupler", 0.5, 1.3, 0.03),
                 follower=around("follower", 0.5, 1.3, 0.03), follower_angle=around("follower_angle", 1.5, 5, 0.01))
        base, coupler, follower = (m[key] for key in ("base", "coupler", "follower"))
        # Both cranks turn; the angle between coupler and driven crank is least where the driving crank lies along the base.
        if min(coupler, follower) < 0.5 or abs(coupler - follower) >= 1 - base or coupler + follower <= 1 + base:
            continue
        drive = Drive(m)
        if drive.angles(np.array([0, PI]))[0].min() < 45 * DEG:
            continue
        a = np.abs(drive.bed(drive.roots(3), 2)[2]).max()
        ways = drive.bed(drive.roots(1), 0)[0]
        c = PI**2 * a / (ways.max() - ways.min())
        wrong.below(least["c"] * (1 - X(1e-7)), c, "synthesis least C")
    return wrong


# ---- the sample


BAD_WORDS = ("NaN", "please report", "panicked", "inf ", "Infinity")


def task(arguments):
    number, seed, binary, directory = arguments
    rng = random.Random(f"{seed}-{number}")
    m, states, commands = machine(number, rng), [], []
    drive, name, wrong = Drive(m), f"{number}", Wrong()
    words, side = settings(m), ["--end", m["ends"]]
    if m["ends"] == "outer" and rng.random() < 0.5:
        side = []
    if number < 4:
        # The machine file as it is carried.
        words = [m["file"]]
    rpm = m["rpm"] if number < 4 or rng.random() < 0.7 else X(float(m["rpm"] * X(rng.uniform(0.6, 1.0))))
    cut = m["rpm"] if number < 4 or rng.random() < 0.7 else X(float(m["rpm"] * X(rng.uniform(0.7, 1.1))))
    other = [cut * X(rng.choice([4 / 7, 0.85, rng.uniform(0.4, 0.99)])), cut]
    if rng.random() < 0.3:
        other.insert(1, cut * X(rng.uniform(1.0, 1.2)))
    other = [X(float(n)) for n in other]
    sections = sorted({X(float(m["rpm"] * X(s))) for s in [rng.uniform(0.6, 0.75), rng.uniform(0.8, 0.95), rng.choice([1.0, 0.97])]})
    jobs = [
        ("linkage", ["--rpm", repr(float(rpm))], "csv"),
        ("rotary", ["--rpm", repr(float(rpm)), *side, "--samples", str(720 * m["lobes"])], "csv,dxf"),
        ("regimes", ["--rpm", ",".join(repr(float(n)) for n in other), *side,
                     *(["--cut-for", repr(float(cut))] if cut != m["rpm"] else [])], "csv"),
    ]
    smooth = m["transition"] == "blend" or m["transition"] == "run-up" and not m["lead"]
    if number % 3 == 0 and (smooth or rng.random() < 0.15) or number < 4:
        # A conoid has no corners, so it is refused with a lead, and without a transition.
        jobs.append(("conoid", ["--rpm", ",".join(repr(float(n)) for n in sections), *side, "--samples", str(720 * m["lobes"])], "csv"))
    end = None
    for command, more, formats in jobs:
        flags = [*words, *more]
        line = " ".join(["camgen", command, *flags, "--force"])
        before = len(wrong)
        try:
            got, report = run(binary, command, flags, directory, f"{name}-{command}", formats)
            if got.returncode not in (0, 1, 2) or any(word in got.stderr for word in BAD_WORDS):
                wrong.append(f"exit {got.returncode}: {got.stderr.strip()[:300]}")
            if got.returncode == 2 or report is None or not report.get("files"):
                states.append(f"{command} refused")
                if "changes its sign" in got.stderr and len(drive.roots(2)) == 2:
                    wrong.append(f"refused for reversals, of which there are two: {got.stderr.strip()[:200]}")
                said = (got.stderr.strip() or "no words").splitlines()[0]
                wrong.notes.append(f"{command} refused: {re.sub(r'[0-9.]*[0-9]', '…', said)[:170]}")
                continue
            failing = [c["check"] for c in report["checks"] if c["verdict"] == "fail"]
            if bool(failing) != (got.returncode == 1):
                wrong.append(f"exit {got.returncode} with {failing} failing")
            states.append(f"{command} judged")
            for check in failing:
                wrong.notes.append(f"{command} forced: {check}")
            if command == "linkage":
                judge_linkage(m, drive, report, wrong, rpm)
                continue
            if end is None:
                end = End(m, drive, m["ends"])
            if end.changes != 2:
                wrong.append(f"a cam for a bed whose acceleration changes its sign {end.changes} times")
                continue
            if command == "rotary":
                judge_rotary(m, end, report, wrong, rpm, m["embedded"])
            elif command == "conoid":
                judge_conoid(m, end, report, wrong, sections)
            else:
                judge_regimes(m, end, report, wrong, other, cut)
        except (AssertionError, KeyError, IndexError, StopIteration, ValueError) as error:
            wrong.append(f"{type(error).__name__}: {error} at {traceback.format_exc().strip().splitlines()[-3].strip()}")
        finally:
            if len(wrong) > before:
                wrong.append(line)
    return number, m["kind"], states, list(wrong), dict(wrong.largest), wrong.notes


def main():
    given = cases.given("linkage", 40, only={"type": int})
    binary, directory = given.binary, given.directory
    began, failed, states, notes, biggest = time.time(), 0, Counter(), Counter(), defaultdict(float)
    wrong = synthesis(binary, directory) if given.only is None else Wrong()
    for line in wrong:
        failed += 1
        print(f"  synthesis: {line}")
    biggest.update(wrong.largest)
    numbers = range(given.count) if given.only is None else [given.only]
    with ProcessPoolExecutor(given.jobs) as pool:
        for number, kind, did, wrong, largest_, noted in pool.map(task, [(n, given.seed, binary, directory) for n in numbers]):
            states.update(did), notes.update(noted)
            failed += bool(wrong)
            for what, share in largest_.items():
                biggest[what] = max(biggest[what], share)
            if wrong:
                print(f"  {number} {kind}: " + "\n    ".join(wrong[:30]))
    print("largest differences, as shares of what is allowed:")
    for what, share in sorted(biggest.items()):
        print(f"  {what:44} {share:.1e}")
    for note, count in sorted(notes.items()):
        print(f"  {count:3} × {note}")
    for command in ("linkage", "rotary", "regimes", "conoid"):
        refused, judged = states[f"{command} refused"], states[f"{command} judged"]
        print(f"{command}: {judged} judged, {refused} refused")
        # A sample that is mostly refused says nothing.
        if refused > (refused + judged) / 3:
            failed += 1
            print(f"  more than a third of {command} refused")
    print(f"{len(numbers)} machines in {time.time() - began:.0f} s; {failed} wrong")
    sys.exit(failed > 0)


if __name__ == "__main__":
    main()
