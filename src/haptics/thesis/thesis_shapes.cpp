#include "haptics/thesis/thesis_shapes.h"

#include <utility>

namespace icome::haptics {

base::Result<std::shared_ptr<const ThesisCsgShape>> ThesisCsgShape::create(const geometry::CsgTree& tree) {
  auto renderer = CsgRenderer::create(tree);
  if (!renderer) return tl::unexpected(renderer.error());
  return std::shared_ptr<const ThesisCsgShape>(new ThesisCsgShape(std::move(*renderer)));
}

std::optional<DirectAnswer> ThesisCsgShape::direct_scp(const Vector3& tip, DirectMemory& memory,
                                                       DirectWorkspace& space) const {
  const auto answer = renderer_.scp(tip, memory, space.csg);
  if (!answer) return std::nullopt;
  return DirectAnswer{answer->place, !answer->exhausted};
}

bool ThesisCsgShape::inside(const Vector3& point, DirectWorkspace&) const { return renderer_.inside(point); }

base::Result<std::shared_ptr<const ThesisLoopShape>> ThesisLoopShape::create(
    std::shared_ptr<const geometry::LoopLevels> levels, const LoopRendererSettings& settings) {
  if (!levels->closed())
    return base::fail(
        "the control mesh is open, and the thesis renderer must tell inside from outside: close the mesh or "
        "use the limit renderer");
  return std::shared_ptr<const ThesisLoopShape>(
      new ThesisLoopShape(LoopRenderer(std::move(levels), settings)));
}

std::optional<DirectAnswer> ThesisLoopShape::direct_scp(const Vector3& tip, DirectMemory& memory,
                                                        DirectWorkspace& space) const {
  const LoopRenderer::Answer answer = renderer_.render(tip, space.loop);
  if (!answer.test.inside) {
    memory = DirectMemory::free_at(tip);
    return std::nullopt;
  }
  memory = {answer.scp, tip, true};
  return DirectAnswer{answer.scp, answer.test.complete};
}

bool ThesisLoopShape::inside(const Vector3& point, DirectWorkspace& space) const {
  return renderer_.inside(point, space.loop).inside;
}

}  // namespace icome::haptics
