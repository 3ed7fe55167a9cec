#pragma once
#include <functional>
#include <string>
#include <vector>

#include "animation/project/project_edit.h"
#include "base/edit_history.h"
#include "interaction/operations/operation.h"

namespace icome::animation {

using interaction::Arguments;
using ProjectHistory = base::EditHistory<Project, ProjectEdit>;

/// The size of a picture (px). Fails with the file's name where it cannot be read.
using SizeOfPicture = std::function<base::Result<Vector2>(const std::string& file)>;
/// The names of the pictures in a folder, relative to the project's, in the order of numbers in names.
using PicturesIn = std::function<base::Result<std::vector<std::string>>(const std::string& folder)>;

/// Fails with a sentence where a sound cannot be read.
using CheckSound = std::function<base::Result<void>(const Sound& sound)>;

/// The disk as tools see it; names are relative to the project's folder.
struct ProjectDisk {
  SizeOfPicture size;
  PicturesIn pictures;
  CheckSound check_sound;
};

/// A project while a tool is used on it.
struct Staging {
  const Project& project;
  const ProjectDisk& disk;
  std::uint64_t next_id;  ///< for new things
  std::string note = {};  ///< a remark for people
};

/// A named tool for animations: the same in scripts and in the window. All that it does is in the edit that
/// it makes.
struct AnimationTool {
  interaction::Operation about;  ///< name, title, group, summary and parameters: px, degrees and frames
  base::Result<ProjectEdit> (*plan)(Staging& staging, const Arguments& arguments);
};

/// All tools, in the order of help.
const std::vector<AnimationTool>& animation_tools();

/// Performs tools on a project that it owns, and undoes and redoes them.
class AnimationRunner {
 public:
  AnimationRunner(Project project, ProjectDisk disk);

  const Project& project() const { return history_.value(); }
  bool can_undo() const { return history_.can_undo(); }
  bool can_redo() const { return history_.can_redo(); }

  /// Performs {"op": NAME, parameters...}. Gives a note for people, mostly empty. A failed one changes
  /// nothing; the sentence begins with the tool's name where there is one.
  base::Result<std::string> perform(const interaction::Value& command);
  /// Applies an edit that was made elsewhere, such as at the end of a drag or a recording, as one step to
  /// undo. Fails as apply_edit().
  base::Result<void> perform(const ProjectEdit& edit) { return history_.perform(edit); }
  /// All that `work` performs is one step to undo.
  void as_one_step(const std::function<void()>& work) { history_.as_one_step(work); }
  /// Steps that can be undone, and those after the first `before` ones made one.
  std::size_t steps() const { return history_.steps(); }
  void join_steps(std::size_t before) { history_.join_steps(before); }
  /// Takes back, or does again, one step; false where there is none.
  bool undo() { return history_.undo(); }
  bool redo() { return history_.redo(); }
  /// Hears each edit that is applied, and may refuse it.
  void set_sink(ProjectHistory::Sink sink) { history_.set_sink(std::move(sink)); }

 private:
  base::Result<std::string> use(const AnimationTool& tool, const interaction::Value::Fields& fields);

  ProjectHistory history_;
  ProjectDisk disk_;
};

// The groups that make up animation_tools().
std::vector<AnimationTool> stage_tools();  // stage, sound, marks
std::vector<AnimationTool> layer_tools();  // layers
std::vector<AnimationTool> cell_tools();   // cells and their pictures
std::vector<AnimationTool> key_tools();    // keys of cells
std::vector<AnimationTool> time_tools();   // moving, copying and thinning keys; frames put in and taken out
std::vector<AnimationTool> constraint_tools();  // joints, distances, chains, paths, axes
std::vector<AnimationTool> hand_tools();        // triangles

}  // namespace icome::animation
