"""Holds what reads files against files that nobody would draw: monsters, and what is left of good files after a thousand cuts.

monster_files.py has the generators of the monsters: dates that do not exist, nests without end, files of a hundred megabytes, lines
of a megabyte. Beside them camgen's own DXF files and the machine files that it carries are changed at random: bytes, lines, values,
ends, and two files spliced. Whatever is read, camgen must end by itself with exit code 0, 1 or 2, within 512 MiB and 2 s, must not
speak of a panic, and must not pass a control character, or one that turns text round, to the terminal. The time is that by the
clock or that of the processor, whichever is less, and up to three times as long where the machine is busy with something else;
how many needed more than 2 s is told.

usage: monsters.py CAMGEN_BINARY DIRECTORY [--count N] [--seed S] [--monsters N] [--only WORDS]
"""
import argparse
import os
import random
import re
import resource
import signal
import subprocess
import sys
import time
from pathlib import Path

import monster_files

MEBI = 1 << 20
ADDRESSES = 1536 * MEBI  # threads reserve addresses that they never use
LARGEST = 512 * MEBI
LONGEST = 2.0  # s
BUSY = 3.0
PATIENCE = 40  # s by the clock
FORBIDDEN = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\u061c\u200e\u200f\u202a-\u202e\u2066-\u2069\ufffe\uffff]")


class Worst:
    """What is counted, and the worst of it."""

    def __init__(self):
        self.runs, self.slow, self.time, self.memory, self.wrong = 0, 0, (0.0, ""), (0, ""), []
        self.codes = {0: 0, 1: 0, 2: 0}

    def tell(self, what, why):
        self.wrong.append(f"{what}: {why}")
        print(f"WRONG {what}: {why}", flush=True)


def limits():
    resource.setrlimit(resource.RLIMIT_AS, (ADDRESSES, ADDRESSES))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def once(words, environment):
    """Exit code, what was told, seconds and bytes of a run."""
    start = time.monotonic()
    run = subprocess.Popen(
        words, stdin=subprocess.DEVNULL, stdout=OUT, stderr=ERR, env=environment, preexec_fn=limits
    )
    signal.alarm(PATIENCE)
    try:
        _, status, used = os.wait4(run.pid, 0)
        run.returncode = os.waitstatus_to_exitcode(status)
    except TimeoutError:
        run.kill()
        _, status, used = os.wait4(run.pid, 0)
        run.returncode = "hangs"
    signal.alarm(0)
    seconds = min(time.monotonic() - start, used.ru_utime + used.ru_stime)
    told = []
    for stream in (OUT, ERR):
        stream.seek(0)
        told.append(stream.read())
        stream.seek(0)
        stream.truncate()
    return run.returncode, told, seconds, used.ru_maxrss * 1024


def hold(worst, what, words, environment=None):
    """Runs camgen and holds the run against the limits."""
    words = [str(word) for word in words]
    code, told, seconds, memory = once(words, environment)
    if seconds > LONGEST:
        worst.slow += 1
        code, told, again, memory = once(words, environment)
        seconds = min(seconds, again)
    worst.runs += 1
    worst.time = max(worst.time, (seconds, what))
    worst.memory = max(worst.memory, (memory, what))
    if code in worst.codes:
        worst.codes[code] += 1
    else:
        worst.tell(what, f"exit code {code}: {told[1][-300:]}")
    if seconds > LONGEST * BUSY:
        worst.tell(what, f"{seconds:.1f} s")
    if memory > LARGEST:
        worst.tell(what, f"{memory / MEBI:.0f} MiB")
    for stream in told:
        text = stream.decode("utf-8", "replace")
        if "panicked" in text or "please report" in text:
            worst.tell(what, text[-300:])
        found = FORBIDDEN.search(text)
        if found:
            worst.tell(what, f"U+{ord(found.group()):04X} in {text[max(0, found.start() - 60):found.end() + 20]!r}")
        if len(text) > MEBI:
            worst.tell(what, f"tells {len(text)} characters: {text[:200]}")
    return code


def put(path, parts):
    with open(path, "wb") as file:
        for part in parts:
            file.write(part)
    return path


class Choice:
    """Which monsters are wanted: those with some words in their names, or so many of each sort."""

    def __init__(self, only, count, seed):
        self.only, self.count, self.seed = only, count, seed

    def of(self, sort, monsters):
        if self.count is None:
            yield from ((name, parts) for name, parts in monsters() if self.only in name)
            return
        rng, names = random.Random(f"{sort} {self.seed}"), [name for name, _ in monsters()]
        wanted = set(rng.sample(names, min(self.count, len(names))))
        yield from ((name, parts) for name, parts in monsters() if name in wanted)


