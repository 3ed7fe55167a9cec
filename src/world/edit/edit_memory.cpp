#include "world/edit/edit_memory.h"

#include "world/motion.h"

namespace icome::world {
namespace {

std::size_t memory_of_fixture(const FixturePointer& fixture) {
  const auto* const inert = std::get_if<Inert>(fixture.get());
  return inert ? sizeof(Inert) + inert->source.size() : 0;
}

std::size_t memory_of_motion(const MotionPointer& motion) { return motion ? bytes_of(*motion) : 0; }

/// Memory that an edit holds outside of itself, bytes.
struct HeldMemory {
  std::size_t operator()(const CreateObject& it) const {
    return it.object.name.size() + memory_of_fixture(it.object.fixture) + memory_of_motion(it.object.motion);
  }
  std::size_t operator()(const RenameObject& it) const { return it.name.size(); }
  std::size_t operator()(const ChangeFixture& it) const { return memory_of_fixture(it.fixture); }
  std::size_t operator()(const ChangeMotion& it) const { return memory_of_motion(it.motion); }
  std::size_t operator()(const CreateGeometry& it) const { return it.shape->bytes(); }
  std::size_t operator()(const ReplaceGeometry& it) const { return it.shape->bytes(); }
  std::size_t operator()(const MoveVertices& it) const {
    return it.vertices.size() * sizeof(std::uint32_t) + it.positions.size() * sizeof(Vector3);
  }
  std::size_t operator()(const AmendGeometry& it) const { return it.change.size(); }
  std::size_t operator()(const CreateMaterial& it) const { return it.material.name.size(); }
  std::size_t operator()(const ChangeMaterial& it) const { return it.material.name.size(); }
  std::size_t operator()(const CreateTexture& it) const { return it.texture.bytes->size(); }
  std::size_t operator()(const CreateScene& it) const { return it.name.size(); }
  std::size_t operator()(const RenameScene& it) const { return it.name.size(); }
  std::size_t operator()(const EditGroup& it) const {
    std::size_t bytes = 0;
    for (const Edit& edit : it.edits) bytes += memory_of(edit);
    return bytes;
  }
  template <typename Other>
  std::size_t operator()(const Other&) const {
    return 0;
  }
};

}  // namespace

std::size_t memory_of(const Edit& edit) { return sizeof(Edit) + std::visit(HeldMemory(), edit.what); }

}  // namespace icome::world
