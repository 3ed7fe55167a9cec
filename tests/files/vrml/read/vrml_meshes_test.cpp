// Meshes that VRML designs name by IcomeMesh.
#include "files/vrml/read/vrml_meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "files/design_files.h"
#include "files/sample_files.h"
#include "files/vrml/read/vrml_reader.h"
#include "files/vrml/vrml_protos.h"
#include "files/vrml/write/vrml_writer.h"

namespace icome::files {
namespace {

namespace fs = std::filesystem;

const std::string kObjTriangle = "v 0 0 0\nv 2 0 0\nv 0 3 0\nf 1 2 3\n";
const std::string kOffTriangle = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

std::string mesh_proto() {
  return std::string("#VRML V2.0 utf8\nPROTO ") + kMeshProto.name + " [\n" + kMeshProto.fields +
         kTriangles.fields + "] {\n" + kTriangles.body + "}\n";
}

/// One object called "thing" whose shape has these fields.
std::string design_with(const std::string& fields) {
  return mesh_proto() +
         "DEF thing Transform { scale 0.5 0.5 0.5 children Shape { appearance Appearance { material DEF clay "
         "Material { diffuseColor 1 0 0 } } geometry DEF scan IcomeMesh { " +
         fields + " } } }\n";
}

LoadedDesign read_whole(const fs::path& path, const DesignReadOptions& options = {}) {
  auto design = read_design(path, options);
  EXPECT_TRUE(design.has_value()) << (design ? "" : design.error().message);
  return design ? std::move(*design) : LoadedDesign{};
}

const world::MeshGeometry* mesh_in(const LoadedDesign& design, std::size_t place = 0) {
  const world::PhysicalObject& object = *design.world.find(design.world.roots().at(place));
  if (!object.geometry) return nullptr;
  return dynamic_cast<const world::MeshGeometry*>(design.world.find(object.geometry)->shape.get());
}

std::string remarks_in(const LoadedDesign& design) {
  std::string all;
  for (const Remark& remark : design.remarks) all += remark.text + "\n";
  return all;
}

TEST(VrmlMeshes, AreShapesWithMaterialAndPlace) {
  const ScratchFolder folder;
  folder.write("scan.obj", kObjTriangle);
  const LoadedDesign design = read_whole(folder.write("a.wrl", design_with("url \"scan.obj\" unit 0.01")));
  EXPECT_EQ(remarks_in(design), "");
  const world::MeshGeometry* const mesh = mesh_in(design);
  ASSERT_NE(mesh, nullptr);
  EXPECT_EQ(mesh->bounds().max(), base::Vector3(0.02, 0.03, 0.0));
  const world::PhysicalObject& thing = *design.world.find(design.world.roots()[0]);
  EXPECT_EQ(thing.name, "thing");
  EXPECT_EQ(thing.parent_from_object.linear()(0, 0), 0.5);
  EXPECT_EQ(design.world.find(thing.material)->name, "clay");
}

TEST(VrmlMeshes, ComeFromTheFirstUrlThatIsThere) {
  const ScratchFolder folder;
  folder.write("flat.OFF", kOffTriangle);
  folder.write("bad.obj", "v 1\n");
  const LoadedDesign design =
      read_whole(folder.write("a.wrl", design_with("url [ \"gone.obj\" \"bad.obj\" \"flat.OFF\" ]")));
  EXPECT_EQ(remarks_in(design), "");
  ASSERT_NE(mesh_in(design), nullptr);
  EXPECT_EQ(mesh_in(design)->bounds().max(), base::Vector3(1.0, 1.0, 0.0));
}

TEST(VrmlMeshes, OfOneFileShareTheirTriangles) {
  const ScratchFolder folder;
  folder.write("scan.obj", kObjTriangle);
  const std::string shape = "Shape { geometry IcomeMesh { url \"scan.obj\" } }\n";
  const std::string other = "Shape { geometry IcomeMesh { url \"./scan.obj\" unit 2 } }\n";
  const LoadedDesign design = read_whole(folder.write("a.wrl", mesh_proto() + shape + shape + other));
  ASSERT_EQ(design.world.roots().size(), 3U);
  EXPECT_EQ(mesh_in(design, 0), mesh_in(design, 1));
  EXPECT_EQ(mesh_in(design, 2)->bounds().max(), base::Vector3(4.0, 6.0, 0.0));
}

TEST(VrmlMeshes, CountFromTheFileThatNamesThem) {
  const ScratchFolder folder;
  fs::create_directories(folder.path() / "parts");
  folder.write("parts/scan.obj", kObjTriangle);
  folder.write("parts/part.wrl", design_with("url \"scan.obj\""));
  const LoadedDesign inlined =
      read_whole(folder.write("a.wrl", "#VRML V2.0 utf8\nInline { url \"parts/part.wrl\" }\n"));
  EXPECT_EQ(inlined.world.geometries().size(), 1U);
  // A PROTO that lies elsewhere does not change where the url stands.
  folder.write("parts/proto.wrl", mesh_proto());
  folder.write("own.obj", kObjTriangle);
  const LoadedDesign design = read_whole(folder.write(
      "b.wrl", std::string("#VRML V2.0 utf8\nEXTERNPROTO IcomeMesh [ field MFString url field SFFloat unit "
                           "] \"parts/proto.wrl\"\n") +
                   "Shape { appearance Appearance { material Material {} } geometry IcomeMesh { url "
                   "\"own.obj\" } }\n"));
  EXPECT_EQ(remarks_in(design), "");
  EXPECT_NE(mesh_in(design), nullptr);
}

TEST(VrmlMeshes, AreSavedAsTheirTriangles) {
  const ScratchFolder folder;
  folder.write("scan.obj", kObjTriangle);
  const LoadedDesign design = read_whole(folder.write("a.wrl", design_with("url \"scan.obj\" unit 0.01")));
  const fs::path saved = folder.path() / "saved.wrl";
  ASSERT_TRUE(write_vrml(saved, design.world).has_value());
  fs::remove(folder.path() / "scan.obj");
  const LoadedDesign again = read_whole(saved);
  EXPECT_EQ(remarks_in(again), "");
  ASSERT_NE(mesh_in(again), nullptr);
  EXPECT_EQ(mesh_in(again)->mesh.positions, mesh_in(design)->mesh.positions);
  EXPECT_EQ(mesh_in(again)->mesh.triangles, mesh_in(design)->mesh.triangles);
}

TEST(VrmlMeshes, ThatAreNotThereLeaveTheRest) {
  const ScratchFolder folder;
  const LoadedDesign design = read_whole(folder.write(
      "a.wrl", design_with("url \"/usr/share/icome-not-there/scan.obj\" package \"icome-scans\"") +
                   "Shape { appearance Appearance { material Material {} } geometry Sphere {} }\n"));
  EXPECT_EQ(
      remarks_in(design),
      "The mesh \"scan\" is left out: '/usr/share/icome-not-there/scan.obj' is not fetched: there is no "
      "such file; it comes with the Debian package icome-scans, as the design says.\n");
  EXPECT_EQ(design.world.roots().size(), 2U);
  EXPECT_EQ(design.world.geometries().size(), 1U);
}

TEST(VrmlMeshes, SayWhatIsWrong) {
  const ScratchFolder folder;
  folder.write("none.obj", "v 0 0 0\n");
  folder.write("word.obj", "v 0 0 zero\n");
  folder.write("table.csv", "1,2,3\n");
  const auto remark_on = [&](const std::string& fields) {
    return remarks_in(read_whole(folder.write("a.wrl", design_with(fields))));
  };
  const auto has = [](const std::string& text, const char* part) {
    return text.find(part) != std::string::npos && text.find("Debian") == std::string::npos;
  };
  EXPECT_TRUE(has(remark_on("url \"none.obj\""), "has no triangles"));
  EXPECT_TRUE(has(remark_on("url \"word.obj\""), "zero")) << remark_on("url \"word.obj\"");
  EXPECT_TRUE(has(remark_on("url \"table.csv\""), "not of a known type"));
  EXPECT_TRUE(has(remark_on("url \"http://example.org/a.obj\""), "only files that came with the design"));
  EXPECT_TRUE(has(remark_on("url \"none.obj\" unit 0"), "its unit is not from 1e-09 to 1e+06 metres"));
  EXPECT_TRUE(has(remark_on("url \"none.obj\" unit -1"), "unit"));
  EXPECT_TRUE(has(remark_on("url \"none.obj\" unit 1e38"), "unit"));
  EXPECT_TRUE(has(remark_on("url \"gone.obj\" package \"rm -rf; evil\""), "no such file"));
  EXPECT_TRUE(has(remark_on("url []"), ""));
}

TEST(VrmlMeshes, RepeatNothingOfOtherPeoplesFiles) {
  const ScratchFolder folder;
  fs::create_directories(folder.path() / "design");
  folder.write("secret.obj", "v my secret word\n");
  folder.write("secret", "root:x:0:0:");
  fs::create_symlink("../secret", folder.path() / "design/link.obj");
  for (const char* url : {"../secret.obj", "link.obj", "../secret", "/etc/passwd", "file:///etc/hostname",
                          "../../../../../../../../etc/passwd"}) {
    const LoadedDesign design =
        read_whole(folder.write("design/a.wrl", design_with("url \"" + std::string(url) + "\"")));
    EXPECT_EQ(mesh_in(design), nullptr);
    const std::string told = remarks_in(design);
    EXPECT_NE(told.find("is left out"), std::string::npos) << url;
    EXPECT_EQ(told.find("word"), std::string::npos) << told;
    EXPECT_EQ(told.find("root:"), std::string::npos) << told;
  }
}

TEST(VrmlMeshes, KeepWithinTheLimit) {
  const ScratchFolder folder;
  std::string large;
  for (int i = 0; i < 2000; ++i) large += kObjTriangle;
  folder.write("large.obj", large);
  const LoadedDesign design =
      read_whole(folder.write("a.wrl", design_with("url \"large.obj\"")), {.size_limit = 20'000});
  EXPECT_EQ(mesh_in(design), nullptr);
  EXPECT_NE(remarks_in(design).find("larger than the limit"), std::string::npos) << remarks_in(design);
  // What files take together counts too, also when they are one that is scaled.
  std::string scaled = mesh_proto();
  for (int i = 1; i <= 50; ++i)
    scaled += "Shape { geometry IcomeMesh { url \"large.obj\" unit " + std::to_string(i) + " } }\n";
  const LoadedDesign many = read_whole(folder.write("b.wrl", scaled), {.size_limit = 1'000'000});
  EXPECT_LT(many.world.geometries().size(), 10U);
  EXPECT_GE(many.world.geometries().size(), 1U);
  EXPECT_NE(remarks_in(many).find("too large together"), std::string::npos) << remarks_in(many);
}

TEST(VrmlMeshes, TryOnlySoManyUrlsAndFiles) {
  int asked = 0;
  const FindMesh nowhere = [&](const std::string&, const std::string& url) -> base::Result<FoundMesh> {
    ++asked;
    return base::fail("there is no " + url);
  };
  Findings findings;
  io::TimeBudget time_budget;
  io::MemoryBudget memory;
  VrmlMeshes meshes(nowhere, 1000, findings, time_budget, memory);
  VrmlMeshNode node;
  node.urls.assign(100'000, "u");
  EXPECT_EQ(meshes.shape_of(node), nullptr);
  EXPECT_EQ(asked, 20);
  node.unit = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(meshes.shape_of(node), nullptr);
  EXPECT_EQ(asked, 20);
}

TEST(VrmlMeshes, ReadTheInstalledBunny) {
  const fs::path bunny = "/usr/share/glmark2/models/bunny.obj";
  if (!fs::exists(bunny)) GTEST_SKIP() << "the package glmark2-data is not installed";
  const ScratchFolder folder;
  for (const char* url :
       {"/usr/share/glmark2/models/bunny.obj", "file:///usr/share/glmark2/models/bunny.obj"}) {
    const LoadedDesign design =
        read_whole(folder.write("a.wrl", design_with("url \"" + std::string(url) + "\" unit 0.1")));
    ASSERT_NE(mesh_in(design), nullptr) << remarks_in(design);
    EXPECT_EQ(mesh_in(design)->mesh.triangles.size(), 69'666U) << url;
  }
}

}  // namespace
}  // namespace icome::files
