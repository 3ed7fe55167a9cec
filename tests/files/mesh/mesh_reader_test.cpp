#include "files/mesh/mesh_reader.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>
#include <tuple>

#include "files/packed_xz.h"
#include "files/sample_files.h"
#include "geometry/mesh/triangle_mesh.h"

namespace icome::files {
namespace {

/// What read_mesh() says after the folder's name.
std::string error_of(const ScratchFolder& folder, const std::filesystem::path& file,
                     const ReadOptions& options = {}) {
  const auto loaded = read_mesh(file, options);
  if (loaded) return "it was read";
  const std::string prefix = folder.path().string() + "/";
  EXPECT_TRUE(loaded.error().message.starts_with(prefix)) << loaded.error().message;
  return loaded.error().message.substr(prefix.size());
}

std::string error_of_bytes(const std::string& name, std::string_view bytes) {
  const ScratchFolder folder;
  return error_of(folder, folder.write(name, bytes));
}

class EveryFormat : public testing::TestWithParam<std::tuple<const char*, std::string, const char*>> {};

TEST_P(EveryFormat, GivesAClosedTetrahedronPackedOrNot) {
  const auto& [name, bytes, format] = GetParam();
  const ScratchFolder folder;
  for (const bool pack : {false, true}) {
    const auto loaded =
        read_mesh(folder.write(name + std::string(pack ? ".XZ" : ""), pack ? packed_xz(bytes) : bytes));
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded->format, format + std::string(pack ? ", xz" : ""));
    EXPECT_EQ(loaded->mesh.positions.size(), 4U);
    EXPECT_EQ(loaded->mesh.triangles.size(), 4U);
    EXPECT_TRUE(loaded->repair.surface.closed);
    EXPECT_EQ(loaded->repair.rewound_faces + loaded->repair.turned_parts, 0U);
    const double scale = format == std::string("GLB") ? 8.0 : 1.0;  // its node doubles
    EXPECT_NEAR(geometry::signed_volume(loaded->mesh), scale / 6.0, 1e-6);
  }
}

INSTANTIATE_TEST_SUITE_P(MeshReader, EveryFormat,
                         testing::Values(std::tuple{"a.obj", sample_obj(), "OBJ"},
                                         std::tuple{"a.OFF", sample_off(), "OFF"},
                                         std::tuple{"a.ply", sample_ascii_ply(), "ascii PLY"},
                                         std::tuple{"little.ply", sample_binary_ply(false), "binary PLY"},
                                         std::tuple{"big.Ply", sample_binary_ply(true), "binary PLY"},
                                         std::tuple{"a.stl", sample_ascii_stl(), "ascii STL"},
                                         std::tuple{"a.STL", sample_binary_stl(), "binary STL"},
                                         std::tuple{"a.glb", sample_glb(), "GLB"}));

TEST(MeshReader, UnitAndFitScaleTheModel) {
  const ScratchFolder folder;
  const auto file =
      folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  const auto centimetres = read_mesh(file, {.unit = 0.01});
  ASSERT_TRUE(centimetres);
  const geometry::Bounds box = geometry::bounds(centimetres->mesh);
  EXPECT_NEAR((box.min() - geometry::Vector3(0, 0, 0)).norm(), 0.0, 1e-15);
  EXPECT_NEAR((box.max() - geometry::Vector3(0.01, 0.02, 0.03)).norm(), 0.0, 1e-15);
  EXPECT_GT(geometry::signed_volume(centimetres->mesh), 0.0);
  const auto fitted = read_mesh(file, {.fit = 0.1});
  ASSERT_TRUE(fitted);
  EXPECT_NEAR(geometry::bounds(fitted->mesh).sizes().maxCoeff(), 0.1, 1e-15);
}

TEST(MeshReader, UnitsHaveNames) {
  EXPECT_EQ(*parse_unit("mm"), 0.001);
  EXPECT_EQ(*parse_unit("in"), 0.0254);
  EXPECT_EQ(parse_unit("miles").error().message,
            "'miles' is not a unit of length; these are: m, dm, cm, mm, um, in");
}

TEST(MeshReader, SettingsThatMakeNoSenseAreRefused) {
  EXPECT_FALSE(read_mesh("a.obj", {.unit = 0.0}));
  EXPECT_FALSE(read_mesh("a.obj", {.unit = std::nan("")}));
  EXPECT_FALSE(read_mesh("a.obj", {.fit = -1.0}));
}

TEST(MeshReader, FilesThatAreNoFilesAreRefused) {
  const ScratchFolder folder;
  EXPECT_EQ(error_of(folder, folder.path() / "none.obj"),
            "none.obj: cannot be read: No such file or directory");
  std::filesystem::create_directory(folder.path() / "folder.obj");
  EXPECT_EQ(error_of(folder, folder.path() / "folder.obj"), "folder.obj: is a folder, not a file");
  ASSERT_EQ(mkfifo((folder.path() / "pipe.obj").c_str(), 0600), 0);
  EXPECT_EQ(error_of(folder, folder.path() / "pipe.obj"), "pipe.obj: is not a regular file");
  EXPECT_EQ(error_of(folder, folder.write("empty.ply", "")), "empty.ply: the file is empty");
  EXPECT_EQ(error_of(folder, folder.write("a.fbx", "x")),
            "a.fbx: is not of a known type; .obj, .ply, .stl, .off and .glb are, also with .xz after");
}

TEST(MeshReader, ContentThatIsNotWhatTheNameSaysIsRefused) {
  EXPECT_EQ(error_of_bytes("a.ply", sample_obj()),
            "a.ply: does not begin with 'ply', so it is not a PLY file");
  EXPECT_EQ(error_of_bytes("a.glb", sample_obj()),
            "a.glb: does not begin with 'glTF', so it is not a GLB file");
  EXPECT_EQ(error_of_bytes("a.off", sample_obj()),
            "a.off:2: does not begin with OFF, so it is not an OFF file");
  EXPECT_EQ(error_of_bytes("a.obj", sample_glb()), "a.obj: holds binary data, so it is not an OBJ file");
  EXPECT_EQ(error_of_bytes("a.obj", sample_off()),
            "a.obj: has no vertices ('v' lines), so it is not an OBJ model");
  EXPECT_EQ(error_of_bytes("a.stl", sample_obj()), "a.stl:1: '#' where 'solid' is expected");
  EXPECT_EQ(error_of_bytes("a.obj.xz", sample_obj()), "a.obj.xz: is not xz data");
}

TEST(MeshReader, PackedFilesThatAreDamagedOrTooLargeAreRefused) {
  const ScratchFolder folder;
  std::string bytes = packed_xz(sample_obj());
  EXPECT_EQ(error_of(folder, folder.write("a.obj.xz", bytes.substr(0, bytes.size() / 2))),
            "a.obj.xz: the xz data is cut short");
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] + 1);
  EXPECT_EQ(error_of(folder, folder.write("a.obj.xz", bytes)), "a.obj.xz: the xz data is damaged");
  const auto bomb = folder.write("bomb.obj.xz", packed_xz(std::string(8'000'000, ' ')));
  EXPECT_LT(std::filesystem::file_size(bomb), 10'000U);
  EXPECT_EQ(error_of(folder, bomb, {.size_limit = 1U << 22U}),
            "bomb.obj.xz: unpacks to more than the limit of 4 MiB");
  const auto large = folder.write("large.obj", std::string(1000, ' '));
  EXPECT_EQ(error_of(folder, large, {.size_limit = 512}),
            "large.obj: is larger than the limit of 0.000488281 MiB");
}

