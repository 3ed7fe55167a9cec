"""An independent reading of .csg files, for checks: is a point in the solid, by the formulas of its primitives?

Shares nothing with the program. Lengths are mm, as in the files."""
import math
import re

TOKENS = re.compile(r"""\s+|//[^\n]*|/\*.*?\*/|(?P<number>-?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)|(?P<word>[$\w]+)|"""
                    r"""(?P<string>"[^"]*")|(?P<sign>.)""", re.S)
NEAR = 1e-6  # mm: points this near to a surface of a primitive are left undecided


class Undecided(Exception):
    pass


def tokens(text):
    return [match.group() for match in TOKENS.finditer(text) if match.lastgroup]


class Reader:
    def __init__(self, text):
        self.tokens = tokens(text)
        self.at = 0

    def take(self, wanted=None):
        token = self.tokens[self.at]
        assert wanted in (None, token), f"{wanted} expected, not {token}"
        self.at += 1
        return token

    def value(self):
        token = self.take()
        if token == "[":
            items = []
            while self.tokens[self.at] != "]":
                items.append(self.value())
                if self.tokens[self.at] == ",":
                    self.take()
            self.take("]")
            return items
        constants = {"true": True, "false": False, "undef": None}
        return constants[token] if token in constants else token if token[0] == '"' else float(token)

    def arguments(self):
        given = {}
        self.take("(")
        while self.tokens[self.at] != ")":
            if self.tokens[self.at + 1] == "=":
                name = self.take()
                self.take("=")
            else:
                name = len(given)
            given[name] = self.value()
            if self.tokens[self.at] == ",":
                self.take()
        self.take(")")
        return given

    def statements(self):
        """All statements up to the closing brace or the end, without those that do not count."""
        found = []
        while self.at < len(self.tokens) and self.tokens[self.at] != "}":
            if self.tokens[self.at] == ";":
                self.take()
                continue
            marks = ""
            while self.tokens[self.at] in "*%#!":
                marks += self.take()
            name, given, children = self.take(), self.arguments(), []
            if self.take() == "{":
                children = self.statements()
                self.take("}")
            if not set(marks) & set("*%"):
                found.append(solid(name, given, children))
        return found


def read(text):
    """The solid: a function of a point that returns True or False, or raises Undecided. None when empty."""
    return union(Reader(text).statements())


# ---- Operations: functions of functions, None for what is empty -----------------------------------

def union(children):
    children = [child for child in children if child]
    # All are asked, so that a point near any surface is undecided.
    return (lambda point: any([child(point) for child in children])) if children else None


def intersection(children):
    if not children or None in children:
        return None
    return lambda point: all([child(point) for child in children])


def difference(children):
    if not children or children[0] is None:
        return None
    taken = [child for child in children[1:] if child]
    return lambda point: children[0](point) & (not any([child(point) for child in taken]))


