"""A disc cam under the press from its numbers: law, curves, forces and every maximum, from the papers' equations; SI."""
import math

import numpy as np

AT = 98066.5


def golden(f, low, high, sections=60):
    g = (math.sqrt(5) - 1) / 2
    a, b = high - g * (high - low), low + g * (high - low)
    fa, fb = f(a), f(b)
    for _ in range(sections):
        if fa < fb:
            low, a, fa = a, b, fb
            b = low + g * (high - low)
            fb = f(b)
        else:
            high, b, fb = b, a, fa
            a = high - g * (high - low)
            fa = f(a)
    return max(fa, fb)


class Law:
    """Motion of a reversal by the crank angle, from the machine's numbers; SI."""

    def __init__(self, m, rpm):
        self.r, self.k, self.p0 = m["r"], m["k"], AT
        q = m["q"]
        self.A = (q - 1) / self.r * (rpm / 35) ** 2
        g = (1 + self.A * self.r) ** (1 / self.k)
        self.L = {"matched": self.k / self.A, "return": self.r * g / (g - 1)}.get(m["column"]) or m["column"]
        self.lead = m["lead"]
        self.omega = 3 * rpm * 2 * math.pi / 60
        # The pair of cylinders is sized once, at the design speed: 2 (p_max − p0) F = m ω² r.
        design = 3 * 35 * 2 * math.pi / 60
        self.unit = m["mass"] * design**2 * self.r / (q - 1)
        self.kind, self.width = m["kind"], m["width"]
        start = -self.lead / self.r
        # Pieces up to the middle: (from, to, function of φ giving Δx and three derivatives).
        self.pieces = []
        law = self.law
        if self.kind == "run-up":
            end = np.array([0.0, -self.r, 0.0]) if self.lead else np.array([f(np.array([0.0]))[0] for f in (
                lambda p: law(p)[0], lambda p: law(p)[1], lambda p: law(p)[2])])
            rows = [self.row(t, o) for t, o in [(1, 0), (1, 1), (1, 2), (0, 1), (0, 2), (0, 3)]]
            c = np.linalg.solve(np.array(rows, float), np.array([*end, 0, 0, 0]))
            self.pieces.append((start - self.width, start, lambda p: self.polynomial(c, p - (start - self.width))))
            self.dwell = c[0]
            first = start - self.width
        elif self.kind == "blend":
            half = self.width / 2
            rows = [self.row(t, o) for t, o in [(1, 0), (1, 1), (1, 2), (0, 0), (0, 1), (0, 2)]]
            end = [f[0] for f in law(np.array([half]))[:3]]
            c = np.linalg.solve(np.array(rows, float), np.array([*end, 0, 0, 0]))
            self.pieces.append((-half, half, lambda p: self.polynomial(c, p + half)))
            self.dwell, first = 0.0, -half
        else:
            self.dwell, first = 0.0, start
        if self.lead:
            self.pieces.append((start, 0.0, lambda p: (-(self.lead + self.r * p), np.full_like(p, -self.r), 0 * p, 0 * p)))
        self.pieces.append((self.width / 2 if self.kind == "blend" else 0.0, math.pi / 2, law))
        self.first = first
        self.lowest = -max([self.most(lambda s: -s[0]), -self.dwell])

    def row(self, t, order):
        factor = [np.prod(range(n - order + 1, n + 1)) if n >= order else 0 for n in range(6)]
        return [f * (float(t) ** max(n - order, 0)) / self.width**order for n, f in enumerate(factor)]

    def polynomial(self, c, p):
        t = p / self.width
        return tuple(sum(c[n] * math.prod(range(n - o + 1, n + 1)) * t ** (n - o) for n in range(o, 6)) / self.width**o
                     for o in range(4))

    def law(self, p):
        x, x1 = self.r * np.sin(p), self.r * np.cos(p)
        u, e = self.A * x, 1 / self.k
        f = -self.L * np.expm1(-np.log1p(u) * e) - (x + self.lead)
        f1 = self.L * self.A * e * (1 + u) ** (-e - 1) - 1
        f2 = -self.L * self.A**2 * e * (e + 1) * (1 + u) ** (-e - 2)
        f3 = self.L * self.A**3 * e * (e + 1) * (e + 2) * (1 + u) ** (-e - 3)
        return f, f1 * x1, f2 * x1**2 - f1 * x, f3 * x1**3 - 3 * f2 * x1 * x - f1 * x1

    def each(self):
        """Every piece of the turn as (from, to, sense, function); the later half is the mirror image."""
        for low, high, f in self.pieces:
            yield low, high, 1.0, f
            yield low, high, -1.0, lambda p, f=f: tuple(v * s for v, s in zip(f(p), (1, -1, 1, -1)))

    def most(self, value, mirrored=False):
        """Largest of value((Δx, Δx', Δx'', Δx''')) over the turn, dwell included."""
        zero = np.zeros(1)
        best = value((zero + self.dwell, zero, zero, zero)).max()
        for low, high, sense, f in self.each():
            if sense < 0 and not mirrored:
                continue
            p = low + (high - low) * (0.5 - 0.5 * np.cos(np.linspace(0, np.pi, 1201)))
            v = value(f(p))
            for i in np.argsort(v)[-3:]:
                one = lambda q: float(value(f(np.array([q])))[0])
                best = max(best, golden(one, p[max(i - 1, 0)], p[min(i + 1, len(p) - 1)]), v[i])
        return best

    def most_at(self, value):
        """As most, of value(φ, …) within the closed air, 0 ≤ φ ≤ 90°."""
        best = -math.inf
        for low, high, f in self.pieces:
            low = max(low, 0.0)
            if high <= low:
                continue
            p = low + (high - low) * (0.5 - 0.5 * np.cos(np.linspace(0, np.pi, 1201)))
            v = value(p, f(p))
            for i in np.argsort(v)[-3:]:
                one = lambda q: float(value(np.array([q]), f(np.array([q])))[0])
                best = max(best, golden(one, p[max(i - 1, 0)], p[min(i + 1, len(p) - 1)]), v[i])
        return best


