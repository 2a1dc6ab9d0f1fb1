"""The belt brake of a paper roll from first principles: a string round pulleys and roll, Coulomb friction added up over the wrap.

Shares nothing with camgen but the machine files that it writes. The inner run of the belt is the string from the left pulley over the
roll to the right one, laid out by tangent points; its length stays what it is on the full roll, and the frame is found by bisection, in
80 bit. On every piece of the wrap the roll presses with T per radian and drags with f T, T growing by f T per radian: Gauss-Legendre
sums of forces and of moments about the pivot give the tension, complex friction its sensitivity. The disc: its lift by the energy
integral of the moment that the weight lacks, and the outline that ezdxf reads with a roller on its arcs, whose spring and slope by the
contact normal give the tension as cut. Frames are drawn at random, to the left, right, above and below, 0.05 to 5 m, at walls and beyond.

usage: brake.py CAMGEN_BINARY DIRECTORY [--count N] [--seed S]
"""
import argparse
import csv
import json
import math
import random
import re
import subprocess
import sys
from collections import Counter, defaultdict
from pathlib import Path

import numpy as np
from outline import Chain, polyline

TURN = 2 * math.pi
NODES, WEIGHTS = np.polynomial.legendre.leggauss(16)
STATIONS = 40
PEAKS = 0.05
WALLS = {
    "pulley": "pulley meets the roll",
    "belt": "leaves the roll",
    "dead": "dead point",
    "jam": "jams",
    "weight": "no longer presses",
    "around": "",  # no name of its own: it is refused, whatever is told
}


class Wrong(list):
    largest = defaultdict(float)

    def close(self, told, true, what, relative=1e-9, absolute=0.0):
        told, true = np.atleast_1d(np.asarray(told, float)), np.atleast_1d(np.asarray(true, float))
        true = np.full(told.shape, true[0]) if true.shape == (1,) else true
        off = np.abs(told - true)
        allowed = relative * np.abs(true) + absolute
        if told.shape != true.shape or not np.isfinite(told).all() or not (off <= allowed).all():
            at = int(np.argmax(off - allowed)) if told.shape == true.shape else 0
            self.append(f"{what} [{at}] told {told.flat[at]!r}, is {true.flat[at]!r}")
            return
        share = np.max(np.where(true != 0, np.maximum(off - absolute, 0) / np.maximum(np.abs(true), 1e-300), 0), initial=0)
        Wrong.largest[what] = max(Wrong.largest[what], float(share))


# ---------------------------------------------------------------- the frame as a string drawing


