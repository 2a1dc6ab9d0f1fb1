"""The lists of `--format inspect` and the lift tables of `--format gauge`, against the profile computed here.

Shares nothing with camgen but the designs below: the roller's centre comes from the laws of laws.py and the geometry of its mechanism (groove.py), the
profile is its parallel by central differences (gcode.py). A ball or a roller on a line through the axis of the cam rests where the largest
of q·u + √(r² − (q×u)²) over the points q of the profile is, a flat face at the largest q·u; between the points of the polygon a parabola
through three of them. Places, normals and balls are read from the CSV file, the plain lines and the DMIS program.

usage: gauge.py CAMGEN_BINARY DIRECTORY [--count N] [--seed S]
"""
import argparse
import re
import subprocess
import sys
from pathlib import Path

import gcode
import groove
import numpy as np
from form_closed import failed, make

ROUNDING = 2e-4


def rests(profile, radius, degrees):
    """Distance from the axis of a follower of a radius, None for a flat face, by cam angle."""
    result = []
    for angle in np.radians(degrees):
        turned = profile * np.exp(-1j * angle)
        with np.errstate(invalid="ignore"):
            value = turned.real if radius is None else turned.real + np.sqrt(radius**2 - turned.imag**2)
        value = np.where(np.isnan(value), -np.inf, value)
        i = int(np.argmax(value))
        a, b, c = value[i - 1], value[i], value[(i + 1) % len(value)]
        bend = a - 2 * b + c
        result.append(b - (a - c) ** 2 / (8 * bend) if np.isfinite(bend) and bend < 0 else b)
    return np.array(result)


def places(folder):
    """Points and normals of the three forms: CSV with six decimals' equals in the others."""
    rows = [line.split(",") for line in (folder / "cam-inspect.csv").read_text().splitlines() if not line.startswith("#")]
    table = np.array([[float(cell) for cell in row] for row in rows[1:]])
    lines = np.array([[float(cell) for cell in line.split()] for line in (folder / "cam-inspect.txt").read_text().splitlines()])
    program = (folder / "cam-inspect.dmi").read_text()
    number = r"(-?[0-9.]+)"
    found = re.findall(rf"F\(P(\d+)\)=FEAT/POINT,CART,{','.join([number] * 6)}\nMEAS/POINT,F\(P\1\),1\nPTMEAS/CART,(.*)\nENDMES", program)
    assert "UNITS/MM" in program and len(found) == len(lines) == len(table) == 360, (len(found), len(lines), len(table))
    assert all(",".join(row[1:7]) == row[7] for row in found)
    points = np.array([[float(cell) for cell in row[:7]] for row in found])
    assert np.array_equal(points, lines)
    assert np.abs(lines[:, [1, 2, 4, 5]] - table[:, 4:8]).max() < 6e-7
    return table


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("binary")
    parser.add_argument("directory", type=Path)
    parser.add_argument("--count", type=int, default=15)
    parser.add_argument("--seed", type=int, default=1)
    asked = parser.parse_args()
    random = __import__("random").Random(asked.seed)
    folder = asked.directory / "gauge"
    folder.mkdir(parents=True, exist_ok=True)
    made, worst, refused = 0, [0.0, 0.0], 0
    for index in range(asked.count):
        found = groove.design(random) | dict(kind="disc", body="groove", clearance=0.0)
        text = "\n".join(line for line in groove.toml(found).splitlines() if not re.match("body|clearance|groove_depth", line)) + "\n"
        radius = random.choice([None, random.uniform(0.5, 5), random.uniform(5, 60)])
        words = ["--gauge", "flat"] if radius is None else ["--gauge", random.choice(["ball", "roller"]), f"{2 * radius!r}mm"]
        done = make(asked.binary, folder, text, "inspect,gauge", *words, "--ball-diameter", "4mm", "--force")
        if done.returncode == 2 or "undercut" in failed(done):
            continue
        assert not failed(done) & {"gauge", "inspection"}, (index, done.stdout)
        made += 1
        sense = -1 if found["ccw"] else 1
        [(_, profile, _)] = gcode.flanks(found)
        rows = [line.split(",") for line in (folder / "cam-gauge.csv").read_text().splitlines() if not line.startswith("#")]
        table = np.array([[float(cell) for cell in row] for row in rows[1:]])
        due = rests(profile, radius, sense * table[:, 0])
        off = np.abs(table[:, 1] - due).max()
        assert off < ROUNDING and np.abs(table[:, 2] - (table[:, 1] - table[:, 1].min())).max() < 1e-9, (index, off, words, text)
        list_ = places(folder)
        tree = gcode.tree(profile)
        away = gcode.away(tree, list_[:, 4:6]).max()
        balls = np.abs(gcode.away(tree, list_[:, 8:10]) - 2.0).max()
        outside = ~gcode.inside(profile, list_[:, 8:10])
        assert away < ROUNDING and balls < 1.0 and outside.all(), (index, away, balls)
        worst = [max(worst[0], off), max(worst[1], away)]
        if index % 3 == 0:
            check = lambda path: subprocess.run([asked.binary, "check", str(path), "--json", "--design", str(folder / "design.toml")], capture_output=True, text=True)
            for name in ["cam-gauge.csv", "cam-inspect.csv", "cam-inspect.txt", "cam-inspect.dmi"]:
                done = check(folder / name)
                assert done.returncode == 0, (index, name, done.stdout[-1500:], done.stderr)
                lines = (folder / name).read_text().splitlines()
                at = len(lines) // 2
                planted = folder / f"planted-{name}"
                moved = re.sub(r"(-?\d+\.\d+)", lambda m: f"{float(m[1]) + 0.02:.6f}", lines[at], count=2)
                for other in (lines[:at] + [moved] + lines[at + 1:], lines[:at] + lines[at + 1:]):
                    planted.write_text("\n".join(other) + "\n")
                    done = check(planted)
                    assert done.returncode in (1, 2), (index, name, lines[at], moved, done.stdout[-1500:])
                    refused += 1
    assert made > asked.count // 2, made
    print(f"{made} of {asked.count} cams: gauge followers within {1e3 * worst[0]:.3f} um, places within {1e3 * worst[1]:.3f} um; {refused} planted faults refused")


if __name__ == "__main__":
    sys.exit(main())
