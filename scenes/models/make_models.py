#!/usr/bin/env python3
"""Makes goblet.glb and ring.glb, surfaces of revolution about +y with exact normals, and diamond.glb, a polyhedron: all closed
and consistently oriented.

Usage: make_models.py (writes beside itself; needs nothing but Python 3). Lengths are in scene units.

The goblet has one material per interface, because a dielectric is described by what it separates:
  glass   glass against air
  wet     glass against water: the bowl below the water's level, front towards the water
  water   water against air: the level, front upwards
"""
import json
import math
import pathlib
import struct


def bezier(p0, p1, p2, p3, count):
    """count points (radius, height) of a cubic Bézier curve, both ends included."""
    points = []
    for i in range(count):
        t = i / (count - 1)
        weights = ((1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t * t * (1 - t), t ** 3)
        points.append(tuple(sum(w * p[k] for w, p in zip(weights, (p0, p1, p2, p3))) for k in (0, 1)))
    return points


def join(*curves):
    """One profile from curves that share their end points."""
    profile = list(curves[0])
    for curve in curves[1:]:
        profile += curve[1:]
    return profile


def tangents(profile):
    """Unit tangents by central differences; on the axis the profile is level."""
    result = []
    for i, point in enumerate(profile):
        before, after = profile[max(i - 1, 0)], profile[min(i + 1, len(profile) - 1)]
        dr, dy = after[0] - before[0], after[1] - before[1]
        if point[0] == 0:
            dr, dy = math.copysign(1.0, dr), 0.0
        length = math.hypot(dr, dy)
        result.append((dr / length, dy / length))
    return result


def plain(_y, _angle):
    return 1.0, 0.0


def lathe(profile, segments, profile_tangents=None, flutes=plain):
    """Turns a profile, whose front lies on its right-hand side, about +y: (positions, normals, triangle indices).

    flutes(y, angle) is the factor on the radius and its derivative by the angle; with flutes, tangents are computed.
    """
    count = len(profile)
    columns = []
    for s in range(segments):
        angle = 2 * math.pi * s / segments
        c, n = math.cos(angle), math.sin(angle)
        factors = [flutes(y, angle) for _, y in profile]
        outline = [(r * f, y) for (r, y), (f, _) in zip(profile, factors)]
        column = []
        for (r, y), (tr, ty), (f, df) in zip(outline, profile_tangents or tangents(outline), factors):
            across = -ty * df / f  # along increasing angle: the normal is P_t x P_angle
            length = math.hypot(1.0, across)
            normal = ((ty * c - across * n) / length, -tr / length, (ty * n + across * c) / length)
            column.append(((r * c, y, r * n), normal))
        columns.append(column)
    positions = [columns[s][i][0] for i in range(count) for s in range(segments)]
    normals = [columns[s][i][1] for i in range(count) for s in range(segments)]
    indices = []
    for i in range(count - 1):
        for s in range(segments):
            a, b = i * segments + s, i * segments + (s + 1) % segments
            c, d = a + segments, b + segments
            if profile[i][0] > 0:
                indices.append((a, c, b))
            if profile[i + 1][0] > 0:
                indices.append((b, c, d))
    return positions, normals, indices


def merge(first, second):
    """Both surfaces as one."""
    offset = len(first[0])
    return first[0] + second[0], first[1] + second[1], first[2] + [tuple(i + offset for i in t) for t in second[2]]


def write_glb(path, parts):
    """Writes {material name: (positions, normals or None, indices)} as one binary glTF 2.0 file with a mesh per material."""
    blob, views, accessors, primitives = b"", [], [], []

    def add(data, component_type, kind, count, **bounds):
        nonlocal blob
        views.append({"buffer": 0, "byteOffset": len(blob), "byteLength": len(data)})
        accessors.append({"bufferView": len(views) - 1, "componentType": component_type, "type": kind, "count": count, **bounds})
        blob += data + b"\0" * (-len(data) % 4)
        return len(accessors) - 1

    for material, (positions, normals, indices) in enumerate(parts.values()):
        bounds = {"min": [min(p[k] for p in positions) for k in range(3)], "max": [max(p[k] for p in positions) for k in range(3)]}
        attributes = {"POSITION": add(b"".join(struct.pack("<3f", *p) for p in positions), 5126, "VEC3", len(positions), **bounds)}
        if normals:
            attributes["NORMAL"] = add(b"".join(struct.pack("<3f", *n) for n in normals), 5126, "VEC3", len(normals))
        primitives.append({
            "material": material,
            "attributes": attributes,
            "indices": add(b"".join(struct.pack("<3H", *t) for t in indices), 5123, "SCALAR", 3 * len(indices)),
        })
    document = {
        "asset": {"version": "2.0", "generator": "make_models.py"}, "scene": 0, "scenes": [{"nodes": list(range(len(parts)))}],
        "nodes": [{"mesh": i, "name": name} for i, name in enumerate(parts)],
        "meshes": [{"primitives": [primitive]} for primitive in primitives],
        "materials": [{"name": name} for name in parts],
        "buffers": [{"byteLength": len(blob)}], "bufferViews": views, "accessors": accessors,
    }
    text = json.dumps(document, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    path.write_bytes(struct.pack("<3I", 0x46546C67, 2, 28 + len(text) + len(blob)) + struct.pack("<2I", len(text), 0x4E4F534A)
                     + text + struct.pack("<2I", len(blob), 0x004E4942) + blob)


def swirl(y, angle):
    """Fourteen flutes that wind about the bowl and fade out at its foot and lip."""
    low, high, depth, count = 0.82, 2.05, 0.016, 14
    if not low < y < high:
        return 1.0, 0.0
    depth *= math.sin(math.pi * (y - low) / (high - low)) ** 2
    phase = count * (angle + 0.55 * (y - low))
    return 1.0 + depth * math.cos(phase), -depth * count * math.sin(phase)


def goblet():
    """A wine glass 2.3 high, filled to 1.6, its bowl fluted: outside from the foot's centre to the rim, inside from the rim down."""
    foot = join([(0, 0.0), (0.3, 0.0), (0.6, 0.0)], bezier((0.6, 0), (0.635, 0), (0.635, 0.04), (0.6, 0.045), 7),
                bezier((0.6, 0.045), (0.3, 0.07), (0.075, 0.1), (0.06, 0.35), 14))
    stem = bezier((0.06, 0.35), (0.05, 0.55), (0.05, 0.65), (0.06, 0.8), 6)
    bowl = bezier((0.06, 0.8), (0.09, 1.02), (0.68, 0.95), (0.68, 1.5), 26)
    lip = bezier((0.68, 1.5), (0.68, 1.85), (0.52, 2.1), (0.5, 2.28), 20)
    rim = bezier((0.5, 2.28), (0.498, 2.3), (0.472, 2.3), (0.47, 2.28), 6)
    dry = bezier((0.47, 2.28), (0.49, 2.08), (0.63, 1.85), (0.62, 1.5), 14)
    bottom = bezier((0.62, 1.5), (0.61, 1.08), (0.3, 1.04), (0, 1.04), 22)
    outside, inside = join(foot, stem, bowl, lip, rim), join(dry, bottom)
    level = next(i for i, point in enumerate(inside) if point[1] < 1.62)
    slopes = tangents(inside)
    slopes[0] = (0.0, -1.0)
    radius, height = inside[level]
    shell = merge(lathe(outside, 112, flutes=swirl), lathe(inside[:level + 1], 112, slopes[:level + 1]))
    return {
        "glass": shell,
        "wet": lathe(inside[level:], 112, slopes[level:]),
        "water": lathe([(radius, height), (0, height)], 112, [(-1, 0), (-1, 0)]),
    }


def ring():
    """A band of outer radius 0.6 and height 0.19 with rounded edges, lying on the ground."""
    inner, outer, height, r = 0.53, 0.6, 0.19, 0.03
    outline = []
    for centre_r, centre_y, start in ((outer - r, r, -90), (outer - r, height - r, 0), (inner + r, height - r, 90), (inner + r, r, 180)):
        for step in range(7):
            angle = math.radians(start + 15 * step)
            outline.append((centre_r + r * math.cos(angle), centre_y + r * math.sin(angle), math.cos(angle), math.sin(angle)))
    outline.append(outline[0])
    return {"metal": lathe([p[:2] for p in outline], 96, [(-p[3], p[2]) for p in outline])}


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def unit(v):
    length = math.sqrt(dot(v, v))
    return tuple(x / length for x in v)


def clipped(polygon, normal, distance):
    """The part of a convex polygon where normal·p ≤ distance."""
    result = []
    for p, q in zip(polygon, polygon[1:] + polygon[:1]):
        dp, dq = dot(normal, p) - distance, dot(normal, q) - distance
        if dp <= 1e-9:
            result.append(p)
        if (dp < -1e-9 and dq > 1e-9) or (dp > 1e-9 and dq < -1e-9):
            t = dp / (dp - dq)
            result.append(tuple(a + t * (b - a) for a, b in zip(p, q)))
    return result


def convex(planes):
    """The body that planes (unit normal outwards, distance) bound: (positions, None, triangle indices)."""
    positions, triangles = [], []

    def vertex(p):
        for i, known in enumerate(positions):
            if max(abs(a - b) for a, b in zip(p, known)) < 1e-6:
                return i
        positions.append(p)
        return len(positions) - 1

    for at, (normal, distance) in enumerate(planes):
        u = unit(cross(normal, (1, 0, 0) if abs(normal[0]) < 0.6 else (0, 1, 0)))
        v = cross(normal, u)
        polygon = [tuple(distance * n + 9 * (su * a + sv * b) for n, a, b in zip(normal, u, v))
                   for su, sv in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
        for other, (n, d) in enumerate(planes):
            if other != at and polygon:
                polygon = clipped(polygon, n, d)
        corners = []
        for i in map(vertex, polygon):
            if i not in corners:
                corners.append(i)
        triangles += [(corners[0], corners[i], corners[i + 1]) for i in range(1, len(corners) - 1)]
    return positions, None, triangles


def diamond():
    """A round brilliant of 57 facets, Tolkowsky's angles about: girdle of radius 1 about the origin, table towards +y."""
    crown, pavilion = math.radians(34.5), math.radians(40.75)
    girdle, table, star, lower = 0.02, 0.56, 0.76, 0.22  # half its thickness; radii of the table's corners, of the facets' tips

    def at(radius, height, steps):
        """steps: of a sixteenth of a turn."""
        angle = math.pi / 8 * steps
        return radius * math.cos(angle), height, radius * math.sin(angle)

    def through(a, b, c):
        n = unit(cross(tuple(y - x for x, y in zip(a, b)), tuple(z - x for x, z in zip(a, c))))
        d = dot(n, a)
        return (n, d) if d > 0 else (tuple(-x for x in n), -d)

    half = math.cos(math.pi / 8)
    top = girdle + math.tan(crown) * (1 - table)
    tip = girdle + math.tan(crown) * (1 - star * half)
    low = -girdle - math.tan(pavilion) * (1 - lower * half)
    planes = [((0, 1, 0), top)]
    for k in range(0, 16, 2):
        bezel, main = at(math.sin(crown), math.cos(crown), k), at(math.sin(pavilion), -math.cos(pavilion), k)
        planes.append((bezel, math.sin(crown) + math.cos(crown) * girdle))
        planes.append((main, math.sin(pavilion) + math.cos(pavilion) * girdle))
        planes.append(through(at(table, top, k), at(table, top, k + 2), at(star, tip, k + 1)))
        for side in (k, k + 2):
            planes.append(through(at(star, tip, k + 1), at(1, girdle, side), at(1, girdle, k + 1)))
            planes.append(through(at(lower, low, k + 1), at(1, -girdle, side), at(1, -girdle, k + 1)))
    planes += [(at(1, 0, k / 5 + 0.1), 1) for k in range(80)]
    return {"diamond": convex(planes)}


if __name__ == "__main__":
    here = pathlib.Path(__file__).parent
    write_glb(here / "goblet.glb", goblet())
    write_glb(here / "ring.glb", ring())
    write_glb(here / "diamond.glb", diamond())
