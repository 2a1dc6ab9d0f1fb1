"""Reads study files by itself and compares their tables with what the command line reports of the same designs, to the last bit.

usage: study.py BINARY DIRECTORY [--count N] [--rows N] [--kills N] [--each N]

For each of a few studies the values of the keys are computed again from the study file (the combinations of a sweep), or checked against their
distribution (random designs), and `camgen make … --set … --json --dry-run` is run for a sample of rows. The Pareto front is found again by
comparing each design with each, the summary by sorting. A long study is killed by SIGKILL at random moments and continued: its table must
have the bytes of an unbroken run, and the memory of the process must not grow. Short studies are killed at random moments and at the calls of the
system with which they write, and the same command must end with the files of an unbroken run and no others; rows that nobody computed must be
refused or made again; a full disk must lose nothing; and another command under the stem of a running study must be refused. The long run is
--count 60 --rows 1000000 --kills 10 --each 300.
"""

import argparse
import csv
import fcntl
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


PARETO = """
name = "front"
base = "feeder"
kind = "pareto"
rows = ROWS
set = ["cam.base_radius=60mm"]
columns = ["cam.prime_radius_mm", "checks.pressure_angle.value"]
[[parameter]]
key = "follower.roller.radius"
from = "2 mm"
to = "20 mm"
[[parameter]]
key = "follower.roller.mass"
mean = "2.5 kg"
deviation = "0.1 kg"
[[objective]]
column = "cam.prime_radius_mm"
[[objective]]
column = "checks.pressure_angle.value"
"""
COMMAND = ["study", "front.toml", "--quiet", "--page"]
# System calls that change files, or are the last before that.
CALLS = ("open", "openat", "write", "fsync", "renameat", "unlinkat", "ftruncate", "flock", "fchmod")


class Bench:
    """A study, the files of an uninterrupted run, and its time."""

    def __init__(self, binary, directory, rows):
        self.binary, self.root, self.text = binary, directory / "broken", PARETO.replace("ROWS", str(rows))
        self.root.mkdir()
        whole = self.case("whole")
        began = time.monotonic()
        run(binary, COMMAND, whole)
        self.seconds = time.monotonic() - began
        self.files = self.found(whole)
        assert sorted(self.files) == [".camgen.json", "front-front.csv", "front.csv", "front.html", "front.json"], sorted(self.files)

    def case(self, name):
        path = self.root / name
        shutil.rmtree(path, ignore_errors=True)
        path.mkdir()
        (path / "front.toml").write_text(self.text, encoding="utf-8")
        return path

    @staticmethod
    def found(case):
        """The files of a case by name."""
        out = case / "output"
        return {path.name: path.read_bytes() for path in out.iterdir()} if out.is_dir() else {}

    def begun(self, case, prefix=()):
        return subprocess.Popen([*prefix, self.binary, *COMMAND], cwd=case, env={**os.environ, "RAYON_NUM_THREADS": "1"}, stdout=subprocess.DEVNULL,
                                stderr=subprocess.DEVNULL, start_new_session=True)

    def continued(self, case, what):
        """The same command again, undisturbed."""
        names = {"front.csv", "front.json", "front-front.csv", "front.html"}
        there = self.found(case)
        partly = names & set(there) if names - set(there) else set()
        # Some files of a set may be in place if its record exists.
        assert not partly or ".camgen-commit" in there, f"{what}: {sorted(there)}"
        done = subprocess.run([self.binary, *COMMAND], cwd=case, capture_output=True, text=True, check=False)
        assert done.returncode == 0, f"{what}: the same command ends with {done.returncode}: {done.stderr}"
        found = self.found(case)
        assert found == self.files, f"{what}: {sorted(found)}, differing {[name for name in found if found[name] != self.files.get(name)]}"
        shutil.rmtree(case)


def killed_at_random(bench, count, seed):
    """Kills at random moments, some runs twice, then runs the same command; returns the number of kills."""
    chance, came = random.Random(seed), 0
    for number in range(count):
        case = bench.case(f"random-{number}")
        for _ in range(chance.choice([1, 1, 1, 2])):
            process = bench.begun(case)
            # Half of the kills at the end, when the files get their names.
            share = chance.uniform(0.0, 1.2) if number % 2 else chance.uniform(0.85, 1.1)
            try:
                process.wait(share * bench.seconds)
            except subprocess.TimeoutExpired:
                os.killpg(process.pid, signal.SIGKILL)
                process.wait()
                came += 1
        bench.continued(case, f"killed at random, {number}")
    return came


