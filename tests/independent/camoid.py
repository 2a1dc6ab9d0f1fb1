"""A conoid from its numbers: sections by the law of disc.py, splines along the axis, the surface by its first and second
fundamental forms; SI. Shares nothing with camgen."""
import math

import numpy as np
from disc import AT, Law, compliance

SHARES = [1.0, 0.5, 0.25, 0.125, 0.0625, 0.03125]


def cardinal(knots):
    """Not-a-knot cubic splines that are 1 at one knot: coefficients [piece, power, knot]; a line of two, a parabola of three."""
    n = len(knots)
    if n < 4:
        powers = np.linalg.inv(np.vander(knots - knots[0], n, increasing=True))
        return np.stack([np.vstack([powers, np.zeros((4 - n, n))])] * (n - 1)), np.zeros(n - 1) + knots[0]
    rows, values = [], []
    power = lambda h, order: [math.prod(range(p - order + 1, p + 1)) * h ** (p - order) if p >= order else 0.0 for p in range(4)]

    def row(entries, value):
        line = np.zeros(4 * (n - 1))
        for piece, part in entries:
            line[4 * piece : 4 * piece + 4] += part
        rows.append(line), values.append(value)

    unit = np.eye(n)
    for i in range(n - 1):
        h = knots[i + 1] - knots[i]
        row([(i, power(0.0, 0))], unit[i]), row([(i, power(h, 0))], unit[i + 1])
        if i + 2 < n:
            orders = (1, 2, 3) if i in (0, n - 3) else (1, 2)
            for order in orders:
                row([(i, power(h, order)), (i + 1, -np.array(power(0.0, order)))], np.zeros(n))
    solved = np.linalg.lstsq(np.array(rows), np.array(values), rcond=None)[0]
    return solved.reshape(n - 1, 4, n), knots[:-1]


