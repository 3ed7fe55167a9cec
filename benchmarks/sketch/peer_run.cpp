#include "peer_run.h"

#include <fmt/format.h>
#include <fmt/os.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace icome::benchmarks {
namespace {

constexpr double kMillimetre = 0.001;  // m

bool runs_there(const std::filesystem::path& folder, const std::string& command) {
  return std::system(fmt::format("cd '{}' && {}", folder.string(), command).c_str()) == 0;
}

void write_strokes(const std::filesystem::path& file, const std::vector<BenchStroke>& strokes) {
  std::ofstream out(file);
  for (const BenchStroke& named : strokes) {
    const char* gap = "";
    for (const sketch::PenSample& sample : named.stroke) {
      out << fmt::format("{}{} {} {}", gap, sample.place.x() / kMillimetre, sample.place.y() / kMillimetre,
                         sample.pressure);
      gap = " ";
    }
    out << '\n';
  }
}

std::vector<CubicBezier> cubics_of(const std::string& text) {
  std::istringstream numbers(text);
  std::vector<CubicBezier> cubics;
  CubicBezier cubic;
  std::size_t next = 0;
  for (double x = 0.0, y = 0.0; numbers >> x >> y;) {
    cubic.points[next] = kMillimetre * Vector2(x, y);
    next = (next + 1) % cubic.points.size();
    if (next == 0) cubics.push_back(cubic);
  }
  return cubics;
}

}  // namespace

PeerRun::PeerRun(const std::filesystem::path& source, const std::filesystem::path& within,
                 const std::vector<BenchStroke>& strokes)
    : folder_(within / fmt::format("icome-sketch-peers-{}", ::getpid())) {
  std::filesystem::copy(source, folder_, std::filesystem::copy_options::recursive);
  write_strokes(folder_ / "strokes.txt", strokes);
  is_there_ = runs_there(folder_, "npm ci --no-audit --no-fund > /dev/null 2>&1");
}

PeerRun::~PeerRun() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

std::optional<std::vector<std::vector<CubicBezier>>> PeerRun::curves(
    const std::vector<Request>& requests) const {
  std::ofstream out(folder_ / "requests.txt");
  for (const Request& request : requests)
    out << fmt::format("{} {} {}\n", request.stroke, request.scale, request.tolerance);
  out.close();
  if (!runs_there(folder_, "node peers.mjs curves strokes.txt requests.txt curves.txt")) return {};
  std::vector<std::vector<CubicBezier>> answers;
  std::ifstream in(folder_ / "curves.txt");
  for (std::string line; std::getline(in, line);) answers.push_back(cubics_of(line));
  if (answers.size() != requests.size()) return {};
  return answers;
}

std::vector<PeerRun::Line> PeerRun::refits(double scale, double tolerance) const {
  return lines_of(fmt::format("refit strokes.txt {} {}", scale, tolerance));
}

std::vector<PeerRun::Line> PeerRun::outlines(double size, double thinning) const {
  return lines_of(fmt::format("outline strokes.txt {} {}", size, thinning));
}

std::vector<PeerRun::Line> PeerRun::lines_of(const std::string& arguments) const {
  std::vector<Line> lines;
  if (!runs_there(folder_, fmt::format("node peers.mjs {} > lines.txt", arguments))) return lines;
  std::ifstream in(folder_ / "lines.txt");
  for (Line line{}; in >> line.count >> line.us;) lines.push_back(line);
  return lines;
}

}  // namespace icome::benchmarks
