"""icome touch on designs: many bodies in one MODEL, each felt as what it is."""
import base64
import json
import math
import struct
import unittest

from icome_program import ProgramTest, SHARED_MESHES, line, point

SHARED_VRML = SHARED_MESHES.parent / "vrml"


# A box; a sphere scaled to an ellipsoid; an upright cylinder and, turned and scaled, its clone; a mesh that is a
# wedge, and its mirrored clone. Lengths in metres, as VRML has them.
DESIGN = """#VRML V2.0 utf8
Transform { translation 0 0 0 children Shape { geometry Box { size 0.1 0.08 0.06 } } }
Transform { translation 0.3 0 0 scale 2 3 5 children Shape { geometry Sphere { radius 0.01 } } }
Transform { translation 0.6 0 0
  children DEF Can Shape { geometry Cylinder { radius 0.02 height 0.1 } } }
Transform { translation 0.9 0 0 rotation 1 0 0 1.5707963267948966 scale 1 2 1 children USE Can }
Transform { translation 1.2 0 0
  children DEF Wedge Shape { geometry IndexedFaceSet {
    coord Coordinate { point [ 0 0 0, 0.06 0 0, 0 0 0.08, 0 0.04 0, 0.06 0.04 0, 0 0.04 0.08 ] }
    coordIndex [ 0 2 1 -1 3 4 5 -1 0 1 4 3 -1 0 3 5 2 -1 1 2 5 4 -1 ] ccw FALSE } } }
Transform { translation 1.5 0 0 scale -1 1 1 children USE Wedge }
"""


class DesignTest(ProgramTest):
    def contact(self, file, start, end, *arguments):
        """Presses from `start` to `end` and holds; the last row of the trace, and the report."""
        points = line(start, end, 300) + [end] * 100
        path = self.path_file(points)
        rows = self.trace(file, "--path", path, *arguments)
        report = self.report(file, "--path", path, "--check", *arguments)
        self.assertEqual((report["pops"], report["sticks"]), (0, 0))
        self.assertEqual(rows[-1]["touching"], 1)
        return rows[-1]

    def assert_point(self, row, expected, delta=1e-7):
        for got, want in zip(point(row, "scp"), expected):
            self.assertAlmostEqual(got, want, delta=delta)


def cube_gltf(nodes):
    """A glTF design: one cube with edges of 0.1 m around the origin, shared by all nodes."""
    corners = [(x, y, z) for x in (-0.05, 0.05) for y in (-0.05, 0.05) for z in (-0.05, 0.05)]
    sides = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
    indices = [i for a, b, c, d in sides for i in (a, b, c, a, c, d)]
    points = b"".join(struct.pack("<3f", *corner) for corner in corners)
    data = points + struct.pack(f"<{len(indices)}H", *indices)
    return json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": list(range(len(nodes)))}],
        "nodes": [{"mesh": 0, **node} for node in nodes],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "buffers": [{"byteLength": len(data),
                     "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}],
        "bufferViews": [{"buffer": 0, "byteLength": len(points)},
                        {"buffer": 0, "byteOffset": len(points), "byteLength": len(data) - len(points)}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3",
                       "min": [-0.05] * 3, "max": [0.05] * 3},
                      {"bufferView": 1, "componentType": 5123, "count": len(indices), "type": "SCALAR"}]})


