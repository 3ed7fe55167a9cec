#pragma once
#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>

namespace icome::world {

/// The permanent name of a thing in a world: an id is never given twice, so the id of a deleted thing
/// names nothing. Made by an IdSource; zero names nothing.
template <typename Named>
struct Id {
  std::uint64_t value = 0;

  explicit operator bool() const { return value != 0; }
  auto operator<=>(const Id&) const = default;
};

struct PhysicalObject;
struct GeometryObject;
struct Material;
struct Texture;
struct Scene;

using ObjectId = Id<PhysicalObject>;
using GeometryId = Id<GeometryObject>;
using MaterialId = Id<Material>;
using TextureId = Id<Texture>;
using SceneId = Id<Scene>;

/// Gives ids to one author (one per person who works on a design, also offline): authors need not ask each
/// other. One counter serves all kinds. Ids given after all numbers are spent are refused by worlds.
class IdSource {
 public:
  static constexpr int kNumberBits = 40;
  static constexpr std::uint64_t kNumberMask = (std::uint64_t{1} << kNumberBits) - 1;
  /// The last valid number. The next one is always given when an author's are spent; it is refused.
  static constexpr std::uint64_t kLastNumber = kNumberMask - 1;

  /// `first` is the first number to give; World::next_number knows it for an existing design.
  explicit IdSource(std::uint32_t author = 0, std::uint64_t first = 1) : author_(author), next_(first) {}
  std::uint32_t author() const { return author_; }

  template <typename AnyId>
  AnyId next() {
    const std::uint64_t number = next_ <= kLastNumber ? next_++ : kNumberMask;
    return AnyId{(std::uint64_t{author_} << kNumberBits) | number};
  }

 private:
  std::uint32_t author_;  // below 2^24
  std::uint64_t next_;
};

}  // namespace icome::world

template <typename Named>
struct std::hash<icome::world::Id<Named>> {
  std::size_t operator()(const icome::world::Id<Named>& id) const noexcept {
    return std::size_t((id.value ^ (id.value >> 32)) * 0x9e3779b97f4a7c15ULL);
  }
};
