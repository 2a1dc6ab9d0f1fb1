"""Motions of segments, each law its acceleration integrated twice by Gauss' rule: nothing of camgen."""
import numpy as np

NODES, WEIGHTS = np.polynomial.legendre.leggauss(40)


def acceleration(law):
    """A function with the shape of the law's acceleration over x in [0, 1]."""
    pi = np.pi
    if law == "cycloidal":
        return lambda x: np.sin(2 * pi * x)
    if law == "harmonic":
        return lambda x: np.cos(pi * x)
    if law == "cubic":
        return lambda x: 1 - 2 * x
    if law == "3-4-5":
        return lambda x: x * (1 - x) * (1 - 2 * x)
    if law == "4-5-6-7":
        return lambda x: (x * (1 - x)) ** 2 * (1 - 2 * x)
    assert law == "modified-sine", law
    return lambda x: np.where(
        x < 1 / 8, np.sin(4 * pi * x), np.where(x < 7 / 8, np.cos(4 * pi / 3 * (x - 1 / 8)), -np.sin(4 * pi * (1 - x)))
    )


def travel(law, x):
    """s(x) = ∫₀ˣ (x − t) a(t) dt over its value at 1; the pieces of the modified sine are integrated one by one."""
    shape = acceleration(law)
    x = np.atleast_1d(x)

    def moment(to):
        total = np.zeros_like(to)
        for low, high in zip([0, 1 / 8, 7 / 8], [1 / 8, 7 / 8, 1]):
            upper = np.clip(to, low, high)
            half, middle = (upper - low) / 2, (upper + low) / 2
            t = middle[:, None] + half[:, None] * NODES
            total += (half[:, None] * WEIGHTS * (to[:, None] - t) * shape(t)).sum(axis=1)
        return total

    return moment(x) / moment(np.array([1.0]))


def motion(segments, start, theta):
    """Position at cam angles in degrees, and the breaks."""
    position, breaks = np.full_like(theta, np.nan), [0.0]
    at, value = 0.0, start
    for law, over, to in segments:
        inside = (theta >= at) & (theta <= at + over)
        if law == "dwell":
            position[inside] = value
        else:
            position[inside] = value + (to - value) * travel(law, (theta[inside] - at) / over)
            value = to
        at += over
        breaks.append(at)
    return position
