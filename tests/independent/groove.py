"""Puts the roller of grooves and rings between the flanks of written DXF files, all round, against motions integrated here, and measures the
solid with OpenCASCADE.

Shares nothing with camgen but the motion programs below: the laws are those of laws.py, integrated twice by Gauss' rule, the roller's centre
comes from the geometry of its mechanism in complex numbers, the flanks are what ezdxf reads on their layers. Each flank must be as far from
the roller's centre as its radius and its share of the clearance say, wherever the roller is; the groove is nowhere narrower than the roller
with its clearance. Faults are planted in the files, and `camgen check` must refuse each by the right check.

usage: groove.py CAMGEN_BINARY DIRECTORY [--count N] [--seed S]
"""
import argparse
import sys
from pathlib import Path

import ezdxf
import numpy as np
from form_closed import FAULTS, LAWS, ROUNDING, TOLERANCE, failed, make, plant, program, volumes
from laws import motion
from outline import Chain


def design(random):
    """A random groove or ring, as a dictionary."""
    swings = random.random() < 0.4
    body = "ring" if random.random() < 0.3 else "groove"
    rise, rest, back = random.uniform(90, 140), random.uniform(0, 40), random.uniform(90, 140)
    stroke = random.uniform(8, 20) if swings else random.uniform(8, 30)
    first, second = random.choice(LAWS), random.choice(LAWS)
    segments = [(first, rise, stroke), ("dwell", rest, stroke), (second, back, 0.0)]
    segments.append(("dwell", 360 - rise - rest - back, 0.0))
    segments = [segment for segment in segments if segment[1] > 0]
    radius = random.uniform(6, 16)
    prime = random.uniform(75, 110) if not swings else random.uniform(85, 110)
    clearance = random.uniform(0.02, 0.2)
    share = random.choice([0.0, 0.5, 1.0, random.random()])
    place = {"offset": random.uniform(-15, 15)} if not swings else {
        "arm": random.uniform(95, 115), "pivot_distance": random.uniform(130, 150), "side": random.choice(["trailing", "leading"])}
    return dict(body=body, swings=swings, segments=segments, radius=radius, prime=prime, clearance=clearance, share=share, place=place,
                ccw=random.random() < 0.3)


def toml(found):
    unit = "deg" if found["swings"] else "mm"
    lines = program(found["segments"], unit)
    lines += ["[follower.swinging-roller]" if found["swings"] else "[follower.roller]", f'radius = "{found["radius"]!r} mm"']
    for key, value in found["place"].items():
        lines.append(f'{key} = "{value}"' if key == "side" else f'{key} = "{value!r} mm"')
    lines += ['inertia = "0.01 kg*m2"' if found["swings"] else 'mass = "2 kg"']
    groove = found["body"] == "groove"
    base = found["prime"] + (-found["radius"] if groove else found["radius"])
    lines += ["[cam]", f'body = "{found["body"]}"', f'base_radius = "{base!r} mm"', 'thickness = "20 mm"']
    if groove:
        lines += [f'clearance = "{found["clearance"]!r} mm"', f'clearance_share = {found["share"]!r}', 'groove_depth = "12 mm"',
                  'bore_radius = "10 mm"']
    lines += [] if not found["ccw"] else ['rotation = "ccw"']
    lines += ["[limits]", 'pressure_angle = "60 deg"', "min_convex_pitch_radius_over_roller = 1.0"]
    return "\n".join(lines) + "\n"


def centres(found, theta):
    """The roller's centre in the drawing at cam angles (rad), complex, mm."""
    degrees = np.degrees(theta)
    position = motion(found["segments"], 0.0, degrees)
    u = np.exp(1j * theta)
    place = found["place"]
    if found["swings"]:
        arm, pivot = place["arm"], place["pivot_distance"]
        # The triangle of shaft, pivot and roller at the lowest lift.
        start = np.arccos((pivot**2 + arm**2 - found["prime"] ** 2) / (2 * pivot * arm))
        side = 1 if place["side"] == "trailing" else -1
        centre = u * (pivot - arm * np.exp(1j * side * (start + np.radians(position))))
    else:
        height = np.sqrt(found["prime"] ** 2 - place["offset"] ** 2)
        centre = u * (height + position + 1j * place["offset"])
    return centre.conj() if found["ccw"] else centre


def flank(document, layer):
    """The one closed outline on a layer."""
    (line,) = [entity for entity in document.modelspace() if entity.dxf.layer == layer]
    assert line.dxftype() == "LWPOLYLINE" and line.closed, line
    return Chain(np.array(line.get_points("xyb"), dtype=float))


