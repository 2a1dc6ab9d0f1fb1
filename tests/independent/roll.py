"""Rolls a roller on the outline of a written DXF and compares it with the law, all round.

Shares nothing with camgen but the machine file and the chosen base radius: the law is equation (10) or (12) and its
column as the paper gives them, the transition a polynomial found by a linear system, the outline what ezdxf reads.
For every cam angle the roller's centre is put where the law wants it: its distance from the outline less the roller
radius is the gap along the normal. Then the centre is moved along the follower's path until the roller touches: the
lift error.

usage: roll.py CAMGEN_BINARY DIRECTORY
"""
import json
import subprocess
import sys
import tomllib
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import numpy as np
from outline import Chain, polyline

UNITS = {"um": 1e-3, "mm": 1.0, "cm": 10.0, "m": 1000.0, "kg": 1.0, "at": 1.0, "deg": np.pi / 180, "rad": 1.0}


def quantity(text):
    number = text.rstrip("abcdefghijklmnopqrstuvwxyz ")
    return float(number) * UNITS[text[len(number):].strip() or "mm"] if number else text


class Cam:
    """The law of one machine in mm and rad, from the paper."""

    def __init__(self, machine, rpm):
        get = lambda table, key, default: machine[table].get(key, default)
        self.r = quantity(machine["bed"]["crank_radius"])
        self.k = machine["buffer"]["polytropic_exponent"]
        q = quantity(machine["buffer"]["end_pressure"]) / quantity(machine["buffer"]["ambient_pressure"])
        self.A = (q - 1) / self.r * (rpm / machine["design"]["rpm"]) ** 2
        column = machine["buffer"]["column"]
        g = (1 + self.A * self.r) ** (1 / self.k)
        self.L = {"matched": self.k / self.A, "return": self.r * g / (g - 1)}.get(column) or quantity(column)
        self.lead = quantity(get("buffer", "lead", "0 mm"))
        self.lever = float(get("cam", "lever", 1.0))
        self.lobes = round(1 / float(get("cam", "cam_turns_per_crank_turn", 1.0)))
        self.roller = quantity(machine["follower"]["roller"]["radius"])
        self.offset = quantity(machine["follower"]["roller"].get("offset", "0 mm"))
        self.ccw = get("cam", "rotation", "cw") == "ccw"
        self.kind, self.width = machine["transition"]["kind"], quantity(machine["transition"]["width"])
        self.start = -self.lead / self.r
        if self.kind == "run-up":
            # Value, slope and curvature at the end; rest with continuous jerk at the beginning.
            v, a, end = (-self.r, 0.0, 0.0) if self.lead else (*self.slopes(0.0), 0.0)
            self.piece = (self.start - self.width, self.start)
            rows, right = [], [end, v, a, 0.0, 0.0, 0.0]
            for t, order in [(1, 0), (1, 1), (1, 2), (0, 1), (0, 2), (0, 3)]:
                rows.append(self.row(t, order))
        elif self.kind == "blend":
            half = self.width / 2
            self.piece = (-half, half)
            rows = [self.row(t, order) for t, order in [(1, 0), (1, 1), (1, 2), (0, 0), (0, 1), (0, 2)]]
            right = [self.law(half), *self.slopes(half), 0.0, 0.0, 0.0]
        else:
            self.piece, self.dwell = (self.start, self.start), 0.0
            return
        self.polynomial = np.linalg.solve(np.array(rows, dtype=float), np.array(right))
        self.dwell = self.polynomial[0]

    def row(self, t, order):
        """Coefficients of a derivative by the crank angle of Σ cₙ tⁿ, n ≤ 5."""
        factor = [np.prod(range(n - order + 1, n + 1)) if n >= order else 0 for n in range(6)]
        return [f * (float(t) ** max(n - order, 0)) / self.width**order for n, f in enumerate(factor)]

    def law(self, phi):
        x = self.r * np.sin(phi)
        return self.L * (1 - (self.A * x + 1) ** (-1 / self.k)) - (x + self.lead)

    def slopes(self, phi):
        x, dx = self.r * np.sin(phi), self.r * np.cos(phi)
        slope = self.L * self.A / self.k * (1 + self.A * x) ** (-1 / self.k - 1) - 1
        second = -self.L * self.A**2 / self.k * (1 / self.k + 1) * (1 + self.A * x) ** (-1 / self.k - 2)
        return slope * dx, second * dx**2 - slope * x

    def bottom(self, theta):
        """Δx at cam angles in [0, 2π)."""
        phi = np.mod(theta * self.lobes, 2 * np.pi)
        phi = np.where(phi > np.pi / 2 + np.pi, phi - 2 * np.pi, phi)
        phi = np.minimum(phi, np.pi - phi)
        low, high = self.piece
        balance = self.law(np.clip(phi, 0, None))
        before = np.full_like(phi, self.dwell)
        if self.kind != "none":
            t = np.clip((phi - low) / self.width, 0, 1)
            before = np.where(phi >= low, sum(c * t**n for n, c in enumerate(self.polynomial)), before)
        retreat = -(self.lead + self.r * phi)
        outside = np.where((phi >= self.start) & (self.lead > 0), retreat, before)
        return np.where(phi >= (high if self.kind == "blend" else 0.0), balance, outside)


