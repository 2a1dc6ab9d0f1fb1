"""Looks for commands that cost too much: each ends by itself within 5 s and 512 MiB, or is refused.

First the commands that once took minutes or gigabytes. Then hostile values of keys and flags, with 1 GiB of addresses. Then a search that climbs on the time of the processor: of the keys of the
embedded machines, with the commands that read them, values are scaled by powers of ten and flags changed; what takes longer is
changed further, for so many seconds. The time is that by the clock or that of the processor, whichever is less, over the slowness of
the machine at that moment: the time of a fixed loop before and after the command, over the time that it takes on a machine at rest.
What takes more than 5 s is run again, and the lesser time counts. What still takes more is reported; it is wrong above three times as
long.

usage: cost.py CAMGEN_BINARY DIRECTORY [--hostile N] [--seconds N] [--seed S] [--only WORDS] [--verbose]
"""
import argparse
import math
import os
import random
import re
import resource
import subprocess
import sys
import time
from pathlib import Path

LONGEST = 5.0  # s
BUSY = 3.0
LARGEST = 512 << 20
ADDRESSES, FEW_ADDRESSES = 4 << 30, 1 << 30
# Steps of a loop, and its time on a machine at rest, s.
LOOP, LOOP_TIME = 1_000_000, 0.08
PATIENCE = 60  # s of the processor; ten times as long by the clock, since a machine may be busy


def once(words, directory, addresses):
    """Exit code, seconds, bytes and errors of a run."""
    def limits():
        resource.setrlimit(resource.RLIMIT_AS, (addresses, addresses))
        resource.setrlimit(resource.RLIMIT_CPU, (PATIENCE, PATIENCE))

    start = time.monotonic()
    with open(directory / "errors.txt", "w+b") as errors:
        run = subprocess.Popen(words, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=errors, cwd=directory, preexec_fn=limits)
        code, used = None, None
        while time.monotonic() < start + 10 * PATIENCE:
            pid, status, used = os.wait4(run.pid, os.WNOHANG)
            if pid:
                code = os.waitstatus_to_exitcode(status)
                break
            time.sleep(0.002)
        else:
            run.kill()
            _, _, used = os.wait4(run.pid, 0)
        run.returncode = code if code is not None else "hangs"
        errors.seek(0)
        told = errors.read().decode("utf-8", "replace")
    seconds = min(time.monotonic() - start, used.ru_utime + used.ru_stime)
    return run.returncode, seconds, used.ru_maxrss * 1024, told


def slowness():
    """Slowdown of the machine compared with one at rest, at least 1."""
    start, value = time.process_time(), 0
    for step in range(LOOP):
        value = (31 * value + step) & 0xFFFF
    return max(1.0, (time.process_time() - start) / LOOP_TIME)


class Worst:
    def __init__(self, directory):
        self.directory, self.runs, self.slow, self.wrong, self.time, self.memory = directory, 0, 0, 0, (0.0, ""), (0, "")

    def hold(self, what, words, addresses=ADDRESSES):
        """Runs a command and holds it against the limits; its time."""
        code, seconds, memory, told = once(words, self.directory, addresses)
        if seconds > LONGEST:
            before = slowness()
            code, again, memory, told = once(words, self.directory, addresses)
            seconds = min(seconds, again) / max(before, slowness())
        self.runs += 1
        self.time, self.memory = max(self.time, (seconds, what)), max(self.memory, (memory, what))
        if LONGEST < seconds <= BUSY * LONGEST:
            self.slow += 1
            print(f"slow {what}: {seconds:.1f} s\n    {' '.join(words)[:1000]}", flush=True)
        faults = [f"{seconds:.1f} s"] * (seconds > BUSY * LONGEST) + [f"{memory >> 20} MiB"] * (memory > LARGEST)
        faults += [f"exit code {code}: {told[-200:]}"] * (code not in (0, 1, 2) or "panicked" in told or "please report" in told)
        if faults:
            self.wrong += 1
            print(f"WRONG {what}: {'; '.join(faults)}\n    {' '.join(words)[:1000]}", flush=True)
        return seconds


def design(motion, follower='[follower.roller]\nradius = "10 mm"', more=""):
    return f'name = "cost"\n{motion}\n{follower}\n[cam]\nbase_radius = "auto"\nthickness = "10 mm"\n{more}'


