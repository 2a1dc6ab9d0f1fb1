"""Tries to get a wrong file accepted and a right one refused by `camgen check`.

The exact outline is a file camgen wrote a thousand times finer than the tolerance (roll.py, plate.py and make.py prove such
files). It is walked here by arc length, deformed along its normal by known amounts, and written as biarcs, lines or splines by
a DXF writer of its own; whatever else would be cut is added, moved or taken away. Each class of fault has a generator; a
file counts as wrong when it is by construction at least 1.01 tolerances off (or not one simple loop, or not this part), as
right when it stays within 0.99 of it with kinks of at most 0.05 degrees, or kinks that rounding to a few decimals explains. Other layers
and blocks, exact doubles and units that are stated rightly leave a file right; a right file in inches or centimetres must pass with a
warning on its unit alone. Solids are moved, turned and doubled by OpenCASCADE, which also says where they lie.

usage: adversary.py CAMGEN_BINARY DIRECTORY [--wrong N] [--right N] [--units N] [--solids N]
                    [--seed N] [--jobs N]
"""
import argparse
import json
import math
import random
import subprocess
import sys
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
from dxf_text import Drawing, put, spline_entity
from outline import polyline
from shapes import (
    Exact, backtrack, biarcs, bumped, deformed, loop, nodes, slot, smooth_place, step, stretch, transformed,
)

FINE = 1e-3  # of the tolerance


class Case:
    def __init__(self, binary, directory, name, command, kind, tolerance, keyway=None, bore=25.0, section=None):
        self.name, self.kind, self.tolerance, self.keyway, self.bore = name, kind, tolerance, keyway, bore
        fine = directory / "exact"
        make = [binary, *command, "--tolerance", f"{FINE * tolerance * 1e3}um", "--format", "dxf", "--out", fine,
                "--name", name, "--json", "--force"]
        run = subprocess.run([str(word) for word in make], capture_output=True, text=True)
        assert run.returncode in (0, 1), f"{name}: {run.stderr}"
        files = json.loads(run.stdout)["files"]
        path = next(f for f in files if section is None or f.endswith(f"-{section}rpm.dxf"))
        document, vertices = polyline(path)
        self.exact = Exact(vertices)
        self.vertices = vertices
        self.holes = [e for e in document.modelspace() if e.dxf.layer != "CAM_PROFILE"]
        words = [word for word in command[1:] if word not in ("--force",)]
        # Without a machine it would look for the design of the file.
        words = words if words and not words[0].startswith("--") else ["dpi", *words]
        self.check = ["check", *words, *([] if kind == "rotary" else ["--cam", kind]), "--tolerance", f"{tolerance * 1e3}um"]
        self.check += ["--section", str(section)] if section else []

    def draw_holes(self, drawing, layer="BORE", move=(0.0, 0.0), scale=1.0, rng=None, skip=False, turn=0.0, widen=0.0):
        if skip:
            return
        for hole in self.holes:
            if hole.dxftype() == "CIRCLE":
                centre = (hole.dxf.center.x + move[0], hole.dxf.center.y + move[1])
                drawing.circle(layer, centre, hole.dxf.radius * scale + widen)
            else:
                points = np.array(hole.get_points("xyb"))
                c, s = math.cos(turn), math.sin(turn)
                turned = points.copy()
                turned[:, 0], turned[:, 1] = c * points[:, 0] - s * points[:, 1], s * points[:, 0] + c * points[:, 1]
                turned[:, :2] = turned[:, :2] * scale + np.array(move)
                drawing.poly(layer, turned)


def cases(binary, directory):
    make = lambda *args, **more: Case(binary, directory, *args, **more)
    key = ["--set", "cam.keyway.width=8mm", "--set", "cam.keyway.depth=3.3mm", "--set", "cam.keyway.angle=90deg"]
    return [
        make("dpi", ["rotary"], "rotary", 0.005),
        make("dpi-fine", ["rotary"], "rotary", 0.0005),
        make("dpi-finest", ["rotary"], "rotary", 0.00005),
        make("paper", ["rotary", "dpi-paper"], "rotary", 0.04),
        make("key", ["rotary", *key], "rotary", 0.005, keyway=True),
        make("ccw", ["rotary", "--set", "cam.rotation=ccw", "--set", "follower.roller.offset=15mm", "--set",
                     "buffer.column=return"], "rotary", 0.005),
        make("blend", ["rotary", "--set", "transition.kind=blend", "--set", "transition.width=30deg"], "rotary", 0.005),
        make("plate", ["translating"], "translating", 0.005),
    ]


