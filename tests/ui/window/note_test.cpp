#include "ui/window/note.h"

#include <gtest/gtest.h>

#include <QDateTime>

namespace icome::ui {
namespace {

using Kind = session::SessionEvent::Kind;

std::chrono::system_clock::time_point local_time(int year, int month, int day, int hour, int minute) {
  const QDateTime time(QDate(year, month, day), QTime(hour, minute));
  return std::chrono::system_clock::from_time_t(time.toSecsSinceEpoch());
}

TEST(TimeText, IsAsShortAsPeopleSayIt) {
  const auto now = local_time(2026, 3, 12, 9, 5);
  EXPECT_EQ(time_text(local_time(2026, 3, 12, 7, 14), now), "07:14");
  EXPECT_EQ(time_text(local_time(2026, 3, 11, 22, 14), now), "yesterday 22:14");
  EXPECT_EQ(time_text(local_time(2026, 1, 2, 22, 14), now), "2 January, 22:14");
  EXPECT_EQ(time_text(local_time(2025, 5, 17, 22, 14), now), "17 May 2025, 22:14");
}

TEST(Note, OfWhatWentWrongSaysWhatToDo) {
  const Note open = note_of({.kind = Kind::OpenFailed, .text = "a.wrl:3: no."});
  EXPECT_EQ(open.weight, Note::Weight::Error);
  EXPECT_EQ(open.text, "a.wrl:3: no.");
  EXPECT_EQ(open.remedies, std::vector{Note::Remedy::OpenAnother});
  const Note save = note_of({.kind = Kind::SaveFailed, .text = "The disk is full."});
  EXPECT_EQ(save.weight, Note::Weight::Error);
  EXPECT_EQ(save.remedies, (std::vector{Note::Remedy::SaveAgain, Note::Remedy::SaveAs}));
}

TEST(Note, OfWhatWentWellGoesByItself) {
  EXPECT_EQ(note_of({.kind = Kind::Saved, .text = "Saved."}).weight, Note::Weight::Passing);
  EXPECT_EQ(note_of({.kind = Kind::DeviceBack, .text = "Back."}).weight, Note::Weight::Passing);
}

TEST(Note, CountsRemarksAndStaysForThem) {
  const Note one = note_of({.kind = Kind::Opened, .text = "a.wrl was opened.", .details = {"A Script."}});
  EXPECT_EQ(one.weight, Note::Weight::Plain);
  EXPECT_EQ(one.text, "a.wrl was opened. 1 thing in it was skipped or put right.");
  const Note two = note_of({.kind = Kind::Opened, .text = "a.wrl was opened.", .details = {"A.", "B."}});
  EXPECT_EQ(two.text, "a.wrl was opened. 2 things in it were skipped or put right.");
  const Note saved =
      note_of({.kind = Kind::SavedInPart, .text = "a.stl was written.", .details = {"A.", "B."}});
  EXPECT_EQ(saved.text, "a.stl was written. 2 things cannot be kept in this format.");
}

TEST(Note, OfOneTopicFollowsAnother) {
  EXPECT_EQ(note_of({.kind = Kind::DeviceLost, .text = ""}).topic, note_of({.kind = Kind::DeviceBack}).topic);
  const Note lost = note_of({.kind = Kind::DeviceLost, .text = "", .device = "left"});
  EXPECT_EQ(note_of({.kind = Kind::DeviceBack, .device = "left"}).topic, lost.topic);
  EXPECT_EQ(note_of({.kind = Kind::Notice, .text = "It is hot", .device = "left"}).topic, lost.topic);
  EXPECT_NE(note_of({.kind = Kind::DeviceLost, .device = "right"}).topic, lost.topic);
  EXPECT_EQ(note_of({.kind = Kind::AutosaveFailed}).topic, note_of({.kind = Kind::AutosaveResumed}).topic);
  EXPECT_NE(note_of({.kind = Kind::Notice, .text = "a"}).topic,
            note_of({.kind = Kind::Notice, .text = "b"}).topic);
}

TEST(Note, OfRecoverableWorkNamesDesignAndTime) {
  const auto now = std::chrono::system_clock::now();
  const Note named = note_of({.journal = "/a/1.icome", .design = "/b/tables.wrl", .changed = now});
  EXPECT_EQ(named.text, "There is work on tables.wrl from " + time_text(now, now) + " that was not saved.");
  EXPECT_EQ(named.journal, "/a/1.icome");
  EXPECT_EQ(named.remedies, (std::vector{Note::Remedy::Recover, Note::Remedy::DiscardJournal}));
  const Note untitled = note_of({.journal = "/a/2.icome", .changed = now});
  EXPECT_NE(untitled.text.find("a design that was never saved"), std::string::npos);
}

TEST(Note, OfRecoveredWorkNamesDesignAndTime) {
  const auto now = std::chrono::system_clock::now();
  const Note note = note_of_recovered({.design = "/b/tables.wrl", .changed = now}, {"A."});
  EXPECT_EQ(note.text,
            "Recovered your work on tables.wrl from " + time_text(now, now) + ". Save it to keep it.");
  EXPECT_EQ(note.remedies, (std::vector{Note::Remedy::Save, Note::Remedy::RevertToSaved}));
  EXPECT_EQ(note.details.size(), 1U);
  // There is no file to go back to.
  EXPECT_EQ(note_of_recovered({.changed = now}, {}).remedies, std::vector{Note::Remedy::Save});
}

TEST(Note, OfWhatWasGivenUpOffersItAgain) {
  const Note design = note_of_given_up("/b/tables.wrl", "lamp.wrl");
  EXPECT_EQ(design.text,
            "tables.wrl was not opened, as you went on with lamp.wrl. Open it again to have it.");
  EXPECT_EQ(design.design, "/b/tables.wrl");
  EXPECT_STREQ(label(design.remedies.at(0)), "Open");
  const Note work = note_of_given_up({.journal = "/a/1.icome", .design = "/b/tables.wrl"}, "lamp.wrl");
  EXPECT_EQ(
      work.text,
      "Your work on tables.wrl was not recovered, as you went on with lamp.wrl. Recover it to have it.");
  EXPECT_EQ(work.journal, "/a/1.icome");
  EXPECT_EQ(work.remedies.at(0), Note::Remedy::Recover);
}

}  // namespace
}  // namespace icome::ui
