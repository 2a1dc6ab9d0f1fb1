"""Runs the programs of `--format gcode` as their controls would, sweeps the cutter, and compares what is left with the cam computed here.

Shares nothing with camgen but the designs below: the roller's centre comes from the laws of laws.py and the geometry of its mechanism (groove.py,
rib.py), the profile is its parallel by numerical differentiation, and the programs are interpreted here, word by word, in each of the six
dialects; those for LinuxCNC also by its own interpreter `rs274`, with its own compensation of the cutter's radius, where it can be had.
Of every move below the upper face many places are taken: the cutter there must reach into the exact cam by no more than the tolerance (a gouge),
and every place of the exact profile must be reached by the cutter to within the tolerance (metal left over). The cutter may go straight down only outside
a blank that is computed here, or where it has cut before; ramps are at most 5 degrees; rapid moves across are at the safe height. Faults are planted in the
programs, and `camgen check` must refuse each.

usage: gcode.py CAMGEN_BINARY DIRECTORY [--count N] [--seed S]
"""
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path
from random import Random

import cases
import groove
import numpy as np
import rib
from form_closed import failed, make
from shapely import STRtree, linestrings, points

TOLERANCE = 5e-3
# Four decimals of rs274, polygons in the place of curves, and of the integration of the laws.
ROUNDING = 2e-4
CONTROLS = {"linuxcnc": ".ngc", "fanuc": ".nc", "sinumerik": ".mpf", "heidenhain": ".h", "grbl": ".gcode", "mach3": ".tap"}
UNPACKED = Path("target/linuxcnc")
THETA = (np.arange(10000) + 0.5) * (2 * np.pi / 10000)


class Machine:
    """The state of a control, and the moves that it has made: (line, rapid, polygon of x, y, z, side of the cutter)."""

    def __init__(self):
        self.at, self.side, self.moves = [None, None, None], 0, []

    def goes_home(self):
        """Z to a machine position, unknown here."""
        self.at[2] = None

    def go(self, line, rapid, to, centre=None, left=False):
        target = [new if new is not None else old for new, old in zip(to, self.at)]
        if None not in self.at and None not in target:
            a, b = np.array(self.at), np.array(target)
            if centre is None:
                count = max(2, int(np.linalg.norm(b - a) / 0.05))
                path = a + np.linspace(0, 1, count)[:, None] * (b - a)
            else:
                from_, to_ = complex(a[0], a[1]) - centre, complex(b[0], b[1]) - centre
                assert abs(abs(from_) - abs(to_)) < 0.005, f"line {line}: radii {abs(from_)} and {abs(to_)}"
                turn = np.angle(to_ / from_)
                turn += 2 * np.pi if left and turn <= 1e-12 else -2 * np.pi if not left and turn >= -1e-12 else 0
                count = max(3, int(abs(from_) * abs(turn) / 0.05), int(abs(turn) / 0.01))
                share = np.linspace(0, 1, count)
                z = centre + (abs(from_) + (abs(to_) - abs(from_)) * share) * from_ / abs(from_) * np.exp(1j * turn * share)
                path = np.stack([z.real, z.imag, a[2] + (b[2] - a[2]) * share], axis=1)
            self.moves.append((line, rapid, path, self.side))
        self.at = target


def plain(block):
    """A block without comments and without words of SINUMERIK."""
    block = re.sub(r"\(.*?\)|;.*|\bCTOL=[\d.]+", "", block).upper()
    return re.sub(r"^TRANS$", "", block).replace("SUPA", "G53").replace(" ", "")


# Words of the set-up, tested by cold_start.py.
SETTING = {"43", "49", "54", "61", "64", "642", "80", "92.1", "92.2"}


