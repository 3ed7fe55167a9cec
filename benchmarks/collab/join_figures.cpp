#include "join_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>

#include "base/clock.h"
#include "collab/client/connection.h"
#include "collab/client/joining.h"
#include "collab/content/content_cache.h"
#include "geometry/mesh/geodesic_sphere.h"
#include "server_process.h"
#include "world/edit/edit.h"
#include "world/shape/mesh_geometry.h"

namespace icome::benchmarks {
namespace {

using namespace collab;
constexpr std::chrono::seconds kPatience{30};

double seconds_since(std::int64_t begin) { return 1e-9 * double(base::steady_nanoseconds() - begin); }

bool never() { return false; }

std::unique_ptr<Connection> connection_to(const DesignAddress& address, const ContentCachePointer& cache) {
  return demand(Connection::create(address, demand(new_identity("bench")), cache));
}

void wait_for(Connection& connection, const std::function<bool()>& done) {
  (void)demand(connection.work_until(done, never, kPatience));
}

/// Joins; `objects` at least are in the design then.
std::unique_ptr<Connection> joined(const DesignAddress& address, const ContentCachePointer& cache = nullptr,
                                   std::size_t objects = 0) {
  auto connection = connection_to(address, cache);
  const Conversation& talk = connection->talk();
  wait_for(*connection, [&] { return talk.state() == ConversationState::Live; });
  if (talk.replica().world().objects().size() < objects) demand<void>(base::fail("The design is not whole."));
  return connection;
}

/// Performs the edit, and waits until it is durable.
void put(const DesignAddress& address, const std::function<world::Edit(world::IdSource&)>& make) {
  const auto connection = joined(address);
  Conversation& talk = connection->talk();
  world::IdSource ids(talk.replica().author());
  (void)demand(talk.perform(make(ids), "Put in"));
  wait_for(*connection, [&] { return talk.replica().unacknowledged() == 0; });
}

world::Edit ball(world::IdSource& ids, int frequency) {
  world::EditGroup group;
  const auto shape = ids.next<world::GeometryId>();
  group.edits.emplace_back(world::CreateGeometry{
      shape,
      std::make_shared<world::MeshGeometry>(geometry::bumpy_geodesic_sphere(frequency, 0.1, 0.005, 8))});
  group.edits.emplace_back(
      world::CreateObject{ids.next<world::ObjectId>(), 0, {.name = "ball", .geometry = shape}});
  return group;
}

world::Edit many_objects(world::IdSource& ids, int count) {
  world::EditGroup group;
  for (int i = 0; i < count; ++i) {
    world::PhysicalObject object{.name = fmt::format("object {}", i)};
    object.parent_from_object.translation().x() = 0.01 * i;
    group.edits.emplace_back(world::CreateObject{ids.next<world::ObjectId>(), std::uint64_t(i), object});
  }
  return group;
}

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

/// The median of so many joins, each by a new program as far as the server can tell.
double join_time(const DesignAddress& address, std::size_t objects, int times,
                 const ContentCachePointer& cache = nullptr) {
  std::vector<double> took;
  for (int i = 0; i < times; ++i) {
    const std::int64_t begin = base::steady_nanoseconds();
    const auto connection = joined(address, cache, objects);
    took.push_back(seconds_since(begin));
  }
  return median(std::move(took));
}

/// From the kill of a server, which is started anew at once, until all of its clients are at work again.
double restart_time(const std::filesystem::path& program, const std::filesystem::path& folder, int clients) {
  const BenchFolder store(folder);
  auto server = std::make_unique<ServerProcess>(program, store.path());
  const DesignAddress address = server->invite("restart");
  std::vector<std::unique_ptr<Connection>> crowd;
  for (int i = 0; i < clients; ++i) {
    crowd.push_back(joined(address));
    Conversation& talk = crowd.back()->talk();
    world::IdSource ids(talk.replica().author());
    (void)demand(talk.perform(world::CreateObject{ids.next<world::ObjectId>(), 0, {.name = "mine"}}, "Mine"));
  }
  const auto all_are_live = [&](bool live) {
    return std::ranges::all_of(crowd, [live](const auto& it) {
      it->work();
      return (it->talk().state() == ConversationState::Live) == live &&
             (!live || it->talk().replica().unacknowledged() == 0);
    });
  };
  while (!all_are_live(true)) {
  }
  const std::int64_t begin = base::steady_nanoseconds();
  server->kill();
  while (!all_are_live(false)) {
  }
  server = std::make_unique<ServerProcess>(program, store.path(), address.port);
  while (!all_are_live(true)) {
  }
  return seconds_since(begin);
}

}  // namespace

std::vector<JoinRow> join_figures(const std::filesystem::path& program, const std::filesystem::path& folder,
                                  const JoinExtent& extent) {
  std::vector<JoinRow> rows;
  {
    const BenchFolder store(folder);
    const ServerProcess server(program, store.path());
    const DesignAddress mesh = server.invite("mesh"), objects = server.invite("objects");
    put(mesh, [&](world::IdSource& ids) { return ball(ids, extent.frequency); });
    put(objects, [&](world::IdSource& ids) { return many_objects(ids, extent.objects); });
    const int triangles = 20 * extent.frequency * extent.frequency;
    rows.push_back(
        {fmt::format("join: a mesh of {} triangles", triangles), join_time(mesh, 1, extent.times), 1.0});
    const BenchFolder contents(folder);
    {
      const ContentCachePointer cache = std::make_shared<FolderContents>(contents.path());
      (void)joined(mesh, cache);
    }
    rows.push_back({"join: the same once more, its shape kept by its hash",
                    join_time(mesh, 1, extent.times, std::make_shared<FolderContents>(contents.path())),
                    1.0});
    rows.push_back({fmt::format("join: {} objects", extent.objects),
                    join_time(objects, std::size_t(extent.objects), extent.times), 0.5});
  }
  rows.push_back({fmt::format("kill -9 and restart: {} clients at work again", extent.clients),
                  restart_time(program, folder, extent.clients), 2.0});
  return rows;
}

void print_table(const std::vector<JoinRow>& rows) {
  fmt::print("\nUntil a design is there; server and clients share this machine\n\n{:<60} {:>8} {:>10}\n",
             "figure", "s", "to reach");
  for (const JoinRow& row : rows)
    fmt::print("{:<60} {:>8.3f} {:>10.1f}\n", row.figure, row.seconds, row.to_reach);
}

}  // namespace icome::benchmarks
