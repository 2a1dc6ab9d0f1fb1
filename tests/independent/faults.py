"""Tries to break the promise that the files of a run are written all or none.

Calls of the system are made to fail one by one and from one on, the program is killed and interrupted at each of them, two writers
work on the same names, a reader polls while sets are replaced, and disks, pipes, modes and names are set up against the writer.
After each of them every name must hold an old or a new file whole, a run that says nothing was changed must have changed nothing,
and the next run must leave one set, with a record that fits it and nothing beside it.

usage: faults.py CAMGEN_BINARY DIRECTORY [--full] [--seed N] [--rounds N] [--faults N] [--jobs N] [--only WORD]
"""
import argparse
import fcntl
import hashlib
import itertools
import json
import os
import random
import re
import shlex
import shutil
import signal
import socket
import stat
import struct
import subprocess
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

# Where the files go, from the directory of a case: two directories, so that both have to be made and taken back.
OUT = "deep/out"
# Nothing that is tried takes so long, unless it hangs; s.
PATIENCE = 60
RECORD, COMMIT, STAGED = ".camgen.json", ".camgen-commit", ".camgen-new-"
KEPT = "the new files are kept"
NOBODY = 65534

RADIUS = ["--set", "follower.roller.radius=29mm"]
OTHER = ["--set", "name=Other"]
# What is run, and what makes an older and a third set of the same names.
COMMANDS = {
    "rotary": (["rotary", "--rpm", "35"], RADIUS, OTHER),
    "rotary-dxf": (["rotary", "--rpm", "35", "--format", "dxf"], RADIUS, OTHER),
    "translating": (["translating", "--rpm", "35"], RADIUS, OTHER),
    "conoid": (["conoid", "--rpm", "35"], RADIUS, OTHER),
    "make": (["make", "feeder"], RADIUS, OTHER),
    "regimes": (["regimes"], RADIUS, OTHER),
    "laws": (["laws", "feeder"], ["--lift", "25mm"], ["--lift", "26mm"]),
    "trade-shaft": (["trade", "shaft"], ["--set", "name=Older"], OTHER),
}
# Its files hold measured times: no two runs make the same.
MEASURED = {"trade-shaft"}
STATES = ("none", "old", "foreign", "cut")

# How each call can fail. What ends in `!` is tried once only: for ever it would rightly be tried again.
ERRORS = {
    "open": ["EACCES", "EMFILE", "EIO"],
    "openat": ["EACCES", "ENOSPC", "EMFILE", "EDQUOT"],
    "flock": ["EIO", "ENOLCK", "EAGAIN!", "EINTR!"],
    "statx": ["EIO", "EACCES"],
    "newfstatat": ["EIO", "EACCES"],
    "fstat": ["EIO"],
    "read": ["EIO", "EINTR!"],
    "write": ["ENOSPC", "EIO", "EDQUOT", "EINTR!"],
    "fsync": ["EIO", "ENOSPC", "EDQUOT", "EINTR!"],
    "fdatasync": ["EIO"],
    "fchmod": ["EPERM", "EIO"],
    "fchown": ["EPERM", "EIO"],
    "rename": ["EIO", "ENOSPC"],
    "renameat": ["EIO", "ENOSPC", "EACCES", "EBUSY", "EXDEV"],
    "renameat2": ["EIO", "ENOSPC"],
    "unlink": ["EIO", "EACCES"],
    "unlinkat": ["EIO", "EACCES", "EBUSY"],
    "mkdir": ["EACCES", "ENOSPC", "EROFS"],
    "mkdirat": ["EACCES", "ENOSPC"],
    "rmdir": ["EBUSY"],
    "getdents64": ["EIO"],
    "lseek": ["EIO"],
    "fcntl": ["EIO"],
    "close": ["EIO"],
}
# With these what was begun cannot be cleared away.
CLEARING = {"unlink", "unlinkat", "rmdir"}


class Wrong(list):
    """What broke, with how to see it again."""

    def add(self, what, how):
        self.append(f"{what}\n      {how}")


class Skip(Exception):
    """A part that cannot be run here."""


# --- directories --------------------------------------------------------------------------------------------------------------


def entry(path):
    """What stands under a name: its kind, content, mode and owner."""
    data = os.lstat(path)
    kind = stat.S_IFMT(data.st_mode)
    content = None
    if kind == stat.S_IFREG:
        content = hashlib.sha256(Path(path).read_bytes()).hexdigest()
    elif kind == stat.S_IFLNK:
        content = os.readlink(path)
    return kind, content, stat.S_IMODE(data.st_mode), data.st_uid, data.st_gid


def seen(directory):
    """All names below a directory."""
    found = {}
    for path in sorted(Path(directory).rglob("*")):
        found[str(path.relative_to(directory))] = entry(path)
    return found


def contents(directory):
    """The files of a directory by name, and what is in them."""
    if not Path(directory).is_dir():
        return {}
    return {p.name: entry(p)[1] for p in Path(directory).iterdir() if stat.S_ISREG(os.lstat(p).st_mode)}


MASK = (1 << 64) - 1
SIPPED = {}


def sipped(path):
    """SipHash-1-3 of 128 bits with a key of zeros, which a record has of a file, in hexadecimal digits."""
    data = Path(path).read_bytes()
    known = hashlib.sha256(data).digest()
    if known not in SIPPED:
        SIPPED[known] = siphash(data)
    return SIPPED[known]


def siphash(data):
    """By Aumasson and Bernstein's description of SipHash, with one round a word and three at the end."""

    def rotated(word, bits):
        return (word << bits | word >> (64 - bits)) & MASK

    def turned(a, b, c, d):
        a, c = (a + b) & MASK, (c + d) & MASK
        b, d = rotated(b, 13) ^ a, rotated(d, 16) ^ c
        a = (rotated(a, 32) + d) & MASK
        c = (c + b) & MASK
        return a, rotated(b, 17) ^ c, rotated(c, 32), rotated(d, 21) ^ a

    a, b, c, d = 0x736F6D6570736575, 0x646F72616E646F6D ^ 0xEE, 0x6C7967656E657261, 0x7465646279746573
    whole = len(data) // 8 * 8
    last = int.from_bytes(data[whole:], "little") | (len(data) & 0xFF) << 56
    for (word,) in itertools.chain(struct.iter_unpack("<Q", data[:whole]), [(last,)]):
        a, b, c, d = turned(a, b, c, d ^ word)
        a ^= word
    c ^= 0xEE
    halves = []
    for _ in range(2):
        for _ in range(3):
            a, b, c, d = turned(a, b, c, d)
        halves.append(a ^ b ^ c ^ d)
        b ^= 0xDD
    return f"{halves[1] << 64 | halves[0]:032x}"


def is_left(name):
    return Path(name).name.startswith((STAGED, COMMIT))


def left(directory):
    return sorted(name for name in os.listdir(directory) if is_left(name)) if Path(directory).is_dir() else []


def fits(directory):
    """Whether the record of a directory has the digest of each file that it names, and each is there."""
    try:
        files = json.loads((Path(directory) / RECORD).read_bytes())["files"]
    except (OSError, ValueError, KeyError):
        return False
    there = contents(directory)
    return bool(files) and all(there.get(name) and sipped(Path(directory) / name) == files[name] for name in files)


def promised(directory):
    """Hashes of all files there that a record in a directory names, in its place or on its way there."""
    files = [path for path in Path(directory).iterdir() if stat.S_ISREG(os.lstat(path).st_mode)]
    by_digest = {sipped(path): entry(path)[1] for path in files}
    hashes = set()
    for path in Path(directory).iterdir():
        if path.name == RECORD or path.name.startswith(STAGED):
            try:
                text = path.read_bytes()
                named = {by_digest.get(digest) for digest in json.loads(text)["files"].values()}
                hashes |= named | {hashlib.sha256(text).hexdigest()}
            except (OSError, ValueError, KeyError, TypeError):
                pass
    return hashes


# --- runs ---------------------------------------------------------------------------------------------------------------------


class Run:
    def __init__(self, code, out, err, line):
        self.code, self.out, self.err, self.line = code, out, err, line

    def panicked(self):
        return "panicked" in self.err or self.code in (101, -signal.SIGABRT, -signal.SIGSEGV)


