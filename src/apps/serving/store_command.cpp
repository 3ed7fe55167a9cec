#include "apps/serving/store_command.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "apps/terminal.h"
#include "collab/server/room.h"
#include "collab/storage/store.h"
#include "collab/storage/store_care.h"
#include "drawing/shape/every_kind.h"
#include "files/design_files.h"

namespace icome::apps {
namespace {

using Json = nlohmann::ordered_json;

std::string dumped(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

base::Result<int> list_designs(const collab::Store& store, bool json) {
  const auto log = store.log();
  if (!log) return tl::unexpected(log.error());
  const auto designs = (*log)->designs();
  if (!designs) return tl::unexpected(designs.error());
  Json report{{"store", store.shown()}, {"designs", Json::array()}};
  std::string text =
      fmt::format("{}: {} design{}\n", store.shown(), designs->size(), designs->size() == 1 ? "" : "s");
  for (const collab::DesignRow& row : *designs) {
    report["designs"].push_back({{"name", row.name},
                                 {"sequence", row.sequence},
                                 {"snapshot_sequence", row.snapshot_sequence},
                                 {"bytes", row.bytes}});
    text += fmt::format("  {:30} {:>12} edits {:>14} bytes\n", row.name, row.sequence, row.bytes);
  }
  return print_answer(json ? dumped(report) : text);
}

/// The world of a design as its log has it.
base::Result<world::World> logged_world(collab::OpLog& log, const std::string& design) {
  const auto row = log.find(design);
  if (!row) return tl::unexpected(row.error());
  if (!*row)
    return base::fail(
        fmt::format("there is no design \"{}\" in this store; icome store list names them.", design));
  const auto start = collab::read_start(log, **row, 1);
  if (!start) return tl::unexpected(start.error());
  const world::GeometryFactory factory = drawing::every_kind_of_shape();
  const auto room = collab::Room::open(*start, {}, factory);
  if (!room) return tl::unexpected(room.error());
  return (*room)->world();
}

/// A database looks after its pages by itself: that every design can be read and replayed is looked at.
base::Result<std::vector<std::string>> check_by_reading(const collab::Store& store) {
  const auto log = store.log();
  if (!log) return tl::unexpected(log.error());
  const auto designs = (*log)->designs();
  if (!designs) return tl::unexpected(designs.error());
  std::vector<std::string> findings;
  for (const collab::DesignRow& row : *designs)
    if (const auto world = logged_world(**log, row.name); !world)
      findings.push_back(fmt::format("{}: {}", row.name, world.error().message));
  return findings;
}

base::Result<int> check_designs(const collab::Store& store, bool json) {
  const auto findings =
      store.is_database() ? check_by_reading(store) : collab::check_store(store.folder()->designs());
  if (!findings) return tl::unexpected(findings.error());
  Json report{{"store", store.shown()}, {"findings", *findings}};
  std::string text;
  for (const std::string& finding : *findings) text += finding + "\n";
  if (findings->empty()) text = store.shown() + ": all is well.\n";
  const int printed = print_answer(json ? dumped(report) : text);
  return findings->empty() ? printed : kFailed;
}

base::Result<int> restore_designs(const ServingOptions& options, const collab::StoreFolder& folder) {
  const auto lock = folder.lock();
  if (!lock) return tl::unexpected(lock.error());
  const auto restored = collab::restore_store(options.file, folder.designs());
  if (!restored) return tl::unexpected(restored.error());
  if (!restored->former.empty())
    tell(fmt::format("what was there is kept as {}.", restored->former.string()));
  if (!restored->keeps_revoked)
    tell("links that were revoked after this backup was made are good again: revoke them once more.");
  return 0;
}

base::Result<int> export_design(const ServingOptions& options, const collab::Store& store) {
  if (const auto able = files::check_can_write(options.file); !able) return tl::unexpected(able.error());
  const auto log = store.log();
  if (!log) return tl::unexpected(log.error());
  const auto world = logged_world(**log, options.design);
  if (!world) return tl::unexpected(world.error());
  const auto losses = files::write_design(options.file, *world);
  if (!losses) return tl::unexpected(losses.error());
  for (const files::Remark& remark : *losses) tell(files::sentence(remark, options.file.string()));
  return 0;
}

base::Result<int> done_or_why(const base::Result<void>& done) {
  if (!done) return tl::unexpected(done.error());
  return 0;
}

base::Result<int> store_task(const ServingOptions& options) {
  const bool restores = options.task == "store restore";
  const auto store = restores ? collab::Store::make(options.store) : collab::Store::open(options.store);
  if (!store) return tl::unexpected(store.error());
  if (!restores)
    if (const auto there = store->demand_designs(); !there) return tl::unexpected(there.error());
  if (options.task == "store list") return list_designs(*store, options.json);
  if (options.task == "store check") return check_designs(*store, options.json);
  if (options.task == "store export") return export_design(options, *store);
  if (store->is_database())
    return base::fail(store->shown() +
                      ": a database is backed up and restored by its own programs, pg_dump and pg_restore "
                      "(--schema=icome).");
  if (restores) return restore_designs(options, *store->folder());
  return done_or_why(collab::backup_store(store->folder()->designs(), options.file, options.force));
}

}  // namespace

int run_store(const ServingOptions& options) {
  const auto done = store_task(options);
  if (done) return *done;
  tell(done.error().message);
  return kFailed;
}

}  // namespace icome::apps
