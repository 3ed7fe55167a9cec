#include "session/felt/haptic_representation.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <tuple>
#include <utility>

#include "base/parallel.h"
#include "haptics/effects/effect_text.h"
#include "session/felt/rigid_part.h"

namespace icome::session {

using base::Affine3;
using haptics::TouchableSides;
using world::PhysicalObject;
using world::World;

namespace {

std::string called(const PhysicalObject& object, world::ObjectId id) {
  return object.name.empty() ? fmt::format("Object {}", id.value & world::IdSource::kNumberMask)
                             : fmt::format("\"{}\"", object.name);
}

world::FixturePointer effect_in(const PhysicalObject& object) {
  return object.fixture && std::holds_alternative<world::ForceEffect>(*object.fixture) ? object.fixture
                                                                                       : nullptr;
}

std::string remark_on(const std::string& object, const FeltShape& felt, std::size_t others) {
  const std::string more = others > 0 ? fmt::format(" (and {} more)", others) : "";
  return fmt::format("{}{} {}{}", object, more, felt.remark, felt.remark.back() == '.' ? "" : ".");
}

constexpr std::size_t kMostEffects = 256;  // that one tick can feel

}  // namespace

/// Brings objects up to date: finds out which shapes they need, has the missing ones made side by side, and
/// hands them out.
class HapticRepresentation::Update {
 public:
  Update(HapticRepresentation& owner, const World& world) : owner_(owner), world_(world) {}

  void bring(const std::vector<Due>& due) {
    needs_.reserve(due.size());
    for (const Due& it : due) look_at(it);
    make_missing();
    for (std::size_t i = 0; i < due.size(); ++i) renew(due[i], needs_[i]);
  }

 private:
  struct Need {
    const PhysicalObject* object = nullptr;  // in the world
    FeltPlace place = {};
    std::optional<ShapeKey> key = {};  // none: no shape
  };
  struct Job {
    ShapeKey key;
    const world::Geometry* shape;
    base::Matrix3 felt_from_geometry;
    FeltShapePointer before;  // null: new
    Job* like = nullptr;      // set: the shape made for that one will do
    FeltShapePointer made = nullptr;
  };

  static ShapeKey key_of(world::GeometryId geometry, const base::Matrix3& stretch) {
    ShapeKey key{geometry, {}};
    std::copy(stretch.data(), stretch.data() + key.stretch.size(), key.stretch.begin());
    return key;
  }

  void look_at(const Due& it) {
    Need need{world_.find(it.id)};
    if (const world::GeometryObject* geometry = world_.find(need.object->geometry)) {
      need.place = felt_place(*geometry->shape, it.world_from_object);
      need.key = key_of(need.object->geometry, need.place.felt_from_geometry);
      const auto [found, fresh] = owner_.shapes_.try_emplace(*need.key);
      if (fresh)
        jobs_.push_back({*need.key, geometry->shape.get(), need.place.felt_from_geometry, before(*need.key)});
    }
    needs_.push_back(need);
  }

  FeltShapePointer before(const ShapeKey& key) const {
    const auto found = owner_.outdated_.find(key);
    return found == owner_.outdated_.end() ? nullptr : found->second;
  }

