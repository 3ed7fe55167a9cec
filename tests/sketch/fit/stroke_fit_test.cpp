#include "sketch/fit/stroke_fit.h"

#include <gtest/gtest.h>

#include <map>
#include <numbers>
#include <string>

#include "places.h"
#include "sketch/dense_distance.h"
#include "sketch/files/stroke_files.h"

namespace icome::sketch {
namespace {

using judges::dense_distance;
using judges::drawn;
using judges::places_of;
using judges::polar;
using judges::wandering;

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kFitError = 1e-4;  // m

PenStroke circle(double radius, int samples) {
  return drawn(samples, [&](double u) { return polar(radius, kTurn * u); });
}

PenStroke zigzag(int teeth, int samples_of_a_tooth) {
  return drawn(teeth * samples_of_a_tooth + 1, [&](double u) {
    const double tooth = u * teeth;
    return Vector2(0.004 * tooth, 0.01 * std::abs(std::remainder(tooth, 2.0)));
  });
}

/// A square that begins in the middle of a side, whose corners are samples.
PenStroke square(int samples_of_a_side) {
  return drawn(4 * samples_of_a_side + 1, [&](double u) {
    constexpr double kSide = 0.02;
    const double at = std::fmod(4.0 * u + 0.5, 4.0);
    const double along = kSide * (at - std::floor(at));
    const Vector2 corners[] = {{along, 0.0}, {kSide, along}, {kSide - along, kSide}, {0.0, kSide - along}};
    return corners[int(at) % 4];
  });
}

/// Every sample three times, and each tenth followed by one that steps back.
PenStroke stuttering(const PenStroke& stroke) {
  PenStroke stutters;
  for (std::size_t i = 0; i < stroke.size(); ++i) {
    for (int k = 0; k < 3; ++k) stutters.push_back(stroke[i]);
    if (i % 10 == 9) stutters.push_back(stroke[i - 3]);
  }
  return stutters;
}

/// Seen as a pen at 1 kHz that rests: noise of a hundredth of a millimetre.
PenStroke at_rest(int samples) {
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0.0, 1e-5);
  return drawn(samples, [&](double) { return Vector2(0.1 + noise(random), 0.2 + noise(random)); });
}

std::map<std::string, PenStroke> many_strokes() {
  std::map<std::string, PenStroke> strokes;
  strokes["circle"] = circle(0.02, 200);
  strokes["sparse circle"] = circle(0.02, 9);
  strokes["line"] = drawn(50, [](double u) { return Vector2(0.1 * u, 0.03 * u); });
  strokes["two samples"] = drawn(2, [](double u) { return Vector2(0.1 * u, 0.03 * u); });
  strokes["three samples"] = drawn(3, [](double u) { return Vector2(0.1 * u, u == 0.5 ? 0.03 : 0.0); });
  strokes["one sample"] = drawn(1, [](double) { return Vector2(0.1, 0.2); });
  strokes["equal samples"] = drawn(30, [](double) { return Vector2(0.1, 0.2); });
  strokes["out and back"] = drawn(61, [](double u) { return Vector2(0.1 * (1.0 - std::abs(2 * u - 1)), 0); });
  strokes["spiral"] = drawn(600, [](double u) { return polar(0.03 * u, 5.0 * kTurn * u); });
  strokes["zigzag"] = zigzag(11, 20);
  strokes["sparse zigzag"] = zigzag(11, 1);
  strokes["square"] = square(50);
  strokes["spirograph"] = drawn(
      1500, [](double u) { return Vector2(polar(0.03, 3.0 * kTurn * u) + polar(0.02, -7.0 * kTurn * u)); });
  strokes["smooth walk"] = wandering(1, 600, 0.0005, 0.1);
  strokes["rough walk"] = wandering(2, 300, 0.0005, 1.0);
  strokes["wild walk"] = wandering(4, 60, 0.01, 3.0);
  strokes["stuttering circle"] = stuttering(circle(0.02, 100));
  strokes["stuttering walk"] = stuttering(wandering(5, 200, 0.0005, 0.3));
  strokes["tiny"] = circle(1e-7, 60);
  strokes["enormous"] = circle(2.0, 60);
  strokes["far away"] = drawn(100, [](double u) { return Vector2(900.0 + 0.02 * u, -900.0 + 0.02 * u * u); });
  strokes["at rest"] = at_rest(1000);
  return strokes;
}

constexpr int kStrokeShares = 6;

/// Tests that hold every one of many strokes to something, a share of them each, so that shards share them
/// out.
class ShareOfStrokes : public ::testing::TestWithParam<int> {
 protected:
  static std::map<std::string, PenStroke> share() {
    std::map<std::string, PenStroke> strokes;
    int number = 0;
    for (const auto& [name, stroke] : many_strokes())
      if (number++ % kStrokeShares == GetParam()) strokes.emplace(name, stroke);
    return strokes;
  }
};
INSTANTIATE_TEST_SUITE_P(FitStroke, ShareOfStrokes, ::testing::Range(0, kStrokeShares));

FitSettings fit_settings(FitMethod method, bool refit, double error = kFitError) {
  FitSettings settings;
  settings.method = method;
  settings.refit = refit;
  settings.error = error;
  return settings;
}

double extent_of(const PenStroke& stroke) {
  geometry::Bounds2 box;
  for (const PenSample& sample : stroke) box.extend(sample.place);
  return box.diagonal().norm();
}

double turn_at_joint(const CubicBezier& first, const CubicBezier& second) {
  const Vector2 a = first.end_direction();
  const Vector2 b = second.start_direction();
  return std::abs(std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b)));
}

