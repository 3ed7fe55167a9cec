#include "files/vrml/read/vrml_nodes.h"

#include <flatbuffers/flatbuffers.h>
#include <vrml_answer_generated.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "files/vrml/read/vrml_scanner.h"
#include "files/vrml/vrml_names.h"

namespace icome::files {
namespace {

/// Limits the depth, as hierarchies are walked from child to parent many times.
constexpr std::uint32_t kMostGenerations = 4 * kMostNestedVrml;

bool keeps_volume(const base::Affine3& frame) {
  const double volume = frame.linear().determinant();
  return frame.matrix().allFinite() && std::isfinite(volume) && volume != 0.0;
}

std::unique_ptr<const PlacedFixture> kept(PlacedFixture fixture) {
  return std::make_unique<const PlacedFixture>(std::move(fixture));
}

class NodeReader {
 public:
  NodeReader(const flat::Scene& scene, world::FlatReader& reader) : scene_(scene), reader_(reader) {}

  std::vector<VrmlNode> read() {
    if (!scene_.nodes()) return {};
    nodes_.reserve(scene_.nodes()->size());
    generations_.reserve(scene_.nodes()->size());
    for (const flat::Node* from : *scene_.nodes()) {
      add(*from);
      if (!reader_.fault().empty()) return {};
    }
    merge();
    return std::move(nodes_);
  }

 private:
  template <typename Tables>
  std::int32_t index(std::int32_t it, const Tables* tables) {
    if (it >= VrmlNode::kNone && it < std::int64_t(tables ? tables->size() : 0)) return it;
    reader_.refuse("a node names what is not there");
    return VrmlNode::kNone;
  }

  void add(const flat::Node& from) {
    VrmlNode node;
    node.parent = from.parent();
    if (node.parent < VrmlNode::kNone || node.parent >= std::int64_t(nodes_.size()))
      return reader_.refuse("a node comes before its parent");
    node.is_object = !from.scene();
    node.geometry = index(from.geometry(), scene_.geometries());
    node.appearance = index(from.appearance(), scene_.appearances());
    node.motion = index(from.motion(), scene_.motions());
    node.name = reader_.text(from.name());
    node.def = reader_.text(from.def());
    if (node.name == node.def) node.name = said_by(node.def);
    node.reused = from.reused();
    read_place(from, node);
    if (from.light() && node.geometry == VrmlNode::kNone) node.fixture = kept(fixture_of(*from.light()));
    if (from.viewpoint() && node.geometry == VrmlNode::kNone)
      node.fixture = kept(fixture_of(*from.viewpoint()));
    if (from.force() && node.geometry == VrmlNode::kNone) {
      PlacedFixture effect;
      effect.fixture = std::make_shared<const world::Fixture>(
          world::ForceEffect{reader_.text(from.force()->text()), from.force()->on()});
      node.fixture = kept(std::move(effect));
    }
    std::uint32_t generation = 0;
    if (node.parent != VrmlNode::kNone) {
      VrmlNode& parent = nodes_[std::size_t(node.parent)];
      if (!parent.is_object) return reader_.refuse("a node lies below a scene");
      if (node.is_object) ++parent.children;
      node.is_flat = node.is_flat || parent.is_flat;
      generation = generations_[std::size_t(node.parent)] + 1;
    }
    if (generation > kMostGenerations) reader_.refuse("nodes lie too deep within each other");
    nodes_.push_back(std::move(node));
    generations_.push_back(generation);
  }

  void read_place(const flat::Node& from, VrmlNode& node) {
    const auto numbers = reader_.items<double>(from.matrix());
    if (numbers.empty()) return;
    if (numbers.size() != 12) return reader_.refuse("a node has half a matrix");
    node.parent_from_node.affine() =
        Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(numbers.data());
    node.is_flat = !keeps_volume(node.parent_from_node);
  }

  bool is_bare(const VrmlNode& node) const {
    if (node.parent == VrmlNode::kNone) return false;
    // A viewpoint may have a name for viewers that differs from its object's.
    const bool says_more = !node.name.empty() && node.name != nodes_[std::size_t(node.parent)].name;
    return node.is_object && !says_more && node.def.empty() && node.children == 0 &&
           node.parent_from_node.matrix().isIdentity(0.0);
  }

  void merge() {
    std::vector<std::uint32_t> shapes(nodes_.size(), 0);  // below each node
    for (const VrmlNode& node : nodes_) {
      if (node.geometry != VrmlNode::kNone && node.parent != VrmlNode::kNone)
        ++shapes[std::size_t(node.parent)];
    }
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      VrmlNode& node = nodes_[i];
      const auto self = std::int32_t(i);
      if (node.geometry != VrmlNode::kNone) node.shape_from = self;
      if (node.fixture) node.fixture_from = self;
      if (!is_bare(node)) continue;
      VrmlNode& parent = nodes_[std::size_t(node.parent)];
      if (node.geometry != VrmlNode::kNone) {
        node.is_merged = shapes[std::size_t(node.parent)] == 1 && parent.shape_from == VrmlNode::kNone;
        if (node.is_merged) parent.shape_from = self;
      } else if (node.fixture) {
        node.is_merged = node.fixture->parent_from_fixture.matrix().isIdentity(0.0) &&
                         parent.fixture_from == VrmlNode::kNone;
        if (node.is_merged) parent.fixture_from = self;
      } else if (node.appearance != VrmlNode::kNone) {
        node.is_merged = true;  // a Shape without geometry
        if (parent.appearance_from == VrmlNode::kNone) parent.appearance_from = self;
      }
    }
  }

  const flat::Scene& scene_;
  world::FlatReader& reader_;
  std::vector<VrmlNode> nodes_;
  std::vector<std::uint32_t> generations_;
};

}  // namespace

std::vector<VrmlNode> nodes_of(const flat::Scene& scene, world::FlatReader& reader) {
  return NodeReader(scene, reader).read();
}

}  // namespace icome::files
