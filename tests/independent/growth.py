"""Looks for run times that grow faster than the input: every reader at sizes n, 2n and 4n.

Drawings (lines, arcs, polylines, splines, blocks, layers, ends that branch, that nearly touch, that coincide), solids, programs in every dialect,
tables of points, of servo drives, of inspection and of a gauge, lift tables, outlines and machine files. The time of a run is that of the
processor minus the time for an empty file, the least of up to three runs, so that a busy machine does not matter. Four times the size may take eight
times as long (work in proportion takes four times, quadratic work sixteen times); runs below a tenth of a second are not judged.

usage: growth.py CAMGEN_BINARY DIRECTORY [--sizes SHARE] [--only WORD] [--verbose]
"""
import argparse
import math
import os
import random
import re
import resource
import subprocess
import sys
from pathlib import Path

MOST_GROWTH = 8.0  # times the time for four times the size
JUDGED = 0.1  # s
RUNS = 3
PATIENCE = 15  # s of the processor

HEAD = "0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1015\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n"
OPEN, CLOSE = "0\nSECTION\n2\nENTITIES\n", "0\nENDSEC\n0\nEOF\n"


def drawing(entities, blocks=""):
    return HEAD + (f"0\nSECTION\n2\nBLOCKS\n{blocks}0\nENDSEC\n" if blocks else "") + OPEN + "".join(entities) + CLOSE


def line(a, b, layer="CAM_PROFILE"):
    return f"0\nLINE\n8\n{layer}\n10\n{a[0]:.9g}\n20\n{a[1]:.9g}\n11\n{b[0]:.9g}\n21\n{b[1]:.9g}\n"


def arc(centre, radius, start, end, layer="CAM_PROFILE"):
    return f"0\nARC\n8\n{layer}\n10\n{centre[0]:.9g}\n20\n{centre[1]:.9g}\n40\n{radius:.9g}\n50\n{start:.9g}\n51\n{end:.9g}\n"


def circle(x, y, radius, layer):
    return f"0\nCIRCLE\n8\n{layer}\n10\n{x:.9g}\n20\n{y:.9g}\n40\n{radius:.9g}\n"


def polyline(points, layer="CAM_PROFILE"):
    return f"0\nLWPOLYLINE\n8\n{layer}\n90\n{len(points)}\n70\n1\n" + "".join(f"10\n{x:.9g}\n20\n{y:.9g}\n" for x, y in points)


def old_polyline(points):
    vertices = "".join(f"0\nVERTEX\n8\nCAM_PROFILE\n10\n{x:.9g}\n20\n{y:.9g}\n" for x, y in points)
    return f"0\nPOLYLINE\n8\nCAM_PROFILE\n66\n1\n70\n1\n{vertices}0\nSEQEND\n"


def spline(poles):
    knots = [0, 0, 0, *range(len(poles) - 2), *[len(poles) - 3] * 3]
    return f"0\nSPLINE\n8\nCAM_PROFILE\n70\n8\n71\n3\n72\n{len(knots)}\n73\n{len(poles)}\n" + "".join(f"40\n{k}\n" for k in knots) + "".join(f"10\n{x:.9g}\n20\n{y:.9g}\n" for x, y in poles)


def vertices_of(text):
    """The vertices of the first polyline of a camgen file, with the bulge of the segment after each."""
    lines = [one.strip() for one in text.splitlines()]
    groups = list(zip(lines[::2], lines[1::2]))
    at, found = groups.index(("0", "LWPOLYLINE")) + 1, []
    while groups[at][0] != "0":
        code, value = groups[at]
        if code == "10":
            found.append([float(value), 0.0, 0.0])
        elif code in ("20", "42"):
            found[-1][1 if code == "20" else 2] = float(value)
        at += 1
    return found


def between(a, b, share):
    """The point at a share of a segment with a bulge."""
    (x0, y0, bulge), (x1, y1, _) = a, b
    if abs(bulge) < 1e-14:
        return x0 + (x1 - x0) * share, y0 + (y1 - y0) * share
    off = (1 - bulge * bulge) / (4 * bulge)
    cx, cy = (x0 + x1) / 2 - (y1 - y0) * off, (y0 + y1) / 2 + (x1 - x0) * off
    angle = math.atan2(y0 - cy, x0 - cx) + 4 * math.atan(bulge) * share
    return cx + math.hypot(x0 - cx, y0 - cy) * math.cos(angle), cy + math.hypot(x0 - cx, y0 - cy) * math.sin(angle)