  void make_missing() {
    const std::vector<Job*> first = first_of_equals();
    base::parallel_for(first.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        Job& job = *first[i];
        job.made =
            make_felt_shape(*job.shape, job.felt_from_geometry, owner_.settings_.felt, job.before.get());
      }
    });
    for (Job& job : jobs_) owner_.shapes_[job.key] = job.like ? of_its_own(job.like->made) : job.made;
    owner_.work_.shapes += first.size();
  }

  /// Shapes that lie in memory once and are stretched alike are felt alike: they are made once.
  std::vector<Job*> first_of_equals() {
    using Likeness = std::tuple<const world::Geometry*, std::array<double, 9>, const FeltShape*>;
    std::map<Likeness, Job*> known;
    std::vector<Job*> first;
    for (Job& job : jobs_) {
      const auto [found, fresh] = known.try_emplace({job.shape, job.key.stretch, job.before.get()}, &job);
      if (fresh)
        first.push_back(&job);
      else
        job.like = found->second;
    }
    return first;
  }

  /// A pointer with a count of users of its own, by which one entry is forgotten and others stay.
  static FeltShapePointer of_its_own(const FeltShapePointer& felt) {
    return {std::make_shared<FeltShapePointer>(felt), felt.get()};
  }

  void renew(const Due& it, const Need& need) {
    Member& member = owner_.members_[it.id];
    const world::FixturePointer effect = effect_in(*need.object);
    if (effect || member.effect) owner_.effects_stale_ = true;
    member.effect = effect;
    release_shape(owner_, member);
    member.seen = owner_.surveys_;
    member.world_from_object = it.world_from_object;
    member.geometry = need.object->geometry;
    member.material = need.object->material;
    member.felt = need.key ? owner_.shapes_.at(*need.key) : nullptr;
    base::Pose world_from_felt = need.place.world_from_felt;
    if (member.felt) world_from_felt.translate(member.felt->middle);
    renew_slot(it.id, member, world_from_felt);
  }

  void renew_slot(world::ObjectId id, Member& member, const base::Pose& world_from_felt) {
    const bool touchable = member.felt && member.felt->shape;
    if (!touchable) {
      release_slot(owner_, member);
      return;
    }
    const bool fresh = !member.slot;
    if (fresh) take_slot(id, member);
    haptics::HapticObject& object = owner_.slots_[*member.slot].object;
    const haptics::Surface surface = owner_.surface_of(world_, member);
    const bool same_shape = !fresh && object.shape == member.felt->shape;
    if (!same_shape || differ(object.surface, surface)) {
      object.shape = member.felt->shape;
      object.surface = surface;
      owner_.stale_ = true;
    }
    if (same_shape) {
      owner_.put(*member.slot, world_from_felt);
    } else {
      object.world_from_object = world_from_felt;
      object.motion = {};
    }
  }

  static bool differ(const haptics::Surface& a, const haptics::Surface& b) {
    return a.stiffness != b.stiffness || a.damping != b.damping || a.static_friction != b.static_friction ||
           a.dynamic_friction != b.dynamic_friction || a.sides != b.sides || a.texture != b.texture;
  }

  void take_slot(world::ObjectId id, Member& member) {
    if (owner_.free_slots_.empty()) {
      member.slot = std::uint32_t(owner_.slots_.size());
      owner_.slots_.emplace_back();
      owner_.slots_.back().object.id.index = *member.slot;
    } else {
      member.slot = owner_.free_slots_.back();
      owner_.free_slots_.pop_back();
    }
    Slot& slot = owner_.slots_[*member.slot];
    ++slot.object.id.generation;  // names of the last one find nothing
    slot.world_id = id;
    owner_.names_.reset();
    owner_.stale_ = true;
  }

 public:
  /// To be called before the member has another shape, or none.
  static void release_shape(HapticRepresentation& owner, const Member& member) {
    if (member.felt) owner.released_.push_back(key_of(member.geometry, member.felt->felt_from_geometry));
  }

  static void release_slot(HapticRepresentation& owner, Member& member) {
    if (!member.slot) return;
    Slot& slot = owner.slots_[*member.slot];
    slot.world_id = {};
    slot.object.shape = nullptr;
    slot.object.surface = {};
    slot.object.motion = {};
    owner.free_slots_.push_back(*member.slot);
    member.slot.reset();
    owner.names_.reset();
    owner.stale_ = true;
  }

 private:
  HapticRepresentation& owner_;
  const World& world_;
  std::vector<Need> needs_;
  std::vector<Job> jobs_;
};

HapticRepresentation::HapticRepresentation(HapticRepresentationSettings settings)
    : settings_(std::move(settings)), scene_(haptics::HapticScene::compile({})) {}

std::optional<world::ObjectId> TouchedNames::object(base::ObjectId haptic_id) const {
  if (haptic_id.index >= names_.size()) return std::nullopt;
  const Name& name = names_[haptic_id.index];
  if (!name.object || name.generation != haptic_id.generation) return std::nullopt;
  return name.object;
}

void HapticRepresentation::open(const World& world, world::SceneId scene) {
  members_.clear();
  effects_stale_ = true;
  shapes_.clear();
  free_slots_.clear();
  for (std::size_t i = slots_.size(); i-- > 0;) {
    slots_[i].object.shape = nullptr;
    slots_[i].object.surface = {};
    slots_[i].object.motion = {};
    slots_[i].world_id = {};
    free_slots_.push_back(std::uint32_t(i));  // the first are given away first, as in a new one
  }
  names_.reset();
  stale_ = true;
  show(world, scene);
}

