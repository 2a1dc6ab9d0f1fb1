"""Forces, torque, jump speed, contact stress and vibration of random cams of `camgen make`, against forces_model.py.

Random programs between rests over the five followers, from slow to well above the speed at which the follower leaves its cam. The report, the
checks and the table are compared; where a preload is proposed it is tried. Wrong keys must be refused with a message that says why.

usage: forces.py CAMGEN_BINARY DIRECTORY [--count N] [--seed N] [--first N] [--verbose]
"""
import argparse
import csv
import json
import math
import random
import os
import subprocess
import sys
from pathlib import Path

os.environ["OPENBLAS_NUM_THREADS"] = "1"
import numpy as np
from forces_model import Cam, fourier, laid, panels, residual, sound, worst_residual

DEG, TAU = math.pi / 180, 2 * math.pi
LAWS = ["cycloidal", "modified-sine", "3-4-5", "4-5-6-7", "modified-trapezoid", "harmonic"]
FOLLOWERS = ["roller", "swinging-roller", "flat", "swinging-flat", "knife"]
# Largest relative differences; forces, stresses and residuals agree to rounding. For a place its value is compared, as places are only as
# sharp as the root of the rounding. Integrals (of the largest torque) are allowed what a rule of fixed steps misses at kinks, deviations
# what harmonics miss that are cut off where the acceleration jumps, and words the rounding to six digits.
TOLERANCES = {"row": 1e-9, "integral": 5e-5, "extreme": 1e-7, "place": 1e-5, "vibration": 1e-7, "harmonic": 1e-9, "deviation": 2e-3, "words": 6e-6}


def program(rng, swings):
    """Segments (law, degrees, position at the end or None) of one lobe, its lobes, and start and angle of the start."""
    lobes = rng.choice([1, 1, 1, 1, 2, 3])
    top = rng.uniform(4, 25)
    start = rng.choice([0.0, 0.0, round(rng.uniform(-10, 10), 2)])
    at = start
    moves = rng.choice([2, 2, 2, 3, 4])
    targets = []
    for i in range(moves - 1):
        at = start + rng.choice([1, 1, -1]) * top * rng.uniform(0.3, 1)
        targets.append(at)
    targets.append(start)
    rows = []
    for to in targets:
        rows.append([rng.choice(LAWS), rng.uniform(1, 2), round(to, 3)])
        if rng.random() < 0.6:
            rows.append(["dwell", rng.uniform(0.2, 0.8), None])
    whole = 360 / lobes
    scale = whole / sum(r[1] for r in rows)
    digits = rng.choice([0, 3])
    left = whole
    for row in rows[:-1]:
        row[1] = max(round(row[1] * scale, digits), 2.0)
        left -= row[1]
    rows[-1][1] = left
    return rows, lobes, start, rng.choice([0.0, 0.0, round(rng.uniform(-90, 300), 1)])


def follower(rng, kind):
    keys = {}
    if kind in ("roller", "knife"):
        keys["offset"] = round(rng.choice([0, rng.uniform(-12, 12)]), 2)
    if kind == "roller":
        keys["radius"] = round(rng.uniform(6, 20), 2)
    if kind == "flat":
        keys["tilt"] = round(rng.choice([0, 0, rng.uniform(-25, 25)]), 1) * DEG
        keys["offset"] = round(rng.choice([0, rng.uniform(-10, 10)]), 2)
    if kind == "swinging-roller":
        keys["radius"], keys["arm"] = round(rng.uniform(6, 20), 2), round(rng.uniform(70, 130), 1)
        keys["pivot_distance"] = round(keys["arm"] * rng.uniform(1.0, 1.5), 1)
    if kind == "swinging-flat":
        keys["pivot_distance"], keys["face_offset"] = round(rng.uniform(110, 180), 1), round(rng.choice([0, rng.uniform(-12, 12)]), 1)
    if kind.startswith("swinging"):
        keys["side"] = rng.choice(["trailing", "leading"])
    return keys


