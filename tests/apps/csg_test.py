"""icome csg: what a .csg file holds, its forms, which points are inside, and a mesh of it."""
import json
import os
import random
import struct
import unittest

import csg_evaluator
from icome_program import ProgramTest, SHARED_MESHES, run

SHARED_CSG = SHARED_MESHES.parent / "csg"
REFUSED = {  # and by which name
    "LetterBlock": "linear_extrude", "allmodules": "minkowski", "candleStand": "linear_extrude",
    "children_indexed": "linear_extrude", "difference-2d-tests": "square", "example012": "import",
    "example020": "linear_extrude", "hull-tests": "hull", "hull": "hull", "offset": "linear_extrude",
    "text_on_cube": "linear_extrude", "polyhedron": "polyhedron"}
PIERCED = "difference() { cube([10, 10, 10], center = true); cylinder(h = 20, r1 = 2, r2 = 2, center = true); }"


class CsgTest(ProgramTest):
    def csg(self, text, name="solid.csg"):
        return self.write(name, text)

    def points_file(self, points, name="points.csv"):
        return self.write(name, "x,y,z\n" + "".join(f"{x!r},{y!r},{z!r}\n" for x, y, z in points))

    def inside(self, file, points, *more):
        lines = self.succeeds("csg", file, "--inside", self.points_file(points), *more).stdout.splitlines()
        self.assertEqual(lines[0], "inside")
        self.assertLessEqual(set(lines[1:]), {"0", "1"})
        self.assertEqual(len(lines), 1 + len(points))
        return [line == "1" for line in lines[1:]]

    def json(self, *arguments):
        return json.loads(self.succeeds("csg", *arguments, "--json").stdout)


class ReportTest(CsgTest):
    def test_json_tells_tree_form_and_bounds(self):
        report = self.json(self.csg("union() { " + PIERCED + " %cube(1); multmatrix([[1,0,0,20],[0,1,0,0],[0,0,1,0],"
                                    "[0,0,0,1]]) { sphere(r = 5); } }"))
        for name, value in {"nodes": 5, "primitives": 3, "depth": 3, "form": "tree", "form_nodes": 5,
                            "pruned": 0}.items():
            self.assertEqual(report[name], value, name)
        for name, corner in {"min": [-0.005] * 3, "max": [0.025, 0.005, 0.005]}.items():
            for a, b in zip(report["bounds"][name], corner):
                self.assertAlmostEqual(a, b, delta=1e-12)
        self.assertEqual(report["notes"], ["cube in line 1 is left out, for '%' makes it background"])

    def test_forms_have_their_own_nodes(self):
        # (a + b) - c is one product less than its normal form (a - c) + (b - c).
        file = self.csg("difference() { group() { cube(2); cube([3, 1, 1]); } cube(1); }")
        normal = self.json(file, "--form", "normal")
        self.assertEqual((normal["nodes"], normal["form"], normal["form_nodes"], normal["products"]), (5, "normal", 7, 2))
        subnormal = self.json(file, "--form", "subnormal")
        self.assertEqual((subnormal["form"], subnormal["form_nodes"], subnormal["products"]), ("subnormal", 5, None))

    def test_forms_that_explode_are_given_up(self):
        pair = "union() { cube(%d); cube([30, %d, 1]); }"
        file = self.csg("intersection() { " + " ".join(pair % (i, i) for i in range(10, 22)) + " }")
        self.fails("csg", file, "--form", "normal", "--max-nodes", "1000", code=1, saying="1000 nodes")
        self.assertEqual(self.json(file, "--form", "normal")["form_nodes"], 4096 * 24 - 1)

    def test_empty_solids_have_no_bounds(self):
        apart = "intersection() { cube(1); multmatrix([[1,0,0,5],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) { cube(1); } }"
        for form in ("tree", "normal", "subnormal"):
            report = self.json(self.csg(apart), "--form", form)
            self.assertIsNone(report["bounds"])
            self.assertEqual(report["nodes"], 3)
        self.assertEqual(self.json(self.csg(apart), "--form", "normal")["form_nodes"], 0)

    def test_people_get_a_table(self):
        text = self.succeeds("csg", self.csg(PIERCED), "--form", "normal").stdout
        self.assertIn("2 primitives, 3 nodes, depth 2", text)
        self.assertIn("normal: 3 nodes, 1 product, 0 nodes pruned", text)
        self.assertIn("-5, -5, -5 to 5, 5, 5 mm", text)

    def test_help_names_every_option(self):
        text = self.succeeds("csg", "--help").stdout
        for word in ("--form ", "--inside ", "--mesh ", "--cell ", "--json ", "x,y,z", "Exit code"):
            self.assertIn(word, text)
        self.assertRegex(self.succeeds("--help").stdout, r"\n  csg +\S")


