"""Sheets of random cams as a shop gets them: nothing lies over anything else, and the table of the profile is the outline that is cut.

Of each design: everything on the drawing and the review sheet, leaders and arrows too, lies inside the frame, every text has letters of at least 2.5 mm, and lies over no other text
and on no straight line, circle or curve; each row of the drawing's table lies on the outline of the DXF file as ezdxf reads it, to the rounding of
the table; the cam angle and the lift of a row are those of the CSV file at the same place of the profile; PDFium finds the table in the PDF.

usage: drawings.py CAMGEN_BINARY DIRECTORY [--count N] [--seed S] [--jobs N]
"""
import csv
import re
import subprocess
import threading
from xml.etree import ElementTree

import cases
import numpy as np
import pypdfium2
from outline import polyline

SVG = "{http://www.w3.org/2000/svg}"
# Half a digit of the table, and what is left of sampling the outline, mm.
ROUNDING = 0.0005 + 0.0002
# Texts nearer than this touch for the eye, mm.
APART = 0.05
ASCENT, DESCENT, CAPITAL = 0.75, 0.22, 0.688
# PDFium is not for several threads at once.
ONE_READER = threading.Lock()
FOLLOWERS = ["roller", "offset-roller", "knife", "flat", "swinging-roller", "swinging-flat"]


def design(rng):
    """A machine file, whose follower is one of the kinds and whose size lies between 5 mm and 1.5 m."""
    kind, size = rng.choice(FOLLOWERS), 10 ** rng.uniform(0.5, 2.8)
    swings = kind.startswith("swinging")
    lift = rng.uniform(4, 18) if swings else size * rng.uniform(0.1, 0.5)
    unit, law = ("deg" if swings else "mm"), rng.choice(["3-4-5", "cycloidal", "modified-sine", "4-5-6-7"])
    up, top, down = rng.randint(70, 130), rng.randint(0, 60), rng.randint(70, 130)
    text = f'name = "Cam {rng.randint(1, 999)}"\n[motion]\nrpm = {rng.randint(20, 300)}\nstart = "0 {unit}"\n'
    for what, over, to in ((law, up, lift), ("dwell", top, None), (law, down, 0)):
        if over:
            text += f'[[motion.segment]]\nlaw = "{what}"\nover = "{over} deg"\n' + (f'to = "{to:.4f} {unit}"\n' if to is not None else "")
    text += '[[motion.segment]]\nlaw = "dwell"\n'
    roller = f'radius = "{size * rng.uniform(0.15, 0.35):.4f} mm"\n'
    if kind in ("roller", "offset-roller"):
        text += "[follower.roller]\n" + roller + (f'offset = "{size * rng.uniform(-0.2, 0.2):.4f} mm"\n' if kind == "offset-roller" else "")
    elif kind == "knife":
        text += "[follower.knife]\n"
    elif kind == "flat":
        text += "[follower.flat]\n"
    elif kind == "swinging-roller":
        arm = size * rng.uniform(1.6, 2.5)
        text += f'[follower.swinging-roller]\narm = "{arm:.4f} mm"\npivot_distance = "{arm * rng.uniform(1.2, 1.4):.4f} mm"\n'
        text += f'side = "{rng.choice(["leading", "trailing"])}"\n' + roller
    else:
        text += f'[follower.swinging-flat]\npivot_distance = "{size * rng.uniform(2.5, 3.5):.4f} mm"\n'
    text += f'[cam]\nbase_radius = "{size * rng.uniform(0.9, 1.4):.4f} mm"\nrotation = "{rng.choice(["cw", "ccw"])}"\n'
    if rng.random() < 0.8:
        text += f'thickness = "{size * rng.uniform(0.1, 0.4):.3f} mm"\n'
    bore = size * rng.uniform(0.2, 0.5)
    if rng.random() < 0.8:
        text += f'bore_diameter = "{2 * bore:.3f} mm"\n'
        text += 'bore_fit = "H7"\n' if 2 * bore < 500 and rng.random() < 0.5 else ""
        if 6.5 < 2 * bore < 440 and rng.random() < 0.6:
            text += f'[cam.keyway]\nwidth = "auto"\ndepth = "auto"\nangle = "{rng.choice([0, 90, 180, 270, rng.randint(-180, 180)])} deg"\nfit = "JS9"\n'
    text += '[limits]\npressure_angle = "80 deg"\nsize = "10 m"\nwall = "0 mm"\nmin_convex_pitch_radius_over_roller = 0\n'
    text += f'[title]\nprofile_tolerance = "{rng.choice([0.02, 0.03, 0.1])} mm"\nhardness = "58+4 HRC"\nsurface_roughness = "Ra 0.8"\n' if rng.random() < 0.5 else ""
    return kind, text


