"""Runs programs of `--format gcode` on controls in an unknown state: every group of words, every offset and every position is unknown until the program
states it, and the first move that reads one of them too early is a fault.

Shares nothing with camgen. Random discs, rings, grooves, ribs, pairs, plates and barrels, ground discs among them, for every control, with and without a tool, a
spindle, a cutter and lines of a shop; each program must run, and end at its home with coolant and spindle off. Programs for LinuxCNC also run in its own
interpreter `rs274`, if available, with words of another program still active: the moves must be the same. Then one word of the head is removed
from a program, or a dangerous move is inserted, and `camgen check` must refuse it; it must accept harmless lines of a shop.

usage: cold_start.py CAMGEN_BINARY DIRECTORY [--count N] [--seed S]
"""
import re
import sys
from random import Random

import barrel
import cases
import conjugate
import gcode
import wedge
from form_closed import make

CONTROLS = gcode.CONTROLS


class Cold:
    """A control in an unknown state."""

    def __init__(self, control):
        self.control, self.known, self.at = control, {}, {}
        self.home = self.by_hand = self.coolant = self.spindle = False
        self.turning = set()

    def needs(self, line, *groups):
        missing = [group for group in groups if group not in self.known]
        assert not missing, f"line {line}: moves before {', '.join(missing)}"

    def tool_changes(self, line, number):
        assert not self.coolant, f"line {line}: the coolant runs as the tool changes"
        assert self.home, f"line {line}: the tool changes at a height that is not known"
        assert number and number > 0, f"line {line}: no tool"
        self.known["tool"] = number
        self.known.pop("length", None)
        self.spindle = False

    def stops(self):
        self.by_hand = True
        self.known.setdefault("tool", "by hand")
        # An operator can set a length only if the program sets none.
        if self.control in ("fanuc", "heidenhain", "mach3"):
            self.known.setdefault("length", "by hand")

    def goes_home(self, line, axes):
        assert axes == {"Z"}, f"line {line}: {axes} to a place of the machine"
        self.home = True
        self.at.pop("Z", None)
        if self.control == "fanuc" and self.known.get("length") != "by hand":
            self.known.pop("length", None)

    def moves(self, line, rapid, arc, to):
        self.needs(line, "unit", "plane", "distance", "radius", "cycle", "datum")
        assert self.known["distance"] == "90", f"line {line}: incremental"
        across = {axis for axis in to if axis != "Z"}
        if not rapid:
            self.needs(line, "feed mode", "path", "feed", *(["centres"] if arc and self.control in ("linuxcnc", "mach3") else []))
            assert self.spindle or self.by_hand, f"line {line}: the spindle stands"
            deep = min(self.at.get("Z", 0), to.get("Z", 0)) < 0
            assert not (deep and across and "Z" in to) or to["Z"] < self.at["Z"], f"line {line}: rises across the part"
            assert {"X", "Y", "Z"} <= set(self.at), f"line {line}: from an unknown place"
        if across:
            assert self.home or "Z" in self.at, f"line {line}: across at an unknown height"
            assert "Z" not in to or not rapid, f"line {line}: a slanted rapid move"
        if "Z" in to and not across:
            missing = {"X", "Y"} - set(self.at)
            assert not missing, f"line {line}: down at an unknown {missing}"
            self.needs(line, "length", "tool")
            self.home = False
        self.at |= to

    def ends(self, line):
        assert self.home and not self.coolant and not self.spindle, f"line {line}: ends {'' if self.home else 'away from home '}{self.coolant} {self.spindle}"
        assert self.known["radius"] in ("40", "R0") and self.known["distance"] == "90" and self.known.get("feed mode") in ("94", None)


