"""What is left of a cam in machines that differ: every figure against air that is integrated step by step.

Shares nothing with camgen but the machine file. The bottom of the cylinder is taken from the CSV of `camgen rotary`, so that the cam is the one
that is cut. The bed is a mass on a crank; its inertia is the second derivative of the place of the crank pin. The air of the true machine is a
closed amount of gas whose pressure is integrated over the volume by Runge and Kutta, dp/dV = −κ p/V, from the pressure at which the port closes.
Residual forces are searched on dense scans; settings of the screw by bisection of the force at the end and by golden section of the largest
force; presses are drawn with a generator that is written down here. Every fourth press has its bed on a crank-slider.

usage: scatter.py CAMGEN_BINARY DIRECTORY [--count N] [--seed N] [--jobs N]
"""
import csv
import math
import re
import subprocess
from pathlib import Path

import cases
import numpy as np
from press import Wrong, X, press, run  # the harness and random machines; no formula of the scatter

# Runge and Kutta's error of the pressure with 400 κ steps an e-fold is below 1e-12; a scan with a zoom finds a value to the square of its place.
EXACT = 1e-8
# A compromise is as good as the search that found it.
LEVELLED = 1e-7
# What is small is told by differences of large forces, N over the largest inertia.
ROUNDING = 1e-13

PARAMETERS = ["polytropic_exponent", "ambient_pressure", "mass", "speed", "column", "lead", "air_lost", "closing_pressure", "phase", "screw"]


def random_numbers(seed, count):
    """SplitMix64."""
    mask = (1 << 64) - 1
    state = seed
    for _ in range(count):
        state = (state + 0x9E3779B97F4A7C15) & mask
        z = state
        z = ((z ^ (z >> 30)) * 0xBF58476D1CE4E5B9) & mask
        z = ((z ^ (z >> 27)) * 0x94D049BB133111EB) & mask
        yield ((z ^ (z >> 31)) >> 11, 0.5)


class Gas:
    """p(V) of a closed amount of gas, dp/dV = −κ p/V, by Runge and Kutta in steps of the volume; volumes over that where the port closes."""

    def __init__(self, kappa, least, most):
        # Runge and Kutta's error is that of the exponent times the step to the fourth power.
        steps = math.ceil(400 * max(1.0, kappa))
        self.table = {1.0: 0.0}
        self.kappa = kappa
        # ln p is tabulated where it is asked for: integrated along ln V the right side is constant, so it is integrated along V itself.
        grid = [1.0]
        while grid[-1] > least:
            grid.append(grid[-1] * (1 - 1 / steps))
        down, p = [(1.0, 1.0)], 1.0
        for a, b in zip(grid, grid[1:]):
            p = self.step(a, b, p)
            down.append((b, p))
        grid = [1.0]
        while grid[-1] < most:
            grid.append(grid[-1] * (1 + 1 / steps))
        up, p = [(1.0, 1.0)], 1.0
        for a, b in zip(grid, grid[1:]):
            p = self.step(a, b, p)
            up.append((b, p))
        nodes = down[::-1] + up[1:]
        self.volume, self.pressure = (np.array(column) for column in zip(*nodes))

    def step(self, a, b, p):
        h, f = b - a, lambda v, p: -self.kappa * p / v
        k1 = f(a, p)
        k2 = f(a + h / 2, p + h / 2 * k1)
        k3 = f(a + h / 2, p + h / 2 * k2)
        k4 = f(b, p + h * k3)
        return p + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)

    def at(self, volume):
        """One more step of Runge and Kutta from the nearest node."""
        volume = np.asarray(volume, dtype=float)
        i = np.clip(np.searchsorted(self.volume, volume), 1, len(self.volume) - 1)
        i = i - (volume - self.volume[i - 1] < self.volume[i] - volume)
        a, p = self.volume[i], self.pressure[i]
        return self.step(a, volume, p)


class Cam:
    """The bottom of the cylinder over the overrun, as the table of `camgen rotary` has it, or a fixed one."""

    def __init__(self, m, rpm, rows, column):
        self.m, self.rpm, self.column = m, rpm, column
        braking = [row for row in rows if 0 <= row[0] <= 90]
        self.angle = np.array([math.radians(row[0]) for row in braking])
        self.x = np.array([row[1] for row in braking])
        self.bottom = np.array([row[2] for row in braking])
        self.closed = column - self.x - float(m.lead) - self.bottom
        both = float(m.both)
        self.unit = both * float(m.p0)
        self.inertia = np.array([float(m.inertia(rpm, X(x))) for x in self.x])

    def residual(self, mass, speed, ambient, kappa, closing, air, column, lead):
        """Inertia less air at the places of the table, N."""
        p0 = float(self.m.p0) * ambient
        volume = self.closed + column - lead
        if volume.min() <= 0:
            return None
        # The amount of gas is that of the length where the port closes, less what is lost, at the closing pressure.
        amount = air * (self.column + column)
        gas = Gas(kappa, volume.min() / amount * 0.99, max(volume.max() / amount * 1.01, 1.001))
        pressure = closing * p0 * gas.at(volume / amount)
        return self.inertia * mass * speed**2 - float(self.m.both) * (pressure - p0)


