#!/usr/bin/env python3
"""Makes the cut-out animations of this folder: their pictures (SVG) and the scripts that put them together.

usage: make_examples.py ICOME      ICOME is the program, which makes the projects of the scripts

boat/ is a boat on a rough sea (thesis, figure 3.3), walk/ a walking figure with joints and chains.
"""
import json
import math
import pathlib
import random
import struct
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
SHADOW = (
    '<filter id="paper" x="-10%" y="-10%" width="120%" height="125%">'
    '<feGaussianBlur in="SourceAlpha" stdDeviation="3"/><feOffset dx="2" dy="4"/>'
    '<feComponentTransfer><feFuncA type="linear" slope="0.35"/></feComponentTransfer>'
    '<feMerge><feMergeNode/><feMergeNode in="SourceGraphic"/></feMerge></filter>'
)


def picture(path, width, height, body, shadow=True):
    """Writes an SVG file of that size, px, whose content throws the shadow of paper."""
    filter_ = ' filter="url(#paper)"' if shadow else ""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" '
        f'viewBox="0 0 {width} {height}">\n<defs>{SHADOW}</defs>\n<g{filter_}>\n{body}\n</g>\n</svg>\n',
        encoding="utf-8",
    )


def torn(points, seed, size=1.5):
    """The path of a polygon whose rim is a little uneven, as scissors leave it."""
    rng = random.Random(seed)
    steps = []
    for (x0, y0), (x1, y1) in zip(points, points[1:] + points[:1]):
        count = max(1, round(math.hypot(x1 - x0, y1 - y0) / 14))
        for i in range(count):
            t = i / count
            steps.append((x0 + t * (x1 - x0) + rng.uniform(-size, size) * (0 < i),
                          y0 + t * (y1 - y0) + rng.uniform(-size, size) * (0 < i)))
    return "M" + " L".join(f"{x:.1f} {y:.1f}" for x, y in steps) + " Z"


def shape(points, colour, seed, size=1.5):
    return f'<path d="{torn(points, seed, size)}" fill="{colour}"/>'


def waves(path, length, height, count, depth, colour, foam, seed):
    """A strip of sea: `count` waves of `length` px, with a rim of foam."""
    width = round(length * count)
    rng = random.Random(seed)
    crest = []
    for x in range(0, width + 1, 8):
        phase = 2 * math.pi * x / length
        crest.append((x, 10 + height * (0.5 - 0.5 * math.cos(phase) + 0.18 * math.sin(2 * phase))))
    body = [(x, y) for x, y in crest] + [(width, depth), (0, depth)]
    # The shadow of a strip falls on the one behind it, so only its rim is of paper.
    lines = "M" + " L".join(f"{x:.1f} {y:.1f}" for x, y in body) + " Z"
    rim = "M" + " L".join(f"{x:.1f} {y + 5 + rng.uniform(-1, 1):.1f}" for x, y in crest)
    picture(path, width, depth,
            f'<path d="{lines}" fill="{colour}"/>'
            f'<path d="{rim}" fill="none" stroke="{foam}" stroke-width="5" stroke-opacity="0.75"/>')


def sea_sound(path, seconds):
    """Surf: noise that swells with the waves, as OGG by ffmpeg."""
    rate, low, slow = 22050, 0.0, 0.0
    rng = random.Random(10)
    values = bytearray()
    for i in range(round(seconds * rate)):
        t = i / rate
        swell = 0.35 + 0.65 * (0.5 - 0.5 * math.cos(2 * math.pi * t / 2)) ** 2
        low += 0.22 * (rng.uniform(-1, 1) - low)
        slow += 0.02 * (rng.uniform(-1, 1) - slow)
        value = max(-1.0, min(1.0, swell * (0.8 * low + 1.6 * slow)))
        values += struct.pack("<h", round(20000 * value))
    subprocess.run(["ffmpeg", "-v", "error", "-y", "-f", "s16le", "-ar", str(rate), "-ac", "1", "-i", "-",
                    "-fflags", "+bitexact", "-flags:a", "+bitexact", "-c:a", "libvorbis", "-q:a", "0", path],
                   input=bytes(values), check=True)


