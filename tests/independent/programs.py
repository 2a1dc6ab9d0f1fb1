"""Random motion programs under every follower of `camgen make`, legal ones and ones at the walls, against motions, cams and contacts made here.

Shares nothing with camgen but the files it reads and writes. A law is a pattern of its acceleration, integrated piece by piece and scaled to
its ends by two linear conditions, or a textbook formula, or the polynomial of its end conditions; a follower is a complex number that is
differentiated by the product rule; splines are dense linear systems of their own optimality, formulas read by Python and differentiated by
Cauchy's integral, forces and jump speeds the balance of forces; the written outline is arcs and lines onto which the follower is let down along
its own path until it touches. Lift as rolled, the columns of the table, figures, peaks, jumps and the verdict of every check are compared; a refusal must be deserved, and a
file broken on purpose refused with line, column and key.

usage: programs.py CAMGEN_BINARY DIRECTORY [--count N] [--seed N] [--only N] [--verbose]
"""
import argparse
import json
import random
import re
import shutil
import subprocess
import sys
import time
from collections import Counter
from pathlib import Path

import numpy as np
from program_cam import Follower
from program_draw import draw, written
from program_judge import Judge
from program_motion import Illegal, Program, law_pieces, quantity

LIMIT_S = 20.0
# Tangent of a pressure angle of 89°.
STEEP = 57
REASONS = {
    "serve": "cannot ", "accelerated": "cannot begin or end with an acceleration", "travel": "needs some travel|needs `to`", "inflection": "inflection",
    "parameter": "must be ", "sum": "points away|the segments|must come after|already cover|greater than|above 0|`over`", "rpm": "needs motion.rpm",
    "dwell": "a dwell", "return": "does not end where it starts", "line": "contradict each other", "reach": "offset|reach|pivot|arm|lever|swing",
    "bore": "bore_radius", "back": "turns back|does not reach|bore_radius", "over": "`over`",
    "end": "turn|rest",
    "own state": "determines velocity and acceleration itself", "auto": "\"auto\" finds", "jerk beside": "the jerk cannot be given", "speed": "made for one speed",
    "impact": "of the load jumps", "range": "outside the turn|does not come after|not inside",
}


class Runner:
    def __init__(self, binary, directory):
        self.binary, self.directory = str(Path(binary).resolve()), directory

    def run(self, path, out, words):
        started = time.monotonic()
        command = [self.binary, "make", str(path), "--json", "--out", str(out), "--name", "cam", "--format", "dxf,csv,json", *words]
        try:
            run = subprocess.run(command, capture_output=True, text=True, timeout=LIMIT_S)
        except subprocess.TimeoutExpired:
            return None, "", f"no end after {LIMIT_S} s", LIMIT_S
        return run.returncode, run.stdout, run.stderr, time.monotonic() - started


def expected(case):
    """The program and the follower of a given base radius, or why there are none."""
    program = None
    try:
        program = Program(case["motion"], case["segments"], case["files"])
        side = -1 if case["follower"].get("side") == "leading" else 1
        if case["kind"] == "swinging-flat" and program.extreme(lambda i, t: -side * program.jet(i, t, 1)[1])[0] >= 1:
            raise Illegal("back")
        if case["cam"]["base_radius"] == "auto":
            return program, None, None
        base = quantity(case["cam"]["base_radius"])
        if "bore_radius" in case["cam"] and quantity(case["cam"]["bore_radius"]) >= base:
            raise Illegal("bore")
        follower = Follower(case["kind"], case["follower"], base)
        follower.reach(program.extreme(lambda i, t: program.jet(i, t, 0)[0])[0] - program.lowest)
        return program, follower, None
    except Illegal as reason:
        return program, None, str(reason)


def form(case):
    """What of a motion a case is about, for the summary."""
    own = [law for law in ("spline", "formula", "table") if any(segment.get("law") == law for segment in case["segments"])]
    whole = [key for key in ("formula", "fourier", "points", "table") if key in case["motion"]]
    auto = ["auto"] * any("auto" in segment.values() for segment in case["segments"])
    return "has " + ("polydyne" if "polydyne" in case["motion"] else (whole + [f"segment {law}" for law in own] + auto + ["laws only"])[0])