class ErrorTest(CsgTest):
    def test_wrong_usage(self):
        file = self.csg(PIERCED)
        self.fails("csg", code=2, saying="FILE.csg")
        self.fails("csg", file, "--form", "best", code=2, saying="--form")
        self.fails("csg", file, "--cell", "1", code=2, saying="--mesh")
        self.fails("csg", file, "--max-nodes", "0", code=2, saying="--max-nodes")
        for cell in ("0", "-1", "nan", "inf"):
            self.fails("csg", file, "--mesh", self.folder / "m.stl", f"--cell={cell}", code=2, saying="--cell")
        self.fails("csg", file, "--mesh", file, code=2, saying="--mesh")

    def test_bad_files_name_line_and_column(self):
        self.fails("csg", self.folder / "none.csg", code=1, saying="none.csg")
        self.fails("csg", self.csg("cube(1);\n  hull();"), code=1, saying="solid.csg:2:3: hull has no exact form")
        self.fails("csg", self.csg("cube([1, 2"), code=1, saying="solid.csg:1:11:")
        self.fails("csg", self.csg("group();"), code=1, saying="holds no solid")

    def test_bad_points_name_the_line(self):
        file = self.csg(PIERCED)
        for text, line in (("", 1), ("0,0,0\n", 1), ("x;y;z\n", 1), ("x,y,z\n0,0,0\n0,0\n", 3), ("x,y,z\n0,0,0,0\n", 2),
                           ("x,y,z\n0,nan,0\n", 2), ("x,y,z\n0,0,inf\n", 2), ("x,y,z\n0,,0\n", 2),
                           ("x,y,z\n0,0,1e999\n", 2), ("x,y,z\n0,0,0\n\n0,0,0\n", 3), ("x,y,z\na,0,0\n", 2)):
            points = self.write("points.csv", text)
            self.fails("csg", file, "--inside", points, code=1, saying=f"points.csv:{line}:")
        self.fails("csg", file, "--inside", self.folder / "none.csv", code=1, saying="none.csv")

    def test_meshes_that_cannot_be_made_leave_nothing_behind(self):
        old = self.write("old.stl", "of another day\n")
        self.fails("csg", self.csg("hull();"), "--mesh", old, code=1, saying="hull")
        apart = self.csg("intersection() { cube(1); multmatrix([[1,0,0,5],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) { cube(1); } }")
        self.fails("csg", apart, "--mesh", old, code=1, saying="the solid is empty")
        needle = self.csg("union() { sphere(r = 100, $fn = 0, $fa = 12, $fs = 2);"
                          " cylinder(h = 1000, r1 = 0.05, r2 = 0.05, center = true, $fn = 0, $fa = 12, $fs = 2); }")
        self.fails("csg", needle, "--mesh", old, "--cell", "100", code=1, saying="--cell")
        self.fails("csg", self.csg(PIERCED), "--mesh", self.folder / "no" / "m.stl", code=1, saying="m.stl")
        self.assertEqual(old.read_text(), "of another day\n")
        self.assertEqual(sorted(os.listdir(self.folder)), ["old.stl", "solid.csg"])


