"""Interpolates the tables of `--format servo-csv`, `servo-xyva`, `servo-twincat` and `servo-isg` as the controls document it, against motions integrated here.

Shares nothing with camgen but the motion programs below: the laws are those of laws.py, integrated by Gauss' rule. Between two nodes the drive runs
on the polynomial of degree 5 with position, velocity and acceleration of both ends, whose coefficients are solved here as a linear system. The
position must be within the tolerance, of an arm at its end, and the velocity within a thousandth of the largest, at many places. Numbers changed in a
table must make `camgen check` refuse it.

usage: servo.py CAMGEN_BINARY DIRECTORY [--count N] [--seed S]
"""
import argparse
import re
import subprocess
import sys
from pathlib import Path

import groove
import numpy as np
from form_closed import LAWS, failed, make
from laws import motion

TOLERANCE = 5e-3
# Of the quadrature of the laws and of the differences of its values.
ROUNDING = 1e-6
VELOCITY = 1e-3
NUMBER = r"(-?[0-9.]+(?:[eE][-+]?\d+)?)"
ENDINGS = {"servo-csv": "-servo.csv", "servo-xyva": "-xyva.st", "servo-twincat": "-twincat.st"}
ISG = "-isg.txt"


def nodes(path):
    """The nodes of a table as an array of master, slave, velocity, acceleration."""
    text = path.read_text()
    if path.suffix == ".csv":
        rows = [line for line in text.splitlines() if line and not line.startswith("#")]
        return np.array([[float(cell) for cell in row.split(",")] for row in rows[1:]])
    names = ["dX", "dY", "dV", "dA"] if "SMC_CAMXYVA" in text else ["MasterPos", "SlavePos", "SlaveVelo", "SlaveAcc"]
    found = re.findall(", ".join(f"{name} := {NUMBER}" for name in names), text)
    low, high = re.search(r"ARRAY\[(\d+)\.\.(\d+)\]", text).groups()
    assert len(found) == int(high) - int(low) + 1, (len(found), low, high)
    assert "nElements" not in text or int(re.search(r"nElements := (\d+)", text)[1]) == len(found)
    return np.array(found, dtype=float)


def equal_parts(text):
    """Positions at equal parts of the turn of a table of the controls of ISG, closed by the first, in mm or degrees."""
    head, rows = re.fullmatch(r"(.*)Begintable\n(.*)EndTable\n", text, re.S).groups()
    stated = dict(re.findall(r"^([\w-]+) = ([^ #\n]+)", head, re.M))
    assert (stated["Tabletype"], stated["Functiontype"]) == ("3", "1"), stated
    slave = 1e-4 * np.array([float(row) for row in rows.split()])
    assert int(stated["Lines"]) == len(slave)
    return np.linspace(0, 360, len(slave) + 1), np.append(slave, slave[0])


