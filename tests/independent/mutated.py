"""Changes right DXF and STEP files at random, and holds what `camgen check` still accepts against ezdxf and OpenCASCADE.

A few bytes, digits, signs, numbers, names, lines or entities of a file that camgen wrote are changed, doubled, moved or taken away.
Where camgen says that the file is this cam, the other reader must find the same: every entity of the model space where it was
to 0.1 mm, nothing more and nothing less, in millimetres; one solid of the same volume and box. (Between the tolerance and 0.1 mm
adversary.py and step_check.py decide.)

usage: mutated.py CAMGEN_BINARY DIRECTORY [--count N] [--seed S] [--jobs N]
"""
import logging
import os
import pickle
import random
import re
import subprocess
import sys
from collections import Counter
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import cases
import numpy as np

CAMS = {
    "disc": ["rotary", "dpi"],
    "keyway": ["rotary", "dpi", "--set", "cam.keyway.width=8mm", "--set", "cam.keyway.depth=3.3mm", "--set", "cam.keyway.angle=90deg"],
    "plate": ["translating", "dpi"],
}
FAR = 0.1  # mm
NUMBER = re.compile(rb"-?\d+\.\d*(?:[eE][-+]?\d+)?|-?\d+")


def drawn(path):
    """The unit, and the entities of the model space with their defining points, mm."""
    import ezdxf

    document = ezdxf.readfile(path)
    found = []
    for entity in document.modelspace():
        kind = entity.dxftype()
        if kind == "POLYLINE":
            points = [(*vertex.dxf.location.xyz, vertex.dxf.get("bulge", 0.0)) for vertex in entity.vertices]
        elif kind == "LWPOLYLINE":
            points = [(x, y, entity.dxf.elevation, bulge) for x, y, bulge in entity.get_points("xyb")]
        elif kind in ("CIRCLE", "ARC"):
            points = [(*entity.dxf.center.xyz, entity.dxf.radius)]
            points += [(entity.dxf.start_angle, entity.dxf.end_angle, 0.0, 0.0)] if kind == "ARC" else []
        elif kind == "LINE":
            points = [(*entity.dxf.start.xyz, 0.0), (*entity.dxf.end.xyz, 0.0)]
        elif kind == "POINT":
            points = [(*entity.dxf.location.xyz, 0.0)]
        else:
            continue
        turned = tuple(entity.dxf.get("extrusion", (0.0, 0.0, 1.0)))
        closed = getattr(entity, "is_closed", None) if kind == "POLYLINE" else getattr(entity, "closed", None)
        found.append((kind, entity.dxf.layer.upper(), closed, np.array(points), turned))
    return document.header.get("$INSUNITS", 0), found


class NotRead(Exception):
    """The other reader does not read a file."""


def same_drawing(path, own):
    """What ezdxf finds otherwise than in the file that camgen wrote."""
    try:
        unit, found = drawn(path)
    except Exception as error:  # whatever a broken file does to it
        raise NotRead(f"{type(error).__name__} {str(error)[:80]}") from error
    if not found:
        raise NotRead("no entity is left in the model space")
    # Without a unit the numbers are millimetres for both; camgen says so. A unit that is no whole number is none.
    if str(unit) not in ("0", str(own[0])) and str(unit).isdigit():
        return f"$INSUNITS {unit}"
    if len(found) != len(own[1]):
        return f"{len(found)} entities instead of {len(own[1])}"
    for (kind, layer, closed, points, turned), (own_kind, own_layer, own_closed, own_points, own_turned) in zip(found, own[1]):
        if (kind, closed) != (own_kind, own_closed):
            return f"{kind} closed {closed} instead of {own_kind} closed {own_closed}"
        if points.shape != own_points.shape:
            return f"{kind} of {len(points)} points instead of {len(own_points)}"
        # A bulge of a chord of some mm moves its arc by half of its change times the chord.
        if not np.abs(points - own_points).max() < FAR or max(abs(a - b) for a, b in zip(turned, own_turned)) > 1e-3:
            return f"{kind} on {layer} is off by {np.abs(points - own_points).max()}"
    return None


def solid(path):
    """Volume and box of the shape of a file, and the number of its solids."""
    from OCP.Bnd import Bnd_Box
    from OCP.BRepBndLib import BRepBndLib
    from OCP.BRepGProp import BRepGProp
    from OCP.GProp import GProp_GProps
    from OCP.Message import Message, Message_Gravity
    from OCP.STEPControl import STEPControl_Reader
    from OCP.TopAbs import TopAbs_SOLID
    from OCP.TopExp import TopExp_Explorer

    for printer in Message.DefaultMessenger_s().Printers():
        printer.SetTraceLevel(Message_Gravity.Message_Fail)
    reader = STEPControl_Reader()
    if int(reader.ReadFile(str(path))) != 1:
        return None
    reader.TransferRoots()
    shape = reader.OneShape()
    if shape.IsNull():
        return None
    explorer, count = TopExp_Explorer(shape, TopAbs_SOLID), 0
    while explorer.More():
        count += 1
        explorer.Next()
    box, measures = Bnd_Box(), GProp_GProps()
    BRepBndLib.AddOptimal_s(shape, box, False, False)
    BRepGProp.VolumeProperties_s(shape, measures)
    return count, measures.Mass(), np.array(box.Get())


def solid_apart(path):
    """As `solid`, in a process of its own: OpenCASCADE 7.8 ends some files with a segmentation fault."""
    reading, writing = os.pipe()
    child = os.fork()
    if child == 0:
        os.close(reading)
        try:
            os.write(writing, pickle.dumps(solid(path)))
        finally:
            os._exit(0)
    os.close(writing)
    with os.fdopen(reading, "rb") as answer:
        data = answer.read()
    os.waitpid(child, 0)
    return pickle.loads(data) if data else None