class Frame:
    """SI. Right and left pulley, centre of gravity and pivot on the full roll, from its axis."""

    def __init__(self, pivot, right, left, gravity, rho, full, core, friction, wanted, clockwise, weight=None):
        self.pivot, self.right, self.left, self.gravity = pivot, right, left, gravity
        self.rho, self.full, self.core = rho, full, core
        self.friction, self.wanted, self.clockwise, self.weight = friction, wanted, clockwise, weight
        self.wrap_full = self.wrap_at(full, 0.0, None)
        self.length = self.string(full, 0.0, self.wrap_full)
        self.ready = math.isfinite(self.length) and self.wrap_full > 0
        if self.ready:
            # The way to turn that keeps the belt taut as the roll runs down: where the string would grow too long.
            h = 1e-6
            grow = self.string(full, h, self.wrap_full) - self.string(full, -h, self.wrap_full)
            self.way = 1.0 if grow > 0 else -1.0
            self.ready = math.isfinite(grow)

    def turned(self, point, theta):
        x, y = point[0] - self.pivot[0], point[1] - self.pivot[1]
        c, s = np.cos(theta), np.sin(theta)
        return self.pivot[0] + c * x - s * y, self.pivot[1] + s * x + c * y

    def tangents(self, radius, theta):
        """Outward normals of the roll where the belt comes off it to either pulley; NaN where a pulley meets the roll."""
        found = []
        for point, side in ((self.right, 1.0), (self.left, -1.0)):
            px, py = self.turned(point, theta)
            d2 = px * px + py * py
            near = radius + self.rho
            room = np.sqrt(d2) - near
            with np.errstate(invalid="ignore"):
                far = np.sqrt(np.where(room > 0, room * (np.sqrt(d2) + near), np.nan))
            found.append(((near * px - side * far * py) / d2, (near * py + side * far * px) / d2, px, py))
        return found

    def string(self, radius, theta, about):
        """Length of the inner run, and of what it winds on the pulleys: arc on the roll, two spans, arcs on the pulleys as seen by
        the frame (they change together as the arc on the roll does). `about`: a wrap less than half a turn off."""
        (x1, y1, p1, r1), (x2, y2, p2, r2) = self.tangents(radius, theta)
        arc = about + self.fold(np.arctan2(x1 * y2 - y1 * x2, x1 * x2 + y1 * y2) - about)
        # The belt touches a pulley on the side away from the normal.
        both = radius + self.rho
        return radius * arc + np.hypot(p1 - both * x1, r1 - both * y1) + np.hypot(p2 - both * x2, r2 - both * y2) + self.rho * arc

    @staticmethod
    def fold(angle):
        # One turn in 80 bit: a double one would cost 1e-16.
        turn = 2 * np.arccos(np.longdouble(-1)) if getattr(angle, "dtype", None) == np.longdouble else TURN
        return angle - turn * np.round(angle / turn)

    def wrap_at(self, radius, theta, about):
        (x1, y1, p1, r1), (x2, y2, p2, r2) = self.tangents(radius, theta)
        turn = np.arctan2(x1 * y2 - y1 * x2, x1 * x2 + y1 * y2)
        if about is not None:
            return about + self.fold(turn - about)
        # From the right pulley counter-clockwise to the left one less than a turn, and what lies on the roll is less than that by
        # the angle from either pulley to where the belt touches: a belt that would cross itself is none.
        between = math.atan2(p1 * r2 - r1 * p2, p1 * p2 + r1 * r2) % TURN
        return between - math.atan2(p1 * y1 - r1 * x1, p1 * x1 + r1 * y1) - math.atan2(x2 * r2 - y2 * p2, x2 * p2 + y2 * r2)

    # The same in plain floats, for the march.
    def quick(self, radius, theta, about):
        c, s = math.cos(theta), math.sin(theta)
        ox, oy = self.pivot
        near = radius + self.rho
        normals, spans, arms, beside = [], 0.0, [], 0.0
        for point, side in ((self.right, 1.0), (self.left, -1.0)):
            x, y = point[0] - ox, point[1] - oy
            px, py = ox + c * x - s * y, oy + s * x + c * y
            d2 = px * px + py * py
            room = math.sqrt(d2) - near
            if room <= 0:
                return None
            far = math.sqrt(room * (math.sqrt(d2) + near))
            nx, ny = (near * px - side * far * py) / d2, (near * py + side * far * px) / d2
            normals.append((nx, ny))
            beside += math.atan2(far, near)
            spans += math.hypot(px - near * nx, py - near * ny)
            # Moment about the pivot of a pull of one on this span, reaction of the roll's side: the line n.x = R.
            arms.append(side * (radius - ox * nx - oy * ny))
        (x1, y1), (x2, y2) = normals
        turn = math.atan2(x1 * y2 - y1 * x2, x1 * x2 + y1 * y2) - about
        arc = about + turn - TURN * round(turn / TURN)
        return near * arc + spans, arc, arms, arc + beside

    def margins(self, radius, theta, got):
        """What has to stay above nothing: each by its name."""
        _, arc, (right, left), opening = got
        sense = -self.way
        first, last = (right, left) if self.clockwise else (left, right)  # slack, tight
        grown = math.exp(min(arc * self.friction, 700.0)) if arc > 0 else 1.0
        slack = sense * first
        tight = sense * last
        x = self.gravity[0] - self.pivot[0]
        y = self.gravity[1] - self.pivot[1]
        return {
            "belt": arc,
            # Behind the roll the pulleys pass each other, and the spans cross sooner or later.
            "around": TURN - opening,
            "dead": slack + tight,
            "jam": tight + slack / grown,
            "weight": sense * (math.cos(theta) * x - math.sin(theta) * y),
        }

    def place(self, radius, before, step, about):
        """Turn at this radius, from that of a somewhat larger one; None and the wall where there is none."""
        off = lambda turn: self.quick(radius, self.way * turn, about)
        low, here = before, off(before)
        if here is None:
            return None, "pulley"
        if here[0] >= self.length:
            return before, here
        while True:
            high, there = low + step, off(low + step)
            if there is None:
                step /= 2
                if step < 1e-15:
                    return None, "pulley"
                continue
            if there[0] >= self.length:
                break
            if -self.way * (there[2][0] + there[2][1]) <= 0:
                # The string is longest in between.
                a, b = low, high
                for _ in range(100):
                    u, v = a + (b - a) / 3, b - (b - a) / 3
                    at_u, at_v = off(u), off(v)
                    if at_u is None or at_v is None:
                        return None, "pulley"
                    a, b = (u, b) if at_u[0] < at_v[0] else (a, v)
                high, there = a, off(a)
                if there[0] >= self.length:
                    break
                return None, "dead"
            low, here = high, there
            if high > before + 7:
                return None, "dead"
        for _ in range(70):
            middle = 0.5 * (low + high)
            if middle in (low, high):
                break
            here = off(middle)
            if here is None:
                return None, "pulley"
            if here[0] < self.length:
                low = middle
            else:
                high = middle
        return high, off(high)

    def march(self, core, pieces=240):
        """Radii, turns and wraps down to `core`, or the wall before it as (name, radius)."""
        if not self.ready:
            return (["pulley" if not math.isfinite(self.length) else "belt"], self.full), None
        radii, turns, wraps = [self.full], [0.0], [self.wrap_full]
        first = self.quick(self.full, 0.0, self.wrap_full)
        bad = [k for k, v in self.margins(self.full, 0.0, first).items() if v <= 0]
        if bad:
            return (bad, self.full), None
        arms = first[2]
        grid = np.linspace(self.full, core, pieces + 1)[1:]

        def fails(radius):
            gap = radii[-1] - radius
            rate = wraps[-1] / max(abs(arms[0] + arms[1]), 1e-9 * self.full)
            turn, got = self.place(radius, turns[-1], max(1.2 * rate * gap, 1e-15), wraps[-1])
            if turn is None:
                return [got], None, None
            return [k for k, v in self.margins(radius, self.way * turn, got).items() if v <= 0], turn, got

        for radius in grid:
            radius = float(radius)
            bad, turn, got = fails(radius)
            if bad:
                good, worst, names = radii[-1], radius, bad
                for _ in range(46):
                    middle = 0.5 * (good + worst)
                    again = fails(middle)[0]
                    if again:
                        worst, names = middle, again
                    else:
                        good = middle
                # `names` of the last failure are those at the wall itself.
                return (names, worst), None
            radii.append(radius), turns.append(turn), wraps.append(got[1])
            arms = got[2]
        return None, (np.array(radii), np.array(turns), np.array(wraps))

    def polish(self, radii, turns, wraps):
        """Turns at these radii in 80 bit, by bisection about those found in plain floats."""
        radius, about = radii.astype(np.longdouble), wraps.astype(np.longdouble)
        exact = Frame.__new__(Frame)
        wide = lambda pair: tuple(np.longdouble(v) for v in pair)
        exact.pivot, exact.right, exact.left, exact.gravity = (wide(p) for p in (self.pivot, self.right, self.left, self.gravity))
        exact.rho = np.longdouble(self.rho)
        length = exact.string(np.longdouble(self.full), np.longdouble(0), np.longdouble(self.wrap_full))
        off = lambda turn: exact.string(radius, self.way * turn, about) - length
        centre = turns.astype(np.longdouble)
        reach = np.full(len(radii), np.longdouble(1e-13))
        low, high = centre - reach, centre + reach
        for _ in range(30):
            under, over = off(low) < 0, off(high) > 0
            if (under & over).all():
                break
            reach = reach * 2
            low, high = np.where(under, low, centre - reach), np.where(over, high, centre + reach)
        for _ in range(60):
            middle = (low + high) / 2
            below = off(middle) < 0
            low, high = np.where(below, middle, low), np.where(below, high, middle)
        turn = (low + high) / 2
        turn[radii == self.full] = 0
        return exact, turn

    def radius_of(self, turns, table):
        """Radius at these turns, by bisection between the stations of the table."""
        radii, known, wraps = table
        at = np.clip(np.searchsorted(known, turns, side="right") - 1, 0, len(known) - 2)
        low, high, about = radii[at + 1].copy(), radii[at].copy(), wraps[at]
        for _ in range(54):
            middle = 0.5 * (low + high)
            # A roll that a pulley would stand in is too large too.
            small = self.string(middle, self.way * turns, about) <= self.length
            low, high = np.where(small, middle, low), np.where(small, high, middle)
        return low, about


class Contact:
    """What the roll does to belt and frame at each of many places: sums over the wrap for a tension of one at the tight end."""

    def __init__(self, frame, radius, theta, about, exact=None):
        geometry = exact or frame
        (x1, y1, p1, r1), (x2, y2, p2, r2) = geometry.tangents(radius, theta)
        self.radius, self.theta = np.asarray(radius, float), np.asarray(theta, float)
        self.wrap = np.asarray(about + frame.fold(np.arctan2(x1 * y2 - y1 * x2, x1 * x2 + y1 * y2) - about), float)
        self.first = np.asarray(np.arctan2(y1, x1), float)
        self.frame = frame
        self.normal = [np.asarray(v, float) for v in (x1, y1, x2, y2)]
        gx, _ = geometry.turned(geometry.gravity, theta)
        self.sense = -frame.way
        self.gravity_arm = self.sense * np.asarray(gx - geometry.pivot[0], float)
        # Arms of the spans: a pull of one along each, taken against the roll, about the pivot.
        arms = []
        for (nx, ny), side in (((x1, y1), 1.0), ((x2, y2), -1.0)):
            tx, ty = side * ny, -side * nx  # along the belt away from the roll
            lever_x, lever_y = radius * nx - geometry.pivot[0], radius * ny - geometry.pivot[1]
            arms.append(np.asarray(-self.sense * (lever_x * ty - lever_y * tx), float))
        self.slack_arm, self.tight_arm = arms if frame.clockwise else arms[::-1]
        # The bisector of the two spans goes through the roll's axis; its distance from the pivot.
        middle = self.first + 0.5 * self.wrap
        # The shortest span: where a pulley nearly touches the roll the wrap goes by its root.
        self.span = float(min(np.min(np.hypot(p[2] - (radius + geometry.rho) * p[0], p[3] - (radius + geometry.rho) * p[1]))
                              for p in ((x1, y1, p1, r1), (x2, y2, p2, r2))))
        self.press_arm = self.sense * (np.sin(middle) * frame.pivot[0] - np.cos(middle) * frame.pivot[1]) * -1.0

    def sums(self, friction):
        """Drag over the roll's surface (a force) and moment of all contact forces about the pivot, per tension at the tight end."""
        strongest = float(np.max(self.wrap)) * abs(friction)
        panels = max(2, int(math.ceil(strongest / 1.5)), int(math.ceil(float(np.max(self.wrap)) / 1.0)))
        drag, moment, size = 0.0, 0.0, 0.0
        ox, oy = self.frame.pivot
        turn = 1.0 if not self.frame.clockwise else -1.0  # of the roll; the belt is dragged along
        for k in range(panels):
            share = (k + 0.5 + 0.5 * NODES) / panels
            alpha = self.first[:, None] + self.wrap[:, None] * share
            # Tight where the surface comes from: at the larger angle of a roll that turns clockwise.
            away = self.wrap[:, None] * ((1 - share) if self.frame.clockwise else share)
            tension = np.exp(-friction * away)
            c, s = np.cos(alpha), np.sin(alpha)
            lx, ly = self.radius[:, None] * c - ox, self.radius[:, None] * s - oy
            press = lx * s - ly * c
            along = turn * (lx * c + ly * s)
            w = WEIGHTS * (0.5 / panels) * self.wrap[:, None]
            drag = drag + (w * friction * tension).sum(axis=1)
            moment = moment + (w * tension * (press + friction * along)).sum(axis=1)
            size = size + (w * np.abs(tension) * (np.abs(press) + np.abs(friction * along))).sum(axis=1)
        return drag, self.sense * moment, size

    def tension(self, weight, friction, extra=0.0):
        drag, moment, _ = self.sums(friction)
        return (weight * self.gravity_arm + extra) * drag / moment

    def lacking(self, wanted, weight, friction):
        """Moment that a disc must add for the wanted tension."""
        drag, moment, _ = self.sums(friction)
        return wanted * moment / drag - weight * self.gravity_arm

    def k(self, friction):
        grown = np.expm1(self.wrap * friction)
        return grown / ((grown + 2) * np.cos((math.pi - self.wrap) / 2))


