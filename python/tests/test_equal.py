"""The results of the package are those of the command line, to the last bit, for random designs of every command.

COUNT in the environment is how many designs of each command; seeded, so that a failure comes again.
"""

import json
import os
import random

import pytest

import camgen

COUNT = int(os.environ.get("COUNT", "3"))

#: Machines of `make`, with keys that are varied: low and high, and the unit.
MAKE = {
    "feeder": {"follower.roller.radius": (10, 20, "mm"), "motion.segment[0].to": (15, 32, "mm"), "cam.thickness": (10, 25, "mm")},
    "valve": {"cam.thickness": (10, 25, "mm"), "cam.base_radius": (36, 60, "mm")},
    "lever": {"follower.swinging-roller.radius": (12, 18, "mm"), "cam.thickness": (10, 20, "mm")},
    "groove": {"cam.thickness": (20, 30, "mm")},
    "conjugate": {"cam.thickness": (10, 20, "mm")},
    "yoke": {"cam.thickness": (10, 20, "mm")},
    "wedge": {"cam.thickness": (10, 20, "mm")},
}
PRESS = {"follower.roller.radius": (22, 34, "mm"), "cam.thickness": (20, 40, "mm"), "bed.mass": (900, 1000, "kg")}


def varied(draw, keys):
    """Random values of some of the keys."""
    return {
        key: f"{draw.uniform(low, high):.{draw.choice([0, 2, 9])}f}{unit}"
        for key, (low, high, unit) in keys.items()
        if draw.random() < 0.7
    }


def typed(overrides):
    return [word for key, value in overrides.items() for word in ("--set", f"{key}={value}")]


def refused(error, done):
    """The same message, and the same exit code."""
    assert done.returncode == 2, f"the package refuses what the program makes: {error}"
    assert error.faults[0].message in done.stderr.decode(), (error, done.stderr.decode())


