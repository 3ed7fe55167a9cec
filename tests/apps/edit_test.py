"""`icome edit` performs a script of operations on a design: all of it, or nothing is written."""
import json
import pathlib
import signal
import subprocess
import unittest

from icome_program import PROGRAM, ProgramTest, run

SEAT = {"op": "create", "shape": "box", "size": [0.4, 0.05, 0.4], "at": [0, 0.45, 0], "name": "seat"}


class EditTest(ProgramTest):
    def script(self, *operations, name="edits.jsonl"):
        lines = (it if isinstance(it, str) else json.dumps(it) for it in operations)
        return self.write(name, "\n".join(lines) + "\n")

    def info(self, file):
        return json.loads(self.succeeds("info", file, "--json").stdout)

    def test_a_new_design(self):
        script = self.script(SEAT)
        out = self.folder / "stool.wrl"
        done = json.loads(self.succeeds("edit", "new", "--apply", script, "--out", out, "--json").stdout)
        self.assertEqual(list(done), ["in", "out", "operations", "errors", "notes", "objects", "triangles",
                                      "bytes", "warnings", "seconds"])
        self.assertEqual([done[it] for it in ("in", "operations", "errors", "objects")], ["new", 1, [], 1])
        self.assertEqual(done["bytes"], out.stat().st_size)
        bounds = self.info(out)["bounds"]
        for got, want in zip(bounds["min"] + bounds["max"], [-0.2, 0.425, -0.2, 0.2, 0.475, 0.2]):
            self.assertAlmostEqual(got, want, delta=1e-6)

    def test_a_design_that_is_there_takes_the_result(self):
        design = self.folder / "stool.icome"
        self.succeeds("edit", "new", "--apply", self.script(SEAT), "--out", design)
        back = {**SEAT, "name": "back", "at": [0, 0.7, -0.2]}
        text = self.succeeds("edit", design, "--apply", self.script(back), "--out", design).stdout
        self.assertIn("1 operation, 2 objects", text)
        self.assertEqual(self.info(design)["objects"], 2)

    def test_what_lands_rests_and_what_stops_does_not_go_through(self):
        ball = {"op": "create", "shape": "sphere", "radius": 0.1, "at": [0, 3, 0], "name": "ball"}
        land = {"op": "land", "objects": "ball"}
        through = {"op": "move", "objects": "ball", "by": [0, -50, 0], "stop": True}
        out = self.folder / "rests.wrl"
        for last in (land, through):
            self.succeeds("edit", "new", "--apply", self.script(SEAT, ball, last), "--out", out)
            bounds = self.info(out)["bounds"]
            self.assertAlmostEqual(bounds["min"][1], 0.425, delta=1e-5)
            self.assertAlmostEqual(bounds["max"][1], 0.475 + 0.2, delta=1e-5)

    def test_what_operations_came_to_is_told(self):
        ball = {"op": "create", "shape": "sphere", "radius": 0.1, "at": [0, 3, 0], "name": "ball"}
        land = {"op": "land", "objects": "ball"}
        out = self.folder / "rests.wrl"
        script = self.script(SEAT, ball, land)
        text = self.succeeds("edit", "new", "--apply", script, "--out", out).stdout
        self.assertIn(f"{script}:3: land: on 'seat'", text)
        notes = json.loads(self.succeeds("edit", "new", "--apply", script, "--out", out, "--json").stdout)["notes"]
        self.assertEqual(notes, [{"line": 3, "op": "land", "text": "on 'seat'"}])

    def test_a_result_of_nothing_is_told(self):
        script = self.script(SEAT, {"op": "delete", "objects": "seat"})
        for ending in ("glb", "stl"):
            text = self.succeeds("edit", "new", "--apply", script, "--out", self.folder / f"none.{ending}").stdout
            self.assertIn("no object in it has triangles", text)

    def test_a_picture_lies_beside_the_script_and_goes_into_the_design(self):
        wood = (pathlib.Path(__file__).resolve().parents[2] / "examples" / "wood.png").read_bytes()
        (self.folder / "wood.png").write_bytes(wood)
        texture = {"op": "texture", "object": "seat", "file": "wood.png", "projection": "own"}
        script = self.script(SEAT, texture)
        for ending in (".icome", ".glb", ".wrl"):
            out = self.folder / f"seat{ending}"
            self.succeeds("edit", "new", "--apply", script, "--out", out)
            self.succeeds("shot", out, self.folder / "seat.png", "--size", "80x60")
        self.assertIn(wood, (self.folder / "seat.glb").read_bytes())
        self.assertEqual((self.folder / "seat_textures" / "wood.png").read_bytes(), wood)
        (self.folder / "cut.png").write_bytes(wood[:1000])
        for file, why in (("nope.png", "No such file"), ("edits.jsonl", "none of PNG, JPEG and GIF"),
                          ("cut.png", "damaged"), (".", "is a folder")):
            wrong = self.script(SEAT, {**texture, "file": file}, name="edits.jsonl")
            done = run("edit", "new", "--apply", wrong, "--out", self.folder / "never.icome")
            self.assertNotEqual(done.returncode, 0)
            self.assertIn(":2: texture: ", done.stderr)
            self.assertIn(why, done.stderr)
            self.assertFalse((self.folder / "never.icome").exists())

    def test_comments_empty_lines_and_standard_input(self):
        text = "\ufeff# A stool.\r\n\r\n  " + json.dumps(SEAT) + "\r\n   \n# end"
        out = self.folder / "stool.glb"
        done = subprocess.run([PROGRAM, "edit", "new", "--apply", "-", "--out", str(out)], input=text,
                              capture_output=True, text=True, timeout=60)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.info(out)["objects"], 1)

    def test_what_is_no_recording_is_told_with_its_line(self):
        out = self.folder / "again.icome"
        recording = self.write("lamp.recording", "icome technique recording 1\nhand,hand,none\n")
        self.fails("edit", "new", "--replay", recording, "--out", out, code=1, saying="lamp.recording: line 2")
        self.fails("edit", "new", "--replay", self.folder / "none", "--out", out, code=1, saying="none")
        self.fails("edit", "new", "--replay", recording, "--apply", self.script(SEAT), "--out", out, code=2,
                   saying="--replay")
        self.assertFalse(out.exists())

    def test_a_wrong_line_is_named_and_nothing_is_written(self):
        script = self.script(SEAT, "", {"op": "delete", "objects": "stool"}, "{")
        out = self.write("kept.wrl", "kept")
        done = run("edit", "new", "--apply", script, "--out", out)
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertIn(f"{script}:3: delete: there is no object named 'stool'", done.stderr)
        self.assertNotIn(":4:", done.stderr)
        self.assertEqual(out.read_text(), "kept")
        self.assertEqual(sorted(it.name for it in self.folder.iterdir()), ["edits.jsonl", "kept.wrl"])

    def test_places_are_counted_from_the_beginning_of_the_line(self):
        script = self.script('    {"op": x}')
        self.fails("edit", "new", "--apply", script, "--out", self.folder / "out.wrl", code=1,
                   saying=":1: this is no JSON at character 12")

    def test_a_signal_ends_the_wait_for_standard_input(self):
        out = self.folder / "out.wrl"
        with subprocess.Popen([PROGRAM, "edit", "new", "--apply", "-", "--out", str(out)],
                              stdin=subprocess.PIPE) as edit:
            edit.stdin.write(b"\n" * 1_000_000)  # more than a pipe holds: it is being read
            edit.stdin.flush()
            edit.send_signal(signal.SIGTERM)
            self.assertEqual(edit.wait(timeout=60), -signal.SIGTERM)
        self.assertFalse(out.exists())

    def test_keep_going_tells_of_all_wrong_lines(self):
        script = self.script({"op": "extrud"}, SEAT, "{", {"op": "delete", "objects": "seat", "all": True}, 7)
        out = self.folder / "out.wrl"
        done = run("edit", "new", "--apply", script, "--out", out, "--keep-going", "--json")
        self.assertEqual(done.returncode, 1)
        report = json.loads(done.stdout)
        self.assertEqual([(it["line"], it["op"]) for it in report["errors"]],
                         [(1, "extrud"), (3, ""), (4, "delete"), (5, "")])
        self.assertEqual((report["out"], report["operations"], report["objects"]), (None, 1, 1))
        for line in (1, 3, 4, 5):
            self.assertIn(f"{script}:{line}: ", done.stderr)
        self.assertFalse(out.exists())

    def test_what_cannot_begin_says_so(self):
        script = self.script(SEAT)
        out = self.folder / "out.wrl"
        self.fails("edit", "nothere.wrl", "--apply", script, "--out", out, code=1, saying="nothere.wrl")
        self.fails("edit", "new", "--apply", "nothere.jsonl", "--out", out, code=1, saying="nothere.jsonl")
        self.fails("edit", "new", "--apply", script, "--out", self.folder / "out.xyz", code=1, saying=".xyz")
        self.fails("edit", "new", "--apply", script, code=2, saying="--out")
        self.fails("edit", code=2, saying="IN is required")
        self.assertFalse(out.exists())

    def test_every_operation_is_told_with_its_parameters(self):
        text = self.succeeds("edit", "--help-ops").stdout
        listed = json.loads(self.succeeds("edit", "--help-ops", "--json").stdout)["operations"]
        for operation in listed:
            self.assertIn("\n" + operation["name"] + "\n", text)
            for parameter in operation["parameters"]:
                self.assertIn("      " + parameter["name"] + ": ", text)
        self.assertLessEqual({"create", "delete", "undo", "redo"}, {it["name"] for it in listed})
        one = self.succeeds("edit", "--help-ops", "create").stdout
        self.assertIn("create\n", one)
        self.assertNotIn("delete\n", one)
        self.fails("edit", "--help-ops", "creat", code=1, saying="did you mean 'create'?")


if __name__ == "__main__":
    unittest.main()
