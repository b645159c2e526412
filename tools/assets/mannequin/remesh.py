"""Isotropic remeshing (split, collapse, flip, relax, project) of a half figure, after Botsch and Kobbelt,
"A Remeshing Approach to Multiresolution Modeling" (2004), with an edge length that varies over the body.

The half mesh is open in the plane x = 0. Its border vertices stay in that plane, so that mirroring closes it.
"""
import numpy as np


class EditableMesh:
    """Triangles with vertex-to-face adjacency in plain lists and sets: the edits are local and sequential."""

    def __init__(self, vertices, triangles):
        self.points = [tuple(p) for p in vertices.tolist()]
        self.faces = [tuple(f) for f in triangles.tolist()]
        self.star = [set() for _ in self.points]
        for index, face in enumerate(self.faces):
            for v in face:
                self.star[v].add(index)

    def compact(self):
        """Arrays without the removed vertices and faces."""
        faces = [f for f in self.faces if f is not None]
        used = sorted({v for f in faces for v in f})
        rename = {v: i for i, v in enumerate(used)}
        return (np.array([self.points[v] for v in used]), np.array([[rename[v] for v in f] for f in faces], dtype=int))

    def ring(self, v):
        return {w for f in self.star[v] for w in self.faces[f] if w != v}

    def shared(self, a, b):
        return sorted(self.star[a] & self.star[b])

    def edges(self):
        found = {(min(a, b), max(a, b)) for f in self.faces if f is not None for a, b in zip(f, f[1:] + f[:1])}
        return sorted(found)

    def length(self, a, b):
        p, q = self.points[a], self.points[b]
        return ((p[0] - q[0]) ** 2 + (p[1] - q[1]) ** 2 + (p[2] - q[2]) ** 2) ** 0.5

    def replace(self, index, face):
        for v in self.faces[index] or ():
            self.star[v].discard(index)
        self.faces[index] = face
        for v in face or ():
            self.star[v].add(index)

    def add(self, face):
        self.faces.append(None)
        self.replace(len(self.faces) - 1, face)


def _normal(p, q, r):
    ax, ay, az = q[0] - p[0], q[1] - p[1], q[2] - p[2]
    bx, by, bz = r[0] - p[0], r[1] - p[1], r[2] - p[2]
    return ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx


def _turned(before, after):
    """True when a triangle's normal turns by more than about 60 degrees, or the triangle all but vanishes."""
    dot = before[0] * after[0] + before[1] * after[1] + before[2] * after[2]
    n0 = (before[0] ** 2 + before[1] ** 2 + before[2] ** 2) ** 0.5
    n1 = (after[0] ** 2 + after[1] ** 2 + after[2] ** 2) ** 0.5
    return dot < 0.5 * n0 * n1 or n1 < 1e-9


def _can_collapse(mesh, a, b, target, limit):
    """Keeps the surface a manifold (link condition), unfolded, and without edges longer than `limit`."""
    if len(mesh.ring(a) & mesh.ring(b)) != len(mesh.shared(a, b)):
        return False
    points, gone = mesh.points, set(mesh.shared(a, b))
    for v in (a, b):
        for f in mesh.star[v]:
            if f in gone:
                continue
            corners = [points[w] for w in mesh.faces[f]]
            moved = [target if w == v else points[w] for w in mesh.faces[f]]
            if _turned(_normal(*corners), _normal(*moved)):
                return False
            for p in moved:
                if sum((x - y) ** 2 for x, y in zip(p, target)) > limit * limit:
                    return False
    return True


def collapse_short(mesh, size):
    count = 0
    for a, b in mesh.edges():
        if not mesh.star[a] or not mesh.star[b]:
            continue
        shared = mesh.shared(a, b)
        wanted = 0.5 * (size[a] + size[b])
        if not shared or mesh.length(a, b) > 0.8 * wanted:
            continue
        seam_a, seam_b = mesh.points[a][0] == 0, mesh.points[b][0] == 0
        if seam_a and seam_b and len(shared) == 2:
            continue
        if seam_b and not seam_a:
            a, b, seam_a, seam_b = b, a, True, False
        p, q = mesh.points[a], mesh.points[b]
        target = p if seam_a and not seam_b else tuple(0.5 * (x + y) for x, y in zip(p, q))
        if not _can_collapse(mesh, a, b, target, 4 / 3 * wanted):
            continue
        for f in shared:
            mesh.replace(f, None)
        for f in sorted(mesh.star[b]):
            mesh.replace(f, tuple(a if w == b else w for w in mesh.faces[f]))
        mesh.points[a] = target
        size[a] = wanted
        count += 1
    return count


def split_long(mesh, size):
    for a, b in mesh.edges():
        wanted = 0.5 * (size[a] + size[b])
        if mesh.length(a, b) > 4 / 3 * wanted:
            split_edge(mesh, a, b, 0.5)
            size.append(wanted)


