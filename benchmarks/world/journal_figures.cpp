#include "base/random.h"
#include "files/journal/journaled_world.h"
#include "sample_worlds.h"
#include "sqlite_journal.h"
#include "world/edit/edit_bytes.h"
#include "world_figures.h"

namespace icome::benchmarks {

using namespace world;
using files::JournaledWorld;

namespace {

constexpr const char* kPlain = "an edit that is only applied";

/// Edits that place objects here and there, one after the other.
class Drags {
 public:
  explicit Drags(const World& world) : roots_(world.roots()) {}
  Edit next() {
    const double x = random_.uniform(), y = random_.uniform();
    return PlaceObject{roots_[random_.index(roots_.size())], Affine3(Eigen::Translation3d(x, y, 0.0))};
  }

 private:
  std::vector<ObjectId> roots_;
  base::Random random_{2};
};

/// Row of edits that `perform` does; each of them is timed.
template <typename Perform>
WorldRow drags_row(const std::string& figure, const World& world, std::size_t count, Perform&& perform) {
  Drags drags(world);
  std::vector<std::int32_t> times;
  for (std::size_t i = 0; i < count; ++i) {
    const Edit edit = drags.next();
    times.push_back(timed([&] { perform(edit); }));
  }
  return timed_row(figure, times);
}

/// Row of the time per edit where many edits share one wait for the disk.
WorldRow grouped_row(JournaledWorld& journal, const WorldExtent& extent) {
  Drags drags(journal.world());
  const double seconds = median_seconds(extent.repeats, [&] {
    for (std::size_t i = 0; i < extent.group; ++i) must(journal.perform(drags.next()));
    must(journal.sync());
  });
  return {.figure = "journalled, synced every " + std::to_string(extent.group) + " edits",
          .value = seconds * 1e6 / double(extent.group)};
}

/// Row of the way of programs without a journal: the whole design is saved for each edit.
WorldRow saved_whole_row(const World& world, const WorldExtent& extent, const WorkFolder& folder) {
  const double seconds =
      median_seconds(extent.repeats, [&] { must(files::write_journal(folder / "saved.icome", world)); });
  return {.figure = "naive: the whole world saved for each edit", .value = seconds * 1e6};
}

}  // namespace

WorldSection journal_figures(const WorldExtent& extent) {
  WorldSection section{"an edit in a world of " + std::to_string(extent.objects) + " objects", {}};
  const WorkFolder folder;
  World plain = flat_world(extent.objects);
  must(files::write_journal(folder / "edits.icome", plain));
  JournaledWorld journal = must(JournaledWorld::open(folder / "edits.icome", GeometryFactory()));
  SqliteJournal sqlite(folder / "edits.sqlite", false), safe_sqlite(folder / "safe.sqlite", true);
  std::vector<WorldRow>& rows = section.rows;
  rows.push_back(drags_row(kPlain, plain, extent.edits, [&](const Edit& edit) { must(apply(plain, edit)); }));
  rows.push_back(
      drags_row("journalled", plain, extent.edits, [&](const Edit& edit) { must(journal.perform(edit)); }));
  rows.back().to_reach = 20.0;
  rows.push_back(
      drags_row("peer: applied, and an SQLite transaction", plain, extent.edits, [&](const Edit& edit) {
        must(apply(plain, edit));
        sqlite.append(must(to_bytes(edit)));
      }));
  rows.push_back(grouped_row(journal, extent));
  rows.push_back(drags_row("journalled and synced", plain, extent.synced, [&](const Edit& edit) {
    must(journal.perform(edit));
    must(journal.sync());
  }));
  rows.push_back(drags_row("peer: applied, and a synced SQLite transaction", plain, extent.synced,
                           [&](const Edit& edit) {
                             must(apply(plain, edit));
                             safe_sqlite.append(must(to_bytes(edit)));
                           }));
  rows.push_back(saved_whole_row(plain, extent, folder));
  for (std::size_t i = 1; i < rows.size(); ++i) {
    rows[i].times_of = rows[0].value;
    rows[i].of = kPlain;
  }
  return section;
}

}  // namespace icome::benchmarks
