"""Outlines of cubic splines as written, by ezdxf and numpy: nothing of camgen.

The SPLINEs of a DXF file are evaluated from their knots and control points by de Boor's recursion. The roller of disc.py, placed
by the law, misses them by no more than the tolerance; they are tangent to what is beside them and have no step of curvature within;
area and length are those of the file of arcs to 1e-6, and the STEP solid has the area times the thickness to 1e-9.

usage: spline.py CAMGEN_BINARY DIRECTORY
"""
import json
import math
import subprocess
import sys
from pathlib import Path

import ezdxf
import numpy as np
from disc import Disc, roll
from felt import Roller, of_disc
from outline import Chain, polyline

DPI = dict(mass=978.2, r=0.18, k=1.35, q=2.0, column="matched", lead=0.0, kind="run-up", width=math.radians(20), roller=0.03,
           offset=0.0, lever=1.0, lobes=1, preload=None, follower_mass=None, ccw=False)
THICKNESS = 30.0


class Spline:
    """A cubic SPLINE as its group codes tell it."""

    def __init__(self, entity):
        self.knots, self.controls = np.array(entity.knots), np.array([(p[0], p[1]) for p in entity.control_points])
        count = len(self.controls)
        assert entity.dxf.degree == 3 and len(entity.weights) == 0 and len(self.knots) == count + 4
        assert (self.knots[:4] == self.knots[0]).all() and (self.knots[-4:] == self.knots[-1]).all()
        assert (np.diff(self.knots[3:-3]) > 0).all(), "simple knots within"
        self.low, self.high = self.knots[0], self.knots[-1]
        self.derivatives = [(self.knots, self.controls)]
        for degree in (3, 2):
            knots, controls = self.derivatives[-1]
            width = knots[degree + 1:-1] - knots[1:-degree - 1]
            self.derivatives.append((knots[1:-1], degree * np.diff(controls, axis=0) / width[:, None]))

    def at(self, t, order=0):
        knots, controls = self.derivatives[order]
        degree = 3 - order
        span = np.clip(np.searchsorted(knots, t, side="right") - 1, degree, len(controls) - 1)
        d = np.array([controls[span - degree + j] for j in range(degree + 1)])
        for level in range(1, degree + 1):
            for j in range(degree, level - 1, -1):
                low, high = knots[span - degree + j], knots[span + j - level + 1]
                share = ((t - low) / (high - low))[:, None]
                d[j] = (1 - share) * d[j - 1] + share * d[j]
        return d[degree]

    def gauss(self, f):
        """∫ f over the spans, by 20 points each."""
        x, w = np.polynomial.legendre.leggauss(20)
        spans = np.unique(self.knots)
        half = np.diff(spans) / 2
        t = (spans[:-1] + half)[:, None] + half[:, None] * x
        return float((f(t.ravel()).reshape(t.shape) * w * half[:, None]).sum())

    def length(self):
        return self.gauss(lambda t: np.hypot(*self.at(t, 1).T))

    def area(self):
        cross = lambda p, v: p[:, 0] * v[:, 1] - p[:, 1] * v[:, 0]
        return 0.5 * self.gauss(lambda t: cross(self.at(t), self.at(t, 1)))

    def heading(self, t):
        v = self.at(np.array([t]), 1)[0]
        return math.atan2(v[1], v[0])

    def curvature_steps(self):
        """Largest step of the curvature at a knot within, over the largest curvature."""
        inner = np.unique(self.knots)[1:-1]
        if len(inner) == 0:
            return 0.0

        def curvature(t):
            v, a = self.at(t, 1), self.at(t, 2)
            return (v[:, 0] * a[:, 1] - v[:, 1] * a[:, 0]) / np.hypot(*v.T) ** 3

        near = 1e-9 * (self.high - self.low)
        before, after = curvature(inner - near), curvature(inner + near)
        return np.abs(after - before).max() / np.abs(before).max()

    def distance(self, points):
        t = np.linspace(self.low, self.high, 200 * len(self.controls))
        all_points = self.at(t)
        nearest = np.array([np.argmin(((all_points - p) ** 2).sum(axis=1)) for p in points])
        t = t[nearest]
        for _ in range(8):
            off, v, a = self.at(t) - points, self.at(t, 1), self.at(t, 2)
            t = np.clip(t - (off * v).sum(axis=1) / ((v * v).sum(axis=1) + (off * a).sum(axis=1)), self.low, self.high)
        return np.hypot(*(self.at(t) - points).T)

    ends = property(lambda self: (self.at(np.array([self.low]))[0], self.at(np.array([self.high]))[0]))
    headings = property(lambda self: (self.heading(self.low), self.heading(self.high)))


