"""What camgen's job costs with the usual Python libraries, side by side with camgen, at equal true accuracy.

Peers: numpy and scipy (law, differential equation), and the whole way to DXF, STEP and CSV in pipeline.py. True
errors are distances of points all over the written outline from the exact profile, never what a program says of itself.
The command line cannot time camgen's law and its solver of (18) alone: those figures are read
from a criterion directory when given.

usage: peers.py CAMGEN_BINARY [CRITERION_DIRECTORY]
"""
import csv
import importlib
import json
import math
import os
import platform
import statistics
import subprocess
import sys
import tempfile
import time
from decimal import Decimal, getcontext
from pathlib import Path

PACKAGES = ("numpy", "scipy.integrate", "shapely", "ezdxf", "OCP.STEPControl")
PLATE_END, START_SLOPE = -49.214115163350484, -0.02650577
PEER_RUNS, CAMGEN_RUNS, MEMORY_RUNS, CALL_RUNS = 7, 21, 3, 15
GNU_TIME = "/usr/bin/time"
ROWS = 72_000


def require():
    """Every package is loaded before anything is measured: a missing one is an error, not a gap in the table."""
    missing = [] if os.access(GNU_TIME, os.X_OK) else [f"{GNU_TIME} (GNU time, for the peak memory)"]
    for name in PACKAGES:
        try:
            importlib.import_module(name)
        except ImportError as error:
            missing.append(f"{name} ({error})")
    if missing:
        sys.exit("peers.py cannot run, missing: " + ", ".join(missing) + "; pip install -r requirements.txt")


require()
import numpy as np  # noqa: E402
from pipeline import A, BORE, CRANK, K, L, ROLLER, WIDTH, curvature, law, pitch, write_table  # noqa: E402


# --- true errors, times, memory ------------------------------------------------------------------------------------


def true_error(points):
    """Largest distance from the exact profile: of the roller's centre line, by Newton on its foot, less the radius."""
    from scipy.spatial import cKDTree

    grid = np.linspace(0, 2 * math.pi, 3601)
    centres = pitch(grid)[0]
    theta = grid[cKDTree(np.c_[centres.real, centres.imag]).query(np.c_[points.real, points.imag])[1]]
    for _ in range(8):
        centre, first, second = pitch(theta)
        away = points - centre
        theta = theta - (away * first.conj()).real / ((away * second.conj()).real - np.abs(first) ** 2)
    return np.abs(np.abs(points - pitch(theta)[0]) - ROLLER).max()


def dxf_facts(path):
    """Segments of the outline as ezdxf reads them, and 40 points on each, arcs by their bulge."""
    import ezdxf

    entity = ezdxf.readfile(path).modelspace().query("LWPOLYLINE[layer=='CAM_PROFILE']").first
    x, y, bulge = np.array(entity.get_points("xyb")).T
    nodes, part = x + 1j * y, np.arange(40) / 40
    chord, half = (np.roll(nodes, -1) - nodes)[:, None], 2 * np.arctan(bulge)[:, None]
    # sin(f·half)/sin(half) along the chord, turned by what the arc's heading has yet to turn; the limit is the chord.
    straight = np.abs(half) < 1e-12
    safe = np.where(straight, 1.0, half)
    along = np.where(straight, part, np.sin(part * safe) / np.sin(safe) * np.exp(1j * (part - 1) * safe))
    return len(nodes), true_error((nodes[:, None] + chord * along).ravel())


def step_error(path):
    """The outline's edges at the bottom of the solid as OpenCASCADE reads them."""
    from OCP.BRepAdaptor import BRepAdaptor_Curve
    from OCP.STEPControl import STEPControl_Reader
    from OCP.TopAbs import TopAbs_EDGE
    from OCP.TopExp import TopExp_Explorer
    from OCP.TopoDS import TopoDS

    reader = STEPControl_Reader()
    reader.ReadFile(str(path))
    reader.TransferRoots()
    explorer, points = TopExp_Explorer(reader.OneShape(), TopAbs_EDGE), []
    while explorer.More():
        curve = BRepAdaptor_Curve(TopoDS.Edge_s(explorer.Current()))
        low, high, count = curve.FirstParameter(), curve.LastParameter(), 40
        count = 40 * curve.NbKnots() if curve.GetType().name == "GeomAbs_BSplineCurve" else count
        places = [curve.Value(t) for t in np.linspace(low, high, count)]
        if all(abs(p.Z()) < 1e-6 and math.hypot(p.X(), p.Y()) > BORE + 1 for p in places):
            points += [complex(p.X(), p.Y()) for p in places]
        explorer.Next()
    return true_error(np.array(points))


