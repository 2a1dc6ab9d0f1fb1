"""Forces of a cam with one follower, from first principles: laws in closed form, geometry in complex numbers, statics of the guide, Hertz,
vibration by Fourier integrals. Shares nothing with camgen. mm, N, rad; moments of swinging followers N·m.

The frame of the geometry turns with the follower round the cam: the real axis is the follower's path, or points from the shaft to the pivot;
the imaginary axis is the way the follower seems to travel. A vector z in it has the derivative z' + iz seen from the cam.
"""
import numpy as np

PI = np.pi
GAUSS_X, GAUSS_W = np.polynomial.legendre.leggauss(16)
BREAKS = {"modified-sine": [1 / 8, 7 / 8], "modified-trapezoid": [1 / 8, 3 / 8, 1 / 2, 5 / 8, 7 / 8]}
# Young's modulus, MPa, and Poisson's ratio of the cam; the follower is of steel.
MATERIALS = {"steel": (210e3, 0.3), "cast-iron": (110e3, 0.26), "bronze": (110e3, 0.34), "aluminium": (70e3, 0.33)}


def law(name, x):
    """Travel and its first two derivatives on x in [0, 1]."""
    if name == "dwell":
        return 0 * x, 0 * x, 0 * x
    if name == "cycloidal":
        return x - np.sin(2 * PI * x) / (2 * PI), 1 - np.cos(2 * PI * x), 2 * PI * np.sin(2 * PI * x)
    if name == "harmonic":
        return (1 - np.cos(PI * x)) / 2, PI / 2 * np.sin(PI * x), PI**2 / 2 * np.cos(PI * x)
    if name == "3-4-5":
        return x**3 * (10 - 15 * x + 6 * x**2), 30 * (x * (1 - x)) ** 2, 60 * x * (1 - x) * (1 - 2 * x)
    if name == "4-5-6-7":
        y = x * (1 - x)
        return x**4 * (35 - 84 * x + 70 * x**2 - 20 * x**3), 140 * y**3, 420 * y**2 * (1 - 2 * x)
    if name == "modified-sine":
        c, slow = 4 + PI, 4 * PI / 3 * x + PI / 3
        middle = (x >= 1 / 8) & (x <= 7 / 8)
        s = np.where(middle, 2 + PI * x - 9 / 4 * np.sin(slow), PI * x - np.sin(4 * PI * x) / 4 + 4 * (x > 1 / 2))
        v = np.where(middle, PI - 3 * PI * np.cos(slow), PI - PI * np.cos(4 * PI * x))
        a = 4 * PI**2 * np.where(middle, np.sin(slow), np.sin(4 * PI * x))
        return s / c, v / c, a / c
    assert name == "modified-trapezoid", name
    late = x > 1 / 2
    x = np.where(late, 1 - x, x)
    top = 8 * PI / (2 + PI)
    t, r = x - 1 / 8, x - 3 / 8
    v1, s1 = top / (4 * PI), top / (4 * PI) * (1 / 8 - 1 / (4 * PI))
    v2, s2 = v1 + top / 4, s1 + v1 / 4 + top / 32
    where = [x < 1 / 8, x < 3 / 8, x <= 1 / 2]
    s = np.select(where, [
        top / (4 * PI) * (x - np.sin(4 * PI * x) / (4 * PI)),
        s1 + v1 * t + top / 2 * t**2,
        s2 + v2 * r + top / (16 * PI**2) * (1 - np.cos(4 * PI * r)),
    ])
    v = np.select(where, [v1 * (1 - np.cos(4 * PI * x)), v1 + top * t, v2 + v1 * np.sin(4 * PI * r)])
    a = np.select(where, [top * np.sin(4 * PI * x), top + 0 * x, top * np.cos(4 * PI * r)])
    return np.where(late, 1 - s, s), v, np.where(late, -a, a)


