#include "ui/cutout/document/cutout_document.h"

#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <QStandardPaths>
#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <system_error>
#include <utility>

#include "animation/files/file_names.h"
#include "animation/picture/project_disk.h"
#include "ui/actions/recent_files.h"

namespace icome::ui {
namespace {

namespace fs = std::filesystem;
using animation::Cell;
using animation::Layer;
using animation::Project;
using animation::ProjectEdit;

fs::path folder_of_unsaved() {
  return path_of(QStandardPaths::writableLocation(QStandardPaths::AppDataLocation)) / "unsaved-animations";
}

/// A place for an unsaved animation that no other window of any program has.
fs::path place_for_unsaved() {
  static int number = 0;
  return folder_of_unsaved() / fmt::format("{}-{}.cutout", ::getpid(), ++number);
}

/// Does the program live that has kept an animation there?
bool is_in_use(const fs::path& kept) {
  const std::string name = kept.filename().string();
  int process = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), process);
  return error == std::errc() && process > 0 && (::kill(process, 0) == 0 || errno == EPERM);
}

}  // namespace

CutoutDocument::CutoutDocument() { take(Project(), fs::current_path()); }

CutoutDocument::~CutoutDocument() = default;

void CutoutDocument::use_folder(const fs::path& folder) {
  pictures_ = std::make_unique<animation::CellPictures>(
      folder, animation::CellPictureOptions{.reach = animation::Reach::Anywhere});
}

void CutoutDocument::take(Project project, const fs::path& folder) {
  saved_ = project;
  use_folder(folder);
  // Asks for the pictures each time, as another folder has others.
  disk_ = {
      .size = [this](const std::string& picture) { return animation::disk_of(*pictures_).size(picture); },
      .pictures = [this](const std::string& name) { return animation::disk_of(*pictures_).pictures(name); },
      .check_sound =
          [this](const animation::Sound& sound) {
            return animation::disk_of(*pictures_).check_sound(sound);
          }};
  runner_ = std::make_unique<animation::AnimationRunner>(std::move(project), disk_);
  runner_->set_sink([this](const ProjectEdit& edit) { return write_down(edit); });
  selection_.clear();
  keys_.clear();
  tried_.reset();
  recording_.reset();
  has_parts_ = false;
  frame_ = 0;
  told_journal_ = false;
  shown_ = keyed();
}

/// An edit that cannot be written down is done anyway: a full disk must not keep a person from working on.
base::Result<void> CutoutDocument::write_down(const ProjectEdit& edit) {
  using Line = animation::ProjectJournal::Line;
  const bool ends_parts = !recording_ && std::exchange(has_parts_, false);
  write_line(edit, ends_parts ? Line::Whole : Line::Edit);
  return {};
}

void CutoutDocument::write_line(const ProjectEdit& edit, animation::ProjectJournal::Line line) {
  if (!journal_ && !closed_ && file_.empty() && kept_.empty()) keep_for_recovery();
  if (!journal_) return;
  const auto added = journal_->add(edit, line);
  if (!added && !std::exchange(told_journal_, true))
    risk_(fmt::format("{} What you do is no longer safe from a crash: save it.", added.error().message));
}

/// Keeps what was recorded so far against a crash.
void CutoutDocument::write_part() {
  part_from_ = frame_;
  const ProjectEdit part = recording_->next_part();
  if (part.empty()) return;
  write_line(part, animation::ProjectJournal::Line::Part);
  has_parts_ = true;
}

void CutoutDocument::begin_journal(std::uint64_t length) {
  journal_.reset();
  const fs::path& file = file_.empty() ? kept_ : file_;
  const bool is_elsewhere = animation::ProjectJournal::is_open(file);
  auto journal = animation::ProjectJournal::open(file, length);
  told_journal_ = !journal;
  if (journal) {
    journal_.emplace(std::move(*journal));
    return risk_({});
  }
  if (is_elsewhere)
    return risk_(
        fmt::format("{} is open in another window already. What is done here is not kept against a "
                    "crash, and saving asks first.",
                    file.filename().string()));
  risk_(fmt::format("{} What you do is not safe from a crash: save it often.", journal.error().message));
}

/// Gives an animation without a file a place where it outlives a crash.
void CutoutDocument::keep_for_recovery() {
  kept_ = place_for_unsaved();
  std::error_code error;
  fs::create_directories(kept_.parent_path(), error);
  if (const auto written = animation::write_project_file(saved_, kept_); written) begin_journal(0);
}

CellStates CutoutDocument::keyed() const { return animation::states_at(project(), frame_); }

