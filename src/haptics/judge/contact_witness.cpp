#include "haptics/judge/contact_witness.h"

#include "geometry/primitive/primitive.h"

namespace icome::haptics {

base::Bounds bounds(const JudgedObject& object) {
  if (const auto* primitive = std::get_if<geometry::Primitive>(&object.surface))
    return geometry::bounds(*primitive);
  if (const auto* solid = std::get_if<MembershipSolid>(&object.surface)) return solid->bounds;
  base::Bounds all;
  for (const base::Vector3& position : std::get<0>(object.surface)->positions) all.extend(position);
  return all;
}

std::unique_ptr<Witness> make_witness(const JudgedObject& object, const Resolution& resolution) {
  if (const auto* solid = std::get_if<MembershipSolid>(&object.surface))
    return make_membership_witness(*solid, resolution);
  if (std::holds_alternative<geometry::Primitive>(object.surface))
    return make_primitive_witness(object, resolution);
  return make_mesh_witness(object);
}

}  // namespace icome::haptics
