"""What camgen said and wrote about one program against what is known here: figures, verdicts, table and the outline as rolled."""
import json
import math
import re
from collections import defaultdict

import numpy as np
from program_cam import Follower, Outline, figures
from program_forces import Load
from program_motion import PI, TAU, Illegal, quantity


class Judge:
    """One case: what camgen said and wrote against what is known here."""

    worst = defaultdict(float)

    def __init__(self, case, program):
        self.case, self.program, self.wrong = case, program, []
        self.load = Load(case, program)
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
        self.close("lowest position, by the largest lift", told, top, 1e-9 * program.size + 1e-12 + 1e-11 * abs(top))
        if self.wrong:
            return
        self.own, self.prime = figures(program, follower), follower.prime
        (self.corner, self.rises), self.clear = self.drops(), self.clear_drops(follower)
        if follower.circle and self.rises:
            # A velocity that rises leaves the roller's own shape.
            self.own["concave"] = min(self.own["concave"] or math.inf, follower.radius)
        self.close("base radius", cam["base_radius_mm"], follower.base, 1e-9 * follower.base)
        self.close("prime radius", cam["prime_radius_mm"], follower.prime, 1e-9 * follower.prime)
        if len(report["motion"]["segments"]) != len(program.segments):
            self.wrong.append("number of segments")
        for told, segment in zip(report["motion"]["segments"], program.segments):
            self.segment(told, segment)
        self.checks(report, follower)

    def jumps(self):
        """How far the velocity drops at each node, over its largest value, and that value."""
        size = self.program.extreme(lambda i, t: np.abs(self.program.derivative(i, t, 1)))[0]
        return [(before - after) / max(size, 1e-300) for before, after in self.program.across(1)], size

    def drops(self):
        """Whether the velocity drops somewhere, which leaves a corner, sharp under a roller, folded under a face; whether it rises."""
        shares, _ = self.jumps()
        return max(shares) > 1e-8, min(shares) < -1e-8

    def clear_drops(self, follower, prime=0.0):
        """Whether each jump is clearly one or none. A corner of the path of less than 1e-7 rad may be one or none; the path turns by the
        jump over its speed, of which this is a bound."""
        shares, size = self.jumps()
        arm = {"swinging-roller": follower.arm, "swinging-flat": follower.pivot}.get(self.case["kind"], 1.0)
        least = 1e-7 * (size + 2.0 * max(self.prime, prime) / arm) / max(size, 1e-300)
        return all(abs(share) < 1e-10 or abs(share) > max(1e-8, least) for share in shares)

    def kinds(self, segment, parts):
        """What its ends are: rest, straight on, turn or moved, as said or, of a motion given in one, as it is; None where that is too close."""
        states = [self.program.segments[self.program.segments.index(segment) - 1].state, segment.state]
        if segment.whole or self.program.driven and segment.law != "dwell":
            ends = [(parts[0], self.program.parts[parts[0]][0]), (parts[-1], self.program.parts[parts[-1]][1])]
            jets = [[float(d[0]) for d in self.program.jet(i, np.array([t]), 2)] for i, t in ends]
            peaks = [self.program.extreme(lambda i, t: np.abs(self.program.derivative(i, t, order)), parts)[0] for order in (1, 2)]
            # At resonance the cam of an elastic load is a circle and rounding.
            if min(peaks) < 1e-10 * self.program.size:
                return None
            shares = [abs(jet[order]) / max(peaks[order - 1], 1e-300) for jet in jets for order in (1, 2)]
            if any(1e-13 < share < 1e-6 for share in shares):
                return None
            states = [{"turn": False} | {key: value if abs(value) > 1e-9 * peak else 0.0 for key, value, peak in zip("va", jet[1:], peaks)} for jet in jets]
        elif any(state.get("near") or 0 < abs(state[key]) < 1e-9 * abs(segment.to - segment.begin) for state in states for key in "va"):
            return None
        letter = lambda s: "U" if s["turn"] or s["v"] == 0 and s["a"] != 0 else "RGB"[(s["v"] != 0) + (s["v"] != 0 and s["a"] != 0)]
        return "-".join(letter(state) for state in states)

    def segment(self, told, segment):
        program = self.program
        parts = [i for i, part in enumerate(program.parts) if part[2] is segment]
        kinds = self.kinds(segment, parts)
        if told["law"] != segment.law or kinds and told["class"] != kinds:
            self.wrong.append(f"segment told {told['law']} {told['class']}, is {segment.law} {kinds}")
        self.close("segment angles", [told["from_deg"], told["to_deg"]], np.degrees([segment.start, segment.start + segment.width]), 1e-8)
        ends = [segment.begin, segment.to]
        if segment.whole or program.driven:
            # Of an elastic load the positions are its own, and the peaks those of its cam.
            own = [(getattr(segment.pieces[end], "piece", segment.pieces[end]), x) for end, x in ((0, 0.0), (-1, 1.0))]
            ends = [segment.begin + segment.scale * float(piece.at(np.array([x]), 0)[0]) for piece, x in own]
        self.close("segment ends", np.array([told["from"], told["to"]]) * self.unit, ends, 1e-10 * (program.size + 1e-3))
        for order, name in ((1, "velocity"), (2, "acceleration"), (3, "jerk")):
            peak = program.extreme(lambda i, t: np.abs(program.derivative(i, t, order)), parts)[0]
            natural = max(abs(segment.scale), abs(segment.to - segment.begin)) / segment.width**order if segment.law != "dwell" else 1.0
            natural += 1e10 * program.noise[order]
            if told["peaks"][name] is not None:
                self.close(f"peak {name}", told["peaks"][name] * self.unit, peak, 1e-8 * peak + 1e-10 * natural)
        ends = sorted(ends)
        high = program.extreme(lambda i, t: program.jet(i, t, 0)[0], parts)[0]
        low = -program.extreme(lambda i, t: -program.jet(i, t, 0)[0], parts)[0]
        over = 0.0 if segment.whole else max(high - ends[1], ends[0] - low, 0.0)
        # What is below a millionth is rounding.
        if told["overshoot"] or over > 1e-6 * max(high - low, program.size):
            self.close("overshoot", told["overshoot"] * self.unit, over, 2e-9 * (high - low + program.size) + 1e-12)

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
            # Round a corner a knife edge loses nothing: the impact is the fault.
            if (told["undercut"]["verdict"] != "fail") != (follower.kind == "knife"):
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
        self.forces(told, report, follower)
        self.failed = {name for name, check in told.items() if check["verdict"] == "fail"}
        self.apart = "does not touch along its path" in ((told.get("rolling") or {}).get("note") or "")
        known = {"continuity", "pressure_angle", "undercut", "min_convex_radius", "cutter_radius", "face_width", "force_closure", "jump_speed", "wall", "size"}
        known |= self.kink(told, follower)
        # What is bent as sharp as the tolerance cannot be told from a corner.
        bent = own["convex"] - follower.radius if follower.circle else own["radius"]
        if follower.kind == "knife":
            bent = own["concave"] or math.inf
        self.sharp = report["outline"] is not None and bent < 2 * report["outline"]["tolerance_mm"]
        known |= {"outline", "rolling"} if self.sharp or not self.clear else set()
        # What is lost to an undercut has a corner, and is missed by the follower.
        known |= {"tangency", "rolling", "outline"} if "undercut" in self.failed else set()
        if self.failed - known:
            self.wrong.append(f"failed {self.failed - known} besides {self.failed & known}")
        for name in ("pressure_angle", "undercut", "min_convex_radius"):
            hint = re.search(r"a base radius of (\S+) mm would pass", told.get(name, {}).get("note") or "")
            # A corner that may be one or none may be kept or not.
            if hint and self.clear_drops(follower, float(hint[1])) and not (self.keeps(self.case["kind"], float(hint[1])) and not self.corner):
                self.wrong.append(f"{name}: {hint[0]}, but it does not")

    def kink(self, told, follower):
        """A velocity that rises leaves a hollow corner in the path: a roller rounds it, the profile of a knife keeps it. Of a face it is a
        straight piece of the profile."""
        if follower.kind != "knife" or "undercut" in self.failed:
            return set()
        worst = 0.0
        for i, (before, after) in enumerate(self.program.across(1)):
            j = (i + 1) % len(self.program.parts)
            s = float(self.program.jet(j, np.array([self.program.parts[j][0]]), 0)[0][0]) - self.program.lowest
            z = follower.height + s + 1j * follower.offset
            worst = max(worst, abs(math.degrees(np.angle((1j * z + after) / (1j * z + before)))))
        if worst > 0.05 * (1 + 1e-3):
            self.close("tangency of a corner", told["tangency"]["value"], worst, 1e-3 * worst + 0.01)
            return {"tangency"}
        return set()

    def forces(self, told, report, follower):
        """Whether the follower stays on its cam at the speed given, and up to which it does."""
        load = self.load
        moving = self.program.extreme(lambda i, t: np.abs(self.program.derivative(i, t, 2)))[0] > 0
        expected = {"force_closure": load.moves and load.omega > 0 or load.pressed, "jump_speed": load.moves and load.constant > 0 and moving}
        for name, runs in expected.items():
            ran = name in told and told[name]["value"] is not None
            if ran != runs:
                self.wrong.append(f"{name} told {told.get(name)}, should it run: {runs}")
        if self.wrong or not expected["force_closure"]:
            return
        if self.clear:
            least = load.least(follower)
            size = max(abs(load.constant), self.program.extreme(lambda i, t: np.abs(load.along(follower)(i, t)[0]))[0])
            self.verdict(told, "force_closure", least[0], 1e-7 * size, lambda v, top: v > top, 0.0)
            dynamics, torque = report["dynamics"], lambda i, t: load.torque(i, t)
            largest, smallest = self.program.extreme(torque)[0], -self.program.extreme(lambda i, t: -torque(i, t))[0]
            each = 1e-7 * max(largest, -smallest) + 1e-12 * size + 1e-12
            self.close("torque_max_nm and least", [dynamics["torque_max_nm"], dynamics["torque_min_nm"]], [largest, smallest], each)
            most = self.program.extreme(lambda i, t: load.along(follower)(i, t)[1])[0]
            ends = [dynamics["contact_force_max_n"], dynamics["contact_force_min_n"]]
            self.close("contact_force_max_n and least", ends, [max(most, 0), max(least[1], 0)], 1e-7 * (size + abs(most)) + 1e-12)
        if expected["jump_speed"]:
            speed, rpm = load.jump() * 60 / TAU, self.case["motion"].get("rpm")
            limit = rpm and self.case["limits"].get("jump_margin", 1.0) * rpm
            self.verdict(told, "jump_speed", speed, 1e-6 * speed + 1e-9, lambda v, least: v >= least, limit)

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
        # Where an undercut leaves a corner, or a knife does not meet the outline on its path, nothing is told of the speed as cut.
        apart = self.failed & {"undercut", "outline"} or self.apart
        untold = re.compile("_cut_(mm|rad)_per_rad" if apart else "nothing")
        gaps = [name for name, column in columns.items() if np.isnan(column).any() and not untold.search(name)]
        if gaps:
            self.wrong.append(f"NaN in the table: {gaps}")
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
            peak = program.extreme(lambda i, t: np.abs(program.derivative(i, t, order)))[0] + 1e9 * program.noise[order]
            higher = program.extreme(lambda i, t: np.abs(program.derivative(i, t, order + 1)))[0]
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
        if "roller_force_n" in columns:
            self.force_columns(columns, sides, found, follower)

    def force_columns(self, columns, sides, found, follower):
        load = self.load
        forces = [load.at(side[0] - self.program.lowest, side[1], side[2]) for side in sides]
        reaches = [load.reach(follower, c) for c in found]
        along = np.stack([force / reach for force, reach in zip(forces, reaches)])
        # 0 where the follower has left the cam.
        normal = np.maximum(along, 0.0) / np.cos([c["alpha"] for c in found])
        torque = np.stack([force * side[1] for force, side in zip(forces, sides)]) * (1.0 if self.swings else 1e-3)
        pairs = [("roller_force_n", along), ("torque_nm", torque), ("contact_force_n", normal)]
        for name, values in pairs:
            size = np.abs(values).max() + abs(load.constant) / (1.0 if name == "torque_nm" else np.min(reaches))
            self.close(name, np.abs(values - columns[name]).min(axis=0), 0.0, 1e-8 * size + 1e-12)

    def rolled(self, path, report, follower, rng):
        """The follower let down on the outline: within the tolerance along the normal all round."""
        outline = Outline(path, self.ccw)
        cam, tolerance = report["cam"], report["outline"]["tolerance_mm"]
        self.close("area", cam["area_mm2"], outline.area - self.bore(), 1e-8 * outline.area)
        self.close("length", report["outline"]["length_mm"], outline.length, 1e-8 * outline.length)
        self.close("arcs and lines", [report["outline"]["arcs"], report["outline"]["lines"]], [outline.arc.sum(), (~outline.arc).sum()], 0.5)
        wall = next((c for c in report["checks"] if c["check"] == "wall"), None)
        if wall and not self.failed & {"undercut", "outline"} and wall["value"] is not None and "bore_radius" in self.case["cam"]:
            self.close("wall", wall["value"], outline.nearest - quantity(self.case["cam"]["bore_radius"]), 1e-6)
            self.close("limit of wall", wall["limit"], self.least_wall(), 1e-9)
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

    def least_wall(self):
        """The larger of 3 mm and 0.15 of the bore's radius; a millimetre of disc without a bore."""
        if "bore_radius" not in self.case["cam"]:
            return 1.0
        return max(3.0, 0.15 * quantity(self.case["cam"]["bore_radius"]))

    def automatic(self, report):
        """An automatic size keeps every limit, and the smallest told breaks one just below."""
        told, kind = report["cam"], self.case["kind"]
        if "smallest_prime_radius_mm" not in told or self.corner and self.clear:
            # A corner is as sharp on a cam of any size.
            sizes = [told["prime_radius_mm"] * 10 ** (k / 40) for k in range(-60, 61)]
            r = told["prime_radius_mm"] - told["base_radius_mm"]
            hopeless = not any(prime > r and self.keeps(kind, prime - r) for prime in sizes)
            if "smallest_prime_radius_mm" in told or not (self.corner or hopeless):
                self.wrong.append(f"smallest prime radius told {told.get('smallest_prime_radius_mm')}, velocity drops {self.corner}")
            return
        smallest = told["smallest_prime_radius_mm"]
        r = told["prime_radius_mm"] - told["base_radius_mm"]
        if told["prime_radius_mm"] < smallest * (1 - 1e-9):
            self.wrong.append(f"automatic prime radius {told['prime_radius_mm']} below the smallest {smallest}")
        bore = quantity(self.case["cam"]["bore_radius"]) if "bore_radius" in self.case["cam"] else 0.0
        for share, expected in ((1 + 1e-6, True), (1 - 1e-5, False)):
            prime = smallest * share
            if prime - r <= (bore + self.least_wall()) * (1 + 1e-4):
                continue
            if self.keeps(kind, prime - r) == (not expected):
                self.wrong.append(f"smallest prime radius told {smallest}: {'breaks' if expected else 'keeps'} the limits at {prime}")

    def keeps(self, kind, base):
        try:
            follower = Follower(kind, self.case["follower"], base)
            follower.reach(self.program.extreme(lambda i, t: self.program.jet(i, t, 0)[0])[0] - self.program.lowest)
        except Illegal:
            return None
        own, limits = figures(self.program, follower), self.case["limits"]
        usual = math.inf if kind.endswith("flat") else math.radians(45 if self.swings else 30)
        limit = quantity(limits["pressure_angle"]) if "pressure_angle" in limits else usual
        if follower.circle:
            ratio = 0.0 if kind == "knife" else limits.get("min_convex_pitch_radius_over_roller", 2.0)
            cutter = quantity(limits["cutter_radius"]) if "cutter_radius" in limits else 0.0
            concave = own["concave"] or math.inf
            # A velocity that rises leaves the roller's own shape.
            fits = (min(concave, follower.radius) if self.rises else concave) >= cutter
            # A circle of 36 mm keeps a limit of 36 mm; a curve of the roller's own radius is an edge.
            blunt = own["convex"] > follower.radius and own["convex"] >= ratio * follower.radius * (1 - 1e-9)
            return own["alpha"] <= limit + 1e-9 and blunt and fits
        # Sharper than a millimetre is an edge.
        return own["alpha"] <= limit + 1e-9 and own["radius"] >= 1.0 and own["turn"] > 0
