#include "animation/picture/laying.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "animation/picture/small_project.h"

namespace icome::animation {
namespace {

constexpr std::uint32_t kWhite = 0xffffffffU;

int channel(std::uint32_t word, unsigned place) { return int(word >> (8 * place) & 0xffU); }

Pixels noise(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  Pixels pixels(width, height);
  for (std::uint32_t& word : pixels.words)
    word = premultiplied(random() & 0xffU, random() & 0xffU, random() & 0xffU, random() & 0xffU);
  return pixels;
}

/// "Over" as its authors give it (Porter and Duff 1984), in doubles.
double over_by_formula(double above, double above_alpha, double below) {
  return above + below * (1 - above_alpha / 255);
}

TEST(Laying, CopiesExactlyWhereNothingIsTurnedOrScaled) {
  const Pixels picture = noise(13, 9, 1);
  Pixels onto(20, 20);
  lay(picture, Affine2(Eigen::Translation2d(3, 5)), {}, onto, {0, 20});
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 20; ++x) {
      const bool within = x >= 3 && x < 16 && y >= 5 && y < 14;
      EXPECT_EQ(onto.row(y)[x], within ? picture.row(y - 5)[x - 3] : 0U) << x << ' ' << y;
    }
}

TEST(Laying, MixesByOverWithEveryOpacity) {
  const Pixels picture = noise(16, 16, 2);
  const Pixels ground = noise(16, 16, 3);
  for (const double opacity : {0.0, 0.25, 0.5, 0.9, 1.0}) {
    Pixels onto = ground;
    lay(picture, Affine2::Identity(), {opacity, {}}, onto, {0, 16});
    for (std::size_t i = 0; i < onto.words.size(); ++i)
      for (unsigned c = 0; c < 4; ++c)
        EXPECT_NEAR(channel(onto.words[i], c),
                    over_by_formula(opacity * channel(picture.words[i], c),
                                    opacity * channel(picture.words[i], 3), channel(ground.words[i], c)),
                    1.6);
  }
}

/// The part of a unit square at (x, y) that lies in a square of half side `half`, turned by `angle` about
/// `middle`: by samples near its rim.
double sampled_coverage(int x, int y, const Vector2& middle, double half, double angle) {
  constexpr int kSide = 32;
  const Vector2 centre = Eigen::Rotation2Dd(-angle) * (Vector2(x + 0.5, y + 0.5) - middle);
  const double from_rim = centre.cwiseAbs().maxCoeff() - half;
  if (std::abs(from_rim) > 1) return from_rim < 0 ? 1 : 0;
  int inside = 0;
  for (int i = 0; i < kSide; ++i)
    for (int k = 0; k < kSide; ++k) {
      const Vector2 at =
          Eigen::Rotation2Dd(-angle) * (Vector2(x + (i + 0.5) / kSide, y + (k + 0.5) / kSide) - middle);
      if (at.cwiseAbs().maxCoeff() <= half) ++inside;
    }
  return double(inside) / (kSide * kSide);
}

TEST(Laying, TurnedAndScaledSquaresCoverWhatGeometrySays) {
  const Pixels square = plain_pixels(20, 20, kWhite);
  for (const double angle : {0.0, 0.1, 0.4, std::numbers::pi / 4, 1.3, 3.0}) {
    for (const double scale : {0.75, 1.0, 1.7}) {
      const Vector2 middle(30.3, 28.6);
      const Affine2 onto_from_picture = Eigen::Translation2d(middle) * Eigen::Rotation2Dd(angle) *
                                        Eigen::Scaling(scale) * Eigen::Translation2d(-10, -10);
      Pixels onto(60, 60);
      lay(square, onto_from_picture, {}, onto, {0, 60});
      double area = 0;
      for (int y = 0; y < 60; ++y)
        for (int x = 0; x < 60; ++x) {
          const double covered = alpha_of(onto.row(y)[x]) / 255.0;
          area += covered;
          ASSERT_NEAR(covered, sampled_coverage(x, y, middle, 10 * scale, angle), 0.13)
              << x << ' ' << y << " angle " << angle << " scale " << scale;
        }
      EXPECT_NEAR(area, 400 * scale * scale, 0.02 * 80 * scale);
    }
  }
}

TEST(Laying, GivesTheLinearBlendBetweenPixels) {
  // A slope along x, seen at 1/1.5 of its size and turned: the picture is linear, so its mix is exact.
  Pixels slope(128, 128);
  for (int y = 0; y < 128; ++y)
    for (int x = 0; x < 128; ++x)
      slope.row(y)[x] = premultiplied(unsigned(x), unsigned(2 * x), unsigned(y), 255);
  const Affine2 onto_from_picture = Eigen::Translation2d(50, 50) * Eigen::Rotation2Dd(0.3) *
                                    Eigen::Scaling(0.7) * Eigen::Translation2d(-64, -64);
  Pixels onto(100, 100);
  lay(slope, onto_from_picture, {}, onto, {0, 100});
  const Affine2 back = onto_from_picture.inverse();
  for (int y = 30; y < 70; ++y)
    for (int x = 30; x < 70; ++x) {
      const Vector2 at = back * Vector2(x + 0.5, y + 0.5) - Vector2(0.5, 0.5);
      EXPECT_NEAR(channel(onto.row(y)[x], 2), at.x(), 0.6);
      EXPECT_NEAR(channel(onto.row(y)[x], 1), 2 * at.x(), 0.6);
      EXPECT_NEAR(channel(onto.row(y)[x], 0), at.y(), 0.6);
    }
}

TEST(Laying, IsTheSameInStripsAndWithoutVectors) {
  const Pixels picture = noise(40, 30, 4);
  const Affine2 onto_from_picture = Eigen::Translation2d(33, 31) * Eigen::Rotation2Dd(-0.7) *
                                    Eigen::Scaling(1.2) * Eigen::Translation2d(-20, -15);
  const Pixels ground = noise(64, 64, 5);
  Pixels whole = ground, strips = ground, plain = ground;
  lay(picture, onto_from_picture, {0.6, {}}, whole, {0, 64});
  for (int y = 0; y < 64; y += 7)
    lay(picture, onto_from_picture, {0.6, {}}, strips, {y, std::min(64, y + 7)});
  EXPECT_EQ(whole.words, strips.words);
  // The least tint takes the loop for single channels, and changes no colour by more than a step.
  lay(picture, onto_from_picture, {0.6, {{0.5F, 0.5F, 0.5F}, 1.0 / 256}}, plain, {0, 64});
  for (std::size_t i = 0; i < whole.words.size(); ++i)
    for (unsigned c = 0; c < 4; ++c) EXPECT_NEAR(channel(whole.words[i], c), channel(plain.words[i], c), 2);
}

TEST(Laying, TintsTowardsASilhouette) {
  const Pixels picture = noise(8, 8, 6);
  Pixels onto(8, 8);
  lay(picture, Affine2::Identity(), {1, {{1.0F, 0.0F, 0.0F}, 1}}, onto, {0, 8});
  for (std::size_t i = 0; i < onto.words.size(); ++i) {
    EXPECT_EQ(channel(onto.words[i], 3), channel(picture.words[i], 3));
    EXPECT_NEAR(channel(onto.words[i], 2), channel(picture.words[i], 3), 1);
    EXPECT_EQ(channel(onto.words[i], 1), 0);
  }
}

TEST(Laying, EvenlyIsAsByATransformThatChangesNothing) {
  const Pixels picture = noise(30, 20, 9), ground = noise(30, 20, 10);
  for (const double share : {0.0, 0.3, 0.6, 1.0})
    for (const double opacity : {0.0, 0.3, 1.0}) {
      const LayingLook look = {opacity, {{0.9F, 0.2F, 0.4F}, share}};
      Pixels one = ground, other = ground;
      lay(picture, Affine2::Identity(), look, one, {0, 20});
      lay_even(picture, 0, look, other, {0, 20});
      EXPECT_EQ(one.words, other.words) << share << ' ' << opacity;
    }
}

TEST(Laying, DrawsNothingByNonsense) {
  const Pixels picture = plain_pixels(4, 4, kWhite);
  Pixels onto(8, 8);
  Affine2 flat = Affine2::Identity(), wild = Affine2::Identity(),
          far = Affine2(Eigen::Translation2d(1e18, -1e18));
  flat.linear().setZero();
  wild.linear()(0, 0) = std::nan("");
  for (const Affine2& each : {flat, wild, far}) lay(picture, each, {}, onto, {0, 8});
  EXPECT_EQ(onto.words, Pixels(8, 8).words);
  lay(picture, Affine2(Eigen::Scaling(1e9)), {}, onto, {0, 8});
  EXPECT_EQ(onto.words, plain_pixels(8, 8, kWhite).words);
}

TEST(Shrunk, KeepsTheMeanOfEveryChannel) {
  const Pixels picture = noise(90, 70, 7);
  for (const auto& [width, height] :
       {std::pair(64, 50), std::pair(45, 35), std::pair(1, 1), std::pair(90, 70)}) {
    const Pixels small = shrunk(picture, width, height);
    for (unsigned c = 0; c < 4; ++c) {
      double before = 0, after = 0;
      for (const std::uint32_t word : picture.words) before += channel(word, c);
      for (const std::uint32_t word : small.words) after += channel(word, c);
      EXPECT_NEAR(before / double(picture.words.size()), after / double(small.words.size()), 0.6);
    }
    for (const std::uint32_t word : small.words)
      for (unsigned c = 0; c < 3; ++c) ASSERT_LE(channel(word, c), channel(word, 3));
  }
  EXPECT_EQ(shrunk(picture, 90, 70).words, picture.words);
}

TEST(Pixels, ComeBackFromPicturesWithoutPremultiplying) {
  const Pixels picture = noise(30, 30, 8);
  const Pixels back = pixels_of(image_of(picture));
  for (std::size_t i = 0; i < picture.words.size(); ++i)
    for (unsigned c = 0; c < 4; ++c) EXPECT_NEAR(channel(back.words[i], c), channel(picture.words[i], c), 1);
}

}  // namespace
}  // namespace icome::animation
