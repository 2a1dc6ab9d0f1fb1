#!/usr/bin/env python3
"""Runs two builds of camgen on the same random machines and motion programs and lists where their outputs differ.

usage: compare.py BEFORE AFTER [--machines 100] [--programs 100] [--seed 1] [--jobs 2] [--allow FILE]

A machine is an embedded one, or a file made of one by dropping lines, with random overrides; some values are invalid on purpose. It goes
through `rotary`, `translating` and `conoid` with random flags, and a part of the DXF files written goes through `check`. With each machine
every analysis runs once, on an embedded machine of its kind whose values are changed at random. A program is a design file of
tests/independent/programs.py: it goes through `make`, a part of them through `check`, `size` and `laws` (needs numpy; tests/run installs it in
target/independent-venv). Either build runs in a fresh directory of its own with the same arguments.

A difference is: another exit code; another set of files; other bytes in a .dxf, .step, .stl, .csv (also of points), .txt or .toml; a value
of a report, its hash of the inputs among them, that has changed or gone. Reports are compared value by value, their list of checks by the
names of the checks.

Listed, but no difference: additions (keys, tables and checks of a report that only AFTER has) and wording (notes of
checks, and what is said on standard error by a run that ends with exit code 2). SVG, HTML and PDF files, printed text and other messages
are only counted.

--allow names a file of regular expressions, one a line, lines with # are comments. A difference is intended when one of
them is found in its line of the list, as in `rotary | report | checks[wall].value`.

Exit code 0: no difference but intended ones. 1: some. 2: the comparison could not be made.
"""
import argparse
import json
import random
import re
import shlex
import subprocess
import sys
import tempfile
import tomllib
from collections import Counter, defaultdict
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path

BYTES = {".dxf", ".step", ".stl", ".csv", ".txt", ".toml"}
COUNTED = {".svg", ".html", ".pdf"}
TIMEOUT = 120  # seconds for one run


# ---- random machines ----


def one_of(*values):
    return lambda rng: str(rng.choice(values))


def number(low, high):
    return lambda rng: f"{rng.uniform(low, high):.4g}"


def quantity(low, high, *units):
    """A number between low and high of the first unit, written in any of them; a unit is its name or (name, factor)."""

    def make(rng):
        unit = rng.choice(units)
        name, factor = unit if isinstance(unit, tuple) else (unit, 1.0)
        return f"{rng.uniform(low, high) * factor:.5g}{rng.choice(['', ' '])}{name}"

    return make


def length(low, high):
    return quantity(low, high, "mm", "mm", "mm", ("cm", 0.1), ("in", 1 / 25.4))


def angle(low, high):
    return quantity(low, high, "deg", "deg", ("rad", 0.0174532925))


def either(*ways):
    return lambda rng: rng.choice(ways)(rng)


def band(rng):
    inner = rng.uniform(20, 80)
    return f"{inner:.3g} mm .. {inner + rng.uniform(-5, 80):.3g} mm"