/// Holds a fit to what every fit must be: a curve without gaps from the first sample to the last, finite, no
/// wild handles, with as many breaks as it says, and widths all along.
void expect_sound(const PenStroke& stroke, const FittedStroke& fitted) {
  const Curve& curve = fitted.curve;
  ASSERT_FALSE(curve.segments.empty());
  const double far = 1e-13 * (1.0 + stroke.front().place.norm());
  EXPECT_LE((curve.segments.front().points[0] - stroke.front().place).norm(), far);
  EXPECT_LE((curve.segments.back().points[3] - stroke.back().place).norm(), far + 1e-3 * kFitError);
  std::size_t breaks = 0;
  for (std::size_t i = 0; i < curve.segments.size(); ++i) {
    const auto& points = curve.segments[i].points;
    for (const Vector2& point : points) ASSERT_TRUE(point.allFinite());
    EXPECT_LE((points[1] - points[0]).norm(), 3.0 * extent_of(stroke) + 1e-12);
    EXPECT_LE((points[3] - points[2]).norm(), 3.0 * extent_of(stroke) + 1e-12);
    if (i == 0) continue;
    EXPECT_EQ(points[0], curve.segments[i - 1].points[3]);
    breaks += turn_at_joint(curve.segments[i - 1], curve.segments[i]) > 1e-6 ? 1 : 0;
  }
  EXPECT_EQ(breaks, fitted.corners);
  EXPECT_EQ(fitted.samples, stroke.size());
  ASSERT_FALSE(curve.widths.empty());
  EXPECT_EQ(curve.widths.front().from, 0.0);
  EXPECT_EQ(curve.widths.back().to, curve.end());
}

void expect_within_what_it_says(const PenStroke& stroke, const FittedStroke& fitted) {
  const double bends = 2e-6 * extent_of(stroke);  // between the places that are looked at
  EXPECT_LE(dense_distance(places_of(stroke), fitted.curve.segments), fitted.error + bends + 1e-15);
}

TEST_P(ShareOfStrokes, ExactFitsAreWithinTheBoundByDenseSampling) {
  for (const auto& [name, stroke] : share()) {
    for (const bool refit : {true, false}) {
      SCOPED_TRACE(name + (refit ? "" : ", as drawn"));
      const FittedStroke fitted = fit_stroke(stroke, fit_settings(FitMethod::Exact, refit));
      expect_sound(stroke, fitted);
      EXPECT_LE(fitted.error, kFitError);
      expect_within_what_it_says(stroke, fitted);
    }
  }
}

