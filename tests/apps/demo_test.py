"""The demo design: everything in it is there, can be touched without a fault, and is drawn from every viewpoint."""
import json
import pathlib
import unittest

from icome_program import BUNNY, ProgramTest

DEMO = pathlib.Path(__file__).resolve().parents[2] / "data" / "demo.wrl"
VIEWPOINTS = ("Front", "Bunny", "Solid", "Knot", "Sea", "Above")


class DemoTest(ProgramTest):
    def test_all_of_it_is_read(self):
        if not BUNNY.exists():
            self.skipTest(f"{BUNNY} is not there: install glmark2-data")
        report = json.loads(self.succeeds("info", DEMO, "--json").stdout)
        self.assertEqual(report["warnings"], [])
        self.assertEqual(report["shapes"], {"csg": 2, "implicit": 1, "loop": 1, "mesh": 1, "primitive": 3})
        self.assertEqual((report["lights"], report["viewpoints"], report["scenes"]), (2, 6, 2))
        self.assertEqual(report["clones"], 3)
        self.assertGreater(report["triangles"], 69666)
        width = report["bounds"]["max"][0] - report["bounds"]["min"][0]
        self.assertTrue(0.3 < width < 0.5, "it stands on a desk")

    def test_it_is_touched_without_pops(self):
        report = self.report(DEMO, "--up", "y", "--check", "--seconds", "2")
        self.assertEqual((report["pops"], report["sticks"]), (0, 0))
        self.assertGreater(report["touch_fraction"], 0.05)

    def test_it_is_drawn_from_its_viewpoints(self):
        pictures = set()
        for name in ("Front", "Bunny"):
            out = self.folder / f"{name}.png"
            self.succeeds("shot", DEMO, out, "--view", name, "--size", "96x60")
            pictures.add(out.read_bytes())
        self.assertEqual(len(pictures), 2)
        self.fails("shot", DEMO, out, "--view", "Nowhere", code=1,
                   saying=", ".join(f'"{name}"' for name in sorted(VIEWPOINTS)))

    def test_saved_again_it_needs_no_other_file(self):
        saved = self.folder / "saved.wrl"
        self.succeeds("convert", DEMO, saved)
        self.assertNotIn("glmark2", saved.read_text())
        before = json.loads(self.succeeds("info", DEMO, "--json").stdout)
        after = json.loads(self.succeeds("info", saved, "--json").stdout)
        for field in ("objects", "triangles", "materials", "clones", "lights", "viewpoints", "scenes"):
            self.assertEqual(after[field], before[field], field)


if __name__ == "__main__":
    unittest.main()
