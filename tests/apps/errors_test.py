"""What a user gets wrong is said in one sentence, with an exit code, and nothing is left half written."""
import base64
import json
import unittest

from icome_program import ProgramTest, run


class UsageTest(ProgramTest):
    def test_unknown_command(self):
        self.fails("feel", code=2, saying='"feel"')

    def test_the_window_has_no_commands_beside_it(self):
        self.fails("--theme", "dark", "touch", "sphere:0.05", code=2, saying="--theme")
        self.fails("room.wrl", "touch", "sphere:0.05", code=2, saying="room.wrl")
        self.fails("--theme", "purple", code=2, saying="--theme")

    def test_unknown_option(self):
        self.fails("touch", "sphere:0.05", "--bogus", code=2, saying="--bogus")

    def test_no_model(self):
        self.fails("touch", code=2, saying="MODEL")

    def test_values_out_of_range_name_the_option(self):
        for option, values in {
            "--rate": ("499", "10001", "nan", "-1000"),
            "--seconds": ("0", "-1", "nan", "inf"),
            "--radius": ("-0.001", "nan", "inf"),
            "--stiffness": ("-1", "nan"),
            "--fit": ("0", "-1", "inf"),
            "--friction": ("0.2,0.3", "-0.1,-0.2", "nan,nan", "much", "0.3,0.2,0.1", "0.3,"),
        }.items():
            for value in values:
                self.fails("touch", "sphere:0.05", f"{option}={value}", code=2, saying=option)

    def test_words_that_are_no_choice_name_the_option(self):
        for option in ("--sides", "--up", "--shading"):
            self.fails("touch", "sphere:0.05", option, "sideways", code=2, saying=option)
        self.fails("touch", "sphere:0.05", "--rate", "fast", code=2, saying="--rate")

    def test_options_that_would_change_nothing_are_refused(self):
        for words in (("--implicit", "x*x+y*y+z*z-0.0025", "--bounds", "0.2", "--fit", "0.1"),
                      ("sphere:0.05", "--subdivide", "limit"),
                      ("solid.csg", "--subdivide", "limit"),
                      ("sphere:0.05", "--unit", "parsec"),
                      ("sphere:0.05", "--renderer", "thesis", "--friction", "0.4,0.3"),
                      ("sphere:0.05", "--renderer", "thesis", "--sides", "both")):
            self.fails("touch", *words, code=2, saying=words[-2])

    def test_one_file_cannot_be_two_things(self):
        self.fails("touch", "sphere:0.05", "--path", "a.csv", "--trace", "a.csv", code=2, saying="--trace")
        self.fails("touch", "sphere:0.05", "--picture", "a.png", "--trace", "a.png", code=2, saying="--picture")


class FileTest(ProgramTest):
    def test_missing_files_are_named(self):
        self.fails("touch", self.folder / "none.obj", code=1, saying="none.obj")
        self.fails("touch", "sphere:0.05", "--path", self.folder / "none.csv", code=1, saying="none.csv")

    def test_bad_meshes_and_primitives_are_refused(self):
        self.fails("touch", self.write("text.obj", "hello\n"), code=1, saying="text.obj")
        self.fails("touch", self.write("nothing.stl", ""), code=1, saying="nothing.stl")
        self.fails("touch", self.write("mesh.docx", "?"), code=1, saying="mesh.docx")
        for primitive in ("sphere:-1", "sphere:nan", "box:1x1", "torus:0.1x0.2", "cube:0.1"):
            self.assertEqual(run("touch", primitive).returncode, 1, primitive)

    def test_bad_paths_name_the_line(self):
        for text, line in (("x,y,z\n", 1), ("t,x,y,z\n0,0,0\n", 2), ("t,x,y,z\n0,0,0,1\n0,0,0,1\n", 3),
                           ("t,x,y,z\n0,0,0,nan\n", 2), ("t,x,y,z\n0,0,a,1\n", 2), ("t,x,y,z\n", 1)):
            file = self.write("path.csv", text)
            self.fails("touch", "sphere:0.05", "--path", file, code=1, saying=f"path.csv:{line}:")

    def lines_alone(self, **asset):
        it = {"asset": {"version": "2.0", **asset}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
              "materials": [{"normalTexture": {"index": 0}}], "textures": [{"source": 0}],
              "images": [{"uri": "data:image/png;base64,iVBORw0KGgo="}],
              "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "mode": 1, "material": 0}]}],
              "buffers": [{"byteLength": 24, "uri": "data:application/octet-stream;base64," +
                           base64.b64encode(bytes(24)).decode()}],
              "bufferViews": [{"buffer": 0, "byteLength": 24}],
              "accessors": [{"bufferView": 0, "componentType": 5126, "count": 2, "type": "VEC3"}]}
        return self.write("lines.gltf", json.dumps(it))

    def test_why_there_is_nothing_to_touch_is_said(self):
        self.fails("touch", self.lines_alone(), code=1, saying="1 primitive of points or lines is left out")

    def test_later_versions_of_gltf_are_refused(self):
        self.fails("info", self.lines_alone(minVersion="2.9"), code=1, saying="it needs version 2.9")
        self.succeeds("info", self.lines_alone(minVersion="2.0"))

    def test_unknown_devices_and_units_list_what_there_is(self):
        self.fails("touch", "sphere:0.05", "--device", "Joystick", code=1, saying="omega.x")
        mesh = self.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        self.fails("touch", mesh, "--unit", "furlong", code=2, saying="mm")

    def test_outputs_that_cannot_be_written_fail_before_the_run(self):
        path = self.path_file([(0.0, 0.0, 1.0)])
        arguments = ("touch", "sphere:0.05", "--path", path)
        self.fails(*arguments, "--trace", self.folder / "no" / "trace.csv", code=1, saying="trace.csv")
        self.fails(*arguments, "--trace", self.folder, code=1, saying=str(self.folder))
        self.fails(*arguments, "--picture", self.folder / "no" / "p.png", code=1, saying="p.png")

    def test_a_failed_run_leaves_no_trace_behind(self):
        old = self.write("trace.csv", "of another day\n")
        self.fails("touch", self.folder / "none.obj", "--trace", old, code=1, saying="none.obj")
        self.assertEqual(old.read_text(), "of another day\n")
        self.assertEqual([file.name for file in self.folder.iterdir()], ["trace.csv"])


if __name__ == "__main__":
    unittest.main()
