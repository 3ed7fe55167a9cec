"""icome touch on what is touched without a mesh: CSG trees, Loop surfaces, formulas."""
import json
import math
import unittest

from icome_program import ProgramTest, SHARED_MESHES

SHARED_CSG = SHARED_MESHES.parent / "csg"
PIERCED = """difference() {
  intersection() { cube(size = [80, 80, 80], center = true); sphere(r = 50); }
  cylinder(h = 200, r1 = 15, r2 = 15, center = true);
}
"""
OCTAHEDRON = "".join(f"v {p}\n" for p in ("1 0 0", "-1 0 0", "0 1 0", "0 -1 0", "0 0 1", "0 0 -1")) + "".join(
    f"f {f}\n" for f in ("1 3 5", "3 2 5", "2 4 5", "4 1 5", "3 1 6", "2 3 6", "4 2 6", "1 4 6"))
WAVES = ("--implicit", "z - 0.005*sin(60*x + 3*t)*cos(60*y)", "--bounds", "0.1,0.1,0.06")


class ExactTest(ProgramTest):
    def touched(self, *arguments):
        return json.loads(self.succeeds("touch", *arguments, "--seconds", "0.5", "--check", "--json").stdout)

    def assert_sound(self, report):
        self.assertGreater(report["touch_fraction"], 0.05)
        self.assertEqual((report["pops"], report["sticks"]), (0, 0))

    def press(self, *arguments):
        """Presses straight down by 2 mm in the middle; the last row of the trace."""
        path = self.write("down.csv", "t,x,y,z\n" + "".join(
            f"{i / 1000},0.022,0,{0.08 - 0.0001 * min(i, 420)}\n" for i in range(500)))
        return self.trace(*arguments, "--path", path)[-1]


