"""The nominal body, centre at the origin, loaded along z, and the directions it is looked at from."""
from dataclasses import dataclass

import numpy as np


@dataclass
class Body:
    shape: str  # "cylinder" (axis z), "disc" (axis y, along which it is looked at), "box", "plane" (two dimensions, x and z)
    half: np.ndarray  # half sizes along x, y, z; m

    @classmethod
    def of(cls, shape, spheres):
        """Sizes are measured from the spheres; so is the shape where its name is not known."""
        half = np.percentile(np.abs(spheres.reference) + spheres.radius[:, None], 99.9, axis=0)
        if np.ptp(spheres.reference[:, 1]) < 1e-9 * half[2]:
            return cls("plane", half)
        shape = shape or ("disc" if half[1] < 0.8 * min(half[0], half[2]) else "cylinder")
        if shape == "disc":
            half[[0, 2]] = max(half[0], half[2])
        if shape == "cylinder":
            half[:2] = max(half[:2])
        return cls(shape, half)

    def edges(self, toward):
        """Polylines of the outline, each with whether it is in sight of an eye far away in the direction `toward`."""
        if self.shape == "plane":
            corners = np.array([(-1, 0, -1), (1, 0, -1), (1, 0, 1), (-1, 0, 1), (-1, 0, -1)])
            return [(corners * self.half, True)]
        return self.box_edges(toward) if self.shape == "box" else self.round_edges(toward)

    def round_edges(self, toward):
        toward = toward[self.axes]
        across, along = np.hypot(*toward[:2]), toward[2]
        if across < 1e-9:
            return [(self.rim(np.linspace(0, 2 * np.pi, 121), 1), True)]
        facing = np.arctan2(toward[1], toward[0])
        front, back = facing + np.linspace(-0.5, 0.5, 61) * np.pi, facing + np.linspace(0.5, 1.5, 61) * np.pi
        edges = [(np.concatenate([self.rim(facing + side * np.pi / 2, end) for end in (-1, 1)]), True) for side in (-1, 1)]
        for end in (-1, 1):
            edges += [(self.rim(front, end), True), (self.rim(back, end), end * along >= -1e-9)]
        return edges

    @property
    def axes(self):
        """Two directions across the axis, and the axis."""
        return [0, 2, 1] if self.shape == "disc" else [0, 1, 2]

    def rim(self, angle, end):
        angle = np.atleast_1d(angle)
        unit = np.stack([np.cos(angle), np.sin(angle), np.full(angle.shape, end)], 1)
        return unit[:, self.axes] * self.half  # exchanging two axes is its own inverse

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
    right = x
    if body.shape == "cylinder" and len(cracks) > 2:
        _, axes = np.linalg.eigh(np.cov(cracks.T))
        normal = axes[:, 0] * [1, 1, 0]
        if np.linalg.norm(normal) > 0.1:
            right = normal / np.linalg.norm(normal)
    return View(right, z, np.cross(right, z))