def texts(root):
    """Every text with its field: left, right, bottom, top; y upwards."""
    found = []
    for text in root.iter(f"{SVG}text"):
        words = "".join(text.itertext()).strip()
        width, size = float(text.get("textLength", 0)), float(text.get("font-size"))
        x, y = float(text.get("x")), -float(text.get("y"))
        left = {"middle": x - width / 2, "end": x - width}.get(text.get("text-anchor"), x)
        found.append((words, np.array([left, left + width, y - DESCENT * size, y + ASCENT * size])))
    return found


def chains(root):
    """Straight lines, polylines, circles and the outlines of paths as chains of points, with the class of their group."""
    for group in root.iter(f"{SVG}g"):
        of = group.get("class", "")
        for line in group.findall(f"{SVG}line"):
            yield of, np.array([[float(line.get("x1")), -float(line.get("y1"))], [float(line.get("x2")), -float(line.get("y2"))]])
        for poly in [*group.findall(f"{SVG}polyline"), *group.findall(f"{SVG}polygon")]:
            points = np.array([[float(n) for n in pair.split(",")] for pair in re.sub(r"\s*,\s*", ",", poly.get("points").strip()).split()])
            points[:, 1] *= -1
            yield of, points if poly.tag.endswith("polyline") else np.vstack([points, points[:1]])
        for circle in group.findall(f"{SVG}circle"):
            angles = np.linspace(0, 2 * np.pi, 721)
            centre, radius = (float(circle.get("cx")), -float(circle.get("cy"))), float(circle.get("r"))
            yield of, np.stack([centre[0] + radius * np.cos(angles), centre[1] + radius * np.sin(angles)], axis=1)


def struck(field, chain):
    """Whether a chain of points meets a field, by Liang and Barsky for all pieces at once."""
    left, right, low, high = field + APART * np.array([1, -1, 1, -1])
    start, way = chain[:-1], np.diff(chain, axis=0)
    enter, leave = np.zeros(len(start)), np.ones(len(start))
    for axis, (a, b) in enumerate(((left, right), (low, high))):
        still = np.abs(way[:, axis]) < 1e-12
        outside = still & ((start[:, axis] < a) | (start[:, axis] > b))
        step = np.where(still, 1.0, way[:, axis])
        one, two = (a - start[:, axis]) / step, (b - start[:, axis]) / step
        enter = np.maximum(enter, np.where(still, np.where(outside, 2.0, 0.0), np.minimum(one, two)))
        leave = np.minimum(leave, np.where(still, 1.0, np.maximum(one, two)))
    return bool((enter <= leave).any())


