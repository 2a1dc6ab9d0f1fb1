"""Which roller gives the smallest cam? A search over all cores: python smallest_cam.py [COUNT]"""

import sys
from concurrent.futures import ThreadPoolExecutor

import numpy as np

import camgen

count = int(sys.argv[1]) if len(sys.argv) > 1 else 200
machine = camgen.Machine.load("dpi")


def area_of(radius_mm):
    """Area of the cam with a roller, mm²; None where a check fails."""
    cam = machine.with_overrides({"follower.roller.radius": f"{radius_mm}mm"}).cam(rpm=35)
    proven = cam.draw("20um").prove()
    return proven.area_mm2 if proven.passed else None


radii = np.linspace(10, 50, count)
# Solving, drawing and proving release the interpreter's lock.
with ThreadPoolExecutor() as pool:
    areas = list(pool.map(area_of, radii))
passed = [(area, radius) for area, radius in zip(areas, radii) if area is not None]
area, radius = min(passed)
print(f"{count} cams, {count - len(passed)} refused; the smallest has {area:.0f} mm² with a roller of {radius:.2f} mm")
