"""The five followers of `camgen make` on a plane cam, and the outline of a DXF file onto which they are let down; mm and rad.

A follower is a complex number that is differentiated by the product rule, a face its support; the outline is arcs and lines.
"""
import math

import numpy as np
from program_motion import PI, Illegal, quantity


class Follower:
    """One of the five, on a cam that turns clockwise; mm and rad."""

    def __init__(self, kind, given, base):
        mm = lambda key: quantity(given[key]) if key in given else 0.0
        self.kind, self.base = kind, base
        self.radius, self.offset = mm("radius"), mm("offset")
        self.side = -1 if given.get("side") == "leading" else 1
        self.pivot, self.arm, self.away, self.tilt = mm("pivot_distance"), mm("arm"), mm("face_offset"), mm("tilt")
        self.prime = base + self.radius
        self.circle = kind in ("roller", "knife", "swinging-roller")
        self.swings = kind.startswith("swinging")
        if kind in ("roller", "knife"):
            if abs(self.offset) >= self.prime:
                raise Illegal("reach")
            self.height = math.sqrt((self.prime - self.offset) * (self.prime + self.offset))
        if kind == "swinging-roller":
            cosine = (self.pivot**2 + self.arm**2 - self.prime**2) / (2 * self.pivot * self.arm)
            if not -1 < cosine < 1:
                raise Illegal("reach")
            self.start = math.acos(cosine)
        if kind == "swinging-flat":
            sine = (base + self.away) / self.pivot
            if not 0 < sine < 1:
                raise Illegal("reach")
            self.start = math.asin(sine)

    def reach(self, lift):
        if self.kind == "swinging-roller" and self.start + lift >= PI or self.kind == "swinging-flat" and self.start + lift >= PI / 2:
            raise Illegal("reach")

    def curves(self, theta, s, v, a):
        """Dictionary of complex pitch and profile, pressure angle, curvature of the pitch curve, radii and the place on a face."""
        u, i, t = np.exp(1j * theta), 1j, self.side
        cross = lambda p, q: (np.conj(p) * q).imag
        with np.errstate(all="ignore"):
            if self.circle:
                if self.kind == "swinging-roller":
                    psi, w = self.start + s, 1 + t * v
                    e = self.arm * np.exp(i * t * psi)
                    centre = u * (self.pivot - e)
                    first = u * (i * self.pivot - i * w * e)
                    second = u * (-self.pivot + w * w * e - i * t * a * e)
                    drive = -i * t * u * e
                else:
                    z = self.height + s + 1j * self.offset
                    centre, first, second, drive = u * z, u * (i * z + v), u * (-z + 2j * v + a), u
                speed = np.abs(first)
                normal = -1j * first / speed
                curvature = cross(first, second) / speed**3
                profile = centre - self.radius * normal
                radius = 1 / curvature - self.radius
                face, turn = None, None
            else:
                if self.kind == "flat":
                    normal = u * np.exp(1j * self.tilt)
                    p = self.base + s * math.cos(self.tilt)
                    q, radius = v * math.cos(self.tilt), self.base + (s + a) * math.cos(self.tilt)
                    drive, turn = u, np.ones_like(s)
                    stem = (p - self.offset * math.sin(self.tilt)) / math.cos(self.tilt) + 1j * self.offset
                    face = q - (np.conj(np.exp(1j * self.tilt)) * stem).imag
                else:
                    psi, turn = self.start + s, 1 + t * v
                    normal = u * np.exp(1j * t * (psi - PI / 2))
                    p, q = self.pivot * np.sin(psi) - self.away, self.pivot * np.cos(psi) * v / turn
                    slope = self.pivot * (np.cos(psi) * a - np.sin(psi) * v * v) / turn - self.pivot * np.cos(psi) * v * t * a / turn**2
                    radius = p + slope / turn
                    face = self.pivot * np.cos(psi) - t * q
                profile = (p + 1j * q) * normal
                if self.kind == "swinging-flat":
                    # From the pivot, turned by a right angle the way that lifts.
                    arm = profile - self.pivot * u
                    drive = 1j * t * arm
                centre, curvature = profile, 1 / radius
            alpha = np.angle(np.conj(normal) * drive)
        return {"centre": centre, "profile": profile, "alpha": alpha, "curvature": curvature, "radius": radius, "face": face, "turn": turn}


