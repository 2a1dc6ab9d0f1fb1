"""A DXF writer of its own: group codes and nothing else, so that files can be wrong in every way."""
import math

import numpy as np
from shapes import reversed_chain


class Drawing:
    def __init__(self, unit=4):
        self.unit, self.layers, self.blocks, self.entities = unit, {}, {}, []
        self.digits = 12

    def number(self, value):
        text = f"{value:.{self.digits}f}"
        return text

    def entity(self, kind, layer, *pairs, block=None):
        body = [("0", kind), ("8", layer)] + [(str(c), v if isinstance(v, str) else self.number(v)) for c, v in pairs]
        (self.blocks.setdefault(block, []) if block else self.entities).append(body)

    def poly(self, layer, vertices, closed=True, block=None, extra=(), old=False):
        if old:
            head = [(66, "1"), (10, 0.0), (20, 0.0), (30, 0.0), (70, "1" if closed else "0"), *extra]
            self.entity("POLYLINE", layer, *head, block=block)
            for x, y, bulge in vertices:
                self.entity("VERTEX", layer, (10, x), (20, y), (30, 0.0), (42, bulge), block=block)
            self.entity("SEQEND", layer, block=block)
            return
        pairs = [(90, str(len(vertices))), (70, "1" if closed else "0"), *extra]
        for x, y, bulge in vertices:
            pairs += [(10, x), (20, y)] + ([(42, bulge)] if bulge else [])
        self.entity("LWPOLYLINE", layer, *pairs, block=block)

    def exploded(self, layer, vertices, rng, block=None, extra=()):
        order = list(range(len(vertices)))
        rng.shuffle(order)
        for i in order:
            (x0, y0, bulge), (x1, y1, _) = vertices[i], vertices[(i + 1) % len(vertices)]
            self.segment(layer, (x0, y0), (x1, y1), bulge, rng, block, extra)

    def segment(self, layer, p, q, bulge, rng, block=None, extra=()):
        if abs(bulge) < 1e-9:
            p, q = (q, p) if rng.random() < 0.3 else (p, q)
            self.entity("LINE", layer, (10, p[0]), (20, p[1]), (11, q[0]), (21, q[1]), *extra, block=block)
            return
        sweep = 4 * math.atan(bulge)
        cx, cy = q[0] - p[0], q[1] - p[1]
        scale = (1 - bulge * bulge) / (4 * bulge)
        mx, my = 0.5 * (p[0] + q[0]) - cy * scale, 0.5 * (p[1] + q[1]) + cx * scale
        radius = math.hypot(cx, cy) * (1 + bulge * bulge) / (4 * abs(bulge))
        start, end = (p, q) if sweep > 0 else (q, p)
        angle = lambda t: math.degrees(math.atan2(t[1] - my, t[0] - mx)) % 360
        self.entity("ARC", layer, (10, mx), (20, my), (40, radius), (50, angle(start)), (51, angle(end)), *extra, block=block)

    def circle(self, layer, centre, radius, block=None, extra=()):
        self.entity("CIRCLE", layer, (10, centre[0]), (20, centre[1]), (40, radius), *extra, block=block)

    def text(self):
        out = ["0", "SECTION", "2", "HEADER", "9", "$ACADVER", "1", "AC1015", "9", "$INSUNITS", "70", str(self.unit)]
        out += ["0", "ENDSEC", "0", "SECTION", "2", "TABLES", "0", "TABLE", "2", "LAYER", "70", str(len(self.layers))]
        for name, (colour, flags) in self.layers.items():
            out += ["0", "LAYER", "2", name, "70", str(flags), "62", str(colour), "6", "CONTINUOUS"]
        out += ["0", "ENDTAB", "0", "ENDSEC", "0", "SECTION", "2", "BLOCKS"]
        for name, bodies in self.blocks.items():
            out += ["0", "BLOCK", "8", "0", "2", name, "70", "0", "10", "0.0", "20", "0.0", "30", "0.0", "3", name]
            out += [word for body in bodies for pair in body for word in pair] + ["0", "ENDBLK", "8", "0"]
        out += ["0", "ENDSEC", "0", "SECTION", "2", "ENTITIES"]
        out += [word for body in self.entities for pair in body for word in pair]
        return "\n".join([*out, "0", "ENDSEC", "0", "EOF", ""])


def spline_entity(drawing, layer, points, headings, lengths):
    """A closed C1 cubic with a Bezier piece between neighbouring points, as one B-spline with double knots."""
    tangent = np.stack([np.cos(headings), np.sin(headings)], axis=1)
    control, knots = [points[0]], [0.0] * 4
    at = 0.0
    for i in range(len(points)):
        j = (i + 1) % len(points)
        third = lengths[i] / 3
        control += [points[i] + tangent[i] * third, points[j] - tangent[j] * third, points[j]]
        at += lengths[i]
        knots += [at] * 3
    knots.append(at)
    pairs = [(70, "8"), (71, "3"), (72, str(len(knots))), (73, str(len(control))), (74, "0")]
    pairs += [(40, k) for k in knots]
    for x, y in control:
        pairs += [(10, x), (20, y), (30, 0.0)]
    drawing.entity("SPLINE", layer, *pairs)


def put(drawing, vertices, rng, layer="CAM_PROFILE", how=None):
    how = how or rng.choice(["lw", "lw", "old", "exploded", "reversed"])
    start = rng.randrange(len(vertices))
    vertices = np.roll(vertices, start, axis=0)
    if how == "reversed":
        vertices = reversed_chain(vertices)
    if how == "exploded":
        drawing.exploded(layer, vertices.tolist(), rng)
    else:
        drawing.poly(layer, vertices.tolist(), old=how == "old")
