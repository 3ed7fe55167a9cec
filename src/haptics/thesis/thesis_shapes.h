#pragma once
#include <memory>

#include "base/result.h"
#include "geometry/csg/csg_tree.h"
#include "geometry/loop/loop_levels.h"
#include "haptics/thesis/direct_shape.h"

namespace icome::haptics {

/// A CSG tree as thesis section 5.5 renders it. A plain primitive is a tree of one leaf.
class ThesisCsgShape final : public DirectShape {
 public:
  /// Fails when the tree's sub-normal form is too large.
  static base::Result<std::shared_ptr<const ThesisCsgShape>> create(const geometry::CsgTree& tree);

  Bounds bounds() const override { return renderer_.bounds(); }
  std::optional<DirectAnswer> direct_scp(const Vector3& tip, DirectMemory& memory,
                                         DirectWorkspace& space) const override;
  bool inside(const Vector3& point, DirectWorkspace& space) const override;
  std::size_t bytes() const override { return sizeof(*this) + renderer_.bytes(); }

  const CsgRenderer& renderer() const { return renderer_; }

 private:
  explicit ThesisCsgShape(CsgRenderer renderer) : renderer_(std::move(renderer)) {}

  CsgRenderer renderer_;
};

/// A Loop surface as thesis sections 5.4.2 and 5.4.3 render it. Shares the levels.
class ThesisLoopShape final : public DirectShape {
 public:
  /// Fails when the surface is open, as it must tell inside from outside.
  static base::Result<std::shared_ptr<const ThesisLoopShape>> create(
      std::shared_ptr<const geometry::LoopLevels> levels, const LoopRendererSettings& settings = {});

  Bounds bounds() const override { return bounds_; }
  std::optional<DirectAnswer> direct_scp(const Vector3& tip, DirectMemory& memory,
                                         DirectWorkspace& space) const override;
  bool inside(const Vector3& point, DirectWorkspace& space) const override;
  std::size_t bytes() const override { return sizeof(*this) + renderer_.bytes(); }

  const LoopRenderer& renderer() const { return renderer_; }

 private:
  explicit ThesisLoopShape(LoopRenderer renderer)
      : renderer_(std::move(renderer)), bounds_(renderer_.levels().bounds()) {}

  LoopRenderer renderer_;
  Bounds bounds_;
};

}  // namespace icome::haptics