def iso(text, control):
    """Words of a letter and a number; the number of moves."""
    state, count = Cold(control), 0
    groups = {"unit": {"20", "21", "700", "710"}, "plane": {"17"}, "distance": {"90", "91"}, "radius": {"40", "41", "42"}, "feed mode": {"93", "94"},
              "centres": {"91.1"}, "path": {"61", "64", "642"}, "datum": {"54", "55"}, "motion": {"0", "1", "2", "3"}, "cycle": {"0", "1", "2", "3", "80"}}
    others = {"43", "49", "53", "28", "92.1", "92.2", "4"}
    if control == "grbl":
        # It has no tools: the operator loads one before the start and sets Z0 with it. It keeps its path, and its centres are relative.
        assert not re.search(r"(?m)^[^(]*(M6|G4[1-3]\b|%|T\d)", text), "a word that grbl does not have"
        state.known |= {"tool": "loaded", "length": "loaded"}
    for line, block in enumerate(text.splitlines(), 1):
        block = re.sub(r"\(.*?\)|;.*", "", block).strip().upper()
        if control == "sinumerik":
            block = re.sub(r"^TRANS$", "", block).replace("SUPA", "G53")
            assert "G642" not in block or re.search(r"CTOL=0\.\d+", block), f"line {line}: smooths without a tolerance"
            block = re.sub(r"CTOL=[\d.]+", "", block)
        words = re.findall(r"([A-Z])([-+]?[0-9]*\.?[0-9]*)", block.replace(" ", ""))
        if not words or block == "%":
            continue
        assert "".join(a + b for a, b in words) == block.replace(" ", ""), f"line {line}: {block}"
        codes, values = {b for a, b in words if a == "G"}, {a: float(b) for a, b in words if a not in "GM"}
        functions = {int(b) for a, b in words if a == "M"}
        if "O" in values:
            continue
        for code in codes:
            found = [group for group, members in groups.items() if code in members]
            assert found or code in others, f"line {line}: G{code}"
            if code in groups["unit"]:
                assert len(words) == 1, f"line {line}: the unit shares its block"
            state.known |= {group: code for group in found}
        if 6 in functions:
            state.tool_changes(line, values.get("T"))
        if 0 in functions:
            state.stops()
        state.spindle = (state.spindle or (3 in functions and "S" in values)) and 5 not in functions
        assert 3 not in functions or "S" in values or "S" in state.known
        state.coolant = (state.coolant or bool(functions & {7, 8})) and 9 not in functions
        if "49" in codes and control != "grbl":
            state.known.pop("length", None)
        if "43" in codes:
            # Without a number, on LinuxCNC only, it is the length of the tool in the spindle.
            assert values.get("H", 0) > 0 or (control == "linuxcnc" and "tool" in state.known), f"line {line}: a length of no tool"
            assert "H" not in values or values["H"] == state.known.get("tool", values["H"]), f"line {line}: the length of another tool"
            state.known["length"] = values.get("H", "tool")
        if control == "sinumerik" and "D" in values:
            state.known["edge"] = values["D"]
            assert not values["D"] or "tool" in state.known, f"line {line}: an edge of no tool"
            state.known.update({"length": values["D"]} if values["D"] else {})
            if not values["D"]:
                state.known.pop("length", None)
        if "93" in codes or state.known.get("feed mode") == "93":
            state.known.pop("feed", None)
        if values.get("F", 0) > 0:
            state.known["feed"] = values["F"]
        to = {axis: values[axis] for axis in "XYZAC" if axis in values}
        state.turning |= set(to) & {"A", "C"}
        if "28" in codes:
            assert state.known.get("distance") == "91" and to == {"Z": 0}, f"line {line}: {block}"
            state.goes_home(line, set(to))
        elif "53" in codes:
            assert state.known.get("motion") == "0" and state.known.get("distance") == "90", f"line {line}: {block}"
            assert control != "sinumerik" or values.get("D") == 0, f"line {line}: a length is taken into account"
            state.goes_home(line, set(to))
        elif to or "I" in values or "J" in values:
            state.moves(line, state.known["motion"] == "0", state.known["motion"] in "23", to)
            count += 1
        if 30 in functions:
            state.ends(line)
            return count
    raise AssertionError("no end")