def bisected(f, low, high):
    for _ in range(80):
        middle = (low + high) / 2
        if f(middle) < 0:
            low = middle
        else:
            high = middle
    return (low + high) / 2


def fault(rng, k):
    """A machine that differs, of any number of parameters."""
    true = dict(mass=1.0, speed=1.0, ambient=1.0, kappa=k, closing=1.0, air=1.0, column=0.0, lead=0.0)
    words = []

    def maybe(name, key, value, text):
        if rng.random() < 0.5:
            true[name] = value
            words.extend(["--fault", f"{key}={text}"])

    by = rng.uniform(-0.3, 0.3)
    maybe("mass", "mass", 1 + by, repr(by))
    by = rng.uniform(-0.3, 0.2)
    maybe("speed", "speed", 1 + by, f"{100 * by!r}%")
    by = rng.uniform(-0.2, 0.2)
    maybe("ambient", "ambient_pressure", 1 + by, repr(by))
    kappa = rng.uniform(max(1.0, k - 0.1), min(3.0, k + 0.1))
    maybe("kappa", "polytropic_exponent", kappa, repr(kappa))
    by = rng.uniform(-0.05, 0.05)
    maybe("closing", "closing_pressure", 1 + by, repr(by))
    by = rng.uniform(0, 0.05)
    maybe("air", "air_lost", 1 - by, repr(by))
    return true, words


def scan(values):
    """Largest size, signed: a parabola through the three values about the largest."""
    i = int(np.abs(values).argmax())
    if i in (0, len(values) - 1):
        return values[i]
    a, b, c = values[i - 1], values[i], values[i + 1]
    bend = a - 2 * b + c
    return b if bend == 0 else b - (a - c) ** 2 / (8 * bend)


def one(binary, directory, number, rng):
    m, name, wrong = press(rng), f"scatter-{number}", Wrong()
    m.lead = X(0)
    m.lobes, m.lever = 1, X(1)
    true, words = fault(rng, float(m.k))
    # A cam is looked up every 1/40 of a degree.
    rows_of_turn = 14400
    cut, report = run(binary, ["rotary", *m.sets(), "--samples", str(rows_of_turn), "--force", "--set", "transition.kind=run-up"],
                      directory, name + "-cam")
    if report is None or not report["files"]:
        return "no cam", [], words
    with open(report["files"][0], newline="") as file:
        rows = [(float(row["crank_deg"]), float(row["x_mm"]) / 1000, float(row["dx_mm"]) / 1000) for row in csv.DictReader(file)]
    column = report["law"]["column_length_mm"] / 1000
    cam = Cam(m, m.rpm, rows, column)
    if abs(cam.angle[-1] - math.pi / 2) > 1e-9:
        return "no place at the end", ["the table has no row at 90 deg"], words
    longer, early = rng.choice([0.0, rng.uniform(-0.02, 0.05) * column]), rng.choice([0.0, rng.uniform(0, 0.01) * column])
    true["column"], true["lead"] = longer, early
    words += ["--fault", f"column={1000 * longer!r}mm", "--fault", f"lead={1000 * early!r}mm"]
    braked_by_all(report["law"], m, cam, wrong)
    seed, rule = rng.randrange(1 << 40), rng.choice(["none", "end", "end", "level"])
    samples = 40
    asked = ["scatter", *m.sets(), *words, "--samples", str(samples), "--seed", str(seed), "--reset", rule, "--force"]
    got, told = run(binary, asked, directory, name)
    size = float(m.inertia(m.rpm, m.r))
    largest = max(size, cam.unit) * 4
    here = cam.residual(**true)
    if told is None:
        used_up = here is None or "column used up" in got.stderr
        balanced = "no column balances" in got.stderr
        cause = got.stderr.strip().partition(":")[2].partition(":")[0].strip()
        return f"refused: {cause}", [] if used_up or balanced else [got.stderr.strip()], asked
    part = told["scatter"]
    of_fault = part["fault"]
    rounding = ROUNDING * largest
    wrong.close(of_fault["residual_n"], scan(here), "residual", EXACT, rounding)
    wrong.close(of_fault["residual_at_end_n"], here[-1], "residual at the end", EXACT, rounding)

    def after(column):
        return cam.residual(**{**true, "column": column})

    # The screw: the force at the end is 0.
    reach = float(column) * 50
    low = -min(column, cam.closed.min() - early) * (1 - 1e-9)
    end = bisected(lambda at: after(at)[-1], low, reach)
    wrong.close(of_fault["column_end_mm"], 1000 * end, "column of end", EXACT, 1e-8 * 1000 * column)
    wrong.close(of_fault["residual_end_n"], scan(after(end)), "residual of end", EXACT * 10, 10 * rounding)
    told_level = scan(after(of_fault["column_level_mm"] / 1000))
    wrong.close(of_fault["residual_level_n"], abs(told_level), "residual of level", EXACT * 10, 10 * rounding)
    for step in (-1e-3, -1e-4, 1e-4, 1e-3):
        beside = after(of_fault["column_level_mm"] / 1000 + step * column)
        if beside is not None and abs(scan(beside)) < abs(told_level) * (1 - LEVELLED) - rounding:
            wrong.append(f"a screw {step} of the column beside the level setting leaves less: {scan(beside)} {told_level}")
    both = cam.residual(**{**true, "column": of_fault["column_with_port_mm"] / 1000, "lead": of_fault["lead_with_port_mm"] / 1000})
    for at in (0, -1):
        wrong.close(1 + both[at] / largest, 1, "screw and port leave nothing at the ends", 1e-9)
    percentiles(part, cam, m, (seed, samples, rule), wrong, rounding)
    settings(part, cam, m, column, rule, wrong, rounding)
    card(binary, directory, name, asked, part, wrong)
    losses(binary, directory, name, m, cam, rng, wrong, rounding)
    levelled(binary, directory, name, m, rng, wrong, rounding)
    return "scatter", wrong, asked


