// Measures cut-out animations: from a frame of the table to the picture on the stage, constraints, drawing.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include "animation/files/project_file.h"
#include "animation/motion/hands.h"
#include "animation/picture/stage_picture.h"
#include "base/clock.h"
#include "base/random.h"
#include "cutout/synth/synthetic_table.h"
#include "places.h"

namespace icome::benchmarks {
namespace {

using animation::CellId;
using animation::CellStates;
using animation::Project;

constexpr double kMillisecond = 1e-6;  // of a nanosecond

double milliseconds_of(const std::function<void()>& work) {
  const std::int64_t begin = base::steady_nanoseconds();
  work();
  return double(base::steady_nanoseconds() - begin) * kMillisecond;
}

void print_times(const std::string& what, std::vector<double> times) {
  std::ranges::sort(times);
  const auto at = [&](double part) {
    return times[std::min(times.size() - 1, std::size_t(part * double(times.size())))];
  };
  fmt::print("{:<56} {:8.3f} {:8.3f} {:8.3f}\n", what, at(0.5), at(0.99), times.back());
}

void perform(Project& project, const animation::ProjectEdit& edit) {
  if (const auto done = apply_edit(project, edit); !done) {
    fmt::print(stderr, "{}\n", done.error().message);
    std::exit(1);
  }
}

/// A cell with that picture, on layer 2.
animation::PutCell cell_of(std::uint64_t number, const std::string& picture, const base::Vector2& place) {
  animation::Cell cell;
  cell.id = CellId{number};
  cell.name = fmt::format("cell {}", number);
  cell.pictures = {picture};
  cell.pivot = {150, 150};
  cell.rest.place = place;
  return {animation::LayerId{2}, number - 10, cell};
}

/// As many cells as there are triangles, which move one each.
Project tangible_project(const cutout::KnownTriangles& known) {
  Project project;
  perform(project, {animation::PutLayer{animation::LayerId{2}, 0, {.name = "cells"}}});
  for (std::size_t i = 0; i < known.triangles.size(); ++i) {
    const std::uint64_t number = 10 + i;
    const std::string& id = known.triangles[i].id;
    perform(project, {cell_of(number, "boat.svg", {640, 360}),
                      animation::ChangeMapping{
                          id, animation::Mapping{id, animation::MappingMode::Absolute, CellId{number}}}});
  }
  return project;
}

/// The time from a frame that has arrived to the pixels of the stage: finding triangles, moving cells,
/// constraints, drawing. Showing these pixels is the window's.
void print_frame_to_picture(int frames) {
  cutout::SyntheticOptions options;
  options.known = cutout::usual_triangles(12);
  options.frames = frames;
  const cutout::SyntheticTable table(options);
  const auto tracker = cutout::make_pose_tracker(options.known, table.view());
  const Project project = tangible_project(options.known);
  const auto map = animation::TableMap::fitting(options.table_width, options.table_height, project.stage);
  animation::CellPictures pictures(places::project_folder() / "data" / "cutout" / "boat");
  animation::Pixels pixels(project.stage.width, project.stage.height);
  animation::Hands hands;
  CellStates states = animation::states_at(project, 0);
  std::vector<double> finding, moving, drawing, all;
  for (int number = 0; number < frames; ++number) {
    const cutout::SyntheticTable::Made made = table.make(number);
    std::vector<animation::TriangleOnTable> triangles;
    finding.push_back(milliseconds_of([&] {
      const auto seen = tracker->see(made.frame.view(), made.truth.time);
      if (!seen) std::abort();  // frames have the view's size
      for (const cutout::Sighting& one : *seen)
        triangles.push_back(
            {options.known.triangles[one.triangle].id, one.pose.centroid, one.pose.angle, one.confidence});
    }));
    moving.push_back(milliseconds_of([&] {
      const auto none = [](const base::Vector2&) { return CellId{}; };
      const animation::Moves moves = hands.next(project, states, triangles, made.truth.time, map, none);
      states = animation::solved(project, states, moves.holds(), &states).states;
    }));
    drawing.push_back(milliseconds_of([&] { draw_frame(project, states, pictures, {}, pixels); }));
    all.push_back(finding.back() + moving.back() + drawing.back());
  }
  print_times("find 12 triangles in a frame of 640x480, following", finding);
  print_times("move 12 cells by them", moving);
  print_times("draw 12 cells of 360x400 px on 1280x720", drawing);
  print_times("frame to picture, these together", all);
}

/// Trees of joints, distances and paths under a hand that wanders.
void print_constraints(int rounds) {
  constexpr std::uint64_t kCells = 100;
  Project project;
  perform(project, {animation::PutLayer{animation::LayerId{2}, 0, {.name = "cells"}}});
  for (std::uint64_t i = 0; i < kCells; ++i)
    perform(project,
            {cell_of(10 + i, "boat.svg", {100.0 + 40 * double(i % 10), 100.0 + 40 * double(i / 10)})});
  std::uint64_t number = 1000;
  const auto add = [&](decltype(animation::Constraint::what) what) {
    perform(project, {animation::PutConstraint{project.constraints.size(),
                                               {animation::ConstraintId{number++}, std::move(what)}}});
  };
  for (std::uint64_t i = 1; i < kCells; ++i) {
    animation::Joint joint;
    joint.parent = CellId{10 + (i - 1) / 2};
    joint.child = CellId{10 + i};
    joint.on_child = {150, 130};
    joint.on_parent = {150, 170};
    add(joint);
  }
  const auto print = [&](const std::string& what) {
    base::Random random(1);
    CellStates states = animation::states_at(project, 0);
    base::Vector2 hand = states.at(CellId{10}).place;
    std::vector<double> times;
    for (int i = 0; i < rounds; ++i) {
      hand += base::Vector2(random.uniform(-8, 8), random.uniform(-8, 8));
      animation::CellState wish = states.at(CellId{10});
      wish.place = hand;
      wish.angle += random.uniform(-0.05, 0.05);
      const animation::Hold hold = {CellId{10}, wish};
      times.push_back(milliseconds_of(
          [&] { states = animation::solved(project, states, std::span(&hold, 1), &states).states; }));
    }
    print_times(what, times);
  };
  print("100 cells, 99 joints, one held");
  for (std::uint64_t i = 0; i < 20; ++i)
    add(animation::DistanceLimit{CellId{10 + i}, CellId{109 - i}, {150, 150}, {150, 150}, 20, 600});
  print("the same and 20 distances");
  for (std::uint64_t i = 0; i < 5; ++i)
    add(animation::PathGuide{CellId{60 + 7 * i}, {150, 150}, {{0, 0}, {400, 300}, {800, 100}}, false, false});
  print("the same and 5 paths (more than can be kept at once)");
}

void print_examples(int rounds) {
  for (const char* name : {"boat", "walk"}) {
    const auto folder = places::project_folder() / "data" / "cutout" / name;
    const auto read = animation::read_project_file(folder / fmt::format("{}.cutout", name));
    if (!read) {
      fmt::print(stderr, "{}\n", read.error().message);
      std::exit(1);
    }
    animation::CellPictures pictures(folder);
    animation::Pixels pixels(read->project.stage.width, read->project.stage.height);
    std::vector<double> states, drawing;
    for (int i = 0; i < rounds; ++i) {
      const int frame = i % read->project.stage.length;
      CellStates at;
      states.push_back(milliseconds_of([&] { at = animation::states_at(read->project, frame); }));
      drawing.push_back(milliseconds_of([&] { draw_frame(read->project, at, pictures, {}, pixels); }));
    }
    print_times(fmt::format("{}: cells of a frame, constraints kept", name), states);
    print_times(fmt::format("{}: frame of 1280x720 ({} cells)", name, read->project.cell_count()), drawing);
  }
}

}  // namespace
}  // namespace icome::benchmarks

int main(int argc, char** argv) {
  CLI::App app("Measures cut-out animations on computed frames and the examples");
  bool quick = false;
  app.add_flag("--quick", quick, "Few frames, to see that it runs");
  CLI11_PARSE(app, argc, argv);
  fmt::print("{:<56} {:>8} {:>8} {:>8}\n", "ms", "median", "p99", "worst");
  icome::benchmarks::print_frame_to_picture(quick ? 10 : 600);
  icome::benchmarks::print_constraints(quick ? 20 : 2000);
  icome::benchmarks::print_examples(quick ? 10 : 400);
}
