"""Files that nobody would draw: what makes a reader of DXF, STEP or machine files fail, each written by a generator.

Each generator yields a name, the words of the command that must survive the file, and the parts of the file as bytes; large ones
are made in pieces, so that the size of this program is not taken for that of camgen.
"""
import random

END = b"  0\nENDSEC\n  0\nEOF\n"


def section(name):
    return f"  0\nSECTION\n  2\n{name}\n".encode()


def groups(*pairs):
    return "".join(f"{code:3}\n{value}\n" for code, value in pairs).encode()


HEAD = section("HEADER") + groups((9, "$INSUNITS"), (70, 4), (0, "ENDSEC"))


def entities(parts):
    """A file of entities and nothing else."""
    yield HEAD + section("ENTITIES")
    yield from parts
    yield END


def blocks(block_parts, parts):
    yield HEAD + section("BLOCKS")
    yield from block_parts
    yield groups((0, "ENDSEC")) + section("ENTITIES")
    yield from parts
    yield END


def many(count, make, at_once=2000):
    """So many pieces, some at a time."""
    for first in range(0, count, at_once):
        yield b"".join(make(i) for i in range(first, min(count, first + at_once)))


def line(x1, y1, x2, y2, layer="CAM_PROFILE"):
    return f"  0\nLINE\n  8\n{layer}\n 10\n{x1}\n 20\n{y1}\n 11\n{x2}\n 21\n{y2}\n".encode()


def lightweight(count, point, layer="CAM_PROFILE", closed=1):
    yield groups((0, "LWPOLYLINE"), (8, layer), (90, count), (70, closed))

    def vertex(i):
        x, y, bulge = point(i)
        return f" 10\n{x}\n 20\n{y}\n 42\n{bulge}\n".encode()

    yield from many(count, vertex)


def spline(degree, points, knots=None, weights=None, layer="CAM_PROFILE", flags=8):
    count = len(points)
    if knots is None:
        knots = [0] * (degree + 1) + list(range(1, count - degree)) + [count - degree] * (degree + 1)
    head = [(0, "SPLINE"), (8, layer), (70, flags), (71, degree), (72, len(knots)), (73, count)]
    yield groups(*head)
    yield from many(len(knots), lambda i: f" 40\n{knots[i]}\n".encode())
    if weights is not None:
        yield from many(len(weights), lambda i: f" 41\n{weights[i]}\n".encode())
    yield from many(count, lambda i: f" 10\n{points[i][0]}\n 20\n{points[i][1]}\n 30\n0\n".encode())


def random_points(seed, count, size):
    rng = random.Random(seed)
    return [(rng.uniform(-size, size), rng.uniform(-size, size)) for _ in range(count)]


def circle(count, radius=100.0):
    from math import cos, pi, sin

    return lambda i: (radius * cos(2 * pi * i / count), radius * sin(2 * pi * i / count), 0)


def insert(block, *more):
    return groups((0, "INSERT"), (8, "0"), (2, block), (10, 0), (20, 0), *more)


def block(name, parts):
    yield groups((0, "BLOCK"), (8, "0"), (2, name), (70, 0), (10, 0), (20, 0))
    yield from parts
    yield groups((0, "ENDBLK"))