class InsideTest(CsgTest):
    def test_points_are_in_metres_and_answered_in_order(self):
        points = [(0.004, 0.0, 0.0), (0.0, 0.0, 0.0), (0.0, -0.003, 0.0049), (0.0, 0.003, 0.0051), (4.0, 0.0, 0.0)]
        self.assertEqual(self.inside(self.csg(PIERCED), points), [True, False, True, False, False])

    def test_line_ends_blanks_and_no_points_are_fine(self):
        file = self.csg("cube(1);")
        for text, answer in (("x,y,z\r\n 5e-4 , +.0005,5e-4\r\n2,0,0", "inside\n1\n0\n"), ("x,y,z\n", "inside\n"),
                             ("x,y,z\n0.1,0,0\n\n\n", "inside\n0\n")):
            points = self.write("points.csv", text)
            self.assertEqual(self.succeeds("csg", file, "--inside", points).stdout, answer)

    def test_json_holds_the_answers(self):
        file, points = self.csg(PIERCED), [(0.004, 0.0, 0.0), (0.0, 0.0, 0.0)]
        report = self.json(file, "--inside", self.points_file(points))
        self.assertEqual(report["inside"], [1, 0])
        self.assertEqual(report["nodes"], 3)
        self.assertNotIn("inside", self.json(file))

    def test_many_points(self):
        dice = random.Random(1)
        points = [tuple(dice.uniform(-0.006, 0.006) for _ in range(3)) for _ in range(100_000)]
        found = self.inside(self.csg(PIERCED), points)
        for (x, y, z), is_inside in zip(points, found):
            self.assertEqual(is_inside, max(abs(x), abs(y), abs(z)) <= 0.005 and x * x + y * y > 4e-6)


class AgreementTest(CsgTest):
    """The program against csg_evaluator.py, in all forms."""

    def check(self, file, count):
        wanted = csg_evaluator.read(file.read_text())
        box = self.json(file)["bounds"] or {"min": [-0.005] * 3, "max": [0.005] * 3}
        dice = random.Random(7)
        points, answers = [], []
        while len(points) < count:
            point = [dice.uniform(low - 0.05 * (high - low), high + 0.05 * (high - low))
                     for low, high in zip(box["min"], box["max"])]
            try:
                answers.append(bool(wanted([1000 * coordinate for coordinate in point])))
                points.append(tuple(point))
            except csg_evaluator.Undecided:
                pass
        for form in ("tree", "normal", "subnormal"):
            found = self.inside(file, points, "--form", form)
            wrong = [point for point, a, b in zip(points, answers, found) if a != b]
            self.assertFalse(wrong, f"{file}, {form}: {len(wrong)} points differ, such as {wrong[:3]}")
        return sum(answers)

    def test_shared_files(self):
        if not SHARED_CSG.exists():
            self.skipTest(f"the shared data is not here: {SHARED_CSG}")
        files = sorted(SHARED_CSG.rglob("*.csg"))
        self.assertEqual(len(files), 42)
        for file in files:
            if file.stem in REFUSED:
                self.fails("csg", file, code=1, saying=REFUSED[file.stem])
            else:
                held = self.check(file, 1500)
                self.assertEqual(held == 0, file.stem == "nullspace-intersection", file)

    def test_random_trees(self):
        for seed in range(12):
            self.check(self.csg(random_csg(random.Random(seed)), f"random{seed}.csg"), 400)


def random_csg(dice):
    """A tree of every kind of statement, with stretching, shearing and mirroring matrices."""
    def size(low=2.0, high=10.0):
        return round(dice.uniform(low, high), 3)

    def primitive():
        fn = dice.choice([0, 0, 2, 3, 5, 8, 13.7, 16, 17, 100])
        centred = dice.choice(["true", "false"])
        return dice.choice([
            f"cube(size = [{size()}, {size()}, {dice.choice([0, size(), size(), size()])}], center = {centred});",
            f"sphere($fn = {fn}, $fa = 12, $fs = 2, r = {size()});",
            f"cylinder($fn = {fn}, h = {size()}, r1 = {size()}, r2 = {dice.choice([0, size()])}, center = {centred});",
            f"polyhedron(points = [[0,0,0],[{size()},0,0],[0,{size()},0],[0,0,{size()}]], "
            "faces = [[0,1,2],[0,3,1],[0,2,3],[1,3,2]]);"])

    def matrix():
        rows = [[round(dice.gauss(i == j, 0.4), 3) for j in range(3)] + [size(-6, 6)] for i in range(3)]
        return f"multmatrix({rows + [[0, 0, 0, 1]]})"

    def statement(depth):
        mark = dice.choice([""] * 12 + ["#", "%", "*"])
        if depth == 0:
            return mark + primitive()
        name = dice.choice([matrix(), matrix(), "difference()", "difference()", "intersection()", "union()",
                            "group()", "color([1, 0, 0, 1])", "render(convexity = 1)"])
        return f"{mark}{name} {{\n" + "\n".join(statement(depth - 1) for _ in range(dice.randint(1, 3))) + "\n}"

    return "cube(size = [1, 1, 1], center = true);\n" + "\n".join(statement(dice.randint(2, 4)) for _ in range(3))