void CutoutDocument::go_to(int frame) {
  frame = std::clamp(frame, 0, std::max(0, last_frame()));
  if (frame == frame_) return;
  frame_ = frame;
  tried_.reset();
  shown_ = keyed();
  changed_(CutoutChange::Frame);
}

bool CutoutDocument::is_selected(CellId cell) const {
  return std::ranges::find(selection_, cell) != selection_.end();
}

void CutoutDocument::select(std::vector<CellId> cells) {
  std::erase_if(cells, [this](CellId cell) { return project().find(cell) == nullptr; });
  if (cells == selection_) return;
  selection_ = std::move(cells);
  changed_(CutoutChange::Selection);
}

const Cell* CutoutDocument::leading() const {
  return selection_.empty() ? nullptr : project().find(selection_.back());
}

void CutoutDocument::select_keys(KeyPlaces keys) {
  if (keys == keys_) return;
  keys_ = std::move(keys);
  changed_(CutoutChange::Selection);
}

bool CutoutDocument::try_out(std::vector<animation::Hold> holds, const CellStates* from) {
  std::erase_if(holds, [this](const animation::Hold& hold) { return is_locked(project(), hold.cell); });
  const CellStates before = shown_;
  CellStates states = from ? *from : before;
  for (const animation::Hold& hold : holds) states[hold.cell] = hold.wish;
  tried_ = animation::solved(project(), states, holds, &before).states;
  shown_ = *tried_;
  if (recording_) take_down(holds);
  if (shown_ == before) return false;
  changed_(CutoutChange::Pose);
  return true;
}

/// Cells in hands, and those that they move.
void CutoutDocument::take_down(const std::vector<animation::Hold>& holds) {
  const CellStates still = keyed();
  CellStates moved;
  for (const auto& [cell, state] : shown_) {
    const auto before = still.find(cell);
    const bool is_held = std::ranges::find(holds, cell, &animation::Hold::cell) != holds.end();
    if (is_held || before == still.end() || !(before->second == state)) moved.emplace(cell, state);
  }
  recording_->take(frame_, moved);
  if (std::abs(frame_ - part_from_) >= project().stage.rate) write_part();
}

void CutoutDocument::begin_recording(std::optional<animation::LayerId> layer) {
  give_up();
  recording_.emplace(project(), layer);
  part_from_ = frame_;
  changed_(CutoutChange::Frame);
}

void CutoutDocument::end_recording(double tolerance) {
  if (!recording_) return;
  const ProjectEdit edit = recording_->finish(tolerance);
  recording_.reset();
  give_up();
  if (edit.empty()) return remark_("Nothing was moved, so nothing was recorded.");
  perform(edit);
}

bool CutoutDocument::keep() {
  if (!tried_) return true;
  if (recording_) {
    write_part();
    give_up();
    return true;
  }
  const ProjectEdit edit = animation::keyed_pose(project(), frame_, *tried_);
  if (edit.empty()) {
    give_up();
    return true;
  }
  return perform(edit);
}

void CutoutDocument::give_up() {
  if (!tried_) return;
  tried_.reset();
  shown_ = keyed();
  changed_(CutoutChange::Pose);
}

/// Cells and keys that are gone are no longer selected.
void CutoutDocument::forget_gone() {
  std::erase_if(selection_, [this](CellId cell) { return project().find(cell) == nullptr; });
  std::erase_if(keys_, [this](const KeyPlace& place) {
    const Cell* const cell = project().find(place.cell);
    return cell == nullptr ||
           animation::key_at(cell->tracks[std::size_t(place.channel)], place.frame) == nullptr;
  });
}

void CutoutDocument::finish() {
  tried_.reset();
  frame_ = std::clamp(frame_, 0, std::max(0, last_frame()));
  forget_gone();
  shown_ = keyed();
  changed_(CutoutChange::Project);
}

base::Result<std::string> CutoutDocument::attempt(const interaction::Value& command) {
  auto done = runner_->perform(command);
  finish();
  return done;
}

bool CutoutDocument::perform(const interaction::Value& command) {
  const auto done = attempt(command);
  remark_(done ? *done : done.error().message);
  return done.has_value();
}

bool CutoutDocument::perform(const ProjectEdit& edit) {
  if (edit.empty()) return true;
  const auto done = runner_->perform(edit);
  finish();
  if (!done) remark_(done.error().message);
  return done.has_value();
}

void CutoutDocument::undo() {
  if (runner_->undo()) finish();
}

void CutoutDocument::redo() {
  if (runner_->redo()) finish();
}

fs::path CutoutDocument::folder() const { return pictures_->folder(); }

