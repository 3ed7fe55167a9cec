"""`icome info` tells what is in a design file, for people and for scripts, and what could not be read."""
import json
import unittest

from icome_program import ProgramTest, SHARED_MESHES, run

TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 2 0\nf 1 2 3\n"
CSG = "difference() { cube(size = [10, 20, 30], center = false); sphere($fn = 0, $fa = 12, $fs = 2, r = 5); }\n"


class InfoTest(ProgramTest):
    def info(self, *arguments):
        return json.loads(self.succeeds("info", *arguments, "--json").stdout)

    def test_a_mesh_is_one_object(self):
        report = self.info(self.write("part.obj", TRIANGLE))
        self.assertEqual(list(report)[:7],
                         ["objects", "clones", "triangles", "materials", "textures", "bounds", "warnings"])
        self.assertEqual([report[key] for key in list(report)[:5]], [1, 0, 1, 0, 0])
        self.assertEqual(report["bounds"], {"min": [0, 0, 0], "max": [1, 2, 0]})
        self.assertEqual(report["warnings"], [])

    def test_units_are_for_formats_without_one(self):
        report = self.info(self.write("part.obj", TRIANGLE), "--unit", "mm")
        self.assertEqual(report["bounds"]["max"], [0.001, 0.002, 0])
        solid = self.info(self.write("solid.csg", CSG), "--unit", "m")
        self.assertEqual(solid["shapes"], {"csg": 1})
        for got, want in zip(solid["bounds"]["max"], [0.01, 0.03, 0.0]):  # turned
            self.assertAlmostEqual(got, want, delta=1e-9)

    def test_what_is_skipped_is_told(self):
        file = self.write("part.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n0 1 0\nnan 0 0\n3 0 1 2\n3 0 1 3\n")
        report = self.info(file)
        self.assertEqual(report["triangles"], 1)
        self.assertEqual(len(report["warnings"]), 1)
        self.assertTrue(report["warnings"][0].startswith(f"{file}: 1 triangle"), report["warnings"])

    def test_people_get_a_table_and_the_tree(self):
        text = self.succeeds("info", self.write("part.obj", TRIANGLE)).stdout
        for word in ("objects", "triangles", "bounds", "part ", "mesh, 1 triangle"):
            self.assertIn(word, text)

    def test_what_cannot_be_read_is_told_in_a_sentence(self):
        self.fails("info", self.folder / "none.obj", code=1, saying="none.obj")
        self.fails("info", self.folder, code=1, saying=str(self.folder))
        self.fails("info", self.write("text.docx", "?"), code=1, saying=".ply")
        self.fails("info", self.write("noise.ply", "ply\n???\n"), code=1, saying="noise.ply:2")
        self.fails("info", code=2, saying="FILE")
        self.fails("info", "a.obj", "--unit", "furlong", code=2, saying="--unit")
        self.fails("info", self.write("a.off", "OFF\n"), "--objects", "-1", code=2, saying="--objects")

    def test_no_shared_mesh_ends_the_program_otherwise(self):
        if not SHARED_MESHES.exists():
            self.skipTest(f"the shared data is not here: {SHARED_MESHES}")
        for file in sorted(SHARED_MESHES.rglob("*.*")):
            done = run("info", file, "--json")
            if file.parent.name == "bad" or file.name == "Cray_right.obj":
                self.assertIn(done.returncode, (0, 1), file)
            else:
                self.assertEqual(done.returncode, 0, f"{file}: {done.stderr}")
            if done.returncode == 0:
                self.assertIn("triangles", json.loads(done.stdout))
            else:
                self.assertTrue(done.stderr.startswith(f"icome: {file}"), done.stderr)


if __name__ == "__main__":
    unittest.main()
