#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "cutout/tracker/edges/colour_classes.h"
#include "cutout/tracker/edges/rectifier.h"
#include "cutout/tracker/pose/triangle_shape.h"

namespace icome::cutout {

/// The frame's evidence about places on a triangle's outline. A place is supported by an edge from red to
/// blue, contradicted by red within or by an edge that lies elsewhere, beside blue beyond where blue goes on
/// outside, and otherwise unknown: skin and other things hide it.
struct OutlineEvidence {
  int places = 0, supported = 0, contradicted = 0, blue_beyond = 0;
  std::array<int, 3> places_of{}, supported_of{};  ///< the same by edges
  double rms = 0;                                  ///< of supported places from the outline, pixels

  double support() const { return places ? double(supported) / places : 0.0; }
  double contradiction() const { return places ? double(contradicted) / places : 0.0; }
  double beyond() const { return places ? double(blue_beyond) / places : 0.0; }
  /// Edges of which at least `least` places are supported.
  int edges_with(int least) const {
    return (supported_of[0] >= least) + (supported_of[1] >= least) + (supported_of[2] >= least);
  }
};

/// A triangle that may lie over the edges of another.
struct Neighbour {
  const TriangleShape* shape;
  Placed placed;
};

/// Knowledge of a pose before a frame is looked at: it draws the pose to itself by so much.
struct PosePrior {
  double place = 3;    ///< standard deviation, mm
  double turn = 0.05;  ///< rad
};

/// The least-squares fit of a triangle to the edges of a frame about it.
struct OutlineFitted {
  Placed placed;
  OutlineEvidence evidence;
  base::Matrix3 information = base::Matrix3::Zero();  ///< of x, y (mm) and turn, by the edges alone
  /// Pixels by which all three edges lie within the outline, alike; none where they do not, or too little is
  /// seen.
  std::optional<double> inwards = std::nullopt;
};

/// Measures triangles in a frame: along rows and columns through their outlines, to sub-pixel.
class OutlineFit {
 public:
  OutlineFit(const Rectifier& rectifier, const ColourClasses& colours)
      : rectifier_(&rectifier), colours_(&colours) {}

  /// The frame that is looked at from now on.
  void look_at(const FrameView& frame) { frame_ = frame; }

  /// Colours at few places 3.5 pixels to both sides of the outline.
  OutlineEvidence glance(const TriangleShape& shape, const Placed& placed) const;

  /// Moves a triangle to the edges within `window` pixels (4 to kMostWindow) of where it is, then within 3.
  OutlineFitted fit(const TriangleShape& shape, const Placed& from, double window, const PosePrior& prior,
                    std::span<const Neighbour> neighbours = {});

  /// Pixels by which outlines are seen farther out than triangles are: what colours that a camera keeps at
  /// half the size (4:2:0), a list that is not exact, or unusual blur do to all of them alike. 0 at first.
  double spread() const { return spread_; }
  void set_spread(double pixels) { spread_ = pixels; }

  /// Pixels of the supported places of the last fit().
  const std::vector<Vector2>& supported_pixels() const { return supported_pixels_; }

  static constexpr int kMostWindow = 24;

 private:
  enum class Outcome : std::uint8_t { Supported, Contradicted, BlueBeyond, Unknown };
  struct Sample {
    Vector2 place;  // mm, of the edge that was found
    Vector2 pixel;  // of the same
    double residual;
    int edge;
    Outcome outcome;
    bool near;  // by colours close to it, as other things lie about: less can be relied on
  };
  struct EdgeInFrame {
    Vector2 start, middle, end;  // pixels
    Vector2 inward;              // unit vector in pixels, at the middle
    double length;               // pixels
    double from, to;             // shares of the edge that its corners leave undisturbed
  };

  EdgeInFrame edge_in_frame(const TriangleShape& shape, const std::array<Vector2, 3>& corners,
                            const std::array<Vector2, 3>& corner_pixels, std::size_t edge,
                            double clearance) const;
  void measure(const TriangleShape& shape, const Placed& placed, int window, double spacing,
               std::span<const Neighbour> neighbours);
  Outcome cross(const Vector2& predicted, const Vector2& inward, const Vector2& tangent, int window,
                float level, Vector2& found, bool& near) const;
  bool solve(const TriangleShape& shape, Placed& placed, const Placed& from, double reach, int rounds,
             const PosePrior& prior, base::Matrix3& information);
  std::optional<double> common_inwards();
  void judge(const TriangleShape& shape, const Placed& placed, OutlineEvidence& evidence);
  ColourClass class_at(double x, double y) const;

  const Rectifier* rectifier_;
  const ColourClasses* colours_;
  FrameView frame_;
  double spread_ = 0;              // pixels
  double pixel_ = 1;               // mm, about the triangle at hand
  std::array<double, 3> walls_{};  // mm that each edge is seen farther out, as the wall below it is blue too
  std::vector<Sample> samples_;
  std::vector<double> residuals_;  // of one edge, pixels
  std::vector<Vector2> supported_pixels_;
};

}  // namespace icome::cutout
