#include "devices/haply/haply_settings.h"

#include <gtest/gtest.h>

#include "devices/haply/haply_frame.h"

namespace icome::devices {
namespace {

TEST(HaplySettings, WithoutAnyTheServiceIsWhereItsMakerPutsIt) {
  const auto settings = parse_haply_settings("", "");
  ASSERT_TRUE(settings);
  EXPECT_EQ(shown_address(settings->service), "localhost:10001");
  EXPECT_EQ(settings->events_port, 10020);
  EXPECT_EQ(settings->force_field, ForceField::ByVersion);
}

TEST(HaplySettings, Places) {
  EXPECT_EQ(shown_address(parse_haply_settings("lab-7:2000", "")->service), "lab-7:2000");
  EXPECT_EQ(shown_address(parse_haply_settings("lab-7", "")->service), "lab-7:10001");
  EXPECT_EQ(shown_address(parse_haply_settings("[::1]:7", "")->service), "[::1]:7");
  EXPECT_EQ(shown_address(parse_haply_settings("[::1]", "")->service), "[::1]:10001");
  for (const char* const wrong :
       {":1", "a:", "a:0", "a:65536", "a:x", "a:1x", "[::1", "[]:1", "[::1]x", "a:1:2"}) {
    const auto refused = parse_haply_settings(wrong, "");
    ASSERT_FALSE(refused) << wrong;
    EXPECT_NE(refused.error().message.find("ICOME_HAPLY"), std::string::npos);
    EXPECT_NE(refused.error().message.find("HOST:PORT"), std::string::npos);
  }
}

TEST(HaplySettings, OptionsInAnyOrder) {
  const auto settings = parse_haply_settings("",
                                             " middle=0.01,-0.2,0.3  rate=2000 grip=61576 events=0 "
                                             "patience=0.5 force=values connect=2 axes=-xy-z ");
  ASSERT_TRUE(settings) << settings.error().message;
  EXPECT_EQ(settings->middle, base::Vector3(0.01, -0.2, 0.3));
  EXPECT_EQ(settings->rate, 2000.0);
  EXPECT_EQ(settings->grip, "61576");
  EXPECT_EQ(settings->events_port, 0);
  EXPECT_EQ(settings->patience, 0.5);
  EXPECT_EQ(settings->connect_patience, 2.0);
  EXPECT_EQ(settings->force_field, ForceField::Values);
  EXPECT_TRUE((settings->axes * base::Vector3(1, 2, 3)).isApprox(base::Vector3(-1, 2, -3)));
}

TEST(HaplySettings, AnOptionThatMakesNoSenseIsASentence) {
  for (const char* const wrong : {"rate=50",    "rate=249",   "rate=nan",     "rate=1e999",   "rate",
                                  "rate=",      "patience=0", "events=65536", "events=1.5",   "force=torque",
                                  "grip=",      "axes=xy",    "axes=xyzx",    "axes=xxz",     "axes=xzy",
                                  "axes=--xyz", "axes=",      "middle=0,0",   "middle=0,0,2", "middle=a,0,0",
                                  "colour=red", "="}) {
    const auto refused = parse_haply_settings("", wrong);
    ASSERT_FALSE(refused) << wrong;
    EXPECT_NE(refused.error().message.find("ICOME_HAPLY_OPTIONS"), std::string::npos);
  }
}

TEST(HaplyFrame, KnownPoses) {
  const HaplySettings settings;
  const HaplyFrame frame(settings);
  ServiceArm arm;
  const auto place_of = [&](const Vector3& from_middle) {
    arm.position = settings.middle + from_middle;
    return frame.state_of(arm, nullptr).position;
  };
  EXPECT_TRUE(place_of({0, 0, 0}).isZero(1e-15));                             // the middle
  EXPECT_TRUE(place_of({0.05, 0, 0}).isApprox(Vector3(0.05, 0, 0), 1e-12));   // right
  EXPECT_TRUE(place_of({0, 0.05, 0}).isApprox(Vector3(0, 0, -0.05), 1e-12));  // away from the user
  EXPECT_TRUE(place_of({0, 0, 0.05}).isApprox(Vector3(0, 0.05, 0), 1e-12));   // up
  arm.velocity = {0.1, 0.2, 0.3};
  EXPECT_TRUE(frame.state_of(arm, nullptr).velocity.isApprox(Vector3(0.1, 0.3, -0.2), 1e-12));
  // A force goes the other way: up, in our frame, is the service's z.
  EXPECT_TRUE(frame.service_force({1, 2, 3}).isApprox(Vector3(1, -3, 2), 1e-12));
}

TEST(HaplyFrame, KnownOrientations) {
  const HaplyFrame frame{HaplySettings()};
  ServiceArm arm;
  ServiceGrip grip;
  EXPECT_TRUE(frame.state_of(arm, &grip).orientation.isApprox(Quaternion::Identity(), 1e-12));
  // A grip points along its own y, and a stylus along its own -z. Turned to the left by a quarter turn about
  // the upright axis, both point to the left.
  grip.orientation = Eigen::AngleAxisd(M_PI / 2, Vector3::UnitZ());
  const PointerState left = frame.state_of(arm, &grip);
  EXPECT_TRUE((left.orientation * Vector3(0, 0, -1)).isApprox(Vector3(-1, 0, 0), 1e-12));
  // Turned about the axis to the right, it points up.
  grip.orientation = Eigen::AngleAxisd(M_PI / 2, Vector3::UnitX());
  const PointerState up = frame.state_of(arm, &grip);
  EXPECT_TRUE((up.orientation * Vector3(0, 0, -1)).isApprox(Vector3(0, 1, 0), 1e-12));
}

}  // namespace
}  // namespace icome::devices
