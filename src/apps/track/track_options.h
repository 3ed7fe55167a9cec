#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace CLI {  // NOLINT(readability-identifier-naming): a library's
class App;
}

namespace icome::apps {

/// The options of icome track.
struct TrackOptions {
  std::string task;  // "track", "sheet", "synth", "calibrate", "learn" or "colours"; empty: none was named
  std::string source;
  std::filesystem::path known;

  std::string pipeline = "pose";
  bool cold = false;          // every frame is searched from nothing
  std::vector<double> table;  // width and height, mm; empty: 640 x 480
  std::filesystem::path view;
  std::string camera_size;  // "640x480"
  double rate = 0;          // frames/s; 0: as it comes
  std::size_t frames = 0;   // 0: all
  double seconds = 0;       // 0: no end
  bool json = false;
  std::string tuio;  // HOST:PORT
  std::filesystem::path picture;
  std::filesystem::path truth;

  std::filesystem::path sheet;      // PDF
  std::filesystem::path calibrate;  // TOML
  std::vector<double> corners;      // pixels
  double thickness = 3.0;           // mm
  std::string id;                   // of a triangle to learn
  std::string cell;

  std::filesystem::path synth;  // folder
  std::size_t triangles = 6;
  bool hands = false, still = false, board = false;
  double occlude = 0, noise = 3, blur = 0.7, light = 1, exposure = 0, tilt = 0.15;
  int quality = 90;
  std::filesystem::path photos;
  std::uint64_t seed = 1;
};

void add_track(CLI::App& app, TrackOptions& options);

}  // namespace icome::apps
