"""Shafts, alone and under the cam of a press: critical speeds, modes, deflections, what they take off the lift, unbalance.

Shares nothing with camgen but the keys of the machine file and Cowper's shear coefficient. Every panel is carried over exactly by the
exponential of its equations (Timoshenko or Euler, with rotary inertia and gyroscopic couples of the asked whirl) in 80-bit floats,
each support an unknown force of its own; a speed is right where the determinant of what is left changes its sign, from one side of
the told speed to the other, and none is left out because the assembled dynamic stiffness has as many negative eigenvalues as
there are told speeds below (Wittrick and Williams; its pieces are too short to resonate by themselves). Deflections are the same
integration at rest. The paper's method is programmed from its text. The lift lost is Newton's root of its balance at every place, largest
values by scanning and zooming in. The cam's own mass, unbalance and inertias are integrated along the exact profile of its law, less its
bore and the holes that the DXF of the disc shows, and what that DXF draws must be the same within its tolerance.

usage: shaft.py CAMGEN_BINARY DIRECTORY [--count N] [--seed N] [--jobs N]
"""
import csv
import json
import math
import random
import re
import subprocess
import time
import traceback
from collections import defaultdict
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import cases
import numpy as np
from outline import Chain, polyline

X = np.longdouble
PI = X("3.14159265358979323846264338327950288")
AT = X("98066.5")
RPM = 30 / PI
# Tabulated steps about a told speed; the determinant must change its sign within the first that is allowed.
STEPS = np.array([10.0**-k for k in range(14, 4, -1)], dtype=X)
# A double loses (ω_j/ω_1)² of its rounding in the weakest of many modes; the rest came to 1e-12.
SPEED = 1e-9
CLOSE = 1e-10
# Shapes have about half the digits of the speeds; 4e-6 was the worst of 700, of a fifth mode 1500 times the first.
SHAPE = 1e-5
PAPER = 1e-9
PLACE = 3e-6


class Wrong(list):
    def __init__(self):
        super().__init__()
        self.largest = defaultdict(float)

    def close(self, told, true, what, relative=CLOSE, absolute=0.0):
        if told is None or (isinstance(told, float) and math.isnan(told)):
            return self.append(f"{what} not told, is {float(true)!r}")
        off = abs(X(told) - X(true))
        share = float(max(off - X(absolute), X(0)) / max(abs(X(true)), X(1e-300)))
        self.largest[what] = max(self.largest[what], share)
        if not off <= relative * abs(X(true)) + absolute:
            self.append(f"{what} told {float(told)!r}, is {float(true)!r} ({share:.1e})")

    def near(self, told, true, scale, what, bound):
        """Arrays against the largest of a curve."""
        off = np.abs(np.asarray(told, dtype=X) - true)
        share = float(off.max() / scale) if len(off) else 0.0
        self.largest[what] = max(self.largest[what], share)
        if not share <= bound:
            i = int(off.argmax())
            self.append(f"{what} row {i} told {float(told[i])!r}, is {float(np.asarray(true)[i])!r} ({share:.1e} of the largest)")


def camgen(binary, words, wrong=None, code=0):
    got = subprocess.run([binary, *map(str, words)], capture_output=True, text=True)
    if wrong is not None and got.returncode != code:
        wrong.append(f"exit {got.returncode}, not {code}: {got.stderr.strip()}")
    return got, json.loads(got.stdout) if got.stdout.startswith("{") else None


def table(path):
    with open(path, newline="") as file:
        rows = list(csv.reader(file))
    return {name: np.array([X(row[i]) if row[i] else X("nan") for row in rows[1:]], dtype=X) for i, name in enumerate(rows[0])}


# ---- linear algebra in 80 bits


def eliminate(matrix):
    """Determinant's sign and logarithm, of many small matrices."""
    m = np.array(matrix, dtype=X)
    count, size = len(m), m.shape[1]
    sign, rows = np.ones(count), np.arange(count)
    scale = np.abs(m).max(axis=2, keepdims=True)
    m = m / np.where(scale > 0, scale, 1)
    for i in range(size):
        best = i + np.abs(m[:, i:, i]).argmax(axis=1)
        sign[best != i] *= -1
        m[rows, i], m[rows, best] = m[rows, best].copy(), m[rows, i].copy()
        pivot = m[:, i, i]
        sign *= np.sign(pivot.astype(float) * 1e250)
        factor = m[:, i + 1 :, i] / np.where(pivot == 0, 1, pivot)[:, None]
        m[:, i + 1 :] -= factor[:, :, None] * m[:, i : i + 1]
    return sign


def solve(matrix, right):
    a = np.concatenate([np.array(matrix, dtype=X), np.array(right, dtype=X)[:, None]], axis=1)
    a /= np.abs(a[:, :-1]).max(axis=1)[:, None]
    size = len(a)
    for i in range(size):
        p = i + int(np.abs(a[i:, i]).argmax())
        a[[i, p]] = a[[p, i]]
        a[i + 1 :] -= (a[i + 1 :, i] / a[i, i])[:, None] * a[i]
    out = np.zeros(size, dtype=X)
    for i in reversed(range(size)):
        out[i] = (a[i, -1] - a[i, i + 1 : size] @ out[i + 1 :]) / a[i, i]
    return out


def null_vector(matrix):
    """What a singular matrix makes 0, by complete pivoting."""
    a = np.array(matrix, dtype=X)
    a /= np.abs(a).max(axis=1)[:, None]
    a /= (columns := np.abs(a).max(axis=0))
    size = len(a)
    order = np.arange(size)
    for i in range(size - 1):
        p, q = np.unravel_index(np.abs(a[i:, i:]).argmax(), (size - i, size - i))
        a[[i, i + p]] = a[[i + p, i]]
        a[:, [i, i + q]] = a[:, [i + q, i]]
        order[[i, i + q]] = order[[i + q, i]]
        a[i + 1 :] -= (a[i + 1 :, i] / a[i, i])[:, None] * a[i]
    out = np.zeros(size, dtype=X)
    out[-1] = 1
    for i in reversed(range(size - 1)):
        out[i] = -(a[i, i + 1 :] @ out[i + 1 :]) / a[i, i]
    back = np.zeros(size, dtype=X)
    back[order] = out
    return back / columns


# ---- the shaft

STEEL = dict(modulus=210e9, density=7850.0, poisson=0.3)


class Segment:
    def __init__(self, length, diameter, bore, modulus, density, poisson):
        self.length, self.d, self.b = X(length), X(diameter), X(bore)
        e, nu, q = X(modulus), X(poisson), self.b / self.d
        self.area, self.j = PI * (self.d**2 - self.b**2) / 4, PI * (self.d**4 - self.b**4) / 64
        self.ej, self.g = e * self.j, e / (2 * (1 + nu))
        k = 6 * (1 + nu) * (1 + q * q) ** 2 / ((7 + 6 * nu) * (1 + q * q) ** 2 + (20 + 12 * nu) * q * q)
        self.kga = k * self.g * self.area
        self.rho_a, self.rho_j = X(density) * self.area, X(density) * self.j


