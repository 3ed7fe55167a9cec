#include "sketch/files/stroke_files.h"

#include <gtest/gtest.h>

#include "places.h"
#include "sketch/files/stroke_file_text.h"

namespace icome::sketch {
namespace {

struct SharedRecording {
  const char* path;
  std::size_t strokes, samples;
  bool has_pressure;
};

TEST(StrokeFiles, ReadsEverySharedRecording) {
  const auto folder = places::shared_data() / "strokes";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no shared data at " << folder;
  // Strokes as DATA.md counts them.
  for (const SharedRecording& expected : {SharedRecording{"Bunny03_SA_cluster.scap", 56, 1874, false},
                                          {"abc_SA_cluster.scap", 33, 1602, false},
                                          {"phone.scap", 119, 3673, false},
                                          {"handwriting_signal.svc", 5, 819, true},
                                          {"painting30sec.dat", 30, 2253, true},
                                          {"evemu/Wacom_Cintiq_13HD_touch_Pen.events", 2, 35, true},
                                          {"evemu/Wacom_Intuos4_6x9.stylus-drag.events", 1, 295, true}}) {
    const auto read = read_strokes(folder / expected.path);
    ASSERT_TRUE(read) << read.error().message;
    std::size_t samples = 0;
    for (const PenStroke& stroke : read->strokes) samples += stroke.size();
    EXPECT_EQ(read->strokes.size(), expected.strokes) << expected.path;
    EXPECT_EQ(samples, expected.samples) << expected.path;
    EXPECT_EQ(read->has_pressure, expected.has_pressure) << expected.path;
  }
}

TEST(StrokeFiles, TellsOfARecordingWithoutStrokes) {
  const auto file = places::shared_data() / "strokes/evemu/Genius_EasyPen_i405X.events";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no shared data at " << file;
  const auto read = read_strokes(file);
  ASSERT_FALSE(read) << "its pen only hovers";
  EXPECT_EQ(read.error().message,
            file.string() + ": there is no stroke in it: the pen never touches the paper");
}

TEST(StrokeFiles, ReadsCsvInSi) {
  const auto read = strokes_in(".csv", "\xEF\xBB\xBFpressure;tilt;X;y;t\r\n0,5;0;0;0;0\r\n");
  EXPECT_FALSE(read) << "a decimal comma is no number";
  const auto good = strokes_in(".csv",
                               "\xEF\xBB\xBFpressure;tilt;X;y;t\r\n0.5;9;10;20;1\r\n1;9;11;20;1.5\r\n"
                               "0;9;0;0;0\r\n0;9;0;0;0\r\n0.25;9;5;6;0.1\r\n");
  ASSERT_TRUE(good) << good.error().message;
  ASSERT_EQ(good->strokes.size(), 2U) << "rows of pressure 0 end a stroke";
  ASSERT_EQ(good->strokes[0].size(), 2U);
  EXPECT_EQ(good->strokes[0][1].time, 1.5);
  EXPECT_EQ(good->strokes[0][1].place, base::Vector2(0.011, 0.02)) << "m of 11,20 mm";
  EXPECT_EQ(good->strokes[1][0].pressure, 0.25);
}

TEST(StrokeFiles, NamesTheLineOfAFaultInCsv) {
  EXPECT_EQ(stroke_error(".csv", "t,x,y,pressure\n0,0,0,1\n0.1,nan,0,1\n"),
            ":3: x is 'nan', which is no finite number with a decimal point");
  EXPECT_EQ(stroke_error(".csv", "t,x,y,pressure\n0,0,0,1.5\n"),
            ":2: the pressure 1.5 is not between 0 and 1");
  EXPECT_EQ(stroke_error(".csv", "t,x,y,pressure\n1,0,0,1\n0.5,0,0,1\n"),
            ":3: time goes back within a stroke, from 1 s to 0.5 s");
  EXPECT_EQ(
      stroke_error(".csv", "t,x,y\n1,0,0\n"),
      ":1: there is no column 'pressure' in the header; write t,x,y,pressure (s, mm, mm, 0 to 1) in the "
      "first line");
  EXPECT_EQ(stroke_error(".csv", "t,x,y,pressure\n1,0,0\n"),
            ":2: the row has 3 cells and so none of the column 'pressure'");
  EXPECT_EQ(stroke_error(".csv", "t,x,y,pressure\n"),
            ": there is no stroke in it: the pen never touches the paper");
  EXPECT_EQ(stroke_error(".csv", "t,x,y,pressure\n0,1e300,0,1\n"),
            ":2: a pen is at most 1e+06 mm from the corner of its paper, not at 1e+300,0 mm");
  EXPECT_EQ(stroke_error(".csv", ""), ": is empty; a stroke CSV begins with the line t,x,y,pressure");
}

TEST(StrokeFiles, ReadsSvcOfBothForms) {
  const auto old =
      strokes_in(".svc", "3\n100 200 1000 1 0 0 512\n100 200 1010 1 0 0 1024\n5 5 1020 0 0 0 0\n");
  ASSERT_TRUE(old) << old.error().message;
  ASSERT_EQ(old->strokes.size(), 1U);
  EXPECT_EQ(old->strokes[0].size(), 2U) << "status 0 is no sample";
  EXPECT_EQ(old->strokes[0][1].time, 1.01) << "whole numbers are ms";
  EXPECT_EQ(old->strokes[0][0].pressure, 0.5) << "512 of 1024, the greatest";
  const auto decimal = strokes_in(".svc", "1\n1.5 2.5 0.5 1 0 0 0.25\n");
  ASSERT_TRUE(decimal) << decimal.error().message;
  EXPECT_EQ(decimal->strokes[0][0].time, 0.5);
  EXPECT_EQ(decimal->strokes[0][0].pressure, 0.25);
  EXPECT_EQ(stroke_error(".svc", "2\n1.5 2.5 0.5 1 0 0 0.25\n"),
            ":1: there are 1 rows, not the 2 of the first line: the file may be cut short");
  EXPECT_EQ(stroke_error(".svc", "1\n1.5 2.5 0.5 7 0 0 0.25\n"),
            ":2: the pen status is 1 (down) or 0 (lifted)");
}

TEST(StrokeFiles, ReadsScapWithoutPressure) {
  const auto read =
      strokes_in(".scap", "#10 20\n@1\n{\n #4 1\n @2.5\n 1 2 0\n 3 4 0\n}\n{\n #5 1\n 5 6 0\n}\n");
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read->strokes.size(), 2U);
  EXPECT_FALSE(read->has_pressure);
  EXPECT_EQ(read->strokes[0][1].pressure, 1.0) << "a pen that feels none presses fully";
  EXPECT_EQ(read->strokes[0][1].time, 0.01);
  EXPECT_EQ(stroke_error(".scap", "#1 1\n{\n1 2 0\n"),
            ":3: the } of the last stroke is missing: the file may be cut short");
  EXPECT_EQ(stroke_error(".scap", "#1 1\n{\n1 inf 0\n}\n"), ":3: inf is not y of the pen: it is not finite");
}

TEST(StrokeFiles, ReadsMyPaintAndLifts) {
  const auto read = strokes_in(".dat", "0 1 1 0\n0.1 1 1 0.5\n0.2 2 1 1e0\n0.3 2 1 0\n0.4 3 3 1\n");
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read->strokes.size(), 2U);
  EXPECT_EQ(read->strokes[0][0].place, base::Vector2(0.001, 0.001));
}

