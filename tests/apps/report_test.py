"""The report: JSON whose names are a contract with scripts, and a table for people."""
import json
import unittest

from icome_program import ProgramTest, line, run

FIELDS = ["model", "triangles", "build_seconds", "ticks", "rate_hz", "tick_us", "haptic_load", "overruns",
          "lost_ticks", "max_force_n", "touch_fraction", "pops", "sticks", "silent", "pulls", "unjudged", "late",
          "judge_unfinished", "texture", "effects", "capped", "peak_memory_bytes"]
CUBE = "".join(f"v {x} {y} {z}\n" for x in (0, 1) for y in (0, 1) for z in (0, 1)) + \
    "f 1 2 4 3\nf 5 7 8 6\nf 1 5 6 2\nf 3 4 8 7\nf 1 3 7 5\nf 2 6 8 4\n"


class ReportTest(ProgramTest):
    def setUp(self):
        super().setUp()
        # From 50 mm above a sphere of 50 mm to 2 mm below its top: the last 2 of 52 mm touch.
        self.path = self.path_file(line((0.0, 0.0, 0.1), (0.0, 0.0, 0.048), 2601))

    def test_json_has_these_fields_in_this_order_and_nothing_else_is_printed(self):
        done = self.succeeds("touch", "sphere:0.05", "--path", self.path, "--json")
        report = json.loads(done.stdout)
        self.assertEqual(list(report), FIELDS)
        self.assertEqual(list(report["tick_us"]), ["median", "p99", "p999", "max"])
        self.assertEqual(list(report["haptic_load"]), ["median", "p999", "max"])

    def test_figures_of_a_primitive(self):
        report = self.report("sphere:0.05", "--path", self.path, "--stiffness", "400", "--rate", "2000")
        self.assertEqual((report["model"], report["triangles"], report["ticks"], report["rate_hz"]),
                         ("sphere:0.05", 0, 2601, 2000))
        self.assertAlmostEqual(report["touch_fraction"], 2 / 52, delta=2 / 2601)
        # 400 N/m at 2 mm, and some damping against 20 mm/s.
        self.assertGreater(report["max_force_n"], 0.8 - 1e-9)
        self.assertLess(report["max_force_n"], 3.3)
        self.assertGreater(report["peak_memory_bytes"], 1e6)
        self.assertGreaterEqual(report["build_seconds"], 0.0)

    def test_load_is_the_tick_as_a_share_of_the_period(self):
        report = self.report("sphere:0.05", "--path", self.path, "--rate", "4000")
        tick, load = report["tick_us"], report["haptic_load"]
        for name in load:
            self.assertAlmostEqual(load[name], tick[name] * 1e-6 * 4000, delta=1e-12)
        self.assertLessEqual(tick["median"], tick["p99"])
        self.assertLessEqual(tick["p99"], tick["p999"])
        self.assertLessEqual(tick["p999"], tick["max"])

    def test_pops_and_sticks_are_null_until_checked(self):
        unchecked = self.report("sphere:0.05", "--path", self.path)
        names = ("pops", "sticks", "silent", "pulls", "unjudged", "late", "judge_unfinished")
        for name in names:
            self.assertIsNone(unchecked[name])
        checked = self.report("sphere:0.05", "--path", self.path, "--check")
        self.assertEqual([checked[name] for name in names], [0, 0, 0, 0, 0, 0, 0])

    def test_triangles_and_names_of_several_models_are_put_together(self):
        mesh = self.write("cube.obj", CUBE)
        report = self.report(mesh, "sphere:0.05", "--fit", "0.1", "--path", self.path)
        self.assertEqual(report["triangles"], 12)
        self.assertEqual(report["model"], f"{mesh} sphere:0.05")

    def test_the_table_says_what_a_person_wants_to_know(self):
        mesh = self.write("cube.obj", CUBE)
        text = self.succeeds("touch", mesh, "--path", self.path, "--check").stdout
        for words in ("cube.obj", "12 triangles", "closed", "2,601 ticks", "haptic load", "overruns", "of the ticks",
                      "0 pops, 0 sticks, 0 silent ticks, 0 pulls, 0 unjudged, 0 late"):
            self.assertIn(words, text)

    def test_repairs_are_told(self):
        mesh = self.write("open.obj", CUBE.rsplit("f", 1)[0])
        text = self.succeeds("touch", mesh, "--path", self.path).stdout
        self.assertIn("open, touchable from both sides", text)
        self.assertIn("4 boundary edges", text)

    def test_messages_do_not_mix_with_the_json(self):
        done = run("touch", "sphere:0.05", "--seconds", "0.1", "--json")
        self.assertEqual(list(json.loads(done.stdout)), FIELDS)


if __name__ == "__main__":
    unittest.main()