def distances(document, layer, points):
    """Distance of points from the outline of a layer, mm."""
    return flank(document, layer).distance(np.stack([points.real, points.imag], axis=1))


def radius_of_circle(document, layer):
    (circle,) = [entity for entity in document.modelspace() if entity.dxf.layer == layer]
    return circle.dxf.radius


def proved(found, folder, theta):
    """Largest errors of the flanks, mm."""
    document = ezdxf.readfile(folder / "cam.dxf")
    points = centres(found, theta)
    inside = found["clearance"] * found["share"]
    if found["body"] == "ring":
        off = distances(document, "CAM_PROFILE", points) - found["radius"]
        assert radius_of_circle(document, "BLANK") > np.abs(points).max() + found["radius"]
        return float(np.abs(off).max())
    inner = distances(document, "GROOVE_INNER", points) - (found["radius"] + inside)
    outer = distances(document, "GROOVE_OUTER", points) - (found["radius"] + found["clearance"] - inside)
    width = (inner + outer).min() + 2 * found["radius"] + found["clearance"]
    assert width >= 2 * found["radius"] + found["clearance"] - 2 * TOLERANCE - ROUNDING, width
    assert abs(radius_of_circle(document, "BORE") - 10) < 1e-9
    return float(max(np.abs(inner).max(), np.abs(outer).max()))


def volume(found, folder):
    """The solid as OpenCASCADE reads it: closed, valid, with the volume of the drawing."""
    (found_volume,) = volumes(folder / "cam.step")
    document = ezdxf.readfile(folder / "cam.dxf")
    blank = np.pi * radius_of_circle(document, "BLANK") ** 2
    if found["body"] == "ring":
        expected = 20 * (blank - abs(flank(document, "CAM_PROFILE").area()))
    else:
        groove = abs(flank(document, "GROOVE_OUTER").area()) - abs(flank(document, "GROOVE_INNER").area())
        expected = 20 * (blank - np.pi * 10**2) - 12 * groove
    assert abs(found_volume / expected - 1) < 1e-6, (found_volume, expected)


def faults(binary, found, folder):
    """Files with a planted fault, each refused by its check."""
    for layer in ["GROOVE_INNER", "GROOVE_OUTER"] if found["body"] == "groove" else ["CAM_PROFILE"]:
        for name, change in FAULTS:
            refused = plant(binary, folder, "cam.dxf", layer, change, "--design", str(folder / "design.toml"))
            assert refused & {"rolling", "outline"}, (layer, name, refused)
    if found["body"] == "groove":
        narrower = 1 - found["clearance"] / (found["prime"] + found["radius"])
        refused = plant(binary, folder, "cam.dxf", "GROOVE_OUTER", lambda z: z * narrower, "--design", str(folder / "design.toml"))
        assert "groove_width" in refused, ("the outer flank without its clearance", refused)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("binary")
    parser.add_argument("directory", type=Path)
    parser.add_argument("--count", type=int, default=30)
    parser.add_argument("--seed", type=int, default=1)
    asked = parser.parse_args()
    random = __import__("random").Random(asked.seed)
    folder = asked.directory / "groove"
    folder.mkdir(parents=True, exist_ok=True)
    theta = np.linspace(0, 2 * np.pi, 2880, endpoint=False)
    worst, made, refused = 0.0, 0, 0
    for index in range(asked.count):
        found = design(random)
        done = make(asked.binary, folder, toml(found))
        if done.returncode != 0:
            # A random cam may be too small for its motion, or lack the force of a ring; never may a flank be wrong.
            broken = failed(done)
            assert broken and not broken & {"rolling", "outline", "groove_width", "bore", "tangency"}, (index, broken, done.stderr, toml(found))
            refused += 1
            if broken - {"force_closure"}:
                continue
            done = make(asked.binary, folder, toml(found), "dxf,step", "--force")
            assert done.returncode == 1, done.stderr
        made += 1
        error = proved(found, folder, theta)
        assert error <= TOLERANCE + ROUNDING, (index, error, toml(found))
        worst = max(worst, error)
        volume(found, folder)
        if index % 5 == 0:
            faults(asked.binary, found, folder)
    assert made > asked.count // 2, (made, refused)
    print(f"{made} of {asked.count} grooves and rings: flanks within {1e3 * worst:.4f} um of the roller, solids valid, planted faults refused")


if __name__ == "__main__":
    sys.exit(main())