TEST_P(ShareOfStrokes, FitsOfTheThesisTellTheirTrueError) {
  for (const auto& [name, stroke] : share()) {
    SCOPED_TRACE(name);
    const FittedStroke fitted = fit_stroke(stroke, fit_settings(FitMethod::Thesis, true));
    expect_sound(stroke, fitted);
    expect_within_what_it_says(stroke, fitted);
  }
}

// The shared samples lie outside of a segment; none or many of them are the hardest for its sums.
TEST_P(ShareOfStrokes, FitsOfTheThesisAreSoundWithAnyNumberOfSharedSamples) {
  for (const unsigned shared : {0U, 1U, 10U, 50U}) {
    for (const auto& [name, stroke] : share()) {
      SCOPED_TRACE(name + ", shared " + std::to_string(shared));
      FitSettings settings = fit_settings(FitMethod::Thesis, true);
      settings.shared = shared;
      expect_sound(stroke, fit_stroke(stroke, settings));
    }
  }
}

void expect_same_at_scale(const PenStroke& stroke, FitMethod method, bool refit, double scale) {
  PenStroke scaled = stroke;
  for (PenSample& sample : scaled) sample.place *= scale;
  const FittedStroke one = fit_stroke(stroke, fit_settings(method, refit));
  const FittedStroke other = fit_stroke(scaled, fit_settings(method, refit, scale * kFitError));
  ASSERT_EQ(one.curve.segments.size(), other.curve.segments.size());
  EXPECT_EQ(one.corners, other.corners);
  const double close = 1e-6 * (extent_of(stroke) + kFitError);
  for (std::size_t i = 0; i < one.curve.segments.size(); ++i)
    for (std::size_t k = 0; k < 4; ++k)
      EXPECT_LE((one.curve.segments[i].points[k] - other.curve.segments[i].points[k] / scale).norm(), close);
}

TEST_P(ShareOfStrokes, TheSameDrawingAtAnotherScaleHasTheSameCurve) {
  for (const auto& [name, stroke] : share()) {
    for (const double scale : {1000.0, 0.001}) {
      SCOPED_TRACE(name + " at " + std::to_string(scale));
      expect_same_at_scale(stroke, FitMethod::Exact, true, scale);
      expect_same_at_scale(stroke, FitMethod::Exact, false, scale);
      expect_same_at_scale(stroke, FitMethod::Thesis, true, scale);
    }
  }
}

// A straight piece of least squares may pass what the pen can draw; the line must not.
TEST(FitStroke, WidthsStayWithinThoseOfThePen) {
  PenStroke stroke = drawn(200, [](double u) { return Vector2(0.1 * u, 0.0); });
  for (std::size_t i = 0; i < stroke.size(); ++i)
    stroke[i].pressure = std::clamp(0.5 + 0.8 * std::sin(0.1 * double(i)), 0.0, 1.0);
  FitSettings settings = fit_settings(FitMethod::Exact, true);
  settings.tip = {0.0, 0.001};
  for (const WidthSegment& piece : fit_stroke(stroke, settings).curve.widths) {
    EXPECT_GE(std::min(piece.from_width, piece.to_width), 0.0);
    EXPECT_LE(std::max(piece.from_width, piece.to_width), 0.001);
  }
}

TEST(FitStroke, ARestOfTenSecondsAt1kHzCostsAFewSegments) {
  const FittedStroke fitted = fit_stroke(at_rest(10000), fit_settings(FitMethod::Exact, true));
  EXPECT_LE(fitted.error, kFitError);
  EXPECT_LE(fitted.curve.segments.size(), 4U);
}

TEST(FitStroke, ALineIsOneSegmentHoweverItIsSampled) {
  for (const int samples : {2, 3, 10, 1000}) {
    const PenStroke line = drawn(samples, [](double u) { return Vector2(0.2 * u * u, 0.1 * u * u); });
    EXPECT_EQ(fit_stroke(line, fit_settings(FitMethod::Exact, true)).curve.segments.size(), 1U) << samples;
  }
}