# Every key of a machine file and how a value for it is made.
KEYS = {
    "name": one_of("a press", "Presse Süd", "x"),
    "bed.mass": quantity(300, 2000, "kg", ("lb", 2.2)),
    "bed.crank_radius": length(100, 300),
    "bed.crank_turns_per_main_shaft_turn": either(one_of(2, 3, 4), number(1, 5)),
    "buffer.polytropic_exponent": either(one_of("1", "1.0", "1.35", "1.4"), number(1.0, 1.6)),
    "buffer.ambient_pressure": quantity(0.8, 1.2, "at", ("bar", 0.98)),
    "buffer.end_pressure": either(*[quantity(1.3, 3.5, "at", ("kPa", 98.0), ("psi", 14.2))] * 3, quantity(1, 9, "at")),
    "buffer.column": either(one_of("matched", "return"), length(150, 500)),
    "buffer.lead": length(0, 30),
    "design.rpm": number(20, 60),
    "follower.roller.radius": length(8, 60),
    "follower.roller.offset": length(-40, 40),
    "follower.roller.mass": quantity(2, 100, "kg"),
    "follower.roller.preload": quantity(0, 6000, "N", ("kN", 0.001), ("kgf", 0.1)),
    "follower.roller.crown": one_of("sphere", "cylinder"),
    "follower.roller.width": length(4, 40),
    "cam.cam_turns_per_crank_turn": one_of(1, 1, 1, 0.5, 0.25, 0.75),
    "cam.lever": number(0.3, 1.6),
    "cam.base_radius": either(one_of("auto"), length(20, 70), length(60, 200), length(100, 600)),
    "cam.thickness": length(4, 60),
    "cam.bore_radius": length(8, 45),
    "cam.material": one_of("steel", "cast-iron", "bronze", "aluminium"),
    "cam.balance": band,
    "cam.rotation": one_of("cw", "ccw"),
    "cam.keyway.width": length(3, 16),
    "cam.keyway.depth": length(1, 8),
    "cam.keyway.angle": angle(-300, 300),
    "transition.kind": one_of("run-up", "blend", "none"),
    "transition.width": angle(2, 60),
    "translating.roller_arm": length(150, 500),
    "translating.bottom_arm": length(150, 500),
    "translating.delta": angle(50, 130),
    "translating.friction_angle": either(one_of("0 deg"), angle(0, 8)),
    "translating.efficiency": either(one_of("1"), number(0.7, 1.0)),
    "translating.efficiency_model": one_of("consistent", "printed"),
    "translating.roller_radius": length(8, 60),
    "translating.plate_height": length(90, 320),
    "conoid.axial_travel": length(30, 400),
    "conoid.mode": one_of("adjusted", "fixed"),
    "conoid.shift": one_of("linear", "square"),
    "conoid.overhang": length(0, 20),
    "limits.pressure_angle": angle(18, 55),
    "limits.min_convex_pitch_radius_over_roller": number(0, 3),
    "limits.cutter_radius": length(2, 60),
    "limits.wall": length(0, 20),
    "limits.contact_stress": quantity(400, 3000, "MPa"),
}
INVALID = ["-5 mm", "0 mm", "0", "-1", "nan", "inf mm", "1e999 mm", "1e9 mm", "5 kg", "5 furlongs", "7", "", "wood", "9 rad"]
INVALID_OVERRIDES = ["cam.thicknes=3 mm", "roller.radius=30mm", "cam.bore_radius", "=5", "cam=3", "cam.bore_radius.x=3 mm"]


def random_overrides(rng):
    share = rng.choice([0.0, 0.05, 0.1, 0.15, 0.25])
    chosen = {key: make(rng) for key, make in KEYS.items() if rng.random() < share}
    # Keys that go together, mostly together.
    if any(key.startswith("cam.keyway.") for key in chosen) and rng.random() < 0.95:
        chosen |= {key: make(rng) for key, make in KEYS.items() if key.startswith("cam.keyway.")}
    if chosen.get("follower.roller.crown") == "cylinder" and rng.random() < 0.9:
        chosen.setdefault("follower.roller.width", KEYS["follower.roller.width"](rng))
    if rng.random() < 0.08:
        chosen[rng.choice(list(KEYS))] = rng.choice(INVALID)
    overrides = [f"{key}={value}" for key, value in chosen.items()]
    if rng.random() < 0.03:
        overrides.append(rng.choice(INVALID_OVERRIDES))
    rng.shuffle(overrides)
    return overrides


def random_machine(rng, embedded):
    """The machine's argument, the text of its file if it is one, and its overrides."""
    base = "dpi" if rng.random() < 0.85 else "dpi-paper"
    text = None
    if rng.random() < 0.15:
        lines = embedded[base].splitlines(keepends=True)
        for _ in range(rng.randint(1, 2)):
            del lines[rng.randrange(len(lines))]
        text = "".join(lines)
    return ("press.toml" if text else base), text, random_overrides(rng)


def random_speed(rng):
    return rng.choice(["20", "25", "30", "35", "40", f"{rng.uniform(15, 55):.1f}", f"{rng.uniform(15, 55):.6f}"])