# ---------------------------------------------------------------- cases


ROLL = dict(pivot=(-1.1, 0.55), right=(0.5, 0.45), left=(-0.55, 0.45), gravity=(0.1, 0.55), rho=0.06, full=0.6, core=0.05)
LEVEL = dict(pivot=(-1.58, 1.18), right=(0.85, 0.1), left=(-0.9, 0.67), gravity=(-0.13, 1.56), rho=0.06, full=0.6, core=0.05)


def draw(rng):
    """A frame of any sort; perhaps one that cannot work."""
    size = 10 ** rng.uniform(math.log10(0.05), math.log10(5))
    rho = rng.uniform(0.03, 0.5)
    wrap = rng.choice([rng.uniform(0.3, 2.5), rng.uniform(0.3, 2.5), rng.uniform(0.02, 0.3), rng.uniform(2.5, 5.2)])
    first = rng.choice([math.pi / 2 - wrap / 2 + rng.gauss(0, 0.3), rng.uniform(0, TURN)])
    points = []
    for side, normal in ((-1, first), (1, first + wrap)):
        far = (1 + rho) * (1 + rng.choice([rng.uniform(0.02, 0.2), rng.uniform(0.1, 1.5)]))
        at = normal + side * math.acos((1 + rho) / far)
        points.append((far * math.cos(at), far * math.sin(at)))
    way, far = rng.uniform(0, TURN), rng.uniform(0.6, 4)
    pivot = (far * math.cos(way), far * math.sin(way))
    gravity = (pivot[0] + rng.uniform(0.1, 3) * rng.choice([-1, 1]), pivot[1] + rng.uniform(-2, 2))
    friction = rng.choice([rng.uniform(0.1, 0.5), rng.uniform(0.1, 0.5), 10 ** rng.uniform(-4, 1.0)])
    scale = lambda p: (1e-3 * float(f"{p[0] * size * 1e3:.7g}"), 1e-3 * float(f"{p[1] * size * 1e3:.7g}"))
    mm = lambda v: 1e-3 * float(f"{v * 1e3:.7g}")
    core = size * rng.choice([rng.uniform(0.05, 0.9), rng.uniform(0.3, 0.9), rng.uniform(0.02, 0.1)])
    frame = Frame(scale(pivot), scale(points[0]), scale(points[1]), scale(gravity), mm(rho * size), mm(size), mm(core), friction,
                  float(f"{10 ** rng.uniform(0.5, 4):.5g}"), rng.random() < 0.5)
    # A centre of gravity that lifts the belt off is wanted now and then only.
    if frame.ready and rng.random() < 0.93 and -frame.way * (frame.gravity[0] - frame.pivot[0]) < 0:
        x = 2 * frame.pivot[0] - frame.gravity[0]
        frame.gravity = (mm(x), frame.gravity[1])
    return frame


def written(frame, path, tables="", brake=""):
    mm = lambda p: "[" + ", ".join(f'"{v * 1e3!r} mm"' for v in p) + "]"
    weight = '"auto"' if frame.weight is None else f'"{frame.weight!r} N"'
    path.write_text(
        f'name = "case"\n[brake]\ntension = "{frame.wanted!r} N"\nfriction = {frame.friction!r}\nweight = {weight}\n'
        f'rotation = "{"cw" if frame.clockwise else "ccw"}"\n{brake}'
        f'[brake.roll]\nlargest_radius = "{frame.full * 1e3!r} mm"\nsmallest_radius = "{frame.core * 1e3!r} mm"\n'
        f'[brake.web]\nthickness = "0.07 mm"\nwidth = "840 mm"\nmodulus = "4500 MPa"\nspeed = "10 m/s"\nlength = "6 m"\n'
        f"[brake.frame]\npivot = {mm(frame.pivot)}\nright_pulley = {mm(frame.right)}\nleft_pulley = {mm(frame.left)}\n"
        f'centre_of_gravity = {mm(frame.gravity)}\npulley_radius = "{frame.rho * 1e3!r} mm"\n'
        f"{tables}"
    )


class Runner:
    def __init__(self, binary, directory):
        self.binary, self.directory = binary, directory
        self.told = Counter()

    def run(self, name, words, machine=None):
        """Exit code, report or message, rows of the table (columns as arrays) or None."""
        for old in self.directory.glob(f"{name}.*"):
            if old.suffix != ".toml":
                old.unlink()
        command = [self.binary, "brake", str(machine or "roll"), *words, "--json", "--force", "--overwrite"]
        command += ["--out", str(self.directory), "--name", name]
        got = subprocess.run(command, capture_output=True, text=True, timeout=60)
        if got.returncode not in (0, 1, 2) or "panicked" in got.stderr:
            return 101, got.stderr, None
        if got.returncode == 2 or not got.stdout.strip():
            return 2, got.stderr, None
        report = json.loads(got.stdout)
        table = None
        path = self.directory / f"{name}.csv"
        if path.exists():
            with open(path) as file:
                lines = list(csv.reader(file))
            table = {key: np.array([float(line[i]) for line in lines[1:]]) for i, key in enumerate(lines[0])}
        return got.returncode, report, table


def solved(frame, radii):
    """The frame at these radii: contact sums in good figures."""
    wall, table = frame.march(float(radii.min()), 240)
    if wall:
        return None, table
    known_r, known_t, known_w = table
    order = np.argsort(known_r)
    guess = np.interp(radii, known_r[order], known_t[order])
    about = np.interp(radii, known_r[order], known_w[order])
    # A linear guess is good to the square of a step; bisection between the neighbours needs none of it.
    at = np.clip(np.searchsorted(-known_r, -radii, side="right") - 1, 0, len(known_r) - 2)
    low, high = known_t[at].copy(), known_t[at + 1].copy()
    for _ in range(60):
        middle = 0.5 * (low + high)
        short = frame.string(radii, frame.way * middle, about) < frame.length
        low, high = np.where(short, middle, low), np.where(short, high, middle)
    guess = 0.5 * (low + high)
    exact, turn = frame.polish(radii, guess, about)
    theta = frame.way * turn
    contact = Contact(frame, radii.astype(np.longdouble), theta, about, exact)
    contact.turn = np.asarray(turn, float)
    return contact, table


