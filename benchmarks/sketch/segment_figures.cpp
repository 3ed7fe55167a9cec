#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

#include "dense_distance.h"
#include "sketch/fit/fit_error.h"
#include "sketch_figures.h"

namespace icome::benchmarks {
namespace {

constexpr double kResolution = 0.01;      // of the bound
constexpr int kTolerances = 16;           // tried before halving
constexpr double kLeastTolerance = 0.02;  // of the bound's square, with which Paper.js compares
constexpr double kMostTolerance = 4.0;
constexpr int kBisections = 8;
// Paper.js is not scale-free: in mm, and with so many units for the bound.
constexpr std::array<double, 3> kUnitsOfBound = {0.0, 2.0, 10.0};

struct Bound {
  std::string name;
  std::function<double(const PenStroke&)> of;  // m
};

std::vector<Bound> bounds() {
  const auto fixed = [](double metres) { return [metres](const PenStroke&) { return metres; }; };
  return {{"0.1 mm", fixed(1e-4)},
          {"0.3 mm", fixed(3e-4)},
          {"1 mm", fixed(1e-3)},
          {"1/500 of the longer side", [](const PenStroke& s) { return extent_of(s) / 500.0; }}};
}

/// The verdicts of all judges on curves that count.
struct Verdicts {
  double dense_above = -std::numeric_limits<double>::infinity();  // of the bound: dense over certified
  double dense_below = 0.0;
  double worst = 0.0;  // dense, of the bound

  void add(double certified, const DenseDistance& dense) {
    dense_above = std::max(dense_above, dense.greatest - dense.error - certified);
    dense_below = std::max(dense_below, certified - dense.greatest);
    worst = std::max(worst, dense.greatest);
  }
};

/// The fewest segments that were seen within the bound, for one stroke and scale.
struct Search {
  std::size_t stroke;
  double bound;       // m
  double scale;       // of mm
  double good = 0.0;  // the greatest tolerance within the bound; of the bound's square
  double bad = std::numeric_limits<double>::infinity();  // the least above it that was not
  std::vector<CubicBezier> best = {};                    // in units of the bound