class GltfTest(DesignTest):
    def setUp(self):
        super().setUp()
        self.design = self.write("cubes.gltf", cube_gltf([
            {}, {"translation": [0.5, 0, 0], "scale": [1, 2, -3]},
            # By 45 degrees about x.
            {"translation": [1, 0, 0], "rotation": [0.3826834323650898, 0, 0, 0.9238795325112867],
             "scale": [1, 2, 1]}]))

    def test_scaled_mirrored_and_turned_clones_are_felt_from_outside(self):
        self.assert_point(self.contact(self.design, (0.01, 0.1, 0.02), (0.01, 0.04, 0.02)), (0.01, 0.05, 0.02), 1e-6)
        self.assert_point(self.contact(self.design, (0.51, 0.03, 0.3), (0.51, 0.03, 0.14)), (0.51, 0.03, 0.15), 1e-6)
        row = self.contact(self.design, (1, 0.025, 0.3), (1, 0.025, 0.09))
        # The face that looked up before the turn: 0.05 from the middle, along a normal of (0, -1, 1).
        self.assertAlmostEqual(row["scp_z"] - row["scp_y"], 0.05 * 2 ** 0.5, delta=1e-6)

    def test_it_is_turned_and_fitted_like_other_files(self):
        row = self.contact(self.design, (0.01, 0.1, -0.02), (0.01, 0.04, -0.02), "--up", "z")
        self.assert_point(row, (0.01, 0.05, -0.02), 1e-6)
        row = self.contact(self.design, (0.001, 0.01, 0.002), (0.001, 0.004, 0.002), "--fit", "0.11")
        self.assert_point(row, (0.001, 0.005, 0.002), 1e-6)  # from x = -0.05 to 1.05: everything is a tenth

    def test_it_is_explored_and_drawn(self):
        picture = self.folder / "touch.png"
        report = self.report(self.design, "--seconds", "1", "--check", "--picture", picture)
        self.assertEqual((report["pops"], report["sticks"]), (0, 0))
        self.assertGreater(report["touch_fraction"], 0.05)
        self.assertEqual(report["triangles"], 36)
        self.assertTrue(picture.read_bytes().startswith(b"\x89PNG"))

    def test_objects_are_numbered_by_model(self):
        path = self.path_file(line((0.51, 0.03, 0.3), (0.51, 0.03, 0.14), 300))
        self.assertEqual(self.trace("sphere:0.01", self.design, "--path", path)[-1]["object"], 1)

    def test_a_tip_with_a_radius_rests_above(self):
        row = self.contact(self.design, (0.01, 0.1, 0.02), (0.01, 0.04, 0.02), "--radius", "0.003")
        self.assert_point(row, (0.01, 0.053, 0.02), 1e-6)

    def test_what_does_not_fit_designs_is_said(self):
        self.fails("touch", self.design, "--renderer", "thesis", code=1, saying="--renderer thesis touches")
        self.fails("touch", self.folder / "none.gltf", code=1, saying="none.gltf")

    def test_meshes_of_a_design_are_control_meshes_where_that_is_asked_for(self):
        report = self.report(self.design, "--subdivide", "limit", "--seconds", "0.3", "--check")
        self.assertEqual((report["triangles"], report["pops"], report["sticks"]), (0, 0, 0))