class Segment:
    """One law from `low` to `high`, rad, between two positions above the lowest of the program."""

    def __init__(self, name, low, high, start, end):
        self.name, self.low, self.high, self.start, self.end = name, low, high, start, end
        self.span = high - low
        self.breaks = [low] + [low + b * self.span for b in BREAKS.get(name, [])] + [high]

    def at(self, theta):
        s, v, a = law(self.name, np.clip((theta - self.low) / self.span, 0, 1))
        h = self.end - self.start
        return self.start + h * s, h * v / self.span, h * a / self.span**2


class Cam:
    """The follower on its cam; `keys` are plain numbers in mm, rad, N, N·m, kg or kg·m², those of the machine file without their units."""

    def __init__(self, kind, keys, segments, base, omega):
        self.kind, self.k, self.segments, self.base, self.omega = kind, keys, segments, base, omega
        self.swings = kind.startswith("swinging")
        self.radius = keys.get("radius", 0.0)
        self.side = -1 if keys.get("side") == "leading" else 1
        self.friction, self.span, self.overhang = keys.get("friction", 0.0), keys.get("span", 1.0), keys.get("overhang", 0.0)
        self.pressed = keys.get("preload", 0.0) + keys.get("own_preload", 0.0) + keys.get("load", 0.0)
        self.inertia = keys.get("inertia", 0.0)

    def touch(self, s, v, a):
        """Contact P, outward normal of the cam, the follower's velocity by the lift at the contact, and curvature of the profile, speed of
        the centre, and the place on the stem from which the overhang counts."""
        k, side = self.k, self.side
        if self.kind in ("flat", "swinging-flat"):
            if self.kind == "flat":
                normal = np.exp(1j * k["tilt"]) + 0 * s
                p, q = self.base + s * np.cos(k["tilt"]), v * np.cos(k["tilt"])
                rho = p + a * np.cos(k["tilt"])
            else:
                pivot, away = k["pivot_distance"], k["face_offset"]
                psi = np.arcsin((self.base + away) / pivot) + s
                normal = np.exp(1j * side * (psi - PI / 2))
                turn = 1 + side * v
                p, q = pivot * np.sin(psi) - away, pivot * np.cos(psi) * v / turn
                up = pivot * (np.cos(psi) * a - np.sin(psi) * v**2)
                rho = p + (up * turn - pivot * np.cos(psi) * v * side * a) / turn**3
            place = (p + 1j * q) * normal
            if self.kind == "flat":
                # The stem stands at its offset; the face crosses it where its distance from the shaft along the normal is p.
                stem = 1j * k["offset"]
                stem = stem + (p - (stem * normal.conj()).real) / np.cos(k["tilt"])
                return place, normal, 1.0 + 0 * normal, 1 / rho, None, stem
            return place, normal, 1j * side * (place - pivot), 1 / rho, None, None
        prime = self.base + self.radius
        if self.swings:
            arm, pivot = k["arm"], k["pivot_distance"]
            psi = np.arccos((arm**2 + pivot**2 - prime**2) / (2 * arm * pivot)) + s
            arrow = arm * np.exp(1j * side * psi)
            centre, drive = pivot - arrow, -1j * side * arrow
            first, second = drive * v, drive * a + arrow * v**2
        else:
            centre = np.sqrt(prime**2 - k["offset"] ** 2) + s + 1j * k["offset"]
            drive, first, second = 1.0 + 0j * s, v + 0j, a + 0j
        speed, bend = first + 1j * centre, second + 2j * first - centre
        curvature = (speed.conj() * bend).imag / np.abs(speed) ** 3
        normal = -1j * speed / np.abs(speed)
        return centre - self.radius * normal, normal, drive, curvature / (1 - self.radius * curvature), np.abs(speed), centre

    def bearings(self, place, normal, stem):
        """Forces of the nearer and the farther bearing square to the stem, for one newton along the normal: balance across, and of moments
        about the place from which the overhang counts."""
        moment = ((place - stem).conj() * normal).imag
        far = (self.overhang * normal.imag - moment) / self.span
        return -normal.imag - far, far

    def state(self, segment, theta):
        """Everything at cam angles within one segment."""
        s, v, a = segment.at(theta)
        place, normal, drive, kappa, speed, stem = self.touch(s, v, a)
        unit = 1.0 if self.swings else 1e-3
        w = self.omega
        path = self.inertia * a * w**2 * unit + self.k.get("damping", 0.0) * v * w * unit + self.k.get("rate", 0.0) * s + self.pressed
        lever = (normal.conj() * drive).real
        # A moment, N·m, over a lever, mm.
        generalised = path * 1e3 if self.swings else path
        free, near, far = lever, 0 * s, 0 * s
        if self.friction:
            near, far = self.bearings(place, normal, stem)
            # Friction holds the follower back while it rises or rests, and holds it up while it falls; it needs a contact.
            rubbing = self.friction * (np.abs(near) + np.abs(far))
            free = np.where(path < 0, lever, lever + np.where(segment.end < segment.start, rubbing, -rubbing))
            lifted, share = lever - rubbing, lever + np.where(segment.end < segment.start, rubbing, -rubbing)
        else:
            lifted = share = lever
        with np.errstate(divide="ignore", invalid="ignore"):
            # A follower that jams is not lifted by any force.
            contact = np.where((free <= 0) & (path >= 0), np.inf, generalised / free)
        torque = contact * (place * normal.conj()).imag * 1e-3
        reach = np.abs(drive) if self.swings else 1.0
        spin = None if speed is None or not self.radius else speed / self.radius - 1 - (self.side * v if self.swings else 0)
        return {"s": s, "v": v, "a": a, "path": path, "force": generalised / reach, "contact": contact, "torque": torque, "kappa": kappa,
                "spin": spin, "near": near, "far": far, "lifted": lifted, "share": share, "alpha": np.arccos(np.clip(lever / reach, -1, 1))}

    def extreme(self, value, segments=None):
        """Largest of value(segment, theta) over the turn and its place, the ends of segments taken from within."""
        best = (-np.inf, 0.0)
        for segment in segments or self.segments:
            for low, high in zip(segment.breaks, segment.breaks[1:]):
                theta = np.linspace(low, high, 161)
                for _ in range(7):
                    found = value(segment, theta)
                    at = int(np.nanargmax(found))
                    if found[at] > best[0]:
                        best = (float(found[at]), float(theta[at]))
                    theta = np.linspace(theta[max(at - 1, 0)], theta[min(at + 1, len(theta) - 1)], 41)
        return best

    def roots(self, segment, value):
        """Places within a segment where value(theta) changes its sign, by halving."""
        theta = np.unique(np.concatenate([np.linspace(a, b, 161) for a, b in zip(segment.breaks, segment.breaks[1:])]))
        f = value(theta)
        at = np.nonzero(f[:-1] * f[1:] < 0)[0]
        low, high = theta[at], theta[at + 1]
        if not len(at):
            return []
        for _ in range(50):
            middle = (low + high) / 2
            same = value(middle) * f[at] > 0
            low, high = np.where(same, middle, low), np.where(same, high, middle)
        return list((low + high) / 2)

    def pieces(self, extra=()):
        """Intervals on which all forces are smooth: (segment, low, high), split also where a bearing or the contact changes its sign."""
        found = []
        for segment in self.segments:
            cuts = set(segment.breaks)
            names = ["path", "near", "far"] if self.friction else ["path"]
            for value in [lambda t, n=n: self.state(segment, t)[n] for n in names] + [lambda t, e=e: e(segment, t) for e in extra]:
                cuts.update(self.roots(segment, value))
            cuts = sorted(cuts)
            found += [(segment, a, b) for a, b in zip(cuts, cuts[1:])]
        return found

    def work(self, value):
        """Integral of value(segment, theta) over the turn, and the largest less the least of what has come together since its start, the mean
        taken off."""
        def add(pieces, less):
            sums = []
            for segment, low, high in pieces:
                theta, weight = panels(low, high, 8)
                sums.append(float((weight * (value(segment, theta) - less)).sum()))
            return np.array(sums)

        total = add(self.pieces(), 0.0).sum()
        mean = total / (2 * PI)
        run = np.cumsum(add(self.pieces([lambda segment, t: value(segment, t) - mean]), mean))
        return total, float(max(run.max(), 0.0) - min(run.min(), 0.0))

    def jump_speed(self):
        """First angular speed at which the force along the path is nought somewhere, and the place."""
        unit = 1.0 if self.swings else 1e-3

        def inverse(segment, theta):
            s, v, a = segment.at(theta)
            square, linear = self.inertia * a * unit, self.k.get("damping", 0.0) * v * unit
            rest = self.k.get("rate", 0.0) * s + self.pressed
            inside = linear**2 - 4 * square * rest
            with np.errstate(divide="ignore", invalid="ignore"):
                found = (-linear + np.sqrt(np.maximum(inside, 0))) / (2 * rest)
            # The reciprocal of the smallest positive root; no root: 0.
            return np.where(rest <= 0, np.inf, np.where((inside < 0) | (found < 0), 0.0, found))

        value, place = self.extreme(inverse)
        return (np.inf if value == 0 else 1 / value), place

    def pressure(self, state, width, material, crown):
        """Hertz' largest pressure, MPa."""
        young, poisson = MATERIALS[material]
        modulus = 1 / ((1 - poisson**2) / young + (1 - 0.3**2) / 210e3)
        across = state["kappa"] + (1 / self.radius if self.radius else 0.0)
        force = np.maximum(state["contact"], 0)
        if not crown:
            return np.sqrt(force * modulus * across / (PI * width))
        return ellipse_pressure(force, modulus, across, 1 / crown + 0 * across)


