#include "interaction/snapping/snap_feel.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "haptics/effects/fields.h"

namespace icome::interaction {
namespace {

constexpr double kMostStrength = 100.0;  // N: no device for hands pulls harder

class WellEffect final : public haptics::Effect {
 public:
  explicit WellEffect(const SnapWell& well) : well_(well) {}
  Vector3 force(const haptics::EffectInput& input) override { return well_force(well_, input.position); }

 private:
  SnapWell well_;
};

/// Contacts by number, and how much of a push they leave.
struct Held {
  std::vector<std::size_t> contacts;
  double left;  // m
};

/// The part of a push that the contacts do not bear, m; all of it where one of them would have to pull.
double left_of(std::span<const Contact> contacts, const std::vector<std::size_t>& which,
               const Vector3& against) {
  Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 3> normals(3, Eigen::Index(which.size()));
  for (std::size_t i = 0; i < which.size(); ++i) normals.col(Eigen::Index(i)) = contacts[which[i]].normal;
  const auto shares = normals.colPivHouseholderQr().solve(against).eval();
  if (!shares.allFinite() || shares.minCoeff() < 0.0) return against.norm();
  return (against - normals * shares).norm();
}

/// Tries all sets that add contacts behind the last one, and keeps the best of each size.
void try_all(std::span<const Contact> contacts, std::vector<std::size_t>& which, const Vector3& against,
             std::vector<Held>& best) {
  for (std::size_t i = which.empty() ? 0 : which.back() + 1; i < contacts.size(); ++i) {
    which.push_back(i);
    const double left = left_of(contacts, which, against);
    Held& so_far = best[which.size()];
    if (left < so_far.left) so_far = {which, left};
    if (which.size() + 1 < best.size()) try_all(contacts, which, against, best);
    which.pop_back();
  }
}

}  // namespace

/// Its strongest pull is at r = R / sqrt(5): k R (1 / sqrt(5)) (4/5)^2.
double stiffness_of(const WellSettings& settings) {
  return settings.strength * std::sqrt(5.0) * 25.0 / 16.0 / settings.radius;
}

Vector3 SnapWell::nearest(const Vector3& position) const {
  if (!normal.isZero(0.0)) return position - normal.dot(position - from) * normal;
  const Vector3 along = to - from;
  const double square = along.squaredNorm();
  if (!(square > 0.0)) return from;
  return from + std::clamp((position - from).dot(along) / square, 0.0, 1.0) * along;
}

SnapWell SnapWell::moved_by(const Vector3& offset) const {
  return {from + offset, to + offset, normal, settings};
}

base::Result<SnapWell> well_around(const Snap& snap, const WellSettings& settings) {
  if (!(settings.strength >= 0.0 && settings.strength <= kMostStrength))
    return base::fail("A snap pulls with 0 to 100 N: choose another strength.");
  if (!(settings.radius > 0.0) || !std::isfinite(settings.radius))
    return base::fail("A snap is felt within a radius: choose one above 0 m.");
  switch (snap.kind) {
    case SnapKind::Edge:
      return SnapWell{snap.from, snap.to, Vector3::Zero(), settings};
    case SnapKind::Face:
      return SnapWell{snap.point, snap.point, snap.direction, settings};
    default:
      return SnapWell{snap.point, snap.point, Vector3::Zero(), settings};
  }
}

Vector3 well_force(const SnapWell& well, const Vector3& position) {
  haptics::GravityWell pull(well.nearest(position), well.settings.radius, stiffness_of(well.settings));
  haptics::EffectInput input;
  input.position = position;
  return pull.force(input);
}

double well_energy(const SnapWell& well, const Vector3& position) {
  const double radius = well.settings.radius;
  const double left = 1.0 - (well.nearest(position) - position).squaredNorm() / (radius * radius);
  if (left <= 0.0) return 0.0;
  return -stiffness_of(well.settings) * radius * radius / 6.0 * left * left * left;
}

std::unique_ptr<haptics::Effect> effect_of(const SnapWell& well) {
  return std::make_unique<WellEffect>(well);
}

Vector3 contact_force(const Vector3& wanted, const Vector3& stopped, const Vector3& approach,
                      const CouplingSettings& settings) {
  const Vector3 back = stopped - wanted;
  const double depth = back.norm();
  if (!std::isfinite(depth) || depth == 0.0 || !approach.allFinite()) return Vector3::Zero();
  const Vector3 direction = back / depth;
  const double spring = settings.stiffness * depth;
  // Damping doubles the spring at most, so that it too begins at nothing, and never makes it pull.
  const double damping = std::clamp(-settings.damping * approach.dot(direction), -spring, spring);
  if (!(spring + damping > 0.0)) return Vector3::Zero();
  return std::min(spring + damping, std::max(0.0, settings.limit)) * direction;
}

std::vector<Contact> holding(std::span<const Contact> contacts, const Vector3& push) {
  constexpr double kWorthOneMore = 0.01;  // of the push
  const double all = push.norm();
  std::vector<Held> best(4, {{}, all});  // by the number of contacts
  std::vector<std::size_t> which;
  if (std::isfinite(all) && all > 0.0) try_all(contacts, which, -push, best);
  const Held* found = &best.front();
  for (const Held& it : best) {
    if (it.left < found->left - kWorthOneMore * all) found = &it;
  }
  std::vector<Contact> result;
  for (const std::size_t i : found->contacts) result.push_back(contacts[i]);
  return result;
}

}  // namespace icome::interaction