def braked_by_all(law, m, cam, wrong):
    """A press built by the report: the reported number of cylinders of the reported bore hold the bed at the end of the stroke by their gas."""
    each = math.pi * (law["bore_mm"] / 1000) ** 2 / 4
    volume = each * cam.closed / (each * cam.column)
    pressure = float(m.p0) * Gas(float(m.k), volume.min() * 0.99, 1.01).at(volume[-1])
    force = law["cylinders"] * each * (pressure - float(m.p0))
    wrong.close(force, cam.inertia[-1], "force of all cylinders at the end of the stroke", EXACT)
    wrong.close(law["cylinders"] * law["piston_area_mm2"], law["piston_area_total_mm2"], "area of all pistons", 1e-12)
    wrong.close(law["piston_area_mm2"], 1e6 * each, "area of a piston", 1e-12)


def card(binary, directory, name, asked, part, wrong):
    """The card of the hand wheel has the columns of the table, and names the rule."""
    command = [binary, *asked, "--quiet", "--out", str(directory), "--name", name + "-wheel", "--overwrite", "--format", "svg"]
    subprocess.run(command, capture_output=True, check=False)
    drawing = (Path(directory) / f"{name}-wheel-card.svg").read_text()
    texts = [re.sub("<[^>]*>", "", text).strip() for text in re.findall(r"<text[^>]*>(.*?)</text>", drawing, re.DOTALL)]
    if not any(f"({part['reset']})" in text for text in texts):
        wrong.append(f"the card does not name the rule {part['reset']}")
    if not any(f"{part['cylinders']} cylinders" in text for text in texts):
        wrong.append("the card does not count the cylinders")
    if any(row["reset"] != part["reset"] for row in read_settings(directory, name)):
        wrong.append("the table of the settings has another rule")
    place = -1
    for row in part["settings"]:
        cells = [f"{row['v']:.2f}", f"{row['rpm']:.2f}", f"{row['column_mm']:.2f}", f"{row['residual_n']:.0f}"]
        for cell in cells:
            later = [i for i, text in enumerate(texts) if i > place and text == cell]
            if not later:
                wrong.append(f"the card has no {cell} for v = {row['v']}")
                return
            place = later[0]


def read_settings(directory, name):
    with open(Path(directory) / f"{name}-settings.csv", newline="") as file:
        return list(csv.DictReader(file))


