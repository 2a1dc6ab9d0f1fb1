"""Puts the followers of `camgen make` on the outlines of written DXF files, all round, against motions integrated here.

Shares nothing with camgen but the motion programs below: each law is its acceleration integrated twice by Gauss' rule, a
roller's centre comes from the geometry of its mechanism in complex numbers, a flat face from the support of the outline.

usage: make.py CAMGEN_BINARY DIRECTORY
"""
import json
import subprocess
import sys
from pathlib import Path

import numpy as np
from laws import motion
from outline import Chain, polyline

def toml(name, unit, segments, follower, cam):
    lines = [f'name = "{name}"', "[motion]", "rpm = 200", f'start = "0 {unit}"']
    for law, over, to in segments:
        lines += ["[[motion.segment]]", f'law = "{law}"', f'over = "{over} deg"']
        lines += [] if law == "dwell" else [f'to = "{to} {unit}"']
    lines += [f"[follower.{follower[0]}]"] + [f'{k} = "{v}"' for k, v in follower[1].items()]
    lines += ["[cam]"] + [f'{k} = "{v}"' for k, v in cam.items()]
    return "\n".join(lines + ["[limits]", 'pressure_angle = "40 deg"', ""])


def gaps(kind, values, chain, lift, theta, base, mirror):
    """Gap between follower and outline, mm, at cam angles in radians."""
    u = np.exp(1j * theta)
    flat = chain.flattened(step=2e-4)
    mm = lambda key, default="0 mm": float(values.get(key, default).split()[0])
    if kind in ("flat", "swinging-flat"):
        # The face is a line of two points in the plane of the shaft, as its stem or its pivot has it, turned with û.
        if kind == "flat":
            tilt = np.radians(mm("tilt"))
            along = 1j * np.exp(1j * tilt) * np.ones_like(lift)
            on = base * np.exp(1j * tilt) + lift
        else:
            pivot, away = mm("pivot_distance"), mm("face_offset")
            side = -1 if values.get("side") == "leading" else 1
            psi = np.arcsin((base + away) / pivot) + np.radians(lift)
            # From the pivot the face points back to the shaft, swung out by ψ; the offset is towards the shaft.
            along = -np.exp(1j * side * psi)
            inwards = -1j * side * along
            on = pivot + away * inwards
        normal = along * -1j
        distance = (on * normal.conj()).real
        normal = np.where(distance < 0, -normal, normal) * u
        # The face touches the farthest point; a polyline of chords this fine is short by 5e-9 of the radius.
        support = np.array([(flat @ [n.real, mirror * n.imag]).max() for n in normal])
        return np.abs(distance) - support
    radius = mm("radius")
    prime = base + radius
    if kind in ("roller", "knife"):
        offset = mm("offset")
        centre = (np.sqrt(prime**2 - offset**2) + lift + 1j * offset) * u
    else:
        arm, pivot = mm("arm"), mm("pivot_distance")
        side = -1 if values.get("side") == "leading" else 1
        psi = np.arccos((pivot**2 + arm**2 - prime**2) / (2 * pivot * arm)) + np.radians(lift)
        centre = (pivot - arm * np.exp(1j * side * psi)) * u
    return chain.distance(np.stack([centre.real, mirror * centre.imag], axis=1)) - radius


def main():
    binary, directory = str(Path(sys.argv[1]).resolve()), Path(sys.argv[2]) / "make"
    directory.mkdir(parents=True, exist_ok=True)
    mixed = [("cycloidal", 90, 20), ("dwell", 25, 0), ("3-4-5", 60, 12), ("modified-sine", 95, 0), ("dwell", 90, 0)]
    smooth = [("4-5-6-7", 120, 20), ("dwell", 30, 0), ("3-4-5", 150, 0), ("dwell", 60, 0)]
    rough = [("harmonic", 150, 15), ("cubic", 150, 0), ("dwell", 60, 0)]
    falls = [("cycloidal", 120, -18), ("dwell", 30, 0), ("modified-sine", 210, 0)]
    roller = ("roller", {"radius": "15 mm", "offset": "8 mm"})
    lever = {"radius": "16 mm", "arm": "110 mm", "pivot_distance": "140 mm"}
    face = {"pivot_distance": "150 mm"}
    cases = [
        ("roller", "mm", mixed, roller, {}),
        ("roller, ccw, falling", "mm", falls, roller, {"rotation": "ccw"}),
        ("roller, rough", "mm", rough, ("roller", {"radius": "10 mm"}), {}),
        ("lever trailing", "deg", mixed, ("swinging-roller", lever), {}),
        ("lever leading, ccw", "deg", smooth, ("swinging-roller", {**lever, "side": "leading"}), {"rotation": "ccw"}),
        ("flat", "mm", smooth, ("flat", {}), {}),
        ("flat, ccw", "mm", mixed, ("flat", {}), {"rotation": "ccw"}),
        ("flat, tilted", "mm", smooth, ("flat", {"tilt": "14 deg", "offset": "5 mm"}), {}),
        ("flat, tilted, ccw", "mm", mixed, ("flat", {"tilt": "-20 deg"}), {"rotation": "ccw"}),
        ("swinging flat trailing", "deg", smooth, ("swinging-flat", {**face, "face_offset": "9 mm"}), {}),
        ("swinging flat leading, ccw", "deg", mixed, ("swinging-flat", {**face, "side": "leading"}), {"rotation": "ccw"}),
        ("knife", "mm", smooth, ("knife", {"offset": "-6 mm"}), {}),
        ("knife, ccw", "mm", mixed, ("knife", {}), {"rotation": "ccw"}),
    ]
    theta = np.arange(0, 360, 0.25) + 0.01
    failed = 0
    print(f"{'cam':26} {'tol/um':>7} {'gap/um':>10} {'arcs':>5}")
    for tolerance in (0.005, 0.0002):
        for title, unit, segments, follower, cam in cases:
            path = directory / "program.toml"
            path.write_text(toml(title, unit, segments, follower, cam))
            command = [binary, "make", str(path), "--tolerance", f"{tolerance * 1e3}um", "--format", "dxf", "--json"]
            run = subprocess.run([*command, "--out", str(directory)], capture_output=True, text=True)
            assert run.returncode == 0, f"{title}: {run.stderr}{run.stdout}"
            report = json.loads(run.stdout)
            _, vertices = polyline(report["files"][0])
            position = motion(segments, 0.0, theta)
            # The lowest position is an end of a segment: every law here is monotone.
            lowest = min([0.0] + [to for law, _, to in segments if law != "dwell"])
            mirror = -1 if cam.get("rotation") == "ccw" else 1
            base = report["cam"]["base_radius_mm"]
            gap = gaps(follower[0], follower[1], Chain(vertices), position - lowest, np.radians(theta), base, mirror)
            worst = np.abs(gap).max()
            # Chords of the flattened outline and twelve decimals, on top of the tolerance.
            good = worst <= tolerance + 2e-6
            failed += not good
            print(f"{title:26} {tolerance * 1e3:7} {worst * 1e3:10.6f} {len(vertices):5}{'' if good else '  FAILED'}")
    print(f"{2 * len(cases) - failed} passed, {failed} failed")
    sys.exit(failed > 0)


main()