def compare(wrong, frame, table, report, contact, stations, cam=None, printed=False, ratio=0.0):
    """Every column of the table, and what the report tells of both ends."""
    f = frame.friction
    degrees = 180 / math.pi
    drag, moment, size = contact.sums(f)
    # Where moments nearly cancel, the last digits of the input tell.
    tangled = float(np.max(size / np.abs(moment)))
    shaky = tangled * 1e-14
    span = np.max(np.abs(contact.turn))
    # Likewise the place of the frame near a dead point, 1e-16 of the string over the arms.
    far = max(math.hypot(*frame.pivot), math.hypot(*frame.gravity), frame.full)
    shaky_place = 4e-16 * frame.length / np.min(np.abs(contact.slack_arm + contact.tight_arm)) * (1 + frame.full / contact.span)
    tol = 1e-10 + shaky + 30 * shaky_place * max(tangled, float(far / np.min(np.abs(contact.gravity_arm))))
    near = far * (1e-12 + 4 * shaky_place)
    full = 0
    printed_lever = contact.gravity_arm / contact.press_arm * contact.k(f)
    exact_weight = frame.wanted / float(contact.tension(1.0, f)[full])
    printed_weight = frame.wanted / float(printed_lever[full])
    weight = frame.weight if frame.weight is not None else (printed_weight / (1 - ratio) if printed else exact_weight)
    wrong.close(report["brake"]["weight_n"], weight, "weight", tol)
    wrong.close(report["brake"]["weight_exact_n"], exact_weight, "weight_exact", tol)
    wrong.close(report["brake"]["weight_printed_n"], printed_weight, "weight_printed", tol)
    wrong.close(report["brake"]["belt_length_mm"], 1e3 * frame.length, "belt_length", 1e-12)
    extra = 0.0 if cam is None else contact.lacking(frame.wanted, weight, f)
    truth = contact.tension(weight, f, extra)
    by_print = (frame.weight if frame.weight is not None else printed_weight) * printed_lever
    tension = truth
    if printed:
        tension = weight * printed_lever * (1 - ratio)
    if printed:
        tol += near / np.min(np.abs(contact.press_arm))
    wrong.close(table["tension_n"], tension, "tension_n", max(1e-9, tol))
    if max(1e-9, tol) == 1e-9:
        Wrong.largest["tension_n of tame frames"] = max(Wrong.largest["tension_n of tame frames"], float(np.max(np.abs(table["tension_n"] / tension - 1))))
    wrong.close(table["tension_printed_n"], by_print, "tension_printed_n", tol + near / np.min(np.abs(contact.press_arm)))
    wrong.close(table["tension_share"], tension / frame.wanted, "tension_share", max(1e-9, tol))
    wrong.close(table["frame_deg"], frame.way * contact.turn * degrees, "frame_deg", 1e-10, (1e-10 + shaky_place) * span)
    wrong.close(table["wrap_deg"], contact.wrap * degrees, "wrap_deg", 1e-11 + 10 * shaky_place, 1e-11)
    wrong.close(table["k"], contact.k(f), "k", 1e-10 + 10 * shaky_place)
    for key in ("weight", "press", "tight", "slack"):
        true = contact.gravity_arm if key == "weight" else getattr(contact, f"{key}_arm")
        wrong.close(1e-3 * table[f"{key}_arm_mm"], true, f"{key}_arm_mm", 1e-11, near)
    if not printed or ratio == 0:
        slack = tension / drag * np.exp(-f * contact.wrap)
        wrong.close(table["belt_slack_n"], slack, "belt_slack_n", max(1e-9, tol))
        wrong.close(table["belt_tight_n"], slack + tension, "belt_tight_n", max(1e-9, tol))
    if not printed:
        wrong.close(table["belt_speed_ratio"], ratio, "belt_speed_ratio", 0, 0)
        h = 1e-30
        apart = contact.tension(weight, f * (1 + 1j * h), extra)
        wrong.close(table["friction_sensitivity"], apart.imag / h / truth.real, "friction_sensitivity", max(1e-9, tol), 1e-12 + shaky)
    for end, at in zip(report["frame"], (0, -1)):
        for key, value in end.items():
            if key in table and key != "frame_deg":
                wrong.close(value, table[key][at], "report, ends of the roll", 1e-13)
    if not printed:  # the printed model's other frictions leave out the belt's speed
        for other in report["brake"]["other_friction"]:
            then = contact.tension(weight, other["friction"], extra)
            _, held, parts = contact.sums(other["friction"])
            if (held > 0).all():
                loose = tol + (1e-14 + 30 * shaky_place) * float(np.max(parts / held))
                wrong.close([other["tension_full_n"], other["tension_run_down_n"]], [then[0], then[-1]], "other friction", loose)
    if cam is None:
        told = report["brake"]
        turns = np.concatenate([stations[1], 0.5 * stations[1][-1] * (1 - np.cos(np.linspace(0, math.pi, 1500)))])
        radius, about = frame.radius_of(turns, stations)
        dense = Contact(frame, radius, frame.way * turns, about)
        by_moment = weight * (1 - ratio) * dense.gravity_arm / dense.press_arm * dense.k(f)
        some = np.concatenate([tension, by_moment if printed else dense.tension(weight, f)])
        room = 2e-4 * (some.max() - some.min()) + (1e-8 + tol) * some.max()
        wrong.close([told["tension_least_n"], told["tension_largest_n"]], [some.min(), some.max()], "least and largest", 0, room)
    if "printed" in report:
        said = report["printed"]
        press = frame.wanted / (contact.k(f)[full] * (1 - ratio))
        by8 = press * contact.press_arm[full] / contact.gravity_arm[full]
        wrong.close(said["press_full_n"], press, "(8)", tol)
        wrong.close(said["weight_by_8_n"], by8, "(8)", tol)
        end = 1 - frame.wanted / (by8 * printed_lever[-1])
        wrong.close(said["belt_speed_ratio_run_down"], end, "(9)", tol, 1e-9 + tol)
        wrong.close(said["belt_speed_range"], end - ratio, "(10)", tol, 1e-9 + tol)
        in_truth = by8 * np.asarray(contact.tension(1.0, f))
        wrong.close([said["tension_in_truth_n"], said["tension_in_truth_run_down_n"]], [in_truth[0], in_truth[-1]], "in truth", tol)
    # The friction that jams the frame, by bisection on the summed moment.
    share = 0.0
    if (contact.tight_arm < 0).any() and f * float(np.max(contact.wrap)) < 50:
        low, high = np.full(len(contact.wrap), f), np.full(len(contact.wrap), 100.0)
        for _ in range(12):
            middle = np.sqrt(low * high)
            held = np.array([float(c) > 0 for c in jam(contact, middle)])
            low, high = np.where(held, middle, low), np.where(held, high, middle)
        share = float(np.max(np.where(contact.tight_arm < 0, f / low, 0)))
    told = next(c for c in report["checks"] if c["check"] == "self_locking")["value"]
    if share and told < 50:
        wrong.close(told, share, "self_locking", 5e-3, 2e-2)
    elif not (contact.tight_arm < 0).any() and told != 0:
        wrong.append(f"self_locking told {told} where no friction jams")
    return weight


def jam(contact, friction):
    """Moment of all contact forces at each place with a friction of its own, by closed sums of the two spans: T of one, f of that."""
    return contact.tight_arm + contact.slack_arm * np.exp(-friction * contact.wrap)