def iso(text):
    """Words of a letter and a number."""
    machine, motion, states, feed = Machine(), None, set(), 0.0
    for line, block in enumerate(text.splitlines(), 1):
        block = plain(block)
        words = re.findall(r"([A-Z])([-+]?[0-9]*\.?[0-9]*)", block)
        if "".join(a + b for a, b in words) != block.replace("%", ""):
            raise AssertionError(f"line {line}: {block}")
        values = {}
        for letter, number in words:
            if letter == "G":
                code = number.lstrip("0") or "0"
                assert code in {"0", "1", "2", "3", "17", "21", "28", "40", "41", "42", "53", "90", "91", "91.1", "94", "710"} | SETTING, f"line {line}: G{number}"
                states.add(code)
                motion = code if code in "0123" else motion
                machine.side = {"40": 0, "41": 1, "42": -1}.get(code, machine.side)
            else:
                assert letter not in values, f"line {line}: {letter} twice"
                values[letter] = float(number)
        feed = values.get("F", feed)
        to = [values.get(axis) for axis in "XYZ"]
        if {("G", "28"), ("G", "53")} & set(words):
            assert to[:2] == [None, None], f"line {line}: {block}"
            machine.goes_home()
        elif to != [None] * 3 or "I" in values or "J" in values:
            assert {"17", "90", "40"} <= states and states & {"21", "710"}, f"line {line}: states {states}"
            assert motion == "0" or feed > 0, f"line {line}: no feed"
            centre = complex(machine.at[0] + values.get("I", 0), machine.at[1] + values.get("J", 0)) if motion in "23" else None
            machine.go(line, motion == "0", to, centre, motion == "3")
        if values.get("M") == 30:
            return machine.moves
    raise AssertionError("no end")


# The codes and functions of grbl 1.1, and the modal groups of which a block may have one word each.
GRBL = {"0": 1, "1": 1, "2": 1, "3": 1, "17": 2, "90": 3, "91": 3, "91.1": 4, "93": 5, "94": 5, "20": 6, "21": 6, "40": 7, "49": 8, "54": 12, "55": 12,
        "61": 13, "80": 1, "4": 0, "28": 0, "53": 0, "92.1": 0}


def grbl(text):
    """grbl 1.1: it stops at a word or a code that it does not have, at an unused word, and at an arc without an end or off its circle."""
    machine, modal, spindle, coolant = Machine(), {1: "0", 2: "17", 3: "90", 5: "94", 6: "21", 7: "40", 8: "49", 12: "54"}, False, False
    feed, speed = None, 0.0
    for line, whole in enumerate(text.splitlines(), 1):
        assert len(whole) < 80, f"line {line}: longer than the buffer of grbl"
        block = re.sub(r"\(.*?\)|;.*|\s", "", whole).upper()
        assert "%" not in block and "(" not in block, f"line {line}: {block}"
        words = re.findall(r"([A-Z])([-+]?[0-9]*\.?[0-9]*)", block)
        assert "".join(a + b for a, b in words) == block, f"line {line}: {block}"
        values, groups, functions = {}, {}, []
        for letter, number in words:
            match letter:
                case "G":
                    assert number in GRBL, f"line {line}: error 20, G{number}"
                    assert GRBL[number] not in groups, f"line {line}: error 21"
                    groups[GRBL[number]] = number
                case "M":
                    assert number in ("0", "2", "30", "3", "5", "7", "8", "9"), f"line {line}: error 20, M{number}"
                    functions.append(number)
                case _:
                    assert letter in "FIJKNPRSTXYZ", f"line {line}: error 20, {letter}"
                    assert letter not in values, f"line {line}: error 25"
                    values[letter] = float(number)
        modal |= {group: code for group, code in groups.items() if group}
        feed, speed = values.get("F", feed), values.get("S", speed)
        spindle = (spindle or "3" in functions) and "5" not in functions
        coolant = (coolant or bool({"7", "8"} & set(functions))) and "9" not in functions
        to = [values.get(axis) for axis in "XYZ"]
        moves = to != [None] * 3
        if groups.get(0) == "53":
            assert modal[1] == "0" and to[:2] == [None, None], f"line {line}: error 30, {block}"
            machine.goes_home()
        elif moves:
            assert modal[1] != "80" and modal[3] == "90", f"line {line}: {block}"
            assert modal[1] == "0" or feed, f"line {line}: error 22, no feed"
            centre = None
            if modal[1] in "23":
                assert to[:2] != [None, None], f"line {line}: error 26, an arc without an end"
                assert ("I" in values or "J" in values) and to[2] is None, f"line {line}: error 35"
                centre = complex(machine.at[0] + values.get("I", 0), machine.at[1] + values.get("J", 0))
                end = [new if new is not None else old for new, old in zip(to, machine.at)]
                radii = [abs(complex(*at[:2]) - centre) for at in (machine.at, end)]
                off = abs(radii[0] - radii[1])
                assert off <= 0.005 or (off <= 0.5 and off <= 1e-3 * radii[0]), f"line {line}: error 33, {radii}"
            else:
                assert not {"I", "J", "R"} & set(values), f"line {line}: error 36"
            machine.go(line, modal[1] == "0", to, centre, modal[1] == "3")
        else:
            assert not {"I", "J", "R"} & set(values), f"line {line}: error 31"
        if "30" in functions:
            assert not spindle and not coolant and machine.at[2] is None, f"line {line}: ends {spindle} {coolant} {machine.at}"
            return machine.moves
    raise AssertionError("no end")


