"""Textured scenes in VRML, glTF and OBJ look as their standards say, and leave for other programs as they look.
Everything is held to picture_judge.py, which shares nothing with the program."""
import base64
import json
import math
import struct
import unittest

from icome_program import ProgramTest
from picture_judge import (HALVES, Camera, Glb, Picture, Thing, bar_place, box_place, compared, hit_bar, hit_box,
                           hit_sphere, hit_square, linear, same_hue, shown, sphere_place, texture, vrml_frame)
from shot_test import pixels

SIDE = 120
# No two rows or columns alike, none its own mirror image.
MAP = Picture(["rgbymcrb", "cyrgmbyg", "mrcbygrc", "gbymrcbm"])
QUAD = Picture(["rgb", "ycm", "bry"])
HOLES = Picture(["r.", ".g"], {"r": (200, 20, 20, 255), "g": (20, 180, 20, 255), ".": (30, 30, 200, 0)}.get)
GREY = Picture(["wk"], {"w": (200,), "k": (90,)}.get)
GREYS_IN_COLOUR = Picture(["wk"], {"w": (200, 200, 200), "k": (90, 90, 90)}.get)


def half_square(half, z=0.0, x=0.0):
    """Where a picture lies on hit_square, once from corner to corner."""
    return lambda p, n: ((p[0] - x) / (2 * half) + 0.5, p[1] / (2 * half) + 0.5)


def vrml_square(half, z=0.0, x=0.0, fields=""):
    corners = ", ".join(f"{x + a * half} {b * half} {z}" for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1)))
    return f"IndexedFaceSet {{ coord Coordinate {{ point [ {corners} ] }} coordIndex [ 0 1 2 3 -1 ] {fields} }}"