@pytest.fixture
def at(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


def both(program, at, command, machine, overrides, flags, cam, drawn):
    """The files of the program, then those of the package in the same place, byte for byte."""
    (at / "own").mkdir(exist_ok=True)
    arguments = [command, machine, *typed(overrides), *flags, "--force"]
    done = program(*arguments, "--json", cwd=at, expected=(0, 1, 2))
    try:
        proven = camgen.Machine.load(machine, overrides).cam(command, **cam).draw(**drawn).prove()
        os.chdir(at / "own")
        files = [] if proven.no_outline else proven.write("output", force=True, overwrite=True)["files"]
    except camgen.CamgenError as error:
        return refused(error, done)
    finally:
        os.chdir(at)
    report, own = json.loads(done.stdout), {**proven.report, "files": files}
    # What changed since the last files of that name is told of the place.
    report.pop("notes", None), own.pop("notes", None)
    assert own == report
    assert proven.passed == (done.returncode == 0)
    for name in files:
        assert (at / "own" / name).read_bytes() == (at / name).read_bytes(), name
    return files


@pytest.mark.parametrize("index", range(COUNT))
@pytest.mark.parametrize("machine", sorted(MAKE))
def test_make(program, at, machine, index):
    draw = random.Random(f"make {machine} {index}")
    overrides = varied(draw, MAKE[machine])
    formats = draw.choice([None, "dxf,svg,step,csv,json", "dxf,csv,html", "dxf,points,diagram,pdf"])
    flags, drawn = (["--format", formats], {"formats": formats}) if formats else ([], {})
    rpm = draw.choice([None, draw.randint(30, 200)])
    if rpm and machine != "wedge":
        flags, cam = [*flags, "--rpm", rpm], {"rpm": rpm}
    else:
        cam = {}
    tolerance = draw.choice([None, f"{draw.uniform(2, 30):.3f}um"])
    if tolerance:
        flags, drawn = [*flags, "--tolerance", tolerance], {**drawn, "tolerance": tolerance}
    if draw.random() < 0.3:
        flags, drawn = [*flags, "--side", "outside"], {**drawn, "side": "outside"}
    if draw.random() < 0.3:
        flags, drawn = [*flags, "--tolerance-acceleration", "2%"], {**drawn, "tolerance_acceleration": 0.02}
    if draw.random() < 0.2:
        flags, drawn = [*flags, "--outline", "spline"], {**drawn, "outline": "spline"}
    both(program, at, "make", machine, overrides, flags, cam, drawn)


@pytest.mark.parametrize("index", range(COUNT))
def test_tool_files(program, at, index):
    """Programs, tables for drives and of points, places for a measuring machine, with all of their options."""
    draw = random.Random(f"tools {index}")
    options = {
        "controller": draw.choice(["linuxcnc", "fanuc", "sinumerik", "heidenhain"]),
        "ball_diameter": "2mm",
        "points_of": draw.choice(["profile", "centre"]),
        "points_as": draw.choice(["polar", "xy"]),
        "points_step": draw.choice(["angle", "chord"]),
        "points_between": draw.choice(["linear", "cubic"]),
    }
    flags = [word for name, value in options.items() for word in ("--" + name.replace("_", "-"), value)]
    flags += ["--start", "20deg", "--lead-in", "arc", "3mm"]
    drawn = {**options, "start": "20deg", "lead_in": ("arc", 0.003)}
    formats = "dxf,gcode,servo-csv,servo-xyva,servo-twincat,inspect,points"
    files = both(
        program, at, "make", "feeder", varied(draw, MAKE["feeder"]), [*flags, "--format", formats, "--cutter-diameter", "8mm"],
        {"cutter_diameter": 0.008}, {**drawn, "formats": formats},
    )
    assert files is None or len(files) >= 8


@pytest.mark.parametrize("index", range(COUNT))
def test_rotary(program, at, index):
    draw = random.Random(f"rotary {index}")
    rpm = round(draw.uniform(20, 36), draw.choice([0, 3]))
    machine, end = draw.choice([("dpi", None), ("dpi", None), ("dpi-six-bar", draw.choice(["outer", "inner"]))])
    flags, cam = ["--rpm", rpm], {"rpm": rpm}
    if end:
        flags, cam = [*flags, "--end", end], {**cam, "end": end}
    if draw.random() < 0.4:
        flags, cam = [*flags, "--cutter-diameter", "16mm"], {**cam, "cutter_diameter": 0.016}
    both(program, at, "rotary", machine, varied(draw, PRESS), flags, cam, {})


@pytest.mark.parametrize("index", range(COUNT))
def test_translating(program, at, index):
    draw = random.Random(f"translating {index}")
    rpm, balance = draw.randint(25, 36), draw.choice(["braking", "return", "mean"])
    flags, cam = ["--rpm", rpm, "--balance", balance], {"rpm": rpm, "balance": balance}
    if draw.random() < 0.4:
        flags, cam = [*flags, "--solver", "paper", "--stations", 900], {**cam, "solver": "paper", "stations": 900}
    both(program, at, "translating", "dpi", varied(draw, {"bed.mass": (900, 1000, "kg")}), flags, cam, {})


@pytest.mark.parametrize("index", range(COUNT))
def test_conoid(program, at, index):
    draw = random.Random(f"conoid {index}")
    if draw.random() < 0.3:
        flags, cam = ["--rpm", "28..35", "--residual", "20N"], {"rpm": "28..35", "residual": 20}
    else:
        speeds = sorted(draw.sample(range(22, 36), draw.choice([2, 3])))
        flags, cam = ["--rpm", ",".join(map(str, speeds))], {"rpm": speeds}
    flags, drawn = [*flags, "--format", "dxf,csv,step", "--tolerance", "50um"], {"formats": ["dxf", "csv", "step"], "tolerance": 50e-6}
    both(program, at, "conoid", "dpi", varied(draw, {"bed.mass": (900, 1000, "kg")}), flags, cam, drawn)


def options_of(draw, name):
    """Random options of an analysis: the machine, its overrides, what it is read as, and options."""
    if name == "regimes":
        return "dpi", varied(draw, PRESS), "cam", {"rpm": sorted(draw.sample(range(20, 36), 3)), "reset": draw.choice(["end", "half", "level"])}
    if name == "spring":
        return "dpi", varied(draw, {"bed.mass": (900, 1000, "kg")}), "cam", {"stiffness": f"{draw.randint(100, 900)} N/mm", "rpm": [30, 35]}
    if name == "drive":
        return "dp", varied(draw, {"bed.mass": (2000, 2300, "kg")}), "drive", {"step": draw.choice(["1deg", "2deg"])}
    if name == "linkage":
        return "dpi-six-bar", {}, "cam", {"rpm": draw.randint(20, 40)}
    if name == "shaft":
        return "press-cylinder", {}, "shaft", {"modes": draw.randint(1, 4), "samples": draw.randint(20, 200)}
    if name == "brake":
        return "roll", {}, "brake", {"samples": draw.randint(10, 100), "cam": draw.random() < 0.3}
    if name == "size":
        return "feeder", varied(draw, MAKE["feeder"]), "cam", {"free": draw.choice([None, "offset"])}
    if name == "laws":
        laws = draw.sample([law.name for law in camgen.laws()], 4)
        return draw.choice(["feeder", None]), {}, "cam", {"laws": laws, "lift": f"{draw.randint(5, 40)}mm"}
    raise AssertionError(name)


@pytest.mark.parametrize("index", range(COUNT))
@pytest.mark.parametrize("name", [name for name in camgen.analyses() if name != "compare"])
def test_analysis(program, at, name, index):
    draw = random.Random(f"{name} {index}")
    machine, overrides, read_as, options = options_of(draw, name)
    flags = []
    for option, value in options.items():
        flag = "--" + option.replace("_", "-")
        if value is True:
            flags += [flag]
        elif value not in (None, False):
            flags += [flag, ",".join(map(str, value)) if isinstance(value, list) else value]
    place = [machine] if machine else []
    done = program(name, *place, *typed(overrides), *flags, "--json", "--force", "--format", "csv,svg,json", cwd=at, expected=(0, 1, 2))
    (at / "own").mkdir()
    try:
        loaded = camgen.Machine.load(machine, overrides, read_as=read_as) if machine else None
        found = camgen.analyse(name, loaded, **options)
    except camgen.CamgenError as error:
        return refused(error, done)
    os.chdir(at / "own")
    written = found.write("output", formats="csv,svg,json", force=True)
    assert written == json.loads(done.stdout)
    assert found.passed == (done.returncode == 0)
    for file in written["files"]:
        assert (at / "own" / file).read_bytes() == (at / file).read_bytes(), file


@pytest.mark.parametrize("index", range(COUNT))
def test_compare_and_check(program, at, index):
    draw = random.Random(f"compare {index}")
    overrides = varied(draw, MAKE["feeder"])
    proven = camgen.Machine.load("feeder", overrides).cam("make").draw("20um").prove()
    outline = proven.outline
    lines = [f"{x:.6f} {y:.6f}" for x, y in outline[:, :2] * draw.uniform(0.9995, 1.0005)]
    (at / "measured.txt").write_text("\n".join(lines) + "\n")
    machine = camgen.Machine.load("feeder", overrides)
    done = program("compare", "measured.txt", "feeder", *typed(overrides), "--json", "--dry-run", cwd=at, expected=(0, 1, 2))
    try:
        report = machine.analyse("compare", measured=at / "measured.txt").report
        assert report == json.loads(done.stdout)
    except camgen.CamgenError as error:
        refused(error, done)
    # Whether its own file, and that of a slightly other cam, is this cam.
    (at / "cam.dxf").write_bytes(proven.bytes(".dxf"))
    other = machine.with_overrides({"motion.segment[0].to": draw.choice(["30mm", "30.02mm"])})
    for cam, more in ((machine, []), (other, typed({"motion.segment[0].to": other.values()["motion.segment[0].to"]}))):
        found = cam.cam("make").check(at / "cam.dxf", "25um")
        done = program("check", "cam.dxf", "--design", "feeder", *typed(overrides), *more, "--tolerance", "25um", "--json", cwd=at)
        assert found["checks"] == json.loads(done.stdout)["checks"]


def test_named_accuracies_and_the_default(program, at):
    """One default, in the library: as many arcs as the command draws."""
    for accuracy in (None, "draft", "standard", "fine"):
        flags = ["--accuracy", accuracy] if accuracy else []
        report = json.loads(program("make", "feeder", "--json", "--dry-run", *flags, cwd=at).stdout)
        outline = camgen.Machine.load("feeder").cam().draw(accuracy=accuracy).prove().outline
        drawn = report["outline"]["arcs"] + report["outline"]["lines"]
        assert len(outline) == drawn, accuracy
