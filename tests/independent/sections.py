"""The sections of drawings before OpenCASCADE: the solid of the STEP file is cut by the plane that the cutting line names, and every edge of that cut
lies on a line of the drawing, every flank of the drawing on an edge of the cut, within 0.01 mm; the hatch lies in the cut surface.

Discs with hubs, grooves, ribs, barrels and globoids at random, in millimetres (first-angle projection) and in inches (third angle), with the symbol that
belongs to it. The section of a barrel or a globoid lies along its axis.

usage: sections.py CAMGEN_BINARY DIRECTORY [--count N] [--seed S] [--jobs N]
"""
import re
import subprocess
from xml.etree import ElementTree

import barrel
import cases
import drawings
import globoid
import groove
import numpy as np
import rib
from OCP.BRepAdaptor import BRepAdaptor_Curve
from OCP.BRepAlgoAPI import BRepAlgoAPI_Section
from OCP.BRepClass3d import BRepClass3d_SolidClassifier
from OCP.gp import gp_Dir, gp_Pln, gp_Pnt
from OCP.IFSelect import IFSelect_RetDone
from OCP.STEPControl import STEPControl_Reader
from OCP.TopAbs import TopAbs_EDGE, TopAbs_IN, TopAbs_ON
from OCP.TopExp import TopExp_Explorer
from OCP.TopoDS import TopoDS

SVG = "{http://www.w3.org/2000/svg}"
NEAR = 0.01  # mm
THICK = 20.0


def design(rng):
    """A machine file of a cam whose drawing has a true section, with a thickness."""
    kind = rng.choice(["disc", "groove", "rib", "barrel", "globoid"])
    if kind == "disc":
        _, text = drawings.design(rng)
        text = re.sub(r'(?m)^thickness = .*\n', "", text).replace("[cam]\n", f'[cam]\nthickness = "{THICK} mm"\n', 1)
        bore, base = (re.search(rf'{key} = "([\d.]+) mm"', text) for key in ("bore_radius", "base_radius"))
        if bore and base and float(base[1]) > 1.8 * float(bore[1]) and rng.random() < 0.6:
            text += f'[cam.hub]\ndiameter = "{1.7 * (float(bore[1]) + float(base[1])) * 0.55:.3f} mm"\nlength = "{rng.uniform(3, 30):.3f} mm"\n'
            text += f'side = "{rng.choice(["back", "front", "both"])}"\n'
    else:
        module = {"groove": groove, "rib": rib, "barrel": barrel, "globoid": globoid}[kind]
        text = module.toml(module.design(rng))
    if rng.random() < 0.3:
        text += '\n[output]\nunits = "inch"\n'
    return kind, text


def solid(path):
    reader = STEPControl_Reader()
    assert reader.ReadFile(str(path)) == IFSelect_RetDone
    reader.TransferRoots()
    return reader.OneShape()


def cut(shape, normal, count=2):
    """The edges in which a plane through the axis cuts a solid, each as so many points, mm."""
    section = BRepAlgoAPI_Section(shape, gp_Pln(gp_Pnt(0, 0, 0), gp_Dir(*normal)))
    section.Build()
    found, edges = [], TopExp_Explorer(section.Shape(), TopAbs_EDGE)
    # The name of the cast has changed from one version of the wheel to the next.
    as_edge = getattr(TopoDS, "Edge_s", None) or TopoDS.Edge
    while edges.More():
        curve = BRepAdaptor_Curve(as_edge(edges.Current()))
        edges.Next()
        points = [curve.Value(at) for at in np.linspace(curve.FirstParameter(), curve.LastParameter(), count)]
        found.append(np.array([[point.X(), point.Y(), point.Z()] for point in points]))
    return found


def lines(root, name):
    """The lines of a group of a sheet, mm of paper, y upwards."""
    for group in root.iter(f"{SVG}g"):
        if group.get("id") == name:
            found = [[[float(line.get("x1")), -float(line.get("y1"))], [float(line.get("x2")), -float(line.get("y2"))]]
                     for line in group.findall(f"{SVG}line")]
            for chain in group.findall(f"{SVG}polyline"):
                points = [[float(x), -float(y)] for x, y in (pair.split(",") for pair in chain.get("points").split())]
                found += [list(pair) for pair in zip(points, points[1:])]
            return np.array(found).reshape(-1, 2, 2)
    return np.zeros((0, 2, 2))


def apart(point, of):
    """The distance of a point from the nearest of some lines."""
    if not len(of):
        return np.inf
    start, way = of[:, 0], of[:, 1] - of[:, 0]
    share = np.clip(np.einsum("ij,ij->i", point - start, way) / np.maximum(np.einsum("ij,ij->i", way, way), 1e-18), 0, 1)
    return np.linalg.norm(point - start - share[:, None] * way, axis=1).min()