class Disc:
    """Everything a report tells of a disc cam, from the law."""

    def __init__(self, m, rpm, prime):
        self.law = Law(m, rpm)
        self.m, self.prime, self.n = m, prime, m["lobes"]
        self.rf, self.eps = m["roller"], m["offset"]
        self.height = math.sqrt(prime**2 - self.eps**2)

    def jet(self, s):
        lever, n = self.m["lever"], self.n
        return lever * (s[0] - self.law.lowest), lever * n * s[1], lever * n * n * s[2]

    def curvature(self, s):
        l, v, a = self.jet(s)
        R, b = self.height + l, v - self.eps
        return (b * (2 * v - self.eps) - R * (a - R)) / (b * b + R * R) ** 1.5

    def tangent_alpha(self, s):
        l, v, _ = self.jet(s)
        return (v - self.eps) / (self.height + l)

    def air(self, p, s):
        law = self.law
        x = law.r * np.sin(np.clip(p, 0, None))
        return law.L - x - law.lead - s[0]

    def force(self, p, s):
        """Along the path, N."""
        law, m = self.law, self.m
        with np.errstate(all="ignore"):
            ratio = np.where(p >= 0, (law.L / self.air(p, s)) ** law.k, 1.0)
        air = law.unit * (ratio - 1) / m["lever"]
        _, _, a = self.jet(s)
        inertia = (m["follower_mass"] or 0) * (law.omega / self.n) ** 2 * a
        return air + (m["preload"] or 0) + inertia

    def figures(self):
        law, m = self.law, self.m
        out = {}
        by_angle = lambda value: max(self.over(value))
        out["max_lift"] = m["lever"] * (law.most(lambda s: s[0]) - law.lowest)
        out["pressure_angle"] = math.degrees(math.atan(law.most(lambda s: np.abs(self.tangent_alpha(s)), mirrored=True)))
        sharp = law.most(lambda s: self.curvature(s), mirrored=True)
        out["convex"] = 1 / sharp if sharp > 0 else math.inf
        hollow = law.most(lambda s: -self.curvature(s), mirrored=True)
        out["hollow"] = 1 / hollow + self.rf if hollow > 0 else math.inf
        if law.lead:
            # The retreat ends with a corner: concave where the bottom comes back from −r, else an edge.
            jump = law.law(np.zeros(1))[1][0] + law.r
            out["hollow" if jump > 0 else "convex"] = self.rf if jump > 0 else 0.0
        out["wall"] = self.prime - self.rf - m["bore"]
        out["inertia"] = law.unit * law.A * law.r
        out["force"] = by_angle(lambda p, s: self.force(p, s))
        out["least"] = -by_angle(lambda p, s: -self.force(p, s))
        speed = 1.0
        out["torque"] = by_angle(lambda p, s: np.abs(self.force(p, s) * self.jet(s)[1])) * speed
        out["residual"] = law.most_at(lambda p, s: law.unit * np.abs(
            law.A * law.r * np.sin(p) - ((law.L / self.air(p, s)) ** law.k - 1)))
        out["air"] = -law.most_at(lambda p, s: -self.air(p, s))
        g = (1 + law.A * law.r) ** (1 / law.k)
        fixed = law.r * g / (g - 1)
        x = np.linspace(0, law.r, 20001)[1:-1]
        gap = lambda x: law.unit * np.abs(law.A * x - ((fixed / (fixed - x)) ** law.k - 1))
        i = int(gap(x).argmax())
        out["fixed"] = golden(lambda t: float(gap(np.array([t]))[0]), x[max(i - 1, 0)], x[min(i + 1, len(x) - 1)])

        def stress(p, s):
            alpha = np.arctan(self.tangent_alpha(s))
            contact = np.maximum(self.force(p, s), 0) / np.cos(alpha)
            pitch = self.curvature(s)
            profile = pitch / (1 - self.rf * pitch)
            bend = np.maximum(1 / self.rf + profile, 0)
            soft = compliance(m["material"])
            return contact * bend / (soft * math.pi * m["thickness"])

        out["stress"] = math.sqrt(max(by_angle(stress), 0)) * 1e-6
        return out

    def over(self, value):
        """Largest of value(φ, Δx…) on every piece, both sides."""
        zero = np.zeros(1)
        yield float(value(zero - 1, (zero + self.law.dwell, zero, zero, zero))[0])
        for low, high, sense, f in self.law.each():
            # The air closes at φ = 0; a blend spans it.
            cuts = [low, 0.0, high] if low < 0 < high else [low, high]
            for a, b in zip(cuts, cuts[1:]):
                p = a + (b - a) * (0.5 - 0.5 * np.cos(np.linspace(0, np.pi, 1201)))
                side = (lambda q: q) if a >= 0 else (lambda q: np.minimum(q, -1e-300))
                v = value(side(p), f(p))
                for i in np.argsort(v)[-3:]:
                    one = lambda q: float(value(side(np.array([q])), f(np.array([q])))[0])
                    yield max(golden(one, p[max(i - 1, 0)], p[min(i + 1, len(p) - 1)]), float(v[i]))


