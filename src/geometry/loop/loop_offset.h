#pragma once
#include <memory>

#include "geometry/loop/loop_tile_sweep.h"
#include "geometry/loop/loop_tiles.h"
#include "geometry/smooth_surface.h"

namespace icome::geometry {

class LoopSurface;

/// The places of a ball's centre while it touches a Loop surface: the surface at the ball's radius. A piece
/// has the places at which the ball touches one tile of the surface (LoopTiles): the tile's offset along its
/// normals and, where the surface ends or bends sharply, tubes around edges and balls around corners, which
/// need no extra work: nearest places of a tile may lie on its border. Where the surface curves in more than
/// the ball, offsets run into each other, and the pieces of both hold. Pieces from count / 2 on are the same
/// tiles, touched from behind. A sheet's rim is rolled round from one side to the other.
///
/// The ball never comes nearer than its radius to a place of a tile that is `tame`. The others are small:
/// there it may come nearer by about 1e-5 of its radius; for degenerate tiles, which are not cut for ever,
/// nothing is proved.
///
/// Immutable; its points are places of the centre.
class LoopOffset final : public SmoothSurface {
 public:
  /// For a ball of this radius (m, > 0). Fails, with the reason as a clause, where the surface bends so much
  /// that it falls into too many tiles.
  static base::Result<std::shared_ptr<const LoopOffset>> create(std::shared_ptr<const LoopSurface> surface,
                                                                double radius);

  double radius() const { return radius_; }
  std::uint32_t tile_count() const { return tiles_.count(); }

  Bounds bounds() const override;
  void near(const Vector3& a, const Vector3& b, double reach, double time, PieceVisitor visit) const override;
  /// Is the centre where it cannot be: in the solid, or nearer than the radius to the surface (of a sheet, to
  /// its front)?
  bool inside(const Vector3& point, double time = 0.0) const override;
  std::optional<SurfacePlace> way_out(const Vector3& point, double time) const override;
  std::optional<SurfaceHit> first_hit(std::uint32_t piece, const Vector3& start, const Vector3& step,
                                      bool from_behind, double time, double slack) const override;
  SurfacePlace nearest_local(const SurfacePlace& from, const Vector3& goal, double time) const override;
  bool covers(const SurfacePlace& place, const Vector3& above, double time, double slack) const override;
  bool same(std::uint32_t one, std::uint32_t other) const override;
  std::size_t bytes() const override;

 private:
  /// A contact of the ball with the surface: the touched place, and the direction to the centre from there.
  struct Contact {
    LoopSpot spot;
    Vector3 place;  // m, on the surface
    Vector3 out;    // unit, towards the centre
  };

  LoopOffset(std::shared_ptr<const LoopSurface> surface, LoopTiles tiles, double radius);

  std::uint32_t tile_of(std::uint32_t piece) const { return piece % tiles_.count(); }
  LoopSide side_of(std::uint32_t piece) const {
    return piece < tiles_.count() ? LoopSide::Front : LoopSide::Back;
  }
  SurfacePlace centre_of(const Contact& contact, LoopSide side) const;
  Contact contact_of(const SurfacePlace& from) const;
  bool holds(const LoopSpot& spot, const Vector3& out, LoopSide side) const;
  std::optional<Contact> contact_towards(const LoopSpot& from, const Vector3& goal, LoopSide side) const;
  std::optional<SurfacePlace> pushed_out(const Vector3& point) const;

  std::shared_ptr<const LoopSurface> surface_;
  LoopTiles tiles_;
  double radius_;
};

}  // namespace icome::geometry
