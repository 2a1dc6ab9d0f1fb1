"""The sheets as PDF, read by PDFium: page size, fonts, the ruler, the outline in its scale, the review sheet on the second page; the motion diagram
on the third, whose largest and least values are those of the CSV.

    sheets.py BINARY DIRECTORY
"""

import csv
import ctypes
import json
import re
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

import pypdfium2
import pypdfium2.raw as raw

PAPERS = {"A3": (420, 297), "A2": (594, 420), "A1": (841, 594)}
POINT = 25.4 / 72  # mm
SVG = "{http://www.w3.org/2000/svg}"

CASES = {
    "rotary": ["rotary"],
    "ccw": ["rotary", "--set", "cam.rotation=ccw"],
    "offset": ["rotary", "--set", "follower.roller.offset=20mm"],
    "huge": ["rotary", "--set", "cam.base_radius=1000mm", "--set", "limits.size=3m"],
    "small": ["rotary", "--set", "cam.base_radius=10mm", "--set", "cam.bore_radius=4mm", "--force"],
    "undercut": ["rotary", "--set", "cam.base_radius=20mm", "--set", "cam.bore_radius=8mm", "--force"],
    "long": ["rotary", "--set", "name=" + "A press with a name of sixty letters, to be told in full here"],
    "cyrillic": ["rotary", "--set", "name=Плоскопечатная машина ДПИ с воздушными буферами, 2 ат"],
    "plate": ["translating"],
    "conoid": ["conoid", "--rpm", "20,25,30,35"],
}


def pages(path):
    document = pypdfium2.PdfDocument(path)
    return document, [document[index] for index in range(len(document))]


def fonts(page):
    """Name and whether it is in the file, of the font of each text object."""
    found = {}
    for thing in page.get_objects(filter=[raw.FPDF_PAGEOBJ_TEXT], max_depth=8):
        font = raw.FPDFTextObj_GetFont(thing.raw)
        size = raw.FPDFFont_GetBaseFontName(font, None, 0)
        name = ctypes.create_string_buffer(size)
        raw.FPDFFont_GetBaseFontName(font, name, size)
        found[name.value.decode()] = raw.FPDFFont_GetIsEmbedded(font) == 1
    return found


def horizontal_lines(page):
    """Lengths (mm) of paths that are one horizontal line."""
    found = []
    for thing in page.get_objects(filter=[raw.FPDF_PAGEOBJ_PATH], max_depth=8):
        if raw.FPDFPath_CountSegments(thing.raw) != 2:
            continue
        points = []
        for index in range(2):
            x, y = ctypes.c_float(), ctypes.c_float()
            raw.FPDFPathSegment_GetPoint(raw.FPDFPath_GetPathSegment(thing.raw, index), x, y)
            points.append((x.value, y.value))
        matrix = thing.get_matrix()
        (ax, ay), (bx, by) = [matrix.on_point(*point) for point in points]
        if abs(ay - by) < 1e-3:
            found.append(abs(bx - ax) * POINT)
    return found


# Columns of the table, and whether the diagram has their rates by time.
COLUMNS = {
    "lift_mm": 0, "velocity_mm_per_rad": 1, "acceleration_mm_per_rad2": 2, "jerk_mm_per_rad3": 3, "pressure_angle_deg": 0,
    "contact_force_n": 0, "torque_nm": 0,
}


def diagram(name, page, table):
    """The page of the diagram against the table: how many largest and least values of columns it has as labels."""
    assert abs(page.get_size()[0] * POINT - 420) < 0.1 and abs(page.get_size()[1] * POINT - 297) < 0.1, name
    assert all(fonts(page).values()), name
    text = page.get_textpage().get_text_range()
    flat = re.sub(r"\s", "", text)
    assert "motiondiagram" in flat and "3/3" in flat, name
    speed = re.search(r"ω=([\d.]+)rad/s", flat)
    speed = float(speed.group(1)) if speed else 1.0
    labels = [float(number) for number in re.findall(r"(?:max|min)(-?[\d.]+(?:e-?\d+)?)at", flat)]
    with open(table, newline="") as file:
        rows = [row for row in csv.DictReader(file)]
    if "cam_deg" not in rows[0]:
        return 0
    compared = 0
    for column, order in COLUMNS.items():
        if column not in rows[0]:
            continue
        values = [float(row[column]) * speed**order for row in rows]
        size = max(abs(value) for value in values)
        for value in (max(values), min(values)):
            if size == 0 or column == "lift_mm" and value == min(values):
                continue
            near = any(abs(label * unit - value) < 1e-2 * size for label in labels for unit in (1, 1000))
            assert near, (name, column, value, labels)
            compared += 1
    return compared


def check(name, arguments, binary, directory):
    out = directory / "sheets" / name
    run = subprocess.run(
        [binary, *arguments, "--format", "svg,pdf,dxf,csv", "--samples", "7200", "--out", str(out), "--name", name, "--json"],
        capture_output=True, text=True, timeout=300)
    forced = "--force" in arguments
    assert run.returncode == (1 if forced else 0), (name, run.stderr)
    report = json.loads(run.stdout)
    assert forced == any(check["verdict"] == "fail" for check in report["checks"]), name
    svg = ElementTree.parse(out / f"{name}.svg").getroot()
    size = [float(svg.get(side).removesuffix("mm")) for side in ("width", "height")]
    assert tuple(size) in PAPERS.values(), (name, size)
    document, (page, *others) = pages(out / f"{name}.pdf")
    # A conoid has a motion for each of its sections.
    assert len(others) == (1 if arguments[0] == "conoid" else 2), (name, len(others))
    compared = sum(diagram(name, other, out / f"{name}.csv") for other in others[1:])
    review = re.sub(r"\s", "", others[0].get_textpage().get_text_range())
    assert ("FAILED" if forced else "passed") in review and "reviewsheet" in review, name
    for told, read in zip(size, page.get_size()):
        assert abs(told - read * POINT) < 0.1, (name, told, read * POINT)
    used = fonts(page)
    assert used and all(used.values()), (name, used)
    # The clip of the page moves the numbers by less than this.
    ruler = min(horizontal_lines(page), key=lambda length: abs(length - 100))
    assert abs(ruler - 100) < 0.02, (name, ruler)
    text = page.get_textpage().get_text_range()
    flat = re.sub(r"\s", "", text)
    for words in ("100mmonpaper", report["inputs"]["hash"], "NOTFORMANUFACTURE" if forced else "partdrawing"):
        assert words in flat, (name, words)
    if not forced:
        assert "NOTFORMANUFACTURE" not in flat, name
    assert re.sub(r"\s", "", report["machine"]) in flat, name
    outlines = [group for group in svg.iter(f"{SVG}g") if group.get("data-scale")]
    assert outlines, name
    page.render(scale=1280 / page.get_size()[0]).to_pil().save(out / f"{name}.png") if has_pillow() else None
    print(f"{name:10} {size[0]:g} x {size[1]:g} mm, scale {outlines[0].get('data-scale')}, ruler {ruler:.4f} mm, "
          f"{len(text)} letters, {compared} values of the diagram, fonts {', '.join(used)}")
    document.close()


def has_pillow():
    try:
        import PIL  # noqa: F401
    except ImportError:
        return False
    return True


def main():
    binary, directory = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
    for name, arguments in CASES.items():
        check(name, arguments, binary, directory)
    print(f"{len(CASES)} sheets as PDF: sizes, fonts, ruler, stamp and texts as they should be")


if __name__ == "__main__":
    main()