def loads(rng, kind):
    """Mass or inertia, spring, guide: numbers in the units of the model."""
    keys, moment = {}, kind.startswith("swinging")
    if rng.random() < 0.93:
        keys["inertia"] = round(10 ** rng.uniform(-3, -1), 5) if moment else round(10 ** rng.uniform(-1, 1), 4)
    if rng.random() < 0.85:
        keys["rate"] = round(rng.uniform(0, 60), 2) if moment else round(rng.uniform(0, 20), 2)
    keys["preload"] = round(rng.uniform(2, 40), 2) if moment else round(rng.uniform(30, 800), 1)
    if rng.random() < 0.35:
        keys["damping"] = round(rng.uniform(0, 0.5), 4) if moment else round(rng.uniform(0, 80), 2)
    if rng.random() < 0.4:
        keys["load"] = round(rng.uniform(-0.6, 1) * keys["preload"], 2)
    if rng.random() < 0.2 and not moment:
        keys["own_preload"] = round(rng.uniform(0, 300), 1)
    if rng.random() < 0.6 and not moment:
        keys["friction"], keys["span"] = round(rng.choice([rng.uniform(0, 0.2), rng.uniform(0.2, 0.6)]), 3), round(rng.uniform(25, 100), 1)
        keys["overhang"] = round(rng.choice([0, rng.uniform(0, 50)]), 1)
    if kind in ("roller", "swinging-roller") and rng.random() < 0.35:
        keys["crown_radius"] = round(10 ** rng.uniform(1.2, 3.2), 1)
    return keys


class Case:
    def __init__(self, rng):
        while True:
            self.kind = rng.choice(FOLLOWERS)
            self.moment = self.kind.startswith("swinging")
            self.rows, self.lobes, self.start, self.at = program(rng, self.moment)
            self.keys = {**follower(rng, self.kind), **loads(rng, self.kind)}
            self.base = round(rng.uniform(20, 60), 1)
            segments = laid(self.rows, self.lobes, self.start, DEG if self.moment else 1.0)
            with np.errstate(all="ignore"):
                self.cam = Cam(self.kind, self.keys, segments, self.base, 0.0)
                if min(s.span for s in segments) > 0.03 and sound(self.cam):
                    break
        jump = self.cam.jump_speed()[0]
        if not 0 < jump < 1e5:
            jump = rng.uniform(5, 60)
        self.rpm = None if rng.random() < 0.05 else float(f"{jump * 60 / TAU * 10 ** rng.uniform(-1.2, 0.45):.5g}")
        self.rpm = min(self.rpm, 1e5) if self.rpm else None
        self.cam.omega = (self.rpm or 0.0) * TAU / 60
        self.fluctuation = round(rng.uniform(0.005, 0.1), 4) if rng.random() < 0.5 else None
        self.frequency = round((self.rpm or 100) / 60 * rng.uniform(3, 40), 3) if rng.random() < 0.5 else None
        self.damping = round(rng.uniform(0.01, 0.3), 3) if rng.random() < 0.25 else 0.0
        self.margin = round(rng.uniform(0.5, 1.5), 2) if rng.random() < 0.3 else None
        self.material = rng.choice(["steel", "cast-iron", "bronze", "aluminium"])
        self.width = round(rng.uniform(8, 30), 1)
        self.rotation = rng.choice(["cw", "ccw"])
        self.limit = round(rng.uniform(0.001, 0.1), 4) if rng.random() < 0.3 else None

    def toml(self):
        k, moment = self.keys, self.moment
        unit = "deg" if moment else "mm"
        out = ['name = "case"', "[motion]"] + ([f"rpm = {self.rpm}"] if self.rpm else [])
        out += [f'start = "{self.start} {unit}"', f'at = "{self.at} deg"', f"repeat = {self.lobes}"]
        for i, (name, over, to) in enumerate(self.rows):
            out += ["[[motion.segment]]", f'law = "{name}"']
            out += [f'over = "{over} deg"'] if i < len(self.rows) - 1 else []
            out += [f'to = "{to} {unit}"'] if to is not None else []
        out.append(f"[follower.{self.kind}]")
        for key in ("radius", "offset", "arm", "pivot_distance", "face_offset", "crown_radius"):
            out += [f'{key} = "{k[key]} mm"'] if key in k else []
        out += [f'tilt = "{round(k["tilt"] / DEG, 1)} deg"'] if "tilt" in k else []
        out += [f'side = "{k["side"]}"'] if "side" in k else []
        if "inertia" in k:
            out.append(f'inertia = "{k["inertia"]} kg*m2"' if moment else f'mass = "{k["inertia"]} kg"')
        out += [f'preload = "{k["own_preload"]} N"'] if "own_preload" in k else []
        units = {"rate": "N*m/rad", "preload": "N*m", "damping": "N*m*s/rad", "load": "N*m"}
        if not moment:
            units = {"rate": "N/mm", "preload": "N", "damping": "N*s/m", "load": "N"}
        out += ["[spring]"] + [f'{key} = "{k[key]} {u}"' for key, u in units.items() if key in k]
        if "friction" in k:
            out += ["[guide]", f"friction = {k['friction']}", f'span = "{k["span"]} mm"', f'overhang = "{k["overhang"]} mm"']
        if self.frequency:
            out += ["[vibration]", f'natural_frequency = "{self.frequency} Hz"', f"damping = {self.damping}"]
        out += ["[flywheel]", f"fluctuation = {self.fluctuation}"] if self.fluctuation else []
        out += ["[cam]", f'base_radius = "{self.base} mm"', f'thickness = "{self.width} mm"', f'material = "{self.material}"']
        out += [f'rotation = "{self.rotation}"', "[limits]", 'pressure_angle = "85 deg"', "min_convex_pitch_radius_over_roller = 0.1"]
        out += [f"jump_margin = {self.margin}"] if self.margin else []
        out += [f"residual = {self.limit}"] if self.limit else []
        return "\n".join(out + [""])


