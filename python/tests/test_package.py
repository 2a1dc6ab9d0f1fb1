"""What the package promises beyond the command line: faults, overrides, motions, arrays, threads, types."""

import html
import json
import math
import os
import pickle
import re
import subprocess
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest

import camgen

#: Designs of the test of memory; the long run is 10000.
DESIGNS = int(os.environ.get("DESIGNS", "200"))

TOML = """
name = "Pusher"
[motion]
start = "0 mm"
[[motion.segment]]
law = "cycloidal"
over = "120 deg"
to = "15 mm"
[[motion.segment]]
law = "cycloidal"
over = "120 deg"
to = "0 mm"
[[motion.segment]]
law = "dwell"
[follower.roller]
radius = "10 mm"
[cam]
bore_radius = "8 mm"
thickness = "12 mm"
[limits]
"""

DATA = {
    "name": "Pusher",
    "motion": {
        "start": "0 mm",
        "segment": [
            {"law": "cycloidal", "over": "120 deg", "to": "15 mm"},
            {"law": "cycloidal", "over": "120 deg", "to": "0 mm"},
            {"law": "dwell"},
        ],
    },
    "follower": {"roller": {"radius": "10 mm"}},
    "cam": {"bore_radius": "8 mm", "thickness": "12 mm"},
    "limits": {},
}


def test_every_fault_has_key_place_and_remedy():
    with pytest.raises(camgen.MachineError) as raised:
        camgen.Machine.load("feeder", {"cam.thikness": "20mm", "cam.bore_radius": "-1mm", "limits.pressure_angle": 30})
    faults = {fault.key: fault for fault in raised.value.faults}
    assert set(faults) == {"cam.thikness", "cam.bore_radius", "limits.pressure_angle"}
    assert "cam.thickness" in faults["cam.thikness"].remedy
    assert all(fault.place.startswith("--set:1:") for fault in faults.values())
    assert isinstance(raised.value, ValueError) and "cam.thikness" in str(raised.value)
    again = pickle.loads(pickle.dumps(raised.value))
    assert again.faults == raised.value.faults and type(again) is camgen.MachineError

    with pytest.raises(camgen.MachineError) as raised:
        camgen.Machine.from_toml(TOML.replace('radius = "10 mm"', 'radius = "10 kg"'), name="pusher.toml")
    (fault,) = raised.value.faults
    assert fault.key == "follower.roller.radius" and fault.place.startswith("pusher.toml:16:")

    with pytest.raises(camgen.MachineError) as raised:
        camgen.Machine.from_toml(TOML.replace('radius = "10 mm"', ""))
    assert [fault.key for fault in raised.value.faults] == ["follower.roller.radius"]

    with pytest.raises(camgen.MachineError, match="cannot read"):
        camgen.Machine.load("no such file.toml")


def test_options_are_told_by_their_names():
    machine = camgen.Machine.load("feeder")
    cam = machine.cam()
    wrong = {
        "tolerance": lambda: cam.draw("5"),
        "side": lambda: cam.draw(side="insid"),
        "tolerance_acceleration": lambda: cam.draw(tolerance_acceleration=5),
        "formats": lambda: cam.draw(formats=["dwg"]),
        "controller": lambda: cam.draw(controller="fanuc"),
        "samples": lambda: cam.table(0),
        "rpm": lambda: machine.cam(rpm=-3),
        "kind": lambda: machine.cam("rotry"),
        "free": lambda: machine.cam(free="ofset"),
        "theta": lambda: cam.curves([math.nan]),
        "read_as": lambda: camgen.Machine.load("feeder", read_as="disc"),
        "name": lambda: machine.analyse("sizes"),
        "size": lambda: machine.analyse("size", fre="offset"),
        "json": lambda: machine.analyse("size", json=True),
        "function": lambda: camgen.Motion.from_function(lambda theta: (theta, theta)),
        "lift": lambda: camgen.Motion.from_samples([0, 1, 2], [0, 1]),
        "segments": lambda: camgen.Motion.program([("cycloidal", "180deg", "20mm")]),
        "law": lambda: camgen.Motion.program([("cyclodal", "180deg", "20mm"), ("cycloidal", "180deg", 0.0)]),
        # Texts that are no names of files.
        "file": lambda: cam.check("\ud800"),
        "directory": lambda: cam.draw().prove().write("a\ud800"),
        "out": lambda: camgen.Study.load("lever-pareto").collect([], "\ud800"),
        "typed": lambda: camgen._camgen.command(["camgen", "\ud800"]),
    }
    for parameter, call in wrong.items():
        with pytest.raises(camgen.OptionError) as raised:
            call()
        assert raised.value.faults[0].key == parameter, (parameter, raised.value)
    with pytest.raises(camgen.SolveError) as raised:
        camgen.Machine.load("dpi").cam(rpm=35, end="inner")
    (fault,) = raised.value.faults
    assert "no linkage" in fault.message and fault.remedy


