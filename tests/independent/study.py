"""Reads study files by itself and compares their tables with what the command line reports of the same designs, to the last bit.

usage: study.py BINARY DIRECTORY [--count N] [--rows N] [--kills N]

For each of a few studies the values of the keys are computed again from the study file (the combinations of a sweep), or checked against their
distribution (random designs), and `camgen make … --set … --json --dry-run` is run for a sample of rows. The Pareto front is found again by
comparing each design with each, the summary by sorting. A long study is killed by SIGKILL at random moments and continued: its table must
have the bytes of an unbroken run, and the memory of the process must not grow. The long run is --count 60 --rows 1000000 --kills 10.
"""

import argparse
import csv
import itertools
import json
import math
import os
import pathlib
import random
import shutil
import signal
import statistics
import subprocess
import sys
import time
import tomllib

HERE = pathlib.Path(__file__).resolve().parents[2]


def run(binary, arguments, directory, expected=(0, 1)):
    done = subprocess.run([binary, *arguments], cwd=directory, capture_output=True, text=True, check=False)
    if done.returncode not in expected:
        sys.exit(f"camgen {' '.join(arguments)}: exit code {done.returncode}\n{done.stderr}")
    return done


def at(report, path):
    """The figure of a path, a check by its name; None where there is none."""
    parts = path.split(".")
    if parts[0] == "checks":
        value = next((found for found in report["checks"] if found["check"] == parts[1]), None)
        parts = parts[2:]
    else:
        value = report
    for part in parts:
        name, *indices = part.replace("]", "").split("[")
        if not isinstance(value, dict) or name not in value:
            return None
        value = value[name]
        for index in indices:
            value = value[int(index)] if int(index) < len(value) else None
    return value


def values(parameter):
    """The values of a key in a sweep, as texts."""
    if "values" in parameter:
        return [str(value) for value in parameter["values"]]
    number = lambda text: (float(str(text).split()[0]), " ".join(str(text).split()[1:]))
    (low, unit), (high, _) = number(parameter["from"]), number(parameter["to"])
    steps = parameter["steps"]
    if parameter.get("scale") == "log":
        inner = [low * math.exp(i / (steps - 1) * math.log(high / low)) for i in range(1, steps - 1)]
    else:
        inner = [(low * (steps - 1 - i) + high * i) / (steps - 1) for i in range(1, steps - 1)]
    return [f"{value!r} {unit}".strip() for value in [low, *inner, high]]


def compared(binary, directory, text, stem, sample, seed):
    """Compares a sample of the rows of a study with the command line; returns how many."""
    study = tomllib.loads(text)
    (directory / f"{stem}.toml").write_text(text, encoding="utf-8")
    run(binary, ["study", f"{stem}.toml", "--quiet", "--overwrite", "--restart"], directory)
    table = list(csv.reader((directory / "output" / f"{stem}.csv").open(newline="", encoding="utf-8")))
    head, rows = table[0], table[1:]
    keys = [parameter["key"] for parameter in study["parameter"]]
    figures = [name for name in head[1 + len(keys) :] if name not in ("feasible", "fault")]
    if study["kind"] == "sweep":
        combinations = list(itertools.product(*map(values, study["parameter"])))
        assert len(combinations) == len(rows), f"{stem}: {len(rows)} rows, {len(combinations)} combinations"
    for number, row in enumerate(rows):
        assert row[0] == str(number) and len(row) == len(head), f"{stem}: row {number} is {row}"
    compared_rows = 0
    for number in sorted(random.Random(seed).sample(range(len(rows)), min(sample, len(rows)))):
        row = dict(zip(head, rows[number]))
        words = [study.get("command", "make"), study["base"], "--json", "--dry-run"]
        for fixed in study.get("set", []):
            words += ["--set", fixed]
        for place, key in enumerate(keys):
            name, cell = head[1 + place], rows[number][1 + place]
            unit = name.removeprefix(f"set.{key}").removeprefix("_")
            if study["kind"] == "sweep":
                typed = combinations[number][place]
                own = typed.split()[0] if unit else typed
                # Exponentials of two libraries may differ in the last bit.
                same = own == cell or math.isclose(float(own), float(cell), rel_tol=1e-15)
                assert same, f"{stem} row {number}: {key} is {cell}, not {typed}"
            words += ["--rpm", cell] if key == "rpm" else ["--set", f"{key}={cell} {unit}".strip()]
        done = run(binary, words, directory, expected=(0, 1, 2))
        if done.returncode == 2:
            assert row["fault"] and not any(row[name] for name in figures), f"{stem} row {number}: a design without a cam has figures: {row}"
            continue
        report = json.loads(done.stdout)
        report["passed"] = done.returncode == 0
        for name in figures:
            value = at(report, name)
            cell = row[name]
            if value is None or isinstance(value, bool):
                same = cell == ("" if value is None else str(value).lower())
            else:
                same = cell == value if isinstance(value, str) else cell != "" and float(cell) == float(value)
            assert same, f"{stem} row {number}: {name} is {cell!r}, and the command line reports {value!r}\n{' '.join(words)}"
        kept = all(
            row[limit["column"]] != "" and limit.get("at_least", -math.inf) <= float(row[limit["column"]]) <= limit.get("at_most", math.inf)
            for limit in study.get("constraint", []))
        assert "feasible" not in row or row["feasible"] == str(kept).lower(), f"{stem} row {number}: feasible is {row['feasible']}"
        compared_rows += 1
    summary(directory, stem, head, rows)
    if study["kind"] == "pareto":
        front(directory, stem, study, head, rows)
    return compared_rows


