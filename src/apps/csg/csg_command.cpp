#include "apps/csg/csg_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "apps/csg/csg_report.h"
#include "apps/csg/points_file.h"
#include "apps/interrupt.h"
#include "apps/status_line.h"
#include "apps/stopwatch.h"
#include "apps/terminal.h"
#include "base/parallel.h"
#include "files/csg/csg_reader.h"
#include "files/mesh/stl_writer.h"
#include "geometry/csg/csg_emptiness.h"
#include "geometry/csg/csg_program.h"
#include "geometry/csg/meshing/csg_mesh.h"

namespace icome::apps {
namespace {

constexpr int kCsgFailed = 1;
constexpr int kCsgInterrupted = 130;              // what shells report for Ctrl-C
constexpr double kMillimetre = 0.001;             // m
constexpr std::size_t kPointsAtOnce = 1U << 16U;  // between two looks at Ctrl-C
constexpr std::size_t kPointsWorthAThread = 4096;

/// The solid of the file, and the answers about it.
struct CsgWork {
  geometry::CsgTree tree;  // in the form
  CsgFigures figures;
  std::vector<base::Vector3> points;
  std::optional<io::NewFile> stl;
};

base::Result<void> bring_to_form(CsgWork& work, const CsgOptions& options) {
  CsgFigures& figures = work.figures;
  figures.form = options.form;
  if (options.form != geometry::CsgForm::Tree) {
    const Stopwatch watch;
    auto normalised = geometry::normalise(work.tree, options.form, {.max_nodes = options.max_nodes});
    if (!normalised) return base::fail(fmt::format("{}: {}", figures.file, normalised.error().message));
    figures.form_seconds = watch.seconds();
    figures.pruned = normalised->pruned;
    work.tree = std::move(normalised->tree);
  }
  figures.form_counted = geometry::count(work.tree);
  figures.products = count_products(work.tree);
  if (work.tree.empty()) figures.bounds = {};
  return {};
}

// Errors that are quick to find are looked for first.
base::Result<CsgWork> prepare_csg(const CsgOptions& options, StatusLine& status) {
  CsgWork work;
  if (options.mesh) {
    auto stl = io::NewFile::create(*options.mesh);
    if (!stl) return tl::unexpected(stl.error());
    work.stl.emplace(std::move(*stl));
  }
  status.say("Reading " + options.file.string());
  auto loaded = files::read_csg(options.file);
  if (!loaded) return tl::unexpected(loaded.error());
  work.figures.file = options.file.string();
  work.figures.notes = std::move(loaded->notes);
  work.figures.read_seconds = loaded->read_seconds;
  work.figures.counted = geometry::count(loaded->tree);
  work.figures.bounds = geometry::bounds(loaded->tree);
  work.tree = std::move(loaded->tree);
  if (options.inside) {
    status.say("Reading " + options.inside->string());
    auto points = read_points(*options.inside);
    if (!points) return tl::unexpected(points.error());
    work.points = std::move(*points);
  }
  status.say("Making the form");
  if (const auto formed = bring_to_form(work, options); !formed) return tl::unexpected(formed.error());
  status.clear();
  return work;
}

/// Is each point inside? Fails when it is interrupted.
base::Result<void> judge_points(CsgWork& work, StatusLine& status) {
  const geometry::CsgProgram program(work.tree);
  const std::size_t count = work.points.size();
  auto& inside = work.figures.inside.emplace(count);
  for (std::size_t begin = 0; begin < count && !interrupted(); begin += kPointsAtOnce) {
    const std::size_t size = std::min(kPointsAtOnce, count - begin);
    base::parallel_for(size, kPointsWorthAThread, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = begin + first; i < begin + last; ++i)
        inside[i] = program.inside(work.points[i]) ? 1 : 0;
    });
    status.progress("Looking where points are", static_cast<double>(begin + size), static_cast<double>(count),
                    "points");
  }
  if (interrupted()) return base::fail("interrupted");
  return {};
}

base::Result<void> make_mesh(CsgWork& work, const CsgOptions& options, StatusLine& status) {
  const geometry::Bounds& box = work.figures.bounds;
  if (box.isEmpty() || geometry::proved_empty(geometry::CsgProgram(work.tree)))
    return base::fail(work.figures.file + ": the solid is empty: there is nothing to mesh.");
  geometry::ContourOptions how;
  how.cell = options.cell_mm ? *options.cell_mm * kMillimetre : box.sizes().maxCoeff() / kCellsAlong;
  how.progress = [&](double part) {
    status.progress("Meshing", std::round(100.0 * part), 100.0, "%");
    return !interrupted();
  };
  const auto made = geometry::contour(work.tree, how);
  if (!made) return base::fail(fmt::format("{}: {}", work.figures.file, made.error().message));
  if (made->mesh.triangles.empty()) {
    return base::fail(fmt::format(
        "{}: no cell of {} mm finds anything of the solid: it is empty, or thinner than that; give "
        "a smaller --cell.",
        work.figures.file, how.cell / kMillimetre));
  }
  if (const auto& place = made->lost) {
    return base::fail(
        fmt::format("{}: parts of the solid are lost in cells of {} mm, as at ({:.4g}, {:.4g}, {:.4g}) mm; "
                    "give a smaller "
                    "--cell.",
                    work.figures.file, how.cell / kMillimetre, place->x() / kMillimetre,
                    place->y() / kMillimetre, place->z() / kMillimetre));
  }
  if (const auto written = files::write_stl(made->mesh, kMillimetre, *work.stl); !written) return written;
  if (const auto finished = work.stl->finish(); !finished) return finished;
  work.figures.mesh = {*options.mesh, made->mesh.triangles.size(), how.cell, made->error};
  return {};
}

void print_inside(const std::vector<std::uint8_t>& inside) {
  std::string text = "inside\n";
  text.reserve(text.size() + 2 * inside.size());
  for (const std::uint8_t is_inside : inside) text += is_inside != 0 ? "1\n" : "0\n";
  std::fwrite(text.data(), 1, text.size(), stdout);
}

/// One thing goes to standard output: JSON, the points' answers or the report.
bool print_csg(const CsgFigures& figures, const CsgOptions& options) {
  if (options.json) {
    print(json_report(figures) + "\n");
  } else if (figures.inside) {
    print_inside(*figures.inside);
    for (const std::string& note : figures.notes) tell(note);
    if (figures.mesh) tell(mesh_text(*figures.mesh));
  } else {
    print(text_report(figures));
  }
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return true;
  tell("standard output cannot be written: is the disk full?");
  return false;
}

}  // namespace

int run_csg(const CsgOptions& options) {
  StatusLine status;
  auto work = prepare_csg(options, status);
  status.clear();
  if (!work) {
    tell(work.error().message);
    return kCsgFailed;
  }
  catch_interrupts();
  base::Result<void> done;
  if (options.inside) done = judge_points(*work, status);
  if (done && options.mesh) done = make_mesh(*work, options, status);
  status.clear();
  if (!done) {
    tell(interrupted() ? "interrupted: nothing was written." : done.error().message);
    return interrupted() ? kCsgInterrupted : kCsgFailed;
  }
  return print_csg(work->figures, options) ? 0 : kCsgFailed;
}

}  // namespace icome::apps
