#include "haptics/contact/haptic_scene.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <numeric>
#include <utility>

#include "geometry/tree/hilbert.h"

namespace icome::haptics {
namespace {

/// The point by which the tree sorts a box; the origin if the box is unlimited and has no centre.
Eigen::Vector3f sorting_point(const Bounds& bounds) {
  const Vector3 centre = bounds.center();
  return centre.allFinite() ? Eigen::Vector3f(centre.cast<float>()) : Eigen::Vector3f::Zero();
}

/// Half of the longest side of a box, m. A box that lies far from its own origin counts as larger:
/// its coordinates have fewer digits.
double own_size(const Bounds& box) {
  if (box.isEmpty()) return 0.0;
  const double largest = std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
  const double share = Tolerance::for_coordinates(1.0).gap / Tolerance::for_size(1.0).gap;
  return std::max(0.5 * box.sizes().maxCoeff(), share * largest);
}

}  // namespace

std::shared_ptr<const HapticScene> HapticScene::compile(std::vector<HapticObject> objects, double moment) {
  std::shared_ptr<HapticScene> scene(new HapticScene());
  scene->objects_ = base::SharedBlocks<HapticObject>(std::move(objects));
  scene->moment_ = moment;
  const auto count = std::uint32_t(scene->objects_.size());
  std::vector<Eigen::Vector3f> places(count);
  for (std::uint32_t i = 0; i < count; ++i) places[i] = sorting_point(scene->object_bounds(i));
  scene->order_ = std::make_shared<const std::vector<std::uint32_t>>(geometry::hilbert_order(places));
  scene->tree_ = std::make_shared<const geometry::BoxTree>(scene->slot_boxes());
  std::vector<std::uint32_t> by_id(count);
  std::iota(by_id.begin(), by_id.end(), 0u);
  std::sort(by_id.begin(), by_id.end(),
            [&](std::uint32_t a, std::uint32_t b) { return scene->objects_[a].id < scene->objects_[b].id; });
  scene->by_id_ = std::make_shared<const std::vector<std::uint32_t>>(std::move(by_id));
  scene->measure_sizes();
  scene->extents_.resize(scene->objects_.block_count());
  for (std::size_t block = 0; block < scene->extents_.size(); ++block) scene->measure_block(block);
  scene->measure_all();
  return scene;
}

std::shared_ptr<const HapticScene> HapticScene::moved(std::span<const Move> moves, double moment) const {
  std::vector<std::pair<std::uint32_t, const Move*>> placed;
  placed.reserve(moves.size());
  for (const Move& move : moves) {
    if (const std::optional<std::uint32_t> object = find(move.id)) placed.emplace_back(*object, &move);
  }
  std::ranges::stable_sort(placed, {}, [](const auto& it) { return it.first; });
  std::vector<std::uint32_t> indices;
  indices.reserve(placed.size());
  for (const auto& [object, move] : placed) indices.push_back(object);

  std::shared_ptr<HapticScene> scene(new HapticScene(*this));
  scene->moment_ = moment;
  scene->objects_ = objects_.changed(indices, [&](std::size_t k, HapticObject& object) {
    object.world_from_object = placed[k].second->world_from_object;
    object.motion = placed[k].second->motion;
  });
  indices.erase(std::ranges::unique(indices).begin(), indices.end());
  constexpr std::size_t kItems = base::SharedBlocks<HapticObject>::kBlockItems;
  for (std::size_t k = 0; k < indices.size(); ++k) {
    if (k == 0 || indices[k] / kItems != indices[k - 1] / kItems) scene->measure_block(indices[k] / kItems);
  }
  scene->measure_all();
  scene->let_stray(indices);
  return scene;
}

/// Takes the objects, ascending, out of the tree; refits the tree when there are too many outside it to be
/// tested one by one.
void HapticScene::let_stray(std::span<const std::uint32_t> moved) {
  constexpr std::size_t kMostStrays = 64;
  std::vector<std::uint32_t> strays;
  std::ranges::set_union(strays_, moved, std::back_inserter(strays));
  stray_boxes_.clear();
  if (strays.size() > std::min(kMostStrays, objects_.size() / 2)) {
    auto tree = std::make_shared<geometry::BoxTree>(*tree_);
    tree->refit(slot_boxes());
    tree_ = std::move(tree);
    strays_.clear();
    return;
  }
  strays_ = std::move(strays);
  constexpr std::size_t kFour = geometry::FourBoxes::kCount;
  stray_boxes_.resize((strays_.size() + kFour - 1) / kFour);
  for (std::size_t i = 0; i < strays_.size(); ++i)
    stray_boxes_[i / kFour].set(unsigned(i % kFour), geometry::float_box(object_bounds(strays_[i])));
}

void HapticScene::measure_sizes() {
  std::vector<double> sizes;
  sizes.reserve(objects_.size());
  for (const HapticObject& object : objects_) sizes.push_back(own_size(object.shape->bounds()));
  sizes_ = std::make_shared<const std::vector<double>>(std::move(sizes));
}

void HapticScene::measure_block(std::size_t block) {
  Extent extent;
  const auto first = std::uint32_t(block * base::SharedBlocks<HapticObject>::kBlockItems);
  for (std::uint32_t i = 0; i < objects_.block(block).size(); ++i) {
    const Bounds box = object_bounds(first + i);
    if (box.min().allFinite() && box.max().allFinite()) extent.bounds.extend(box);
    extent.moves = extent.moves || is_dynamic(first + i);
  }
  extents_[block] = extent;
}

void HapticScene::measure_all() {
  bounds_.setEmpty();
  moves_ = false;
  for (const Extent& extent : extents_) {
    bounds_.extend(extent.bounds);
    moves_ = moves_ || extent.moves;
  }
  extent_ = bounds_.isEmpty()
                ? 1.0
                : std::max(bounds_.min().cwiseAbs().maxCoeff(), bounds_.max().cwiseAbs().maxCoeff());
}

// The box sweeps over everything the object can reach within the horizon, so that the tree stays
// right between two scenes.
Bounds HapticScene::object_bounds(std::uint32_t object) const {
  const HapticObject& it = objects_[object];
  const Bounds local = it.shape->bounds();
  if (local.isEmpty()) return local;
  if (!local.min().allFinite() || !local.max().allFinite()) {
    const Vector3 far = Vector3::Constant(std::numeric_limits<double>::infinity());
    return {-far, far};
  }
  const Vector3 centre = it.world_from_object * Vector3(local.center());
  Vector3 reach = it.world_from_object.linear().cwiseAbs() * (0.5 * local.sizes());
  if (!it.motion.still()) {
    const double turn_radius = local.center().norm() + 0.5 * local.sizes().norm();
    const double longest = std::max(it.motion.arrives, it.motion.ends - it.motion.arrives);  // s
    const double chord = std::min(2.0, it.motion.angular.norm() * longest) * turn_radius;
    reach += it.motion.linear.cwiseAbs() * longest + Vector3::Constant(chord);
  }
  return {centre - reach, centre + reach};
}

std::vector<geometry::FloatBox> HapticScene::slot_boxes() const {
  std::vector<geometry::FloatBox> boxes(objects_.size());
  for (std::size_t slot = 0; slot < boxes.size(); ++slot) {
    boxes[slot] = geometry::float_box(object_bounds((*order_)[slot]));
  }
  return boxes;
}

void HapticScene::gather(ContactRegion& region) const {
  const auto& [origin, tip, elapsed] = region.frame();
  near(origin + region.a(), origin + region.b(), region.reach() + tip + edge_dip(tip),
       [&](std::uint32_t object) {
         gather_object(region, object);
         return !region.overflowed();
       });
}

void HapticScene::gather_object(ContactRegion& region, std::uint32_t object) const {
  const HapticObject& it = objects_[object];
  const ContactRegion::Frame& frame = region.frame();
  const Pose region_from_object = pose_in(frame.origin, object, frame.elapsed);
  const Pose object_from_region = region_from_object.inverse();
  ElementSink sink(region, object, region_from_object);
  const double reach = region.reach() + edge_dip(frame.tip);
  const std::size_t before = region.size();
  it.shape->gather({object_from_region * region.a(), object_from_region * region.b(), reach, frame.tip,
                    it.surface.sides, time(object, frame.elapsed)},
                   sink);
  if (region.size() != before) region.hold(size_near(object, object_from_region * region.a()));
}

void HapticScene::expand(std::uint32_t object, std::uint32_t piece, const ContactRegion::Frame& frame,
                         PieceElements& elements) const {
  const HapticObject& it = objects_[object];
  it.shape->expand(piece, frame.tip, it.surface.sides, elements);
  const Pose region_from_object = pose_in(frame.origin, object, frame.elapsed);
  const bool in_place = region_from_object.matrix().isIdentity(0.0);
  for (Element& element : elements.all()) {
    element.object = object;
    element.time = this->time(object, frame.elapsed);
    if (!in_place) element = transformed(region_from_object, element);
  }
}

std::size_t HapticScene::sweep(std::uint32_t object, const Vector3& start, const Vector3& step,
                               double distance, const ContactRegion::Frame& frame,
                               PieceVisitor& visitor) const {
  const Pose object_from_region = pose_in(frame.origin, object, frame.elapsed).inverse();
  return objects_[object].shape->sweep(object_from_region * start, object_from_region.linear() * step,
                                       distance, visitor);
}

// An unlimited object counts as large as the place on it is far out.
double HapticScene::size_near(std::uint32_t object, const Vector3& place) const {
  const double size = (*sizes_)[object];
  return std::isfinite(size) ? size : std::max(1.0, place.cwiseAbs().maxCoeff());
}

Tolerance HapticScene::tolerance_near(std::uint32_t object, const Vector3& place) const {
  return Tolerance::for_size(size_near(object, place));
}

Pose HapticScene::pose_in(const Vector3& origin, std::uint32_t object, double elapsed) const {
  Pose result = pose(object, elapsed);
  result.translation() -= origin;
  return result;
}

Pose HapticScene::pose(std::uint32_t object, double elapsed) const {
  const HapticObject& it = objects_[object];
  return haptics::moved(it.world_from_object, it.motion, elapsed);
}

std::optional<std::uint32_t> HapticScene::find(ObjectId id) const {
  const auto place =
      std::lower_bound(by_id_->begin(), by_id_->end(), id,
                       [&](std::uint32_t object, ObjectId key) { return objects_[object].id < key; });
  if (place == by_id_->end() || objects_[*place].id != id) return std::nullopt;
  return *place;
}

std::size_t HapticScene::bytes() const {
  return sizeof(*this) + objects_.bytes() + tree_->bytes() + extents_.capacity() * sizeof(Extent) +
         (order_->capacity() + by_id_->capacity() + strays_.capacity()) * sizeof(std::uint32_t) +
         sizes_->capacity() * sizeof(double) + stray_boxes_.capacity() * sizeof(geometry::FourBoxes);
}

}  // namespace icome::haptics