def same_solid(path, own):
    found = solid_apart(path)
    if found is None:
        raise NotRead("OpenCASCADE")
    count, volume, box = found
    if count != own[0]:
        return f"{count} solids"
    if not abs(volume / own[1] - 1) < 1e-3:
        return f"the volume is {volume} instead of {own[1]} mm³"
    return None if np.abs(box - own[2]).max() < FAR else f"the box is {np.round(box, 2)} instead of {np.round(own[2], 2)}"


def changed(data, rng):
    """The file with one to three changes."""
    for _ in range(rng.choice([1, 1, 1, 2, 3])):
        lines = data.split(b"\n")
        kind = rng.choice(["byte", "digit", "number", "number", "line", "double", "swap", "move", "block", "copy", "take"])
        at = rng.randrange(len(lines))
        if kind == "byte":
            place = rng.randrange(len(data))
            data = data[:place] + bytes([rng.choice([rng.randrange(256), rng.randrange(32, 127)])]) + data[place + 1:]
            continue
        if kind in ("digit", "number"):
            numbers = list(NUMBER.finditer(data)) if len(data) < 20_000 else []
            if not numbers:
                start = rng.randrange(len(data))
                numbers = list(NUMBER.finditer(data, start, start + 400))
            if not numbers:
                continue
            found = rng.choice(numbers)
            old = found.group()
            if kind == "digit":
                place = found.start() + rng.randrange(len(old))
                data = data[:place] + rng.choice([b"0", b"1", b"5", b"9", b"-", b".", b"", b"e"]) + data[place + 1:]
            else:
                value = float(old)
                new = rng.choice([-value, 0.0, value + rng.choice([-1, 1]) * 10 ** rng.uniform(-1, 3), value * rng.choice([2, 0.5, 25.4, 1e100, 10])])
                text = f"{new:.6f}" if b"." in old and abs(new) < 1e15 else f"{new:.0f}" if b"." not in old and abs(new) < 1e15 else f"{new:e}"
                data = data[:found.start()] + text.encode() + data[found.end():]
            continue
        if kind == "line":
            lines[at] = rng.choice(lines)
        elif kind == "double":
            lines.insert(at, lines[at])
        elif kind == "swap":
            other = min(max(at + rng.randint(-6, 6), 0), len(lines) - 1)
            lines[at], lines[other] = lines[other], lines[at]
        elif kind == "move":
            line = lines.pop(at)
            lines.insert(rng.randrange(len(lines)), line)
        else:
            # Whole groups: an even number of lines from an even place on.
            start, size = at // 2 * 2, 2 * rng.choice([1, 1, 2, 4, 8, 20])
            part = lines[start:start + size]
            if kind == "take":
                del lines[start:start + size]
            elif kind == "copy":
                to = rng.randrange(len(lines)) // 2 * 2
                lines[to:to] = part
            else:
                to = min(start + 2 * rng.randint(1, 10), len(lines)) // 2 * 2
                del lines[start:start + size]
                lines[to:to] = part
        data = b"\n".join(lines)
    return data


def judged(job):
    """State and what is wrong with some changed files of a kind."""
    binary, directory, ending, name, command, seed, numbers = job
    path, right = directory / f"changed-{name}-{seed}-{numbers[0]}.{ending}", directory / f"{name}.{ending}"
    data = right.read_bytes()
    own = drawn(right) if ending == "dxf" else solid(right)
    states, wrong = Counter(), []
    logging.disable(logging.CRITICAL)
    for number in numbers:
        rng = random.Random(f"{seed} {ending} {name} {number}")
        mutant = changed(data, rng)
        if mutant == data:
            states["the same"] += 1
            continue
        path.write_bytes(mutant)
        run = subprocess.run([binary, "check", str(path), command[1], "--cam", command[0], "--rpm", "35", *command[2:], "--quiet"], capture_output=True, text=True)
        states[f"{ending} exit {run.returncode}"] += 1
        why = None
        if run.returncode not in (0, 1, 2) or "panicked" in run.stderr:
            why = f"exit code {run.returncode}: {run.stderr[-200:]}"
        elif run.returncode == 0:
            try:
                why = same_drawing(path, own) if ending == "dxf" else same_solid(path, own)
            except NotRead:
                states[f"{ending} of these not read by the other"] += 1
        if why:
            kept = directory / f"wrong-{name}-{number}.{ending}"
            kept.write_bytes(mutant)
            wrong.append(f"{kept.name}: {why}")
    path.unlink(missing_ok=True)
    return states, wrong


def main():
    words = cases.given("mutated", 200)
    jobs = []
    for name, command in CAMS.items():
        make = [words.binary, *command, "--rpm", "35", "--format", "dxf,step", "--out", str(words.directory), "--name", name, "--quiet"]
        assert subprocess.run(make, capture_output=True).returncode == 0, make
        numbers = list(range(words.count // len(CAMS)))
        for ending in ("dxf", "step"):
            parts = [numbers[i:i + 100] for i in range(0, len(numbers), 100)]
            jobs += [(words.binary, words.directory, ending, name, command, words.seed, part) for part in parts]
    states, wrong = Counter(), []
    with ProcessPoolExecutor(words.jobs) as pool:
        for found, faults in pool.map(judged, jobs):
            states += found
            wrong += faults
            for fault in faults:
                print(f"  {fault}", flush=True)
    cases.finish(states, len(wrong))


if __name__ == "__main__":
    main()