  double tolerance(double share) const {
    const double bound_in_units = 1000.0 * bound * scale;
    return share * bound_in_units * bound_in_units;
  }
};

/// Asks for a tolerance of each search, and takes note of what came.
bool try_tolerances(const PeerRun& peers, const std::vector<BenchStroke>& strokes,
                    std::vector<Search>& searches, const std::vector<double>& shares) {
  std::vector<PeerRun::Request> requests;
  for (std::size_t i = 0; i < searches.size(); ++i)
    requests.push_back({searches[i].stroke, searches[i].scale, searches[i].tolerance(shares[i])});
  const auto answers = peers.curves(requests);
  if (!answers) return false;
  for (std::size_t i = 0; i < searches.size(); ++i) {
    Search& search = searches[i];
    const PenStroke& stroke = strokes[search.stroke].stroke;
    const std::vector<CubicBezier> curve = beside_line((*answers)[i], stroke, search.bound);
    const double distance = sketch::greatest_distance(line_of(stroke, search.bound), curve, kResolution);
    if (distance <= 1.0) {
      if (shares[i] > search.good) search.good = shares[i];
      if (search.best.empty() || curve.size() < search.best.size()) search.best = curve;
    } else if (shares[i] > search.good) {
      search.bad = std::min(search.bad, shares[i]);
    }
    if (search.bad <= search.good) search.bad = std::numeric_limits<double>::infinity();
  }
  return true;
}

/// Paper.js at its best: of a row of tolerances and those between the greatest that is within the bound and
/// the next, whichever takes the fewest segments.
std::vector<Search> search_all(const PeerRun& peers, const std::vector<BenchStroke>& strokes,
                               const Bound& bound) {
  std::vector<Search> searches;
  for (std::size_t i = 0; i < strokes.size(); ++i) {
    const double metres = bound.of(strokes[i].stroke);
    for (const double units : kUnitsOfBound)
      searches.push_back({i, metres, units > 0.0 ? units / (1000.0 * metres) : 1.0});
  }
  const double step = std::pow(kMostTolerance / kLeastTolerance, 1.0 / (kTolerances - 1));
  double share = kLeastTolerance;
  for (int k = 0; k < kTolerances; ++k, share *= step)
    if (!try_tolerances(peers, strokes, searches, std::vector<double>(searches.size(), share))) return {};
  for (int k = 0; k < kBisections; ++k) {
    std::vector<double> shares;
    for (const Search& search : searches)
      shares.push_back(std::isfinite(search.bad) ? 0.5 * (search.good + search.bad) : 2.0 * search.good);
    if (!try_tolerances(peers, strokes, searches, shares)) return {};
  }
  return searches;
}

/// Our curves in units of the bound, and how many samples they break at.
struct OurFits {
  std::vector<std::vector<CubicBezier>> curves;
  std::size_t segments = 0;
  std::size_t corners = 0;
  std::size_t above = 0;  // strokes that the judge finds not within the bound
  Verdicts verdicts;
};

OurFits fit_all(const std::vector<BenchStroke>& strokes, const Bound& bound) {
  OurFits fits;
  for (const BenchStroke& named : strokes) {
    const double metres = bound.of(named.stroke);
    const sketch::FittedStroke fitted = fit_within(named.stroke, metres);
    const std::vector<Vector2> line = line_of(named.stroke, metres);
    fits.curves.push_back(beside_line(fitted.curve.segments, named.stroke, metres));
    const double certified = sketch::greatest_distance(line, fits.curves.back(), kResolution);
    fits.above += certified > 1.0 + 1e-9 ? 1 : 0;
    fits.verdicts.add(certified, dense_distance(line, fits.curves.back()));
    fits.segments += fits.curves.back().size();
    fits.corners += fitted.corners;
  }
  return fits;
}

/// The peer's segments by scale, and the best of all scales, beside ours for the same strokes.
struct Comparison {
  std::array<std::size_t, kUnitsOfBound.size()> by_scale{};
  std::array<std::size_t, kUnitsOfBound.size()> ours_by_scale{};
  std::size_t best = 0;
  std::size_t ours = 0;
  std::size_t without = 0;  // strokes for which no tolerance comes within the bound
  Verdicts verdicts;
};

Comparison compare(const std::vector<Search>& searches, const std::vector<BenchStroke>& strokes,
                   const OurFits& fits) {
  Comparison compared;
  for (std::size_t i = 0; i < strokes.size(); ++i) {
    const std::vector<CubicBezier>* best = nullptr;
    for (std::size_t k = 0; k < kUnitsOfBound.size(); ++k) {
      const Search& search = searches[i * kUnitsOfBound.size() + k];
      if (search.best.empty()) continue;
      compared.by_scale[k] += search.best.size();
      compared.ours_by_scale[k] += fits.curves[i].size();
      if (!best || search.best.size() < best->size()) best = &search.best;
    }
    if (!best) {
      ++compared.without;
      continue;
    }
    compared.best += best->size();
    compared.ours += fits.curves[i].size();
    const auto line = line_of(strokes[i].stroke, searches[i * kUnitsOfBound.size()].bound);
    compared.verdicts.add(sketch::greatest_distance(line, *best, kResolution), dense_distance(line, *best));
  }
  return compared;
}

SketchRow beside_peer_row(const std::string& figure, std::size_t ours, std::size_t peer, bool is_aim) {
  const double ratio = double(ours) / double(peer);
  return {.figure = figure,
          .unit = "count",
          .ours = fmt::format("{}", ours),
          .other = fmt::format("{}", peer),
          .ratio = fmt::format("{:.3f}", ratio),
          .to_reach = is_aim ? reached_of(ratio, 0.7) : ""};
}

std::string verdict_note(const std::string& whose, const Verdicts& verdicts) {
  return fmt::format(
      "  {}: the dense judge's greatest distance is {:.4f} of the bound, at most {:.1e} above and {:.4f} "
      "below "
      "the certified one",
      whose, verdicts.worst, std::max(0.0, verdicts.dense_above), verdicts.dense_below);
}

void add_bound(SketchSection& section, const Bound& bound, const std::vector<BenchStroke>& strokes,
               const PeerRun* peers) {
  const OurFits fits = fit_all(strokes, bound);
  section.notes.push_back(fmt::format("{}: our {} segments break at {} joints; {} strokes above the bound",
                                      bound.name, fits.segments, fits.corners, fits.above));
  section.notes.push_back(verdict_note("ours", fits.verdicts));
  const std::vector<Search> searches = peers ? search_all(*peers, strokes, bound) : std::vector<Search>{};
  if (searches.empty()) {
    section.rows.push_back({.figure = bound.name, .unit = "count", .ours = fmt::format("{}", fits.segments)});
    return;
  }
  const Comparison compared = compare(searches, strokes, fits);
  section.rows.push_back(
      beside_peer_row(bound.name + ": Paper.js, best of all scales", compared.ours, compared.best, true));
  for (std::size_t k = 0; k < kUnitsOfBound.size(); ++k) {
    const std::string scale =
        kUnitsOfBound[k] > 0.0 ? fmt::format("with {:g} units for the bound", kUnitsOfBound[k]) : "in mm";
    section.rows.push_back(
        beside_peer_row("  Paper.js " + scale, compared.ours_by_scale[k], compared.by_scale[k], false));
  }
  section.notes.push_back(verdict_note("Paper.js", compared.verdicts));
  if (compared.without > 0)
    section.notes.push_back(
        fmt::format("  Paper.js comes within the bound with no tolerance in {} strokes, "
                    "which count for neither",
                    compared.without));
}

}  // namespace

SketchSection segment_figures(const std::vector<BenchStroke>& strokes, const PeerRun* peers) {
  SketchSection section{"segments within a certified greatest distance, both ways", {}, {}};
  for (const Bound& bound : bounds()) add_bound(section, bound, strokes, peers);
  section.notes.push_back(
      "Paper.js knows no corners: its joints are smooth, and a sharp turn costs it segments. For each stroke "
      "its tolerance\nis the one with the fewest segments of 24 around the greatest that keeps the bound.");
  return section;
}

}  // namespace icome::benchmarks