def test_a_solid_is_written_of_a_drawn_flank_only():
    cam = camgen.Machine.load("dpi").cam("conoid", rpm=[30, 35])
    sections = cam.draw("50um", formats=["dxf"]).prove()
    with pytest.raises(camgen.OptionError, match="no step file: the flank"):
        sections.bytes(".step")
    assert b"B_SPLINE_SURFACE" in cam.draw("50um").prove().bytes(".step")


def test_a_refused_cam_is_not_written(tmp_path):
    cam = camgen.Machine.load("feeder", {"limits.pressure_angle": "20 deg", "cam.base_radius": "30 mm"}).cam()
    proven = cam.draw().prove()
    assert not proven.passed and "FAILED: pressure_angle" in repr(proven)
    with pytest.raises(camgen.RefusedError, match="pressure_angle"):
        proven.write(tmp_path)
    assert list(tmp_path.iterdir()) == []
    assert proven.write(tmp_path, force=True)["files"]
    (tmp_path / "mine.dxf").write_text("mine")
    with pytest.raises(camgen.FilesError) as raised:
        proven.write(tmp_path, force=True, name="mine", formats=["dxf"])
    assert isinstance(raised.value, OSError)
    assert (tmp_path / "mine.dxf").read_text() == "mine"


def test_a_file_a_text_and_a_dictionary_are_one_machine(tmp_path):
    (tmp_path / "machine.toml").write_text(TOML)
    loaded = camgen.Machine.load(tmp_path / "machine.toml")
    files = [machine.cam().draw().prove().files() for machine in (loaded, camgen.Machine.from_toml(TOML), camgen.Machine.from_dict(DATA))]
    assert files[0] == files[1] == files[2]
    odd = {**DATA, "name": 'a "quote" \\ ü € 𝛼'}
    assert camgen.Machine.from_dict(odd).name == odd["name"]
    numbers = camgen.Machine.from_dict({**DATA, "motion": {**DATA["motion"], "rpm": np.float64(90.5)}})
    assert numbers.cam().rpm == [90.5]
    with pytest.raises(camgen.OptionError) as raised:
        camgen.Machine.from_dict({**DATA, "cam": {"thickness": object()}})
    assert raised.value.faults[0].key == "cam.thickness"


def test_overrides_are_as_those_of_a_loaded_file():
    base = camgen.Machine.load("feeder")
    keys = {"follower.roller.radius": "14mm", "motion.rpm": 90, "motion.segment.1.to": "28mm"}
    fresh = camgen.Machine.load("feeder", keys)
    assert base.with_overrides(keys).values() == fresh.values() != base.values()
    again = base.with_overrides({"motion.rpm": 50}).with_overrides({"motion.rpm": 90})
    assert again.cam().rpm == [90.0]
    assert fresh.values()["motion.rpm"] == "90"


def test_figures_before_a_drawing_are_those_of_the_report():
    for name, kind, rpm in (("feeder", "make", 120), ("dpi", "rotary", 35), ("lever", "make", 60)):
        cam = camgen.Machine.load(name).cam(kind, rpm=rpm)
        report = cam.draw().prove().report
        assert cam.base_radius_mm == report["cam"]["base_radius_mm"]
        assert cam.prime_radius_mm == report["cam"]["prime_radius_mm"]
        found = {check["check"]: check for check in report["checks"]}
        assert cam.pressure_angle_deg == found["pressure_angle"]["value"]
        assert cam.pressure_angle == math.radians(cam.pressure_angle_deg)
        assert cam.finding("contact_stress").value == found["contact_stress"]["value"]
        forces = cam.forces()
        # What is known of the drawing alone is not there yet.
        found = report.get("dynamics", report.get("force"))
        assert forces and all(found[key] == value for key, value in forces.items() if "residual" not in key)
        assert cam.figures()["cam"]["max_lift_mm" if name != "lever" else "max_lift_deg"] > 0


