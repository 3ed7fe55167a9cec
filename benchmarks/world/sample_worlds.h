#pragma once
#include <cstdlib>
#include <filesystem>
#include <string>
#include <utility>

#include "base/clock.h"
#include "base/result.h"
#include "world/edit/edit.h"

namespace icome::benchmarks {

/// Every object a root: where rows of siblings are longest.
world::World flat_world(std::size_t objects);
/// Groups of 100 objects with names and places, of 100 shapes and 10 materials. `own_shapes`: each object
/// has one of its own.
world::World grouped_world(std::size_t objects, bool own_shapes);

/// Two triangles in each square of a grid.
world::GeometryPointer grid_mesh(std::size_t squares_along_side, double height);

/// What cannot fail, unless the benchmark is wrong.
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