def dxf_monsters(binary, directory, choice, worst):
    path = directory / "monster.dxf"
    check = [binary, "check", path, "--cam", "rotary", "--rpm", "35"]
    sweden = os.environ | {"TZ": "Europe/Stockholm"}
    for name, parts in choice.of("dxf", monster_files.dxf):
        put(path, parts)
        hold(worst, f"DXF, {name}", check, sweden)
        if path.stat().st_size < MEBI:
            hold(worst, f"DXF, {name}, as JSON", [*check, "--json"])
    path = directory / "monster.step"
    for name, parts in choice.of("step", monster_files.step):
        put(path, parts)
        hold(worst, f"STEP, {name}", [binary, "check", path, "--cam", "rotary", "--rpm", "35"])
    if not choice.only:
        path.touch()
        for size in (200 * MEBI, 1 << 40):
            os.truncate(path, size)
            code = hold(worst, f"DXF of {size} zeros", [binary, "check", path])
            if code != 2:
                worst.tell(f"DXF of {size} zeros", f"exit code {code}")


def machine_monsters(binary, directory, choice, worst):
    path = directory / "monster.toml"
    for name, parts in choice.of("machine", monster_files.machine):
        put(path, parts)
        for command in ("make", "rotary", "shaft", "brake"):
            words = [binary, command, path, "--dry-run"]
            if hold(worst, f"machine file, {name}, {command}", words) == 0:
                worst.tell(f"machine file, {name}", "taken for a machine")


def no_files(binary, directory, worst):
    """What is no file where a file is due: none of it may be waited for, or read to its end."""
    pipe = directory / "pipe"
    if not pipe.exists():
        os.mkfifo(pipe)
    machine = directory / "names.toml"
    motion = subprocess.run([binary, "init", "--follower", "roller"], capture_output=True, text=True, check=True).stdout
    machine.write_text(motion)
    for bad in (pipe, directory, "/dev/zero", "/dev/stdin", "/dev/null", "/proc/self/mem", "/dev/tty"):
        table = "name = \"x\"\n[motion]\ntable = \"" + str(bad) + "\"\n[follower.roller]\nradius = \"10 mm\"\n"
        path = put(directory / "table.toml", [table.encode()])
        for words in (
            ["check", bad], ["make", bad], ["rotary", bad], ["conoid", bad], ["translating", bad], ["regimes", bad],
            ["shaft", bad], ["brake", bad], ["drive", bad], ["linkage", bad], ["spring", bad], ["size", bad],
            ["check", machine, bad], ["check", machine, "--design", bad], ["side-by-side", bad, "dpi"],
            ["rotary", "--template", bad, "--dry-run"], ["make", path, "--dry-run"], ["trade", bad],
            ["rotary", bad, "--watch"], ["make", bad, "--watch"],
        ):
            if "--watch" in words and bad == "/proc/self/mem":
                continue  # a file, and may be watched
            what = " ".join(map(str, words))
            code = hold(worst, what, [binary, *words])
            if code != 2:
                worst.tell(what, f"exit code {code}")


def stems(binary, directory, worst):
    """Names of machine files that would be unfit names of the files they make."""
    motion = subprocess.run([binary, "init", "--follower", "roller"], capture_output=True, check=True).stdout
    folder = directory / "stems"
    names = ["-rf.toml", "..toml", ".toml", ".hidden.toml", "a\nb.toml", "a\x1b[31mb.toml", "CON.toml", "nul.toml",
             "com1.toml", "aux.x.toml", "x" * 250 + ".toml", "a:b.toml", "a\\b.toml", "a|b?.toml", "ende .toml", "ende..toml",
             "a\u202eb.toml", "a\u0085b.toml", "a\ufffeb.toml", "\u00fcber.toml", " .toml"]
    for name in names:
        folder.mkdir(exist_ok=True)
        for old in folder.iterdir():
            old.unlink()
        source = put(directory / "stems" / name, [motion])
        out = directory / "made"
        out.mkdir(exist_ok=True)
        hold(worst, f"stem {name!r}", [binary, "make", f"{folder}/{name}", "--format", "dxf", "--out", out])
        source.unlink()
        for made in out.iterdir():
            stem = made.name.split(".")[0].lower()
            reserved = re.fullmatch("con|prn|aux|nul|com[0-9]|lpt[0-9]", stem)
            own = made.name == ".camgen.json"
            if not own and (made.name[0] in ".-" or FORBIDDEN.search(made.name) or set(made.name) & set("/\\:*?\"<>|\n")
                            or len(made.name) > 120 or reserved):
                worst.tell(f"stem {name!r}", f"made {made.name!r}")
            made.unlink()


EXTREME = [b"1e300", b"-1e300", b"nan", b"inf", b"1e15", b"-1e15", b"1e16", b"1e-300", b"0", b"-1", b"1", b"999999999999",
           b"1e-9", b"9223372036854775807", b"-2147483648", b"0x10", b"", b"1,5", b"\x1b[31m", b"\xe2\x80\xae", b"\xff\xfe"]


