"""Walks a closed chain of arcs by its length and deforms it along its normal by known amounts: right and wrong outlines.

All lengths in mm; vertices are rows of x, y, bulge.
"""
import math

import numpy as np


class Exact:
    """A closed chain of arcs by arc length: point, unit tangent, signed curvature."""

    def __init__(self, vertices):
        point = vertices[:, :2]
        chord = np.roll(point, -1, axis=0) - point
        bulge = vertices[:, 2]
        self.sweep = 4 * np.arctan(bulge)
        length = np.hypot(*chord.T)
        half = np.where(bulge == 0, 1.0, self.sweep / 2)
        self.length = np.where(bulge == 0, length, length * half / np.sin(half))
        self.heading = np.arctan2(chord[:, 1], chord[:, 0]) - self.sweep / 2
        self.point, self.curvature = point, self.sweep / self.length
        self.at = np.concatenate([[0.0], np.cumsum(self.length)])
        self.total = self.at[-1]

    def walk(self, s):
        s = np.mod(np.asarray(s, dtype=float), self.total)
        i = np.clip(np.searchsorted(self.at, s, side="right") - 1, 0, len(self.length) - 1)
        along = s - self.at[i]
        half = 0.5 * self.curvature[i] * along
        heading = self.heading[i] + 2 * half
        # The chord of the part walked: its length along · sin(half)/half, in the direction of its middle.
        chord = along * np.sinc(half / np.pi)
        middle = self.heading[i] + half
        point = self.point[i] + chord[:, None] * np.stack([np.cos(middle), np.sin(middle)], axis=1)
        return point, heading, self.curvature[i]

    def corners(self):
        turn = self.heading - np.roll(self.heading + self.sweep, 1)
        return np.abs((turn + np.pi) % (2 * np.pi) - np.pi) > 1e-4


def biarcs(points, headings, closed=True):
    """Vertices (x, y, bulge) of tangent arc pairs through points with headings."""
    a, b = points, np.roll(points, -1, axis=0)
    h0, h1 = headings, np.roll(headings, -1)
    if not closed:
        a, b, h0, h1 = a[:-1], b[:-1], h0[:-1], h1[:-1]
    chord = b - a
    direction = np.arctan2(chord[:, 1], chord[:, 0])
    wrap = lambda x: (x + np.pi) % (2 * np.pi) - np.pi
    alpha, beta = wrap(direction - h0), wrap(h1 - direction)
    # Whatever heading the joint has, the two arcs are tangent; this one makes their chords equally long.
    joint_heading = direction + 0.5 * (alpha - beta)
    sweep0, sweep1 = wrap(joint_heading - h0), wrap(h1 - joint_heading)
    length = np.hypot(*chord.T)
    c0, c1 = h0 + 0.5 * sweep0, joint_heading + 0.5 * sweep1
    # The joint is where the chord through a in direction c0 meets that through b in direction c1.
    cross = np.cos(c0) * np.sin(c1) - np.sin(c0) * np.cos(c1)
    straight = np.abs(cross) < 1e-12
    t = np.where(straight, 0.5 * length, (chord[:, 0] * np.sin(c1) - chord[:, 1] * np.cos(c1)) / np.where(straight, 1, cross))
    joint = a + t[:, None] * np.stack([np.cos(c0), np.sin(c0)], axis=1)
    joint = np.where(straight[:, None], 0.5 * (a + b), joint)
    out = np.empty((2 * len(a), 3))
    out[0::2, :2], out[1::2, :2] = a, joint
    out[0::2, 2], out[1::2, 2] = np.tan(sweep0 / 4), np.tan(sweep1 / 4)
    return out


def nodes(exact, count, rng, around=()):
    """Arc lengths: even with a random phase, denser where a fault is; never across the corners of a plate."""
    s = (np.arange(count) + rng.random()) * exact.total / count
    extra = [np.linspace(middle - 1.02 * half, middle + 1.02 * half, 41) for middle, half in around]
    s = np.mod(np.concatenate([s, *extra]), exact.total)
    # Breaks of the exact chain's curvature need no node: its arcs are a thousandth of the tolerance long in deviation.
    s = np.unique(s)
    keep = np.concatenate([[True], np.diff(s) > 1e-6 * exact.total / max(count, 100)])
    return s[keep]


def smooth_bump(u):
    inside = np.abs(u) < 1
    value = np.where(inside, (1 - u * u) ** 3, 0.0)
    slope = np.where(inside, -6 * u * (1 - u * u) ** 2, 0.0)
    return value, slope


def deformed(exact, s, offset, slope):
    """Points and headings of the curve that lies `offset` to the left of the exact one (inwards of a ccw loop)."""
    point, heading, curvature = exact.walk(s)
    normal = np.stack([-np.sin(heading), np.cos(heading)], axis=1)
    return point + normal * offset[:, None], heading + np.arctan2(slope, 1 - curvature * offset)


def smooth_place(case, rng, half):
    """A place whose surroundings hold no corner."""
    exact = case.exact
    corners = exact.at[:-1][exact.corners()]
    while True:
        s = rng.random() * exact.total
        if all(min(abs(s - c), exact.total - abs(s - c)) > 1.1 * half + 1 for c in corners):
            return s


def bumped(case, rng, amplitude, half, count):
    exact = case.exact
    middle = smooth_place(case, rng, half)
    if case.kind != "rotary":
        return bumped_chain(case, rng, amplitude, half, middle)
    s = nodes(exact, count, rng, [(middle, half)])
    away = (s - middle + 0.5 * exact.total) % exact.total - 0.5 * exact.total
    value, slope = smooth_bump(away / half)
    points, headings = deformed(exact, s, amplitude * value, amplitude * slope / half)
    return biarcs(points, headings)