def dxf_structure():
    """Dates, depths, sections and sizes."""
    small = line(0, 0, 1, 0)
    for value in ("2458000.5", "1e300", "-1e300", "nan", "inf", "0"):
        dates = groups(*[p for name in ("$TDCREATE", "$TDUPDATE", "$TDINDWG") for p in ((9, name), (40, value))])
        yield f"date {value}", [section("HEADER") + dates + groups((0, "ENDSEC")) + section("ENTITIES") + small + END]
    yield "nested data", entities([small, groups((1001, "APP")), *many(12_000, lambda i: b"1002\n{\n")])
    yield "nested groups", entities([small, *many(12_000, lambda i: b"102\n{A\n")])
    yield "groups one after the other", entities([small, *many(500_000, lambda i: b"102\n{A\n102\n}\n")])
    yield "sections", many(500_000, lambda i: section("ENTITIES") + b"  0\nENDSEC\n")
    yield "sections of one line", [*many(100_000, lambda i: section("ENTITIES") + small + b"  0\nENDSEC\n"), b"  0\nEOF\n"]
    yield "a long line", [HEAD, *(b"x" * 1_000_000 for _ in range(200))]
    yield "a long value", [HEAD + section("ENTITIES") + b"  0\nLINE\n  8\n", *(b"x" * 100_000 for _ in range(200)), b"\n", END]
    yield "returns alone", [(HEAD + section("ENTITIES")).replace(b"\n", b"\r"), *(b"  0\rLINE\r" * 10_000 for _ in range(100)), END.replace(b"\n", b"\r")]
    yield "empty lines", (b"\n" * 1_000_000 for _ in range(200))
    yield "many groups of one entity", entities([groups((0, "TEXT"), (8, "0")), *many(5_000_000, lambda i: b" 40\n1\n")])
    yield "variables", [section("HEADER"), *many(2_000_000, lambda i: b"  9\n$INSUNITS\n 70\n4\n"), groups((0, "ENDSEC")) + section("ENTITIES") + END]
    yield "binary zeros", [b"AutoCAD Binary DXF\r\n\x1a\0", *(bytes(1_000_000) for _ in range(100))]
    yield "binary truths", [b"AutoCAD Binary DXF\r\n\x1a\0", *(b"\x22\x01\x01" * 300_000 for _ in range(100))]
    yield "nothing", [b""]
    yield "random bytes", [random.Random(3).randbytes(1_000_000)]
    yield "names of every kind", entities(
        [line(0, i, 1, i, f"L{chr(code)}\u200bX") for i, code in enumerate([*range(1, 10), *range(11, 13), *range(14, 32), *range(127, 160), 0x202A, 0x202E, 0x2066, 0x2069, 0xFFFE, 0xFFFF, 0x2028, 0xFEFF])]
        + [groups((0, "RE\x1b[31mGION"), (8, "\x1b]0;x\x07"), (10, 0), (20, 0)), insert("\x9b31m\u202eB")]
        + [line(0, 0, "\x1b[31m", 0)]
    )


def dxf_layers():
    """Layers."""
    table = lambda n: (section("TABLES") + groups((0, "TABLE"), (2, "LAYER")), *many(n, lambda i: groups((0, "LAYER"), (2, f"L{i}"), (70, 0), (62, 7))), groups((0, "ENDTAB"), (0, "ENDSEC")))
    yield "a table of layers", [HEAD, *table(90_000), section("ENTITIES"), line(0, 0, 1, 1), END]
    yield "a layer for each line", [HEAD, *table(40_000), section("ENTITIES"), *many(40_000, lambda i: line(i, 0, i, 1, f"L{i}")), END]
    yield "a layer for each text", entities(many(400_000, lambda i: groups((0, "TEXT"), (8, f"L{i}"), (10, 0))))
    yield "hidden layers", entities(many(300_000, lambda i: groups((0, "LINE"), (8, f"L{i}"), (60, 1))))
    yield "a kind for each entity", entities(many(300_000, lambda i: groups((0, f"K{i}"), (8, f"L{i}"), (10, i), (20, 1))))
    yield "names as long as files", entities(many(200, lambda i: line(i, 0, i, 1, "L" * 200_000 + str(i)), 10))
    yield "layers of a chain", entities(many(100_000, lambda i: line(i, 0, i + 1, 0, f"L{i}")))
    yield "thick layers", entities(many(100_000, lambda i: line(i, 0, i + 1, 0, f"L{i}") + b" 39\n5\n"))


