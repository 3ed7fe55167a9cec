#pragma once
#include <cstdint>
#include <string>
#include <string_view>

namespace icome::files {

/// Meanings of a .csg file's statements. Render and the top level are unions like Group.
enum class CsgKeyword : std::uint8_t {
  Cube,
  Sphere,
  Cylinder,
  Polyhedron,
  Multmatrix,
  Color,
  Union,
  Intersection,
  Difference,
  Inexact,  // known, but without a form that can be touched exactly
  Unknown
};

CsgKeyword csg_keyword(std::string_view name);

constexpr bool is_primitive(CsgKeyword keyword) { return keyword <= CsgKeyword::Polyhedron; }

/// The reason why a statement of this name cannot be read: the message for Inexact and Unknown.
std::string refusal(std::string_view name, CsgKeyword keyword);

}  // namespace icome::files
