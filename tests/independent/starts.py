"""Where the outlines of random cams start, and the lead-ins to there, as ezdxf reads them from the DXF file.

Without --start the first vertex lies in the middle of the arc about the shaft that the last dwell leaves. With it the outline is the same, and
starts where the CSV file has the profile at that cam angle. A lead-in ends at the start in the direction of the cut, and none of its points lies
in the metal by more than the tolerance; one that is refused would.

usage: starts.py CAMGEN_BINARY DIRECTORY [--count N] [--seed S] [--jobs N]
"""
import csv
import re
import subprocess

import cases
import ezdxf
import numpy as np
from drawings import design
from outline import Chain, polyline

TOLERANCE = 0.005  # mm
# What the distance of sampled points from an arc is wrong by, mm.
ROUNDING = 1e-6


def way(path):
    """The points of the lead-in from its far end to the start, close to each other, and its direction there."""
    found = [entity for entity in ezdxf.readfile(path).modelspace() if entity.dxf.layer == "LEAD_IN"]
    assert len(found) == 1, f"{len(found)} lead-ins"
    entity = found[0]
    if entity.dxftype() == "LINE":
        start, end = np.array(entity.dxf.start.xyz[:2]), np.array(entity.dxf.end.xyz[:2])
        return start + np.linspace(0, 1, 2001)[:, None] * (end - start), (end - start) / np.hypot(*(end - start))
    centre, radius = np.array(entity.dxf.center.xyz[:2]), entity.dxf.radius
    # Counter-clockwise in the file; it is run clockwise.
    angles = np.radians(np.linspace(entity.dxf.end_angle, entity.dxf.start_angle, 2001))
    if entity.dxf.end_angle < entity.dxf.start_angle:
        angles = np.radians(np.linspace(entity.dxf.end_angle + 360, entity.dxf.start_angle, 2001))
    points = centre + radius * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    return points, np.array([np.sin(angles[-1]), -np.cos(angles[-1])])


def inside(points, polygon):
    """Which points lie inside a polygon."""
    x, y = points[:, :1], points[:, 1:]
    a, b = polygon, np.roll(polygon, -1, axis=0)
    spans = (a[:, 1] > y) != (b[:, 1] > y)
    crossing = a[:, 0] + (y - a[:, 1]) / np.where(a[:, 1] == b[:, 1], 1, b[:, 1] - a[:, 1]) * (b[:, 0] - a[:, 0])
    return (spans & (x < crossing)).sum(axis=1) % 2 == 1


def depth(points, chain):
    """How deep points lie within a chain, mm."""
    flat = chain.flattened(0.002)
    deep = np.concatenate([inside(part, flat) for part in np.array_split(points, 20)])
    return chain.distance(points[deep]).max() if deep.any() else 0.0


def own_way(chain, form, size):
    """The lead-in of a chain by its first vertex."""
    end, heading = chain.start[0], chain.heading_in[0]
    along, outward = np.array([np.cos(heading), np.sin(heading)]), np.array([np.sin(heading), -np.cos(heading)])
    if form == "tangent":
        return end - np.linspace(1, 0, 2001)[:, None] * along * size
    turn = np.linspace(np.pi / 2, 0, 2001)[:, None]
    return end + outward * size - size * (outward * np.cos(turn) + along * np.sin(turn))


def default_faults(chain):
    """The first and the last arc lie about the shaft and are as long as each other."""
    wrong = []
    for index in (0, -1):
        if not np.hypot(*chain.centre[index]) < 1e-6 * chain.radius[index]:
            wrong.append(f"the arc beside the start lies about {chain.centre[index]}")
    if not wrong and not abs(chain.sweep[0] - chain.sweep[-1]) < 1e-8:
        wrong.append(f"the start parts a dwell in {np.degrees(chain.sweep[[-1, 0]])}°")
    return wrong


