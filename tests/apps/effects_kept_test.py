"""Designs with effects below groups that are stretched, turned, sheared and mirrored: every format of designs keeps how
they are felt."""
import json
import math
import random
import unittest

from icome_program import ProgramTest, distance, length, point

RAMPED = 550  # ticks, after which forces are whole
KINDS = ("point:{a},{b},{c},40,1", "line:{a},{b},{c},1,{b},2,30,1", "plane:{a},{b},{c},1,2,{c},30,1",
         "curve:{a},{b},{c};0.05,{a},0.03;{c},0.04,0;30,1", "viscous:0.5", "friction:0.2,0.15", "inertia:0.1",
         "well:{a},{b},{c},0.09,0.4", "recess:{a},{b},{c},0.2,1,{c},0.005,0.12,0.4", "constant:0.1,-0.2,0.05",
         "field:-2*y,2*x,0.2*sin(6*t)")


def turn(chance):
    """A quaternion."""
    parts = [chance.gauss(0.0, 1.0) for _ in range(4)]
    return [part / math.sqrt(sum(it * it for it in parts)) for part in parts]


def scale(chance):
    return [chance.choice((-1.0, 1.0)) * chance.uniform(0.4, 2.5) for _ in range(3)]


def place(chance):
    return {"translation": [chance.uniform(-0.05, 0.05) for _ in range(3)], "rotation": turn(chance),
            "scale": scale(chance)}


class EffectsKeptTest(ProgramTest):
    def design(self, chance, kinds):
        """Chains of groups, each with an effect at its end."""
        nodes = []
        roots = []
        for kind in kinds:
            numbers = {name: round(chance.uniform(-0.03, 0.05), 4) for name in "abc"}
            roots.append(len(nodes))
            for depth in range(chance.randint(0, 2)):
                nodes.append({"name": f"group {len(nodes)}", **place(chance), "children": [len(nodes) + 1]})
            nodes.append({"name": f"effect {len(nodes)}", **place(chance),
                          "extras": {"icome": {"effect": {"text": kind.format(**numbers), "on": True}}}})
        return self.write("first.gltf", json.dumps({"asset": {"version": "2.0"}, "scene": 0, "nodes": nodes,
                                                    "scenes": [{"nodes": roots}]}))

    def forces(self, design, path):
        return [point(row, "force") for row in self.trace(design, "--device", "omega.x", "--path", path)]

    def test_what_is_felt_at_200_places_is_kept_by_every_format(self):
        start = (0.05, 0.02, 0.03)
        way = [(0.05 + 0.03 * math.sin(3.0 * t), 0.02 + 0.02 * math.sin(5.0 * t), 0.03 * math.cos(4.0 * t))
               for t in (0.001 * i for i in range(200))]
        path = self.path_file([start] * RAMPED + way)
        for seed in range(11):
            chance = random.Random(seed)
            kinds = [KINDS[seed]] + chance.sample(KINDS, 2)
            design = self.design(chance, kinds)
            wanted = self.forces(design, path)
            self.assertGreater(max(map(length, wanted)), 0.01, kinds)
            # VRML's numbers have single precision: what it loses it loses once.
            formats = (("a.icome", 1e-9), ("b.glb", 1e-9), ("c.gltf", 1e-9), ("d.wrl", 2e-5), ("e.wrl", 1e-9),
                       ("f.icome", 1e-9))
            for name, tolerance in formats:
                out = self.folder / name
                self.succeeds("convert", design, out)
                felt = self.forces(out, path)
                self.assertLess(max(map(distance, wanted, felt)), tolerance, (seed, name, kinds))
                wanted = felt
                design = out  # each from the one before

    def test_a_group_that_is_stretched_keeps_its_turn_and_its_mirror(self):
        path = self.path_file([(0.05, 0.02, 0.03)] * RAMPED)
        for group, wanted in (({"rotation": [0, 0, 1, 0], "scale": [2, 2, 2]}, (-0.3, -0.1, 0.2)),
                              ({"scale": [-2, -3, 1]}, (-0.3, -0.1, 0.2)),
                              ({"scale": [1, -3, 1]}, (0.3, -0.1, 0.2)),
                              ({"rotation": [0, 0, 1e-9, 1], "scale": [1, -3, 1]}, (0.3, -0.1, 0.2)),
                              ({"scale": [-1, -1, -1]}, (-0.3, -0.1, -0.2)),
                              ({"scale": [0.1, 5, 0.1]}, (0.3, 0.1, 0.2))):
            effect = {"extras": {"icome": {"effect": {"text": "constant:0.3,0.1,0.2", "on": True}}}}
            design = self.write("group.gltf", json.dumps(
                {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
                 "nodes": [{"name": "group", "children": [1], **group}, effect]}))
            self.assertLess(distance(self.forces(design, path)[-1], wanted), 1e-6, group)


if __name__ == "__main__":
    unittest.main()