def split_edge(mesh, a, b, t):
    """Puts a vertex at a + t (b - a) and returns its index."""
    p, q = mesh.points[a], mesh.points[b]
    mesh.points.append(tuple(x + t * (y - x) for x, y in zip(p, q)))
    mesh.star.append(set())
    middle = len(mesh.points) - 1
    for f in mesh.shared(a, b):
        face = mesh.faces[f]
        mesh.replace(f, tuple(middle if w == b else w for w in face))
        mesh.add(tuple(middle if w == a else w for w in face))
    return middle


def flip_for_valence(mesh):
    valence = [len(s) for s in mesh.star]
    ideal = [4 if p[0] == 0 else 6 for p in mesh.points]
    for v, p in enumerate(mesh.points):
        if p[0] == 0:
            valence[v] += 1
    for a, b in mesh.edges():
        shared = mesh.shared(a, b)
        if len(shared) != 2:
            continue
        f, g = shared
        face = mesh.faces[f]
        if face[(face.index(a) + 1) % 3] != b:
            f, g = g, f
        c = next(w for w in mesh.faces[f] if w not in (a, b))
        d = next(w for w in mesh.faces[g] if w not in (a, b))
        if c == d or d in mesh.ring(c):
            continue
        change = sum(abs(valence[v] + s - ideal[v]) - abs(valence[v] - ideal[v])
                     for v, s in ((a, -1), (b, -1), (c, 1), (d, 1)))
        if change >= 0 or not _flip_is_flat(mesh, a, b, c, d):
            continue
        mesh.replace(f, (a, d, c))
        mesh.replace(g, (d, b, c))
        for v, s in ((a, -1), (b, -1), (c, 1), (d, 1)):
            valence[v] += s


def _flip_is_flat(mesh, a, b, c, d):
    pa, pb, pc, pd = (mesh.points[v] for v in (a, b, c, d))
    mean = tuple(x + y for x, y in zip(_normal(pa, pb, pc), _normal(pb, pa, pd)))
    first, second = _normal(pa, pd, pc), _normal(pd, pb, pc)
    return not (_turned(mean, first) or _turned(mean, second))


def relax(vertices, triangles, normals, rate=0.6):
    """Moves each vertex towards its neighbours' mean, within the tangent plane."""
    total, weight = np.zeros_like(vertices), np.zeros(len(vertices))
    for i in range(3):
        for j in range(3):
            if i != j:
                np.add.at(total, triangles[:, i], vertices[triangles[:, j]])
                np.add.at(weight, triangles[:, i], 1)
    shift = total / weight[:, None] - vertices
    seam = vertices[:, 0] == 0
    # A border vertex is drawn off its even spacing by inner neighbours: it moves half as far.
    shift[seam, 0], shift[seam] = 0, 0.5 * shift[seam]
    shift -= (shift * normals).sum(axis=1, keepdims=True) * normals
    shift[seam, 0] = 0
    return vertices + rate * shift


def remesh(vertices, triangles, size_of, project, normals_of, rounds=6):
    """`size_of` gives the wanted edge length at points; `project` puts points on the surface; `normals_of` its normals."""
    mesh = EditableMesh(vertices, triangles)
    for _ in range(12):
        removed = collapse_short(mesh, size_of(np.array(mesh.points)).tolist())
        vertices, triangles = mesh.compact()
        mesh = EditableMesh(project(vertices), triangles)
        if removed < 0.01 * len(vertices):
            break
    for _ in range(rounds):
        split_long(mesh, size_of(np.array(mesh.points)).tolist())
        collapse_short(mesh, size_of(np.array(mesh.points)).tolist())
        flip_for_valence(mesh)
        vertices, triangles = mesh.compact()
        for _ in range(2):
            vertices = project(relax(vertices, triangles, normals_of(vertices)))
        mesh = EditableMesh(vertices, triangles)
    return vertices, triangles


def cut(vertices, triangles, field, project):
    """Inserts the zero line of `field` (a function of points) as edges, so that a region can end in a clean border."""
    value = field(vertices)
    mesh = EditableMesh(vertices, triangles)
    edges = np.array(mesh.edges())
    crossing = edges[(value[edges[:, 0]] < 0) != (value[edges[:, 1]] < 0)]
    points, snapped = vertices.copy(), set()
    for a, b in crossing.tolist():
        t = value[a] / (value[a] - value[b])
        for v, near, w in ((a, t, b), (b, 1 - t, a)):
            # Slivers are avoided by moving a vertex that is near the line onto it; seam vertices only along the seam.
            if near < 0.3 and v not in snapped and w not in snapped and (vertices[v][0] > 0 or vertices[w][0] == 0):
                points[v] = vertices[v] + near * (vertices[w] - vertices[v])
                snapped.add(v)
                break
    value[sorted(snapped)] = 0
    mesh = EditableMesh(points, triangles)
    for a, b in crossing.tolist():
        if value[a] * value[b] < 0 and mesh.shared(a, b):
            split_edge(mesh, a, b, value[a] / (value[a] - value[b]))
    vertices, triangles = mesh.compact()
    return project(vertices), triangles
