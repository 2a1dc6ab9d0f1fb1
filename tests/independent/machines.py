"""Random machines: exit 0 exactly where a program of its own finds every limit kept, every told maximum right.

Shares nothing with camgen but the machine file. Disc cams: the law is equation (10) or (12), its transitions are polynomials
found by linear systems, pitch curve, curvature and pressure angle come from their textbook formulas, forces from the air law;
every maximum is searched here on each smooth piece by itself. The written outline is read by ezdxf and rolled on. Plates: the
table must satisfy equation (18) and be the integral of its own slope; maxima are taken along it. Conoids: the surface of
camoid.py through any number of sections, by its fundamental forms.

usage: machines.py CAMGEN_BINARY DIRECTORY [--count N] [--seed N] [--jobs N] [--only KIND]
"""
import json
import math
import subprocess
from pathlib import Path

import cases
import numpy as np
from camoid import SHARES, Camoid
from disc import CUSTOMARY, MODULI, Disc, roll
from outline import Chain, polyline


# Customary limits: the column, m, and the size, mm.
LONGEST_COLUMN, LARGEST_SIZE = 2.0, 2000.0


def machine(rng):
    lobes = rng.choices([1, 2, 3], [8, 1, 1])[0]
    kind = rng.choice(["run-up", "run-up", "blend"])
    m = dict(
        mass=rng.uniform(200, 3000), r=rng.uniform(0.05, 0.3), k=rng.uniform(1.2, 1.45), q=rng.uniform(1.3, 5.0),
        column=rng.choice(["matched", "matched", "return"]), lead=0.0, kind=kind,
        width=math.radians(rng.choice([20, 20, 1, 0.2, rng.uniform(5, 40)])), roller=rng.uniform(0.008, 0.04), offset=0.0,
        lever=rng.choice([1.0, rng.uniform(0.3, 1.5)]), lobes=lobes, bore=rng.uniform(0.01, 0.05),
        material=rng.choice(["steel", "cast-iron", "bronze", "aluminium"]), thickness=rng.uniform(0.01, 0.08),
        preload=None, follower_mass=None, pressure_angle=rng.choice([30.0, rng.uniform(20, 50)]),
        ratio=rng.choice([2.0, rng.uniform(1.2, 3)]), cutter=rng.uniform(0.004, 0.03), wall=rng.uniform(0.001, 0.02),
        ccw=rng.random() < 0.3, base=None, stress=rng.choice([None, rng.uniform(300, 2500)]),
        share=rng.choice([None, rng.uniform(1e-5, 0.2)]),
    )
    if rng.random() < 0.15:
        m["column"] = m["k"] * m["r"] / (m["q"] - 1) * rng.uniform(0.9, 1.4)
    if rng.random() < 0.15 and kind == "run-up":
        m["lead"] = rng.uniform(0.001, 0.01)
    if rng.random() < 0.3:
        m["offset"] = rng.uniform(-0.02, 0.02)
    if rng.random() < 0.4:
        m["preload"], m["follower_mass"] = rng.uniform(0, 9000), rng.uniform(0, 80)
    if rng.random() < 0.5:
        m["base"] = rng.uniform(0.04, 0.4)
    return m, rng.choice([35.0, rng.uniform(15, 60)])


