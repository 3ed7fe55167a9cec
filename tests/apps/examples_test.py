"""The worked examples of the thesis, built by script from examples/: each is what its text says."""
import json
import math
import pathlib
import unittest

from icome_program import ProgramTest

EXAMPLES = pathlib.Path(__file__).resolve().parents[2] / "examples"


def volume_and_area(obj):
    """Of the triangles of an OBJ file."""
    points, volume, area = [], 0.0, 0.0
    for line in obj.read_text().splitlines():
        words = line.split()
        if words[:1] == ["v"]:
            points.append([float(it) for it in words[1:4]])
        elif words[:1] == ["f"]:
            a, b, c = (points[int(it.split("/")[0]) - 1] for it in words[1:4])
            u, v = ([q - p for p, q in zip(a, other)] for other in (b, c))
            cross = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
            volume += sum(p * q for p, q in zip(a, cross)) / 6
            area += math.hypot(*cross) / 2
    return volume, area


class ExamplesTest(ProgramTest):
    def built(self, name, ending):
        out = self.folder / f"{name}{ending}"
        self.succeeds("edit", "new", "--apply", EXAMPLES / f"{name}.jsonl", "--out", out)
        return out

    def info(self, name):
        return json.loads(self.succeeds("info", self.built(name, ".icome"), "--json").stdout)

    def test_every_example_is_looked_at_here(self):
        self.assertEqual(sorted(it.stem for it in EXAMPLES.glob("*.jsonl")),
                         ["sheet", "stairs", "tables", "torus-and-cone", "wood-stairs"])

    def test_two_tables(self):
        report = self.info("tables")
        # Two tops of their own, and for each table one leg with three clones.
        self.assertEqual((report["objects"], report["clones"], report["materials"]), (12, 6, 2))
        for got, want in zip(report["bounds"]["max"], [1.6, 0.72, 0.25]):
            self.assertAlmostEqual(got, want, delta=1e-9)
        self.succeeds("convert", self.built("tables", ".icome"), self.folder / "tables.obj")

    def test_stairs(self):
        report = self.info("stairs")
        # Ten steps and 18 treads, each of one shape, in two groups, and the pole.
        self.assertEqual((report["objects"], report["clones"]), (31, 26))
        self.assertAlmostEqual(report["bounds"]["max"][1], 3.2, delta=1e-9)
        self.assertAlmostEqual(report["bounds"]["min"][2], -0.15 - 9 * 0.28, delta=1e-9)

    def test_wooden_stairs_of_a_square(self):
        report = self.info("wood-stairs")
        # Ten steps of one shape in a group; a square of 0.28 m, 0.9 m wide, with the picture on all of it.
        self.assertEqual((report["objects"], report["clones"], report["materials"]), (11, 9, 1))
        self.assertAlmostEqual(report["bounds"]["max"][1], 0.14 + 9 * 0.17, delta=1e-9)
        obj = self.folder / "stairs.obj"
        self.succeeds("convert", self.built("wood-stairs", ".icome"), obj)
        self.assertAlmostEqual(volume_and_area(obj)[0], 10 * 0.28 ** 2 * 0.9, delta=1e-6)
        picture = next(self.folder.glob("stairs_textures/*.png"))
        self.assertEqual(picture.read_bytes(), (EXAMPLES / "wood.png").read_bytes())
        places = {tuple(map(float, line.split()[1:3])) for line in obj.read_text().splitlines()
                  if line.startswith("vt ")}
        # The ends show the picture once; 0.9 m of a side are 0.9 / 0.28 pictures.
        self.assertTrue({(0, 0), (1, 0), (1, 1), (0, 1)} <= places)
        self.assertAlmostEqual(max(u for u, _ in places), 1 + 0.9 / 0.28, delta=1e-5)

    def test_a_square_becomes_a_sheet(self):
        report = self.info("sheet")
        self.assertEqual(report["triangles"], 2 * 4 ** 5)
        low, high = report["bounds"]["min"], report["bounds"]["max"]
        self.assertAlmostEqual(high[0], 0.2, delta=1e-9)  # its rim stays
        # Two of 4 x 4 control points are pulled, one up and one down: Bernstein polynomials of degree 3.
        steps = [i / 32 for i in range(33)]
        rise = max(0.3 * 9 * s * t * ((1 - s) ** 2 * (1 - t) ** 2 - s * (1 - s) * t * (1 - t))
                   for s in steps for t in steps)
        self.assertAlmostEqual(high[1], rise, delta=1e-6)
        self.assertAlmostEqual(low[1], -rise, delta=1e-6)

    def test_a_torus_and_a_cone(self):
        torus_and_cone = volume_and_area(self.built("torus-and-cone", ".obj"))[0]
        # Of the polygons turned in 72 steps: a prism of the mean of the polygon's distances, by Pappus' rule for
        # chords, sin(5 degrees) in place of 5 degrees.
        chord = 72 * math.sin(math.radians(5))
        ring = 0.1 * chord * 0.00276224  # the area of the 16-gon as drawn
        cone = chord / 2 * 0.08 ** 2 * 0.18 / 3
        self.assertAlmostEqual(torus_and_cone, ring + cone, delta=2e-6)


if __name__ == "__main__":
    unittest.main()
