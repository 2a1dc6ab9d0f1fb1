"""The solid of a cam in build123d: its volume by another kernel. Needs build123d."""

import camgen

cam = camgen.Machine.load("feeder").cam()
proven = cam.draw("5um").prove()
solid = proven.to_build123d()
mass = proven.report["cam"]["mass_kg"]
print(f"{solid.volume:.3f} mm³ by OpenCASCADE, {proven.area_mm2:.3f} mm² by camgen, {mass:.4f} kg")
