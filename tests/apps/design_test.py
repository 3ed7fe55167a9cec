"""icome touch on designs: many bodies in one MODEL, each felt as what it is."""
import unittest

from icome_program import ProgramTest, line, point


class DesignTest(ProgramTest):
    def contact(self, file, start, end, *arguments):
        """Presses from `start` to `end` and holds; the last row of the trace, and the report."""
        points = line(start, end, 300) + [end] * 100
        path = self.path_file(points)
        rows = self.trace(file, "--path", path, *arguments)
        report = self.report(file, "--path", path, "--check", *arguments)
        self.assertEqual((report["pops"], report["sticks"]), (0, 0))
        self.assertEqual(rows[-1]["touching"], 1)
        return rows[-1]

    def assert_point(self, row, expected, delta=1e-7):
        for got, want in zip(point(row, "scp"), expected):
            self.assertAlmostEqual(got, want, delta=delta)


class JournalTest(DesignTest):
    SOLID = "difference() { cube(size = [80, 80, 80], center = true); cylinder(h = 200, r = 15, center = true); }\n"

    def test_a_csg_tree_in_a_design_is_felt_without_a_mesh(self):
        design = self.folder / "solid.icome"
        self.succeeds("convert", self.write("solid.csg", self.SOLID), design)
        row = self.contact(design, (0.02, 0, 0.1), (0.02, 0, 0.038))
        self.assert_point(row, (0.02, 0, 0.04))
        self.assertEqual(self.report(design, "--seconds", "0.1")["triangles"], 0)


if __name__ == "__main__":
    unittest.main()