def run(command, runs):
    """Medians of wall time in ms, of peak memory in MiB, and the printed output of every run."""
    walls, peaks, printed = [], [], []
    # What others left to write would be waited for when camgen and the peers sync their files.
    os.sync()
    for _ in range(runs + 1):
        start = time.perf_counter()
        output = subprocess.run(command, capture_output=True, text=True, check=True).stdout
        walls.append((time.perf_counter() - start) * 1e3)
        printed.append(output)
    for _ in range(MEMORY_RUNS):
        # A child's RUSAGE counts its parent's memory up to exec: the parent must be as small as GNU time.
        measured = subprocess.run([GNU_TIME, "-f", "%M", *command], capture_output=True, text=True, check=True)
        peaks.append(int(measured.stderr.split()[-1]) / 1024)
    # The first run fills the caches of the disk.
    return statistics.median(walls[1:]), statistics.median(peaks), printed[1:]


def median_call(function, runs=CALL_RUNS):
    times = []
    for _ in range(runs):
        start = time.perf_counter()
        result = function()
        times.append((time.perf_counter() - start) * 1e6)
    return statistics.median(times), result


def plate_slope(x, y):
    """dΔx/dx of equation (18), printed model, η = 0.95, ρ = 3°, Δ = 90°, arms 300 mm (theory §4)."""
    if x == 0:
        return START_SLOPE
    psi = math.asin(y / 300)
    theta = math.pi / 2 + psi
    k = 0.95 / math.cos(psi) * (A * x / math.expm1(-K * math.log1p(-(x + y) / L)) - 1)
    alpha = math.atan2(k * math.sin(theta), 1 + k * math.cos(theta)) - math.radians(3)
    return math.cos(psi) * math.sin(alpha) / math.sin(theta - alpha)


def plate(method, within):
    """Loosest tolerance that meets the error: time in µs and true error in mm."""
    from scipy.integrate import solve_ivp

    tried = []
    for digits in np.arange(3, 13.5, 0.5):
        solve = lambda: solve_ivp(lambda x, y: [plate_slope(x, y[0])], (0, CRANK), [0.0], method, rtol=10.0**-digits,
                                  atol=100 * 10.0**-digits, t_eval=[CRANK])
        took, solution = median_call(solve)
        tried.append((abs(solution.y[0, -1] - PLATE_END), took))
        if tried[-1][0] <= within:
            return tried[-1][::-1]
    return min(tried)[::-1]


def exact_law(x):
    """(10) to 50 digits."""
    getcontext().prec = 50
    x, k = Decimal(float(x)), Decimal("1.35")
    return 180 * k * (1 - (x / 180 + 1) ** (-1 / k)) - x


def law_error(xs, values):
    return max(float(abs(Decimal(float(v)) / exact_law(x) - 1)) for x, v in zip(xs, values))


def balance_root(x):
    """Δx by a root of the balance (9), per point."""
    from scipy.optimize import brentq

    return brentq(lambda y: A * x - ((L / (L - x - y)) ** K - 1), -CRANK, 20.0, xtol=1e-13, rtol=1e-15)


# --- the table -----------------------------------------------------------------------------------------------------


def criterion_us(directory, name):
    """Median of an earlier `cargo bench`; None, shown as a dash and said below the table, when there is none."""
    path = Path(directory or "", name, "new", "estimates.json")
    return json.loads(path.read_text())["median"]["point_estimate"] / 1e3 if directory and path.exists() else None