def laid(rows, lobes, start, unit):
    """Segments in radians from the start of the program, positions above the lowest."""
    positions = [start] + [r[2] for r in rows if r[2] is not None]
    lowest, segments, at, value = min(positions), [], 0.0, start
    for lobe in range(lobes):
        for i, (name, over, to) in enumerate(rows):
            end = value if to is None else to
            low, at = at, (lobe + 1) * 2 * PI / lobes if i == len(rows) - 1 else at + over * PI / 180
            segments.append(Segment(name, low, at, (value - lowest) * unit, (end - lowest) * unit))
            value = end
    return segments


def sound(cam):
    """No undercut, moderate angles, a face that does not fold over."""
    for segment in cam.segments:
        theta = np.linspace(segment.low, segment.high, 200)
        with np.errstate(invalid="ignore", divide="ignore"):
            found = cam.state(segment, theta)
            bend = 1 / found["kappa"]
        if not np.isfinite(found["alpha"]).all() or found["alpha"].max() > 1.25:
            return False
        if cam.radius or cam.kind == "knife":
            # The pitch curve bends less than the roller on the convex side.
            if ((bend + cam.radius) * bend <= 0).any() or ((bend > 0) & (bend < 0.5)).any():
                return False
            if cam.radius and (found["kappa"] * cam.radius < -0.97).any():
                return False
        elif (bend < 1).any() or (cam.swings and (1 + cam.side * found["v"] < 0.2).any()):
            return False
        if cam.swings:
            k = cam.k
            if cam.kind == "swinging-flat":
                psi = np.arcsin((cam.base + k["face_offset"]) / k["pivot_distance"]) + found["s"]
                if (psi > 1.45).any():
                    return False
                continue
            rest = np.arccos((k["arm"] ** 2 + k["pivot_distance"] ** 2 - (cam.base + cam.radius) ** 2) / (2 * k["arm"] * k["pivot_distance"]))
            if (rest + found["s"] > 3.0).any():
                return False
    return True