class Tally:
    """Worst relative differences by figure, and what went wrong."""

    def __init__(self, verbose):
        self.worst, self.count, self.wrong, self.verbose, self.title = {}, {}, [], verbose, ""

    def near(self, figure, got, want, kind, scale=0.0):
        self.count[figure] = self.count.get(figure, 0) + 1
        if got is None or want is None or not (math.isfinite(got) and math.isfinite(want)):
            same = got is want or got == want
            return same or self.fail(figure, f"{got} instead of {want}")
        gap = abs(got - want) / max(abs(want), scale, 1e-300)
        self.worst[figure] = max(self.worst.get(figure, 0.0), gap)
        return gap <= TOLERANCES[kind] or self.fail(figure, f"{got!r} instead of {want!r}, off by {gap:.1e}")

    def equal(self, figure, got, want):
        self.count[figure] = self.count.get(figure, 0) + 1
        return got == want or self.fail(figure, f"{got!r} instead of {want!r}")

    def fail(self, figure, text):
        self.wrong.append((self.title, figure, text))
        print(f"{self.title}: {figure}: {text}")
        return False


def call(binary, path, *options):
    run = subprocess.run([binary, "make", str(path), *options], capture_output=True, text=True, timeout=60)
    return run.returncode, run.stdout, run.stderr


def sides(case, degrees):
    """The segments that hold a cam angle, with the angle inside each; two at a break."""
    theta = ((degrees - case.at) * DEG) % TAU
    found = []
    for turn in (theta - TAU, theta, theta + TAU):
        found += [(s, min(max(turn, s.low), s.high)) for s in case.cam.segments if s.low - 1e-9 <= turn <= s.high + 1e-9]
    return found


def nearest(case, degrees, value, want):
    """The one of the values beside a cam angle that is nearest to the wanted."""
    values = [float(value(s, np.array([t]))[0]) for s, t in sides(case, degrees)]
    return min(values, key=lambda v: abs(v - want))


def compare_rows(case, path, tally):
    cam = case.cam
    with open(path) as file:
        rows = [{k: float(v) for k, v in row.items() if k.endswith(("deg", "_n", "_nm"))} for row in csv.DictReader(file)]
    columns = {"roller_force_n": "force", "torque_nm": "torque", "contact_force_n": "contact"}
    tally.equal("columns", sorted(set(columns) - set(rows[0])), [])
    degrees = np.array([row["cam_deg"] for row in rows])
    theta = ((degrees - case.at) * DEG) % TAU
    want = [{n: np.full(len(rows), np.nan) for n in columns.values()} for _ in range(2)]
    for segment in cam.segments:
        for turn in (theta - TAU, theta, theta + TAU):
            inside = np.nonzero((turn >= segment.low - 1e-9) & (turn <= segment.high + 1e-9))[0]
            if not len(inside):
                continue
            found = cam.state(segment, np.clip(turn[inside], segment.low, segment.high))
            for name in columns.values():
                # 0 where the follower has left the cam.
                told = np.maximum(found[name], 0.0) if name == "contact" else found[name]
                for i, value in zip(inside, told):
                    slot = 0 if np.isnan(want[0][name][i]) else 1
                    want[slot][name][i] = value
    for column, name in columns.items():
        if column not in rows[0]:
            continue
        got = np.array([row[column] for row in rows])
        gap = np.fmin(*(np.where(got == w[name], 0.0, np.abs(got - w[name])) for w in want))
        finite = np.abs(want[0][name])
        scale = finite[np.isfinite(finite)].max() or 1.0
        at = int(np.argmax(gap))
        tally.near(f"row {column}", float(gap[at] / scale) + 1, 1.0, "row")
        if gap[at] > TOLERANCES["row"] * scale:
            tally.fail(column, f"at {degrees[at]} deg {got[at]!r}, here {want[0][name][at]!r} or {want[1][name][at]!r}")