class CsgTest(ExactTest):
    def press(self, file, *arguments):
        # As the solid lies in the file, so that its z is the world's.
        return super().press(file, "--up", "y", *arguments)

    def test_a_solid_is_touched_without_a_mesh(self):
        report = self.touched(self.write("pierced.csg", PIERCED))
        self.assert_sound(report)
        self.assertEqual(report["triangles"], 0)

    def test_the_contact_lies_on_the_cut_face(self):
        row = self.press(self.write("pierced.csg", PIERCED))
        self.assertEqual(row["touching"], 1)
        self.assertAlmostEqual(row["scp_z"], 0.04, delta=1e-9)  # the top of the cube, from the file's mm
        self.assertAlmostEqual(row["scp_x"], 0.022, delta=1e-6)

    def test_the_renderer_of_the_thesis_gives_the_same_face(self):
        row = self.press(self.write("pierced.csg", PIERCED), "--renderer", "thesis")
        self.assertAlmostEqual(row["scp_z"], 0.04, delta=1e-9)

    def test_fit_scales_the_solid(self):
        row = self.press(self.write("pierced.csg", PIERCED), "--fit", "0.08")
        self.assertAlmostEqual(row["scp_z"], 0.04, delta=1e-9)

    def test_a_tip_with_a_radius_feels_the_exact_solid(self):
        file = self.write("pierced.csg", PIERCED)
        said = self.succeeds("touch", file, "--radius", "0.002", "--seconds", "0.1").stdout
        self.assertIn("feels it exactly", said)
        self.assertAlmostEqual(self.press(file, "--radius", "0.002")["scp_z"], 0.042, delta=1e-9)

    def test_a_tip_with_a_radius_says_why_it_feels_a_mesh(self):
        file = self.write("egg.csg", "multmatrix([[1,0,0,0],[0,1,0,0],[0,0,2,0],[0,0,0,1]]) { sphere(r = 20); }")
        said = self.succeeds("touch", file, "--radius", "0.002", "--seconds", "0.1").stdout
        self.assertRegex(said, r"is felt as \d+ triangles")
        self.assertIn("curved primitives are stretched", said)

    def test_an_empty_solid_is_refused(self):
        file = self.write("apart.csg", "intersection() { cube(1); multmatrix([[1,0,0,5],[0,1,0,0],[0,0,1,0],"
                                       "[0,0,0,1]]) { cube(1); } }")
        self.fails("touch", file, code=1, saying="is empty: there is nothing to touch")

    def test_what_leaves_nothing_is_empty(self):
        ball = "sphere(r = 5);"
        file = self.write("taken.csg", f"difference() {{ intersection() {{ {ball} cube([8, 8, 8]); }} {ball} }}")
        self.fails("touch", file, code=1, saying="is empty: there is nothing to touch")
        self.fails("csg", file, "--mesh", self.folder / "taken.stl", code=1, saying="the solid is empty")
        design = self.folder / "taken.wrl"
        self.succeeds("convert", file, design)
        self.fails("touch", design, code=1, saying="is empty: there is nothing to touch")

    def test_thin_solids_are_solids(self):
        thin = {"plate": "cube(size = [200, 200, 0.2], center = true);",
                "rod": "cylinder(h = 100, r1 = 0.05, r2 = 0.05, center = true);",
                "tube": "difference() { cylinder(h = 100, r1 = 0.4, r2 = 0.4, center = true);"
                        " cylinder(h = 120, r1 = 0.3, r2 = 0.3, center = true); }"}
        path = self.path_file([(0.00035, 0, 0.06 - 0.0002 * i) for i in range(300)])
        for name, text in thin.items():
            file = self.write(f"{name}.csg", text)
            self.assertEqual(self.touched(file)["pops"], 0, name)
            design = self.folder / f"{name}.wrl"
            self.succeeds("convert", file, design)
            self.assertGreater(self.touched(design)["touch_fraction"], 0.05, name)
            mesh = self.folder / f"{name}.stl"
            self.succeeds("convert", file, mesh)
            self.assertGreater(self.touched(mesh)["triangles"], 10, name)
        # Down the wall of the tube, 0.1 mm thick: the tip rests on its upper end.
        row = self.trace(self.folder / "tube.csg", "--up", "y", "--path", path)[-1]
        self.assertEqual(row["touching"], 1)
        self.assertAlmostEqual(row["scp_z"], 0.05, delta=1e-9)

    def test_thousands_of_nested_operations_start_at_once(self):
        def ball(i, radius):
            return (f"multmatrix([[1,0,0,{i * 37 % 181 - 90}],[0,1,0,{i * 53 % 179 - 89}],[0,0,1,{i * 71 % 173 - 86}],"
                    f"[0,0,0,1]]) {{ sphere(r = {radius}); }}")
        trees = {}
        for operation in ("difference", "union"):
            text = "cube(size = [200, 200, 200], center = true);"
            for i in range(3000):
                text = f"{operation}() {{ {text} {ball(i, 2)} }}"
            trees[operation] = text
        shells = "sphere(r = 1);"
        for i in range(3000):
            shells = f"difference() {{ sphere(r = {1 + 0.03 * (i + 1)}); {shells} }}"
        trees["shells"] = shells
        path = self.path_file([(0, 0, 0.2 - 0.001 * i) for i in range(10)])
        for name, text in trees.items():
            file = self.write(f"{name}.csg", text)
            self.assertEqual(self.report(file, "--path", path)["triangles"], 0, name)

    def test_shared_files_are_touched(self):
        if not SHARED_CSG.is_dir():
            self.skipTest(f"the shared .csg files are not at {SHARED_CSG}")
        for name in ("example001", "example003", "difference_cube", "CSG-modules", "polyhedron-concave-test"):
            with self.subTest(name):
                self.assert_sound(self.touched(SHARED_CSG / "pure" / f"{name}.csg"))