class Arc:
    def __init__(self, entity):
        self.centre, self.radius = np.array(entity.dxf.center.xyz[:2]), entity.dxf.radius
        self.low, self.high = math.radians(entity.dxf.start_angle), math.radians(entity.dxf.end_angle)
        self.sweep = (self.high - self.low) % (2 * math.pi)

    def on(self, angle):
        return self.centre + self.radius * np.array([math.cos(angle), math.sin(angle)])

    ends = property(lambda self: (self.on(self.low), self.on(self.high)))
    headings = property(lambda self: (self.low + math.pi / 2, self.high + math.pi / 2))

    def length(self):
        return self.radius * self.sweep

    def area(self):
        a, b = self.ends
        return 0.5 * ((a[0] * b[1] - a[1] * b[0]) + self.radius**2 * (self.sweep - math.sin(self.sweep)))

    def distance(self, points):
        away = points - self.centre
        angle = (np.arctan2(away[:, 1], away[:, 0]) - self.low) % (2 * math.pi)
        ends = np.min([np.hypot(*(points - end).T) for end in self.ends], axis=0)
        return np.where(angle <= self.sweep, np.abs(np.hypot(*away.T) - self.radius), ends)


class Outline:
    """Every curve of CAM_PROFILE, in the order of the file, which runs round once."""

    def __init__(self, path):
        document = ezdxf.readfile(path)
        audit = document.audit()
        assert not audit.errors and not audit.fixes, "ezdxf finds faults"
        found = [e for e in document.modelspace() if e.dxf.layer == "CAM_PROFILE"]
        assert {e.dxftype() for e in found} <= {"SPLINE", "ARC"}, "SPLINE and ARC only"
        self.curves = [Spline(e) if e.dxftype() == "SPLINE" else Arc(e) for e in found]
        self.splines = [c for c in self.curves if isinstance(c, Spline)]
        self.spans = sum(len(s.controls) - 3 for s in self.splines)
        gap, kink = 0.0, 0.0
        for a, b in zip(self.curves, self.curves[1:] + self.curves[:1]):
            gap = max(gap, float(np.hypot(*(a.ends[1] - b.ends[0]))))
            turn = b.headings[0] - a.headings[1]
            kink = max(kink, abs((turn + math.pi) % (2 * math.pi) - math.pi))
        assert gap < 1e-9 and kink < 1e-9, f"gap {gap} mm, kink {kink} rad"
        assert max((s.curvature_steps() for s in self.splines), default=0) < 1e-6, "steps of curvature within a spline"

    def area(self):
        return sum(curve.area() for curve in self.curves)

    def length(self):
        return sum(curve.length() for curve in self.curves)

    def distance(self, points):
        return np.min([curve.distance(points) for curve in self.curves], axis=0)


def solid_volume(path):
    """Volume of a valid closed solid by OpenCASCADE, or None where that is not installed."""
    try:
        from OCP.BRepCheck import BRepCheck_Analyzer
        from OCP.BRepGProp import BRepGProp
        from OCP.GProp import GProp_GProps
        from OCP.STEPControl import STEPControl_Reader
    except ImportError:
        return None
    reader = STEPControl_Reader()
    reader.ReadFile(str(path))
    checks = reader.WS().Model().GlobalCheck(True)
    assert checks.NbFails() == 0 and checks.NbWarnings() == 0, "messages on loading"
    reader.TransferRoots()
    shape = reader.OneShape()
    assert BRepCheck_Analyzer(shape).IsValid(), "not a valid solid"
    properties = GProp_GProps()
    BRepGProp.VolumeProperties_s(shape, properties, 1e-12)
    return properties.Mass()


