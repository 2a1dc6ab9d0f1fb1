"""Splines made here from their own optimality: the states at the knots of least ∫(s‴)² or ∫(s″)², dense linear systems; not-a-knot tables.

A quintic between two knots is the polynomial of position, velocity and acceleration at both; where a velocity is free the fourth derivative
may not jump, where an acceleration is free the third: the derivatives of ∫(s‴)² by them. A cubic likewise, one order lower.
"""
import math

import numpy as np


def between(count):
    """Coefficients on [0, 1] of the polynomials that take one derivative at one end, rows p0 v0 a0 p1 v1 a1."""
    half = count // 2
    rows = []
    for t in (0.0, 1.0):
        for order in range(half):
            rows.append([math.perm(k, order) * t ** (k - order) if k >= order else 0.0 for k in range(count)])
    return np.linalg.inv(np.array(rows)).T


CUBIC, QUINTIC = between(4), between(6)


def derivative(table, order, at):
    """Of the polynomials of `between` at 0 or 1."""
    count = table.shape[1]
    return np.array([sum(math.perm(k, order) * row[k] * at ** (k - order) for k in range(order, count)) for row in table])


class Interval:
    """Between two knots: width, both positions, and its states, numbers or indices (int) of unknowns: v0 a0 v1 a1, of a cubic v0 v1."""

    def __init__(self, low, high, first, last, states):
        self.low, self.high, self.first, self.last, self.states = low, high, first, last, list(states)

    def coefficients(self, found):
        """Of powers of (x − low)."""
        width, half = self.high - self.low, len(self.states) // 2
        values = [found[s] if isinstance(s, int) else s for s in self.states]
        powers = [width ** (1 + k % half) for k in range(2 * half)]
        scaled = [v * w for v, w in zip(values, powers)]
        z = np.array([0.0, *scaled[:half], self.last - self.first, *scaled[half:]])
        c = z @ (QUINTIC if half == 2 else CUBIC) / width ** np.arange(2 * half + 2)
        c[0] += self.first
        return c


def solved(intervals, unknowns, knots=()):
    """The unknown states; `knots`: (unknown, interval, interval behind it) whose equation is that the highest derivative does not jump."""
    if unknowns == 0:
        return np.zeros(0)
    half = len(intervals[0].states) // 2
    table = QUINTIC if half == 2 else CUBIC
    natural = np.mean([i.high - i.low for i in intervals])
    matrix, right = np.zeros((unknowns, unknowns)), np.zeros(unknowns)
    scale = np.ones(unknowns)
    replaced = {row for row, _, _ in knots}

    def add(row, interval, order, at, sign):
        width = (interval.high - interval.low) / natural
        weights = derivative(table, order, at) / width**order
        slots = [w for k, w in enumerate(weights) if k % (half + 1)]
        for k, (state, weight) in enumerate(zip(interval.states, slots)):
            weight = sign * weight * width ** (1 + k % half)
            if isinstance(state, int):
                scale[state] = natural ** (1 + k % half)
                matrix[row, state] += weight
            else:
                right[row] -= weight * state * natural ** (1 + k % half)
        right[row] -= sign * weights[half + 1] * (interval.last - interval.first)

    for interval in intervals:
        for k, state in enumerate(interval.states):
            if isinstance(state, int) and state not in replaced:
                # Velocity: the derivative of order 4 (cubic: 2); acceleration: 3.
                order = 2 * half - k % half
                add(state, interval, order, float(k >= half), -1.0 if k >= half else 1.0)
    for row, before, behind in knots:
        add(row, before, 2 * half + 1, 1.0, -1.0)
        add(row, behind, 2 * half + 1, 0.0, 1.0)
    size = np.abs(matrix).max(axis=1)
    matrix, right = matrix / size[:, None], right / size
    found = np.linalg.solve(matrix, right)
    found += np.linalg.solve(matrix, right - matrix @ found)
    return found / scale


def periodic(angles, values, turn, degree):
    """Intervals and their coefficients of the closed spline through points."""
    count, half = len(angles), (degree - 1) // 2
    ends = np.concatenate([angles, [angles[0] + turn]])
    intervals = []
    for i in range(count):
        j = (i + 1) % count
        states = [half * i + k for k in range(half)] + [half * j + k for k in range(half)]
        intervals.append(Interval(ends[i], ends[i + 1], values[i], values[j], states))
    found = solved(intervals, half * count)
    return [(i.low, i.high, i.coefficients(found)) for i in intervals]


