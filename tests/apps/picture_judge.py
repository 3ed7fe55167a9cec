"""What textured scenes look like, worked out ray by ray from ISO/IEC 14772-1 (VRML 97) and the glTF 2.0
specification, without any of the program's code: the program's pictures and files are held to it."""
import json
import math
import struct
import zlib

# What displays show (sRGB), dark enough that nothing is bent towards white, and so that each has another hue.
HUES = {"r": (200, 20, 20), "g": (20, 180, 20), "b": (30, 30, 200), "y": (190, 180, 20), "m": (190, 20, 180),
        "c": (20, 170, 190)}


def linear(channel):
    """Light of a channel from 0 to 255 (IEC 61966-2-1)."""
    part = channel / 255.0
    return part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4


def shown(light):
    part = 12.92 * light if light <= 0.0031308 else 1.055 * light ** (1 / 2.4) - 0.055
    return 255.0 * part


def png(rows):
    """A file of rows, from the top, of pixels that all have as many channels: 1 to 4."""
    channels = len(rows[0][0])
    raw = b"".join(b"\0" + bytes(value for pixel in row for value in pixel) for row in rows)

    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
    head = struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, {1: 0, 2: 4, 3: 2, 4: 6}[channels], 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(raw)) +
            chunk(b"IEND", b""))


class Picture:
    """Texels as words of hues from the top, blown up so that a filter touches their rims only."""
    SIZE = 16  # pixels of a texel

    def __init__(self, words, texel=HUES.get):
        self.texels = [[tuple(texel(letter)) for letter in word] for word in words]

    def file(self):
        return png([[pixel for pixel in row for _ in range(self.SIZE)] for row in self.texels
                    for _ in range(self.SIZE)])

    def at(self, u, v):
        """The texel at (u, v) from the lower left, repeated."""
        high, wide = len(self.texels), len(self.texels[0])
        return self.texels[min(high - 1, int((1.0 - v % 1.0) * high))][min(wide - 1, int(u % 1.0 * wide))]


HALVES = Picture(["ab"], {"a": (20, 180, 20, 140), "b": (20, 180, 20, 220)}.get)


# ---- Where a picture lies (VRML 97, 6.6, 6.10, 6.11, 6.42): a point and the normal there to (u, v). ---------

def round_share(p):
    """Counter-clockwise from the back, seen from above."""
    return math.atan2(-p[0], -p[2]) / (2 * math.pi) % 1.0


def box_place(size):
    def place(p, n):
        x, y, z = (p[i] / size[i] for i in range(3))
        axis = max(range(3), key=lambda i: abs(n[i]))
        across, up = {(2, True): (x, y), (2, False): (-x, y), (0, True): (-z, y), (0, False): (z, y),
                      (1, True): (x, -z), (1, False): (x, z)}[axis, n[axis] > 0]
        return across + 0.5, up + 0.5
    return place


def sphere_place(radius):
    return lambda p, n: (round_share(p), 0.5 + math.asin(max(-1, min(1, p[1] / radius))) / math.pi)


def bar_place(radius, height):
    """Of cylinders and cones, with round pictures on their ends."""
    def place(p, n):
        if abs(n[1]) > 0.999:
            return 0.5 + 0.5 * p[0] / radius, 0.5 - math.copysign(0.5, n[1]) * p[2] / radius
        return round_share(p), 0.5 + p[1] / height
    return place


# ---- Rays: each gives the nearest hit as (t, point, normal), or nothing. ------------------------------------

def along(o, d, t):
    return tuple(o[i] + t * d[i] for i in range(3))


def hit_box(size):
    def hit(o, d):
        enter, leave, axis = -math.inf, math.inf, 0
        for i in range(3):
            if abs(d[i]) < 1e-12:
                if abs(o[i]) > size[i] / 2:
                    return None
                continue
            low, high = sorted(((-size[i] / 2 - o[i]) / d[i], (size[i] / 2 - o[i]) / d[i]))
            if low > enter:
                enter, axis = low, i
            leave = min(leave, high)
        if enter > leave or enter < 0:
            return None
        normal = tuple(-math.copysign(1, d[i]) if i == axis else 0.0 for i in range(3))
        return enter, along(o, d, enter), normal
    return hit


def hit_sphere(radius):
    def hit(o, d):
        b, c = sum(o[i] * d[i] for i in range(3)), sum(x * x for x in o) - radius * radius
        if b * b < c:
            return None
        t = -b - math.sqrt(b * b - c)
        p = along(o, d, t)
        return (t, p, tuple(x / radius for x in p)) if t > 0 else None
    return hit


