#include <optional>

#include "sketch/tools/connect.h"
#include "ui/sketch/canvas_tool.h"

namespace icome::ui {
namespace {

constexpr double kAttracts = 18.0;  // pixels: M of thesis 4.16
constexpr double kEndRing = 6.0;    // pixels

/// Drags an end of a stroke to another end, which attracts it; to the other one of its own, and the curve is
/// closed.
class ConnectTool final : public CanvasTool {
 public:
  using CanvasTool::CanvasTool;

  void press(const PenInput& input) override {
    hover(input);
    held_ = end_;
    end_.reset();
  }

  void drag(const PenInput& input) override {
    if (!held_) return;
    end_ = sketch::nearest_end(document().drawing(), input.place, view().on_paper(kAttracts), held_);
    const drawing::Stroke* const stroke = document().drawing().find(held_->stroke);
    if (stroke == nullptr) return;
    auto changed = std::make_shared<drawing::Stroke>(*stroke);
    changed->curve = sketch::end_moved(stroke->curve, held_->is_last, end_ ? end_->place : input.place);
    if (end_ && end_->stroke == held_->stroke)
      changed->curve = sketch::closed(changed->curve, view().on_paper(kAttracts));
    document().try_out(drawing::edit_of(drawing::ReplaceStroke{std::move(changed)}));
    redraw_all();
  }

  void release(const PenInput& input) override {
    held_.reset();
    document().keep();
    hover(input);
  }

  void hover(const PenInput& input) override {
    end_ = sketch::nearest_end(document().drawing(), input.place, view().on_paper(kAttracts));
    redraw_all();
  }

  void give_up() override {
    held_.reset();
    CanvasTool::give_up();
  }

  void paint(QPainter& painter, const QRect& /*part*/) override {
    painter.setPen(overlay_pen());
    if (end_) painter.drawEllipse(view().to_screen(end_->place), kEndRing, kEndRing);
  }

  sketch::ToolGrip grip() const override {
    if (!held_ || !end_) return {};
    return {.end = end_->place, .within = view().on_paper(kAttracts)};
  }

 private:
  std::optional<sketch::StrokeEnd> held_;
  std::optional<sketch::StrokeEnd> end_;  // that a press would take, or that the held one goes to
};

/// Fills the curve that goes around the place, else the stroke that is near; with Shift, empties it.
class FillTool final : public CanvasTool {
 public:
  using CanvasTool::CanvasTool;

  void press(const PenInput& input) override {
    auto stroke = sketch::enclosing(document().drawing(), input.place);
    if (!stroke) {
      if (const auto near = document().index().nearest(input.place, view().on_paper(kTakenWithin)))
        stroke = near->stroke;
    }
    if (!stroke) return;
    interaction::Value::Fields fields = {{"stroke", double(stroke->value)}};
    if (!(input.modifiers & Qt::ShiftModifier)) fields.emplace_back("colour", command_colour(look().fill));
    document().perform(command("fill", std::move(fields)));
  }
  void drag(const PenInput& /*input*/) override {}
  void release(const PenInput& /*input*/) override {}
};

}  // namespace

std::unique_ptr<CanvasTool> make_connect_tool(SketchBench& bench) {
  return std::make_unique<ConnectTool>(bench);
}
std::unique_ptr<CanvasTool> make_fill_tool(SketchBench& bench) { return std::make_unique<FillTool>(bench); }

}  // namespace icome::ui
