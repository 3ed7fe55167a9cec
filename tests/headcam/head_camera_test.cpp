// Heads found in pictures that were drawn, where they are known.
#include "headcam/head_camera.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <thread>

#include "base/random.h"
#include "cutout/source/picture_bytes.h"
#include "headcam/camera_head.h"
#include "headcam/face_cascade.h"

namespace icome::headcam {
namespace {

using base::Vector2;
using base::Vector3;

constexpr int kWidth = 640, kHeight = 480;
constexpr double kFocal = 1.1;  // widths

HeadCamera marker_camera() {
  HeadCamera camera;
  camera.target = HeadTarget::Marker;
  camera.focal = kFocal;
  camera.size = 0.04;
  return camera;
}

/// A picture of a ball of the marker's colour at a place in the user's axes, before a room that is grey and
/// brown, with the noise of a camera. Edges are smooth, as a lens makes them.
cutout::Frame picture_of(const std::optional<Vector3>& place, base::Random& random, double light = 1.0) {
  cutout::Frame frame{kWidth, kHeight, std::vector<std::uint8_t>(3 * std::size_t(kWidth) * kHeight)};
  const double focal = kFocal * kWidth;
  Vector2 centre = Vector2::Zero();
  double radius = 0.0;
  if (place) {
    centre = {0.5 * kWidth - focal * place->x() / place->z(),
              0.5 * kHeight - focal * place->y() / place->z()};
    radius = 0.5 * focal * 0.04 / place->z();
  }
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const double brown = 0.5 + 0.5 * std::sin(0.02 * x) * std::cos(0.03 * y);
      const Vector3 room = Vector3(90.0, 100.0, 120.0) + brown * Vector3(-30.0, 10.0, 50.0);
      const double inside = std::clamp(radius + 0.5 - (Vector2(x + 0.5, y + 0.5) - centre).norm(), 0.0, 1.0);
      const Vector3 bgr = (1.0 - inside) * room + inside * Vector3(40.0, 180.0, 20.0);
      for (int i = 0; i < 3; ++i)
        frame.bgr[3 * (std::size_t(y) * kWidth + std::size_t(x)) + std::size_t(i)] =
            std::uint8_t(std::clamp(light * bgr[i] + random.uniform(-6.0, 6.0), 0.0, 255.0));
    }
  return frame;
}

TEST(MarkerFinder, FindsTheMarkerWithinMillimetres) {
  base::Random random(1);
  const auto finder = marker_finder({20, 180, 40});
  for (int i = 0; i < 40; ++i) {
    const Vector3 place(random.uniform(-0.2, 0.2), random.uniform(-0.15, 0.15), random.uniform(0.45, 0.9));
    const cutout::Frame frame = picture_of(place, random, random.uniform(0.6, 1.1));
    const auto seen = finder->find(frame.view());
    ASSERT_TRUE(seen);
    const Vector3 found = place_of(*seen, kWidth, kHeight, marker_camera());
    // Across to a fifth of a pixel or so; the distance to one in a hundred.
    EXPECT_LT((found / found.z() - place / place.z()).norm() * place.z(), 3e-4);
    EXPECT_NEAR(found.z(), place.z(), 0.012 * place.z());
  }
}

TEST(MarkerFinder, FindsNothingWhereThereIsNoMarker) {
  base::Random random(2);
  const auto finder = marker_finder({20, 180, 40});
  EXPECT_FALSE(finder->find(picture_of(std::nullopt, random).view()));
  const auto blue = marker_finder(*parse_marker_colour("blue"));
  EXPECT_FALSE(blue->find(picture_of(Vector3(0.0, 0.0, 0.6), random).view())) << "of another colour";
}

TEST(MarkerFinder, TakesTheLargestSpotAndJoinsWhatTouches) {
  // A ring and a U, whose parts meet only further down.
  cutout::Frame frame{40, 30, std::vector<std::uint8_t>(3 * 40 * 30, 128)};
  const auto paint = [&](int x, int y) {
    auto* const pixel = &frame.bgr[3 * std::size_t(y * 40 + x)];
    pixel[0] = 20, pixel[1] = 20, pixel[2] = 220;
  };
  for (int y = 5; y < 25; ++y) paint(5, y), paint(15, y);
  for (int x = 5; x <= 15; ++x) paint(x, 25);
  for (int y = 5; y < 10; ++y)
    for (int x = 25; x < 31; ++x) paint(x, y);
  const auto seen = marker_finder(*parse_marker_colour("red"))->find(frame.view());
  ASSERT_TRUE(seen);
  EXPECT_NEAR(seen->centre.x(), 10.5, 1e-9);
  EXPECT_NEAR(std::pow(0.5 * seen->size, 2.0) * M_PI, 51.0, 1e-9) << "20 + 20 + 11 pixels";
}

TEST(HeadCalibration, FindsTheFocalLength) {
  base::Random random(3);
  const auto finder = marker_finder({20, 180, 40});
  HeadCalibration calibration;
  EXPECT_FALSE(calibration.result(marker_camera(), 0.6));
  for (int i = 0; i < 5; ++i) calibration.take(picture_of(Vector3(0.05, 0.0, 0.6), random).view(), *finder);
  HeadCamera unknown = marker_camera();
  unknown.focal = 3.0;
  const auto camera = calibration.result(unknown, 0.6);
  ASSERT_TRUE(camera) << camera.error().message;
  EXPECT_NEAR(camera->focal, kFocal, 0.01 * kFocal);
  const auto read = read_head_camera(head_camera_text(*camera), "camera.toml");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_NEAR(read->focal, camera->focal, 1e-5);
  EXPECT_EQ(read->colour, camera->colour);
  EXPECT_EQ(read->target, HeadTarget::Marker);
  calibration.take(picture_of(Vector3(0.0, 0.0, 0.4), random).view(), *finder);
  for (int i = 0; i < 4; ++i) calibration.take(picture_of(Vector3(0.0, 0.0, 0.3), random).view(), *finder);
  EXPECT_FALSE(calibration.result(unknown, 0.6)) << "the head has moved";
}

TEST(HeadCamera, FaultsOfItsFileAreToldWithTheirPlace) {
  const auto told = [](const char* text) { return read_head_camera(text, "c.toml").error().message; };
  EXPECT_NE(told("target = \"face\"\nfocal_width = 1\n").find("c.toml:2:1: a head camera has no key"),
            std::string::npos);
  EXPECT_NE(told("focal_widths = 100\n").find("c.toml:1:16:"), std::string::npos);
  EXPECT_NE(told("colour = \"#808080\"\n").find("nearly grey"), std::string::npos);
}

TEST(HeadCamera, AddressesNameSourceAndSettings) {
  EXPECT_TRUE(is_head_camera_address("camera"));
  EXPECT_FALSE(is_head_camera_address("cameras:0"));
  EXPECT_EQ(parse_head_camera_address("camera")->source, "camera");
  EXPECT_EQ(parse_head_camera_address("camera:/dev/video2")->source, "/dev/video2");
  const auto marker = parse_head_camera_address("camera-marker:shots/a?.png?colour=#ff0000&size=60&field=90");
  ASSERT_TRUE(marker) << marker.error().message;
  EXPECT_EQ(marker->source, "shots/a?.png");
  EXPECT_EQ(marker->camera.colour, (MarkerColour{255, 0, 0}));
  EXPECT_DOUBLE_EQ(marker->camera.size, 0.06);
  EXPECT_NEAR(marker->camera.focal, 0.5, 1e-12);
  EXPECT_EQ(parse_head_camera_address("camera-marker?size=60")->source, "camera");
  EXPECT_NE(parse_head_camera_address("camera?colr=red").error().message.find("colour"), std::string::npos);
  EXPECT_FALSE(parse_head_camera_address("camera?size=0"));
}

/// A folder of pictures that goes with the test.
class Pictures {
 public:
  explicit Pictures(const std::vector<std::optional<Vector3>>& places)
      : folder_(std::filesystem::path(testing::TempDir()) /
                testing::UnitTest::GetInstance()->current_test_info()->name()) {
    std::filesystem::create_directories(folder_);
    base::Random random(4);
    int number = 0;
    for (const auto& it : places) {
      const auto bytes = cutout::encode_jpeg(picture_of(it, random).view(), 90);
      std::ofstream(folder_ / (std::to_string(number++) + ".jpg"), std::ios::binary) << *bytes;
    }
  }
  ~Pictures() { std::filesystem::remove_all(folder_); }
  std::string address() const {
    return "camera-marker:" + folder_.string() + "?colour=#14b428&size=40&field=48.89";
  }
  const std::filesystem::path& folder() const { return folder_; }