def dialogue(text, control="heidenhain"):
    """Blocks of Klartext; the number of moves."""
    state, count, tolerance = Cold(control), 0, None
    state.known |= {"datum": "preset", "feed mode": "94", "distance": "90", "cycle": "0"}
    for line, block in enumerate(text.splitlines()):
        words = re.sub(r"^\d+ ", "", block).partition(";")[0].split()
        match words:
            case []:
                continue
            case ["BEGIN", "PGM", _, unit]:
                state.known["unit"] = unit
            case ["TOOL", "CALL", "Z", *rest]:
                state.known["plane"] = "Z"
            case ["TOOL", "CALL", number, "Z", *rest]:
                state.tool_changes(line, int(number))
                state.known |= {"plane": "Z", "length": "call"}
            case ["STOP"]:
                state.stops()
                state.known.setdefault("plane", "by hand")
            case ["CYCL", "DEF", "32.1", *rest]:
                tolerance = float(rest[0][1:]) if rest else None
                state.known["path"] = tolerance
            case ["CYCL", "DEF", *_]:
                assert not re.search(r"[XYZ][+-][1-9]|ROT[+-][1-9]", block), block
            case ["M1"]:
                continue
            case ["M8"]:
                state.coolant = True
            case ["M9"]:
                state.coolant = False
            case ["M30"]:
                state.ends(line)
            case ["END", "PGM", _, _]:
                return count
            case ["CC", *_]:
                continue
            case [("L" | "C") as kind, *rest]:
                for word in rest:
                    if word in ("R0", "RL", "RR"):
                        state.known["radius"] = word
                    if re.fullmatch(r"F[\d.]+", word):
                        state.known["feed"] = word
                    if word in ("M3", "M5"):
                        state.spindle = word == "M3"
                    if word in ("M7", "M8", "M9"):
                        state.coolant = word != "M9"
                to = {word[0]: float(word[1:]) for word in rest if re.fullmatch(r"[XYZ][+-][\d.]+", word)}
                if "M91" in rest:
                    state.needs(line, "radius")
                    state.goes_home(line, set(to))
                else:
                    assert "FMAX" in rest or tolerance, f"line {line}: no tolerance of the path"
                    state.moves(line, "FMAX" in rest, kind == "C", to)
                    count += 1
            case _:
                raise AssertionError(f"line {line}: {block}")
    raise AssertionError("no end")


def run(text, control):
    return dialogue(text) if control == "heidenhain" else iso(text, control)


def after_another_program(path, folder, rs274):
    """Checks that LinuxCNC makes the same moves of a program with words of another one still active."""
    left = "G20 G18 G91 G90.1 G93 G55 G64\nG10 L2 P1 X0 Y0 Z0\nG92 X3 Y4 Z5\nG43.1 Z7\n"
    dirty = folder / "dirty.ngc"
    dirty.write_text(left + path.read_text())
    size = lambda moves: [(rapid, [round(float(number), 6) for number in (*moved[0], *moved[-1])]) for _, rapid, moved, _ in moves]
    clean, other = (size(gcode.linuxcnc(file, folder, rs274, 2.0)) for file in (path, dirty))
    # The first moves begin at different positions.
    assert clean[2:] == other[2:] and len(clean) == len(other), (path, next(pair for pair in zip(clean[2:], other[2:]) if pair[0] != pair[1]))


def design(random):
    """A design: its kind, its text, its flags for `make`, and the controls with a program for it."""
    kind = random.choice(["flat", "flat", "flat", "flat", "pair", "plate", "barrel", "ground"])
    controls = list(CONTROLS)
    if kind == "barrel":
        found = barrel.design(random)
        return kind, barrel.toml(found), [], [*controls[:3], "mach3"]
    if kind == "pair":
        return kind, conjugate.toml(conjugate.design(random)), [], controls
    if kind == "plate":
        return kind, wedge.toml(wedge.design(random)), [], controls
    found, text, _ = gcode.design(random)
    if kind == "ground":
        while found["kind"] != "disc":
            found, text, _ = gcode.design(random)
        return kind, text, ["--set", "cut.form=polar", "--cutter-diameter", "120mm"], [*controls[:3], "mach3"]
    return found["kind"], text, gcode.diameter(gcode.cutter_radius(found, random)), controls


