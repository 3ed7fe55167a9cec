"""What a glTF file of another program had is in the file that `icome convert` makes of it, or is told to be lost."""
import base64
import json
import struct
import unittest

from icome_program import ProgramTest
from picture_judge import HALVES, Glb, Picture

QUAD = Picture(["rg", "by"])


class GltfKeptTest(ProgramTest):
    def file_of(self, materials, picture=QUAD, **more):
        """A triangle in each of the materials."""
        corners = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)
        places = struct.pack("<6f", 0, 0, 1, 0, 0, 1)
        data = corners + places + places + struct.pack("<12f", *[0.5] * 12)
        views = [(0, 36), (36, 24), (60, 24), (84, 48)]
        it = {"asset": {"version": "2.0"}, "scenes": [{"nodes": list(range(len(materials)))}], "scene": 0,
              "nodes": [{"mesh": i, "name": f"thing {i}"} for i in range(len(materials))],
              "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "material": i}]}
                         for i in range(len(materials))],
              "materials": materials, "textures": [{"source": 0, "sampler": 0}], "samplers": [{}],
              "images": [{"uri": "data:image/png;base64," + base64.b64encode(picture.file()).decode()}],
              "accessors": [{"bufferView": i, "componentType": 5126, "count": 3, "type": kind} for i, kind in
                            enumerate(("VEC3", "VEC2", "VEC2", "VEC4"))],
              "bufferViews": [{"buffer": 0, "byteOffset": start, "byteLength": size} for start, size in views],
              "buffers": [{"byteLength": len(data),
                           "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}]}
        it["accessors"][0].update(min=[0, 0, 0], max=[1, 1, 0])
        it.update(more)
        return self.write("in.gltf", json.dumps(it))

    def kept(self, file, times=1):
        """The materials of what is made of it, by name, and what was told."""
        told = ""
        for i in range(times):
            out = self.folder / f"out{i}.glb"
            told += "\n".join(json.loads(self.succeeds("convert", file, out, "--json").stdout)["warnings"])
            file = out
        return {it["name"]: it for it in Glb(file).json["materials"]}, told

    def near(self, found, expected, places=5):
        self.assertEqual(len(found), len(expected))
        for one, other in zip(found, expected):
            self.assertAlmostEqual(one, other, places)

    def test_materials_are_what_they_were(self):
        base = {"baseColorTexture": {"index": 0}}
        file = self.file_of([
            {"name": "metal", "pbrMetallicRoughness": {"baseColorFactor": [0.9, 0.5, 0.2, 1], "metallicFactor": 0.75,
                                                       "roughnessFactor": 0.15}},
            {"name": "as it is", "pbrMetallicRoughness": {}},
            {"name": "tinted", "pbrMetallicRoughness": {**base, "baseColorFactor": [0.5, 0.25, 0.8, 1]},
             "emissiveFactor": [0.1, 0.2, 0.3], "doubleSided": True},
            {"name": "glass", "alphaMode": "BLEND",
             "pbrMetallicRoughness": {"baseColorFactor": [0.2, 0.3, 0.4, 0.5]}},
            {"name": "flat", "extensions": {"KHR_materials_unlit": {}}, "pbrMetallicRoughness": base},
            {"name": "laid", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0, "extensions": {
                "KHR_texture_transform": {"offset": [0.1, 0.2], "rotation": 0.3, "scale": [2, 3]}}}}},
        ], extensionsUsed=["KHR_materials_unlit", "KHR_texture_transform"])
        for times in (1, 2):
            it, told = self.kept(file, times)
            pbr = {name: material.get("pbrMetallicRoughness", {}) for name, material in it.items()}
            self.near(pbr["metal"]["baseColorFactor"], [0.9, 0.5, 0.2, 1])
            self.near([pbr["metal"]["metallicFactor"], pbr["metal"]["roughnessFactor"]], [0.75, 0.15])
            # Nothing said means all metal and rough, and seen from the front.
            self.assertEqual(pbr["as it is"].get("metallicFactor", 1), 1)
            self.assertEqual(pbr["as it is"].get("roughnessFactor", 1), 1)
            self.assertFalse(it["as it is"].get("doubleSided", False))
            self.near(pbr["tinted"]["baseColorFactor"], [0.5, 0.25, 0.8, 1])
            self.near(it["tinted"]["emissiveFactor"], [0.1, 0.2, 0.3])
            self.assertTrue(it["tinted"]["doubleSided"])
            self.assertEqual(it["glass"]["alphaMode"], "BLEND")
            self.near(pbr["glass"]["baseColorFactor"], [0.2, 0.3, 0.4, 0.5])
            self.assertIn("KHR_materials_unlit", it["flat"]["extensions"])
            laid = pbr["laid"]["baseColorTexture"]["extensions"]["KHR_texture_transform"]
            self.near(laid["offset"] + [laid["rotation"]] + laid["scale"], [0.1, 0.2, 0.3, 2, 3])
            self.assertEqual(told, "")

    def test_alpha_of_pictures_counts_as_it_did(self):
        base = {"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}
        file = self.file_of([{"name": "mask", "alphaMode": "MASK", "alphaCutoff": 0.7, **base},
                             {"name": "usual mask", "alphaMode": "MASK", **base},
                             {"name": "blend", "alphaMode": "BLEND", **base}, {"name": "opaque", **base}], HALVES)
        for times in (1, 2):
            it, told = self.kept(file, times)
            modes = {name: (of.get("alphaMode", "OPAQUE"), round(of.get("alphaCutoff", 0.5), 5))
                     for name, of in it.items()}
            self.assertEqual(modes, {"mask": ("MASK", 0.7), "usual mask": ("MASK", 0.5), "blend": ("BLEND", 0.5),
                                     "opaque": ("OPAQUE", 0.5)})
            self.assertEqual(told, "")

    def test_of_maps_of_metal_and_roughness_the_means_count(self):
        """Blue is metal, green roughness, times the factors (glTF 2.0, 3.9.2)."""
        texel = {"a": (0, 255, 0), "b": (0, 0, 51)}.get
        file = self.file_of([{"name": "worn", "pbrMetallicRoughness": {"metallicRoughnessTexture": {"index": 0},
                                                                       "roughnessFactor": 0.8}}],
                            picture=Picture(["ab", "ab"], texel))
        materials, told = self.kept(file)
        found = materials["worn"]["pbrMetallicRoughness"]
        self.near([found["metallicFactor"], found["roughnessFactor"]], [0.1, 0.4])
        self.assertIn("means count", told)

    def test_what_is_lost_is_told(self):
        file = self.file_of([{"name": "rich", "normalTexture": {"index": 0}, "occlusionTexture": {"index": 0},
                              "emissiveTexture": {"index": 0}, "emissiveFactor": [1, 1, 1],
                              "pbrMetallicRoughness": {"metallicRoughnessTexture": {"index": 0}},
                              "extensions": {"KHR_materials_clearcoat": {}}, "extras": {"mine": 1}}],
                            samplers=[{"wrapS": 33648, "magFilter": 9728}],
                            extensionsUsed=["KHR_materials_clearcoat"])
        it = json.loads(file.read_text())
        it["asset"]["copyright"] = "(c) somebody"
        it["meshes"][0]["name"] = "another name"
        it["meshes"][0]["primitives"][0]["attributes"].update(TEXCOORD_1=2, COLOR_0=3)
        file.write_text(json.dumps(it))
        materials, told = self.kept(file)
        for word in ("normals (1", "metal and roughness (1", "occlusion (1", "emission (1", "mirrored", "smoothed",
                     "KHR_materials_clearcoat", "extras", "copyright", "names? of (a )?mesh", "texture coordinates",
                     "opacity"):
            self.assertRegex(told, word.replace("(1", r"\(1"))
        # A map of emission says where it glows: without it, the whole would.
        self.assertEqual(materials["rich"].get("emissiveFactor", [0, 0, 0]), [0, 0, 0])

    def test_vrml_and_back(self):
        """What ICOME itself says by extras of its own is not lost either, and a picture's own colours stay."""
        (self.folder / "p.png").write_bytes(HALVES.file())
        file = self.write("in.wrl", "#VRML V2.0 utf8\nShape { appearance Appearance { material DEF paint Material { "
                          "diffuseColor 0.2 0.4 0.6 transparency 0.25 shininess 0.5 specularColor 0.1 0.2 0.3 } "
                          "texture ImageTexture { url \"p.png\" } textureTransform TextureTransform { scale 2 3 "
                          "rotation 0.5 translation 0.25 0.125 } } geometry Box { } }\n")
        self.succeeds("convert", file, self.folder / "once.wrl")
        self.succeeds("convert", file, self.folder / "by.glb")
        self.succeeds("convert", self.folder / "by.glb", self.folder / "twice.wrl")
        once, twice = ((self.folder / name).read_text().replace("twice_", "once_")
                       for name in ("once.wrl", "twice.wrl"))
        self.assertIn("textureTransform TextureTransform", once)
        self.assertIn("transparency 0.25", once)
        self.assertEqual(once, twice)
        self.succeeds("convert", self.folder / "once.wrl", self.folder / "again.wrl")
        self.assertEqual((self.folder / "again.wrl").read_text().replace("again_", "once_"), once)


if __name__ == "__main__":
    unittest.main()
