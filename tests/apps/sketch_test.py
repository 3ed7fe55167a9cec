"""icome sketch: fits held against the samples by dense sampling written here, pictures, edits, and what is wrong."""
import json
import math
import struct
import unittest

from icome_program import ProgramTest

HEADER = "t,x,y,pressure\n"


def at(segment, t):
    u = 1 - t
    weights = (u * u * u, 3 * t * u * u, 3 * t * t * u, t * t * t)
    return tuple(sum(w * p[k] for w, p in zip(weights, segment)) for k in range(2))


def to_line(point, line):
    """The distance of a point to a line of straight pieces."""
    least = math.inf
    for a, b in zip(line, line[1:]):
        way = (b[0] - a[0], b[1] - a[1])
        squared = way[0] ** 2 + way[1] ** 2
        part = ((point[0] - a[0]) * way[0] + (point[1] - a[1]) * way[1]) / squared if squared else 0
        part = min(1, max(0, part))
        least = min(least, math.hypot(a[0] + part * way[0] - point[0], a[1] + part * way[1] - point[1]))
    return least


def distance_of(segments, samples):
    curve = [at(segment, k / 200) for segment in segments for k in range(201)]
    return max(max(to_line(place, samples) for place in curve), max(to_line(place, curve) for place in samples))


def stl_volume(file):
    """The volume that the triangles of a binary STL file enclose, by the divergence theorem."""
    volume = 0.0
    for record in struct.iter_unpack("<12fH", file.read_bytes()[84:]):
        (ax, ay, az), (bx, by, bz), (cx, cy, cz) = record[3:6], record[6:9], record[9:12]
        volume += ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx)
    return volume / 6