def killed_at_calls(bench, count, seed):
    """Kills at the calls that write; returns the numbers of kills and of calls. None without strace."""
    if shutil.which("strace") is None:
        return None
    case, log = bench.case("calls"), bench.root / "log"
    tracer = ["strace", "-f", "-o", str(log), "-e", f"trace={','.join(CALLS)}"]
    if bench.begun(case, tracer).wait() != 0:
        return None
    counts, calls, began = {}, [], False
    for line in log.read_text(errors="replace").splitlines():
        name = line.partition(" ")[2].strip().partition("(")[0]
        if name in CALLS:
            counts[name] = counts.get(name, 0) + 1
            began = began or "output" in line
            if began:
                calls.append((name, counts[name]))
    random.Random(seed).shuffle(calls)
    came = 0
    for number, (call, ordinal) in enumerate(calls[:count]):
        case = bench.case(f"call-{number}")
        prefix = ["strace", "-f", "-o", os.devnull, "-e", f"trace={call}", "-e", f"inject={call}:signal=KILL:when={ordinal}"]
        came += bench.begun(case, prefix).wait() not in (0, 1, 2)
        bench.continued(case, f"killed at {call} {ordinal}")
    return came, len(calls)


def stopped(bench, name):
    """A case with a run killed after rows were saved."""
    for attempt in range(20):
        case = bench.case(name)
        process = bench.begun(case)
        part, marker = case / "output" / "front.csv.part", case / "output" / "front.csv.part.json"
        while process.poll() is None:
            saved = json.loads(marker.read_bytes()) if marker.exists() else {"rows": 0}
            if saved["rows"] > 0 and part.exists():
                os.killpg(process.pid, signal.SIGKILL)
                process.wait()
                if part.exists():
                    return case, part, saved
    raise AssertionError(f"{name}: no run could be stopped with rows saved")


def forged(bench, count, seed):
    """Forged rows are refused, or made again; returns the number of each."""
    case, part, saved = stopped(bench, "forged")
    kept = {path.name: path.read_bytes() for path in (case / "output").iterdir()}
    rows = part.read_bytes()[: saved["bytes"]].splitlines(keepends=True)
    chance, refused, again = random.Random(seed), 0, 0

    def cell(row, column, text):
        cells = row.split(b",")
        cells[column] = text
        return b",".join(cells)

    for number in range(count):
        at = chance.randrange(1, len(rows))
        changed = {
            0: lambda: rows[:at] + [cell(rows[at], 2, b"1")] + rows[at + 1 :],
            1: lambda: rows[:at] + [cell(rows[at], 4, b"0.5")] + rows[at + 1 :],
            2: lambda: rows[:at] + [rows[at].replace(b",", b", ", 1)] + rows[at + 1 :],
            3: lambda: rows[:at] + rows[at + 1 :],
            4: lambda: [cell(rows[0], 2, b"set.other"), *rows[1:]],
            5: lambda: rows + [cell(rows[at], 0, str(len(rows) - 1).encode())],
            6: lambda: rows + [b"%d,1,1,1,1,\n" % (len(rows) - 1 + i) for i in range(5000)],
            7: lambda: rows[:at],
            8: lambda: rows + [bytes(100)],
            9: lambda: [rows[0], *reversed(rows[1:])],
        }[number % 10]()
        shutil.rmtree(case)
        case = bench.case("forged")
        (case / "output").mkdir()
        for name, content in kept.items():
            (case / "output" / name).write_bytes(content)
        part.write_bytes(b"".join(changed))
        done = subprocess.run([bench.binary, *COMMAND], cwd=case, capture_output=True, text=True, check=False)
        if done.returncode == 2:
            assert "was changed since camgen wrote it" in done.stderr and "--restart" in done.stderr, done.stderr
            assert part.read_bytes() == b"".join(changed), f"a refused part was changed: {number}"
            run(bench.binary, [*COMMAND, "--restart"], case, expected=(0,))
            refused += 1
        else:
            again += 1
        assert bench.found(case) == bench.files, f"forged rows were kept: {number}: {sorted(bench.found(case))}"
    shutil.rmtree(case)
    return refused, again