def along(vertices, count):
    """About `count` points of a closed polyline."""
    pairs = list(zip(vertices, vertices[1:] + vertices[:1]))
    lengths = [math.hypot(b[0] - a[0], b[1] - a[1]) for a, b in pairs]
    found = []
    for (a, b), length in zip(pairs, lengths):
        parts = max(1, round(count * length / sum(lengths)))
        found += [between(a, b, part / parts) for part in range(parts)]
    return found


def finer(text, times):
    """A table with interpolated rows between its rows; other lines stay."""
    number = re.compile(r"[-+]?\d[\d.eE+-]*")
    rows, found = text.splitlines(), []
    for row, following in zip(rows, rows[1:] + [""]):
        found.append(row)
        own, other = number.findall(row), number.findall(following)
        if not row[:1].isdigit() or len(own) != len(other) or not following[:1].isdigit():
            continue
        for part in range(1, times):
            values = iter(f"{float(a) + (float(b) - float(a)) * part / times:.12g}" for a, b in zip(own, other))
            found.append(number.sub(lambda _: next(values), row))
    return "\n".join(found) + "\n"


class Made:
    """camgen's files, from which larger ones are made."""

    def __init__(self, binary, directory):
        def make(out, *words):
            subprocess.run([binary, "make", "feeder", "--name", "f", "--out", out, "--overwrite", "--quiet", *words], cwd=directory, check=True)

        make("made", "--format", "dxf,step,points,servo-csv,servo-xyva,servo-isg,inspect,gauge,csv")
        self.programs = {}
        for control, ending in (("linuxcnc", "ngc"), ("fanuc", "nc"), ("sinumerik", "mpf"), ("heidenhain", "h")):
            make(control, "--format", "gcode", "--controller", control, "--cutter-diameter", "8mm")
            self.programs[control] = (directory / control / f"f.{ending}").read_text()
        self.outline = vertices_of((directory / "made/f.dxf").read_text())
        self.path = vertices_of((directory / "linuxcnc/f-cutter.dxf").read_text())
        self.text = lambda ending: (directory / f"made/f{ending}").read_text()