def main():
    words = cases.given("starts", 40)

    def one(number, rng):
        kind, text = design(rng)
        name = f"cam-{number}"
        machine = words.directory / f"{name}.toml"
        machine.write_text(text)
        lowest = float(re.search(r'base_radius = "([\d.]+)', text).group(1))

        def made(name, *more):
            command = [words.binary, "make", str(machine), "--format", "dxf,csv", "--samples", "3600", "--out", str(words.directory)]
            command += ["--name", name, "--force", "--quiet", *more]
            return subprocess.run(command, capture_output=True, text=True), " ".join(command)

        run, command = made(name)
        path = words.directory / f"{name}.dxf"
        if not path.exists():
            return f"{kind} without files", [] if run.returncode == 2 else [run.stderr], command
        _, vertices = polyline(path)
        chain = Chain(vertices)
        wrong = default_faults(chain)
        angle = rng.uniform(0, 359.9)
        form, size = rng.choice(["tangent", "arc"]), lowest * 10 ** rng.uniform(-1.5, 0)
        run, command = made(f"{name}-at", "--start", f"{angle:.4f}deg")
        _, started = polyline(words.directory / f"{name}-at.dxf")
        again = Chain(started)
        if abs(again.area() - chain.area()) > 1e-8 * chain.area() or again.distance(chain.start).max() > 1e-8:
            wrong.append("another start is another outline")
        with open(words.directory / f"{name}-at.csv", newline="") as file:
            rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
        column = lambda key: np.array([float(row[key]) for row in rows])
        places = np.stack([column("profile_x_mm"), column("profile_y_mm")], axis=1)
        places = np.append(places, places[:1], axis=0)
        at = angle * len(rows) / 360
        low, high = places[int(at)], places[int(at) + 1]
        there, apart = low + (at - int(at)) * (high - low), np.hypot(*(high - low))
        if np.hypot(*(started[0, :2] - there)) > 0.1 * apart + 2 * TOLERANCE:
            wrong.append(f"θ = {angle:.3f}° is at {there}, the start at {started[0, :2]}")
        run, command = made(f"{name}-in", "--start", f"{angle:.4f}deg", "--lead-in", form, f"{size:.6f}mm")
        deepest = depth(own_way(again, form, size), again)
        if run.returncode == 2:
            if "would cut" not in run.stderr or not deepest > TOLERANCE - ROUNDING:
                wrong.append(f"refused, but it is {deepest:.6f} mm deep: {run.stderr}")
            return f"{kind} {form} refused", wrong, command
        points, direction = way(words.directory / f"{name}-in.dxf")
        _, vertices = polyline(words.directory / f"{name}-in.dxf")
        led = Chain(vertices)
        if np.hypot(*(points[-1] - led.start[0])) > 1e-8:
            wrong.append(f"the lead-in ends at {points[-1]}, the cut starts at {led.start[0]}")
        along = np.array([np.cos(led.heading_in[0]), np.sin(led.heading_in[0])])
        if not np.hypot(*(direction - along)) < 1e-7:
            wrong.append(f"the lead-in arrives along {direction}, the cut goes along {along}")
        length = np.hypot(*np.diff(points, axis=0).T).sum()
        if abs(length - size * (1 if form == "tangent" else np.pi / 2)) > 1e-4 * length:
            wrong.append(f"the lead-in is {length} mm long")
        if (deep := depth(points, led)) > TOLERANCE + ROUNDING:
            wrong.append(f"the lead-in is {deep} mm deep in the cam")
        checked = subprocess.run([words.binary, "check", str(words.directory / f"{name}-in.dxf"), "--design", str(machine), "-v"], capture_output=True, text=True)
        if "lead_in" not in checked.stdout or re.search(r"FAIL +lead_in|WARN +lead_in", checked.stdout):
            wrong.append(f"check: {checked.stdout[:400]}")
        return f"{kind} {form}", wrong, command

    states, failed = cases.judged(words, one)
    cases.finish(states, failed)


if __name__ == "__main__":
    main()