def hit_bar(bottom, top, height):
    """A cylinder or a cone along y."""
    slope = (bottom - top) / height

    def hit(o, d):
        hits = []
        # x^2 + z^2 = (middle - slope y)^2
        middle = (bottom + top) / 2
        a = d[0] ** 2 + d[2] ** 2 - (slope * d[1]) ** 2
        b = o[0] * d[0] + o[2] * d[2] + slope * d[1] * (middle - slope * o[1])
        c = o[0] ** 2 + o[2] ** 2 - (middle - slope * o[1]) ** 2
        if abs(a) > 1e-12 and b * b >= a * c:
            for sign in (-1, 1):
                t = (-b + sign * math.sqrt(b * b - a * c)) / a
                p = along(o, d, t)
                if t > 0 and abs(p[1]) <= height / 2:
                    away = math.hypot(p[0], p[2]) or 1.0
                    size = math.hypot(1, slope)
                    hits.append((t, p, (p[0] / away / size, slope / size, p[2] / away / size)))
        for y, radius, up in ((height / 2, top, 1.0), (-height / 2, bottom, -1.0)):
            if abs(d[1]) > 1e-12:
                t = (y - o[1]) / d[1]
                p = along(o, d, t)
                if t > 0 and math.hypot(p[0], p[2]) <= radius:
                    hits.append((t, p, (0.0, up, 0.0)))
        return min(hits, default=None)
    return hit


def hit_square(half, z=0.0, x=0.0):
    """Upright, facing +z."""
    def hit(o, d):
        if abs(d[2]) < 1e-12:
            return None
        t = (z - o[2]) / d[2]
        p = along(o, d, t)
        return (t, p, (0.0, 0.0, 1.0)) if t > 0 and abs(p[0] - x) <= half and abs(p[1]) <= half else None
    return hit


class Camera:
    def __init__(self, eye, angle=0.7):
        """Looks at the origin, y up; `angle` is the picture's, which is square."""
        self.eye, self.angle = eye, angle
        size = math.sqrt(sum(x * x for x in eye))
        back = tuple(x / size for x in eye)
        flat = math.hypot(back[0], back[2])
        self.right = (back[2] / flat, 0.0, -back[0] / flat)
        self.up = (back[1] * self.right[2] - back[2] * self.right[1], back[2] * self.right[0] - back[0] *
                   self.right[2], back[0] * self.right[1] - back[1] * self.right[0])
        self.back = back

    def ray(self, x, y):
        """Through a place of the picture, in [-1, 1] from the lower left."""
        reach = math.tan(self.angle / 2)
        d = tuple(reach * x * self.right[i] + reach * y * self.up[i] - self.back[i] for i in range(3))
        size = math.sqrt(sum(v * v for v in d))
        return self.eye, tuple(v / size for v in d)

    def vrml(self):
        m = [self.right, self.up, self.back]  # columns
        turn = math.acos(max(-1, min(1, (m[0][0] + m[1][1] + m[2][2] - 1) / 2)))
        axis = (m[1][2] - m[2][1], m[2][0] - m[0][2], m[0][1] - m[1][0])
        if turn < 1e-6:
            axis = (0, 1, 0)
        elif turn > math.pi - 1e-6:
            axis = (0, 1, 0)  # back along -z: eyes of these tests have y up
        return ("Viewpoint { position %.9g %.9g %.9g orientation %.9g %.9g %.9g %.9g fieldOfView %.9g }\n" %
                (*self.eye, *axis, turn, self.angle))

    def gltf(self):
        matrix = [*self.right, 0, *self.up, 0, *self.back, 0, *self.eye, 1]
        return ({"camera": 0, "matrix": matrix},
                {"type": "perspective", "perspective": {"yfov": self.angle, "znear": 0.01, "aspectRatio": 1.0}})


class Thing:
    """A surface with what it shows: `colour(u, v)` gives linear light, or None for a hole."""

    def __init__(self, hit, place, colour):
        self.hit, self.place, self.colour = hit, place, colour

    def seen(self, ray):
        found = self.hit(*ray)
        if not found:
            return None
        light = self.colour(*self.place(found[1], found[2]))
        return (found[0], light) if light is not None else None


def light_at(things, ray):
    hits = [it for it in (thing.seen(ray) for thing in things) if it]
    return min(hits)[1] if hits else None