def summary(directory, stem, head, rows):
    """The distribution of each column, by sorting."""
    told = json.loads((directory / "output" / f"{stem}.json").read_text(encoding="utf-8"))
    for name, of in told["columns"].items():
        numbers = sorted(float(row[head.index(name)]) for row in rows if row[head.index(name)] not in ("", "true", "false"))
        size = max(abs(numbers[0]), abs(numbers[-1]), 1e-300)
        assert of["count"] == len(numbers) and of["least"] == numbers[0] and of["largest"] == numbers[-1], f"{stem}: {name}"
        assert abs(of["mean"] - statistics.fmean(numbers)) <= 1e-12 * size, f"{stem}: mean of {name}"
        if len(numbers) > 1:
            assert abs(of["deviation"] - statistics.stdev(numbers)) <= 1e-9 * size, f"{stem}: deviation of {name}"
        for share, value in of["quantiles"].items():
            # At most that share lies a cell below the quantile, and at least it a cell above.
            cell = (numbers[-1] - numbers[0]) / 4096 * 1.01
            below = sum(number < value - cell for number in numbers) / len(numbers)
            upto = sum(number <= value + cell for number in numbers) / len(numbers)
            assert below <= float(share) + 1e-9 and upto >= float(share) - 1e-9, f"{stem}: quantile {share} of {name}"


def front(directory, stem, study, head, rows):
    """The front by comparing each design with each."""
    sign = [1 if objective.get("goal", "least") == "least" else -1 for objective in study["objective"]]
    places = [head.index(objective["column"]) for objective in study["objective"]]
    kept = [row for row in rows if ("feasible" not in head or row[head.index("feasible")] == "true") and all(row[place] for place in places)]
    points = [[s * float(row[place]) for s, place in zip(sign, places)] for row in kept]
    beats = lambda a, b: a != b and all(x <= y for x, y in zip(a, b))
    best = [row for row, own in zip(kept, points) if not any(beats(other, own) for other in points)]
    told = list(csv.reader((directory / "output" / f"{stem}-front.csv").open(newline="", encoding="utf-8")))
    assert told[1:] == best, f"{stem}: the front has {len(told) - 1} designs, by brute force {len(best)}"


def memory(pid):
    """Largest resident size of a process so far, MiB; None where it has ended."""
    try:
        lines = pathlib.Path(f"/proc/{pid}/status").read_text(encoding="utf-8").splitlines()
    except OSError:
        return None
    return next((int(line.split()[1]) / 1024 for line in lines if line.startswith("VmHWM")), None)


