"""Errors of manufacture: the follower on a profile that is changed in full, and what a study of them finds.

Shares nothing with camgen but the machine file. The profile of a cycloidal motion is moved along its normals by waves and wear, and shifted off
its shaft; the path of the centre of the roller as it is made is the parallel of that curve; a straight path or an arm, where it really lies, meets it at
a cam angle with a lift. Nothing is to first order. Judges random discs, then a study of the roller's radius by the closed form of its distribution.

usage: as_made.py CAMGEN_BINARY DIRECTORY [--count N] [--seed N] [--jobs N]
"""
import copy
import csv
import json
import math
import subprocess

import cases
import numpy as np

TURN = 2 * math.pi
PLACES = 60000


def program(rise, high, back):
    """Cycloidal rise and return of 1, with dwells; value and three derivatives at angles in radians."""

    def jet(theta):
        value = [np.zeros_like(theta) for _ in range(3)]
        for start, span, sign in ((0.0, rise, 1), (rise + high, back, -1)):
            x = (theta - start) / span
            inside = (x >= 0) & (x <= 1)
            shape = [x - np.sin(TURN * x) / TURN, (1 - np.cos(TURN * x)) / span, TURN * np.sin(TURN * x) / span**2]
            for order in range(3):
                part = shape[order] if sign > 0 else (1 - shape[0] if order == 0 else -shape[order])
                value[order] = np.where(inside, part, value[order])
        value[0] = np.where((theta > rise) & (theta < rise + high), 1.0, value[0])
        return value

    return jet


def unit(angle):
    return np.stack([np.cos(angle), np.sin(angle)], axis=-1)


def derivative(curve, step):
    """Of a closed curve by evenly spaced places, exact to the sixth order."""
    shifted = lambda by: np.roll(curve, -by, axis=0)
    return (45 * (shifted(1) - shifted(-1)) - 9 * (shifted(2) - shifted(-2)) + (shifted(3) - shifted(-3))) / (60 * step)