def settings(m):
    mm = lambda v: f"{v * 1e3!r}mm"
    sets = {
        "bed.mass": f"{m['mass']!r}kg", "bed.crank_radius": mm(m["r"]), "buffer.polytropic_exponent": repr(m["k"]),
        "buffer.end_pressure": f"{m['q']!r}at", "buffer.column": m["column"] if isinstance(m["column"], str) else mm(m["column"]),
        "buffer.lead": mm(m["lead"]), "transition.kind": m["kind"], "transition.width": f"{m['width']!r}rad",
        "follower.roller.radius": mm(m["roller"]), "follower.roller.offset": mm(m["offset"]), "cam.lever": repr(m["lever"]),
        "cam.cam_turns_per_crank_turn": repr(1 / m["lobes"]), "cam.bore_radius": mm(m["bore"]), "cam.material": m["material"],
        "cam.thickness": mm(m["thickness"]), "limits.pressure_angle": f"{m['pressure_angle']!r}deg",
        "limits.min_convex_pitch_radius_over_roller": repr(m["ratio"]), "limits.cutter_radius": mm(m["cutter"]),
        "limits.wall": mm(m["wall"]), "cam.rotation": "ccw" if m["ccw"] else "cw",
    }
    if m["base"]:
        sets["cam.base_radius"] = mm(m["base"])
    if m["preload"] is not None:
        sets["follower.roller.preload"], sets["follower.roller.mass"] = f"{m['preload']!r}N", f"{m['follower_mass']!r}kg"
    if m["stress"]:
        sets["limits.contact_stress"] = f"{m['stress']!r}MPa"
    if m["share"]:
        sets["limits.residual_share"] = repr(m["share"])
    return [word for key, value in sets.items() for word in ("--set", f"{key}={value}")]


def close(told, true, what, wrong, relative=1e-6, absolute=0.0):
    if told is None or not math.isfinite(true):
        if not (told is None and not math.isfinite(true)):
            wrong.append(f"{what} told {told}, is {true}")
        return
    if abs(told - true) > relative * abs(true) + absolute:
        wrong.append(f"{what} told {told!r}, is {true!r} ({told / true - 1 if true else told:.1e})")


