// Tools that take a stroke at a place and change its curve there: pull and width.
#include <algorithm>
#include <cmath>
#include <optional>

#include "sketch/tools/pull.h"
#include "sketch/tools/retouch.h"
#include "ui/sketch/canvas_tool.h"

namespace icome::ui {
namespace {

/// The place of a stroke that is taken, or would be by a press: shown as a ring.
class CurveTool : public CanvasTool {
 public:
  using CanvasTool::CanvasTool;

  void press(const PenInput& input) override {
    look_for(input.place);
    const drawing::Stroke* const stroke = pick_ ? document().drawing().find(pick_->stroke) : nullptr;
    if (stroke != nullptr) taken_ = *stroke;
    from_ = input;
  }
  void drag(const PenInput& input) override {
    if (!taken_) return;
    now_ = input;
    auto changed = std::make_shared<drawing::Stroke>(*taken_);
    changed->curve = change(taken_->curve, *pick_, from_, input);
    document().try_out(drawing::edit_of(drawing::ReplaceStroke{std::move(changed)}));
    redraw_all();
  }
  void release(const PenInput& input) override {
    taken_.reset();
    document().keep();
    hover(input);
  }
  void hover(const PenInput& input) override {
    look_for(input.place);
    redraw_all();
  }
  void give_up() override {
    taken_.reset();
    CanvasTool::give_up();
  }
  void paint(QPainter& painter, const QRect& /*part*/) override {
    if (!pick_) return;
    constexpr double kRing = 5.0;
    const QPointF at = taken_ && now_ ? shown_at(*pick_, *now_) : view().to_screen(pick_->point);
    painter.setPen(overlay_pen());
    painter.drawEllipse(at, kRing, kRing);
  }

 protected:
  virtual drawing::Curve change(const drawing::Curve& curve, const sketch::Pick& pick, const PenInput& from,
                                const PenInput& now) = 0;
  /// The place on the canvas while it is dragged.
  virtual QPointF shown_at(const sketch::Pick& pick, const PenInput& now) const = 0;
  /// The place at which the curve was taken; none: it is not held.
  std::optional<drawing::Vector2> taken_at() const {
    return taken_ ? std::optional(from_.place) : std::nullopt;
  }

 private:
  void look_for(const drawing::Vector2& place) {
    pick_ = document().index().nearest(place, view().on_paper(kTakenWithin));
    now_.reset();
  }

  std::optional<sketch::Pick> pick_;
  std::optional<drawing::Stroke> taken_;  // as it was; none: nothing is held
  PenInput from_;
  std::optional<PenInput> now_;
};

class PullTool final : public CurveTool {
 public:
  using CurveTool::CurveTool;

  sketch::ToolGrip grip() const override {
    const auto from = taken_at();
    return from ? sketch::ToolGrip{.start = *from, .holding = 1.0} : sketch::ToolGrip{};
  }

 private:
  drawing::Curve change(const drawing::Curve& curve, const sketch::Pick& pick, const PenInput& from,
                        const PenInput& now) override {
    return sketch::pulled(curve, pick.place, now.place - from.place, sketch::PullRule::Exact);
  }
  QPointF shown_at(const sketch::Pick& /*pick*/, const PenInput& now) const override { return now.at; }
};

/// A pen makes the line as wide as it is pressed at most: lightly, narrower. A mouse goes up for wider.
class WidthTool final : public CurveTool {
 public:
  using CurveTool::CurveTool;

  void press(const PenInput& input) override {
    hardest_ = 0.0;
    CurveTool::press(input);
  }

 private:
  static constexpr double kReach = 0.01;        // m along the line on both sides
  static constexpr double kTwiceAsWide = 60.0;  // pixels up
  static constexpr double kMostFactor = 20.0;

  drawing::Curve change(const drawing::Curve& curve, const sketch::Pick& pick, const PenInput& from,
                        const PenInput& now) override {
    hardest_ = std::max(hardest_, now.pressure);
    const double factor = now.is_pen ? 2.0 * hardest_ : std::exp2((from.at.y() - now.at.y()) / kTwiceAsWide);
    return sketch::width_changed(curve, pick.place, std::min(factor, kMostFactor), kReach);
  }
  QPointF shown_at(const sketch::Pick& pick, const PenInput& /*now*/) const override {
    return view().to_screen(pick.point);
  }

  double hardest_ = 0.0;  // pressure since the press
};

}  // namespace

std::unique_ptr<CanvasTool> make_pull_tool(SketchBench& bench) { return std::make_unique<PullTool>(bench); }
std::unique_ptr<CanvasTool> make_width_tool(SketchBench& bench) { return std::make_unique<WidthTool>(bench); }

}  // namespace icome::ui
