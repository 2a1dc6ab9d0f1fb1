"""Solves equation (18) once more and puts both rollers on the written plate.

Shares nothing with camgen but the machine file: (18) as the paper prints it with angles and tangents, solved for the
slope by bisection at every evaluation, integrated by the classical Runge-Kutta method in two step sizes (their
difference is the error of this gate). Compared are the table, the balance along the table, the mirrored flanks of the DXF
and the distance of both rollers from them.

usage: plate.py CAMGEN_BINARY DIRECTORY
"""
import csv
import json
import subprocess
import sys
import tomllib
from math import asin, atan2, cos, log, radians, sin
from pathlib import Path

import numpy as np
from outline import Chain, polyline


class Plate:
    """Equation (18) for the embedded machine with some keys replaced; mm and rad."""

    def __init__(self, machine, column, model, delta):
        self.r, self.k = 180.0, machine["buffer"]["polytropic_exponent"]
        self.A = 1 / self.r  # q = 2
        g = 2 ** (1 / self.k)
        self.L = {"matched": self.k / self.A, "return": self.r * g / (g - 1)}[column]
        self.l1 = self.l2 = 300.0
        self.delta, self.rho, self.eta, self.model = radians(delta), radians(3), 0.95, model

    def air(self, x, y):
        return (self.L / (self.L - x - y)) ** self.k - 1

    def angles(self, y, slope):
        psi = asin(y / self.l2)
        theta = self.delta + psi
        # (21) with v_A = slope v_T/(λ cos ψ).
        v = slope / (self.l2 / self.l1 * cos(psi))
        return psi, theta, atan2(v * sin(theta), 1 + v * cos(theta))

    def right(self, x, y, slope, rho, eta):
        psi, theta, alpha = self.angles(y, slope)
        lam = self.l2 / self.l1
        return self.air(x, y) * (1 + lam * sin(alpha + rho) * cos(psi) / (eta * sin(theta - alpha - rho)))

    def efficiency(self, slope, back=False):
        if self.model == "printed" or slope == 0:
            return self.eta if self.model == "printed" else 1.0
        return self.eta if (slope > 0) != back else 1 / self.eta

    def slope(self, x, y):
        """Bisection of (18) for the slope; 0 where the lever sticks."""
        load = self.A * x
        low, high = -0.99, 1.5
        left = lambda s: load - self.right(x, y, s, self.rho, self.efficiency(s))
        for _ in range(60):
            middle = (low + high) / 2
            if left(middle) > 0:
                low = middle
            else:
                high = middle
        return 0.0 if low < 0 < high or abs(low) < 1e-14 else low

    def start(self):
        """The slope at x = 0, from (18) at a hair of overrun with y = s x; Richardson takes the rest away."""
        near = lambda x: self.fixed(lambda s: self.slope(x, s * x))
        return 2 * near(1e-4) - near(2e-4)

    @staticmethod
    def fixed(f):
        low, high = -0.9, 1.4
        for _ in range(60):
            middle = (low + high) / 2
            if f(middle) > middle:
                low = middle
            else:
                high = middle
        return low

    def solve(self, steps):
        # Squared spacing: the solution leaves x = 0 on a line found above.
        xs = self.r * np.linspace(0, 1, steps + 1) ** 2
        first = self.start()
        ys = [0.0, first * xs[1]]
        for a, b in zip(xs[1:-1], xs[2:]):
            y, h = ys[-1], b - a
            k1 = self.slope(a, y)
            k2 = self.slope(a + h / 2, y + h / 2 * k1)
            k3 = self.slope(a + h / 2, y + h / 2 * k2)
            k4 = self.slope(b, y + h * k3)
            ys.append(y + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4))
        return first, xs, np.array(ys)