def through_table(x, y, rest):
    """The quintic through rows from 0, 0 to 1, 1: at rest at its ends, or not-a-knot; below six rows the polynomial through them."""
    count = len(x)
    if not rest and count < 6:
        t = 2 * np.array(x) - 1
        c = np.linalg.solve(np.vander(t, increasing=True), np.array(y))
        shifted = np.polynomial.Polynomial(c)(np.polynomial.Polynomial([-1, 2])).coef
        return [(0.0, 1.0, shifted)]
    index = iter(range(2 * count))
    states = [[0.0, 0.0] if rest and i in (0, count - 1) else [next(index), next(index)] for i in range(count)]
    intervals = [Interval(x[i], x[i + 1], y[i], y[i + 1], states[i] + states[i + 1]) for i in range(count - 1)]
    if rest:
        found, knots = solved(intervals, 2 * (count - 2)), ()
    else:
        last = 2 * count - 1
        knots = [(0, intervals[0], intervals[1]), (1, intervals[1], intervals[2]), (last - 1, intervals[-3], intervals[-2]), (last, intervals[-2], intervals[-1])]
        found = solved(intervals, 2 * count, knots)
    return [(i.low, i.high, i.coefficients(found)) for i in intervals]


class Joined:
    """Polynomials from knot to knot as one piece over [0, 1]."""

    def __init__(self, parts, low=0.0, high=1.0):
        self.low, self.high = low, high
        self.knots = np.array([part[0] for part in parts])
        self.cells = 8 * len(parts)
        size = max(len(part[2]) for part in parts)
        table = np.zeros((len(parts), size))
        for row, part in zip(table, parts):
            row[: len(part[2])] = part[2]
        self.tables = [table]
        for _ in range(6):
            table = np.concatenate([table[:, 1:] * np.arange(1, size), np.zeros((len(parts), 1))], axis=1)
            self.tables.append(table)

    def at(self, x, order):
        where = np.clip(np.searchsorted(self.knots, x, side="right") - 1, 0, len(self.knots) - 1)
        t, table = x - self.knots[where], self.tables[order]
        value = np.zeros_like(t)
        for k in range(table.shape[1] - 1, -1, -1):
            value = value * t + table[where, k]
        return value


# ---------------------------------------------------------------- formulas


NAMES = {name: getattr(np, name) for name in ("sin", "cos", "tan", "sqrt", "exp", "log")}
NAMES |= {"asin": np.arcsin, "acos": np.arccos, "atan": np.arctan, "pi": math.pi, "e": math.e}


class Formula:
    """A formula as Python reads it, times `factor`; derivatives by Cauchy's integral on a circle without a singular place."""

    def __init__(self, text, variable, begin, width, circle, factor=1.0):
        self.code = compile(text.replace("^", "**"), "formula", "eval")
        self.variable, self.begin, self.width, self.circle, self.factor = variable, begin, width, circle, factor
        self.low, self.high, self.cells = 0.0, 1.0, 512
        self.around = np.exp(2j * math.pi * np.arange(32) / 32)

    def value(self, z):
        return eval(self.code, {"__builtins__": {}, **NAMES, self.variable: z}) * self.factor + 0 * z

    def at(self, x, order):
        z = self.begin + self.width * np.asarray(x, float)
        if order == 0:
            return np.real(self.value(z.astype(complex)))
        ring = self.value(z[:, None] + self.circle * self.around)
        mean = (ring * self.around ** -float(order)).mean(axis=1).real
        return mean * math.factorial(order) * (self.width / self.circle) ** order

    def noise(self):
        """What the rounding of values on the circle makes of each derivative by the variable: 5e-7 of a jerk of 64 under an elastic load,
        of which 40 digits say that it was told right."""
        size = np.abs(self.at(np.linspace(0.0, 1.0, 64), 0)).max()
        return np.array([1e-15 * size * math.factorial(order) / self.circle**order for order in range(7)])


class Driven:
    """The cam of an elastic load: s + first·s' + second·s'' of a piece."""

    def __init__(self, piece, first, second):
        self.piece, self.first, self.second = piece, first, second
        self.low, self.high = piece.low, piece.high
        self.cells = getattr(piece, "cells", 128)

    def at(self, x, order):
        return self.piece.at(x, order) + self.first * self.piece.at(x, order + 1) + self.second * self.piece.at(x, order + 2)