void HapticRepresentation::show(const World& world, world::SceneId scene) {
  shown_ = scene;
  survey(world);
  released_.clear();  // other scenes may come back
  publish();
}

/// Finds all objects of the scene anew.
void HapticRepresentation::survey(const World& world) {
  ++surveys_;
  std::vector<Due> due;
  const world::Scene* scene = world.find(shown_);
  const std::vector<world::ObjectId> nothing;
  const std::vector<world::ObjectId>& roots = scene ? scene->roots : shown_ ? nothing : world.roots();
  shown_roots_.clear();
  if (scene) shown_roots_.insert(roots.begin(), roots.end());
  for (const world::ObjectId root : roots) collect(world, root, due);
  // A root of a scene may lie below another.
  std::sort(due.begin(), due.end(), [](const Due& a, const Due& b) { return a.id < b.id; });
  due.erase(std::unique(due.begin(), due.end(), [](const Due& a, const Due& b) { return a.id == b.id; }),
            due.end());
  slots_.reserve(due.size());
  Update(*this, world).bring(due);
  std::vector<world::ObjectId> gone;
  for (const auto& [id, member] : members_) {
    if (member.seen != surveys_) gone.push_back(id);
  }
  for (const world::ObjectId id : gone) forget(id);
}

/// The object's place, multiplied from the top down as in collect(): the same bits.
Affine3 HapticRepresentation::place(const World& world, world::ObjectId id) const {
  std::vector<const PhysicalObject*> line;
  for (const PhysicalObject* it = world.find(id); it; it = world.find(it->parent)) line.push_back(it);
  Affine3 result = settings_.world_from_design;
  for (auto it = line.rbegin(); it != line.rend(); ++it) result = result * (*it)->parent_from_object;
  return result;
}

/// Adds the objects of a subtree and their places.
void HapticRepresentation::collect(const World& world, world::ObjectId root, std::vector<Due>& due) {
  const std::size_t first = due.size();
  due.push_back({root, place(world, root)});
  for (std::size_t i = first; i < due.size(); ++i) {
    const Due above = due[i];
    for (const world::ObjectId child : world.find(above.id)->children)
      due.push_back({child, above.world_from_object * world.find(child)->parent_from_object});
  }
}

bool HapticRepresentation::in_scene(const World& world, world::ObjectId id) const {
  if (!shown_) return world.find(id) != nullptr;
  for (const PhysicalObject* object = world.find(id); object; id = object->parent, object = world.find(id)) {
    if (shown_roots_.contains(id)) return true;
  }
  return false;
}

void HapticRepresentation::follow(const World& world, const world::Changes& changes) {
  for (const world::GeometryId geometry : changes.geometries) outdate_shapes(geometry);
  const bool other_roots = shown_ && std::binary_search(changes.scenes.begin(), changes.scenes.end(), shown_);
  if (other_roots) survey(world);
  std::vector<Due> due;
  for (const world::ObjectId id : changes.objects) note_object(world, id, due);
  const auto changed = [](const auto& ids, auto id) {
    return std::binary_search(ids.begin(), ids.end(), id);
  };
  if (!changes.geometries.empty() || !changes.materials.empty()) {
    for (const auto& [id, member] : members_) {
      if (changed(changes.geometries, member.geometry) || changed(changes.materials, member.material))
        due.push_back({id, member.world_from_object});
    }
  }
  // In the order of ids, as tables keep none: the same edits give the same scene. The objects noted first
  // know best where they are.
  std::stable_sort(due.begin(), due.end(), [](const Due& a, const Due& b) { return a.id < b.id; });
  due.erase(std::unique(due.begin(), due.end(), [](const Due& a, const Due& b) { return a.id == b.id; }),
            due.end());
  Update(*this, world).bring(due);
  outdated_.clear();
  forget_unused();
  publish();
}

/// Notes an object that an edit named, and those below it where it took them along.
void HapticRepresentation::note_object(const World& world, world::ObjectId id, std::vector<Due>& due) {
  if (!world.find(id)) {
    forget(id);  // objects below it are named too
    return;
  }
  const auto found = members_.find(id);
  const bool stays = in_scene(world, id);
  const Affine3 here = place(world, id);
  if (stays && found != members_.end() && found->second.world_from_object.matrix() == here.matrix()) {
    due.push_back({id, here});
    return;
  }
  std::vector<Due> below;
  collect(world, id, below);
  for (const Due& it : below) {
    // Below an object that has left, there may be a root of the scene.
    if (stays || in_scene(world, it.id))
      due.push_back(it);
    else
      forget(it.id);
  }
}

