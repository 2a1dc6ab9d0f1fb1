"""Plants links, pipes, sockets, devices, directories and files under every name that a command may write, and runs it.

For each command that writes (and for the page of `camgen serve`) the names of its files are learnt from a run in an empty directory. Then each of
them, the names of camgen's records, of temporary files, and of those of earlier versions is taken by something of the user: what was planted, and
the file or directory that it leads to, must be as before, unless it is a plain file and `--overwrite` was given; every run must end in time, and
with exit code 0 only if all its files exist.

usage: planted.py CAMGEN_BINARY DIRECTORY [--count N] [--seed N] [--jobs N]

--count is the number of planted names of each command; the long run is --count 400.
"""

import argparse
import hashlib
import json
import os
import random
import shutil
import signal
import socket
import stat
import subprocess
import sys
import urllib.request
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

# Longest time of a run that does not hang, s.
PATIENCE = 60
STUDY = """name = "small"
base = "feeder"
kind = "pareto"
rows = 12
columns = ["cam.base_radius_mm"]
[[parameter]]
key = "follower.roller.radius"
from = "14 mm"
to = "20 mm"
[[objective]]
column = "cam.base_radius_mm"
[[objective]]
column = "checks.pressure_angle.value"
"""
COMMANDS = {
    "make": ["make", "feeder", "--format", "dxf,csv,json,html"],
    "rotary": ["rotary", "--rpm", "35", "--format", "dxf,svg"],
    "laws": ["laws", "feeder"],
    "import": ["import", "lift.csv", "--follower", "roller,diameter=20mm"],
    "compare": ["compare", "points.csv", "feeder"],
    "side-by-side": ["side-by-side", "feeder", "feeder"],
    "study": ["study", "small.toml", "--page"],
    "init": ["init", "out/own.toml"],
    "serve": [],
}
RECORDS = [".camgen.json", ".camgen-1.json", ".camgen-commit", ".camgen-commit-1", ".camgen-new-1-0", ".camgen-new-7-0"]
# Endings of unfinished files, of this and earlier versions.
ADDED = [".part", ".part.json", ".tmp", ".part.json.tmp", ".camgen-new", ".new"]
KINDS = ["a file", "a link", "a link to nothing", "a link to a directory", "a link to a device", "a hard link", "a pipe", "a socket", "a directory",
         "a device", "a read-only file", "a file like a record", "a file like a marker"]


def listed(binary, where, command):
    """The names written by a command, and its exit."""
    inputs(binary, where, command)
    done = run(binary, where, COMMANDS[command])
    return sorted(os.listdir(where / "out")), done


def inputs(binary, where, command):
    """The input files of a command."""
    where.mkdir(parents=True)
    (where / "small.toml").write_text(STUDY, encoding="utf-8")
    shown = subprocess.run([binary, "machines", "show", "feeder"], capture_output=True, check=True)
    (where / "own.toml").write_bytes(shown.stdout)
    made = subprocess.run([binary, "make", "feeder", "--format", "csv", "--out", "made", "--name", "cam", "--quiet"], cwd=where, capture_output=True, check=False)
    assert made.returncode == 0, made.stderr
    rows = (where / "made" / "cam.csv").read_text(encoding="utf-8").splitlines()
    head = rows[0].split(",")
    angle, lift = head.index("cam_deg"), next(i for i, name in enumerate(head) if name.startswith("lift"))
    (where / "lift.csv").write_text("cam_deg,lift_mm\n" + "".join(f"{r.split(',')[angle]},{r.split(',')[lift]}\n" for r in rows[1:]), encoding="utf-8")
    x, y = (next(i for i, name in enumerate(head) if name.startswith(f"profile_{axis}") or name == f"{axis}_mm") for axis in "xy")
    (where / "points.csv").write_text("x_mm,y_mm\n" + "".join(f"{r.split(',')[x]},{r.split(',')[y]}\n" for r in rows[1:]), encoding="utf-8")
    shutil.rmtree(where / "made")
    (where / "out").mkdir()
    if command == "serve":
        # Next to the files that it writes, which the page may save.
        (where / "own.toml").rename(where / "out" / "own.toml")


def run(binary, where, words, more=()):
    """Exit code and standard error of a command; None for the code if it hangs."""
    if not words:
        return served(binary, where, more)
    out = [] if words[0] == "init" else ["--out", "out", "--name", "own"]
    process = subprocess.Popen([binary, *words, *out, *more], cwd=where, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                               start_new_session=True)
    try:
        _, told = process.communicate(timeout=PATIENCE)
        return process.returncode, told.decode(errors="replace")
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        process.communicate()
        return None, "it hangs"


def served(binary, where, more):
    """`camgen serve`: the page saves its machine file and writes files."""
    process = subprocess.Popen([binary, "serve", "out/own.toml", "--out", "out", *more], cwd=where, stdout=subprocess.PIPE,
                               stderr=subprocess.PIPE, text=True)
    try:
        address = process.stdout.readline().strip()
        if not address:
            return process.wait(PATIENCE), process.stderr.read()
        host, token = address.split("/?token=")

        def asked(path, body):
            request = urllib.request.Request(host + path, json.dumps(body).encode(), {"X-Camgen-Token": token}, method="POST")
            with urllib.request.urlopen(request, timeout=PATIENCE) as answer:
                return json.loads(answer.read())
        toml = asked("/files", {})["designs"][0].get("toml", "")
        changed = toml.replace('name = "Feeder"', 'name = "Another"')
        faults = [done["faults"] for done in (asked("/save", {"design": 0, "toml": changed, "before": toml}),
                                              asked("/write", {"name": "own", "toml": toml, "formats": ["dxf", "csv"]})) if "faults" in done]
        return (2 if faults else 0), str(faults)
    except (TimeoutError, OSError) as error:
        return None, f"it hangs: {error}"
    finally:
        process.kill()
        process.wait()