def mach3(text):
    """Mach3: centres of arcs are absolute or relative by its set-up until G91.1, and G64 lets it leave its path."""
    stated, machine, motion, feed = set(), Machine(), None, 0.0
    for line, whole in enumerate(text.splitlines(), 1):
        block = re.sub(r"\([^)]*\)", "", whole).upper().replace(" ", "")
        words = re.findall(r"([GMTSHDFXYZIJP])([-+]?[0-9]*\.?[0-9]*)", block)
        assert "".join(a + b for a, b in words) == block, f"line {line}: {block}"
        codes = [number for letter, number in words if letter == "G"]
        values = {letter: float(number) for letter, number in words if letter not in "GM"}
        assert len(values) + len(codes) + sum(letter == "M" for letter, _ in words) == len(words), f"line {line}: a word twice"
        assert set(codes) <= {"0", "1", "2", "3", "4", "17", "20", "21", "40", "41", "42", "43", "49", "53", "54", "55", "61", "80", "90", "91.1", "92.1", "94"}, f"line {line}: {codes}"
        stated |= set(codes)
        for code in codes:
            motion = code if code in "0123" else motion
            machine.side = {"40": 0, "41": 1, "42": -1}.get(code, machine.side)
        assert "41" not in codes and "42" not in codes or "D" in values, f"line {line}: the radius is not known"
        assert "43" not in codes or "H" in values, f"line {line}: the length is not known"
        feed = values.get("F", feed)
        to = [values.get(axis) for axis in "XYZ"]
        if "53" in codes:
            assert to[:2] == [None, None] and motion == "0"
            machine.goes_home()
        elif to != [None] * 3:
            assert {"17", "90", "40", "49", "80", "94", "61", "54"} <= stated and stated & {"20", "21"}, f"line {line}: {stated}"
            assert motion == "0" or feed > 0, f"line {line}: no feed"
            centre = None
            if motion in "23":
                assert "91.1" in stated and {"I", "J"} <= set(values), f"line {line}: a centre that is not known"
                centre = complex(machine.at[0] + values["I"], machine.at[1] + values["J"])
                end = complex(to[0], to[1])
                assert end != complex(*machine.at[:2]), f"line {line}: a full circle in one block"
                assert abs(abs(complex(*machine.at[:2]) - centre) - abs(end - centre)) < 0.002, f"line {line}: radii differ"
            machine.go(line, motion == "0", to, centre, motion == "3")
        if ("M", "30") in words:
            return machine.moves
    raise AssertionError("no end")


def run_by(control, text):
    """The moves of a program on its control."""
    return {"heidenhain": dialogue, "grbl": grbl, "mach3": mach3}.get(control, iso)(text)