class Bench:
    """The binary, the directory, and what a run without a fault makes of each start."""

    def __init__(self, binary, root, options):
        self.binary, self.root, self.options = os.path.abspath(binary), Path(root).resolve(), options
        self.rng = random.Random(options.seed)
        self.numbers = itertools.count()
        self.starts, self.made, self.lock = {}, {}, threading.RLock()
        self.strace = self.traces()

    def traces(self):
        """Whether strace can be had and may trace, and make calls fail."""
        if shutil.which("strace") is None:
            return None
        probe = [*self.tracer(["openat"]), "-e", "inject=openat:error=EIO:when=1000", "true"]
        run = subprocess.run(probe, capture_output=True, text=True, check=False)
        return "strace" if run.returncode == 0 else None

    @staticmethod
    def tracer(calls, log=None):
        return ["strace", "-f", "-o", str(log or os.devnull), "-e", f"trace={','.join(calls)}"]

    def words(self, name, variant=0):
        words, old, third = COMMANDS[name]
        return [*words, *((), old, third)[variant], "--out", OUT, "--name", "cam"]

    def case(self):
        """An empty directory of its own."""
        path = self.root / f"case-{next(self.numbers)}"
        shutil.rmtree(path, ignore_errors=True)
        path.mkdir(parents=True)
        return path

    def begun(self, words, where, prefix=(), **how):
        """Starts a run, in a group of its own."""
        environment = {**os.environ, "RAYON_NUM_THREADS": "1", "NO_COLOR": "1"}
        how = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "stdin": subprocess.DEVNULL, **how}
        line = [*prefix, self.binary, *words]
        process = subprocess.Popen(line, cwd=where, env=environment, start_new_session=True, **how)
        process.line = f"RAYON_NUM_THREADS=1 {shlex.join(line)}"
        return process

    @staticmethod
    def ended(process, patience=PATIENCE):
        """Its outcome; `None` for the code where it does not end."""
        try:
            out, err = process.communicate(timeout=patience)
            code = process.returncode
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            out, err = process.communicate()
            code = None
        return Run(code, out or b"", (err or b"").decode(errors="replace"), process.line)

    def run(self, words, where, prefix=(), **how):
        return self.ended(self.begun(words, where, prefix, **how))

    def start(self, name, state):
        """A directory in the state that a run begins with, and the sets that its names may hold."""
        with self.lock:
            if (name, state) not in self.starts:
                self.starts[name, state] = self.set_up(name, state)
            return self.starts[name, state]

    def set_up(self, name, state):
        where = self.case()
        known = []
        if state != "none":
            self.must(name, 1, where)
            known.append(contents(where / OUT))
        if state == "foreign":
            (where / OUT / "notes.txt").write_text("mine\n")
            (where / OUT / "cam").mkdir()
            (where / OUT / "cam" / "cam.dxf").write_text("mine too\n")
            known = [contents(where / OUT)]
        if state == "cut":
            known.append(self.after(name, "old", 2))
            self.cut(name, where)
        return where, known or [{}]

    def must(self, name, variant, where):
        run = self.run(self.words(name, variant), where)
        assert run.code == 0, f"{run.line}: {run.code} {run.err}"

    def cut(self, name, where):
        """A run with the third set is killed when some of its files are in their places."""
        run = self.run(self.words(name, 2), where, [*self.tracer(["renameat"]), "-e", "inject=renameat:signal=KILL:when=3"])
        assert (where / OUT / COMMIT).exists(), f"{run.line}: it was not cut off: {run.code} {run.err}"

    def copy(self, name, state):
        where = self.case()
        shutil.copytree(self.start(name, state)[0], where, symlinks=True, dirs_exist_ok=True)
        return where

    def after(self, name, state, variant=0, then=None):
        """The set that a run makes of a start, and another run after it."""
        with self.lock:
            key = name, state, variant, then
            if key not in self.made:
                where = self.copy(name, state)
                self.must(name, variant, where)
                if then is not None:
                    self.must(*then, where)
                self.made[key] = contents(where / OUT)
                shutil.rmtree(where)
            return self.made[key]

    def calls(self, name, state):
        """The calls of the thread that writes, from the first that touches the directory: call, its ordinal, its text."""
        where = self.copy(name, state)
        log = where / "trace"
        run = self.run(self.words(name), where, self.tracer(ERRORS, log))
        assert run.code == 0, run.err
        counts, found, main = {}, [], None
        for line in log.read_text(errors="replace").splitlines():
            pid, _, text = line.partition(" ")
            match = re.match(r"(\w+)\((.*)", text.strip())
            main = main or pid
            if match and pid == main:
                counts[match[1]] = counts.get(match[1], 0) + 1
                if found or f'"{OUT.split("/", maxsplit=1)[0]}' in match[2]:
                    found.append((match[1], counts[match[1]], match[0]))
        shutil.rmtree(where)
        return found

    def how(self, name, state, run):
        """How to see a case again."""
        older = shlex.join([self.binary, *self.words(name, 1)])
        cut = f"strace -f -e inject=renameat:signal=KILL:when=3 {shlex.join([self.binary, *self.words(name, 2)])}"
        states = {"none": "an empty directory", "old": older, "foreign": f"{older}; echo mine > {OUT}/notes.txt",
                  "cut": f"{older}; {cut}"}
        return f"start: {states[state]}; then: {run.line}"


# --- judgement ----------------------------------------------------------------------------------------------------------------


def is_one_of(found, known, measured, directory):
    """Whether a directory holds one of these sets, and no more."""
    found = {name: content for name, content in found.items() if not is_left(name)}
    if any(found == one for one in known):
        return True
    return measured and fits(directory) and set(found) >= {"cam.csv", "cam.svg"}


def torn(directory, before, known, measured):
    """Names that hold neither an old file nor a new one whole, that are missing, or that nobody asked for."""
    found = contents(directory)
    faults = []
    hashes = promised(directory) if measured and Path(directory).is_dir() else set()
    for name in sorted({*found, *(name for one in known for name in one)}):
        allowed = {one[name] for one in known if name in one}
        if name in found:
            if not is_left(name) and found[name] not in allowed and found[name] not in hashes:
                faults.append(f"{name} is torn" if allowed else f"{name} is not asked for")
        elif name in before:
            faults.append(f"{name} is missing")
    return faults


def judged(bench, name, state, where, run, cleared=True, silenced=False):
    """What is wrong with a directory after a run that something befell, and after the next one. Begun files that cannot be cleared
    away may stay, and a run that cannot write any more says nothing."""
    directory, (start, olds) = where / OUT, bench.start(name, state)
    measured = name in MEASURED
    new = {} if measured else bench.after(name, state)
    known = [*olds, new] if new else olds
    faults = []
    if run.code is None:
        return [f"no end within {PATIENCE} s"]
    if run.panicked():
        faults.append(f"it panicked: {run.err[-200:]}")
    if run.code not in (0, 1, 2) and run.code != -signal.SIGKILL:
        faults.append(f"exit code {run.code}")
    found, whole = contents(directory), seen(where)
    same = whole == seen(start)
    if run.code == 0:
        if not is_one_of(found, [new], measured, directory) or left(directory):
            faults.append(f"exit 0, and not the new set: {difference(found, new)}")
    elif run.code == 2 and KEPT not in run.err and not (silenced and not run.err.strip() and COMMIT in found):
        if state == "cut":
            faults += after_cut(bench, name, directory, olds, found, cleared)
        elif not same and (cleared or changed(seen(start), whole)):
            faults.append(f"exit 2, and something was changed: {difference(whole, seen(start))}; it said: {run.err.strip()[-160:]}")
        if state != "cut" and COMMIT in found:
            faults.append("exit 2 without a word of it, and a record stands")
    elif run.code == 2 and KEPT in run.err and COMMIT not in found:
        faults.append(f"it said that the set is kept, and there is no record: {run.err.strip()[-160:]}")
    before = contents(start / OUT)
    if run.code != 0 and not same:
        faults += torn(directory, before, known, measured)
        if COMMIT not in found and not is_one_of(found, [*known, before], measured, directory):
            faults.append(f"no record, and a mixed set: {sorted(found)}")
        faults += next_run(bench, name, state, where, new)
    return faults


def changed(before, after):
    """Whether more was changed than what cannot be cleared away."""
    kept = {name: one for name, one in after.items() if not is_left(name) and (name in before or one[0] != stat.S_IFDIR)}
    return kept != before


def after_cut(bench, name, directory, olds, found, cleared):
    """What an earlier run left may be finished before a run fails; all of it, or its record stands."""
    if COMMIT in found or name in MEASURED:
        return []
    pending = {file: content for file, content in found.items() if not is_left(file)}
    if pending != olds[-1] or (cleared and left(directory)):
        return [f"the earlier set is not whole: {difference(found, olds[-1])}"]
    return []


def next_run(bench, name, state, where, new):
    """The same command again, with nothing in its way."""
    directory = where / OUT
    again = bench.run(bench.words(name), where)
    if again.code != 0:
        return [f"the next run: exit {again.code}: {again.err.strip()[-200:]}"]
    if not is_one_of(contents(directory), [new], name in MEASURED, directory):
        return [f"the next run left another set: {difference(contents(directory), new)}"]
    if left(directory) or not fits(directory):
        return [f"the next run left {left(directory)}, record fits: {fits(directory)}"]
    if state == "foreign" and (directory / "notes.txt").read_text() != "mine\n":
        return ["a foreign file was changed"]
    return []


def difference(one, other):
    """The names that two directories differ in, in words."""
    differ = [name for name in sorted({*one, *other}) if one.get(name) != other.get(name)]
    return ", ".join(f"{n} {'extra' if n not in other else 'missing' if n not in one else 'differs'}" for n in differ[:6])


# --- faults -------------------------------------------------------------------------------------------------------------------


def plans(bench, names, states):
    """Every fault of every call: command, state, calls that fail from when on, how it is called."""
    made = []
    for name, state in itertools.product(names, states):
        for call, ordinal, text in bench.calls(name, state):
            for error in ERRORS[call]:
                made.append((name, state, [(call, error.rstrip("!"), ordinal, False)], text))
                if not error.endswith("!"):
                    made.append((name, state, [(call, error, ordinal, True)], text))
    return made


def dying(bench, names, states):
    """From each call on that changes something, all such calls fail: the disk is gone."""
    made, dead = [], ("openat", "write", "fsync", "renameat", "unlinkat", "mkdir", "rmdir")
    for name, state in itertools.product(names, states):
        counts = {}
        calls = bench.calls(name, state)
        first = {call: ordinal for call, ordinal, _ in reversed(calls)}
        for call, ordinal, text in calls:
            if call in dead:
                spec = [(one, "EIO", counts.get(one, first.get(one, 1) - 1) + 1, True) for one in dead]
                made.append((name, state, spec, text))
            counts[call] = ordinal
    return made


def fault(bench, plan):
    """One run with a fault; whether it came, and what is wrong then."""
    name, state, spec, text = plan
    where = bench.copy(name, state)
    log = where.with_suffix(".trace")
    prefix = bench.tracer(sorted({one[0] for one in spec}), log)
    for call, error, when, lasting in spec:
        prefix += ["-e", f"inject={call}:error={error}:when={when}{'+' if lasting else ''}"]
    run = bench.run(bench.words(name), where, prefix)
    came = "(INJECTED)" in log.read_text(errors="replace")
    run.line = run.line.replace(str(log), os.devnull)
    cleared = not any(call in CLEARING for call, _, _, _ in spec)
    silenced = any(call == "write" and lasting for call, _, _, lasting in spec)
    faults = judged(bench, name, state, where, run, cleared, silenced)
    log.unlink()
    shutil.rmtree(where)
    return came, [f"{one}\n      {bench.how(name, state, run)}\n      at: {text[:120]}" for one in faults]


def sampled(bench, plans_, most):
    plans_ = list(plans_)
    bench.rng.shuffle(plans_)
    return plans_[:most] if most is not None else plans_


def in_parallel(bench, work, items):
    with ThreadPoolExecutor(bench.options.jobs) as pool:
        return list(pool.map(work, items))