def rotary(binary, directory, number, rng):
    m, rpm = machine(rng)
    name = f"r{number}"
    tolerance = rng.choice([0.005, 0.0005, 0.05])
    command = [binary, "rotary", "--rpm", repr(rpm), *settings(m), "--json", "--format", "dxf", "--out", str(directory),
               "--name", name, "--tolerance", f"{tolerance * 1e3}um", "--force"]
    run = subprocess.run(command, capture_output=True, text=True)
    if run.returncode == 2:
        return "not a cam", [], run.stderr.strip()
    report = json.loads(run.stdout)
    wrong = []
    checks = {}
    for c in report["checks"]:
        checks[c["check"]] = c
    cam, force = report["cam"], report["force"]
    disc = Disc(m, rpm, cam["prime_radius_mm"] * 1e-3)
    f = disc.figures()
    told = lambda check: checks[check]["value"]
    close(cam["max_lift_mm"], 1e3 * f["max_lift"], "max_lift", wrong)
    close(told("pressure_angle"), f["pressure_angle"], "pressure_angle", wrong)
    left = 1e3 * (f["convex"] - disc.rf)
    close(told("undercut"), left, "undercut", wrong, absolute=1e-6 * 1e3 * f["convex"])
    close(told("min_convex_radius"), 1e3 * f["convex"], "min_convex_radius", wrong)
    close(told("cutter_radius"), 1e3 * f["hollow"], "cutter_radius", wrong)
    close(force["inertia_max_n"], f["inertia"], "inertia", wrong)
    close(force["residual_fixed_bottom_max_n"], f["fixed"], "fixed bottom", wrong)
    close(force["roller_force_max_n"], f["force"], "roller force", wrong)
    close(force["torque_max_nm"], f["torque"], "torque", wrong)
    if left > 0:
        close(told("contact_stress"), f["stress"], "contact_stress", wrong)
    if m["preload"] is not None:
        close(told("force_closure"), f["least"], "force_closure", wrong, absolute=1e-6 * f["force"])
    if "air" in checks:
        close(told("air"), 1e3 * f["air"], "air", wrong)
    close(told("column"), 1e3 * disc.law.L, "column", wrong)

    # Rolling on the written outline.
    size = 0.0
    file_wrong = kinked = False
    if report["files"]:
        _, vertices = polyline(report["files"][0])
        chain = Chain(vertices)
        # Wall and size are those of the outline as written.
        f["wall"], size = chain.distance(np.zeros((1, 2)))[0] * 1e-3 - m["bore"], chain.extents().max()
        close(told("wall"), 1e3 * f["wall"], "wall", wrong, absolute=1e-9)
        close(told("size"), size, "size", wrong, absolute=1e-9)
        gap, lift_error, rolled_residual = roll(disc, chain)
        if gap > report["rolling"]["gap_mm"] and abs(report["rolling"]["gap_mm"]) < gap - 1e-9:
            wrong.append(f"gap told {report['rolling']['gap_mm']}, at least {gap}")
        if left > 0:
            lift = report["rolling"]["lift_error_max_mm"]
            if lift is not None and lift < lift_error - 2e-9:
                wrong.append(f"lift error told {lift}, at least {lift_error}")
            if force["residual_max_n"] is not None and force["residual_max_n"] < rolled_residual * (1 - 1e-6) - 1e-6:
                wrong.append(f"residual told {force['residual_max_n']}, at least {rolled_residual}")
        file_wrong, kinked = gap > tolerance + 2e-9, np.abs(chain.kinks()).max() > 0.05
        Path(report["files"][0]).unlink()
    # The verdict.
    share = m["share"] if m["share"] else f["fixed"] / f["inertia"]
    told_residual = force["residual_max_n"]
    value = math.inf if told_residual is None else told_residual / f["inertia"]
    stress_limit = m["stress"] or CUSTOMARY[m["material"]]
    limits = {
        "pressure_angle": f["pressure_angle"] / m["pressure_angle"], "undercut": disc.rf / f["convex"],
        "min_convex_radius": m["ratio"] * disc.rf / f["convex"], "cutter_radius": m["cutter"] / f["hollow"],
        "wall": (m["wall"] + 1e-15) / f["wall"] if f["wall"] > 0 else 2.0,
        "contact_stress": f["stress"] / stress_limit if left > 0 else 0.0, "residual": value / share,
        # With a lead the bottom leaves with a velocity.
        "air": 0.0 if f["air"] > 0 else 2.0, "continuity": 2.0 if m["lead"] > 0 else 0.0, "column": disc.law.L / LONGEST_COLUMN, "size": size / LARGEST_SIZE,
        "force_closure": 0.0 if m["preload"] is None or f["least"] > 0 else 2.0, "rolling": 2.0 if file_wrong else 0.0, "tangency": 2.0 if kinked else 0.0,
    }
    if left <= 0:
        # On an edge a pressure means nothing.
        del limits["contact_stress"]
        failing_of = {c["check"] for c in report["checks"] if c["verdict"] == "fail"} - {"contact_stress"}
    else:
        failing_of = {c["check"] for c in report["checks"] if c["verdict"] == "fail"}
    broken = {check for check, ratio in limits.items() if ratio > 1 + 1e-6}
    doubtful = {check for check, ratio in limits.items() if abs(ratio - 1) <= 1e-6}
    failing = failing_of
    if not doubtful and (broken - failing or (failing - broken) & set(limits)):
        wrong.append(f"broken here {sorted(broken)}, there {sorted(failing)}")
    others = failing - set(limits)
    if not doubtful and (run.returncode == 0) != (not broken and not others):
        wrong.append(f"exit {run.returncode}, broken {sorted(broken)}, others {sorted(others)}")
    if others and not broken:
        wrong.append(f"only camgen finds {sorted(others)}: " + "; ".join(str(checks[o]) for o in others))
    state = "cam" if run.returncode == 0 else "refused"
    return state, wrong, " ".join(command[1:])