void HapticRepresentation::forget(world::ObjectId id) {
  const auto found = members_.find(id);
  if (found == members_.end()) return;
  if (found->second.effect) effects_stale_ = true;
  Update::release_shape(*this, found->second);
  Update::release_slot(*this, found->second);
  members_.erase(found);
}

/// Puts aside the felt shapes made of a shape that has changed.
void HapticRepresentation::outdate_shapes(world::GeometryId geometry) {
  auto it = shapes_.lower_bound({geometry, {}});
  // Entries of a stretch may be below zero.
  while (it != shapes_.begin() && std::prev(it)->first.geometry == geometry) --it;
  while (it != shapes_.end() && it->first.geometry == geometry) outdated_.insert(shapes_.extract(it++));
}

/// Forgets shapes without users: an object stretched by hand leaves one behind with every step.
void HapticRepresentation::forget_unused() {
  for (const ShapeKey& key : released_) {
    const auto found = shapes_.find(key);
    if (found != shapes_.end() && found->second.use_count() == 1) shapes_.erase(found);
  }
  released_.clear();
}

std::shared_ptr<const haptics::HapticTexture> HapticRepresentation::texture(const std::string& name) {
  const auto [found, fresh] = textures_.try_emplace(name);
  if (fresh && !name.empty() && settings_.texture) found->second = settings_.texture(name);
  return found->second;
}

haptics::Surface HapticRepresentation::surface_of(const World& world, const Member& member) {
  haptics::Surface surface;
  surface.sides = member.felt->closed ? TouchableSides::Front : TouchableSides::Both;
  if (const world::Material* material = world.find(member.material)) {
    const world::TouchProperties& touch = material->touch;
    surface.stiffness = touch.stiffness.value_or(0.0);
    surface.damping = touch.damping.value_or(haptics::kAutomaticDamping);
    surface.static_friction = touch.static_friction;
    surface.dynamic_friction = touch.dynamic_friction;
    surface.texture = texture(touch.texture);
  }
  return surface;
}

/// Lets an object that was touchable before go to where it is now.
void HapticRepresentation::put(std::uint32_t slot, const base::Pose& world_from_felt) {
  Slot& it = slots_[slot];
  haptics::HapticObject& object = it.object;
  if (object.world_from_object.matrix() == world_from_felt.matrix()) return;
  moved_.push_back(slot);
  if (settings_.glide_seconds > 0.0) {
    const double now = settings_.clock();
    object.motion.arrives = object.motion.ends = settings_.glide_seconds;
    const base::Pose here = haptics::moved(object.world_from_object, object.motion, now - it.set_off);
    object.motion = haptics::motion_between(here, world_from_felt, settings_.glide_seconds);
    it.set_off = now;
    going_.push_back(slot);
  }
  object.world_from_object = world_from_felt;
}

/// Renews the time that objects on their way still have to go.
void HapticRepresentation::go_on() {
  const double now = settings_.clock();
  std::vector<std::uint32_t> still_going;
  for (const std::uint32_t slot : std::exchange(going_, {})) {
    Slot& it = slots_[slot];
    if (!it.world_id || it.object.motion.still()) continue;
    const double left = std::max(0.0, it.set_off + settings_.glide_seconds - now);
    it.object.motion.arrives = it.object.motion.ends = left;
    if (left <= 0.0) it.object.motion = {};
    if (left > 0.0) still_going.push_back(slot);
    moved_.push_back(slot);
  }
  std::ranges::sort(still_going);
  still_going.erase(std::ranges::unique(still_going).begin(), still_going.end());
  going_ = std::move(still_going);
}

bool HapticRepresentation::placeable(const Member& effect) {
  return effect.world_from_object.matrix().allFinite();
}