def points_flags(rng, has_centre=True):
    curves = [["profile"], ["cutter", "--cutter-radius", "8mm"], *([["centre"]] if has_centre else [])]
    flags = ["--points-of", *rng.choice(curves)] if rng.random() < 0.6 else []
    for flag, values in (("--points-as", ["polar", "xy"]), ("--points-step", ["angle", "chord"]), ("--points-between", ["linear", "cubic"])):
        flags += [flag, rng.choice(values)] if rng.random() < 0.4 else []
    return flags


def random_flags(rng, command, overrides):
    flags = []

    def sometimes(share, *more):
        if rng.random() < share:
            flags.extend(more)

    if command == "conoid":
        speeds = sorted({random_speed(rng) for _ in range(rng.randint(1, 4))}, key=float)
        if rng.random() < 0.05:
            rng.shuffle(speeds)
        # A blend leaves more between the sections than is asked for, and takes half a minute to find that out.
        if rng.random() < 0.2 and "transition.kind=blend" not in overrides:
            speeds = [f"{rng.uniform(15, 25):.1f}..{rng.uniform(26, 45):.1f}"]
            sometimes(0.95, "--residual", f"{rng.choice([2, 5, 20, 100, 500])}N")
        else:
            sometimes(0.1, "--residual", f"{rng.choice([0.1, 2, 50])}N")
        flags += ["--rpm", ",".join(speeds)]
    else:
        sometimes(0.5, "--rpm", random_speed(rng))
        sometimes(0.02, "--rpm", rng.choice(["0", "-3", "fast", "20,30", "20..30"]))
    accuracy = rng.random()
    if accuracy < 0.02:
        flags += ["--tolerance", rng.choice(["0mm", "5", "5 kg", "1m"])]
    elif accuracy < 0.4:
        flags += ["--tolerance", rng.choice(["100um", "20um", "10um", "2um", "1um", "0.1um", "0.05mm"])]
    elif accuracy < 0.6:
        flags += ["--accuracy", rng.choice(["draft", "standard", "fine"])]
    if rng.random() < 0.9:
        kinds = ["dxf", "svg", "step", "csv"] + (["stl"] if command == "conoid" or rng.random() < 0.03 else [])
        kinds = [kind for kind in kinds if rng.random() < 0.75] + ["json"]
        if rng.random() < (0.3 if command != "translating" else 0.03):
            kinds.append("points")
            flags += points_flags(rng)
        rng.shuffle(kinds)
        flags += ["--format", ",".join(kinds)]
    sometimes(0.9, "--samples", str(rng.choice([1, 2, 3, 7, 36, 60, 90])))
    sometimes(0.25, "--side", rng.choice(["both", "inside", "outside"]))
    sometimes(0.25, "--dxf-version", rng.choice(["r12", "r2000", "r2010", "r2013"]))
    sometimes(0.6, "--force")
    sometimes(0.05, "--name", "part")
    if command == "rotary" and "--cutter-radius" not in flags:
        sometimes(0.25, "--cutter-radius", f"{rng.choice([1, 5, 8, 20, 60, 300])}mm")
    if command == "translating":
        sometimes(0.3, "--balance", rng.choice(["braking", "return", "mean"]))
        if rng.random() < 0.25:
            flags += ["--solver", "paper"]
            sometimes(0.8, "--stations", str(rng.choice([2, 5, 18, 180, 700])))
        else:
            sometimes(0.03, "--stations", "18")
    output = rng.random()
    if output < 0.85:
        flags.append("--json")
    elif output < 0.9:
        flags.append("--quiet")
    return flags


# ---- runs ----


@dataclass
class Ended:
    """How one run of one build ended."""

    code: int | str
    out: str
    err: str


@dataclass
class Case:
    """One command on one machine, by both builds."""

    command: str
    line: str
    before: Ended
    after: Ended
    files: tuple[dict, dict] | None = None  # name to bytes


# Flags as revisions before them call them.
FORMER = {"--cutter-radius": "--cutter"}


def knows(binary, flag, known={}):
    if (binary, flag) not in known:
        known[binary, flag] = flag in subprocess.run([binary, "rotary", "--help"], capture_output=True, text=True).stdout
    return known[binary, flag]