def entered(found, moves, radius, margin, safe):
    """Checks how the cutter reaches its depth. The blank is the circle about the shaft that holds the outer profile, with a margin; of a groove and of a
    hollow outline all is metal."""
    outer = {"disc": 0, "rib": 0}.get(found["kind"])
    edge = None if outer is None else max(abs(flanks(found)[outer][1])) + margin + (radius or 0.0)
    # Places of level cuts, by their depth, in the order in which they were cut.
    levels, slopes = [], 0
    for line, rapid, path, _ in moves:
        across, down = np.ptp(path[:, 0]) + np.ptp(path[:, 1]) > 1e-9, path[0, 2] - path[-1, 2]
        if rapid:
            assert not across or (abs(path[0, 2] - safe) < 1e-3 and abs(down) < 1e-9), f"line {line}: a rapid move across at {path[0, 2]}"
            assert down <= 0 or path[-1, 2] > 0, f"line {line}: fast down to {path[-1, 2]}"
        elif across and abs(down) < 1e-9 and path[0, 2] < 0:
            levels.append((path[0, 2], path[:, :2]))
        elif across and path[:, 2].min() < 0:
            slope = np.degrees(np.arctan2(down, np.hypot(*(path[-1, :2] - path[0, :2]))))
            assert 0 < slope < 5, f"line {line}: a ramp of {slope} degrees"
            slopes += 1
        elif down > 0 and path[-1, 2] < 0:
            at = path[-1, :2]
            if edge is not None and np.hypot(*at) >= edge:
                continue
            before = [places for z, places in levels if z <= path[-1, 2] + 2e-3]
            away = min((np.hypot(*(places - at).T).min() for places in before), default=np.inf)
            assert away < 0.06, f"line {line}: straight down into metal at {at}, {away} from what was cut"
    return slopes


def dialogue(text):
    """L, CC and C of HEIDENHAIN's dialogue."""
    machine, centre, feed, lines = Machine(), None, 0.0, text.splitlines()
    assert re.fullmatch(r"0 BEGIN PGM \w+ MM", lines[0]) and re.fullmatch(rf"{len(lines) - 1} END PGM \w+ MM", lines[-1])
    for line, block in enumerate(lines[1:-1], 1):
        number, _, block = block.partition(" ")
        assert int(number) == line
        words = block.partition(";")[0].split()
        if not words or words[0] in ("TOOL", "CYCL", "STOP", "M30", "M8", "M9"):
            continue
        assert words[0] in ("L", "CC", "C"), block
        value = lambda axis: next((float(word[1:]) for word in words[1:] if word[0] == axis and word[1] in "+-"), None)
        if "M91" in words:
            machine.goes_home()
            continue
        if words[0] == "CC":
            centre = complex(value("X"), value("Y"))
            continue
        for word in words:
            machine.side = {"R0": 0, "RL": 1, "RR": -1}.get(word, machine.side)
            feed = float(word[1:]) if re.fullmatch(r"F\d[\d.]*", word) else feed
        rapid = "FMAX" in words
        assert rapid or feed > 0
        left = "DR+" in words
        assert words[0] == "L" or left != ("DR-" in words)
        machine.go(line, rapid, [value("X"), value("Y"), value("Z")], centre if words[0] == "C" else None, left)
    return machine.moves


def polar(text):
    """C turns the disc, X moves the wheel, straight in both at once: the wheel's centre as the disc sees it, and its largest speed, mm/min."""
    moves, motion, by_time, states, feed, fastest = [], None, False, set(), None, 0.0
    at = dict(X=None, C=None, Z=None)
    for line, block in enumerate(text.splitlines(), 1):
        block = plain(block)
        words = re.findall(r"([A-Z])([-+]?[0-9]*\.?[0-9]*)", block)
        assert "".join(a + b for a, b in words) == block.replace("%", ""), f"line {line}: {block}"
        values = {letter: float(number) for letter, number in words if letter != "G"}
        for number in (number for letter, number in words if letter == "G"):
            assert number in {"0", "1", "17", "21", "28", "40", "53", "90", "91", "91.1", "93", "94", "710"} | SETTING, f"line {line}: G{number}"
            states.add(number)
            motion = number if number in "01" else motion
            by_time = {"93": True, "94": False}.get(number, by_time)
        feed = values.get("F") if by_time else values.get("F", feed)
        if {("G", "28"), ("G", "53")} & set(words):
            at = at | dict(Z=None)
            continue
        before, at = at, {axis: values.get(axis, old) for axis, old in at.items()}
        if at != before and None not in before.values():
            assert {"17", "90", "40"} <= states and states & {"21", "710"} and (motion == "0" or feed > 0), f"line {line}"
            share = np.linspace(0, 1, 2 + int(abs(at["C"] - before["C"]) / 0.02))
            x, c, z = (before[axis] + (at[axis] - before[axis]) * share for axis in "XCZ")
            assert motion == "0" or at["C"] == before["C"] or by_time, f"line {line}: no time"
            places = x * np.exp(-1j * np.radians(c))
            if by_time:
                fastest = max(fastest, abs(np.diff(places)).sum() * feed)
            moves.append((line, motion == "0", np.stack([places.real, places.imag, z], axis=1), 0))
        if values.get("M") == 30:
            return moves, fastest
    raise AssertionError("no end")


