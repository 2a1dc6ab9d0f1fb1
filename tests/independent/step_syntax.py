"""Writes a right STEP file in other ways and with faults of its syntax, and holds `camgen check` against OpenCASCADE.

What other programs may write (long lines, comments, other line ends, the schemas of AP203, AP214 and AP242, units in any order,
numbers in every form of ISO 10303-21) is accepted, and OpenCASCADE reads the same solid. What is no valid file (words in small
letters, parameters too many, a schema of buildings, a second file behind the first) is refused. Whatever is accepted, of both lists,
OpenCASCADE must read as the same solid: it is read in a process of its own, because some of these files end it.

usage: step_syntax.py CAMGEN_BINARY DIRECTORY
"""
import json
import re
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

SCHEMA = "AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }"
UNIT = "(LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT(.MILLI., .METRE.))"
UNITS = "((#12, #13, #14))"
METRES = "#9012 = (LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT($, .METRE.));\n"
CORNER = "(-25., 0., 30.)"
# How OpenCASCADE, FreeCAD, SolidWorks, Inventor, Creo, CATIA, NX, Onshape, Rhino and SolveSpace name their schemas.
SCHEMAS = [
    "AUTOMOTIVE_DESIGN", "AUTOMOTIVE_DESIGN { 1 0 10303 214 2 1 1}", "AUTOMOTIVE_DESIGN_CC2 { 1 2 10303 214 -1 1 5 4 }", "CONFIG_CONTROL_DESIGN",
    "AP203_CONFIGURATION_CONTROLLED_3D_DESIGN_OF_MECHANICAL_PARTS_AND_ASSEMBLIES_MIM_LF { 1 0 10303 403 3 1 4}",
    "AP242_MANAGED_MODEL_BASED_3D_ENGINEERING_MIM_LF { 1 0 10303 442 1 1 4 }", "automotive_design",
    "CONFIG_CONTROL_DESIGN', 'GEOMETRIC_VALIDATION_PROPERTIES_MIM', 'SHAPE_APPEARANCE_LAYER_MIM",
]
# Entities of the solid, and a further parameter of each.
SURPLUS = [
    "CARTESIAN_POINT", "DIRECTION", "VECTOR", "AXIS2_PLACEMENT_3D", "PLANE", "CYLINDRICAL_SURFACE", "LINE", "CIRCLE", "EDGE_CURVE", "VERTEX_POINT",
    "EDGE_LOOP", "ORIENTED_EDGE", "FACE_BOUND", "ADVANCED_FACE", "CLOSED_SHELL", "MANIFOLD_SOLID_BREP", "ADVANCED_BREP_SHAPE_REPRESENTATION",
]
ALONE = [name for name in SURPLUS if name != "ADVANCED_BREP_SHAPE_REPRESENTATION"]


def once(pattern, by, text):
    made = re.sub(pattern, by, text, count=1)
    assert made != text, pattern
    return made


def replaced(text, old, new, count=-1):
    assert old in text, old
    return text.replace(old, new, count)