class Shaft:
    """segments; supports (at, stiffness or None); discs (at, mass, I_t, I_p); extra places; SI."""

    def __init__(self, segments, supports, discs, places=(), beam="timoshenko"):
        self.segments, self.supports, self.discs = segments, sorted(supports, key=lambda s: s[0]), discs
        self.beam, self.length = beam, sum(s.length for s in segments)
        ends = np.cumsum(np.array([s.length for s in segments], dtype=X))
        self.ends = ends
        self.steps = [X(0), *ends]
        marks = sorted({float(x) for x in [*self.steps, *(s[0] for s in supports), *(d[0] for d in discs), *places]})
        marks = [m for i, m in enumerate(marks) if i == 0 or m - marks[i - 1] > 1e-12]
        self.nodes = marks
        self.panels = []
        for a, b in zip(marks, marks[1:]):
            i = min(int((ends <= X(a + b) / 2).sum()), len(segments) - 1)
            self.panels.append((X(a), X(b) - X(a), segments[i]))
        self.unit = np.exp(np.mean(np.log(np.array([s.ej for s in segments], dtype=X))))

    def node(self, x):
        return int(np.argmin([abs(n - float(x)) for n in self.nodes]))

    def carry(self, panel, lengths, squares, g):
        """State (y, ψ, M, Q) from the left of a piece to its right; lengths or squares of the speed may be many."""
        _, _, s = panel
        l, unit = self.length, self.unit
        lengths, squares = np.broadcast_arrays(np.atleast_1d(np.asarray(lengths, dtype=X)) / l, np.asarray(squares, dtype=X))
        a = np.zeros((lengths.size, 4, 4), dtype=X)
        thick = self.beam == "timoshenko"
        a[:, 0, 1] = 1
        a[:, 0, 3] = unit / (s.kga * l * l) if thick else 0
        a[:, 1, 2] = unit / s.ej
        a[:, 2, 3] = -1
        a[:, 2, 1] = -(g * s.rho_j * l * l / unit * squares) if thick else 0
        a[:, 3, 0] = -s.rho_a * l**4 / unit * squares
        a *= lengths[:, None, None]
        # Sizes balanced for the exponential: y, ψ, M, Q by powers of what makes the largest entries alike.
        norm = float(np.abs(a).max())
        balance = X(max(norm, 1e-30)) ** X(0.25) if norm > 1 else X(1)
        d = balance ** np.arange(4)
        a = a * d[None, None, [0, 1, 2, 3]] / d[None, [0, 1, 2, 3], None]
        halvings = max(0, math.ceil(math.log2(max(float(np.abs(a).sum(axis=2).max()), 1e-30))) + 1)
        a = a / X(2) ** halvings
        out = np.zeros_like(a) + np.eye(4, dtype=X)
        term = out.copy()
        for i in range(1, 19):
            term = np.matmul(term, a) / i
            out = out + term
        for _ in range(halvings):
            out = np.matmul(out, out)
        return out * d[None, :, None] / d[None, None, :]

    def march(self, squares, whirl, force=None):
        """Conditions at supports and the right end over the unknowns (y, ψ on the left, forces of supports, and what is given);
        the states at every node, after what acts on it."""
        squares = np.atleast_1d(np.asarray(squares, dtype=X))
        gamma = {"planar": 0, "forward": 1, "backward": -1}[whirl]
        g = 1 - 2 * gamma
        l, unit = self.length, self.unit
        size = 2 + len(self.supports) + 1
        z = np.zeros((len(squares), 4, size), dtype=X)
        z[:, 0, 0] = z[:, 1, 1] = 1
        rows, states = [], []
        for i, x in enumerate(self.nodes):
            if i:
                z = np.matmul(self.carry(self.panels[i - 1], self.panels[i - 1][1], squares, g), z)
            for at, mass, across, along in self.discs:
                if self.node(at) == i:
                    z[:, 3] -= (X(mass) * l**3 / unit * squares)[:, None] * z[:, 0]
                    z[:, 2] -= ((X(across) - gamma * X(along)) * l / unit * squares)[:, None] * z[:, 1]
            for j, (at, stiffness) in enumerate(self.supports):
                if self.node(at) == i:
                    row = z[:, 0].copy()
                    row[:, 2 + j] -= 0 if stiffness is None else unit / (X(stiffness) * l**3)
                    rows.append(row)
                    z = z.copy()
                    z[:, 3, 2 + j] += 1
            if force is not None and self.node(force) == i:
                z = z.copy()
                z[:, 3, -1] -= l * l / unit
            states.append(z.copy())
        rows += [z[:, 2], z[:, 3]]
        return np.stack(rows, axis=1), states

    def signs(self, rpm, whirl):
        squares = (np.atleast_1d(np.asarray(rpm, dtype=X)) / RPM) ** 2
        return eliminate(self.march(squares, whirl)[0][:, :, :-1])

    def below(self, rpm, whirl):
        """How many critical speeds are lower."""
        square = (X(rpm) / RPM) ** 2
        gamma = {"planar": 0, "forward": 1, "backward": -1}[whirl]
        g = 1 - 2 * gamma
        l, unit = self.length, self.unit
        pieces, where = [], []
        for i, (_, length, s) in enumerate(self.panels):
            n = 1
            while True:
                h = length / n
                bending = s.rho_a * (h / X("4.73")) ** 4 / s.ej
                rest = s.rho_a * (h / PI) ** 2 / s.kga + 3 * s.rho_j * (h / PI) ** 2 / s.ej if self.beam == "timoshenko" else 0
                if square * (bending + rest) < 0.5:
                    break
                n = n + 1 if n < 4 else int(n * 1.4)
            where.append(sum(n for n, _ in pieces))
            pieces.append((n, self.carry(self.panels[i], h, square, g)[0]))
        total = sum(n for n, _ in pieces)
        where.append(total)
        k = np.zeros((2 * total + 2, 2 * total + 2), dtype=X)
        at = 0
        for n, t in pieces:
            a, b, c, d = t[:2, :2], t[:2, 2:], t[2:, :2], t[2:, 2:]
            det = b[0, 0] * b[1, 1] - b[0, 1] * b[1, 0]
            inverse = np.array([[b[1, 1], -b[0, 1]], [-b[1, 0], b[0, 0]]], dtype=X) / det
            # Ends' forces: Q goes with y, M with ψ, the left ones reversed.
            from_left, from_right = -inverse @ a, inverse
            end_left, end_right = c + d @ from_left, d @ from_right
            swap = [1, 0]
            piece = np.block([[-from_left[swap], -from_right[swap]], [end_left[swap], end_right[swap]]])
            piece = (piece + piece.T) / 2
            for _ in range(n):
                k[2 * at : 2 * at + 4, 2 * at : 2 * at + 4] += piece
                at += 1
        fixed = []
        for place, stiffness in self.supports:
            i = 2 * where[self.node(place)]
            if stiffness is None:
                fixed.append(i)
            else:
                k[i, i] += X(stiffness) * l**3 / unit
        for place, mass, across, along in self.discs:
            i = 2 * where[self.node(place)]
            k[i, i] -= X(mass) * l**3 / unit * square
            k[i + 1, i + 1] -= (X(across) - gamma * X(along)) * l / unit * square
        keep = [i for i in range(len(k)) if i not in fixed]
        k = k[np.ix_(keep, keep)]
        d = np.sqrt(np.abs(np.diag(k)))
        k = k / d / d[:, None]
        # Banded elimination in 80 bits; its negative pivots are the negative eigenvalues (Sylvester).
        negative = 0
        for i in range(len(k)):
            negative += k[i, i] < 0
            end = min(i + 4, len(k))
            k[i + 1 : end, i:end] -= (k[i + 1 : end, i] / k[i, i])[:, None] * k[i, i:end]
        return int(negative)

    def states_at(self, states, x, square, g):
        """States at places, of one march already combined."""
        out = np.zeros((len(x), 4), dtype=X)
        index = np.clip(np.searchsorted(np.array(self.nodes), np.asarray(x, dtype=float), side="right") - 1, 0, len(self.panels) - 1)
        for i in set(index):
            mine = np.nonzero(index == i)[0]
            t = self.carry(self.panels[i], np.maximum(x[mine] - self.panels[i][0], 0), square, g)
            out[mine] = np.matmul(t, states[i][:, None])[:, :, 0]
        return out

    def root(self, rpm, whirl, share):
        """The critical speed near a told one, or that where there is none."""
        low, high = X(rpm) * (1 - X(share)), X(rpm) * (1 + X(share))
        for _ in range(9):
            at = low + (high - low) * np.arange(33, dtype=X) / 32
            s = self.signs(at, whirl)
            turn = np.nonzero(s[1:] * s[:-1] <= 0)[0]
            if not len(turn):
                return X(rpm)
            low, high = at[turn[0]], at[turn[0] + 1]
        return (low + high) / 2

    def mode(self, rpm, whirl, x):
        """Deflections of the mode at places; largest 1. And whether another place comes within a hair of it."""
        square = (X(rpm) / RPM) ** 2
        g = {"planar": 1, "forward": -1, "backward": 3}[whirl]
        conditions, states = self.march(square, whirl)
        v = np.append(null_vector(conditions[0][:, :-1]), X(0))
        nodes = [s[0] @ v for s in states]
        fine = np.concatenate([p[0] + p[1] * np.arange(0, 41, dtype=X) / 40 for p in self.panels])
        y = lambda at: self.states_at(nodes, np.atleast_1d(at), square, g)[:, 0]
        values = y(fine)
        peaks = []
        for sense in (1, -1):
            i = int((sense * values).argmax())
            low, high = fine[max(i - 2, 0)], fine[min(i + 2, len(fine) - 1)]
            best = sense * values[i]
            for _ in range(5):
                at = low + (high - low) * np.arange(33, dtype=X) / 32
                there = sense * y(at)
                j = int(there.argmax())
                best = max(best, there[j])
                low, high = at[max(j - 1, 0)], at[min(j + 1, 32)]
            peaks.append(best)
        scale = peaks[0] if peaks[0] >= peaks[1] else -peaks[1]
        return y(x) / scale, abs(peaks[0] - peaks[1]) < 1e-7 * abs(scale)

    def under(self, force, x):
        """Under 1 N: y and slope at places, y at the force, slopes at and forces of the supports, in their order along the shaft."""
        conditions, states = self.march(0, "planar", force)
        v = np.append(solve(conditions[0][:, :-1], -conditions[0][:, -1]), X(1))
        nodes = [s[0] @ v for s in states]
        at = self.states_at(nodes, x, X(0), 1)
        slopes = [nodes[self.node(p)][1] for p, _ in self.supports]
        forces = [-v[2 + j] * self.unit / self.length**2 for j in range(len(self.supports))]
        return at[:, 0] * self.length, at[:, 1], nodes[self.node(force)][0] * self.length, slopes, forces

    def twist(self, drive, at):
        low, high = sorted((X(drive), X(at)))
        out, begin = X(0), X(0)
        for s in self.segments:
            inside = min(high, begin + s.length) - max(low, begin)
            if inside > 0:
                out += inside / (s.g * 2 * s.j)
            begin += s.length
        return out

    def mass(self):
        return sum(s.rho_a * s.length for s in self.segments) + sum(X(d[1]) for d in self.discs)

    def centre(self):
        begin, moment = X(0), X(0)
        for s in self.segments:
            moment += s.rho_a * s.length * (begin + s.length / 2)
            begin += s.length
        return (moment + sum(X(d[1]) * X(d[0]) for d in self.discs)) / self.mass()

    def paper(self, stations):
        """The paper's iteration, from its text."""
        marks = sorted({float(x) for x in [*self.steps, *(s[0] for s in self.supports), *(d[0] for d in self.discs)]})
        ends, total = self.ends, self.length
        x, m, ej = [X(0)], [], []
        for a, b in zip(marks, marks[1:]):
            s = self.segments[min(int((ends <= X(a + b) / 2).sum()), len(self.segments) - 1)]
            # Neighbours of one section are one panel.
            n = max(1, math.ceil(float(stations * X(b - a) / total) - 1e-9))
            x += [X(a) + (X(b) - X(a)) * i / n for i in range(1, n + 1)]
            m += [s.rho_a] * n
            ej += [s.ej] * n
        x, m, ej = np.array(x, dtype=X), np.array(m, dtype=X), np.array(ej, dtype=X)
        h = np.diff(x)
        point = np.zeros(len(x), dtype=X)
        for d in self.discs:
            point[int(np.argmin(np.abs(x - X(d[0]))))] += X(d[1])
        zero = np.zeros(1, dtype=X)
        cumulative = lambda left, right: np.concatenate([zero, np.cumsum(h * (left + right) / 2)])
        (a, k1), (b, k2) = self.supports
        a, b = X(a), X(b)
        ia, ib = int(np.argmin(np.abs(x - a))), int(np.argmin(np.abs(x - b)))
        weight = np.concatenate([m * h / 2, zero]) + np.concatenate([zero, m * h / 2]) + point
        y, last = 1 + X("0.37") * x / total, None
        for rounds in range(10000):
            plain = cumulative(m * y[:-1], m * y[1:])
            jumps = np.cumsum(point * y)
            right, left = plain + jumps, plain + jumps - point * y
            a2 = cumulative(right[:-1], left[1:])
            f, mo = right[-1], right[-1] * total - a2[-1]
            r2 = -(mo - f * a) / (b - a)
            r1 = -f - r2
            moment = a2 + r1 * np.maximum(x - a, 0) + r2 * np.maximum(x - b, 0)
            slope = cumulative(moment[:-1] / ej, moment[1:] / ej)
            z = cumulative(slope[:-1], slope[1:])
            za = X(0) if k1 is None else -r1 / X(k1)
            zb = X(0) if k2 is None else -r2 / X(k2)
            c1 = ((zb - z[ib]) - (za - z[ia])) / (b - a)
            z = z + (za - z[ia]) + c1 * (x - a)
            square = (weight * y * z).sum() / (weight * z * z).sum()
            y = z / np.abs(z).max()
            if last is not None and abs(square - last) < 1e-13 * square:
                return np.sqrt(square) * RPM
            last = square
        return None