class Plate:
    """Equation (18) and what follows from it, along the rows of a table; SI."""

    def __init__(self, m, rpm, table):
        self.m = m
        self.x, self.y, self.slope = (table[key] for key in ("x_mm", "dx_mm", "slope"))
        self.x, self.y = 1e-3 * self.x, 1e-3 * self.y
        q = m["q"]
        self.A = (q - 1) / m["r"] * (rpm / 35) ** 2
        design = 3 * 35 * 2 * math.pi / 60
        self.unit = m["mass"] * design**2 * m["r"] / (q - 1)
        g = (1 + self.A * m["r"]) ** (1 / m["k"])
        self.L = {"matched": m["k"] / self.A, "return": m["r"] * g / (g - 1)}[m["column"]]
        self.lam = m["bottom_arm"] / m["roller_arm"]
        self.psi = np.arcsin(self.y / m["bottom_arm"])
        self.theta = m["delta"] + self.psi
        v = self.slope / (self.lam * np.cos(self.psi))
        self.alpha = np.arctan2(v * np.sin(self.theta), 1 + v * np.cos(self.theta))
        self.air_length = self.L - self.x - self.y
        self.air = (self.L / self.air_length) ** m["k"] - 1

    def share(self, rho, efficiency):
        """Cross force of the rollers over the air force."""
        angle = self.alpha + rho
        return self.lam * np.cos(self.psi) / (efficiency * np.sin(self.theta - angle)), angle

    def efficiency(self, back):
        eta = self.m["efficiency"]
        if self.m["model"] == "printed":
            return np.full_like(self.x, eta)
        rising = (self.slope > 0) != back
        return np.where(self.slope == 0, np.nan, np.where(rising, eta, 1 / eta))

    def residual(self, back):
        rho = -self.m["friction"] if back else self.m["friction"]
        share, angle = self.share(rho, self.efficiency(back))
        return self.unit * (self.A * self.x - self.air * (1 + share * np.sin(angle)))

    def force(self, back):
        rho = -self.m["friction"] if back else self.m["friction"]
        share, _ = self.share(rho, self.efficiency(back))
        return 0.5 * self.unit * self.air * share * np.cos(rho)


def peak(values):
    """Largest of even samples, by the parabola through its neighbours."""
    values = np.where(np.isfinite(values), values, -np.inf)
    i = int(values.argmax())
    if i in (0, len(values) - 1) or not np.isfinite(values[i - 1 : i + 2]).all():
        return values[i], False
    a, b, c = values[i - 1 : i + 2]
    bend = a - 2 * b + c
    return (b - (c - a) ** 2 / (8 * bend) if bend < 0 else b), abs(bend) < 1e-4 * abs(b)