def dxf_joints():
    """Ends that meet."""
    from math import cos, pi, sin

    rng = random.Random(5)
    spoke = lambda i: line(0, 0, 100 * cos(i), 100 * sin(i))
    yield "a star", entities(many(100_000, spoke))
    yield "a star of layers", entities(many(100_000, lambda i: line(0, 0, cos(i), sin(i), f"L{i % 9}")))
    yield "diameters", entities(many(100_000, lambda i: line(-cos(i), -sin(i), cos(i), sin(i))))
    yield "one line often", entities(many(190_000, lambda i: line(0, 0, 10, 5)))
    yield "points", entities(many(190_000, lambda i: line(3, 4, 3, 4)))
    size = 4e-4
    yield "a cloud of short lines", entities(many(100_000, lambda i: line(*(rng.uniform(0, size) for _ in range(4)))))
    yield "a row of short lines", entities(many(100_000, lambda i: line(i * 2e-5, 0, (i + 1) * 2e-5, 0)))
    yield "a heap of arcs", entities(many(100_000, lambda i: groups((0, "ARC"), (8, "CAM_PROFILE"), (10, 0), (20, 0), (40, 1 + (i % 3) * 1e-5), (50, i), (51, i + 90))))
    yield "circles on circles", entities(many(95_000, lambda i: groups((0, "CIRCLE"), (8, "BORE"), (10, 0), (20, 0), (40, 25))))
    yield "holes", entities([*lightweight(200, circle(200)), *many(90_000, lambda i: groups((0, "CIRCLE"), (8, "BORE"), (10, i % 300), (20, i // 300), (40, 0.3)))])
    yield "a grid", entities(many(150_000, lambda i: line(i % 300, i // 300, i % 300 + 1, i // 300, "0") if i % 2 else line(i % 300, i // 300, i % 300, i // 300 + 1, "0")))
    turn = 2 * pi / 199_000
    yield "a polygon of lines", entities(many(199_000, lambda i: line(100 * cos(i * turn), 100 * sin(i * turn), 100 * cos(i * turn + turn), 100 * sin(i * turn + turn))))
    zigzag = lambda i: (100 * cos(i * turn) * (1 + 0.5 * (i % 2)), 100 * sin(i * turn) * (1 + 0.5 * (i % 2)), 0)
    yield "a polygon", entities(lightweight(199_000, circle(199_000)))
    yield "a zigzag", entities(lightweight(199_000, zigzag))
    tangle = lambda i: (rng.uniform(-100, 100), rng.uniform(-100, 100), rng.uniform(-1, 1))
    yield "a tangle", entities(lightweight(199_000, tangle))
    yield "a tangle of 20000", entities(lightweight(20_000, tangle))
    yield "a spiral", entities(lightweight(150_000, lambda i: (1e-3 * i * cos(i / 50), 1e-3 * i * sin(i / 50), 0)))
    yield "a polygon far off", entities(lightweight(150_000, lambda i: (1e15 * cos(i / 9), 1e15 * sin(i / 7), 1e15)))


def dxf_counts():
    """More than anybody cuts."""
    rng = random.Random(7)
    number = lambda: f"{rng.uniform(-200, 200):.12f}"
    yield "106 MB of lines", entities(many(1_050_000, lambda i: line(number(), number(), number(), number())))
    yield "a polyline of 2000000", entities(lightweight(2_000_000, circle(2_000_000)))
    yield "vertices", entities([groups((0, "POLYLINE"), (8, "0"), (70, 1)), *many(800_000, lambda i: groups((0, "VERTEX"), (8, "0"), (10, i), (20, i % 7))), groups((0, "SEQEND"))])
    yield "polylines without end", entities(many(700_000, lambda i: groups((0, "POLYLINE"), (8, "0"), (0, "VERTEX"), (8, "0"), (10, i), (20, 0))))
    yield "records of nothing", entities(many(10_000_000, lambda i: b"  0\nX\n"))
    yield "texts", entities(many(2_000_000, lambda i: groups((0, "TEXT"), (8, "0"), (10, 1), (20, 1), (1, "A"))))
    ten = [insert(f"B{i + 1}") * 10 for i in range(20)]
    nest = [part for i, parts in enumerate(ten) for part in block(f"B{i}", [parts])]
    bottom = list(block("B20", [line(0, 0, 1, 1, "CAM_PROFILE")]))
    yield "blocks within blocks", blocks([*nest, *bottom], [insert("B0")])
    yield "empty blocks within blocks", blocks([*nest, *block("B20", [])], [insert("B0")])
    yield "a row of rows", blocks(block("B", [line(0, 0, 1, 1)]), [insert("B", (70, 30000), (71, 30000), (44, 1), (45, 1))])
    yield "a row of nothing", blocks(block("B", []), [insert("B", (70, 10**15), (71, 10**15))])
    heavy = [groups((0, "TEXT")), *many(1_000_000, lambda i: b" 40\n1\n")]
    yield "a heavy text often", blocks(block("B", heavy), [insert("B", (70, 1000), (71, 1000))])
    yield "a heavy block often", blocks(block("B", many(200_000, lambda i: groups((0, "TEXT")))), [insert("B", (70, 100))])
    yield "a polyline often", blocks(block("B", lightweight(100_000, circle(100_000))), [insert("B", (70, 1000))])
    yield "blocks", blocks((part for i in range(100_000) for part in block(f"B{i}", [])), many(100_000, lambda i: insert(f"B{i}")))
    yield "blocks of one name", blocks((part for i in range(200_000) for part in block("B", [])), [insert("B")])
    yield "a block of itself", blocks(block("B", [insert("B") * 1000]), [insert("B") * 1000])


def dxf_curves():
    """Splines and ellipses."""
    for degree in (2, 3, 4, 5, 8, 11):
        yield f"a spline of degree {degree}", entities(spline(degree, random_points(degree, 3_000, 1e6)))
        yield f"a small spline of degree {degree}", entities(spline(degree, random_points(degree, 3_000, 150)))
    yield "a huge spline", entities(spline(4, random_points(1, 3_000, 1e14)))
    yield "a fine spline", entities(spline(5, random_points(1, 60_000, 1e-3)))
    yield "a spline of 190000", entities(spline(3, random_points(1, 190_000, 100)))
    yield "a spline of 900000", entities(spline(3, random_points(1, 900_000, 100)))
    rng = random.Random(11)
    weights = [10 ** rng.uniform(-300, 15) for _ in range(2000)]
    yield "weights", entities(spline(3, random_points(2, 2000, 100), weights=weights))
    yield "weights of 1e-300", entities(spline(2, random_points(2, 999, 100), weights=[1, 1e-300, 1] * 333))
    for knot in ("nan", "inf", "-inf", "1e300", "1e15", "-1e15", "1e-320"):
        for degree in (1, 3, 4):
            knots = [0] * (degree + 1) + [0.5, knot] + [1] * (degree + 1)
            yield f"knot {knot} of degree {degree}", entities(spline(degree, random_points(3, degree + 3, 10), knots))
    for value in ("nan", "1e15", "1e-300", "0", "-1"):
        yield f"points at {value}", entities(spline(4, [(0, 0), (value, 1), (1, value), (value, value), (2, 2), (3, 3)]))
        yield f"weight {value}", entities(spline(4, random_points(4, 6, 10), weights=[1, value, 1, value, 1, 1]))
        yield f"degree {value}", entities(spline(3, random_points(4, 6, 10)) if value == "0" else [groups((0, "SPLINE"), (71, value), (40, 0), (10, 0), (20, 0))])
    knots = [0] * 4 + [i * 1e-310 for i in range(1, 50)] + [1] * 4
    yield "knots of nothing", entities(spline(3, random_points(4, 53, 10), knots))
    fit = lambda n, p: [groups((0, "SPLINE"), (8, "CAM_PROFILE"), (70, 1), (71, 3)), *many(n, lambda i: groups((11, p(i)), (21, i % 3)))]
    yield "fit points", entities(fit(150_000, lambda i: i * 1e-3))
    yield "fit points in a heap", entities(fit(150_000, lambda i: i % 2 * 1e-300))
    yield "fit points far off", entities(fit(15_000, lambda i: (-1) ** i * 1e15))
    ellipse = lambda major, ratio, *more: groups((0, "ELLIPSE"), (8, "CAM_PROFILE"), (10, 0), (20, 0), (11, major), (21, 0), (40, ratio), *more)
    for major in ("1e15", "1e9", "100", "1e-300"):
        for ratio in ("1e-12", "1e15", "1", "-1", "1e-300"):
            yield f"an ellipse {major} {ratio}", entities([ellipse(major, ratio)])
    yield "an ellipse round and round", entities([ellipse(100, 0.5, (41, -1e15), (42, 1e15))])
    yield "ellipses", entities(many(100_000, lambda i: ellipse(100 + i, 0.3)))
    yield "oblong rows", blocks(block("B", many(1000, lambda i: groups((0, "CIRCLE"), (8, "0"), (10, 0), (20, 0), (40, 100 + i)))), [insert("B", (41, 1), (42, 1e-9), (70, 100), (44, 1))])
    for bulge in ("1e15", "1e-15", "nan", "-1", "1e300"):
        yield f"bulge {bulge}", entities(lightweight(4, lambda i: (i % 2 * 50, i // 2 * 50, bulge)))


def dxf():
    for made in (dxf_structure, dxf_layers, dxf_joints, dxf_counts, dxf_curves):
        yield from made()


def step():
    """STEP files."""
    head = b"ISO-10303-21;\nHEADER;\nFILE_SCHEMA(('AUTOMOTIVE_DESIGN'));\nENDSEC;\nDATA;\n"
    end = b"ENDSEC;\nEND-ISO-10303-21;\n"
    yield "lists", [head, b"#1=X(", b"(" * 1_000_000]
    yield "instances", [head, *many(1_500_000, lambda i: f"#{i}=X();\n".encode()), end]
    yield "values", [head, b"#1=X(", *many(6_000_000, lambda i: b"1,", 100_000), b"1);\n", end]
    yield "names", [head, *many(500_000, lambda i: f"#{i}=X(.{'N' * 60}.);\n".encode()), end]
    yield "texts", [head, b"#1=X('", *(b"x" * 1_000_000 for _ in range(100)), b"');\n", end]
    yield "comments", [head, *(b"/* */" * 100_000 for _ in range(100)), end]
    yield "representations", [head, *many(300_000, lambda i: f"#{i}=SHAPE_REPRESENTATION('',(#1,#2,#3),#4);\n".encode()), b"#900000=MANIFOLD_SOLID_BREP('',#1);\n", end]
    faces = b"".join(b"#%d," % i for i in range(2, 200_000))
    yield "faces", [head, b"#1=MANIFOLD_SOLID_BREP('',#900001);\n#900001=CLOSED_SHELL('',(" + faces + b"#2));\n", *many(200_000, lambda i: f"#{i + 2}=ADVANCED_FACE('',(#{i + 2}),#2,.T.);\n".encode()), end]
    yield "a word with escapes", [head + b"#1=X(\x1b[31m);\n#2=Y('\xe2\x80\xae');\n" + end]


def machine():
    """Machine files."""
    yield "keys on one line", [b"bed = { ", *many(8_000, lambda i: f"key{i} = 1, ".encode()), b"last = 1 }\n"]
    yield "keys", many(60_000, lambda i: f"key{i} = 1\n".encode())
    yield "keys of a table", [b"[bed]\n", *many(60_000, lambda i: f"mas{i} = 1\n".encode())]
    yield "long keys", many(3000, lambda i: f"{'k' * 300}{i} = 1\n".encode())
    yield "quoted keys", many(40_000, lambda i: f"\"a.b{i}\" = 1\n".encode())
    yield "dotted keys", many(20_000, lambda i: f"a.b.c.d.e.f.g.h{i} = 1\n".encode())
    yield "deep keys", [b"a" + b".a" * 400_000 + b" = 1\n"]
    yield "deep tables", [b"[a" + b".a" * 400_000 + b"]\n"]
    yield "tables", many(60_000, lambda i: f"[t{i}]\n".encode())
    yield "segments", [b"[motion]\n", *many(45_000, lambda i: b"[[motion.segment]]\n")]
    yield "segments with a fault", many(15_000, lambda i: b"[[motion.segment]]\nlaw = \"x\"\nover = 1\n")
    yield "segments on one line", [b"motion.segment = [", *many(40_000, lambda i: b"{law = \"x\"}, "), b"]\n"]
    yield "lists in lists", [b"x = " + b"[" * 500_000]
    yield "tables in tables", [b"x = " + b"{ a = " * 150_000]
    yield "digits", [b"[bed]\nmass = \"" + b"1" * 900_000 + b" kg\"\n"]
    yield "bare digits", [b"[bed]\nmass = " + b"1" * 900_000 + b"\n"]
    yield "many digits", [b"[bed]\n", *many(400, lambda i: f"mass{i} = \"{'1' * 2000} kg\"\n".encode()), b"[limits]\n" + b"x = \"" + b"9" * 100_000 + b" mm\"\n"]
    yield "an exponent", [b"[bed]\nmass = \"1e" + b"9" * 900_000 + b" kg\"\n"]
    yield "a long word", [b"[transition]\nkind = \"" + b"run-up" * 150_000 + b"\"\n"]
    yield "a long text", [b"name = \"" + b"n" * 1_000_000 + b"\"\n[bed]\nmass = 1\n"]
    yield "a formula", [b"name=\"x\"\n[motion]\nformula = \"" + b"sin(" * 250_000 + b"\"\n"]
    yield "points", [b"name=\"x\"\n[motion]\npoints = [", *many(35_000, lambda i: f"[\"{i} deg\", \"{i % 9} mm\"],".encode()), b"]\n[follower.roller]\nradius=\"10 mm\"\n"]
    yield "fewer points", [b"name=\"x\"\n[motion]\npoints = [", *many(4_000, lambda i: f"[\"{i * 0.09} deg\", \"{i % 9} mm\"],".encode()), b"]\n[follower.roller]\nradius=\"10 mm\"\n[cam]\nthickness=\"20 mm\"\nmaterial=\"steel\"\nbore_radius=\"10 mm\"\n"]
    yield "numbers", [b"[motion.fourier]\ncos = [", *many(250_000, lambda i: b"1, "), b"]\n"]
    yield "wrong numbers", [b"[motion.fourier]\ncos = [", *many(200_000, lambda i: b"\"x\", "), b"]\n"]
    yield "a table for each number", many(20_000, lambda i: f"[[shaft.segment]]\ndiameter = \"{i} furlongs\"\n".encode())
    yield "zeros", [bytes(1_000_000)]
    yield "returns", [b"\r" * 1_000_000]
    yield "not text", [random.Random(9).randbytes(500_000)]
    yield "an open text", [b"name = \"" + b"x" * 900_000]
    yield "equals", [b"=" * 900_000]
    yield "faults of the text", [b"x = = 1\n" * 100_000]
    yield "remarks", [b"# \xe2\x80\xae\n" * 150_000]
    yield "twice", [b"a = 1\n" * 150_000]
    for code in (1, 7, 8, 27, 127, 0x85, 0x9B, 0x202A, 0x202E, 0x2066, 0x2069, 0xFFFE, 0xFFFF, 0x2028, 0xFEFF):
        c, u = chr(code), f"\\u{code:04X}"
        yield f"names with {code:x}", [f"name = \"a{u}b\"\n\"k{u}\" = 1\n[bed]\nmass = \"1{u} kg\"\n[\"t{u}\"]\n[transition]\nkind = \"{u}\"\n".encode()]
        yield f"raw {code:x}", [f"name = \"a{c}b\"\nk{c} = 1\n[bed{c}]\nmass = \"{c}\" # {c}\n".encode()]
        yield f"told {code:x}", [f"name = \"ab\" # {c}\nk = \"{c}\"\n[bed] # {c}\nmass = 1 # {c}\n".encode()]
