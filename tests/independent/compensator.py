"""The second disc whose spring takes the torque of the camshaft: its law by energy, and both discs rolled on as they are cut.

Shares nothing with camgen but the machine file. The law of the first cam is that of disc.py; the work of the shaft is the integral
of roller force times slope over the turn, by quadrature between the rows of the table; the second disc gives it back to a spring,
½ c (y0 + y)² + E = const. Then both written DXF files are read by ezdxf: on every arc the roller's centre runs on a circle, its
slope follows from the contact normal alone, the air presses as the rolled lift says, the spring as its own rolled lift says, and
what both leave on the shaft is compared with what the report tells. Prints the ladder of tolerances.

usage: compensator.py CAMGEN_BINARY DIRECTORY [--count N] [--seed N] [--jobs N]
"""
import csv
import json
import math
import random
import subprocess
from collections import defaultdict
from pathlib import Path

import cases
import numpy as np
from disc import Disc
from felt import Track
from machines import machine, settings
from outline import polyline

NODES, WEIGHTS = np.polynomial.legendre.leggauss(12)
TURN = 2 * math.pi


class Wrong(list):
    largest = defaultdict(float)

    def close(self, told, true, what, relative, absolute=0.0):
        off = abs(told - true)
        share = max(off - absolute, 0.0) / abs(true) if true else off
        Wrong.largest[what] = max(Wrong.largest[what], share)
        if not off <= relative * abs(true) + absolute:
            self.append(f"{what} told {told!r}, is {true!r} ({share:.1e})")


class First:
    """Torque and work of the first cam by the crank angle, at its own or another speed; SI."""

    def __init__(self, disc, share=1.0):
        self.disc, self.law, self.m, self.n = disc, disc.law, disc.m, disc.n
        law = self.law
        self.omega = law.omega / self.n * share
        self.column = law.L
        if share != 1.0:
            # (14): the column with which the unchanged cam balances the bed at the end of its way.
            ratio = (1 + law.A * law.r) ** (1 / law.k)
            shorter = law.L * (1 - 1 / ratio)
            g = (1 + law.A * share**2 * law.r) ** (1 / law.k)
            self.column = shorter * g / (g - 1)

    def force(self, phi, s, acceleration):
        """Along the roller's path; s is Δx, the acceleration that of the follower by the cam angle."""
        law, m = self.law, self.m
        x = law.r * np.sin(np.clip(phi, 0, None))
        left = self.column - x - law.lead - s
        with np.errstate(all="ignore"):
            air = np.where(phi >= 0, np.expm1(law.k * np.log(self.column / left)), 0.0)
        return law.unit * air / m["lever"] + (m["preload"] or 0.0) + (m["follower_mass"] or 0.0) * self.omega**2 * acceleration

    def torque(self, phi, jets):
        """By the crank angle: what a turn of the shaft by 1/n rad takes."""
        lever = self.m["lever"]
        return self.force(phi, jets[0], lever * self.n**2 * jets[2]) * lever * jets[1]

    def pieces(self):
        """(from, to, function) over the first half of a reversal, cut where the air closes."""
        for low, high, f in self.law.pieces:
            for a, b in zip(*(lambda c: (c, c[1:]))([low, 0.0, high] if low < 0 < high else [low, high])):
                if b > a:
                    yield a, b, f

    def of(self, phi, f, before):
        """Torque at angles of one piece; the air is open before its seam although 0 belongs to both."""
        return self.torque(np.minimum(phi, -1e-300) if before else phi, f(phi))