def segments(count):
    """As many rises and returns as fit into a turn."""
    half = 360 / count
    one = lambda i: f'[[motion.segment]]\nlaw = "cycloidal"\nover = "{half:.9g} deg"\nto = "{0.1 * (1 - i % 2)} mm"'
    return '[motion]\nrpm = 60\nstart = "0 mm"\n' + "\n".join(one(i) for i in range(count - 1)) + '\n[[motion.segment]]\nlaw = "cycloidal"\nto = "0 mm"'


def table(count, wave=3):
    rows = "\n".join(f"{360 * i / count:.9f},{10 - 10 * math.cos(math.tau * i / count) + 0.01 * math.sin(wave * math.tau * i / count):.9f}" for i in range(count))
    return f"angle_deg,lift_mm\n{rows}\n"


def crossing_arcs(count):
    """A closed chain of half circles that all cross each other, as DXF."""
    head = "0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1015\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n"
    corner = lambda i: (50 * math.cos(2.39996 * i), 50 * math.sin(2.39996 * i))
    vertices = "".join("10\n{:.6f}\n20\n{:.6f}\n42\n0.9\n".format(*corner(i)) for i in range(count))
    return f"{head}0\nLWPOLYLINE\n8\nCAM_PROFILE\n90\n{count}\n70\n1\n{vertices}0\nENDSEC\n0\nEOF\n"


def known(directory):
    """What once took minutes or gigabytes, and its neighbours."""
    def file(name, text):
        (directory / name).write_text(text)
        return name

    listed = lambda count, low, high, unit="": ",".join(f"{low + (high - low) * i / count:.6g}{unit}" for i in range(count))
    for share in ["0.01%", "0.005%", "0.001%", "0.0001%"]:
        yield f"acceleration {share}", ["rotary", "--tolerance-acceleration", share]
        yield f"feeder, acceleration {share}", ["make", "feeder", "--tolerance-acceleration", share]
    for tolerance in ["0.01um", "0.0001um"]:
        yield f"tolerance {tolerance}", ["rotary", "--tolerance", tolerance]
        yield f"conoid, tolerance {tolerance}", ["conoid", "--rpm", "25,30,35", "--tolerance", tolerance]
    for travel in ["10mm", "1mm", "0.3mm", "0.1mm", "0.001mm"]:
        for more in [], ["--set", "limits.pressure_angle=80deg", "--set", "limits.min_convex_pitch_radius_over_roller=1"]:
            yield f"conoid, travel {travel}{' without limits' * bool(more)}", ["conoid", "--rpm", "25,30,35", "--set", f"conoid.axial_travel={travel}", *more]
    for column in ["1e-10mm", "1e-3mm", "0.1mm", "1mm"]:
        yield f"conoid, column {column}", ["conoid", "--rpm", "25,30,35", "--set", f"buffer.column={column}"]
    for count in [50, 100, 400, 700]:
        yield f"conoid, {count} speeds", ["conoid", "--rpm", listed(count, 20, 40)]
    for count in [30, 50, 200, 400]:
        yield f"spring, {count} stiffnesses and speeds", ["spring", "--stiffness", listed(count, 200, 400, "N/mm"), "--rpm", listed(count, 10, 30)]
    for count in [36, 1000, 10000]:
        yield f"regimes, {count} speeds", ["regimes", "--set", f"regimes.rpm=[{listed(count, 10, 40)}]"]
    for count in [300000, 1000000]:
        yield f"{count} stations", ["translating", "--solver", "paper", "--stations", str(count)]
    for angle in ["1e-12deg", "1e-3deg", "1deg"]:
        yield f"size, pressure angle {angle}", ["size", "feeder", "--free", "offset", "--set", f"limits.pressure_angle={angle}"]
    for waves in [100, 1000, 2000, 5000, 20000]:
        for amplitude in ["0.000001", "0.01"]:
            motion = f'[motion]\nrpm = 100\nstart = "0 mm"\nformula = "5*cos(th)+sin({waves}*th)*{amplitude}"'
            yield f"formula of {waves} waves of {amplitude}", ["make", file(f"waves-{waves}-{amplitude}.toml", design(motion))]
    formula = "+".join(f"sin({i}*th)*0.001" for i in range(1, 240))
    long = file("long.toml", design(f'[motion]\nrpm = 100\nstart = "0 mm"\nformula = "{formula}"'))
    yield "long formula", ["make", long]
    for count in [720, 2000, 5000]:
        name = file(f"segments-{count}.toml", design(segments(count), more="[limits]\npressure_angle = \"60 deg\"\nmin_convex_pitch_radius_over_roller = 0\n"))
        yield f"make {count} segments", ["make", name]
        yield f"size of {count} segments", ["size", name, "--free", "offset"]
    for count in [3600, 10000, 20000]:
        for wave in [3, 300]:
            file("rows.csv", table(count, wave))
            motion = '[motion]\nrpm = 100\nstart = "0 mm"\ntable = "rows.csv"\n'
            for shape in ["", 'shape = "monotonic"\n', 'smooth = "auto"\n']:
                name = file("rows.toml", design(motion + shape))
                yield f"table of {count} rows, wave {wave} {shape.strip()}", ["make", name]
            yield f"size of {count} rows, wave {wave}", ["size", name, "--free", "offset"]
    for count in [1000, 2000, 5000, 20000]:
        points = ", ".join(f'["{360 * i / count:.6g} deg", "{5 - 5 * math.cos(math.tau * i / count):.6g} mm"]' for i in range(count))
        yield f"{count} points", ["make", file("points.toml", design(f'[motion]\nrpm = 100\nstart = "0 mm"\npoints = [{points}]'))]
    for count in [500, 2000, 5000, 9990]:
        yield f"check of {count} crossing arcs", ["check", file(f"arcs-{count}.dxf", crossing_arcs(count)), "--cam", "rotary", "--rpm", "35"]


