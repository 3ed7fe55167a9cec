"""The simulated hand: it finds and touches every kind of model, leaves a picture, and Ctrl-C ends it."""
import json
import math
import signal
import subprocess
import time
import unittest

from icome_program import BUNNY, PROGRAM, ProgramTest, SHARED_MESHES

PNG_SIGNATURE = b"\x89PNG\r\n\x1a\n"


class ExploreTest(ProgramTest):
    def test_it_touches_most_of_the_time(self):
        sheet = self.write("sheet.obj", "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n")
        for model in (["sphere:0.05"], ["box:0.1x0.1x0.1"], ["plane"], ["torus:0.05x0.02"], [sheet, "--fit", "0.2"],
                      ["sphere:0.03", "plane"], ["sphere:5"], ["sphere:0.001"]):
            report = self.report(*model, "--seconds", "1")
            self.assertGreater(report["touch_fraction"], 0.6, model)
            self.assertGreater(report["max_force_n"], 0.0, model)

    def test_solids_and_formulas_are_touched_most_of_the_time(self):
        pierced = self.write("pierced.csg", "difference() { cube(size = [80, 80, 80], center = true); "
                                            "cylinder(h = 200, r1 = 15, r2 = 15, center = true); }")
        for model in ([pierced], ["--implicit", "x^2 + y^2 + (z/2)^2 - 0.03^2", "--bounds", "0.1"]):
            self.assertGreater(self.report(*model, "--seconds", "1")["touch_fraction"], 0.6, model)

    def test_it_says_why_it_touched_little(self):
        sinking = ("--implicit", "x^2 + y^2 + (z + 0.3*t)^2 - 0.03^2", "--bounds", "0.6", "--seconds", "1")
        self.assertIn("the surface moves", self.succeeds("touch", *sinking).stderr)
        self.assertNotIn("the hand touched", self.succeeds("touch", "sphere:0.05", "--seconds", "1").stderr)

    def test_bunny_leaves_a_picture(self):
        if not BUNNY.exists():
            self.skipTest("glmark2-data is not installed")
        picture = self.folder / "touch.png"
        text = self.succeeds("touch", BUNNY, "--up", "y", "--fit", "0.1", "--seconds", "2", "--picture", picture).stdout
        self.assertEqual(picture.read_bytes()[:8], PNG_SIGNATURE)
        self.assertIn("touch.png", text)
        self.assertIn("69,666 triangles", text)

    def test_a_device_profile_limits_the_force(self):
        report = self.report("box:0.1x0.1x0.1", "--device", "touch", "--seconds", "1")
        self.assertLessEqual(report["max_force_n"], 3.3)
        self.assertGreater(report["touch_fraction"], 0.5)

    def test_ctrl_c_ends_the_run_with_report_and_trace(self):
        trace = self.folder / "trace.csv"
        process = subprocess.Popen([PROGRAM, "touch", "sphere:0.05", "--seconds", "200", "--rate", "2000", "--json",
                                    "--trace", trace], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(process.kill)
        while process.poll() is None and not any(file.stat().st_size for file in self.folder.iterdir()):
            time.sleep(0.05)  # until the first rows are on disk
        process.send_signal(signal.SIGINT)
        output, messages = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 0, messages)
        report = json.loads(output)
        self.assertLess(report["ticks"], 200 * 2000)
        self.assertEqual(len(trace.read_text().splitlines()), report["ticks"] + 1)
        self.assertIn("interrupted", messages)

    def test_a_check_that_takes_long_ends_between_two_ticks(self):
        # A sphere tip in a groove is slow to judge; rows are touched by the thousand before they are judged.
        rods = "".join(f"multmatrix([[1,0,0,{x}],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) {{ "
                       "cylinder(h = 60, r1 = 10, r2 = 10, center = true); } " for x in (-10, 10))
        groove = self.write("groove.csg", f"union() {{ {rods} }}")
        path = self.path_file([(0.002 * math.sin(i / 400), 0.006 + 0.002 * math.sin(i / 111), 0.01 * math.sin(i / 700))
                               for i in range(20000)])
        trace = self.folder / "trace.csv"
        process = subprocess.Popen([PROGRAM, "touch", groove, "--up", "y", "--radius", "0.002", "--path", path, "--check",
                                    "--json", "--trace", trace], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(process.kill)
        while process.poll() is None and not any(file.stat().st_size for file in self.folder.glob("trace*")):
            time.sleep(0.05)  # until the first rows are on disk
        process.send_signal(signal.SIGTERM)
        output, messages = process.communicate(timeout=200)
        self.assertEqual(process.returncode, 130, messages)
        self.assertLess(json.loads(output)["ticks"], 8192)
        self.assertIn("interrupted", messages)


class SharedDataTest(ProgramTest):
    """Real meshes, sound and bad, where the shared data is present."""

    def setUp(self):
        super().setUp()
        if not SHARED_MESHES.is_dir():
            self.skipTest("the shared meshes are not here")
        self.path = self.path_file([(0.2, 0.1, 0.3 - 0.001 * i) for i in range(600)])

    def test_sound_meshes_can_be_touched(self):
        for kind in ("anatomy", "cad", "control", "scan"):
            for mesh in sorted((SHARED_MESHES / kind).iterdir()):
                report = self.report(mesh, "--fit", "0.1", "--path", self.path)
                self.assertGreater(report["triangles"], 0, mesh)
                self.assertEqual(report["ticks"], 600)

    def test_intricate_meshes_are_touched_most_of_the_time(self):
        for name in ("boolean/Generic_Twin_7863.1.t0_right.obj", "anatomy/teeth-bottom.obj.xz"):
            report = self.report(SHARED_MESHES / name, "--fit", "0.1", "--seconds", "1", "--check")
            self.assertGreater(report["touch_fraction"], 0.6, name)
            self.assertEqual(report["silent"], 0, name)

    def test_bad_meshes_are_touched_or_refused_in_one_sentence(self):
        for mesh in sorted((SHARED_MESHES / "bad").iterdir()):
            done = subprocess.run([PROGRAM, "touch", mesh, "--fit", "0.1", "--path", self.path, "--json"],
                                  capture_output=True, text=True)
            if done.returncode == 0:
                self.assertGreater(json.loads(done.stdout)["triangles"], 0, mesh)
            else:
                self.assertEqual(done.returncode, 1, f"{mesh}: {done.stderr}")
                self.assertEqual(done.stdout, "")
                self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
                self.assertIn(mesh.name, done.stderr)


if __name__ == "__main__":
    unittest.main()
