"""Random motion programs under every follower of `camgen make`, legal ones and ones at the walls, against motions, cams and contacts made here.

Shares nothing with camgen but the files it reads and writes. A law is a pattern of its acceleration, integrated piece by piece and scaled to
its ends by two linear conditions, or a textbook formula, or the polynomial of its end conditions; a follower is a complex number that is
differentiated by the product rule; the written outline is arcs and lines onto which the follower is let down along its own path until it touches.
Lift as rolled, the columns of the table, figures, peaks, jumps and the verdict of every check are compared; a refusal must be deserved.

usage: programs.py CAMGEN_BINARY DIRECTORY [--count N] [--seed N] [--verbose]
"""
import argparse
import json
import math
import random
import re
import shutil
import subprocess
import sys
import time
from collections import Counter, defaultdict
from pathlib import Path

import numpy as np
from program_cam import Follower, Outline, figures
from program_motion import ALIASES, ANGLES, HALVES, LENGTHS, NAMES, PI, POLYNOMIALS, SINES, TAU, Illegal, Program, law_pieces, quantity

LIMIT_S = 20.0


# ---------------------------------------------------------------- drawing of cases


def number(rng, value, exact=False):
    return repr(value) if exact or rng.random() < 0.2 else f"{value:.{rng.choice([3, 4, 6])}g}"


def length(rng, value, exact=False):
    unit = rng.choice(["mm", "mm", "mm", "cm", "in", "m"])
    return f"{number(rng, value / LENGTHS[unit], exact)} {unit}"


def angle(rng, value, exact=False):
    unit = rng.choice(["deg", "deg", "deg", "rad"])
    return f"{number(rng, value / ANGLES[unit], exact)} {unit}"


def rate_text(rng, value, order, swings, omega):
    of = rng.choice(["deg", "rad"] if swings else ["mm", "mm", "in", "m"])
    by = rng.choice(["deg", "rad", "rad"] + (["s"] if omega else []))
    each = omega if by == "s" else ANGLES[by]
    power = "" if order == 1 else str(order)
    return f"{value / (LENGTHS | ANGLES)[of] * each**order!r} {of}/{by}{power}"


def serving(start, end, equal):
    """Laws for two kinds of ends, R at rest, G moving, U turning, B and A accelerated."""
    both = start + end
    if "B" in both or "A" in both:
        return ["polynomial"]
    laws = list(HALVES) + ["polynomial"]
    if "U" in both:
        return laws + ["double-harmonic"] * 3 if both in ("RU", "UR") else laws
    laws += list(POLYNOMIALS)
    return laws + list(SINES) if both == "RR" or equal else laws


def own_numbers(rng, law):
    if law == "scca" and rng.random() < 0.8:
        shares = [rng.choice([0, rng.random(), rng.random(), rng.random()]) for _ in range(4)]
        shares[2] += 0.05
        shares = [share / sum(shares) for share in shares]
        return {"fractions": [*shares[:3], max(1 - sum(shares[:3]), 0.0)]}
    if law in ("parabola-line", "sine-line") and rng.random() < 0.7:
        return {"line": rng.choice([0.0, 0.25, 0.5, round(rng.uniform(0, 0.95), 3), 0.9999995])}
    if law == "s-curve" and rng.random() < 0.7:
        return {"ramp": rng.choice([0.5, 0.25, round(rng.uniform(0.02, 0.5), 3), 0.0])}
    if law == "triple-harmonic" and rng.random() < 0.7:
        return {"amplitudes": rng.choice([[7, 0, -2.4], [1, 0, 0], [round(rng.uniform(4, 8), 2), round(rng.uniform(-1, 1), 2), round(rng.uniform(-3, 3), 2)]])}
    return {}