def needs_strace(bench):
    if not bench.strace:
        raise Skip("needs strace and the right to trace")


def chosen(bench):
    names = list(COMMANDS) if bench.options.full else ["rotary-dxf", "rotary", "laws"]
    return names, STATES


def failing(bench, wrong, make, most):
    needs_strace(bench)
    made = make(bench, *chosen(bench))
    tried = sampled(bench, made, most)
    came = 0
    for hit, faults in in_parallel(bench, lambda plan: fault(bench, plan), tried):
        came += hit
        wrong.extend(faults)
    single = sum(1 for plan in tried if len(plan[2]) == 1 and not plan[2][0][3])
    starts = len({plan[:2] for plan in tried})
    return f"{len(tried)} of {len(made)} faults ({single} single, {len(tried) - single} lasting; {came} came) over {starts} commands × states"


def single_and_lasting(bench, wrong):
    return failing(bench, wrong, plans, bench.options.faults or (None if bench.options.full else 110))


def disk_gone(bench, wrong):
    most = bench.options.faults and bench.options.faults // 4
    return failing(bench, wrong, dying, most or (None if bench.options.full else 30))


def taking_back(bench, wrong):
    """A fault, and what was begun cannot be cleared away either."""
    def make(bench, names, states):
        made = []
        for name, state, spec, text in plans(bench, names, states):
            if spec[0][0] in ("fsync", "renameat", "write") and spec[0][1] == "EIO":
                made.append((name, state, [*spec, ("unlinkat", "EIO", 1, True), ("rmdir", "EIO", 1, True)], text))
        return made
    most = bench.options.faults and bench.options.faults // 8
    return failing(bench, wrong, make, most or (None if bench.options.full else 20))


# --- kills --------------------------------------------------------------------------------------------------------------------

# Calls that change nothing need no kill of their own.
KILLED = ("mkdir", "openat", "write", "fsync", "renameat", "unlinkat", "fchmod", "flock", "getdents64")


def killed(bench, plan):
    """One run that is killed, and a run after it: the same, one of another set, or another command."""
    name, state, (call, ordinal, text), after = plan
    where = bench.copy(name, state)
    prefix = [*bench.tracer([call]), "-e", f"inject={call}:signal=KILL:when={ordinal}"]
    run = bench.run(bench.words(name), where, prefix)
    came = run.code == -signal.SIGKILL
    directory, (_, olds) = where / OUT, bench.start(name, state)
    new = {} if name in MEASURED else bench.after(name, state)
    if after is None or name in MEASURED:
        faults = judged(bench, name, state, where, run)
    else:
        faults = torn(directory, contents(bench.start(name, state)[0] / OUT), [*olds, new], False) if left(directory) else []
        faults += follow(bench, name, state, where, after, new)
    shutil.rmtree(where)
    return came, [f"{one}\n      {bench.how(name, state, run)}; next: {after}\n      before: {text[:120]}" for one in faults]


def follow(bench, name, state, where, after, new):
    """Another run than the one that was killed finishes or discards that one's set, and writes its own."""
    directory = where / OUT
    found = contents(directory)
    stands = COMMIT in found and state != "cut"
    whole = {file: content for file, content in found.items() if not is_left(file)}
    run = bench.run(bench.words(*after), where)
    if run.code != 0:
        return [f"the next run: exit {run.code}: {run.err.strip()[-200:]}"]
    if stands or whole == new:
        expected = [bench.after(name, state, 0, after)]
    elif state == "cut":
        expected = [bench.after(name, state, 0, after), bench.after(*after_of(name, state, after))]
    else:
        expected = [bench.after(*after_of(name, state, after))]
    if contents(directory) not in expected or left(directory) or not fits(directory):
        return [f"the next run left another set: {difference(contents(directory), expected[0])}"]
    return []


def after_of(name, state, after):
    """The key of the set that the next run makes where the killed one had done nothing: it is of another command, perhaps."""
    other, variant = after
    return name, state, variant, after if other != name else None