class Law:
    """Lift over the turn of the frame, from the work that the disc gives."""

    def __init__(self, frame, table, weight, rate, preload):
        # Stations crowded at both ends: there a pulley may nearly touch the roll, and the moment may cross nothing.
        turns = table[1][-1] * 0.5 * (1 - np.cos(np.linspace(0, math.pi, 401)))
        turns[-1] = table[1][-1]
        half, mid = 0.5 * np.diff(turns), 0.5 * (turns[1:] + turns[:-1])
        nodes, weights = np.polynomial.legendre.leggauss(6)
        places = (mid[:, None] + half[:, None] * nodes).ravel()
        moment = self.moment(frame, table, weight, places).reshape(len(half), -1)
        work = np.concatenate([[0.0], np.cumsum((moment * weights).sum(axis=1) * half)])
        self.size = float((np.abs(moment) * weights).sum(axis=1) @ half)
        best = float(work.max())
        k = int(np.argmax(work))
        for i in (k - 1, k):
            if 0 <= i < len(half):
                # The parabola of the moment between stations: its root is the largest work.
                ends = self.moment(frame, table, weight, turns[i : i + 2])
                if ends[0] > 0 > ends[1]:
                    low, high = turns[i], turns[i + 1]
                    for _ in range(50):
                        middle = 0.5 * (low + high)
                        low, high = (middle, high) if self.moment(frame, table, weight, np.array([middle]))[0] > 0 else (low, middle)
                    h = 0.5 * (low - turns[i])
                    inner = self.moment(frame, table, weight, turns[i] + h * (1 + nodes))
                    best = max(best, float(work[i] + h * (inner * weights).sum()))
        self.turns, self.work, self.best = turns, work, best
        self.moments = self.moment(frame, table, weight, turns)
        self.rate, self.rest = rate, preload / rate

    def least(self):
        """The least work, between stations too."""
        return self.best - 0.5 * self.rate * float((self.between(np.linspace(0, self.turns[-1], 20001)) + self.rest).max() ** 2 - self.rest**2)

    def lift(self, work):
        d = 2 * np.maximum(self.best - work, 0) / self.rate
        return d / (self.rest + np.sqrt(self.rest**2 + d))

    def between(self, turns):
        """Lift anywhere: the work between stations is a cubic of their moments."""
        at = np.clip(np.searchsorted(self.turns, turns, side="right") - 1, 0, len(self.turns) - 2)
        h = self.turns[at + 1] - self.turns[at]
        t = (turns - self.turns[at]) / h
        a, b = self.work[at], self.work[at + 1]
        da, db = h * self.moments[at], h * self.moments[at + 1]
        return self.lift(a + t * (da + t * (3 * (b - a) - 2 * da - db + t * (2 * (a - b) + da + db))))

    @staticmethod
    def moment(frame, table, weight, turns):
        radius, about = frame.radius_of(turns, table)
        return Contact(frame, radius, frame.way * turns, about).lacking(frame.wanted, weight, frame.friction)


def rolled(path, roller, angles, clockwise):
    """Where the centre of the roller stands at each angle of the disc, and its slope over it, from the arcs alone. The disc that turns
    clockwise has the point at that polar angle under the follower; one that turns the other way is the mirror image of its drawing."""
    if not clockwise:
        y, slope = rolled(path, roller, -angles, True)
        return y, -slope
    _, vertices = polyline(str(path))
    chain = Chain(vertices)
    if chain.area() < 0:
        raise ValueError("clockwise outline")
    convex = chain.sweep >= 0
    reach = np.where(convex, chain.radius + roller, chain.radius - roller)
    start = np.arctan2(*(chain.start - chain.centre).T[::-1])
    c, s = np.cos(angles)[:, None], np.sin(angles)[:, None]
    along = c * chain.centre[:, 0] + s * chain.centre[:, 1]
    across = c * chain.centre[:, 1] - s * chain.centre[:, 0]
    with np.errstate(invalid="ignore"):
        root = np.sqrt(reach**2 - across**2)
    place = along + np.where(convex, root, -root)
    # Direction from the arc's centre to that place, and whether the arc goes there; a line has no bulge and is refused.
    if not chain.is_arc.all():
        raise ValueError("a line on the outline of a cam")
    dx, dy = place * c - chain.centre[:, 0], place * s - chain.centre[:, 1]
    way = np.arctan2(dy, dx)
    middle = start + chain.sweep / 2
    off = np.abs((way - middle + math.pi) % TURN - math.pi)
    on = (off <= np.abs(chain.sweep) / 2 + 1e-9) & np.isfinite(place)
    place = np.where(on, place, -np.inf)
    which = np.argmax(place, axis=1)
    row = np.arange(len(angles))
    y = place[row, which]
    # Normal of the pitch curve: along the line from the arc's centre.
    radial, tangential = y - along[row, which], -across[row, which]
    return y, -y * tangential / radial


def as_cut(frame, table, weight, law, path, ratio, roller, clockwise, places=9001, shift=None):
    """Web tension over the working stretch with the disc as it is written; SI, with the places as angles of the disc.

    `shift` is how high the law's lift 0 stands where that is known; else what the written disc stands above the law, on the whole."""
    end = table[1][-1]
    turns = end * np.concatenate([np.linspace(0, 1, places), 1 - np.geomspace(1e-6, 0.02, 300)[::-1]])
    y, slope = rolled(path, roller, ratio * turns, clockwise)
    y, slope = 1e-3 * y, 1e-3 * slope
    nominal = law.between(turns)
    offset = float(np.mean(y - nominal))
    force = law.rate * (law.rest + y - (offset if shift is None else shift))
    moment = -ratio * force * slope
    radius, about = frame.radius_of(turns, table)
    contact = Contact(frame, radius, frame.way * turns, about)
    return contact.tension(weight, frame.friction, moment), offset, ratio * turns, (y - offset - nominal)


def dressed(frame, table, rng):
    """Gear, spring and the tables of a disc for this frame."""
    end = table[1][-1]
    over = rng.random() < 0.12
    ratio = float(f"{(rng.uniform(361, 500) if over else rng.choice([rng.uniform(40, 340), rng.uniform(340, 359)])) / 180 * math.pi / end:.6g}")
    radii, turns, wraps = table
    some = Contact(frame, radii, frame.way * turns, wraps)
    weight = frame.weight if frame.weight is not None else frame.wanted / float(some.tension(1.0, frame.friction)[0])
    moment = some.lacking(frame.wanted, weight, frame.friction)
    work = np.concatenate([[0], np.cumsum(0.5 * (moment[1:] + moment[:-1]) * np.diff(turns))])
    swing = float(work.max() - work.min()) + 1e-9
    lift = rng.uniform(3e-3, 40e-3)
    soft = rng.uniform(0.3, 4)  # of the preload's compression over the lift
    rate = 2 * swing / (lift**2 * (1 + 2 * soft))
    rate, preload = float(f"{rate * 1e-3:.6g}"), float(f"{rate * soft * lift:.6g}")
    rotation = rng.choice(["cw", "ccw"])
    text = (
        f'[brake.cam]\nturns_per_frame_turn = {ratio!r}\nspring_rate = "{rate!r} N/mm"\npreload = "{preload!r} N"\n'
        '[follower.roller]\nradius = "15 mm"\n'
        f'[cam]\nbase_radius = "auto"\nthickness = "20 mm"\nbore_radius = "5 mm"\nmaterial = "steel"\nrotation = "{rotation}"\n'
        '[limits]\npressure_angle = "30 deg"\nmin_convex_pitch_radius_over_roller = 2.0\ntension_spread = 1.0\n'
    )
    return ratio, 1e3 * rate, preload, text, rotation, ratio * end * 180 / math.pi


# ---------------------------------------------------------------- groups