class SketchTest(ProgramTest):
    def strokes(self, *strokes, name="strokes.csv"):
        rows = []
        for stroke in strokes:
            rows += [f"{i * 0.005!r},{x!r},{y!r},{0.5!r}" for i, (x, y) in enumerate(stroke)]
            rows.append(f"{len(stroke) * 0.005!r},0,0,0")
        return self.write(name, HEADER + "\n".join(rows) + "\n")

    def fit(self, file, *options):
        return json.loads(self.succeeds("sketch", "fit", file, "--json", *options).stdout)["strokes"]

    def test_curves_are_as_near_to_the_samples_as_they_say(self):
        circle = [(50 + 20 * math.cos(i / 10), 50 + 20 * math.sin(i / 10)) for i in range(60)]
        hook = [(i, 0.01 * i * i) for i in range(30)] + [(29 - i, 9) for i in range(1, 20)]
        file = self.strokes(circle, hook)
        for options in [(), ("--error", 0.5), ("--method", "thesis", "--shared", 5), ("--no-refit",)]:
            fitted = self.fit(file, *options)
            self.assertEqual([stroke["samples"] for stroke in fitted], [60, 49])
            for stroke, samples in zip(fitted, (circle, hook)):
                self.assertEqual(set(stroke), {"samples", "segments", "widths", "max_error_mm", "corners"})
                self.assertLessEqual(distance_of(stroke["segments"], samples), stroke["max_error_mm"] + 1e-3)
                if "thesis" not in options:
                    self.assertLessEqual(stroke["max_error_mm"], 0.5 if 0.5 in options else 0.1)
                self.assertEqual(stroke["widths"][0][0], 0)
                self.assertEqual(stroke["widths"][-1][2], len(stroke["segments"]))
                for before, after in zip(stroke["segments"], stroke["segments"][1:]):
                    self.assertEqual(before[3], after[0])
            if options == ():
                self.assertEqual([stroke["corners"] for stroke in fitted], [0, 1])

    def test_svg_there_and_back_is_the_same_drawing(self):
        file = self.strokes([(i, math.sin(i)) for i in range(40)], [(10, 10), (20, 30)])
        svg, again = self.folder / "a.svg", self.folder / "b.svg"
        self.succeeds("sketch", "render", file, svg)
        self.succeeds("sketch", "render", svg, again)
        lists = [json.loads(self.succeeds("sketch", "list", one, "--json").stdout) for one in (svg, again)]
        self.assertEqual(lists[0]["layers"], lists[1]["layers"])
        self.assertEqual(len(lists[0]["layers"][0]["strokes"]), 2)
        for name, start in (("a.png", b"\x89PNG"), ("a.pdf", b"%PDF")):
            self.succeeds("sketch", "render", svg, self.folder / name)
            self.assertEqual((self.folder / name).read_bytes()[:4], start)

    def test_edits(self):
        edits = self.write("edits.jsonl", '{"op": "draw", "way": [[0, 0], [60, 0]]}\n'
                           '{"op": "erase", "way": [[30, -9], [30, 9]], "radius": 3}\n')
        out = self.folder / "out.svg"
        report = json.loads(self.succeeds("sketch", "edit", "new", "--apply", edits, "--out", out, "--json").stdout)
        self.assertEqual((report["operations"], report["strokes"]), (2, 2))
        strokes = json.loads(self.succeeds("sketch", "list", out, "--json").stdout)["layers"][0]["strokes"]
        for stroke, box in zip(strokes, ([0, 0, 27, 0], [33, 0, 60, 0])):
            for have, want in zip(stroke["bounds"], box):
                self.assertAlmostEqual(have, want, delta=0.01)
        bad = self.write("bad.jsonl", '{"op": "select-all"}\n{"op": "split", "stroke": 2}\n')
        self.fails("sketch", "edit", out, "--apply", bad, "--out", self.folder / "x.svg", code=1, saying="bad.jsonl:2")
        self.assertFalse((self.folder / "x.svg").exists())

    def drawing_design(self, *lines, name="paper.icome"):
        """A design whose only object is the drawing that the lines of a script make."""
        edits = self.write("make.jsonl", "".join(json.dumps(line) + "\n" for line in lines))
        svg, design = self.folder / "paper.svg", self.folder / name
        self.succeeds("sketch", "edit", "new", "--apply", edits, "--out", svg)
        self.succeeds("sketch", "model", svg, design, "--drawing")
        return design

    def test_a_drawing_in_a_design_is_touched_drawn_on_and_kept(self):
        design = self.drawing_design({"op": "draw", "way": [[20, 20], [120, 20]], "widest": 4})
        self.assertEqual(json.loads(self.succeeds("info", design, "--json").stdout)["shapes"], {"drawing": 1})
        self.succeeds("touch", design, "--check")
        edits = self.write("more.jsonl", '{"op": "draw", "way": [[20, 60], [120, 90]]}\n{"op": "undo"}\n'
                           '{"op": "draw", "way": [[20, 80], [120, 80]], "colour": "red"}\n')
        for out in ("more.icome", "more.wrl", "more.glb", "more.svg"):
            self.succeeds("sketch", "edit", design, "--apply", edits, "--out", self.folder / out)
            strokes = json.loads(self.succeeds("sketch", "list", self.folder / out, "--json").stdout)["layers"][0]["strokes"]
            self.assertEqual([[round(x, 1) for x in stroke["bounds"]] for stroke in strokes],
                             [[20, 20, 120, 20], [20, 80, 120, 80]], out)
        self.succeeds("sketch", "render", self.folder / "more.wrl", self.folder / "more.png")
        self.fails("sketch", "edit", design, "--object", "papr", "--apply", edits, "--out", self.folder / "x.icome",
                   code=1, saying="'paper'")
        cube = self.write("cube.jsonl", '{"op": "create", "shape": "cube"}\n')
        self.succeeds("edit", "new", "--apply", cube, "--out", self.folder / "cube.icome")
        self.fails("sketch", "list", self.folder / "cube.icome", code=1, saying="no drawing")

    def test_curves_of_a_drawing_are_swept(self):
        design = self.drawing_design(
            {"op": "draw", "way": [[100, 60], [160, 60], [160, 100], [100, 100]], "closed": True},
            {"op": "draw", "way": [[10, 10], [20, 40]]})
        edits = self.write("sweep.jsonl", '{"op": "extrude", "profile": "paper", "steps": [{"move": [0, 0, 0.01]}], '
                           '"name": "slab"}\n'
                           '{"op": "extrude", "profile": "paper", "open": true, "steps": [{"turn": [0, 10, 0], '
                           '"repeat": 36}], "ends": "joined", "name": "lathe"}\n')
        out = self.folder / "swept.icome"
        self.succeeds("edit", design, "--apply", edits, "--out", out)
        swept = json.loads(self.succeeds("info", out, "--json").stdout)
        self.assertEqual((swept["objects"], swept["shapes"]["drawing"], swept["shapes"]["mesh"]), (3, 1, 2))
        # The slab is 10 mm thick on the paper; the lathe's line is 138.5 mm from the axis at most.
        self.assertAlmostEqual(swept["bounds"]["max"][2], 0.1385, delta=0.001)
        self.assertAlmostEqual(swept["bounds"]["max"][0], 0.1485, delta=0.001)
        for bad, saying in (('"which": 3', "number 3"), ('"open": true, "which": 2', "number 2")):
            wrong = self.write("wrong.jsonl", '{"op": "extrude", "profile": "paper", "steps": [{"move": [0, 0, 1]}], '
                               + bad + '}\n')
            self.fails("edit", design, "--apply", wrong, "--out", self.folder / "x.icome", code=1, saying=saying)

    def test_holes_of_a_drawing_are_swept_along(self):
        svg = self.write("frame.svg", '<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="100mm" '
                         'viewBox="0 0 100 100"><path fill-rule="evenodd" fill="#000" '
                         'd="M10 10H90V90H10Z M30 30H70V70H30Z"/></svg>')
        design, out, stl = (self.folder / name for name in ("frame.icome", "swept.icome", "frame.stl"))
        self.succeeds("sketch", "model", svg, design, "--drawing")
        edits = self.write("sweep.jsonl", '{"op": "extrude", "profile": "frame", "name": "swept", '
                           '"steps": [{"move": [0, 0, 0.01]}]}\n{"op": "delete", "objects": ["frame"]}\n')
        self.succeeds("edit", design, "--apply", edits, "--out", out)
        self.succeeds("convert", out, stl)
        self.assertAlmostEqual(stl_volume(stl), (0.08 * 0.08 - 0.04 * 0.04) * 0.01, delta=1e-8)

    def test_what_is_wrong_is_named_with_its_line(self):
        for text, saying in [("a,b\n1,2\n", "s.csv:1"), (HEADER + "0,nan,0,1\n", "s.csv:2"),
                             (HEADER + "0,0,0,1\n1,0,0,2\n", "s.csv:3"), ("", "s.csv"), (HEADER, "s.csv")]:
            self.fails("sketch", "fit", self.write("s.csv", text), code=1, saying=saying)
        (self.folder / "b.csv").write_bytes(bytes(range(256)))
        self.fails("sketch", "fit", self.folder / "b.csv", code=1, saying="b.csv")
        self.fails("sketch", "fit", self.folder / "none.csv", code=1, saying="none.csv")
        self.fails("sketch", "fit", self.folder, code=1, saying=self.folder.name)
        good = self.strokes([(0, 0), (1, 1)])
        self.fails("sketch", "render", good, self.folder / "a.gif", code=1, saying="a.gif")
        self.fails("sketch", "render", good, self.folder / "no" / "a.svg", code=1, saying="a.svg")

    def test_usage(self):
        good = self.strokes([(0, 0), (1, 1)])
        for wrong in [(), ("fit",), ("fit", good, "--error", -1), ("fit", good, "--method", "best"),
                      ("render", good), ("edit", good)]:
            self.fails("sketch", *wrong, code=2, saying="")
        for task in ("fit", "render", "edit", "list"):
            self.assertIn("JSON", self.succeeds("sketch", task, "--help").stdout)


if __name__ == "__main__":
    unittest.main()