def drawings(made, rng):
    """Kinds of drawings, each by its number of entities."""
    own = polyline([(x, y) for x, y, _ in made.outline])
    ring = lambda n: along(made.outline, n)
    sides = lambda points: [line(a, b) for a, b in zip(points, points[1:] + points[:1])]

    def loose(n, layer):
        for _ in range(n):
            x, y, turn = rng.uniform(-50, 50), rng.uniform(-50, 50), rng.uniform(0, math.tau)
            yield line((x, y), (x + math.cos(turn), y + math.sin(turn)), layer)

    def grid(n, layer):
        wide = int(n ** 0.5) + 1
        return [circle(-9 + 18 * (i % wide) / wide, -9 + 18 * (i // wide) / wide, 1 / wide, layer) for i in range(n)]

    def shuffled(all):
        rng.shuffle(all)
        return all

    def block(name, inside):
        return f"0\nBLOCK\n8\n0\n2\n{name}\n70\n0\n10\n0\n20\n0\n{inside}0\nENDBLK\n"

    def insert(name, x=0.0, layer="PARTS"):
        return f"0\nINSERT\n8\n{layer}\n2\n{name}\n10\n{x}\n20\n0\n"

    one = line((0, 0), (1, 1), "0")
    yield "lines in order", 25_000, lambda n: drawing(sides(ring(n)))
    yield "lines in any order", 25_000, lambda n: drawing(shuffled(sides(ring(n))))
    yield "lines in any order and unit", 25_000, lambda n: drawing(shuffled(sides([(x / 25.4, y / 25.4) for x, y in ring(n)])))
    yield "lines of a circle", 12_500, lambda n: drawing(sides([(50 * math.cos(math.tau * i / n), 50 * math.sin(math.tau * i / n)) for i in range(n)]))
    yield "lines that nearly touch", 25_000, lambda n: drawing([line(a, (b[0] - 1e-3 * (b[0] - a[0]), b[1] + 1e-3)) for a, b in zip(ring(n), ring(n)[1:])])
    yield "lines that do not touch, on the layer of the outline", 25_000, lambda n: drawing([own, *loose(n, "CAM_PROFILE")])
    yield "lines that do not touch, on another layer", 25_000, lambda n: drawing([own, *loose(n, "OTHER")])
    yield "only lines that do not touch", 25_000, lambda n: drawing(loose(n, "0"))
    yield "lines side by side", 25_000, lambda n: drawing(line((1e-3 * i, 0), (1e-3 * i, 40)) for i in range(n))
    yield "lines from one point", 25_000, lambda n: drawing(line((0, 0), (40 * math.cos(i), 40 * math.sin(i))) for i in range(n))
    yield "lines between two points", 25_000, lambda n: drawing(line((0, 0), (40, 1e-9 * i)) for i in range(n))
    yield "a tree of lines", 25_000, lambda n: drawing(line((i // 3, i % 3), (i // 3 + 1, (i + 1) % 3)) for i in range(n))
    yield "equal lines", 25_000, lambda n: drawing([own, line((0, 0), (1, 1)) * n])
    yield "points without length", 25_000, lambda n: drawing([own, line((1, 1), (1, 1)) * n])
    yield "arcs of a circle", 12_500, lambda n: drawing(arc((0, 0), 40, 360 * i / n, 360 * (i + 1) / n) for i in range(n))
    yield "arcs that do not touch", 25_000, lambda n: drawing([own, *(arc((rng.uniform(-50, 50), rng.uniform(-50, 50)), 1, 0, 90) for _ in range(n))])
    yield "circles in each other", 25_000, lambda n: drawing(circle(0, 0, 20 + 20 * i / n, "CAM_PROFILE") for i in range(n))
    yield "holes", 12_500, lambda n: drawing([own, *grid(n, "HOLES")])
    yield "holes on the layer of the bore", 12_500, lambda n: drawing([own, *grid(n, "BORE")])
    yield "a polyline", 25_000, lambda n: drawing([polyline(ring(n))])
    yield "a polyline of old", 25_000, lambda n: drawing([old_polyline(ring(n))])
    yield "a polyline with equal vertices", 25_000, lambda n: drawing([polyline([point for point in ring(500) for _ in range(n // 500)])])
    yield "a polyline that wanders", 12_500, lambda n: drawing([polyline([(40 * math.cos(2.4 * i / n) * (1 + i / n), 40 * math.sin(6 * i / n)) for i in range(n)])])
    yield "polylines", 25_000, lambda n: drawing([own, *(polyline([(i, 0), (i + 0.5, 0), (i, 1)], "OTHER") for i in range(n // 3))])
    yield "a spline", 12_500, lambda n: drawing([spline((ring(n) * 2)[: n + 3])])
    yield "splines", 5_000, lambda n: drawing([own, *(spline([(i, 0), (i + 0.2, 1), (i + 0.4, -1), (i + 0.6, 0)]) for i in range(n))])
    yield "blocks", 12_500, lambda n: drawing([own, *(insert(f"B{i}", i) for i in range(n))], "".join(block(f"B{i}", one) for i in range(n)))
    yield "insertions of one block", 25_000, lambda n: drawing([own, *(insert("B", i) for i in range(n))], block("B", one))
    yield "a large block", 25_000, lambda n: drawing([own, insert("B")], block("B", "".join(line((i, 0), (i + 0.5, 1), "0") for i in range(n))))
    yield "blocks in blocks", 12_500, lambda n: drawing([own, insert("B0")], "".join(block(f"B{i}", insert(f"B{i + 1}") + one) for i in range(n)))
    yield "layers", 25_000, lambda n: drawing([own, *(line((i, 0), (i + 0.5, 9), f"L{i}") for i in range(n))])
    yield "texts", 25_000, lambda n: drawing([own, *(f"0\nTEXT\n8\nCAM_PROFILE\n10\n{i}\n20\n0\n1\nA\n" for i in range(n))])
    yield "kinds that are unknown", 25_000, lambda n: drawing([own, *(f"0\nK{i}\n8\nL{i}\n10\n{i}\n" for i in range(n))])


def solid(made, count, doubled=False):
    """camgen's solid with more instances, or with the same lines again under other numbers."""
    text = made.text(".step")
    head, rest = text.split("DATA;", 1)
    data, tail = rest.split("ENDSEC;", 1)
    top = max(int(number) for number in re.findall(r"#(\d+)\s*=", data)) + 1
    if doubled:
        copies = max(1, count // data.count("\n"))
        more = "".join(re.sub(r"#(\d+)", lambda number: f"#{int(number[1]) + copy * top}", data) for copy in range(1, copies))
    else:
        more = "".join(f"#{top + i}=CARTESIAN_POINT('',({i}.,0.,0.));\n" for i in range(count))
    return f"{head}DATA;{data}{more}ENDSEC;{tail}"


def program(made, control, count):
    """camgen's program with its path as `count` straight moves."""
    points = along(made.path, count)
    lines = made.programs[control].splitlines()
    is_move = lambda text: re.match(r"(N?\d+ )?(G[123] X|L X|C X|CC X)", text) and "FMAX" not in text and "G0" not in text
    first = next(at for at, text in enumerate(lines) if is_move(text))
    last = max(at for at, text in enumerate(lines) if is_move(text))
    if control == "heidenhain":
        move = lambda at, x, y: f"{first + at} L X{x:+.5f} Y{y:+.5f}{' R0 F300' if at == 0 else ''}"
    else:
        move = lambda at, x, y: f"G1 X{x:.5f} Y{y:.5f}{' F300.' if at == 0 else ''}"
    return "\n".join([*lines[:first], *(move(at, x, y) for at, (x, y) in enumerate(points + points[:1])), *lines[last + 1 :]]) + "\n"


def checked(made, rng):
    """All inputs of `check`, with the ending of the file name."""
    for name, size, text in drawings(made, rng):
        yield f"drawing, {name}", ".dxf", size, text
    yield "solid, points", ".step", 25_000, lambda n: solid(made, n)
    yield "solid, copies", ".step", 25_000, lambda n: solid(made, n, True)
    for control in made.programs:
        yield f"program, {control}", ".nc", 12_500, lambda n, control=control: program(made, control, n)
        yield f"program, {control}, comments", ".nc", 50_000, lambda n, control=control: made.programs[control].replace("\n", "\n" + ("; a\n" if control in ("sinumerik", "heidenhain") else "(a)\n") * n, 1)
    yield "program, variables", ".ngc", 25_000, lambda n: "".join(f"#{i % 5000 + 1}={i}\n" for i in range(n)) + made.programs["linuxcnc"]
    yield "program, a long line", ".ngc", 25_000, lambda n: made.programs["linuxcnc"].replace("F300", "F300" + " " * n, 1)
    for ending, rows in (("-points.csv", 238), ("-servo.csv", 15), ("-inspect.csv", 360), ("-gauge.csv", 360), (".csv", 720)):
        yield f"table, {ending}", ending, 12_500, lambda n, ending=ending, rows=rows: finer(made.text(ending), max(1, n // rows))
    yield "table, -isg.txt", "-isg.txt", 25_000, lambda n: re.sub(r"Lines = \d+", f"Lines = {n}", made.text("-isg.txt").split("Begintable\n")[0]) + "Begintable\n" + "".join(f"{15 - 15 * math.cos(math.tau * i / n):.4f}\n" for i in range(n)) + "Endtable\n"


def lift(angle):
    share = min(angle, 360 - angle) / 180
    return 20 * (share - math.sin(math.tau * share) / math.tau)


def rows(count, noise=0.0, rng=None):
    return "deg;mm\n" + "".join(f"{360 * i / count:.9g};{lift(360 * i / count) + (rng.gauss(0, noise) if noise else 0):.6f}\n" for i in range(count))


def designs(motion):
    return f'name = "growth"\n[motion]\nrpm = 60\n{motion}\n[follower.roller]\nradius = "10 mm"\n[cam]\nbase_radius = "60 mm"\nthickness = "10 mm"\n'


def commands(made, rng):
    """Inputs of other commands: file name, text and command; tables are next to the design."""
    as_table = lambda n, noise, command: ("rows.csv", rows(n, noise, rng), command)
    imported = ["import", "rows.csv", "--from", "table", "--follower", "roller,diameter=20mm", "--dry-run"]
    yield "import, exact rows", 2_500, lambda n: as_table(n, 0, imported)
    yield "import, noisy rows", 1_000, lambda n: as_table(n, 0.01, [*imported, "--deviation", "0.01um"])
    points = lambda n: ("points.csv", "x;y\n" + "".join(f"{x:.6f};{y:.6f}\n" for x, y in along(made.outline, n)))
    yield "import, points", 1_000, lambda n: (*points(n), ["import", "points.csv", "--from", "points", "--follower", "roller,diameter=30mm", "--dry-run"])
    yield "import, an outline", 5_000, lambda n: ("outline.dxf", drawing([polyline(along(made.outline, n))]), ["import", "outline.dxf", "--follower", "roller,diameter=30mm", "--deviation", "30um", "--dry-run"])
    yield "compare, points", 5_000, lambda n: (*points(n), ["compare", "points.csv", "feeder"])
    described = lambda text: ("design.toml", text, ["make", "design.toml", "--dry-run"])
    yield "design, points", 1_250, lambda n: described(designs('start = "0 mm"\npoints = [' + ", ".join(f'["{360 * i / n:.9g} deg", "{lift(360 * i / n):.6f} mm"]' for i in range(n)) + "]"))
    half = lambda n, i: f'[[motion.segment]]\nlaw = "cycloidal"\nover = "{360 / n:.9g} deg"\nto = "{0.1 * (1 - i % 2)} mm"\n'
    yield "design, segments", 250, lambda n: described(designs('start = "0 mm"\n' + "".join(half(n, i) for i in range(n - 1)) + '[[motion.segment]]\nlaw = "cycloidal"\nto = "0 mm"\n'))
    constant = designs('start = "0 mm"\n[motion.fourier]\ncos = [1]\n')
    broken = lambda more: described(constant.replace("[motion]", more + "[motion]", 1))
    yield "design, unknown keys", 5_000, lambda n: broken("".join(f"key{i} = {i}\n" for i in range(n)))
    yield "design, unknown tables", 5_000, lambda n: described(constant + "".join(f"[table{i}]\nkey = 1\n" for i in range(n)))
    yield "design, comments", 10_000, lambda n: broken("# a comment\n" * n)
    yield "design, a long list", 10_000, lambda n: broken(f"list = [{'1, ' * n}1]\n")
    yield "design, a long name", 100_000, lambda n: described(constant.replace("growth", "a" * n))
    yield "design, overrides", 250, lambda n: ("design.toml", constant, ["make", "design.toml", "--dry-run", *(word for i in range(n) for word in ("--set", f"cam.thickness={i + 1}mm"))])


def seconds(words, directory):
    """Processor time of a run, and its exit code."""
    limit = lambda: resource.setrlimit(resource.RLIMIT_CPU, (PATIENCE, PATIENCE))
    run = subprocess.Popen(words, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, cwd=directory, preexec_fn=limit)
    _, status, used = os.wait4(run.pid, 0)
    run.returncode = os.waitstatus_to_exitcode(status)
    return used.ru_utime + used.ru_stime, run.returncode


def growth(sizes, prepared, directory, empty):
    """Times at n, 2n and 4n, last time / first time, and the exit codes."""
    def measured(size, times):
        words = prepared(size)
        runs = [seconds(words, directory) for _ in range(times)]
        return max(1e-3, min(time for time, _ in runs) - empty), runs[0][1]

    for runs in (1, RUNS):
        found = [measured(size, runs) for size in sizes]
        times = [time for time, _ in found]
        grows = times[2] / times[0]
        if times[2] < JUDGED or grows <= MOST_GROWTH:
            break
    return times, grows, [code for _, code in found]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("binary", type=lambda text: str(Path(text).resolve()))
    parser.add_argument("directory", type=lambda text: Path(text).resolve() / "growth")
    parser.add_argument("--sizes", type=float, default=1.0)
    parser.add_argument("--only", default="")
    parser.add_argument("--verbose", action="store_true")
    words = parser.parse_args()
    words.directory.mkdir(parents=True, exist_ok=True)
    rng, made = random.Random(1), Made(words.binary, words.directory)
    empty = min(seconds([words.binary, "check", "made/f.dxf", "--design", "feeder"], words.directory)[0] for _ in range(3))

    def of_file(name, text, command):
        (words.directory / name).write_text(text)
        return [words.binary, *command]

    def of_check(ending, text):
        return lambda size: of_file(f"large{ending}", text(size), ["check", f"large{ending}", "--design", "feeder", "--quiet"])

    def of_command(prepared):
        return lambda size: of_file(*prepared(size))

    all_cases = [(name, size, of_check(ending, text)) for name, ending, size, text in checked(made, rng)]
    all_cases += [(name, size, of_command(prepared)) for name, size, prepared in commands(made, rng)]
    wrong, judged, worst, total = 0, 0, (0.0, ""), 0
    for name, size, prepared in all_cases:
        if words.only not in name:
            continue
        sizes = [max(8, int(words.sizes * times * size)) for times in (1, 2, 4)]
        times, grows, codes = growth(sizes, prepared, words.directory, empty)
        total += 1
        # A size refused before reading has no time to compare.
        is_judged = times[2] >= JUDGED and (codes[0] == codes[2] or 2 not in (codes[0], codes[2]))
        judged += is_judged
        bad = (is_judged and grows > MOST_GROWTH) or not set(codes) <= {0, 1, 2}
        if is_judged:
            worst = max(worst, (grows, name))
        wrong += bad
        if bad or words.verbose:
            print(f"{'WRONG ' if bad else ''}{name}: {', '.join(f'{time:.2f}' for time in times)} s for {sizes}, {grows:.1f} times; exit {codes}", flush=True)
    print(f"{total} readers, {judged} of them judged at n, 2n and 4n; the time for 4n is at most {worst[0]:.1f} times that for n ({worst[1]}); {wrong} wrong")
    sys.exit(wrong > 0)


if __name__ == "__main__":
    main()