def golden(runner, wrong):
    """The figures of the specification's last table, from what camgen tells."""
    close = wrong.close
    for f, ks, share in ((0.25, (0.274165887366796260, 0.255721991805072814), 0.152822357380115603),
                         (0.30, (0.327183808926815271, 0.306435270802648008), 0.148074587862013791)):
        path = runner.directory / "ends.toml"
        path.write_text(f'name = "ends"\n[brake]\nmodel = "printed"\ntension = "300 N"\nfriction = {f}\nbelt_speed_ratio = 0.8\n'
                        '[brake.ends]\nwrap = ["90 deg", "45 deg"]\npress_ratio = 0.93\n')
        code, report, _ = runner.run("ends", ["--dry-run"], path)
        if code != 0:
            wrong.append(f"ends: exit {code}: {str(report)[:200]}")
            continue
        ends = report["ends"]
        close([ends["k_full"], ends["k_run_down"]], ks, "golden 1, 2", 4e-16)
        close(abs(ends["belt_speed_range_of_slip"]), share, "golden 3", 1e-14)
        # By hand: both ends hold 300 N in the eyes of (6).
        press = 300 / (0.2 * ks[0])
        close(ends["press_full_n"], press, "golden 4", 1e-14)
        close(ends["belt_speed_ratio_run_down"], 1 - 300 / (0.93 * press * ks[1]), "golden 4", 1e-14)
        if f == 0.25:
            close([ends["press_full_n"], ends["belt_speed_ratio_run_down"]], [5471.14017139997526, 0.769435528523976879], "golden 4", 1e-15)
        close(ends["tension_in_truth_n"], 1500, "4.1 in truth", 1e-12)
    code, report, table = runner.run("golden", ["--samples", "22", "--format", "csv"])
    at = {round(r): i for i, r in enumerate(table["roll_radius_mm"])}
    told = lambda key, radius: table[key][at[radius]]
    close(report["brake"]["belt_length_mm"], 1151.64335595526398, "golden 5", 1e-15)
    close([told("frame_deg", 300), told("wrap_deg", 300)], [-15.0395240976658934, 58.4232429187088541], "golden 6", 1e-14)
    close([told("frame_deg", 50), told("wrap_deg", 50)], [-27.1821251254367711, 52.1566777935014476], "golden 7", 1e-14)
    close([told(k, 300) for k in ("weight_arm_mm", "press_arm_mm", "slack_arm_mm", "tight_arm_mm")],
          [1158.89646776140423, 1228.91832492365415, 858.266003761705701, 341.248499378612196], "golden 8", 1e-14)
    close([report["brake"]["weight_n"], report["brake"]["weight_printed_n"]], [1030.53078728117009, 1081.31345275355376], "golden 9", 1e-14)
    close([told("tension_n", 300), told("tension_n", 50)], [267.032457647984554, 243.378703746757656], "golden 10", 1e-14)
    close([told("tension_printed_n", 300), told("tension_printed_n", 50)], [264.880998813025013, 244.306044238296701], "golden 11", 1e-14)
    more = next(o for o in report["brake"]["other_friction"] if abs(o["friction"] - 0.3) < 1e-12)
    close([more["tension_full_n"], more["tension_run_down_n"]], [362.433518205482607, 294.138923378757070], "golden 12", 1e-14)
    close([told("friction_sensitivity", 600), told("belt_slack_n", 600)], [1.03499115792, 901.743102744314276], "golden 13", 1e-11)
    web = report["web"]
    close([web["belt_speed_ratio_printed"], web["belt_speed_ratio_exact"]], [0.998866213151927438, 0.998867497168742922], "golden 18", 1e-15)
    close(web["stretch_mm"], 6.80272108843537415, "golden 18", 1e-14)
    close(web["speed_sensitivity"], 882, "882", 1e-14)
    # A strained web held between nip and belt: mass V (1 + wound)/(1 + strain) as it passes either; P by the belt's speed told.
    strain = 300 / (0.07e-3 * 0.84 * 4500e6)
    close(web["strain"], strain, "strain", 1e-14)
    for key, modulus in (("tension_4000_mpa_n", 4000e6), ("tension_5000_mpa_n", 5000e6)):
        close(web[key], 0.07e-3 * 0.84 * modulus * (1 / web["belt_speed_ratio_exact"] - 1), "modulus", 1e-10)
    close(web["roll_inertia_kg_m2"], 119.696447247638767, "golden 20", 1e-14)
    code, report, _ = runner.run("golden", ["--dry-run", "--set", "brake.acceleration=0.3m/s2"])
    text = json.dumps(report["web"])
    found = [v for v in report["web"].values() if isinstance(v, float) and abs(v - 99.7470393730323055) < 1e-9]
    if not found:
        wrong.append(f"golden 20: J V̇/R² is not in the report: {text}")
    # Without slip: the belt tells the tension, and the weight has to grip.
    for wound in (0.0, 0.0002):
        words = ["--set", "brake.mode=no-slip", "--set", f"brake.web.wound_strain={wound}", "--format", "csv", "--samples", "4"]
        code, report, table = runner.run("noslip", words)
        ratio = (1 + wound) / (1 + strain)
        close(report["web"]["belt_speed_ratio_exact"], ratio, "no-slip speed", 1e-15)
        close(table["belt_speed_ratio"], np.full(5, ratio), "no-slip speed", 1e-15)
        close(report["web"]["heat_w"], 3000 * (1 - ratio), "no-slip heat", 1e-10)
        grip = next(c for c in report["checks"] if c["check"] == "grip")
        close(grip["value"], 243.378703746757656 / 300, "grip", 1e-12)
        close(float(re.search(r'"([\d.]+) N"', grip["note"])[1]), 1905.42, "weight for the grip", 0, 0.0101)
    for given, wound, true in ((0.9985, 0.0, 397.496244366549825), (0.9985, 0.0002, 450.495743615423135)):
        close(0.07e-3 * 0.84 * 4500e6 * ((1 + wound) / given - 1), true, "golden 19 (ours)", 1e-12)


def balance(runner, wrong):
    """What the moments about the pivot and the paper's own (3) to (6) say where the belt does not slip, and where it slips in print."""
    frame = Frame(**ROLL, friction=0.25, wanted=300.0, clockwise=True)
    for weight in (2500.0, 1100.0):
        words = ["--set", "brake.mode=no-slip", "--set", f"brake.weight={weight} N", "--format", "csv", "--samples", "22"]
        _, report, table = runner.run("gripping", words)
        contact, _ = solved(frame, 1e-3 * table["roll_radius_mm"])
        could = contact.tension(weight, 0.25)
        grips = could > 300
        tension = np.where(grips, 300.0, could)
        wrong.close(table["tension_n"], tension, f"no-slip, {weight} N: tension_n", 1e-11)
        # The spans' pulls hold the weight, whatever the friction does: two unknowns, and their difference is the tension.
        slack = (weight * contact.gravity_arm - tension * contact.tight_arm) / (contact.tight_arm + contact.slack_arm)
        wrong.close(table["belt_slack_n"], slack, f"no-slip, {weight} N: belt_slack_n by the moments about the pivot", 1e-10)
        wrong.close(table["belt_tight_n"], slack + tension, f"no-slip, {weight} N: belt_tight_n by the moments about the pivot", 1e-10)
        apart = contact.tension(weight, 0.25 * (1 + 1e-30j)).imag / 1e-30 / could
        wrong.close(table["friction_sensitivity"], np.where(grips, 0, apart), f"no-slip, {weight} N: friction_sensitivity", 1e-10)
        for other in report["brake"]["other_friction"]:
            then = np.minimum(contact.tension(weight, other["friction"]), 300)
            told = [other["tension_full_n"], other["tension_run_down_n"]]
            wrong.close(told, [then[0], then[-1]], f"no-slip, {weight} N: with a friction of {other['friction']:.2f}", 1e-10)
    words = ["--set", "brake.model=printed", "--set", "brake.belt_speed_ratio=0.8", "--format", "csv", "--samples", "22"]
    _, report, table = runner.run("in-print", words)
    contact, _ = solved(frame, 1e-3 * table["roll_radius_mm"])
    weight = 5 * 300 / float((contact.gravity_arm / contact.press_arm * contact.k(0.25))[0])
    wrong.close(report["brake"]["weight_n"], weight, "printed: weight", 1e-11)
    # (3): both spans alike, their resultant along the bisector holds the weight; (5), whatever the belt's speed.
    mean = weight * contact.gravity_arm / (2 * np.cos((math.pi - contact.wrap) / 2) * contact.press_arm)
    slack = 2 * mean / (np.exp(0.25 * contact.wrap) + 1)
    wrong.close(table["belt_slack_n"], slack, "printed at V_z/V = 0.8: belt_slack_n by (5)", 1e-10)
    for other in report["brake"]["other_friction"]:
        then = weight * contact.gravity_arm / contact.press_arm * contact.k(other["friction"]) * 0.2
        wrong.close(other["tension_full_n"], then[0], f"printed at V_z/V = 0.8: with a friction of {other['friction']:.2f}", 1e-10)


