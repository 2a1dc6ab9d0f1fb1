"""Lift tables with one wrong row, and correct ones, by laws that share nothing with camgen.

Half of the tables have one row that is off by 50 um or more: `make` must exit 1 because of `outlier` and name that row and its line. The others are
correct, however they are rounded, scattered, sampled unevenly or by however few rows, and whatever law they follow: nothing may be flagged.
Wrong rows are chosen to be detectable: in tables of 90 to 720 rows, with errors of at least four times the bend of the neighbouring rows.

usage: outliers.py CAMGEN_BINARY DIRECTORY [--count N] [--seed N] [--only N]
The long run: --count 400, 200 of each.
"""
import argparse
import json
import math
import random
import subprocess
import sys
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

TAU = 2 * math.pi


def modified_sine(x):
    k = 1 / (4 + math.pi)
    if x < 1 / 8:
        return k * (math.pi * x - math.sin(4 * math.pi * x) / 4)
    if x < 7 / 8:
        return k * (2 + math.pi * x - 9 / 4 * math.sin((4 * math.pi * x + math.pi) / 3))
    return k * (4 + math.pi * x - math.sin(4 * math.pi * x) / 4)


SMOOTH = {
    "3-4-5": lambda x: x ** 3 * (10 - 15 * x + 6 * x * x),
    "4-5-6-7": lambda x: x ** 4 * (35 - 84 * x + 70 * x * x - 20 * x ** 3),
    "cycloidal": lambda x: x - math.sin(TAU * x) / TAU,
    "modified sine": modified_sine,
}
# Laws with an acceleration step; the last two have a velocity step.
OTHERS = {
    "parabola": lambda x: 2 * x * x if x < 0.5 else 1 - 2 * (1 - x) ** 2,
    "harmonic": lambda x: (1 - math.cos(math.pi * x)) / 2,
    "line": lambda x: x,
    "half harmonic": lambda x: math.sin(math.pi * x / 2),
}


class Lobe:
    def __init__(self, rng, laws):
        self.lift, self.start = rng.uniform(2, 15), rng.uniform(0, 360)
        self.rise, self.fall = rng.uniform(60, 120), rng.uniform(60, 120)
        self.top = rng.choice([0, rng.uniform(5, 60)])
        self.laws = [rng.choice(list(laws.values())) for _ in range(2)]

    def at(self, degree):
        x = (degree - self.start) % 360
        if x < self.rise:
            return self.lift * self.laws[0](x / self.rise)
        if x <= self.rise + self.top:
            return self.lift
        if x < self.rise + self.top + self.fall:
            return self.lift * self.laws[1](1 - (x - self.rise - self.top) / self.fall)
        return 0.0


class Case:
    def __init__(self, rng, wrong):
        self.wrong = None
        lobe = Lobe(rng, SMOOTH if wrong else {**SMOOTH, **OTHERS})
        count = rng.choice([90, 120, 180, 360, 720] if wrong else [12, 18, 24, 36, 48, 60, 72, 90, 120, 180, 360, 720])
        degrees = [360 * i / count for i in range(count)]
        if not wrong and rng.random() < 0.3:
            degrees = sorted(360 * (i + rng.uniform(-0.4, 0.4)) / count % 360 for i in range(count))
        decimals = rng.choice([3, 4, 6] if wrong else [2, 3, 4, 6, 12])
        scatter = 0.0 if wrong else rng.choice([0, 0, 0.001, 0.005, 0.02])
        values = [lobe.at(degree) + rng.gauss(0, scatter) for degree in degrees]
        self.head = rng.choice([[], ["deg;mm"], ["# measured", "", "deg;mm"]])
        if wrong:
            self.wrong = self.spoil(rng, values)
        self.smooth = "auto" if rng.random() < 0.2 else None
        self.rows = [f"{degree:.6f};{value:.{decimals}f}" for degree, value in zip(degrees, values)]

    @staticmethod
    def spoil(rng, values):
        """Makes a row wrong by more than the bend of its neighbours, the fourth difference around it; returns its index."""
        count = len(values)
        for _ in range(1000):
            at = rng.randrange(count)
            weights = [1, -4, 6, -4, 1]
            bend = max(abs(sum(w * values[(at + by + k - 2) % count] for k, w in enumerate(weights))) for by in range(-4, 5))
            off = rng.choice([-1, 1]) * rng.choice([0.05, 0.1, 0.5])
            if abs(off) > 4 * bend / 6 + 0.02:
                values[at] += off
                return at
        return None

    def text(self):
        return "\n".join(self.head + self.rows) + "\n"


def judged(binary, directory, seed, index):
    rng = random.Random(f"{seed} {index}")
    case = Case(rng, index % 2 == 0)
    folder = directory / f"outliers-{index}"
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "lift.csv").write_text(case.text())
    smooth = f'smooth = "{case.smooth}"\n' if case.smooth else ""
    (folder / "cam.toml").write_text(
        f'name = "o"\n[motion]\nstart = "0 mm"\ntable = "lift.csv"\n{smooth}[follower.roller]\nradius = "5 mm"\n'
        '[cam]\nbase_radius = "200 mm"\n[limits]\npressure_angle = "89 deg"\ncontinuity = 0\novershoot = "1000 %"\n'
        "min_convex_pitch_radius_over_roller = 0\n")
    run = subprocess.run([binary, "make", "cam.toml", "--json", "--dry-run"], cwd=folder, capture_output=True, text=True, timeout=120)
    if not run.stdout.startswith("{"):
        # A cam without an outline has no report.
        return "no outline", None if case.wrong is None else f"{index}: {run.stderr[:200]}"
    found = [check for check in json.loads(run.stdout)["checks"] if check["check"] == "outlier" and check["verdict"] == "fail"]
    if case.wrong is None:
        return "correct", f"{index}: a correct row is flagged: {found[0]['note']}" if found else None
    if not found or run.returncode != 1:
        return "wrong", f"{index}: row {case.wrong + 1} of {len(case.rows)} is not flagged, exit {run.returncode}"
    wanted = f"row {case.wrong + 1} (line {case.wrong + 1 + len(case.head)} of the file)"
    return "wrong", None if wanted in found[0]["note"] else f"{index}: {wanted} is wanted: {found[0]['note']}"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("binary")
    parser.add_argument("directory")
    parser.add_argument("--count", type=int, default=40)
    parser.add_argument("--seed", default="outliers")
    parser.add_argument("--only", type=int)
    given = parser.parse_args()
    binary, directory = str(Path(given.binary).resolve()), Path(given.directory)
    indices = range(given.count) if given.only is None else [given.only]
    tally, failures = Counter(), 0
    with ThreadPoolExecutor(2) as pool:
        for kind, fault in pool.map(lambda index: judged(binary, directory, given.seed, index), indices):
            tally[kind] += 1
            if fault:
                failures += 1
                print(fault)
    print(", ".join(f"{count} {kind}" for kind, count in sorted(tally.items())) + f", {failures} failures")
    sys.exit(failures > 0)


main()
