#include "files/vrml/worker/geometry_fields.h"

#include <Inventor/fields/SoMFColor.h>
#include <Inventor/fields/SoMFFloat.h>
#include <Inventor/fields/SoMFInt32.h>
#include <Inventor/fields/SoMFVec2f.h>
#include <Inventor/fields/SoMFVec3f.h>

#include <type_traits>

namespace icome::files {
namespace {

template <typename Field>
std::span<const float> floats_of(const Field& field) {
  using Value = std::remove_cvref_t<decltype(*field.getValues(0))>;
  constexpr std::size_t kWidth = sizeof(Value) / sizeof(float);
  static_assert(sizeof(Value) == kWidth * sizeof(float));
  const auto count = static_cast<std::size_t>(field.getNum());
  if (count == 0) return {};
  return {reinterpret_cast<const float*>(field.getValues(0)), count * kWidth};
}

}  // namespace

std::span<const float> floats(const SoMFFloat& field) { return floats_of(field); }
std::span<const float> floats(const SoMFVec2f& field) { return floats_of(field); }
std::span<const float> floats(const SoMFVec3f& field) { return floats_of(field); }
std::span<const float> floats(const SoMFColor& field) { return floats_of(field); }

std::span<const int> indices(const SoMFInt32& field) {
  if (field.getNum() == 0) return {};
  return {field.getValues(0), static_cast<std::size_t>(field.getNum())};
}

}  // namespace icome::files
