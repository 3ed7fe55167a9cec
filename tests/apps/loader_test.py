"""One loader and one up axis: the same design in every format that can hold it is the same to every command."""
import json
import unittest

from icome_program import ProgramTest, line, point
from png_pixels import pixels

# A step: 10 x 20 mm, 300 mm high in the file's z, with a block of half the height beside it.
STEP = """union() {
  cube(size = [10, 20, 300], center = false);
  multmatrix([[1,0,0,10],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) { cube(size = [40, 20, 150], center = false); }
}
"""
# What feels, and what is exact, has a place in designs only.
FELT = """#VRML V2.0 utf8
PROTO IcomeMaterial [ field SFColor diffuseColor 0.8 0.8 0.8 field SFString name "" field SFFloat stiffness -1
  field SFFloat damping -1 field SFFloat staticFriction 0 field SFFloat dynamicFriction 0
  field SFString hapticTexture "" ] { Material { diffuseColor IS diffuseColor } }
Shape { appearance Appearance { material IcomeMaterial { stiffness 500 staticFriction 0.6 dynamicFriction 0.4 } }
  geometry Sphere { radius 0.05 } }
Transform { translation 0.2 0 0 scale 1 2 1 children Shape {
  appearance Appearance { material IcomeMaterial { stiffness 700 staticFriction 0.5 dynamicFriction 0.5
    hapticTexture "ridges:0.0003,0.004" } }
  geometry Cylinder { radius 0.03 height 0.1 } } }
"""
WHOLE = (".wrl", ".gltf", ".glb", ".icome")
MESHES = (".obj", ".ply", ".stl", ".off")