TEST(FitStroke, TheCornersOfASquareAreKeptHoweverItIsSampled) {
  for (const int samples_of_a_side : {2, 10, 50, 500}) {  // even, so that the corners are samples
    for (const bool refit : {true, false}) {
      SCOPED_TRACE(std::to_string(samples_of_a_side) + (refit ? "" : ", as drawn"));
      const PenStroke stroke = square(samples_of_a_side);
      const FittedStroke fitted = fit_stroke(stroke, fit_settings(FitMethod::Exact, refit));
      EXPECT_EQ(fitted.corners, 4U);
      EXPECT_TRUE(!refit || fitted.curve.segments.size() == 5);
    }
  }
}

// It asked for all memory: a way that ends where it began, and was nowhere far from there.
TEST(FitStroke, AClosedStrokeThatIsSmallerThanTheBoundIsADot) {
  for (const double size : {1e-6, 0.001, 0.02, 0.3}) {
    PenStroke stroke;
    for (int i = 0; i <= 64; ++i) {
      const double there = std::sin(M_PI * i / 32.0);  // there and back, and the other way
      stroke.push_back({0.001 * i, size * Vector2(there, 1.3 * there), 0.5});
    }
    stroke.back().place = stroke.front().place;
    FitSettings settings;
    settings.error = 1.0;
    const FittedStroke fitted = fit_stroke(stroke, settings);
    ASSERT_FALSE(fitted.curve.segments.empty());
    for (const CubicBezier& segment : fitted.curve.segments)
      for (const Vector2& point : segment.points) EXPECT_TRUE(point.allFinite());
    EXPECT_LE(fitted.error, settings.error);
  }
}

TEST(FitStroke, ACircleHasNoCorner) {
  for (const int samples : {60, 500, 5000}) {
    for (const bool refit : {true, false})
      EXPECT_EQ(fit_stroke(circle(0.02, samples), fit_settings(FitMethod::Exact, refit)).corners, 0U)
          << samples;
  }
}

/// A random curve of cubics that turn without a break from one to the next, and samples on it at even t.
struct KnownCurve {
  std::size_t cubics;
  PenStroke samples;
};

KnownCurve known_curve(unsigned seed) {
  std::mt19937 random(seed);
  const auto between = [&](double least, double most) {
    return least + (most - least) * double(random()) / double(std::mt19937::max());
  };
  KnownCurve known = {4 + random() % 20, {}};
  Vector2 place = Vector2::Zero();
  double direction = 0.0;
  for (std::size_t i = 0; i < known.cubics; ++i) {
    const double length = between(0.005, 0.03);
    const double turn = between(-0.9, 0.9);
    const double next = direction + turn + between(-1.2, 1.2);
    const Vector2 end = place + polar(length, direction + turn);
    const Vector2 second = place + polar(between(0.25, 0.45) * length, direction);
    const Vector2 third = end - polar(between(0.25, 0.45) * length, next);
    const CubicBezier cubic = {{place, second, third, end}};
    const int samples = int(length / 3e-4);
    for (int k = i == 0 ? 0 : 1; k <= samples; ++k)
      known.samples.push_back({0.001 * double(known.samples.size()), cubic.at(double(k) / samples), 0.5});
    place = end;
    direction = next;
  }
  return known;
}

// The samples lie on those, so they are within the bound: the optimum has no more. A few curves may, not all.
TEST(FitStroke, SmoothCurvesHaveNoMoreSegmentsThanTheCubicsThatTheyAreMadeOf) {
  std::size_t ours = 0;
  std::size_t known = 0;
  for (unsigned seed = 0; seed < 8; ++seed) {
    const KnownCurve curve = known_curve(seed);
    const FittedStroke fitted = fit_stroke(curve.samples, fit_settings(FitMethod::Exact, true));
    EXPECT_LE(fitted.error, kFitError) << seed;
    EXPECT_LE(fitted.curve.segments.size(), curve.cubics + 2) << seed;
    ours += fitted.curve.segments.size();
    known += curve.cubics;
  }
  EXPECT_LE(ours, known);
}