def judge_speeds(shaft, told, whirl, wrong, what="critical speed", bound=SPEED):
    """Each told speed lies where the determinant changes sign, and as many lie below as are told."""
    told = [X(t) for t in told]
    for j, n in enumerate(told):
        rpm = np.concatenate([n * (1 - STEPS), n * (1 + STEPS)])
        s = shaft.signs(rpm, whirl)
        good = np.nonzero(s[: len(STEPS)] * s[len(STEPS) :] < 0)[0]
        off = float(STEPS[good[0]]) if len(good) else 1.0
        # Weak modes keep less of a double.
        allowed = max(bound, 1e-14 * float(n / max(told[0], X(1e-9))) ** 2) if n > 0 else bound
        wrong.largest[what] = max(wrong.largest[what], off)
        if off > allowed:
            wrong.append(f"{what} {j + 1} told {float(n)!r}: no root within {allowed:.0e}" + (f", but within {off:.0e}" if off < 1 else ""))
        beyond = 1 + max(X(1e-6), 3 * X(bound))
        if j + 1 < len(told) and told[j + 1] < n * beyond**2:
            continue
        count = shaft.below(n * beyond, whirl)
        if count != j + 1:
            wrong.append(f"{what} {j + 1} told {float(n)!r}: {count} lie at or below it")


# ---- the machine files


class Machine:
    """Numbers in the units of the file."""

    def __init__(self, rng, press):
        near = lambda low, high, digits=1: round(rng.uniform(low, high), digits)
        self.beam = rng.choice(["timoshenko", "timoshenko", "euler"])
        self.press = press
        count = rng.randint(1, 6)
        self.segments = []
        for _ in range(count):
            d = near(20, 80) if press else rng.choice([near(10, 100), near(30, 60), near(5, 400)])
            s = dict(length=near(20, 150) if press else rng.choice([near(20, 400), near(1, 50, 2)]), diameter=d)
            if rng.random() < 0.3:
                s["bore"] = round(d * rng.uniform(0.1, 0.9), 2)
            if rng.random() < 0.1 and self.segments:
                s.update(modulus=near(60, 250), density=0.0, poisson=0.3)
            elif rng.random() < 0.3:
                s.update(modulus=near(60, 250), density=near(1500, 9000, 0), poisson=near(0.1, 0.45, 2))
            self.segments.append(s)
        length = sum(s["length"] for s in self.segments)
        self.length = length
        spots = sorted(rng.sample(range(0, 21), 4))
        last = math.floor(length * 100 + 1e-6) / 100
        here = lambda f: min(round(length * f / 20 + (rng.uniform(-0.02, 0.02) * length if 0 < f < 20 else 0), 2), last)
        number = rng.choice([2, 2, 2, 3, 4])
        self.supports = [[max(here(f), 0.0), rng.choice(["rigid", 10 ** rng.uniform(6, 9.5), 10 ** rng.uniform(7, 9)])] for f in
                         sorted(rng.sample(spots, number))]
        if rng.random() < 0.2:
            rng.shuffle(self.supports)
        self.discs = []
        for _ in range(rng.randint(0, 3)):
            if rng.random() < 0.5:
                across = 10 ** rng.uniform(-4, -1)
                d = dict(mass=near(0.1, 20, 2), diametral_inertia=across, polar_inertia=across * rng.choice([2.0, rng.uniform(0, 2), 0.0]))
            else:
                big = near(60, 300)
                d = dict(diameter=big, bore=round(big * rng.uniform(0.1, 0.6), 1), width=near(5, 60))
                if rng.random() < 0.3:
                    del d["bore"]
            d["at"] = max(here(rng.randint(0, 20)), 0.0)
            if rng.random() < 0.6:
                d.update(unbalance=near(0, 2000), angle=near(-180, 360))
            self.discs.append(d)
        self.cam_at = max(here(rng.randint(1, 19)), 0.0) if press or rng.random() < 0.7 else None
        self.drive_at = max(here(rng.randint(0, 20)), 0.0) if rng.random() < 0.6 else None
        self.limits = {}
        if press:
            self.cam(rng, near)

    def cam(self, rng, near):
        # The bore of the cam is the shaft's diameter where it sits; off a step.
        begin, at = 0.0, self.cam_at
        for s in self.segments:
            if abs(at - begin) < 1e-6:
                at = self.cam_at = round(begin + s["length"] * 0.4, 2)
            if begin < at < begin + s["length"] - 1e-9:
                self.bore = s["diameter"]
                break
            begin += s["length"]
        else:
            at = self.cam_at = round(s["length"] * 0.4 + begin - s["length"], 2)
            self.bore = s["diameter"]
        self.m = dict(mass=near(200, 1500), r=near(80, 200), turns=rng.choice([1.0, 3.0]), k=rng.choice([1.35, near(1.2, 1.4, 3)]),
                      q=rng.choice([2.0, near(1.5, 4, 2)]), column=rng.choice(["matched", "return"]), rpm=near(15, 40),
                      roller=near(15, 30), offset=rng.choice([0.0, 0.0, near(-10, 10)]), lobes=rng.choice([1, 1, 2]),
                      lever=rng.choice([1.0, 1.0, near(0.5, 1.2, 2)]), base=near(90, 160), thickness=near(15, 40), width=near(12, 28),
                      rotation=rng.choice(["cw", "ccw"]), preload=rng.choice([0.0, 0.0, near(500, 4000)]))
        if self.m["lobes"] == 2:
            self.m["base"] += 90
        self.m["inertia"] = near(5, 60) if self.m["preload"] and rng.random() < 0.5 else 0.0
        self.m["balance"] = rng.random() < 0.25
        self.m["cut"] = round(self.m["rpm"] * rng.uniform(0.7, 1.15), 2) if rng.random() < 0.3 else None

    def text(self, scale=1.0):
        s, lines = repr, ['name = "S"']
        if self.press:
            m = self.m
            lines += [
                f'[bed]\nmass = "{s(m["mass"])} kg"\ncrank_radius = "{s(m["r"])} mm"\ncrank_turns_per_main_shaft_turn = {s(m["turns"])}',
                f'[buffer]\npolytropic_exponent = {s(m["k"])}\nambient_pressure = "1 at"\nend_pressure = "{s(m["q"])} at"',
                f'column = "{m["column"]}"\n[design]\nrpm = {s(m["rpm"])}',
                f'[follower.roller]\nradius = "{s(m["roller"])} mm"\noffset = "{s(m["offset"])} mm"',
                *([f'preload = "{s(m["preload"])} N"'] if m["preload"] else []),
                *([f'mass = "{s(m["inertia"])} kg"'] if m["inertia"] else []),
                f'[cam]\ncam_turns_per_crank_turn = {s(1 / m["lobes"])}\nlever = {s(m["lever"])}\nbase_radius = "{s(m["base"])} mm"',
                f'thickness = "{s(m["thickness"])} mm"\nbore_radius = "{s(self.bore * scale / 2)} mm"\nmaterial = "steel"',
                f'rotation = "{m["rotation"]}"' + (f'\nbalance = "{s(self.bore * scale / 2 + 5)} mm .. {s(m["base"] - 8)} mm"' if m["balance"] else ""),
                f'[transition]\nkind = "run-up"\nwidth = "{s(m["width"])} deg"',
            ]
        lines.append(f'[shaft]\nbeam = "{self.beam}"')
        for key in ("cam_at", "drive_at"):
            if getattr(self, key) is not None:
                lines.append(f'{key} = "{s(getattr(self, key))} mm"')
        for seg in self.segments:
            lines.append(f'[[shaft.segment]]\nlength = "{s(seg["length"])} mm"\ndiameter = "{s(seg["diameter"] * scale)} mm"')
            if "bore" in seg:
                lines.append(f'bore = "{s(seg["bore"] * scale)} mm"')
            if "modulus" in seg:
                lines.append(f'modulus = "{s(seg["modulus"])} GPa"\ndensity = "{s(seg["density"])} kg/m3"\npoisson = {s(seg["poisson"])}')
        for at, k in self.supports:
            lines.append(f'[[shaft.support]]\nat = "{s(at)} mm"\nstiffness = "{k if k == "rigid" else s(k) + " N/m"}"')
        units = dict(mass="kg", diametral_inertia="kg*m2", polar_inertia="kg*m2", diameter="mm", bore="mm", width="mm", at="mm",
                     unbalance="g*mm", angle="deg")
        for d in self.discs:
            lines.append("[[shaft.disc]]\n" + "\n".join(f'{key} = "{s(v)} {units[key]}"' for key, v in d.items()))
        if self.limits:
            lines.append("[limits]\n" + "\n".join(f"{k} = {v}" for k, v in self.limits.items()))
        return "\n".join(lines) + "\n"

    def disc(self, d):
        """(place, mass, I_t, I_p), SI."""
        at = X(d["at"]) / 1000
        if "mass" in d:
            return at, X(d["mass"]), X(d["diametral_inertia"]), X(d["polar_inertia"])
        big, small, w = X(d["diameter"]) / 1000, X(d.get("bore", 0.0)) / 1000, X(d["width"]) / 1000
        mass = X(STEEL["density"]) * PI / 4 * (big**2 - small**2) * w
        return at, mass, mass * ((big**2 + small**2) / 16 + w * w / 12), mass * (big**2 + small**2) / 8

    def shaft(self, cam=None, stiffness=None, beam=None):
        segments = []
        for s in self.segments:
            own = dict(modulus=s["modulus"] * 1e9, density=s["density"], poisson=s["poisson"]) if "modulus" in s else STEEL
            segments.append(Segment(X(s["length"]) / 1000, X(s["diameter"]) / 1000, X(s.get("bore", 0.0)) / 1000, **own))
        supports = [(X(at) / 1000, None if k == "rigid" else (X(k) if stiffness is None else stiffness)) for at, k in self.supports]
        discs = [self.disc(d) for d in self.discs]
        places = [X(p) / 1000 for p in (self.cam_at, self.drive_at) if p is not None]
        if cam:
            discs.append((X(self.cam_at) / 1000, *cam))
        return Shaft(segments, supports, discs, places, beam or self.beam)


