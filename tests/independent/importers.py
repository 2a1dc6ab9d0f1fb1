"""Opens cut files with the importers of the programs a shop uses, and measures what arrives there.

A plate, a disc with a keyway, a disc with holes that balance it, the sections of a conoid and a disc of cubic splines, in every
version of DXF that has them. Each importer must give closed wires, as many as were written, of the length and area that camgen
reports; those of splines have the length and area of the same disc in fine arcs, to 1e-6 where the importer keeps the curves.

  ezdxf      the library; always
  FreeCAD    `Import.readDXF`, its importer in C++, and the older one in Python where its library is there
  LibreCAD   what `dxf2pdf` draws
  Inkscape   its extension `dxf_input.py`
  dxf2gcode  the G-code it exports

A program that is not installed is named and left out. --install gets those of Debian by apt-get, as root.

usage: importers.py CAMGEN_BINARY DIRECTORY [--install] [--pictures] [--freecad-library DIRECTORY]
"""
import argparse
import json
import math
import os
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
import zlib
from pathlib import Path

import ezdxf
import numpy as np

VERSIONS = ["r12", "r2000", "r2010", "r2013"]
KEYWAY = ["--set", "cam.keyway.width=14mm", "--set", "cam.keyway.depth=3.8mm", "--set", "cam.keyway.angle=30deg"]
HOLES = ["--set", "cam.lever=0.15", "--set", "cam.base_radius=90mm", "--set", "cam.balance=40mm .. 85mm", "--set",
             "limits.contact_stress=3000MPa"]
CASES = {
    "plate": ["translating"],
    "keyway": ["rotary", *KEYWAY],
    "holes": ["rotary", *HOLES],
    "conoid": ["conoid", "--rpm", "20,25,30,35"],
    "spline": ["rotary", "--tolerance", "0.05um", "--outline", "spline"],
}
# What the wires of a case are measured by in place of its own report: the same in fine arcs.
FINE_ARCS = {"spline": ["rotary", "--tolerance", "0.02um", "--outline", "arcs"]}
PACKAGES = ["freecad", "librecad", "inkscape", "python3-lxml", "python3-cssselect", "dxf2gcode"]
# Ends nearer than this are joined, mm; lengths and areas agree to this share.
EXACT = (1e-5, 1e-6)


class Missing(Exception):
    """A program that is not here."""


class Wire:
    """Segments end to start: x, y, bulge of each start, and where the last one ends."""

    def __init__(self, vertices, end, gap):
        start = np.array(vertices, dtype=float)
        self.start, self.end = start[:, :2], np.vstack([start[1:, :2], end])
        self.bulge = start[:, 2]
        self.closed = math.dist(end, self.start[0]) <= gap

    def length(self):
        chord = np.hypot(*(self.end - self.start).T)
        sweep = 4 * np.arctan(np.abs(self.bulge))
        radius = chord * (1 + self.bulge**2) / (4 * np.maximum(np.abs(self.bulge), 1e-300))
        return float(np.where(self.bulge == 0, chord, radius * sweep).sum())

    def area(self):
        cross = self.start[:, 0] * self.end[:, 1] - self.start[:, 1] * self.end[:, 0]
        chord = np.hypot(*(self.end - self.start).T)
        sweep = 4 * np.arctan(np.abs(self.bulge))
        safe = np.where(self.bulge == 0, 1.0, np.abs(self.bulge))
        radius = chord * (1 + safe**2) / (4 * safe)
        cap = np.where(self.bulge == 0, 0.0, np.sign(self.bulge) * radius**2 * (sweep - np.sin(sweep)))
        return abs(float(0.5 * (cross + cap).sum()))

    def points(self):
        found = []
        for a, b, bulge in zip(self.start, self.end, self.bulge, strict=True):
            count = max(1, int(4 * math.atan(abs(bulge)) / 0.02))
            for i in range(count):
                # The point of an arc at the share t of its sweep, from its chord.
                t, sweep = i / count, 4 * math.atan(bulge)
                if bulge == 0:
                    found.append(a)
                else:
                    far = math.sin(sweep * t / 2) / math.sin(sweep / 2)
                    turn = sweep * (t - 1) / 2
                    x, y = far * (b - a)
                    found.append(a + [x * math.cos(turn) - y * math.sin(turn), x * math.sin(turn) + y * math.cos(turn)])
        return np.array([*found, self.end[-1]])


