#pragma once
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "drawing/shape/drawing_shape.h"
#include "sketch/files/drawing_files.h"
#include "sketch/script/sketch_tool.h"
#include "sketch/tools/pick.h"

namespace icome::ui {

/// The place in a design where the drawing of a window lives: each edit goes there at once.
struct DrawingHome {
  std::string name;                                     ///< of the object, for people
  std::function<const drawing::DrawingShape*()> shape;  ///< null: it is gone
  std::function<base::Result<void>(const drawing::DrawingEdit&)> edit;
};

/// The drawing of a window: what was done to it, its file, and what a drag tries out. All changes go through
/// sketch::SketchRunner, as those of a script do.
class SketchDocument {
 public:
  using Command = interaction::Value;

  SketchDocument();  // an empty page of A4

  /// As it is; as it is seen while something is tried out; as it was before the last change.
  const drawing::Drawing& drawing() const { return runner_->drawing(); }
  const drawing::Drawing& shown() const { return tried_ ? *tried_ : drawing(); }
  const drawing::Drawing& before() const { return tried_ ? drawing() : before_; }
  const sketch::Selection& selection() const { return runner_->selection(); }
  /// The layer that the next stroke goes to if it may; the topmost layer where none was chosen.
  drawing::LayerId layer() const;
  /// Finds strokes of the drawing as it is.
  const sketch::StrokeIndex& index();
  bool can_undo() const { return runner_->can_undo(); }
  bool can_redo() const { return runner_->can_redo(); }

  /// Uses a tool, as a line of a script does. Remarks and refusals are told; false: it was refused.
  bool perform(const Command& command);
  void undo();
  void redo();

  /// Shows what an edit would do, in the place of what was tried out before it.
  void try_out(const drawing::DrawingEdit& edit);
  /// Shows what an edit would do to what is shown, which is tried out, too.
  void try_more(const drawing::DrawingEdit& edit);
  /// Does what was tried out, as one step to undo; nothing where nothing was.
  void keep();
  /// Ends showing what was tried out.
  void give_up();

  const std::filesystem::path& file() const { return file_; }
  bool is_modified() const;
  /// Replaces the drawing by a file's. Gives notes on what was skipped in it.
  base::Result<std::vector<std::string>> open(const std::filesystem::path& file);
  /// Replaces the drawing by one that lives in a design.
  void open(DrawingHome home);
  /// Takes over what others did to the drawing in its design, after which nothing can be undone here. A
  /// drawing that is gone there stays here, and lives on its own.
  void follow_home();
  /// Lets the drawing live on its own.
  void leave_home();
  bool lives_in_design() const { return home_.has_value(); }
  /// The name of the object whose drawing it is; empty for one that lives on its own.
  std::string home_name() const { return home_ ? home_->name : std::string(); }
  /// Writes the drawing as SVG; the file is then the document's own.
  base::Result<void> save(const std::filesystem::path& file);

  /// Called after each change of what is shown, selected or chosen, and of the file.
  void on_change(std::function<void()> change) { changed_ = std::move(change); }
  /// Hears what a tool remarks, or why it refused.
  void on_remark(std::function<void(const std::string&)> remark) { remark_ = std::move(remark); }

 private:
  void take(drawing::Drawing drawing);
  void finish(drawing::Drawing before);

  std::unique_ptr<sketch::SketchRunner> runner_;
  drawing::Drawing before_;
  std::optional<drawing::Drawing> tried_;
  drawing::DrawingEdit trying_;               // what made it of the drawing
  drawing::Drawing saved_;                    // as the file has it
  std::optional<sketch::StrokeIndex> index_;  // none: not made since the last change
  std::optional<DrawingHome> home_;           // none: it lives on its own
  bool sending_ = false;                      // an edit of one's own to its home
  std::filesystem::path file_;                // empty: it has none
  bool is_foreign_ = false;                   // read from a recording, which cannot hold it
  std::function<void()> changed_ = [] {};
  std::function<void(const std::string&)> remark_ = [](const std::string&) {};
};

/// A command of these fields: command("move", {{"by", ...}}).
SketchDocument::Command command(const char* tool, interaction::Value::Fields fields = {});
/// A place (m) as commands have it: mm.
interaction::Value command_place(const drawing::Vector2& place);
/// A colour likewise.
interaction::Value command_colour(const drawing::Colour& colour);

}  // namespace icome::ui