COMMANDS = {
    "dpi": [["rotary"], ["translating"], ["conoid", "--rpm", "25,30,35"], ["regimes"], ["spring"], ["drive"]],
    "feeder": [["make"], ["size", "--free", "offset"], ["laws"]],
    "lever": [["make"], ["size", "--free", "pivot-distance"], ["laws"]],
    "valve": [["make"], ["size"], ["laws"]],
    "dpi-crank-slider": [["linkage"], ["rotary"]],
    "dpi-six-bar": [["linkage"], ["rotary"]],
    "dpi-shaft": [["shaft"]],
    "roll": [["brake"]],
}
QUANTITY = re.compile(r"^(\s*)([a-z_]+)\s*=\s*\"?(-?[0-9][0-9.e+-]*)\s*([^\"#]*?)\"?\s*(#.*)?$")


def keys(binary, machine):
    """Every number of a machine file: its key, value and unit."""
    text = subprocess.run([binary, "machines", "show", machine], capture_output=True, text=True, check=True).stdout
    section, found = "", []
    for line in text.splitlines():
        heading = re.match(r"\s*(\[+)([^\]]+)\]", line)
        if heading:
            section = None if heading.group(1) == "[[" else heading.group(2)
        elif section is not None and (number := QUANTITY.match(line)):
            found.append((f"{section}.{number.group(2)}" if section else number.group(2), float(number.group(3)), number.group(4)))
    return found


HOSTILE = [
    "nan", "inf", "-inf", "1e308", "-1e308", "1e-308", "0", "-0", "-1", "1e400", "99999999999999999999", "", " ", '"', "''", "[]", "{}", "[1,2", "true",
    "2026-01-01", "\U0001f4a5", "\x1b[31m", "\u202e", "../../etc/passwd", "/dev/zero", "/proc/self/mem", "a" * 5000, "(" * 5000, "1e5mm", "-1e-12mm", "0mm", "1e-9mm",
    "1e9N", "1e-9deg", "360deg", "1e6deg", "0.1um", "1/0", "%s", "\n", "0x10", "1_000", "1e3", "1e-3", "auto", "none", "all", "steel", "1,2,3", ",".join(["7"] * 900),
]
FLAGS = [
    "--rpm", "--tolerance", "--tolerance-velocity", "--tolerance-acceleration", "--samples", "--name", "--format", "--accuracy", "--free", "--side", "--outline", "--end",
    "--dxf-version", "--template", "--cutter-diameter", "--residual", "--lift", "--over", "--sort", "--stiffness", "--stations", "--order", "--modes", "--section",
]