def one(runner, case, name, rng, tally, samples):
    """Runs and judges a case; the list of what is wrong."""
    path, out = runner.directory / f"{name}.toml", runner.directory / name
    path.write_text(written(case))
    for file, text in case["files"].items():
        (runner.directory / file).write_text(text)
    shutil.rmtree(out, ignore_errors=True)
    program, follower, reason = (None, None, "broken") if case["broken"] else expected(case)
    code, stdout, stderr, took = runner.run(path, out, case["words"])
    files = sorted(p.name for p in out.iterdir()) if out.exists() else []
    Judge.worst["seconds"] = max(Judge.worst["seconds"], took)
    if code not in (0, 1, 2):
        return [f"exit {code}: {stderr[:400]}"]
    if case["broken"] and code == 2:
        return refused_broken(case, stderr, files, tally)
    if code == 2:
        return refused(case, stderr, files, reason, program, follower, tally, samples)
    if reason == "reach" and on_the_wall(case):
        tally["on the wall"] += 1
        shutil.rmtree(out, ignore_errors=True)
        return []
    if reason:
        return [f"exit {code}, but the file is illegal: {reason}"]
    report = json.loads(stdout)
    judge = Judge(case, program)
    if follower is None:
        follower = Follower(case["kind"], case["follower"], report["cam"]["base_radius_mm"])
    judge.report(report, follower)
    if not judge.wrong and case["cam"]["base_radius"] == "auto":
        judge.automatic(report)
    if judge.wrong:
        return judge.wrong
    if (code == 1) != bool(judge.failed):
        judge.wrong.append(f"exit {code}, failed {judge.failed}")
    forced = "--force" in case["words"]
    if code == 1 and not forced:
        if files:
            judge.wrong.append(f"exit 1 without --force wrote {files}")
        runner.run(path, out, [*case["words"], "--force"])
        files = sorted(p.name for p in out.iterdir()) if out.exists() else []
    tally[f"exit {code}"] += 1
    tally.update(f"  fails {name}" for name in judge.failed)
    tally.update([f"  {form(case)}"])
    if files:
        if {"cam.csv", "cam.dxf", "cam.json"} - set(files):
            judge.wrong.append(f"files {files}")
        if {**json.loads((out / "cam.json").read_text()), "files": None} != {**report, "files": None}:
            judge.wrong.append("the report as a file is not the one on stdout")
        judge.table(out / "cam.csv", follower)
        deserved = judge.rolled(out / "cam.dxf", report, follower, rng)
        if not (deserved or "undercut" in judge.failed or judge.sharp) and judge.failed & {"rolling", "outline"}:
            judge.wrong.append(f"{judge.failed} without a gap beyond the tolerance")
        if rng.random() < 0.05:
            twin = runner.directory / f"{name}-twin"
            runner.run(path, twin, sorted({*case["words"], "--force"}, key=[*case["words"], "--force"].index))
            for file in ("cam.csv", "cam.dxf"):
                if (twin / file).read_bytes() != (out / file).read_bytes():
                    judge.wrong.append(f"{file} of two runs differ")
            shutil.rmtree(twin)
    elif "undercut" not in judge.failed:
        judge.wrong.append(f"exit {code}, and no files: {stderr[:200]}")
    else:
        tally["  no outline"] += 1
    shutil.rmtree(out, ignore_errors=True)
    return judge.wrong


def on_the_wall(case):
    """Whether an offset is the prime radius but for rounding, which may be in reach or not."""
    given = case["follower"]
    prime = quantity(case["cam"]["base_radius"]) + (quantity(given["radius"]) if "radius" in given else 0.0)
    return case["kind"] in ("roller", "knife") and abs(abs(quantity(given.get("offset", "0 mm"))) - prime) < 1e-12 * prime


def refused(case, stderr, files, reason, program, follower, tally, samples):
    """Exit 2: no file, a place in the file, and a reason known here."""
    wrong = [f"exit 2 wrote {files}"] if files else []
    message = stderr.split("\n")[0]
    if not re.search(r"--> \S+:\d+:\d+", stderr) and not re.search(r"(cam|follower|limits|motion)\.[a-z_]+", message):
        wrong.append(f"exit 2 without a place: {stderr[:300]}")
    if reason is None and case["cam"]["base_radius"] == "auto" and "no base radius keeps the limits" in stderr:
        reason = "no automatic size"
    if reason is None and program and program.near and re.search(REASONS["accelerated"], stderr):
        reason = "accelerated by rounding"
    # A jump is small beside the peak of a steep segment elsewhere.
    if "of the load jumps" in stderr and program and getattr(program, "jumped", 0.0) > 1e-10:
        reason = "impact"
    # A face needs as much radius as the acceleration falls, an edge as the velocity asks for.
    peak = lambda order: program.extreme(lambda i, t: np.abs(program.jet(i, t, order)[order]))[0]
    if "more than the largest coordinate of a drawing" in stderr and program and max(peak(0), peak(1), peak(2) * (case["kind"] == "flat")) > 1e5:
        reason = "too large"
    # Within a degree of the radius no arcs or splines fit a profile: the cam is a spike.
    if "no arcs or splines fit the outline" in stderr and program and follower and peak(1) > STEEP * follower.base:
        reason = "a spike"
    if reason is None:
        wrong.append(f"refused, but legal: {stderr[:400]}")
    tally[f"exit 2 {reason}"] += 1
    samples.setdefault(f"{reason}: {re.sub('[-0-9.e]+', '#', message)[:70]}", message)
    if reason and not any(re.search(REASONS.get(one, ""), stderr) for one in reason.split(", ")):
        wrong.append(f"{reason} is told as: {stderr[:400]}")
    return wrong


