"""`icome shot` draws a design into a picture, without a window."""
import json
import os
import unittest

from icome_program import ProgramTest, run
from png_pixels import pixels

# A red plate in front (z = 1), a green one behind, both facing +z.
PLATES = """o front
v -1 -1 1
v 1 -1 1
v 1 1 1
v -1 1 1
f 1 2 3 4
o behind
v -3 -1 -1
v 3 -1 -1
v 3 1 -1
v -3 1 -1
f 5 6 7 8
"""


class ShotTest(ProgramTest):
    def setUp(self):
        super().setUp()
        self.out = self.folder / "out.png"

    def shot(self, file, *arguments):
        report = json.loads(self.succeeds("shot", file, self.out, "--json", *arguments).stdout)
        width, height, rows = pixels(self.out)
        self.assertEqual((report["width"], report["height"]), (width, height))
        return report, rows

    def coloured_plates(self):
        """A PLY file with colours: a red square in front of a wider green one."""
        corners = [(-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1), (-3, -1, -1), (3, -1, -1), (3, 1, -1), (-3, 1, -1)]
        lines = ["ply", "format ascii 1.0", "element vertex 8"]
        lines += [f"property float {c}" for c in "xyz"] + [f"property uchar {c}" for c in ("red", "green", "blue")]
        lines += ["element face 4", "property list uchar int vertex_indices", "end_header"]
        lines += [f"{x} {y} {z} " + ("230 0 0" if i < 4 else "0 230 0") for i, (x, y, z) in enumerate(corners)]
        lines += ["3 0 1 2", "3 0 2 3", "3 4 5 6", "3 4 6 7"]
        return self.write("plates.ply", "\n".join(lines) + "\n")

    def test_draws_what_is_there(self):
        report, rows = self.shot(self.coloured_plates(), "--view", "front", "--size", "120x60")
        self.assertEqual((report["view"], report["objects"], report["triangles"]), ("front", 1, 4))
        self.assertEqual(report["file"], str(self.out))
        self.assertEqual(report["warnings"], [])
        self.assertGreater(report["seconds"], 0)
        red, green = rows[30][60], rows[30][20]
        self.assertGreater(red[0], 2 * red[1])
        self.assertGreater(green[1], 2 * green[0])
        _, rows = self.shot(self.coloured_plates(), "--view", "back", "--size", "120x60")
        self.assertGreater(rows[30][60][1], 2 * rows[30][60][0])

    def test_people_get_a_line(self):
        done = self.succeeds("shot", self.write("p.obj", PLATES), self.out, "--size", "40x30")
        self.assertRegex(done.stdout, r"out\.png: 40 x 30 pixels, view iso, \d objects?, 4 triangles, read in ")

    def test_backgrounds(self):
        file = self.coloured_plates()
        for name, corner in (("#102030", (16, 32, 48, 255)), ("white", (255, 255, 255, 255)), ("none", (0, 0, 0, 0))):
            _, rows = self.shot(file, "--view", "top", "--size", "64x64", "--background", name)
            for got, want in zip(rows[0][0], corner):
                self.assertAlmostEqual(got, want, delta=2)

    def test_each_eye_gets_its_picture(self):
        file = self.coloured_plates()
        common = ["--view", "front", "--size", "120x80", "--background", "black"]
        _, left = self.shot(file, *common, "--eye", "-40,0,600")
        _, right = self.shot(file, *common, "--eye", "40,0,600")
        self.assertNotEqual(left, right)
        stereo = ["--eye-distance-mm", "80", "--stereo"]
        report, both = self.shot(file, *common, *stereo, "side-by-side")
        self.assertEqual((report["width"], report["height"], report["stereo"]), (240, 80, "side-by-side"))
        self.assertEqual([row[:120] for row in both], left)
        self.assertEqual([row[120:] for row in both], right)
        _, both = self.shot(file, *common, *stereo, "top-bottom")
        self.assertEqual(both, left + right)
        _, both = self.shot(file, *common, *stereo, "anaglyph")
        for row, of_left, of_right in zip(both, left, right):
            self.assertEqual(row, [(l[0], r[1], r[2], r[3]) for l, r in zip(of_left, of_right)])

    def test_the_screen_is_a_window(self):
        """The red plate lies before the screen's plane, which goes through the middle of both, the green one behind it."""
        def left_edge(rows, is_colour):
            row = rows[len(rows) // 2]
            return next(x for x, pixel in enumerate(row) if is_colour(pixel))
        file = self.coloured_plates()
        common = ["--view", "front", "--background", "black", "--screen", "600x400"]
        def red(pixel):
            return pixel[0] > 2 * pixel[1] and pixel[0] > 40
        report, _ = self.shot(file, "--view", "front", "--screen", "1000x50")
        self.assertEqual((report["width"], report["height"]), (1280, 64))  # square pixels
        _, straight = self.shot(file, *common, "--size", "300x200")
        _, aside = self.shot(file, *common, "--size", "300x200", "--eye", "150,0,600")
        # A metre of the world is the same everywhere on the plane of the screen (z = 0), where a pixel has m metres. A
        # red edge at x = -1, z = 1 is seen there at e + (x - e) d / (d - 1), for an eye e to the right and d before it.
        self.assertLess(left_edge(aside, red), left_edge(straight, red))
        shift = left_edge(straight, red) - left_edge(aside, red)
        first = 150 - left_edge(straight, red)  # pixels from the middle, of 1 m * d / (d - 1)
        # The screen's 600 mm are 300 pixels, so that the eye's 600 mm before it are d = 300 pixels * m, and e = 75 pixels * m:
        # first = (1 / m) d / (d - 1) = 300 / (300 m - 1), and the shift is e (d / (d - 1) - 1) / m = 75 / (300 m - 1).
        self.assertAlmostEqual(shift, 75 / 300 * first, delta=1.5)
        self.fails("shot", file, self.out, "--screen", "600x400", "--size", "100x100", code=2, saying="--screen")
        self.fails("shot", file, self.out, "--screen", "600", code=2, saying="520x320")
        self.fails("shot", file, self.out, "--eye", "0,0,-600", code=2, saying="towards you")
        self.fails("shot", file, self.out, "--stereo", "shutter", code=2, saying="shutter")

    def test_up_can_be_chosen(self):
        file = self.coloured_plates()
        _, rows = self.shot(file, "--view", "top", "--up", "z", "--size", "60x60")
        self.assertGreater(rows[30][30][0], 2 * rows[30][30][1])

    def test_solids_are_drawn(self):
        solid = self.write("solid.csg", "difference() { cube([10, 10, 10], center = true); sphere(r = 6); }\n")
        report, rows = self.shot(solid, "--size", "80x80")
        self.assertGreater(report["triangles"], 100)

    def test_an_empty_design_is_an_empty_picture_and_told(self):
        report, rows = self.shot(self.write("empty.off", "OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n"), "--size", "8x8")
        self.assertEqual(report["objects"], 0)
        self.assertIn("nothing to see", report["warnings"][-1])

    def test_wrong_usage(self):
        file = self.write("p.obj", PLATES)
        for size in ("0x10", "10", "10x", "16385x10", "-1x5", "axb", "10x10x10", "1e3x10"):
            self.fails("shot", file, self.out, f"--size={size}", code=2, saying="--size")
        for colour in ("blue", "#12345", "#12345g", "#1234567"):
            self.fails("shot", file, self.out, "--background", colour, code=2, saying="--background")
        self.fails("shot", file, code=2, saying="OUT.png")
        self.fails("shot", file, file, code=2, saying="replace the design")
        self.assertEqual(os.listdir(self.folder), ["p.obj"])

    def test_other_endings_are_refused(self):
        file = self.write("p.obj", PLATES)
        for name in ("p.jpg", "p.png.jpeg", "p", "p.webp"):
            self.fails("shot", file, self.folder / name, code=1, saying="ends in .png")
        self.fails("touch", file, "--picture", self.folder / "p.jpg", code=1, saying="ends in .png")
        self.fails("techniques", "--picture", self.folder / "p.jpg", code=1, saying="ends in .png")
        self.assertEqual(os.listdir(self.folder), ["p.obj"])
        self.succeeds("shot", file, self.folder / "P.PNG", "--size", "8x8")

    def test_what_cannot_be_done_leaves_nothing_behind(self):
        self.out.write_text("of another day\n")
        file = self.write("p.obj", PLATES)
        self.fails("shot", self.folder / "none.obj", self.out, code=1, saying="none.obj")
        self.fails("shot", self.write("bad.obj", "f 1 2 3\n"), self.out, code=1, saying="bad.obj")
        self.fails("shot", file, self.out, "--view", "roof", code=1, saying='no view "roof"')
        self.fails("shot", file, self.out, "--scene", "cellar", code=1, saying='no scene "cellar"')
        self.fails("shot", file, self.folder / "no" / "out.png", code=1, saying="out.png")
        self.assertEqual(self.out.read_text(), "of another day\n")
        self.assertEqual(sorted(os.listdir(self.folder)), ["bad.obj", "out.png", "p.obj"])

    def test_no_driver_is_told_with_what_to_install(self):
        os.environ["__EGL_VENDOR_LIBRARY_DIRS"] = "/no/such/folder"
        self.addCleanup(os.environ.pop, "__EGL_VENDOR_LIBRARY_DIRS")
        self.fails("shot", self.write("p.obj", PLATES), self.out, code=1, saying="install libegl-mesa0")
        self.assertFalse(self.out.exists())

    def test_help_names_every_option(self):
        text = self.succeeds("shot", "--help").stdout
        for word in ("--size ", "--view ", "--scene ", "--background ", "--studio", "--up ", "--unit ", "--json",
                     "Exit code"):
            self.assertIn(word, text)
        self.assertRegex(self.succeeds("--help").stdout, r"\n  shot +\S")


if __name__ == "__main__":
    unittest.main()
