#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "interaction/operations/operation.h"
#include "sketch/drawn.h"
#include "sketch/tools/selection.h"

namespace icome::sketch {

using interaction::Arguments;

/// A drawing while a tool is used on it.
struct Drafting {
  const Drawing& drawing;
  std::uint64_t next_id;     ///< for new strokes and layers
  Selection selection = {};  ///< the chosen control points, which tools may change
  LayerId layer = {};        ///< where new strokes go
  std::string note = {};     ///< a remark for people
};

/// A named tool for drawings: the same in scripts and in the window. All that it does is in the edit that it
/// makes and in what it chooses.
struct SketchTool {
  interaction::Operation
      about;  ///< name, title, group, summary and parameters; lengths in mm, without a plan
  base::Result<DrawingEdit> (*plan)(Drafting& drafting, const Arguments& arguments);
};

/// All tools, in the order of help.
const std::vector<SketchTool>& sketch_tools();

/// Performs tools on a drawing that it owns, and undoes and redoes them.
class SketchRunner {
 public:
  explicit SketchRunner(Drawing drawing);

  const Drawing& drawing() const { return history_.value(); }
  const Selection& selection() const { return selection_; }
  /// The layer that new strokes go to: the one that was chosen, or no id where none was.
  LayerId layer() const { return layer_; }
  bool can_undo() const { return history_.can_undo(); }
  bool can_redo() const { return history_.can_redo(); }

  /// Performs {"op": NAME, parameters...}, as icome edit does. Gives a note for people, mostly empty. A
  /// failed one changes nothing; the sentence begins with the tool's name where there is one.
  base::Result<std::string> perform(const interaction::Value& command);
  /// Applies an edit that was made elsewhere, such as at the end of a drag, as one step to undo. Fails as
  /// apply_edit().
  base::Result<void> perform(const DrawingEdit& edit) { return history_.perform(edit); }
  /// Hears each edit that is applied, and may refuse it (DrawingHistory::Sink).
  void set_sink(DrawingHistory::Sink sink) { history_.set_sink(std::move(sink)); }

 private:
  base::Result<std::string> use(const SketchTool& tool, const interaction::Value::Fields& fields);

  DrawingHistory history_;
  Selection selection_;
  LayerId layer_;
};

// The groups that make up sketch_tools().
std::vector<SketchTool> drawing_tools();
std::vector<SketchTool> shaping_tools();
std::vector<SketchTool> selection_tools();
std::vector<SketchTool> stroke_tools();
std::vector<SketchTool> layer_tools();

}  // namespace icome::sketch
