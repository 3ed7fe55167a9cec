#pragma once
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <thread>
#include <utility>

#include "session/session.h"
#include "world/shape/geometry.h"

namespace icome::benchmarks {

/// The value of a result that cannot fail, unless the benchmark is wrong.
template <typename Value>
Value must(base::Result<Value> result) {
  if (!result) {
    std::fprintf(stderr, "%s\n", result.error().message.c_str());
    std::abort();
  }
  if constexpr (!std::is_void_v<Value>) return std::move(*result);
}

inline std::unique_ptr<session::Session> start_session() {
  return must(session::Session::create(session::SessionSettings{}));
}

/// Runs the main loop until the condition holds; false after a minute.
template <typename Condition>
bool turn_until(session::Session& session, const Condition& condition) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (std::chrono::steady_clock::now() < end) {
    session.update();
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::microseconds(100));
  }
  return false;
}

/// The ids of an object that was added, and of its shape and material.
struct Added {
  world::ObjectId object;
  world::GeometryId geometry;
  world::MaterialId material;
};

/// Adds an object with this shape and a material of its own.
Added add_shape(session::Session& session, world::GeometryPointer shape, const base::Affine3& place);
world::GeometryPointer thick_plate();  // 0.4 m, its top at y = 0
/// A bumpy plate of 0.4 m about y = 0, with 2 * squares * squares triangles.
world::GeometryPointer large_plate(int squares);
base::Affine3 lowered(double metres);

}  // namespace icome::benchmarks