def joined(segments, gap):
    """Wires of loose segments (start, end, bulge), whichever way and order they come in."""
    return chained([[segment] for segment in segments], gap)


def chained(chains, gap):
    """Wires of loose chains of segments."""
    left, wires = list(chains), []
    while left:
        chain = left.pop(0)
        vertices, end = [(*a, bulge) for a, _, bulge in chain], chain[-1][1]
        while left and not (len(vertices) > 1 and math.dist(vertices[0][:2], end) <= gap):
            apart = [(min(math.dist(c[0][0], end), math.dist(c[-1][1], end)), i) for i, c in enumerate(left)]
            distance, index = min(apart)
            if distance > gap:
                break
            chain = left.pop(index)
            if math.dist(chain[0][0], end) > math.dist(chain[-1][1], end):
                chain = [(b, a, -bulge) for a, b, bulge in reversed(chain)]
            vertices += [(*a, bulge) for a, _, bulge in chain]
            end = chain[-1][1]
        wires.append(Wire(vertices, end, gap))
    return wires


def circle(x, y, radius):
    a, b = (x - radius, y), (x + radius, y)
    return [(a, b, 1.0), (b, a, 1.0)]


def run(command, **more):
    environment = {**os.environ, "QT_QPA_PLATFORM": "offscreen", **more.pop("env", {})}
    try:
        return subprocess.run(command, env=environment, capture_output=True, text=True, timeout=120, **more)
    except FileNotFoundError:
        raise Missing(f"{command[0]} is not there") from None


def bulge_of(a, m, b):
    """Of the arc from a to b through m, in about its middle."""
    chord, sagitta = b - a, m - (a + b) / 2
    return -2 * (chord[0] * sagitta[1] - chord[1] * sagitta[0]) / (chord @ chord)


def arcs_along(spline):
    """Arcs through three points each, 32 from knot to knot: off by the fourth power of their length."""
    knots = sorted(set(spline.knots()))
    times = np.concatenate([np.linspace(a, b, 65)[:-1] for a, b in zip(knots, knots[1:])] + [[knots[-1]]])
    points = np.array([(p.x, p.y) for p in spline.points(times)])
    for a, m, b in zip(points[0:-1:2], points[1::2], points[2::2]):
        yield tuple(a), tuple(b), bulge_of(a, m, b)


def by_ezdxf(files, _):
    def segments(path):
        for entity in ezdxf.readfile(path).modelspace():
            if entity.dxftype() == "CIRCLE":
                yield from circle(entity.dxf.center.x, entity.dxf.center.y, entity.dxf.radius)
                continue
            if entity.dxftype() == "ARC":
                turn = math.radians((entity.dxf.end_angle - entity.dxf.start_angle) % 360)
                # A bulge of more than a half turn is known to few digits: two arcs.
                low, centre = math.radians(entity.dxf.start_angle), np.array(entity.dxf.center.xyz[:2])
                on = [tuple(centre + entity.dxf.radius * np.array([math.cos(a), math.sin(a)])) for a in (low, low + turn / 2, low + turn)]
                yield from ((a, b, math.tan(turn / 8)) for a, b in zip(on, on[1:]))
                continue
            if entity.dxftype() == "SPLINE":
                yield from arcs_along(entity.construction_tool())
                continue
            if entity.dxftype() == "LWPOLYLINE":
                found, closed = list(entity.get_points("xyb")), entity.closed
            else:
                found = [(*v.dxf.location.xyz[:2], v.dxf.get("bulge", 0.0)) for v in entity.vertices]
                closed = entity.is_closed
            following = found[1:] + found[:1] if closed else found[1:]
            yield from (((ax, ay), (bx, by), bulge) for (ax, ay, bulge), (bx, by, _) in zip(found, following))

    return "ezdxf " + ezdxf.__version__, {f: joined(segments(f), EXACT[0]) for f in files}, EXACT, EXACT[1]


