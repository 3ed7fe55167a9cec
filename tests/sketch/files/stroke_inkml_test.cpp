#include <gtest/gtest.h>

#include "sketch/files/stroke_file_text.h"
#include "sketch/files/stroke_files.h"

namespace icome::sketch {
namespace {

std::string ink(const std::string& inside) {
  return "<ink xmlns=\"http://www.w3.org/2003/InkML\">\n" + inside + "\n</ink>\n";
}

TEST(StrokeInkMl, ReadsPlainTracesAsMm) {
  const auto read = strokes_in(".inkml", ink("<trace>10 0, 9 14,\n 8 28</trace><trace>1 1</trace>"));
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read->strokes.size(), 2U);
  ASSERT_EQ(read->strokes[0].size(), 3U);
  EXPECT_TRUE(read->strokes[0][2].place.isApprox(base::Vector2(0.008, 0.028)));
  EXPECT_EQ(read->strokes[0][2].time, 0.02) << "1/100 s apart where no time is told";
}

TEST(StrokeInkMl, FollowsDifferencesAsInTheExampleOfTheStandard) {
  // W3C InkML 2011, 3.2.1: the trace and the points that its table gives.
  const auto read = strokes_in(
      ".inkml", ink("<traceFormat><channel name='X' type='decimal'/><channel name='Y' type='decimal'/>"
                    "<intermittentChannels><channel name='B1' type='boolean'/><channel name='B2' "
                    "type='boolean'/></intermittentChannels></traceFormat>"
                    "<trace>1125 18432,'23'43,\"7\"-8,3-5,7-3,6 2,6 8,3 6 T,2 4*T,3 6,3-6 F F</trace>"));
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read->strokes[0].size(), 11U);
  const auto& stroke = read->strokes[0];
  EXPECT_TRUE(stroke[1].place.isApprox(base::Vector2(1.148, 18.475)));
  EXPECT_TRUE(stroke[2].place.isApprox(base::Vector2(1.178, 18.510)));
  EXPECT_TRUE(stroke[4].place.isApprox(base::Vector2(1.251, 18.567)));
  EXPECT_TRUE(stroke[7].place.isApprox(base::Vector2(1.404, 18.676)));
}

TEST(StrokeInkMl, ReadsChannelsWithUnits) {
  const auto read = strokes_in(
      ".inkml",
      ink("<definitions><context xml:id='c'><inkSource><traceFormat>"
          "<channel name='T' units='ms'/><channel name='Y' units='cm'/><channel name='X' units='in'/>"
          "<channel name='F' max='200'/><channel name='OTx'/></traceFormat></inkSource></context>"
          "</definitions><traceGroup contextRef='#c'><trace>500 1 2 50 7</trace></traceGroup>"));
  ASSERT_TRUE(read) << read.error().message;
  const PenSample& sample = read->strokes[0][0];
  EXPECT_EQ(sample.time, 0.5);
  EXPECT_TRUE(sample.place.isApprox(base::Vector2(0.0508, 0.01))) << "2 in, 1 cm";
  EXPECT_EQ(sample.pressure, 0.25) << "50 of 200";
}

TEST(StrokeInkMl, SkipsHoveringAndJoinsContinuations) {
  const auto read =
      strokes_in(".inkml", ink("<trace type='penUp'>1 1</trace><trace continuation='begin'>1 1</trace>"
                               "<trace continuation='end'>2 2</trace>"));
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read->strokes.size(), 1U);
  EXPECT_EQ(read->strokes[0].size(), 2U);
}

TEST(StrokeInkMl, NamesTheLineOfAFault) {
  EXPECT_EQ(stroke_error(".inkml", ink("<trace>\n1 1,\n2 x</trace>")), ":4: 'x' is no number of a trace");
  EXPECT_EQ(stroke_error(".inkml", ink("<trace>1 1, 2</trace>")),
            ":2: a point of the trace has 1 of its 2 numbers: it may be cut short");
  EXPECT_EQ(stroke_error(".inkml", ink("<trace>1 1 1</trace>")),
            ":2: a point of the trace has more than its 2 channels");
  EXPECT_EQ(stroke_error(".inkml", ink("<trace>1 nan</trace>")), ":2: 'nan' is no number of a trace");
  EXPECT_EQ(stroke_error(".inkml", ink("<traceFormat>\n<channel name='X' units='furlong'/></traceFormat>")),
            ":3: the unit 'furlong' of channel X is unknown: write mm, cm, m, in or himetric, or s or ms of "
            "times");
  EXPECT_EQ(stroke_error(".inkml", "<svg/>"), ":1: it is no InkML, which begins with <ink>, but <svg>");
  EXPECT_EQ(stroke_error(".inkml", "<ink>\n<trace>1 1").substr(0, 24), ":2: it is no sound XML (");
}

TEST(StrokeInkMl, RefusesDeepNesting) {
  std::string deep;
  for (int i = 0; i < 100000; ++i) deep += "<traceGroup>";
  for (int i = 0; i < 100000; ++i) deep += "</traceGroup>";
  EXPECT_EQ(stroke_error(".inkml", ink(deep)), ":2: elements lie more than 100 deep within one another");
}

TEST(StrokeInkMl, DoesNotExpandEntities) {
  const auto read = strokes_in(".inkml",
                               "<!DOCTYPE ink [<!ENTITY a '1 1'><!ENTITY b '&a;,&a;'>]>"
                               "<ink><trace>&b;</trace></ink>");
  EXPECT_FALSE(read) << "an entity is text that is no number";
}

}  // namespace
}  // namespace icome::sketch