def level(runner, wrong):
    frame = Frame(**LEVEL, friction=0.25, wanted=300.0, clockwise=True)
    code, report, table = runner.run("level", ["--format", "csv"], "roll-level")
    contact, stations = solved(frame, 1e-3 * table["roll_radius_mm"])
    weight = compare(wrong, frame, table, report, contact, stations)
    wrong.close(weight, 1518.3893025303, "weight of roll-level", 1e-12)
    if not (code == 0 and 299.675 < table["tension_n"].min() and table["tension_n"].max() < 300.005):
        wrong.append(f"roll-level: exit {code}, {table['tension_n'].min()} to {table['tension_n'].max()} N")


def disc_case(runner, wrong, name, frame, ratio, rate, preload, words, machine=None, limit=None, clockwise=True):
    """One disc: law, table and outline. Largest error of the tension as cut, N."""
    code, report, table = runner.run(name, ["--cam", "--format", "csv,dxf", *words], machine)
    if table is None or code == 101:
        return code, report
    radii = 1e-3 * table["roll_radius_mm"]
    contact, stations = solved(frame, radii)
    weight = compare(wrong, frame, table, report, contact, stations, cam=True)
    wrong.close(table["tension_n"], np.full(len(radii), frame.wanted), "tension_n with the disc", 1e-9)
    law = Law(frame, stations, weight, rate, preload)
    degrees = 180 / math.pi
    wrong.close(table["cam_deg"], ratio * contact.turn * degrees, "cam_deg", 1e-9, 1e-9)
    moment = contact.lacking(frame.wanted, weight, frame.friction)
    size = weight * np.max(contact.gravity_arm)
    _, sums, sizes = contact.sums(frame.friction)
    shaky = 1e-9 + float(np.max(sizes / np.abs(sums))) * 1e-13
    wrong.close(table["cam_moment_nm"], moment, "cam_moment_nm", 1e-9, shaky * size)
    # Stations of ours are not those of the table: the lift there by its own small integral from the station before.
    at = np.clip(np.searchsorted(law.turns, contact.turn + 1e-15, side="right") - 1, 0, len(law.turns) - 1)
    nodes, weights = np.polynomial.legendre.leggauss(6)
    h = 0.5 * (contact.turn - law.turns[at])
    inner = Law.moment(frame, stations, weight, (law.turns[at][:, None] + h[:, None] * (1 + nodes)).clip(0, law.turns[-1]).ravel())
    work = law.work[at] + h * (inner.reshape(len(h), -1) * weights).sum(axis=1)
    lift = law.lift(work)
    floor = 1e-10 * (size * stations[1][-1] + law.size) / (rate * law.rest)
    # Where a pulley is about to touch the roll the moment goes by a root, and no quadrature has all figures.
    rough = 1e-5 if contact.span < 0.05 * frame.full else 0.0
    wrong.close(1e-3 * table["lift_mm"], lift, "lift_mm", 1e-8 + rough, (1e-8 + rough) * lift.max() + floor)
    told = report["disc"]
    # What the spring gives on the way from its most to its least.
    wrong.close(told["work_j"], law.best - law.least(), "work", 1e-8 + rough, 1e-9 * (size * stations[1][-1] + law.size))
    wrong.close(1e-3 * told["lift_full_mm"], lift[0], "lift on the full roll", 1e-8 + rough, (1e-8 + rough) * lift.max() + floor)
    path = runner.directory / f"{name}-cam.dxf"
    try:
        tension, offset, angles, off = as_cut(frame, stations, weight, law, path, ratio, 15.0, clockwise)
    except (ValueError, AssertionError) as error:
        wrong.append(f"outline: {error}")
        return code, report
    # Offset by ours against what camgen's own table tells of law and motion.
    with open(runner.directory / f"{name}-cam.csv") as file:
        first = next(csv.DictReader(file))
    shift = 1e-3 * (report["cam"]["prime_radius_mm"] + float(first["lift_mm"]) - float(first["position_mm"]))
    tolerance = 1e-3 * report["outline"]["tolerance_mm"]
    Wrong.largest["outline off the law, of the tolerance"] = max(Wrong.largest["outline off the law, of the tolerance"], float(np.max(np.abs(off))) / tolerance)
    if abs(shift - offset) > 1.5 * tolerance:
        wrong.append(f"the law stands {1e6 * (shift - offset):.2f} µm off what is cut")
    if np.max(np.abs(off)) > 2.5 * tolerance:
        wrong.append(f"as cut {1e6 * np.max(np.abs(off)):.2f} µm off the law, tolerance {1e6 * tolerance} µm")
    tension = as_cut(frame, stations, weight, law, path, ratio, 15.0, clockwise, shift=shift)[0]
    error = float(np.max(np.abs(tension - frame.wanted)))
    # Either of the two may miss a narrow peak between its places by so much of the error.
    room = PEAKS * error + 2e-5 * frame.wanted
    # A brake that is about to jam has no bounds of its tension to compare.
    if np.max(sizes / np.abs(sums)) < 1e3:
        said = np.array([told["tension_as_cut_least_n"], told["tension_as_cut_largest_n"]])
        wrong.close(said, [tension.min(), tension.max()], "as cut, told", 0, room)
        away = float(np.max(np.abs(said - [tension.min(), tension.max()]))) / max(error, 1e-6 * frame.wanted)
        Wrong.largest["as cut, told, of the error as cut"] = max(Wrong.largest["as cut, told, of the error as cut"], away)
    if limit is not None and error > limit:
        wrong.append(f"{name}: as cut {error:.4f} N off, at most {limit}")
    return error, report


def roll(runner, wrong):
    """The embedded machine with its disc, at three tolerances and both ways round."""
    frame = Frame(**ROLL, friction=0.25, wanted=300.0, clockwise=True)
    out = []
    for name, words, limit in (("roll-5", [], 1.5), ("roll-005", ["--tolerance", "0.05um"], 0.08),
                               ("roll-v", ["--tolerance-velocity", "0.1%"], None), ("roll-ccw", ["--set", "cam.rotation=ccw"], 1.5),
                               ("roll-v2", ["--tolerance-velocity", "0.02%"], 0.1)):
        error, report = disc_case(runner, wrong, name, frame, 10.0, 20e3, 1e3, words, None, limit, name != "roll-ccw")
        if isinstance(error, int):
            wrong.append(f"{name}: exit {error}: {str(report)[:200]}")
        else:
            out.append(f"{name} {error:.4f} N")
        if name == "roll-5":
            with open(runner.directory / "roll-5.csv") as file:
                rows = {round(float(r["roll_radius_mm"])): r for r in csv.DictReader(file)}
            wrong.close(report["disc"]["work_j"], 63.7279628167790370, "golden 14", 1e-12)
            wrong.close(report["disc"]["cam_end_deg"], 271.821251254367711, "golden 14", 1e-14)
            wrong.close([float(rows[r]["lift_mm"]) for r in (600, 500, 300, 100)],
                        [44.1955215585003473, 42.5650642915691229, 32.2047795779638801, 9.48501658986883778], "golden 15", 1e-12)
            wrong.close([float(rows[r]["cam_moment_nm"]) for r in (300, 50)], [147.444348237193964, 255.925862925341622], "golden 17", 1e-12)
    return "; ".join(out)


