#pragma once
#include <cstdlib>
#include <filesystem>
#include <string>
#include <utility>

#include "base/clock.h"
#include "base/result.h"
#include "world/edit/edit.h"

namespace icome::benchmarks {

/// A world in which every object is a root, so that the list of siblings is longest.
world::World flat_world(std::size_t objects);
/// A world of groups of 100 objects with names and places, and of 100 shapes and 10 materials. With
/// `own_shapes`, each object has a shape of its own.
world::World grouped_world(std::size_t objects, bool own_shapes);

/// A mesh over a grid, with two triangles in each square.
world::GeometryPointer grid_mesh(std::size_t squares_along_side, double height);

/// The value of a result that cannot fail, unless the benchmark is wrong.
template <typename Value>
Value must(base::Result<Value> result) {
  if (!result) std::abort();
  if constexpr (!std::is_void_v<Value>) return std::move(*result);
}

/// The time that `work` takes, ns.
template <typename Work>
std::int32_t timed(Work&& work) {
  const std::int64_t begin = base::steady_nanoseconds();
  work();
  return std::int32_t(base::steady_nanoseconds() - begin);
}

/// A folder for files, removed with the object.
class WorkFolder {
 public:
  WorkFolder();
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;
  ~WorkFolder() { std::filesystem::remove_all(path_); }
  std::filesystem::path operator/(const char* name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

}  // namespace icome::benchmarks