class Camoid:
    def __init__(self, m, speeds, prime, share=None):
        """`share`: of the largest v, the c of t = asinh(v/c), or None for splines in the place."""
        self.m, self.speeds, self.prime = m, np.array(speeds), prime
        self.rf, self.eps = m["roller"], m["offset"]
        self.height = math.sqrt(prime**2 - self.eps**2)
        v = self.speeds if m["shift"] == "linear" else self.speeds**2
        self.z = m["travel"] * (v - v[0]) / (v[-1] - v[0])
        self.v = lambda z: v[0] + (v[-1] - v[0]) * z / m["travel"]
        self.dv = (v[-1] - v[0]) / m["travel"]
        self.scale = share * v[-1] if share else None
        self.coefficients, self.left = cardinal(self.variable(self.z)[0])
        self.laws = [Law(dict(m, column=self.column(rpm)), rpm) for rpm in speeds]
        self.lowest = min(law.lowest for law in self.laws)
        self.pieces = [(low, high, sense) for low, high, _ in self.laws[0].pieces for sense in (1.0, -1.0)]

    def column(self, rpm):
        m = self.m
        r, k, q = m["r"], m["k"], m["q"]
        A0 = (q - 1) / r
        g = q ** (1 / k)
        design = k / A0 if m["column"] == "matched" else r * g / (g - 1)
        if m["mode"] == "fixed":
            return design
        A = A0 * (rpm / 35) ** 2
        return design * (1 - (1 + A0 * r) ** (-1 / k)) / (1 - (1 + A * r) ** (-1 / k))

    def variable(self, z):
        z = np.asarray(z, float)
        if self.scale is None:
            return z, np.ones_like(z), np.zeros_like(z)
        y, b = self.v(z) / self.scale, self.dv / self.scale
        return np.arcsinh(y), b / np.sqrt(1 + y * y), -b * b * y / (1 + y * y) ** 1.5

    def weights(self, z):
        """[derivative, ..., section] by z up to the second."""
        t, t1, t2 = self.variable(z)
        piece = np.clip(np.searchsorted(self.left, t, side="right") - 1, 0, len(self.left) - 1)
        c, h = self.coefficients[piece], (t - self.left[piece])[..., None]
        w = c[..., 0, :] + h * (c[..., 1, :] + h * (c[..., 2, :] + h * c[..., 3, :]))
        w1 = c[..., 1, :] + h * (2 * c[..., 2, :] + 3 * h * c[..., 3, :])
        w2 = 2 * c[..., 2, :] + 6 * h * c[..., 3, :]
        return w, w1 * t1[..., None], w2 * t1[..., None] ** 2 + w1 * t2[..., None]

    def bottoms(self, piece, p):
        """[order, ..., section] of Δx by the crank angle on a piece and its mirror image."""
        low, high, sense = self.pieces[piece]
        out = []
        for law in self.laws:
            f = next(f for l, h, f in law.pieces if (l, h) == (low, high))
            out.append(np.stack([v * s for v, s in zip(f(p)[:3], (1, sense, 1))]))
        return np.stack(out, axis=-1)

    def partials(self, b, z):
        """s, s_θ, s_θθ, s_z, s_θz, s_zz."""
        lever, n = self.m["lever"], self.m["lobes"]
        w, w1, w2 = self.weights(z)
        lift, first, second = lever * (b[0] - self.lowest), lever * n * b[1], lever * n * n * b[2]
        dot = lambda a, c: (a * c).sum(-1)
        return dot(lift, w), dot(first, w), dot(second, w), dot(lift, w1), dot(first, w1), dot(lift, w2)

    def normal(self, s):
        h, a = self.height + s[0], s[1] - self.eps
        normal = np.stack([h, -a, -h * s[3]], axis=-1)
        return normal / np.linalg.norm(normal, axis=-1)[..., None]

    def touching(self, b, z):
        """Where the sphere stands that touches the cut at z."""
        place = np.array(z, float)
        for _ in range(60):
            s = self.partials(b, place)
            place = 0.5 * place + 0.5 * (z + self.rf * self.normal(s)[..., 2])
        return place

    def curvatures(self, s):
        h, a = self.height + s[0], s[1] - self.eps
        normal = self.normal(s)
        dot = lambda r, t, k: r * normal[..., 0] + t * normal[..., 1] + k * normal[..., 2]
        E, F, G = a * a + h * h, a * s[3], 1 + s[3] ** 2
        L, M, N = -dot(s[2] - h, 2 * s[1] - self.eps, 0), -dot(s[4], s[3], 0), -dot(s[5], 0, 0)
        mean = 0.5 * (E * N - 2 * F * M + G * L) / (E * G - F * F)
        gauss = (L * N - M * M) / (E * G - F * F)
        root = np.sqrt(np.maximum(mean**2 - gauss, 0))
        return mean + root, mean - root

    def radius(self, b, z):
        """Of the point of contact of the cut at z about the axis."""
        place = self.touching(b, z)
        s = self.partials(b, place)
        n = self.normal(s)
        return np.hypot(self.height + s[0] - self.rf * n[..., 0], self.eps - self.rf * n[..., 1])

    def most(self, value, low, high):
        """Largest of value(b, p, z) over every piece and these places along the axis."""
        best = -math.inf
        for piece, (start, end, _) in enumerate(self.pieces):
            cuts = [start, 0.0, end] if start < 0 < end else [start, end]
            for a, c in zip(cuts, cuts[1:]):
                best = max(best, self.most_of(lambda p, z: value(self.bottoms(piece, p), p, z), (a, c), (low, high)))
        return best

    @staticmethod
    def most_of(value, across, along):
        grid = lambda span, n: span[0] + (span[1] - span[0]) * (0.5 - 0.5 * np.cos(np.linspace(0, np.pi, n)))
        p, z = grid(across, 61), grid(along, 31)
        P, Z = np.meshgrid(p, z, indexing="ij")
        v = value(P.ravel(), Z.ravel()).reshape(P.shape)
        v = np.where(np.isfinite(v), v, -np.inf)
        best = v.max()
        padded = np.pad(v, 1, constant_values=-np.inf)
        around = np.max([padded[1 + i : 62 + i, 1 + j : 32 + j] for i in (-1, 0, 1) for j in (-1, 0, 1)], axis=0)
        peaks = np.argwhere((v >= around) & np.isfinite(v))
        for i, j in sorted(peaks, key=lambda ij: -v[tuple(ij)])[:4]:
            box = [p[max(i - 1, 0)], p[min(i + 1, 60)], z[max(j - 1, 0)], z[min(j + 1, 30)]]
            for _ in range(16):
                fine_p, fine_z = np.linspace(*box[:2], 9), np.linspace(*box[2:], 9)
                P, Z = np.meshgrid(fine_p, fine_z, indexing="ij")
                w = value(P.ravel(), Z.ravel()).reshape(P.shape)
                a, c = np.unravel_index(np.nanargmax(w), w.shape)
                best = max(best, w[a, c])
                box = [fine_p[max(a - 2, 0)], fine_p[min(a + 2, 8)], fine_z[max(c - 2, 0)], fine_z[min(c + 2, 8)]]
        return best

    def air(self, rpm, b, p, z):
        """Length of the air and the loading A x, at a speed (array)."""
        A = (self.m["q"] - 1) / self.m["r"] * (rpm / 35) ** 2
        x = self.m["r"] * np.sin(p)
        bottom = (b[0] * self.weights(z)[0]).sum(-1)
        L = np.array([self.column(v) for v in np.atleast_1d(rpm)])
        return L, L - x - bottom, A * x

    def residual(self):
        law = self.laws[0]
        square = self.m["shift"] == "square"

        def left(b, p, z):
            v = self.v(z)
            rpm = np.sqrt(v) if square else v
            L, air, inertia = self.air(rpm, b, p, z)
            with np.errstate(all="ignore"):
                force = law.unit * np.abs(inertia - ((L / air) ** law.k - 1))
            return np.where(p >= 0, force, 0.0)

        # Between two sections each, and where they are.
        return max(self.most(left, a, c) for a, c in zip(self.z, self.z[1:]))

    def force(self, i, b, p):
        law, m = self.laws[i], self.m
        x = law.r * np.sin(np.clip(p, 0, None))
        with np.errstate(all="ignore"):
            ratio = np.where(p >= 0, (law.L / (law.L - x - b[0][..., i])) ** law.k, 1.0)
        inertia = (m["follower_mass"] or 0) * (law.omega / m["lobes"]) ** 2 * m["lever"] * m["lobes"] ** 2 * b[2][..., i]
        return law.unit * (ratio - 1) / m["lever"] + (m["preload"] or 0) + inertia

    def of_sections(self, value):
        """Largest of value(i, b, p, s) over the sections."""
        best = -math.inf
        for i, z in enumerate(self.z):
            at = lambda b, p, _, i=i, z=z: value(i, b, p, self.partials(b, np.zeros_like(p) + z))
            best = max(best, self.most(at, z, z + 1e-12))
        return best

    def stress(self):
        soft = compliance(self.m["material"])

        def pressure(i, b, p, s):
            normal = self.force(i, b, p) / self.normal(s)[..., 0]
            k1, k2 = self.curvatures(s)
            inside = lambda k: np.maximum(0.5 * (1 / self.rf + k / (1 - k * self.rf)), 0)
            return hertz(np.maximum(normal, 0), inside(k1), inside(k2), soft)

        return 1e-6 * self.of_sections(pressure)

    def figures(self):
        m, travel = self.m, self.m["travel"]
        out = {}
        out["max_lift"] = m["lever"] * (max(law.most(lambda s: s[0]) for law in self.laws) - self.lowest)
        out["pressure_angle"] = math.degrees(self.most(lambda b, p, z: self.alpha(b, z), 0.0, travel))
        contact = lambda b, z: z - self.rf * self.normal(self.partials(b, z))[..., 2]
        out["reach"] = max(self.most(lambda b, p, z: contact(b, z) - travel, 0.0, travel),
                           self.most(lambda b, p, z: -contact(b, z), 0.0, travel))
        out["axial"] = self.of_sections(lambda i, b, p, s: np.abs(self.force(i, b, p) * s[3]))
        out["least"] = -self.of_sections(lambda i, b, p, s: -self.force(i, b, p))
        out["residual"] = self.residual()
        return out

    def alpha(self, b, z):
        s = self.partials(b, z)
        return np.abs(np.arctan2(s[1] - self.eps, self.height + s[0]))

    def of_metal(self, overhang):
        """Least radius of convexity, largest ball in the hollows and least radius, over all that the spheres cut."""
        low, high = -overhang, self.m["travel"] + overhang
        at = lambda b, z: self.curvatures(self.partials(b, self.touching(b, z)))
        sharp = self.most(lambda b, p, z: at(b, z)[0], low, high)
        hollow = self.most(lambda b, p, z: -at(b, z)[1], low, high)
        return (1 / sharp if sharp > 0 else math.inf, 1 / hollow + self.rf if hollow > 0 else math.inf,
                -self.most(lambda b, p, z: -self.radius(b, z), low, high))

    def section(self, i, count=160):
        """Points of the cut at a section, mm, of a clockwise cam."""
        points = []
        for piece, (low, high, sense) in enumerate(self.pieces):
            p = np.linspace(low, high, count)
            b = self.bottoms(piece, p)
            place = self.touching(b, np.zeros_like(p) + self.z[i])
            s = self.partials(b, place)
            n = self.normal(s)
            theta = (p if sense > 0 else math.pi - p) / self.m["lobes"]
            x, y = self.height + s[0] - self.rf * n[..., 0], self.eps - self.rf * n[..., 1]
            points.append(np.stack([x * np.cos(theta) - y * np.sin(theta), x * np.sin(theta) + y * np.cos(theta)], axis=-1))
        return 1e3 * np.concatenate(points)