def law_rows(camgen, directory, criterion):
    command = [camgen, "rotary", "--rpm", "35", "--quiet", "--force", "--format", "csv", "--out", directory]
    few = run(command, CAMGEN_RUNS)[0]
    many = run([*command, "--samples", str(ROWS)], PEER_RUNS)[0]
    their_row = median_call(lambda: write_table(directory / "peer.csv", ROWS), 3)[0] / ROWS
    with open(directory / "dpi-rotary-35rpm.csv", newline="") as file:
        table = np.array([(float(row["x_mm"]), float(row["dx_mm"])) for row in csv.DictReader(file)][: ROWS // 4 + 1])
    # The smallest x, where (10) cancels, and the whole stroke.
    x, dx = table[np.unique(np.concatenate([np.arange(1, 101), np.arange(100, len(table), 100)]))].T
    points = np.linspace(0.01, CRANK, 100_000)
    vector = median_call(lambda: law(points))[0] * 1e3 / len(points)
    roots, found = median_call(lambda: [balance_root(value) for value in x])
    ours, bench = law_error(x, dx), criterion_us(criterion, "law_displacement")
    bench = bench and bench * 1e3
    blank = None, None
    return [
        ("law: time a point, ns", "numpy (10)", *blank, (vector, bench)),
        ("law: largest relative error", "numpy (10)", *blank, (law_error(x, law(x)), ours)),
        ("law: time a point, ns", "scipy brentq on (9)", *blank, (roots * 1e3 / len(x), bench)),
        ("law: largest relative error", "scipy brentq on (9)", *blank, (law_error(x, found), ours)),
        ("table: a row of CSV (10 columns; camgen 18), µs", "numpy savetxt", *blank,
         (their_row, (many - few) * 1e3 / (ROWS - 720))),
    ]


def plate_rows(camgen, directory, criterion):
    command = [camgen, "translating", "--set", "translating.efficiency_model=printed", "--quiet", "--format", "csv"]
    subprocess.run([*command, "--name", "plate", "--out", directory], check=True)
    with open(directory / "plate.csv", newline="") as file:
        ours = abs(float(list(csv.DictReader(file))[-1]["dx_mm"]) - PLATE_END)
    bench = [criterion_us(criterion, f"(18) matched_ode to {accuracy} mm") for accuracy in ("1e-3", "1e-3", "1e-9")]
    rows = []
    for method in ("LSODA", "DOP853"):
        solved = [plate(method, within) for within in (5e-3, 1e-3, 1e-9)]
        rows.append(("(18): time to solve, µs", f"scipy {method}", *[(s[0], b) for s, b in zip(solved, bench)]))
        errors = [(s[1] * 1e3, o) for s, o in zip(solved, (None, None, ours * 1e3))]
        rows.append(("(18): true error at x = 180 mm, µm", f"scipy {method}", *errors))
    return rows


def occ_arcs(tolerance):
    """OpenCASCADE's arc converter on each smooth piece of the exact profile: time in µs, the arcs' points, largest kink.

    It takes a spline, here one through 400 points a piece (4e-8 mm off). Of its angle tolerances 0.1 rad gives the fewest
    arcs.
    """
    from OCP.Geom2dAdaptor import Geom2dAdaptor_Curve
    from OCP.Geom2dAPI import Geom2dAPI_Interpolate
    from OCP.Geom2dConvert import Geom2dConvert_ApproxArcsSegments
    from OCP.gp import gp_Pnt2d, gp_Vec2d
    from OCP.TColgp import TColgp_HArray1OfPnt2d
    from OCP.TColStd import TColStd_HArray1OfReal

    took, arcs, worst_kink = 0.0, [], 0.0
    for start, end in ((-WIDTH, 0), (0, math.pi), (math.pi, math.pi + WIDTH)):
        theta = np.linspace(start, end, 400)
        centre, first, second = pitch(theta)
        array, places = TColgp_HArray1OfPnt2d(1, 400), TColStd_HArray1OfReal(1, 400)
        for index, point in enumerate(centre + 1j * ROLLER * first / np.abs(first)):
            array.SetValue(index + 1, gp_Pnt2d(point.real, point.imag))
            places.SetValue(index + 1, theta[index])
        velocity = first * (1 - ROLLER * curvature(first, second))
        spline = Geom2dAPI_Interpolate(array, places, False, 1e-9)
        spline.Load(*(gp_Vec2d(v.real, v.imag) for v in velocity[[0, -1]]), False)
        spline.Perform()
        adaptor = Geom2dAdaptor_Curve(spline.Curve())
        time_of_piece, found = median_call(lambda: Geom2dConvert_ApproxArcsSegments(adaptor, tolerance, 0.1).GetResult())
        took += time_of_piece
        heading, last = None, None
        for index in range(1, found.Length() + 1):
            arc = Geom2dAdaptor_Curve(found.Value(index))
            places = np.linspace(arc.FirstParameter(), arc.LastParameter(), 40)
            points = np.array([complex(p.X(), p.Y()) for p in map(arc.Value, places)])
            tangents = []
            for place in (places[0], places[-1]):
                point, tangent = gp_Pnt2d(), gp_Vec2d()
                arc.D1(place, point, tangent)
                tangents.append(complex(tangent.X(), tangent.Y()))
            if last is not None and abs(points[0] - last) > abs(points[-1] - last):
                points, tangents = points[::-1], [-tangents[1], -tangents[0]]
            if heading is not None:
                worst_kink = max(worst_kink, abs(np.angle(tangents[0] / heading, deg=True)))
            heading, last = tangents[1], points[-1]
            arcs.append(points)
    # The dwell is an arc of its own.
    return took, len(arcs) + 1, true_error(np.concatenate(arcs)), worst_kink


def outline_rows(camgen, directory, criterion):
    """The outline as arcs: OpenCASCADE's converter, and the Rust peers as `cargo bench --bench peers` left them."""
    ours, theirs, kinks = [], [], []
    for micrometres in (5, 1):
        command = [camgen, "rotary", "--rpm", "35", "--tolerance", f"{micrometres}um", "--quiet", "--format", "dxf,json"]
        subprocess.run([*command, "--out", directory], check=True)
        count, error = dxf_facts(directory / "dpi-rotary-35rpm.dxf")
        checks = json.loads((directory / "dpi-rotary-35rpm.json").read_text())["checks"]
        kinks.append(next(check["value"] for check in checks if check["check"] == "tangency"))
        time_of = lambda what: criterion_us(criterion, f"peers_{micrometres} µm_{what}")
        ours.append((time_of("camgen_ exact offset and its arcs"), count, error))
        given = time_of("cavalier_contours_ offset of given arcs")
        theirs.append((occ_arcs(micrometres / 1000), given, time_of("kurbo_ cubics and offset")))
    peer, blank = "OpenCASCADE ApproxArcsSegments", None
    rows = [
        ("outline: arcs", peer, *[(t[0][1], o[1]) for t, o in zip(theirs, ours)], blank),
        ("outline: true error, µm", peer, *[(t[0][2] * 1e3, o[2] * 1e3) for t, o in zip(theirs, ours)], blank),
        ("outline: largest kink, deg", peer, *[(t[0][3], kink) for t, kink in zip(theirs, kinks)], blank),
        ("outline: time, µs; camgen's with the offset", peer, *[(t[0][0], o[0]) for t, o in zip(theirs, ours)], blank),
        ("offset of given arcs, µs; camgen: offset and arcs", "cavalier_contours", *[(t[1], o[0]) for t, o in zip(theirs, ours)], blank),
        ("offset as cubics, µs; camgen: as arcs", "kurbo", *[(t[2], o[0]) for t, o in zip(theirs, ours)], blank),
    ]
    bench = lambda many, what: criterion_us(criterion, f"peers_{many} points_{what}")
    for many in (3600, 36_000):
        exact = bench(many, "camgen_ offset of given pitch points")
        centre = pitch(np.linspace(0, 2 * math.pi, many, endpoint=False))[0]
        plain = median_call(lambda: plain_normals(centre))[0]
        buffered = median_call(lambda: buffer(centre))[0]
        chords = bench(many, "cavalier_contours_ offset of given chords")
        for who, took in (("numpy, normals by differences", plain), ("shapely buffer", buffered), ("cavalier_contours, chords", chords)):
            rows.append((f"offset of {many} given pitch points, µs", who, blank, blank, (took, exact)))
    return rows


def plain_normals(points):
    along = np.roll(points, -1) - np.roll(points, 1)
    return points + 1j * ROLLER * along / np.abs(along)


def buffer(points):
    from shapely.geometry import Polygon

    return Polygon(np.c_[points.real, points.imag]).buffer(-ROLLER, quad_segs=64)


def measure(command, runs, directory, stem):
    wall, peak, printed = run(command, runs)
    (segments, dxf), step = dxf_facts(directory / f"{stem}.dxf"), step_error(directory / f"{stem}.step")
    size = lambda kind: (directory / f"{stem}.{kind}").stat().st_size
    return {"wall": wall, "peak MiB": peak, "printed": printed, "segments": segments, "DXF bytes": size("dxf"),
            "DXF true error, µm": dxf * 1e3, "STEP bytes": size("step"), "STEP true error, µm": step * 1e3}


def part_rows(camgen, directory):
    """The whole process of every peer against the whole command of camgen."""
    ways = {"normals": "normals, chords", "shapely": "shapely, chords", "spline": "normals; spline STEP"}
    columns = {way: [] for way in ways}
    for micrometres in (5, 1):
        command = [camgen, "rotary", "--rpm", "35", "--tolerance", f"{micrometres}um", "--quiet", "--out", directory]
        ours = measure(command, CAMGEN_RUNS, directory, "dpi-rotary-35rpm")
        alike = run([*command, "--format", "dxf,step,csv"], CAMGEN_RUNS)[0]
        for way in ways:
            out = directory / f"{way}-{micrometres}"
            out.mkdir()
            script = Path(__file__).with_name("pipeline.py")
            peer = measure([sys.executable, script, way, str(micrometres / 1000), out], PEER_RUNS, out, "cam")
            stages = [json.loads(text.splitlines()[-1]) for text in peer["printed"]]
            work = statistics.median(sum(s.values()) - s["imports"] for s in stages)
            cells = {"wall, ms": (peer["wall"], ours["wall"]),
                     "wall, camgen without SVG, ms": (peer["wall"], alike),
                     "work after start and imports, ms; camgen whole": (work, ours["wall"])}
            facts = {key: (peer[key], ours[key]) for key in ours if key not in ("wall", "printed")}
            columns[way].append(cells | facts)
            for kind in ("DXF", "STEP"):
                assert peer[f"{kind} true error, µm"] <= micrometres, f"{way}: {kind} misses {micrometres} µm"
    return [(f"cam: {key}", title, *[group[key] for group in columns[way]], None)
            for way, title in ways.items() for key in columns[way][0]]


def cell(value):
    if value is None:
        return "–"
    return f"{value:.3g}" if abs(value) < 100 else f"{value:,.0f}".replace(",", " ")


def show(rows):
    groups = [f"{accuracy}: peer | camgen | peer/camgen" for accuracy in ("5 µm", "1 µm", "finest")]
    print("| what | peer | " + " | ".join(groups) + " |")
    print("|---|---|" + "--:|" * 9)
    for what, peer, *groups in rows:
        cells = []
        for pair in groups:
            theirs, ours = pair or (None, None)
            cells += [cell(theirs), cell(ours), cell(theirs / ours if theirs is not None and ours else None)]
        print(f"| {what} | {peer} | " + " | ".join(cells) + " |")


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    camgen, criterion = str(Path(sys.argv[1]).resolve()), sys.argv[2] if len(sys.argv) == 3 else None
    with tempfile.TemporaryDirectory() as name:
        directory = Path(name)
        rows = [*law_rows(camgen, directory, criterion), *plate_rows(camgen, directory, criterion)]
        rows += outline_rows(camgen, directory, criterion) + part_rows(camgen, directory)
    show(rows)
    version = subprocess.run([camgen, "--version"], capture_output=True, text=True, check=True).stdout.strip()
    source = f"medians of an earlier `cargo bench`, {criterion}" if criterion else "no criterion directory, so dashes"
    print(f"""
{version}, Python {platform.python_version()}, {os.cpu_count()} cores. Times and peaks are medians, sizes and errors of the last run:
- whole processes: {PEER_RUNS} runs of a peer, {CAMGEN_RUNS} of camgen, after one to warm the caches;
  peak memory: {MEMORY_RUNS} runs by GNU time;
- calls within Python: {CALL_RUNS} runs; a row of CSV: camgen {CAMGEN_RUNS} runs of 720 and {PEER_RUNS} of {ROWS}, numpy 3 of {ROWS};
- camgen's time for law and (18): {source}; a dash: no such figure.
  (18) there is `matched` with the default efficiency model, to 1 µm, 1 µm and 1 pm;
- (18), peers: the loosest tolerance with a true error within 5 µm, 1 µm, 1 pm; camgen's error: its CSV, printed model.
Finest: the law in full double precision, (18) to 1 pm. camgen also finds the base radius, rolls the roller on the file
it wrote, checks, and draws the SVG; the peers do none of that. Both sync their files to disk.""")


main()
