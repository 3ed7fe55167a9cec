#pragma once
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "animation/files/project_file.h"
#include "animation/motion/constraints.h"
#include "animation/picture/stage_picture.h"
#include "animation/record/posing.h"
#include "animation/script/animation_tool.h"
#include "ui/cutout/document/key_edits.h"

namespace icome::ui {

using animation::CellStates;

/// The part of a document that has changed.
enum class CutoutChange : std::uint8_t {
  Project,    // anything of it, and all below
  Frame,      // the present frame, and so what is shown
  Pose,       // cells that are moved and not keyed yet
  Selection,  // cells or keys that are selected
};

/// The animation of a window: what was done to it, its file and its journal, the present frame, what is
/// selected, and what a drag or a hand tries out. All changes go through animation::AnimationRunner, as those
/// of a script do.
class CutoutDocument {
 public:
  CutoutDocument();  // an empty stage
  ~CutoutDocument();
  CutoutDocument(const CutoutDocument&) = delete;
  CutoutDocument& operator=(const CutoutDocument&) = delete;

  const animation::Project& project() const { return runner_->project(); }
  animation::CellPictures& pictures() { return *pictures_; }
  const animation::ProjectDisk& disk() const { return disk_; }

  int frame() const { return frame_; }
  /// Goes to a frame; to the first or the last one for those beyond.
  void go_to(int frame);
  int last_frame() const { return project().stage.length - 1; }

  /// Cells that are selected, those that are there; the last one leads.
  const std::vector<CellId>& selection() const { return selection_; }
  bool is_selected(CellId cell) const;
  void select(std::vector<CellId> cells);
  /// The cell that leads the selection; null where none is selected.
  const animation::Cell* leading() const;
  /// Keys that are selected.
  const KeyPlaces& keys() const { return keys_; }
  void select_keys(KeyPlaces keys);

  /// All cells at the present frame, with what is tried out.
  const CellStates& shown() const { return shown_; }
  /// All cells at the present frame by their keys.
  CellStates keyed() const;
  /// Shows cells as hands wish them, and the others as `from` has them; none: as they are shown. They obey
  /// the constraints: what hangs on them moves, too, and they themselves only go where they can. Cells of
  /// locked layers stay. True: what is shown has changed.
  bool try_out(std::vector<animation::Hold> holds, const CellStates* from = nullptr);
  /// Keys what was tried out, as one step to undo; nothing where nothing was, or while it is recorded.
  bool keep();
  /// Ends showing what was tried out.
  void give_up();
  const std::optional<CellStates>& tried() const { return tried_; }

  /// Takes down what is tried out at each frame, of one layer or, where it is none, of all.
  /// Hands that hold cells hear of it as of another frame, so that these are held from the first frame on.
  void begin_recording(std::optional<animation::LayerId> layer);
  bool is_recording() const { return recording_.has_value(); }
  /// Puts what was taken down into the animation, as one step to undo. Keys that make less of a difference
  /// than `tolerance` (px) are left out.
  void end_recording(double tolerance);

  /// Uses a tool, as a line of a script does. Remarks and refusals are told; false: it was refused.
  bool perform(const interaction::Value& command);
  /// Likewise, but tells nothing: gives a note for people, mostly empty, or why it was refused.
  base::Result<std::string> attempt(const interaction::Value& command);
  /// Applies an edit as one step to undo; an empty one is none. Refusals are told; false: it was refused.
  bool perform(const animation::ProjectEdit& edit);
  /// All that `work` performs is one step to undo.
  void as_one_step(const std::function<void()>& work) { runner_->as_one_step(work); }
  bool can_undo() const { return runner_->can_undo(); }
  bool can_redo() const { return runner_->can_redo(); }
  void undo();
  void redo();
  /// Steps that can be undone, and those after the first `before` ones made one, as of a key that is held.
  std::size_t steps() const { return runner_->steps(); }
  void join_steps(std::size_t before) { runner_->join_steps(before); }
  /// Numbers for new layers, cells and constraints of one edit.
  std::uint64_t next_id() const { return project().next_id; }