 private:
  std::filesystem::path folder_;
};

/// The last status that is told before `until`, at most some seconds later.
template <typename Until>
devices::DeviceStatus read_until(CameraHead& head, base::Pose& pose, const Until& until) {
  devices::DeviceStatus status = devices::DeviceStatus::Stalled;
  for (int i = 0; i < 3000; ++i) {
    status = head.read(pose);
    if (until(status)) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return status;
}

TEST(CameraHead, FollowsTheMarkerFromWhereItWasFirstSeenAndLosesIt) {
  std::vector<std::optional<Vector3>> places(15, Vector3(0.0, 0.0, 0.6));
  places.insert(places.end(), 15, Vector3(0.1, 0.05, 0.7));
  places.insert(places.end(), 30, std::nullopt);
  const Pictures pictures(places);
  auto head = CameraHead::create(pictures.address());
  ASSERT_TRUE(head) << head.error().message;
  base::Pose pose = base::Pose::Identity();
  using devices::DeviceStatus;
  EXPECT_EQ(read_until(**head, pose, [](auto status) { return status == DeviceStatus::Ok; }),
            DeviceStatus::Ok);
  EXPECT_LT(pose.translation().norm(), 0.02) << "the first place is ahead";
  read_until(**head, pose, [&](auto) { return pose.translation().x() > 0.09; });
  EXPECT_NEAR(pose.translation().x(), 0.1, 0.003);
  EXPECT_NEAR(pose.translation().y(), 0.05, 0.003);
  EXPECT_NEAR(pose.translation().z(), 0.1, 0.015);
  EXPECT_TRUE(pose.linear().isIdentity());
  EXPECT_EQ(read_until(**head, pose, [](auto status) { return status == DeviceStatus::Lost; }),
            DeviceStatus::Lost);
  EXPECT_NE((*head)->why_lost().find("marker is not found"), std::string::npos);
}

TEST(CameraHead, SaysWhatIsMissing) {
  EXPECT_NE(CameraHead::create("camera-marker:/no/such/folder").error().message.find("/no/such/folder"),
            std::string::npos);
  EXPECT_FALSE(CameraHead::create("camera-marker?colour=grey"));
  const auto face = face_finder();
  if (!face) {
    EXPECT_NE(face.error().message.find("opencv-data"), std::string::npos);
  }
  EXPECT_NE(face_finder("/no/such/cascade.xml").error().message.find("/no/such/cascade.xml"),
            std::string::npos);
}

constexpr const char* kSmallCascade = R"(<?xml version="1.0"?>
<!-- a comment -->
<opencv_storage>
<cascade type_id="opencv-cascade-classifier"><stageType>BOOST</stageType>
  <height>8</height> <width>8</width>
  <stages><_><maxWeakCount>1</maxWeakCount><stageThreshold>0.5</stageThreshold>
    <weakClassifiers><_><internalNodes>0 -1 0 0.1</internalNodes><leafValues>0. 1.</leafValues></_></weakClassifiers></_>
  </stages>
  <features><_><rects><_>0 0 4 8 -1.</_><_>4 0 4 8 1.</_></rects><tilted>0</tilted></_></features>
</cascade></opencv_storage>
)";

GreyPicture halves(int dark, int light) {
  GreyPicture picture{8, 8, {}};
  for (int i = 0; i < 64; ++i) picture.pixels.push_back(std::uint8_t(i % 8 < 4 ? dark : light));
  return picture;
}

TEST(FaceCascade, AsksRectanglesByTheContrastOfTheWindow) {
  const auto cascade = read_face_cascade(kSmallCascade, "small.xml");
  ASSERT_TRUE(cascade) << cascade.error().message;
  // Right less left, over the area times the standard deviation: 32 d / (36 d / 2), whatever d is.
  EXPECT_TRUE(is_face(*cascade, PictureSums(halves(100, 110)), 0, 0));
  EXPECT_TRUE(is_face(*cascade, PictureSums(halves(0, 255)), 0, 0));
  EXPECT_FALSE(is_face(*cascade, PictureSums(halves(110, 100)), 0, 0));
  EXPECT_FALSE(is_face(*cascade, PictureSums(halves(100, 100)), 0, 0)) << "without contrast";
}

TEST(FaceCascade, WhatIsNoCascadeIsToldWithItsLine) {
  const std::string good = kSmallCascade;
  const auto told = [](const std::string& text) {
    const auto read = read_face_cascade(text, "c.xml");
    return read ? std::string() : read.error().message;
  };
  EXPECT_EQ(told(good), "");
  EXPECT_NE(told("").find("c.xml:1:"), std::string::npos);
  EXPECT_NE(told("<a/>").find("c.xml:1: this is no cascade"), std::string::npos);
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    return told(text.replace(text.find(from), from.size(), to));
  };
  EXPECT_NE(changed("<tilted>0", "<tilted>1").find("c.xml:9: tilted"), std::string::npos);
  EXPECT_NE(changed("0 -1 0 0.1", "1 0 0 0.1 -1 0 1 0.2").find("c.xml:7:"), std::string::npos);
  EXPECT_NE(changed("0 -1 0 0.1", "0 -1 7 0.1").find("a feature is named"), std::string::npos);
  EXPECT_NE(changed("4 0 4 8 1.", "4 0 5 8 1.").find("a rectangle makes no sense"), std::string::npos);
  for (std::size_t end = 0; end < good.size(); ++end) (void)read_face_cascade(good.substr(0, end), "cut.xml");
}

}  // namespace
}  // namespace icome::headcam