class Second:
    """Law of the second disc by the crank angle of the first half, from the work of the first."""

    def __init__(self, first, rate, preload):
        self.first, self.rate, self.preload = first, rate, preload
        self.y0 = preload / rate
        # Work at the ends of many panels of every piece.
        self.grid, work, self.highest, self.lowest = [], 0.0, 0.0, 0.0
        for a, b, f in first.pieces():
            before = b <= 0
            cuts = np.linspace(a, b, 801)
            self.grid.append((cuts, work + np.concatenate([[0.0], np.cumsum(self.panels(f, cuts, before))]), f, before))
            works = self.grid[-1][1]
            at_cuts = first.of(cuts, f, before)
            for i in np.flatnonzero(at_cuts[:-1] * at_cuts[1:] < 0):
                low, high = cuts[i], cuts[i + 1]
                rises = at_cuts[i] > 0
                for _ in range(60):
                    middle = (low + high) / 2
                    low, high = (middle, high) if (first.of(np.array([middle]), f, before)[0] > 0) == rises else (low, middle)
                there = works[i] + self.panels(f, np.array([cuts[i], low]), before)[0]
                self.highest, self.lowest = max(self.highest, there), min(self.lowest, there)
            self.highest, self.lowest = max(self.highest, works.max()), min(self.lowest, works.min())
            work = works[-1]
        self.lift = self.of_work(self.lowest)

    def panels(self, f, cuts, before):
        half = np.diff(cuts) / 2
        at = (cuts[:-1] + half)[:, None] + half[:, None] * NODES
        return (half[:, None] * WEIGHTS * self.first.of(at.ravel(), f, before).reshape(at.shape)).sum(axis=1)

    def of_work(self, work):
        d = 2 * np.maximum(self.highest - work, 0) / self.rate
        return d / (self.y0 + np.sqrt(self.y0**2 + d))

    def at(self, phi):
        """Lift, its slope by the crank angle, and the first torque, at a scalar angle of the first half (or in the dwell)."""
        for cuts, works, f, before in self.grid:
            last = f is self.grid[-1][2]
            if cuts[0] <= phi < cuts[-1] or (last and phi >= cuts[-1]):
                phi = min(phi, cuts[-1])
                i = min(int(np.searchsorted(cuts, phi, side="right")) - 1, len(cuts) - 2)
                work = works[i] + (self.panels(f, np.array([cuts[i], phi]), before)[0] if phi > cuts[i] else 0.0)
                torque = self.first.of(np.array([phi]), f, before)[0]
                y = self.of_work(work)
                slope = -torque / (self.rate * (self.y0 + y))
                h = 1e-5 * (cuts[-1] - cuts[0])
                near = np.clip(phi, cuts[0] + h, cuts[-1] - h)
                rate = np.diff(self.first.of(np.array([near - h, near + h]), f, before))[0] / (2 * h)
                bend = -(rate + self.rate * slope**2) / (self.rate * (self.y0 + y))
                return float(y), float(slope), float(torque), float(bend)
        return float(self.of_work(0.0)), 0.0, 0.0, 0.0

    def samples(self, count=400):
        """φ, lift, slope and curvature by the crank angle over every piece, and the jets of the first cam."""
        for cuts, works, f, before in self.grid:
            y = self.of_work(works)
            torque = self.first.of(cuts, f, before)
            slope = -torque / (self.rate * (self.y0 + y))
            # d/dφ of the torque inside the piece, one-sided differences left out at its ends.
            h = 1e-4 * (cuts[-1] - cuts[0])
            inner = np.clip(cuts, cuts[0] + h, cuts[-1] - h)
            rate = (self.first.of(inner + h, f, before) - self.first.of(inner - h, f, before)) / (2 * h)
            bend = -(rate + self.rate * slope**2) / (self.rate * (self.y0 + y))
            yield np.minimum(cuts, -1e-300) if before else cuts, y, slope, bend, f(cuts)


def folded(theta, n):
    """Crank angle of the first half that a cam angle mirrors to, and +1 or −1 on the way back."""
    phi = math.fmod(theta * n, TURN)
    phi -= TURN if phi > 1.5 * math.pi else 0
    return (phi, 1.0) if phi <= math.pi / 2 else (math.pi - phi, -1.0)