  /// The folder that names of files count from: that of its file, else the present one.
  std::filesystem::path folder() const;
  /// A file's name as the project has it: relative where it has a folder and the file lies in or near it.
  std::string name_in_project(const std::filesystem::path& file) const;

  const std::filesystem::path& file() const { return file_; }
  bool is_modified() const;
  /// The outcome of opening a file.
  struct Opened {
    std::string note;           // about the journal, for people; mostly empty
    std::size_t recovered = 0;  // edits that were not saved, and were taken up again
  };
  /// Replaces the project by a file's, with what its journal adds after a crash: not that of another window
  /// in which the file is open, nor one of this window itself, whose work is given up.
  base::Result<Opened> open(std::filesystem::path file);
  /// Takes an unsaved animation from where it was kept for a crash, as one without a file.
  base::Result<void> recover(const std::filesystem::path& kept);
  /// Why writing to a file could take away the work of others, as a sentence: it is not as it was read or
  /// saved here, or it is open in another window. Empty: it could not.
  std::string reason_not_to_write(const std::filesystem::path& file) const;
  /// Writes the project; the file is then the document's own, and names of pictures count from its folder.
  base::Result<void> save(std::filesystem::path file);
  /// Ends the journal: all is saved, or given up.
  void close();
  /// Likewise, for the last time: nothing is kept for a crash any more.
  void close_for_good();

  void on_change(std::function<void(CutoutChange)> change) { changed_ = std::move(change); }
  /// Hears what a tool remarks, or why something was refused.
  void on_remark(std::function<void(const std::string&)> remark) { remark_ = std::move(remark); }
  void remark(const std::string& text) const { remark_(text); }
  /// Hears why what is done is not safe from a crash, which matters until it is read; an empty text when it
  /// is safe again.
  void on_risk(std::function<void(const std::string&)> risk) { risk_ = std::move(risk); }

 private:
  void use_folder(const std::filesystem::path& folder);
  void take(animation::Project project, const std::filesystem::path& folder);
  base::Result<void> write_down(const animation::ProjectEdit& edit);
  void write_line(const animation::ProjectEdit& edit, animation::ProjectJournal::Line line);
  void write_part();
  void begin_journal(std::uint64_t length);
  bool is_own(const std::filesystem::path& file) const;
  void keep_for_recovery();
  void take_down(const std::vector<animation::Hold>& holds);
  void forget_gone();
  void finish();

  std::unique_ptr<animation::AnimationRunner> runner_;
  std::unique_ptr<animation::CellPictures> pictures_;
  animation::ProjectDisk disk_;
  animation::Project saved_;  // as the file has it
  std::optional<animation::ProjectJournal> journal_;
  std::filesystem::path kept_;  // the stand-in for a file while there is none; empty: not kept yet
  bool told_journal_ = false;   // a person knows that it cannot be written
  bool closed_ = false;         // for good
  std::filesystem::path file_;  // empty: it has none
  std::uint64_t hash_ = 0;      // of the file's text, as it was read or saved last
  int frame_ = 0;
  std::vector<CellId> selection_;
  KeyPlaces keys_;
  CellStates shown_;
  std::optional<CellStates> tried_;
  std::optional<animation::Recording> recording_;
  int part_from_ = 0;       // frame at which the journal's next part of the recording begins
  bool has_parts_ = false;  // in the journal, whose recording is not written as a whole yet
  std::function<void(CutoutChange)> changed_ = [](CutoutChange) {};
  std::function<void(const std::string&)> remark_ = [](const std::string&) {};
  std::function<void(const std::string&)> risk_ = [](const std::string&) {};
};

/// A command of these fields: cutout_command("join", {{"parent", ...}}).
interaction::Value cutout_command(const char* tool, interaction::Value::Fields fields = {});
/// A place (px) and a list of texts as commands have them.
interaction::Value command_point(const base::Vector2& place);
interaction::Value command_texts(const std::vector<std::string>& texts);

/// Animations that were never saved and whose window is gone without being closed: kept for being recovered.
std::vector<std::filesystem::path> lost_animations();
/// Gives one up.
void forget_lost_animation(const std::filesystem::path& kept);

}  // namespace icome::ui