def drawn(m, seed, samples):
    """The presses, in the order of their draws."""
    half = dict(zip(PARAMETERS, [0.05, 0.03, 0.05, 0.01, 1e-3, 2e-4, 0.01, 0.01, math.radians(0.1), 1e-4]))
    numbers = [(bits + half_bit) / 2**53 for bits, half_bit in random_numbers(seed, 16 * samples)]
    for j in range(samples):
        at = {name: half[name] * (2 * numbers[16 * j + i] - 1) for i, name in enumerate(PARAMETERS)}
        yield dict(mass=1 + at["mass"], speed=1 + at["speed"], ambient=1 + at["ambient_pressure"], kappa=float(m.k) + at["polytropic_exponent"],
                   closing=1 + at["closing_pressure"], air=1 - abs(at["air_lost"]), column=at["column"], lead=at["lead"]), at["phase"], at["screw"]


def percentiles(part, cam, m, draws, wrong, rounding):
    """The presses that the command draws, each with a phase error by differences of the bottom along the crank."""
    seed, samples, rule = draws
    coarse = slice(0, None, 20)
    at = Cam.__new__(Cam)
    at.__dict__.update(cam.__dict__)
    for name in ("angle", "x", "bottom", "closed", "inertia"):
        setattr(at, name, getattr(cam, name)[coarse])
    if len(at.x) != 181:
        wrong.append(f"{len(at.x)} stations")
        return
    # A cam that is ahead by δ lifts the bottom by Δx' δ: the force of that to first order, by central differences of the air.
    slope = np.gradient(cam.bottom, cam.angle, edge_order=2)[coarse]
    nominal = dict(mass=1.0, speed=1.0, ambient=1.0, kappa=float(m.k), closing=1.0, air=1.0, column=0.0, lead=0.0)
    tiny = 1e-6 * float(cam.column)
    stiffness = (at.residual(**{**nominal, "lead": tiny}) - at.residual(**{**nominal, "lead": -tiny})) / (2 * tiny)
    by_phase = slope * stiffness
    fixed = Cam.__new__(Cam)
    fixed.__dict__.update(at.__dict__)
    # A fixed bottom whose air holds the bed at the end.
    q = 1 + float(m.inertia(m.rpm, m.r)) / cam.unit
    gas = Gas(float(m.k), q ** (-1 / float(m.k)) * 0.98, 1.001)
    ratio = bisected(lambda v: q - float(gas.at(v)), gas.volume[0], 1.0)
    fixed.column = at.x[-1] / (1 - ratio)
    fixed.closed = fixed.column - at.x
    built, reset, plain = [], [], []

    def end(body, true):
        low = -min(body.column, body.closed.min() - abs(true["lead"])) * 0.999
        return bisected(lambda column: body.residual(**{**true, "column": column})[-1], low, 50 * body.column)

    for true, phase, screw in drawn(m, seed, samples):
        with_phase = lambda values: float((np.abs(values) + np.abs(by_phase * phase)).max())
        built.append(with_phase(at.residual(**true)))
        reset.append(with_phase(at.residual(**{**true, "column": end(at, true) + screw})))
        own = true["column"] if rule == "none" else end(fixed, true) + screw
        plain.append(float(np.abs(fixed.residual(**{**true, "column": own})).max()))
    for body, rule, sizes in (("cam", "none", built), ("cam", "end", reset), ("fixed-bottom", "none" if rule == "none" else "end", plain)):
        sizes.sort()
        for row in part["percentiles"]:
            if (row["body"], row["reset"]) == (body, rule):
                rank = math.ceil(row["percentile"] / 100 * samples - 1e-9)
                # The phase force is by differences along a table of 1/40 of a degree.
                wrong.close(row["residual_n"], sizes[rank - 1], f"P{row['percentile']:.0f} {body} {rule}", 5e-6, 10 * rounding)


def settings(part, cam, m, column, rule, wrong, rounding):
    """The settings over v by a rule: residual forces of cam and fixed bottom: 0 at the end of the stroke by `end`, least by `level`; by `none` the columns of v = 1."""
    first = next(row for row in part["settings"] if row["v"] == 1.0)
    for row in part["settings"][::5]:
        true = dict(mass=row["v"], speed=1.0, ambient=1.0, kappa=float(m.k), closing=1.0, air=1.0, column=row["column_mm"] / 1000 - column, lead=0.0)
        wrong.close(row["residual_n"], abs(scan(cam.residual(**true))), "residual of a setting", 10 * EXACT, 10 * rounding)
        fixed = Cam.__new__(Cam)
        fixed.__dict__.update(cam.__dict__)

        def left(length):
            fixed.column, fixed.closed = length, length - cam.x
            return abs(scan(fixed.residual(**{**true, "column": 0.0})))

        own = row["fixed_column_mm"] / 1000
        wrong.close(row["fixed_residual_n"], left(own), "residual of a fixed bottom", 10 * EXACT, 10 * rounding)
        wrong.close(part["cylinders"] * row["added_volume_each_mm3"], row["added_volume_mm3"], "volume of a setting", 1e-12)
        if rule == "level":
            if min(left(own * (1 - 1e-4)), left(own * (1 + 1e-4))) < row["fixed_residual_n"] * (1 - LEVELLED) - rounding:
                wrong.append(f"a fixed bottom at v = {row['v']} is not levelled")
            beside = [abs(scan(cam.residual(**{**true, "column": true["column"] + by * column}))) for by in (-1e-4, 1e-4)]
            if min(beside) < row["residual_n"] * (1 - LEVELLED) - rounding:
                wrong.append(f"the cam at v = {row['v']} is not levelled")
        elif rule == "end":
            left(own)
            ends = [cam.residual(**true)[-1], fixed.residual(**{**true, "column": 0.0})[-1]]
            for force in ends:
                wrong.close(1 + force / (cam.inertia[-1] * max(1.0, row["v"])), 1, "a setting leaves nothing at the end", 1e-8)
        else:
            wrong.close(row["column_mm"], 1000 * column, "column that is not reset", 1e-12)
            wrong.close(own, first["fixed_column_mm"] / 1000, "fixed column that is not reset", 1e-12)


