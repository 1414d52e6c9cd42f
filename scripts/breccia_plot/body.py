"""The nominal body, centre at the origin, axis z, and the directions it is looked at from."""
from dataclasses import dataclass

import numpy as np


@dataclass
class Body:
    shape: str  # "cylinder", "disc" (looked at along its axis), "box"
    half: np.ndarray  # half sizes along x, y, z; m

    @classmethod
    def of(cls, specimen, frame):
        """As the summary names it; what is not named is measured from the spheres."""
        reach = np.abs(frame.reference) + frame.radius[:, None]
        measured = np.percentile(reach, 99.9, axis=0)
        width = specimen.get("diameter_m") or 2 * max(measured[:2])
        depth = specimen.get("depth_m") or width
        height = specimen.get("height_m") or 2 * measured[2]
        shape = specimen.get("shape") or ("cylinder" if height > 0.8 * width else "disc")
        return cls(shape, np.array([width, depth, height]) / 2)

    def edges(self, toward):
        """Polylines of the outline, each with whether it is in sight of an eye far away in the direction `toward`."""
        return self.box_edges(toward) if self.shape == "box" else self.round_edges(toward)

    def round_edges(self, toward):
        across, along = np.hypot(*toward[:2]), toward[2]
        if across < 1e-9:
            return [(self.rim(np.linspace(0, 2 * np.pi, 121), 1), True)]
        facing = np.arctan2(toward[1], toward[0])
        front, back = facing + np.linspace(-0.5, 0.5, 61) * np.pi, facing + np.linspace(0.5, 1.5, 61) * np.pi
        edges = [(np.concatenate([self.rim(facing + side * np.pi / 2, end) for end in (-1, 1)]), True) for side in (-1, 1)]
        for end in (-1, 1):
            edges += [(self.rim(front, end), True), (self.rim(back, end), end * along >= -1e-9)]
        return edges

    def rim(self, angle, end):
        angle = np.atleast_1d(angle)
        return np.stack([self.half[0] * np.cos(angle), self.half[0] * np.sin(angle), np.full(angle.shape, end * self.half[2])], 1)

    def box_edges(self, toward):
        corners = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
        hidden = corners[np.argmin(corners @ toward)]  # the corner farthest away
        pairs = [(a, b) for i, a in enumerate(corners) for b in corners[:i] if np.abs(a - b).sum() == 2]
        return [(np.array(pair) * self.half, not any((end == hidden).all() for end in pair)) for pair in pairs]


@dataclass
class View:
    """An orthographic view: unit vectors to the right, up, and towards the eye."""
    right: np.ndarray
    up: np.ndarray
    toward: np.ndarray

    def flat(self, points):
        return np.stack([points @ self.right, points @ self.up], axis=-1)

    def turned(self, yaw, pitch):
        """From a little to the side and above; degrees."""
        yaw, pitch = np.radians([yaw, pitch])
        right = np.cos(yaw) * self.right + np.sin(yaw) * self.toward
        toward = np.cos(yaw) * self.toward - np.sin(yaw) * self.right
        return View(right, np.cos(pitch) * self.up - np.sin(pitch) * toward, np.cos(pitch) * toward + np.sin(pitch) * self.up)


def face_on(body, cracks):
    """The view square to the cut. A disc is cut at mid-thickness, a cylinder through its axis such that the plane
    that fits the cracks best is seen edge-on: a shear band shows its dip."""
    x, y, z = np.eye(3)
    if body.shape == "disc":
        return View(x, y, z)
    right = x
    if body.shape == "cylinder" and len(cracks) > 2:
        _, axes = np.linalg.eigh(np.cov(cracks.T))
        normal = axes[:, 0] * [1, 1, 0]
        if np.linalg.norm(normal) > 0.1:
            right = normal / np.linalg.norm(normal)
    return View(right, z, np.cross(right, z))