def hertz(force, first, second, soft):
    """Pressure in the middle of the ellipse of contact, by the complete elliptic integrals; arrays."""
    small, large = np.minimum(first, second), np.maximum(first, second)
    share = np.clip(small / np.where(large > 0, large, 1), 1e-9, 1.0)
    low, high = np.full_like(share, math.log(1e-10)), np.zeros_like(share)
    for _ in range(70):
        middle = 0.5 * (low + high)
        square = np.exp(2 * middle)
        K, E, KmE = integrals(1 - square)
        # K − E is taken from the sum of the mean itself: no digits are lost near the circle.
        quotient = square * KmE / (E - square * K)
        quotient = np.where(1 - square < 1e-5, 1 - 0.75 * (1 - square), quotient)
        low, high = np.where(quotient < share, middle, low), np.where(quotient < share, high, middle)
    ratio = np.exp(0.5 * (low + high))
    _, E, _ = integrals(1 - ratio**2)
    short = np.cbrt(3 * force * ratio * E * soft / (2 * math.pi * (small + large)))
    with np.errstate(all="ignore"):
        return np.where((force > 0) & (large > 0), 3 * force * ratio / (2 * math.pi * short**2), 0.0)


def integrals(m):
    a, b, c = np.ones_like(m), np.sqrt(1 - m), np.sqrt(m)
    total, power = 0.5 * m, 0.5
    for _ in range(8):
        a, b, c = 0.5 * (a + b), np.sqrt(a * b), 0.5 * (a - b)
        power *= 2
        total = total + power * c * c
    K = math.pi / (2 * a)
    return K, K * (1 - total), K * total