def compare_dynamics(case, report, checks, tally):
    cam, told = case.cam, report.get("dynamics")
    if told is None:
        return tally.fail("dynamics", "missing")
    of = lambda name: lambda segment, theta: cam.state(segment, theta)[name]
    minus = lambda value: lambda segment, theta: -value(segment, theta)
    turn, swing = cam.work(of("torque"))
    largest = max(abs(cam.extreme(of("torque"))[0]), abs(cam.extreme(minus(of("torque")))[0]))
    tally.near("mean torque", told["torque_mean_nm"], turn / TAU, "integral", largest)
    tally.near("work fluctuation", told["work_fluctuation_j"], swing, "integral", largest)
    for key, value, sign in [("torque_max", of("torque"), 1), ("torque_min", of("torque"), -1), ("contact_force_max", of("contact"), 1)]:
        unit = "_nm" if key.startswith("torque") else "_n"
        want = sign * cam.extreme(value if sign > 0 else minus(value))[0]
        tally.near(key, told[key + unit], want, "extreme", largest if unit == "_nm" else 0)
        at = nearest(case, told[key + "_at_deg"], value, want)
        tally.near(key + " place", at, want, "place", largest if unit == "_nm" else 0)
    least = max(-cam.extreme(minus(of("contact")))[0], 0.0)
    tally.near("contact_force_min", told["contact_force_min_n"], least, "extreme", cam.extreme(of("contact"))[0])
    if case.rpm:
        tally.near("mean power", told["power_mean_w"], turn / TAU * cam.omega, "integral", largest * cam.omega)
        tally.near("largest power", told["power_max_w"], cam.extreme(of("torque"))[0] * cam.omega, "extreme", largest * cam.omega)
    if case.fluctuation and case.rpm:
        tally.near("flywheel", told["flywheel_kg_m2"], swing / (case.fluctuation * cam.omega**2), "integral",
                   largest / (case.fluctuation * cam.omega**2))
    else:
        tally.equal("flywheel absent", "flywheel_kg_m2" in told, False)


def compare_closure(case, path, report, checks, tally):
    cam, told = case.cam, report.get("dynamics", {})
    force = lambda segment, theta: cam.state(segment, theta)["force"]
    minus = lambda segment, theta: -force(segment, theta)
    closure, jump = checks.get("force_closure"), checks.get("jump_speed")
    least, scale = -cam.extreme(minus)[0], cam.extreme(force)[0]
    remedies = set()
    # Without a speed the force at rest may be told.
    if closure["verdict"] != "info" or case.rpm:
        tally.near("force_closure", closure["value"], least, "extreme", scale)
        tally.near("force_closure place", nearest(case, closure["cam_deg"], force, least), least, "place", scale)
        tally.equal("force_closure verdict", closure["verdict"], "pass" if least > 0 else "fail")
        remedies.update(proposal(closure))
    omega = cam.jump_speed()[0] if case.keys.get("inertia") else 0.0
    if not omega:
        # No mass, or nothing presses the follower on where it is lowest.
        tally.equal("no jump speed", (told.get("jump_rpm"), jump["note"].startswith("not run")), (None, True))
    else:
        want = omega * 60 / TAU
        tally.near("jump speed", jump["value"], want, "extreme")
        if told:
            tally.equal("jump speed told twice", (jump["value"], jump["cam_deg"]), (told["jump_rpm"], told["jump_at_deg"]))
        if case.rpm:
            limit = case.rpm * (case.margin or 1)
            tally.near("jump limit", jump["limit"], limit, "row")
            if abs(want / limit - 1) > 1e-9:
                tally.equal("jump verdict", jump["verdict"], "pass" if want >= limit else "fail")
            remedies.update(proposal(jump))
        # At this speed the force is nought at that angle.
        at, cam.omega = cam.omega, omega
        tally.near("force at the jump", nearest(case, jump["cam_deg"], force, 0.0) + scale, scale, "place")
        cam.omega = at
    for key, value, unit, speed in remedies:
        tally.equal("unit of the remedy", unit, "N*m" if case.moment else "N")
        tally.near("speed of the remedy", speed or case.rpm, case.rpm * ((case.margin or 1) if speed else 1), "words")
        _, out, err = call(case.binary, path, "--set", f'{key}="{value} {unit}"', "--dry-run", "--json")
        if not out:
            tally.fail("remedy", err)
            continue
        again = {c["check"]: c["verdict"] for c in json.loads(out)["checks"]}
        # With a margin below 1 the speed that holds is below that of the cam.
        held = ["jump_speed"] if speed else ["force_closure"]
        tally.equal("remedy holds", [again[c] for c in held], ["pass"])
        # By the model, and with little to spare.
        keep = cam.pressed, cam.omega
        cam.omega *= (case.margin or 1) if speed else 1
        cam.pressed += value - case.keys.get("preload" if key.startswith("spring") else "own_preload", 0.0)
        spare = -cam.extreme(lambda segment, theta: -cam.state(segment, theta)["path"])[0]
        cam.pressed, cam.omega = keep
        tally.equal("remedy by the model", spare > 0, True)
        tally.equal("remedy not too much", spare <= (0.02 if case.moment else 2.0) + 0.02 * value or (key, value, spare), True)