def interpolated(table):
    """Position and velocity of the drive at many places: master, slave, velocity by degree."""
    masters, slaves, speeds = [], [], []
    for (x, y, v, a), (x1, y1, v1, a1) in zip(table, table[1:]):
        h = x1 - x
        powers = np.arange(6)
        rows = [0.0**powers, [0, 1, 0, 0, 0, 0], [0, 0, 2, 0, 0, 0], np.ones(6), powers, powers * (powers - 1)]
        coefficients = np.linalg.solve(np.array(rows, dtype=float), [y, v * h, a * h * h, y1, v1 * h, a1 * h * h])
        share = np.linspace(0, 1, 13)[:-1]
        masters.append(x + share * h)
        slaves.append(np.polynomial.polynomial.polyval(share, coefficients))
        speeds.append(np.polynomial.polynomial.polyval(share, np.polynomial.polynomial.polyder(coefficients)) / h)
    return np.concatenate(masters), np.concatenate(slaves), np.concatenate(speeds)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("binary")
    parser.add_argument("directory", type=Path)
    parser.add_argument("--count", type=int, default=15)
    parser.add_argument("--seed", type=int, default=1)
    asked = parser.parse_args()
    random = __import__("random").Random(asked.seed)
    folder = asked.directory / "servo"
    folder.mkdir(parents=True, exist_ok=True)
    worst, made, most, refused, straight = [0.0, 0.0], 0, 0, 0, 0
    for index in range(asked.count):
        found = groove.design(random)
        found["body"] = "groove"
        found["segments"] = [(random.choice(LAWS) if law != "dwell" else law, over, to) for law, over, to in found["segments"]]
        tolerance = random.choice([TOLERANCE, 1e-3, 0.05])
        done = make(asked.binary, folder, groove.toml(found), ",".join(ENDINGS), "--force", "--tolerance", f"{1e3 * tolerance!r}um")
        if done.returncode == 2:
            continue
        assert "servo" not in failed(done), (index, done.stdout[:3000])
        made += 1
        tables = [nodes(folder / f"cam{ending}") for ending in ENDINGS.values()]
        assert all(np.array_equal(tables[0], other) for other in tables), index
        most = max(most, len(tables[0]))
        master, slave, speed = interpolated(tables[0])
        exact = motion(found["segments"], 0.0, master)
        arm = np.radians(1) * found["place"]["arm"] if found["swings"] else 1.0
        off = np.abs(slave - exact).max() * arm
        step = 1e-3
        inner = (master > step) & (master < 360 - step)
        slope = (motion(found["segments"], 0.0, master[inner] + step) - motion(found["segments"], 0.0, master[inner] - step)) / (2 * step)
        share = np.abs(speed[inner] - slope).max() / np.abs(slope).max()
        assert off < tolerance + ROUNDING and share < VELOCITY * (1 + 1e-2), (index, off, share, groove.toml(found))
        worst = [max(worst[0], off / tolerance), max(worst[1], share)]
        isg = folder / f"cam{ISG}"
        isg.unlink(missing_ok=True)
        done = make(asked.binary, folder, groove.toml(found), "servo-isg", "--force", "--tolerance", f"{1e3 * tolerance!r}um")
        if isg.exists():
            straight += 1
            masters, slaves = equal_parts(isg.read_text())
            part = masters[1]
            places = (masters[:-1, None] + part * np.linspace(0, 1, 5)[:-1]).ravel()
            off = np.abs(np.interp(places, masters, slaves) - motion(found["segments"], 0.0, places)).max() * arm
            # Within a part, clear of its ends, where the law's own slope is taken by central differences.
            inside = masters[:-1, None] + part * np.array([0.01, 0.99])
            near = 0.005 * part
            exact_slope = (motion(found["segments"], 0.0, (inside + near).ravel()) - motion(found["segments"], 0.0, (inside - near).ravel())) / (2 * near)
            share = np.abs(np.repeat(np.diff(slaves) / part, 2) - exact_slope).max() / np.abs(slope).max()
            assert off < tolerance + ROUNDING and share < VELOCITY * (1 + 2e-2), (index, off, share, groove.toml(found))
        else:
            assert "more than 100000" in done.stderr, (index, done.stderr)
        if index % 3 == 0:
            path = folder / "cam-servo.csv"
            check = lambda path: subprocess.run([asked.binary, "check", str(path), "--json", "--tolerance", f"{1e3 * tolerance!r}um", "--design", str(folder / "design.toml")], capture_output=True, text=True)
            done = check(path)
            assert done.returncode == 0, (index, done.stdout[-2000:], done.stderr)
            lines = path.read_text().splitlines()
            row = random.randrange(len(lines) // 2, len(lines) - 2)
            cells = [float(cell) for cell in lines[row].split(",")]
            cells[1] += 1.3 * tolerance / arm
            faults = [lines[:row] + [",".join(map(repr, cells))] + lines[row + 1:], lines[:-1]]
            for fault in faults:
                planted = folder / "planted-servo.csv"
                planted.write_text("\n".join(fault) + "\n")
                done = check(planted)
                assert done.returncode == 1 and "servo" in failed(done), (index, done.stdout[-1500:], done.stderr)
                refused += 1
    assert made > asked.count // 2, made
    print(f"{made} of {asked.count} motions: positions within {100 * worst[0]:.1f} % of the tolerance, velocities within {worst[1]:.2e} of the largest, at most {most} nodes; {straight} tables of straight lines; {refused} planted faults refused")


if __name__ == "__main__":
    sys.exit(main())