def losses(binary, directory, name, m, cam, rng, wrong, rounding):
    """A reversal that loses air and has friction, and whose air expands on another exponent: the air step by step along the crank."""
    k = float(m.k)
    back = rng.choice([k, rng.uniform(k, min(3.0, k + 0.2))])
    leak, piston, bed = rng.choice([0.0, rng.uniform(0, 0.03)]), rng.choice([0.0, rng.uniform(0, 0.05)]), rng.choice([0.0, rng.uniform(0, 0.1)])
    friction = bed * float(m.inertia(m.rpm, m.r))
    asked = ["scatter", *m.sets(), "--samples", "0", "--force", "--set", f"buffer.expansion_exponent={back!r}", "--set", f"buffer.leak={leak!r}",
             "--set", f"buffer.piston_friction={piston!r}", "--set", f"bed.friction={friction!r} N"]
    got, told = run(binary, asked, directory, name + "-losses")
    if told is None:
        wrong.append(f"losses refused: {got.stderr.strip()}")
        return
    p0, both, volume = float(m.p0), float(m.both), cam.closed
    rise = cam.inertia[-1] / (both * p0)
    step = 2 * (cam.angle[1] - cam.angle[0])
    rate = lambda p: -leak / rise * (p - 1)
    # Every second place of the table is an end of a step, those between are its middle.
    f, pressures = 1.0, [1.0]
    law = lambda f, v: (f * cam.column / v) ** k
    for i in range(0, len(volume) - 2, 2):
        a, b, c = volume[i : i + 3]
        k1 = rate(law(f, a))
        k2 = rate(law(f + step / 2 * k1, b))
        k3 = rate(law(f + step / 2 * k2, b))
        k4 = rate(law(f + step * k3, c))
        f += step / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
        pressures.append(law(f, c))
    on_way_in = np.array(pressures)
    dead, left, shortest = on_way_in[-1], f, volume[-1]
    law = lambda f, v: dead * (f / left * shortest / v) ** back
    returning, way = [dead], volume[::-1]
    for i in range(0, len(way) - 2, 2):
        a, b, c = way[i : i + 3]
        k1 = rate(law(f, a))
        k2 = rate(law(f + step / 2 * k1, b))
        k3 = rate(law(f + step / 2 * k2, b))
        k4 = rate(law(f + step * k3, c))
        f += step / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
        returning.append(law(f, c))
    returning = np.array(returning)[::-1]
    inertia = cam.inertia[::2]
    air = both * p0
    r_in = inertia - (1 + piston) * air * (on_way_in - 1) - friction
    r_back = inertia - (1 - piston) * air * (returning - 1) + friction
    part = told["scatter"].get("losses")
    if part is None:
        if leak or piston or friction or back != k:
            wrong.append("no losses in the report")
        return
    wrong.close(part["air_left"], f, "air left", 1e-9)
    wrong.close(part["residual_in_n"], scan(r_in), "residual in", 1e-7, 10 * rounding)
    wrong.close(part["residual_back_n"], scan(r_back), "residual back", 1e-7, 10 * rounding)
    wrong.close(abs(part["half_loop_n"]), abs(scan((r_back - r_in) / 2)), "half loop", 1e-7, 10 * rounding)
    # The work is the area of the loop over the volume, by trapezoids between places a twentieth of a degree apart.
    area = np.trapezoid if hasattr(np, "trapezoid") else np.trapz
    work = -both * p0 * (area(on_way_in - 1, volume[::2]) - area(returning - 1, volume[::2]))
    if work > 1e-6 * size_of(cam):
        wrong.close(part["work_lost_j"], work, "work lost", 1e-5, 1e-9 * size_of(cam))


