#include "apps/track/truth_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "io/file_bytes.h"

namespace icome::apps {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::uint64_t kLongestTruth = 2'000'000'000;  // bytes
// A sighting within these of the truth is right; farther off it is a ghost.
constexpr double kRightWithin = 6.0;                           // mm
constexpr double kRightTurn = 6.0 * std::numbers::pi / 180.0;  // rad

bool near_pose(const cutout::TrianglePose& one, const cutout::TrianglePose& other) {
  return (one.centroid - other.centroid).norm() < kRightWithin;
}

cutout::FrameTruth frame_of(const Json& entry, const TruthFile& truth) {
  cutout::FrameTruth frame;
  frame.time = entry.at("t").get<double>();
  frame.poses.resize(truth.ids.size());
  for (const Json& triangle : entry.at("triangles")) {
    const auto place = std::ranges::find(truth.ids, triangle.at("id").get<std::string>());
    if (place == truth.ids.end()) continue;
    frame.poses[std::size_t(place - truth.ids.begin())] = {
        {triangle.at("x_mm").get<double>(), triangle.at("y_mm").get<double>()},
        triangle.at("angle_rad").get<double>()};
  }
  return frame;
}

}  // namespace

base::Result<TruthFile> read_truth(const std::filesystem::path& path) {
  const auto bytes = io::read_bytes(path, kLongestTruth);
  if (!bytes) return tl::unexpected(bytes.error());
  TruthFile truth;
  try {
    const Json json = Json::parse(*bytes);
    truth.rate = json.at("rate").get<double>();
    truth.ids = json.at("ids").get<std::vector<std::string>>();
    for (const Json& entry : json.at("frames")) truth.frames.push_back(frame_of(entry, truth));
  } catch (const Json::exception& error) {
    return base::fail(
        fmt::format("{}: it is no truth that icome track --synth wrote: {}", path.string(), error.what()));
  }
  if (!(truth.rate > 0)) return base::fail(fmt::format("{}: the rate is not above 0", path.string()));
  return truth;
}

std::string truth_text(const TruthFile& truth) {
  std::string text =
      fmt::format("{{\"rate\": {:.17g}, \"ids\": {}, \"frames\": [", truth.rate, Json(truth.ids).dump());
  for (std::size_t i = 0; i < truth.frames.size(); ++i) {
    Json entry = {{"t", truth.frames[i].time}};
    entry["triangles"] = Json::array();
    for (std::size_t k = 0; k < truth.ids.size(); ++k) {
      const cutout::TrianglePose& pose = truth.frames[i].poses[k];
      entry["triangles"].push_back({{"id", truth.ids[k]},
                                    {"x_mm", pose.centroid.x()},
                                    {"y_mm", pose.centroid.y()},
                                    {"angle_rad", pose.angle}});
    }
    text += fmt::format("{}\n{}", i == 0 ? "" : ",", entry.dump());
  }
  return text + "\n]}\n";
}

base::Result<TruthJudge> TruthJudge::create(TruthFile truth, const cutout::KnownTriangles& known) {
  TruthJudge judge;
  for (const cutout::KnownTriangle& triangle : known.triangles) {
    const auto place = std::ranges::find(truth.ids, triangle.id);
    if (place == truth.ids.end())
      return base::fail(fmt::format(
          "the truth tells nothing of a triangle '{}'; take the known.toml beside it", triangle.id));
    judge.place_in_truth_.push_back(std::size_t(place - truth.ids.begin()));
  }
  judge.truth_ = std::move(truth);
  return judge;
}

void TruthJudge::judge(std::size_t frame, const std::vector<cutout::Sighting>& sightings) {
  if (frame >= truth_.frames.size()) return;
  const cutout::FrameTruth& truth = truth_.frames[frame];
  wanted_ += place_in_truth_.size();
  for (const cutout::Sighting& sighting : sightings) {
    const std::size_t own = place_in_truth_[sighting.triangle];
    const cutout::TrianglePose& right = truth.poses[own];
    const double turn = std::abs(std::remainder(sighting.pose.angle - right.angle, 2 * std::numbers::pi));
    if (near_pose(sighting.pose, right) && turn < kRightTurn) {
      const double miss = (sighting.pose.centroid - right.centroid).norm();
      ++found_;
      square_mm_ += miss * miss;
      square_rad_ += turn * turn;
      worst_ = std::max(worst_, miss);
      continue;
    }
    const bool other = std::ranges::any_of(place_in_truth_, [&](std::size_t place) {
      return place != own && near_pose(sighting.pose, truth.poses[place]);
    });
    ++(other ? swaps_ : ghosts_);
  }
}

double TruthJudge::position_rms() const { return found_ > 0 ? std::sqrt(square_mm_ / double(found_)) : 0.0; }
double TruthJudge::angle_rms() const { return found_ > 0 ? std::sqrt(square_rad_ / double(found_)) : 0.0; }

}  // namespace icome::apps