def roll(binary, directory, name, overrides, flags, tolerance):
    """Writes a cam into a directory, rolls on it, and returns a row of the table; raises when the tolerance is broken."""
    sets = [part for override in overrides for part in ("--set", override)]
    command = [binary, "rotary", *name, *sets, *flags, "--tolerance", f"{tolerance * 1e3}um", "--json",
               "--format", "dxf", "--out", str(directory), "--force"]
    run = subprocess.run(command, capture_output=True, text=True)
    assert run.returncode in (0, 1), run.stderr
    report = json.loads(run.stdout)
    toml = subprocess.run([binary, "machines", "show", name[0] if name else "dpi"], capture_output=True, text=True)
    machine = tomllib.loads(toml.stdout)
    for override in overrides:
        path, value = override.split("=")
        table = machine
        *tables, key = path.split(".")
        for part in tables:
            table = table[part]
        table[key] = value
    cam = Cam(machine, report["rpm"])
    _, vertices = polyline(report["files"][0])
    chain = Chain(vertices)

    grid = np.radians(np.arange(0, 360, 0.05))
    edges = np.array([0.0, *cam.piece, cam.start])
    edges = np.concatenate([edges, np.pi - edges]) / cam.lobes
    edges = (edges[:, None] + np.arange(cam.lobes) * (2 * np.pi / cam.lobes)).ravel()
    near = (edges[:, None] + np.linspace(-1e-3, 1e-3, 41)).ravel()
    theta = np.mod(np.concatenate([grid, near]), 2 * np.pi)
    bottom = cam.bottom(theta)
    # The least of a fine scan, then of the closed form's own end: the dip of a matched law is at x = r.
    least = min(cam.bottom(np.radians(np.arange(0, 360, 0.01))).min(), cam.bottom(np.array([np.pi / 2 / cam.lobes])).min())
    lift = cam.lever * (bottom - least)
    prime = report["cam"]["prime_radius_mm"]
    height = np.sqrt(prime**2 - cam.offset**2) + lift
    along = np.stack([np.cos(theta), np.sin(theta)], axis=1)
    across = np.stack([-np.sin(theta), np.cos(theta)], axis=1)
    mirror = np.array([1.0, -1.0 if cam.ccw else 1.0])
    centre = lambda h: (along * h[:, None] + across * cam.offset) * mirror
    gap = chain.distance(centre(height)) - cam.roller

    # Newton along the path; its slope, cos α, from two neighbouring distances.
    moved, step = height.copy(), 1e-4
    for _ in range(4):
        here = chain.distance(centre(moved)) - cam.roller
        cosine = (chain.distance(centre(moved + step)) - chain.distance(centre(moved - step))) / (2 * step)
        moved -= here / cosine
    lift_error = (moved - height) * cosine
    kink = np.abs(chain.kinks()).max()
    row = (np.abs(gap).max() * 1e3, np.abs(lift_error).max() * 1e3, kink, len(vertices))
    # Rounding of the coordinates, twelve decimals and a radius of metres, on top of the tolerance.
    allowed = tolerance + 2e-9
    assert np.abs(gap).max() <= allowed, f"gap {row[0]} um at {np.degrees(theta[np.abs(gap).argmax()])} deg"
    assert np.abs(lift_error).max() <= allowed * 1.001, f"lift {row[1]} um"
    assert kink <= 0.05, f"kink {kink} deg"
    assert chain.area() > 0
    return row