class LoopTest(ExactTest):
    def test_the_limit_of_a_control_mesh_is_touched(self):
        self.assert_sound(self.touched(self.write("o.obj", OCTAHEDRON), "--fit", "0.1", "--subdivide", "limit"))

    def test_creases_keep_the_edges(self):
        control = self.write("o.obj", OCTAHEDRON)
        smooth = self.succeeds("touch", control, "--subdivide", "limit", "--seconds", "0.1").stdout
        sharp = self.succeeds("touch", control, "--subdivide", "limit", "--crease", "60", "--seconds", "0.1").stdout
        self.assertIn("0 sharp edges", smooth)
        self.assertIn("12 sharp edges", sharp)

    def test_a_tip_with_a_radius_feels_the_exact_limit(self):
        file = self.write("o.obj", OCTAHEDRON)
        arguments = ("--fit", "0.1", "--subdivide", "limit", "--radius", "0.002")
        self.assertIn("feels it exactly", self.succeeds("touch", file, *arguments, "--seconds", "0.1").stdout)
        # By Loop's limit mask, a vertex among four others that balance goes to 1 - 4 / (4 + 3 / (8 beta)) of its
        # place, with 4 beta = 5/8 - (3/8)^2.
        beta = (5 / 8 - (3 / 8) ** 2) / 4
        top = 0.05 * (1 - 4 / (4 + 3 / (8 * beta)))
        path = self.path_file([(0, 0, 0.08 - 0.0001 * i) for i in range(700)])
        self.assertAlmostEqual(self.trace(file, *arguments, "--path", path)[-1]["scp_z"], top + 0.002, delta=1e-8)

    def test_the_thesis_renders_levels(self):
        report = self.touched(self.write("o.obj", OCTAHEDRON), "--fit", "0.1", "--subdivide", "thesis:3")
        self.assertGreater(report["touch_fraction"], 0.05)


def above_valley(x, z):
    """The nearest place to (x, z) with z >= x and z >= -2 x: of the two sides of the groove and its bottom."""
    free = [p for p in ((x, z), ((x + z) / 2,) * 2, ((x - 2 * z) / 5, -2 * (x - 2 * z) / 5), (0.0, 0.0))
            if p[1] >= max(p[0], -2 * p[0]) - 1e-12]
    return min(free, key=lambda p: (p[0] - x) ** 2 + (p[1] - z) ** 2)