def test_curves_are_the_table_at_any_angle():
    cam = camgen.Machine.load("feeder").cam()
    table = cam.table(360)
    theta = np.radians(np.arange(360))
    curves = cam.curves(theta)
    assert set(curves) <= set(table) and {"lift_mm", "pressure_angle_deg", "profile_x_mm"} <= set(curves)
    for name in curves:
        assert curves[name].shape == (360,) and curves[name].base is not None
        np.testing.assert_allclose(curves[name], table[name], rtol=1e-9, atol=1e-9)
    # Exact derivatives: a central difference of the lift has the velocity.
    step = 1e-5
    rates = (cam.curves(theta + 1e-3 + step)["lift_mm"] - cam.curves(theta + 1e-3 - step)["lift_mm"]) / (2 * step)
    np.testing.assert_allclose(rates, cam.curves(theta + 1e-3)["velocity_mm_per_rad"], atol=1e-5)
    assert table.array.shape == (len(table.columns), 360)
    proven = cam.draw(samples=90).prove()
    assert proven.table().array.shape[1] == 90 and "acceleration_cut_mm_per_rad2" in proven.table()


def area_by_green(outline):
    """Area of a closed chain of arcs: the polygon, and a segment of a circle for each bulge."""
    start, end = outline[:, :2], np.roll(outline[:, :2], -1, axis=0)
    polygon = 0.5 * np.sum(start[:, 0] * end[:, 1] - end[:, 0] * start[:, 1])
    chord, sweep = np.hypot(*(end - start).T), 4 * np.arctan(outline[:, 2])
    curved = np.abs(sweep) > 1e-9
    radius = chord[curved] / (2 * np.sin(0.5 * sweep[curved]))
    return polygon + np.sum(0.5 * radius**2 * (sweep[curved] - np.sin(sweep[curved])))


def test_the_outline_is_what_is_cut():
    cam = camgen.Machine.load("feeder").cam()
    proven = cam.draw().prove()
    bore = math.pi * 10.0**2
    values = camgen.Machine.load("feeder").values()
    radius = float(re.match(r"Ø?([\d.]+)", values["cam.bore_radius"])[1])
    bore = math.pi * (radius / (2 if "Ø" in values["cam.bore_radius"] else 1)) ** 2
    keyway = area_by_green(proven.outline) - bore - proven.area_mm2
    # What else is cut is a keyway or a hole at most.
    assert 0 <= keyway + 1e-6 and keyway < 0.05 * bore
    assert proven.cubics.shape == (0, 4, 2)
    spline = cam.draw(outline="spline").prove()
    assert np.isnan(spline.outline[:, 2]).any() and spline.cubics.shape[1:] == (4, 2)
    assert spline.area_mm2 == pytest.approx(proven.area_mm2, rel=1e-4)


def harmonic(theta, lift=0.010):
    sin, cos = np.sin(theta), np.cos(theta)
    return lift * (1 - cos), lift * sin, lift * cos, -lift * sin


MACHINE = {"name": "own", "follower": {"roller": {"radius": "12 mm"}}, "cam": {"bore_radius": "8 mm"}, "limits": {}}


def test_a_function_is_the_motion_it_is():
    motion = camgen.Motion.from_function(harmonic)
    theta = np.linspace(0, 2 * math.pi, 1001)[:-1]
    for found, exact, within in zip(motion(theta), harmonic(theta), (1e-14, 1e-12, 1e-10, 1e-8)):
        np.testing.assert_allclose(found, exact, atol=within)
    # The offset of a circle that turns about a point beside its centre is a circle: the cam is an eccentric one.
    cam = camgen.Machine.from_dict(MACHINE, {"cam.base_radius": "23mm"}).cam(motion=camgen.Motion.from_function(eccentric))
    profile = cam.table(500)
    radii = np.hypot(profile["profile_x_mm"] + 5.0, profile["profile_y_mm"])
    np.testing.assert_allclose(radii, 28.0, atol=1e-9)
    assert cam.draw("1um").prove().passed