void HapticRepresentation::list_effects() {
  std::vector<world::ObjectId> ids;
  for (const auto& [id, member] : members_)
    if (member.effect) ids.push_back(id);
  std::sort(ids.begin(), ids.end());
  effects_.clear();
  for (const world::ObjectId id : ids) {
    const Member& member = members_.at(id);
    const auto& effect = std::get<world::ForceEffect>(*member.effect);
    if (!effect.on || !placeable(member) || !haptics::make_effect(effect.text)) continue;
    if (effects_.size() == kMostEffects) break;
    const TurnPart place = turn_part(member.world_from_object);
    effects_.push_back({.id = id.value,
                        .text = effect.text,
                        .world_from_effect = place.world_from_turned,
                        .mirrored = place.mirrored});
  }
}

void HapticRepresentation::publish() {
  if (std::exchange(effects_stale_, false)) list_effects();
  go_on();
  const double now = settings_.clock();
  if (stale_) {
    std::vector<haptics::HapticObject> objects;
    objects.reserve(slots_.size() - free_slots_.size());
    for (const Slot& slot : slots_) {
      if (slot.world_id) objects.push_back(slot.object);
    }
    scene_ = haptics::HapticScene::compile(std::move(objects), now);
    ++work_.compiled;
  } else if (!moved_.empty()) {
    std::vector<haptics::HapticScene::Move> moves;
    for (const std::uint32_t slot : moved_) {
      const haptics::HapticObject& it = slots_[slot].object;
      moves.push_back({it.id, it.world_from_object, it.motion});
    }
    scene_ = scene_->moved(moves, now);
    ++work_.moved;
  }
  stale_ = false;
  moved_.clear();
}

std::optional<base::ObjectId> HapticRepresentation::haptic_id(world::ObjectId object) const {
  const auto found = members_.find(object);
  if (found == members_.end() || !found->second.slot) return std::nullopt;
  return slots_[*found->second.slot].object.id;
}

std::optional<world::ObjectId> HapticRepresentation::object(base::ObjectId haptic_id) const {
  if (haptic_id.index >= slots_.size()) return std::nullopt;
  const Slot& slot = slots_[haptic_id.index];
  if (!slot.world_id || slot.object.id != haptic_id) return std::nullopt;
  return slot.world_id;
}

const std::shared_ptr<const TouchedNames>& HapticRepresentation::names() {
  if (!names_) {
    std::vector<TouchedNames::Name> names;
    names.reserve(slots_.size());
    for (const Slot& slot : slots_) names.push_back({slot.object.id.generation, slot.world_id});
    names_ = std::make_shared<const TouchedNames>(std::move(names));
  }
  return names_;
}

FeltShapePointer HapticRepresentation::felt(world::ObjectId object) const {
  const auto found = members_.find(object);
  return found == members_.end() ? nullptr : found->second.felt;
}

std::vector<std::string> HapticRepresentation::remarks(const World& world) const {
  std::vector<world::ObjectId> ids;
  for (const auto& [id, member] : members_) ids.push_back(id);
  std::sort(ids.begin(), ids.end());
  std::map<const FeltShape*, std::size_t> users;
  for (const auto& [id, member] : members_) ++users[member.felt.get()];
  std::set<const FeltShape*> told;
  std::size_t effects = 0;
  std::set<world::MaterialId> materials;
  std::vector<std::string> sentences;
  for (const world::ObjectId id : ids) {
    const Member& member = members_.at(id);
    if (member.effect) {
      ++effects;
      const auto made = haptics::make_effect(std::get<world::ForceEffect>(*member.effect).text);
      const std::string why = !made               ? made.error().message
                              : placeable(member) ? std::string()
                                                  : "its place is not finite.";
      if (!why.empty())
        sentences.push_back(
            fmt::format("{} is an effect that is not felt: {}", called(*world.find(id), id), why));
    }
    const FeltShape* felt = member.felt.get();
    if (!felt) continue;
    if (!felt->remark.empty() && told.insert(felt).second)
      sentences.push_back(remark_on(called(*world.find(id), id), *felt, users[felt] - 1));
    const world::Material* material = world.find(member.material);
    if (!material || !materials.insert(member.material).second) continue;
    const std::string& name = material->touch.texture;
    const auto texture = textures_.find(name);
    if (!name.empty() && texture != textures_.end() && !texture->second)
      sentences.push_back(
          fmt::format("\"{}\" is felt smooth: no haptic texture is called \"{}\".", material->name, name));
  }
  if (effects > kMostEffects)
    sentences.push_back(fmt::format("Of {} effects only the first {} are felt.", effects, kMostEffects));
  return sentences;
}

}  // namespace icome::session