# ---- the cam


class Law:
    """Lift of the roller by the crank angle, its first two derivatives by the cam angle, and the bed; SI."""

    def __init__(self, m):
        self.m = m
        self.r, self.k, self.p0 = X(m["r"]) / 1000, X(m["k"]), AT
        # The cylinders are sized at the design speed; the cam is one for another.
        cut = X(m.get("cut") or m["rpm"])
        self.omega = cut * X(m["turns"]) / RPM
        self.q = X(m["q"])
        self.a = (self.q - 1) / self.r * (cut / X(m["rpm"])) ** 2
        h = (1 + self.a * self.r) ** (1 / self.k)
        self.column = self.k / self.a if m["column"] == "matched" else self.r * h / (h - 1)
        self.both = X(m["mass"]) * (X(m["rpm"]) * X(m["turns"]) / RPM) ** 2 * self.r / (self.q - 1)  # p0 times both pistons' areas
        self.lever, self.lobes = X(m["lever"]), m["lobes"]
        self.width = X(m["width"]) * PI / 180
        # Run-up: a quintic, at rest with no acceleration or jerk, to the law's value, slope and curvature.
        v, s, c = (f[0] for f in self.exact(np.array([X(0)])))
        w = self.width
        # In t from 0 to 1: b0 + b3 t³ + b4 t⁴ + b5 t⁵ leaves one too many; no jerk at the start either: b3 = 0.
        b5 = solve(np.array([[4, 5], [12, 20]], dtype=X), np.array([s * w, c * w * w], dtype=X))
        self.b4, self.b5 = b5
        self.dwell = v - self.b4 - self.b5
        inside = self.exact(np.linspace(X(0), PI / 2, 4001))[0]
        self.lowest = min(self.dwell, inside.min())
        if m["column"] == "return":
            self.lowest = min(self.dwell, X(0))
        self.height = np.sqrt((X(m["base"] + m["roller"]) / 1000) ** 2 - (X(m["offset"]) / 1000) ** 2)
        self.offset = X(m["offset"]) / 1000

    def exact(self, p):
        x, x1 = self.r * np.sin(p), self.r * np.cos(p)
        u, e = self.a * x, 1 / self.k
        f = -self.column * np.expm1(-np.log1p(u) * e) - x
        f1 = self.column * self.a * e * np.exp(-(e + 1) * np.log1p(u)) - 1
        f2 = -self.column * self.a**2 * e * (e + 1) * np.exp(-(e + 2) * np.log1p(u))
        return f, f1 * x1, f2 * x1**2 - f1 * x

    def at(self, cam):
        """x of the bed, Δx, s, s', s'' at cam angles in radians."""
        crank = np.mod(np.asarray(cam, dtype=X) * self.lobes, 2 * PI)
        middle = crank - PI / 2
        middle = np.where(middle > PI, middle - 2 * PI, middle)
        sense = np.where(middle > 0, -1, 1)
        p = PI / 2 - np.abs(middle)
        # The air closes where the law begins, that place included.
        inside = p >= -1e-12
        d, v, c = self.exact(np.where(inside, np.maximum(p, 0), 0))
        t = np.clip(p / self.width + 1, 0, 1)
        w = self.width
        run = (self.dwell + self.b4 * t**4 + self.b5 * t**5, (4 * self.b4 * t**3 + 5 * self.b5 * t**4) / w,
               (12 * self.b4 * t**2 + 20 * self.b5 * t**3) / w**2)
        d, v, c = np.where(inside, d, run[0]), np.where(inside, v, run[1]) * sense, np.where(inside, c, run[2])
        x = np.where(inside, self.r * np.sin(np.where(inside, p, 0)), 0)
        n = self.lobes
        self.closed = inside
        return np.maximum(x, 0), d, self.lever * (d - self.lowest), self.lever * n * v, self.lever * n * n * c

    def loaded(self, cam, compliance, twist):
        """Φ, tan α, bending, twist, what is left of the balance; the roller where it stands under its own force."""
        x, d, s, v, c = self.at(cam)
        tangent = (v - self.offset) / (self.height + s)
        give_bend = compliance * (1 + tangent**2)
        give = give_bend + v * v * twist
        rest = X(self.m["preload"]) + X(self.m["inertia"]) * (self.omega / self.lobes) ** 2 * c
        closed = self.closed
        column = np.where(closed, self.column - x - d, self.column)
        air = lambda low: np.where(closed, self.both / self.lever * np.expm1(self.k * np.log(self.column / (column + low / self.lever))), 0)
        # Newton on a convex, falling force; then it stays.
        low = np.zeros_like(x)
        for _ in range(60):
            value = low - give * (air(low) + rest)
            slope = 1 + give * np.where(closed, self.both / self.lever**2 * self.k * np.exp(
                self.k * np.log(self.column / (column + low / self.lever))) / (column + low / self.lever), 0)
            low = low - value / slope
        # A follower that would have to be pulled is not pressed on: no force, and it stands where the law has it.
        off = air(low) + rest < 0
        low = np.where(off, 0, low)
        force = np.where(off, 0, air(low) + rest)
        left = X(self.m["mass"]) * self.omega**2 * x - air(low) * self.lever
        return force, tangent, force * give_bend, force * v * v * twist, np.where(closed, left, 0)


def largest(f, low, high):
    least, most = X(low), X(high)
    low, high, best = least, most, None
    for zoom in range(7):
        at = low + (high - low) * np.arange(1441, dtype=X) / 1440
        values = f(at)
        i = int(values.argmax())
        if best is None or values[i] > best[0]:
            best = values[i], at[i]
        cell = (high - low) / 1440
        low, high = max(least, best[1] - 2 * cell), min(most, best[1] + 2 * cell)
    return best


class Whole:
    """Mass, unbalance (kg mm, cam angle) and inertias of the cam, its profile the parallel curve of its law's."""

    def __init__(self, m, bore, density, holes):
        law, n = Law(m), m["lobes"]
        rf, eps = X(m["roller"]) / 1000, law.offset
        nodes, weights = (np.array(v, dtype=X) for v in np.polynomial.legendre.leggauss(40))
        ends = {X(0), 2 * PI}
        for lobe in range(n):
            begin = 2 * PI * lobe / n
            for crank in (X(0), PI, PI + law.width, 2 * PI - law.width):
                ends.add(begin + crank / n)
        ends = sorted(ends)
        area, first, polar = X(0), 0j * X(0), X(0)
        for a, b in zip(ends, ends[1:]):
            for i in range(10):
                low, high = a + (b - a) * i / 10, a + (b - a) * (i + 1) / 10
                if high - low < 1e-15:
                    continue
                at = low + (high - low) * (nodes + 1) / 2
                _, _, s, v, c = law.at(at)
                u, turn = law.height + s, np.cos(at) + 1j * np.sin(at)
                p, p1 = (u + 1j * eps) * turn, (v - eps + 1j * u) * turn
                p2 = (c - u + 1j * (2 * v - eps)) * turn
                speed = np.abs(p1)
                bend = (p1.real * p2.imag - p1.imag * p2.real) / speed**3
                z, dz = p + 1j * rf * p1 / speed, p1 * (1 - rf * bend) * weights * (high - low) / 2
                cross = z.real * dz.imag - z.imag * dz.real
                area += cross.sum() / 2
                first = first + (z * cross).sum() / 3
                polar += (np.abs(z) ** 2 * cross).sum() / 4
        for z, r in [(0j, X(bore) / 2000), *holes]:
            hole = PI * r * r
            area, first, polar = area - hole, first - hole * z, polar - hole * (abs(z) ** 2 + r * r / 2)
        scale = X(density) * X(m["thickness"]) / 1000
        self.mass, self.unbalance = scale * area, scale * first * 1000
        self.along = scale * polar - abs(self.unbalance) ** 2 / self.mass * 1e-6
        self.across = self.along / 2 + self.mass * (X(m["thickness"]) / 1000) ** 2 / 12


