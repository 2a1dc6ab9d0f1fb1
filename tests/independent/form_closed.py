"""What the programs on form-closed cams have in common: the text of a motion, files with a planted fault, verdicts, solids.

Shares nothing with camgen.
"""
import json
import subprocess

import ezdxf
import numpy as np

LAWS = ["modified-sine", "3-4-5", "4-5-6-7", "cycloidal"]
TOLERANCE = 5e-3
# Rounding of twelve decimals and of the integration of the laws.
ROUNDING = 2e-8

# Faults that the rolling of any flank must find: what it does to a point of the drawing, complex, mm.
FAULTS = [("shifted by 1.3 tolerances", lambda z: z + 1.3 * TOLERANCE), ("turned by 0.1 deg", lambda z: z * np.exp(0.1j * np.pi / 180))]


def rise_and_return(random, stroke):
    """Segments of a whole turn: a rise, a rest, a return and a rest."""
    rise, rest, back = random.uniform(90, 140), random.uniform(5, 40), random.uniform(90, 140)
    return [(random.choice(LAWS), rise, stroke), ("dwell", rest, stroke), (random.choice(LAWS), back, 0.0), ("dwell", 360 - rise - rest - back, 0.0)]


def program(segments, unit, rpm=150):
    """The lines of a motion program, without a follower."""
    lines = ['name = "random"', "[motion]", f"rpm = {rpm}", f'start = "0 {unit}"']
    for law, over, to in segments:
        lines += ["[[motion.segment]]", f'law = "{law}"', f'over = "{over!r} deg"']
        lines += [] if law == "dwell" else [f'to = "{to!r} {unit}"']
    return lines


def failed(done):
    """The checks that failed, by name; none where there is no report."""
    return {check["check"] for check in json.loads(done.stdout)["checks"] if check["verdict"] == "fail"} if done.stdout.strip() else set()


def make(binary, folder, text, formats="dxf,step", *rest):
    """Makes the cam of a design in a folder; the finished process."""
    (folder / "design.toml").write_text(text)
    command = [binary, "make", str(folder / "design.toml"), "--out", str(folder), "--name", "cam", "--json", "--format", formats]
    return subprocess.run([*command, "--overwrite", "--tolerance-acceleration", "none", *rest], capture_output=True, text=True)


def plant(binary, folder, file, layer, change, *design):
    """Changes the outline of a layer of a file; the checks by which `camgen check` refuses it."""
    document = ezdxf.readfile(folder / file)
    (line,) = [entity for entity in document.modelspace() if entity.dxf.layer == layer]
    moved = [(change(complex(x, y)), bulge) for x, y, bulge in line.get_points("xyb")]
    line.set_points([(z.real, z.imag, bulge) for z, bulge in moved], format="xyb")
    planted = folder / f"planted-{file}"
    document.saveas(planted)
    done = subprocess.run([binary, "check", str(planted), "--json", *design], capture_output=True, text=True)
    assert done.returncode == 1, (file, layer, done.returncode, done.stderr)
    return failed(done)


def volumes(path):
    """The volumes of the solids of a STEP file as OpenCASCADE reads it, which must be valid."""
    from OCP.BRepCheck import BRepCheck_Analyzer
    from OCP.BRepGProp import BRepGProp
    from OCP.GProp import GProp_GProps
    from OCP.STEPControl import STEPControl_Reader
    from OCP.TopAbs import TopAbs_SOLID
    from OCP.TopExp import TopExp_Explorer

    reader = STEPControl_Reader()
    assert reader.ReadFile(str(path)) == 1, path
    reader.TransferRoots()
    shape = reader.OneShape()
    assert BRepCheck_Analyzer(shape).IsValid(), path
    explorer, found = TopExp_Explorer(shape, TopAbs_SOLID), []
    while explorer.More():
        properties = GProp_GProps()
        BRepGProp.VolumeProperties_s(explorer.Current(), properties)
        found.append(properties.Mass())
        explorer.Next()
    return found