def hostile(binary, worst, count, rng):
    """Values that nobody means, for keys and flags of every command."""
    # `trade` is left out: it measures times, as long as that takes.
    starts = [(machine, words) for machine, all in COMMANDS.items() for words in all]
    numbers = {machine: keys(binary, machine) for machine in COMMANDS}
    for _ in range(count):
        machine, words = rng.choice(starts)
        command = [binary, words[0], machine, *words[1:]]
        for _ in range(rng.choice([1, 1, 2])):
            value = rng.choice(HOSTILE)
            if rng.random() < 0.75:
                command += ["--set", f"{rng.choice(numbers[machine])[0]}={value}"]
            else:
                command += [rng.choice(FLAGS), value]
        worst.hold(f"hostile: {machine} {words[0]}", [*command, "--out", "found", "--overwrite", "--quiet"], FEW_ADDRESSES)


def climb(binary, worst, seconds, rng):
    """Changes what took longest, for so many seconds; how many commands took more than 1 s."""
    starts = [(machine, tuple(words)) for machine, all in COMMANDS.items() for words in all]
    numbers = {machine: keys(binary, machine) for machine in COMMANDS}
    pool, end, slow = [(0.0, machine, words, ()) for machine, words in starts], time.monotonic() + seconds, 0
    while time.monotonic() < end:
        # Half of the time anything, else one of the slowest.
        _, machine, words, sets = rng.choice(pool) if rng.random() < 0.5 else rng.choice(sorted(pool, reverse=True)[:8])
        sets = dict(sets)
        for _ in range(rng.choice([1, 1, 2, 3])):
            key, value, unit = rng.choice(numbers[machine])
            sets[key] = f"{value * 10 ** rng.uniform(-4, 4) * rng.choice([1, 1, 1, -1]):.6g}{unit}"
        if rng.random() < 0.2 and words[0] in ("rotary", "translating", "conoid", "make"):
            flag, value = rng.choice([("--tolerance", f"{10 ** rng.uniform(-4, 3):.3g}um"), ("--tolerance-acceleration", f"{10 ** rng.uniform(-5, 1):.3g}%")])
            words = tuple(word for word in words if not word.startswith("--tol")) if flag not in words else words
            words = words if flag in words else (*words, flag, value)
        command = [binary, words[0], machine, *words[1:]]
        command += [word for key, value in sorted(sets.items()) for word in ("--set", f"{key}={value}")]
        took = worst.hold(f"search: {machine} {words[0]}", [*command, "--out", "found", "--overwrite", "--quiet"])
        slow += took > 1
        pool.append((took, machine, words, tuple(sorted(sets.items()))))
        if len(pool) > 200:
            pool = [(0.0, *start, ()) for start in starts] + sorted(pool, reverse=True)[:100]
    return slow


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("binary", type=lambda text: str(Path(text).resolve()))
    parser.add_argument("directory", type=lambda text: Path(text).resolve() / "cost")
    parser.add_argument("--hostile", type=int, default=500)
    parser.add_argument("--seconds", type=float, default=60)
    parser.add_argument("--seed", default="1")
    parser.add_argument("--only", default="")
    parser.add_argument("--verbose", action="store_true")
    words = parser.parse_args()
    words.directory.mkdir(parents=True, exist_ok=True)
    worst = Worst(words.directory)
    for what, command in known(words.directory):
        if words.only in what:
            writes = [] if command[0] == "check" else ["--out", "found", "--overwrite"]
            took = worst.hold(what, [words.binary, *command, *writes, "--quiet"])
            if words.verbose:
                print(f"{took:6.2f} s  {what}", flush=True)
    hostile(words.binary, worst, words.hostile, random.Random(words.seed))
    listed = worst.runs
    slow = climb(words.binary, worst, words.seconds, random.Random(words.seed)) if words.seconds > 0 else 0
    print(f"{listed} known and hostile commands and {worst.runs - listed} found by the search, {slow} of these above 1 s; {worst.slow} above 5 s; worst {worst.time[0]:.2f} s "
          f"({worst.time[1]}) and {worst.memory[0] >> 20} MiB ({worst.memory[1]}); {worst.wrong} wrong")
    sys.exit(worst.wrong > 0)


if __name__ == "__main__":
    main()