class TexturedScenesTest(ProgramTest):
    def picture(self, name, picture):
        (self.folder / name).write_bytes(picture.file())
        return name

    def vrml(self, camera, shapes):
        text = "#VRML V2.0 utf8\n" + camera.vrml()
        for geometry, picture, more, material in shapes:
            url = self.picture(f"p{abs(hash(str(picture.texels)))}.png", picture)
            text += (f"Shape {{ appearance Appearance {{ material Material {{ {material} }} texture ImageTexture "
                     f"{{ url \"{url}\" }} {more} }}\n geometry {geometry} }}\n")
        return self.write("scene.wrl", text)

    def drawn(self, file, *arguments):
        out = self.folder / "out.png"
        self.succeeds("shot", file, out, "--size", f"{SIDE}x{SIDE}", "--background", "white", *arguments)
        return pixels(out)[2]

    def looks_right(self, file, camera, things, fits=same_hue, least=200):
        count, wrong = compared(camera, things, self.drawn(file), fits)
        self.assertGreater(count, least)
        self.assertLessEqual(len(wrong), count // 100, f"{len(wrong)} of {count}: {wrong[:5]}")

    def exact(self, light, expected):
        return all(abs(shown(a) - shown(b)) < 4 for a, b in zip(light, expected))

    # ---- VRML 97: 1 to 8 ------------------------------------------------------------------------------------

    def primitive(self, geometry, hit, place, eye, picture=MAP, fields="", frame=lambda u, v: (u, v)):
        camera = Camera(eye)
        more = f"textureTransform TextureTransform {{ {fields} }}" if fields else ""
        file = self.vrml(camera, [(geometry, picture, more, "diffuseColor 0.1 0.1 0.9")])
        things = [Thing(hit, place, texture(picture, frame))]
        self.looks_right(file, camera, things)
        self.leaves_so(file, place, picture, frame)

    def test_1_a_sphere_stands_upright(self):
        self.primitive("Sphere { radius 0.5 }", hit_sphere(0.5), sphere_place(0.5), (0.6, 0.9, 1.3))

    def test_2_a_sphere_has_its_seam_at_the_back(self):
        self.primitive("Sphere { radius 0.5 }", hit_sphere(0.5), sphere_place(0.5), (-0.3, -0.4, -1.6))

    def test_3_a_box_is_upright_on_each_side(self):
        size = (0.8, 0.5, 0.6)
        for eye in ((1.0, 0.9, 1.2), (-1.0, -0.9, -1.2)):
            self.primitive("Box { size 0.8 0.5 0.6 }", hit_box(size), box_place(size), eye, QUAD)

    def test_4_a_cylinder_with_a_transform(self):
        self.primitive("Cylinder { radius 0.3 height 0.7 }", hit_bar(0.3, 0.3, 0.7), bar_place(0.3, 0.7),
                       (0.5, 1.0, 1.3), QUAD, "scale 2 1 translation 0.1 0.25",
                       vrml_frame((0.1, 0.25), 0.0, (2, 1)))

    def test_5_a_cone_with_a_turned_picture(self):
        self.primitive("Cone { bottomRadius 0.4 height 0.8 }", hit_bar(0.4, 0.0, 0.8), bar_place(0.4, 0.8),
                       (0.4, -0.8, 1.5), QUAD, "rotation 0.6 center 0.5 0.5",
                       vrml_frame((0, 0), 0.6, (1, 1), (0.5, 0.5)))

    def test_6_a_box_with_all_of_a_transform(self):
        size = (0.6, 0.6, 0.6)
        self.primitive("Box { size 0.6 0.6 0.6 }", hit_box(size), box_place(size), (1.0, 0.7, 1.2), QUAD,
                       "translation 0.2 0.1 rotation 1.5707963 scale 1.5 1.5 center 0.25 0.5",
                       vrml_frame((0.2, 0.1), 1.5707963, (1.5, 1.5), (0.25, 0.5)))

    def test_7_colours_replace_and_greys_multiply(self):
        """VRML 97, 4.14.3: by how many components the picture's file has, not by what it shows."""
        camera = Camera((0.0, 0.0, 1.6))
        red = "diffuseColor 0.78 0.1 0.1"
        file = self.vrml(camera, [(vrml_square(0.2, 0, -0.3), GREY, "", red),
                                  (vrml_square(0.2, 0, 0.3), GREYS_IN_COLOUR, "", red)])
        tint = tuple(linear(255 * part) for part in (0.78, 0.1, 0.1))
        things = [Thing(hit_square(0.2, 0, -0.3), half_square(0.2, 0, -0.3), texture(GREY, tint=tint)),
                  Thing(hit_square(0.2, 0, 0.3), half_square(0.2, 0, 0.3), texture(GREYS_IN_COLOUR))]
        self.looks_right(file, camera, things)

    def test_8_holes_show_what_is_behind(self):
        camera = Camera((0.2, 0.1, 1.6))
        file = self.vrml(camera, [(vrml_square(0.3), HOLES, "", "transparency 0.6"),
                                  (vrml_square(0.5, -0.4), QUAD, "", "")])
        things = [Thing(hit_square(0.3), half_square(0.3), texture(HOLES, hole=lambda it: it[3] == 0)),
                  Thing(hit_square(0.5, -0.4), half_square(0.5), texture(QUAD))]
        self.looks_right(file, camera, things)
        glb = Glb(self.converted(file, "glb"))
        modes = {it.get("alphaMode", "OPAQUE") for it in glb.json["materials"]}
        self.assertEqual(modes, {"MASK", "OPAQUE"})
        # The picture's opacity replaces the material's, and MTL multiplies them.
        library = self.converted(file, "obj").with_suffix(".mtl").read_text()
        self.assertEqual({line for line in library.splitlines() if line.startswith("d ")}, {"d 1"})

    # ---- glTF 2.0: 9 to 11 ----------------------------------------------------------------------------------

    def gltf(self, camera, squares, name="scene.gltf"):
        """Unlit squares: (half, z, picture, factor, members of the material, of its texture, coordinates)."""
        node, lens = camera.gltf()
        it = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": list(range(len(squares) + 1))}],
              "extensionsUsed": ["KHR_materials_unlit", "KHR_texture_transform"], "cameras": [lens],
              "nodes": [node], "meshes": [], "materials": [], "textures": [], "images": [], "accessors": [],
              "bufferViews": [], "buffers": []}
        data = b""
        for i, (half, z, picture, factor, material, info, sets) in enumerate(squares):
            corners = [(-half, -half, z), (half, -half, z), (half, half, z), (-half, half, z)]
            lists = [("POSITION", corners)] + [(f"TEXCOORD_{k}", it) for k, it in enumerate(sets)]
            attributes = {}
            for label, rows in lists:
                attributes[label] = len(it["accessors"])
                body = b"".join(struct.pack(f"<{len(row)}f", *row) for row in rows)
                it["bufferViews"].append({"buffer": 0, "byteOffset": len(data), "byteLength": len(body)})
                it["accessors"].append({"bufferView": len(it["bufferViews"]) - 1, "componentType": 5126, "count": 4,
                                        "type": f"VEC{len(rows[0])}", "min": [min(c) for c in zip(*rows)],
                                        "max": [max(c) for c in zip(*rows)]})
                data += body
            body = struct.pack("<6H", 0, 1, 2, 0, 2, 3)
            it["bufferViews"].append({"buffer": 0, "byteOffset": len(data), "byteLength": len(body)})
            it["accessors"].append({"bufferView": len(it["bufferViews"]) - 1, "componentType": 5123, "count": 6,
                                    "type": "SCALAR"})
            data += body
            it["meshes"].append({"primitives": [{"attributes": attributes, "material": i,
                                                 "indices": len(it["accessors"]) - 1}]})
            it["nodes"].append({"mesh": i})
            it["images"].append({"uri": "data:image/png;base64," + base64.b64encode(picture.file()).decode()})
            it["textures"].append({"source": i})
            it["materials"].append({"pbrMetallicRoughness": {"baseColorFactor": factor, "baseColorTexture":
                                                             {"index": i, **info}},
                                    "extensions": {"KHR_materials_unlit": {}}, **material})
        it["buffers"].append({"byteLength": len(data), "uri": "data:application/octet-stream;base64," +
                              base64.b64encode(data).decode()})
        return self.write(name, json.dumps(it))

    ONCE = [(0, 1), (1, 1), (1, 0), (0, 0)]  # down from the top

    def test_9_the_base_colour_multiplies_in_linear_light(self):
        camera = Camera((0.0, 0.0, 1.6))
        file = self.gltf(camera, [(0.5, 0, QUAD, [0.5, 0.25, 0.8, 1], {}, {}, [self.ONCE])])
        things = [Thing(hit_square(0.5), half_square(0.5), texture(QUAD, tint=(0.5, 0.25, 0.8)))]
        self.looks_right(file, camera, things, self.exact)
        self.looks_right(self.converted(file, "glb"), camera, things, self.exact)

    def test_10_a_picture_is_laid_by_its_transform_on_the_set_that_it_names(self):
        """KHR_texture_transform: scaled, turned counter-clockwise, moved; v down."""
        camera = Camera((0.0, 0.0, 1.6))
        transform = {"offset": [0.1, 0.7], "rotation": 0.5, "scale": [0.6, 0.9], "texCoord": 1}
        file = self.gltf(camera, [(0.5, 0, QUAD, [1, 1, 1, 1], {}, {"extensions":
                                  {"KHR_texture_transform": transform}}, [[(0, 0)] * 4, self.ONCE])])

        def frame(u, v):
            s, t = 0.6 * u, 0.9 * (1 - v)
            return (0.1 + math.cos(0.5) * s + math.sin(0.5) * t, 1 - (0.7 - math.sin(0.5) * s + math.cos(0.5) * t))
        things = [Thing(hit_square(0.5), half_square(0.5), texture(QUAD, frame))]
        self.looks_right(file, camera, things, self.exact)
        self.looks_right(self.converted(file, "glb"), camera, things, self.exact)

    def test_11_alpha_counts_as_the_mode_says(self):
        camera = Camera((0.0, 0.0, 1.6))
        solid = (0.5, -0.3, QUAD, [1, 1, 1, 1], {}, {}, [self.ONCE])
        behind = Thing(hit_square(0.5, -0.3), half_square(0.5), texture(QUAD))
        for mode, cutoff, alpha, picture, hole in (("MASK", 0.7, 1, HALVES, lambda it: it[3] < 0.7 * 255),
                                                   ("MASK", None, 0.4, HOLES, lambda it: True),
                                                   ("MASK", 1.5, 1, HOLES, lambda it: True),
                                                   ("OPAQUE", None, 1, HALVES, lambda it: False)):
            material = {"alphaMode": mode, **({"alphaCutoff": cutoff} if cutoff else {})}
            file = self.gltf(camera, [(0.3, 0, picture, [1, 1, 1, alpha], material, {}, [self.ONCE]), solid])
            things = [Thing(hit_square(0.3), half_square(0.3), texture(picture, hole=hole)), behind]
            for it in (file, self.converted(file, "glb")):
                with self.subTest(mode=mode, cutoff=cutoff, file=it.name):
                    self.looks_right(it, camera, things, self.exact)

    def test_metal_shines_in_the_colours_of_its_picture(self):
        """metallicFactor is 1 where a file says nothing of it."""
        camera = Camera((0.0, 0.0, 1.6))

        def without_white(light, expected):
            return same_hue(light, expected) and min(light) < 0.35 * max(light)
        for metal in ({}, {"metallicFactor": 1, "roughnessFactor": 0.5}, {"metallicFactor": 0}):
            file = self.gltf(camera, [(0.5, 0, QUAD, [1, 1, 1, 1], {}, {}, [self.ONCE])])
            it = json.loads(file.read_text())
            del it["materials"][0]["extensions"]
            it["materials"][0]["pbrMetallicRoughness"].update(metal)
            file.write_text(json.dumps(it))
            things = [Thing(hit_square(0.5), half_square(0.5), texture(QUAD))]
            for each in (file, self.converted(file, "glb")):
                with self.subTest(metal=metal, file=each.name):
                    self.looks_right(each, camera, things, without_white)

    # ---- OBJ: 12 --------------------------------------------------------------------------------------------

    def test_12_mtl_multiplies_and_moves(self):
        self.picture("quad.png", QUAD)
        self.write("paint.mtl", "newmtl paint\nKd 0.9 0.5 0.3\nmap_Kd -s 2 1 1 -o 0.25 0.5 quad.png\n")
        file = self.write("scene.obj", "mtllib paint.mtl\nv -.5 -.5 0\nv .5 -.5 0\nv .5 .5 0\nv -.5 .5 0\n"
                          "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl paint\nf 1/1 2/2 3/3 4/4\n")
        rows = self.drawn(file, "--view", "front")
        tint = tuple(linear(255 * part) for part in (0.9, 0.5, 0.3))
        colour = texture(QUAD, lambda u, v: (2 * u + 0.25, v + 0.5), tint)
        # The square fills the view but for a rim, which its corners show.
        inside = [(x, y) for y in range(SIDE) for x in range(SIDE) if rows[y][x][:3] != (255, 255, 255)
                  and max(rows[y][x][:3]) - min(rows[y][x][:3]) > 40]
        low = [min(it[k] for it in inside) for k in (0, 1)]
        high = [max(it[k] for it in inside) + 1 for k in (0, 1)]
        for i in range(12):
            for j in range(6):
                u, v = (i + 0.5) / 12, (j + 0.5) / 6
                pixel = rows[int(high[1] - v * (high[1] - low[1]))][int(low[0] + u * (high[0] - low[0]))]
                if len({colour(u + a, v + b) for a in (-0.02, 0.02) for b in (-0.02, 0.02)}) == 1:
                    self.assertTrue(same_hue(tuple(map(linear, pixel[:3])), colour(u, v)), (u, v, pixel))

    # ---- Lights ---------------------------------------------------------------------------------------------

    def test_a_directional_light_shines_on_its_group(self):
        """VRML 97, 4.6.1: on its siblings and what is below them; other lights on everything."""
        squares = [vrml_square(0.2, 0, x) for x in (-0.3, 0.3)]
        shapes = [f"Shape {{ appearance Appearance {{ material Material {{ }} }} geometry {it} }}" for it in squares]
        light = "DirectionalLight { direction 0 0 -1 }"
        head = "#VRML V2.0 utf8\n" + Camera((0.0, 0.0, 1.6)).vrml()

        def brightness(text, name="lit.wrl"):
            rows = self.drawn(self.write(name, head + text) if text else self.folder / name)
            return [linear(rows[SIDE // 2][x][1]) for x in (SIDE // 4, 3 * SIDE // 4)]
        grouped = f"Group {{ children [ {light} Group {{ children {shapes[0]} }} ] }} {shapes[1]}"
        left, right = brightness(grouped)
        self.assertGreater(left, 2 * right)
        both = brightness(f"{light} {' '.join(shapes)}")
        self.assertAlmostEqual(both[0], left, delta=0.05)
        self.assertAlmostEqual(both[1], left, delta=0.05)
        for ending in ("wrl", "glb"):
            kept = self.converted(self.folder / "lit.wrl", ending)
            again = brightness("", kept.name)
            self.assertAlmostEqual(again[0], both[0], delta=0.02)
        self.write("lit.wrl", head + grouped)
        for ending in ("wrl", "glb"):
            again = brightness("", self.converted(self.folder / "lit.wrl", ending).name)
            self.assertAlmostEqual(again[0], left, delta=0.02)
            self.assertAlmostEqual(again[1], right, delta=0.02)

    # ---- Scenes for other programs --------------------------------------------------------------------------

    def converted(self, file, ending):
        out = self.folder / f"{file.stem}-out.{ending}"
        self.succeeds("convert", file, out)
        return out

    def leaves_so(self, file, place, picture, frame):
        """The triangles that stand in a GLB and an OBJ file show the picture where the surface does."""
        for triangles in (Glb(self.converted(file, "glb")).triangles(picture), self.obj_triangles(file, picture)):
            count, wrong = 0, []
            for corners, places, shows in triangles:
                a, b = ([corners[j][k] - corners[0][k] for k in range(3)] for j in (1, 2))
                normal = (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
                size = math.sqrt(sum(it * it for it in normal))
                for weights in ((0.5, 0.3, 0.2), (0.15, 0.25, 0.6), (0.1, 0.7, 0.2)):
                    point, found = (tuple(sum(w * it[k] for w, it in zip(weights, of)) for k in range(len(of[0])))
                                    for of in (corners, places))
                    u, v = frame(*place(point, tuple(it / size for it in normal)))
                    if len({picture.at(u + x, v + y) for x in (-0.03, 0.03) for y in (-0.03, 0.03)}) > 1:
                        continue
                    count += 1
                    if shows(*found) != picture.at(u, v):
                        wrong.append((point, (u, v), found))
            self.assertGreater(count, 10)
            self.assertLessEqual(len(wrong), count // 50, f"{len(wrong)} of {count}: {wrong[:3]}")

    def obj_triangles(self, file, picture):
        out = self.converted(file, "obj")
        vertices, places = [], []
        for line in out.read_text().splitlines():
            words = line.split()
            if words[:1] == ["v"]:
                vertices.append(tuple(map(float, words[1:4])))
            elif words[:1] == ["vt"]:
                places.append(tuple(map(float, words[1:3])))
            elif words[:1] == ["f"]:
                corners = [word.split("/") for word in words[1:]]
                yield ([vertices[int(it[0]) - 1] for it in corners], [places[int(it[1]) - 1] for it in corners],
                       picture.at)


if __name__ == "__main__":
    unittest.main()
