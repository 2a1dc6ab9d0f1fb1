"""Makes random designs in millimetres and in inches and compares their files: the same cam in either, each file stating its unit.

Shares nothing with camgen. DXF files are read by ezdxf: every point, bulge and radius of the file in inches times 25.4 is that of the file in
millimetres to 1e-9 mm. Tables are compared by the names of their columns. Programs are run by the interpreters of gcode.py, those in inches scaled
here by 25.4 (feeds of HEIDENHAIN's dialogue are in tenths of an inch per minute): the cutter goes the same way but for the tolerance. Then the unit of
each file is changed and nothing else, and `camgen check` must refuse it: a cut file in inches that is taken for millimetres is the worst error.

usage: inches.py CAMGEN_BINARY DIRECTORY [--count N] [--seed S]
"""
import argparse
import json
import random as randoms
import re
import subprocess
from pathlib import Path

import ezdxf
import gcode
import groove
import numpy as np
import rib
from form_closed import program, rise_and_return
from shapely import LineString, STRtree, linestrings, points

INCH = 25.4
TOLERANCE = 20e-3
EXACT = 1e-9
FORMATS = "dxf,csv,points,inspect,servo-csv,servo-xyva,servo-twincat,servo-isg,gcode,svg,pdf,step,json"
# grbl needs a cutter for every program.
CONTROLS = {control: ending for control, ending in gcode.CONTROLS.items() if control != "grbl"}


def design(random):
    """A disc, a ring, a groove or a rib of random dimensions, or a plate."""
    if random.random() < 0.2:
        stroke, lift = random.uniform(80, 200), random.uniform(5, 25)
        laws = [random.choice(["modified-sine", "3-4-5", "cycloidal"]) for _ in range(2)]
        lines = ['name = "plate"', "[motion]", f'stroke = "{stroke!r} mm"', 'start = "0 mm"', "[[motion.segment]]", f'law = "{laws[0]}"',
                 f'over = "{0.5 * stroke!r} mm"', f'to = "{lift!r} mm"', "[[motion.segment]]", f'law = "{laws[1]}"', f'to = "{1.2 * lift!r} mm"',
                 "[follower.roller]", f'diameter = "{random.uniform(10, 40)!r} mm"', "[cam]", 'body = "wedge"', 'run_in = "20 mm"', 'thickness = "12 mm"',
                 "[limits]", 'pressure_angle = "60 deg"']
        return "wedge", "\n".join(lines) + "\n", 12.0
    if random.random() < 0.3:
        # A cam as a shop in inches gives it.
        lift = random.choice([0.25, 0.375, 0.5, 0.75])
        lines = program([(law, over, to / INCH) for law, over, to in rise_and_return(random, lift * INCH)], "in")
        lines += ["[follower.roller]", f'diameter = "{random.choice([0.5, 0.75, 1.0])} in"', "[cam]", f'base_radius = "{random.choice([2.5, 3.0, 3.75])} in"',
                  'thickness = "0.75 in"', 'bore_diameter = "0.75 in"', "[limits]", 'pressure_angle = "45 deg"']
        return "disc", "\n".join(lines) + "\n", 0.75 * INCH
    kind = random.choice(["disc", "ring", "groove", "rib"])
    if kind == "rib":
        return kind, rib.toml(rib.design(random)), rib.THICKNESS
    found = groove.design(random)
    found["body"] = "ring" if kind == "ring" else "groove"
    text = groove.toml(found)
    if kind == "disc":
        text = "\n".join(line for line in text.splitlines() if not re.match("body|clearance|groove_depth", line)) + "\n"
    return kind, text, 12.0 if kind == "groove" else 20.0


def made(binary, folder, control, version, *rest):
    command = [binary, "make", str(folder.parent / "design.toml"), "--out", str(folder), "--name", "cam", "--json", "--overwrite", "--tolerance", "20um",
               "--tolerance-acceleration", "none", "--controller", control, "--dxf-version", version, *rest]
    return subprocess.run(command, capture_output=True, text=True)