def draw_motion(rng, swings):
    """`[motion]` and its segments, keys as text."""
    lobes = rng.choice([1] * 9 + [2, 3, 5])
    size = math.radians(rng.choice([rng.uniform(2, 12), rng.uniform(5, 40)])) if swings else rng.choice([rng.uniform(1, 8), rng.uniform(4, 40)])
    count = rng.choice([1, 2, 2, 3, 3, 4, 4, 5, 6]) if lobes == 1 else rng.choice([2, 2, 3])
    fill = TAU / lobes
    shares = [rng.uniform(0.3, 1) for _ in range(count)]
    if rng.random() < 0.12:
        shares[rng.randrange(count)] = rng.choice([0.1, 0.02, 0.003, 0.0005])
    widths = [fill * share / sum(shares) for share in shares]
    start = size * rng.choice([0, 0, 0, rng.uniform(-1, 1)])
    positions, high = [], rng.random() < 0.8
    for _ in range(count - 1):
        positions.append(start + size * (rng.uniform(0.5, 1) if high else rng.uniform(0, 0.3)))
        high = not high if rng.random() < 0.8 else high
    positions.append(start)
    kinds = [rng.choice("RRRRRRGUUBA") for _ in range(count)]
    if rng.random() < 0.35:
        kinds = ["R"] * count
    speeds = [rng.uniform(-0.3, 1.4) * (positions[i] - positions[i - 1]) / widths[i] if kinds[i] in "GB" else 0.0 for i in range(count)]
    fixed = [None] * count
    for i in range(count):
        chance = rng.random()
        if chance < 0.25 and count > 1 and not (i == count - 1 and fixed[i - 1]):
            fixed[i] = "dwell"
            if i == count - 1:
                positions[i - 1] = positions[i]
            elif i:
                positions[i] = positions[i - 1]
            else:
                positions[0] = start
            kinds[i] = kinds[i - 1] = "R"
            speeds[i] = speeds[i - 1] = 0.0
    for i in range(count):
        free = all(fixed[j] is None for j in (i - 1, i, (i + 1) % count)) and count > 2
        if free and rng.random() < 0.25 and abs(positions[i] - positions[i - 1]) > 0.05 * size:
            fixed[i] = "line"
            kinds[i] = kinds[i - 1] = "G"
            speeds[i] = speeds[i - 1] = (positions[i] - positions[i - 1]) / widths[i]
    motion = {}
    if rng.random() < 0.8:
        motion["rpm"] = rng.choice([60, 300, 1500, round(rng.uniform(1, 900), 1)])
    omega = motion["rpm"] * TAU / 60 if "rpm" in motion else None
    text = (lambda v, exact=False: angle(rng, v, exact)) if swings else (lambda v, exact=False: length(rng, v, exact))
    motion["start"] = text(start)
    at = 0.0
    if rng.random() < 0.25:
        at = rng.uniform(-PI, PI)
        motion["at"] = angle(rng, at)
        at = quantity(motion["at"])
    if lobes > 1:
        motion["repeat"] = lobes
    segments, behind, now = [], 0.0, quantity(motion["start"])
    for i in range(count):
        last = i == count - 1
        segment = {}
        if fixed[i] is None and abs(positions[i] - positions[i - 1]) < 1e-9 * size and rng.random() < 0.97:
            fixed[i] = "dwell" if kinds[i] + kinds[i - 1] == "RR" else "polynomial"
        equal = kinds[i - 1] == kinds[i] == "G" and speeds[i] == speeds[i - 1]
        law = fixed[i] or rng.choice(serving(kinds[i - 1], kinds[i], equal))
        if fixed[i] is None and rng.random() < 0.03:
            law = rng.choice(NAMES + ["dwell"])
        aliases = [alias for alias, name in ALIASES.items() if name == law]
        if not (law == "cycloidal" and rng.random() < 0.3):
            segment["law"] = rng.choice([law, law, *aliases]) if aliases else law
        if not last or rng.random() < 0.15:
            exact = last or law == "line"
            if rng.random() < 0.75:
                segment["over"] = angle(rng, fill - behind if last else widths[i], exact)
                width = quantity(segment["over"])
            else:
                segment["until"] = angle(rng, at + (fill if last else behind + widths[i]), exact)
                width = quantity(segment["until"]) - at - behind
        else:
            width = fill - behind
        if law == "line":
            speed = speeds[i] if last else (positions[i] - now) / width if width > 0 else 1.0
            form = 0 if last else rng.choice([0, 1, 2])
            if form:
                segment["velocity"] = rate_text(rng, speed, 1, swings, omega)
                if form == 2:
                    segment.pop("over", None)
                    segment.pop("until", None)
            if form != 1:
                segment["to"] = motion["start"] if last or positions[i] == start else text(positions[i], True)
            previous = segments[-1] if segments else None
            target = quantity(segment["to"]) if "to" in segment else now + speed * width
            exact_speed = (target - now) / width if width > 0 else 1.0
            if previous is not None and rng.random() < 0.95:
                previous["velocity"] = rate_text(rng, exact_speed, 1, swings, omega)
            now = target
        elif law != "dwell":
            if last:
                segment["to"] = motion["start"]
            elif positions[i] == start:
                segment["to"], now = motion["start"], quantity(motion["start"])
            elif rng.random() < 0.7:
                segment["to"] = text(positions[i])
                now = quantity(segment["to"])
            else:
                segment["by"] = text(positions[i] - now)
                now += quantity(segment["by"])
            if kinds[i] in "GB":
                segment["velocity"] = rate_text(rng, speeds[i], 1, swings, omega)
            if kinds[i] in "BA":
                segment["acceleration"] = rate_text(rng, rng.uniform(-3, 3) * size / max(widths) ** 2, 2, swings, omega)
            if kinds[i] == "U":
                segment["end"] = "turn"
            if law == "polynomial" and kinds[i] != "U" and rng.random() < 0.3:
                segment["jerk"] = rate_text(rng, rng.choice([0.0, rng.uniform(-5, 5) * size / max(widths) ** 3]), 3, swings, omega)
            segment.update(own_numbers(rng, law))
            if law in HALVES and rng.random() < 0.3:
                turns = "U" in (kinds[i], kinds[i - 1])
                odd = ["smooth", f"{rng.uniform(0.2, 0.8):.3f}", f"{rng.uniform(0.02, 0.98):.4f}", "0.9999995"]
                usual = [f"{rng.uniform(0.3, 0.7):.2f}"]
                segment["inflection"] = "match" if turns and rng.random() < 0.6 else rng.choice(odd if rng.random() < 0.3 else usual)
        behind += width
        segments.append(segment)
    return motion, segments, size