TEST(MeshReader, CoordinatesBeyondReasonAreRefused) {
  EXPECT_EQ(error_of_bytes("a.obj", "v 0 0 0\nv 1 0 0\nv 0 2e30 0\nf 1 2 3\n"),
            "a.obj: has coordinates of 2e+30 m, beyond 1e+15 m: check the file and its unit");
  EXPECT_EQ(error_of_bytes("a.obj", "v 0 0 0\nv 1e999 0 0\n"), "a.obj:2: '1e999' is out of range");
}

TEST(MeshReader, NothingToTouchIsRefusedWithTheReason) {
  EXPECT_EQ(error_of_bytes("a.obj", "v 0 0 0\n"), "a.obj: has no triangles");
  EXPECT_EQ(error_of_bytes("a.obj", "v 0 0 0\nv 1 0 0\nf 1 2\n"),
            "a.obj: has no triangles: 1 face with fewer than three corners left out");
  EXPECT_EQ(error_of_bytes("a.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n"),
            "a.obj: has no triangle that can be touched: 1 vertex with NaN or infinite coordinates removed, "
            "1 face using them dropped, 2 unused vertices removed");
}

TEST(MeshReader, SentencesTellWhatWasLeftOutAndRepaired) {
  const ScratchFolder folder;
  const auto loaded =
      read_mesh(folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 1 0\nf 1 2 3\nf 1 2\nf 1 3 4\n"));
  ASSERT_TRUE(loaded);
  EXPECT_EQ(
      loaded->sentences(),
      (std::vector<std::string>{"1 face with fewer than three corners left out", "1 duplicate vertex welded",
                                "1 degenerate face dropped", "the surface is open: 3 boundary edges"}));
}

}  // namespace
}  // namespace icome::files
