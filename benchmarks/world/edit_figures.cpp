#include <malloc.h>

#include "base/random.h"
#include "sample_worlds.h"
#include "world_figures.h"

namespace icome::benchmarks {

using namespace world;

namespace {

constexpr double kTargetUs = 20.0;

/// Times edits of one kind, which `make` makes one after the other, and then taking each of them back.
template <typename Make>
void add_rows(const std::string& name, World& world, const WorldExtent& extent, WorldSection& section,
              Make&& make) {
  std::vector<std::int32_t> there, back;
  std::vector<Edit> inverses;
  for (std::size_t i = 0; i < extent.edits; ++i) {
    const Edit edit = make(i);
    there.push_back(timed([&] { inverses.push_back(must(apply(world, edit))); }));
  }
  for (auto it = inverses.rbegin(); it != inverses.rend(); ++it)
    back.push_back(timed([&] { must(apply(world, *it)); }));
  for (const auto& [what, times] : {std::pair(name, &there), std::pair(name + ", taken back", &back)}) {
    section.rows.push_back(timed_row(what, *times));
    section.rows.back().to_reach = kTargetUs;
  }
}

std::size_t memory_in_use() {
  const struct mallinfo2 info = ::mallinfo2();
  return info.uordblks + info.hblkhd;
}

WorldRow memory_row(const std::string& figure, const WorldExtent& extent, bool own_shapes) {
  const std::size_t before = memory_in_use();
  const World world = grouped_world(extent.objects, own_shapes);
  return {.figure = figure,
          .unit = "B",
          .value = double(memory_in_use() - before) / double(world.objects().size())};
}

}  // namespace

WorldSection edit_figures(const WorldExtent& extent) {
  WorldSection section{"edits among " + std::to_string(extent.objects) + " roots, and memory", {}};
  World world = flat_world(extent.objects);
  IdSource ids(0, world.next_number(0));
  base::Random random(1);
  const auto any = [&] { return world.roots()[random.index(world.roots().size())]; };
  const auto fresh = [&](std::size_t place) {
    return CreateObject{ids.next<ObjectId>(), place, {.name = "new"}};
  };
  add_rows("place an object", world, extent, section, [&](std::size_t i) {
    return PlaceObject{any(), Affine3(Eigen::Translation3d(double(i), 0.0, 0.0))};
  });
  add_rows("rename an object", world, extent, section, [&](std::size_t i) {
    return RenameObject{any(), std::to_string(i)};
  });
  add_rows("create an object behind all", world, extent, section,
           [&](std::size_t) { return fresh(world.roots().size()); });
  add_rows("create an object before all", world, extent, section, [&](std::size_t) { return fresh(0); });
  add_rows("create an object anywhere", world, extent, section,
           [&](std::size_t) { return fresh(random.index(world.roots().size())); });
  add_rows("delete any object", world, extent, section, [&](std::size_t) { return DeleteObject{any()}; });
  add_rows("delete the first object", world, extent, section,
           [&](std::size_t) { return DeleteObject{world.roots().front()}; });
  add_rows("move any object anywhere", world, extent, section, [&](std::size_t) {
    return MoveObject{any(), {}, random.index(world.roots().size())};
  });
  section.rows.push_back(memory_row("memory an object of 100 shapes", extent, false));
  section.rows.push_back(memory_row("memory an object with a shape of its own", extent, true));
  return section;
}

}  // namespace icome::benchmarks