def stretch(case, start, end):
    """The exact chain from `start` round to `end` (arc lengths), as vertices; the last one is the end point, bulge 0."""
    exact = case.exact
    length = (end - start) % exact.total
    inner = np.mod(exact.at[:-1] - start, exact.total)
    order = np.sort(inner[(inner > 1e-9) & (inner < length - 1e-9)])
    s = np.concatenate([[0.0], order, [length]])
    point, _, _ = exact.walk(start + s)
    _, _, curvature = exact.walk(start + 0.5 * (s[1:] + s[:-1]))
    bulge = np.tan(0.25 * curvature * np.diff(s))
    return np.column_stack([point, np.concatenate([bulge, [0.0]])])


def bumped_chain(case, rng, amplitude, half, middle):
    """The exact arcs with a bump of biarcs in place of one stretch."""
    s = np.linspace(middle - half, middle + half, 41)
    value, slope = smooth_bump((s - middle) / half)
    points, headings = deformed(case.exact, s, amplitude * value, amplitude * slope / half)
    bump = biarcs(points, headings, closed=False)
    return np.concatenate([bump, stretch(case, middle + half, middle - half)[:-1]])


def slot(case, rng, width, depth, lip, inwards=True):
    """A slot (or a fin) square to the outline with lips of radius `lip` that are tangent to it."""
    middle = smooth_place(case, rng, width + 2 * lip)
    sign = 1.0 if inwards else -1.0
    half = 0.5 * width + lip
    a, b = middle - half, middle + half
    (p,), (heading,), _ = case.exact.walk([a])
    (q,), (heading_q,), _ = case.exact.walk([b])
    (_,), (mid,), _ = case.exact.walk([middle])
    n = np.array([-math.sin(mid), math.cos(mid)]) * sign
    turn = lambda angle: math.tan(0.25 * angle)
    # First lip: from the outline's heading to the direction n; arc of radius lip.
    into = math.atan2(n[1], n[0])
    wrap = lambda x: (x + math.pi) % (2 * math.pi) - math.pi
    def arc(start, h, sweep, radius):
        centre = start + radius * math.copysign(1, sweep) * np.array([-math.sin(h), math.cos(h)])
        away = start - centre
        c, s = math.cos(sweep), math.sin(sweep)
        return centre + np.array([c * away[0] - s * away[1], s * away[0] + c * away[1]])
    sweep_in = wrap(into - heading)
    p1 = arc(p, heading, sweep_in, lip)
    sweep_out = wrap(heading_q - (into + math.pi))
    # The last lip backwards.
    q1 = arc(q, heading_q + math.pi, -sweep_out, lip)
    p2, q2 = p1 + n * depth, q1 + n * depth
    vertices = [(*p, turn(sweep_in)), (*p1, 0.0), (*p2, -sign), (*q2, 0.0), (*q1, turn(sweep_out))]
    return np.concatenate([np.array(vertices), stretch(case, b, a)[:-1]])


def loop(case, rng, radius, inwards):
    """A full small circle in the outline, tangent to it: not a simple loop, though near it everywhere."""
    middle = smooth_place(case, rng, 1.0)
    (p,), (h,), _ = case.exact.walk([middle])
    side = 1.0 if inwards else -1.0
    opposite = p + 2 * radius * side * np.array([-math.sin(h), math.cos(h)])
    return np.concatenate([np.array([(*p, side), (*opposite, side)]), stretch(case, middle, middle - 1e-7)[:-1]])


def backtrack(case, rng, by):
    """Forth, back and forth again over the same stretch."""
    middle = smooth_place(case, rng, by + 1)
    a, b = middle, middle + by
    forth = stretch(case, a, b)
    back = forth[::-1].copy()
    back[:-1, 2], back[-1, 2] = -forth[-2::-1, 2], 0.0
    return np.concatenate([forth[:-1], back[:-1], stretch(case, a, a - 1e-7)[:-1]])


def step(case, rng, amplitude, length, ramp):
    """Offset over a stretch; smooth ramps at its ends."""
    middle = smooth_place(case, rng, 0.5 * length + ramp)
    n = 21
    u = np.linspace(0, 1, n)
    rise, slope = u**3 * (10 - 15 * u + 6 * u * u), 30 * u**2 * (1 - u) ** 2
    start = middle - 0.5 * length - ramp
    s = np.concatenate([start + ramp * u, np.linspace(middle - 0.5 * length, middle + 0.5 * length, 60)[1:-1],
                        middle + 0.5 * length + ramp * u])
    value = amplitude * np.concatenate([rise, np.ones(58), rise[::-1]])
    slopes = amplitude / ramp * np.concatenate([slope, np.zeros(58), -slope[::-1]])
    points, headings = deformed(case.exact, s, value, slopes)
    part = biarcs(points, headings, closed=False)
    return np.concatenate([part, stretch(case, s[-1], s[0])[:-1]])


def transformed(vertices, angle=0.0, shift=(0.0, 0.0), factor=1.0, mirror=False):
    out = vertices.copy()
    if mirror:
        out = np.column_stack([vertices[:, 0], -vertices[:, 1], -vertices[:, 2]])
    c, s = math.cos(angle), math.sin(angle)
    x, y = factor * out[:, 0], factor * out[:, 1]
    return np.column_stack([c * x - s * y + shift[0], s * x + c * y + shift[1], out[:, 2]])


def reversed_chain(vertices):
    out = vertices[::-1].copy()
    out[:, 2] = -np.roll(vertices[::-1, 2], -1)
    return out