def eccentric(theta):
    """A roller on a circle of pitch radius 40 mm about a point 5 mm beside the shaft, lift from the lowest point at 0."""
    e, r = 0.005, 0.040
    sin, cos = np.sin(theta), np.cos(theta)
    root = np.sqrt(r * r - (e * sin) ** 2)
    # s = root - e cos - (r - e), with the derivatives of the root.
    d1 = -e * e * sin * cos / root
    d2 = -(e * e * (cos * cos - sin * sin) + d1 * d1) / root
    d3 = (4 * e * e * sin * cos - 3 * d1 * d2) / root
    return root - e * cos - (r - e), d1 + e * sin, d2 + e * cos, d3 - e * sin


def test_a_wrong_derivative_is_told():
    def wrong(theta):
        s, ds, dds, ddds = harmonic(theta)
        return s, ds, 1.001 * dds, ddds

    with pytest.raises(camgen.OptionError, match="the acceleration|the jerk|the velocity|the lift"):
        camgen.Motion.from_function(wrong)
    with pytest.raises(camgen.OptionError, match="jumps"):
        camgen.Motion.from_function(lambda theta: (0.001 * theta, 0 * theta + 0.001, 0 * theta, 0 * theta))
    with pytest.raises(ZeroDivisionError):
        camgen.Motion.from_function(lambda theta: 1 / 0)