def interpreter():
    """LinuxCNC's rs274 with the environment that it needs; None where it cannot be had."""
    if found := shutil.which("rs274"):
        return [found], dict(os.environ)
    binary = UNPACKED / "usr/bin/rs274"
    if not binary.exists():
        return None
    libraries = sorted({str(path.parent.resolve()) for path in UNPACKED.rglob("*.so*")})
    return [str(binary.resolve())], os.environ | {"LD_LIBRARY_PATH": ":".join(libraries)}


def linuxcnc(path, folder, rs274, diameter):
    """The moves that LinuxCNC makes of a program, its cutter's radius kept by itself."""
    command, environment = rs274
    (folder / "rs274.var").write_text("")
    (folder / "tool.tbl").write_text(f"T1 P1 D{diameter / 25.4:.9f} Z0\n")  # without a machine its tools are in inches
    words = [*command, "-v", str(folder / "rs274.var"), "-t", str(folder / "tool.tbl"), "-n", "2", "-g", str(path)]
    done = subprocess.run(words, capture_output=True, text=True, stdin=subprocess.DEVNULL, env=environment, timeout=120)
    assert "PROGRAM_END" in done.stdout, done.stdout[-500:] + done.stderr[-500:]
    machine = Machine()
    machine.at = [0.0, 0.0, 0.0]
    for line, text in enumerate(done.stdout.splitlines(), 1):
        found = re.search(r"(STRAIGHT_TRAVERSE|STRAIGHT_FEED|ARC_FEED)\((.*)\)", text)
        if not found:
            continue
        numbers = [float(number) for number in found[2].split(",")]
        if found[1] == "ARC_FEED":
            x, y, i, j, turns, z = numbers[:6]
            assert abs(turns) == 1
            machine.go(line, False, [x, y, z], complex(i, j), turns > 0)
        else:
            machine.go(line, found[1] == "STRAIGHT_TRAVERSE", numbers[:3])
    return machine.moves


def parallel(of, distance):
    """The parallel of a closed curve at a distance to its left, complex, by central differences."""
    step = 1e-5
    tangent = of(THETA + step) - of(THETA - step)
    return of(THETA) + 1j * tangent / abs(tangent) * distance


def flanks(found):
    """The exact flanks: name, closed polygon, and whether the metal lies around it."""
    ccw = -1 if found["ccw"] else 1
    if found["kind"] == "rib":
        outer, inner = (lambda theta, k=k: rib.centres(found, theta)[k] for k in (0, 1))
        return [("outer", parallel(outer, ccw * found["radius"]), False), ("inner", parallel(inner, -ccw * found["radius"]), True)]
    centre = lambda theta: groove.centres(found, theta)
    radius, inside = found["radius"], found["clearance"] * found["share"]
    match found["kind"]:
        case "disc":
            return [("", parallel(centre, ccw * radius), False)]
        case "ring":
            return [("", parallel(centre, -ccw * radius), True)]
    return [("inner", parallel(centre, ccw * (radius + inside)), False),
            ("outer", parallel(centre, -ccw * (radius + found["clearance"] - inside)), True)]


def tree(path):
    ends = np.roll(path, -1)
    return STRtree(linestrings(np.stack([np.stack([path.real, path.imag], 1), np.stack([ends.real, ends.imag], 1)], axis=1)))


def away(found, places):
    """Distance of places (n × 2) from a tree of lines."""
    (order, _), distance = found.query_nearest(points(places), return_distance=True, all_matches=False)
    result = np.empty(len(places))
    result[order] = distance
    return result