def panels(low, high, count):
    """Nodes and weights of Gauss' rule on `count` equal parts."""
    edges = np.linspace(low, high, count + 1)
    half = np.diff(edges)[:, None] / 2
    return ((edges[:-1, None] + half) + half * GAUSS_X).ravel(), (half * GAUSS_W).ravel()


def elliptic(m):
    """K − E and E − (1 − m)K of the parameter m = e², by the arithmetic-geometric mean: both over e² stay exact for round contacts."""
    a, b, total, power = np.ones_like(m), np.sqrt(1 - m), m / 2, 1.0
    for _ in range(40):
        a, b, c = (a + b) / 2, np.sqrt(a * b), (a - b) / 2
        total, power = total + power * c**2, 2 * power
    k = PI / (2 * a)
    return k * total, k * (m - total)


def ellipse_pressure(force, modulus, first, second):
    """Largest pressure of an elliptical contact of relative curvatures `first` and `second`, 1/mm (Johnson, 4.2)."""
    small, large = np.minimum(first, second), np.maximum(first, second)
    low, high = np.full_like(small, -14.0), np.zeros_like(small)
    for _ in range(70):
        ratio = np.exp((low + high) / 2)
        along, over = elliptic(1 - ratio**2)
        # Curvatures of the ellipse of this ratio b/a: ((a/b)² E − K)/(K − E); they grow apart as it gets slender.
        slender = over / ratio**2 < large / small * along
        low, high = np.where(slender, low, (low + high) / 2), np.where(slender, (low + high) / 2, high)
    ratio = np.exp((low + high) / 2)
    square = 1 - ratio**2
    along, over = elliptic(square)
    # F = (2/3) p π a b and curvature/2 = (p/E*)(b/(e² a²))(K − E) with the long axis a.
    return (3 * force * (small / 2 * modulus * square) ** 2 / (2 * PI * ratio**3 * along**2)) ** (1 / 3)