class VrmlTest(DesignTest):
    def setUp(self):
        super().setUp()
        self.design = self.write("design.wrl", DESIGN)

    def test_a_box_is_where_the_file_puts_it(self):
        row = self.contact(self.design, (0.01, 0.1, 0.02), (0.01, 0.035, 0.02))
        self.assert_point(row, (0.01, 0.04, 0.02))
        self.assertEqual(row["object"], 0)

    def test_a_scaled_sphere_is_an_ellipsoid(self):
        row = self.contact(self.design, (0.31, 0.02, 0.1), (0.31, 0.01, 0.03))
        x, y, z = row["scp_x"] - 0.3, row["scp_y"], row["scp_z"]
        self.assertAlmostEqual((x / 0.02) ** 2 + (y / 0.03) ** 2 + (z / 0.05) ** 2, 1.0, delta=1e-6)
        # The nearest place of it: its normal leads through the tip.
        normal = (x / 0.02 ** 2, y / 0.03 ** 2, z / 0.05 ** 2)
        away = (0.01 - x, 0.01 - y, 0.03 - z)
        size = math.sqrt(sum(it * it for it in normal)) * math.sqrt(sum(it * it for it in away))
        self.assertAlmostEqual(sum(a * b for a, b in zip(normal, away)) / size, -1.0, delta=1e-6)

    def test_cylinders_stand_upright_and_clones_lie_where_they_are_turned(self):
        self.assert_point(self.contact(self.design, (0.6, 0.1, 0), (0.6, 0.045, 0)), (0.6, 0.05, 0))
        self.assert_point(self.contact(self.design, (0.7, 0.02, 0), (0.61, 0.02, 0)), (0.62, 0.02, 0))
        # Twice as long, and its axis along z.
        self.assert_point(self.contact(self.design, (0.9, 0, 0.2), (0.9, 0, 0.095)), (0.9, 0, 0.1))
        self.assert_point(self.contact(self.design, (0.9, 0.1, 0.05), (0.9, 0.015, 0.05)), (0.9, 0.02, 0.05))

    def test_meshes_are_felt_from_outside_also_mirrored(self):
        # The slanted face of the wedge, x / 0.06 + z / 0.08 = 1, from outside; the mirrored one likewise.
        for middle, side in ((1.2, 1.0), (1.5, -1.0)):
            row = self.contact(self.design, (middle + side * 0.1, 0.02, 0.1), (middle + side * 0.025, 0.02, 0.035))
            x, z = side * (row["scp_x"] - middle), row["scp_z"]
            self.assertAlmostEqual(x / 0.06 + z / 0.08, 1.0, delta=1e-6)

    def test_it_is_turned_scaled_and_fitted_like_other_files(self):
        row = self.contact(self.design, (0.01, 0.1, -0.02), (0.01, 0.025, -0.02), "--up", "z")
        self.assert_point(row, (0.01, 0.03, -0.02))
        # From x = -0.05 to 1.5: fitted to 0.155, everything is a tenth.
        row = self.contact(self.design, (0.001, 0.01, 0.002), (0.001, 0.0035, 0.002), "--fit", "0.155")
        self.assert_point(row, (0.001, 0.004, 0.002))

    def test_objects_are_numbered_by_model(self):
        path = self.path_file(line((0.01, 0.1, 0.02), (0.01, 0.035, 0.02), 300))
        row = self.trace("sphere:0.01", self.design, "--path", path)[-1]
        self.assertEqual(row["object"], 1)

    def test_it_is_explored_and_drawn(self):
        picture = self.folder / "touch.png"
        report = self.report(self.design, "--fit", "0.3", "--seconds", "2", "--check", "--picture", picture)
        self.assertEqual((report["pops"], report["sticks"]), (0, 0))
        self.assertGreater(report["touch_fraction"], 0.02)  # in a long row there is much air between
        self.assertTrue(picture.read_bytes().startswith(b"\x89PNG"))

    def test_a_tip_with_a_radius_rests_above(self):
        row = self.contact(self.design, (0.01, 0.1, 0.02), (0.01, 0.035, 0.02), "--radius", "0.003")
        self.assert_point(row, (0.01, 0.043, 0.02))

    def test_what_does_not_fit_designs_is_said(self):
        self.fails("touch", self.design, "--renderer", "thesis", code=1, saying="--renderer thesis touches")
        self.fails("touch", self.design, "--subdivide", "limit", code=1, saying="--subdivide is for meshes")
        self.fails("touch", self.write("empty.wrl", "#VRML V2.0 utf8\n"), code=1, saying="nothing to touch")
        self.fails("touch", self.folder / "none.wrl", code=1, saying="none.wrl")

    def test_shared_designs_are_touched(self):
        if not SHARED_VRML.is_dir():
            self.skipTest(f"the shared VRML files are not at {SHARED_VRML}")
        for name in SHARED_DESIGNS:
            with self.subTest(name):
                report = self.report(SHARED_VRML / name, "--fit", "0.2", "--seconds", "0.5", "--check")
                self.assertGreater(report["touch_fraction"], 0.05)
                self.assertEqual((report["pops"], report["sticks"]), (0, 0))


SHARED_DESIGNS = ("assimp/HelloWorld.wrl", "castle/vrml_2/collisions.wrl", "castle/vrml_2/kings_head.wrl",
                  "choreonoid/tire.wrl", "openhrp3/PA10/pa10.main.wrl", "openvrml/models/scale.wrl",
                  "vtk/teapot.wrl", "xj3d/geometry/ElevationGrid.wrl", "xj3d/external/inlined_boxes.wrl")


class JournalTest(DesignTest):
    SOLID = "difference() { cube(size = [80, 80, 80], center = true); cylinder(h = 200, r = 15, center = true); }\n"

    def test_a_csg_tree_in_a_design_is_felt_without_a_mesh(self):
        design = self.folder / "solid.icome"
        self.succeeds("convert", self.write("solid.csg", self.SOLID), design)
        row = self.contact(design, (0.02, 0.1, 0), (0.02, 0.038, 0))
        self.assert_point(row, (0.02, 0.04, 0))
        self.assertEqual(self.report(design, "--seconds", "0.1")["triangles"], 0)


if __name__ == "__main__":
    unittest.main()
