"""From a distance field to triangles: marching tetrahedra over the half space x >= 0, on a sparse grid."""
import numpy as np

# The six tetrahedra round the main diagonal of a cube; they agree across the faces of neighbouring cubes.
_CORNERS = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]])
_TETRAHEDRA = np.array([[0, 5, 1, 6], [0, 1, 2, 6], [0, 2, 3, 6], [0, 3, 7, 6], [0, 7, 4, 6], [0, 4, 5, 6]])


def _near_cells(field, low, cells, cell, block=8):
    """Indices of the grid cells in blocks that the surface may pass."""
    blocks = -(-np.array(cells) // block)
    index = np.stack(np.meshgrid(*[np.arange(n) for n in blocks], indexing="ij"), -1).reshape(-1, 3)
    reach = 0.5 * block * cell * np.sqrt(3) * 1.6
    index = index[np.abs(field(low + (index + 0.5) * block * cell)) < reach]
    inner = np.stack(np.meshgrid(*[np.arange(block)] * 3, indexing="ij"), -1).reshape(-1, 3)
    return (index[:, None] * block + inner[None]).reshape(-1, 3)


def _edge_table(tetrahedra, inside):
    """Triangles as triples of (grid vertex inside, grid vertex outside) pairs."""
    count = inside.sum(axis=1)
    pairs = []
    for lone_inside in (True, False):
        pick = count == (1 if lone_inside else 3)
        tets, flags = tetrahedra[pick], inside[pick] == lone_inside
        lone = np.argmax(flags, axis=1)
        others = np.array([[1, 2, 3], [0, 2, 3], [0, 1, 3], [0, 1, 2]])[lone]
        rows = np.arange(len(tets))
        pairs.append(np.stack([np.stack([tets[rows, lone], tets[rows, others[:, k]]], -1) for k in range(3)], 1))
    pick = count == 2
    tets, order = tetrahedra[pick], np.argsort(~inside[pick], axis=1, kind="stable")
    a, b, c, d = np.take_along_axis(tets, order, axis=1).T
    pairs.append(np.stack([np.stack(x, -1) for x in ((a, c), (b, c), (b, d))], 1))
    pairs.append(np.stack([np.stack(x, -1) for x in ((a, c), (b, d), (a, d))], 1))
    return np.vstack(pairs)


def polygonise(field, low, high, cell):
    """Vertices (N, 3) and triangles (M, 3), outward; the mesh is open in the plane x = low[0] only."""
    low = np.array(low, dtype=float)
    cells = np.ceil((np.array(high) - low) / cell).astype(int)
    index = _near_cells(field, low, cells, cell)
    stride = cells + 32
    corner = index[:, None] + _CORNERS[None]
    key = (corner[..., 0] * stride[1] + corner[..., 1]) * stride[2] + corner[..., 2]
    keys, flat = np.unique(key, return_inverse=True)
    grid = np.stack([keys // (stride[1] * stride[2]), keys // stride[2] % stride[1], keys % stride[2]], -1)
    positions = low + grid * cell
    values = field(positions)
    values = np.where(np.abs(values) < 1e-7, 1e-7, values)
    tetrahedra = flat.reshape(key.shape)[:, _TETRAHEDRA].reshape(-1, 4)
    inside = values[tetrahedra] < 0
    crossing = inside.any(axis=1) & ~inside.all(axis=1)
    pairs = _edge_table(tetrahedra[crossing], inside[crossing])
    pairs = np.sort(pairs, axis=-1)
    edges, triangles = np.unique(pairs.reshape(-1, 2), axis=0, return_inverse=True)
    a, b = values[edges[:, 0]], values[edges[:, 1]]
    t = np.clip(a / (a - b), 0.02, 0.98)[:, None]
    vertices = positions[edges[:, 0]] * (1 - t) + positions[edges[:, 1]] * t
    triangles = triangles.reshape(-1, 3)
    return vertices, _outward(field, vertices, triangles, cell)


def _outward(field, vertices, triangles, cell):
    p = vertices[triangles]
    normal = np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])
    normal /= np.linalg.norm(normal, axis=1, keepdims=True) + 1e-20
    centre = p.mean(axis=1)
    step = 0.3 * cell
    inward = field(centre + step * normal) < field(centre - step * normal)
    triangles = triangles.copy()
    triangles[inward] = triangles[inward][:, ::-1]
    return triangles


def project(field, gradient, vertices, rounds=4):
    """Moves the vertices onto the surface; those in the plane x = 0 stay in it."""
    seam = vertices[:, 0] == 0
    for _ in range(rounds):
        slope = gradient(field, vertices)
        slope[seam, 0] = 0
        step = field(vertices) / np.maximum((slope ** 2).sum(axis=1), 0.05)
        vertices = vertices - np.clip(step, -0.01, 0.01)[:, None] * slope
    return vertices