class Case:
    def __init__(self, rng):
        self.swings = rng.random() < 0.5
        self.rise, self.high, self.back = (math.radians(rng.randint(*span)) for span in ((80, 140), (20, 60), (80, 140)))
        self.lift = math.radians(rng.uniform(8, 20)) if self.swings else rng.uniform(6, 25)
        self.radius, self.base, self.rpm = rng.uniform(6, 14), rng.uniform(45, 70), rng.uniform(60, 300)
        self.arm, self.pivot, self.offset = rng.uniform(70, 110), 0.0, 0.0
        if self.swings:
            prime = self.base + self.radius
            self.pivot = math.hypot(prime, self.arm) * rng.uniform(0.97, 1.03)
        else:
            self.offset = rng.uniform(-10, 10)
        um = lambda size: rng.uniform(-size, size) * 1e-3
        self.roller = um(15)
        self.place, self.side = um(30), um(30)
        self.eccentricity, self.at = abs(um(20)), rng.uniform(0, TURN)
        self.wear, self.ahead = abs(um(10)), math.radians(rng.uniform(-0.05, 0.05))
        self.preload, self.mass, self.width = rng.uniform(800, 1500), rng.uniform(1, 4), rng.uniform(12, 25)

    def text(self):
        lift = f"{math.degrees(self.lift)!r} deg" if self.swings else f"{self.lift!r} mm"
        segment = "[[motion.segment]]\nlaw = "
        motion = (
            f'{segment}"cycloidal"\nover = "{math.degrees(self.rise)!r} deg"\nto = "{lift}"\n'
            f'{segment}"dwell"\nover = "{math.degrees(self.high)!r} deg"\n'
            f'{segment}"cycloidal"\nover = "{math.degrees(self.back)!r} deg"\nto = "0 {lift.split()[1]}"\n{segment}"dwell"\n'
        )
        if self.swings:
            follower = (f'[follower.swinging-roller]\nradius = "{self.radius!r} mm"\narm = "{self.arm!r} mm"\npivot_distance = "{self.pivot!r} mm"\nside = "trailing"\n'
                        f'inertia = "0.01 kg*m2"\n')
        else:
            follower = f'[follower.roller]\nradius = "{self.radius!r} mm"\noffset = "{self.offset!r} mm"\nmass = "{self.mass!r} kg"\npreload = "{self.preload!r} N"\n'
        place = f'centre_distance = "{self.place!r} mm"\noffset = "{self.side!r} mm"'
        return (f'name = "as made"\n[motion]\nrpm = {self.rpm!r}\nstart = "0 {lift.split()[1]}"\n{motion}{follower}[cam]\nbase_radius = "{self.base!r} mm"\nthickness = "{self.width!r} mm"\n'
                f'material = "steel"\n[as_made]\nroller_radius = "{self.roller!r} mm"\n{place}\neccentricity = "{self.eccentricity!r} mm"\n'
                f'eccentricity_at = "{self.at!r} rad"\nangle = "{self.ahead!r} rad"\nwear = "{self.wear!r} mm"\n')

    def lifts(self, theta):
        return [self.lift * part for part in program(self.rise, self.high, self.back)(theta)]

    def pitch(self, theta):
        s, ds, _ = self.lifts(theta)
        prime = self.base + self.radius
        along, across = unit(theta), unit(theta + TURN / 4)
        if not self.swings:
            height = math.sqrt(prime**2 - self.offset**2) + s
            point = along * height[:, None] + across * self.offset
            slope = along * (ds - self.offset)[:, None] + across * height[:, None]
        else:
            start = math.acos((self.pivot**2 + self.arm**2 - prime**2) / (2 * self.pivot * self.arm))
            psi = start + s
            e = unit(theta + psi)
            point = self.pivot * along - self.arm * e
            slope = self.pivot * across - self.arm * unit(theta + psi + TURN / 4) * (1 + ds)[:, None]
        slope /= np.linalg.norm(slope, axis=1)[:, None]
        return point, np.stack([slope[:, 1], -slope[:, 0]], axis=-1)

    def made(self):
        """Cam angle and lift of the follower as made, with the first-order-free path of the roller's centre."""
        theta = np.arange(PLACES) * TURN / PLACES
        pitch, normal = self.pitch(theta)
        profile = pitch - normal * (self.radius + self.wear) + self.eccentricity * unit(np.array(self.at))
        tangent = derivative(profile, TURN / PLACES)
        tangent /= np.linalg.norm(tangent, axis=1)[:, None]
        centre = profile + (self.radius + self.roller) * np.stack([tangent[:, 1], -tangent[:, 0]], axis=-1)
        size = np.linalg.norm(centre, axis=1)
        polar = np.unwrap(np.arctan2(centre[:, 1], centre[:, 0]))
        if self.swings:
            # The frame of the pivot is turned by γ; the arm is read in that of the drawing.
            pivot, turned = math.hypot(self.pivot + self.place, self.side), math.atan2(self.side, self.pivot + self.place)
            angle = polar + np.arccos((pivot**2 + size**2 - self.arm**2) / (2 * pivot * size)) - turned
            prime = self.base + self.radius
            start = math.acos((self.pivot**2 + self.arm**2 - prime**2) / (2 * self.pivot * self.arm))
            lift = np.arccos((pivot**2 + self.arm**2 - size**2) / (2 * pivot * self.arm)) + turned - start
        else:
            offset = self.offset + self.side
            height = np.sqrt(size**2 - offset**2)
            angle = polar - np.arctan2(offset, height)
            lift = height - self.place - math.sqrt((self.base + self.radius) ** 2 - self.offset**2)
        # A cam that is ahead comes earlier.
        angle = angle - self.ahead
        # By the angle at which it really comes; both are functions of the place on the cam.
        step = TURN / PLACES
        pace = derivative(angle - theta, step) + 1
        first = derivative(lift, step) / pace
        second = derivative(first, step) / pace
        nominal = self.lifts(np.mod(angle, TURN))
        errors = [lift - nominal[0], second - nominal[2]]
        order = np.argsort(np.mod(angle, TURN))
        return np.mod(angle, TURN)[order], [part[order] for part in (lift, first, second)], [error[order] for error in errors]


