#include "files/vrml/write/vrml_writer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string_view>

#include "files/design_maker.h"
#include "files/sample_files.h"
#include "io/file_bytes.h"
#include "world/every_edit.h"
#include "world/random_edits.h"

namespace icome::files {
namespace {

using namespace world;

struct Written {
  std::string text;
  std::vector<std::string> remarks;
};

Written write_out(const World& world, const ScratchFolder& folder, const std::string& name = "design.wrl") {
  const auto remarks = write_vrml(folder.path() / name, world);
  if (!remarks) throw std::runtime_error(remarks.error().message);
  Written result{io::read_bytes(folder.path() / name, 1U << 28U).value(), {}};
  for (const Remark& remark : *remarks) result.remarks.push_back(remark.text);
  return result;
}

/// What follows the first line and the PROTOs.
std::string body(const World& world) {
  const ScratchFolder folder;
  const std::string text = write_out(world, folder).text;
  const std::size_t protos = text.rfind("\n}\n\n");
  return text.substr(protos == std::string::npos ? text.find("\n\n") + 2 : protos + 4);
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

TEST(VrmlWriter, WritesAnObjectAsPeopleWould) {
  DesignMaker design;
  const ObjectId table = design.add("table", box(0.5), {}, at(0.0, 0.9, -0.0));
  design.add("ball", std::make_shared<PrimitiveGeometry>(geometry::Sphere{0.1}), table);
  EXPECT_EQ(body(design.world), R"(DEF table Transform {
  translation 0 0.9 0
  children [
    Shape {
      appearance DEF IcomeDefault Appearance {
        material Material { }
      }
      geometry Box {
        size 0.5 0.5 0.5
      }
    }
    DEF ball Transform {
      children [
        Shape {
          appearance USE IcomeDefault
          geometry Sphere {
            radius 0.1
          }
        }
      ]
    }
  ]
}
)");
}

TEST(VrmlWriter, AnEmptyWorldIsAFileToo) {
  const ScratchFolder folder;
  EXPECT_EQ(write_out(World(), folder).text, "#VRML V2.0 utf8\n\n");
}

TEST(VrmlWriter, NamesAreTitlesWhereTheyCannotBeDefNames) {
  DesignMaker design;
  for (const char* name :
       {"left door", "door", "door", "2nd", "w\xc3\xb6od", "USE", "a+b", "IcomeUnnamed", "say \"\\\""})
    design.add(name, nullptr);
  design.add("", nullptr);
  const std::string text = body(design.world);
  EXPECT_TRUE(
      contains(text, "DEF left_door Transform {\n  children [\n    WorldInfo {\n      title \"left door\""));
  EXPECT_TRUE(contains(text, "DEF door Transform { }"));
  EXPECT_TRUE(contains(text, "DEF door_2 Transform {\n  children [\n    WorldInfo {\n      title \"door\""));
  EXPECT_TRUE(contains(text, "DEF _2nd Transform"));
  EXPECT_TRUE(contains(text, "title \"w\xc3\xb6od\""));
  EXPECT_TRUE(contains(text, "DEF _USE Transform"));
  EXPECT_TRUE(contains(text, "DEF a_b Transform"));
  EXPECT_TRUE(contains(text, "DEF _IcomeUnnamed Transform"));
  EXPECT_TRUE(contains(text, R"(title "say \"\\\"")"));
  EXPECT_TRUE(contains(text, "\nTransform { }\n"));
}

TEST(VrmlWriter, ClonesUseWhatTheyShare) {
  DesignMaker design;
  const ObjectId leg = design.add("leg", one_triangle());
  const MaterialId wood = design.ids.next<MaterialId>();
  applied(design.world, CreateMaterial{wood, {.name = "wood"}});
  applied(design.world, ChooseMaterial{leg, wood});
  duplicated(design.world, design.ids, leg, Duplicate::CloneObject);
  duplicated(design.world, design.ids, leg, Duplicate::CopyObject);
  const std::string text = body(design.world);
  EXPECT_EQ(count(text, "appearance DEF wood Appearance"), 1U);
  EXPECT_EQ(count(text, "appearance USE wood\n"), 2U);
  EXPECT_EQ(count(text, "geometry DEF leg_shape IndexedFaceSet"), 1U);
  EXPECT_EQ(count(text, "geometry USE leg_shape\n"), 1U);
  EXPECT_EQ(count(text, "geometry IndexedFaceSet"), 1U);
}

TEST(VrmlWriter, DefinesOnlyProtosThatAreUsed) {
  DesignMaker design;
  design.add("solid", csg());
  const ScratchFolder folder;
  const std::string text = write_out(design.world, folder).text;
  EXPECT_EQ(count(text, "PROTO "), 1U);
  EXPECT_TRUE(contains(text, "PROTO IcomeCsg ["));
  EXPECT_TRUE(contains(text, "geometry IcomeCsg {"));
}

TEST(VrmlWriter, WritesEveryKindOfShapeForOtherProgramsToo) {
  DesignMaker design;
  for (const GeometryPointer& shape : every_shape()) design.add("one", shape);
  const ScratchFolder folder;
  const Written all = write_out(design.world, folder);
  for (const char* part : {"IcomeLoopSurface {", "IcomeImplicit {", "shape \"torus:0.3x0.1\"", "axis \"y\"",
                           "formula \"x^2 + y^2 + z^2 - 0.05^2\"", "box \"-0.1 -0.1 -0.1 0.1 0.1 0.1\"",
                           "crease [\n", "corner [\n", "tree \"define mesh 0\n"})
    EXPECT_EQ(contains(all.text, part), std::string_view(part) != "axis \"y\"") << part;
  const auto told = [&](std::string_view remark) {
    return std::count(all.remarks.begin(), all.remarks.end(), remark);
  };
  EXPECT_EQ(all.remarks.size(), 2U);
  EXPECT_EQ(told("The shape of \"one\" is not seen by other programs: A plane has no end: it cannot be made "
                 "triangles."),
            1);
  EXPECT_EQ(told("The colours of parts of the shape of \"one\" are not seen by other programs."), 1);
}

TEST(VrmlWriter, TellsThatParametersAreNotKept) {
  const ScratchFolder folder;
  DesignMaker design;
  design.add("by hand", one_triangle());
  EXPECT_TRUE(write_out(design.world, folder).remarks.empty());
  design.add("made", made_mesh());
  const std::vector<std::string> one{"VRML 2.0 knows no parameters of shapes: 1 shape stays as triangles."};
  EXPECT_EQ(write_out(design.world, folder).remarks, one);
  design.add("made", made_mesh());
  const std::vector<std::string> two{"VRML 2.0 knows no parameters of shapes: 2 shapes stay as triangles."};
  EXPECT_EQ(write_out(design.world, folder).remarks, two);
}

TEST(VrmlWriter, TellsThatProjectorsAreNotKept) {
  const ScratchFolder folder;
  DesignMaker design;
  design.add("pictured", made_mesh(R"({"op":"texture","projection":"box"})"));
  const std::vector<std::string> one{"VRML 2.0 does not keep where pictures were thrown on 1 mesh from."};
  EXPECT_EQ(write_out(design.world, folder).remarks, one);
}

class OwnShape final : public Geometry {
 public:
  std::string_view kind() const override { return "egg"; }
  Bounds bounds() const override { return Bounds(Vector3::Zero(), Vector3::Ones()); }
  std::uint64_t hash() const override { return 1; }
  std::size_t bytes() const override { return sizeof(*this); }
  base::Result<std::shared_ptr<const MeshGeometry>> triangles(double) const override {
    return std::make_shared<const MeshGeometry>(tetrahedron());
  }
  base::Result<std::string> write() const override { return base::fail("no"); }
};

TEST(VrmlWriter, WhatItHasNoNodeForBecomesTrianglesOrNothing) {
  DesignMaker design;
  design.add("own", std::make_shared<OwnShape>());
  design.add("broken", std::make_shared<MeshGeometry>(geometry::TriangleMesh{{}, {{0, 1, 2}}}));
  const ScratchFolder folder;
  const Written all = write_out(design.world, folder);
  EXPECT_EQ(count(all.text, "-1\n"), 4U);
  ASSERT_EQ(all.remarks.size(), 2U);
  EXPECT_TRUE(contains(all.remarks[0], "The shape of \"own\" is written as triangles: VRML 2.0 has nothing"));
  EXPECT_TRUE(contains(all.remarks[1], "The shape of \"broken\" is left out: A triangle names a vertex"));
}

TEST(VrmlWriter, MeshesSayWhatLooksSmooth) {
  geometry::TriangleMesh tetra = tetrahedron();
  auto flat = std::make_shared<MeshGeometry>(tetra);
  for (std::size_t t = 0; t < tetra.triangles.size(); ++t) {
    const Vector3 across =
        (tetra.corner(t, 1) - tetra.corner(t, 0)).cross(tetra.corner(t, 2) - tetra.corner(t, 0));
    flat->normals.push_back({across.normalized(), across.normalized(), across.normalized()});
  }
  DesignMaker design;
  design.add("flat", flat);
  std::string text = body(design.world);
  EXPECT_FALSE(contains(text, "normal Normal") || contains(text, "creaseAngle") || contains(text, "solid"));
  DesignMaker smooth;
  smooth.add("smooth", std::make_shared<MeshGeometry>(tetra));
  text = body(smooth.world);
  EXPECT_TRUE(contains(text, "creaseAngle 3.1415927") && !contains(text, "normal"));
  DesignMaker other;
  other.add("other", textured_mesh());
  text = body(other.world);
  EXPECT_TRUE(contains(text, "normal Normal {") && contains(text, "normalIndex [") &&
              contains(text, "texCoordIndex [") && contains(text, "colorIndex ["));
}

TEST(VrmlWriter, PicturesLieBesideTheDesignAndAreNeverOverwritten) {
  const ScratchFolder folder;
  DesignMaker design;
  const auto paint = [&](const std::string& name, const std::string& bytes) {
    const TextureId picture = design.ids.next<TextureId>();
    const MaterialId material = design.ids.next<MaterialId>();
    applied(design.world, CreateTexture{picture, {name, "image/png", std::make_shared<std::string>(bytes)}});
    applied(design.world, CreateMaterial{material, {.texture = picture}});
    applied(design.world, ChooseMaterial{design.add(name, nullptr), material});
  };
  paint("../../maps/wood.png", "one");
  paint("/tmp/wood.png", "two");
  paint("C:\\wood.png", "two");
  paint("..", "three");
  paint("bark.jpg", "four");
  std::string first, again;
  for (std::string* text : {&first, &again}) *text = write_out(design.world, folder, "my table.wrl").text;
  EXPECT_EQ(first, again);
  for (const char* part : {"url \"my_table_textures/wood.png\"", "url \"my_table_textures/wood-2.png\"",
                           "url \"my_table_textures/bark_jpg.png\""})
    EXPECT_TRUE(contains(first, part)) << part;
  EXPECT_EQ(io::read_bytes(folder.path() / "my_table_textures/wood.png", 9).value(), "one");
  EXPECT_EQ(io::read_bytes(folder.path() / "my_table_textures/wood-2.png", 9).value(), "two");
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.path()))
    files += entry.is_regular_file() ? 1 : 0;
  EXPECT_EQ(files, 5U);
}

TEST(VrmlWriter, DoesNotFollowALinkInPlaceOfThePicturesFolder) {
  const ScratchFolder folder, elsewhere;
  World world;
  for (const Edit& edit : every_edit()) applied(world, edit);
  std::filesystem::create_directory_symlink(elsewhere.path(), folder.path() / "design_textures");
  const auto result = write_vrml(folder.path() / "design.wrl", world);
  ASSERT_FALSE(result);
  EXPECT_TRUE(contains(result.error().message, "design_textures: the folder for the design's pictures"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "design.wrl"));
  EXPECT_TRUE(std::filesystem::is_empty(elsewhere.path()));
}

TEST(VrmlWriter, LightsViewpointsAndScenes) {
  DesignMaker design;
  const ObjectId lamp = design.add("lamp", nullptr, {}, at(0.0, 2.0, 0.0));
  applied(design.world, ChangeFixture{lamp, spot_light()});
  const ObjectId eye = design.add("from the door", nullptr, {}, at(0.0, 1.6, 3.0));
  applied(design.world, ChangeFixture{eye, std::make_shared<const Fixture>(Viewpoint{1.2})});
  const ObjectId nameless = design.add("", box(1.0));
  const SceneId room = design.ids.next<SceneId>();
  applied(design.world, CreateScene{room, "the room"});
  applied(design.world, EnterScene{room, nameless, 0});
  applied(design.world, EnterScene{room, lamp, 1});
  const std::string text = body(design.world);
  EXPECT_TRUE(
      contains(text, "    SpotLight {\n      on FALSE\n      color 0.1 0.2 0.3\n      intensity 0.4\n"));
  EXPECT_TRUE(contains(text,
                       "    Viewpoint {\n      position 0 0 0\n      fieldOfView 1.2\n"
                       "      description \"from the door\"\n"));
  EXPECT_TRUE(contains(text, "DEF IcomeUnnamed Transform {\n  children [\n    Shape {"));
  EXPECT_TRUE(text.ends_with(
      "IcomeScene {\n  name \"the room\"\n  objects [\n    \"IcomeUnnamed\"\n    \"lamp\"\n  ]\n}\n"));
}

TEST(VrmlWriter, ScriptsStandAsTheyStoodAndKeepTheirNames) {
  DesignMaker design;
  const auto script = [&](const std::string& name, const std::string& source, ObjectId parent = {}) {
    const ObjectId id = design.add(name, nullptr, parent);
    applied(design.world, ChangeFixture{id, std::make_shared<const Fixture>(Inert{"Script", source})});
    return id;
  };
  const std::string source = "DEF logic Script {\n  url \"javascript: a = { '}' }\"\n}";
  design.add("logic", nullptr);
  script("logic", source);
  EXPECT_EQ(body(design.world),
            "DEF logic_2 Transform {\n  children [\n    WorldInfo {\n      title \"logic\"\n"
            "    }\n  ]\n}\n" +
                source + "\n");
  const ObjectId door = script("door", "Script { }");
  script("", "Script {", door);
  script("", "DEF a Script { } DEF b Script { }");
  script("", "Script { field SFNode x USE door }");
  script("", "Sound { }");
  const ScratchFolder folder;
  const Written all = write_out(design.world, folder);
  EXPECT_TRUE(
      contains(all.text, "DEF door Transform {\n  children [\n    Script { }\n    Transform { }\n  ]\n}\n"));
  EXPECT_TRUE(all.text.ends_with("]\n}\nTransform { }\nTransform { }\nTransform { }\n"));
  EXPECT_EQ(all.remarks,
            (std::vector<std::string>{
                "4 nodes that are no whole VRML scripts are left out.",
                "1 scripts will be objects of their own, not parts of the objects that they are in now."}));
}

TEST(VrmlWriter, TellsWhatIsLeftOut) {
  DesignMaker design;
  applied(design.world, CreateGeometry{design.ids.next<GeometryId>(), box(1.0)});
  applied(design.world, CreateMaterial{design.ids.next<MaterialId>(), {}});
  geometry::TriangleMesh large = tetrahedron();
  large.positions[1].x() = 1e300;
  design.add("large", std::make_shared<MeshGeometry>(large));
  const ScratchFolder folder;
  const Written all = write_out(design.world, folder);
  EXPECT_EQ(all.remarks,
            (std::vector<std::string>{
                "1 shapes that no object has are left out.", "1 materials that no object has are left out.",
                "Numbers beyond 3.4e38, the largest that VRML 2.0 can hold, became that."}));
}

TEST(VrmlWriter, ReplacesTheFileWhenAllIsWrittenOrNotAtAll) {
  const ScratchFolder folder;
  folder.write("design.wrl", "before");
  EXPECT_TRUE(write_out(World(), folder).text.starts_with("#VRML"));
  EXPECT_FALSE(write_vrml(folder.path() / "nowhere" / "design.wrl", World()));
}

TEST(VrmlWriter, DeepAndRandomWorldsAreWrittenTheSameEachTime) {
  DesignMaker chain;
  ObjectId parent;
  for (int i = 0; i < 900; ++i) parent = chain.add("link", nullptr, parent);
  EXPECT_EQ(count(body(chain.world), "Transform {"), 900U);
  const ScratchFolder folder;
  for (int i = 0; i < 200; ++i) parent = chain.add("link", nullptr, parent);
  const auto refused = write_vrml(folder.path() / "design.wrl", chain.world);
  ASSERT_FALSE(refused);
  EXPECT_TRUE(
      contains(refused.error().message, "design.wrl: Objects lie more than 995 deep within each other"));
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    RandomEdits edits(seed);
    World world;
    for (int i = 0; i < 200; ++i) (void)apply(world, edits.next(world));
    const std::string text = write_out(world, folder).text;
    EXPECT_EQ(count(text, "Transform {"), world.objects().size());
    EXPECT_EQ(count(text, "{"), count(text, "}"));
    EXPECT_EQ(write_out(world, folder).text, text);
  }
}

}  // namespace
}  // namespace icome::files