TEST(StrokeFiles, ReadsEvemuByTheRangesOfItsAxes) {
  const auto read = strokes_in(".events",
                               "# EVEMU 1.2\nA: 00 100 1100 0 0 200\nA: 01 0 1000 0 0 200\nA: 18 0 1000 0 0\n"
                               "E: 0.01 0003 0000 300 # X\nE: 0.01 0003 0001 400\nE: 0.01 0000 0000 0\n"
                               "E: 0.02 0001 014a 1\nE: 0.02 0003 0018 250\nE: 0.02 0000 0000 0\n"
                               "E: 0.03 0003 0000 500\nE: 0.03 0000 0000 0\n"
                               "E: 0.04 0001 014a 0\nE: 0.04 0000 0000 0\n");
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read->strokes.size(), 1U);
  ASSERT_EQ(read->strokes[0].size(), 2U) << "hovering before and the report of the lift are no samples";
  EXPECT_TRUE(read->strokes[0][0].place.isApprox(base::Vector2(0.001, 0.002)))
      << "(300-100)/200 mm, 400/200 mm";
  EXPECT_EQ(read->strokes[0][0].pressure, 0.25) << "250 of the range's 1000";
  EXPECT_EQ(stroke_error(".events", "E: 0.01 0003 zz 300\n"), ":1: 'zz' is not the code of an event");
}

TEST(StrokeFiles, KnowsFormatsByContent) {
  EXPECT_TRUE(strokes_in(".txt", "t,x,y,pressure\n0,1,1,1\n"));
  EXPECT_TRUE(strokes_in(".txt", "1\n1.5 2.5 0.5 1 0 0 0.25\n"));
  EXPECT_TRUE(strokes_in(".txt", "#10 20\n@1\n{\n1 2 0\n}\n"));
  EXPECT_TRUE(strokes_in(".txt", "0 1 1 1\n"));
  EXPECT_TRUE(strokes_in(".txt", "<ink><trace>1 1</trace></ink>"));
  EXPECT_EQ(stroke_error(".txt", std::string("\x7f\0ELF\xff", 6)).substr(0, 41),
            ": is no recording of a pen that is known:");
}

TEST(StrokeFiles, RefusesBytesThatAreNoRecording) {
  const std::string bytes("\0\xff\x01 binary\r\r\n\n\xfe", 14);
  for (const char* const ending : {".csv", ".inkml", ".svc", ".scap", ".dat", ".events"})
    EXPECT_FALSE(strokes_in(ending, bytes)) << ending;
  for (const char* const ending : {".csv", ".inkml", ".svc", ".scap", ".dat", ".events"})
    EXPECT_FALSE(strokes_in(ending, "")) << ending;
}

}  // namespace
}  // namespace icome::sketch
