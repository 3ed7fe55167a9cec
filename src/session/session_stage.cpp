#include <algorithm>
#include <utility>

#include "interaction/object_move.h"
#include "session/display/picking.h"
#include "session/session_parts.h"
#include "world/motion.h"

namespace icome::session {
namespace {

constexpr double kSymbolSlack = 0.01;  // of the field of view: some 6 pixels of 600

}  // namespace

void SessionStage::mark_handle(const std::optional<interaction::MarkedHandle>& marked) {
  parts_.mouse_marks = marked;
}

std::optional<SessionStage::Picked> SessionStage::pick(const interaction::Ray& ray) const {
  const FeltVersion& felt = parts_.felt.read();
  // Things are picked where they are seen: at the end of their glide.
  const double elapsed =
      std::max(session_seconds() - felt.scene->moment(), haptics::EffectFeed::kGlideSeconds);
  const auto thing = session::pick(*felt.scene, ray, elapsed);
  if (!thing) return std::nullopt;
  const auto object = felt.names->object(thing->object);
  if (!object) return std::nullopt;
  return Picked{*object, thing->place};
}

std::optional<SessionStage::Picked> SessionStage::pick_seen(const interaction::Ray& ray) const {
  auto surface = pick(ray);
  const auto symbol =
      parts_.effects.pick(parts_.world, parts_.shown_scene, ray, kSymbolSlack * parts_.user.view().field);
  if (!symbol || (surface && surface->place.distance <= symbol->place.distance)) return surface;
  return Picked{symbol->object, symbol->place};
}

std::optional<PartOutlines::Picked> SessionStage::pick_part(const interaction::Ray& ray) const {
  parts_.renew_parts();
  return parts_.part_outlines.pick(ray, kSymbolSlack * parts_.user.view().field);
}

std::optional<interaction::PlacedPart> SessionStage::part_near(const base::Vector3& place,
                                                               double reach) const {
  parts_.renew_parts();
  return parts_.part_outlines.nearest(place, reach);
}

void SessionStage::mark_part(const std::optional<MarkedPart>& marked) { parts_.mark_part(marked); }

const std::optional<MarkedPart>& SessionStage::marked_part() const { return parts_.marked_part; }

void SessionStage::show_scene(world::SceneId scene) {
  if (!scene || parts_.world.find(scene)) parts_.show(scene);
}

world::SceneId SessionStage::shown_scene() const { return parts_.shown_scene; }

bool SessionStage::has_motions() const { return !world::moving_objects(parts_.world).empty(); }

bool SessionStage::playing() const { return parts_.played_since.has_value(); }

void SessionStage::play(bool on) {
  if (on == playing()) return;
  parts_.played_since = on ? std::optional<double>(session_seconds()) : std::nullopt;
  Edited edited;
  edited.play = Edited::Play{parts_.played_since};
  parts_.queue.post(std::move(edited));
}

base::Bounds SessionStage::selection_bounds() const {
  const world::World& world = parts_.world;
  const world::Scene* scene = world.find(parts_.shown_scene);
  const auto& all = scene ? scene->roots : world.roots();
  base::Bounds bounds;
  for (const world::ObjectId id :
       parts_.selection.empty() ? all : interaction::topmost(world, parts_.selection))
    bounds.extend(world::bounds(world, id));
  return bounds;
}

}  // namespace icome::session
