"""Reads every version of the written DXF with ezdxf, strictly, and looks for what a shop's software trips over.

usage: dxf_gate.py CAMGEN_BINARY DIRECTORY
"""
import math
import subprocess
import sys
from pathlib import Path

import numpy as np
from outline import Chain, polyline
from shapely.geometry import Polygon

NAMES = {"r12": "AC1009", "r2000": "AC1015", "r2010": "AC1024", "r2013": "AC1027"}


def gate(path, version):
    raw = path.read_bytes()
    assert raw.isascii() and raw.endswith(b"EOF\n"), "not ASCII, or cut short"
    lines = raw.decode().split("\n")[:-1]
    pairs = [(int(lines[i]), lines[i + 1]) for i in range(0, len(lines), 2)]
    reals = [(code, value) for code, value in pairs if 10 <= code < 60 or 140 <= code < 150]
    assert all(math.isfinite(float(v)) and "e" not in v.lower() and v != "-0.0" for _, v in reals), "a bad number"
    if version == "r12":
        assert not any(code in (100, 330, 5) for code, _ in pairs), "subclass markers or handles in R12"
    else:
        handles = [value for code, value in pairs if code in (5, 105)]
        seed, used = int(handles[0], 16), [int(h, 16) for h in handles[1:]]
        assert len(used) == len(set(used)) and max(used) < seed, "handles"
        owners = {int(v, 16) for code, v in pairs if code in (330, 340, 350, 390)} - {0}
        assert owners <= set(used), f"dangling pointers {owners - set(used)}"
    document, vertices = polyline(path)
    assert document.dxfversion == NAMES[version]
    audit = document.audit()
    assert not audit.errors and not audit.fixes, f"{audit.errors} {audit.fixes}"
    assert document.header["$INSUNITS"] == 4 and document.header["$MEASUREMENT"] == 1, "not millimetres"
    kinds = sorted((e.dxf.layer, e.dxftype()) for e in document.modelspace())
    shape = "POLYLINE" if version == "r12" else "LWPOLYLINE"
    assert kinds == [("BORE", "CIRCLE"), ("CAM_PROFILE", shape)], f"{kinds}"
    chain = Chain(vertices)
    assert np.abs(chain.kinks()).max() <= 0.05 and chain.area() > 0
    flat = chain.flattened()
    assert Polygon(flat).is_valid, "crosses itself"
    low, high = flat.min(axis=0), flat.max(axis=0)
    least, largest = document.header["$EXTMIN"], document.header["$EXTMAX"]
    assert np.allclose(low, least[:2], atol=1e-2) and np.allclose(high, largest[:2], atol=1e-2), "extents"
    return vertices


def main():
    binary, directory = Path(sys.argv[1]).resolve(), Path(sys.argv[2])
    failed, seen = 0, []
    for version in NAMES:
        command = [binary, "rotary", "--quiet", "--format", "dxf", "--dxf-version", version, "--name", version]
        subprocess.run([*command, "--out", directory], check=True)
        try:
            seen.append(gate(directory / f"{version}.dxf", version))
            print(f"{version}: ok, {len(seen[-1])} arcs")
        except AssertionError as error:
            failed += 1
            print(f"{version}: FAILED {error}")
    if not all(np.array_equal(seen[0], other) for other in seen):
        failed += 1
        print("the versions differ: FAILED")
    print(f"{len(NAMES) - failed} passed, {failed} failed")
    sys.exit(failed > 0)


main()