def kills(bench, wrong):
    needs_strace(bench)
    names, states = chosen(bench)
    made = []
    for name, state in itertools.product(names, states):
        for call in bench.calls(name, state):
            if call[0] in KILLED:
                made += [(name, state, call, after) for after in (None, (name, 2))]
    tried = sampled(bench, made, bench.options.faults and bench.options.faults // 2 or (None if bench.options.full else 60))
    came = 0
    for hit, faults in in_parallel(bench, lambda plan: killed(bench, plan), tried):
        came += hit
        wrong.extend(faults)
    return f"{len(tried)} of {len(made)} kills ({came} came) over {len({plan[:2] for plan in tried})} commands × states"


def kills_then_another_command(bench, wrong):
    """A cut-off set of one command is finished or discarded by a run of another, under another stem."""
    needs_strace(bench)
    calls = [call for call in bench.calls("rotary-dxf", "old") if call[0] in KILLED]
    new, old = bench.after("rotary-dxf", "old"), bench.start("rotary-dxf", "old")[1][0]
    for call, ordinal, _ in calls:
        where = bench.copy("rotary-dxf", "old")
        prefix = [*bench.tracer([call]), "-e", f"inject={call}:signal=KILL:when={ordinal}"]
        run = bench.run(bench.words("rotary-dxf"), where, prefix)
        stands = (where / OUT / COMMIT).exists()
        second = bench.run(["laws", "feeder", "--out", OUT, "--name", "laws"], where)
        found = contents(where / OUT)
        expected = new["cam.dxf"] if stands else None
        if second.code != 0 or left(where / OUT) or not fits(where / OUT):
            wrong.add(f"exit {second.code}, left {left(where / OUT)}: {second.err[-200:]}", run.line)
        elif found["cam.dxf"] not in ([expected] if expected else [old["cam.dxf"], new["cam.dxf"]]) or "laws.csv" not in found:
            wrong.add("the earlier set is not in its place", run.line)
        shutil.rmtree(where)
    return f"{len(calls)} kills"


# --- order --------------------------------------------------------------------------------------------------------------------


def order(bench, wrong):
    """What a power cut could lose: each file is synced before the record, the record before the files, these before its removal."""
    needs_strace(bench)
    names = chosen(bench)[0]
    for name, state in itertools.product(names, ("none", "old")):
        where = bench.copy(name, state)
        log = where.with_suffix(".trace")
        tracer = ["strace", "-f", "-y", "-o", str(log), "-e", "trace=write,fsync,renameat,unlinkat"]
        run = bench.run(bench.words(name), where, tracer)
        unsynced, step = set(), "staging"
        for line in log.read_text(errors="replace").splitlines():
            call = re.match(r"\d+ +(\w+)\((.*)", line)
            if not call or OUT not in line:
                continue
            path = re.match(r"\d+<([^>]*)>", call[2])
            handle = path[1] if path else ""
            if call[1] == "write":
                unsynced.add(handle)
            elif call[1] == "fsync":
                unsynced.discard(handle)
                if handle.endswith(OUT):
                    step = {"renamed": "recorded", "placing": "placed"}.get(step, step)
            elif call[1] == "renameat" and re.findall(r'"([^"]*)"', line)[-1] == COMMIT:
                if unsynced:
                    wrong.add(f"not synced before the record: {unsynced}", run.line)
                step = "renamed"
            elif call[1] == "renameat":
                if step not in ("recorded", "placing"):
                    wrong.add("a file is put in place before the record is synced", run.line)
                step = "placing"
            elif call[1] == "unlinkat" and step != "placed":
                wrong.add("the record is removed before the files are synced", run.line)
        log.unlink()
        shutil.rmtree(where)
    return f"{len(names) * 2} traces"


# --- writers and readers ------------------------------------------------------------------------------------------------------


def two_writers(bench, wrong):
    """Two runs with other inputs write the same names at the same time; some slowed down, some killed."""
    rounds, busy = bench.options.rounds, 0
    where = bench.case()
    directory = where / OUT
    counts = {"plain": 0, "slow": 0, "killed": 0}
    for number in range(rounds):
        name = ("rotary-dxf", "rotary", "make")[number // 8 % 3]
        if number % 4 == 0:
            shutil.rmtree(where / "deep", ignore_errors=True)
        sets = [bench.after(name, "none", variant) for variant in (0, 1)]
        kind = ("plain", "slow", "killed")[number % 3] if bench.strace else "plain"
        counts[kind] += 1
        prefixes = [[], []]
        if kind == "slow":
            prefixes[number % 2] = [*bench.tracer(["renameat"]), "-e", "inject=renameat:delay_enter=20000"]
        if kind == "killed":
            when = bench.rng.randint(1, 3)
            prefixes[0] = [*bench.tracer(["renameat"]), "-e", f"inject=renameat:signal=KILL:when={when}:delay_enter=20000"]
        both = [bench.begun(bench.words(name, variant), where, prefixes[variant]) for variant in (0, 1)]
        runs = [bench.ended(process) for process in both]
        for variant, run in enumerate(runs):
            if run.code == -signal.SIGKILL and kind == "killed" and variant == 0:
                continue
            if run.code == 2 and "another run of camgen" in run.err:
                busy += 1
            elif run.code != 0:
                wrong.add(f"round {number} ({kind}): exit {run.code}: {run.err.strip()[-200:]}", run.line)
        if kind == "killed" and runs[0].code == -signal.SIGKILL:
            runs.append(bench.run(bench.words(name, 1), where))
            sets = sets[1:]
        found = contents(directory)
        if found not in sets or not fits(directory):
            wrong.add(f"round {number} ({kind}): a mixed set: {difference(found, sets[0])}", " & ".join(run.line for run in runs))
            shutil.rmtree(where / "deep", ignore_errors=True)
    told = ", ".join(f"{count} {kind}" for kind, count in counts.items() if count)
    return f"{rounds} rounds ({told}); {busy} told that the other was at work"


def reader(bench, wrong):
    """A reader opens all names again and again while two sets replace each other: each is there, and whole."""
    where = bench.case()
    bench.must("rotary", 0, where)
    first, second = ({n: c for n, c in bench.after("rotary", "none", v).items()} for v in (0, 1))
    bytes_ = {}
    for variant in (0, 1):
        bench.must("rotary", variant, where)
        bytes_[variant] = {name: (where / OUT / name).read_bytes() for name in (first, second)[variant]}
    over, counts = threading.Event(), {"runs": 0}

    def write():
        end = time.monotonic() + (30 if bench.options.full else 8)
        slow = [*bench.tracer(["renameat", "unlinkat"]), "-e", "inject=renameat,unlinkat:delay_exit=2000"]
        while time.monotonic() < end:
            counts["runs"] += 1
            prefix = slow if bench.strace and counts["runs"] % 2 else ()
            run = bench.run(bench.words("rotary", counts["runs"] % 2), where, prefix)
            if run.code != 0:
                wrong.add(f"exit {run.code}: {run.err[-200:]}", run.line)
        over.set()

    writer = threading.Thread(target=write)
    writer.start()
    polls, seen_ = 0, set()
    while not over.is_set():
        for name in first:
            polls += 1
            try:
                with open(where / OUT / name, "rb") as file:
                    found = file.read()
            except FileNotFoundError:
                wrong.add(f"{name} is missing for a moment", "rotary, two sets alternately")
                continue
            variant = next((v for v in (0, 1) if bytes_[v][name] == found), None)
            seen_.add((name, variant))
            if variant is None:
                wrong.add(f"{name} is torn for a moment", "rotary, two sets alternately")
    writer.join()
    return f"{polls} polls over {counts['runs']} runs; both sets seen of {sum((n, 0) in seen_ and (n, 1) in seen_ for n in first)} names"


# --- disks, pipes, modes, names -----------------------------------------------------------------------------------------------


def must_be_old(bench, name, state, where, run, wrong, words=None):
    """Exit 2, words, and nothing changed."""
    start = seen(bench.start(name, state)[0])
    if run.code != 2 or run.panicked() or not run.err.strip():
        wrong.add(f"exit {run.code}, not 2: {run.err.strip()[-200:]}", bench.how(name, state, run))
    if seen(where) != start:
        wrong.add(f"something was changed: {difference(seen(where), start)}", bench.how(name, state, run))
    if words and words not in run.err:
        wrong.add(f"it is not told: {run.err.strip()[-200:]}", bench.how(name, state, run))


def done(*line):
    """Whether a command of the system can be had, and does its work."""
    line = [str(word) for word in line]
    return shutil.which(line[0]) is not None and subprocess.run(line, capture_output=True, check=False).returncode == 0


def small_disks(bench, wrong):
    """Disks of every small size, full somewhere between the first byte and the last."""
    tried, outcomes = 0, {}
    sizes = [(name, size) for name, sizes in (("rotary-dxf", range(4, 61, 4)), ("rotary", range(500, 1101, 40)))
             for size in sizes]
    step = 1 if bench.options.full else 2
    for (name, size), state in itertools.product(sizes[::step], ("none", "old")):
        where = bench.case()
        if not done("mount", "-t", "tmpfs", "-o", f"size={size}k", "tmpfs", where):
            raise Skip("needs the right to mount")
        try:
            if state == "old":
                shutil.copytree(bench.start(name, "old")[0], where, dirs_exist_ok=True)
            tried += 1
            run = bench.run(bench.words(name), where)
            outcomes[run.code] = outcomes.get(run.code, 0) + 1
            faults = judged_on_disk(bench, name, state, where, run)
            for one in faults:
                wrong.add(one, f"on a tmpfs of size={size}k: {bench.how(name, state, run)}")
        except (OSError, shutil.Error):
            pass  # Not even the older set has room.
        finally:
            done("umount", where)
    return f"{tried} disks, exit codes {outcomes}"


def judged_on_disk(bench, name, state, where, run):
    """As `judged`, without the next run, for which the disk is as small as before."""
    new, old = bench.after(name, state), bench.start(name, state)[0]
    if run.code == 0:
        return [] if contents(where / OUT) == new else ["exit 0, and not the new set"]
    if run.code == 2 and KEPT not in run.err:
        return [] if seen(where) == seen(old) else [f"something was changed: {difference(seen(where), seen(old))}"]
    return [f"exit {run.code}: {run.err[-200:]}"]


def standard_output(bench, wrong):
    """What cannot be told is not written."""
    tried = 0
    for name, state in itertools.product(chosen(bench)[0], ("none", "old")):
        where = bench.copy(name, state)
        with open("/dev/full", "wb") as full:
            run = bench.run(bench.words(name), where, stdout=full)
        run.line += " > /dev/full"
        must_be_old(bench, name, state, where, run, wrong, "standard output")
        for shell in ('exec "$@" >&-', 'exec "$@" >&- 2>&-', 'exec "$@" <&- >&- 2>&-', '"$@" | :; exit 0', 'exec "$@" 2>/dev/full'):
            tried += 1
            where = bench.copy(name, state)
            run = bench.run(bench.words(name), where, ["sh", "-c", shell, "sh"])
            faults = judged(bench, name, state, where, run)
            for one in faults:
                wrong.add(one, bench.how(name, state, run))
            shutil.rmtree(where)
    return f"{tried + tried // 5} runs"


def limits(bench, wrong):
    """Files that outgrow the limit of the shell."""
    tried = 0
    for name, state in itertools.product(("rotary-dxf", "rotary"), ("none", "old")):
        for blocks in (0, 1, 2, 4, 17, 18, 20, 100, 229, 240, 484, 1000):
            tried += 1
            where = bench.copy(name, state)
            run = bench.run(bench.words(name), where, ["sh", "-c", f'ulimit -f {blocks}; exec "$@"', "sh"])
            if run.code == 2:
                must_be_old(bench, name, state, where, run, wrong)
            else:
                for one in judged(bench, name, state, where, run):
                    wrong.add(one, bench.how(name, state, run))
            shutil.rmtree(where)
    return f"{tried} limits"


def until(what, patience=PATIENCE):
    """Waits until something is so."""
    end = time.monotonic() + patience
    while time.monotonic() < end:
        if what():
            return True
        time.sleep(0.002)
    return False


def staged_in(directory):
    return Path(directory).is_dir() and any(name.startswith(STAGED) for name in os.listdir(directory))


def moved(bench, wrong):
    """The directory is renamed, removed or replaced while files are made for it."""
    needs_strace(bench)
    slow = [*bench.tracer(["fsync"]), "-e", "inject=fsync:delay_enter=600000:when=1"]
    for replaced in ("gone", "directory", "symlink", "file"):
        where = bench.copy("rotary-dxf", "old")
        out, away, other = where / OUT, where / "away", where / "other"
        other.mkdir()
        process = bench.begun(bench.words("rotary-dxf"), where, slow)
        until(lambda out=out: staged_in(out))
        out.rename(away)
        {"gone": lambda: None, "directory": out.mkdir, "symlink": lambda: out.symlink_to(other),
         "file": lambda: out.write_text("mine\n")}[replaced]()
        run = bench.ended(process)
        if run.code != 2 or run.panicked():
            wrong.add(f"{replaced}: exit {run.code}: {run.err[-200:]}", run.line)
        if contents(away) != bench.start("rotary-dxf", "old")[1][0] or os.listdir(other):
            wrong.add(f"{replaced}: something was changed: {sorted(os.listdir(away))} {os.listdir(other)}", run.line)
        if replaced == "directory" and os.listdir(out):
            wrong.add(f"{replaced}: something was written: {os.listdir(out)}", run.line)
    where = bench.copy("rotary-dxf", "old")
    out, away = where / OUT, where / "away"
    late = [*bench.tracer(["renameat"]), "-e", "inject=renameat:delay_enter=600000:when=2"]
    process = bench.begun(bench.words("rotary-dxf"), where, late)
    until(lambda: (out / COMMIT).exists())
    out.rename(away)
    run = bench.ended(process)
    if contents(away) != bench.after("rotary-dxf", "old") or run.code not in (0, 2):
        wrong.add(f"moved in the last step: exit {run.code}: {sorted(os.listdir(away))}", run.line)
    return "5 moves"


def given(where, user):
    for path in [where, *where.rglob("*")]:
        os.chown(path, user, user)


def unprivileged(bench, wrong):
    """A user who may not write into the directory, or not make it."""
    if os.geteuid() != 0:
        raise Skip("needs the superuser, to become another user")
    who = {"user": NOBODY, "group": NOBODY, "extra_groups": []}
    for state, user in (("old", 0), ("none", 0), ("old", NOBODY), ("none", NOBODY)):
        where = bench.copy("rotary-dxf", state)
        given(where, user)
        os.chmod(where / OUT if state == "old" else where, 0o555)
        before = seen(where)
        try:
            run = bench.run(bench.words("rotary-dxf"), where, **who)
        except PermissionError as error:
            raise Skip("needs a directory and a binary that every user may reach") from error
        if run.code != 2 or run.panicked() or "ermission denied" not in run.err:
            wrong.add(f"{state}: exit {run.code}: {run.err[-200:]}", run.line)
        if seen(where) != before:
            wrong.add(f"{state}: something was changed: {difference(seen(where), before)}", run.line)
    # His own directory with files of another user, who allows nothing: they are replaced, or nothing is.
    where = bench.copy("rotary-dxf", "old")
    given(where, NOBODY)
    os.chown(where / OUT / "cam.dxf", 0, 0)
    run = bench.run(bench.words("rotary-dxf"), where, **who)
    if run.code != 0 or contents(where / OUT) != bench.after("rotary-dxf", "old"):
        wrong.add(f"a file of another user: exit {run.code}: {run.err[-200:]}", run.line)
    return "5 directories as another user"


def obstructed(kind, file):
    """Makes a file that can be read and not be replaced; how that is undone, and who runs then. `None` where it cannot be made."""
    if kind == "sticky":
        if os.geteuid() != 0:
            return None
        given(file.parent.parent.parent, NOBODY)
        os.chown(file, 0, 0)
        os.chown(file.parent, 0, 0)
        os.chmod(file.parent, 0o1777)
        return ["chown", str(NOBODY), str(file)], {"user": NOBODY, "group": NOBODY, "extra_groups": []}
    do, undo = {"mount": (["mount", "--bind", file, file], ["umount", file]),
                "immutable": (["chattr", "+i", file], ["chattr", "-i", file])}[kind]
    return ([str(word) for word in undo], {}) if done(*do) else None


def in_the_way(bench, wrong):
    """A file that only its rename finds not to be replaceable: another user's in a sticky directory, one that is mounted, one that
    is immutable. Nothing is written, or at least the set is not mixed for good."""
    tried = []
    for kind, name in itertools.product(("sticky", "mount", "immutable"), ("cam.svg", RECORD)):
        where = bench.copy("rotary", "old")
        out, old, new = where / OUT, contents(where / OUT), bench.after("rotary", "old")
        made = obstructed(kind, out / name)
        if made is None:
            continue
        undo, who = made
        try:
            runs = [bench.run(bench.words("rotary"), where, **who) for _ in range(2)]
            found = {n: c for n, c in contents(out).items() if not is_left(n)}
        except PermissionError:
            continue  # The other user does not reach the directory or the binary.
        finally:
            done(*undo)
        tried.append(kind)
        if found not in (old, new):
            took = sorted(n for n in found if found[n] == new.get(n))
            wrong.add(f"{kind} {name}: after two runs (exit {[run.code for run in runs]}) the set is mixed, new are {took}; "
                      f"the second said: {runs[1].err.strip()[-200:]}", f"{bench.how('rotary', 'old', runs[0])}; twice; {name} is {kind} before (undone by: {shlex.join(undo)})")
        last = bench.run(bench.words("rotary"), where, **who)
        if last.code != 0 or contents(out) != new:
            wrong.add(f"{kind} {name}: out of the way, and exit {last.code}: {last.err[-200:]}", last.line)
    if not tried:
        raise Skip("needs the superuser, and a directory and a binary that every user may reach")
    return f"{len(tried)} files ({', '.join(sorted(set(tried)))})"


def signals(bench, wrong):
    """Before the record a signal leaves nothing behind; after it all is put in place first."""
    needs_strace(bench)
    tried, ends = 0, {}
    for name, state in itertools.product(("rotary-dxf", "rotary"), ("none", "old")):
        calls = [call for call in bench.calls(name, state) if call[0] in ("fsync", "renameat", "openat", "write", "unlinkat", "flock")]
        # What a thread's memory asks of the system comes or not by timing, and would be counted as a later call.
        calls = [call for call in calls if "/proc/" not in call[2]]
        recorded = next(i for i, call in enumerate(calls) if call[0] == "renameat")
        told = next(i for i, call in enumerate(calls) if call[2].startswith("write(1"))
        for index, (call, ordinal, text) in enumerate(calls):
            if not bench.options.full and bench.rng.random() > 0.3:
                continue
            number = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)[index % 3]
            where = bench.copy(name, state)
            prefix = [*bench.tracer([call]), "-e", f"inject={call}:signal={number.name}:when={ordinal}"]
            run = bench.run(bench.words(name), where, prefix)
            tried += 1
            ends[run.code] = ends.get(run.code, 0) + 1
            found, same = contents(where / OUT), seen(where) == seen(bench.start(name, state)[0])
            # Signals are held once the directory is open: just before that the one that was made for it may stay, empty.
            same = same or state == "none" and not any(path.is_file() for path in where.rglob("*"))
            new = found == bench.after(name, state) and not left(where / OUT)
            if run.code not in (0, 2, -number, 128 + number):
                wrong.add(f"exit {run.code} by {number.name}", bench.how(name, state, run))
            if not (same or new):
                wrong.add(f"neither the old set nor the new one: {sorted(found)}", bench.how(name, state, run))
            elif index <= told and not same:
                wrong.add(f"{number.name} before the record, and the set was written: {text[:80]}", bench.how(name, state, run))
            elif index > recorded and not new:
                wrong.add(f"{number.name} after the record, and the set is not written: {text[:80]}", bench.how(name, state, run))
            shutil.rmtree(where)
    return f"{tried} signals, exit codes {ends}"


def ignored(bench, wrong):
    """Signals that are to be ignored, as nohup asks, are: the set is written."""
    needs_strace(bench)
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        where = bench.copy("rotary-dxf", "old")
        call = "fsync"
        prefix = [*bench.tracer([call]), "-e", f"inject={call}:signal={number.name}:when=1"]
        ignore = f"trap '' {number.name.removeprefix('SIG')}; exec \"$@\""
        run = bench.run(bench.words("rotary-dxf"), where, ["sh", "-c", ignore, "sh", *prefix])
        if run.code != 0 or contents(where / OUT) != bench.after("rotary-dxf", "old"):
            wrong.add(f"{number.name} is ignored: exit {run.code}: {run.err.strip()[-200:]}", run.line)
    return "3 signals"


def modes(bench, wrong):
    """The mask of the user for new files; what the old ones had for those that replace them."""
    for mask in (0o077, 0o022, 0o002, 0o027):
        where = bench.case()
        run = bench.run(bench.words("rotary-dxf"), where, umask=mask)
        wanted = 0o666 & ~mask
        found = {p.name: stat.S_IMODE(p.stat().st_mode) for p in (where / OUT).iterdir()}
        if set(found.values()) != {wanted} or stat.S_IMODE((where / OUT).stat().st_mode) != 0o777 & ~mask:
            wrong.add(f"umask {mask:03o}: {({n: oct(m) for n, m in found.items()})}", run.line)
    for mode, mask in ((0o640, 0o022), (0o600, 0o022), (0o666, 0o077), (0o444, 0o022), (0o755, 0o022)):
        where = bench.copy("rotary-dxf", "old")
        os.chmod(where / OUT / "cam.dxf", mode)
        if os.geteuid() == 0:
            os.chown(where / OUT / "cam.dxf", 1234, 4321)
        before = entry(where / OUT / "cam.dxf")
        run = bench.run(bench.words("rotary-dxf"), where, umask=mask)
        after = entry(where / OUT / "cam.dxf")
        if run.code != 0 or after[2:] != before[2:] or after[1] == before[1]:
            wrong.add(f"mode {mode:o} of {before[3:]}: {after[2]:o} of {after[3:]}, exit {run.code}", run.line)
    return "4 masks, 5 modes"


def nothing_of_it(bench, wrong, what, set_up, word=None, name="rotary-dxf"):
    """With something odd in the way: exit 2, words, and all as it was."""
    where = bench.copy(name, "old")
    set_up(where / OUT, where)
    before = seen(where)
    run = bench.run(bench.words(name), where)
    if run.code != 2 or run.panicked() or not run.err.strip() or (word or "") not in run.err:
        wrong.add(f"{what}: exit {run.code}: {run.err.strip()[-200:]}", run.line)
    if seen(where) != before:
        wrong.add(f"{what}: something was changed: {difference(seen(where), before)}", run.line)
    return run


def replaced(make):
    """The target is replaced by something else."""
    def set_up(out, where):
        (out / "cam.dxf").unlink()
        make(out / "cam.dxf", where)
    return set_up


def listening(path):
    with socket.socket(socket.AF_UNIX) as one:
        here = os.getcwd()
        os.chdir(path.parent)
        one.bind(path.name)
        os.chdir(here)


def odd_names(bench, wrong):
    """Things in the places of files that are none."""
    def link_to(path, where):
        (where / "mine.dxf").write_text("mine\n")
        path.symlink_to(where / "mine.dxf")
    odd = {
        "a symlink": (replaced(link_to), "symbolic link"),
        "a broken symlink": (replaced(lambda path, where: path.symlink_to(where / "none")), "symbolic link"),
        "a pipe": (replaced(lambda path, where: os.mkfifo(path)), "not a regular file"),
        "a directory": (replaced(lambda path, where: path.mkdir()), "a directory"),
        "a socket": (replaced(lambda path, where: listening(path)), "not a regular file"),
    }
    for what, (set_up, word) in odd.items():
        nothing_of_it(bench, wrong, f"{what} in the place of a target", set_up, word)
    for what, make in (("a pipe", os.mkfifo), ("a directory", os.mkdir), ("a symlink", lambda p: os.symlink("/dev/zero", p))):
        def set_up(out, where, make=make):
            (out / RECORD).unlink()
            make(out / RECORD)
        nothing_of_it(bench, wrong, f"{what} in the place of {RECORD}", set_up)
    return "8 odd things"


def records(bench, wrong):
    """Records of a cut-off run that none wrote: refused in words, or of no effect; never followed out of the directory."""
    def text(content):
        return lambda out, where: (out / COMMIT).write_bytes(content)
    def whole(entries):
        return text(json.dumps(entries).encode())
    def sparse(out, where):
        with open(out / COMMIT, "wb") as file:
            file.truncate(1 << 27)
    out_of_it = [{"staged": ".camgen-new-1-0", "target": "../../mine"}]
    garbage = {
        "garbage": text(b"\x00garbage"), "empty": text(b""), "half a record": text(b'[{"staged":".camgen-new-1-0","tar'),
        "another type": text(b"{}"), "out of the directory": whole(out_of_it), "too large": sparse,
        "a path that is staged": whole([{"staged": ".camgen-new-/../x", "target": "cam.dxf"}]),
        "not a staged file": whole([{"staged": "notes.txt", "target": "cam.dxf"}]),
    }
    harmless = {
        "of files that are gone": whole([{"staged": ".camgen-new-1-0", "target": "cam.dxf"}]), "of nothing": whole([]),
        "a pipe": lambda out, where: os.mkfifo(out / COMMIT),
        "a symlink": lambda out, where: (out / COMMIT).symlink_to("/dev/zero"),
        "a directory": lambda out, where: (out / COMMIT).mkdir(),
        "a directory that is to be staged": lambda out, where: (out / f"{STAGED}x").mkdir(),
    }
    for what, set_up in {**garbage, **harmless}.items():
        where = bench.copy("rotary-dxf", "old")
        set_up(where / OUT, where)
        before = os.lstat(where / OUT / COMMIT) if os.path.lexists(where / OUT / COMMIT) else None
        run = bench.run([*bench.words("rotary-dxf"), "--quiet"], where)
        if run.code != 0 or run.panicked():
            wrong.add(f"a record: {what}: exit {run.code}: {run.err[-200:]}", run.line)
        found = {name: content for name, content in contents(where / OUT).items() if not is_left(name)}
        if run.code == 0 and found != bench.after("rotary-dxf", "old"):
            wrong.add(f"a record: {what}: exit 0, and {sorted(os.listdir(where / OUT))}", run.line)
        stays = what in garbage or what in ("a pipe", "a symlink", "a directory")
        if stays and (os.lstat(where / OUT / COMMIT).st_ino != before.st_ino or f"{COMMIT}`" not in run.err):
            wrong.add(f"a record: {what}: it is not told and left: {run.err.strip()[-200:]}", run.line)
    return f"{len(garbage) + len(harmless)} records"


def left_behind(bench, wrong):
    """What was left by others under names of camgen's own: a next run is not stopped by it for good."""
    def odd(out):
        with open(os.fsencode(out) + b"/" + STAGED.encode() + b"\xff", "wb") as file:
            file.write(b"x")
    def many(out):
        for number in range(3000):
            (out / f"{STAGED}{number}-0").write_text("x")
    def link(out):
        (out / f"{STAGED}1-0").symlink_to("cam.dxf")
    for what, set_up in (("a name that is no UTF-8", odd), ("3000 files", many), ("a symlink", link)):
        where = bench.copy("rotary-dxf", "old")
        set_up(where / OUT)
        run = bench.run(bench.words("rotary-dxf"), where)
        # camgen's own names are plain letters: the one that is not belongs to somebody else, and stays.
        foreign = os.fsencode(where / OUT) + b"/" + STAGED.encode() + b"\xff"
        if os.path.lexists(foreign):
            os.unlink(foreign)
        if run.code != 0 or left(where / OUT) or contents(where / OUT) != bench.after("rotary-dxf", "old"):
            wrong.add(f"{what} left behind: exit {run.code}: {run.err.strip()[-200:]}", run.line)
    # Names that no run gives are of somebody else's files.
    mine = [f"{STAGED}notes.txt", f"{STAGED}1", f"{STAGED}1-x", f"{STAGED}-1", f"{COMMIT}s", f"{COMMIT}-new-x"]
    where = bench.copy("rotary-dxf", "old")
    for name in mine:
        (where / OUT / name).write_text("mine\n")
    (where / OUT / f"{STAGED}1-0").mkdir()
    run = bench.run(bench.words("rotary-dxf"), where)
    if run.code != 0 or left(where / OUT) != sorted([*mine, f"{STAGED}1-0"]):
        wrong.add(f"files of its user's own: exit {run.code}, there are {left(where / OUT)}: {run.err.strip()[-200:]}", run.line)
    return f"{3 + len(mine)} leftovers"


# --- directories that users share ---------------------------------------------------------------------------------------------

USERS = (NOBODY, NOBODY - 1)


def as_user(user):
    return {"user": user, "group": user, "extra_groups": []}


def of_user(directory, user):
    """What a user owns in a directory, by name."""
    return {path.name: entry(path) for path in Path(directory).iterdir() if os.lstat(path).st_uid == user}


def shared(bench, wrong):
    """Two users write into a sticky directory, and are killed at random places: nobody is stopped, and nobody's files are touched."""
    needs_strace(bench)
    if os.geteuid() != 0:
        raise Skip("needs the superuser, to become two other users")
    where = bench.case()
    out = where / OUT
    out.mkdir(parents=True)
    os.chmod(out, 0o1777)

    def words(stem, variant):
        return ["rotary", "--rpm", "35", "--format", "dxf,csv", *((), RADIUS)[variant], "--out", OUT, "--name", stem, "--quiet"]

    def whole(stem, variant):
        """The set of a stem."""
        case = bench.case()
        run = bench.run(words(stem, variant), case)
        assert run.code == 0, run.err
        return {name: content for name, content in contents(case / OUT).items() if name != RECORD}

    sets = {(user, variant): whole(f"cam{index}", variant) for index, user in enumerate(USERS) for variant in (0, 1)}
    try:
        if bench.run(["--version"], where, **as_user(NOBODY)).code != 0:
            raise Skip("needs a binary that every user may reach")
    except PermissionError as error:
        raise Skip("needs a directory and a binary that every user may reach") from error
    kills, refused, calls = 0, 0, ("openat", "write", "fsync", "renameat", "unlinkat", "getdents64")
    for number in range(bench.options.rounds):
        user = bench.rng.choice(USERS)
        other, stem, variant = USERS[user == USERS[0]], f"cam{USERS.index(user)}", number % 2
        theirs = of_user(out, other)
        call = bench.rng.choice(calls)
        kill = [*bench.tracer([call]), "-e", f"inject={call}:signal=KILL:when={bench.rng.randint(1, {'openat': 30, 'write': 12}.get(call, 6))}"]
        run = bench.run(words(stem, variant), where, kill, **as_user(user))
        kills += run.code == -signal.SIGKILL
        if run.code not in (0, -signal.SIGKILL):
            wrong.add(f"round {number}: user {user} is stopped: exit {run.code}: {run.err.strip()[-200:]}", run.line)
        # One round in three the other goes on first, beside what was left.
        turns = [other, user] if number % 3 == 0 else [user]
        for one in turns:
            rest = of_user(out, USERS[one == USERS[0]])
            again = bench.run(words(f"cam{USERS.index(one)}", variant), where, **as_user(one))
            mine = of_user(out, one)
            found = {name: data[1] for name, data in mine.items() if name in sets[one, variant]}
            if again.code != 0 or found != sets[one, variant] or any(is_left(name) for name in mine):
                wrong.add(f"round {number}: user {one} is stopped or has another set: exit {again.code}, {sorted(mine)}: {again.err.strip()[-300:]}", again.line)
            if of_user(out, USERS[one == USERS[0]]) != rest:
                wrong.add(f"round {number}: user {one} has touched what the other has", again.line)
        if len(turns) == 1 and of_user(out, other) != theirs:
            wrong.add(f"round {number}: user {user} has touched what the other has", run.line)
        if number % 4 == 0 and theirs:
            # The name of the other's file: refused, and the file stays.
            before = of_user(out, other)
            taken = bench.run(words(f"cam{USERS.index(other)}", 1 - variant), where, **as_user(user))
            refused += taken.code == 2
            if taken.code != 2 or of_user(out, other) != before:
                wrong.add(f"round {number}: the name of another's file: exit {taken.code}: {taken.err.strip()[-200:]}", taken.line)
    # What is planted by the other under every name of camgen's own.
    for name in (RECORD, ".camgen-1.json", COMMIT, f"{COMMIT}-1", f"{STAGED}1-0"):
        if not os.path.lexists(out / name):
            (out / name).write_text("{}")
            os.chown(out / name, USERS[1], USERS[1])
    planted = of_user(out, USERS[1])
    run = bench.run(words("cam0", 0), where, **as_user(USERS[0]))
    if run.code != 0 or of_user(out, USERS[1]) != planted:
        wrong.add(f"planted names stop a user: exit {run.code}: {run.err.strip()[-300:]}", run.line)
    return f"{bench.options.rounds} rounds of two users, {kills} killed, {refused} refused for a name of the other"


def planted_records(own, stamps):
    """Records of a set as nobody but an attacker writes them: what they are, their entries, and what is staged."""
    digest, evil = siphash(b"evil\n"), b"evil\n"
    targets = ["thesis.txt", ".bashrc", "new.txt", ".profile", "new.dxf", "cam.dxf", RECORD, "cam", "link", "../mine", "sub/x", "/etc/x", "..", "", COMMIT,
               "a\npass  forged", "\x1b[31mred", ".camgen-7.json"]
    for target in targets:
        for states, stamp in (("its stamp", stamps.get(target)), ("no stamp", None), ("another stamp", "5 1.1")):
            # Alone, with the record that is there, with one that lies, and with one that says nothing.
            lying = json.dumps({"files": {**own["files"], target: digest}, "inputs": {}}).encode()
            for how, record in (("alone", None), ("with a lying record", lying), ("with an empty record", b'{"files":{},"inputs":{}}')):
                entries = [{"staged": f"{STAGED}1-0", "target": target, "replaces": stamp}]
                staged = {f"{STAGED}1-0": evil}
                if record is not None and target != RECORD:
                    entries.append({"staged": f"{STAGED}1-1", "target": RECORD, "replaces": stamps[RECORD]})
                    staged[f"{STAGED}1-1"] = record
                yield f"{target!r}, {states}, {how}", entries, staged


def planted(bench, wrong):
    """Records that somebody has put into a directory: no file but camgen's own is touched, and no run is stopped."""
    allowed = {"cam.dxf", RECORD, "new.dxf"}
    own = json.loads((bench.start("rotary-dxf", "old")[0] / OUT / RECORD).read_text())
    kinds = 0
    plans = None
    for number in itertools.count():
        where = bench.copy("rotary-dxf", "old")
        out = where / OUT
        for name in ("thesis.txt", ".bashrc"):
            (out / name).write_text("mine\n")
        (where / "mine").write_text("mine\n")
        (out / "cam").mkdir()
        (out / "link").symlink_to("../../mine")
        stamps = {}
        for path in out.iterdir():
            data = os.lstat(path)
            stamps[path.name] = f"{data.st_size} {data.st_mtime_ns // 10**9}.{data.st_mtime_ns % 10**9}"
        plans = list(planted_records(own, stamps))
        if not bench.options.full:
            bench.rng.seed(bench.options.seed)
            plans = [plans[i] for i in sorted(bench.rng.sample(range(len(plans)), 45))]
        if number >= len(plans):
            break
        what, entries, staged = plans[number]
        kinds += 1
        for name, content in staged.items():
            (out / name).write_bytes(content)
        (out / COMMIT).write_text(json.dumps(entries))
        if number % 5 == 4 and os.geteuid() == 0:
            os.chown(out / COMMIT, NOBODY, NOBODY)
        before = seen(where)
        run = bench.run(["laws", "feeder", "--out", OUT, "--name", "laws"], where)
        after = seen(where)
        touched = {Path(name).name for name in {*before, *after} if before.get(name) != after.get(name)}
        touched = {name for name in touched if not name.startswith(("laws", ".camgen"))} - allowed
        forged = [line for line in (run.out.decode(errors="replace") + run.err).splitlines() if line.startswith("pass  forged") or "\x1b" in line]
        if run.code != 0 or touched or forged or entry(out / "link")[1] != "../../mine":
            wrong.add(f"{what}: exit {run.code}, touched {sorted(touched)}, forged {forged}: {run.err.strip()[-300:]}", run.line)
        if entry(out / "cam.dxf") != before[f"{OUT}/cam.dxf"] and not fits(out):
            wrong.add(f"{what}: cam.dxf is not as the record says", run.line)
        shutil.rmtree(where)
    # What the record of the directory says of the last run is shown in one line.
    where = bench.copy("rotary-dxf", "old")
    record = json.loads((where / OUT / RECORD).read_text())
    for values in record["inputs"].values():
        values["rpm\npass  forged"] = ["1", "1\npass  forged\x1b[31m"]
        for value in values.values():
            value[1] += "\npass  forged"
    (where / OUT / RECORD).write_text(json.dumps(record))
    run = bench.run(bench.words("rotary-dxf"), where)
    if any(line.startswith("pass  forged") for line in (run.out.decode() + run.err).splitlines()) or b"\x1b" in run.out:
        wrong.add("values of the record of the directory forge a line", run.line)
    return f"{kinds} planted records, and values of a record"


def edited_meanwhile(bench, wrong):
    """A run is cut off after its record; then its user edits, makes or links a file, which the next run must not replace in silence;
    and where it is refused for another file's sake it does not say that nothing was written when it was."""
    needs_strace(bench)
    kill = [*bench.tracer(["renameat"]), "-e", "inject=renameat:signal=KILL:when=2"]

    def cut(state):
        where = bench.copy("rotary-dxf", state)
        first = bench.run(bench.words("rotary-dxf"), where, kill)
        assert (where / OUT / COMMIT).exists(), first.err
        return where, where / OUT / "cam.dxf", bench.how("rotary-dxf", state, first)

    for what, state in (("edited", "old"), ("made", "none"), ("linked", "none")):
        where, file, how = cut(state)
        mine = where / "mine"
        mine.write_text("its user's\n")
        if what == "linked":
            file.symlink_to(mine)
        else:
            file.write_text("its user's\n")
        run = bench.run(bench.words("rotary-dxf"), where)
        if file.read_text(errors="replace") != "its user's\n" or mine.read_text() != "its user's\n":
            wrong.add(f"a file that its user {what} after the run was cut off is replaced without --overwrite: exit {run.code}, "
                      f"stderr {run.err.strip()[-120:]!r}", f"{how}; its user {what} {OUT}/cam.dxf; {run.line}")
        elif run.code not in (0, 2):
            wrong.add(f"exit {run.code}: {run.err[-200:]}", run.line)
    where, file, how = cut("old")
    before = entry(file)
    (file.parent / "other.dxf").write_text("mine\n")
    run = bench.run(["rotary", "--rpm", "35", "--format", "dxf", "--out", OUT, "--name", "other"], where)
    if run.code != 2 or (entry(file) != before and "nothing was written" in run.err and "cam.dxf" not in run.err):
        wrong.add(f"it put the earlier set in place, and said: exit {run.code}: {run.err.strip()[-200:]}",
                  f"{how}; echo mine > {OUT}/other.dxf; {run.line}")
    return "4 edits"


def locked(bench, wrong):
    """Another run holds the directory: it is waited for, in vain or not."""
    def hold(seconds, words):
        where = bench.copy("rotary-dxf", "old")
        handle = os.open(where / OUT, os.O_RDONLY | os.O_DIRECTORY)
        fcntl.flock(handle, fcntl.LOCK_EX)
        begun = time.monotonic()
        process = bench.begun(bench.words("rotary-dxf"), where)
        if seconds:
            time.sleep(seconds)
            os.close(handle)
        run = bench.ended(process)
        lasted = time.monotonic() - begun
        if seconds is None:
            os.close(handle)
            must_be_old(bench, "rotary-dxf", "old", where, run, wrong, words)
            if lasted < 9.9:
                wrong.add(f"it waited for {lasted:.1f} s only", run.line)
        elif run.code != 0 or contents(where / OUT) != bench.after("rotary-dxf", "old"):
            wrong.add(f"exit {run.code} after {lasted:.1f} s: {run.err[-200:]}", run.line)
    with ThreadPoolExecutor(2) as pool:
        list(pool.map(lambda one: hold(*one), [(None, "another run of camgen"), (2, None)]))
    return "2 locks"


def given_up(bench, wrong):
    """A run makes the directory and gives up while another waits for it: that one writes all the same."""
    needs_strace(bench)
    where = bench.case()
    first = bench.begun(bench.words("rotary-dxf", 1), where,
                        [*bench.tracer(["fsync"]), "-e", "inject=fsync:error=EIO:when=1:delay_enter=1500000"])
    until(lambda: staged_in(where / OUT))
    second = bench.run(bench.words("rotary-dxf"), where)
    gone = bench.ended(first)
    if gone.code != 2:
        wrong.add(f"the first: exit {gone.code}: {gone.err[-200:]}", gone.line)
    if second.code != 0 or contents(where / OUT) != bench.after("rotary-dxf", "none"):
        wrong.add(f"the second: exit {second.code}: {second.err.strip()[-200:]}", f"{gone.line} & sleep 0.8; {second.line}")
    return "1 pair"


def no_locks(bench, wrong):
    """Where directories cannot be locked nobody knows whose the leftovers are: a run that is killed stops no later one for good."""
    needs_strace(bench)
    unlocked = ["-e", "inject=flock:error=ENOLCK:when=1+"]
    calls = [call for call in bench.calls("rotary-dxf", "old") if call[0] in ("openat", "write", "fsync", "renameat", "unlinkat")]
    for call, ordinal, text in calls:
        where = bench.copy("rotary-dxf", "old")
        kill = [*bench.tracer([call, "flock"]), *unlocked, "-e", f"inject={call}:signal=KILL:when={ordinal}"]
        first = bench.run(bench.words("rotary-dxf"), where, kill)
        second = bench.run(bench.words("rotary-dxf"), where, [*bench.tracer(["flock"]), *unlocked])
        found = {file: content for file, content in contents(where / OUT).items() if not file.startswith((STAGED, COMMIT + "-new"))}
        if second.code != 0 or found != bench.after("rotary-dxf", "old"):
            wrong.add(f"killed at {text[:70]}: exit {second.code} of every later run: {second.err.strip()[-200:]}",
                      f"{bench.how('rotary-dxf', 'old', first)}; {second.line}")
        shutil.rmtree(where)
    # In a container the number of the process is often the same each time.
    where = bench.copy("rotary-dxf", "old")
    numbered = [*bench.tracer(["flock", "getpid"]), *unlocked, "-e", "inject=getpid:retval=7"]
    (where / OUT / f"{STAGED}7-0").write_text("left\n")
    run = bench.run(bench.words("rotary-dxf"), where, numbered)
    if run.code != 0:
        wrong.add(f"a leftover of the same process number: exit {run.code}: {run.err.strip()[-200:]}", f"echo > {OUT}/{STAGED}7-0; {run.line}")
    return f"{len(calls) + 1} kills"


def own_names(bench, wrong):
    """Stems that are the names of camgen's own files: refused, or the files are there and stay."""
    stems = ((".camgen", "json"), (".camgen-new-1", "dxf"), (".camgen-new-1-0", "dxf,csv"), (".camgen-commit", "dxf"),
             (".camgen-commit-new", "dxf"), (".camgen", "dxf,json"))
    for stem, formats in stems:
        where = bench.case()
        words = ["rotary", "--rpm", "35", "--format", formats, "--out", OUT, "--name", stem]
        run = bench.run(words, where)
        if run.code == 2 and not (where / "deep").exists():
            continue
        wanted = {f"{stem}.{ending}" for ending in formats.split(",")}
        if run.code != 0 or not wanted <= set(contents(where / OUT)) or not fits(where / OUT):
            wrong.add(f"{stem} {formats}: exit {run.code}: {sorted(contents(where / OUT))}, record fits: {fits(where / OUT)}", run.line)
        second = bench.run(["laws", "feeder", "--out", OUT, "--name", "laws"], where)
        if second.code != 0 or not wanted <= set(contents(where / OUT)):
            wrong.add(f"{stem} {formats}: after a run of another name exit {second.code}: {sorted(contents(where / OUT))}: "
                      f"{second.err.strip()[-200:]}", f"{run.line}; {second.line}")
    return f"{len(stems)} stems"


def paths(bench, wrong):
    """Directories as they may be typed, made for a run that fails and for one that does not."""
    typed = ("out", "out/", "./out", ".", "a/../out", "a/b/../../out", "a/./b//c", "link", "link/sub", "to/none/x", "broken", "file/x")
    for path in typed:
        for fails in (True, False):
            where = bench.case()
            (where / "real").mkdir()
            (where / "link").symlink_to("real")
            (where / "broken").symlink_to("nowhere")
            (where / "file").write_text("mine\n")
            before = seen(where)
            prefix = ["sh", "-c", 'ulimit -f 0; exec "$@"', "sh"] if fails else ()
            run = bench.run(["rotary", "--rpm", "35", "--format", "dxf", "--out", path, "--name", "cam"], where, prefix)
            if run.panicked() or run.code not in (0, 2) or (fails and run.code == 0):
                wrong.add(f"{path}: exit {run.code}: {run.err[-200:]}", run.line)
            if run.code == 2 and seen(where) != before:
                wrong.add(f"{path}: exit 2, and {difference(seen(where), before)}", run.line)
            if run.code == 0 and not fits(where / path):
                wrong.add(f"{path}: exit 0, and that path does not lead to the files: {sorted(seen(where))}", run.line)
            if run.code == 2 and not fails and path not in ("broken", "file/x"):
                wrong.add(f"{path}: refused: {run.err.strip()[-200:]}", run.line)
    return f"{2 * len(typed)} runs"


def impatient(bench, wrong):
    """Interrupted while it waits: for another run, and for a pipe that nobody reads. It ends within a second or two, and nothing is left."""
    where = bench.copy("rotary-dxf", "old")
    handle = os.open(where / OUT, os.O_RDONLY | os.O_DIRECTORY)
    fcntl.flock(handle, fcntl.LOCK_EX)
    process = bench.begun(bench.words("rotary-dxf"), where)
    time.sleep(2)
    took = interrupted(process, where, wrong, bench, "while it waits for another run")
    os.close(handle)
    where = bench.copy("rotary-dxf", "old")
    reads, writes = os.pipe()
    os.set_blocking(writes, False)
    try:
        while True:
            os.write(writes, bytes(4096))
    except BlockingIOError:
        os.set_blocking(writes, True)
    process = bench.begun(bench.words("rotary-dxf"), where, stdout=writes)
    until(lambda: staged_in(where / OUT))
    time.sleep(1)
    blocked = interrupted(process, where, wrong, bench, "while nobody reads its report")
    os.close(reads)
    os.close(writes)
    return f"2 interrupts, ended after {took} and {blocked}"


def interrupted(process, where, wrong, bench, what):
    begun = time.monotonic()
    os.kill(process.pid, signal.SIGINT)
    try:
        process.wait(4)
    except subprocess.TimeoutExpired:
        os.kill(process.pid, signal.SIGINT)
        try:
            process.wait(20)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
        wrong.add(f"one SIGINT {what} does not end it within 4 s", process.line)
    run = bench.ended(process)
    if seen(where) != seen(bench.start("rotary-dxf", "old")[0]):
        wrong.add(f"SIGINT {what} (a second one after 4 s): left {left(where / OUT)}", run.line)
    return f"{time.monotonic() - begun:.1f} s"


def inits(bench, wrong):
    """`camgen init FILE`: whole or not there, and the next `init` is not in the way of its own remains."""
    needs_strace(bench)
    where = bench.case()
    text = bench.run(["init"], where).out
    file, log = f"{OUT}/own.toml", where / "trace"
    run = bench.run(["init", file], where, bench.tracer(ERRORS, log))
    assert run.code == 0 and (where / file).read_bytes() == text, run.err
    counts, made, begun = {}, [], False
    for line in log.read_text(errors="replace").splitlines():
        match = re.match(r"\d+ +(\w+)\((.*)", line)
        if not match:
            continue
        call = match[1]
        counts[call] = counts.get(call, 0) + 1
        begun = begun or '"deep' in match[2]
        if begun:
            made += [[f"error={error.rstrip('!')}", call, counts[call]] for error in ERRORS[call]]
            made += [["signal=KILL", call, counts[call]]] if call in KILLED else []
    tried = sampled(bench, made, None if bench.options.full else 60)

    def one(plan):
        how, call, ordinal = plan
        place = bench.case()
        run = bench.run(["init", file], place, [*bench.tracer([call]), "-e", f"inject={call}:{how}:when={ordinal}"])
        path, faults = place / file, []
        there = path.read_bytes() if path.exists() else None
        if there not in (None, text):
            faults.append(f"{len(there)} bytes of {len(text)}")
        if run.code == 0 and there != text or run.code not in (0, 2, -signal.SIGKILL):
            faults.append(f"exit code {run.code}, file {'there' if there else 'not there'}: {run.err[-200:]}")
        again = bench.run(["init", file], place)
        if again.code != 0 and not (again.code == 2 and "already exists" in again.err + run.err and path.exists()):
            faults.append(f"the next init: exit code {again.code}: {again.err[-200:]}")
        if not path.exists() or path.read_bytes() != text or left(path.parent):
            faults.append(f"the next init left {sorted(os.listdir(path.parent)) if path.parent.exists() else None}")
        for what in faults:
            wrong.add(what, run.line)
        shutil.rmtree(place, ignore_errors=True)

    in_parallel(bench, one, tried)
    # A limit of the size of files, and a file that is there.
    place = bench.case()
    run = bench.run(["init", "own.toml"], place, ["prlimit", "--fsize=1024"])
    if run.code != 2 or (place / "own.toml").exists():
        wrong.add(f"a limit of 1 kB: exit code {run.code}", run.line)
    (place / "own.toml").write_text("mine")
    run = bench.run(["init", "own.toml"], place)
    if run.code != 2 or (place / "own.toml").read_text() != "mine":
        wrong.add("a file of the user's own is replaced", run.line)
    return f"{len(tried)} of {len(made)} faults and kills"


def watching(bench, wrong):
    """Three runs with --watch write the same names when their machine changes, and one is killed at it: the others go on, and the set is
    whole."""
    where = bench.case()
    text = bench.run(["machines", "show", "dpi"], where).out.decode()
    assert 'radius = "30 mm"' in text, text[-300:]
    file = where / "own.toml"
    words = ["rotary", "own.toml", "--rpm", "35", "--format", "dxf,csv", "--out", OUT, "--name", "cam", "--quiet"]

    def change(radius):
        new = file.with_suffix(".new")
        new.write_text(text.replace('radius = "30 mm"', f'radius = "{radius} mm"', 1))
        new.replace(file)

    def made(radius):
        """The set for a radius."""
        case = bench.case()
        change(radius)
        shutil.copy(file, case / "own.toml")
        run = bench.run(words, case)
        assert run.code == 0, run.err
        return {name: content for name, content in contents(case / OUT).items() if name != RECORD}

    sets = {radius: made(radius) for radius in (29, 28, 27, 26)}
    change(29)
    kill = ["strace", "-f", "-o", os.devnull, "-e", "trace=renameat", "-e", "inject=renameat:signal=KILL:when=3"] if bench.strace else []
    errors = [open(where / f"err{number}", "wb") for number in range(3)]
    runs = [bench.begun([*words, "--watch"], where, kill if number == 0 else (), stdout=subprocess.DEVNULL, stderr=errors[number]) for number in range(3)]

    def is_made(radius):
        found = contents(where / OUT)
        return {name: found.get(name) for name in sets[radius]} == sets[radius] and fits(where / OUT) and not left(where / OUT)

    for radius in (29, 28, 27, 26):
        change(radius)
        time.sleep(1.5)
        # What the killed one has left is finished by the next run of another, at the next change.
        until(lambda radius=radius: is_made(radius) or runs[0].poll() is not None and COMMIT in left(where / OUT), 40)
        torn = {name for name, content in contents(where / OUT).items() if name in sets[29] and content not in {one[name] for one in sets.values()}}
        if torn or not is_made(radius) and not (radius != 26 and COMMIT in left(where / OUT)):
            wrong.add(f"radius {radius}: another set after 40 s: {difference(contents(where / OUT), sets[radius])}, left {left(where / OUT)}", runs[1].line)
    time.sleep(1)
    alive = [process.poll() is None for process in runs[1:]]
    if alive != [True, True] or bench.strace and runs[0].poll() is None:
        wrong.add(f"still running are {alive}, and the first {runs[0].poll()}", runs[1].line)
    for process in runs:
        os.killpg(process.pid, signal.SIGKILL) if process.poll() is None else None
        process.wait()
    return "3 writers, 4 changes"


KINDS = {
    "faults of calls": single_and_lasting,
    "a disk that is gone": disk_gone,
    "faults that cannot be taken back": taking_back,
    "kills": kills,
    "kills, then another command": kills_then_another_command,
    "order of syncs": order,
    "two writers": two_writers,
    "a reader": reader,
    "small disks": small_disks,
    "standard output": standard_output,
    "limits of size": limits,
    "moved directories": moved,
    "another user": unprivileged,
    "files that cannot be replaced": in_the_way,
    "signals": signals,
    "signals that are ignored": ignored,
    "modes": modes,
    "odd names": odd_names,
    "records of none": records,
    "leftovers of none": left_behind,
    "a shared directory": shared,
    "planted records": planted,
    "watching": watching,
    "edits after a cut": edited_meanwhile,
    "locks": locked,
    "a first run gives up": given_up,
    "interrupts while it waits": impatient,
    "no locks": no_locks,
    "names of its own": own_names,
    "paths": paths,
    "init": inits,
}
# Of one cause no more are shown.
SHOWN = 6


def main():
    parser = argparse.ArgumentParser(usage=__doc__.split("usage: ")[1])
    parser.add_argument("binary")
    parser.add_argument("directory", type=Path)
    parser.add_argument("--full", action="store_true")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--rounds", type=int, default=None)
    parser.add_argument("--faults", type=int, default=None, help="at most so many")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1)
    parser.add_argument("--only", help="kinds with this word")
    options = parser.parse_args()
    options.rounds = options.rounds or (120 if options.full else 12)
    # What runs in the background of a shell ignores interrupts, and so would all that it starts.
    for number in (signal.SIGHUP, signal.SIGINT, signal.SIGTERM):
        if signal.getsignal(number) == signal.SIG_IGN:
            signal.signal(number, signal.default_int_handler if number == signal.SIGINT else signal.SIG_DFL)
    options.directory.mkdir(parents=True, exist_ok=True)
    bench = Bench(options.binary, options.directory, options)
    if not bench.strace:
        print("strace cannot be had or may not trace here: faults, kills, signals, moves and slowed writers are left out")
    bad, total = 0, 0
    for kind, work in KINDS.items():
        if options.only and options.only not in kind:
            continue
        wrong, begun = Wrong(), time.monotonic()
        try:
            told = work(bench, wrong)
        except Skip as why:
            told = f"left out: {why}"
        except (AssertionError, OSError) as error:
            told = "broken off"
            wrong.add(f"{type(error).__name__}: {error}", f"--only {shlex.quote(kind)} --seed {options.seed}")
        print(f"{kind}: {told}; {len(wrong)} wrong; {time.monotonic() - begun:.0f} s", flush=True)
        for one in wrong[:SHOWN]:
            print(f"    {one}")
        if len(wrong) > SHOWN:
            print(f"    and {len(wrong) - SHOWN} more")
        bad += len(wrong)
        total += 1
    print(f"{total} kinds, {bad} wrong")
    sys.exit(1 if bad else 0)


if __name__ == "__main__":
    main()
