#include "ui/cutout/document/cutout_files.h"

#include <QAbstractButton>
#include <QFileDialog>
#include <QLabel>
#include <QLineEdit>
#include <QMessageBox>
#include <QPlainTextEdit>
#include <fstream>

#include "ui/cutout/cutout_stage.h"

namespace icome::ui {
namespace {

class CutoutFilesTest : public CutoutStage {
 protected:
  CutoutFiles& files() { return window_->files(); }
  QMessageBox* question(const char* name) {
    QCoreApplication::processEvents();
    QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    return window_->findChild<QMessageBox*>(name);
  }
  void answer(const char* name, const QString& words) {
    QMessageBox* const box = question(name);
    ASSERT_TRUE(box) << name;
    for (QAbstractButton* button : box->buttons())
      if (button->text().remove('&').startsWith(words)) return button->click();
    FAIL() << words.toStdString();
  }
  std::string text_in(const std::string& name) const {
    std::ifstream in(file(name), std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(file(name), std::ios::binary) << text;
  }
  /// A sound of a tenth of a second: mono, 8 kHz, 16 bits.
  void write_sound(const std::string& name) const {
    const auto number = [](std::uint32_t value, int bytes) {
      std::string text;
      for (int i = 0; i < bytes; ++i) text += char(value >> (8 * i) & 0xff);
      return text;
    };
    const std::string values(1600, '\x10');
    write(name, "RIFF" + number(36 + 1600, 4) + "WAVEfmt " + number(16, 4) + number(1, 2) + number(1, 2) +
                    number(8000, 4) + number(16000, 4) + number(2, 2) + number(16, 2) + "data" +
                    number(1600, 4) + values);
  }
  QFileDialog& export_dialog() {
    files().choose_and_export({});
    auto* const dialog = window_->findChild<QFileDialog*>("cutout.export");
    EXPECT_TRUE(dialog);
    dialog->setDirectory(folder_.path());
    return *dialog;
  }
  static QLineEdit& name_in(QFileDialog& dialog) { return *dialog.findChild<QLineEdit*>("fileNameEdit"); }
  void accept(QFileDialog& dialog) { QMetaObject::invokeMethod(&dialog, "accept"); }
  void make_length(int frames) {
    ASSERT_TRUE(
        document().perform(cutout_command("stage", {{"length", frames}, {"width", 64}, {"height", 48}})));
  }
};

TEST_F(CutoutFilesTest, SavingAsksWhereTheFileWasChangedElsewhere) {
  add_cell("boat");
  ASSERT_TRUE(document().save(file("r.cutout")));
  document().perform(cutout_command("add-layer"));
  const std::string others = text_in("r.cutout") + "# another program was here\n";
  write("r.cutout", others);
  files().save();
  answer("cutout.overwrite", "Cancel");
  EXPECT_EQ(text_in("r.cutout"), others);
  EXPECT_TRUE(document().is_modified());
  files().save();
  answer("cutout.overwrite", "Save As");
  auto* const dialog = window_->findChild<QFileDialog*>("cutout.save_as");
  ASSERT_TRUE(dialog);
  dialog->reject();
  files().save();
  answer("cutout.overwrite", "Overwrite");
  EXPECT_FALSE(document().is_modified());
  EXPECT_EQ(text_in("r.cutout").find("another program"), std::string::npos);
  document().perform(cutout_command("add-layer"));
  files().save();
  EXPECT_FALSE(question("cutout.overwrite")) << "it is as it was saved here";
  EXPECT_FALSE(document().is_modified());
}

TEST_F(CutoutFilesTest, TwoWindowsOfAFileDoNotOverwriteEachOtherUnasked) {
  add_cell("boat");
  ASSERT_TRUE(document().save(file("r.cutout")));
  CutoutWindow second(folder_.filePath("second.conf"));
  second.show();
  second.open(file("r.cutout"));
  second.document().perform(cutout_command("add-layer", {{"name", "second"}}));
  const auto box_of_second = [&] { return second.findChild<QMessageBox*>("cutout.overwrite"); };
  second.files().save();
  ASSERT_TRUE(box_of_second()) << "the first has it open";
  box_of_second()->reject();
  QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
  document().perform(cutout_command("add-layer", {{"name", "first"}}));
  files().save();
  EXPECT_FALSE(question("cutout.overwrite"));
  EXPECT_NE(text_in("r.cutout").find("first"), std::string::npos);
  second.files().save();
  ASSERT_TRUE(box_of_second());
  EXPECT_TRUE(box_of_second()->text().contains("r.cutout was changed by another program"));
  for (QAbstractButton* button : box_of_second()->buttons())
    if (button->text().contains("Overwrite")) {
      button->click();
      break;
    }
  EXPECT_NE(text_in("r.cutout").find("second"), std::string::npos);
  document().perform(cutout_command("add-layer"));
  files().save();
  answer("cutout.overwrite", "Cancel");
  EXPECT_NE(text_in("r.cutout").find("second"), std::string::npos);
}

TEST_F(CutoutFilesTest, FramesAreReplacedOnlyWhenAPersonAgrees) {
  add_cell("boat");
  make_length(5);
  for (const char* name : {"shot0001.png", "shot0003.png", "shot0009.png"}) write(name, "mine");
  const std::string out = file("shot%04d.png").string();
  files().export_if_agreed(out, {});
  ASSERT_TRUE(question("cutout.replace_frames"));
  EXPECT_EQ(question("cutout.replace_frames")->text(), "2 of these files are there already. Replace them?");
  answer("cutout.replace_frames", "Cancel");
  EXPECT_FALSE(files().is_exporting());
  EXPECT_EQ(text_in("shot0001.png"), "mine");
  files().export_if_agreed(out, {});
  answer("cutout.replace_frames", "Replace");
  ASSERT_TRUE(until([&] { return !files().is_exporting(); }));
  EXPECT_NE(text_in("shot0001.png"), "mine");
  EXPECT_EQ(text_in("shot0009.png"), "mine") << "out of the range";
  files().export_if_agreed(file("other%04d.png").string(), {});
  EXPECT_FALSE(question("cutout.replace_frames"));
  ASSERT_TRUE(until([&] { return !files().is_exporting(); }));
  EXPECT_TRUE(std::filesystem::exists(file("other0004.png")));
}

TEST_F(CutoutFilesTest, AFolderIsWrittenWhereTheNameEndsWithASlash) {
  add_cell("boat");
  make_length(3);
  QFileDialog& dialog = export_dialog();
  name_in(dialog).setText("frames/");
  accept(dialog);
  ASSERT_TRUE(until([&] { return !files().is_exporting(); }));
  EXPECT_TRUE(std::filesystem::exists(file("frames") / "frame0002.png"));
  EXPECT_FALSE(std::filesystem::exists(file("frames") / ".mp4"));
}

TEST_F(CutoutFilesTest, ASequenceIsOfferedANameWithANumber) {
  add_cell("boat");
  make_length(3);
  QFileDialog& dialog = export_dialog();
  EXPECT_EQ(name_in(dialog).text(), "animation.mp4");
  const QStringList filters = dialog.nameFilters();
  const auto choose = [&](const QString& ending) {
    const QStringList found = filters.filter("*" + ending);
    ASSERT_EQ(found.size(), 1);
    dialog.selectNameFilter(found[0]);
    emit dialog.filterSelected(found[0]);
  };
  choose(".svg)");
  EXPECT_EQ(name_in(dialog).text(), "animation%04d.svg");
  name_in(dialog).setText("shot%04d.svg");
  choose(".png)");
  EXPECT_EQ(name_in(dialog).text(), "shot%04d.png");
  choose(".webm)");
  EXPECT_EQ(name_in(dialog).text(), "shot.webm");
  choose(".svg)");
  accept(dialog);
  ASSERT_TRUE(until([&] { return !files().is_exporting(); }));
  EXPECT_TRUE(std::filesystem::exists(file("shot0002.svg")));
  EXPECT_EQ(export_name("/a%b/shot.png"), "/a%b/shot%04d.png");
  EXPECT_EQ(export_name("/a/shot%d.svg"), "/a/shot%d.svg");
  EXPECT_EQ(export_name("/a/film.mp4"), "/a/film.mp4");
}

TEST_F(CutoutFilesTest, ClosingDuringAnExportAsks) {
  add_cell("boat", 900, 700);
  ASSERT_TRUE(document().perform(cutout_command("stage", {{"length", 3000}})));
  ASSERT_TRUE(document().save(file("long.cutout")));
  files().export_to(file("long%04d.png").string(), {});
  window_->close();
  EXPECT_TRUE(window_->isVisible());
  answer("cutout.stop_export", "Go On");
  EXPECT_TRUE(window_->isVisible());
  EXPECT_TRUE(files().is_exporting());
  window_->close();
  answer("cutout.stop_export", "Stop the Export and Close");
  EXPECT_FALSE(window_->isVisible());
  ASSERT_TRUE(until([&] { return !files().is_exporting(); }));
  EXPECT_FALSE(std::filesystem::exists(file("long0000.png")));
}

TEST_F(CutoutFilesTest, PicturesAfterABadOneComeInAndAllBadOnesAreNamed) {
  for (const char* name : {"a.png", "c.png", "e.png"}) paper(name, 20, 20, Qt::red);
  write("b.png", "no picture");
  write("d.svg", "<nothing");
  std::vector<std::filesystem::path> chosen;
  for (const char* name : {"a.png", "b.png", "c.png", "d.svg", "e.png"}) chosen.push_back(file(name));
  const auto names_the_bad = [&] {
    const auto* const list = window_->findChild<QPlainTextEdit*>("banner.list");
    return list != nullptr && list->toPlainText().contains("b.png") && list->toPlainText().contains("d.svg");
  };
  files().add_cells(chosen, false);
  EXPECT_EQ(project().cell_count(), 3U);
  EXPECT_TRUE(is_told("2 of 5 pictures could not be read, and were left out."));
  EXPECT_TRUE(names_the_bad());
  document().undo();
  EXPECT_EQ(project().cell_count(), 0U);
  files().add_cells(chosen, true);
  ASSERT_EQ(project().cell_count(), 1U);
  EXPECT_EQ(project().layers[0].cells[0].pictures.size(), 3U);
  document().undo();
  std::filesystem::create_directories(file("parts"));
  for (const char* name : {"a.png", "b.png", "c.png"})
    std::filesystem::copy_file(file(name), file("parts") / name);
  files().take_dropped({file("parts")});
  ASSERT_EQ(project().cell_count(), 1U);
  EXPECT_EQ(project().layers[0].cells[0].pictures.size(), 2U);
  EXPECT_TRUE(is_told("The folder was imported; left out: "));
}

TEST_F(CutoutFilesTest, ASoundThatCannotBeReadLeavesTheGoodOne) {
  add_cell("boat");
  write_sound("good.wav");
  write("bad.wav", "no sound");
  files().use_sound(file("good.wav"));
  ASSERT_TRUE(project().sound);
  const animation::Sound good = *project().sound;
  files().use_sound(file("bad.wav"));
  ASSERT_TRUE(project().sound);
  EXPECT_EQ(project().sound->file, good.file);
  EXPECT_TRUE(is_told("bad.wav: is no sound that can be read"));
}

}  // namespace
}  // namespace icome::ui