# Required words of the head for each control, as written.
NEEDED = {
    "linuxcnc": ["G21\n", "G17 ", "G90 ", " G94", "G91.1 ", "G40 ", "G61\n", "G53 G0 Z0.0\n", "G54\n", " G43 H1", "S2400 M3\n"],
    "fanuc": ["G21\n", "G17 ", "G94 ", "G40 ", "G91 G28 Z0.\n", "G54\n", "G43 H01 ", "S2400 M3\n"],
    "sinumerik": ["G710\n", "G17 ", "G90 ", "G94 ", " G40", "G642 CTOL=0.001\n", " CTOL=0.001", "G0 SUPA Z0.0 D0\n", " D0", "G54\n", "D1 ", "S2400 M3\n"],
    "heidenhain": [" R0", "TOOL CALL 1 Z S2400", " M3", "L Z-1.0 R0 FMAX M91\n"],
    "grbl": ["G21\n", "G17 ", "G90 ", " G94", "G40 ", "G53 G0 Z-1.0\n", "G54\n", "S2400 M3\n"],
    "mach3": ["G21\n", "G17 ", "G90 ", " G94", "G91.1 ", "G40 ", "G61\n", "G53 G0 Z0.0\n", "G54\n", " G43 H1", "S2400 M3\n"],
}
# Dangerous lines before the first move of a pass.
DANGEROUS = {
    "linuxcnc": ["G28", "G28 Z0", "G0 X0 Y0 Z5", "G0 Z5", "G64", "G1 X5 F100"],
    "fanuc": ["G28", "G28 Z0.", "G91 G28 Z-30.", "G0 X0. Y0. Z5.", "G0 G43 H01 Z5.", "G91 G53 G0 Z0."],
    "sinumerik": ["CYCLE832()", "CYCLE832()\nCOMPCAD", "G64 CTOL=0.004", "CTOL=0.5", "G0 X0 Y0 Z5", "G0 D1 Z5"],
    "heidenhain": ["L Z+5 R0 FMAX", "L X+0 Y+0 Z+5 R0 FMAX"],
    "grbl": ["G28", "G28 Z0", "G0 X0 Y0 Z5", "G0 Z5", "G64", "T1 M6", "G43 H1", "G41 D1"],
    "mach3": ["G28", "G28 Z0", "G0 X0 Y0 Z5", "G0 Z5", "G64", "G1 X5 F100", "G90.1"],
}
# Harmless lines of a shop in the same position.
HARMLESS = {
    "linuxcnc": ["G64 P0.004", "G92.1", "G54 G92.1", "G90 G92.2 G80", "G91 G28 Z0\nG90", "M8", "G55"],
    "fanuc": ["G61", "G91 G28 Z0.\nG90", "M8", "G80 G15 G50 G69"],
    "sinumerik": ["G60", "G64 COMPCAD CTOL=0.004\nG642 COMPOF", "G641 ADIS=0.004", "CYCLE832(0.004,1,1)", "TRANS\nROT", "G0 SUPA Z0 D0", "M8", 'MSG("CAM")', "COMPCAD\nCOMPOF"],
    "heidenhain": ["CYCL DEF 32.0 TOLERANCE\nCYCL DEF 32.1 T0.004", "L Z-1 R0 FMAX M91", "L M140 MB MAX", "M8"],
    "grbl": ["G92.1", "M8", "G55", "G61", "G4 P1"],
    "mach3": ["G92.1", "M8", "G55", "G91 G28 Z0\nG90", "G61"],
}


def first_of_pass(lines, control):
    """The line of the first rapid move across."""
    pattern = r"\d+ L X.* FMAX" if control == "heidenhain" else r"G0 X"
    return next(number for number, line in enumerate(lines) if re.match(pattern, line))


def altered(text, control):
    """Programs without one word, or with one dangerous line: the change and the text."""
    lines = text.splitlines(keepends=True)
    first = first_of_pass(lines, control)
    # The head, its first move across, and its first move down.
    head, rest = "".join(lines[: first + 2]), "".join(lines[first + 2 :])
    for word in NEEDED[control]:
        assert word in head, (word, head)
        without = head.replace(word, "") if word == " R0" else head.replace(word, re.sub(r".*L Z-1.0.*", "", "") if word.endswith("\n") and control == "heidenhain" else "", 1)
        if control == "heidenhain" and word.startswith("L Z"):
            without = re.sub(r"\d+ " + re.escape(word), "", head, count=1)
        if control == "heidenhain" and word.startswith("TOOL"):
            without = re.sub(r"\d+ " + re.escape(word) + "\n", "", head, count=1)
        yield f"without {word.strip()}", without + rest
    number = "0 " if control == "heidenhain" else ""
    insert = lambda line: "".join(lines[:first]) + "".join(f"{number}{own}\n" for own in line.split("\n")) + "".join(lines[first:])
    for line in DANGEROUS[control]:
        yield f"with {line}", insert(line)
    swapped = lines[:first] + [lines[first + 1], lines[first]] + lines[first + 2 :]
    yield "Z first", "".join(swapped)
    if control != "heidenhain":
        slanted = re.sub(r" Z[\d.]+", "", lines[first + 1]).rstrip() + lines[first].replace("G0", "").rstrip() + " " + re.search(r"Z[\d.]+", lines[first + 1])[0]
        yield "slanted", "".join(lines[:first] + [slanted + "\n"] + lines[first + 2 :])


def harmless(text, control):
    lines = text.splitlines(keepends=True)
    first = first_of_pass(lines, control)
    number = "0 " if control == "heidenhain" else ""
    for line in HARMLESS[control]:
        yield line, "".join(lines[:first]) + "".join(f"{number}{own}\n" for own in line.split("\n")) + "".join(lines[first:])