def start(binary, arguments, directory):
    arguments = [FORMER[word] if word in FORMER and not knows(binary, word) else word for word in arguments]
    # Under one name, because the usage names the program.
    try:
        done = subprocess.run(
            ["camgen", *arguments], executable=binary, cwd=directory, stdin=subprocess.DEVNULL, capture_output=True,
            timeout=TIMEOUT,
        )
    except subprocess.TimeoutExpired:
        return Ended("timeout", "", "")
    return Ended(done.returncode, done.stdout.decode(errors="replace"), done.stderr.decode(errors="replace"))


class Pair:
    """Both builds, each in a directory of its own with the same files in it."""

    def __init__(self, binaries, files):
        self.binaries, self.given = binaries, set(files)
        self.kept = [tempfile.TemporaryDirectory() for _ in binaries]
        self.directories = [Path(kept.name) for kept in self.kept]
        for name, text in files.items():
            self.put(name, [text.encode()] * 2)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        for kept in self.kept:
            kept.cleanup()

    def put(self, name, contents):
        for directory, content in zip(self.directories, contents):
            (directory / name).write_bytes(content)

    def run(self, arguments, note="", with_files=True):
        """A case of these arguments: how both ended, and the files they wrote."""
        ended = [start(binary, arguments, directory) for binary, directory in zip(self.binaries, self.directories)]
        line = shlex.join(["camgen", *arguments]) + note
        return Case(arguments[0], line, *ended, tuple(map(self.files_in, self.directories)) if with_files else None)

    def files_in(self, directory):
        paths = [path for path in sorted(directory.rglob("*")) if path.is_file() and path.name not in self.given | {".camgen.json"}]
        return {str(path.relative_to(directory)): path.read_bytes() for path in paths}


def cases_of_command(binaries, rng, command, machine, text, overrides):
    sets = [word for override in overrides for word in ("--set", override)]
    flags = random_flags(rng, command, overrides)
    with Pair(binaries, {} if text is None else {"press.toml": text}) as pair:
        made = pair.run([command, machine, *sets, *flags])
        yield made
        kind = ["--cam", "translating"] if command == "translating" else []
        yield from cases_of_check(pair, rng, made, [machine, *sets, *kind], flags)


def cases_of_check(pair, rng, made, machine, flags):
    """A part of the DXF files written, some of them cut off, through `check`."""
    files = made.files
    draw, cut, tolerance = rng.random(), rng.random(), rng.choice(["1um", "5um", "0.05mm"])
    drawn = sorted(name for name in files[0] if name.endswith(".dxf"))
    if draw >= 0.4 or not drawn:
        return
    name = drawn[int(len(drawn) * draw / 0.4)]
    if name not in files[1]:
        return
    note = ""
    if cut < 0.15:
        pair.put(name, [own[name][: int(len(own[name]) * cut / 0.15)] for own in files])
        note = f" # of the file cut off at {cut / 0.15:.6f} of its length"
    arguments = ["check", name, *machine, "--json"]
    # As the file was cut, but at times with another tolerance.
    kept = ["--tolerance", "--accuracy", "--balance"] + (["--rpm"] if made.command != "conoid" else [])
    for flag in [flag for flag in kept if flag in flags]:
        arguments += [flag, flags[flags.index(flag) + 1]]
    if cut > 0.8 and "--tolerance" not in flags and "--accuracy" not in flags:
        arguments += ["--tolerance", tolerance]
    if made.command == "conoid" and (speed := re.search(r"([\d.]+)rpm\.dxf$", name)):
        arguments += ["--rpm", speed[1]]
    yield pair.run(arguments, note, with_files=False)


# ---- analyses ----