def right(text):
    """Other ways to write the same."""
    yield "as it is", text
    yield "Windows line ends", text.replace("\n", "\r\n")
    yield "returns as line ends", text.replace("\n", "\r")
    yield "one line", text.replace("\n", " ")
    yield "a line of 40 000 blanks", replaced(text, "#18 =", " " * 40_000 + "#18 =")
    yield "short lines", re.sub(r", ", ",\n", text)
    yield "no blanks", text.replace(" = ", "=").replace(", ", ",")
    yield "a blank before each bracket", re.sub(r"([A-Z])\(", r"\1 (", text)
    yield "a comment of 600 lines", replaced(text, "DATA;\n", "DATA;/*" + ("x" * 70 + "\n") * 600 + "*/\n")
    yield "a comment of 16 000 characters", replaced(text, "DATA;\n", "DATA;/*" + "x" * 15_990 + "*/\n")
    yield "comments", replaced(text, "#18 = ", "/* it's; #19 ( */ #18 \t = /***/ /* /* */")
    yield "a name of 16 000 characters", replaced(text, "BREP(''", f"BREP('{'x' * 16_000}'")
    yield "a name with a comment", replaced(text, "BREP(''", "BREP('/* x */ ÄÖ'")
    yield "nothing as name", replaced(text, "BREP(''", "BREP($")
    yield "blanks behind the end", text + "\n\n \t\r\n"
    yield "a comment behind the end", text + "/* end */\n"
    yield "ends of files behind the end", text + "\x1a\0\0"
    yield "a directive of a printed page", replaced(text, "#18 =", "\\N\\#18 =")
    yield "two data sections", replaced(text, "#1000 =", "ENDSEC;\nDATA;\n#1000 =")
    yield "an entity of a user", replaced(text, "ENDSEC;\nEND-", "#9000 = !MY_THING('x');\nENDSEC;\nEND-")
    yield "zeros before a number", replaced(text, "#17 = ", "#0017 = ")
    yield "a complex entity of one part", once(r"= (PLANE\([^)]*\));", r"= (\1);", text)
    yield "no NAMED_UNIT", replaced(text, " NAMED_UNIT(*) SI_UNIT(.MILLI.", " SI_UNIT(.MILLI.")
    yield "a unit in another order", replaced(text, UNIT, "(SI_UNIT(.MILLI., .METRE.) NAMED_UNIT(*) LENGTH_UNIT())")
    yield "no uncertainty", replaced(text, "GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT((#15)) ", "")
    yield "a large uncertainty", replaced(text, "1.E-06", "1.")
    yield "a small exponent", replaced(text, CORNER, "(-2.5e1, 0.e0, 3.e+1)")
    yield "exponents", replaced(text, CORNER, "(-2.5E+1, 0.E0, 3.E01)")
    yield "whole numbers", replaced(text, CORNER, "(-25, 0, +30)")
    yield "numbers of 300 digits", replaced(text, CORNER, f"(-{'0' * 60}25., 0., 30.{'0' * 300})")
    yield "long vectors", re.sub(r"(VECTOR\('', #\d+, )[^)]*\)", r"\g<1>1000.)", text)
    yield "long directions", text.replace("DIRECTION('', (0., 0., 1.))", "DIRECTION('', (0., 0., 100.))")
    yield "placements without a last direction", re.sub(r"(AXIS2_PLACEMENT_3D\('', #\d+, #\d+, )#\d+\)", r"\1$)", text)
    for schema in SCHEMAS:
        yield f"schema {schema[:40]}", replaced(text, SCHEMA, schema)


def wrong(text):
    """Faults: small letters, surplus, units, schemas, what is behind the end, numbers."""
    yield "small letters", re.sub(r"= ([A-Z_0-9]+)\(", lambda found: f"= {found[1].lower()}(", text)
    for old in ("PLANE(", "ADVANCED_FACE(", "LENGTH_UNIT(", "LENGTH_MEASURE(", ".MILLI.", ".T.", "HEADER;", "DATA;", "ENDSEC;", "END-ISO"):
        yield f"{old} in small letters", replaced(text, old, old.lower(), 1)
    yield "a capital first", replaced(text, "MANIFOLD_SOLID_BREP(", "Manifold_Solid_Brep(")
    for name in SURPLUS:
        yield f"surplus in {name}", once(rf"(\d = {name}\([^;]*)\);", r"\1, 5.);", text)
        yield f"too little in {name}", once(rf"(\d = {name}\([^;]*), [^,;]*\);", r"\1);", text)
    for name in ALONE:
        yield f"{name} as a part", once(rf"= ({name}\([^;]*\));", r"= (FOO() \1);", text)
    yield "surplus in SI_UNIT", replaced(text, "(.MILLI., .METRE.)", "(.MILLI., .METRE., 5)")
    yield "two prefixes", replaced(text, "(.MILLI., .METRE.)", "(.KILO., .MILLI., .METRE.)")
    yield "surplus in NAMED_UNIT", replaced(text, UNIT, UNIT.replace("(*)", "(*, *)"))
    yield "surplus in LENGTH_UNIT", replaced(text, UNIT, UNIT.replace("UNIT()", "UNIT(5)"))
    yield "metres behind", replaced(replaced(text, UNITS, "((#12, #9012, #13, #14))"), "#13 = (", METRES + "#13 = (")
    yield "metres before", replaced(replaced(text, UNITS, "((#9012, #12, #13, #14))"), "#13 = (", METRES + "#13 = (")
    for schema in ("IFC4", "IFC2X3", "", "HELLO", "ISO-10303-042"):
        yield f"schema {schema!r}", replaced(text, SCHEMA, schema)
    yield "no schema", once(r"FILE_SCHEMA.*\n", "", text)
    yield "no header", once(r"(?s)HEADER;.*?ENDSEC;\n", "", text)
    yield "a second header", replaced(text, "DATA;\n", "HEADER;\nENDSEC;\nDATA;\n", 1)
    yield "the file twice", text + text
    yield "another file behind", text + text.replace(".MILLI.", "$")
    yield "words behind the end", text + "garbage\n"
    yield "data behind the end", text + "DATA;\n#9000 = MANIFOLD_SOLID_BREP('', #17);\nENDSEC;\n"
    yield "a comment of 16 400 characters", replaced(text, "DATA;\n", f"DATA;/*{'x' * 16_400}*/\n")
    yield "a name of 16 400 characters", replaced(text, "BREP(''", f"BREP('{'x' * 16_400}'")
    yield "an exponent without a point", replaced(text, CORNER, "(-25E0, 0, 3E1)")
    yield "typed coordinates", replaced(text, CORNER, "(LENGTH_MEASURE(-25.), 0., 30.)")
    yield "a typed radius", once(r"(CYLINDRICAL_SURFACE\('', #\d+, )([0-9.]+)\)", r"\1POSITIVE_LENGTH_MEASURE(\2))", text)
    yield "a vector of 1 nm", once(r"(VECTOR\('', #\d+, )[^)]*\)", r"\g<1>1.E-9)", text)
    yield "a number above 32 bits", text.replace("#2417", "#3000000000")
    yield "a comment behind a number", replaced(text, "#18 = ", "#18 /* */ = ")
    yield "a line end behind a number", replaced(text, "#18 = ", "#18\n= ")
    yield "the number 0", text.replace("#2417", "#0")