def judge_section(root, letter, shape, is_inch):
    """What is wrong with a section."""
    scale = next(float(group.get("data-scale")) for group in root.iter(f"{SVG}g") if group.get("data-scale"))
    edges, flanks, hatch = (lines(root, f"{kind}-{letter}") / scale for kind in ("section", "flanks", "hatch"))
    drawn = np.concatenate([edges, flanks])
    if not len(drawn):
        return [f"there is no section {letter}"]
    upright = 1 if letter == "A" else 0
    low, high = drawn[:, :, upright].min(), drawn[:, :, upright].max()

    ends = np.concatenate(cut(shape, (0, 1, 0) if letter == "A" else (1, 0, 0)))[:, 2]
    bottom = ends.min()

    def to_paper(point):
        along, height = point[1 - upright], point[2]
        # First angle: A seen from above, the face of the front view below; B seen from the left, that face at the right.
        first = high - (height - bottom) if letter == "A" else low + (height - bottom)
        third = low + (height - bottom) if letter == "A" else high - (height - bottom)
        place = third if is_inch else first
        return np.array([along, place] if letter == "A" else [place, along])

    normal = (0, 1, 0) if letter == "A" else (1, 0, 0)
    wrong, found = [], cut(shape, normal)
    if not found:
        return [f"{letter}: the plane does not meet the solid"]
    on_paper = np.array([[to_paper(end) for end in ends] for ends in found])
    for line in on_paper:
        for share in (0, 0.3, 0.7, 1):
            point = line[0] + share * (line[1] - line[0])
            if (off := apart(point, drawn)) > NEAR:
                wrong.append(f"{letter}: an edge of the solid at {np.round(point, 3)} is {off:.4f} mm off the drawing")
                break
    for line in flanks:
        if (off := max(apart(end, on_paper) for end in line)) > NEAR:
            wrong.append(f"{letter}: the flank at {np.round(line, 3).tolist()} is {off:.4f} mm off the solid")
    for line in hatch[:: max(1, len(hatch) // 12)]:
        middle = line.mean(axis=0)
        along, place = (middle[0], middle[1]) if letter == "A" else (middle[1], middle[0])
        height = bottom + ((place - low) if (letter == "B") != is_inch else (high - place))
        point = gp_Pnt(along, 0, height) if letter == "A" else gp_Pnt(0, along, height)
        if BRepClass3d_SolidClassifier(shape, point, 1e-6).State() not in (TopAbs_IN, TopAbs_ON):
            wrong.append(f"{letter}: hatched at {np.round(middle, 3)}, where the solid is not")
    if not len(hatch):
        wrong.append(f"{letter}: nothing is hatched")
    return wrong


def scale_of(root):
    """The scale of a sheet: its ruler is 100 mm or 4 in of paper long, and the scale stands in the title block."""
    words = [text.text.strip() for text in root.iter(f"{SVG}text") if text.text]
    (scale,) = [word for word in words if re.fullmatch(r"\d+:\d+", word)]
    paper, true = map(int, scale.split(":"))
    return paper / true


def judge_round(root, shape):
    """What is wrong with the section of a round cam along its axis: z to the right, psi = 0 upwards, the axis at y = 0."""
    scale = scale_of(root)
    edges, flanks, hatch, ends = (lines(root, f"{kind}-A") / scale for kind in ("section", "flanks", "hatch", "ends"))
    drawn = np.concatenate([edges, flanks, ends])
    if not len(flanks) or not len(hatch):
        return ["there is no section A"]
    wrong, on_paper = [], [points[:, [2, 0]] for points in cut(shape, (0, 1, 0), 9)]
    for points in on_paper:
        if (off := max(apart(point, drawn) for point in points)) > NEAR:
            wrong.append(f"A: an edge of the solid at {np.round(points[0], 3)} is {off:.4f} mm off the drawing")
    pieces = np.concatenate([np.stack([points[:-1], points[1:]], axis=1) for points in (p[:, [2, 0]] for p in cut(shape, (0, 1, 0), 200))])
    for line in flanks:
        if (off := max(apart(end, pieces) for end in line)) > NEAR:
            wrong.append(f"A: the flank at {np.round(line, 3).tolist()} is {off:.4f} mm off the solid")
    for line in hatch[:: max(1, len(hatch) // 12)]:
        z, x = line.mean(axis=0)
        if BRepClass3d_SolidClassifier(shape, gp_Pnt(x, 0, z), 1e-6).State() not in (TopAbs_IN, TopAbs_ON):
            wrong.append(f"A: hatched at {np.round([z, x], 3)}, where the solid is not")
    return wrong


def symbol_faults(root, is_inch):
    """The small end of the frustum is seen at the right of it in the first angle, at the left in the third."""
    (group,) = [group for group in root.iter(f"{SVG}g") if group.get("id") == "projection"]
    circle = min(float(circle.get("cx")) for circle in group.findall(f"{SVG}circle"))
    frustum = np.mean([float(line.get("x1")) for line in group.findall(f"{SVG}line")[:4]])
    is_third = circle < frustum
    return [] if is_third == is_inch else [f"the symbol is of the {'third' if is_third else 'first'} angle"]


def main():
    words = cases.given("sections", 40)

    def one(number, rng):
        kind, text = design(rng)
        is_inch = '"inch"' in text
        name = f"cam-{number}"
        machine = words.directory / f"{name}.toml"
        machine.write_text(text)
        command = [words.binary, "make", str(machine), "--format", "svg,step", "--out", str(words.directory), "--name", name, "--force", "--quiet"]
        run = subprocess.run([*command, "--tolerance-acceleration", "none"], capture_output=True, text=True)
        if run.returncode == 2 or not (words.directory / f"{name}.step").exists():
            return f"{kind} refused", [], " ".join(command)
        root = ElementTree.parse(words.directory / f"{name}.svg").getroot()
        shape = solid(words.directory / f"{name}.step")
        wrong = symbol_faults(root, is_inch)
        if kind in ("barrel", "globoid"):
            wrong += judge_round(root, shape)
        else:
            for letter in "A" if kind == "disc" else "AB":
                wrong += judge_section(root, letter, shape, is_inch)
        return f"{kind}{' in inches' if is_inch else ''}", wrong, " ".join(command)

    states, failed = cases.judged(words, one)
    cases.finish(states, failed)


if __name__ == "__main__":
    main()