def levelled(binary, directory, name, m, rng, wrong, rounding):
    """A cam that is cut to leave half of the loop of its air on either way: the air of its table on both exponents."""
    k = float(m.k)
    back = rng.uniform(k + 1e-3, min(3.0, k + 0.3))
    asked = ["--set", "buffer.balance=level", "--set", f"buffer.expansion_exponent={back!r}"]
    got, report = run(binary, ["rotary", *m.sets(), *asked, "--samples", "14400", "--force", "--set", "transition.kind=run-up"], directory, name + "-level")
    if report is None or not report["files"]:
        return
    losses = report["losses"]
    with open(report["files"][0], newline="") as file:
        table = [(float(row["crank_deg"]), float(row["x_mm"]) / 1000, float(row["dx_mm"]) / 1000) for row in csv.DictReader(file)]
    rows = [row for row in table if 0 <= row[0] <= 90]
    column, lead = report["law"]["column_length_mm"] / 1000, losses["lead_mm"] / 1000
    length = np.array([column - lead - x - dx for _, x, dx in rows])
    # The bottom on the way back is where it was on the way in.
    for degrees, x, dx in table:
        if 90 < degrees <= 180:
            twin = rows[round((180 - degrees) * 40)]
            if abs(twin[2] - dx) > 1e-12 * column:
                wrong.append(f"the bottom at {degrees} is not that at {twin[0]}")
                break
    inertia = np.array([float(m.inertia(m.rpm, X(x))) for _, x, _ in rows])
    air = float(m.both) * float(m.p0)
    gas_in, gas_back = Gas(k, length[-1] / column * 0.99, 1.001), Gas(back, 0.99, column / length[-1] * 1.01)
    on_way_in = gas_in.at(length / column)
    returning = on_way_in[-1] * gas_back.at(length / length[-1])
    r_in, r_back = inertia - air * (on_way_in - 1), inertia - air * (returning - 1)
    wrong.close(losses["residual_in_n"], scan(r_in), "levelled, in", 1e-7, 10 * rounding)
    wrong.close(losses["residual_back_n"], scan(r_back), "levelled, back", 1e-7, 10 * rounding)
    wrong.close(1 + np.abs(r_in + r_back).max() / inertia[-1], 1, "the mean of both ways", 1e-9)
    wrong.close(report["force"]["inertia_max_n"], inertia[-1], "inertia of a levelled cam", 1e-9)
    at_port = air * (1 - on_way_in[-1] * float(gas_back.at(np.array([column / length[-1]]))[0]))
    wrong.close(losses["residual_at_port_n"], at_port, "left at the port", 1e-7, 10 * rounding)
    # Before the reversal the bottom rests at 0 and the piston is a lead inside.
    if abs(rows[0][2]) > 1e-12 or not 0 < lead < column - length[-1]:
        wrong.append(f"no lead: {lead} of {column}, {rows[0]}")


class SliderBed:
    """The bed on a crank-slider, by the crank angle from the start of the reversal at one end: overrun and deceleration over the square of the crank speed."""

    def __init__(self, r, rod, offset, outer):
        self.r, self.rod, self.offset, self.sign = r, rod, offset, 1 if outer else -1
        fine = np.linspace(-math.pi, math.pi, 200001) if outer else np.linspace(0, 2 * math.pi, 200001)
        dead = fine[int((self.sign * self.place(fine)).argmax())]
        braked = lambda at: self.sign * self.second(at) < 0
        step = 1e-3
        start = next(dead - i * step for i in range(1, 4000) if not braked(dead - i * step))
        end = next(dead + i * step for i in range(1, 4000) if not braked(dead + i * step))
        zero = lambda low, high: bisected(lambda at: self.sign * self.second(at) * (1 if braked(low) else -1), low, high)
        self.start, self.angle = zero(start, start + step), 0.0
        self.angle = zero(end - step, end) - self.start
        self.dead = bisected(lambda at: -self.sign * self.first(at), dead - 1e-3, dead + 1e-3) - self.start

    def arm(self, at):
        s = self.r * np.sin(at) - self.offset
        return s, np.sqrt(self.rod**2 - s * s)

    def place(self, at):
        return self.r * np.cos(at) + self.arm(at)[1]

    def first(self, at):
        s, q = self.arm(at)
        return -self.r * np.sin(at) - s * self.r * np.cos(at) / q

    def second(self, at):
        (s, q), s1, s2 = self.arm(at), self.r * np.cos(at), -self.r * np.sin(at)
        return -self.r * np.cos(at) - (s1 * s1 + s * s2) / q - (s * s1) ** 2 / q**3

    def at(self, crank):
        theta = self.start + crank
        return self.sign * (self.place(theta) - self.place(self.start)), np.maximum(-self.sign * self.second(theta), 0.0)