PRESSES = ["dpi", "dpi", "dpi-paper", "dpi-crank-slider", "dpi-six-bar"]
DESIGNS = ["feeder", "lever", "valve"]
# Every analysis, the embedded machines it takes, and the flags it may have, each with its values.
ANALYSES = {
    "regimes": (PRESSES, {"--rpm": ["25", "20,30,40", "33.5,41"], "--cut-for": ["30", "41.7"], "--reset": ["end", "half", "level"]}),
    "spring": (["dpi", "dpi-paper"], {"--rpm": ["30", "20,45"], "--stiffness": ["68kgf/cm,165kgf/cm", "120N/mm"], "--residual": ["50kgf", "900N"]}),
    "drive": (["dp"], {"--solver": ["paper"], "--step": ["5deg", "7deg", "0.1rad"]}),
    "linkage": (["dpi-six-bar", "dpi-crank-slider"], {"--rpm": ["30", "42.5"]}),
    "shaft": (
        ["press-cylinder", "dpi-shaft"],
        {"--rpm": ["30", "400"], "--modes": ["1", "4"], "--whirl": ["planar", "backward"], "--solver": ["paper"], "--samples": ["12", "90"]},
    ),
    "brake": (["roll", "roll-level"], {"--samples": ["7", "40"], "--cam": [None], "--synthesize=robust": [None]}),
    "size": (DESIGNS, {"--rpm": ["90", "250"], "--free": ["offset", "pivot-distance"]}),
    "laws": (DESIGNS, {"--rpm": ["90"], "--lift": ["12mm", "20deg"], "--over": ["75deg", "2rad"], "--sort": ["cv", "cj"]}),
}
# Of equal lobes: no other size will do.
COUNTS = {"cam.cam_turns_per_crank_turn"}
SELDOM = {"--synthesize=robust", "--solver"}


def leaves(table, before=""):
    for key, value in table.items():
        if isinstance(value, dict):
            yield from leaves(value, f"{before}{key}.")
        else:
            yield f"{before}{key}", value


def changed(rng, value):
    """A number or quantity of another size; None of what is neither."""
    factor = rng.choice([rng.uniform(0.95, 1.05), rng.uniform(0.8, 1.25), rng.uniform(0.3, 3)])
    if isinstance(value, str) and (parts := re.fullmatch(r"(-?[\d.]+)( *[A-Za-z].*)", value)):
        return f"{float(parts[1]) * factor:.5g}{parts[2]}"
    return f"{value * factor:.5g}" if type(value) in (int, float) else None


def overrides_of(rng, text):
    share = rng.choice([0.0, 0.05, 0.15, 0.3])
    values = [(key, changed(rng, value)) for key, value in leaves(tomllib.loads(text)) if key not in COUNTS and rng.random() < share]
    values = [(key, value) for key, value in values if value is not None]
    if values and rng.random() < 0.05:
        values[0] = values[0][0], rng.choice(INVALID)
    return [f"{key}={value}" for key, value in values]


def cases_of_analysis(binaries, rng, command, embedded):
    machines, flags = ANALYSES[command]
    name = rng.choice(machines)
    arguments = [command, name]
    for override in overrides_of(rng, embedded[name]):
        arguments += ["--set", override]
    for flag, values in flags.items():
        if rng.random() < (0.08 if flag in SELDOM else 0.3):
            arguments += [word for word in (flag, rng.choice(values)) if word is not None]
    kinds = ["json", *(kind for kind in ("csv", "svg") if rng.random() < 0.8)]
    kinds += ["toml"] if command in ("linkage", "brake") and rng.random() < 0.5 else []
    kinds += ["dxf"] if "--cam" in arguments else []
    arguments += ["--format", ",".join(kinds), *(["--json"] if rng.random() < 0.85 else [])]
    arguments += ["--force"] if rng.random() < 0.6 else []
    with Pair(binaries, {}) as pair:
        yield pair.run(arguments)


# ---- motion programs ----


def programs():
    """The generator of tests/independent/programs.py; None without numpy."""
    sys.path.append(str(Path(__file__).resolve().parents[1] / "independent"))
    try:
        import program_draw
    except ModuleNotFoundError as error:
        if error.name != "numpy":
            raise
        return None
    return program_draw


def cases_of_program(binaries, rng, generator):
    case = generator.draw(rng)
    kinds = ["json", *(kind for kind in ("dxf", "csv", "svg", "step") if rng.random() < 0.7)]
    flags = list(case["words"]) + (["--set", f"cam.thickness={rng.choice([8, 15.5])}mm"] if "step" in kinds else [])
    if rng.random() < 0.3:
        kinds.append("points")
        flags += points_flags(rng, has_centre="roller" in case["kind"])
    for share, *more in ((0.1, "--outline", "spline"), (0.1, "--cutter-radius", "8mm"), (0.1, "--dxf-version", "r12"), (0.1, "--rpm", "95")):
        flags += more if rng.random() < share and more[0] not in flags else []
    with Pair(binaries, {"design.toml": generator.written(case), **case["files"]}) as pair:
        made = pair.run(["make", "design.toml", *flags, "--format", ",".join(kinds), *(["--json"] if rng.random() < 0.85 else [])])
        yield made
        yield from cases_of_check(pair, rng, made, ["--design", "design.toml"], flags)
        for command in ("size", "laws"):
            if rng.random() < 0.15:
                yield pair.run([command, "design.toml", "--format", "csv,json", "--json", "--name", command])