def texture(picture, frame=lambda u, v: (u, v), tint=(1.0, 1.0, 1.0), hole=lambda texel: False):
    def colour(u, v):
        texel = picture.at(*frame(u, v))
        if hole(texel):
            return None
        rgb = texel[:3] if len(texel) > 2 else (texel[0],) * 3
        return tuple(linear(rgb[i]) * tint[i] for i in range(3))
    return colour


def vrml_frame(translation=(0, 0), rotation=0.0, scale=(1, 1), center=(0, 0)):
    """Tc' = -C S R C T Tc (VRML 97, 6.49)."""
    def frame(u, v):
        u, v = u + translation[0] + center[0], v + translation[1] + center[1]
        u, v = (math.cos(rotation) * u - math.sin(rotation) * v, math.sin(rotation) * u + math.cos(rotation) * v)
        return u * scale[0] - center[0], v * scale[1] - center[1]
    return frame


def same_hue(light, expected):
    """Whatever white light adds to it."""
    def coloured(rgb):
        return [value - min(rgb) for value in rgb]
    a, b = coloured(light), coloured(expected)
    size_a, size_b = math.hypot(*a), math.hypot(*b)
    if size_b < 0.1 * math.hypot(*expected):
        return size_a < 0.3 * math.hypot(*light)
    return size_a > 0 and sum(x * y for x, y in zip(a, b)) > 0.96 * size_a * size_b


def compared(camera, things, rows, fits):
    """How many pixels of a square picture were compared, and those that do not fit: pixels that a texel or an
    object fills, whose place is the same at all their corners."""
    side, wrong, count = len(rows), [], 0
    for y in range(0, side, 2):
        for x in range(0, side, 2):
            lights = {light_at(things, camera.ray(2 * (x + dx) / side - 1, 1 - 2 * (y + dy) / side))
                      for dx in (-1.5, 2.5) for dy in (-1.5, 2.5)}
            expected = light_at(things, camera.ray(2 * (x + 0.5) / side - 1, 1 - 2 * (y + 0.5) / side))
            if len(lights) > 1 or expected is None or expected not in lights:
                continue
            count += 1
            if not fits(tuple(linear(value) for value in rows[y][x][:3]), expected):
                wrong.append((x, y, rows[y][x], tuple(round(shown(value)) for value in expected)))
    return count, wrong


class Glb:
    """What a reader of glTF that knows no extras sees of a file whose nodes stand at the origin."""

    def __init__(self, file):
        data = file.read_bytes()
        length = struct.unpack("<I", data[12:16])[0]
        self.json = json.loads(data[20:20 + length])
        self.data = data[28 + length:]

    def accessor(self, index):
        it = self.json["accessors"][index]
        view = self.json["bufferViews"][it["bufferView"]]
        wide = {"SCALAR": 1, "VEC2": 2, "VEC3": 3}[it["type"]]
        kind, size = {5121: ("B", 1), 5123: ("H", 2), 5125: ("I", 4), 5126: ("f", 4)}[it["componentType"]]
        start = view.get("byteOffset", 0) + it.get("byteOffset", 0)
        stride = view.get("byteStride", wide * size)
        return [struct.unpack_from(f"<{wide}{kind}", self.data, start + i * stride) for i in range(it["count"])]

    def triangles(self, picture):
        for mesh in self.json["meshes"]:
            for primitive in mesh["primitives"]:
                vertices = self.accessor(primitive["attributes"]["POSITION"])
                places = self.accessor(primitive["attributes"]["TEXCOORD_0"])
                pbr = self.json["materials"][primitive["material"]]["pbrMetallicRoughness"]
                assert pbr.get("baseColorFactor", [1, 1, 1])[:3] == [1, 1, 1], pbr
                move = pbr["baseColorTexture"].get("extensions", {}).get("KHR_texture_transform", {})
                x, y = move.get("offset", (0, 0))
                sx, sy = move.get("scale", (1, 1))
                turn = move.get("rotation", 0)

                def shows(s, t, sx=sx, sy=sy, x=x, y=y, turn=turn):
                    s, t = s * sx, t * sy
                    return picture.at(math.cos(turn) * s + math.sin(turn) * t + x,
                                      1 - (-math.sin(turn) * s + math.cos(turn) * t + y))
                corners = [it[0] for it in self.accessor(primitive["indices"])]
                for i in range(0, len(corners), 3):
                    yield ([vertices[k] for k in corners[i:i + 3]], [places[k] for k in corners[i:i + 3]], shows)
