"""Effects and textures of a design: made by operations, kept by every format that keeps a design, and felt."""
import json
import math
import unittest

from icome_program import ProgramTest, distance, length, line, point

BALL = {"op": "create", "shape": "sphere", "radius": 0.02, "name": "ball"}
WIND = {"op": "effect", "name": "wind", "force": "constant:0.5,0,0", "at": [0.05, 0.02, 0.03], "turn": [0, 0, 90]}
SPRING = {"op": "effect", "name": "spring", "force": "point:0.01,0,0,100,0", "at": [0.05, 0.02, 0.03],
          "turn": [0, 0, 90]}
RAMPED = 600  # ticks, after which forces are whole
TIP = (0.055, 0.02, 0.04)


class DesignEffectsTest(ProgramTest):
    def design(self, name, *operations):
        script = self.write("edits.jsonl", "\n".join(map(json.dumps, operations)) + "\n")
        out = self.folder / name
        self.succeeds("edit", "new", "--apply", script, "--out", out)
        return out

    def force_at(self, design, tip=TIP):
        rows = self.trace(design, "--device", "omega.x", "--path", self.path_file([tip] * RAMPED))
        return point(rows[-1], "force")

    def test_an_effect_is_felt_where_its_object_stands_and_as_it_is_turned(self):
        self.assertLess(distance(self.force_at(self.design("wind.icome", BALL, WIND)), (0.0, 0.5, 0.0)), 1e-9)
        # Its own x is the design's y: the spring holds at (0.05, 0.03, 0.03).
        expected = tuple(100.0 * (held - at) for held, at in zip((0.05, 0.03, 0.03), TIP))
        self.assertLess(distance(self.force_at(self.design("spring.icome", BALL, SPRING)), expected), 1e-6)

    def test_every_format_of_designs_keeps_effects(self):
        off = {**WIND, "name": "calm", "force": "constant:9,9,9", "on": False}
        design = self.design("a.icome", BALL, SPRING, WIND, off)
        wanted = self.force_at(design)
        self.assertGreater(length(wanted), 0.5)
        for name in ("b.wrl", "c.glb", "d.gltf", "e.icome"):
            out = self.folder / name
            self.succeeds("convert", design, out)
            text = self.succeeds("info", out).stdout
            self.assertIn("effect point:0.01,0,0,100,0", text)
            self.assertIn("effect constant:9,9,9, off", text)
            if name != "c.glb":  # which is touched as a mesh
                self.assertLess(distance(self.force_at(out), wanted), 1e-6, name)
            design = out  # each from the one before

    def test_a_copy_is_felt_too_and_one_that_is_deleted_is_not(self):
        copied = {"op": "copy", "object": "wind"}
        self.assertLess(distance(self.force_at(self.design("two.icome", BALL, WIND, copied)), (0.0, 1.0, 0.0)), 1e-9)
        gone = {"op": "delete", "objects": "wind"}
        self.assertEqual(self.force_at(self.design("none.icome", BALL, WIND, gone)), (0.0, 0.0, 0.0))

    def test_a_material_has_the_texture_that_it_was_given(self):
        slab = {"op": "create", "shape": "box", "size": [0.2, 0.02, 0.2], "at": [0, -0.01, 0], "name": "slab"}
        feel = {"op": "feel", "objects": "slab", "texture": "bumps", "depth": 0.0006, "spacing": 0.004,
                "stiffness": 500}
        design = self.design("slab.icome", slab, feel)
        wrl = self.folder / "slab.wrl"
        self.succeeds("convert", design, wrl)
        down = line((0.0, 0.001, 0.0), (0.0, -0.002, 0.0), 200) + [(0.0, -0.002, 0.0)] * RAMPED
        along = [(0.00001 * i, -0.002, 0.0) for i in range(800)]
        path = self.path_file(down + along)
        for file in (design, wrl):
            for row in self.trace(file, "--device", "omega.x", "--path", path)[-len(along) + 5:]:
                # The top is at y = 10 mm in the slab's own frame, where the cosine is -1; at z = 0 it is 1.
                height = 0.0006 / 6.0 * (math.cos(2.0 * math.pi * row["tip_x"] / 0.004) - 3.0)
                self.assertAlmostEqual(row["force_y"], 500.0 * (0.002 + height), delta=0.02)

    def test_an_effect_of_a_design_that_is_capped_is_told(self):
        design = self.design("hard.icome", BALL, {**SPRING, "force": "point:0,0,0,50000"})
        report = self.report(design, "--device", "omega.x", "--path", self.path_file([TIP] * 10))
        self.assertEqual(len(report["capped"]), 1)
        self.assertIn("stiffness 50000 N/m is felt as 10000 N/m", report["capped"][0])

    def test_what_makes_no_sense_is_told(self):
        for operation, saying in [({**WIND, "force": "wel:1"}, "did you mean 'well'"),
                                  ({**WIND, "force": "viscous:x"}, "number 1"),
                                  ({"op": "feel", "objects": "ball", "texture": "bumps", "depth": 0.001}, "go together"),
                                  ({"op": "feel", "objects": "ball", "texture": "bumps", "depth": 0.001,
                                    "spacing": 0.001}, "SPACING"),
                                  ({"op": "feel", "objects": "ball", "depth": 0.001, "spacing": 0.01}, "texture")]:
            script = self.write("edits.jsonl", json.dumps(BALL) + "\n" + json.dumps(operation) + "\n")
            self.fails("edit", "new", "--apply", script, "--out", self.folder / "x.icome", code=1, saying=saying)


if __name__ == "__main__":
    unittest.main()