# ---- comparing ----


@dataclass
class Group:
    """The same thing seen in several runs, with the first of them."""

    count: int = 0
    example: str = ""
    detail: str = ""
    largest: float = 0.0  # relative change of a number


@dataclass
class Tally:
    """Everything seen; the keys of the groups are (command, kind, path)."""

    runs: Counter = field(default_factory=Counter)
    files: Counter = field(default_factory=Counter)
    text: Counter = field(default_factory=Counter)
    differences: dict = field(default_factory=lambda: defaultdict(Group))
    additions: dict = field(default_factory=lambda: defaultdict(Group))
    wording: dict = field(default_factory=lambda: defaultdict(Group))
    panics: dict = field(default_factory=lambda: defaultdict(Group))


def clip(value, room=120):
    text = value if isinstance(value, str) else json.dumps(value, ensure_ascii=False)
    text = " ⏎ ".join(text.strip().splitlines())
    return text if len(text) <= room else text[:room] + "…"


def change_of(before, after, room=120):
    """Two values side by side; of long texts what surrounds the first change."""
    if isinstance(before, str) and isinstance(after, str) and max(len(before), len(after)) > room:
        at = next((i for i, (a, b) in enumerate(zip(before, after)) if a != b), min(len(before), len(after)))
        start = max(0, at - room // 3)
        lead = "…" if start else ""
        return f"{lead}{clip(before[start:], room)}  →  {lead}{clip(after[start:], room)}"
    return f"{clip(before, room)}  →  {clip(after, room)}"


class Seen:
    """What one run adds to the tally: a group counts a run once, however often it is in it."""

    def __init__(self, case):
        self.case, self.found = case, {}

    def add(self, where, kind, path, detail="", change=0.0):
        held = self.found.setdefault((where, kind, path), [detail, change])
        held[1] = max(held[1], change)

    def into(self, tally):
        for (where, kind, path), (detail, change) in self.found.items():
            # A message about a machine is the same from every command.
            command = "any" if kind == "message" else self.case.command
            group = getattr(tally, where)[command, kind, path]
            if group.count == 0:
                group.example, group.detail = self.case.line, detail
            group.count += 1
            group.largest = max(group.largest, change)


def named_checks(checks):
    """The list of checks as a table by name; a name that comes again gets a number."""
    table, times = {}, Counter()
    for check in checks:
        name = str(check.get("check"))
        times[name] += 1
        table[name if times[name] == 1 else f"{name} {times[name]}"] = check
    return table


def compare_values(seen, path, before, after):
    if path.endswith(".note"):
        if before != after:
            seen.add("wording", "note", path, change_of(before, after))
    elif isinstance(before, dict) and isinstance(after, dict):
        for key in before | after:
            # Checks are told by [name], keys of tables by .key; a note may come and go.
            inner = f"{path}[{key}]" if path == "checks" else f"{path}.{key}".lstrip(".")
            if key == "note" or key in before and key in after:
                compare_values(seen, inner, before.get(key, ""), after.get(key, ""))
            elif key in after:
                seen.add("additions", "report", inner, clip(after[key]))
            else:
                seen.add("differences", "report: gone", inner, clip(before[key]))
    elif isinstance(before, list) and isinstance(after, list):
        if path == "checks":
            compare_values(seen, path, named_checks(before), named_checks(after))
        elif len(before) != len(after):
            seen.add("differences", "report", f"{path}[] length", f"{len(before)}  →  {len(after)}")
        else:
            for one, other in zip(before, after):
                compare_values(seen, f"{path}[]", one, other)
    elif repr(before) != repr(after):  # tells 1 from 1.0, 0.0 from -0.0, and finds NaN equal to itself
        numbers = type(before) is float and type(after) is float
        change = abs(after - before) / max(abs(before), abs(after), 5e-324) if numbers else 0.0
        seen.add("differences", "report", path, change_of(before, after), change)


def compare_reports(seen, where, before, after):
    """Two reports as text; empty where there is none."""
    if before == after:
        return
    try:
        tables = json.loads(before), json.loads(after)
    except ValueError:
        seen.add("differences", "report", f"no JSON to compare {where}", change_of(before, after))
    else:
        compare_values(seen, "", *tables)


def first_change(before, after):
    try:
        one, other = before.decode().split("\n"), after.decode().split("\n")
    except UnicodeDecodeError:
        at = next((i for i, (a, b) in enumerate(zip(before, after)) if a != b), min(len(before), len(after)))
        return f"from byte {at} on, {len(before)}  →  {len(after)} bytes"
    for line, (a, b) in enumerate(zip(one, other), 1):
        if a != b:
            return f"line {line}: {change_of(a, b, 60)}"
    return f"{len(one)}  →  {len(other)} lines"


def file_kind(name):
    return "-cutter.dxf" if name.endswith("-cutter.dxf") else Path(name).suffix


def compare_files(seen, tally, before, after):
    for name in sorted(before.keys() | after.keys()):
        kind = file_kind(name)
        if name not in after or name not in before:
            seen.add("differences", "files", f"{kind} only {'before' if name in before else 'after'}", name)
            continue
        one, other = before[name], after[name]
        tally.files[kind, one == other] += 1
        if one == other:
            continue
        if Path(name).suffix in BYTES:
            seen.add("differences", "bytes", kind, f"{name}, {first_change(one, other)}")
        elif kind == ".json":
            compare_reports(seen, "in the file", one.decode(errors="replace"), other.decode(errors="replace"))
        elif kind not in COUNTED:
            seen.add("differences", "bytes", kind, f"{name}, of no known kind")


def told(err):
    """The shape of a message: without its numbers."""
    return re.sub(r"\d[\d.e+-]*", "#", err)


def changed_lines(before, after):
    one, other = before.splitlines(), after.splitlines()
    gone, come = [line for line in one if line not in other], [line for line in other if line not in one]
    return f"{clip(chr(10).join(gone), 300)}\n      →  {clip(chr(10).join(come), 300)}"


def compare_case(tally, case):
    seen, before, after = Seen(case), case.before, case.after
    tally.runs[case.command, before.code, after.code] += 1
    if before.code != after.code:
        detail = clip(before.err, 200) + "  →  " + clip(after.err, 200)
        seen.add("differences", "exit code", f"{before.code} → {after.code}", detail)
    for build, ended in (("before", before), ("after", after)):
        if "panicked" in ended.err:
            seen.add("panics", build, told(clip(ended.err, 200)), clip(ended.err, 300))
    if before.code == "timeout" or after.code == "timeout":
        seen.into(tally)
        return
    if "--json" in case.line:
        compare_reports(seen, "on standard output", before.out, after.out)
    elif before.out != after.out:
        tally.text["standard output"] += 1
    if before.err != after.err:
        if before.code == after.code == 2:
            seen.add("wording", "message", f"{told(before.err)}\0{told(after.err)}", changed_lines(before.err, after.err))
        else:
            tally.text["standard error"] += 1
    if case.files:
        compare_files(seen, tally, *case.files)
    seen.into(tally)


# ---- telling ----


def tell_groups(title, groups):
    print(f"\n{title}: {len(groups) or 'none'}")
    for (command, kind, path), group in sorted(groups.items()):
        # The path of a message is the pair of its shapes, which its detail shows.
        label = f"{command} | {kind}" + ("" if kind == "message" else f" | {path}")
        largest = f", up to {group.largest:.2g} relative" if group.largest else ""
        print(f"  {label}\n      {group.count} runs{largest}; {group.detail}\n      {group.example}")


def tell_counts(tally):
    print("runs by exit code")
    for command in dict.fromkeys(command for command, *_ in tally.runs):
        counts = {(one, other): count for (name, one, other), count in tally.runs.items() if name == command}
        parts = [
            f"{one if one == other else f'{one} → {other}'}: {count}"
            for (one, other), count in sorted(counts.items(), key=str)
        ]
        print(f"  {command:12} {sum(counts.values()):5}   {',  '.join(parts)}")
    print("files of the same name, and how many with the same bytes")
    for kind in sorted({kind for kind, _ in tally.files}):
        same, other = tally.files[kind, True], tally.files[kind, False]
        print(f"  {kind:12} {same + other:5}   {same}")
    print("only counted")
    counted = sum(tally.files[kind, False] for kind in COUNTED)
    print(f"  SVG, HTML and PDF files {counted}, standard output as text {tally.text['standard output']}, "
          f"standard error (exit code not 2) {tally.text['standard error']}")


def main():
    parser = argparse.ArgumentParser(usage=__doc__.splitlines()[2].removeprefix("usage: "))
    parser.add_argument("before", type=Path)
    parser.add_argument("after", type=Path)
    parser.add_argument("--machines", type=int, default=100)
    parser.add_argument("--programs", type=int, help="100 where numpy is installed")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--allow", type=Path)
    args = parser.parse_args()
    binaries = [args.before.resolve(), args.after.resolve()]
    try:
        allowed = [re.compile(line) for line in args.allow.read_text().splitlines()
                   if line.strip() and not line.startswith("#")] if args.allow else []
        embedded = {}
        for name in dict.fromkeys(["dpi", "dpi-paper"] + [name for machines, _ in ANALYSES.values() for name in machines]):
            shown = start(binaries[0], ["machines", "show", name], ".")
            if shown.code != 0:
                parser.error(f"{args.before} machines show {name}: exit code {shown.code}: {shown.err}")
            embedded[name] = shown.out
        start(binaries[1], ["--version"], ".")
    except (OSError, re.error) as error:
        parser.error(str(error))

    generator = programs()
    if generator is None and args.programs:
        parser.error("--programs needs numpy: run this with target/independent-venv/bin/python, which tests/run installs")
    count = 0 if generator is None else 100 if args.programs is None else args.programs
    if generator is None:
        print("no motion programs are compared: numpy is not installed\n")

    def cases(index, command):
        rng = random.Random(f"{args.seed} {index} {command}")
        if command == "make":
            return cases_of_program(binaries, rng, generator)
        if command in ANALYSES:
            return cases_of_analysis(binaries, rng, command, embedded)
        machine = random_machine(random.Random(f"{args.seed} {index}"), embedded)
        return cases_of_command(binaries, rng, command, *machine)

    def work(place):
        found = Tally()
        for case in cases(*place):
            compare_case(found, case)
        return found

    tally = Tally()
    places = [(index, command) for index in range(args.machines) for command in ("rotary", "translating", "conoid", *ANALYSES)]
    places += [(index, "make") for index in range(count)]
    with ThreadPoolExecutor(args.jobs) as pool:
        # Added up in the order of the runs, so that the list does not depend on which of them ends first.
        for found in pool.map(work, places):
            add(tally, found)

    intended, differences, used = {}, {}, set()
    for key, group in tally.differences.items():
        fitting = [pattern for pattern in allowed if pattern.search(" | ".join(key))]
        used.update(fitting)
        (intended if fitting else differences)[key] = group

    tell_counts(tally)
    for title, groups in (("panics", tally.panics), ("additions", tally.additions), ("wording", tally.wording)):
        tell_groups(title, groups)
    if allowed:
        tell_groups("intended differences", intended)
        for pattern in allowed:
            if pattern not in used:
                print(f"  never found: {pattern.pattern}")
    tell_groups("DIFFERENCES" if differences else "differences", differences)
    return 1 if differences else 0


def add(tally, found):
    for name in ("runs", "files", "text"):
        getattr(tally, name).update(getattr(found, name))
    for name in ("differences", "additions", "wording", "panics"):
        for key, group in getattr(found, name).items():
            held = getattr(tally, name)[key]
            if held.count == 0:
                held.example, held.detail = group.example, group.detail
            held.count += group.count
            held.largest = max(held.largest, group.largest)


if __name__ == "__main__":
    sys.exit(main())
