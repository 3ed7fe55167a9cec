#pragma once
#include <string>
#include <vector>

#include "session/session.h"

namespace icome::ui {

/// A message to a person, above the scene.
struct Note {
  enum class Weight : std::uint8_t {
    Passing,  // disappears by itself
    Plain,
    Warning,
    Error,
  };
  /// A remedy that a button of the note offers.
  enum class Remedy : std::uint8_t {
    Save,
    SaveAs,
    SaveAgain,
    OpenAnother,
    RevertToSaved,   // the file as it was saved, instead of recovered work
    Recover,         // the work of `journal`
    DiscardJournal,  // of the work of `journal`
    Open,            // `design`
    Choose,          // for conflicts
  };
  Weight weight = Weight::Plain;
  std::string text = {};
  std::string topic = {};  // a later note of the same topic takes its place; empty: none
  std::vector<std::string> details = {};
  std::vector<Remedy> remedies = {};
  std::filesystem::path journal = {};
  std::filesystem::path design = {};
};

/// Topics of what is of use only while a shared design is open.
inline constexpr const char* kSharingTopics[] = {"server", "conflicts", "floor"};

/// Text of the button of a remedy.
const char* label(Note::Remedy remedy);

/// The note on an event of a session.
Note note_of(const session::SessionEvent& event);

/// The note on work to be recovered: "There is work on tables.wrl from 22:14 that was not saved."
Note note_of(const session::RecoverableWork& work);

/// The note on recovered work: "Recovered your work on tables.wrl from 22:14. Save it to keep it."
Note note_of_recovered(const session::RecoverableWork& work, const std::vector<std::string>& details);

/// The note on a design that was not opened, as a person went on with another: "tables.wrl was not opened, as
/// you went on with lamp.wrl. Open it again to have it."
Note note_of_given_up(const std::filesystem::path& design, const std::string& other);

/// The note on work that was not recovered, as a person went on with another design.
Note note_of_given_up(const session::RecoverableWork& work, const std::string& other);

/// A time in words for people at `now`: "22:14", "yesterday 22:14", "17 May, 22:14".
std::string time_text(std::chrono::system_clock::time_point then, std::chrono::system_clock::time_point now);

}  // namespace icome::ui