def save(folder, commands, program):
    """Writes the script of a project and lets the program make the project of it."""
    script = folder / f"{folder.name}.jsonl"
    script.write_text("".join(json.dumps(command) + "\n" for command in commands), encoding="utf-8")
    subprocess.run([program, "animate", "new", "--apply", script.name, "--save", f"{folder.name}.cutout"],
                   cwd=folder, check=True)


def make_boat(program):
    folder = HERE / "boat"
    length = 96
    circle = [(90 + 70 * math.cos(a), 90 + 70 * math.sin(a)) for a in [i * math.pi / 20 for i in range(40)]]
    rays = "".join(
        f'<path d="M{90 + 76 * math.cos(a - .09):.1f} {90 + 76 * math.sin(a - .09):.1f} '
        f'L{90 + 88 * math.cos(a):.1f} {90 + 88 * math.sin(a):.1f} '
        f'L{90 + 76 * math.cos(a + .09):.1f} {90 + 76 * math.sin(a + .09):.1f} Z" fill="#f7c948"/>'
        for a in [i * math.pi / 8 for i in range(16)])
    picture(folder / "sun.svg", 180, 180, shape(circle, "#f9d65c", 1) + rays)
    cloud = "".join(f'<ellipse cx="{x}" cy="{y}" rx="{rx}" ry="{ry}" fill="#f4f6f8"/>'
                    for x, y, rx, ry in [(90, 80, 70, 36), (160, 62, 74, 48), (236, 82, 66, 34), (160, 92, 130, 26)])
    picture(folder / "cloud.svg", 320, 130, cloud)
    hull = [(14, 300), (346, 300), (300, 372), (62, 372)]
    stripe = [(24, 314), (336, 314), (329, 326), (32, 326)]
    mast = [(168, 30), (178, 30), (178, 302), (168, 302)]
    sail = [(186, 46), (186, 282), (330, 282), (288, 190), (236, 104)]
    jib = [(160, 70), (160, 282), (46, 282), (98, 190)]
    flag = '<path d="M173 8 L222 20 L173 34 Z" fill="#d64545"/>'
    picture(folder / "boat.svg", 360, 400,
            shape(mast, "#6b4f3a", 2, 0.6) + flag + shape(sail, "#fbf3e0", 3) + shape(jib, "#f3d9b1", 4) +
            shape(hull, "#b5442e", 5) + shape(stripe, "#f3d9b1", 6, 0.8))
    bird = ("M4 30 Q24 4 44 28 Q64 4 84 30 Q64 20 44 36 Q24 20 4 30 Z",
            "M4 14 Q24 24 44 30 Q64 24 84 14 Q64 34 44 38 Q24 34 4 14 Z")
    for number, path in enumerate(bird):
        picture(folder / f"bird{number}.svg", 88, 44, f'<path d="{path}" fill="#3f4a56"/>')
    sea_sound(folder / "sea.ogg", length / 24)
    waves(folder / "sea-back.svg", 320, 34, 6, 330, "#3d7ea6", "#a9d3e5", 7)
    waves(folder / "sea-middle.svg", 400, 46, 5, 280, "#2b6a94", "#8fc4dc", 8)
    waves(folder / "sea-front.svg", 480, 58, 5, 240, "#1d5379", "#7fb8d4", 9)

    commands = [
        {"op": "stage", "width": 1280, "height": 720, "rate": 24, "length": length, "background": "#9fd0e6"},
        {"op": "add-layer", "name": "sky"},
        {"op": "add-cell", "name": "sun", "pictures": "sun.svg", "place": [1060, 150], "layer": "sky"},
        {"op": "add-cell", "name": "cloud", "pictures": "cloud.svg", "place": [300, 130], "layer": "sky"},
        {"op": "add-cell", "name": "small cloud", "pictures": "cloud.svg", "place": [760, 210], "scale": 0.55,
         "layer": "sky", "opacity": 0.9},
        {"op": "add-cell", "name": "gull", "pictures": ["bird0.svg", "bird1.svg"], "place": [-60, 220],
         "layer": "sky"},
        {"op": "add-layer", "name": "sea behind"},
        {"op": "add-cell", "name": "far waves", "pictures": "sea-back.svg", "layer": "sea behind",
         "pivot": [0, 10], "place": [0, 400]},
        {"op": "add-layer", "name": "boat"},
        {"op": "add-cell", "name": "boat", "pictures": "boat.svg", "layer": "boat", "pivot": [180, 330],
         "place": [560, 470]},
        {"op": "add-layer", "name": "sea before"},
        {"op": "add-cell", "name": "waves", "pictures": "sea-middle.svg", "layer": "sea before",
         "pivot": [0, 10], "place": [0, 470]},
        {"op": "add-cell", "name": "near waves", "pictures": "sea-front.svg", "layer": "sea before",
         "pivot": [0, 10], "place": [0, 560]},
        # The boat keeps to the swell, so that a hand can only shift it along.
    ]
    last = length
    for cell, period, first, by in [("far waves", 96, -320, 320), ("waves", 96, 0, -400),
                                    ("near waves", 96, -480, 480)]:
        commands += [{"op": "key", "cell": cell, "frame": 0, "x": first},
                     {"op": "key", "cell": cell, "frame": period, "x": first + by}]
    for cell, size, period in [("far waves", 6, 48), ("waves", 9, 48), ("near waves", 14, 32)]:
        base = {"far waves": 400, "waves": 470, "near waves": 560}[cell]
        for frame in range(0, last + 1, period // 2):
            up = -1 if (frame // (period // 2)) % 2 else 1
            commands.append({"op": "key", "cell": cell, "frame": frame, "y": base + up * size, "ease": "eased"})
    for frame, angle, y in [(0, -5, 470), (12, 2, 446), (24, 7, 462), (36, 1, 488), (48, -7, 470), (60, 1, 440),
                            (72, 6, 462), (84, 0, 484), (96, -5, 470)]:
        commands.append({"op": "key", "cell": "boat", "frame": frame, "angle": angle, "y": y, "ease": "eased"})
    commands += [{"op": "key", "cell": "boat", "frame": 0, "x": 540, "ease": "eased"},
                 {"op": "key", "cell": "boat", "frame": 48, "x": 700, "ease": "eased"},
                 {"op": "key", "cell": "boat", "frame": 96, "x": 540, "ease": "eased"},
                 {"op": "key", "cell": "gull", "frame": 0, "x": -60, "y": 240},
                 {"op": "key", "cell": "gull", "frame": 48, "y": 150, "ease": "eased"},
                 {"op": "key", "cell": "gull", "frame": 95, "x": 1350, "y": 230},
                 {"op": "expose", "cell": "gull", "frame": 0, "pictures": [0, 1] * 12, "each": 4},
                 {"op": "key", "cell": "cloud", "frame": 0, "x": 280}, {"op": "key", "cell": "cloud", "frame": 95, "x": 340},
                 {"op": "key", "cell": "sun", "frame": 0, "angle": 0}, {"op": "key", "cell": "sun", "frame": 96, "angle": 22.5},
                 {"op": "sound", "file": "sea.ogg"}, {"op": "mark", "frame": 24, "text": "crest"}, {"op": "mark", "frame": 72, "text": "crest"},
                 {"op": "map", "triangle": "boat", "mode": "relative", "cell": "boat"},
                 {"op": "map", "triangle": "any", "mode": "nearest"}]
    save(folder, commands, program)


def limb(length, top, bottom, margin=12):
    """The outline of a limb that hangs down, its joint `margin` px below the upper rim."""
    width = 2 * max(top, bottom) + 2 * margin
    middle = width / 2
    points = [(middle + top * math.cos(a), margin + top - top * math.sin(a) * 1.0) for a in
              [i * math.pi / 10 for i in range(11)]]
    points += [(middle - bottom * math.cos(a), margin + top + length + bottom * math.sin(a)) for a in
               [i * math.pi / 10 for i in range(11)]]
    return round(width), round(2 * margin + top + length + bottom), middle, margin + top, points


def make_walk(program):
    folder = HERE / "walk"
    length = 48
    parts = {}
    for name, size, top, bottom, colour in [("thigh", 120, 30, 22, "#31587a"), ("shin", 116, 22, 16, "#31587a"),
                                            ("upper-arm", 92, 22, 17, "#d9822b"), ("forearm", 86, 17, 13, "#e8b98a")]:
        for side, shade in [("near", 1.0), ("far", 0.72)]:
            width, height, middle, joint, points = limb(size, top, bottom)
            rgb = [int(int(colour[i:i + 2], 16) * shade) for i in (1, 3, 5)]
            body = shape(points, "#%02x%02x%02x" % tuple(rgb), len(name), 0.8)
            if name == "shin":
                foot_y = joint + size + bottom - 4
                body += (f'<path d="M{middle - bottom} {foot_y - 14} L{middle + bottom} {foot_y - 14} '
                         f'Q{middle + 56} {foot_y - 4} {middle + 56} {foot_y + 12} L{middle - bottom} {foot_y + 12} Z" '
                         f'fill="{"#5b3a29" if side == "near" else "#432b1e"}"/>')
                width, height = width + 60, height + 18
            picture(folder / f"{name}-{side}.svg", width, height, body)
            parts[f"{name}-{side}"] = (middle, joint, size)
    torso = [(34, 30), (106, 30), (122, 120), (112, 214), (28, 214), (18, 120)]
    picture(folder / "torso.svg", 140, 240, shape(torso, "#e0912f", 11) +
            '<path d="M28 196 L112 196 L112 214 L28 214 Z" fill="#5b3a29"/>')
    head = ('<circle cx="75" cy="78" r="52" fill="#e8b98a"/><path d="M24 66 Q30 14 80 18 Q128 22 128 62 L120 54 '
            'Q100 40 24 66 Z" fill="#4a2f23"/><circle cx="98" cy="76" r="5" fill="#2b2b2b"/>'
            '<path d="M125 78 L142 90 L124 96 Z" fill="#dba674"/>')
    picture(folder / "head-closed.svg", 156, 150, head + '<path d="M92 108 Q104 112 114 106" stroke="#8c4a36" '
                                                         'stroke-width="5" fill="none"/>')
    picture(folder / "head-open.svg", 156, 150, head + '<ellipse cx="103" cy="108" rx="11" ry="9" fill="#8c4a36"/>')
    picture(folder / "ground.svg", 1600, 160,
            shape([(0, 20), (1600, 20), (1600, 160), (0, 160)], "#7fae5a", 13) +
            "".join(f'<path d="M{x} 22 l6 -16 l6 16 Z" fill="#6a9a48"/>' for x in range(30, 1600, 80)), False)
    picture(folder / "hill.svg", 900, 320, shape([(0, 320), (120, 190), (300, 80), (470, 30), (640, 110), (800, 220),
                                                  (900, 320)], "#a9cf8b", 14, 3))
    picture(folder / "tree.svg", 200, 330, '<path d="M88 200 L112 200 L118 320 L82 320 Z" fill="#6b4f3a"/>'
            '<circle cx="100" cy="110" r="86" fill="#4f8a4b"/><circle cx="66" cy="150" r="54" fill="#5d9a58"/>')

    hip, shoulder = (640, 400), (640, 226)
    commands = [{"op": "stage", "width": 1280, "height": 720, "rate": 24, "length": length, "background": "#d8ecf3"},
                {"op": "add-layer", "name": "land"},
                {"op": "add-cell", "name": "hill", "pictures": "hill.svg", "pivot": [0, 320], "place": [-100, 600],
                 "layer": "land"},
                {"op": "add-cell", "name": "far hill", "pictures": "hill.svg", "pivot": [0, 320],
                 "place": [620, 600], "scale": 0.8, "layer": "land"},
                {"op": "add-cell", "name": "tree", "pictures": "tree.svg", "pivot": [100, 320], "place": [1000, 590],
                 "layer": "land"},
                {"op": "add-cell", "name": "ground", "pictures": "ground.svg", "pivot": [0, 20], "place": [-80, 590],
                 "layer": "land"},
                {"op": "add-layer", "name": "figure"}]

    def add(name, picture_, pivot, place):
        commands.append({"op": "add-cell", "name": name, "pictures": picture_, "pivot": list(pivot),
                         "place": list(place), "layer": "figure"})

    def add_limb(side, upper, lower, at, words):
        middle, joint, size = parts[f"{upper}-{side}"]
        below, joint_below, _ = parts[f"{lower}-{side}"]
        knee = (at[0], at[1] + size)
        add(f"{side} {words[1]}", f"{lower}-{side}.svg", (below, joint_below), knee)
        add(f"{side} {words[0]}", f"{upper}-{side}.svg", (middle, joint), at)

    add_limb("far", "upper-arm", "forearm", shoulder, ("arm", "forearm"))
    add_limb("far", "thigh", "shin", hip, ("thigh", "shin"))
    add("torso", "torso.svg", (70, 200), (640, 392))
    add("head", ["head-closed.svg", "head-open.svg"], (70, 134), (640, 214))
    add_limb("near", "thigh", "shin", hip, ("thigh", "shin"))
    add_limb("near", "upper-arm", "forearm", shoulder, ("arm", "forearm"))
    for side in ("far", "near"):
        commands += [{"op": "join", "parent": "torso", "child": f"{side} thigh", "least": -70, "greatest": 70},
                     {"op": "join", "parent": f"{side} thigh", "child": f"{side} shin", "least": -130, "greatest": 4},
                     {"op": "chain", "cells": [f"{side} thigh", f"{side} shin"]},
                     {"op": "join", "parent": "torso", "child": f"{side} arm"},
                     {"op": "join", "parent": f"{side} arm", "child": f"{side} forearm", "least": -4,
                      "greatest": 150},
                     {"op": "chain", "cells": [f"{side} arm", f"{side} forearm"]}]
    commands.append({"op": "join", "parent": "torso", "child": "head", "least": -30, "greatest": 30})

    # One step takes 12 frames. Angles of thigh and shin less thigh over a cycle of 24 frames; positive turns the
    # foot forward (to the right).
    cycle = [(0, 26, -6), (3, 20, -16), (6, 4, -8), (9, -14, -6), (12, -26, -16), (15, -18, -52), (18, 6, -64),
             (21, 26, -34), (24, 26, -6)]
    for side, shift in [("near", 0), ("far", 12)]:
        for turn in range(0, length // 24 + 1):
            for frame, thigh, bend in cycle[:-1]:
                at = frame + shift + 24 * (turn - 1)
                if 0 <= at <= length:
                    commands += [{"op": "key", "cell": f"{side} thigh", "frame": at, "angle": thigh, "ease": "eased"},
                                 {"op": "key", "cell": f"{side} shin", "frame": at, "angle": thigh + bend, "ease": "eased"}]
        for frame in range(0, length + 1, 12):
            forward = (frame // 12 + (side == "far")) % 2
            commands += [{"op": "key", "cell": f"{side} arm", "frame": frame, "angle": 28 if forward else -30,
                          "ease": "eased"},
                         {"op": "key", "cell": f"{side} forearm", "frame": frame, "angle": 62 if forward else -14,
                          "ease": "eased"}]
    for frame in range(0, length + 1, 6):
        up = frame // 6 % 2
        commands.append({"op": "key", "cell": "torso", "frame": frame, "y": 392 - 12 * up, "angle": -3 + 2 * up,
                         "ease": "eased"})
        commands.append({"op": "key", "cell": "head", "frame": frame, "angle": 2 - 4 * up, "ease": "eased"})
    commands += [{"op": "key", "cell": "ground", "frame": 0, "x": -80}, {"op": "key", "cell": "ground", "frame": 48, "x": -240},
                 {"op": "key", "cell": "tree", "frame": 0, "x": 1080}, {"op": "key", "cell": "tree", "frame": 48, "x": 920},
                 {"op": "expose", "cell": "head", "frame": 0, "pictures": [0, 1, 0, 1, 0, 0, 1, 0], "each": 6},
                 {"op": "mark", "frame": 6, "text": "Ah"}, {"op": "mark", "frame": 18, "text": "O"},
                 {"op": "mark", "frame": 36, "text": "Ah"}]
    save(folder, commands, program)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    make_boat(str(pathlib.Path(sys.argv[1]).resolve()))
    make_walk(str(pathlib.Path(sys.argv[1]).resolve()))