def overlaps(path):
    root = ElementTree.parse(path).getroot()
    left, top, width, height = (float(n) for n in root.get("viewBox").split())
    fields, wrong = texts(root), []
    boxes = np.array([field for _, field in fields])
    for text in root.iter(f"{SVG}text"):
        if float(text.get("font-size")) * CAPITAL < 2.5 - 1e-3:
            wrong.append(f"`{''.join(text.itertext()).strip()}` has letters of {float(text.get('font-size')) * CAPITAL:.2f} mm")
    for index, (words, field) in enumerate(fields):
        if field[0] < left or field[1] > left + width or field[3] > -top or field[2] < -top - height:
            wrong.append(f"`{words}` leaves the sheet")
        rest = boxes[index + 1:]
        over = (rest[:, 0] < field[1] - APART) & (rest[:, 1] > field[0] + APART) & (rest[:, 2] < field[3] - APART) & (rest[:, 3] > field[2] + APART)
        wrong += [f"`{words}` over `{fields[index + 1 + other][0]}`" for other in np.flatnonzero(over)]
    everything = list(chains(root))
    # Not the centring marks, which are short.
    sides = [chain for of, chain in everything if of == "frame" and np.abs(np.diff(chain, axis=0)).max() > 0.5 * height]
    frame = np.concatenate(sides)
    least, largest = frame.min(axis=0) - APART, frame.max(axis=0) + APART
    for of, chain in everything:
        if of not in ("frame", "grid-reference") and ((chain < least).any() or (chain > largest).any()):
            wrong.append(f"{of} crosses the frame at {np.round(chain[np.abs(chain - (least + largest) / 2).max(axis=1).argmax()], 1)}")
    for of, chain in everything:
        # Texts stand on tinted rows.
        if len(chain) < 2 or of == "area":
            continue
        low, high = chain.min(axis=0), chain.max(axis=0)
        near = np.flatnonzero((boxes[:, 0] < high[0]) & (boxes[:, 1] > low[0]) & (boxes[:, 2] < high[1]) & (boxes[:, 3] > low[1]))
        wrong += [f"`{fields[index][0]}` is struck by {of}" for index in near if struck(boxes[index], chain)]
    return sorted(set(wrong))


CELL = re.compile(r"-?\d+\.\d{3}|\d+\.\d{1,2}|\d+|–")


def table(path):
    """Rows of ψ, R, θ and lift of the table of the profile on a drawing."""
    all_texts = ["".join(text.itertext()).strip() for group in ElementTree.parse(path).getroot().iter(f"{SVG}g")
                 if group.get("class") == "facts" for text in group.findall(f"{SVG}text")]
    if "Profile R at polar angle ψ (TED)" not in all_texts:
        return None
    behind = all_texts[all_texts.index("Profile R at polar angle ψ (TED)"):]
    behind = behind[:behind.index("Files of this part")]
    cells = [cell for cell in behind if CELL.fullmatch(cell)]
    return np.array([[float("nan") if cell == "–" else float(cell) for cell in cells[at:at + 4]] for at in range(0, len(cells), 4)])


def in_pdf(path):
    """Whether the first page of a PDF has the table."""
    with ONE_READER:
        document = pypdfium2.PdfDocument(path)
        text = document[0].get_textpage().get_text_range()
        document.close()
    return "ProfileRatpolarangle" in re.sub(r"\s", "", text)


def sampled(vertices):
    """Points of a chain of arcs and lines, so near that chords are as good as arcs: 0.01 µm for a radius of 600 mm."""
    start, end, bulge = vertices[:, :2], np.roll(vertices[:, :2], -1, axis=0), vertices[:, 2]
    points = []
    for a, b, bend in zip(start, end, bulge):
        share = np.linspace(0, 1, 40 + int(abs(4 * np.arctan(bend)) / 0.0004), endpoint=False)
        if bend == 0:
            points.append(a + share[:, None] * (b - a))
            continue
        sweep = 4 * np.arctan(bend)
        chord = b - a
        centre = (a + b) / 2 + np.array([-chord[1], chord[0]]) * (1 - bend * bend) / (4 * bend)
        angle = np.arctan2(*(a - centre)[::-1]) + share * sweep
        points.append(centre + np.hypot(*(a - centre)) * np.stack([np.cos(angle), np.sin(angle)], axis=1))
    return np.concatenate(points)


def outermost(points, psi):
    """Where the ray at an angle leaves a closed chain of points last."""
    direction = np.array([np.cos(psi), np.sin(psi)])
    along, across = points @ direction, points @ np.array([-direction[1], direction[0]])
    ahead, beyond = np.roll(along, -1), np.roll(across, -1)
    crossing = ((across >= 0) != (beyond >= 0)) & (along + ahead > 0)
    if not crossing.any():
        return float("nan")
    share = across[crossing] / (across[crossing] - beyond[crossing])
    return (along[crossing] + share * (ahead[crossing] - along[crossing])).max()