/// Places of equally spaced lengths along a curve, by adding up short chords.
std::vector<double> places_by_length(const Curve& curve, int count) {
  constexpr int kSteps = 500;
  std::vector<double> along = {0.0};
  for (int i = 1; i <= kSteps * int(curve.segments.size()); ++i)
    along.push_back(along.back() +
                    (curve.at(i / double(kSteps)) - curve.at((i - 1) / double(kSteps))).norm());
  std::vector<double> places;
  for (int k = 0; k <= count; ++k) {
    const auto next = std::lower_bound(along.begin(), along.end(), along.back() * k / count);
    places.push_back(double(next - along.begin()) / kSteps);
  }
  return places;
}

/// With pressure that grows evenly along the way the width must grow evenly along the curve.
void expect_even_growth(PenStroke stroke) {
  double length = 0.0;
  std::vector<double> along = {0.0};
  for (std::size_t i = 1; i < stroke.size(); ++i)
    along.push_back(length += (stroke[i].place - stroke[i - 1].place).norm());
  for (std::size_t i = 0; i < stroke.size(); ++i) stroke[i].pressure = along[i] / length;
  const FitSettings settings = fit_settings(FitMethod::Exact, true);
  const Curve curve = fit_stroke(stroke, settings).curve;
  const auto places = places_by_length(curve, 50);
  for (int k = 0; k <= 50; ++k) {
    const double width = settings.tip.width(k / 50.0);
    EXPECT_NEAR(curve.width_at(places[std::size_t(k)]), width, 0.00013) << "at " << k << " of 50";
  }
}

TEST(FitStroke, WidthsBelongToTheirPlacesOnALineAndACircle) {
  expect_even_growth(drawn(100, [](double u) { return Vector2(0.1 * u, 0.0); }));
  expect_even_growth(circle(0.02, 200));
}

// The way back is nearer to samples of the way out than their own part of the curve may be.
TEST(FitStroke, WidthsBelongToTheirPlacesWhereLinesLieOnEachOther) {
  expect_even_growth(drawn(
      201, [](double u) { return Vector2(0.1 * (1.0 - std::abs(2.0 * u - 1.0)), u > 0.5 ? 0.00003 : 0.0); }));
  expect_even_growth(drawn(601, [](double u) { return polar(0.01, 3.0 * kTurn * u); }));
  expect_even_growth(drawn(801, [](double u) {
    return Vector2(0.02 * std::abs(std::remainder(8.0 * u, 2.0)), 0.00002 * std::sin(300.0 * u));
  }));
}

TEST(FitStroke, NoWidthIsNegativeWhereThePenHasNoLeastWidth) {
  FitSettings settings = fit_settings(FitMethod::Exact, true);
  settings.tip = {0.0, 0.001};
  PenStroke stroke = drawn(200, [](double u) { return Vector2(0.1 * u, 0.0); });
  for (std::size_t i = 0; i < stroke.size(); ++i)
    stroke[i].pressure = std::max(0.0, std::sin(0.2 * double(i)));
  for (const WidthSegment& piece : fit_stroke(stroke, settings).curve.widths) {
    EXPECT_GE(piece.from_width, 0.0);
    EXPECT_GE(piece.to_width, 0.0);
  }
}

// Strokes of real pens: all that holds for made-up strokes, and the fit of the thesis as well.
TEST(FitStroke, SharedStrokesAreWithinTheBoundByDenseSampling) {
  const auto folder = places::shared_data() / "strokes";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "the shared data is not here: " << folder;
  for (const char* name : {"abc_SA_cluster.scap", "handwriting_signal.svc", "phone.scap"}) {
    const auto read = read_strokes(folder / name);
    ASSERT_TRUE(read);
    for (std::size_t i = 0; i < read->strokes.size(); i += 4) {
      SCOPED_TRACE(std::string(name) + ", stroke " + std::to_string(i));
      const PenStroke& stroke = read->strokes[i];
      const FittedStroke fitted = fit_stroke(stroke, fit_settings(FitMethod::Exact, i % 8 == 0));
      expect_sound(stroke, fitted);
      EXPECT_LE(fitted.error, kFitError);
      expect_within_what_it_says(stroke, fitted);
      expect_sound(stroke, fit_stroke(stroke, fit_settings(FitMethod::Thesis, true)));
    }
  }
}

}  // namespace
}  // namespace icome::sketch