class Rolled:
    """A roller on the arcs of a file; height along its path and slope, by the contact normal; mm."""

    def __init__(self, path, radius, prime, offset, ccw):
        _, vertices = polyline(path)
        self.radius, self.offset = radius, offset
        self.base = math.sqrt(prime**2 - offset**2)
        self.spans = []
        track = Track(vertices, ccw)
        for centre, signed, start, end, at_start, at_end, sweep in track.arcs:
            low, high = self.angle(start, at_start), self.angle(end, at_end)
            # A dwell may be one arc of more than half a turn.
            high += TURN * round((low + sweep - high) / TURN)
            self.spans.append((centre, signed, at_start, low, high))

    def angle(self, point, normal):
        q = point + normal * self.radius
        return math.atan2(q[1], q[0]) - math.atan2(self.offset, math.sqrt(q @ q - self.offset**2))

    def joints(self):
        return np.array([low for *_, low, _ in self.spans])

    def roll(self, theta):
        """Lift and slope at sorted angles in [0, 2π); the highest of the arcs that reach there, each gone on with for 1e-7 rad: a joint that
        is as tangent as rounding makes it may leave that open."""
        lift, slope = np.full(len(theta), -np.inf), np.zeros(len(theta))
        for centre, signed, normal, low, high in self.spans:
            if high <= low:
                continue
            turn = np.floor((low - 1e-7) / TURN) * TURN
            for k in (turn, turn + TURN, turn + 2 * TURN):
                i, j = np.searchsorted(theta + k, [low - 1e-7, high + 1e-7])
                if j <= i:
                    continue
                t = theta[i:j]
                u = np.stack([np.cos(t), np.sin(t)])
                across = np.stack([-np.sin(t), np.cos(t)])
                if signed is None:
                    n = np.broadcast_to(normal[:, None], u.shape)
                    on = (centre + normal * self.radius) @ normal
                    h = (on - self.offset * (across * n).sum(axis=0)) / (u * n).sum(axis=0)
                else:
                    a, b = centre @ u, centre @ across - self.offset
                    reach = signed + self.radius
                    h = a + np.sign(reach) * np.sqrt(np.maximum(reach**2 - b**2, 0))
                    n = (h * u + self.offset * across - centre[:, None]) / reach
                s = self.offset - h * (across * n).sum(axis=0) / (u * n).sum(axis=0)
                higher = h - self.base > lift[i:j]
                lift[i:j] = np.where(higher, h - self.base, lift[i:j])
                slope[i:j] = np.where(higher, s, slope[i:j])
        return lift, slope


def as_cut(first, rate, y0, paths, report, m, comp_roller):
    """Largest torque that both discs leave on the shaft, N·m, without the inertia of either follower, and its place."""
    n = first.n
    one = Rolled(paths[0], 1e3 * m["roller"], report["cam"]["prime_radius_mm"], 1e3 * m["offset"], m["ccw"])
    two = Rolled(paths[1], comp_roller, report["compensator"]["prime_radius_mm"], 0.0, m["ccw"])
    joints = np.concatenate([one.joints(), two.joints()])
    theta = np.concatenate([np.linspace(0, TURN, 14400, endpoint=False), (joints[:, None] + [-2e-9, 2e-9, -1e-6, 1e-6]).ravel()])
    theta = np.sort(np.mod(theta, TURN))
    lift, slope = one.roll(theta)
    lift2, slope2 = two.roll(theta)
    phi = np.mod(theta * n, TURN)
    phi = np.where(phi > 1.5 * np.pi, phi - TURN, phi)
    phi = np.where(phi > np.pi / 2, np.pi - phi, phi)
    bottom = 1e-3 * lift / m["lever"] + first.law.lowest
    # The follower's own inertia belongs to the law: by its acceleration there.
    acceleration = np.zeros(len(phi))
    for low, high, f in first.pieces():
        inside = (phi >= low) & (phi <= high)
        if inside.any():
            acceleration[inside] = m["lever"] * n * n * f(phi[inside])[2]
    torque = first.force(phi, bottom, acceleration) * 1e-3 * slope + rate * (y0 + 1e-3 * lift2) * 1e-3 * slope2
    assert np.isfinite(torque).all(), "an angle that no arc serves"
    i = int(np.abs(torque).argmax())
    return abs(torque[i]), math.degrees(theta[i])


def camgen(binary, directory, name, words):
    command = [binary, "rotary", *words, "--json", "--out", str(directory), "--name", name, "--overwrite", "--force",
               "--format", "dxf,csv"]
    got = subprocess.run(command, capture_output=True, text=True)
    return command, got, json.loads(got.stdout) if got.stdout else None


def table(path):
    with open(path, newline="") as file:
        return [{key: float(value) if value else None for key, value in row.items()} for row in csv.DictReader(file)]


