"""A mesh whose file has the coordinates of a map is touched as finely as one about its origin."""
import math
import unittest

from icome_program import ProgramTest, point

FAR = (524288.0, 4194304.0, 128.0)  # m, as UTM coordinates are; powers of two, which round nothing
HALF = 0.046875


def cube(offset):
    corners = [[offset[axis] + (HALF if i >> axis & 1 else -HALF) for axis in range(3)] for i in range(8)]
    faces = ((0, 2, 1), (1, 2, 3), (4, 5, 6), (5, 7, 6), (0, 1, 4), (1, 5, 4),
             (2, 6, 3), (3, 6, 7), (0, 4, 2), (2, 4, 6), (1, 3, 5), (3, 7, 5))
    return "".join(f"v {x!r} {y!r} {z!r}\n" for x, y, z in corners) + "".join(
        f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in faces)


class FarCoordinatesTest(ProgramTest):
    def touched(self, name, offset, *arguments):
        """The trace of a tip that wanders on and over the edges of a cube, less the offset."""
        def tip(t):
            way = (0.05 * math.sin(3 * t), 0.03 * math.cos(5 * t), 0.06 - 0.02 * min(1.0, t))
            return [round(c * 2 ** 28) / 2 ** 28 + o for c, o in zip(way, offset)]
        path = self.path_file([tip(i / 1000) for i in range(3000)], name=f"{name}.csv")
        mesh = self.write(f"{name}.obj", cube(offset))
        report = self.report(mesh, "--path", path, "--check", *arguments)
        self.assertEqual((report["pops"], report["sticks"]), (0, 0))
        self.assertGreater(report["touch_fraction"], 0.5)
        rows = self.trace(mesh, "--path", path, *arguments, name=f"{name}-trace.csv")
        return [[a - b for a, b in zip(point(row, "scp"), offset)] + list(point(row, "force")) for row in rows]

    def test_the_trace_is_that_of_a_near_mesh(self):
        for arguments in ((), ("--radius", "0.001")):
            near, far = self.touched("near", (0, 0, 0), *arguments), self.touched("far", FAR, *arguments)
            worst = max(abs(a - b) for one, other in zip(near, far) for a, b in zip(one[:3], other[:3]))
            self.assertLess(worst, 3e-9, "the world's coordinates themselves have steps of 1e-9 m there")
            force = max(abs(a - b) for one, other in zip(near, far) for a, b in zip(one[3:], other[3:]))
            self.assertLess(force, 1e-5)


if __name__ == "__main__":
    unittest.main()