FREECAD = """
import json, os, sys
import FreeCAD
task = json.load(open(os.environ["CAMGEN_IMPORT"]))
found = {}

def segments(edge):
    first, last = edge.ParameterRange
    kind = type(edge.Curve).__name__
    parts = 1 if kind in ("Line", "LineSegment") else 2 if kind == "Circle" else 200
    points = [edge.valueAt(first + (last - first) * i / (2 * parts)) for i in range(2 * parts + 1)]
    for a, m, b in zip(points[0::2], points[1::2], points[2::2]):
        chord, sagitta = b - a, m - (a + b) * 0.5
        bulge = -2 * (chord.x * sagitta.y - chord.y * sagitta.x) / (chord.x**2 + chord.y**2)
        yield (a.x, a.y), (b.x, b.y), 0.0 if kind in ("Line", "LineSegment") else bulge

for name in task["files"]:
    if task["legacy"]:
        sys.path.append(task["library"])
        FreeCAD.ParamGet("User parameter:BaseApp/Preferences/Mod/Draft").SetBool("dxfUseLegacyImporter", True)
        import importDXF
        document = importDXF.open(name)
    else:
        import Import
        document = FreeCAD.newDocument()
        FreeCAD.setActiveDocument(document.Name)
        Import.readDXF(name)
    shapes = [o.Shape for o in document.Objects if hasattr(o, "Shape") and not o.isDerivedFrom("App::DocumentObjectGroup")]
    found[name] = [s for shape in shapes for edge in shape.Edges for s in segments(edge)]
    FreeCAD.closeDocument(document.Name)
json.dump({"version": ".".join(FreeCAD.Version()[:2]), "found": found}, open(task["answer"], "w"))
"""


def by_freecad(files, options, legacy=False):
    program = next((p for p in ("freecadcmd", "FreeCADCmd", "freecad.cmd") if shutil.which(p)), None)
    if program is None:
        raise Missing("freecadcmd is not there")
    library = options.freecad_library
    if legacy and not library:
        raise Missing("its library (the addon Draft-dxf-importer) is not there: see --freecad-library")
    folder = options.directory / ("freecad-legacy" if legacy else "freecad")
    folder.mkdir(exist_ok=True)
    script, task, answer = folder / "read.py", folder / "task.json", folder / "answer.json"
    answer.unlink(missing_ok=True)
    script.write_text(FREECAD)
    # A home of its own: the user's settings stay as they are and do not matter.
    names = {"files": [str(f) for f in files], "legacy": legacy, "library": str(library), "answer": str(answer)}
    task.write_text(json.dumps(names))
    told = run([program, str(script)], env={"CAMGEN_IMPORT": str(task), "HOME": str(folder), "XDG_CONFIG_HOME": str(folder)})
    assert answer.exists(), told.stdout[-2000:] + told.stderr[-2000:]
    said = json.loads(answer.read_text())
    # Its Python importer rounds to six decimals.
    precision = (1e-4, 1e-5) if legacy else EXACT
    found = {f: joined(said["found"][str(f)], precision[0]) for f in files}
    return f"FreeCAD {said['version']}, importer in {'Python' if legacy else 'C++'}", found, precision, precision[1]


def by_freecad_legacy(files, options):
    return by_freecad(files, options, legacy=True)


def pdf_chains(path, scale):
    """Strokes of the page's content in mm: LibreCAD draws arcs as chords on a grid of 1/1200 inch."""
    number = r"(-?[\d.]+)"
    for stream in re.findall(rb"stream\r?\n(.*?)endstream", path.read_bytes(), re.S):
        try:
            text = zlib.decompressobj().decompress(stream).decode("latin-1")
        except zlib.error:
            continue
        if " cm\n" not in text:
            continue
        unit = float(re.search(rf"{number} 0 0 -?[\d.]+ {number} {number} cm", text)[1]) * 25.4 / 72 / scale
        for stroke in re.findall(r"((?:[-\d. ]+ [mlc]\n|h\n)+)S\n", text):
            points = []
            for numbers, what in re.findall(r"([-\d. ]+) ([mlc])\n", stroke):
                given = unit * np.array(numbers.split(), dtype=float).reshape(-1, 2) * (1, -1)
                points.extend(bezier(points[-1], *given) if what == "c" else given)
            chords = [(a, b, 0.0) for a, b in zip(points, points[1:]) if math.dist(a, b) > 0]
            if chords:
                yield chords