def proposal(check):
    """(key, number, unit, speed) of a note `KEY = "12 N" would hold it [at 600 rpm]`."""
    note = check.get("note", "")
    if "would hold it" not in note:
        return set()
    head, tail = note.split(" would hold it")
    key, quoted = head.split("; ")[-1].split(" = ")
    number, unit = quoted.strip('"').split()
    return {(key, float(number), unit, float(tail.split()[1]) if " rpm" in tail else None)}


def jamming(cam):
    """The least share of the force along the normal that is left to lift the follower, where it rises."""
    return -cam.extreme(lambda segment, theta: -cam.state(segment, theta)["lifted"], [s for s in cam.segments if s.end > s.start])[0]


def compare_contact(case, report, checks, tally):
    cam = case.cam
    if "friction" in case.keys and case.keys["friction"] > 0:
        # Only a rise jams; the least share of the whole turn, friction helping where the follower falls, is accepted as well.
        want, turn = jamming(cam), -cam.extreme(lambda segment, theta: -cam.state(segment, theta)["share"])[0]
        guide = checks["guide"]
        tally.near("guide", guide["value"], min(want, turn, key=lambda v: abs(v - guide["value"])), "extreme", 0.1)
        tally.equal("guide verdict", guide["verdict"], "pass" if want > 0 else "fail")
        if want <= 0:
            return
    if case.kind == "knife":
        return
    value = lambda segment, theta: cam.pressure(cam.state(segment, theta), case.width, case.material, case.keys.get("crown_radius"))
    want = cam.extreme(value)[0]
    if want > 0:
        got = checks["contact_stress"]
        tally.near("crowned stress" if "crown_radius" in case.keys else "line stress", got["value"], want, "extreme")
        tally.near("contact_stress place", nearest(case, got["cam_deg"], value, want), want, "place")
        # Under a crown the fatigue limit of running contact warns up to that of rest (ISO 281, ISO 76: 1500 and 4200 MPa for steel).
        bearable = got["limit"] * (4200 / 1500 if "crown_radius" in case.keys else 1)
        judged = "pass" if want <= got["limit"] else "warn" if want <= bearable else "fail"
        # Without a speed the inertia is not in the forces.
        if judged == "pass" and not case.rpm and {"mass", "inertia"} & set(case.keys):
            judged = "info"
        tally.equal("contact_stress verdict", got["verdict"], judged)
    if cam.radius:
        mean = sum((w * cam.state(s, t)["spin"]).sum() for s, a, b in cam.pieces() for t, w in [panels(a, b, 16)]) / TAU
        tally.near("roller turns", report["cam"]["roller_turns"][0], mean, "integral")
        most = cam.extreme(lambda segment, theta: np.abs(cam.state(segment, theta)["spin"]))[0]
        tally.near("roller turns, largest", report["cam"]["roller_turns"][1], most, "extreme")