def killed(binary, directory, rows, kills, seed):
    """A study that is killed at random moments and continued, against an unbroken one; returns a line of figures."""
    text = f"""
name = "killed"
base = "feeder"
kind = "monte-carlo"
rows = {rows}
set = ["cam.base_radius=60mm"]
columns = ["cam.prime_radius_mm", "checks.pressure_angle.value"]
[[parameter]]
key = "follower.roller.radius"
from = "-1 mm"
to = "20 mm"
[[parameter]]
key = "follower.roller.mass"
mean = "2.5 kg"
deviation = "0.1 kg"
"""
    (directory / "killed.toml").write_text(text, encoding="utf-8")
    command = [binary, "study", "killed.toml", "--quiet"]
    began, size = time.monotonic(), 0.0
    process = subprocess.Popen([*command, "--name", "whole"], cwd=directory)
    while process.poll() is None:
        size = max(size, memory(process.pid) or 0.0)
        time.sleep(0.005)
    seconds = time.monotonic() - began
    assert process.returncode == 0
    # Rows are written as they come: a million of them take no more memory than a thousand, about 18 MiB.
    assert 4 < size < 40, f"{rows} rows took {size:.1f} MiB"
    chance = random.Random(seed)
    done = 0
    for _ in range(kills):
        process = subprocess.Popen([*command, "--name", "broken"], cwd=directory)
        try:
            process.wait(chance.uniform(0.1, 1.0) * seconds / (kills + 1))
            break
        except subprocess.TimeoutExpired:
            os.kill(process.pid, signal.SIGKILL)
            process.wait()
            done += 1
            assert not (directory / "output" / "broken.csv").exists()
    run(binary, command[1:] + ["--name", "broken"], directory)
    for ending in (".csv", ".json"):
        whole, broken = ((directory / "output" / f"{name}{ending}").read_bytes() for name in ("whole", "broken"))
        assert whole == broken, f"after {done} kills {ending} differs"
    written = (directory / "output" / "whole.csv").stat().st_size
    return f"{rows} rows in {seconds:.1f} s, {written / rows:.1f} bytes a row, {size:.1f} MiB of memory, killed {done} times: the same bytes"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("binary")
    parser.add_argument("directory")
    parser.add_argument("--count", type=int, default=4, help="rows of each study that are compared")
    parser.add_argument("--rows", type=int, default=8000, help="rows of the study that is killed")
    parser.add_argument("--kills", type=int, default=3)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    binary = str(pathlib.Path(arguments.binary).resolve())
    directory = pathlib.Path(arguments.directory).resolve() / "study"
    shutil.rmtree(directory, ignore_errors=True)
    directory.mkdir(parents=True)
    texts = {path.stem: path.read_text(encoding="utf-8") for path in sorted((HERE / "profiles" / "studies").glob("*.toml"))}
    texts["press"] = """
name = "press"
base = "dpi"
kind = "sweep"
command = "rotary"
columns = ["cam.base_radius_mm", "force.inertia_max_n", "checks.pressure_angle.value", "checks.residual.value"]
[[parameter]]
key = "rpm"
values = [30, 35, 40]
[[parameter]]
key = "follower.roller.radius"
from = "25 mm"
to = "35 mm"
steps = 3
"""
    texts["words"] = """
name = "words"
base = "feeder"
kind = "sweep"
columns = ["passed", "outline.arcs", "cam.area_mm2", "dynamics.torque_max_nm", "checks.contact_stress.verdict"]
[[parameter]]
key = "motion.segment[0].law"
values = ["cycloidal", "3-4-5", "modified-sine"]
[[parameter]]
key = "cam.bore_radius"
from = "8 mm"
to = "16 mm"
steps = 3
scale = "log"
"""
    rows = sum(compared(binary, directory, text, stem, arguments.count, arguments.seed) for stem, text in texts.items())
    print(f"study: {rows} rows of {len(texts)} studies have the figures of the command line to the last bit")
    print("study: " + killed(binary, directory, arguments.rows, arguments.kills, arguments.seed))


if __name__ == "__main__":
    main()
