#include <fmt/format.h>

#include <utility>

#include "files/design.h"
#include "session/session_parts.h"
#include "session/stage.h"

namespace icome::session {
namespace {

std::vector<std::string> sentences(const std::vector<files::Remark>& remarks,
                                   const std::filesystem::path& design) {
  std::vector<std::string> result;
  for (const files::Remark& it : remarks) result.push_back(files::sentence(it, design.filename().string()));
  return result;
}

}  // namespace

void Session::make_new() {
  cancel_open();
  parts_->open_world({}, {}, base::Pose::Identity());
}

void Session::open(const std::filesystem::path& design) {
  auto loaded = files::read_design(design);
  if (!loaded) {
    parts_->tell(SessionEvent::Kind::OpenFailed, loaded.error().message);
    return;
  }
  parts_->open_world(std::move(loaded->world), design, session::stage_from_world(stands_on_z(design)));
  parts_->tell(SessionEvent::Kind::Opened, fmt::format("{} was opened.", design.filename().string()),
               sentences(loaded->remarks, design));
}

void Session::cancel_open() {}

std::optional<double> Session::opening() const { return std::nullopt; }

void Session::save(const std::filesystem::path& design) {
  const auto written = files::write_design(design, parts_->world);
  if (!written) {
    parts_->tell(SessionEvent::Kind::SaveFailed, written.error().message);
    return;
  }
  parts_->path = design;
  parts_->saved_revision = parts_->revisions.now();
  parts_->tell(SessionEvent::Kind::Saved, fmt::format("{} was saved.", design.filename().string()),
               sentences(*written, design));
}

bool Session::saving() const { return false; }

const std::filesystem::path& Session::path() const { return parts_->path; }

bool Session::modified() const { return parts_->revisions.now() != parts_->saved_revision; }

void Session::close() {}

std::vector<RecoverableWork> Session::recoverable() const { return {}; }

void Session::recover(const RecoverableWork&) {}

void Session::discard(const RecoverableWork&) {}

}  // namespace icome::session