std::string CutoutDocument::name_in_project(const fs::path& file) const {
  return file_.empty() ? fs::absolute(file).lexically_normal().string()
                       : animation::name_from(folder(), file);
}

bool CutoutDocument::is_modified() const { return !(saved_ == project()); }

bool CutoutDocument::is_own(const fs::path& file) const {
  std::error_code error;
  return !file_.empty() && (file == file_ || fs::equivalent(file, file_, error));
}

base::Result<CutoutDocument::Opened> CutoutDocument::open(fs::path file) {
  auto read = animation::read_project_file(file);
  if (!read) return tl::unexpected(read.error());
  const bool leaves_journal = is_own(file) || animation::ProjectJournal::is_open(file);
  if (leaves_journal) {
    if (read->as_saved) read->project = *std::exchange(read->as_saved, std::nullopt);
    read->recovered = read->journal_length = 0;
    read->note.clear();
  }
  close();
  const fs::path folder = fs::absolute(file).parent_path();
  take(std::move(read->project), folder);
  if (read->as_saved) saved_ = std::move(*read->as_saved);
  file_ = std::move(file);
  hash_ = read->hash;
  begin_journal(read->journal_length);
  changed_(CutoutChange::Project);
  return Opened{std::move(read->note), read->recovered};
}

base::Result<void> CutoutDocument::recover(const fs::path& kept) {
  auto read = animation::read_project_file(kept);
  if (!read) return tl::unexpected(read.error());
  close();
  take(std::move(read->project), fs::current_path());
  saved_ = Project();
  kept_ = kept;
  begin_journal(read->journal_length);
  changed_(CutoutChange::Project);
  return {};
}

std::string CutoutDocument::reason_not_to_write(const fs::path& file) const {
  const std::string name = file.filename().string();
  std::error_code error;
  if (is_own(file) && fs::exists(file, error) && animation::hash_of_file(file) != hash_)
    return fmt::format("{} was changed by another program since it was opened or saved here.", name);
  const bool has_journal = journal_ && is_own(file);
  if (!has_journal && animation::ProjectJournal::is_open(file))
    return fmt::format("{} is open in another window, too.", name);
  return {};
}

base::Result<void> CutoutDocument::save(fs::path file) {
  const fs::path folder = fs::absolute(file).parent_path();
  const ProjectEdit names = animation::renamed_files(this->project(), this->folder(), folder);
  Project project = this->project();
  if (const auto applied = animation::apply_edit(project, names); !applied)
    return tl::unexpected(applied.error());
  auto written = animation::write_project_file(project, file);
  if (!written) return written;
  const bool had_file = !file_.empty();
  const std::uint64_t hash = animation::hash_of_text(animation::project_text(project));
  close();
  file_ = std::move(file);  // before anything is done, which would be kept for a crash without it
  hash_ = hash;
  if (had_file && !names.empty()) {
    // Earlier steps had other names, and undoing them would bring these back.
    const int frame = frame_;
    take(std::move(project), folder);
    go_to(frame);
  } else {
    use_folder(folder);
    if (!names.empty()) (void)runner_->perform(names);
    saved_ = std::move(project);
  }
  begin_journal(0);
  finish();
  return {};
}

void CutoutDocument::close() {
  if (journal_) journal_->remove();
  journal_.reset();
  if (!kept_.empty()) {
    std::error_code error;
    fs::remove(kept_, error);
  }
  kept_.clear();
  file_.clear();
}

void CutoutDocument::close_for_good() {
  close();
  closed_ = true;
}

interaction::Value cutout_command(const char* tool, interaction::Value::Fields fields) {
  fields.insert(fields.begin(), {"op", tool});
  return fields;
}

interaction::Value command_point(const base::Vector2& place) {
  return interaction::Value::List{place.x(), place.y()};
}

interaction::Value command_texts(const std::vector<std::string>& texts) {
  interaction::Value::List list;
  for (const std::string& text : texts) list.emplace_back(text);
  return list;
}

std::vector<fs::path> lost_animations() {
  std::vector<fs::path> lost;
  std::error_code error;
  for (fs::directory_iterator it(folder_of_unsaved(), error), end; !error && it != end; it.increment(error))
    if (it->path().extension() == ".cutout" && !is_in_use(it->path())) lost.push_back(it->path());
  std::ranges::sort(lost);
  return lost;
}

void forget_lost_animation(const fs::path& kept) {
  std::error_code error;
  fs::remove(kept, error);
  fs::remove(animation::journal_of(kept), error);
}

}  // namespace icome::ui
