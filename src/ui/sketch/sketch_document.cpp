#include "ui/sketch/sketch_document.h"

#include <algorithm>
#include <utility>

namespace icome::ui {
namespace {

constexpr double kCommandMm = 1000.0;  // mm in a m

drawing::Drawing empty_page() {
  drawing::Drawing page;
  page.layers.push_back({.id = page.next_layer_id(), .name = "Layer 1", .strokes = {}});
  return page;
}

bool is_same_stroke(const drawing::StrokePointer& a, const drawing::StrokePointer& b) {
  return a == b || *a == *b;
}

/// Is it the same drawing, stroke by stroke?
bool is_same(const drawing::Drawing& a, const drawing::Drawing& b) {
  return a.size == b.size &&
         std::equal(a.layers.begin(), a.layers.end(), b.layers.begin(), b.layers.end(),
                    [](const drawing::Layer& one, const drawing::Layer& other) {
                      return one.id == other.id && one.name == other.name && one.visible == other.visible &&
                             one.locked == other.locked &&
                             std::ranges::equal(one.strokes, other.strokes, is_same_stroke);
                    });
}

}  // namespace

SketchDocument::SketchDocument() { take(empty_page()); }

void SketchDocument::take(drawing::Drawing drawing) {
  saved_ = drawing;
  before_ = drawing;
  runner_ = std::make_unique<sketch::SketchRunner>(std::move(drawing));
  tried_.reset();
  trying_.clear();
  index_.reset();
  if (!home_) return;
  runner_->set_sink([this](const drawing::DrawingEdit& edit) {
    sending_ = true;
    const auto done = home_->edit(edit);
    sending_ = false;
    return done;
  });
}

drawing::LayerId SketchDocument::layer() const {
  for (const drawing::Layer& layer : drawing().layers)
    if (layer.id == runner_->layer()) return layer.id;
  return drawing().layers.empty() ? drawing::LayerId{} : drawing().layers.back().id;
}

const sketch::StrokeIndex& SketchDocument::index() {
  if (!index_) index_.emplace(drawing());
  return *index_;
}

/// After a change that may have left the drawing as it was.
void SketchDocument::finish(drawing::Drawing before) {
  tried_.reset();
  trying_.clear();
  if (!is_same(before, drawing())) {
    before_ = std::move(before);
    index_.reset();
  }
  changed_();
}

bool SketchDocument::perform(const Command& command) {
  drawing::Drawing before = drawing();
  const auto done = runner_->perform(command);
  finish(std::move(before));
  remark_(done ? *done : done.error().message);
  return done.has_value();
}

void SketchDocument::undo() {
  if (can_undo()) perform(command("undo"));
}

void SketchDocument::redo() {
  if (can_redo()) perform(command("redo"));
}

void SketchDocument::try_out(const drawing::DrawingEdit& edit) {
  tried_ = drawing();
  trying_.clear();
  try_more(edit);
}

void SketchDocument::try_more(const drawing::DrawingEdit& edit) {
  if (!tried_) tried_ = drawing();
  if (const auto done = drawing::apply_edit(*tried_, edit); !done) return remark_(done.error().message);
  trying_.insert(trying_.end(), edit.begin(), edit.end());
  changed_();
}

void SketchDocument::keep() {
  const drawing::DrawingEdit edit = std::exchange(trying_, {});
  if (edit.empty()) return give_up();
  drawing::Drawing before = drawing();
  const auto done = runner_->perform(edit);
  finish(std::move(before));
  if (!done) remark_(done.error().message);
}

void SketchDocument::give_up() {
  if (!tried_) return;
  tried_.reset();
  trying_.clear();
  changed_();
}

bool SketchDocument::is_modified() const {
  if (home_) return false;
  return is_foreign_ || !is_same(saved_, drawing());
}

base::Result<std::vector<std::string>> SketchDocument::open(const std::filesystem::path& file) {
  auto read = sketch::read_drawing(file, {});
  if (!read) return tl::unexpected(read.error());
  home_.reset();
  take(std::move(read->drawing));
  is_foreign_ = !sketch::check_can_write_drawing(file);
  file_ = is_foreign_ ? std::filesystem::path() : file;
  changed_();
  return std::move(read->notes);
}

void SketchDocument::open(DrawingHome home) {
  const drawing::DrawingShape* const shape = home.shape();
  if (!shape) return;
  home_ = std::move(home);
  file_.clear();
  is_foreign_ = false;
  take(shape->drawing());
  changed_();
}

void SketchDocument::follow_home() {
  if (!home_ || sending_) return;
  const drawing::DrawingShape* const shape = home_->shape();
  if (!shape) return leave_home();
  if (is_same(shape->drawing(), drawing())) return;
  take(shape->drawing());
  changed_();
  remark_("The drawing was changed in its design.");
}

void SketchDocument::leave_home() {
  if (!home_) return;
  const std::string name = home_->name;
  home_.reset();
  runner_->set_sink({});
  is_foreign_ = true;
  changed_();
  remark_("\"" + name + "\" is no longer in the design: what you draw stays here alone.");
}

base::Result<void> SketchDocument::save(const std::filesystem::path& file) {
  auto written = sketch::write_drawing(drawing(), file, {}, drawing::SvgLines::Outlines);
  if (!written) return written;
  if (home_) return {};  // a copy
  saved_ = drawing();
  file_ = file;
  is_foreign_ = false;
  changed_();
  return {};
}

SketchDocument::Command command(const char* tool, interaction::Value::Fields fields) {
  fields.insert(fields.begin(), {"op", tool});
  return fields;
}

interaction::Value command_place(const drawing::Vector2& place) {
  return interaction::Value::List{kCommandMm * place.x(), kCommandMm * place.y()};
}

interaction::Value command_colour(const drawing::Colour& colour) {
  return interaction::Value::List{double(colour[0]), double(colour[1]), double(colour[2])};
}

}  // namespace icome::ui