def refused_broken(case, stderr, files, tally):
    """A file broken on purpose: no file, line and column, and the key in the message or the line it shows."""
    wrong = [f"exit 2 wrote {files}"] if files else []
    if not re.search(r"--> \S+:\d+:\d+|missing key", stderr):
        wrong.append(f"broken, and told without a place: {stderr[:300]}")
    if not re.search(case["broken"], stderr):
        wrong.append(f"broken at {case['broken']}, told as: {stderr[:300]}")
    tally["exit 2 broken on purpose"] += 1
    return wrong


def golden():
    """Laws made here against the figures of the specification, G1 to G11."""
    rest, turn = ("R", 0.0), ("U", 0.0)
    cases = [
        ("modified-sine", {}, rest, rest, "smooth", 0.1, [0.01069721279143388, 0.3039640090835889, 5.257399593740826, 21.4662849395378]),
        ("modified-trapezoid", {}, rest, rest, "smooth", 0.3, [0.160590348672676, 1.244406188140663, 4.888123762813258, 0]),
        ("scca", {"fractions": [0.15, 0.25, 0.35, 0.25]}, rest, rest, "smooth", 0.3, [0.1985647188475994, 1.393383782482947, 3.343326940716362, -37.63088883298218]),
        ("modified-sine", {}, rest, rest, 0.4, 0.7, [0.8593858184624717, 1.099752116221107, -3.989459378434157]),
        ("modified-sine", {}, ("G", 0.3), ("G", 0.8), 0.45, 0.6, [0.5918564045283607, 1.260583206127209, -0.8072865435906733]),
        ("modified-sine", {}, rest, turn, "smooth", 0.5, [0.4479009232040498, 1.65434986819262, 0.6831285684864257]),
        ("4-5-6-7", {}, rest, rest, "smooth", 0.3, [0.126036, 1.29654, 7.4088, -8.82]),
        ("triple-harmonic", {}, rest, rest, "smooth", 0.2, [0.02581611404006618, 0.5512287570313157, 8.107558743536343, 49.65548929170054]),
        ("freudenstein-1-3-5", {}, rest, rest, "smooth", 0.15, [0.02773883199770806, 0.4951196505364218, 4.98429912265449, 4.182629660733969]),
        ("gutman-1-3", {}, rest, rest, "smooth", 0.15, [0.02826377086125798, 0.5083923582442535, 5.129555531306581, 0.634788620903982]),
        ("freudenstein-1-3", {}, rest, rest, "smooth", 0.15, [0.02525398890638129, 0.4671733822999421, 5.109690457453158, 10.30766420552435]),
        ("double-harmonic", {}, rest, turn, "smooth", 0.15, [0.00296989444237521, 0.07772614785125209, 1.496336999803818, 18.0463272440782]),
    ]
    for law, own, start, end, inflection, x, wanted in cases:
        pieces = law_pieces(law, own, start, end, inflection, None)
        piece = next(piece for piece in pieces if x <= piece.high)
        found = [float(piece.at(np.array([x]), order)[0]) for order in range(len(wanted))]
        assert np.allclose(found, wanted, rtol=1e-12, atol=1e-12), (law, found, wanted)


def main():
    words = argparse.ArgumentParser()
    words.add_argument("binary")
    words.add_argument("directory", type=Path)
    words.add_argument("--count", type=int, default=300)
    words.add_argument("--seed", type=int, default=1)
    words.add_argument("--only", type=int, help="one case of the seed, by its number")
    words.add_argument("--verbose", action="store_true", help="samples of the messages, and the whole of what is wrong")
    given = words.parse_args()
    given.directory.mkdir(parents=True, exist_ok=True)
    golden()
    runner, tally, samples, failures = Runner(given.binary, given.directory), Counter(), {}, 0
    started = time.monotonic()
    for index in range(given.count) if given.only is None else [given.only]:
        rng = random.Random(f"{given.seed}-{index}")
        case, name = draw(rng), f"case-{given.seed}-{index}"
        wrong = one(runner, case, name, rng, tally, samples)
        if wrong:
            failures += 1
            shown = wrong if given.verbose else wrong[:2]
            print(f"{name} {case['kind']}: " + "\n    ".join(shown) + f"\n    {name}.toml {' '.join(case['words'])}")
        else:
            for file in (f"{name}.toml", *case["files"]):
                (given.directory / file).unlink()
    seconds = time.monotonic() - started
    if given.verbose:
        print("\n".join(f"{key}\n    {message}" for key, message in sorted(samples.items())))
    print("\n".join(f"{count:6} {what}" for what, count in sorted(tally.items())))
    print("worst of the allowed: " + ", ".join(f"{key} {value:.2g}" for key, value in sorted(Judge.worst.items())))
    print(f"{given.count} programs, {failures} wrong, {given.count / seconds:.1f} a second")
    sys.exit(failures > 0)


main()
