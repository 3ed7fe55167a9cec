#include "ui/sketch/stroke_picture.h"

#include <algorithm>
#include <cstdlib>

#include "base/random.h"
#include "ui/desktop_test.h"

namespace icome::ui {
namespace {

const QSize kPictureSize(300, 200);
constexpr int kLayersRounding = 6;  // of a channel: what is laid over in another order
constexpr int kOtherOutline = 48;   // likewise: less than a fifth of a pixel, where many rims meet

drawing::StrokePointer random_stroke(base::Random& random, std::uint64_t id) {
  drawing::Stroke stroke;
  stroke.id = drawing::StrokeId{id};
  const drawing::Vector2 corner(random.uniform(0.0, 0.05), random.uniform(0.0, 0.03));
  const auto point = [&] {
    return drawing::Vector2(corner + 0.02 * drawing::Vector2(random.uniform(), random.uniform()));
  };
  stroke.curve.segments = {{{point(), point(), point(), point()}}};
  stroke.curve.widths = {{0.0, random.uniform(0.0, 0.003), 1.0, random.uniform(0.0005, 0.003)}};
  stroke.colour = {float(random.uniform()), float(random.uniform()), float(random.uniform())};
  if (random.index(3) == 0) stroke.fill = drawing::Colour{1.0F, 0.5F, 0.0F};
  if (random.index(3) == 0) stroke.opacity = 0.5;
  if (random.index(3) == 0) stroke.ends = drawing::CurveEnds::Flat;
  return std::make_shared<const drawing::Stroke>(std::move(stroke));
}

/// A picture of more strokes than one sheet has, that was changed again and again, beside one that is made at
/// once.
class StrokePictureTest : public ::testing::Test {
 protected:
  StrokePictureTest() {
    application();
    drawing_.size = {0.06, 0.04};
    for (int i = 0; i < 2; ++i) drawing_.layers.push_back({drawing_.next_layer_id(), "", true, false, {}});
    for (int i = 0; i < 900; ++i) strokes(i % 2).push_back(random_stroke(random_, drawing_.next_id++));
    view_.fit(drawing_.size, kPictureSize);
    show();
  }

  std::vector<drawing::StrokePointer>& strokes(int layer) {
    return drawing_.layers[std::size_t(layer)].strokes;
  }
  drawing::StrokePointer& any_stroke(int layer) {
    return strokes(layer)[random_.index(strokes(layer).size())];
  }
  QRect show() { return picture_.show(drawing_, view_, kPictureSize, ratio_); }

  void expect_as_at_once(int difference) {
    StrokePicture other;
    other.show(drawing_, view_, kPictureSize, ratio_);
    ASSERT_EQ(picture_.image().size(), other.image().size());
    int greatest = 0;
    for (int y = 0; y < other.image().height(); ++y)
      for (int x = 0; x < other.image().width(); ++x) {
        const QRgb a = picture_.image().pixel(x, y), b = other.image().pixel(x, y);
        greatest = std::max({greatest, std::abs(qRed(a) - qRed(b)), std::abs(qGreen(a) - qGreen(b)),
                             std::abs(qBlue(a) - qBlue(b))});
      }
    EXPECT_LE(greatest, difference);
  }

  void change_at_random() {
    const int layer = int(random_.index(2));
    switch (random_.index(5)) {
      case 0:
        return strokes(layer).push_back(random_stroke(random_, drawing_.next_id++));
      case 1:
        any_stroke(layer) = random_stroke(random_, drawing_.next_id++);
        return;
      case 2:
        if (strokes(layer).size() > 350)
          strokes(layer).erase(strokes(layer).begin() + std::ptrdiff_t(random_.index(strokes(layer).size())));
        return;
      case 3:
        std::swap(any_stroke(layer), any_stroke(layer));
        return;
      default:
        drawing_.layers[std::size_t(layer)].visible = !drawing_.layers[std::size_t(layer)].visible;
    }
  }

  base::Random random_{31};
  drawing::Drawing drawing_;
  PaperView view_;
  double ratio_ = 1.0;
  StrokePicture picture_;
};

TEST_F(StrokePictureTest, IsAsMadeAtOnceAfterAnyChanges) {
  for (int i = 0; i < 14; ++i) {
    for (std::size_t k = 1 + random_.index(3); k-- > 0;) change_at_random();
    show();
    expect_as_at_once(kLayersRounding);
    if (HasFailure()) FAIL() << i;
  }
}

TEST_F(StrokePictureTest, IsAsMadeAtOnceWhileStrokesAreDragged) {
  for (int drag = 0; drag < 2; ++drag) {
    const std::size_t one = random_.index(strokes(0).size()), other = random_.index(strokes(1).size());
    for (int i = 0; i < 10; ++i) {
      strokes(0)[one] = random_stroke(random_, drawing_.next_id++);
      if (drag % 2 == 1) strokes(1)[other] = random_stroke(random_, drawing_.next_id++);
      show();
      expect_as_at_once(kLayersRounding);
      // The strokes beside it change meanwhile.
      if (i == 6) change_at_random();
      if (HasFailure()) FAIL() << drag << ", " << i;
    }
  }
}

TEST_F(StrokePictureTest, IsAsMadeAtOnceWherePaperIsShifted) {
  for (const double ratio : {1.0, 2.0}) {
    ratio_ = ratio;
    show();
    for (int i = 0; i < 6; ++i) {
      const QPointF by(int(random_.index(41)) - 20, int(random_.index(41)) - 20);
      PaperView shifted = view_;
      shifted.shift(by);
      EXPECT_TRUE(picture_.can_shift_to(shifted));
      view_ = shifted;
      if (i % 4 == 3) change_at_random();
      show();
      expect_as_at_once(kLayersRounding);
      if (HasFailure()) FAIL() << ratio << ", " << i;
    }
    view_.shift({3000.0, 0.0});
    EXPECT_FALSE(picture_.can_shift_to(view_)) << "nothing of the picture would be left";
    view_.fit(drawing_.size, kPictureSize);
  }
}

TEST_F(StrokePictureTest, IsAsExactAtEveryZoom) {
  for (const double factor : {1.3, 3.0, 5.0, 0.02, 9.0, 1.2}) {
    view_.zoom({150.0, 100.0}, factor);
    EXPECT_FALSE(picture_.can_shift_to(view_));
    show();
    expect_as_at_once(kOtherOutline);
  }
}

TEST_F(StrokePictureTest, TellsWhatHasChanged) {
  EXPECT_TRUE(show().isEmpty());
  const auto box = [&](const drawing::StrokePointer& stroke) {
    const drawing::Bounds2 bounds = stroke->curve.bounds();
    return QRectF(view_.to_screen(bounds.min()), view_.to_screen(bounds.max()));
  };
  strokes(1).push_back(random_stroke(random_, drawing_.next_id++));
  const QRectF there = box(strokes(1).back()) & QRectF(QPointF(), QSizeF(kPictureSize));
  const QRectF told = show();
  EXPECT_EQ(told & there, there);
  const QRectF before = box(strokes(0)[3]) & QRectF(QPointF(), QSizeF(kPictureSize));
  strokes(0)[3] = random_stroke(random_, drawing_.next_id++);
  const QRectF again = show();
  EXPECT_EQ(again & before, before) << "where it was, it must go";
}

}  // namespace
}  // namespace icome::ui