def translating(binary, directory, number, rng):
    m = dict(
        mass=rng.uniform(200, 3000), r=rng.uniform(0.08, 0.3), k=rng.uniform(1.2, 1.45), q=rng.uniform(1.3, 3.0),
        column=rng.choice(["matched", "return"]), roller_arm=rng.uniform(0.2, 0.5), bottom_arm=rng.uniform(0.2, 0.5),
        delta=math.radians(rng.choice([90, rng.uniform(70, 100)])), friction=math.radians(rng.uniform(0, 5)),
        efficiency=rng.choice([1.0, 0.95, rng.uniform(0.85, 1)]), model=rng.choice(["consistent", "printed"]),
        roller=rng.uniform(0.01, 0.04), material=rng.choice(sorted(MODULI)), thickness=rng.uniform(0.01, 0.08),
        pressure_angle=rng.choice([30.0, rng.uniform(15, 60)]), wall=rng.uniform(0.001, 0.02),
        share=rng.choice([None, rng.uniform(1e-4, 0.2)]),
    )
    rpm = rng.choice([35.0, rng.uniform(25, 40)])
    mm = lambda v: f"{v * 1e3!r}mm"
    sets = {
        "bed.mass": f"{m['mass']!r}kg", "bed.crank_radius": mm(m["r"]), "buffer.polytropic_exponent": repr(m["k"]),
        "buffer.end_pressure": f"{m['q']!r}at", "buffer.column": m["column"], "translating.roller_arm": mm(m["roller_arm"]),
        "translating.bottom_arm": mm(m["bottom_arm"]), "translating.delta": f"{m['delta']!r}rad",
        "translating.friction_angle": f"{m['friction']!r}rad", "translating.efficiency": repr(m["efficiency"]),
        "translating.efficiency_model": m["model"], "translating.roller_radius": mm(m["roller"]),
        "translating.plate_height": "400mm", "cam.material": m["material"], "cam.thickness": mm(m["thickness"]),
        "limits.pressure_angle": f"{m['pressure_angle']!r}deg", "limits.wall": mm(m["wall"]), "limits.cutter_radius": "3mm",
    }
    if m["share"]:
        sets["limits.residual_share"] = repr(m["share"])
    words = [word for key, value in sets.items() for word in ("--set", f"{key}={value}")]
    name, tolerance = f"t{number}", rng.choice([0.005, 0.05])
    command = [binary, "translating", "--rpm", repr(rpm), *words, "--json", "--format", "dxf,csv", "--samples", "4000", "--out",
               str(directory), "--name", name, "--tolerance", f"{tolerance * 1e3}um", "--force"]
    run = subprocess.run(command, capture_output=True, text=True)
    if run.returncode == 2:
        return "not a cam", [], run.stderr.strip()
    report = json.loads(run.stdout)
    checks = {c["check"]: c for c in report["checks"]}
    if len(report["files"]) < 2:
        return "no outline", [] if run.returncode == 1 else ["exit 0 without a file"], ""
    rows = np.genfromtxt(report["files"][1], delimiter=",", names=True)
    plate = Plate(m, rpm, rows)
    wrong = []
    inertia = plate.unit * plate.A * m["r"]
    close(force_of(report, "inertia_max_n"), inertia, "inertia", wrong)
    # The law: (18) holds at every row, and the table is the integral of its slope.
    braking, back = plate.residual(False), plate.residual(True)
    moving = np.isfinite(braking)
    left = np.abs(braking[1:][moving[1:]]).max(initial=0) / inertia
    if left > 1e-9:
        wrong.append(f"(18) leaves {left:.2e} of the inertia while braking")
    h = plate.x[1] - plate.x[0]
    simpson = plate.y[:-2:2] + h / 3 * (plate.slope[:-2:2] + 4 * plate.slope[1:-1:2] + plate.slope[2::2]) - plate.y[2::2]
    if np.sort(np.abs(simpson))[-8] > 1e-9 * m["r"]:
        wrong.append(f"the table is not the integral of its slope: {np.sort(np.abs(simpson))[-8]:.2e} m")
    value, sure = peak(np.abs(back))
    told = force_of(report, "residual_return_max_n")
    if told < value * (1 - 1e-6) or (sure and told > value * (1 + 1e-5)):
        wrong.append(f"residual on the way back told {told}, is {value}")
    both = np.fmax(plate.force(False), plate.force(True))
    value, sure = peak(both)
    told = force_of(report, "roller_force_max_n")
    if told < value * (1 - 1e-6) or (sure and np.isfinite(both).all() and told > value * (1 + 1e-5)):
        wrong.append(f"roller force told {told}, is {value}")
    # Curves: the pitch curve of the lower flank, its heading by (21).
    value, sure = peak(np.abs(rows["pressure_angle_deg"]))
    if checks["pressure_angle"]["value"] < value - 1e-9:
        wrong.append(f"pressure angle told {checks['pressure_angle']['value']}, is {value}")
    if "air" in checks:
        least = -peak(-plate.air_length)[0] * 1e3
        close(checks["air"]["value"], least, "air", wrong)
    document, vertices = polyline(report["files"][0])
    chain = Chain(vertices)
    centre = np.stack([rows["pitch_x_mm"], rows["pitch_y_mm"]], axis=1)
    axis = report["cam"]["plate"]["axis_distance_mm"]
    own = 1e3 * np.stack([plate.x + m["roller_arm"] * (np.sin(plate.theta) - math.sin(m["delta"])),
                          m["roller_arm"] * (math.cos(m["delta"]) - np.cos(plate.theta))], axis=1) + [0, axis]
    if np.abs(centre - own).max() > 1e-8:
        wrong.append(f"the pitch curve is off by {np.abs(centre - own).max()} mm")
    gap = max(np.abs(chain.distance(own[::4] * [1, side]) - 1e3 * m["roller"]).max() for side in (1, -1))
    undercut = checks["undercut"]["verdict"] == "fail"
    if abs(report["rolling"]["gap_mm"]) < gap - 1e-9 and not undercut:
        wrong.append(f"gap told {report['rolling']['gap_mm']}, at least {gap}")
    failing = {name for name, c in checks.items() if c["verdict"] == "fail"}
    g = (1 + plate.A * m["r"]) ** (1 / m["k"])
    fixed = m["r"] * g / (g - 1)
    x = np.linspace(0, m["r"], 20001)[1:-1]
    left = peak(plate.unit * np.abs(plate.A * x - ((fixed / (fixed - x)) ** m["k"] - 1)))[0]
    close(force_of(report, "residual_fixed_bottom_max_n"), left, "fixed bottom", wrong)
    rolled = force_of(report, "residual_max_n")
    share = m["share"] or left / inertia
    broken = {
        "pressure_angle": checks["pressure_angle"]["value"] > m["pressure_angle"], "rolling": gap > tolerance + 2e-9,
        "residual": rolled is None or rolled / inertia >= share, "wall": checks["wall"]["value"] < 1e3 * m["wall"] * (1 - 1e-9),
        "contact_stress": checks["contact_stress"]["value"] > CUSTOMARY[m["material"]],
    }
    for check, is_broken in broken.items():
        if check in checks and is_broken != (check in failing):
            wrong.append(f"{check}: broken {is_broken}, verdict {checks[check]['verdict']}")
        elif check not in checks:
            wrong.append(f"no check {check}")
    if (run.returncode == 0) != (not failing):
        wrong.append(f"exit {run.returncode} with {sorted(failing)}")
    for path in report["files"]:
        Path(path).unlink()
    return "cam" if run.returncode == 0 else "refused", wrong, " ".join(command[1:])