def stop_while_it_computes(process, out):
    """Stops a study with an open table, at a moment at which it is not writing a name."""
    while process.poll() is None:
        if (out / "front.csv.part").exists():
            os.killpg(process.pid, signal.SIGSTOP)
            handle = os.open(out, os.O_RDONLY | os.O_DIRECTORY)
            try:
                fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
                return
            except BlockingIOError:
                os.killpg(process.pid, signal.SIGCONT)
            finally:
                os.close(handle)
        time.sleep(0.001)


def at_once(bench):
    """Under the stem of a running study no other command writes; under another stem it does."""
    case = bench.case("at-once")
    process = bench.begun(case)
    stop_while_it_computes(process, case / "output")
    try:
        for words, code in ((["make", "feeder", "--name", "front", "--quiet"], 2), (["study", "front.toml", "--quiet"], 2),
                            (["make", "feeder", "--name", "other", "--quiet", "--format", "csv"], 0)):
            done = subprocess.run([bench.binary, *words], cwd=case, capture_output=True, text=True, check=False, timeout=60)
            assert done.returncode == code and (code == 0 or "another run of camgen is writing" in done.stderr), f"{words}: {done.returncode} {done.stderr}"
    finally:
        os.killpg(process.pid, signal.SIGCONT)
    assert process.wait() == 0
    found = bench.found(case)
    for name in bench.files:
        assert name == ".camgen.json" or found[name] == bench.files[name], name
    assert set(found) == {*bench.files, "other.csv"}, sorted(found)
    shutil.rmtree(case)


def full_disks(bench):
    """A disk that is full for some time: nothing is lost. None if none can be mounted."""
    sizes = (4, 16, 60, 120, 200, 260, 320, 400, 500)
    for size in sizes:
        case = bench.case("disk")
        (case / "output").mkdir()
        mount = ["mount", "-t", "tmpfs", "-o", f"size={size}k", "tmpfs", str(case / "output")]
        if shutil.which("mount") is None or subprocess.run(mount, capture_output=True, check=False).returncode != 0:
            return None
        try:
            done = subprocess.run([bench.binary, *COMMAND], cwd=case, capture_output=True, text=True, check=False)
            assert done.returncode in (0, 2) and "panicked" not in done.stderr, done.stderr
            there = set(bench.found(case))
            assert done.returncode == 0 or "front.csv" not in there, f"{size} kB: {done.stderr}: {there}"
            subprocess.run(["mount", "-o", "remount,size=100m", str(case / "output")], check=True)
            run(bench.binary, COMMAND, case, expected=(0,))
            assert bench.found(case) == bench.files, f"{size} kB: {sorted(bench.found(case))}"
        finally:
            subprocess.run(["umount", str(case / "output")], check=False)
    return len(sizes)


def broken(binary, directory, rows, count, seed):
    """All tests of interrupted studies; returns lines of figures."""
    bench = Bench(binary, directory, rows)
    came = killed_at_random(bench, count, seed)
    yield f"{count} studies killed at random moments, {came} kills came: all end by the same command"
    calls = killed_at_calls(bench, count, seed)
    yield "no strace: no kills at calls" if calls is None else f"{min(count, calls[1])} of {calls[1]} calls at which it was killed, {calls[0]} kills came: all end by the same command"
    refused, again = forged(bench, max(20, count // 5), seed)
    yield f"{refused + again} forged tables: {refused} refused, {again} made again, none kept"
    at_once(bench)
    disks = full_disks(bench)
    yield "no disk can be mounted" if disks is None else f"{disks} full disks: nothing is lost"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("binary")
    parser.add_argument("directory")
    parser.add_argument("--count", type=int, default=4, help="rows of each study that are compared")
    parser.add_argument("--rows", type=int, default=8000, help="rows of the study that is killed")
    parser.add_argument("--kills", type=int, default=3)
    parser.add_argument("--each", type=int, default=12, help="kills at random, and at calls")
    parser.add_argument("--short", type=int, default=4500, help="rows of the studies that are killed often")
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    binary = str(pathlib.Path(arguments.binary).resolve())
    directory = pathlib.Path(arguments.directory).resolve() / "study"
    shutil.rmtree(directory, ignore_errors=True)
    directory.mkdir(parents=True)
    texts = {path.stem: path.read_text(encoding="utf-8") for path in sorted((HERE / "crates" / "cams" / "profiles" / "studies").glob("*.toml"))}
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
    for line in broken(binary, directory, arguments.short, arguments.each, arguments.seed):
        print(f"study: {line}")
    print("study: " + killed(binary, directory, arguments.rows, arguments.kills, arguments.seed))


if __name__ == "__main__":
    main()