class Cut:
    """The same of the cam as it is drawn, in the angles of the drawing; its holes about the bore, by cam angle, in metres."""

    def __init__(self, path, thickness, density, mirrored):
        document, vertices = polyline(path)
        chain = Chain(vertices)
        nodes, weights = np.polynomial.legendre.leggauss(24)
        area, first = 0.0, 0j
        for i in range(len(chain.start)):
            a, b = complex(*chain.start[i]), complex(*chain.end[i])
            if chain.is_arc[i]:
                m, half = complex(*chain.centre[i]), chain.sweep[i] / 2
                turn = np.exp(1j * half * (nodes + 1))
                z, dz = m + (a - m) * turn, (a - m) * turn * 1j * half
            else:
                z, dz = a + (b - a) * (nodes + 1) / 2, (b - a) / 2 * np.ones_like(nodes)
            cross = (z.real * dz.imag - z.imag * dz.real) * weights
            area += 0.5 * cross.sum()
            first += (z * cross).sum() / 3
        if area < 0:
            area, first = -area, -first
        self.holes = []
        for e in document.modelspace():
            if e.dxftype() == "CIRCLE" and e.dxf.layer == "BORE":
                r, z = e.dxf.radius, complex(e.dxf.center.x, e.dxf.center.y)
                area -= math.pi * r * r
                first -= math.pi * r * r * z
                if abs(z) > 1e-6:
                    z = z.conjugate() if mirrored else z
                    self.holes.append((complex(z) / 1000, X(r) / 1000))
        scale = float(density) * float(thickness)
        self.mass = scale * area * 1e-6
        self.unbalance = scale * first * 1e-6  # kg mm
        self.around = float(chain.length.sum())


def judge_vectors(shaft, machine, told, checks, cam, speed, wrong):
    vectors = [(X(d["at"]) / 1000, d["unbalance"] * np.exp(1j * math.radians(d["angle"]))) for d in machine.discs if "unbalance" in d]
    if cam is not None:
        vectors.append((X(machine.cam_at) / 1000, cam.turned))
    # A cam's digits of its DXF.
    size = sum(abs(u) for _, u in vectors)
    slack = 1e-9 * size + (cam.whole if cam is not None else 0)
    total = sum((u for _, u in vectors), 0j)
    apart = lambda length, deg: length * np.exp(1j * math.radians(deg))
    off = abs(apart(told["unbalance_g_mm"], told["unbalance_deg"]) - total)
    wrong.largest["unbalance of the greatest"] = max(wrong.largest["unbalance of the greatest"], float(off / max(size, 1.0)))
    if off > slack + 1e-9:
        wrong.append(f"unbalance told {told['unbalance_g_mm']} at {told['unbalance_deg']}, is {abs(total)} at {np.degrees(np.angle(total))}")
    a, b = shaft.supports[0][0], shaft.supports[-1][0]
    of = [sum((u * complex((b - x) / (b - a)) for x, u in vectors), 0j), sum((u * complex((x - a) / (b - a)) for x, u in vectors), 0j)]
    for plane, at, true in zip(told["planes"], (a, b), of):
        wrong.close(plane["at_mm"], 1000 * at, "plane")
        if abs(apart(plane["unbalance_g_mm"], plane["deg"]) - true) > slack * 10 + 1e-9:
            wrong.append(f"plane at {plane['at_mm']} told {plane['unbalance_g_mm']} at {plane['deg']}, is {abs(true)} at {np.degrees(np.angle(true))}")
    check = next((c for c in checks if c["check"] == "unbalance"), None)
    if check is None:
        return wrong.append("no check of the unbalance")
    wrong.close(check["value"], abs(total), "unbalance of the check", 1e-9, slack + 1e-9)
    grade = machine.limits.get("balance_grade")
    omega = None if speed is None else X(speed) / RPM
    if grade and omega:
        whole = 1000 * X(grade) * shaft.mass() / omega
        loose = 1e-10 if cam is None else 1e-5
        wrong.close(told["permissible_g_mm"], whole, "permissible", loose)
        wrong.close(check["limit"], whole, "permissible of the check", loose)
        share = (b - shaft.centre()) / (b - a)
        # The lever's shares, kept within 0.3 and 0.7 between the bearings, within 0.3 and 1.3 beyond them.
        high = X("0.7") if 0 <= share <= 1 else X("1.3")
        for plane, part in zip(told["planes"], (share, 1 - share)):
            wrong.close(plane["permissible_g_mm"], min(max(part, X("0.3")), high) * whole, "permissible of a plane", 10 * loose)
        if abs(abs(total) / float(whole) - 1) > 1e-5:
            verdict = "fail" if abs(total) > whole else "pass"
            if check["verdict"] != verdict:
                wrong.append(f"unbalance {check['verdict']}, {abs(total)} of {float(whole)}")
    if omega and check.get("note") and abs(total) > 1e-6:
        run = float(abs(total) * 1e-6 / shaft.mass() * omega * 1000)
        found = re.search(r"e ω = ([0-9.e+-]+) mm/s, (?:grade G ([0-9.]+)|(.*))", check["note"])
        loose = 1e-6 if cam is None else 1e-5 + cam.whole / float(abs(total))
        if not found or abs(float(found[1]) - run) > 6e-4 + loose * run:
            wrong.append(f"{check['note']!r}, e ω is {run}")
        elif found[2]:
            grades = [0.4, 1, 2.5, 6.3, 16, 40, 100, 250, 630, 1600, 4000]
            true = next((g for g in grades if run <= g), None)
            if true != float(found[2].rstrip(".")) and not any(abs(run / g - 1) < 10 * loose for g in grades):
                wrong.append(f"{check['note']!r}, e ω is {run}: G {true}")


def judge_tables(shaft, machine, report, csv_path, whirl, wrong, words):
    told = report["shaft"]
    t = table(csv_path)
    x = t["x_mm"] / 1000
    if abs(x[0]) > 0 or abs(x[-1] - shaft.length) > 1e-12 or (np.diff(x) < 0).any():
        wrong.append("the table does not run along the shaft")
    twice = {float(x[i]) for i in np.nonzero(np.diff(x) == 0)[0]}
    for i, end in enumerate(shaft.ends[:-1]):
        one, two = shaft.segments[i], shaft.segments[i + 1]
        changes = one.d != two.d or one.b != two.b
        if changes and not any(abs(v - float(end)) < 1e-9 for v in twice):
            wrong.append(f"the step at {float(end)} has not both its sides in the table")
    index = np.minimum((shaft.ends[None, :] < x[:, None] + 1e-12).sum(axis=1), len(shaft.segments) - 1)
    away = np.array([abs(v - shaft.ends).min() > 1e-9 for v in x])
    for key, name in (("d", "diameter_mm"), ("b", "bore_mm")):
        true = np.array([getattr(shaft.segments[i], key) * 1000 for i in index], dtype=X)
        wrong.near(t[name][away], true[away], X(1), name, 1e-10)
    for j, n in enumerate(told["critical_rpm"]):
        beside = min((abs(m / n - 1) for i, m in enumerate(told["critical_rpm"]) if i != j), default=1.0)
        if beside < 1e-5:
            continue
        # With the cam's mass a little off the shape is that at its own speed.
        true, tie = shaft.mode(shaft.root(n, whirl, 2e-5) if machine.press else n, whirl, x)
        mine = t[f"mode{j + 1}"]
        if tie and (mine * true).sum() < 0:
            true = -true
        weak = 1e-14 * (n / told["critical_rpm"][0]) ** 2
        what, least, shift = ("mode under a cam", 1e-3, 1e-5) if machine.press else ("mode", SHAPE, 1e-11)
        wrong.near(mine, true, X(1), what, max(least, weak * 10, shift / beside))
    if machine.cam_at is not None:
        y, slope, c, *_ = shaft.under(X(machine.cam_at) / 1000, x)
        wrong.near(t["deflection_um_per_kn"], y * 1e9, np.abs(y).max() * 1e9, "deflection", 1e-9)
        wrong.near(t["slope_urad_per_kn"], slope * 1e9, np.abs(slope).max() * 1e9, "slope", 1e-9)
        wrong.close(told["compliance_um_per_kn"], c * 1e9, "compliance", 1e-9)
        if machine.drive_at is not None and machine.press:
            true = shaft.twist(X(machine.drive_at) / 1000, X(machine.cam_at) / 1000) * 1e6
            wrong.close(told["twist_compliance_urad_per_nm"], true, "twist compliance", 1e-12, 1e-15)
        elif told["twist_compliance_urad_per_nm"] is not None and machine.drive_at is None:
            wrong.append("a twist without a drive")
    elif told["compliance_um_per_kn"] is not None:
        wrong.append("a compliance without a cam")


