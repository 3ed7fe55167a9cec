#include "world/sharing.h"

#include <fmt/format.h>

#include <algorithm>

namespace icome::world {
namespace {

struct Words {
  const char* one;   // "object uses"
  const char* many;  // "objects use"
  const char* what;  // "this shape"
};

template <typename AnyId>
std::string in_words(const World& world, AnyId id, const Words& words) {
  const auto* shared = world.find(id);
  const std::uint32_t users = shared ? shared->users : 0;
  if (users == 0) return fmt::format("no {} {}", words.one, words.what);
  return fmt::format("{} {} {}", users, users == 1 ? words.one : words.many, words.what);
}

template <typename AnyId>
std::vector<ObjectId> users_of(const World& world, AnyId id, AnyId PhysicalObject::*member) {
  std::vector<ObjectId> result;
  if (!id) return result;
  for (const auto& [object, it] : world.objects()) {
    if (it.*member == id) result.push_back(object);
  }
  std::sort(result.begin(), result.end());
  return result;
}

}  // namespace

std::string sharing(const World& world, GeometryId shape) {
  return in_words(world, shape, {"object uses", "objects use", "this shape"});
}

std::string sharing(const World& world, MaterialId material) {
  return in_words(world, material, {"object has", "objects have", "this material"});
}

std::string sharing(const World& world, TextureId texture) {
  return in_words(world, texture, {"material shows", "materials show", "this texture"});
}

std::vector<ObjectId> users(const World& world, GeometryId shape) {
  return users_of(world, shape, &PhysicalObject::geometry);
}

std::vector<ObjectId> users(const World& world, MaterialId material) {
  return users_of(world, material, &PhysicalObject::material);
}

}  // namespace icome::world