def test_a_function_may_jump_at_its_breaks():
    def parabolas(theta):
        """Constant acceleration up and down: its acceleration jumps each quarter."""
        quarter = np.minimum((theta // (math.pi / 2)).astype(int), 3)
        a = 0.008 * np.array([1, -1, -1, 1])[quarter]
        u = theta - quarter * math.pi / 2
        start_v = 0.008 * math.pi / 2 * np.array([0, 1, 0, -1])[quarter]
        half = 0.004 * (math.pi / 2) ** 2
        start_s = half * np.array([0, 1, 2, 1])[quarter]
        return start_s + start_v * u + 0.5 * a * u * u, start_v + a * u, a, 0.0

    breaks = np.arange(1, 4) * math.pi / 2
    with pytest.raises(camgen.OptionError):
        camgen.Motion.from_function(parabolas)

    motion = camgen.Motion.from_function(parabolas, breaks=breaks)
    assert set(breaks) <= set(motion.pieces[:, 0])
    theta = np.array([0.0, 1.0, 2.0, 4.0, 6.0])
    for found, exact in zip(motion(theta), parabolas(theta)):
        np.testing.assert_allclose(found, exact, atol=1e-11)


def test_samples_have_the_spline_of_least_jerk():
    from numpy.linalg import solve

    count = 24
    theta = np.linspace(0, 2 * math.pi, count, endpoint=False)
    lift = harmonic(theta)[0] + 0.0005 * np.sin(3 * theta)
    motion = camgen.Motion.from_samples(theta, lift)
    again = camgen.Motion.from_samples(np.append(theta, 2 * math.pi), np.append(lift, lift[0]))
    places = np.linspace(0, 2 * math.pi, 777, endpoint=False)
    np.testing.assert_array_equal(motion(places), again(places))
    # The periodic quintic spline on equal knots by its B-splines, of other mathematics: a circulant system.
    values = np.array([1, 26, 66, 26, 1]) / 120
    matrix = sum(value * np.roll(np.eye(count), shift, axis=1) for value, shift in zip(values, range(-2, 3)))
    weights = solve(matrix, lift)

    def basis(u):
        u = np.clip(u, -3, 3)
        return sum((-1) ** k * math.comb(6, k) * np.maximum(u + 3 - k, 0) ** 5 for k in range(7)) / 120

    u = places / (2 * math.pi) * count
    spline = sum(weights[j] * (basis(u - j) + basis(u - j - count) + basis(u - j + count)) for j in range(count))
    np.testing.assert_allclose(motion(places)[0], spline - motion_lowest(motion, lift, theta), atol=1e-12)


def motion_lowest(motion, lift, theta):
    """The lowest value of the spline: its lift counts from there."""
    return float(np.mean(lift - motion(theta)[0]))


def test_a_program_in_code_is_that_of_a_file():
    motion = camgen.Motion.program([("cycloidal", "120deg", "15mm"), ("cycloidal", "120deg", 0.0), (None, "120deg", 0.0)])
    of_file = camgen.Machine.from_toml(TOML).motion
    theta = np.linspace(0, 6.28, 500)
    np.testing.assert_allclose(motion(theta), of_file(theta), atol=1e-15)
    law = camgen.law("cycloidal")
    x = np.linspace(0, 1, 50)
    np.testing.assert_allclose(law(x)[0], x - np.sin(2 * math.pi * x) / (2 * math.pi), atol=1e-15)
    assert len(camgen.laws()) > 10 and "3-4-5" in {law.name for law in camgen.laws()}


CASES = Path(__file__).resolve().parents[2] / "tests" / "cases" / "motions.json"


def motion_of(case):
    """A motion of the cases of the file tests, in the way of code."""
    if "segments" in case:
        return camgen.Motion.program([(law, f"{over}deg", f"{to}mm") for law, over, to in case["segments"]])
    rows = case.get("rows")
    if "wrong" in case:
        at, off = case["wrong"]
        rows = [[i, round(8 * (1 - math.cos(math.radians(i))), 4) + (off if i == at else 0)] for i in range(360)]
    theta, lift = np.array(rows, dtype=float).T
    options = {key: case[key] for key in ("shape", "smooth", "degree") if key in case}
    return camgen.Motion.from_samples(np.radians(theta), lift / 1e3, **options)


@pytest.mark.parametrize("case", json.loads(CASES.read_text()), ids=lambda case: case["name"])
def test_a_motion_from_code_is_refused_as_that_of_a_file(case):
    if "check" not in case:
        with pytest.raises(camgen.OptionError) as raised:
            motion_of(case)
        said = str(raised.value).replace("samples", "rows").replace("sample", "row")
        assert case["part"] in said, said
        return
    machine = camgen.Machine.from_toml(
        'name = "case"\n[follower.roller]\nradius = "10 mm"\n[cam]\nbase_radius = "100 mm"\n'
        "[limits]\nmin_convex_pitch_radius_over_roller = 0\n"
    )
    proven = machine.cam(motion=motion_of(case), rpm=100).draw().prove()
    assert not proven.passed
    failed = {finding.check for finding in proven.findings if finding.verdict == "fail"}
    assert case["check"] in failed, failed


def test_correct_samples_have_the_checks_of_rows():
    theta = np.linspace(0, 2 * math.pi, 360, endpoint=False)
    for smooth in (None, "auto", "3um", 3e-6):
        motion = camgen.Motion.from_samples(theta, np.round(harmonic(theta)[0], 6), smooth=smooth)
        proven = camgen.Machine.from_toml(TOML).cam(motion=motion).draw().prove()
        checks = {finding.check: finding.verdict for finding in proven.findings}
        assert checks["outlier"] == "pass" and checks["overshoot"] == "pass", checks


def test_notebooks_show_the_page_and_the_sheet():
    proven = camgen.Machine.load("feeder").cam().draw().prove()
    frame = proven._repr_html_()
    page = html.unescape(re.search(r'srcdoc="([^"]*)"', frame)[1])
    assert page == proven.bytes(".html").decode() and "<script" in page
    assert proven._repr_svg_() == proven.bytes(".svg").decode()
    assert repr(proven) == "<camgen.Proven feeder-make-120rpm, passed>"
    assert "base radius 17 mm" in repr(camgen.Machine.load("feeder").cam())
    analysis = camgen.Machine.load("feeder").analyse("size")
    assert "<iframe" in analysis._repr_html_() and "<svg" in analysis._repr_svg_()


def test_plots():
    pytest.importorskip("matplotlib")
    cam = camgen.Machine.load("feeder").cam()
    assert len(cam.plot().axes) == 4
    from camgen._plot import points_of

    proven = cam.draw().prove()
    line = proven.plot().axes[0].lines[0]
    assert len(line.get_xdata()) > 100
    # Points of the plotted arcs enclose the area of the arcs.
    points = points_of(proven.outline, 200)
    x, y = points[:, 0], points[:, 1]
    polygon = 0.5 * abs(np.sum(x[:-1] * y[1:] - x[1:] * y[:-1]))
    assert polygon == pytest.approx(area_by_green(proven.outline), rel=1e-6)


def volume_by_opencascade(step, tmp_path):
    """Volume of a STEP file, mm³."""
    control = pytest.importorskip("OCP.STEPControl")
    from OCP.BRepGProp import BRepGProp
    from OCP.GProp import GProp_GProps

    path = tmp_path / "cam.step"
    path.write_bytes(step)
    reader = control.STEPControl_Reader()
    reader.ReadFile(str(path))
    reader.TransferRoots()
    properties = GProp_GProps()
    BRepGProp.VolumeProperties_s(reader.OneShape(), properties)
    return properties.Mass()


def test_the_volume_is_that_of_opencascade(tmp_path):
    for name, thickness in (("feeder", 20.0), ("valve", 14.0)):
        proven = camgen.Machine.load(name, {"cam.thickness": f"{thickness}mm"}).cam().draw().prove()
        assert volume_by_opencascade(proven.bytes(".step"), tmp_path) == pytest.approx(proven.area_mm2 * thickness, rel=1e-6)


def test_the_volume_is_that_of_build123d():
    pytest.importorskip("build123d")
    proven = camgen.Machine.load("feeder", {"cam.thickness": "20mm"}).cam().draw().prove()
    solid = proven.to_build123d()
    assert solid.volume == pytest.approx(proven.area_mm2 * 20.0, rel=1e-6)
    top = max(solid.faces(), key=lambda face: face.center().Z)
    assert top.area == pytest.approx(proven.area_mm2, rel=1e-6)


def design(index):
    keys = {"follower.roller.radius": f"{12 + 6 * (index % 97) / 97:.4f}mm", "motion.segment[0].to": f"{20 + index % 10}mm"}
    proven = BASE.with_overrides(keys).cam().draw().prove()
    return proven.passed, len(proven.bytes(".dxf"))


BASE = camgen.Machine.load("feeder")


def resident():
    """Resident memory, MB."""
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 1e6


@pytest.mark.skipif(not os.path.exists("/proc/self/statm"), reason="needs /proc")
def test_memory_does_not_grow():
    alone = [design(index) for index in range(20)]
    with ThreadPoolExecutor(2) as pool:
        list(pool.map(design, range(DESIGNS // 2)))
        before = resident()
        found = list(pool.map(design, range(DESIGNS)))
        grown = resident() - before
    assert found[:20] == alone
    # Less than a kilobyte for each design: fragments of the allocator.
    assert grown < 4 + DESIGNS / 1000, f"{grown:.1f} MB over {DESIGNS} designs"


def test_the_lock_is_released():
    """While a cam is solved, drawn and proved, another thread of Python runs."""
    ticks, done = [0], threading.Event()

    def tick():
        while not done.is_set():
            ticks[0] += 1
            time.sleep(0)

    thread = threading.Thread(target=tick)
    machine = camgen.Machine.load("dpi")
    thread.start()
    before = ticks[0]
    machine.cam("conoid", rpm=[30, 35]).draw("50um", formats=["dxf"]).prove()
    during = ticks[0] - before
    done.set()
    thread.join()
    assert during > 100, during


def test_the_program_is_the_program(tmp_path):
    """The console script: version, exit codes, an interrupted pipe."""
    run = lambda *words: subprocess.run([sys.executable, "-m", "camgen", *words], cwd=tmp_path, capture_output=True, text=True)
    assert run("--version").stdout == f"camgen {camgen.__version__}\n"
    assert run("make", "feeder", "--quiet").returncode == 0
    assert (tmp_path / "output" / "feeder-make-120rpm.dxf").exists()
    assert run("make", "feeder", "--set", "limits.pressure_angle=10deg", "--set", "cam.base_radius=30mm").returncode == 1
    wrong = run("make", "feeder", "--set", "cam.thikness=1mm")
    assert wrong.returncode == 2 and "did you mean" in wrong.stderr
    assert run("mak").returncode == 2
    assert json.loads(run("size", "feeder", "--json", "--dry-run").stdout)["command"] == "size"


def test_types(tmp_path):
    """The stubs are those of the module, and the package is typed throughout."""
    pytest.importorskip("mypy")
    run = lambda *words: subprocess.run([sys.executable, "-m", *words], cwd=tmp_path, capture_output=True, text=True)
    found = run("mypy.stubtest", "camgen", "--ignore-disjoint-bases")
    assert found.returncode == 0, found.stdout + found.stderr
    found = run("mypy", "--strict", "--ignore-missing-imports", "-p", "camgen")
    assert found.returncode == 0, found.stdout + found.stderr
    (tmp_path / "use.py").write_text(
        "import camgen\nmachine = camgen.Machine.load('feeder', {'cam.thickness': '20mm'})\n"
        "lift: float = machine.cam().curves([0.5])['lift_mm'][0]\nmachine.cam(rpm='fast', kind='disc')\n"
    )
    found = run("mypy", "--strict", "use.py")
    assert found.returncode == 1 and "Literal" in found.stdout and "1 error" in found.stdout, found.stdout