def bezier(a, b, c, d):
    t = np.linspace(0, 1, 65)[1:, None]
    return list((1 - t) ** 3 * a + 3 * (1 - t) ** 2 * t * b + 3 * (1 - t) * t**2 * c + t**3 * d)


def by_librecad(files, options):
    folder = options.directory / "librecad"
    folder.mkdir(exist_ok=True)
    # Half the size, so that the cams fit on its sheet, A4: what lies outside of it is left out.
    scale, found = 0.4, {}
    for f in files:
        # It writes beside the file it reads.
        copied = folder / f.name
        shutil.copy(f, copied)
        run(["librecad", "dxf2pdf", "-s", str(scale), "-c", copied.name], cwd=folder)
        grid = 25.4 / 1200 / scale
        # Neighbouring chords share their ends; separate entities meet within a step of the grid each way.
        found[f] = chained(pdf_chains(copied.with_suffix(".pdf"), scale), 3 * grid)
    # Steps of the grid make a line of short chords longer; they do not move it.
    return "LibreCAD, dxf2pdf", found, (3 * grid, 1e-3), 0.05


def by_inkscape(files, options):
    extension = Path("/usr/share/inkscape/extensions/dxf_input.py")
    if not extension.exists():
        raise Missing("inkscape is not there")
    found = {}
    for f in files:
        # The extension belongs to the system's Python and the packages there.
        told = run(["/usr/bin/python3", str(extension), str(f)], env={"PYTHONPATH": str(extension.parent)})
        if not told.stdout.startswith("<svg") and "No module named" in told.stderr:
            raise Missing(told.stderr.strip().splitlines()[-1])
        found[f] = joined(svg_segments(told.stdout), 1e-4)
    version = run(["inkscape", "--version"]).stdout.split()[:2] if shutil.which("inkscape") else ["Inkscape"]
    return " ".join(version), found, (1e-4, 1e-5), 1e-5


def svg_segments(text):
    pixel, space = 25.4 / 96, "{http://www.w3.org/2000/svg}"
    root = ElementTree.fromstring(text)
    for group in root.iter(space + "g"):
        for path in group.iter(space + "path"):
            at = first = None
            for command, numbers in re.findall(r"([MLACzZ])([^MLACzZ]*)", path.get("d")):
                values = [float(v) for v in re.findall(r"-?\d+\.?\d*(?:e-?\d+)?", numbers)]
                to = (pixel * values[-2], -pixel * values[-1]) if values else first
                bulge = 0.0
                if command == "C":
                    points = pixel * np.array(values).reshape(-1, 2) * (1, -1)
                    for a, m, b in zip(*[iter(through(at, points))] * 3):
                        yield a, b, bulge_of(np.array(a), m, np.array(b))
                    at = to
                    continue
                if command == "A":
                    chord, radius = math.dist(at, to), pixel * values[0]
                    # Half a circle is one, whatever the digits of its ends.
                    half = math.asin(chord / (2 * radius)) if chord < 1.999999 * radius else math.pi / 2
                    # Sweep 1 is clockwise once y points up.
                    bulge = math.tan((math.pi - half if values[3] else half) / 2) * (-1 if values[4] else 1)
                if command == "M":
                    first = to
                elif math.dist(at, to) > 1e-6:
                    yield at, to, bulge
                at = to


def through(at, points):
    """Start, middle and end of 32 arcs along each cubic, one after the other."""
    for three in points.reshape(-1, 3, 2):
        on = [at, *map(tuple, bezier(np.array(at), *three))]
        for i in range(0, 64, 2):
            yield from (on[i], np.array(on[i + 1]), on[i + 2])
        at = on[-1]


# Written for older Qt bindings, which took a float for an int; nothing of the import is touched.
DXF2GCODE = """
import runpy, sys
import dxf2gcode.gui.messagebox as messages
import dxf2gcode.gui.routetext as route
font = route.QFont
route.QFont = lambda family, size=-1, *more: font(family, max(1, int(size)), *more)
messages.MessageBox.write = lambda self, text: None
sys.argv = ["dxf2gcode", "-q", "-e", sys.argv[2], sys.argv[1]]
runpy.run_path("/usr/bin/dxf2gcode", run_name="__main__")
"""


