#include "sketch/tools/selection.h"

#include <algorithm>
#include <cmath>

#include "geometry/curve/nearest_on_curve.h"
#include "sketch/tools/pick.h"

namespace icome::sketch {
namespace {

std::size_t point_count(const Curve& curve) { return 3 * curve.segments.size() + 1; }

const Vector2& control_point(const Curve& curve, std::size_t number) {
  const std::size_t segment = std::min(number / 3, curve.segments.size() - 1);
  return curve.segments[segment].points[number - 3 * segment];
}

/// Calls visit(stroke) for each stroke that tools may change.
template <typename Visit>
void for_each_stroke(const Drawing& drawing, const Visit& visit) {
  for (const Layer& layer : drawing.layers) {
    if (!can_change(layer)) continue;
    for (const StrokePointer& stroke : layer.strokes) visit(*stroke);
  }
}

/// Chooses what `chosen(curve, number)` says of each control point.
template <typename Chosen>
Selection choose(const Drawing& drawing, const Chosen& chosen) {
  Selection selection;
  for_each_stroke(drawing, [&](const Stroke& stroke) {
    std::vector<bool> points(point_count(stroke.curve));
    bool any = false;
    for (std::size_t i = 0; i < points.size(); ++i) {
      points[i] = chosen(stroke.curve, i);
      any = any || points[i];
    }
    if (any) selection.emplace(stroke.id, std::move(points));
  });
  return selection;
}

bool is_whole(const std::vector<bool>& points) {
  return std::all_of(points.begin(), points.end(), [](bool chosen) { return chosen; });
}

/// Calls visit(stroke, points) for each chosen stroke that is still there.
template <typename Visit>
void for_each_chosen(const Drawing& drawing, const Selection& selection, const Visit& visit) {
  for_each_stroke(drawing, [&](const Stroke& stroke) {
    const auto chosen = selection.find(stroke.id);
    if (chosen != selection.end() && chosen->second.size() == point_count(stroke.curve))
      visit(stroke, chosen->second);
  });
}

}  // namespace

bool is_inside(const Vector2& point, std::span<const Vector2> closed_line, InsideRule rule) {
  int crossings = 0;
  int winding = 0;
  for (std::size_t i = 0; i < closed_line.size(); ++i) {
    const Vector2& a = closed_line[i];
    const Vector2& b = closed_line[(i + 1) % closed_line.size()];
    const bool up = a.y() <= point.y() && b.y() > point.y();
    const bool down = a.y() > point.y() && b.y() <= point.y();
    if (!up && !down) continue;
    const double side = (b.x() - a.x()) * (point.y() - a.y()) - (point.x() - a.x()) * (b.y() - a.y());
    if ((up && side > 0.0) || (down && side < 0.0)) {
      ++crossings;
      winding += up ? 1 : -1;
    }
  }
  return rule == InsideRule::EvenOdd ? crossings % 2 == 1 : winding != 0;
}

Selection inside_lasso(const Drawing& drawing, std::span<const Vector2> lasso, InsideRule rule) {
  Bounds2 box;
  for (const Vector2& point : lasso) box.extend(point);
  return choose(drawing, [&](const Curve& curve, std::size_t number) {
    const Vector2& point = control_point(curve, number);
    return box.contains(point) && is_inside(point, lasso, rule);
  });
}

Selection touched(const Drawing& drawing, std::span<const Vector2> places, double within) {
  Selection selection;
  for_each_stroke(drawing, [&](const Stroke& stroke) {
    const double reach = within + 0.5 * stroke.curve.widest();
    const auto touches = [&](const CubicBezier& segment) {
      return std::any_of(places.begin(), places.end(), [&](const Vector2& place) {
        return segment.hull_bounds().squaredExteriorDistance(place) <= reach * reach &&
               geometry::nearest_on_curve(segment, place).distance_squared <= reach * reach;
      });
    };
    if (std::any_of(stroke.curve.segments.begin(), stroke.curve.segments.end(), touches))
      selection.emplace(stroke.id, std::vector<bool>(point_count(stroke.curve), true));
  });
  return selection;
}

Selection everything(const Drawing& drawing) {
  return choose(drawing, [](const Curve&, std::size_t) { return true; });
}

Selection joined(const Selection& a, const Selection& b) {
  Selection both = a;
  for (const auto& [stroke, points] : b) {
    const auto [known, is_new] = both.emplace(stroke, points);
    if (is_new) continue;
    if (known->second.size() != points.size()) {
      known->second = points;  // the other was chosen before the stroke changed
      continue;
    }
    for (std::size_t i = 0; i < points.size(); ++i) known->second[i] = known->second[i] || points[i];
  }
  return both;
}

DrawingEdit transformed(const Drawing& drawing, const Selection& selection, const Eigen::Affine2d& to_other) {
  DrawingEdit edit;
  for_each_chosen(drawing, selection, [&](const Stroke& stroke, const std::vector<bool>& points) {
    auto moved = std::make_shared<Stroke>(stroke);
    if (is_whole(points)) {
      moved->curve = transformed(stroke.curve, to_other);
    } else {
      for (std::size_t i = 0; i < stroke.curve.segments.size(); ++i)
        for (std::size_t k = 0; k < 4; ++k)
          if (points[3 * i + k])
            moved->curve.segments[i].points[k] = to_other * stroke.curve.segments[i].points[k];
      if (stroke.curve.closed && points.front() != points.back())  // one point that two numbers stand for
        moved->curve.segments.back().points[3] = moved->curve.segments.front().points[0];
    }
    edit.emplace_back(ReplaceStroke{std::move(moved)});
  });
  return edit;
}

Bounds2 bounds_of(const Drawing& drawing, const Selection& selection) {
  Bounds2 box;
  for_each_chosen(drawing, selection, [&](const Stroke& stroke, const std::vector<bool>& points) {
    for (std::size_t i = 0; i < points.size(); ++i)
      if (points[i]) box.extend(control_point(stroke.curve, i));
  });
  return box;
}

std::vector<Vector2> holding_points(const Drawing& drawing, const Selection& selection) {
  std::vector<Vector2> held;
  for_each_chosen(drawing, selection, [&](const Stroke& stroke, const std::vector<bool>& points) {
    const std::size_t joints = stroke.curve.segments.size() + 1;
    for (std::size_t j = 0; j < joints; ++j) {
      if (points[3 * j]) continue;
      const auto any_between = [&](std::size_t from, std::size_t to) {
        for (std::size_t i = from; i <= to; ++i)
          if (points[i]) return true;
        return false;
      };
      if ((j > 0 && any_between(3 * j - 3, 3 * j - 1)) ||
          (j + 1 < joints && any_between(3 * j + 1, 3 * j + 3)))
        held.push_back(control_point(stroke.curve, 3 * j));
    }
  });
  return held;
}

}  // namespace icome::sketch