def draw(rng):
    kind = rng.choice(["roller", "roller", "knife", "swinging-roller", "swinging-roller", "flat", "swinging-flat"])
    swings = kind.startswith("swinging")
    motion, segments, size = draw_motion(rng, swings)
    radius = rng.uniform(3, 20)
    follower, cam, limits = {}, {}, {}
    scale = max(size * 100 if swings else size, 4.0)
    base = scale * rng.choice([rng.uniform(0.3, 1.5), rng.uniform(1, 4), rng.uniform(2, 8)])
    if kind in ("roller", "swinging-roller"):
        follower["radius"] = length(rng, radius)
    if kind in ("roller", "knife") and rng.random() < 0.6:
        prime = base + (radius if kind == "roller" else 0)
        follower["offset"] = length(rng, rng.choice([rng.uniform(-0.4, 0.4), rng.uniform(-0.4, 0.4), rng.choice([-1, 1]) * rng.uniform(0.9, 1.02)]) * prime)
    if kind == "swinging-roller":
        arm = rng.uniform(40, 160)
        follower["arm"] = length(rng, arm)
        prime = base + radius
        low, high = max(abs(prime - arm), arm * 0.2), prime + arm
        follower["pivot_distance"] = length(rng, rng.choice([rng.uniform(low, high), math.hypot(arm, prime), math.hypot(arm, prime) * 1.1, low * 1.01, high * 0.99]))
    if kind == "flat":
        if rng.random() < 0.5:
            follower["tilt"] = angle(rng, math.radians(rng.choice([rng.uniform(-25, 25), rng.uniform(-60, 60)])))
        if rng.random() < 0.4:
            follower["offset"] = length(rng, rng.uniform(-0.5, 0.5) * base)
    if kind == "swinging-flat":
        follower["pivot_distance"] = length(rng, base * rng.choice([rng.uniform(1.2, 4), rng.uniform(2, 5), rng.uniform(0.9, 1.3)]))
        if rng.random() < 0.6:
            follower["face_offset"] = length(rng, base * rng.uniform(-0.7, 0.5))
    if swings and rng.random() < 0.6:
        follower["side"] = rng.choice(["trailing", "leading"])
    if kind.endswith("flat") and rng.random() < 0.5:
        follower["width"] = length(rng, scale * rng.uniform(0.5, 4))
    if kind in ("roller", "knife", "flat") and "rpm" in motion and rng.random() < 0.25:
        follower["mass"], follower["preload"] = f"{rng.uniform(0.1, 5):.2f} kg", f"{rng.uniform(10, 2000):.0f} N"
    cam["base_radius"] = "auto" if rng.random() < 0.3 else length(rng, base)
    if rng.random() < 0.4:
        cam["rotation"] = rng.choice(["cw", "ccw", "ccw"])
    if rng.random() < 0.3:
        cam["bore_radius"] = length(rng, base * rng.uniform(0.1, 1.02))
    if rng.random() < 0.6:
        limits["pressure_angle"] = angle(rng, math.radians(rng.choice([rng.uniform(15, 60), rng.uniform(40, 89), 75])))
    if rng.random() < 0.5:
        limits["min_convex_pitch_radius_over_roller"] = rng.choice([0, 0.5, 1, 1.5])
    if rng.random() < 0.15:
        limits["continuity"] = rng.choice([0, 1, 2, 3])
    if rng.random() < 0.15:
        limits["cutter_radius"] = length(rng, rng.uniform(2, 40))
    words = ["--tolerance", rng.choice(["1um", "5um", "5um", "50um"]), "--samples", str(rng.choice([181, 240, 360]))]
    words += ["--tolerance-acceleration", "none"] if rng.random() < 0.5 else []
    words += ["--force"] if rng.random() < 0.5 else []
    return {"kind": kind, "motion": motion, "segments": segments, "follower": follower, "cam": cam, "limits": limits, "words": words}