def numbers(entity):
    """The numbers of an entity: lengths, then those without a unit."""
    match entity.dxftype():
        case "LWPOLYLINE":
            rows = list(entity.get_points("xyb"))
            return [v for x, y, _ in rows for v in (x, y)], [b for *_, b in rows]
        case "POLYLINE":
            rows = [(v.dxf.location.x, v.dxf.location.y, v.dxf.get("bulge", 0.0)) for v in entity.vertices]
            return [v for x, y, _ in rows for v in (x, y)], [b for *_, b in rows]
        case "CIRCLE":
            return [*entity.dxf.center, entity.dxf.radius], []
        case "LINE":
            return [*entity.dxf.start, *entity.dxf.end], []
        case "ARC":
            return [*entity.dxf.center, entity.dxf.radius], [entity.dxf.start_angle, entity.dxf.end_angle]
        case "SPLINE":
            return [v for point in entity.control_points for v in point], []
    raise AssertionError(entity.dxftype())


def drawings(metric, inch):
    """Largest difference of the lengths of two DXF files, mm, and of what has no unit."""
    one, two = ezdxf.readfile(metric), ezdxf.readfile(inch)
    assert (one.header["$INSUNITS"], one.header["$MEASUREMENT"]) == (4, 1), metric
    assert (two.header["$INSUNITS"], two.header["$MEASUREMENT"]) == (1, 0), inch
    first, second = list(one.modelspace()), list(two.modelspace())
    assert [(e.dxftype(), e.dxf.layer) for e in first] == [(e.dxftype(), e.dxf.layer) for e in second] and first
    worst = [0.0, 0.0]
    for a, b in zip(first, second):
        (lengths, ratios), (inches, others) = numbers(a), numbers(b)
        worst[0] = max(worst[0], np.abs(np.array(lengths) - INCH * np.array(inches)).max())
        worst[1] = max([worst[1], *np.abs(np.array(ratios) - np.array(others))])
    extents = [np.array(document.header[name][:2]) for document in (one, two) for name in ("$EXTMIN", "$EXTMAX")]
    assert np.abs(np.concatenate(extents[:2]) - INCH * np.concatenate(extents[2:])).max() < EXACT
    return worst


def table(path):
    lines = [line for line in path.read_text().splitlines() if not line.startswith("#")]
    return lines[0].split(","), np.array([[float(cell) for cell in line.split(",")] for line in lines[1:]])


def tables(metric, inch):
    """Each column of a table in inches is that of millimetres with `in` for `mm`, its numbers by the power of the inch in its name."""
    (names, rows), (others, values) = table(metric), table(inch)
    for name, other, column, found in zip(names, others, rows.T, values.T, strict=True):
        assert other == re.sub(r"(?<=_)mm(?=\d|_|$)", "in", name), (name, other)
        assert "mm" not in other
        power = 0
        parts = name.split("_")
        for before, part in zip([""] + parts, parts):
            if found_unit := re.fullmatch(r"mm(\d?)", part):
                power += (-1 if before == "per" else 1) * int(found_unit[1] or 1)
        scaled = found * INCH**power
        # What is of the outline as written has the roundings of its twelve decimals, which rates amplify.
        atol, rtol = (1e-5, 1e-5) if "_cut" in name else (2e-11, 1e-13)
        same = np.isclose(column, scaled, rtol=rtol, atol=atol, equal_nan=True) | (column == scaled)
        # The acceleration as cut jumps at the joints of arcs: a row at one has that of either.
        assert same.all() or ("acceleration_cut" in name and same.mean() > 0.95), (name, column[~same][:3], scaled[~same][:3])


def scaled(path, control):
    """The moves of a program in inches as one in mm, by its own interpreter."""
    text = path.read_text()
    if control == "heidenhain":
        assert re.match(r"0 BEGIN PGM \w+ INCH\n", text) and re.search(r"\d+ END PGM \w+ INCH\n$", text), path
        text = text.replace(" INCH\n", " MM\n")
        return gcode.dialogue(in_mm(text, "XYZ", 2.54)), feeds(text, 2.54)
    word = "G700" if control == "sinumerik" else "G20"
    assert re.search(rf"\b{word}\b", text) and not re.search(r"\bG(21|710|71)\b", text), path
    text = text.replace("G700", "G710").replace("G20", "G21")
    return gcode.iso(in_mm(text, "XYZIJ", INCH)), feeds(text, INCH)


def in_mm(text, letters, feed):
    """The lengths of every block outside of comments times 25.4, and its feeds."""
    def block(line):
        code, mark, comment = (line, "", "") if line.startswith(("(", "O")) or ";" not in line else line.partition(";")
        if line.startswith(("(", "O")) or "PGM" in line:
            return line
        code = re.sub(rf"([{letters}])([-+]?[\d.]+)", lambda m: f"{m[1]}{INCH * float(m[2]):+.9f}", code)
        return re.sub(r"F([\d.]+)", lambda m: f"F{feed * float(m[1]):.6f}", code) + mark + comment
    return "\n".join(map(block, text.splitlines())) + "\n"