class LoaderTest(ProgramTest):
    def all_of(self, design, endings):
        """The design itself and, by `icome convert`, in other formats."""
        files = [design]
        for ending in endings:
            if ending != design.suffix:
                files.append(design.with_suffix(ending))
                self.succeeds("convert", design, files[-1])
        return files

    def bounds(self, file):
        box = json.loads(self.succeeds("info", file, "--json").stdout)["bounds"]
        return box["min"] + box["max"]

    def assert_near(self, values, expected, delta, file):
        for got, want in zip(values, expected, strict=True):
            self.assertAlmostEqual(got, want, delta=delta, msg=str(file))

    def felt(self, file, path, *arguments):
        """Places and forces of every tick."""
        rows = self.trace(file, "--path", path, *arguments)
        return [value for row in rows for value in point(row, "scp") + point(row, "force") + (row["touching"],)]

    def assert_felt_alike(self, files, path, delta, *arguments):
        first = self.felt(files[0], path, *arguments)
        self.assertGreater(sum(first[6::7]), 100, "the path touches")
        for file in files[1:]:
            self.assert_near(self.felt(file, path, *arguments), first, delta, file)

    def test_designs_feel_alike_in_every_format_that_keeps_them(self):
        files = self.all_of(self.write("felt.wrl", FELT), WHOLE)
        box = self.bounds(files[0])
        self.assert_near(box, [-0.05, -0.1, -0.05, 0.23, 0.1, 0.05], 1e-9, files[0])
        # Down on the sphere, along it against its friction, then down on the stretched cylinder and across its grain.
        path = self.path_file(line((0, 0.06, 0), (0, 0.045, 0), 200) + line((0, 0.045, 0), (0.02, 0.042, 0.01), 300)
                              + line((0.02, 0.2, 0), (0.2, 0.2, 0), 50) + line((0.2, 0.2, 0), (0.2, 0.098, 0), 200)
                              + line((0.2, 0.098, 0), (0.215, 0.098, 0.01), 300))
        for file in files[1:]:
            self.assert_near(self.bounds(file), box, 1e-9, file)
        self.assert_felt_alike(files, path, 1e-9)
        self.assert_felt_alike(files, path, 1e-9, "--radius", "0.002")
        self.assert_felt_alike(files, path, 1e-9, "--fit", "0.3")

    def test_solids_stand_upright_in_every_format(self):
        files = self.all_of(self.write("step.csg", STEP), WHOLE + MESHES)
        # On the higher part and over its edge, down to the lower one.
        path = self.path_file(line((0.005, 0.31, -0.01), (0.005, 0.298, -0.01), 200)
                              + line((0.005, 0.298, -0.01), (0.03, 0.298, -0.01), 400)
                              + line((0.03, 0.298, -0.01), (0.03, 0.148, -0.01), 400))
        for file in files:
            self.assert_near(self.bounds(file), [0, 0, -0.02, 0.05, 0.3, 0], 1e-7, file)
        self.assert_felt_alike(files[:1 + len(WHOLE)], path, 1e-9)
        self.assert_felt_alike(files, path, 1e-4, "--friction", "0.2")
        self.assertAlmostEqual(self.felt(files[0], path)[-6], 0.15, delta=1e-9)

    def drawn(self, picture):
        """How wide and how high what is drawn is, in pixels: whatever is not the background of the corner."""
        width, height, rows = pixels(picture)
        other = [(x, y) for y in range(height) for x in range(width) if rows[y][x][3] > 128]
        xs, ys = [x for x, _ in other], [y for _, y in other]
        return max(xs) - min(xs), max(ys) - min(ys)

    def test_pictures_show_them_upright(self):
        files = self.all_of(self.write("step.csg", STEP), WHOLE + MESHES)
        picture = self.folder / "picture.png"
        sizes = []
        for file in files:
            self.succeeds("shot", file, picture, "--view", "front", "--size", "120x120", "--background", "none")
            sizes.append(self.drawn(picture))
        for file, (width, height) in zip(files, sizes):
            self.assertGreater(height, 4 * width, file)
            self.assert_near((width, height), sizes[0], 1, file)

    def test_what_is_edited_stays_upright(self):
        script = self.write("nothing.jsonl", "")
        for file in self.all_of(self.write("step.csg", STEP), WHOLE + MESHES):
            edited = self.folder / "edited.wrl"
            self.succeeds("edit", file, "--apply", script, "--out", edited)
            self.assert_near(self.bounds(edited), [0, 0, -0.02, 0.05, 0.3, 0], 1e-7, file)

    def test_an_stl_file_is_the_same_when_it_is_read_and_written_again(self):
        slanted = self.write("slanted.csg", "multmatrix([[0.8,-0.6,0,3],[0.6,0.8,0,1],[0,0,1,2],[0,0,0,1]]) { "
                             "difference() { cube(size = [10, 20, 30], center = true); cylinder(h = 40, r = 4, "
                             "center = true); } }\n")
        once, twice = self.folder / "once.stl", self.folder / "twice.stl"
        self.succeeds("convert", slanted, once)
        self.succeeds("convert", once, twice)
        self.assertEqual(once.read_bytes(), twice.read_bytes())

    def test_units_and_axes_mean_the_same_to_every_command(self):
        block = self.write("block.obj", "".join(f"v {x} {y} {z}\n" for x in (0, 10) for y in (0, 20) for z in (0, 300))
                           + "f 1 2 4 3\nf 5 7 8 6\nf 1 5 6 2\nf 3 4 8 7\nf 1 3 7 5\nf 2 6 8 4\n")
        how = ("--unit", "mm", "--up", "z")
        turned = self.folder / "turned.glb"
        self.succeeds("convert", block, turned, *how)
        self.assert_near(self.bounds(turned), [0, 0, -0.02, 0.01, 0.3, 0], 1e-7, turned)
        path = self.path_file(line((0.005, 0.31, -0.01), (0.005, 0.298, -0.01), 300))
        self.assert_near(self.felt(block, path, *how), self.felt(turned, path), 1e-6, block)

    def test_touching_tells_what_was_turned_and_keeps_to_limits(self):
        step = self.write("step.csg", STEP)
        self.assertIn("Its z axis points up: it was turned", self.succeeds("touch", step, "--seconds", "0.05").stdout)
        for file in self.all_of(step, MESHES):
            self.fails("touch", file, "--seconds-limit", "0", code=1, saying="0 s that it may")


if __name__ == "__main__":
    unittest.main()
