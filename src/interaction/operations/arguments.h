#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "base/vector.h"
#include "interaction/operations/parameter.h"
#include "world/world.h"

namespace icome::interaction {

using base::Vector2;
using base::Vector3;

/// Reads the file of a picture: its name, its kind and its bytes. Fails with a sentence that names the
/// file. Without a function no files are read.
using PictureReader = std::function<base::Result<world::Texture>(const std::string& file)>;

/// The values given to an operation, checked against its parameters: the required ones are there, and each
/// is of its kind and in range. Refers to the parameters, the fields and the world.
class Arguments {
 public:
  /// Fails with a sentence that names the parameter: one that is unknown (with a suggestion), missing, of
  /// another kind, out of range, or that names an object that does not exist or shares its name.
  static base::Result<Arguments> check(const std::vector<Parameter>& parameters, const Value::Fields& fields,
                                       const world::World& world, PictureReader pictures = {});

  /// Has a value been given, or is there a fallback?
  bool has(std::string_view name) const { return find(name) != nullptr; }

  // Precondition of all: there is such a parameter of that kind, and has(name).
  bool flag(std::string_view name) const;
  double number(std::string_view name) const;
  std::int64_t count(std::string_view name) const;
  const std::string& text(std::string_view name) const;  // of a Choice too
  std::vector<std::string> texts(std::string_view name) const;
  world::Colour colour(std::string_view name) const;
  Vector3 vector(std::string_view name) const;
  std::vector<double> numbers(std::string_view name) const;
  std::vector<std::uint32_t> counts(std::string_view name) const;  // `least` must be 0 or more
  std::vector<Vector2> points2(std::string_view name) const;
  std::vector<Vector3> points3(std::string_view name) const;
  world::ObjectId object(std::string_view name) const;
  std::vector<world::ObjectId> objects(std::string_view name) const;
  std::vector<Arguments> records(std::string_view name) const;
  /// Reads its file. Fails as the reader does.
  base::Result<world::Texture> picture(std::string_view name) const;

  /// All values that have been given, for recipes (MeshGeometry::recipe) and reports.
  const Value::Fields& given() const { return *given_; }

 private:
  Arguments() = default;
  const Value* find(std::string_view name) const;
  const Value& at(std::string_view name) const;

  const std::vector<Parameter>* parameters_ = nullptr;
  const Value::Fields* given_ = nullptr;
  const world::World* world_ = nullptr;
  PictureReader pictures_ = {};
};

/// The object that a person names: by its name where it is the only one, by a path of names from above
/// ("table/leg") where it is not, or by "#" and its number. Fails saying what there is instead.
base::Result<world::ObjectId> named_object(const world::World& world, std::string_view name);

}  // namespace icome::interaction
