#include "files/mesh/stl_writer.h"

#include <gtest/gtest.h>

#include "files/mesh/mesh_reader.h"
#include "files/sample_files.h"
#include "geometry/primitive/primitive.h"
#include "io/file_bytes.h"

namespace icome::files {
namespace {

using geometry::TriangleMesh;

base::Result<void> written(const TriangleMesh& mesh, double unit, const std::filesystem::path& path) {
  auto file = io::NewFile::create(path);
  if (!file) return tl::unexpected(file.error());
  if (auto stl = write_stl(mesh, unit, *file); !stl) return stl;
  return file->finish();
}

std::size_t files_in(const ScratchFolder& folder) {
  std::size_t count = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder.path())) ++count;
  return count;
}

TEST(StlWriter, MeshesComeBack) {
  const ScratchFolder folder;
  const TriangleMesh mesh = geometry::tessellate(geometry::Torus{0.05, 0.02}, 1e-4);
  const auto path = folder.path() / "torus.stl";
  for (const double unit : {0.001, 1.0}) {
    ASSERT_TRUE(written(mesh, unit, path));
    const auto loaded = read_mesh(path, {.unit = unit});
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded->format, "binary STL");
    EXPECT_TRUE(loaded->repair.surface.closed);
    EXPECT_EQ(loaded->mesh.positions.size(), mesh.positions.size());
    ASSERT_EQ(loaded->mesh.triangles.size(), mesh.triangles.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for (int i = 0; i < 3; ++i) EXPECT_LT((loaded->mesh.corner(t, i) - mesh.corner(t, i)).norm(), 1e-8);
  }
  EXPECT_EQ(files_in(folder), 1U);
}

TEST(StlWriter, WhatWasReadIsWrittenTheSame) {
  const ScratchFolder folder;
  const auto once = folder.path() / "once.stl", twice = folder.path() / "twice.stl";
  ASSERT_TRUE(written(geometry::tessellate(geometry::Torus{0.05, 0.02}, 1e-5), 1.0, once));
  const auto loaded = read_mesh(once);
  ASSERT_TRUE(loaded) << loaded.error().message;
  ASSERT_TRUE(written(loaded->mesh, 1.0, twice));
  EXPECT_TRUE(*io::read_bytes(once, 1U << 30U) == *io::read_bytes(twice, 1U << 30U));
}

TEST(StlWriter, TheBytesAreThoseOfTheFormat) {
  const ScratchFolder folder;
  const TriangleMesh mesh{{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}}, {{0, 1, 2}}};
  ASSERT_TRUE(written(mesh, 2.0, folder.path() / "a.stl"));
  const std::string bytes = *io::read_bytes(folder.path() / "a.stl", 1000);
  ASSERT_EQ(bytes.size(), 80U + 4 + 50);
  EXPECT_FALSE(bytes.starts_with("solid"));
  std::string expected = bytes_of(std::uint32_t{1});
  for (const float number : {0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 0.0F, 1.0F, 0.0F})
    expected += bytes_of(number);
  EXPECT_EQ(bytes.substr(80), expected + std::string(2, '\0'));
}

TEST(StlWriter, WhatCannotBeHeldIsRefusedAndNothingIsLeft) {
  const ScratchFolder folder;
  const TriangleMesh huge{{{0, 0, 0}, {1e39, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  const auto old = folder.write("old.stl", "of another day");
  EXPECT_EQ(written(huge, 1.0, old).error().message,
            old.string() + ": the mesh is too large for an STL file's single precision");
  EXPECT_EQ(*io::read_bytes(old, 100), "of another day");
  EXPECT_EQ(files_in(folder), 1U);
}

TEST(NewFile, ImpossiblePathsAreToldAtOnce) {
  const ScratchFolder folder;
  EXPECT_EQ(io::NewFile::create(folder.path() / "no" / "a.stl").error().message,
            (folder.path() / "no" / "a.stl").string() + ": cannot be written (No such file or directory).");
  EXPECT_EQ(io::NewFile::create(folder.path()).error().message,
            folder.path().string() + ": cannot be written (not an ordinary file).");
  EXPECT_EQ(io::NewFile::create("/dev/null").error().message,
            "/dev/null: cannot be written (not an ordinary file).");
}

}  // namespace
}  // namespace icome::files
