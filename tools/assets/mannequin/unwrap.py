"""Texture coordinates: charts by body part, flattened by least squares conformal maps (Levy et al. 2002), packed in rows.

The left half fills u in [0, 0.5], the right half is its mirror image in [0.5, 1]; charts do not overlap.
"""
import numpy as np

MARGIN = 0.006


def _components(triangles, label):
    """Splits every label into edge-connected pieces; returns piece numbers."""
    owner, parent = {}, list(range(len(triangles)))

    def find(i):
        while parent[i] != i:
            parent[i] = parent[parent[i]]
            i = parent[i]
        return i

    for f, tri in enumerate(triangles.tolist()):
        for a, b in zip(tri, tri[1:] + tri[:1]):
            key = (min(a, b), max(a, b))
            if key in owner and label[owner[key]] == label[f]:
                parent[find(f)] = find(owner[key])
            owner.setdefault(key, f)
    return np.unique([find(f) for f in range(len(triangles))], return_inverse=True)[1]


def _neighbours(triangles):
    owner, result = {}, [[] for _ in triangles]
    for f, tri in enumerate(triangles.tolist()):
        for a, b in zip(tri, tri[1:] + tri[:1]):
            key = (min(a, b), max(a, b))
            if key in owner:
                result[f].append(owner[key])
                result[owner[key]].append(f)
            owner[key] = f
    return result


def charts(triangles, label, smallest=40):
    """Chart number of each triangle: pieces of `label`, the small ones given to the neighbour with the longest border."""
    label, near = label.copy(), _neighbours(triangles)
    for _ in range(6):
        piece = _components(triangles, label)
        small = np.flatnonzero(np.bincount(piece) < smallest)
        if not len(small):
            break
        for number in small:
            faces = np.flatnonzero(piece == number)
            around = [label[g] for f in faces for g in near[f] if piece[g] != number]
            if around:
                label[faces] = np.bincount(around).argmax()
    return _components(triangles, label)


def flatten(vertices, triangles):
    """Conformal plane coordinates of one chart, scaled to its true area, its long side upright."""
    p = vertices[triangles]
    e1, e2 = p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]
    x1 = np.linalg.norm(e1, axis=1)
    axis = e1 / x1[:, None]
    x2 = (e2 * axis).sum(axis=1)
    y2 = np.linalg.norm(e2 - x2[:, None] * axis, axis=1)
    area = .5 * x1 * y2
    # Rows of the conformal energy: sum over corners of W_j (u_j + i v_j), W the opposite edge as a complex number.
    w = np.stack([(x2 - x1) + 1j * y2, -x2 - 1j * y2, x1 + 0j], axis=1) / np.sqrt(2 * area)[:, None]
    count = len(vertices)
    system = np.zeros((len(triangles), count), dtype=complex)
    np.add.at(system, (np.arange(len(triangles))[:, None], triangles), w)
    spread = vertices - vertices.mean(axis=0)
    direction = np.linalg.svd(spread, full_matrices=False)[2][0]
    first, last = np.argmin(spread @ direction), np.argmax(spread @ direction)
    free = np.setdiff1d(np.arange(count), [first, last])
    fixed = np.array([0, np.linalg.norm(vertices[last] - vertices[first]) * 1j])
    left, right = system[:, free], -system[:, [first, last]] @ fixed
    plane = np.zeros(count, dtype=complex)
    plane[[first, last]] = fixed
    plane[free] = np.linalg.solve(left.conj().T @ left, left.conj().T @ right)
    q = np.column_stack([plane.real, plane.imag])
    flat = q[triangles]
    d1, d2 = flat[:, 1] - flat[:, 0], flat[:, 2] - flat[:, 0]
    signed = .5 * (d1[:, 0] * d2[:, 1] - d1[:, 1] * d2[:, 0])
    return q * np.sqrt(area.sum() / np.abs(signed.sum()))


def _rows(sizes, scale, width, height):
    """Corners of the rectangles packed in rows, or None if they do not fit."""
    place, x, y, row = np.zeros((len(sizes), 2)), MARGIN, MARGIN, 0.0
    for k in sorted(range(len(sizes)), key=lambda i: -sizes[i][1]):
        w, h = sizes[k] * scale
        if x + w + MARGIN > width:
            x, y, row = MARGIN, y + row + MARGIN, 0.0
        place[k], x, row = (x, y), x + w + MARGIN, max(row, h)
        if x > width or y + h + MARGIN > height:
            return None
    return place


def unwrap(vertices, triangles, chart):
    """(vertex, chart) pairs, their texture coordinates in [0, 0.5] x [0, 1], and triangles over the pairs."""
    key = triangles * (chart.max() + 1) + chart[:, None]
    pairs, corner = np.unique(key.ravel(), return_inverse=True)
    corner = corner.reshape(-1, 3)
    vertex, owner = pairs // (chart.max() + 1), pairs % (chart.max() + 1)
    plane, sizes = np.zeros((len(pairs), 2)), []
    for number in range(chart.max() + 1):
        mine = np.flatnonzero(owner == number)
        rename = np.full(len(pairs), -1)
        rename[mine] = np.arange(len(mine))
        q = flatten(vertices[vertex[mine]], rename[corner[chart == number]])
        plane[mine] = q - q.min(axis=0)
        sizes.append(plane[mine].max(axis=0))
    low, high = 0.0, 10.0
    for _ in range(40):
        middle = .5 * (low + high)
        low, high = (middle, high) if _rows(sizes, middle, .5, 1) is not None else (low, middle)
    place = _rows(sizes, low, .5, 1)
    uv = plane * low + place[owner]
    # glTF's v runs down the image.
    return vertex, np.column_stack([uv[:, 0], 1 - uv[:, 1]]), corner