def judge(report, m, rpm, rate, preload, roller, mass, tolerance, wrong):
    """Law, table and rolled discs of one report against own figures."""
    told, files = report["compensator"], report["files"]
    if sum(f.endswith(".csv") for f in files) < 2:
        wrong.append(f"forced, yet only {len(files)} files")
        return None, 0.0, None
    disc = Disc(m, rpm, report["cam"]["prime_radius_mm"] * 1e-3)
    first = First(disc)
    second = Second(first, rate, preload)
    n = first.n
    # Quadrature of panels of a ten-thousandth of the turn with twelve nodes, sums of a thousand rounded terms, and the work of
    # highest and lowest place by difference: 1e-12 of the work; the brief of the house is 1e-9 of the lift.
    # Where the first roller would leave its cam the work has several highest places near each other, and no meaning.
    lifts = any(c["check"] == "force_closure" and c["verdict"] == "fail" for c in report["checks"])
    exact = 1e-6 if lifts else 1e-9
    wrong.close(told["lift_max_mm"], 1e3 * second.lift, "lift", exact)
    wrong.close(told["work_j"], second.highest - second.lowest, "work", exact)
    wrong.close(told["spring_force_max_n"], preload + rate * second.lift, "spring force", exact)
    omega = first.omega
    before = after = 0.0
    for phi, y, slope, bend, jets in second.samples():
        torque = n * first.torque(phi, jets)
        before = max(before, np.abs(torque).max())
        if mass:
            after = max(after, np.abs(n**3 * mass * omega**2 * slope * bend).max())
    # Among 800 places of a piece: (1/1600 of it)² and a bend of some units.
    wrong.close(told["torque_before_max_nm"], before, "torque before", 2e-5)
    if mass:
        # The curvature by differences, at the ends of a piece a ten-thousandth of it inside.
        wrong.close(told["torque_after_max_nm"], after, "torque of the second mass", 5e-3)
    elif told["torque_after_max_nm"] > 1e-9 * before + 1e-9:
        wrong.append(f"torque left by the law told {told['torque_after_max_nm']}")
    main, rows = table(next(f for f in files if f.endswith(".csv") and "compensator" not in Path(f).name)), table(
        next(f for f in files if f.endswith("compensator.csv")))
    off = worst = 0.0
    steep = max(np.abs(slope).max() for _, _, slope, _, _ in second.samples()) * n
    for row, other in zip(rows, main):
        phi, sign = folded(math.radians(row["cam_deg"]), n)
        y, slope, torque, bend = second.at(phi)
        off = max(off, abs(row["lift_mm"] - 1e3 * y) / (1e3 * second.lift))
        # Where two pieces meet the slope may jump, of a blend or a lead; either side is right.
        jump = any(abs(phi - edge) < 1e-9 for cuts, *_ in second.grid for edge in (cuts[0], cuts[-1]))
        if not jump:
            worst = max(worst, abs(row["velocity_mm_per_rad"] - 1e3 * sign * n * slope) / (1e3 * steep))
            # Of the spring and of the mass that it moves, whose curvature comes by differences.
            moved = n**3 * mass * omega**2 * sign * slope * bend if mass else 0.0
            wrong.close(other["compensator_torque_nm"], moved - sign * n * torque, "table: torque of the spring", 1e-7,
                        1e-9 * before + 1e-3 * after)
            left = other["compensator_torque_nm"] + other["torque_nm"] - other["torque_left_nm"]
            if abs(left) > 1e-9 * (before + after):
                wrong.append(f"{other['cam_deg']}°: torques add up to {left} too much")
    wrong.close(off, 0, "law in the table over the lift", 0, exact)
    wrong.close(worst, 0, "slope in the table over the largest", 0, 1e-7)

    # Other speeds: the spring set anew.
    for row in told["preload_by_rpm"]:
        slow = First(disc, row["rpm"] / rpm)
        parts = [(n * slow.torque(phi, jets), rate * n * slope, y, n**3 * (mass or 0) * slow.omega**2 * slope * bend)
                 for phi, y, slope, bend, jets in second.samples()]
        t1, gain, y, own = (np.concatenate([part[i] for part in parts]) for i in range(4))
        left = lambda y0: np.abs(t1 + gain * (y0 + y) + (own if mass else 0)).max()
        wrong.close(row["torque_before_max_nm"], np.abs(t1).max(), "slower: before", 3e-5)
        if not mass:
            wrong.close(row["torque_unchanged_max_nm"], left(second.y0), "slower: unchanged", 1e-3)
        # A largest of straight lines in the preload: one lowest place.
        low, high = 0.0, 4 * second.y0 + 4 * second.lift
        for _ in range(120):
            a, b = low + (high - low) / 3, high - (high - low) / 3
            low, high = (low, b) if left(a) < left(b) else (a, high)
        if not mass:
            wrong.close(row["torque_after_max_nm"], left((low + high) / 2), "slower: reset", 1e-3, 1e-6 * before)
            if abs(left(row["preload_n"] / rate) - left((low + high) / 2)) > 1e-3 * left((low + high) / 2) + 1e-6 * before:
                wrong.append(f"{row['rpm']} rpm: preload {row['preload_n']} leaves {left(row['preload_n'] / rate)}, "
                             f"{rate * (low + high) / 2} leaves {left((low + high) / 2)}")

    drawn = sorted((f for f in files if f.endswith(".dxf")), key=len)
    failing = {c["check"] for c in [*report["checks"], *told["checks"]] if c["verdict"] == "fail"}
    own = None
    if len(drawn) == 2 and not failing & {"undercut", "rolling", "outline", "tangency"}:
        own, place = as_cut(first, rate, second.y0, drawn, report, m, roller)
        if told["torque_as_cut_max_nm"] is None:
            wrong.append("no torque as cut told")
        elif not mass and not m["follower_mass"]:
            # Both roll on the same arcs; the largest lies at or near a joint, where the grid has places on either side.
            # It is told of the law's forces on the cut slopes: a share of the lift error over the lift less than the forces of the
            # lifts as cut, 0.5 % at 50 µm on the embedded press. Where the air closes in a blend the torque jumps, and slopes that
            # are cut cannot: at that place every value between is right.
            jump = max((abs(n * (first.of(b[0][:1], b[2], b[3]) - first.of(a[0][-1:], a[2], a[3]))[0])
                        for a, b in zip(second.grid, second.grid[1:])), default=0.0)
            wrong.close(told["torque_as_cut_max_nm"], own, "torque as cut", 0.03, 1e-7 * before + jump)
    return own, before, second