def written(case):
    show = lambda v: json.dumps(v)
    lines = ['name = "random"', "[motion]"] + [f"{k} = {show(v)}" for k, v in case["motion"].items()]
    for segment in case["segments"]:
        lines += ["[[motion.segment]]"] + [f"{k} = {show(v)}" for k, v in segment.items()]
    for title, table in ((f"follower.{case['kind']}", case["follower"]), ("cam", case["cam"]), ("limits", case["limits"])):
        lines += [f"[{title}]"] + [f"{k} = {show(v)}" for k, v in table.items()]
    return "\n".join(lines) + "\n"


# ---------------------------------------------------------------- judging


class Judge:
    """One case: what camgen said and wrote against what is known here."""

    worst = defaultdict(float)

    def __init__(self, case, program):
        self.case, self.program, self.wrong = case, program, []
        self.swings = case["kind"].startswith("swinging")
        self.unit = PI / 180 if self.swings else 1.0
        self.ccw = case["cam"].get("rotation") == "ccw"

    def close(self, what, told, true, allowed):
        """Arrays or numbers within `allowed`; keeps the largest share of it for the summary."""
        told, true = np.asarray(told, float), np.asarray(true, float)
        with np.errstate(invalid="ignore", divide="ignore"):
            off = np.where(told == true, 0.0, np.abs(told - true)) / allowed
        off = np.where(np.isnan(off), math.inf, off)
        at = int(np.argmax(off)) if off.ndim else 0
        if off.max(initial=0) > 1:
            one, other = (float(np.ravel(np.broadcast_to(values, told.shape))[at]) for values in (told, true))
            self.wrong.append(f"{what}[{at}] told {one!r}, is {other!r}, {off.max():.3g} of the allowed")
        else:
            Judge.worst[what] = max(Judge.worst[what], float(off.max(initial=0)))

    def report(self, report, follower):
        program, cam = self.program, report["cam"]
        top = program.extreme(lambda i, t: program.jet(i, t, 0)[0])[0] - program.lowest
        told = cam["max_lift_deg" if self.swings else "max_lift_mm"] * self.unit
        self.close("lowest position, by the largest lift", told, top, 1e-9 * program.size + 1e-12)
        if self.wrong:
            return
        self.own = figures(program, follower)
        self.corner, self.clear, rises = self.drops()
        if follower.circle and rises:
            # A velocity that rises leaves the roller's own shape.
            self.own["concave"] = min(self.own["concave"] or math.inf, follower.radius)
        self.close("base radius", cam["base_radius_mm"], follower.base, 1e-9 * follower.base)
        self.close("prime radius", cam["prime_radius_mm"], follower.prime, 1e-9 * follower.prime)
        if len(report["motion"]["segments"]) != len(program.segments):
            self.wrong.append("number of segments")
        for told, segment in zip(report["motion"]["segments"], program.segments):
            self.segment(told, segment)
        self.checks(report, follower)

    def drops(self):
        """Whether the velocity drops somewhere, which leaves a corner, sharp under a roller, folded under a face; whether each jump is
        clearly one or none; whether it rises somewhere."""
        size = self.program.extreme(lambda i, t: np.abs(self.program.jet(i, t, 1)[1]))[0]
        shares = [(before - after) / max(size, 1e-300) for before, after in self.program.across(1)]
        return max(shares) > 1e-8, all(abs(share) > 1e-8 or abs(share) < 1e-10 for share in shares), min(shares) < -1e-8

    def segment(self, told, segment):
        program = self.program
        parts = [i for i, part in enumerate(program.parts) if part[2] is segment]
        begin = program.segments[program.segments.index(segment) - 1].state
        letter = lambda s: "U" if s["turn"] or s["v"] == 0 and s["a"] != 0 else "RGB"[(s["v"] != 0) + (s["v"] != 0 and s["a"] != 0)]
        kinds = f"{letter(begin)}-{letter(segment.state)}"
        if (told["law"], told["class"]) != (segment.law, kinds):
            self.wrong.append(f"segment told {told['law']} {told['class']}, is {segment.law} {kinds}")
        self.close("segment angles", [told["from_deg"], told["to_deg"]], np.degrees([segment.start, segment.start + segment.width]), 1e-8)
        self.close("segment ends", np.array([told["from"], told["to"]]) * self.unit, [segment.begin, segment.to], 1e-10 * (program.size + 1e-3))
        for order, name in ((1, "velocity"), (2, "acceleration"), (3, "jerk")):
            peak = program.extreme(lambda i, t: np.abs(program.jet(i, t)[order]), parts)[0]
            natural = max(abs(segment.scale), abs(segment.to - segment.begin)) / segment.width**order if segment.law != "dwell" else 1.0
            if told["peaks"][name] is not None:
                self.close(f"peak {name}", told["peaks"][name] * self.unit, peak, 1e-8 * peak + 1e-10 * natural)
        ends = sorted((segment.begin, segment.to))
        high = program.extreme(lambda i, t: program.jet(i, t, 0)[0], parts)[0]
        low = -program.extreme(lambda i, t: -program.jet(i, t, 0)[0], parts)[0]
        self.close("overshoot", told["overshoot"] * self.unit, max(high - ends[1], ends[0] - low, 0.0), 2e-9 * (high - low + program.size) + 1e-12)

    def checks(self, report, follower):
        """Value, limit and verdict of each check by own figures; every failure must be one."""
        own, limits, told = self.own, self.case["limits"], {c["check"]: c for c in report["checks"]}
        shares = self.program.jump()
        value = next((order for order, share in enumerate(shares) if share > 1e-9), 3)
        clear = all(share < 1e-11 or share > 1e-7 for share in shares[: value + 1])
        if clear and told["continuity"]["value"] != value:
            self.wrong.append(f"continuity told {told['continuity']['value']}, jumps {shares}")
        self.verdict(told, "continuity", value if clear else None, 0, lambda v, limit: v >= limit, limits.get("continuity", 1))
        if self.case["kind"].endswith("flat"):
            usual = None
        else:
            usual = math.radians(45 if self.swings else 30)
        limit = quantity(limits["pressure_angle"]) if "pressure_angle" in limits else usual
        self.verdict(told, "pressure_angle", math.degrees(own["alpha"]), 1e-4, lambda v, top: v <= top, limit and math.degrees(limit))
        if self.corner and self.clear:
            if told["undercut"]["verdict"] != "fail":
                self.wrong.append("a corner is not told as an undercut")
        elif follower.circle and self.clear:
            scale = abs(own["convex"]) * 1e-6 + 1e-7
            self.verdict(told, "undercut", own["convex"] - follower.radius, scale, lambda v, top: v > top, 0.0)
            if follower.kind != "knife":
                ratio = limits.get("min_convex_pitch_radius_over_roller", 2.0)
                self.verdict(told, "min_convex_radius", own["convex"], scale, lambda v, top: v >= top, ratio * follower.radius)
            if self.clear and told["undercut"]["verdict"] != "fail":
                cutter = quantity(limits["cutter_radius"]) if "cutter_radius" in limits else None
                if (told["cutter_radius"]["value"] is None) == (own["concave"] is None) and own["concave"] is not None:
                    self.verdict(told, "cutter_radius", own["concave"], 1e-6 * own["concave"] + 1e-7, lambda v, top: v >= top, cutter)
                elif own["concave"] is not None and own["concave"] < 1e6:
                    self.wrong.append(f"cutter_radius told {told['cutter_radius']['value']}, is {own['concave']}")
        elif self.clear and own["turn"] > 0:
            self.verdict(told, "undercut", own["radius"], 1e-6 * (abs(own["radius"]) + follower.base), lambda v, top: v > top, 0.0)
            low, high = own["face"]
            width = high - low if self.swings else 2 * max(-low, high)
            if "face_mm" in report["cam"]:
                self.close("face", report["cam"]["face_mm"], [low, high], 1e-7 * (abs(low) + abs(high) + follower.base))
            if "width" in self.case["follower"]:
                self.verdict(told, "face_width", width, 1e-7 * (width + follower.base), lambda v, top: v <= top, quantity(self.case["follower"]["width"]))
        if "mass" in self.case["follower"]:
            mass, preload = (float(self.case["follower"][key].split()[0]) for key in ("mass", "preload"))
            most = self.program.extreme(lambda i, t: -self.program.jet(i, t)[2])[0] * 1e-3 * self.program.omega**2
            self.verdict(told, "force_closure", preload - mass * most, 1e-7 * (preload + mass * abs(most)), lambda v, top: v > top, 0.0)
        self.failed = {name for name, check in told.items() if check["verdict"] == "fail"}
        known = {"continuity", "pressure_angle", "undercut", "min_convex_radius", "cutter_radius", "face_width", "force_closure", "wall"}
        # What is lost to an undercut has a corner, and is missed by the follower.
        known |= {"tangency", "rolling", "outline"} if "undercut" in self.failed else set()
        if self.failed - known:
            self.wrong.append(f"failed {self.failed - known} besides {self.failed & known}")
        for name in ("pressure_angle", "undercut", "min_convex_radius"):
            hint = re.search(r"a base radius of (\S+) mm would pass", told.get(name, {}).get("note") or "")
            if hint and not (self.keeps(self.case["kind"], float(hint[1])) and not self.corner):
                self.wrong.append(f"{name}: {hint[0]}, but it does not")

    def verdict(self, told, name, value, allowed, passes, limit):
        check = told.get(name)
        if check is None:
            self.wrong.append(f"no check {name}")
            return
        if limit is not None and check["limit"] is not None:
            self.close(f"limit of {name}", check["limit"], limit, 1e-9 * (1 + abs(limit)))
        if value is not None:
            self.close(name, check["value"], value, allowed or 1e-12)
            if limit is not None and abs(value - limit) > allowed or allowed == 0:
                said = check["verdict"] != "fail"
                if said != bool(passes(value, limit)):
                    self.wrong.append(f"{name}: verdict {check['verdict']} of {value} at limit {limit}")

    def table(self, path, follower):
        program, size = self.program, self.program.size
        text = path.read_text().split("\n")
        rows = np.array([line.split(",") for line in text[1:] if line]).astype(float)
        columns = dict(zip(text[0].split(","), rows.T))
        if np.isnan(rows).any():
            self.wrong.append("NaN in the table")
        count = int(self.case["words"][self.case["words"].index("--samples") + 1])
        theta = np.radians(columns["cam_deg"])
        self.close("cam_deg", columns["cam_deg"], 360 * np.arange(count) / count, 1e-9)
        sides = [program.everywhere(theta, nudge) for nudge in (0.0, 1e-9, -1e-9)]
        q = "deg" if self.swings else "mm"
        r = "rad" if self.swings else "mm"
        near = lambda values, told: np.stack(values)[np.argmin(np.abs(np.stack(values) - told), axis=0), np.arange(count)]
        # What a rounding of the angle makes of each derivative.
        steep = [np.abs(sides[0][order]).max() for order in range(4)]
        for order, name in enumerate((f"position_{q}", f"velocity_{r}_per_rad", f"acceleration_{r}_per_rad2", f"jerk_{r}_per_rad3")):
            told = columns[name] * (self.unit if order == 0 else 1.0)
            peak = program.extreme(lambda i, t: np.abs(program.jet(i, t)[order]))[0]
            higher = program.extreme(lambda i, t: np.abs(program.jet(i, t, order + 1)[order + 1]))[0]
            self.close(name, told, near([side[order] for side in sides], told), 1e-9 * peak + 1e-14 * higher + 1e-12 * size + 1e-300)
        self.close("lift", columns[f"lift_{q}"] * self.unit, columns[f"position_{q}"] * self.unit - program.lowest, 1e-10 * (size + 1e-3) + 1e-9 * steep[0])
        found = [follower.curves(theta, side[0] - program.lowest, side[1], side[2]) for side in sides]
        flip = np.conj if self.ccw else (lambda z: z)
        sharp = 1e-9 * (follower.prime + steep[0] + steep[1] + follower.pivot)
        for key, name in (("centre", "pitch"), ("profile", "profile")):
            told = columns[f"{name}_x_mm"] + 1j * columns[f"{name}_y_mm"]
            self.close(f"{name} points", np.min([np.abs(told - flip(c[key])) for c in found], axis=0), 0.0, sharp)
        self.close("pressure_angle_deg", np.min([np.abs(np.degrees(c["alpha"]) - columns["pressure_angle_deg"]) for c in found], axis=0), 0.0, 1e-6)
        pitch, profile = columns["pitch_curvature_radius_mm"], columns["profile_curvature_radius_mm"]
        bend = [np.abs(1 / pitch - c["curvature"]) / (1e-7 * (np.abs(c["curvature"]) + 1 / follower.prime)) for c in found]
        self.close("pitch_curvature_radius_mm", np.min(bend, axis=0), 0.0, 1.0)
        finite = np.isfinite(profile) & np.isfinite(pitch)
        self.close("profile_curvature_radius_mm", profile[finite], (pitch - (follower.radius if follower.circle else 0.0))[finite], 1e-9 * (np.abs(pitch[finite]) + follower.prime))
        if found[0]["face"] is not None:
            self.close("face_mm", np.min([np.abs(columns["face_mm"] - c["face"]) for c in found], axis=0), 0.0, 10 * sharp)
        if "mass" in self.case["follower"]:
            mass, preload = (float(self.case["follower"][key].split()[0]) for key in ("mass", "preload"))
            force = preload + mass * columns["acceleration_mm_per_rad2"] * 1e-3 * program.omega**2
            self.close("roller_force_n", columns["roller_force_n"], force, 1e-9 * (np.abs(force).max() + preload))
            self.close("torque_nm", columns["torque_nm"], force * columns["velocity_mm_per_rad"] * 1e-3, 1e-9 * (np.abs(force).max() + preload) * (steep[1] + 1))

    def rolled(self, path, report, follower, rng):
        """The follower let down on the outline: within the tolerance along the normal all round."""
        outline = Outline(path, self.ccw)
        cam, tolerance = report["cam"], report["outline"]["tolerance_mm"]
        self.close("area", cam["area_mm2"], outline.area - self.bore(), 1e-8 * outline.area)
        self.close("length", report["outline"]["length_mm"], outline.length, 1e-8 * outline.length)
        self.close("arcs and lines", [report["outline"]["arcs"], report["outline"]["lines"]], [outline.arc.sum(), (~outline.arc).sum()], 0.5)
        wall = next((c for c in report["checks"] if c["check"] == "wall"), None)
        if wall and wall["value"] is not None and "bore_radius" in self.case["cam"]:
            self.close("wall", wall["value"], outline.nearest - quantity(self.case["cam"]["bore_radius"]), 1.1 * tolerance)
        joints = np.concatenate([np.array([low, high]) for low, high, _, _ in self.program.parts])
        theta = np.concatenate([np.arange(2000) * TAU / 2000 + rng.uniform(0, 1e-3), joints + 1e-7, joints - 1e-7])
        s, v, a, _ = self.program.everywhere(theta)
        s = s - self.program.lowest
        lift = outline.lift(follower, theta, s)
        curves = follower.curves(theta, s, v, a)
        drive = follower.arm if follower.kind == "swinging-roller" else np.abs(curves["face"]) if self.swings else 1.0
        gap = np.abs(lift - s) * drive * np.abs(np.cos(curves["alpha"]))
        if self.failed & {"rolling", "outline", "undercut"}:
            return float(gap.max()) > tolerance
        # On its way in the follower may meet another lobe: there the gap is taken where it should be.
        far = np.nonzero(gap > tolerance)[0]
        if follower.circle and len(far):
            gap[far] = np.abs(outline.distance(curves["centre"][far]) - follower.radius)
        worst = int(np.argmax(gap))
        Judge.worst["gap over tolerance"] = max(Judge.worst["gap over tolerance"], float(gap[worst]) / tolerance)
        # The foot of the normal moves on by the gap: a share of it for what bends and leans there.
        lean = 1 / max(abs(math.cos(curves["alpha"][worst])), 1e-3)
        if gap[worst] > tolerance * (1 + 0.05 * lean) + 1e-6:
            self.wrong.append(f"rolled {1e3 * gap[worst]:.4f} µm off along the normal at {math.degrees(theta[worst]):.5f} deg, tolerance {1e3 * tolerance:.4f} µm")
        return True

    def bore(self):
        return PI * quantity(self.case["cam"]["bore_radius"]) ** 2 if "bore_radius" in self.case["cam"] else 0.0

    def automatic(self, report):
        """An automatic size keeps every limit, and the smallest told breaks one just below."""
        told, kind = report["cam"], self.case["kind"]
        if "smallest_prime_radius_mm" not in told or self.drops()[0]:
            # A corner is as sharp on a cam of any size.
            if "smallest_prime_radius_mm" in told or not self.drops()[0]:
                self.wrong.append(f"smallest prime radius told {told.get('smallest_prime_radius_mm')}, velocity drops {self.drops()}")
            return
        smallest = told["smallest_prime_radius_mm"]
        r = told["prime_radius_mm"] - told["base_radius_mm"]
        if told["prime_radius_mm"] < smallest * (1 - 1e-9):
            self.wrong.append(f"automatic prime radius {told['prime_radius_mm']} below the smallest {smallest}")
        bore = quantity(self.case["cam"]["bore_radius"]) if "bore_radius" in self.case["cam"] else 0.0
        for share, expected in ((1 + 1e-6, True), (1 - 1e-5, False)):
            prime = smallest * share
            # A millimetre of wall, and of the disc itself.
            if prime - r <= (bore + 1) * (1 + 1e-4):
                continue
            if self.keeps(kind, prime - r) != expected:
                self.wrong.append(f"smallest prime radius told {smallest}: {'breaks' if expected else 'keeps'} the limits at {prime}")

    def keeps(self, kind, base):
        try:
            follower = Follower(kind, self.case["follower"], base)
            follower.reach(self.program.extreme(lambda i, t: self.program.jet(i, t, 0)[0])[0] - self.program.lowest)
        except Illegal:
            return False
        own, limits = figures(self.program, follower), self.case["limits"]
        usual = math.inf if kind.endswith("flat") else math.radians(45 if self.swings else 30)
        limit = quantity(limits["pressure_angle"]) if "pressure_angle" in limits else usual
        if follower.circle:
            ratio = 0.0 if kind == "knife" else limits.get("min_convex_pitch_radius_over_roller", 2.0)
            cutter = quantity(limits["cutter_radius"]) if "cutter_radius" in limits else 0.0
            fits = own["concave"] is None or own["concave"] >= cutter
            return own["alpha"] <= limit + 1e-9 and own["convex"] > max(1.0, ratio) * follower.radius and fits
        # Sharper than a millimetre is an edge.
        return own["alpha"] <= limit + 1e-9 and own["radius"] >= 1.0 and own["turn"] > 0