class ImplicitTest(ExactTest):
    VALLEY = ("--implicit", "z - max(x, -2*x)", "--bounds", "0.2,0.2,0.1")

    def way(self, name, places):
        return self.write(name, "t,x,y,z\n" + "".join(
            f"{i / 1000},{x:.12f},{y:.12f},{z:.12f}\n" for i, (x, y, z) in enumerate(places)))

    def test_waves_are_touched_while_they_move(self):
        self.assert_sound(self.touched(*WAVES))

    def test_time_moves_the_surface_under_a_still_tip(self):
        path = self.write("still.csv", "t,x,y,z\n" + "".join(f"{i / 1000},0,0,-0.001\n" for i in range(1500)))
        heights = [row["scp_z"] for row in self.trace(*WAVES, "--path", path)]
        self.assertGreater(max(heights) - min(heights), 0.003)

    def test_a_groove_holds_the_contact_on_both_sides(self):
        places = [(0.012 * math.sin(0.02 * i), 0.00001 * i, 0.045 - min(0.055, 0.0005 * i)) for i in range(600)]
        rows = self.trace(*self.VALLEY, "--path", self.way("groove.csv", places))
        for (x, y, z), row in zip(places, rows):
            expected = above_valley(x, z)
            self.assertAlmostEqual(row["scp_x"], expected[0], delta=1e-9)
            self.assertAlmostEqual(row["scp_y"], y, delta=1e-9)
            self.assertAlmostEqual(row["scp_z"], expected[1], delta=1e-9)

    def test_creases_and_poles_hold_under_the_exploring_hand(self):
        for formula in ("z - max(x, -2*x)", "min(z - 0.01*sin(50*x), x)", "1/x", "z - abs(x)"):
            with self.subTest(formula):
                self.assert_sound(self.touched("--implicit", formula, "--bounds", "0.2,0.2,0.1"))

    def test_a_crease_that_moves_takes_the_contact_along(self):
        formula = "z - max(x - 0.01*sin(20*t), -2*(x - 0.01*sin(20*t)))"
        places = [(0.01 * math.cos(0.013 * i), 0.0, 0.06 - min(0.065, 0.0005 * i)) for i in range(1500)]
        rows = self.trace("--implicit", formula, "--bounds", "0.1", "--path", self.way("moving.csv", places))
        off = []
        for i, ((x, _, z), row) in enumerate(zip(places, rows)):
            groove = 0.01 * math.sin(0.02 * i)
            expected = above_valley(x - groove, z)
            off.append(math.hypot(row["scp_x"] - groove - expected[0], row["scp_z"] - expected[1]))
        self.assertLess(max(off), 0.0002)  # as far as the groove moves in a tick
        self.assertLess(sorted(off)[-len(off) // 100], 1e-8)

    def test_a_tip_with_a_radius_feels_the_exact_surface(self):
        said = self.succeeds("touch", *self.VALLEY, "--radius", "0.002", "--seconds", "0.1").stdout
        self.assertIn("feels it exactly", said)
        places = [(0.0, 0.0, 0.045 - min(0.055, 0.0005 * i)) for i in range(200)]
        last = self.trace(*self.VALLEY, "--radius", "0.002", "--path", self.way("ball.csv", places))[-1]
        # In the groove, a radius from both of its sides.
        x, z = last["scp_x"], last["scp_z"]
        self.assertAlmostEqual((z - x) / math.sqrt(2), 0.002, delta=1e-9)
        self.assertAlmostEqual((z + 2 * x) / math.sqrt(5), 0.002, delta=1e-9)

    def test_waves_that_move_lift_a_tip_with_a_radius(self):
        formula = "z - 0.01*sin(50*x + 4*t)"
        path = self.way("lifted.csv", [(0.0, 0.0, 0.04 - min(0.045, 0.0005 * i)) for i in range(300)])
        rows = self.trace("--implicit", formula, "--bounds", "0.1", "--radius", "0.002", "--path", path)
        for row in rows[100:]:
            near = min(math.hypot(x - row["scp_x"], 0.01 * math.sin(50 * x + 4 * row["t"]) - row["scp_z"])
                       for x in (row["scp_x"] + 1e-5 * i for i in range(-250, 251)))
            self.assertAlmostEqual(near, 0.002, delta=1e-7)

    def test_a_tip_with_a_radius_says_why_it_feels_a_mesh_of_a_formula(self):
        cone = ("--implicit", "x^2 + y^2 - z^2", "--bounds", "0.1", "--radius", "0.002")
        said = self.succeeds("touch", *cone, "--seconds", "0.1").stdout
        self.assertIn("comes to a point", said)

    def test_bad_formulas_name_the_column(self):
        self.fails("touch", "--implicit", "x + * y", "--bounds", "0.1", code=1, saying="column")


class UsageTest(ExactTest):
    def test_options_that_do_not_go_together(self):
        file = self.write("o.obj", OCTAHEDRON)
        for arguments, code, word in ((("--implicit", "x"), 1, "--bounds"), ((file, "--bounds", "1"), 2, "--implicit"),
                                ((file, "--renderer", "thesis"), 1, "--subdivide"),
                                ((file, "--crease", "30"), 2, "--subdivide"),
                                ((file, "--subdivide", "thesis:3", "--renderer", "exact"), 2, "--renderer"),
                                ((file, "--subdivide", "fine"), 2, "limit"), ((), 2, "MODEL"),
                                (("--implicit", "x", "--bounds", "1,2"), 2, "--bounds"),
                                ((file, "--renderer", "voxels"), 2, "thesis")):
            with self.subTest(arguments):
                self.fails("touch", *arguments, code=code, saying=word)


if __name__ == "__main__":
    unittest.main()
