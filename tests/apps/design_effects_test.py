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
            self.assertLess(distance(self.force_at(out), wanted), 1e-6, name)
            texts = self.report(out, "--path", self.path_file([TIP] * 10), "--effect", "viscous:1")["effects"]
            self.assertEqual(texts, ["viscous:1", SPRING["force"], WIND["force"]])
            design = out  # each from the one before

    def test_a_design_of_effects_alone_can_be_touched(self):
        design = self.design("alone.icome", WIND, {**SPRING, "force": "well:0,0,0,0.02,1.5"})
        self.assertGreater(length(self.force_at(design)), 0.5)
        report = self.report(design, "--seconds", "1", "--check", "--picture", self.folder / "alone.png")
        self.assertGreater(report["max_force_n"], 1.0)
        self.assertEqual((report["touch_fraction"], report["triangles"], report["silent"]), (0, 0, 0))
        text = self.succeeds("touch", design, "--seconds", "1")
        self.assertIn("effects alone", text.stdout)
        self.assertNotIn("%", text.stderr)
        off = self.design("off.icome", {**WIND, "on": False})
        self.fails("touch", off, code=1, saying="nothing to touch")

    def test_a_copy_is_felt_too_and_one_that_is_deleted_is_not(self):
        copied = {"op": "copy", "object": "wind"}
        self.assertLess(distance(self.force_at(self.design("two.icome", BALL, WIND, copied)), (0.0, 1.0, 0.0)), 1e-9)
        gone = {"op": "delete", "objects": "wind"}
        self.assertEqual(self.force_at(self.design("none.icome", BALL, WIND, gone)), (0.0, 0.0, 0.0))

    def test_every_texture_of_the_help_can_be_given_without_numbers(self):
        for name in ("ridges", "grooves", "bumps", "grain", "smooth"):
            design = self.design(f"{name}.icome", BALL, {"op": "feel", "objects": "ball", "texture": name})
            report = self.report(design, "--path", self.path_file([TIP] * 10))
            self.assertEqual(report["model"], str(design))
            self.assertNotIn("felt smooth", self.succeeds("touch", design, "--path", self.path_file([TIP] * 10)).stdout)

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
        # The ball has the device's nominal stiffness and needs half of what is stable, the spring all of it.
        self.assertEqual(len(report["capped"]), 2)
        self.assertIn("stiffness 5000 N/m is felt as 3333.33 N/m", report["capped"][0])
        self.assertIn("stiffness 50000 N/m is felt as 6666.67 N/m", report["capped"][1])

    def test_effects_of_a_file_that_make_no_sense_are_each_told_and_the_others_are_felt(self):
        wrong = {"magnet:1": 'no effect "magnet"', "well:0,0,0,0,1": "RADIUS", "curve:0,0,0": "it has one point",
                 "constant:nan,0,0": '"nan"', "viscous:-2": "DAMPING"}
        nodes = [{"extras": {"icome": {"effect": {"text": text}}}} for text in (*wrong, "constant:0,0.5,0")]
        design = self.write("wrong.gltf", json.dumps({"asset": {"version": "2.0"}, "scene": 0, "nodes": nodes,
                                                      "scenes": [{"nodes": list(range(len(nodes)))}]}))
        self.assertLess(distance(self.force_at(design), (0.0, 0.5, 0.0)), 1e-9)
        told = self.succeeds("touch", design, "--path", self.path_file([TIP] * 10)).stdout
        for number, why in enumerate(wrong.values(), 1):
            self.assertRegex(told, f"Object {number} is an effect that is not felt: .*{why}")

    def test_what_makes_no_sense_is_told(self):
        for operation, saying in [({**WIND, "force": "wel:1"}, "did you mean 'well'"),
                                  ({**WIND, "force": "viscous:x"}, "number 1"),
                                  ({"op": "feel", "objects": "ball", "texture": "bumps", "depth": 0.001}, "go together"),
                                  ({"op": "feel", "objects": "ball", "texture": "bumps", "depth": 0.001,
                                    "spacing": 0.001}, "SPACING"),
                                  ({**WIND, "material": "wood"}, "no 'material'"),
                                  ({**WIND, "factor": 2}, "no 'factor'"),
                                  ({"op": "feel", "objects": "ball", "depth": 0.001, "spacing": 0.01}, "texture")]:
            script = self.write("edits.jsonl", json.dumps(BALL) + "\n" + json.dumps(operation) + "\n")
            self.fails("edit", "new", "--apply", script, "--out", self.folder / "x.icome", code=1, saying=saying)


if __name__ == "__main__":
    unittest.main()