def residual(movement, ratio):
    """Amplitude that joined segments leave behind over their travel, undamped: |∫ s'' e^(inθ) dθ| / n for n natural periods in a turn."""
    ratio = np.atleast_1d(ratio)
    parts = []
    for segment, shift in movement:
        for low, high in zip(segment.breaks, segment.breaks[1:]):
            theta, weight = panels(low, high, 4 + int((high - low) * ratio.max() / 6))
            parts.append((theta + shift, weight * segment.at(theta)[2]))
    theta, shape = (np.concatenate(column) for column in zip(*parts))
    # A law lies between its ends, so the travel is the range of these.
    ends = [movement[0][0].start] + [segment.end for segment, _ in movement]
    return np.abs(np.exp(1j * ratio[:, None] * theta) @ shape) / ratio / (max(ends) - min(ends))


def worst_residual(movement, low, high):
    ratio = np.linspace(low, high, 201)
    best = 0.0
    for _ in range(6):
        found = residual(movement, ratio)
        at = int(found.argmax())
        best = max(best, float(found[at]))
        ratio = np.linspace(ratio[max(at - 1, 0)], ratio[min(at + 1, len(ratio) - 1)], 11)
    return best


def fourier(segments, count):
    """Mean and complex coefficients S of the lift, s = mean + Re Σ S e^(ikθ), k from 1: from the acceleration, S = −A/k²."""
    mean, orders, total = 0.0, np.arange(1, count + 1), np.zeros(count, complex)
    nodes, shapes = [], []
    for segment in segments:
        for low, high in zip(segment.breaks, segment.breaks[1:]):
            theta, weight = panels(low, high, 4 + int((high - low) * count / 12))
            s, _, a = segment.at(theta)
            mean += (weight * s).sum() / (2 * PI)
            if segment.start != segment.end:
                nodes.append(theta)
                shapes.append(weight * a / PI)
    turn, wave = np.exp(-1j * np.concatenate(nodes)), np.concatenate(shapes).astype(complex)
    for k in range(count):
        wave *= turn
        total[k] = wave.sum()
    return mean, -total / orders**2