def feeds(text, unit):
    return sorted({round(unit * float(number), 1) for number in re.findall(r"F(\d[\d.]*)", re.sub(r"\(.*?\)|;.*", "", text))})


def below(moves):
    return np.concatenate([path for _, rapid, path, _ in moves if path[:, 2].max() < -1e-6 and not rapid])


def programs(metric, inch, control):
    """How far the cutter's ways below the face lie apart, mm."""
    run = gcode.dialogue if control == "heidenhain" else gcode.iso
    one = run(metric.read_text())
    two, of_inches = scaled(inch, control)
    of_metric = feeds(metric.read_text(), 1.0)
    assert of_metric == of_inches, (of_metric, of_inches)
    first, second = below(one), below(two)
    assert abs(first[:, 2].min() - second[:, 2].min()) < 2e-3, "depth"
    worst = 0.0
    for a, b in ((first, second), (second, first)):
        lines = linestrings(np.stack([a[:-1, :2], a[1:, :2]], axis=1))
        lines = lines[np.hypot(*(a[1:, :2] - a[:-1, :2]).T) < 1.0]
        tree = STRtree(lines)
        (_, _), distance = tree.query_nearest(points(b[:, :2]), return_distance=True, all_matches=False)
        worst = max(worst, distance.max())
    return worst


# What states the unit of a file, and what the other one would state; `None` is the unit that nothing states.
CHANGES = [
    (".dxf", r"(\$INSUNITS\n 70\n)1\n", r"\g<1>4\n"),
    (".dxf", r"(\$INSUNITS\n 70\n)1\n( *9\n\$MEASUREMENT\n 70\n)0\n", r"\g<1>4\n\g<2>1\n"),
    (".csv", "_in(?=[,\\n_2-9])", "_mm"),
    ("-points.csv", "_in(?=[,\\n:])", "_mm"),
    ("-inspect.csv", "_in(?=[,\\n:])", "_mm"),
    ("-inspect.txt", "# units: inches\n", ""),
    ("-inspect.dmi", "UNITS/INCH", "UNITS/MM"),
    ("-servo.csv", "_in(?=[,\\n_])", "_mm"),
    ("-xyva.st", "slave: in", "slave: mm"),
    ("-twincat.st", "slave: in", "slave: mm"),
    (".ngc", r"\bG20\b", "G21"), (".nc", r"\bG20\b", "G21"), (".mpf", r"\bG700\b", "G710"), (".h", " INCH\n", " MM\n"),
]


def files_of(folder, ending):
    """The files of an ending, of one part or of each flank; `.csv` alone is the table of the cam."""
    return [folder / f"cam{ending}"] if ending == ".csv" else sorted(folder.glob(f"cam*{ending}"))


def checked(binary, path, text, cut):
    command = [binary, "check", str(path), "--design", str(text), "--json", "--tolerance", "20um", "--units", "inch"]
    # An outline is not the path of a cutter: the flag would be refused as without effect.
    return subprocess.run([*command, *(["--cutter-diameter", cut] if cut and path.suffix != ".dxf" else [])], capture_output=True, text=True)