def describe(frame):
    return (f"pivot {frame.pivot} right {frame.right} left {frame.left} gravity {frame.gravity} rho {frame.rho} full {frame.full} core {frame.core} "
            f"f {frame.friction} {'cw' if frame.clockwise else 'ccw'} P {frame.wanted} G {frame.weight}")


def refusal(message, wall):
    """Whether the message names this wall, and its radius (or None)."""
    names, radius = wall
    found = re.search(r"radius of ([\d.eE+-]+) mm", message)
    told = float(found[1]) * 1e-3 if found else None
    return any(WALLS[n] in message for n in names), told


def random_frames(runner, count, seed):
    rng = random.Random(seed)
    tally, failures = Counter(), []
    number = accepted = 0
    while accepted < count and number < 40 * count:
        number += 1
        frame = draw(rng)
        name = f"case-{number}"
        path = runner.directory / f"{name}.toml"
        wrong = Wrong()
        wall, table = frame.march(frame.core)
        kind, reach = "plain", None
        if wall and wall[1] < 0.97 * frame.full and rng.random() < 0.8:
            # Not as far as the wall: just before it, or just beyond.
            share = rng.choice([1e-3, 1e-5, 0.1, 0.3])
            before = wall[1] + share * (frame.full - wall[1]) * (1 if rng.random() < 0.7 else -0.1)
            reach = wall
            frame.core = 1e-3 * float(f"{max(before, 0.01 * frame.full) * 1e3:.9g}")
            wall, table = frame.march(frame.core)
            kind = "near a wall"
        elif wall and wall[1] >= 0.97 * frame.full and rng.random() < 0.7:
            continue  # not yet a brake
        if not wall and rng.random() < 0.3:
            some = Contact(frame, table[0][:1], np.zeros(1), table[2][:1])
            frame.weight = float(f"{frame.wanted / float(some.tension(1.0, frame.friction)[0]) * rng.uniform(0.5, 2):.6g}")
        printed = not wall and rng.random() < 0.12
        ratio = float(f"{rng.uniform(0, 0.9):.3g}") if not wall and rng.random() < 0.3 else 0.0
        cam = not wall and not printed and ratio == 0 and rng.random() < 0.33
        dress = dressed(frame, table, rng) if cam else None
        cam = cam and dress[2] < 9e8 and 2e-9 < dress[1] < 9e11
        words = ["--samples", str(STATIONS), "--format", "csv"]
        brake = f'model = "{"printed" if printed else "consistent"}"\nbelt_speed_ratio = {ratio!r}\n'
        if cam:
            gear, rate, preload, tables, rotation, end = dress
            written(frame, path, tables, brake)
            sampled = ["--samples", str(STATIONS)]
            error, report = disc_case(runner, wrong, name, frame, gear, rate, preload, sampled, path, None, rotation == "cw")
            if end >= 360:
                tally["discs of more than a turn refused"] += 1
                if error != 2 or "give a turns_per_frame_turn of" not in str(report):
                    wrong.append(f"a disc of {end:.2f}° is not refused: {str(report)[:200]}")
            elif isinstance(error, int):
                if error == 2 and any(w in str(report) for w in ("does not fit", "undercut", "base radius", "base_radius")):
                    tally["discs that cannot be cut"] += 1
                else:
                    wrong.append(f"disc of {end:.2f}°, exit {error}: {str(report)[:300]}")
            else:
                tally["discs"] += 1
                accepted += 1
                Wrong.largest["tension as cut at 5 µm, of the wanted"] = max(Wrong.largest["tension as cut at 5 µm, of the wanted"], error / frame.wanted)
        else:
            written(frame, path, "[limits]\ntension_spread = 1.0\n", brake)
            code, report, columns = runner.run(name, words, path)
            if code == 101:
                wrong.append(f"panic: {report[:300]}")
            elif wall:
                tally[f"refused: {wall[0][0]}"] += 1
                if code == 2 and "around" in wall[0]:
                    pass
                elif code != 2:
                    wrong.append(f"accepted (exit {code}) where {wall[0]} at {wall[1] * 1e3} mm")
                else:
                    named, told = refusal(report, wall)
                    if not named:
                        wrong.append(f"wall {wall[0]} at {wall[1] * 1e3} mm, told: {report.splitlines()[0]}")
                    elif told is None or abs(told - wall[1]) > 2e-5 * wall[1] + 2e-6 * frame.full + 6e-7:
                        wrong.append(f"wall {wall[0]} at {wall[1] * 1e3:.6f} mm, told at {told and told * 1e3}: {report.splitlines()[0]}")
            elif code == 2:
                wrong.append(f"refused though nothing is in the way: {report.splitlines()[0] if report else 'nothing said'}")
            else:
                tally[kind if not printed else "printed"] += 1
                accepted += 1
                contact, stations = solved(frame, 1e-3 * columns["roll_radius_mm"])
                if contact is None:
                    wrong.append("no place for the last row")
                else:
                    compare(wrong, frame, columns, report, contact, stations, printed=printed, ratio=ratio)
                    if reach and "around" not in reach[0] and reach[1] > 2e-3 * frame.core:
                        # How far it could follow: to the wall found before.
                        far = next(c for c in report["checks"] if c["check"] == "frame_reach")["value"]
                        wrong.close(1e-3 * far, reach[1], "frame_reach", 2e-5, 2e-6 * frame.full)
        if wrong:
            failures.append(f"{name} (seed {seed}): {'; '.join(wrong[:4])}\n    {describe(frame)}")
        else:
            for old in runner.directory.glob(f"{name}[.-]*"):
                old.unlink()
    return tally, failures, accepted


def main():
    words = argparse.ArgumentParser()
    words.add_argument("binary")
    words.add_argument("directory", type=Path)
    words.add_argument("--count", type=int, default=300)
    words.add_argument("--seed", type=int, default=1)
    given = words.parse_args()
    given.directory.mkdir(parents=True, exist_ok=True)
    runner = Runner(given.binary, given.directory)
    bad = False

    def told(title, wrong, more=""):
        nonlocal bad
        print(f"{title}: {len(wrong)} wrong{'; ' + more if more else ''}")
        for line in wrong[:20]:
            bad = True
            print(f"  {line}")

    wrong = Wrong()
    golden(runner, wrong)
    told("golden figures", wrong)
    wrong = Wrong()
    balance(runner, wrong)
    told("belt without slip, and slip in print", wrong)
    wrong = Wrong()
    level(runner, wrong)
    told("roll-level", wrong)
    wrong = Wrong()
    more = roll(runner, wrong)
    told("roll with its disc", wrong, more)
    tally, failures, accepted = random_frames(runner, given.count, given.seed)
    told(f"{accepted} random frames", failures, ", ".join(f"{n} {k}" for k, n in sorted(tally.items())))
    print("worst: " + ", ".join(f"{k} {v:.1e}" for k, v in sorted(Wrong.largest.items()) if not k.startswith("golden")))
    if bad or accepted < given.count:
        sys.exit(1)


main()