def moved(matrix, child):
    rows = [row[:3] for row in matrix[:3]]
    cross = lambda a, b: [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    determinant = dot(rows[0], cross(rows[1], rows[2]))
    if abs(determinant) < 1e-12 or child is None:
        return None
    columns = [cross(rows[(i + 1) % 3], rows[(i + 2) % 3]) for i in range(3)]
    inverse = [[columns[j][i] / determinant for j in range(3)] for i in range(3)]
    shift = [row[3] for row in matrix[:3]]

    def inside(point):
        local = [point[i] - shift[i] for i in range(3)]
        return child([dot(row, local) for row in inverse])
    return inside


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def solid(name, given, children):
    if name in ("group", "union", "render", "color"):
        return union(children)
    return {"intersection": lambda: intersection(children), "difference": lambda: difference(children),
            "multmatrix": lambda: moved(given.get("m", given.get(0)), union(children)),
            "cube": lambda: cube(given), "sphere": lambda: sphere(given), "cylinder": lambda: cylinder(given),
            "polyhedron": lambda: polyhedron(given.get("points"), given.get("faces"))}[name]()


# ---- Primitives: by a distance-like function, negative inside ---------------------------------------

def bounded(distance):
    def inside(point):
        d = distance(point)
        if abs(d) < NEAR:
            raise Undecided
        return d < 0
    return inside


def cube(given):
    size = given["size"]
    if min(size) <= 0:
        return None
    middle = [0, 0, 0] if given["center"] else [s / 2 for s in size]
    return bounded(lambda p: max(abs(p[i] - middle[i]) - size[i] / 2 for i in range(3)))


def facets(given):
    count = given.get("$fn", 0)
    return int(count) if 3 <= count <= 16 else 0


def ring(radius, z, sides):
    return [[radius * math.cos(2 * math.pi * i / sides), radius * math.sin(2 * math.pi * i / sides), z]
            for i in range(sides)]


def convex(rings):
    """The convex solid around stacked rings of corners: the planes of its sides and lids."""
    planes = [([0, 0, -1], -rings[0][0][2]), ([0, 0, 1], rings[-1][0][2])]
    for low, high in zip(rings, rings[1:]):
        sides = len(low)
        for i in range(sides):
            along = math.pi * (2 * i + 1) / sides  # of the side's middle
            radii = [math.hypot(r[0][0], r[0][1]) * math.cos(math.pi / sides) for r in (low, high)]
            rise, run = high[0][2] - low[0][2], radii[1] - radii[0]
            length = math.hypot(rise, run)
            normal = [math.cos(along) * rise / length, math.sin(along) * rise / length, -run / length]
            planes.append((normal, dot(normal, [radii[0] * math.cos(along), radii[0] * math.sin(along), low[0][2]])))
    return bounded(lambda p: max(dot(normal, p) - offset for normal, offset in planes))


def sphere(given):
    radius, sides = given["r"], facets(given)
    if radius <= 0:
        return None
    if not sides:
        return bounded(lambda p: math.sqrt(dot(p, p)) - radius)
    count = (sides + 1) // 2
    polars = [math.pi * (i + 0.5) / count for i in reversed(range(count))]
    return convex([ring(radius * math.sin(polar), radius * math.cos(polar), sides) for polar in polars])


def cylinder(given):
    height, r1, r2, sides = given["h"], given["r1"], given["r2"], facets(given)
    if height <= 0 or min(r1, r2) < 0 or max(r1, r2) == 0:
        return None
    low = -height / 2 if given["center"] else 0
    if sides:
        return convex([ring(r1, low, sides), ring(r2, low + height, sides)])
    slope = (r2 - r1) / height
    return bounded(lambda p: max(low - p[2], p[2] - low - height,
                                 math.hypot(p[0], p[1]) - r1 - slope * (p[2] - low)))


def polyhedron(points, faces):
    if not points or not faces:
        return None
    corners = [[[points[int(i)][k] for k in range(3)] for i in face] for face in faces]
    planes = []
    for face in corners:  # Newell's normal: faces may be concave
        normal = [sum((a[(k + 1) % 3] - b[(k + 1) % 3]) * (a[(k + 2) % 3] + b[(k + 2) % 3])
                      for a, b in zip(face, face[1:] + face[:1])) for k in range(3)]
        planes.append((normal, dot(normal, face[0])))

    def inside(point):
        """Counts the faces that a ray in +x goes through: even-odd rule in the plane of y and z."""
        crossings = 0
        for face, (normal, offset) in zip(corners, planes):
            height = dot(normal, point) - offset
            if abs(height) < NEAR * math.sqrt(dot(normal, normal)):
                raise Undecided
            if normal[0] == 0 or height / normal[0] > 0:  # along the ray, or behind its start
                continue
            within = False
            for a, b in zip(face, face[1:] + face[:1]):
                if (a[2] > point[2]) != (b[2] > point[2]):
                    within ^= point[1] < a[1] + (b[1] - a[1]) * (point[2] - a[2]) / (b[2] - a[2])
            crossings += within
        return crossings % 2 == 1
    return inside