def gcode_segments(text):
    """Moves with the cutter down, each contour once."""
    seen, at = set(), (0.0, 0.0)
    for line in text.splitlines():
        words = dict((k, float(v)) for k, v in re.findall(r"([GXYIJZ]) *(-?[\d.]+)", line.split("(")[0]))
        if "X" not in words and "Y" not in words:
            continue
        to = (words.get("X", at[0]), words.get("Y", at[1]))
        move = (at, to)
        if words.get("G", 0) in (1, 2, 3) and move not in seen and math.dist(*move) > 0:
            seen.add(move)
            bulge = 0.0
            if words["G"] in (2, 3):
                cx, cy = at[0] + words["I"], at[1] + words["J"]
                turn = math.atan2(to[1] - cy, to[0] - cx) - math.atan2(at[1] - cy, at[0] - cx)
                sweep = turn % (2 * math.pi) if words["G"] == 3 else -(-turn % (2 * math.pi))
                bulge = math.tan(sweep / 4)
            yield at, to, bulge
        elif words.get("G", 0) in (2, 3) and math.dist(*move) == 0 and (at, "full") not in seen:
            seen.add((at, "full"))
            cx, cy = at[0] + words["I"], at[1] + words["J"]
            across = (2 * cx - at[0], 2 * cy - at[1])
            yield from ((at, across, 1.0), (across, at, 1.0))
        at = to


def by_dxf2gcode(files, options):
    program = Path("/usr/bin/dxf2gcode")
    if not program.exists():
        raise Missing("dxf2gcode is not there")
    folder = options.directory / "dxf2gcode"
    folder.mkdir(exist_ok=True)
    (folder / "drive.py").write_text(DXF2GCODE)

    def imported(path):
        out = folder / (path.stem + ".ngc")
        out.unlink(missing_ok=True)
        # It fails at its end, after the export, in taking down its windows.
        home = {"HOME": str(folder), "XDG_CONFIG_HOME": str(folder)}
        told = run(["/usr/bin/python3", str(folder / "drive.py"), str(path), str(out)], env=home)
        assert out.exists(), told.stderr[-2000:]
        return joined(gcode_segments(out.read_text(errors="replace")), 5e-3)

    # The version of 2019 takes each bulge of an LWPOLYLINE for the segment before it: a half disc loses its arc.
    probe = folder / "probe.dxf"
    document = ezdxf.new("R2000", units=4)
    document.modelspace().add_lwpolyline([(-50, 0, 0), (50, 0, 1), (50, 60, 0), (-50, 60, 0)], format="xyb", close=True)
    document.saveas(probe)
    [slot] = imported(probe)
    right = 100 * 60 + math.pi * 30**2 / 2
    if abs(slot.area() - right) > 1:
        print("dxf2gcode: reads the arcs of an LWPOLYLINE one vertex late, also those of others: only r12 is asked of it")
        files = [f for f in files if "-r12" in f.stem]
    # Three decimals.
    return "dxf2gcode", {f: imported(f) for f in files}, (5e-3, 1e-4), 1e-4


READERS = [by_ezdxf, by_freecad, by_freecad_legacy, by_librecad, by_inkscape, by_dxf2gcode]


def written(binary, directory):
    """The files of every case and version, and what camgen says of each: wires, length of the outline, area."""
    expected = {}
    for case, command in CASES.items():
        fine = None
        if case in FINE_ARCS:
            words = [*FINE_ARCS[case], "--json", "--format", "dxf", "--name", f"{case}-arcs", "--out", str(directory / "arcs")]
            fine = json.loads(subprocess.run([binary, *words], check=True, capture_output=True, text=True).stdout)
        for version in VERSIONS:
            # R12 has no SPLINE.
            if fine and version == "r12":
                continue
            name = f"{case}-{version}"
            flags = ["--json", "--format", "dxf", "--dxf-version", version, "--name", name, "--out", str(directory)]
            made = subprocess.run([binary, *command, *flags], check=True, capture_output=True, text=True)
            report = json.loads(made.stdout)
            report = fine and {**fine, "files": report["files"]} or report
            sections = report.get("sections", [report["cam"]])
            lengths = [report["outline"].get("length_mm")] if len(sections) == 1 else [None] * len(sections)
            for path, section, length in zip(report["files"], sections, lengths, strict=True):
                path = Path(path)
                # Splines and the arcs between them make one wire.
                space = [e.dxftype() for e in ezdxf.readfile(path).modelspace()]
                written = sum(kind in ("CIRCLE", "LWPOLYLINE", "POLYLINE") for kind in space) + ("SPLINE" in space)
                expected[path] = (written, length, section["area_mm2"])
    return expected


