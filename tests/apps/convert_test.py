"""`icome convert` writes designs in other formats, whole or not at all, and tells what was lost."""
import json
import os
import pathlib
import unittest

from icome_program import ProgramTest

DEMO = pathlib.Path(__file__).resolve().parents[2] / "data" / "demo.wrl"
CUBE = ("OFF\n8 6 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 0.3\n1 0 0.3\n1 1 0.3\n0 1 0.3\n"
        "4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n")
ENDINGS = (".glb", ".gltf", ".obj", ".ply", ".stl", ".off", ".icome")


class ConvertTest(ProgramTest):
    def info(self, file):
        return json.loads(self.succeeds("info", file, "--json").stdout)

    def test_every_format_gives_back_what_it_was_given(self):
        source = self.write("cube.off", CUBE)
        for ending in ENDINGS:
            out = self.folder / f"out{ending}"
            self.succeeds("convert", source, out)
            report = self.info(out)
            self.assertEqual(report["triangles"], 12, ending)
            for got, want in zip(report["bounds"]["max"], [1, 1, 0.3]):
                self.assertAlmostEqual(got, want, delta=1e-6)

    def test_a_second_way_round_changes_nothing(self):
        source = self.write("cube.off", CUBE)
        first, second = self.folder / "a.off", self.folder / "b.off"
        self.succeeds("convert", source, first)
        self.succeeds("convert", first, second)
        self.assertEqual(first.read_text(), second.read_text())

    def test_a_file_can_take_its_own_place(self):
        file = self.write("cube.off", CUBE)
        self.succeeds("convert", file, file)
        self.assertEqual(self.info(file)["triangles"], 12)
        self.assertEqual([it.name for it in self.folder.iterdir()], ["cube.off"])

    def test_formats_of_designs_keep_exact_shapes(self):
        solid = self.write("solid.csg", "cube(size = [10, 20, 30], center = false);\n")
        for ending in (".glb", ".gltf", ".icome"):
            out = self.folder / f"out{ending}"
            self.succeeds("convert", solid, out)
            self.assertEqual(self.info(out)["shapes"], {"csg": 1})

    def test_vrml_through_gltf_and_back(self):
        table = self.write("table.wrl", "#VRML V2.0 utf8\nDEF table Transform { children [\n"
                           "  DEF leg Transform { translation 1 2 3 children Shape { geometry DEF box Box {} } }\n"
                           "  Transform { children Shape { geometry USE box } } ] }\n")
        self.succeeds("convert", table, self.folder / "table.glb")
        self.succeeds("convert", self.folder / "table.glb", self.folder / "back.wrl")
        first, last = self.info(table), self.info(self.folder / "back.wrl")
        for key in ("objects", "clones", "triangles", "materials", "textures", "bounds", "shapes", "depth"):
            self.assertEqual(first[key], last[key], key)

    def test_thin_solids_come_whole_and_are_counted_as_they_are_written(self):
        plate = self.write("plate.csg", "difference() { cube(size = [1000, 18, 1000], center = true);\n"
                           "cylinder(h = 3000, r1 = 100, r2 = 100, center = true, $fn = 0, $fa = 12, $fs = 2); }\n")
        slit = self.write("slit.csg", "difference() { cube(size = [1000, 1000, 1000], center = true);\n"
                          "multmatrix([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 100], [0, 0, 0, 1]]) {\n"
                          "cube(size = [2, 3000, 1000], center = true); } }\n")
        for solid, least, most in ((plate, 8, 60000), (slit, 12, 60)):
            for ending in (".glb", ".stl", ".obj", ".ply"):
                out = self.folder / f"out{ending}"
                done = json.loads(self.succeeds("convert", solid, out, "--json").stdout)
                self.assertEqual(done["triangles"], self.info(out)["triangles"], ending)
                self.assertGreaterEqual(done["triangles"], least)
                self.assertLessEqual(done["triangles"], most)

    def test_a_shape_without_triangles_is_told(self):
        nothing = self.write("nothing.csg", "difference() { cube(size = [10, 10, 10], center = true);\n"
                             "cube(size = [20, 20, 20], center = true); }\n")
        for ending in (".glb", ".stl", ".obj"):
            done = json.loads(self.succeeds("convert", nothing, self.folder / f"out{ending}", "--json").stdout)
            self.assertEqual(done["triangles"], 0)
            self.assertTrue(any("no triangles" in it for it in done["warnings"]), (ending, done["warnings"]))

    def test_what_would_be_lost_altogether_is_refused(self):
        """A formula for a sheet of 0.4 mm in a metre of box: exact as it is, too thin for triangles."""
        bounds = [[-0.5, -0.1, -0.5], [0.5, 0.1, 0.5]]
        edits = self.write("edits.jsonl", json.dumps(
            {"op": "create", "shape": "implicit", "formula": "abs(y)-0.0002", "bounds": bounds}) + "\n")
        design = self.folder / "sheet.icome"
        self.succeeds("edit", "new", "--apply", edits, "--out", design)
        self.fails("convert", design, self.folder / "sheet.stl", code=1, saying="too thin")
        self.assertFalse((self.folder / "sheet.stl").exists())

    def test_losses_are_told(self):
        solid = self.write("solid.csg", "cube(size = [10, 20, 30], center = false);\n")
        done = json.loads(self.succeeds("convert", solid, self.folder / "solid.ply", "--json").stdout)
        self.assertEqual(list(done), ["in", "out", "objects", "triangles", "bytes", "warnings"])
        self.assertEqual(done["objects"], 1)
        self.assertTrue(any("triangles" in warning for warning in done["warnings"]), done)

    def test_failures_leave_what_was_there(self):
        old = self.write("old.ply", "of another day\n")
        self.fails("convert", self.write("bad.off", "OFF\n1 1 0\n0 0 0\n3 0 1 2\n"), old, code=1, saying="bad.off")
        self.fails("convert", self.folder / "none.obj", old, code=1, saying="none.obj")
        self.assertEqual(old.read_text(), "of another day\n")
        self.assertEqual(sorted(it.name for it in self.folder.iterdir()), ["bad.off", "old.ply"])

    def damaged(self, cut):
        """A design of many objects, cut short; and how many it had."""
        whole = self.folder / "whole.icome"
        self.succeeds("convert", DEMO, whole)
        count = json.loads(self.succeeds("info", whole, "--json").stdout)["objects"]
        bad = self.folder / "bad.icome"
        bad.write_bytes(whole.read_bytes()[:-cut])
        return bad, count

    def test_a_damaged_design_gives_all_but_what_is_damaged(self):
        bad, count = self.damaged(100)
        told = json.loads(self.succeeds("info", bad, "--json").stdout)
        self.assertGreaterEqual(told["objects"], count - 1)
        self.assertTrue(any("damaged" in warning or "cut off" in warning for warning in told["warnings"]), told)
        data = bytearray((self.folder / "whole.icome").read_bytes())
        for share in (0.2, 0.5, 0.8):
            flipped = bytearray(data)
            flipped[int(len(data) * share)] ^= 4
            bad.write_bytes(flipped)
            told = json.loads(self.succeeds("info", bad, "--json").stdout)
            self.assertGreaterEqual(told["objects"], count - 1)
            self.assertTrue(any("is damaged" in warning for warning in told["warnings"]), told)

    def test_a_damaged_design_is_not_replaced_unasked(self):
        bad, _ = self.damaged(100)
        before = bad.read_bytes()
        source = self.write("cube.off", CUBE)
        script = self.write("none.jsonl", "")
        self.fails("convert", source, bad, code=1, saying="--force")
        self.fails("edit", bad, "--apply", script, "--out", bad, code=1, saying="--force")
        self.assertEqual(bad.read_bytes(), before)
        kept = self.folder / "bad.icome.lost"
        self.assertTrue(before.endswith(kept.read_bytes()))
        self.succeeds("edit", bad, "--apply", script, "--out", bad, "--force")
        self.assertNotEqual(bad.read_bytes(), before)
        self.assertEqual(json.loads(self.succeeds("info", bad, "--json").stdout)["warnings"], [])
        self.assertTrue(kept.exists())

    def test_places_that_cannot_be_written_are_named(self):
        source = self.write("cube.off", CUBE)
        self.fails("convert", source, self.folder / "no" / "a.ply", code=1, saying="a.ply")
        self.fails("convert", source, self.folder / "a.docx", code=1, saying=".ply")
        link = self.folder / "full.ply"
        link.symlink_to("/dev/full")
        self.fails("convert", source, link, code=1, saying="full.ply")
        self.fails("convert", source, code=2, saying="OUT")

    @unittest.skipIf(os.geteuid() == 0, "root may write anywhere")
    def test_a_folder_without_permission(self):
        source = self.write("cube.off", CUBE)
        self.folder.chmod(0o500)
        self.addCleanup(self.folder.chmod, 0o700)
        self.fails("convert", source, self.folder / "a.ply", code=1, saying="a.ply")


if __name__ == "__main__":
    unittest.main()
