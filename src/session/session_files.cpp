#include <fmt/format.h>

#include <utility>

#include "collab/client/integration.h"
#include "files/design.h"
#include "session/session_parts.h"
#include "world/motion.h"

namespace icome::session {
namespace {

std::vector<std::string> sentences(const std::vector<files::Remark>& remarks,
                                   const std::filesystem::path& design) {
  std::vector<std::string> result;
  for (const files::Remark& it : remarks) result.push_back(files::sentence(it, design.filename().string()));
  return result;
}

std::string shown_name(const std::filesystem::path& design) {
  return design.empty() ? "A design without a name" : design.filename().string();
}

}  // namespace

/// Takes in a design that was read, or the reason why there is none.
void SessionParts::take_opened(DesignLoader::Outcome& outcome) {
  const std::shared_ptr<ClaimedWork> work = std::exchange(recovering, nullptr);
  const std::shared_ptr<JoinedDesign> joined = std::exchange(joining, nullptr);
  const std::string name = shown_name(outcome.design);
  if (!outcome.result) {
    tell(SessionEvent::Kind::OpenCancelled, fmt::format("{} was not opened: it was cancelled.", name));
  } else if (!*outcome.result) {
    tell(SessionEvent::Kind::OpenFailed, outcome.result->error().message);
  } else {
    files::LoadedDesign& loaded = **outcome.result;
    std::vector<std::string> details = sentences(loaded.remarks, outcome.design);
    if (joined) {
      open_world(std::move(loaded.world), {});
      joined->connection ? begin_sharing(std::move(*joined)) : take_kept_copy(*joined);
    } else {
      saver.has_read(outcome.design, loaded.stamp);
      open_world(std::move(loaded.world), outcome.design, work);
    }
    if (work) {
      tell(SessionEvent::Kind::Recovered,
           fmt::format("{}: your unsaved work was recovered. Save it to keep it.", name), std::move(details));
    } else {
      const std::size_t moving = world::moving_objects(world).size();
      const std::string motions = moving == 0 ? ""
                                  : moving == 1
                                      ? " One object of it can move by itself."
                                      : fmt::format(" {} objects of it can move by themselves.", moving);
      tell(SessionEvent::Kind::Opened, fmt::format("{} was opened ({}).{}", name, loaded.format, motions),
           std::move(details));
    }
  }
}

void SessionParts::tell_of_saved(const DesignSaver::Outcome& outcome,
                                 const std::vector<std::string>& missing) {
  const std::string name = shown_name(outcome.design);
  if (missing.empty()) {
    tell(SessionEvent::Kind::Saved, fmt::format("{} was saved.", name),
         sentences(*outcome.result, outcome.design));
  } else {
    tell(SessionEvent::Kind::SavedInPart,
         fmt::format(
             "{} was written, but cannot hold all of your design, which still counts as changed: save it "
             "as .icome, too.",
             name),
         missing);
  }
}

void SessionParts::take_saved(DesignSaver::Outcome& outcome) {
  const std::uint64_t revision = saving_revisions.front();
  saving_revisions.pop_front();
  if (!outcome.result) {
    tell(outcome.asks ? SessionEvent::Kind::SaveAsks : SessionEvent::Kind::SaveFailed,
         outcome.result.error().message);
    return;
  }
  std::vector<std::string> missing;
  for (const files::Remark& it : *outcome.result)
    if (it.loses) missing.push_back(files::sentence(it, outcome.design.filename().string()));
  tell_of_saved(outcome, missing);
  // It is of a design that is not open any more.
  if (outcome.number < opened_number) return;
  if (shared) return;  // a copy: the design is on the server
  path = outcome.design;
  left_out = std::move(missing);
  if (left_out.empty()) saved_revision = revision;
  Edited edited;
  edited.saved = std::make_shared<const SavedWork>(
      SavedWork{.design = outcome.design, .number = outcome.number, .in_part = !left_out.empty()});
  queue.post(std::move(edited));
}

/// Puts a design that was read into this one.
void SessionParts::take_integrated(DesignLoader::Outcome& outcome) {
  const std::string name = shown_name(outcome.design);
  if (!outcome.result || !*outcome.result) {
    const std::string why = outcome.result ? outcome.result->error().message : name + ": it was cancelled.";
    return tell(SessionEvent::Kind::IntegrateFailed, why);
  }
  const files::LoadedDesign& loaded = **outcome.result;
  const world::ObjectId parent = world.find(integrate_under) ? integrate_under : world::ObjectId{};
  const world::Edit edit = collab::integration_of(loaded.world, world, parent, ids);
  const auto done = SessionHistory(*this).perform(edit, "Integrate " + name);
  if (!done) return tell(SessionEvent::Kind::IntegrateFailed, done.error().message);
  tell(SessionEvent::Kind::Integrated, fmt::format("{} was put into the design.", name),
       sentences(loaded.remarks, outcome.design));
}

void SessionParts::take_files() {
  if (auto read = integrator.poll()) take_integrated(*read);
  if (auto opened = loader.poll()) take_opened(*opened);
  while (auto saved = saver.poll()) take_saved(*saved);
  if (!journal) return;
  if (const auto news = journal->news())
    tell(news->keeping ? SessionEvent::Kind::AutosaveResumed : SessionEvent::Kind::AutosaveFailed,
         news->text);
}

/// Ends all saving, so that work that is written by now is not kept against crashes, too.
void SessionParts::finish_saving() {
  while (saver.busy()) {
    saver.wait();
    while (auto saved = saver.poll()) take_saved(*saved);
  }
}

void SessionFiles::make_new() {
  parts_.loader.cancel();
  parts_.take_files();
  parts_.open_world({}, {});
}

void SessionFiles::open(const std::filesystem::path& design) {
  parts_.recovering.reset();
  parts_.joining.reset();
  parts_.loader.open(design);
}

void SessionFiles::cancel_open() { parts_.loader.cancel(); }

void SessionFiles::integrate(const std::filesystem::path& design, world::ObjectId parent) {
  parts_.integrate_under = parent;
  parts_.integrator.open(design);
}

bool SessionFiles::integrating() const { return parts_.integrator.part().has_value(); }

std::optional<double> SessionFiles::opening() const { return parts_.loader.part(); }

void SessionFiles::save(const std::filesystem::path& design, bool anyway) {
  if (!parts_.saver.can_save()) {
    parts_.tell(SessionEvent::Kind::SaveFailed,
                fmt::format("{} was not saved, as {} saves before it are still being written: try again in a "
                            "moment.",
                            shown_name(design), DesignSaver::kMostWaiting));
    return;
  }
  parts_.saving_revisions.push_back(parts_.revisions.now());
  parts_.saver.save(design, parts_.world, parts_.queue.posted(),
                    anyway ? DesignSaver::Replace::Anyway : DesignSaver::Replace::Safely);
}

bool SessionFiles::saving() const { return parts_.saver.busy(); }

const std::filesystem::path& SessionFiles::path() const { return parts_.path; }

bool SessionFiles::modified() const {
  if (parts_.shared) {
    const bool is_lost = !parts_.shared->kept && parts_.shared->talk().replica().unacknowledged() > 0;
    return parts_.history.trying() || is_lost;
  }
  return parts_.revisions.now() != parts_.saved_revision || !parts_.left_out.empty();
}

const std::vector<std::string>& SessionFiles::left_out() const { return parts_.left_out; }

void SessionFiles::close() {
  parts_.leave_shared();
  if (parts_.journal) parts_.journal->close();
}

std::vector<RecoverableWork> SessionFiles::recoverable() const {
  const std::filesystem::path& folder = parts_.settings.autosave_folder;
  return folder.empty() ? std::vector<RecoverableWork>{} : find_recoverable_work(folder);
}

void SessionFiles::recover(const RecoverableWork& work) {
  const auto claimed = ClaimedWork::claim(work);
  if (!claimed) {
    parts_.tell(SessionEvent::Kind::OpenFailed, claimed.error().message);
    return;
  }
  parts_.loader.start(work.design, [work = *claimed](const files::DesignReadOptions& options) {
    return work->read(options);
  });
  parts_.joining.reset();
  parts_.recovering = *claimed;
}

void SessionFiles::discard(const RecoverableWork& work) {
  // Work that another program has claimed in the meantime is left to it.
  if (const auto claimed = ClaimedWork::claim(work)) (*claimed)->discard();
}

}  // namespace icome::session