def inside(polygon, places):
    """Which places lie inside a polygon."""
    x, y = places[:, 0], places[:, 1]
    result = np.zeros(len(places), bool)
    a, b = polygon, np.roll(polygon, -1)
    for part in np.array_split(np.arange(len(places)), max(1, len(places) // 200)):
        spans = (a.imag > y[part, None]) != (b.imag > y[part, None])
        with np.errstate(divide="ignore", invalid="ignore"):
            crossing = a.real + (y[part, None] - a.imag) / (b.imag - a.imag) * (b.real - a.real)
        result[part] = (spans & (x[part, None] < crossing)).sum(axis=1) % 2 == 1
    return result


def judged(found, moves, cutter, depth, slot):
    """What the cutter does to the cam: the deepest gouge and the most metal left over, mm. `cutter` is None where the control's own path is the
    profile, and then the cutter is a point on the side that the program names."""
    radius = cutter or 0.0
    below = []
    for line, rapid, path, side in moves:
        deep = path[:, 2].min() < -1e-9
        upright = np.ptp(path[:, 0]) < 1e-9 and np.ptp(path[:, 1]) < 1e-9
        assert not (rapid and deep) or (upright and path[-1, 2] > path[0, 2]), f"line {line}: rapid below the face"
        if deep and not rapid:
            below.append(path)
    lowest = -min(path[:, 2].min() for path in below)
    assert abs(lowest - depth) < 2e-3, (lowest, depth)
    places = np.concatenate([path[:, :2] for path in below])
    bottom = np.concatenate([path[:, :2] for path in below if path[:, 2].max() < 1e-3 - depth])
    way = bottom[:, 0] + 1j * bottom[:, 1]
    exact = flanks(found)
    metals = [~inside(profile, places) if hollow else inside(profile, places) for _, profile, hollow in exact]
    # A rib is the metal between its flanks, of a groove that on either side.
    metal = np.logical_and.reduce(metals) if found["kind"] == "rib" else np.logical_or.reduce(metals)
    distance = np.minimum.reduce([away(tree(profile), places) for _, profile, _ in exact])
    gouge, left = np.where(metal, radius + distance, radius - distance).max(), 0.0
    lines = linestrings(np.stack([bottom[:-1], bottom[1:]], axis=1))
    passes = STRtree(lines[np.abs(np.diff(way)) < 1.0])
    for _, profile, _ in exact:
        # Every place of the profile is reached at the full depth.
        near = away(passes, np.stack([profile.real, profile.imag], 1)[::4])
        left = max(left, np.abs(near - radius).max() if not slot else (near - radius).max())
    return gouge, left


def design(random):
    kind = random.choice(["disc", "disc", "ring", "groove", "groove", "rib"])
    if kind == "rib":
        found = rib.design(random) | dict(kind=kind)
        text, depth = rib.toml(found), rib.THICKNESS
    else:
        found = groove.design(random) | dict(kind=kind)
        found["body"] = "ring" if kind == "ring" else "groove"
        text = groove.toml(found)
        depth = 12.0 if kind == "groove" else 20.0
        if kind == "disc":
            found["clearance"] = 0.0
            text = "\n".join(line for line in text.splitlines() if not re.match("body|clearance|groove_depth", line)) + "\n"
    return found, text, depth


def cutter_radius(found, random):
    """A cutter for a design, mm, or None."""
    return random.choice([None, random.uniform(1.0, found["radius"] * 0.95)])


def diameter(radius):
    """The flag for a cutter of a radius, mm; none for None."""
    return ["--cutter-diameter", f"{2 * radius!r}mm"] if radius else []


def with_cut(text, keys):
    """A design with the table `cut`."""
    cut = "\n".join(["[cut]", *keys]) + "\n"
    return text.replace("[limits]", cut + "[limits]") if "[limits]" in text else text + "\n" + cut


def check(binary, folder, file, *words):
    """`camgen check` of a program and the design in a folder; the finished process."""
    return subprocess.run([binary, "check", str(file), "--json", "--design", str(folder / "design.toml"), *words], capture_output=True, text=True)


def fault_texts(text, control, random):
    """Programs with one planted fault each."""
    lines = text.splitlines()
    arcs = [i for i, line in enumerate(lines) if re.search(r"\bG[23]\b| DR[+-]", line)]
    if len(arcs) < 8:
        return
    # Between two other arcs: a lead-in that is turned over may keep clear of the metal, and cuts nothing wrong.
    near = 2 if control == "heidenhain" else 1
    inner = [i for i in arcs if i - near in arcs and i + near in arcs]
    if not inner:
        return
    middle = inner[len(inner) // 2]

    def changed(name, index, how):
        other = lines.copy()
        other[index] = how(other[index])
        assert other[index] != lines[index], (name, lines[index])
        return name, "\n".join(line for line in other if line is not None) + "\n"

    if control == "heidenhain":
        yield changed("an arc turned over", middle, lambda line: line.replace("DR+", "DR?").replace("DR-", "DR+").replace("DR?", "DR-"))
        move = lambda line: re.sub(r"X([+-][\d.]+)", lambda m: f"X{float(m[1]) + 1.5:+.4f}", line)
        yield changed("a centre moved", middle - 1, move)
        yield changed("the side of the cutter", middle, lambda line: line + (" RL" if " RR" in text else " RR"))
    else:
        yield changed("an arc turned over", middle, lambda line: line.replace("G2 ", "G? ").replace("G3 ", "G2 ").replace("G? ", "G3 "))
        yield changed("a centre moved", middle, lambda line: re.sub(r"I(-?[\d.]+)", lambda m: f"I{float(m[1]) + 1.5:.4f}", line))
        yield changed("incremental coordinates", middle, lambda line: "G91 " + line)
        yield changed("the side of the cutter", middle, lambda line: ("G41 " if "G42" in text else "G42 ") + line)
        yield changed("inches", 0 if control != "fanuc" else 1, lambda line: line + "\nG20")
    yield changed("a block lost", middle, lambda line: None)
    shift = 1.3 * TOLERANCE
    def moved(line):
        return re.sub(r"\bX([-+]?[\d.]+)", lambda m: f"X{'+' if control == 'heidenhain' and float(m[1]) + shift >= 0 else ''}{float(m[1]) + shift:.4f}", line)
    yield "moved by 1.3 tolerances", "\n".join(moved(line) for line in lines) + "\n"
    plunges = [i for i, line in enumerate(lines) if re.search(r"Z-.*F\d", line)]
    if not plunges or re.search(r"(?m)^(G1|\d+ L) X.* Z", text):
        return
    plunge = plunges[0]
    yield changed("not deep enough", plunge, lambda line: re.sub(r"Z-([\d.]+)", "Z-1.0", line)) if len(plunges) == 1 else changed(
        "a rapid plunge", plunge, lambda line: line.replace("G1", "G0").replace(re.search(r"F[\d.]+", line)[0], "FMAX" if control == "heidenhain" else ""))


def main():
    asked = cases.given("gcode", 15)
    random, folder = Random(int(asked.seed)), asked.directory
    rs274 = interpreter()
    worst, made, run, planted, ground, sloping = [0.0, 0.0], 0, 0, 0, 0, 0
    for index in range(asked.count):
        found, text, depth = design(random)
        control = list(CONTROLS)[index % len(CONTROLS)]
        cutter = cutter_radius(found, random)
        cut = [f'direction = "{random.choice(["climb", "conventional"])}"']
        cut += random.choice([[], [f'depth_per_pass = "{random.uniform(3, 9)!r} mm"']])
        cut += random.choice([[], ["spindle = 2400", "tool = 1", 'preamble = ["M8"]', 'postamble = ["M9"]']])
        safe, margin = random.choice([(None, None), (random.uniform(10, 80), random.uniform(0, 9))])
        cut += [f'safe_height = "{safe!r} mm"', f'blank_margin = "{margin!r} mm"'] if safe else []
        allowance = random.choice([0.0, 0.0, random.uniform(0.05, 0.4)])
        passes = random.choice([1, 1, 2, 3])
        cut += [f'allowance = "{allowance!r} mm"'] if allowance else []
        cut += [f"finish_passes = {passes}"] if passes > 1 else []
        cut += random.choice([[], [f'coolant = "{random.choice(["flood", "mist", "off"])}"']])
        chords = random.random() < 0.25
        cut += ["arcs = false"] if chords else []
        text = with_cut(text, cut)
        words = ["--controller", control, *diameter(cutter)]
        done = make(asked.binary, folder, text, "gcode", *words)
        if done.returncode == 1:
            broken = failed(done)
            assert broken and "program" not in broken or "cutter_radius" in broken, (index, broken, text, words)
            if broken - {"force_closure"}:
                continue
            done = make(asked.binary, folder, text, "gcode", *words, "--force")
            assert done.returncode == 1, done.stderr
        elif done.returncode == 2:
            known = ["free for the cutter"]
            known += ["G41"] * ((control == "grbl" or chords) and not cutter) + ["no room for it", "has no path there"] * (allowance > 0)
            assert any(why in done.stderr for why in known), (index, done.stderr, text, words)
            continue
        made += 1
        path = folder / f"cam{CONTROLS[control]}"
        program = path.read_text()
        slot = found["kind"] == "groove" and cutter is None
        radius = cutter if cutter else (found["radius"] + 0.5 * found["clearance"] if slot else None)
        moves = run_by(control, program)
        results = [judged(found, moves, radius, depth, slot)]
        sloping += entered(found, moves, radius, 3.0 if margin is None else margin, round(safe, 4) if safe else 50.0)
        assert not chords or not re.search(r"\bG[23] |^\d+ C ", program, re.M), (index, "an arc")
        roughs = program.lower().count("roughing)") + len(re.findall(r"^\d+ ; .*roughing$", program, re.M)) + len(re.findall(r"^; .*roughing$", program, re.M))
        assert (roughs > 0) == (allowance > 0), (index, roughs, allowance)
        if control == "linuxcnc" and rs274:
            # Where LinuxCNC keeps the cutter on the profile it is one of its own.
            own = radius or min(1.0, 0.2 * found["radius"])
            results.append(judged(found, linuxcnc(path, folder, rs274, 2 * own), own, depth, slot))
            run += 1
        for result in results:
            assert max(result) < TOLERANCE + ROUNDING, (index, result, words, text)
            worst = [max(a, b) for a, b in zip(worst, result)]
        if found["kind"] == "disc" and cutter and control not in ("heidenhain", "grbl"):
            (folder / "design.toml").unlink()
            # A disc that is ground has no stock of its own.
            ground_text = re.sub(r"(?m)^(safe_height|blank_margin|allowance|finish_passes|entry|arcs) = .*\n", "", text)
            done = make(asked.binary, folder, ground_text.replace("[cut]", '[cut]\nform = "polar"'), "gcode", *words, "--force")
            assert done.returncode < 2 and "program" not in failed(done), (index, done.stdout, done.stderr, text)
            program_in_c = path.read_text()
            moves, fastest = polar(program_in_c)
            result = judged(found, moves, cutter, depth, False)
            assert max(result) < TOLERANCE + ROUNDING and fastest < 300 * 1.02, (index, result, fastest, text)
            ground, worst = ground + 1, [max(a, b) for a, b in zip(worst, result)]
            for name, other in [("another way round", re.sub(r"C(-?)", lambda m: "C" if m[1] else "C-", program_in_c)), ("a row moved", re.sub(r"X([0-9.]+) C(-?1[0-9.]+)", lambda m: f"X{float(m[1]) + 0.02:.3f} C{m[2]}", program_in_c, count=1))]:
                if other == program_in_c:
                    continue
                file = folder / f"planted{CONTROLS[control]}"
                file.write_text(other)
                done = check(asked.binary, folder, file, *diameter(cutter))
                # A symmetric cam is the same either way round.
                assert done.returncode in (1, 2) or name == "another way round", (index, name, done.stdout, done.stderr)
                planted += 1
            path.write_text(program)
            (folder / "design.toml").write_text(text)
        if index % 3 == 0:
            size = diameter(radius)
            done = check(asked.binary, folder, path, *size)
            assert done.returncode == 0, (index, done.stdout[-2000:], done.stderr)
            for name, other in fault_texts(program, control, random):
                file = folder / f"planted{CONTROLS[control]}"
                file.write_text(other)
                done = check(asked.binary, folder, file, *size)
                assert done.returncode in (1, 2) and (done.returncode == 2 or "program" in failed(done)), (index, name, control, done.stdout, done.stderr)
                planted += 1
    assert made > asked.count // 2, made
    by = f"{run} of them by rs274" if rs274 else "rs274 is not to be had"
    print(f"{made} of {asked.count} programs ({by}): gouges up to {1e3 * worst[0]:.3f} um, {1e3 * worst[1]:.3f} um left over; {sloping} lines of ramps; {ground} discs ground in polar coordinates; {planted} planted faults refused")


if __name__ == "__main__":
    sys.exit(main())