def one(words, number, rng):
    case = Case(rng)
    path = words.directory / f"{number}.toml"
    path.write_text(case.text())
    command = [words.binary, "make", str(path), "--json", "--dry-run"]
    ran = subprocess.run(command, capture_output=True, text=True)
    if ran.returncode == 2:
        return "refused", [ran.stderr.strip()[:300]] if "as_made" in ran.stderr else [], " ".join(command)
    report = json.loads(ran.stdout)
    told = report["as_made"]
    angle, (lift, first, second), (error, jerk) = case.made()
    scale = case.arm if case.swings else 1.0
    # Second order: an error of 60 µm over a radius of curvature of some 5 mm, and the angle times the acceleration.
    largest = np.abs(error * scale).max()
    slack = 5e-5 + 0.004 * largest
    wrong = []

    def near(name, found, wanted, slack):
        if not abs(found - wanted) <= slack:
            wrong.append(f"{name}: told {found}, is {wanted}")

    near("low", told["lift_error_low_mm"], error.min() * scale, slack)
    near("high", told["lift_error_high_mm"], error.max() * scale, slack)
    near("range", told["lift_error_range_mm"], (error.max() - error.min()) * scale, slack)
    even = np.interp(np.arange(20000) * TURN / 20000, angle, error, period=TURN) * scale
    near("rms", told["lift_error_rms_mm"], math.sqrt((even**2).mean()), slack)
    omega = case.rpm * TURN / 60
    # At the ends of a movement the acceleration of the error has a kink, where differences of it mean nothing.
    acceleration = np.quantile(np.abs(jerk), 0.9999) * omega**2
    if case.swings:
        near("acceleration", told["acceleration_error_max_rad_per_s2"], acceleration, 0.02 * acceleration)
    else:
        near("acceleration", told["acceleration_error_max_m_per_s2"], acceleration * 1e-3, 0.02 * acceleration * 1e-3)
        # Where cam and follower sit moves the contact along the cam; forces are those of the surfaces.
        seated = copy.copy(case)
        seated.place = seated.side = seated.eccentricity = seated.ahead = 0.0
        _, (lift, first, second), _ = seated.made()
        height = math.sqrt((case.base + case.radius) ** 2 - case.offset**2) + lift
        tangent = (first - case.offset) / height
        force = (case.preload + case.mass * second * 1e-3 * omega**2) * np.sqrt(1 + tangent**2)
        near("largest force", told["contact_force_max_n"], force.max(), 0.002 * force.max())
        near("least force", told["contact_force_min_n"], force.min(), 0.002 * force.max())
        # A line of contact, K. L. Johnson: the curvature of the path of the centre gives that of the profile.
        bend = (height**2 + 2 * (first - case.offset) ** 2 - (first - case.offset) * first - height * second) / (height**2 + (first - case.offset) ** 2) ** 1.5
        relative = 1 / (case.radius + case.roller) + bend / (1 - bend * (case.radius + case.roller))
        modulus = 210e3 / (2 * (1 - 0.3**2))
        stress = np.sqrt(np.maximum(force, 0) * modulus * relative / (math.pi * case.width))
        near("pressure", told["contact_stress_max_mpa"], stress.max(), 0.01 * stress.max())
    return "judged", wrong, " ".join(command)


def study(words):
    """The largest error of the lift for an error δ of the roller is |δ|/cos α at the largest pressure angle: half a normal distribution."""
    case = Case(__import__("random").Random("study"))
    base = words.directory / "study-base.toml"
    base.write_text(case.text().split("[as_made]")[0])
    file = words.directory / "roller.toml"
    deviation, rows = 0.004, 4000
    file.write_text(f'name = "roller"\nbase = "study-base.toml"\nkind = "monte-carlo"\nrows = {rows}\nsampling = "random"\nseed = 7\n'
                    f'columns = ["as_made.lift_error_max_mm", "checks.pressure_angle.value"]\n[[parameter]]\nkey = "as_made.roller_radius"\n'
                    f'mean = "0 mm"\ndeviation = "{deviation} mm"\n')
    ran = subprocess.run([words.binary, "study", str(file), "--out", str(words.directory), "--restart"], capture_output=True, text=True)
    if ran.returncode:
        return [ran.stderr]
    table = list(csv.DictReader((words.directory / "roller.csv").open()))
    errors = np.array([float(row["as_made.lift_error_max_mm"]) for row in table])
    steep = math.radians(float(table[0]["checks.pressure_angle.value"]))
    scale = deviation / math.cos(steep)
    mean, square = scale * math.sqrt(2 / math.pi), scale**2
    wrong = []
    # Four standard deviations of the mean of so many rows.
    if abs(errors.mean() - mean) > 4 * scale * math.sqrt((1 - 2 / math.pi) / rows):
        wrong.append(f"mean of the study {errors.mean()}, closed form {mean}")
    if abs((errors**2).mean() - square) > 4 * square * math.sqrt(2 / rows):
        wrong.append(f"mean square of the study {(errors**2).mean()}, closed form {square}")
    print(f"study: mean {errors.mean():.6f} mm, closed form {mean:.6f}; {rows} rows")
    return wrong


def main():
    words = cases.given("as_made", 40)
    states, failed = cases.judged(words, lambda number, rng: one(words, number, rng))
    wrong = study(words)
    for what in wrong:
        print("  study: " + what)
    cases.finish(states, failed + bool(wrong))


if __name__ == "__main__":
    main()
