#include "apps/serving/store_command.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "apps/terminal.h"
#include "collab/server/room.h"
#include "collab/storage/sqlite_op_log.h"
#include "collab/storage/store_care.h"
#include "collab/storage/store_folder.h"
#include "files/design_files.h"

namespace icome::apps {
namespace {

using Json = nlohmann::ordered_json;

std::string dumped(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

base::Result<int> list_designs(const collab::StoreFolder& folder, bool json) {
  auto log = collab::SqliteOpLog::open(folder.designs());
  if (!log) return tl::unexpected(log.error());
  const auto designs = log->designs();
  if (!designs) return tl::unexpected(designs.error());
  Json report{{"store", folder.path().string()}, {"designs", Json::array()}};
  std::string text = fmt::format("{}: {} design{}\n", folder.path().string(), designs->size(),
                                 designs->size() == 1 ? "" : "s");
  for (const collab::DesignRow& row : *designs) {
    report["designs"].push_back({{"name", row.name},
                                 {"sequence", row.sequence},
                                 {"snapshot_sequence", row.snapshot_sequence},
                                 {"bytes", row.bytes}});
    text += fmt::format("  {:30} {:>12} edits {:>14} bytes\n", row.name, row.sequence, row.bytes);
  }
  return print_answer(json ? dumped(report) : text);
}

base::Result<int> check_designs(const collab::StoreFolder& folder, bool json) {
  const auto findings = collab::check_store(folder.designs());
  if (!findings) return tl::unexpected(findings.error());
  Json report{{"store", folder.path().string()}, {"findings", *findings}};
  std::string text;
  for (const std::string& finding : *findings) text += finding + "\n";
  if (findings->empty()) text = folder.path().string() + ": all is well.\n";
  const int printed = print_answer(json ? dumped(report) : text);
  return findings->empty() ? printed : kFailed;
}

base::Result<int> restore_designs(const ServingOptions& options, const collab::StoreFolder& folder) {
  const auto lock = folder.lock();
  if (!lock) return tl::unexpected(lock.error());
  const auto former = collab::restore_store(options.file, folder.designs());
  if (!former) return tl::unexpected(former.error());
  if (!former->empty()) tell(fmt::format("what was there is kept as {}.", former->string()));
  return 0;
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
  const world::GeometryFactory factory;
  const auto room = collab::Room::open(*start, {}, factory);
  if (!room) return tl::unexpected(room.error());
  return (*room)->world();
}

base::Result<int> export_design(const ServingOptions& options, const collab::StoreFolder& folder) {
  if (const auto able = files::check_can_write(options.file); !able) return tl::unexpected(able.error());
  auto log = collab::SqliteOpLog::open(folder.designs());
  if (!log) return tl::unexpected(log.error());
  const auto world = logged_world(*log, options.design);
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
  auto path = options.store.empty() ? collab::StoreFolder::default_path()
                                    : base::Result<std::filesystem::path>(options.store);
  if (!path) return tl::unexpected(path.error());
  const bool restores = options.task == "store restore";
  const auto folder = restores ? collab::StoreFolder::make(*path) : collab::StoreFolder::open(*path);
  if (!folder) return tl::unexpected(folder.error());
  if (restores) return restore_designs(options, *folder);
  if (options.task == "store list") return list_designs(*folder, options.json);
  if (options.task == "store check") return check_designs(*folder, options.json);
  if (options.task == "store export") return export_design(options, *folder);
  return done_or_why(collab::backup_store(folder->designs(), options.file, options.force));
}

}  // namespace

int run_store(const ServingOptions& options) {
  const auto done = store_task(options);
  if (done) return *done;
  tell(done.error().message);
  return kFailed;
}

}  // namespace icome::apps