def faults(binary, folder, cut):
    """Files whose unit is changed, and how many of them were accepted."""
    tried, accepted = 0, []
    design = folder.parent / "design.toml"
    for ending, pattern, other in CHANGES:
        for path in files_of(folder, ending):
            if not path.exists() or (ending == ".dxf" and "cutter" in path.name):
                continue
            text = path.read_text()
            changed = re.sub(pattern, other, text)
            if changed == text and ending in ("-servo.csv", "-xyva.st", "-twincat.st"):
                assert "slave_deg" in text or "slave: deg" in text  # an arm's angles have no unit of length
                continue
            assert changed != text, (path, pattern)
            for right, content in ((True, text), (False, changed)):
                planted = folder / f"planted{ending}"
                planted.write_text(content)
                done = checked(binary, planted, design, cut)
                tried += 1
                if right != (done.returncode == 0):
                    accepted.append((path.name, "right" if right else "changed", done.returncode, done.stdout[:300] or done.stderr[:300]))
                planted.unlink()
    return tried, accepted


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("binary")
    parser.add_argument("directory", type=Path)
    parser.add_argument("--count", type=int, default=100)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--faults", type=int, default=1, help="plant faults in the files of every so many designs")
    asked = parser.parse_args()
    binary, random = str(Path(asked.binary).resolve()), randoms.Random(asked.seed)
    worst, ratio, apart, tabled, tried, wrong, done = 0.0, 0.0, 0.0, 0, 0, [], 0
    while done < asked.count:
        kind, text, _ = design(random)
        control, version = random.choice(list(CONTROLS)), random.choice(["r12", "r2000", "r2010", "r2013"])
        spline = ["--outline", "spline"] if version != "r12" and kind == "disc" and random.random() < 0.2 else []
        formats = FORMATS + (",gauge,diagram,html" if kind == "disc" else ",diagram" if kind == "wedge" else "")
        if kind == "wedge":
            formats = ",".join(part for part in formats.split(",") if not part.startswith(("servo", "inspect")))
        root = asked.directory / "inches" / str(done)
        for unit in ("mm", "inch"):
            folder = root / unit
            folder.mkdir(parents=True, exist_ok=True)
            for old in folder.iterdir():
                old.unlink()
        (root / "design.toml").write_text(text)
        cut = "" if kind not in ("disc", "wedge") else random.choice(["6mm", "0.25in"])
        rest = [*spline, "--format", formats, *(["--cutter-diameter", cut] if cut else []), "--set", "cut.decimals=5", "--points-step", "chord",
                "--points-between", "cubic"]
        metric = made(binary, root / "mm", control, version, *rest)
        inch = made(binary, root / "inch", control, version, *rest, "--units", "inch")
        if metric.returncode != 0 and metric.returncode == inch.returncode:
            continue  # a design that breaks a limit in either unit
        assert metric.returncode == inch.returncode == 0, (root, kind, metric.stderr[-300:], inch.stderr[-300:])
        one, two = json.loads(metric.stdout), json.loads(inch.stdout)
        for report in (one, two):
            for key in ("inputs", "files", "notes"):
                report.pop(key, None)
        assert one["cam"] == two["cam"] if "cam" in one else True, "a report for programs is in mm whatever the unit"
        names = sorted(path.name for path in (root / "mm").iterdir())
        assert names == sorted(path.name for path in (root / "inch").iterdir())
        for name in names:
            a, b = root / "mm" / name, root / "inch" / name
            if name.endswith(".dxf"):
                found = drawings(a, b)
                worst, ratio = max(worst, found[0]), max(ratio, found[1])
            elif name.endswith(".csv"):
                tables(a, b)
                tabled += 1
            elif name.endswith(CONTROLS[control]):
                apart = max(apart, programs(a, b, control))
            elif name.endswith("-inspect.txt"):
                lines = b.read_text().splitlines()
                assert lines[0] == "# units: inches"
                rows = [np.array([[float(cell) for cell in line.split()] for line in some]) for some in (a.read_text().splitlines(), lines[1:])]
                assert np.abs(rows[0][:, 1:4] - INCH * rows[1][:, 1:4]).max() < 2e-6 and np.abs(rows[0][:, 4:] - rows[1][:, 4:]).max() < 2e-6
            elif name.endswith(".svg") and "diagram" not in name:
                sheet = re.sub(r"<!--.*?-->|<style.*?</style>", "", b.read_text(), flags=re.S)
                shown = re.findall(r">([^<>]*\bmm\b[^<>]*)<", sheet)
                assert not shown, (b, shown)
            elif name.endswith(".step"):
                assert a.read_bytes().partition(b"DATA;")[2] == b.read_bytes().partition(b"DATA;")[2], "a STEP file stays in mm"
        assert worst < EXACT and ratio < EXACT, (root, worst, ratio)
        assert apart < 2.2 * TOLERANCE, (root, apart)
        if done % asked.faults == 0:
            found = faults(binary, root / "inch", cut)
            tried, wrong = tried + found[0], wrong + found[1]
        done += 1
    print(f"{done} designs in mm and in inches: geometry of DXF files equal to {worst:.1e} mm, bulges and angles to {ratio:.1e}; {tabled} tables equal; "
          f"programs no farther apart than {1e3 * apart:.1f} um at a tolerance of {1e3 * TOLERANCE:.0f} um")
    print(f"{tried} files in inches before camgen check, half of them with another unit: {len(wrong)} wrongly judged")
    for case in wrong[:10]:
        print(" ", *case)
    assert not wrong


main()
