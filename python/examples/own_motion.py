"""Motions of your own: a function with its derivatives, samples, and a program of laws."""

import math

import numpy as np

import camgen


def two_harmonics(theta):
    """s = h [1 - cos θ - (cos 2θ - 1)/8]/2 and its derivatives, m by rad."""
    half = 0.5 * 0.020
    return (
        half * (1 - np.cos(theta) - (np.cos(2 * theta) - 1) / 8),
        half * (np.sin(theta) + np.sin(2 * theta) / 4),
        half * (np.cos(theta) + np.cos(2 * theta) / 2),
        half * (-np.sin(theta) - np.sin(2 * theta)),
    )


theta = np.linspace(0, 2 * np.pi, 72, endpoint=False)
motions = {
    "a function": camgen.Motion.from_function(two_harmonics),
    "72 samples": camgen.Motion.from_samples(theta, two_harmonics(theta)[0]),
    "a program": camgen.Motion.program(
        [("cycloidal", "90deg", "20mm"), ("dwell", "30deg", "20mm"), ("3-4-5", "120deg", 0.0), (None, "120deg", 0.0)]
    ),
}
machine = camgen.Machine.from_dict(
    {
        "name": "Own motion",
        "follower": {"roller": {"radius": "12mm"}},
        "cam": {"bore_radius": "10mm", "thickness": "15mm"},
        "limits": {"pressure_angle": "25 deg"},
    }
)
for name, motion in motions.items():
    cam = machine.cam(motion=motion, rpm=60)
    proven = cam.draw("5um").prove()
    lift, velocity, acceleration, jerk = motion([math.pi / 2])[:, 0]
    print(f"{name}: base radius {cam.base_radius_mm} mm, {len(proven.outline)} arcs, passed: {proven.passed}")
    print(f"  at 90 deg: lift {1e3 * lift:.4f} mm, velocity {1e3 * velocity:.4f} mm/rad")