def judge(wires, expected, precision, length_share):
    """What is wrong with the wires of a file, and how far length and area are off."""
    count, length, area = expected
    found = sorted(wires, key=lambda wire: wire.area(), reverse=True)
    net = found[0].area() - sum(wire.area() for wire in found[1:]) if found else 0.0
    off_length = abs(found[0].length() / length - 1) if found and length else 0.0
    off_area = abs(net / area - 1)
    wrong = []
    if len(found) != count:
        wrong.append(f"{len(found)} wires, not {count}")
    wrong += [f"{sum(not wire.closed for wire in found)} wires are open"] if not all(w.closed for w in found) else []
    if off_area > precision[1]:
        wrong.append(f"area {net:.3f} mm², not {area:.3f}")
    if off_length > length_share:
        wrong.append(f"length {found[0].length():.4f} mm, not {length:.4f}")
    return wrong, off_length, off_area


def picture(wires, path):
    points = [wire.points() for wire in wires]
    low, high = np.min([p.min(axis=0) for p in points], axis=0), np.max([p.max(axis=0) for p in points], axis=0)
    size = high - low
    lines = [
        f'<path d="M {" L ".join(f"{x:.3f},{-y:.3f}" for x, y in p)}{" Z" if wire.closed else ""}" fill="none"'
        f' stroke="{"black" if wire.closed else "red"}" stroke-width="0.8"/>'
        for wire, p in zip(wires, points, strict=True)
    ]
    box = f"{low[0] - 5} {-high[1] - 5} {size[0] + 10} {size[1] + 10}"
    path.write_text(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{box}" width="400">{"".join(lines)}</svg>')


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("binary", type=Path)
    parser.add_argument("directory", type=Path)
    parser.add_argument("--install", action="store_true", help="apt-get install what is missing, as root")
    parser.add_argument("--pictures", action="store_true", help="an SVG of what each program has read")
    parser.add_argument("--freecad-library", type=Path, help="directory of dxfReader.py for FreeCAD's older importer")
    options = parser.parse_args()
    options.directory = options.directory.resolve()
    options.directory.mkdir(parents=True, exist_ok=True)
    if options.install:
        subprocess.run(["apt-get", "update", "-qq"], check=True)
        subprocess.run(["apt-get", "install", "-y", "-qq", "--no-install-recommends", *PACKAGES], check=True)
    expected = written(options.binary.resolve(), options.directory)
    failed, left_out = 0, []
    print(f"{'importer':34} {'files':>5} {'wires':>5} {'length off':>10} {'area off':>9}")
    for reader in READERS:
        try:
            name, found, precision, length_share = reader(list(expected), options)
        except Missing as missing:
            left_out.append(f"{reader.__name__.removeprefix('by_').replace('_', ', ')}: {missing}")
            continue
        worst = [0.0, 0.0]
        for path, wires in found.items():
            wrong, *off = judge(wires, expected[path], precision, length_share)
            worst = [max(a, b) for a, b in zip(worst, off, strict=True)]
            failed += bool(wrong)
            if wrong:
                print(f"{name}: {path.name} FAILED: {'; '.join(wrong)}")
            if options.pictures and wires:
                picture(wires, options.directory / f"{reader.__name__.removeprefix('by_')}-{path.stem}.svg")
        count = sum(len(wires) for wires in found.values())
        print(f"{name:34} {len(found):5} {count:5} {worst[0]:10.1e} {worst[1]:9.1e}")
    for words in left_out:
        print(f"not tried: {words}")
    sys.exit(failed > 0)


main()