def table_faults(directory, name):
    rows = table(directory / f"{name}.svg")
    if rows is None or not in_pdf(directory / f"{name}.pdf"):
        return ["no table on the sheet"]
    regular = {psi for psi, *_ in rows if psi % 5 == 0}
    if not any(set(range(0, 360, step)) <= regular for step in (5, 10, 15, 30)) or (np.diff(rows[:, 0]) <= 0).any():
        return [f"{len(rows)} rows in the table"]
    _, vertices = polyline(directory / f"{name}.dxf")
    points, wrong = sampled(vertices), []
    with open(directory / f"{name}.csv", newline="") as file:
        curve = list(csv.DictReader(line for line in file if not line.startswith("#")))
    column = lambda key: np.array([float(row[key]) for row in curve])
    theta = np.append(column("cam_deg"), 360.0)
    closed = lambda values: np.append(values, values[0])
    profile = np.stack([closed(column("profile_x_mm")), closed(column("profile_y_mm"))], axis=1)
    lift = closed(column("lift_deg" if "lift_deg" in curve[0] else "lift_mm"))
    tolerance = 0.02 + 0.002 * np.abs(profile).max()
    for psi, radius, angle, raised in rows:
        # The polar angle of a change of segment is rounded to 0.01°.
        around = [outermost(points, np.radians(psi + by)) for by in ((0,) if psi % 5 == 0 else (-0.005, 0, 0.005))]
        there = around[len(around) // 2]
        if not min(around) - ROUNDING < radius < max(around) + ROUNDING:
            wrong.append(f"ψ = {psi}: R {radius}, the outline {there:.4f}")
        if np.isnan(angle):
            continue
        place = np.array([np.interp(angle, theta, profile[:, 0]), np.interp(angle, theta, profile[:, 1])])
        told = radius * np.array([np.cos(np.radians(psi)), np.sin(np.radians(psi))])
        if np.hypot(*(place - told)) > tolerance:
            wrong.append(f"ψ = {psi}: θ {angle} touches at {np.round(place, 3)}, the row is at {np.round(told, 3)}")
        if abs(np.interp(angle, theta, lift) - raised) > 0.02 + 0.004 * lift.max():
            wrong.append(f"ψ = {psi}: lift {raised}, at θ {angle} {np.interp(angle, theta, lift):.4f}")
    return wrong


def main():
    words = cases.given("drawings", 40)

    def one(number, rng):
        kind, text = design(rng)
        name = f"cam-{number}"
        machine = words.directory / f"{name}.toml"
        machine.write_text(text)
        command = [words.binary, "make", str(machine), "--format", "svg,pdf,dxf,csv", "--samples", "3600", "--out", str(words.directory), "--name", name, "--force", "--quiet"]
        command += ["--start", f"{rng.uniform(0, 359):.2f}deg", "--lead-in", "arc", "0.5mm"] if rng.random() < 0.3 else []
        run = subprocess.run(command, capture_output=True, text=True)
        if run.returncode == 2 or not (words.directory / f"{name}.dxf").exists():
            lines = run.stderr.strip().splitlines()
            is_known = any(part in run.stderr for part in ("cannot be", "no outline", "reach", "undercut", "below base_radius", "narrower"))
            return f"{kind} exit {run.returncode} without files", [] if is_known else lines or [f"exit {run.returncode}"], " ".join(command)
        wrong = table_faults(words.directory, name)
        for sheet in (f"{name}.svg", f"{name}-review.svg"):
            wrong += [f"{sheet}: {fault}" for fault in overlaps(words.directory / sheet)]
        return f"{kind} exit {run.returncode}", wrong, " ".join(command)

    states, failed = cases.judged(words, one)
    cases.finish(states, failed)


if __name__ == "__main__":
    main()