def figures(program, follower):
    """Extremes over the turn: pressure angle, convex and concave radii, face."""
    def of(key):
        def function(i, t):
            s, v, a = program.jet(i, t, 2)
            return key(follower.curves(t, s - program.lowest, v, a))
        return function

    found = {"alpha": program.extreme(of(lambda c: np.abs(c["alpha"])))[0]}
    if follower.circle:
        found["convex"] = 1 / max(program.extreme(of(lambda c: c["curvature"]))[0], 1e-300)
        # Concave where the curvature is negative: the sharpest.
        sharpest = program.extreme(of(lambda c: -c["curvature"]))[0]
        found["concave"] = 1 / sharpest + follower.radius if sharpest > 1e-12 else None
    else:
        found["radius"] = -program.extreme(of(lambda c: -c["radius"]))[0]
        found["turn"] = -program.extreme(of(lambda c: -c["turn"]))[0]
        found["face"] = -program.extreme(of(lambda c: -c["face"]))[0], program.extreme(of(lambda c: c["face"]))[0]
    return found


# ---------------------------------------------------------------- the written outline


class Outline:
    """Arcs and lines of the only polyline on CAM_PROFILE, as complex numbers."""

    def __init__(self, path, mirrored):
        lines = path.read_text().split("\n")
        codes = [int(code) for code in lines[0::2] if code.strip()]
        values = lines[1::2]
        found, inside = [], False
        for code, value in zip(codes, values):
            if code == 0:
                inside = value.strip() == "LWPOLYLINE"
                if inside:
                    found.append({"x": [], "y": [], "b": [], "closed": False, "layer": None})
            elif inside:
                entity = found[-1]
                if code == 8:
                    entity["layer"] = value.strip()
                elif code == 70:
                    entity["closed"] = int(value) & 1 == 1
                elif code == 10:
                    entity["x"].append(float(value))
                    entity["b"].append(0.0)
                elif code == 20:
                    entity["y"].append(float(value))
                elif code == 42:
                    entity["b"][-1] = float(value)
        found = [entity for entity in found if entity["layer"] == "CAM_PROFILE"]
        assert len(found) == 1 and found[0]["closed"], f"{len(found)} outlines in {path}"
        self.start = np.array(found[0]["x"]) + 1j * np.array(found[0]["y"])
        bulge = np.array(found[0]["b"])
        end = np.roll(self.start, -1)
        chord = end - self.start
        self.arc = bulge != 0
        safe = np.where(self.arc, bulge, 1.0)
        sweep = 4 * np.arctan(bulge)
        centre = (self.start + end) / 2 + 1j * chord * (1 - safe**2) / (4 * safe)
        radius = np.abs(chord) * (1 + safe**2) / (4 * safe)
        area = np.sum(self.start.real * end.imag - self.start.imag * end.real) / 2
        self.area = area + np.sum(np.where(self.arc, radius**2 * (sweep - np.sin(sweep)) / 2, 0.0))
        self.length = np.sum(np.where(self.arc, np.abs(radius * sweep), np.abs(chord)))
        # The middle of an arc as a direction from its centre; a concave one has a negative radius.
        middle = np.sign(radius) * -1j * chord / np.abs(chord)
        self.nearest = self.least_distance(centre, radius, sweep, middle)
        flip = np.conj if mirrored else (lambda z: z)
        self.start, end = flip(self.start), flip(end)
        self.centre, self.radius = flip(centre)[self.arc], radius[self.arc]
        self.middle, self.half = flip(middle)[self.arc], np.abs(sweep[self.arc]) / 2
        self.lines = [(flip_start, flip_end) for flip_start, flip_end, arc in zip(self.start, end, self.arc) if not arc]
        self.mirrored = mirrored

    def least_distance(self, centre, radius, sweep, middle):
        """Of the outline from the shaft."""
        best = np.abs(self.start).min()
        # A straight edge under a face has its nearest place where the face is square to the ray.
        chord = np.roll(self.start, -1) - self.start
        share = np.clip(-(np.conj(chord) * self.start).real / np.abs(chord) ** 2, 0, 1)
        best = min(best, np.abs(self.start + share * chord)[~self.arc].min(initial=math.inf))
        for i in np.nonzero(self.arc)[0]:
            foot = -centre[i] / abs(centre[i]) if abs(centre[i]) > 1e-9 else middle[i]
            for direction in (foot, -foot):
                if abs(np.angle(direction / middle[i])) <= abs(sweep[i]) / 2:
                    best = min(best, abs(centre[i] + abs(radius[i]) * direction))
        return best

    def distance(self, points):
        """Of points from the outline."""
        p = points[:, None]
        away = p - self.centre
        foot = np.where(self.on_arc(away), np.abs(np.abs(away) - np.abs(self.radius)), math.inf)
        best = np.minimum(np.abs(p - self.start).min(axis=1), foot.min(axis=1, initial=math.inf))
        for start, end in self.lines:
            share = np.clip((np.conj(end - start) * (points - start)).real / abs(end - start) ** 2, 0, 1)
            best = np.minimum(best, np.abs(points - start - share * (end - start)))
        return best

    def on_arc(self, away):
        """Whether directions from the centres lie on the arcs, with a hair."""
        return np.abs(np.angle(away * np.conj(self.middle))) <= self.half + 1e-9

    def let_down(self, follower, theta):
        """Height of a roller or knife along its path when it first touches, coming from outside; an angle for a swinging one."""
        u = np.exp(1j * theta)[:, None]
        r = follower.radius
        centres = np.concatenate([self.centre, self.start])
        reach = np.concatenate([self.radius + r, np.full(len(self.start), r)])
        hollow = np.concatenate([self.radius < 0, np.zeros(len(self.start), bool)])
        fits = ~(hollow & (reach > 0))
        sign = np.where(hollow, -1.0, 1.0)
        with np.errstate(invalid="ignore"):
            if follower.kind == "swinging-roller":
                to = centres - follower.pivot * u
                far = np.abs(to)
                gamma = np.arccos((follower.arm**2 + far**2 - reach**2) / (2 * follower.arm * far))
                height = follower.side * np.angle(-to / u) + sign * gamma
                at = u * (follower.pivot - follower.arm * np.exp(1j * follower.side * height))
            else:
                local = centres / u
                height = local.real + sign * np.sqrt(reach**2 - (local.imag - follower.offset) ** 2)
                at = u * (height + 1j * follower.offset)
            count = len(self.centre)
            away = at[:, :count] - self.centre
            good = np.concatenate([self.on_arc(away), np.ones((len(theta), len(self.start)), bool)], axis=1) & fits
            height = np.where(good & np.isfinite(height), height, -math.inf)
        best = height.max(axis=1)
        for start, end in self.lines:
            best = np.maximum(best, self.down_on_line(follower, u[:, 0], start, end))
        return best

    def down_on_line(self, follower, u, start, end):
        along = (end - start) / abs(end - start)
        normal = (1j if self.mirrored else -1j) * along
        level = (np.conj(normal) * start).real + follower.radius
        with np.errstate(invalid="ignore", divide="ignore"):
            if follower.kind == "swinging-roller":
                # (a u − l u e^{iτψ})·n = level: a cosine of τψ + arg(u/n).
                turn = np.angle(u * np.conj(normal))
                cosine = (follower.pivot * np.cos(turn) - level) / follower.arm
                both = [np.angle(np.exp(1j * (follower.side * (sign * np.arccos(cosine) - turn)))) for sign in (1, -1)]
                candidates = both
            else:
                local = normal * np.conj(u)
                candidates = [(level - follower.offset * local.imag) / local.real]
            best = np.full(len(u), -math.inf)
            for height in candidates:
                arm = follower.arm * np.exp(1j * follower.side * height)
                at = u * (follower.pivot - arm if follower.kind == "swinging-roller" else height + 1j * follower.offset)
                share = (np.conj(along) * (at - start)).real
                good = (share >= -1e-9) & (share <= abs(end - start) + 1e-9) & np.isfinite(height)
                best = np.where(good, np.maximum(best, height), best)
        return best

    def support(self, normal):
        """Farthest of the outline along directions, and how far beside the shaft it is there."""
        n = normal[:, None]
        corner = (np.conj(n) * self.start).real
        outer = self.radius > 0
        good = np.abs(np.angle(n * np.conj(self.middle[outer]))) <= self.half[outer] + 1e-9
        arcs = np.where(good, (np.conj(n) * self.centre[outer]).real + self.radius[outer], -math.inf)
        values = np.concatenate([corner, arcs], axis=1)
        best = values.argmax(axis=1)
        places = np.concatenate([np.broadcast_to(self.start, corner.shape), self.centre[outer] + self.radius[outer] * n], axis=1)
        rows = np.arange(len(normal))
        return values[rows, best], (np.conj(1j * normal) * places[rows, best]).real

    def lift(self, follower, theta, expected):
        """Lift of the follower on the outline, mm or rad; `expected` is where the search for a swinging face begins."""
        if follower.circle:
            start = follower.start if follower.kind == "swinging-roller" else follower.height
            return self.let_down(follower, theta) - start
        if follower.kind == "flat":
            return (self.support(np.exp(1j * (theta + follower.tilt)))[0] - follower.base) / math.cos(follower.tilt)
        psi = follower.start + expected
        for _ in range(4):
            normal = np.exp(1j * (theta + follower.side * (psi - PI / 2)))
            p, q = self.support(normal)
            psi = psi - (follower.pivot * np.sin(psi) - follower.away - p) / (follower.pivot * np.cos(psi) - follower.side * q)
        return psi - follower.start