MODULI = {"steel": (210e9, 0.3), "cast-iron": (110e9, 0.26), "bronze": (110e9, 0.34), "aluminium": (70e9, 0.33)}
CUSTOMARY = {"steel": 1500, "cast-iron": 700, "bronze": 500, "aluminium": 250}


def compliance(material):
    """1/E* of a steel roller on a material."""
    return sum((1 - v * v) / e for e, v in (MODULI["steel"], MODULI[material]))


def roll(disc, chain):
    """Largest gap and lift error (mm) and residual (N) of the roller on a chain, at fine places."""
    law, n = disc.law, disc.n
    worst_gap, worst_lift, worst_force = 0.0, 0.0, 0.0
    sign = -1.0 if disc.m["ccw"] else 1.0
    for low, high, sense, f in law.each():
        p = low + (high - low) * np.linspace(0, 1, 700)
        s = f(p)
        lift, v, _ = disc.jet(s)
        phi = p if sense > 0 else math.pi - p
        theta = phi / n
        u = np.stack([np.cos(theta), np.sin(theta)], axis=1)
        across = np.stack([-np.sin(theta), np.cos(theta)], axis=1)
        mirror = np.array([1.0, sign])
        centre = lambda h: (u * h[:, None] + across * disc.eps) * 1e3 * mirror
        height = disc.height + lift
        gap = chain.distance(centre(height)) - 1e3 * disc.rf
        moved = height.copy()
        for _ in range(4):
            here = (chain.distance(centre(moved)) - 1e3 * disc.rf) * 1e-3
            cosine = (chain.distance(centre(moved + 1e-7)) - chain.distance(centre(moved - 1e-7))) * 1e-3 / 2e-7
            moved -= here / np.where(np.abs(cosine) > 0.05, cosine, np.inf)
        error = moved - height
        worst_gap = max(worst_gap, np.abs(gap).max())
        worst_lift = max(worst_lift, 1e3 * np.abs(error).max())
        inside = p >= 0
        if inside.any():
            x = law.r * np.sin(p[inside])
            bottom = s[0][inside] + error[inside] / disc.m["lever"]
            with np.errstate(all="ignore"):
                left = law.A * x - ((law.L / (law.L - x - law.lead - bottom)) ** law.k - 1)
            worst_force = max(worst_force, law.unit * np.abs(left).max())
    return worst_gap, worst_lift, worst_force