def under_a_linkage(binary, directory, number, rng):
    """The same under a crank-slider: bed by its own kinematics, bottom by the law, which the table of the cam has."""
    m, name, wrong = press(rng), f"linkage-{number}", Wrong()
    m.lead, m.lobes, m.lever, m.column = X(0), 1, X(1), rng.choice(["matched", "return"])
    rod, offset, outer = rng.uniform(2.2, 8), rng.choice([0.0, rng.uniform(-0.25, 0.25)]), rng.random() < 0.5
    sets = [*m.sets(), "--set", f"linkage.rod_ratio={rod!r}", "--set", f"linkage.offset_ratio={offset!r}", "--end", "outer" if outer else "inner"]
    cut, report = run(binary, ["rotary", "dpi-crank-slider", *sets, "--samples", "3600", "--force", "--set", "transition.kind=run-up"], directory, name + "-cam")
    if report is None or not report["files"]:
        return "no cam under a linkage", [], sets
    with open(report["files"][0], newline="") as file:
        rows = [[float(row[key]) for key in ("crank_deg", "x_mm", "dx_mm")] for row in csv.DictReader(file)]
    r, k, p0 = float(m.r), float(m.k), float(m.p0)
    # Which side the offset is on is a matter of definition: the side whose bed the table has.
    sides = [SliderBed(r, rod * r, side * offset * r, outer) for side in (1, -1)]
    inside = lambda bed: np.array([row for row in rows if 0 <= row[0] <= math.degrees(bed.angle)])
    off = lambda bed: np.abs(bed.at(np.radians(inside(bed)[:, 0]))[0] - inside(bed)[:, 1] / 1000).max()
    bed = min(sides, key=off)
    if off(bed) > 1e-9 * r:
        return "linkage", [f"the bed is {off(bed)} m beside its own kinematics"], sets
    omega = 2 * math.pi * float(m.rpm) * float(m.turns) / 60
    design = omega
    dense = np.linspace(0, bed.angle, 20001)
    x, a = bed.at(dense)
    both = float(m.mass) * design**2 * a.max() / (float(m.end) - p0)
    loading = float(m.mass) * omega**2 / (both * p0)
    column = report["law"]["column_length_mm"] / 1000
    bottom = lambda x, a: column * (1 - (1 + loading * a) ** (-1 / k)) - x
    table = inside(bed)
    exact = bottom(*bed.at(np.radians(table[:, 0])))
    if np.abs(exact - table[:, 2] / 1000).max() > 1e-8 * r:
        wrong.append(f"the bottom is {np.abs(exact - table[:, 2] / 1000).max()} m beside the law")

    def residual(true, at, column_of=None):
        """At crank angles; a fixed bottom where its column is given."""
        x, a = bed.at(at)
        own = column if column_of is None else column_of
        volume = own + true["column"] - true["lead"] - x - (bottom(x, a) if column_of is None else 0)
        if volume.min() <= 0:
            return None
        amount = true["air"] * (own + true["column"])
        gas = Gas(true["kappa"], volume.min() / amount * 0.99, max(volume.max() / amount * 1.01, 1.001))
        pressure = true["closing"] * p0 * true["ambient"] * gas.at(volume / amount)
        return float(m.mass) * true["mass"] * (omega * true["speed"]) ** 2 * a - both * (pressure - p0 * true["ambient"])

    true, words = fault(rng, k)
    true["column"], true["lead"] = rng.uniform(-0.02, 0.05) * column, 0.0
    words += ["--fault", f"column={1000 * true['column']!r}mm"]
    seed, samples, rule = rng.randrange(1 << 40), 25, rng.choice(["end", "level"])
    asked = ["scatter", "dpi-crank-slider", *sets, *words, "--samples", str(samples), "--seed", str(seed), "--reset", rule, "--force"]
    got, told = run(binary, asked, directory, name)
    here = residual(true, dense)
    if told is None:
        known = here is None or "column used up" in got.stderr or "no column balances" in got.stderr
        return "refused under a linkage", [] if known else [got.stderr.strip()], asked
    part, rounding = told["scatter"], ROUNDING * max(both * p0, both * p0 * loading * a.max()) * 4
    wrong.close(part["fault"]["residual_n"], scan(here), "residual under a linkage", 1e-6, rounding)
    dead = np.array([bed.dead])
    end = bisected(lambda at: residual({**true, "column": at}, dead)[0], -column * (1 + loading * a.max()) ** (-1 / k) * 0.999, 50 * column)
    wrong.close(part["fault"]["column_end_mm"], 1000 * end, "column of end under a linkage", EXACT, 1e-8 * 1000 * column)
    left = lambda at: abs(scan(residual({**true, "column": at}, dense)))
    wrong.close(abs(part["fault"]["residual_end_n"]), left(end), "residual of end under a linkage", 1e-6, 10 * rounding)
    level = part["fault"]["column_level_mm"] / 1000
    wrong.close(part["fault"]["residual_level_n"], left(level), "residual of level under a linkage", 1e-6, 10 * rounding)
    for step in (-1e-3, 1e-3):
        if left(level + step * column) < left(level) * (1 - 1e-6) - rounding:
            wrong.append(f"a screw {step} of the column beside the level setting leaves less under a linkage")
    stations = np.append(np.linspace(0, bed.angle, 181), [bed.dead, dense[int(a.argmax())]])
    x, a_here = bed.at(stations)
    # Ahead by δ the bottom stands Δx' δ nearer: by a central difference of the law along the crank, times the stiffness of the air.
    ahead = 1e-4
    slope = (bottom(*bed.at(stations + ahead)) - bottom(*bed.at(stations - ahead))) / (2 * ahead)
    slope[np.abs(stations) < 1e-9] = (bottom(*bed.at(np.array([ahead])))[0] - 0.0) / ahead
    nominal, tiny = dict(mass=1.0, speed=1.0, ambient=1.0, kappa=k, closing=1.0, air=1.0, column=0.0), 1e-6 * column
    stiffness = (residual({**nominal, "lead": tiny}, stations) - residual({**nominal, "lead": -tiny}, stations)) / (2 * tiny)
    x_dead, a_dead = (float(values[0]) for values in bed.at(dead))
    fixed = x_dead / (1 - (1 + loading * a_dead) ** (-1 / k))
    built, plain = [], []
    for true, phase, screw in drawn(m, seed, samples):
        built.append(float(np.abs(residual(true, stations) + slope * stiffness * phase).max()))
        reach = lambda at: residual({**true, "column": at}, dead, fixed)[0]
        end = bisected(reach, -(fixed - x_dead - abs(true["lead"])) * 0.999, 50 * fixed)
        plain.append(float(np.abs(residual({**true, "column": end + screw}, stations, fixed)).max()))
    for body, of_body, sizes in (("cam", "none", built), ("fixed-bottom", "end", plain)):
        sizes.sort()
        for row in part["percentiles"]:
            if (row["body"], row["reset"]) == (body, of_body):
                rank = math.ceil(row["percentile"] / 100 * samples - 1e-9)
                wrong.close(row["residual_n"], sizes[rank - 1], f"P{row['percentile']:.0f} {body} under a linkage", 1e-4, 10 * rounding)
    for row in part["settings"][::6]:
        true = {**nominal, "lead": 0.0, "mass": row["v"], "column": row["column_mm"] / 1000 - column}
        wrong.close(row["residual_n"], abs(scan(residual(true, dense))), "residual of a setting under a linkage", 1e-6, 10 * rounding)
        of_fixed = lambda length: abs(scan(residual({**true, "column": 0.0}, dense, length)))
        own = row["fixed_column_mm"] / 1000
        wrong.close(row["fixed_residual_n"], of_fixed(own), "residual of a fixed bottom under a linkage", 2e-4, 10 * rounding)
        if rule == "end":
            ends = [residual(true, dead)[0], residual({**true, "column": 0.0}, dead, own)[0]]
            for force in ends:
                wrong.close(1 + force / (both * p0 * loading * a.max() * max(1.0, row["v"])), 1, "a setting leaves nothing at the dead point", 1e-8)
        elif min(of_fixed(own * (1 - 1e-3)), of_fixed(own * (1 + 1e-3))) < row["fixed_residual_n"] * (1 - 2e-4) - rounding:
            wrong.append(f"a fixed bottom at v = {row['v']} is not levelled under a linkage")
    return "linkage", wrong, asked


def size_of(cam):
    """The work of the largest force over the stroke, J."""
    return float(cam.inertia[-1] * cam.x[-1])


def main():
    words = cases.given("scatter", 12)

    def judged(number, rng):
        of = under_a_linkage if number % 4 == 3 else one
        state, wrong, arguments = of(words.binary, words.directory, number, rng)
        return state, wrong, " ".join(arguments)

    states, failed = cases.judged(words, judged)
    cases.show_largest(Wrong.largest)
    cases.finish(states, failed)


if __name__ == "__main__":
    main()
