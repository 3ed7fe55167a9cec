"""Surface contact points and forces against closed forms, through the whole program."""
import math
import unittest

from icome_program import ProgramTest, distance, length, line, point

STIFFNESS = 500.0  # N/m, so that 1 mm is 0.5 N, below every limit
RAMP_ROWS = 600    # forces grow from zero during the first 0.5 s


class ContactTest(ProgramTest):
    def touched(self, rows):
        touched = [row for row in rows if row["touching"] == 1]
        self.assertGreater(len(touched), len(rows) / 2)
        return touched

    def test_sphere(self):
        points = []
        for i in range(3000):
            polar, angle = 0.3 + 0.0008 * i, 0.003 * i
            radius = 0.05 + max(-0.002, 0.001 - 0.00001 * i)
            points.append((radius * math.sin(polar) * math.cos(angle), radius * math.sin(polar) * math.sin(angle),
                           radius * math.cos(polar)))
        for row in self.touched(self.trace("sphere:0.05", "--path", self.path_file(points))):
            tip = point(row, "tip")
            on_sphere = tuple(0.05 * value / length(tip) for value in tip)
            self.assertLess(distance(point(row, "scp"), on_sphere), 1e-9)

    def test_sphere_tip_rests_a_radius_away(self):
        points = line((0.0, 0.0, 0.06), (0.0, 0.01, 0.05), 2000)
        for row in self.trace("sphere:0.05", "--radius", "0.004", "--path", self.path_file(points)):
            if row["touching"] == 1:
                self.assertAlmostEqual(length(point(row, "scp")), 0.054, delta=1e-9)

    def test_box_face(self):
        points = line((0.01, 0.02, 0.052), (0.01, 0.02, 0.047), 200) + line((0.01, 0.02, 0.047), (-0.03, 0.0, 0.045), 800)
        for row in self.touched(self.trace("box:0.2x0.2x0.1", "--path", self.path_file(points))):
            self.assertLess(distance(point(row, "scp"), (row["tip_x"], row["tip_y"], 0.05)), 1e-9)

    def test_plane_and_its_force(self):
        points = line((0.0, 0.0, 0.001), (0.0, 0.0, -0.001), 100) + [(0.0, 0.0, -0.001)] * (RAMP_ROWS + 100)
        rows = self.touched(self.trace("plane", "--stiffness", STIFFNESS, "--path", self.path_file(points)))
        for row in rows:
            self.assertLess(distance(point(row, "scp"), (row["tip_x"], row["tip_y"], 0.0)), 1e-9)
        force = point(rows[-1], "force")
        self.assertLess(distance(force, (0.0, 0.0, 0.5)), 1e-6)

    def test_friction_holds_within_its_cone(self):
        # Pressed 2 mm deep, then 0.5 mm sideways: held with a static coefficient of 0.5, not with 0.1.
        points = line((0.0, 0.0, 0.001), (0.0, 0.0, -0.002), 100) + line((0.0, 0.0, -0.002), (0.0005, 0.0, -0.002), 700)
        path = self.path_file(points)
        held = self.trace("plane", "--friction", "0.5,0.5", "--path", path)[-1]
        self.assertAlmostEqual(held["scp_x"], 0.0, delta=1e-6)
        slid = self.trace("plane", "--friction", "0.1,0.1", "--path", path)[-1]
        self.assertAlmostEqual(slid["scp_x"], 0.0005 - 0.1 * 0.002, delta=1e-5)

    def test_front_sides_let_a_tip_out_and_both_sides_hold_it(self):
        # A square sheet: from below, only both sides touch.
        sheet = self.write("sheet.obj", "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n")
        path = self.path_file(line((0.1, 0.2, -0.01), (0.1, 0.2, 0.002), 400))
        self.assertEqual(self.trace(sheet, "--path", path)[-1]["touching"], 1)
        self.assertEqual(self.trace(sheet, "--sides", "front", "--path", path)[-1]["touching"], 0)


class UnitsTest(ProgramTest):
    CORNERS = [(x, y, z) for x in (-0.05, 0.05) for y in (-0.05, 0.05) for z in (-0.05, 0.05)]
    FACES = "f 1 2 4 3\nf 5 7 8 6\nf 1 5 6 2\nf 3 4 8 7\nf 1 3 7 5\nf 2 6 8 4\n"

    def cube(self, name, scale):
        lines = "".join("v {!r} {!r} {!r}\n".format(*(scale * value for value in corner)) for corner in self.CORNERS)
        return self.write(name, lines + self.FACES)

    def test_the_same_cube_in_metres_and_millimetres_feels_the_same(self):
        path = self.path_file(line((0.01, 0.02, 0.052), (-0.02, 0.01, 0.048), 1500))
        arguments = ("--path", path, "--friction", "0.3,0.2")
        metres = self.trace(self.cube("m.obj", 1.0), *arguments, name="m.csv")
        for other in (("mm.obj", 1000.0, "--unit", "mm"), ("cm.obj", 100.0, "--unit", "cm"),
                      ("any.obj", 77.0, "--fit", "0.1")):
            rows = self.trace(self.cube(*other[:2]), *other[2:], *arguments, name="other.csv")
            for row, expected in zip(rows, metres, strict=True):
                self.assertEqual(row["touching"], expected["touching"])
                self.assertLess(distance(point(row, "force"), point(expected, "force")), 1e-9)
                self.assertLess(distance(point(row, "scp"), point(expected, "scp")), 1e-9)

    def test_up_z_turns_the_files_z_to_the_worlds_y(self):
        # A sheet z = 0.03 in the file lies at y = 0.03 in the world.
        sheet = self.write("sheet.obj", "v -1 -1 0.03\nv 1 -1 0.03\nv 1 1 0.03\nv -1 1 0.03\nf 1 2 3 4\n")
        path = self.path_file(line((0.1, 0.04, 0.2), (0.1, 0.029, 0.2), 300))
        row = self.trace(sheet, "--up", "z", "--path", path)[-1]
        self.assertLess(distance(point(row, "scp"), (0.1, 0.03, 0.2)), 1e-9)


if __name__ == "__main__":
    unittest.main()
