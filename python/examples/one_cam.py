"""One cam from an embedded machine to files: python one_cam.py [DIRECTORY]"""

import sys
import tempfile

import camgen

directory = sys.argv[1] if len(sys.argv) > 1 else tempfile.mkdtemp()

machine = camgen.Machine.load("feeder", {"follower.roller.radius": "14mm", "cam.thickness": "20mm"})
cam = machine.cam(rpm=120)
print(cam)
print(f"base radius {cam.base_radius_mm} mm, pressure angle {cam.pressure_angle_deg:.2f} deg")
print(f"largest torque {cam.forces()['torque_max_nm']:.2f} N·m")

proven = cam.draw("5um").prove()
for finding in proven.findings:
    limit = "" if finding.limit is None else f"{finding.bound} {finding.limit}"
    print(f"{finding.check:<20} {finding.value:12.4f} {finding.unit:<4} {limit:<20} {finding.verdict}")

# Refused with an exception where a check has failed.
for name in proven.write(directory)["files"]:
    print(name)

# What is wrong is told with its key, its place and what would be right; all faults at once.
try:
    camgen.Machine.load("feeder", {"cam.thikness": "20mm", "cam.bore_radius": "-1mm"})
except camgen.MachineError as error:
    for fault in error.faults:
        print(f"{fault.key}: {fault.message} [{fault.remedy}]")
