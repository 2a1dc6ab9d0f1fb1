"""A closed chain of arcs and lines out of a DXF file, read by ezdxf, and its distance from points, by numpy."""
import ezdxf
import numpy as np


def polyline(path, layer="CAM_PROFILE"):
    """The only polyline of a layer as an array of x, y, bulge."""
    document = ezdxf.readfile(path)
    found = [e for e in document.modelspace() if e.dxf.layer == layer]
    assert len(found) == 1, f"{path}: {len(found)} entities on {layer}"
    entity = found[0]
    if entity.dxftype() == "LWPOLYLINE":
        assert entity.closed, f"{path}: open"
        return document, np.array(entity.get_points("xyb"), dtype=float)
    assert entity.dxftype() == "POLYLINE" and entity.is_closed, f"{path}: {entity.dxftype()}"
    return document, np.array([(*v.dxf.location.xyz[:2], v.dxf.get("bulge", 0.0)) for v in entity.vertices])


class Chain:
    def __init__(self, vertices):
        self.start = vertices[:, :2]
        self.end = np.roll(self.start, -1, axis=0)
        bulge = vertices[:, 2]
        chord = self.end - self.start
        self.length = np.hypot(*chord.T)
        assert (self.length > 1e-6).all(), "a segment of no length"
        self.sweep = 4 * np.arctan(bulge)
        self.is_arc = bulge != 0
        safe = np.where(self.is_arc, bulge, 1.0)
        left = np.stack([-chord[:, 1], chord[:, 0]], axis=1)
        self.centre = (self.start + self.end) / 2 + left * ((1 - safe**2) / (4 * safe))[:, None]
        self.radius = self.length * (1 + safe**2) / (4 * np.abs(safe))
        heading = np.arctan2(chord[:, 1], chord[:, 0])
        self.heading_in, self.heading_out = heading - self.sweep / 2, heading + self.sweep / 2

    def kinks(self):
        """Turn of the tangent at the start of each segment, degrees."""
        turn = self.heading_in - np.roll(self.heading_out, 1)
        return np.degrees((turn + np.pi) % (2 * np.pi) - np.pi)

    def area(self):
        cross = self.start[:, 0] * self.end[:, 1] - self.start[:, 1] * self.end[:, 0]
        cap = np.where(self.is_arc, self.radius**2 * (np.abs(self.sweep) - np.sin(np.abs(self.sweep))), 0)
        return 0.5 * (cross + np.sign(self.sweep) * cap).sum()

    def extents(self):
        """Length and width of the upright rectangle about the chain."""
        points = [self.start]
        start = np.arctan2(*(self.start - self.centre).T[::-1])
        for quarter in np.arange(4) * np.pi / 2:
            along = (quarter - start) * np.sign(self.sweep) % (2 * np.pi)
            touched = self.is_arc & (along <= np.abs(self.sweep))
            points.append((self.centre + self.radius[:, None] * [np.cos(quarter), np.sin(quarter)])[touched])
        points = np.concatenate(points)
        return points.max(axis=0) - points.min(axis=0)

    def flattened(self, step=0.01):
        points = []
        for i in range(len(self.start)):
            count = max(1, int(abs(self.sweep[i]) / step)) if self.is_arc[i] else 1
            if not self.is_arc[i]:
                points.append(self.start[i])
                continue
            a0 = np.arctan2(*(self.start[i] - self.centre[i])[::-1])
            angle = a0 + self.sweep[i] * np.arange(count) / count
            points.extend(self.centre[i] + self.radius[i] * np.stack([np.cos(angle), np.sin(angle)], axis=1))
        return np.array(points)

    def distance(self, points):
        """Distance of every point from the chain: to the arc where its foot lies on it, else to an end."""
        p = points[:, None, :]
        to_end = np.minimum(np.linalg.norm(p - self.start, axis=2), np.linalg.norm(p - self.end, axis=2))
        away = p - self.centre
        from_centre = np.linalg.norm(away, axis=2)
        # The foot lies on the arc when its angle from the middle of the arc is at most half the sweep.
        middle = np.arctan2(*(self.start - self.centre).T[::-1]) + self.sweep / 2
        off = np.arctan2(away[:, :, 1], away[:, :, 0]) - middle
        off = np.abs((off + np.pi) % (2 * np.pi) - np.pi)
        on_arc = off <= np.abs(self.sweep) / 2
        chord = self.end - self.start
        t = ((p - self.start) * chord).sum(axis=2) / (chord**2).sum(axis=1)
        foot = self.start + np.clip(t, 0, 1)[:, :, None] * chord
        to_line = np.linalg.norm(p - foot, axis=2)
        to_arc = np.where(on_arc, np.abs(from_centre - self.radius), to_end)
        return np.where(self.is_arc, to_arc, to_line).min(axis=1)
