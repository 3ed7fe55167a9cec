"""Files of strangers: what they hold never reaches the terminal raw, nor takes along what is not theirs."""
import json
import subprocess

import unittest

from icome_program import PROGRAM, ProgramTest

CONTROL = "\x1b]0;owned\x07\x1b[2J\x9b31m\x7f\r"
SEEN = "owned"


def is_clean(output):
    """No control characters but line ends and tabs, as UTF-8 or as single bytes."""
    text = output.decode("utf-8")
    return not any((ord(c) < 0x20 and c not in "\n\t") or 0x7F <= ord(c) < 0xA0 for c in text)


class TerminalTest(ProgramTest):
    def runs_clean(self, *arguments, seen=True):
        done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, timeout=250)
        output = done.stdout + done.stderr
        self.assertTrue(is_clean(output), (arguments, output))
        if seen:
            self.assertIn(SEEN.encode(), output, arguments)
        return done

    def test_what_designs_hold_is_shown_harmlessly_by_every_command(self):
        obj = self.folder / "a.obj"
        obj.write_bytes((f"o {CONTROL}\nusemtl {CONTROL}\nmtllib {CONTROL}.mtl\n"
                         "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n").encode())
        bad = self.folder / "bad.obj"
        bad.write_bytes(f"v {CONTROL} 0 0\n".encode())
        gltf = self.write("a.gltf", json.dumps({
            "asset": {"version": "2.0"}, "extensionsRequired": [CONTROL]}))
        named = self.write("named.gltf", json.dumps({
            "asset": {"version": "2.0"}, "scenes": [{"nodes": [0, 1]}],
            "nodes": [{"name": CONTROL}, {"name": "flat", "scale": [0, 0, 0]}],
            "images": [{"uri": CONTROL + ".png"}], "textures": [{"source": 0}]}))
        for command in ("info", "convert", "shot", "touch", "edit"):
            more = {"convert": [self.folder / "out.wrl"], "shot": [self.folder / "out.png"],
                    "edit": ["--apply", self.write("none.jsonl", "\n"), "--out", self.folder / "out.wrl"],
                    "touch": ["--seconds", "0.05"]}.get(command, [])
            self.runs_clean(command, bad, *more)
            self.runs_clean(command, gltf, *more)
            self.runs_clean(command, obj, *more, seen=command != "touch")
            self.runs_clean(command, named, *more, seen=command != "touch")
            if command != "edit":
                self.runs_clean(command, named, *more, "--json", seen=command != "touch")
        self.runs_clean("csg", self.write("a.csg", f"{CONTROL}();"), seen=False)
        self.runs_clean("stats", "describe", self.write("a.csv", f"{CONTROL},b\n1,2\n2,3\n"), "--column", "b",
                        seen=False)

    def test_json_gives_names_as_they_are(self):
        named = self.write("named.gltf", json.dumps({
            "asset": {"version": "2.0"}, "images": [{"uri": "a\x1b\x85b.png"}], "textures": [{"source": 0}]}))
        report = json.loads(self.runs_clean("info", named, "--json", seen=False).stdout)
        self.assertTrue(any("a?" in it or "a\x1b" in it for it in report["warnings"]), report["warnings"])


class ReachTest(ProgramTest):
    PICTURE = bytes.fromhex("47494638396101000100800000ffffff00000021f90400000000002c00000000010001000002024401003b")

    def test_pictures_above_the_design_need_a_flag_and_are_told(self):
        (self.folder / "secret.gif").write_bytes(self.PICTURE)
        folder = self.folder / "design"
        folder.mkdir()
        design = folder / "a.wrl"
        design.write_text("#VRML V2.0 utf8\nShape { appearance Appearance { texture ImageTexture { "
                          "url \"../secret.gif\" } } geometry Box {} }\n")
        done = self.succeeds("convert", design, folder / "a.glb")
        self.assertIn("it leads above the folder of the design", done.stdout)
        self.assertEqual(json.loads(self.succeeds("info", folder / "a.glb", "--json").stdout)["textures"], 0)
        done = self.succeeds("convert", design, folder / "b.glb", "--urls-above")
        self.assertIn("secret.gif lies above the design's folder", done.stdout)
        self.assertEqual(json.loads(self.succeeds("info", folder / "b.glb", "--json").stdout)["textures"], 1)


class BudgetTest(ProgramTest):
    def test_limits_of_memory_and_time_can_be_chosen(self):
        protos = "PROTO P0 [] { Group { children [ Group {} Group {} ] } }\n"
        for i in range(1, 26):
            protos += f"PROTO P{i} [] {{ Group {{ children [ P{i - 1} {{}} P{i - 1} {{}} ] }} }}\n"
        design = self.write("a.wrl", "#VRML V2.0 utf8\n" + protos + "P25 {}\n")
        self.fails("info", design, code=1, saying="256 MB of memory")
        self.fails("info", design, "--memory-limit", "100", code=1, saying="100 MB of memory")
        self.fails("info", design, "--memory-limit", "1e6", "--seconds-limit", "0.2", code=1, saying="0.2 s")
        self.fails("touch", design, code=1, saying="256 MB of memory")


class AxisTest(ProgramTest):
    def bounds(self, file, *more):
        return json.loads(self.succeeds("info", file, "--json", *more).stdout)["bounds"]["max"]

    def test_what_stands_on_z_is_turned_once_and_turned_back(self):
        tower = self.write("tower.csg", "cube(size = [10, 20, 300], center = false);\n")
        self.assertEqual([round(x, 6) for x in self.bounds(tower)], [0.01, 0.3, 0])
        told = self.succeeds("convert", tower, self.folder / "tower.glb").stdout
        self.assertIn("Its z axis points up: it was turned", told)
        self.assertEqual([round(x, 6) for x in self.bounds(self.folder / "tower.glb")], [0.01, 0.3, 0])
        self.succeeds("convert", self.folder / "tower.glb", self.folder / "tower.stl")
        self.assertEqual([round(x, 6) for x in self.bounds(self.folder / "tower.stl")], [0.01, 0.3, 0])
        lying = [round(x, 6) for x in self.bounds(self.folder / "tower.stl", "--up", "y")]
        self.assertEqual(lying, [0.01, 0.02, 0.3], "the file itself has z up")
        for one, other in (("tower", "twice"), ("twice", "thrice")):
            self.succeeds("convert", self.folder / f"{one}.stl", self.folder / f"{other}.stl")
        twice, thrice = ((self.folder / f"{name}.stl").read_bytes() for name in ("twice", "thrice"))
        self.assertEqual(twice, thrice)
        self.assertEqual([round(x, 6) for x in self.bounds(self.folder / "thrice.stl")], [0.01, 0.3, 0])

    def test_remarks_are_told_by_every_command_that_reads(self):
        design = self.write("a.wrl", "#VRML V2.0 utf8\nFog {}\nShape { geometry Box {} }\n")
        done = self.succeeds("shot", design, self.folder / "a.png")
        self.assertIn("a.wrl:2: A Fog is left out.", done.stderr)
        self.assertIn("a.wrl:2: A Fog is left out.", self.succeeds("touch", design, "--seconds", "0.05").stdout)


if __name__ == "__main__":
    unittest.main()
