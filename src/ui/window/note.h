#pragma once
#include <string>
#include <vector>

#include "session/session.h"

namespace icome::ui {

/// Something that a person is told above the scene.
struct Note {
  enum class Weight : std::uint8_t {
    Passing,  // goes by itself
    Plain,
    Warning,
    Error,
  };
  /// What can be done about it with one click.
  enum class Remedy : std::uint8_t {
    Save,
    SaveAs,
    SaveAgain,
    OpenAnother,
    RevertToSaved,   // the file as it was saved, instead of recovered work
    Recover,         // work of `journal`
    DiscardJournal,  // the same
    Open,            // `design`
  };
  Weight weight = Weight::Plain;
  std::string text = {};
  std::string topic = {};  // a later note of the same topic takes its place; empty: none
  std::vector<std::string> details = {};
  std::vector<Remedy> remedies = {};
  std::filesystem::path journal = {};
  std::filesystem::path design = {};
};

/// What is written on the button.
const char* label(Note::Remedy remedy);

/// What is said of something that happened to a session.
Note note_of(const session::SessionEvent& event);

/// Of work that waits to be recovered: "There is work on tables.wrl from 22:14 that was not saved."
Note note_of(const session::RecoverableWork& work);

/// Of work that was recovered: "Recovered your work on tables.wrl from 22:14. Save it to keep it."
Note note_of_recovered(const session::RecoverableWork& work, const std::vector<std::string>& details);

/// Of a design that was not opened, as a person went on with another: "tables.wrl was not opened, as you went
/// on with lamp.wrl. Open it again to have it."
Note note_of_given_up(const std::filesystem::path& design, const std::string& other);

/// The same of work that was to be recovered.
Note note_of_given_up(const session::RecoverableWork& work, const std::string& other);

/// When that was, as people say it where this is written: "22:14", "yesterday 22:14", "17 May, 22:14".
std::string time_text(std::chrono::system_clock::time_point then, std::chrono::system_clock::time_point now);

}  // namespace icome::ui
