# SPDX-License-Identifier: BSL-1.0
"""Invented movies with every kind of shape, as MovieSeries writes them."""
import json
import math

WORDS = {"title": "Every kind <b>of</b> shape", "scalar": "load", "unit": "mean grain weights"}


def header(dimension, **changed):
    return {"format": "talus movie", "version": 1, "dimension": dimension, **WORDS, **changed}


def block(dimension, half):
    if dimension == 2:
        return {"vertices": [-half, -half, half, -half, -half, half, half, half], "faces": [[0, 1], [1, 3], [3, 2], [2, 0]]}
    corners = [half if i >> k & 1 else -half for i in range(8) for k in range(3)]
    return {"vertices": corners, "faces": [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]]}


def shapes(d):
    """(obstacle, shape) of every body: a floor and two walls, a hole, then what falls."""
    def along(axis, x=1.0):
        return [x if k == axis else 0.0 for k in range(d)]
    ball = {"kind": "ball", "radius": 0.4, "centre": [0.0] * d}
    segment = {"vertices": along(0, -0.4) + along(0, 0.4), "faces": [[0, 1], [1, 0]] if d == 2 else []}
    moved = {"kind": "ball", "radius": 0.25, "centre": along(0, 0.3)}
    return [
        (True, {"kind": "half_space", "normal": along(d - 1), "offset": 0.0}),
        (True, {"kind": "half_space", "normal": along(0), "offset": 0.0}),
        (True, {"kind": "half_space", "normal": along(0, -1.0), "offset": -8.0}),
        (True, {"kind": "hole", "radius": 9.0, "centre": along(0, 4.0), **({"axis": along(1)} if d == 3 else {})}),
        (True, {"kind": "unbounded"}),
        (True, {"kind": "core", "radius": 0.0, **block(d, 0.5)}),
        (False, ball),
        (False, {"kind": "core", "radius": 0.2, **segment}),
        (False, {"kind": "core", "radius": 0.0, **block(d, 0.4)}),
        (False, {"kind": "core", "radius": 0.1, **block(d, 0.3)}),
        (False, {"kind": "compound", "children": [moved, {"kind": "core", "radius": 0.0, **block(d, 0.25)}]}),
        (False, {"kind": "box", "low": [-0.4] * d, "high": [0.3] * d}),
        (False, ball),
    ]


def movie(dimension, frames=41, **changed):
    """The lines. The last body leaves in the middle, and its load is unknown before."""
    bodies = shapes(dimension)
    lines = [header(dimension, **changed)]
    lines += [{"body": 3 * i, "obstacle": obstacle, "shape": shape} for i, (obstacle, shape) in enumerate(bodies)]
    for k in range(frames):
        time = 0.05 * k
        present = [i for i in range(len(bodies)) if i + 1 < len(bodies) or k < frames // 2]
        positions, rotations, scalars = [], [], []
        for i in present:
            free = not bodies[i][0]
            x = [1.0 + 1.05 * (i - 6), 4.0 + 0.5 * (i % 2) - 0.9 * time * time] if free else [0.0, 0.0]
            if i == 5:
                x = [4.0, 0.5]
            angle = 0.7 * time * (i - 8) if free else 0.0
            positions += [x[0], x[1]] if dimension == 2 else [x[0], 0.3 * (i % 3), x[1]]
            rotations += [angle] if dimension == 2 else [0.0, math.sin(angle / 2), 0.0, math.cos(angle / 2)]
            scalars.append(None if i + 1 == len(bodies) else 2.0 * i * (0.3 + 0.35 * time) if free else 0.0)
        frame = {"time": time, "bodies": [3 * i for i in present], "positions": positions, "rotations": rotations}
        if lines[0]["scalar"]:
            frame["scalars"] = scalars
        lines.append(frame)
    return lines


def text(lines):
    return "".join(json.dumps(line, separators=(",", ":")) + "\n" for line in lines)