def rolled(run, binary, directory):
    """A line of the table, and whether the tolerance is kept."""
    number, title, name, overrides, flags, tolerance = run
    begin = f"{title:26} {tolerance * 1e3:7}"
    try:
        gap, lift, kink, arcs = roll(binary, directory / f"roll-{number}", name, overrides, flags, tolerance)
    except AssertionError as error:
        return f"{begin} FAILED {error}", False
    return f"{begin} {gap:10.6f} {lift:10.6f} {kink:9.1e} {arcs:5}", True


def main():
    binary, directory = str(Path(sys.argv[1]).resolve()), Path(sys.argv[2])
    cases = [
        ("dpi", [], [], []),
        ("dpi-paper", ["dpi-paper"], [], []),
        ("dpi-paper 700 mm, forced", ["dpi-paper"], ["cam.base_radius=700mm"], []),
        ("25 rpm", [], [], ["--rpm", "25"]),
        ("return", [], ["buffer.column=return"], []),
        ("return, corner", [], ["buffer.column=return", "transition.kind=none"], []),
        ("column 200 mm", [], ["buffer.column=200mm"], []),
        ("blend", [], ["transition.kind=blend", "transition.width=30deg"], []),
        ("offset 20 mm", [], ["follower.roller.offset=20mm"], []),
        ("offset −20 mm, ccw", [], ["follower.roller.offset=-20mm", "cam.rotation=ccw"], []),
        ("lever 0.5, roller 12 mm", [], ["cam.lever=0.5", "follower.roller.radius=12mm"], []),
        ("two lobes", [], ["cam.cam_turns_per_crank_turn=0.5"], []),
        ("three lobes, offset, ccw", [], ["cam.cam_turns_per_crank_turn=0.3333", "follower.roller.offset=8mm", "cam.rotation=ccw"], []),
        ("three lobes, corner", [], ["cam.cam_turns_per_crank_turn=0.3333", "buffer.column=return", "transition.kind=none"], []),
        ("four lobes, blend", [], ["cam.cam_turns_per_crank_turn=0.25", "transition.kind=blend", "transition.width=30deg"], []),
        ("four lobes, lead", [], ["cam.cam_turns_per_crank_turn=0.25", "buffer.lead=5mm"], []),
        ("lead 5 mm", [], ["buffer.lead=5mm"], []),
    ]
    print(f"{'cam':26} {'tol/um':>7} {'gap/um':>10} {'lift/um':>10} {'kink/deg':>9} {'arcs':>5}")
    failed = 0
    runs = [(number, *case, tolerance) for number, (case, tolerance) in enumerate((case, tolerance) for tolerance in (0.005, 0.000_05) for case in cases)]

    with ProcessPoolExecutor(2) as pool:
        for line, passed in pool.map(rolled, runs, [binary] * len(runs), [directory] * len(runs)):
            failed += not passed
            print(line)
    print(f"{len(runs) - failed} passed, {failed} failed")
    sys.exit(failed > 0)


if __name__ == "__main__":
    main()