def movements(case):
    """Joined segments between dwells of one lobe, each with the turn it lies ahead: [[(segment, shift), ...], ...]; none without a dwell."""
    count = len(case.rows)
    lobe = case.cam.segments[:count]
    rests = [i for i, s in enumerate(lobe) if s.start == s.end]
    found = []
    for here, after in zip(rests, rests[1:] + [r + count for r in rests[:1]]):
        group = [(lobe[i % count], TAU / case.lobes * (i // count)) for i in range(here + 1, after)]
        # A group that lies in the next lobe is told in this one.
        shift = group[0][1] if group else 0.0
        found += [[(s, w - shift) for s, w in group]] if group else []
    return found


def compare_vibration(case, report, checks, tally):
    told = report.get("vibration")
    unit = DEG if case.moment else 1.0
    waves = report.get("harmonics")
    if not case.frequency:
        return tally.equal("vibration absent", (told, waves), (None, None))
    ratio = case.frequency * 60 / case.rpm if case.rpm else 10
    if not waves:
        return tally.equal("harmonics without a speed", case.rpm, None)
    mean, coefficients = fourier(case.cam.segments, int(24 * ratio) + 300)
    # The series starts at the angle of the program; waves count from cam angle 0.
    orders = np.arange(1, len(coefficients) + 1)
    coefficients = coefficients * np.exp(-1j * orders * case.at * DEG) / unit
    scale = np.abs(coefficients).max()
    tally.near("harmonics: mean", waves["mean"], mean / unit, "harmonic", scale)
    for k, (c, s) in enumerate(zip(waves["cos"], waves["sin"])):
        tally.near("harmonics", c, coefficients[k].real, "harmonic", scale)
        tally.near("harmonics", s, -coefficients[k].imag, "harmonic", scale)
    if not case.rpm:
        tally.equal("vibration not run", (told, checks["vibration"]["note"].startswith("not run")), (None, True))
        return
    tally.near("frequency ratio", told["frequency_ratio"], ratio, "row")
    moving = movements(case)
    if not tally.equal("movements", len(told["movements"]), len(moving)):
        return
    most = 0.0 if moving else None
    for got in told["movements"]:
        match = [m for m in moving if abs(((got["from_deg"] - case.at) * DEG - m[0][0].low + 1e-6) % (TAU / case.lobes)) < 1e-5]
        if not tally.equal("movement's start", len(match), 1):
            continue
        movement = match[0]
        span = movement[-1][0].high + movement[-1][1] - movement[0][0].low
        tally.near("movement's end", got["to_deg"], got["from_deg"] + span / DEG, "row")
        tally.near("period ratio", got["period_ratio"], span / TAU * ratio, "row")
        want = float(residual(movement, ratio)[0])
        most = max(most, want)
        tally.near("residual", got["residual"], want, "vibration", 1e-3)
        worst = worst_residual(movement, 0.8 * ratio, 1.2 * ratio)
        tally.near("worst residual", got["residual_worst"], worst, "vibration", 1e-3)
        at = got["residual_worst_at_ratio"] / span * TAU
        tally.near("worst residual's place", float(residual(movement, at)[0]), worst, "place", 1e-3)
    check = checks["vibration"]
    tally.near("vibration", check["value"], most, "vibration", 1e-3)
    want = "info" if not case.limit or most is None else "pass" if most <= case.limit else "fail"
    tally.equal("vibration verdict", check["verdict"], want)
    for wave in told["resonances"]:
        tally.near("resonance", wave["rpm"], case.frequency * 60 / wave["order"], "row")
        tally.near("resonance amplitude", wave["amplitude"], abs(coefficients[wave["order"] - 1]), "harmonic", scale)
    # Load less follower: the quick series of the load, the closed form of the follower.
    r = orders / ratio
    if case.damping == 0 and np.abs(r - 1).min() < 1e-6:
        return
    load = coefficients / (1 - r**2 + 2j * case.damping * r)

    def deviation(segment, theta):
        wave = np.exp(1j * np.outer(theta + case.at * DEG, orders)) @ load
        return np.abs(mean / unit + wave.real - segment.at(theta)[0] / unit)

    # All peaks of a fine grid that may be the highest, by the fast Fourier transform; then each by steps.
    size = 1 << int(math.ceil(math.log2(12 * len(orders))))
    angles = np.arange(size) * TAU / size
    spectrum = np.zeros(size // 2 + 1, complex)
    spectrum[1 : len(load) + 1] = load * size / 2
    theta = (angles - case.at * DEG) % TAU
    lift = np.zeros(size)
    for segment in case.cam.segments:
        inside = (theta >= segment.low) & (theta <= segment.high)
        lift[inside] = segment.at(theta[inside])[0] / unit
    grid = np.abs(np.fft.irfft(spectrum, size) + mean / unit - lift)
    peaks = (grid >= np.roll(grid, 1)) & (grid >= np.roll(grid, -1)) & (grid > 0.99 * grid.max())
    fine = 0.0
    for at in np.nonzero(peaks)[0][:12]:
        near = angles[at] + np.linspace(-1, 1, 9) * TAU / size
        for _ in range(4):
            found = [max(float(deviation(s, np.array([x]))[0]) for s, x in sides(case, t / DEG)) for t in near]
            best = int(np.argmax(found))
            fine = max(fine, found[best])
            near = near[best] + np.linspace(-1, 1, 9) * (near[1] - near[0])
    tally.near("deviation", told["deviation_max"], fine, "deviation")
    tally.near("deviation's place", nearest(case, told["deviation_at_deg"], deviation, fine), fine, "deviation")


def compare(case, path, tally):
    out = path.parent
    code, text, error = call(case.binary, path, "--json", "--force", "--overwrite", "--samples", "180", "--tolerance", "50um", "--format", "csv",
                             "--out", str(out), "--name", path.stem)
    if not text:
        return tally.fail("run", f"exit {code}: {error}")
    report = json.loads(text)
    checks = {c["check"]: c for c in report["checks"]}
    tally.equal("exit code", code, int(any(c["verdict"] == "fail" for c in report["checks"])))
    compare_rows(case, report["files"][0], tally)
    if jamming(case.cam) > 0:
        compare_dynamics(case, report, checks, tally)
    else:
        tally.equal("dynamics of a follower that jams", "dynamics" in report, False)
    compare_closure(case, path, report, checks, tally)
    compare_contact(case, report, checks, tally)
    compare_vibration(case, report, checks, tally)


def refusals(binary, directory, tally):
    """Keys that do not fit: exit 2 and a message with the given words."""
    path = directory / "plain.toml"
    follower = {"mm": ["[follower.roller]", 'radius = "15 mm"', 'mass = "2 kg"'],
                "deg": ["[follower.swinging-roller]", 'radius = "15 mm"', 'arm = "110 mm"', 'pivot_distance = "140 mm"', 'inertia = "0.01 kg*m2"']}

    def write(unit, rpm="rpm = 200"):
        lines = ['name = "plain"', "[motion]", rpm, f'start = "0 {unit}"', "[[motion.segment]]", 'over = "90 deg"', f'to = "15 {unit}"',
                 "[[motion.segment]]", 'law = "dwell"', 'over = "90 deg"', "[[motion.segment]]", 'over = "100 deg"', f'to = "0 {unit}"',
                 "[[motion.segment]]", 'law = "dwell"'] + follower[unit] + ["[spring]"]
        lines += ['preload = "400 N"'] if unit == "mm" else ['preload = "20 N*m"']
        path.write_text("\n".join(lines + ["[cam]", 'base_radius = "40 mm"', 'thickness = "15 mm"', ""]))

    guide = ["guide.friction=0.1", 'guide.span="60 mm"']
    wrong = [
        ("mm", ['spring.rate="8 N*m/rad"'], ["spring.rate", "straight path", "N/mm"]),
        ("mm", ['spring.preload="8 N*m"'], ["spring.preload", "moment", "force"]),
        ("mm", ['spring.load="8 N*m"'], ["spring.load", "moment", "force"]),
        ("mm", ['spring.damping="1 N*m*s/rad"'], ["spring.damping", "N*s/m"]),
        ("deg", ['spring.rate="8 N/mm"'], ["spring.rate", "swings", "N*m/rad"]),
        ("deg", ['spring.preload="8 N"'], ["spring.preload", "force", "moment"]),
        ("deg", ['spring.load="8 N"'], ["spring.load", "swings"]),
        ("deg", ['spring.damping="1 N*s/m"'], ["spring.damping", "swings"]),
        ("deg", guide, ["guide", "straight path", "swings"]),
        ("deg", ['follower.swinging-roller.mass="2 kg"'], ["follower.swinging-roller.mass", "unknown key"]),
        ("mm", ['follower.roller.inertia="2 kg*m2"'], ["follower.roller.inertia", "unknown key"]),
        ("mm", ['follower.roller.mass="2 mm"'], ["follower.roller.mass", "kg"]),
        ("mm", ['follower.roller.mass="-2 kg"'], ["follower.roller.mass", "above 0"]),
        ("deg", ['follower.swinging-roller.inertia="0 kg*m2"'], ["inertia", "above 0"]),
        ("mm", ['follower.roller.crown_radius="0 mm"'], ["crown_radius", "above 0"]),
        ("mm", ['follower.roller.preload="-1 N"'], ["follower.roller.preload", "at least 0"]),
        ("mm", ['spring.rate="-1 N/mm"'], ["spring.rate", "at least 0"]),
        ("mm", ['spring.damping="-1 N*s/m"'], ["spring.damping", "at least 0"]),
        ("mm", ["guide.friction=-0.1", guide[1]], ["guide.friction", "at least 0"]),
        ("mm", [guide[0], 'guide.span="0 mm"'], ["guide.span", "above 0"]),
        ("mm", guide + ['guide.overhang="-1 mm"'], ["guide.overhang", "at least 0"]),
        ("mm", guide[:1], ["span"]),
        ("mm", ["flywheel.fluctuation=0"], ["flywheel.fluctuation", "above 0"]),
        ("mm", ['vibration.natural_frequency="0 Hz"'], ["natural_frequency", "above 0"]),
        ("mm", ['vibration.natural_frequency="40 mm"'], ["natural_frequency", "Hz"]),
        ("mm", ['vibration.natural_frequency="40 Hz"', "vibration.damping=1"], ["vibration.damping"]),
        ("mm", ['vibration.natural_frequency="40 Hz"', "vibration.damping=-0.1"], ["vibration.damping", "at least 0"]),
        ("mm", ["limits.jump_margin=0"], ["limits.jump_margin", "above 0"]),
        ("mm", ["motion.rpm=0"], ["motion.rpm"]),
        ("mm", ["motion.rpm=-5"], ["motion.rpm"]),
    ]
    for unit, settings, words in wrong:
        write(unit)
        options = [part for setting in settings for part in ("--set", setting)]
        code, _, error = call(binary, path, "--dry-run", "--json", *options)
        tally.title = " ".join(settings)
        tally.equal("refused", code, 2)
        tally.equal("message", [w for w in words if w not in error] and error, [])
    # Without a speed the vibration is not run, the jump speed stands without a limit, and power and flywheel stay away.
    write("mm", "")
    tally.title = "no speed"
    code, out, error = call(binary, path, "--dry-run", "--json", "--set", 'vibration.natural_frequency="40 Hz"', "--set", "flywheel.fluctuation=0.02")
    if tally.equal("runs", (code, error), (0, "")):
        report = json.loads(out)
        checks = {c["check"]: c for c in report["checks"]}
        tally.equal("vibration not run", checks["vibration"]["note"].startswith("not run"), True)
        tally.equal("jump speed told", (checks["jump_speed"]["verdict"], checks["jump_speed"]["limit"]), ("info", None))
        for key in ("power_mean_w", "power_max_w", "flywheel_kg_m2"):
            tally.equal(key, report["dynamics"].get(key), None)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("binary")
    parser.add_argument("directory")
    parser.add_argument("--count", type=int, default=60)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--verbose", action="store_true")
    options = parser.parse_args()
    directory = Path(options.directory) / "forces"
    directory.mkdir(parents=True, exist_ok=True)
    tally = Tally(options.verbose)
    refusals(options.binary, directory, tally)
    for number in range(options.first, options.first + options.count):
        case = Case(random.Random(f"{options.seed} {number}"))
        case.binary = str(Path(options.binary).resolve())
        path = directory / f"case-{number}.toml"
        path.write_text(case.toml())
        tally.title = f"{path.name} ({case.kind})"
        before = len(tally.wrong)
        with np.errstate(all="ignore"):
            compare(case, path, tally)
        if len(tally.wrong) == before:
            for file in directory.glob(f"{path.stem}*"):
                file.unlink()
    if options.verbose:
        for figure in tally.count:
            print(f"{figure:45} {tally.count[figure]:7} {tally.worst.get(figure, 0):9.1e}")
    print(f"{options.count} cams, {sum(tally.count.values())} figures, {len(tally.wrong)} wrong")
    sys.exit(len(tally.wrong) > 0)


if __name__ == "__main__":
    main()