def spoilt(rng, data, others, number):
    """A file after a few of the accidents that files have; `number` finds its numbers."""
    for _ in range(rng.choice([1, 1, 1, 2, 3, 8])):
        how = rng.randrange(8)
        lines = data.split(b"\n")
        at = rng.randrange(len(lines))
        if how == 0 and data:
            changed = bytearray(data)
            for _ in range(rng.choice([1, 1, 5, 50])):
                changed[rng.randrange(len(changed))] = rng.randrange(256)
            data = bytes(changed)
        elif how in (1, 2):
            places = list(number.finditer(data))
            for place in rng.sample(places, min(len(places), rng.choice([1, 1, 3]))):
                if data[place.start():place.end()] == place.group():
                    data = data[:place.start()] + rng.choice(EXTREME) + data[place.end():]
        elif how == 3:
            del lines[at:at + rng.choice([1, 1, 2, 2, 7])]
            data = b"\n".join(lines)
        elif how == 4:
            few = lines[at:at + rng.choice([1, 2, 8])]
            lines[at:at] = few * rng.choice([1, 1, 2, 300])
            data = b"\n".join(lines)
        elif how == 5:
            data = data[:rng.randrange(len(data) + 1)] + rng.choice([b"", b"\n  0\nEOF\n", b"\n"])
        elif how == 6:
            other = rng.choice(others)
            data = data[:rng.randrange(len(data) + 1)] + other[rng.randrange(len(other)):]
        elif len(lines) > 4:
            other = rng.randrange(len(lines))
            lines[at], lines[other] = lines[other], lines[at]
            data = b"\n".join(lines)
    return data


def good_files(binary, directory):
    """Cut files of every sort, and machine files, as they should be."""
    keyway = ["--set", "cam.keyway.width=8mm", "--set", "cam.keyway.depth=3.3mm"]
    for name, words in (("arcs", keyway), ("spline", ["--outline", "spline"]), ("old", ["--dxf-version", "r12"])):
        words = [binary, "rotary", *words, "--format", "dxf", "--name", name, "--out", str(directory), "--quiet"]
        subprocess.run(words, check=True)
    drawings = [(directory / f"{name}.dxf").read_bytes() for name in ("arcs", "spline", "old")]
    followers = (None, "roller", "swinging-roller", "flat", "knife")
    starts = [[binary, "init", *(["--follower", f] if f else [])] for f in followers]
    machines = [subprocess.run(words, capture_output=True, check=True).stdout for words in starts]
    profiles = (Path(__file__).resolve().parents[2] / "crates").glob("*/profiles/*.toml")
    machines += [path.read_bytes() for path in sorted(profiles, key=lambda path: path.name)]
    return drawings, machines


def mutated(binary, directory, count, seed, worst):
    drawings, machines = good_files(binary, directory)
    number = re.compile(rb"[-+]?\d+(\.\d+)?(e[-+]?\d+)?")
    path = directory / "spoilt.dxf"
    for index in range(count):
        rng = random.Random(f"dxf {seed} {index}")
        put(path, [spoilt(rng, rng.choice(drawings), drawings, number)])
        json = ["--json"] if index % 5 == 0 else []
        hold(worst, f"spoilt DXF {index}", [binary, "check", path, "--cam", "rotary", "--rpm", "35", *json])
    path = directory / "spoilt.toml"
    for index in range(count):
        rng = random.Random(f"toml {seed} {index}")
        data = rng.choice(machines)
        put(path, [spoilt(rng, data, machines, number)])
        command = "make" if b"[motion]" in data else rng.choice(["rotary", "rotary", "translating", "regimes"])
        if b"[brake" in data:
            command = "brake"
        elif b"[shaft" in data:
            command = rng.choice(["shaft", "rotary"])
        hold(worst, f"spoilt machine file {index}, {command}", [binary, command, path, "--dry-run"])


def awake(*_):
    raise TimeoutError


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("binary")
    parser.add_argument("directory", type=Path)
    parser.add_argument("--count", type=int, default=400)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--monsters", type=int, help="so many of each sort, chosen by the seed [default: all]")
    parser.add_argument("--only", default="", help="only monsters with these words in their names, and nothing else")
    options = parser.parse_args()
    directory = options.directory / "monsters"
    directory.mkdir(parents=True, exist_ok=True)
    signal.signal(signal.SIGALRM, awake)
    global OUT, ERR
    OUT, ERR = (open(directory / name, "w+b") for name in ("out", "err"))
    worst = Worst()
    binary = str(Path(options.binary).resolve())
    choice = Choice(options.only, options.monsters, options.seed)
    dxf_monsters(binary, directory, choice, worst)
    machine_monsters(binary, directory, choice, worst)
    if not options.only:
        no_files(binary, directory, worst)
        stems(binary, directory, worst)
        mutated(binary, directory, options.count, options.seed, worst)
    for left in ("monster.dxf", "monster.step"):
        (directory / left).unlink(missing_ok=True)
    codes = ", ".join(f"{count} with {code}" for code, count in worst.codes.items())
    print(
        f"{worst.runs} runs ({codes}), {worst.slow} of them at first above {LONGEST} s; "
        f"worst {worst.time[0]:.2f} s ({worst.time[1]}) and {worst.memory[0] / MEBI:.0f} MiB ({worst.memory[1]}); "
        f"{len(worst.wrong)} wrong"
    )
    sys.exit(1 if worst.wrong else 0)


if __name__ == "__main__":
    main()