def conoid(binary, directory, number, rng):
    m, _ = machine(rng)
    m["lead"] = 0.0
    m["width"] = math.radians(rng.uniform(8, 40))
    if rng.random() < 0.6:
        # One that may be made.
        m.update(mass=rng.uniform(20, 300), material="steel", base=None, stress=None, share=None, cutter=0.004, wall=0.001, preload=None,
                 follower_mass=None)
    m["column"] = rng.choice(["matched", "return"])
    m.update(travel=rng.uniform(0.06, 0.3), mode=rng.choice(["adjusted", "fixed"]), shift=rng.choice(["linear", "square"]))
    overhang = rng.choice(["auto", "auto", "auto", rng.uniform(0, 0.01)])
    slowest = rng.uniform(15, 30)
    count = rng.choice([2, 3, 4, 5])
    speeds = [slowest + (rng.uniform(35, 45) - slowest) * i / (count - 1) for i in range(count)]
    if any(b - a < 1 for a, b in zip(speeds, speeds[1:])):
        speeds = np.linspace(slowest, 40.0, count).tolist()
    sets = [f"conoid.axial_travel={m['travel'] * 1e3!r}mm", f"conoid.mode={m['mode']}", f"conoid.shift={m['shift']}",
            f"conoid.overhang={overhang if overhang == 'auto' else repr(overhang * 1e3) + 'mm'}"]
    name, tolerance = f"c{number}", rng.choice([0.005, 0.05])
    command = [binary, "conoid", "--rpm", ",".join(map(repr, speeds)), *settings(m), *(w for s in sets for w in ("--set", s)),
               "--json", "--format", "dxf", "--out", str(directory), "--name", name, "--tolerance", f"{tolerance * 1e3}um",
               "--force"]
    run = subprocess.run(command, capture_output=True, text=True)
    if run.returncode == 2:
        return "not a cam", [], run.stderr.strip()
    report = json.loads(run.stdout)
    checks = {c["check"]: c for c in report["checks"]}
    told = lambda check: checks[check]["value"]
    cam, wrong = report["cam"], []
    prime = cam["prime_radius_mm"] * 1e-3
    shares = [None] if report["between"]["splines_in"] == "place" else SHARES
    all = [Camoid(m, speeds, prime, share) for share in shares]
    surface = min(all, key=lambda s: abs(s.residual() - told_force(report)))
    f = surface.figures()
    law = surface.laws[-1]
    inertia = law.unit * law.A * law.r
    close(cam["max_lift_mm"], 1e3 * f["max_lift"], "max_lift", wrong)
    close(told("pressure_angle"), f["pressure_angle"], "pressure_angle", wrong)
    close(told("axial_force"), f["axial"], "axial_force", wrong)
    close(report["between"]["residual_max_n"], f["residual"], "residual between", wrong, absolute=1e-9 * inertia)
    close(report["force"]["inertia_max_n"], inertia, "inertia", wrong)
    if m["preload"] is not None:
        close(told("force_closure"), f["least"], "force_closure", wrong, absolute=1e-6 * inertia)
    convex, hollow, radius = surface.of_metal(cam["overhang_mm"] * 1e-3)
    left = 1e3 * (convex - surface.rf)
    wall = radius - m["bore"]
    if left > 0:
        close(told("min_convex_radius"), 1e3 * convex, "min_convex_radius", wrong)
        close(told("undercut"), left, "undercut", wrong, absolute=1e-6 * 1e3 * convex)
        close(told("cutter_radius"), 1e3 * hollow, "cutter_radius", wrong)
        close(told("wall"), 1e3 * wall, "wall", wrong, absolute=1e-6)
        stress = surface.stress()
        close(told("contact_stress"), stress, "contact_stress", wrong)
    off = 0.0
    if report["files"] and left > 0:
        for i, path in enumerate(p for p in report["files"] if p.endswith(".dxf")):
            _, vertices = polyline(path)
            points = surface.section(i) * [1.0, -1.0 if m["ccw"] else 1.0]
            off = max(off, np.abs(Chain(vertices).distance(points)).max())
        if off > tolerance + 2e-9:
            wrong.append(f"a section is off by {off} mm, with the verdict {checks['outline']['verdict']}")
    reach = f["reach"] - cam["overhang_mm"] * 1e-3
    stress_limit = m["stress"] or CUSTOMARY[m["material"]] * 4200 / 1500
    # What no cam leaves, at the speed at which most is left with it.
    A = law.A * (report["between"]["rpm"] / speeds[-1]) ** 2
    g = (1 + A * law.r) ** (1 / law.k)
    fixed = law.r * g / (g - 1)
    x = np.linspace(0, law.r, 20001)[1:-1]
    share = m["share"] or peak(law.unit * np.abs(A * x - ((fixed / (fixed - x)) ** law.k - 1)))[0] / inertia
    limits = {
        "pressure_angle": f["pressure_angle"] / m["pressure_angle"], "undercut": surface.rf / convex,
        "min_convex_radius": m["ratio"] * surface.rf / convex, "cutter_radius": m["cutter"] / hollow,
        "wall": m["wall"] / wall if wall > 0 else 2.0, "residual": told("residual") / share,
        "axial_reach": 1 + reach / surface.rf, "force_closure": 0.0 if m["preload"] is None or f["least"] > 0 else 2.0,
    }
    if left > 0:
        limits["contact_stress"] = stress / stress_limit
    broken = {check for check, ratio in limits.items() if ratio > 1 + 1e-6}
    doubtful = {check for check, ratio in limits.items() if abs(ratio - 1) <= 1e-6}
    failing = {c["check"] for c in report["checks"] if c["verdict"] == "fail"} - ({"contact_stress"} if left <= 0 else set())
    if (broken ^ failing) - doubtful and not (left <= 0 and broken <= failing):
        wrong.append(f"broken here {sorted(broken)}, there {sorted(failing)}")
    if not doubtful and (run.returncode == 0) != (not broken and not failing):
        wrong.append(f"exit {run.returncode}, broken {sorted(broken)}")
    for path in report["files"]:
        Path(path).unlink()
    return "conoid" if run.returncode == 0 else "conoid refused", wrong, " ".join(command[1:])


def told_force(report):
    return report["between"]["residual_max_n"]


def force_of(report, key):
    return report["force"][key]


def main():
    kinds = {"rotary": rotary, "translating": translating, "conoid": conoid}
    words = cases.given("machines", 150, only={"choices": kinds})

    def one(number, rng):
        kind = kinds.get(words.only, conoid if number % 24 == 5 else translating if number % 4 == 3 else rotary)
        return kind(words.binary, words.directory, number, rng)

    cases.finish(*cases.judged(words, one))


if __name__ == "__main__":
    main()
