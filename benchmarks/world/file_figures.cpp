#include <unistd.h>

#include "files/journal/journaled_world.h"
#include "sample_worlds.h"
#include "world_figures.h"

namespace icome::benchmarks {

using namespace world;
using files::JournaledWorld;

namespace {

void add_rows(const std::string& name, const World& world, const WorldExtent& extent, WorldSection& section) {
  const WorkFolder folder;
  const std::filesystem::path path = folder / "world.icome";
  const double copied = median_seconds(extent.repeats, [&] { const World copy = world; });
  const double written = median_seconds(extent.repeats, [&] { must(files::write_journal(path, world)); });
  const double opened =
      median_seconds(extent.repeats, [&] { (void)must(JournaledWorld::open(path, GeometryFactory())); });
  const auto size = double(std::filesystem::file_size(path));
  std::vector<WorldRow>& rows = section.rows;
  const std::string copy = "a copy in memory";
  rows.push_back({.figure = name + ": " + copy, .unit = "ms", .value = copied * 1e3});
  rows.push_back({.figure = name + ": written and synced",
                  .unit = "ms",
                  .value = written * 1e3,
                  .times_of = copied * 1e3,
                  .of = copy});
  rows.push_back({.figure = name + ": opened",
                  .unit = "ms",
                  .value = opened * 1e3,
                  .to_reach = 2000.0,
                  .times_of = copied * 1e3,
                  .of = copy});
  rows.push_back(
      {.figure = name + ": on disk, an object", .unit = "B", .value = size / double(world.objects().size())});
}

/// Row of reading a snapshot with as many edits behind it as there are objects, as after a long day.
WorldRow replay_row(const World& world, const WorldExtent& extent) {
  const WorkFolder folder;
  const std::filesystem::path path = folder / "world.icome";
  must(files::write_journal(path, world));
  {
    files::JournalOptions options;
    options.compact_factor = std::numeric_limits<double>::infinity();
    JournaledWorld journal = must(JournaledWorld::open(path, GeometryFactory(), options));
    const std::vector<ObjectId> roots = world.roots();
    for (std::size_t i = 0; i < extent.objects; ++i)
      must(journal.perform(RenameObject{roots[i % roots.size()], std::to_string(i)}));
  }
  const double seconds =
      median_seconds(extent.repeats, [&] { (void)must(files::read_journal(path, GeometryFactory())); });
  return {.figure = "the first with as many edits behind it: read",
          .unit = "ms",
          .value = seconds * 1e3,
          .to_reach = 2000.0};
}

}  // namespace

WorldSection file_figures(const WorldExtent& extent) {
  WorldSection section{std::to_string(extent.objects) + " objects on disk", {}};
  const World shared = grouped_world(extent.objects, false);
  add_rows("100 shapes", shared, extent, section);
  section.rows.push_back(replay_row(shared, extent));
  add_rows("a shape each", grouped_world(extent.objects, true), extent, section);
  return section;
}

}  // namespace icome::benchmarks
