#pragma once
// Small pictures and projects for tests.
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

#include "animation/picture/stage_picture.h"

namespace icome::animation {

/// An empty folder, which goes with its end.
class TestFolder {
 public:
  explicit TestFolder(std::filesystem::path path) : path_(std::move(path)) {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  TestFolder(const TestFolder&) = delete;
  TestFolder& operator=(const TestFolder&) = delete;
  ~TestFolder() { std::filesystem::remove_all(path_); }

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  void write(const std::string& name, const std::string& bytes) const {
    std::ofstream(path_ / name, std::ios::binary) << bytes;
  }
  void write_png(const std::string& name, const Pixels& pixels) const {
    const auto written = charts::write_png(image_of(pixels), path_ / name);
    if (!written) throw std::runtime_error(written.error().message);
  }

 private:
  std::filesystem::path path_;
};

/// A picture of one colour.
inline Pixels plain_pixels(int width, int height, std::uint32_t word) {
  Pixels pixels(width, height);
  std::fill(pixels.words.begin(), pixels.words.end(), word);
  return pixels;
}

/// A cell with the pivot in the middle of its picture; the stage grows no other than it is.
inline Cell& add_cell(Project& project, const std::string& picture, const Vector2& pivot,
                      const Vector2& place) {
  if (project.layers.empty()) {
    project.layers.emplace_back();
    project.layers.back().id = LayerId{project.next_id++};
    project.layers.back().name = "front";
  }
  Cell cell;
  cell.id = CellId{project.next_id++};
  cell.name = picture;
  cell.pictures = {picture};
  cell.pivot = pivot;
  cell.rest.place = place;
  project.layers.back().cells.push_back(cell);
  return project.layers.back().cells.back();
}

inline Project small_project(int width, int height) {
  Project project;
  project.stage.width = width;
  project.stage.height = height;
  project.camera.rest.place = 0.5 * Vector2(width, height);
  return project;
}

/// States by keys alone.
inline CellStates states_by_keys(const Project& project, double frame) {
  CellStates states;
  states[kCamera] = state_at(project.camera, frame);
  for (const Layer& layer : project.layers)
    for (const Cell& cell : layer.cells) states[cell.id] = state_at(cell, frame);
  return states;
}

}  // namespace icome::animation
