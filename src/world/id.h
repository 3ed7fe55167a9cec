#pragma once
#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>

namespace icome::world {

/// Names a thing of a world for good: an id is never given away twice, so one whose thing is gone names
/// nothing. Made by an IdSource; zero names nothing.
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

/// Gives ids away for one author (one per person who works on a design, also offline): authors need not
/// ask each other. One counter serves all kinds. What it gives when all numbers are spent, no world takes.
class IdSource {
 public:
  static constexpr int kNumberBits = 40;
  static constexpr std::uint64_t kNumberMask = (std::uint64_t{1} << kNumberBits) - 1;
  /// There is always a next number, which is no good when all of an author's are spent.
  static constexpr std::uint64_t kLastNumber = kNumberMask - 1;

  /// `first` is the first number to give; World::next_number knows it for a design that exists.
  explicit IdSource(std::uint32_t author = 0, std::uint64_t first = 1) : author_(author), next_(first) {}

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