REASONS = {
    "serve": "cannot ", "accelerated": "cannot begin or end with an acceleration", "travel": "needs a travel|needs `to`", "inflection": "inflection",
    "parameter": "must be ", "sum": "the segments|must be behind|already cover|greater than|above 0|`over`", "rpm": "needs motion.rpm",
    "dwell": "a dwell", "return": "does not end where it starts", "line": "do not fit", "reach": "offset|reach|pivot|arm|lever|swing",
    "bore": "bore_radius", "back": "turns back|does not reach", "over": "`over`", "end": "turn|rest",
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
        program = Program(case["motion"], case["segments"])
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


def one(runner, case, name, rng, tally, samples):
    """Runs and judges a case; the list of what is wrong."""
    path, out = runner.directory / f"{name}.toml", runner.directory / name
    path.write_text(written(case))
    shutil.rmtree(out, ignore_errors=True)
    program, follower, reason = expected(case)
    code, stdout, stderr, took = runner.run(path, out, case["words"])
    files = sorted(p.name for p in out.iterdir()) if out.exists() else []
    Judge.worst["seconds"] = max(Judge.worst["seconds"], took)
    if code not in (0, 1, 2):
        return [f"exit {code}: {stderr[:400]}"]
    if code == 2:
        return refused(case, stderr, files, reason, program, tally, samples)
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
    tally[f"exit {code}" + (" " + "+".join(sorted(judge.failed)) if code else "")] += 1
    if files:
        if {"cam.csv", "cam.dxf", "cam.json"} - set(files):
            judge.wrong.append(f"files {files}")
        if {**json.loads((out / "cam.json").read_text()), "files": None} != {**report, "files": None}:
            judge.wrong.append("the report as a file is not the one on stdout")
        judge.table(out / "cam.csv", follower)
        deserved = judge.rolled(out / "cam.dxf", report, follower, rng)
        if "undercut" not in judge.failed and judge.failed & {"rolling", "outline"} and not deserved:
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


def refused(case, stderr, files, reason, program, tally, samples):
    """Exit 2: no file, a place in the file, and a reason known here."""
    wrong = [f"exit 2 wrote {files}"] if files else []
    message = stderr.split("\n")[0]
    if not re.search(r"--> \S+:\d+:\d+", stderr) and not re.search(r"(cam|follower|limits|motion)\.[a-z_]+", message):
        wrong.append(f"exit 2 without a place: {stderr[:300]}")
    if reason is None and case["cam"]["base_radius"] == "auto" and "no base radius keeps the limits" in stderr:
        reason = "no automatic size"
    if "more than a drawing holds" in stderr and program and max(abs(program.lowest), program.size) > 1e5:
        reason = "too large"
    if reason is None:
        wrong.append(f"refused, but legal: {stderr[:400]}")
    tally[f"exit 2 {reason}"] += 1
    samples.setdefault(f"{reason}: {re.sub('[-0-9.e]+', '#', message)[:70]}", message)
    if reason and not any(re.search(REASONS.get(one, ""), stderr) for one in reason.split(", ")):
        wrong.append(f"{reason} is told as: {stderr[:400]}")
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
    words.add_argument("--verbose", action="store_true", help="samples of the messages, and the whole of what is wrong")
    given = words.parse_args()
    given.directory.mkdir(parents=True, exist_ok=True)
    golden()
    runner, tally, samples, failures = Runner(given.binary, given.directory), Counter(), {}, 0
    started = time.monotonic()
    for index in range(given.count):
        rng = random.Random(f"{given.seed}-{index}")
        case, name = draw(rng), f"case-{given.seed}-{index}"
        wrong = one(runner, case, name, rng, tally, samples)
        if wrong:
            failures += 1
            shown = wrong if given.verbose else wrong[:2]
            print(f"{name} {case['kind']}: " + "\n    ".join(shown) + f"\n    {name}.toml {' '.join(case['words'])}")
        else:
            (given.directory / f"{name}.toml").unlink()
    seconds = time.monotonic() - started
    if given.verbose:
        print("\n".join(f"{key}\n    {message}" for key, message in sorted(samples.items())))
    print("\n".join(f"{count:6} {what}" for what, count in sorted(tally.items())))
    print("worst of the allowed: " + ", ".join(f"{key} {value:.2g}" for key, value in sorted(Judge.worst.items())))
    print(f"{given.count} programs, {failures} wrong, {given.count / seconds:.1f} a second")
    sys.exit(failures > 0)


main()