# Reads one file as mutated.py does, in a process that it may end.
READER = "import sys, json; import mutated; found = mutated.solid(sys.argv[1]); print('FOUND', json.dumps(found and [found[0], found[1], list(found[2])]))"


def solid(path):
    """Number of solids, volume and box as OpenCASCADE has them; `None` where it reads nothing, or ends."""
    run = subprocess.run([sys.executable, "-c", READER, path], capture_output=True, text=True, cwd=Path(__file__).parent)
    told = [line for line in run.stdout.splitlines() if line.startswith("FOUND ")]
    return json.loads(told[0].removeprefix("FOUND ")) if run.returncode == 0 and told else None


def same(found, own):
    return found[0] == own[0] and abs(found[1] / own[1] - 1) < 1e-9 and max(abs(a - b) for a, b in zip(found[2], own[2])) < 1e-6


def main():
    binary, directory = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
    command = [binary, "rotary", "dpi", "--rpm", "35", "--format", "step", "--name", "syntax", "--out", directory, "--quiet", "--overwrite"]
    assert subprocess.run(command).returncode == 0, command
    text = (directory / "syntax.step").read_text()
    own = solid(directory / "syntax.step")

    def judged(number, accepted, name, made):
        """What is wrong with camgen's verdict on a file."""
        path = directory / f"syntax-{number}.step"
        path.write_bytes(made.encode())
        run = subprocess.run([binary, "check", path, "dpi", "--rpm", "35", "--cam", "rotary"], capture_output=True, text=True)
        told, against = (run.stderr or run.stdout).strip()[-300:], []
        if run.returncode not in ((0,) if accepted else (1, 2)) or "panicked" in run.stderr:
            against.append(f"{name}: exit code {run.returncode}: {told}")
        if run.returncode == 0:
            found = solid(path)
            if not found or not same(found, own):
                against.append(f"{name}: accepted, and OpenCASCADE reads {found} instead of {own}")
        path.unlink()
        return against

    files = [(True, *file) for file in right(text)] + [(False, *file) for file in wrong(text)]
    with ThreadPoolExecutor(2) as pool:
        faults = [fault for found in pool.map(judged, range(len(files)), *zip(*files)) for fault in found]
    counts = [sum(accepted for accepted, *_ in files), sum(not accepted for accepted, *_ in files)]
    for fault in faults:
        print(f"  {fault}")
    print(f"step_syntax.py: {counts[0]} other ways to write a solid accepted, {counts[1]} faults refused, {len(faults)} wrong")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
