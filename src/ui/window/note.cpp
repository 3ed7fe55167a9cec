#include "ui/window/note.h"

#include <fmt/format.h>

#include <QDateTime>
#include <QLocale>

namespace icome::ui {

using session::SessionEvent;
using Weight = Note::Weight;
using Remedy = Note::Remedy;

namespace {

std::string design_of(const session::RecoverableWork& work) {
  if (work.design.empty()) return "a design that was never saved";
  return work.design.filename().string();
}

/// All notes on one device share a topic: what it says now takes the place of what it said before.
std::string device_topic(const SessionEvent& event) { return "device " + event.device; }

/// "1 thing was", "2 things were".
std::string counted_sentence(std::size_t count, const char* one, const char* many) {
  return count == 1 ? fmt::format(" 1 {}.", one) : fmt::format(" {} {}.", count, many);
}

}  // namespace

const char* label(Remedy remedy) {
  switch (remedy) {
    case Remedy::Save:
      return "Save";
    case Remedy::SaveAs:
      return "Save As\u2026";
    case Remedy::SaveAgain:
      return "Try Again";
    case Remedy::OpenAnother:
      return "Open Another\u2026";
    case Remedy::RevertToSaved:
      return "Open the Saved One";
    case Remedy::Recover:
      return "Recover";
    case Remedy::DiscardJournal:
      return "Discard";
    case Remedy::Open:
      return "Open";
    case Remedy::Choose:
      return "Choose\u2026";
  }
  return "";
}

Note note_of(const SessionEvent& event) {
  Note note{.text = event.text, .details = event.details};
  // Notes on a file share a topic: they go when the next file is opened or saved.
  switch (event.kind) {
    case SessionEvent::Kind::Opened:
      note.topic = "file";
      note.weight = event.details.empty() ? Weight::Passing : Weight::Plain;
      if (!event.details.empty()) {
        note.text += counted_sentence(event.details.size(), "thing in it was skipped or put right",
                                      "things in it were skipped or put right");
      }
      break;
    case SessionEvent::Kind::OpenFailed:
      note.topic = "file";
      note.weight = Weight::Error;
      note.remedies = {Remedy::OpenAnother};
      break;
    case SessionEvent::Kind::OpenCancelled:
      note.topic = "file";
      note.weight = Weight::Passing;
      break;
    case SessionEvent::Kind::Saved:
      note.topic = "file";
      note.weight = event.details.empty() ? Weight::Passing : Weight::Plain;
      break;
    case SessionEvent::Kind::SavedInPart:
      note.topic = "file";
      note.weight = Weight::Warning;
      note.text += counted_sentence(event.details.size(), "thing cannot be kept in this format",
                                    "things cannot be kept in this format");
      note.remedies = {Remedy::SaveAs};
      break;
    case SessionEvent::Kind::SaveAsks:
      note.topic = "file";
      note.weight = Weight::Warning;
      note.remedies = {Remedy::SaveAs};
      break;
    case SessionEvent::Kind::SaveFailed:
      note.topic = "file";
      note.weight = Weight::Error;
      note.remedies = {Remedy::SaveAgain, Remedy::SaveAs};
      break;
    case SessionEvent::Kind::Recovered:
      note.topic = "file";
      note.remedies = {Remedy::Save};
      break;
    case SessionEvent::Kind::AutosaveFailed:
      note.topic = "autosave";
      note.weight = Weight::Warning;
      note.remedies = {Remedy::Save};
      break;
    case SessionEvent::Kind::AutosaveResumed:
      note.topic = "autosave";
      note.weight = Weight::Passing;
      break;
    case SessionEvent::Kind::DeviceLost:
      note.topic = device_topic(event);
      note.weight = Weight::Warning;
      break;
    case SessionEvent::Kind::DeviceBack:
      note.topic = device_topic(event);
      note.weight = Weight::Passing;
      break;
    case SessionEvent::Kind::Integrated:
      note.topic = "integrate";
      note.weight = event.details.empty() ? Weight::Passing : Weight::Plain;
      break;
    case SessionEvent::Kind::IntegrateFailed:
      note.topic = "integrate";
      note.weight = Weight::Error;
      break;
    case SessionEvent::Kind::ServerLost:
      note.topic = "server";
      note.weight = Weight::Warning;
      break;
    case SessionEvent::Kind::ServerBack:
      note.topic = "server";
      note.weight = Weight::Passing;
      break;
    case SessionEvent::Kind::SharingEnds:
      note.topic = "sharing ends";
      note.weight = Weight::Error;
      note.remedies = {Remedy::SaveAs};
      break;
    case SessionEvent::Kind::Floor:
      note.topic = "floor";
      break;
    case SessionEvent::Kind::Conflicts:
      note.topic = "conflicts";
      note.weight = Weight::Warning;
      note.remedies = {Remedy::Choose};
      break;
    case SessionEvent::Kind::Dropped:
      note.topic = event.text;
      note.weight = Weight::Warning;
      break;
    case SessionEvent::Kind::NotAsItIs:
      note.topic = "not as it is";
      note.weight = Weight::Plain;
      break;
    case SessionEvent::Kind::Notice:
      note.topic = event.device.empty() ? event.text : device_topic(event);
      break;
  }
  return note;
}

Note note_of(const session::RecoverableWork& work) {
  return {.text = fmt::format("There is work on {} from {} that was not saved.", design_of(work),
                              time_text(work.changed, std::chrono::system_clock::now())),
          .topic = work.journal.string(),
          .remedies = {Remedy::Recover, Remedy::DiscardJournal},
          .journal = work.journal};
}

Note note_of_recovered(const session::RecoverableWork& work, const std::vector<std::string>& details) {
  Note note{.text = fmt::format("Recovered your work on {} from {}. Save it to keep it.", design_of(work),
                                time_text(work.changed, std::chrono::system_clock::now())),
            .topic = "file",
            .details = details,
            .remedies = {Remedy::Save}};
  if (!work.design.empty()) note.remedies.push_back(Remedy::RevertToSaved);
  return note;
}

Note note_of_given_up(const std::filesystem::path& design, const std::string& other) {
  return {.text = fmt::format("{} was not opened, as you went on with {}. Open it again to have it.",
                              design.filename().string(), other),
          .topic = "file",
          .remedies = {Remedy::Open},
          .design = design};
}

Note note_of_given_up(const session::RecoverableWork& work, const std::string& other) {
  return {
      .text = fmt::format("Your work on {} was not recovered, as you went on with {}. Recover it to have it.",
                          design_of(work), other),
      .topic = work.journal.string(),
      .remedies = {Remedy::Recover, Remedy::DiscardJournal},
      .journal = work.journal};
}

std::string time_text(std::chrono::system_clock::time_point then, std::chrono::system_clock::time_point now) {
  const auto local = [](std::chrono::system_clock::time_point time) {
    return QDateTime::fromSecsSinceEpoch(std::chrono::system_clock::to_time_t(time));
  };
  const QDateTime date = local(then), today = local(now);
  const QString clock = date.toString("HH:mm");
  const qint64 days = date.date().daysTo(today.date());
  if (days == 0) return clock.toStdString();
  if (days == 1) return "yesterday " + clock.toStdString();
  const QString format = date.date().year() == today.date().year() ? "d MMMM" : "d MMMM yyyy";
  return (QLocale::c().toString(date, format) + ", " + clock).toStdString();
}

}  // namespace icome::ui