def gate(binary, directory, name, tolerance, args, changes):
    def written(kind):
        stem = f"spline-{name}-{kind}".replace(" ", "-")
        command = [binary, "rotary", "--rpm", "35", "--outline", kind, "--tolerance", f"{tolerance * 1e3}um", "--json", "--format",
                   "dxf,step", "--out", str(directory), "--name", stem, *args]
        run = subprocess.run(command, capture_output=True, text=True)
        assert run.returncode == 0, run.stderr + run.stdout
        return directory / stem, json.loads(run.stdout)

    (spline_stem, report), (arcs_stem, arcs_report) = written("spline"), written("arcs")
    outline = Outline(spline_stem.with_suffix(".dxf"))
    told = report["outline"]
    assert (told["splines"], told["spans"], told["arcs"]) == (
        len(outline.splines), outline.spans, len(outline.curves) - len(outline.splines)), told
    disc = Disc({**DPI, **changes}, 35.0, report["cam"]["prime_radius_mm"] * 1e-3)
    gap, _, _ = roll(disc, outline)
    assert gap <= tolerance * (1 + 1e-9), f"the roller is {gap} mm off"
    assert gap <= told["deviation_max_mm"] + 1e-9, f"{gap} mm off, told {told['deviation_max_mm']}"
    # As cut: the roller follows the circle of curvature of the written spline at each of its places.
    follower, law, flip = Roller(1e3 * disc.rf, 1e3 * disc.prime, 1e3 * disc.eps), of_disc(disc), -1.0 if disc.m["ccw"] else 1.0
    worst = 0.0
    for spline in outline.splines:
        t = np.linspace(spline.low, spline.high, 60 * len(spline.controls))[1:-1]
        for p, v, a in zip(spline.at(t), spline.at(t, 1), spline.at(t, 2)):
            normal = np.array([v[1], -v[0] * flip]) / np.hypot(*v)
            point, radius = p * [1, flip], np.hypot(*v) ** 3 / (v[0] * a[1] - v[1] * a[0])
            theta = follower.angle(point, normal)
            jet = follower.jet((point - normal * radius, radius, None, None, normal, None), theta)
            worst = max(worst, abs(jet[2] - law(theta)[0](theta)[2]))
    rolling = report["rolling"]
    largest, told_error = rolling["acceleration_of_motion_max_mm_per_rad2"], rolling["acceleration_error_max_mm_per_rad2"]
    # Its ends, where the error is largest, are not among the places.
    assert worst <= told_error * (1 + 1e-6) and worst > 0.9 * told_error, f"acceleration off by {worst}, told {told_error}"
    assert worst <= 0.05 * largest, f"{worst} of {largest}, 5 % asked for"
    chain = Chain(polyline(arcs_stem.with_suffix(".dxf"))[1])
    arcs_length = np.where(chain.is_arc, chain.radius * np.abs(chain.sweep), chain.length).sum()
    # Either outline lies within the tolerance, so that they differ by no more than two of them all round.
    share = max(1e-6, 2 * tolerance * arcs_length / chain.area())
    area, length = outline.area() / chain.area() - 1, outline.length() / arcs_length - 1
    assert abs(area) <= share and abs(length) <= max(1e-6, 2 * math.pi * 2 * tolerance / arcs_length), (area, length)
    volume = solid_volume(spline_stem.with_suffix(".step"))
    off = abs(volume / (report["cam"]["area_mm2"] * THICKNESS) - 1) if volume is not None else 0.0
    assert off <= 1e-9, f"volume {volume}"
    return outline.spans, arcs_report["outline"]["arcs"], gap * 1e3, area, length, off


def main():
    binary, directory = Path(sys.argv[1]).resolve(), Path(sys.argv[2])
    directory.mkdir(parents=True, exist_ok=True)
    cases = [
        ("plain", 0.005, [], {}),
        ("coarse", 0.05, [], {}),
        ("fine", 0.0005, [], {}),
        ("finest", 0.00002, [], {}),
        ("turned", 0.005, ["--set", "cam.rotation=ccw", "--set", "follower.roller.offset=10mm"], dict(ccw=True, offset=0.01)),
        ("blend", 0.005, ["--set", "transition.kind=blend"], dict(kind="blend")),
    ]
    print(f"{'splines':10} {'spans':>5} {'arcs':>5} {'gap/µm':>9} {'area':>9} {'length':>9} {'volume':>9}")
    failed = 0
    for name, tolerance, args, changes in cases:
        try:
            spans, arcs, gap, area, length, volume = gate(binary, directory, name, tolerance, args, changes)
            print(f"{name:10} {spans:5} {arcs:5} {gap:9.5f} {area:9.1e} {length:9.1e} {volume:9.1e}")
        except AssertionError as error:
            failed += 1
            print(f"{name:10} FAILED: {error}")
    # R12 has no SPLINE: refused, with the reason.
    run = subprocess.run([binary, "rotary", "--rpm", "35", "--outline", "spline", "--dxf-version", "r12", "--out", str(directory)],
                         capture_output=True, text=True)
    if run.returncode != 2 or "R12 has no SPLINE" not in run.stderr:
        failed += 1
        print(f"r12        FAILED: {run.returncode} {run.stderr}")
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
