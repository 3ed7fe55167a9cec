#include "files/csg/csg_keywords.h"

#include <fmt/format.h>

#include <array>

#include "io/text_scanner.h"

namespace icome::files {
namespace {

struct KnownKeyword {
  std::string_view name;
  CsgKeyword keyword;
};

constexpr std::array<KnownKeyword, 26> kKnownKeywords{{{"group", CsgKeyword::Union},
                                                       {"multmatrix", CsgKeyword::Multmatrix},
                                                       {"cube", CsgKeyword::Cube},
                                                       {"cylinder", CsgKeyword::Cylinder},
                                                       {"sphere", CsgKeyword::Sphere},
                                                       {"polyhedron", CsgKeyword::Polyhedron},
                                                       {"color", CsgKeyword::Color},
                                                       {"difference", CsgKeyword::Difference},
                                                       {"union", CsgKeyword::Union},
                                                       {"intersection", CsgKeyword::Intersection},
                                                       {"render", CsgKeyword::Union},
                                                       {"hull", CsgKeyword::Inexact},
                                                       {"minkowski", CsgKeyword::Inexact},
                                                       {"resize", CsgKeyword::Inexact},
                                                       {"linear_extrude", CsgKeyword::Inexact},
                                                       {"rotate_extrude", CsgKeyword::Inexact},
                                                       {"projection", CsgKeyword::Inexact},
                                                       {"text", CsgKeyword::Inexact},
                                                       {"square", CsgKeyword::Inexact},
                                                       {"circle", CsgKeyword::Inexact},
                                                       {"polygon", CsgKeyword::Inexact},
                                                       {"offset", CsgKeyword::Inexact},
                                                       {"fill", CsgKeyword::Inexact},
                                                       {"surface", CsgKeyword::Inexact},
                                                       {"import", CsgKeyword::Inexact},
                                                       {"roof", CsgKeyword::Inexact}}};

}  // namespace

CsgKeyword csg_keyword(std::string_view name) {
  for (const KnownKeyword& known : kKnownKeywords) {
    if (known.name == name) return known.keyword;
  }
  return CsgKeyword::Unknown;
}

std::string refusal(std::string_view name, CsgKeyword keyword) {
  if (keyword == CsgKeyword::Inexact) {
    return fmt::format(
        "{} has no exact form as a solid: these have one: cube, sphere, cylinder and polyhedron under "
        "multmatrix, color, group, union, intersection, difference and render",
        name);
  }
  return fmt::format(
      "{} is not known here: a .csg file, as openscad -o MODEL.csg MODEL.scad writes it, is expected",
      io::quoted(name));
}

}  // namespace icome::files