def one(binary, directory, number, rng):
    m, rpm = machine(rng)
    name, wrong = f"k{number}", Wrong()
    m["base"], m["stress"], m["share"], m["lead"] = None, None, None, 0.0
    m["q"] = rng.uniform(1.3, 3.0)
    m["width"] = max(m["width"], math.radians(2))
    m["mass"] = rng.uniform(100, 1500)
    if rng.random() < 0.25:
        m["kind"] = "none"
    if rng.random() < 0.6 or m["kind"] == "none":
        # A mass that meets a corner takes a blow, which is no torque.
        m["follower_mass"], m["preload"] = rng.choice([(None, None), (1e-9, rng.uniform(0, 5000))])
    roller, mass = rng.choice([30.0, rng.uniform(10, 45)]), rng.choice([None, None, rng.uniform(5, 80)])
    # A spring of the size of the work: lift of the size of the crank.
    disc = Disc(m, rpm, 0.3)
    first = First(disc)
    work = Second(first, 1e5, 1e4)
    work = work.highest - work.lowest
    lift = rng.uniform(0.2, 1.0) * m["r"]
    ratio = rng.uniform(1.2, 5)
    rate = float(2 * work * (ratio - 1) / ((ratio + 1) * lift**2))
    preload = rate * lift / (ratio - 1)
    tolerance = rng.choice(["5um", "0.5um"])
    words = ["--rpm", repr(rpm), *settings(m), "--tolerance", tolerance, "--compensator",
             f"spring_rate={rate / 1000!r}N/mm,preload={preload!r}N,roller_radius={roller!r}mm" + (f",mass={mass!r}kg" if mass else "")]
    if rng.random() < 0.5:
        words += ["--tolerance-acceleration", rng.choice(["none", "2%"])]
    command, got, report = camgen(binary, directory, name, words)
    if report is None or report.get("compensator") is None:
        return "not a cam", [f"exit {got.returncode}: {got.stderr.strip()}"] if got.returncode != 2 else [], command, got.stderr.strip()
    own, *_ = judge(report, m, rpm, rate, preload, roller, mass, tolerance, wrong)
    return ("made" if got.returncode == 0 else "forced") + ("" if own is not None else ", not rolled"), wrong, command, ""