def judge_sweep(machine, cam, path, low, high, steps, whirl, modes, wrong, bound):
    t = table(path)
    k = t["stiffness_n_per_m"]
    if len(k) != steps + 1:
        wrong.append(f"{len(k)} rows of the sweep, not {steps + 1}")
    wrong.near(k, X(low) + (X(high) - X(low)) * np.arange(len(k)) / max(len(k) - 1, 1), X(high), "sweep", 1e-12)
    for i in sorted({0, len(k) // 3, len(k) - 1}):
        told = [t[f"n{j + 1}_rpm"][i] for j in range(modes)]
        what = "swept speed under a cam" if machine.press else "swept speed"
        judge_speeds(machine.shaft(cam, stiffness=k[i]), told, whirl, wrong, what, bound)
    return t


def check_of(report, name):
    return next((c for c in report["checks"] if c["check"] == name), None)


def sample(binary, directory, number, seed):
    rng = random.Random(f"{seed}-{number}")
    wrong, press = Wrong(), number % 3 == 2
    machine = Machine(rng, press)
    name = f"shaft-{number}"
    path = Path(directory) / f"{name}.toml"
    whirl = rng.choice(["forward", "planar", "backward"])
    modes = rng.choice([1, 3, 3, 5])
    paper = len(machine.supports) == 2 and rng.random() < 0.35
    rpm = (machine.m["cut"] or machine.m["rpm"]) if press else (round(rng.uniform(50, 20000), 1) if rng.random() < 0.7 else None)
    if rng.random() < 0.6:
        machine.limits["balance_grade"] = rng.choice([2.5, 6.3, 16, 40])
    machine.limits["critical_speed_ratio"] = rng.choice([0.7, 0.05, 0.5])
    path.write_text(machine.text())
    words = ["shaft", str(path), "--json", "--out", str(directory), "--name", name, "--overwrite", "--format", "csv", "--force",
             "--samples", rng.choice([40, 90]), "--whirl", whirl]
    other = ["--rpm", repr(rpm)] if press and machine.m["cut"] else []
    words += other
    if rpm and not press:
        words += ["--rpm", repr(rpm)]
    stations = rng.choice([18, 36, 7, 180])
    words += ["--solver", "paper", "--stations", stations] if paper else ["--modes", modes]
    sweep = None
    if not paper and rng.random() < 0.4 and any(k != "rigid" for _, k in machine.supports):
        sweep = (10 ** rng.uniform(6, 8), 10 ** rng.uniform(8, 10), rng.choice([3, 10]))
        words += ["--sweep", f"{sweep[0]!r} N/m .. {sweep[1]!r} N/m", "--steps", sweep[2]]
    got, report = camgen(binary, words)
    kind = ("press " if press else "alone ") + ("paper" if paper else whirl)
    if got.returncode == 2 or report is None:
        text = got.stderr.strip()
        if not paper and modes > 1 and re.search(r"digits|10.?000|does not exist|no such mode|critical speed", text):
            found = re.search(r"critical speed (\d+) is more than 10000 times", text)
            if found and not press and not sweep:
                _, one = camgen(binary, ["shaft", str(path), "--json", "--dry-run", "--whirl", whirl, "--modes", 1])
                first = one["shaft"]["critical_rpm"][0]
                if machine.shaft().below(10000 * X(first), whirl) >= int(found[1]):
                    wrong.append(f"refused, though speed {found[1]} is within 10000 times the first, {first}: {text}")
            return "refused: a wall", wrong, words, text
        if press and re.search(r"undercut|pressure angle|outline", text):
            return "refused: the cam", wrong, words, text
        if "apart" in text or "same place" in text or "one place" in text:
            return "refused: one place", wrong, words, text
        return "refused", [f"refused: {text}"], words, text
    told = report["shaft"]
    cam = inertia = None
    if press:
        cam_name = name + "-cam"
        camgen(binary, ["rotary", str(path), "--json", "--out", str(directory), "--name", cam_name, "--overwrite", "--format", "dxf",
                        "--force", *other])
        m = machine.m
        cut = Cut(Path(directory) / f"{cam_name}.dxf", X(m["thickness"]) / 1000, STEEL["density"], m["rotation"] == "ccw")
        cam = Whole(m, machine.bore, STEEL["density"], cut.holes)
        cam.turned = complex(cam.unbalance) * 1e3
        # An outline within 5 µm of it, on either side by turns: a micrometre all around is more than is left.
        ring = STEEL["density"] * m["thickness"] / 1000 * cut.around * 1e-9
        cam.loose, cam.whole = ring, ring * 1e3 * cut.around / 6
        wrong.close(cut.mass, cam.mass, "mass of the drawn cam", 0, ring)
        drawn = cut.unbalance.conjugate() if m["rotation"] == "ccw" else cut.unbalance
        if abs(drawn * 1e3 - cam.turned) > cam.whole:
            wrong.append(f"the drawn cam's unbalance {drawn * 1e3}, its law's {cam.turned}")
        inertia = (cam.mass, cam.across, cam.along)
    shaft = machine.shaft(inertia)
    wrong.close(told["mass_kg"], shaft.mass(), "mass", 1e-12, cam.loose if press else 0.0)
    speed = None
    if press:
        speed = X(rpm) * X(machine.m["turns"]) / machine.m["lobes"]
        wrong.close(told["speed_rpm"], speed, "speed", 1e-14)
    elif rpm:
        speed = X(rpm)
        wrong.close(told["speed_rpm"], speed, "speed", 1e-14)
    # The mass of the cam is one of an outline, known to the share of its tolerance.
    bound = 1e-5 if press else SPEED
    if paper:
        true = shaft.paper(stations)
        wrong.close(told["critical_rpm"][0], true, "paper under a cam" if press else "paper", bound if press else PAPER)
        if len(told["critical_rpm"]) != 1:
            wrong.append("more than one speed of the paper's method")
    else:
        if len(told["critical_rpm"]) != modes:
            why = [note for note in report["notes"] if re.search(r"more than 10000 times the first|does not exist", note)]
            beyond = re.search(r"critical speed (\d+) is more than 10000 times", " ".join(why))
            if not why:
                wrong.append(f"{len(told['critical_rpm'])} speeds, not {modes}, without a note")
            elif beyond and not press and shaft.below(10000 * X(told["critical_rpm"][0]), whirl) >= int(beyond[1]):
                wrong.append(f"speed {beyond[1]} is within 10000 times the first: {why}")
            modes = len(told["critical_rpm"])
        judge_speeds(shaft, told["critical_rpm"], whirl, wrong, "critical speed under a cam" if press else "critical speed", bound)
    csv_path = next(f for f in report["files"] if f.endswith(f"{name}.csv"))
    if paper:
        with_modes = dict(report, shaft=dict(told, critical_rpm=[]))
        judge_tables(shaft, machine, with_modes, csv_path, whirl, wrong, words)
    else:
        judge_tables(shaft, machine, report, csv_path, whirl, wrong, words)
    if sweep:
        judge_sweep(machine, inertia, next(f for f in report["files"] if f.endswith("-sweep.csv")), *sweep, whirl, modes, wrong, bound)
    judge_vectors(shaft, machine, told, report["checks"], cam, speed, wrong)
    check = check_of(report, "critical_speed")
    if speed is not None:
        # Whatever whirl was asked for, a speed is held against the first critical one of forward whirl.
        if whirl == "forward" and not paper:
            first = X(told["critical_rpm"][0])
        else:
            first = speed / X(check["value"])
            judge_speeds(shaft, [float(first)], "forward", wrong, "first of forward whirl", max(bound, 1e-10))
        ratio = speed / first
        wrong.close(check["value"], ratio, "share of the critical speed", 1e-12)
        limit = machine.limits["critical_speed_ratio"]
        if check["verdict"] != ("pass" if ratio <= limit else "fail"):
            wrong.append(f"critical_speed {check['verdict']} at {float(ratio)} of {limit}")
        if abs(told["first_harmonic"] - math.ceil(first / speed)) > (1 if abs(first / speed - round(float(first / speed))) < 1e-6 else 0):
            wrong.append(f"first harmonic {told['first_harmonic']}, {float(first / speed)}")
    if press:
        kind += judge_press(binary, machine, shaft, report, directory, name, words, other, wrong)
    fails = any(c["verdict"] == "fail" for c in report["checks"])
    if (got.returncode == 1) != fails:
        wrong.append(f"exit {got.returncode}, though {'a' if fails else 'no'} check failed")
    return kind, wrong, words, ""


def judge_press(binary, machine, shaft, report, directory, name, words, other_speed, wrong):
    told, law = report["shaft"], Law(machine.m)
    at = X(machine.cam_at) / 1000
    _, _, c, slopes, forces = shaft.under(at, np.array([at], dtype=X))
    twist = shaft.twist(X(machine.drive_at) / 1000, at) if machine.drive_at is not None else X(0)
    t = table(next(f for f in report["files"] if f.endswith("-lift.csv")))
    turn = t["cam_deg"] * PI / 180
    force, tangent, bend, turned, left = law.loaded(turn, c, twist)
    top = np.abs(force).max()
    # Where the air closes a place in degrees may stand on either side of the law's start.
    wrong.near(t["force_n"], force, top, "force", 1e-9)
    alpha = np.arctan(tangent) * 180 / PI
    wrong.near(t["pressure_angle_deg"], alpha, X(90), "pressure angle", 1e-9)
    scale = (bend + turned).max()
    wrong.near(t["bending_mm"], bend * 1000, scale * 1000, "bending", 1e-9)
    wrong.near(t["twist_mm"], turned * 1000, scale * 1000, "twist", 1e-9)
    wrong.near(t["lift_error_mm"], (bend + turned) * 1000, scale * 1000, "lift error", 1e-9)
    # What is left is a difference of forces.
    wrong.near(t["residual_n"], left, np.abs(left).max(), "residual row", 1e-7)
    whole = 2 * PI
    low = lambda cam: (lambda f: f[2] + f[3])(law.loaded(cam, c, twist))
    value, place = largest(low, 0, whole)
    wrong.close(told["lift_error_max_mm"], value * 1000, "largest lift error", 1e-10)
    here = X(told["lift_error_cam_deg"]) * PI / 180
    wrong.close(low(np.array([here], dtype=X))[0], value, "lift error where it is told", 1e-10)
    f = law.loaded(np.array([here], dtype=X), c, twist)
    wrong.close(told["bending_mm"], f[2][0] * 1000, "bending at the largest", 1e-9)
    if machine.drive_at is not None:
        wrong.close(told["twist_mm"], f[3][0] * 1000, "twist at the largest", 1e-9, 1e-12 * float(value))
    elif told["twist_mm"] is not None:
        wrong.append("a twist without a drive")
    left_most, place = largest(lambda a: np.abs(law.loaded(a, c, twist)[4]), 0, whole)
    wrong.close(told["residual_max_n"], left_most, "largest residual", 1e-8)
    here = X(told["residual_cam_deg"]) * PI / 180
    wrong.close(abs(law.loaded(np.array([here], dtype=X), c, twist)[4][0]), left_most, "residual where it is told", 1e-8)
    normal, _ = largest(lambda a: (lambda f: f[0] * np.sqrt(1 + f[1] ** 2))(law.loaded(a, c, twist)), 0, whole)
    # As the file has them.
    places = [float(p) for p, _ in shaft.supports]
    forces = [forces[places.index(float(X(p) / 1000))] for p, _ in machine.supports]
    for mine, there in zip(told["support_force_n"], forces):
        wrong.close(abs(mine), abs(there) * normal, "support force", 1e-9, 1e-9 * float(normal))
    slope = max(abs(s) for s in slopes) * normal
    wrong.close(told["support_slope_rad"], slope, "support slope", 1e-9)
    # Limits: one that fails tells a factor that passes.
    limits = {"lift_error": (value * 1000, "mm"), "support_slope": (slope, "rad")}
    state = ""
    for check, (there, unit) in limits.items():
        for share in (X("0.5"), X("1.01")):
            limit = float(there * share)
            if limit > 1.5 and unit == "rad":
                continue
            key = f"limits.{check}={limit!r}{unit}"
            got, other = camgen(binary, ["shaft", words[1], "--json", "--dry-run", "--modes", "1", *other_speed, "--set", key])
            if other is None:
                wrong.append(f"{key}: {got.stderr.strip()}")
                continue
            one = check_of(other, check)
            if one["verdict"] != ("fail" if share < 1 else "pass"):
                wrong.append(f"{check} {one['verdict']} with {key}")
            if share > 1:
                continue
            found = re.search(r"every diameter times ([0-9.]+) would pass", one["note"] if one.get("note") else "")
            if not found:
                state = " no factor" if "would pass" not in (one.get("note") or "") else ""
                wrong.largest[f"{check}: no factor told"] += 1
                # Supports alone, or the twist left, may already be too soft; then no thicker shaft passes.
                thick = Path(directory) / f"{name}-thick.toml"
                thick.write_text(machine.text(2.5))
                got, other = camgen(binary, ["shaft", str(thick), "--json", "--dry-run", "--modes", "1", *other_speed, "--set", key])
                if other is not None and check_of(other, check)["verdict"] == "pass":
                    wrong.append(f"{check}: no factor told with {key}, though 2.5 passes; {one.get('note')!r}")
                continue
            factor = float(found[1])
            for scale_, verdict in ((factor, "pass"), (1 + (factor - 1) * 0.99 if factor < 1.05 else factor * 0.99, "fail")):
                again = Path(directory) / f"{name}-again.toml"
                again.write_text(machine.text(scale_))
                got, other = camgen(binary, ["shaft", str(again), "--json", "--dry-run", "--modes", "1", *other_speed, "--set", key])
                if other is None:
                    wrong.largest["remedy refused: " + got.stderr.strip()[:60]] += 1
                    continue
                after = check_of(other, check)
                if after["verdict"] != verdict:
                    wrong.append(f"{check}: told factor {factor}; at {scale_} {after['verdict']}, {after['value']} of {after['limit']}")
    return state


# ---- golden numbers

HEAD = 'name = "G"\n[shaft]\n'


def plain(beam, segments, supports, discs=(), extra=""):
    text = HEAD + f'beam = "{beam}"\n{extra}'
    for length, diameter, density in segments:
        text += f'[[shaft.segment]]\nlength = "{length} mm"\ndiameter = "{diameter} mm"\ndensity = "{density} kg/m3"\n'
    for at, k in supports:
        text += f'[[shaft.support]]\nat = "{at} mm"\nstiffness = "{k}"\n'
    for at, mass, across, along in discs:
        text += f'[[shaft.disc]]\nat = "{at} mm"\nmass = "{mass} kg"\ndiametral_inertia = "{across} kg*m2"\npolar_inertia = "{along} kg*m2"\n'
    return text


U = [(1000, 50, 7850)]
THIN = [(600, 40, 0)]
A = [(40, 45, 7850), (220, 50, 7850), (40, 45, 7850)]
CYLINDER = [(255, 160, 7850), (857, 416, 7850), (255, 160, 7850)]
ENDS = lambda k: [(0, k), (1000, k)]
BOTH = lambda k: [(0, k), (1367, k)]
SOFT = [(20, "5e8 N/m"), (280, "5e8 N/m")]
CAM = [(150, 12, 0.05, 0.1)]
SPEEDS = [
    (1, "euler", U, ENDS("rigid"), [], "planar", [6093.347682792889, 24373.39073117156, 54840.12914513600]),
    (2, "timoshenko", U, ENDS("rigid"), [], "planar", [6074.972073783426, 24084.26301837447]),
    (2, "timoshenko", U, ENDS("rigid"), [], "forward", [6084.263364012018, 24228.02188763180]),
    (2, "timoshenko", U, ENDS("rigid"), [], "backward", [6065.722966187317, 23942.97390463904]),
    (3, "euler", U, ENDS("1e7 N/m"), [], "planar", [5413.510214810984, 15716.19544918423, 26276.55885737483]),
    (4, "euler", U, ENDS("1e3 N/m"), [], "planar", [108.7628142754203, 188.4036051931632, 13814.64851867083]),
    (5, "euler", U, [(0, "rigid"), (600, "rigid")], [], "planar", [7421.034148463497, 22739.65921978735, 63598.76406395408]),
    (6, "euler", U, [(0, "rigid"), (500, "rigid"), (1000, "rigid")], [], "planar", [24373.39073117156, 38075.88805403992]),
    (7, "euler", THIN, [(0, "5e7 N/m"), (600, "5e7 N/m")], [(300, 50, 0, 0)], "planar", [3178.483229711536]),
    (7, "timoshenko", THIN, [(0, "5e7 N/m"), (600, "5e7 N/m")], [(300, 50, 0, 0)], "planar", [3163.905671237357]),
    (8, "euler", THIN, [(0, "3e7 N/m"), (600, "8e7 N/m")], [(200, 50, 0, 0)], "planar", [3476.058018584551]),
    (9, "euler", THIN, [(0, "rigid"), (600, "rigid")], [(200, 30, 0, 0), (450, 20, 0, 0)], "planar", [4066.455187663764, 14301.23903641713]),
    (10, "euler", THIN, [(0, "rigid"), (400, "rigid")], [(550, 20, 0.15, 0.28)], "planar", [4474.324778571339, 22398.61792358752]),
    (10, "euler", THIN, [(0, "rigid"), (400, "rigid")], [(550, 20, 0.15, 0.28)], "forward", [6627.450147882450]),
    (10, "euler", THIN, [(0, "rigid"), (400, "rigid")], [(550, 20, 0.15, 0.28)], "backward", [3504.878889263391, 16888.34580161384]),
    (11, "euler", CYLINDER, BOTH("rigid"), [], "planar", [13585.0767376831, 38598.1374583666, 152868.700635786]),
    (11, "euler", CYLINDER, BOTH("1e9 N/m"), [], "planar", [9618.04017496464, 25152.4139485009, 111123.768975142]),
    (11, "euler", CYLINDER, BOTH("1e8 N/m"), [], "planar", [4087.45435463490, 9929.73944541790, 88071.0522710540]),
    (12, "timoshenko", CYLINDER, BOTH("rigid"), [], "forward", [12509.2782396983]),
    (12, "timoshenko", CYLINDER, BOTH("1e9 N/m"), [], "forward", [9213.26930905277]),
    (12, "timoshenko", CYLINDER, BOTH("1e8 N/m"), [], "forward", [4055.02450071158]),
    (12, "timoshenko", CYLINDER, BOTH("rigid"), [], "planar", [12481.2819608306]),
    (12, "timoshenko", CYLINDER, BOTH("1e9 N/m"), [], "planar", [9207.22563519439]),
    (12, "timoshenko", CYLINDER, BOTH("1e8 N/m"), [], "planar", [4054.92621481053]),
    (13, "euler", A, SOFT, CAM, "planar", [31037.8806635059]),
    (13, "timoshenko", A, SOFT, CAM, "forward", [30074.1493733311, 248100.536441864]),
    (13, "timoshenko", A, SOFT, CAM, "planar", [30009.1225150917, 63981.6615397055]),
    (13, "timoshenko", A, SOFT, CAM, "backward", [29944.3466279115]),
    (15, "euler", [(1600, 50, 7850)], [(600, "1e5 N/m"), (1000, "1e5 N/m")], [], "planar",
     [371.449434091129, 850.028486664154, 5457.94376130062]),
]
PAPERS = [
    (15, "euler", [(1600, 50, 7850)], [(600, "1e5 N/m"), (1000, "1e5 N/m")], [], 18, 371.981729116),
    (15, "euler", [(1600, 50, 7850)], [(600, "1e5 N/m"), (1000, "1e5 N/m")], [], 180, 371.455285322),
    (16, "euler", U, ENDS("rigid"), [], 18, 6124.417378818762), (16, "euler", U, ENDS("rigid"), [], 180, 6093.657052784936),
    (16, "euler", U, ENDS("1e7 N/m"), [], 18, 5433.901564815), (16, "euler", U, [(0, "rigid"), (600, "rigid")], [], 18, 7451.661545744),
    (16, "euler", CYLINDER, BOTH("1e9 N/m"), [], 36, 9629.206696326), (16, "timoshenko", A, SOFT, CAM, 18, 31095.44014869),
]


def golden(binary, directory):
    wrong = Wrong()
    path = Path(directory) / "golden.toml"

    def ask(text, *words, code=0):
        path.write_text(text)
        got, report = camgen(binary, ["shaft", str(path), "--json", "--out", str(directory), "--name", "golden", "--overwrite", "--format",
                                      "csv", *words], wrong, code)
        return report

    for number, beam, segments, supports, discs, whirl, speeds in SPEEDS:
        report = ask(plain(beam, segments, supports, discs), "--whirl", whirl, "--modes", len(speeds))
        for j, (told, true) in enumerate(zip(report["shaft"]["critical_rpm"], speeds)):
            wrong.close(told, true, "golden speed", 1e-11)
    report = ask(plain("euler", THIN, [(0, "rigid"), (400, "rigid")], [(550, 20, 0.15, 0.28)]), "--whirl", "forward", "--modes", 2)
    if len(report["shaft"]["critical_rpm"]) != 1 or not any("1 critical speed: number 2 does not exist" in note for note in report["notes"]):
        wrong.append(f"one forward speed of two: {report['shaft']['critical_rpm']} {report['notes']}")
    for number, beam, segments, supports, discs, stations, true in PAPERS:
        report = ask(plain(beam, segments, supports, discs), "--solver", "paper", "--stations", stations)
        wrong.close(report["shaft"]["critical_rpm"][0], true, "golden paper", 1e-9)
    # 3 and 5: shapes at a row that the table has.
    ask(plain("euler", U, ENDS("1e7 N/m")), "--whirl", "planar", "--samples", 101)
    t = table(Path(directory) / "golden.csv")
    wrong.close(t["mode1"][0], X("0.1734315202550"), "golden shape", 1e-11)
    ask(plain("euler", U, [(0, "rigid"), (600, "rigid")]), "--whirl", "planar", "--samples", 101)
    t = table(Path(directory) / "golden.csv")
    i = int(np.argmin(np.abs(t["x_mm"] - 300)))
    if abs(t["x_mm"][i] - 300) < 1e-9:
        wrong.close(t["mode1"][i] / t["mode1"][-1], X("-0.205799224095"), "golden shape", 1e-9)
    # 8, 13: compliances.
    soft = [(0, "3e7 N/m"), (600, "8e7 N/m")]
    disc = [(200, 50, 0, 0)]
    report = ask(plain("euler", THIN, soft, disc, 'cam_at = "200 mm"\n'), "--modes", 1)
    wrong.close(report["shaft"]["compliance_um_per_kn"], 1.509380470619220e-7 * 1e9, "golden compliance", 1e-11)
    t = table(Path(directory) / "golden.csv")
    wrong.close(t["slope_urad_per_kn"][0], 8.119970533962716e-7 * 1e9, "golden slope", 1e-11)
    wrong.close(t["slope_urad_per_kn"][-1], -7.037643093836840e-7 * 1e9, "golden slope", 1e-11)
    report = ask(plain("timoshenko", THIN, soft, disc, 'cam_at = "200 mm"\n'), "--modes", 1)
    wrong.close(report["shaft"]["compliance_um_per_kn"], 1.524201248388624e-7 * 1e9, "golden compliance", 1e-11)
    for beam, true in (("euler", 6.694265515355378), ("timoshenko", 7.173360879693742)):
        report = ask(plain(beam, A, SOFT, CAM, 'cam_at = "150 mm"\ndrive_at = "0 mm"\n'), "--modes", 1)
        wrong.close(report["shaft"]["compliance_um_per_kn"], true, "golden compliance", 1e-11)
    # 14: the press; 143.7 N of fixed point; its own cam's base radius is found as 99 mm less the roller.
    _, report = camgen(binary, ["shaft", "dpi-shaft", "--json", "--dry-run"], wrong)
    wrong.close(report["shaft"]["lift_error_max_mm"], 0.45142529623318, "golden lift error", 1e-11)
    wrong.close(report["shaft"]["twist_compliance_urad_per_nm"], 3.4497267423842, "golden twist", 1e-11)
    wrong.close(report["shaft"]["residual_max_n"], 143.6889340886, "golden residual", 1e-10)
    for key, deg in (("lift_error_cam_deg", 47.5089), ("residual_cam_deg", 52.9460)):
        at = report["shaft"][key]
        wrong.close(min(at, 180 - at), deg, "golden place", 0, 6e-5)
    # 17: two unbalances; planes are the supports.
    text = plain("euler", [(500, 40, 7850)], [(0, "rigid"), (500, "rigid")])
    for at, amount, angle in ((100, 300, 0), (400, 200, 120)):
        text += f'[[shaft.disc]]\nat = "{at} mm"\nmass = "1 kg"\nunbalance = "{amount} g*mm"\nangle = "{angle} deg"\n'
    part = ask(text)["shaft"]
    for told, true, deg in ((part["planes"][0], 222.710574513, 8.94827556), (part["planes"][1], 140, 98.2132107),
                            (dict(unbalance_g_mm=part["unbalance_g_mm"], deg=part["unbalance_deg"]), 264.575131106, 40.8933946)):
        wrong.close(told["unbalance_g_mm"], true, "golden unbalance", 1e-11)
        wrong.close(told["deg"], deg, "golden angle", 2e-9)
    # Massless pieces beside heavy ones under forward whirl: no speed of 0, none left out, and no "no mass".
    for segments, supports in [([(265, 59, 7850), (66, 37, 0)], [(10, 1e9), (205, 5e7)]),
                               ([(252, 166, 7850), (195, 85, 7850), (282, 118, 0)], [(401, None), (630, 5e7)])]:
        text = plain("timoshenko", segments, [(at, "rigid" if k is None else f"{k!r} N/m") for at, k in supports])
        shaft = Shaft([Segment(X(length) / 1000, X(d) / 1000, X(0), 210e9, rho, 0.3) for length, d, rho in segments],
                      [(X(at) / 1000, k) for at, k in supports], [])
        for order in ("auto", *range(8, 15)):
            report = ask(text, "--modes", 3, "--order", order)
            if report:
                judge_speeds(shaft, report["shaft"]["critical_rpm"], "forward", wrong, f"massless piece, order {order}, speed", 1e-6)
    # A support where the lengths of the segments end, as a reader adds them.
    tenths = [(0.1, 50, 7850), (0.2, 50, 7850), (0.3, 50, 7850), (100.1, 50, 7850), (60.7, 50, 7850)]
    ends = str(round(sum(length for length, *_ in tenths), 6))
    ask(plain("euler", tenths, [(0, "rigid"), (ends, "rigid")]), "--modes", 1)
    for lengths in ([33.3, 33.3, 33.4], [74.1, 105.6, 96.3], [249.84, 109.14]):
        total = f"{sum(round(100 * length) for length in lengths) / 100:.2f}"
        ask(plain("euler", [(length, 50, 7850) for length in lengths], [(0, "rigid"), (total, "rigid")]), "--modes", 1)
    return wrong


def task(given):
    binary, directory, number, seed = given
    try:
        return number, *sample(binary, directory, number, seed)
    except Exception:
        return number, "broken", ["the check itself: " + traceback.format_exc()], [], ""


def main():
    given = cases.given("shaft", 42, only={"type": int})
    start = time.monotonic()
    binary, directory = given.binary, given.directory
    failed, states, worst = 0, defaultdict(int), defaultdict(float)
    numbers = range(given.count) if given.only is None else [given.only]
    if given.only is None:
        wrong = golden(binary, directory)
        for line in wrong:
            failed += 1
            print(f"  golden: {line}")
        worst.update(wrong.largest)
    with ProcessPoolExecutor(given.jobs) as pool:
        for number, state, wrong, words, text in pool.map(task, [(binary, str(directory), n, given.seed) for n in numbers]):
            states[state] += 1
            failed += bool(wrong)
            for what, share in getattr(wrong, "largest", {}).items():
                worst[what] = worst[what] + share if "remedy" in what or "no factor" in what else max(worst[what], share)
            if wrong:
                print(f"  {number} ({state}): " + "\n    ".join(wrong[:12]) + f"\n    {' '.join(map(str, words))}")
            elif text:
                print(f"  {number} {state}: {text[:300]}")
    cases.show_largest(worst)
    cases.finish(states, failed, f"; {time.monotonic() - start:.0f} s")


if __name__ == "__main__":
    main()