class MeshTest(CsgTest):
    def mesh(self, *arguments):
        file = self.folder / "mesh.stl"
        report = self.json(*arguments, "--mesh", file)
        data = file.read_bytes()
        count = struct.unpack_from("<I", data, 80)[0]
        self.assertEqual(len(data), 84 + 50 * count)
        self.assertEqual(report["mesh"]["triangles"], count)
        numbers = [struct.unpack_from("<12f", data, 84 + 50 * i)[3:] for i in range(count)]
        return report, [(row[0:3], row[3:6], row[6:9]) for row in numbers]

    def closed_volume(self, triangles):
        """In mm^3, of triangles of which each edge has two that run along it in opposite directions."""
        edges = set()
        volume = 0.0
        for a, b, c in triangles:
            for edge in ((a, b), (b, c), (c, a)):
                self.assertNotIn(edge, edges)
                edges.add(edge)
            volume += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2])
                       + a[2] * (b[0] * c[1] - b[1] * c[0])) / 6
        self.assertTrue(all((b, a) in edges for a, b in edges))
        return volume

    def test_meshes_are_closed_in_millimetres_and_near(self):
        report, triangles = self.mesh(self.csg(PIERCED), "--cell", "0.25")
        self.assertAlmostEqual(self.closed_volume(triangles), 1000 - 3.14159265 * 4 * 10, delta=1.0)
        self.assertAlmostEqual(report["mesh"]["cell"], 0.00025, delta=1e-12)
        self.assertLess(report["mesh"]["error"], 0.00002)
        self.assertEqual(max(x for triangle in triangles for x, _, _ in triangle), 5.0)
        self.assertEqual(sorted(os.listdir(self.folder)), ["mesh.stl", "solid.csg"])

    def test_flat_faces_are_exact_and_of_few_triangles(self):
        hexagon = 1.5 * 3 ** 0.5
        tetrahedron = ("polyhedron(points = [[0,0,0],[9,0,0],[0,9,0],[0,0,9]],"
                       " faces = [[0,1,2],[0,3,1],[0,2,3],[1,3,2]]);")
        for text, volume, most in (
                ("cylinder($fn = 6, h = 10, r1 = 2, r2 = 2);", 40 * hexagon, 20),
                ("cylinder($fn = 6, h = 9, r1 = 2, r2 = 0);", 12 * hexagon, 10),
                (tetrahedron, 121.5, 4),
                ("difference() { cube([20, 20, 5], center = true);"
                 " cylinder($fn = 6, h = 9, r1 = 2, r2 = 2, center = true); }",
                 5 * (400 - 4 * hexagon), 50)):
            report, triangles = self.mesh(self.csg(text))
            self.assertLessEqual(len(triangles), most, text)
            self.assertAlmostEqual(self.closed_volume(triangles), volume, delta=1e-3, msg=text)
            self.assertLess(report["mesh"]["error"], 1e-9)

    def test_round_holes_have_the_triangles_that_they_need(self):
        _, triangles = self.mesh(self.csg("difference() { cube([100, 100, 5], center = true);"
                                          " cylinder(h = 9, r1 = 5, r2 = 5, center = true); }"), "--cell", "0.05")
        self.assertLess(len(triangles), 900)
        self.assertAlmostEqual(self.closed_volume(triangles), 5 * (10000 - 3.14159265 * 25), delta=1.0)

    def test_by_default_a_side_has_two_hundred_cells(self):
        report, _ = self.mesh(self.csg("cube([2, 0.1, 0.1]);"))
        self.assertAlmostEqual(report["mesh"]["cell"], 1e-5, delta=1e-12)

    def test_people_are_told_about_the_mesh(self):
        text = self.succeeds("csg", self.csg("sphere(1);"), "--mesh", self.folder / "m.stl", "--cell", "0.2").stdout
        self.assertRegex(text, r"m\.stl: [\d,]+ triangles, at most \S+ um off the surface, cells of 200 um")
        told = run("csg", self.csg("sphere(1);"), "--mesh", self.folder / "m.stl", "--cell", "0.2", "--inside",
                   self.points_file([(0.0, 0.0, 0.0)]))
        self.assertEqual(told.stdout, "inside\n1\n")
        self.assertIn("triangles", told.stderr)


if __name__ == "__main__":
    unittest.main()