def dpi():
    m, _ = machine(random.Random(1))
    m.update(mass=978.2, r=0.18, k=1.35, q=2.0, column="matched", lead=0.0, kind="run-up", width=math.radians(20), roller=0.03,
             offset=0.0, lever=1.0, lobes=1, bore=0.025, material="steel", thickness=0.03, preload=None, follower_mass=None,
             pressure_angle=30.0, ratio=2.0, cutter=0.01, wall=0.005, ccw=False, base=None, stress=None, share=None)
    return m


def ladder(binary, directory):
    wrong, m = Wrong(), dpi()
    rows = []
    # The velocity tolerance of each disc times the largest force on it is the most its slope can leave.
    steps = [("50um", "none", "none"), ("5um", "none", "none"), ("0.5um", "none", "none"), ("0.05um", "none", "none"),
             ("5um", "0.2%", "none"), ("5um", "0.1%", "none"),
             ("5um", "none", "5%")]
    print(f"{'tolerance':>9} {'velocity':>9} {'accel.':>7} {'arcs':>10} {'told N·m':>10} {'own N·m':>10} {'share':>8} {'factor':>7}")
    for tolerance, velocity, acceleration in steps:
        words = ["--tolerance", tolerance, "--tolerance-velocity", velocity, "--tolerance-acceleration", acceleration,
                 "--compensator", "spring_rate=100N/mm,preload=10kN"]
        _, got, report = camgen(binary, directory, "ladder", words)
        own, before, second = judge(report, m, 35.0, 1e5, 1e4, 30.0, None, tolerance, wrong)
        told = report["compensator"]["torque_as_cut_max_nm"]
        factor = rows[-1] / told if rows and velocity == acceleration == "none" else math.nan
        rows.append(told)
        arcs = f"{report['outline']['arcs']}+{report['compensator']['outline']['arcs']}"
        print(f"{tolerance:>9} {velocity:>9} {acceleration:>7} {arcs:>10} {told:10.4f} {own:10.4f} {told / before:8.4%} {factor:7.2f}")
        wrong.close(before, 1185.79948570587439, "golden 14", 1e-5)
        wrong.close(1e3 * second.at(math.radians(30))[0], 16.8560087716494965, "golden 15: y(30°), own", 1e-11)
        wrong.close(1e3 * second.lift, 77.9655190789303427, "golden 15: y(90°), own", 1e-11)
        if velocity != "none":
            share = float(velocity[:-1]) / 100
            fastest = max(np.abs(jets[1]).max() for *_, jets in second.samples())
            second_fastest = max(np.abs(slope).max() for _, _, slope, _, _ in second.samples())
            most = share * (21288.1 * fastest + report["compensator"]["spring_force_max_n"] * second_fastest)
            if told > most:
                wrong.append(f"velocity to {velocity}, torque left {told} of at most {most}")
    slope = math.log(rows[0] / rows[3]) / math.log(1000)
    print(f"torque as cut ~ tolerance^{slope:.3f}, two thirds expected")
    # A whole number of arcs makes each step uneven; over three decades the exponent holds.
    if not 0.55 < slope < 0.8 or any(not 2.5 < a / b < 9 for a, b in zip(rows[:3], rows[1:4])):
        wrong.append(f"as cut {rows[:4]} does not fall as the tolerance to two thirds")
    if rows[1] > 0.015 * 1185.80:
        wrong.append(f"{rows[1]} N·m left at 5 µm")
    row = next(r for r in report["compensator"]["preload_by_rpm"] if r["rpm"] == 25)
    print(f"25 rpm: {row['torque_before_max_nm']:.2f} N·m, {row['torque_unchanged_max_nm']:.2f} with the second disc, "
          f"{row['torque_after_max_nm']:.2f} with {row['preload_n']:.0f} N")
    if row["torque_after_max_nm"] > 99:
        wrong.append(f"{row['torque_after_max_nm']} N·m at 25 rpm with the preload reset")
    return wrong


def main():
    words = cases.given("compensator", 60)
    wrong = ladder(words.binary, words.directory)
    for line in wrong:
        print(f"  ladder: {line}")

    def one_case(number, rng):
        state, wrong, command, _ = one(words.binary, words.directory, number, rng)
        return state, wrong, " ".join(command[1:])

    states, failed = cases.judged(words, one_case)
    cases.show_largest(Wrong.largest)
    cases.finish(states, failed + len(wrong))


if __name__ == "__main__":
    main()
