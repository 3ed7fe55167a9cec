"""Many primitives in one design cost memory by their number alone: nobody makes triangles that nobody asked for."""
import random
import unittest

from icome_program import ProgramTest, line

RADIUS = 0.01


class ManyPrimitivesTest(ProgramTest):
    def design(self, count):
        """As many spheres and as many boxes on a grid, the last ones in sizes of their own."""
        chance = random.Random(7)
        lines = ["#VRML V2.0 utf8"]
        for i in range(count):
            x, y = 0.05 * (i % 40), 0.05 * (i // 40)
            own = 1.0 if i < count // 2 else chance.uniform(0.5, 1.0)
            sphere, box = f"Sphere {{ radius {RADIUS * own} }}", f"Box {{ size 0.02 0.02 {0.02 * own} }}"
            for z, shape in ((0.0, sphere), (0.1, box)):
                lines.append(f"Transform {{ translation {x} {y} {z} children Shape {{ geometry {shape} }} }}")
        return self.write(f"{count}.wrl", "\n".join(lines) + "\n")

    def test_touching_one_of_many_takes_little_memory(self):
        # Down onto the first sphere, from below.
        path = self.path_file(line((0, 0, -0.02), (0, 0, -0.008), 200))
        few, many = (self.report(self.design(count), "--path", path) for count in (10, 1000))
        self.assertGreater(many["touch_fraction"], 0.1)
        self.assertEqual(many["max_force_n"], few["max_force_n"])
        grown = many["peak_memory_bytes"] - few["peak_memory_bytes"]
        # A mesh of one sphere for a picture has 200 kB; sanitizers multiply what objects need.
        self.assertLess(grown / 1980, 20e3)

    def test_a_hand_finds_its_way_over_many(self):
        few, many = (self.report(self.design(count), "--seconds", "0.3") for count in (10, 1000))
        self.assertGreater(many["touch_fraction"], 0.2)
        self.assertLess((many["peak_memory_bytes"] - few["peak_memory_bytes"]) / 1980, 20e3)


if __name__ == "__main__":
    unittest.main()