def digest(path):
    """State of the entry under a name, without opening pipes and devices."""
    data = os.lstat(path)
    kind = stat.S_IFMT(data.st_mode)
    if kind == stat.S_IFREG:
        return kind, data.st_ino, stat.S_IMODE(data.st_mode), hashlib.sha256(path.read_bytes()).hexdigest()
    if kind == stat.S_IFLNK:
        return kind, data.st_ino, os.readlink(path)
    if kind == stat.S_IFDIR:
        return kind, data.st_ino, sorted((name, digest(path / name)) for name in os.listdir(path))
    return kind, data.st_ino


def plant(path, kind, victim, folder):
    """Puts a user's entry under a name; returns whether that is possible here."""
    try:
        if kind == "a file":
            path.write_text("mine\n", encoding="utf-8")
        elif kind == "a read-only file":
            path.write_text("mine\n", encoding="utf-8")
            path.chmod(0o444)
        elif kind == "a file like a record":
            path.write_text('{"files": {}, "inputs": {}}', encoding="utf-8")
        elif kind == "a file like a marker":
            path.write_text('{"rows": 5}', encoding="utf-8")
        elif kind == "a hard link":
            os.link(victim, path)
        elif kind == "a pipe":
            os.mkfifo(path)
        elif kind == "a directory":
            path.mkdir()
            (path / "mine").write_text("mine\n", encoding="utf-8")
        elif kind == "a socket":
            with socket.socket(socket.AF_UNIX) as one:
                one.bind(os.path.relpath(path))
        elif kind == "a device":
            os.mknod(path, stat.S_IFCHR | 0o666, os.makedev(1, 5))
        else:
            path.symlink_to({"a link": victim, "a link to nothing": victim.with_name("none"), "a link to a directory": folder,
                             "a link to a device": Path("/dev/zero")}[kind])
        return True
    except (PermissionError, OSError):
        return False


def tried(binary, root, command, name, kind, overwrite, names):
    """The faults of a run with a planted entry; None if it cannot be planted."""
    where = root / f"{command}-{hashlib.sha256(f'{name}{kind}{overwrite}'.encode()).hexdigest()[:12]}"
    shutil.rmtree(where, ignore_errors=True)
    inputs(binary, where, command)
    victim, folder, path = where / "victim", where / "folder", where / "out" / name
    victim.write_text("victim\n", encoding="utf-8")
    folder.mkdir()
    (folder / "mine").write_text("mine\n", encoding="utf-8")
    if not plant(path, kind, victim, folder):
        return None
    before = digest(path), digest(victim), digest(folder)
    words = COMMANDS[command]
    code, told = run(binary, where, words, ["--overwrite"] if overwrite and command != "init" else [])
    how = f"{command}: {kind} at out/{name}{' --overwrite' if overwrite else ''}: exit {code}: {told.strip()[-200:]}"
    wrong = []
    if code not in (0, 1, 2):
        wrong.append("it hangs" if code is None else f"exit code {code}")
    if "panicked" in told:
        wrong.append("it panicked")
    plain = stat.S_ISREG(before[0][0])
    # camgen's own temporary name, or a file that the user allows to be replaced.
    replaceable = name.startswith(".camgen-new-") and kind not in ("a directory", "a pipe", "a socket", "a device")
    replaceable = replaceable or name == ".camgen.json" and kind == "a file like a record" or plain and overwrite and (name in names or name == ".camgen.json")
    after = digest(path) if os.path.lexists(path) else None
    if after != before[0] and not replaceable:
        wrong.append("what was planted is not as before")
    if digest(victim) != before[1] or digest(folder) != before[2] or (where / "none").exists():
        wrong.append("what it leads to is not as before")
    missing = [one for one in names if not os.path.lexists(where / "out" / one)]
    if code == 0 and missing:
        wrong.append(f"exit code 0 without {missing}")
    shutil.rmtree(where)
    return [f"{one}\n      {how}" for one in wrong]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("binary", type=Path)
    parser.add_argument("directory", type=Path)
    parser.add_argument("--count", type=int, default=40)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--only", default="")
    options = parser.parse_args()
    binary, root = options.binary.resolve(), (options.directory / "planted").resolve()
    shutil.rmtree(root, ignore_errors=True)
    # Socket paths must be short.
    root.mkdir(parents=True)
    os.chdir(root)
    chance, wrong, done = random.Random(options.seed), [], {}
    for command in COMMANDS:
        if options.only not in command:
            continue
        names, (code, told) = listed(binary, root / f"{command}-whole", command)
        assert code in (0, 1) and names, f"{command}: exit {code}: {told}"
        places = sorted({*names, *RECORDS, *(name + added for name in names if not name.startswith(".") for added in ADDED)})
        plans = [(name, kind, overwrite) for name in places for kind in KINDS for overwrite in (False, True)]
        chance.shuffle(plans)
        # Each kind under the name of a file and under a name next to it, before all others.
        plans.sort(key=lambda plan: not (plan[0] in names or plan[0].endswith((".part", ".part.json"))))
        with ThreadPoolExecutor(options.jobs) as pool:
            found = list(pool.map(lambda plan: tried(binary, root, command, *plan, names), plans[: options.count]))
        done[command] = sum(one is not None for one in found)
        wrong += [line for one in found if one for line in one]
    print(f"planted: {done}: {len(wrong)} wrong")
    for line in wrong[:20]:
        print(f"    {line}")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