def gate(binary, directory, name, column, model, delta):
    args = ["--set", f"buffer.column={column}", "--set", f"translating.efficiency_model={model}"]
    args += ["--set", f"translating.delta={delta}deg", "--set", "limits.pressure_angle=80deg", "--samples", "400"]
    command = [binary, "translating", *args, "--json", "--format", "dxf,csv", "--name", name, "--out", directory]
    run = subprocess.run(command, capture_output=True, text=True)
    assert run.returncode == 0, run.stderr
    report = json.loads(run.stdout)
    show = subprocess.run([binary, "machines", "show", "dpi"], capture_output=True, text=True, check=True).stdout
    plate = Plate(tomllib.loads(show), column, model, delta)
    with open(directory / f"{name}.csv", newline="") as file:
        rows = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]
    table = {key: np.array([row[key] for row in rows]) for key in rows[0]}
    x, y = table["x_mm"], table["dx_mm"]

    # The squared steps do not meet the rows: the table is carried to them from the nearest row by its own slope, which
    # costs 2e-5 mm beside the breaks of the slope.
    first, xs, ys = plate.solve(800)
    _, _, half = plate.solve(400)
    own_error = np.abs(ys[::2] - half).max()
    slope_error = abs(first - report["law"]["start_slope"])
    nearest = np.abs(x[:, None] - xs[None, :]).argmin(axis=0)
    off = xs - x[nearest]
    curvature = np.gradient(table["slope"], x)[nearest]
    value = y[nearest] + off * table["slope"][nearest] + off**2 / 2 * curvature
    law = np.abs(value - ys).max()

    forces, back = [], []
    peak = report["force"]["inertia_max_n"]
    for row in rows[1:]:
        sticks = row["slope"] == 0
        left = lambda rho, eta: (plate.A * row["x_mm"] - plate.right(row["x_mm"], row["dx_mm"], row["slope"], rho, eta))
        if not sticks:
            forces.append(abs(left(plate.rho, plate.efficiency(row["slope"]))))
            eta = plate.efficiency(row["slope"], back=plate.model == "consistent")
            # Δx falls on the way back where it rose: the losses change sides.
            back.append(abs(left(-plate.rho, eta) * peak - row["residual_return_n"]) / peak)
        psi, theta, alpha = plate.angles(row["dx_mm"], row["slope"])
        assert abs(np.degrees(psi) - row["psi_deg"]) < 1e-9 and abs(np.degrees(alpha) - row["alpha_deg"]) < 1e-9
    axis = report["cam"]["plate"]["axis_distance_mm"]
    theta = plate.delta + np.radians(table["psi_deg"])
    pitch = np.stack([x + 300 * (np.sin(theta) - sin(plate.delta)), axis + 300 * (cos(plate.delta) - np.cos(theta))])
    drawn = np.abs(pitch - np.stack([table["pitch_x_mm"], table["pitch_y_mm"]])).max()

    document, vertices = polyline(directory / f"{name}.dxf")
    chain = Chain(vertices)
    assert chain.area() > 0
    mirrored = vertices[:, :2] * [1, -1]
    symmetric = max(np.hypot(*(vertices[:, :2] - point).T).min() for point in mirrored)
    gaps = [np.abs(chain.distance((pitch * [[1], [side]]).T) - 30).max() for side in (1, -1)]
    corners = np.sum(np.abs(chain.kinks()) > 0.05)
    height = np.ptp(chain.flattened(1e-4)[:, 1])

    assert slope_error < 1e-6, f"starting slope off by {slope_error}"
    assert law < own_error + 2e-5, f"law off by {law} mm, this gate by {own_error}"
    assert max(forces) < 1e-9 and max(back) < 1e-9, f"(18) is left with {max(forces)}, on the way back {max(back)}"
    assert drawn < 1e-9, f"pitch curve off by {drawn}"
    assert symmetric < 1e-9 and corners == 4, f"flanks {symmetric}, {corners} corners"
    assert max(gaps) <= 0.005, f"gap {max(gaps)} mm"
    assert abs(height - 120) < 0.02, f"height {height}"
    return law, own_error, max(forces), max(gaps)


def main():
    binary, directory = Path(sys.argv[1]).resolve(), Path(sys.argv[2])
    print(f"{'plate':22} {'law/mm':>9} {'own error':>9} {'(18)/Pmax':>10} {'gap/mm':>8}")
    failed = 0
    for column in ("matched", "return"):
        for model in ("consistent", "printed"):
            for delta in (90, 70):
                name = f"{column}-{model}-{delta}"
                try:
                    law, own, force, gap = gate(binary, directory, name, column, model, delta)
                    print(f"{name:22} {law:9.1e} {own:9.1e} {force:10.1e} {gap:8.5f}")
                except AssertionError as error:
                    failed += 1
                    print(f"{name}: {error}")
    sys.exit(bool(failed))


main()