def passing_disc(binary, folder, random):
    """A disc that passes its checks: without a mass, because no spring presses its follower on."""
    while True:
        found, text, _ = gcode.design(random)
        text = re.sub(r"(?m)^(mass|inertia) = .*\n", "", text)
        if found["kind"] == "disc" and make(binary, folder, text, "gcode").returncode == 0:
            return text


def main():
    asked = cases.given("cold_start", 15)
    random, folder = Random(int(asked.seed)), asked.directory
    rs274 = gcode.interpreter()
    programs = refused = taken = dirty = 0
    for index in range(asked.count):
        kind, text, words, controls = design(random)
        tool, spindle, lines = random.random() < 0.6, random.random() < 0.6, random.random() < 0.5
        cut = ["tool = 1"] if tool else []
        cut += ["spindle = 2400"] if spindle else []
        cut += ["depth_per_pass = \"5 mm\""] if random.random() < 0.4 else []
        flat = kind not in ("barrel", "ground")
        cut += [f'coolant = "{random.choice(["flood", "mist"])}"'] if random.random() < 0.4 else []
        cut += ["finish_passes = 2"] if flat and random.random() < 0.3 else []
        own = {key: f'{key} = ["M1"]' for key in ("header", "after_tool", "footer") if random.random() < 0.3}
        text = gcode.with_cut(text, cut)
        for control in controls:
            shop = {"heidenhain": ["M8"], "grbl": ["M8"], "fanuc": ["M8", "G55"]}.get(control, ["M8", "G0 SUPA Z0 D0" if control == "sinumerik" else "G91 G28 Z0"])
            more = ["--set", f"cut.preamble=[{', '.join(repr(line) for line in shop)}]".replace("'", '"')] if lines else []
            # A stop by M1 is not one of grbl's words.
            for key, line in own.items():
                line = line.replace("M1", "G4 P1") if control == "grbl" else line
                more += ["--set", "cut." + line.replace(" = ", "=")]
            for old in folder.glob(f"cam*{CONTROLS[control]}"):
                old.unlink()
            done = make(asked.binary, folder, text, "gcode", "--controller", control, "--force", *words, *more)
            if done.returncode == 2:
                assert any(why in done.stderr for why in ("free for the cutter", "concave", "does not fit", "decimals", "cutter", "G41")), (index, kind, control, done.stderr, text)
                continue
            for path in sorted(folder.glob(f"cam*{CONTROLS[control]}")):
                program = path.read_text()
                try:
                    assert run(program, control) > 0
                except AssertionError as why:
                    raise AssertionError((index, kind, control, tool, spindle, str(why), path)) from why
                programs += 1
                if control == "linuxcnc" and rs274 and kind not in ("barrel", "ground"):
                    after_another_program(path, folder, rs274)
                    dirty += 1
                if "M0\n" in program or "STOP" in program:
                    stop = re.sub(r"(?m)^(M0|\d+ STOP)\n", "", program)
                    try:
                        run(stop, control)
                    except AssertionError:
                        continue
                    raise AssertionError((index, kind, control, "runs without its stop"))
    # One program for each control, altered.
    text = passing_disc(asked.binary, folder, random)
    # With the clearance as the safe height: "Z first" must not be high above all clamps.
    text = gcode.with_cut(text, ["tool = 1", "spindle = 2400", 'depth = "4 mm"', 'safe_height = "5 mm"'])
    for control, ending in CONTROLS.items():
        for size in ([], ["--cutter-diameter", "2mm"]):
            if control == "grbl" and not size:
                continue
            done = make(asked.binary, folder, text, "gcode", "--controller", control, *size)
            assert done.returncode == 0, (control, done.stdout, done.stderr)
            program = (folder / f"cam{ending}").read_text()
            file = folder / f"altered{ending}"

            def checked(other):
                file.write_text(other)
                return gcode.check(asked.binary, folder, file, *size)

            for name, other in altered(program, control):
                done = checked(other)
                assert other != program and done.returncode in (1, 2), (control, name, size, done.stdout, file)
                refused += 1
            for name, other in harmless(program, control):
                done = checked(other)
                assert done.returncode == 0, (control, name, done.stdout, done.stderr, file)
                taken += 1
    assert programs > asked.count, programs
    by = f"{dirty} also by rs274 after another program" if rs274 else "rs274 is not to be had"
    print(f"{programs} programs of {asked.count} designs state all before they move ({by}); {refused} altered ones refused, {taken} with lines of a shop taken")


if __name__ == "__main__":
    sys.exit(main())