def amount(rng, tolerance, low=1.01, high=8.0):
    """A size just above the tolerance more often than far above it, of either sign."""
    return tolerance * (low + (high - low) * rng.random() ** 4) * rng.choice([-1, 1])


def count(rng, most=50_000):
    return int(10 ** rng.uniform(1, math.log10(most)) if rng.random() < 0.15 else 10 ** rng.uniform(1.7, 3.6))


# ---- wrong files: each gives a title and a drawing


def wrong(case, rng):
    tolerance, exact = case.tolerance, case.exact
    drawing = Drawing()
    plain = lambda: put(drawing, case.vertices, rng, how="lw")
    holes = case.draw_holes
    kinds = ["bump", "bump", "bump", "slot", "fin", "loop", "backtrack", "step", "moved", "open", "stray", "block",
             "height", "width", "unknown-unit", "second", "hidden", "frame", "grid", "elsewhere", "kink", "inverted", "lost", "misreversed", "decimals", "layer", "wrong-unit"]
    if case.kind == "rotary":
        kinds += ["hole", "hole", "through", "none", "chords"]
    kind = rng.choice(kinds)
    title = kind
    if kind == "bump":
        half = 10 ** rng.uniform(-2, 1.2)
        a = amount(rng, tolerance)
        half = max(half, 4 * abs(a))
        n = max(count(rng), int(exact.total / 2) + 3)
        title = f"bump {a / tolerance:.3f} tol, half width {half:.4f} mm, {n} segments"
        put(drawing, bumped(case, rng, a, half, n), rng)
        holes(drawing)
    elif kind in ("slot", "fin"):
        width = 10 ** rng.uniform(-1.3, 0.3)
        lip = width * rng.uniform(0.05, 0.5)
        depth = 10 ** rng.uniform(-1, 2.2) if kind == "slot" else 10 ** rng.uniform(-1, 1.5)
        title = f"{kind} {width:.3f} × {depth:.3f} mm, lips {lip:.3f}"
        put(drawing, slot(case, rng, width, depth, lip, kind == "slot"), rng)
        holes(drawing)
    elif kind == "loop":
        radius = tolerance * 10 ** rng.uniform(-0.6, 1)
        title = f"loop of radius {radius / tolerance:.3f} tol"
        put(drawing, loop(case, rng, radius, rng.random() < 0.5), rng, how=rng.choice(["lw", "old", "reversed"]))
        holes(drawing)
    elif kind == "backtrack":
        by = 10 ** rng.uniform(-1, 1.5)
        title = f"backtrack by {by:.3f} mm"
        put(drawing, backtrack(case, rng, by), rng, how=rng.choice(["lw", "old", "reversed"]))
        holes(drawing)
    elif kind == "step":
        a = amount(rng, tolerance)
        length, ramp = 10 ** rng.uniform(-1, 1.5), 10 ** rng.uniform(-1, 1)
        title = f"step {a / tolerance:.3f} tol over {length:.3f} mm"
        put(drawing, step(case, rng, a, length, max(ramp, 20 * abs(a))), rng)
        holes(drawing)
    elif kind == "kink":
        # A tooth with straight sides: within the tolerance, with kinks beyond 0.05 degrees.
        a = rng.uniform(0.3, 0.9) * tolerance
        half = a / math.radians(rng.uniform(0.12, 40)) + 2e-6
        middle = smooth_place(case, rng, half)
        points, _, _ = exact.walk([middle - half, middle, middle + half])
        _, heading, _ = exact.walk([middle])
        points[1] += a * np.array([-math.sin(heading[0]), math.cos(heading[0])])
        tooth = np.column_stack([points[:2], [0, 0]])
        title = f"tooth {a / tolerance:.3f} tol, {math.degrees(a / half):.3f} deg"
        put(drawing, np.concatenate([tooth, stretch(case, middle + half, middle - half)[:-1]]), rng)
        holes(drawing)
    elif kind == "moved":
        how = rng.choice(["turned", "shifted", "scaled", "mirrored", "inch"])
        reach = np.abs(case.vertices[:, :2]).max()
        a = amount(rng, tolerance, 1.6, 40)
        if how == "turned":
            # A disc that is turned shows as its radius times its slope only; far enough for every cam here.
            change = dict(angle=a / tolerance * 0.02)
        elif how == "shifted":
            change = dict(shift=(a * 1.2, 0) if rng.random() < 0.5 else (0, a * 1.2))
        elif how == "scaled":
            change = dict(factor=1 + a / reach)
        elif how == "mirrored":
            change = dict(mirror=True)
        else:
            change = dict(factor=rng.choice([25.4, 1 / 25.4, 10, 0.1]))
        if how == "mirrored" and case.kind != "rotary":
            # A plate is its own mirror image.
            change = dict(shift=(0, 2 * abs(a)))
        title = f"{how} {change}"
        put(drawing, transformed(case.vertices, **change), rng, how="lw")
        holes(drawing)
    elif kind == "open":
        gap = tolerance * 10 ** rng.uniform(0.1, 3)
        middle = smooth_place(case, rng, gap)
        title = f"open by {gap / tolerance:.2f} tol"
        drawing.poly("CAM_PROFILE", stretch(case, middle + gap, middle).tolist(), closed=False)
        holes(drawing)
    elif kind == "stray":
        plain()
        holes(drawing)
        layer = rng.choice(["0", "BORE", "NOTES", "Defpoints2", "CAM_PROFILE"])
        what = rng.choice(["LINE", "CIRCLE", "ARC", "ELLIPSE", "LWPOLYLINE", "SPLINE", "POLYLINE"])
        x, y, r = rng.uniform(-150, 150), rng.uniform(-150, 150), rng.uniform(0.5, 60)
        title = f"stray {what} on {layer}"
        if what == "LINE":
            drawing.entity("LINE", layer, (10, x), (20, y), (11, x + r), (21, y - r))
        elif what == "CIRCLE":
            drawing.circle(layer, (x, y), r)
        elif what == "ARC":
            drawing.entity("ARC", layer, (10, x), (20, y), (40, r), (50, 10.0), (51, 200.0))
        elif what == "ELLIPSE":
            drawing.entity("ELLIPSE", layer, (10, x), (20, y), (30, 0.0), (11, r), (21, 0.0), (31, 0.0), (40, 0.4),
                           (41, 0.0), (42, 2 * math.pi))
        elif what == "SPLINE":
            knots = [(40, float(k)) for k in (0, 0, 0, 0, 1, 1, 1, 1)]
            points = [pair for i in range(4) for pair in ((10, x + i * r), (20, y + (i % 2) * r), (30, 0.0))]
            drawing.entity("SPLINE", layer, (70, "8"), (71, "3"), (72, "8"), (73, "4"), (74, "0"), *knots, *points)
        else:
            drawing.poly(layer, [(x, y, 0.0), (x + r, y, 0.3), (x, y + r, 0.0)], closed=rng.random() < 0.5,
                         old=what == "POLYLINE")
    elif kind == "block":
        plain()
        holes(drawing)
        inner = rng.choice(["outline", "circle", "nested"])
        title = f"block with {inner}"
        if inner == "outline":
            put_block = transformed(case.vertices, angle=0.4)
            drawing.poly(rng.choice(["0", "CAM_PROFILE"]), put_block.tolist(), block="PART")
        else:
            drawing.circle("0", (30, 20), 12, block="PART")
        name = "PART"
        if inner == "nested":
            drawing.entity("INSERT", "0", (2, "PART"), (10, 5.0), (20, 5.0), block="OUTER")
            name = "OUTER"
        drawing.entity("INSERT", rng.choice(["0", "NOTES"]), (2, name), (10, rng.uniform(-20, 20)), (20, 0.0))
    elif kind == "height":
        holes(drawing)
        z = rng.choice([7.0, 0.5, -3.0])
        title = f"part of the outline at height {z}"
        vertices = case.vertices.tolist()
        lifted = set(rng.sample(range(len(vertices)), max(1, len(vertices) // 3)))
        for i, (p, q) in enumerate(zip(vertices, vertices[1:] + vertices[:1])):
            extra = [(30, z), (31, z)] if i in lifted else []
            if extra and abs(p[2]) >= 1e-9:
                extra = [(30, z)]
            drawing.segment("CAM_PROFILE", p[:2], q[:2], p[2], rng, None, extra)
    elif kind == "width":
        holes(drawing)
        title = "a wide polyline"
        w = rng.choice([3.0, 0.5])
        extra = [(43, w)]
        drawing.poly("CAM_PROFILE", case.vertices.tolist(), extra=extra)
    elif kind == "unknown-unit":
        title = "a unit whose size is not known"
        drawing.unit = rng.choice([3, 7, 11, 17, 21])
        plain()
        holes(drawing)
    elif kind == "hidden":
        # A shop would not cut it, with or without a contour that it would cut.
        layer = rng.choice(["CAM_PROFILE", "CONTOUR"])
        title = f"outline on hidden layer {layer}"
        put(drawing, case.vertices, rng, how="lw", layer=layer)
        drawing.layers = {layer: rng.choice([(-3, 0), (3, 1)])}
        holes(drawing)
        if rng.random() < 0.4:
            put(drawing, transformed(case.vertices, factor=0.9), rng, how="lw", layer="0")
    elif kind == "frame":
        title = "a closed contour around the outline"
        reach = 1.3 * np.abs(case.vertices[:, :2]).max()
        put(drawing, case.vertices, rng, how="lw", layer=rng.choice(["CAM_PROFILE", "0"]))
        holes(drawing)
        corners = [(-reach, -reach, 0.0), (reach, -reach, 0.0), (reach, reach, 0.0), (-reach, reach, 0.0)]
        drawing.poly(rng.choice(["0", "FRAME", "CAM_PROFILE"]), corners)
    elif kind == "grid":
        # On a grid of a tenth of the tolerance and less, with one vertex off by more than that.
        decimals = max(3, int(math.ceil(-math.log10(0.1 * tolerance))))
        a = amount(rng, tolerance, 1.3, 20)
        vertices = np.array(case.vertices)
        index = rng.randrange(len(vertices))
        vertices[index, :2] *= 1 + a / np.hypot(*vertices[index, :2])
        title = f"{decimals} decimals, a vertex off by {a / tolerance:.2f} tol"
        put(drawing, np.column_stack([np.round(vertices[:, :2], decimals), vertices[:, 2]]), rng, how="lw")
        holes(drawing)
    elif kind == "elsewhere":
        # The outline on another layer, and something else where it should be.
        title = "something else on the layer of the outline"
        put(drawing, case.vertices, rng, how="lw", layer="CONTOUR")
        holes(drawing)
        drawing.circle("CAM_PROFILE", (0.0, 0.0), case.bore * rng.uniform(0.2, 0.8))
    elif kind == "wrong-unit":
        # Inches called centimetres, and so on: the size is wrong.
        unit, factor = rng.choice([(1, 10.0), (5, 25.4), (6, 25.4), (4, 25.4), (4, 10.0), (0, 25.4)])
        title = f"wrong-unit {unit} of sizes over {factor}"
        drawing.unit = unit
        put(drawing, transformed(case.vertices, factor=1 / factor), rng, how="lw")
        holes(drawing, scale=1 / factor)
    elif kind in ("inverted", "lost", "misreversed"):
        title = f"{kind} bulges"
        put(drawing, misbulged(case.vertices, kind, rng), rng, how="lw")
        holes(drawing)
    elif kind == "decimals":
        # Rounded so far that the vertices are many tolerances off.
        decimals = int(math.floor(-math.log10(40 * tolerance)))
        title = f"decimals {decimals}"
        rounded = np.column_stack([np.round(case.vertices[:, :2], decimals), case.vertices[:, 2]])
        put(drawing, rounded, rng, how="lw")
        holes(drawing)
    elif kind == "layer":
        # On another layer, and more than the part would be cut.
        title = "layer of another name"
        put(drawing, case.vertices, rng, how="lw", layer=rng.choice(["0", "CONTOUR", "CAM_PROFIL"]))
        holes(drawing)
        drawing.circle("NOTES", (0.0, 0.0), case.bore * 0.3)
    elif kind == "second":
        plain()
        holes(drawing)
        by = rng.choice([max(0.05 * tolerance, 1e-5), 0.5 * tolerance, 30 * tolerance])
        title = f"the outline twice, {by / tolerance:.2f} tol apart"
        put(drawing, transformed(case.vertices, shift=(by, 0.0)), rng, how="lw", layer=rng.choice(["CAM_PROFILE", "0"]))
    elif kind == "hole":
        plain()
        how = rng.choice(["moved", "wider", "scaled"] + (["turned"] if case.keyway else []))
        a = amount(rng, tolerance, 1.02, 300)
        title = f"bore {how} by {a / tolerance:.2f} tol"
        if how == "moved":
            angle = rng.uniform(0, 2 * math.pi)
            holes(drawing, move=(a * math.cos(angle) * 1.01, a * math.sin(angle) * 1.01))
        elif how == "turned":
            # The corner of the keyway at about 28 mm moves by 1.5 times this.
            holes(drawing, turn=math.copysign(abs(a) * 1.5 / 25, a))
        else:
            if case.keyway:
                holes(drawing, scale=1 + 1.5 * a / case.bore)
            else:
                holes(drawing, widen=a)
    elif kind == "through":
        plain()
        holes(drawing)
        title = "a circle of 60 mm through the profile"
        (p,), _, _ = exact.walk([rng.random() * exact.total])
        drawing.circle(rng.choice(["BORE", "HOLES", "0"]), p, 30.0)
    elif kind == "none":
        plain()
        title = "no bore"
    elif kind == "chords":
        # Lines with kinks beyond 0.05 degrees, or too coarse for the tolerance.
        n = int(10 ** rng.uniform(1, 3.6))
        s = (np.arange(n) + rng.random()) * exact.total / n
        points, _, _ = exact.walk(s)
        title = f"{n} chords"
        put(drawing, np.column_stack([points, np.zeros(n)]), rng)
        holes(drawing)
    return title, drawing.text()


def misbulged(vertices, kind, rng):
    """The vertices of the exact outline with bulges as programs get them wrong."""
    wrong = np.array(vertices, dtype=float)
    if kind == "inverted":
        wrong[:, 2] *= -1
    elif kind == "lost":
        # The sharpest is lost where the closing one is a line already.
        index = len(wrong) - 1 if abs(wrong[-1, 2]) > 0.05 else int(np.argmax(np.abs(wrong[:, 2])))
        wrong[index, 2] = 0.0
    else:
        sign = rng.choice([1.0, -1.0])
        wrong = wrong[::-1].copy()
        wrong[:, 2] *= sign
    return wrong


# ---- right files in other units: a warning on the unit


def in_units(case, rng):
    drawing = Drawing()
    unit, factor, name = rng.choice([(1, 25.4, "inches"), (5, 10.0, "centimetres"), (6, 1e3, "metres"), (14, 100.0, "decimetres")])
    drawing.unit = unit
    put(drawing, transformed(case.vertices, factor=1 / factor), rng, how="lw")
    case.draw_holes(drawing, scale=1 / factor)
    return name, drawing.text()


# ---- right files


def deviation(case, vertices, s, closed=True):
    """Largest distance of the chain from the exact outline near the places its vertices were made for."""
    got = Exact(vertices)
    worst = 0.0
    for share in np.linspace(0, 1, 9):
        p, _, _ = got.walk(got.at[:-1] + share * got.length)
        # The foot: from the arc length of the first vertex of each pair of arcs, by Newton.
        guess = np.repeat(s, 2)[: len(p)] + 0.0
        ahead = np.repeat(np.mod(np.diff(np.concatenate([s, [s[0] + case.exact.total]])), case.exact.total), 2)[: len(p)]
        guess = guess + ahead * (np.tile([0.0, 0.5], len(p) // 2 + 1)[: len(p)] + 0.5 * share)
        for _ in range(8):
            q, h, k = case.exact.walk(guess)
            t = np.stack([np.cos(h), np.sin(h)], axis=1)
            guess = guess + ((p - q) * t).sum(axis=1)
        q, h, _ = case.exact.walk(guess)
        worst = max(worst, np.hypot(*(p - q).T).max())
    return worst


def right(case, rng):
    tolerance, exact = case.tolerance, case.exact
    drawing = Drawing()
    holes_done = False
    kinds = ["own", "insert", "information", "reversed", "doubled", "layers", "one-layer", "blocks", "grid"]
    if case.kind == "rotary":
        kinds += ["biarcs", "biarcs", "wave", "wave", "lines", "spline", "rounded"]
    kind = rng.choice(kinds)
    title = kind
    if kind in ("biarcs", "wave", "spline", "rounded"):
        while True:
            n = count(rng)
            s = nodes(exact, n, rng)
            share = rng.uniform(0.2, 0.97) if kind == "wave" else 0.0
            waves = rng.randint(1, max(1, n // 24))
            phase = rng.random() * 2 * math.pi
            w = 2 * math.pi * waves / exact.total
            offset = share * tolerance * np.sin(w * s + phase)
            slope = share * tolerance * w * np.cos(w * s + phase)
            points, headings = deformed(exact, s, offset, slope)
            vertices = biarcs(points, headings)
            if deviation(case, vertices, s) <= 0.99 * tolerance - (2e-6 if kind == "rounded" else 0):
                break
        title = f"{kind}, {len(vertices)} segments, {share:.3f} tol"
        if kind == "rounded":
            # Six decimals turn headings of short segments; they are long enough here for 0.05 degrees.
            if np.hypot(*np.diff(points, axis=0).T).min() < 0.02:
                put(drawing, case.vertices, rng, how="lw")
            else:
                put(drawing, np.round(vertices, 6), rng, how="lw")
        elif kind == "spline":
            lengths = np.diff(np.concatenate([s, [s[0] + exact.total]]))
            lengths = np.mod(lengths, exact.total)
            if n < 200:
                n = 400
                s = nodes(exact, n, rng)
                points, headings, _ = exact.walk(s)
                lengths = np.mod(np.diff(np.concatenate([s, [s[0] + exact.total]])), exact.total)
            if exact.total / len(s) > 2:
                put(drawing, vertices, rng)
            else:
                spline_entity(drawing, "CAM_PROFILE", points, headings, lengths)
        else:
            put(drawing, vertices, rng)
    elif kind == "lines":
        # Kinks of at most 0.05 degrees need 7200 chords and more; curvature varies, so by heading.
        fine = np.linspace(0, exact.total, 200_001)
        _, heading, k = exact.walk(fine[:-1])
        turning = np.concatenate([[0.0], np.cumsum(np.abs(k) * np.diff(fine))])
        n = rng.randint(int(turning[-1] / math.radians(0.045)) + 1, 30_000)
        sag = np.interp(np.linspace(0, turning[-1], n + 1), turning, fine)
        s = np.unique(np.concatenate([sag[:-1], np.arange(0, exact.total, math.sqrt(4 * tolerance * 60))]))
        s = s[np.concatenate([[True], np.diff(s) > 1e-3])]
        points, _, _ = exact.walk(s)
        title = f"{len(s)} lines"
        put(drawing, np.column_stack([points, np.zeros(len(s))]), rng, how=rng.choice(["lw", "old", "exploded"]))
    elif kind == "insert":
        drawing.poly(rng.choice(["0", "CAM_PROFILE"]), transformed(case.vertices, shift=(-7.5, 3.25)).tolist(), block="CAM")
        drawing.entity("INSERT", "CAM_PROFILE", (2, "CAM"), (10, 7.5), (20, -3.25))
        drawing.layers = {"CAM_PROFILE": (7, 0)}
    elif kind == "doubled":
        put(drawing, case.vertices, rng, how="lw")
        put(drawing, case.vertices, rng, how=rng.choice(["lw", "reversed"]), layer=rng.choice(["CAM_PROFILE", "0"]))
    elif kind == "layers":
        # Without the layer of the outline the outermost contour is it; names of layers have no capitals.
        layer = rng.choice(["0", "CONTOUR", "cam_profile"])
        title = f"outline on layer {layer}"
        put(drawing, case.vertices, rng, how=rng.choice(["lw", "exploded"]), layer=layer)
        case.draw_holes(drawing, layer=rng.choice(["bore", "0", layer]))
        holes_done = True
    elif kind == "one-layer":
        put(drawing, case.vertices, rng, how="lw")
        case.draw_holes(drawing, layer="CAM_PROFILE")
        holes_done = True
    elif kind == "blocks":
        drawing.poly("0", transformed(case.vertices, shift=(-7.5, 3.25)).tolist(), block="CAM")
        drawing.entity("INSERT", rng.choice(["0", "PARTS"]), (2, "CAM"), (10, 7.5), (20, -3.25))
    elif kind == "grid":
        # The exact outline is short of segments that rounding kinks by more than it explains.
        shortest = np.hypot(*np.diff(case.vertices[:, :2], axis=0).T).min()
        width = min(0.1 * tolerance, 5e-4 * shortest)
        decimals = max(3, int(math.ceil(-math.log10(width))))
        title = f"vertices with {decimals} decimals"
        put(drawing, np.column_stack([np.round(case.vertices[:, :2], decimals), case.vertices[:, 2]]), rng, how="lw")
    elif kind == "information":
        put(drawing, case.vertices, rng, how="lw")
        drawing.layers = {"OFF": (-3, 0), "FROZEN": (3, 1), "CAM_PROFILE": (7, 0)}
        drawing.circle("OFF", (10, 10), 40)
        drawing.circle("FROZEN", (0, 0), 60)
        drawing.entity("TEXT", "NOTES", (10, 0.0), (20, 0.0), (40, 5.0), (1, "cut from 30 mm plate"))
        drawing.entity("POINT", "NOTES", (10, 3.0), (20, 4.0))
        drawing.entity("LINE", "FRAME", (67, "1"), (10, 0.0), (20, 0.0), (11, 297.0), (21, 0.0))
    else:
        put(drawing, case.vertices, rng, how="reversed" if kind == "reversed" else None)
    if not holes_done:
        case.draw_holes(drawing, layer=rng.choice(["BORE", "BORE", "HOLES"]))
    return title, drawing.text()


def judge(binary, directory, case, number, kind, seed):
    rng = random.Random(f"{seed}-{kind}-{number}")
    title, text = {"wrong": wrong, "right": right, "units": in_units}[kind](case, rng)
    path = directory / f"{kind}-{number % 64}-{number}.dxf"
    path.write_text(text)
    run = subprocess.run([binary, case.check[0], str(path), *case.check[1:], "--json"], capture_output=True, text=True)
    expected = 1 if kind == "wrong" else 0
    good = run.returncode == expected
    if good and kind == "units":
        good = [c["check"] for c in json.loads(run.stdout)["checks"] if c["verdict"] == "warn" and c["check"] == "units"] == ["units"]
    said = ""
    if not good:
        kept = directory / "kept"
        kept.mkdir(exist_ok=True)
        path.rename(kept / path.name)
        try:
            failing = [c for c in json.loads(run.stdout)["checks"] if c["verdict"] == "fail"]
            said = "; ".join(f"{c['check']} {c['value']} > {c['limit']} {c.get('note', '')}" for c in failing)
        except ValueError:
            said = run.stderr
    else:
        path.unlink()
    return good, run.returncode, f"{case.name}: {title}", said, path.name


# ---- solids that lie elsewhere


def written(shape, path):
    """Writes a shape by OpenCASCADE, which gives what has a location a placement."""
    from OCP.STEPControl import STEPControl_AsIs, STEPControl_Writer

    writer = STEPControl_Writer()
    writer.Transfer(shape, STEPControl_AsIs)
    writer.Write(str(path))


def loaded(path):
    """What OpenCASCADE finds in a file: the shape, the number of its solids, and its bounding box."""
    from OCP.Bnd import Bnd_Box
    from OCP.BRepBndLib import BRepBndLib
    from OCP.STEPControl import STEPControl_Reader
    from OCP.TopAbs import TopAbs_SOLID
    from OCP.TopExp import TopExp_Explorer

    reader = STEPControl_Reader()
    reader.ReadFile(str(path))
    reader.TransferRoots()
    shape = reader.OneShape()
    explorer, count = TopExp_Explorer(shape, TopAbs_SOLID), 0
    while explorer.More():
        count += 1
        explorer.Next()
    box = Bnd_Box()
    BRepBndLib.AddOptimal_s(shape, box, False, False)
    return shape, count, np.array(box.Get())


def solids(binary, directory, total, rng):
    from OCP.BRep import BRep_Builder
    from OCP.gp import gp_Ax1, gp_Dir, gp_Pnt, gp_Trsf, gp_Vec
    from OCP.Message import Message, Message_Gravity
    from OCP.TopLoc import TopLoc_Location
    from OCP.TopoDS import TopoDS_Compound

    for printer in Message.DefaultMessenger_s().Printers():
        printer.SetTraceLevel(Message_Gravity.Message_Fail)
    make = [binary, "rotary", "dpi", "--format", "step", "--out", directory, "--name", "solid", "--quiet"]
    assert subprocess.run([str(word) for word in make], capture_output=True).returncode == 0
    own, count, home = loaded(directory / "solid.step")
    assert count == 1
    text = (directory / "solid.step").read_text()
    kinds, failed = Counter(), 0
    for number in range(total):
        path = directory / "placed.step"
        kind = ("home", "shift", "turn", "over", "tilt", "text", "second", "far")[number % 8]
        move, expected = gp_Trsf(), 1
        size = 10 ** rng.uniform(-1.5, 2.7) * rng.choice([-1, 1])
        if kind in ("shift", "turn", "over", "tilt"):
            axis = gp_Ax1(gp_Pnt(0, 0, 0), gp_Dir(*((0, 0, 1) if kind == "turn" else (1, 0, 0))))
            if kind == "shift":
                move.SetTranslation(gp_Vec(*[size if i == number // 8 % 3 else 0.0 for i in range(3)]))
            else:
                move.SetRotation(axis, {"turn": math.radians(rng.uniform(1, 359)), "over": math.pi, "tilt": rng.uniform(0.01, 1.5)}[kind])
        if kind in ("home", "shift", "turn", "over", "tilt"):
            expected = 0 if kind == "home" else 1
            written(own.Moved(TopLoc_Location(move)), path)
        elif kind == "text":
            # A placement in the representation of the solid, as text.
            place, axis = rng.choice([((size, 0, 0), (0, 0, 1)), ((0, 0, size), (0, 0, 1)), ((0, 0, 0), (0, 0, -1)), ((0, 0, 30), (0, 0, -1))])
            items = text.index("ADVANCED_BREP_SHAPE_REPRESENTATION")
            placed = text[:items] + text[items:].replace("(#", "(#900001, #", 1)
            point = lambda values: ", ".join(f"{value:.9f}" for value in values)
            lines = (f"#900001 = AXIS2_PLACEMENT_3D('', #900002, #900003, #900004);\n#900002 = CARTESIAN_POINT('', ({point(place)}));\n"
                     f"#900003 = DIRECTION('', ({point(axis)}));\n#900004 = DIRECTION('', (1., 0., 0.));\n")
            end = placed.rindex("ENDSEC;")
            path.write_text(placed[:end] + lines + placed[end:])
        elif kind == "second":
            move.SetTranslation(gp_Vec(400.0 * rng.choice([0, 1]), 0, 0))
            both, builder = TopoDS_Compound(), BRep_Builder()
            builder.MakeCompound(both)
            builder.Add(both, own)
            builder.Add(both, own.Moved(TopLoc_Location(move)))
            written(both, path)
        else:
            # A point that no entity of the shell uses.
            end = text.rindex("ENDSEC;")
            path.write_text(f"{text[:end]}#900005 = CARTESIAN_POINT('', ({size:.3f}E+100, 0., 0.));\n{text[end:]}")
        _, count, box = loaded(path)
        same = count == 1 and np.abs(box - home).max() < 5e-3
        run = subprocess.run([binary, "check", str(path), "dpi", "--rpm", "35", "--json"], capture_output=True, text=True)
        # Where OpenCASCADE loads something else than the cam in its place, it must be refused; a turn by its box alone is not seen.
        good = run.returncode == expected and not (run.returncode == 0 and not same)
        kinds[kind] += 1
        if not good:
            failed += 1
            kept = directory / "kept"
            kept.mkdir(exist_ok=True)
            path.rename(kept / f"{kind}-{number}.step")
            print(f"  solid {kind}, {size:.4f}: exit {run.returncode}, {count} solids, box {np.round(box, 3)} {run.stderr[:200]}")
    print(f"solids: {total} files, {failed} wrong")
    print("  " + ", ".join(f"{kind} {n}" for kind, n in sorted(kinds.items())))
    return failed


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("binary"), parser.add_argument("directory")
    parser.add_argument("--wrong", type=int, default=600), parser.add_argument("--right", type=int, default=150)
    parser.add_argument("--units", type=int, default=60), parser.add_argument("--solids", type=int, default=60)
    parser.add_argument("--seed", default="1"), parser.add_argument("--jobs", type=int, default=2)
    given = parser.parse_args()
    binary, directory = str(Path(given.binary).resolve()), Path(given.directory) / "adversary"
    directory.mkdir(parents=True, exist_ok=True)
    cams = cases(binary, directory)
    failed = 0
    for kind, total in (("wrong", given.wrong), ("right", given.right), ("units", given.units)):
        classes, missed = Counter(), Counter()
        task = lambda number: judge(binary, directory, cams[number % len(cams)], number, kind, given.seed)
        with ThreadPoolExecutor(given.jobs) as pool:
            for good, code, title, said, name in pool.map(task, range(total)):
                what = title.split(": ")[1].split()[0].rstrip(",")
                what = "lines" if what.isdigit() else what
                classes[what] += 1
                if not good:
                    missed[what] += 1
                    failed += 1
                    if missed[what] <= 8:
                        print(f"  {kind} file gives exit {code}: {title} [{name}] {said[:300]}")
        print(f"{kind}: {total} files, {sum(missed.values())} {'accepted' if kind == 'wrong' else 'refused'}")
        print("  " + ", ".join(f"{what} {n}" + (f" ({missed[what]} failed)" if missed[what] else "")
                               for what, n in sorted(classes.items())))
    failed += solids(binary, directory, given.solids, random.Random(f"{given.seed}-solids"))
    sys.exit(failed > 0)


main()
