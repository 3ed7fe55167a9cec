#pragma once
#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>

#include "collab/protocol/address.h"
#include "collab/server/design_server.h"
#include "collab/server/token.h"
#include "collab/storage/sqlite_op_log.h"
#include "collab/storage/store_folder.h"
#include "own_folder.h"

namespace icome::collab {

/// A server with one design, "table", on a thread, in a folder of the running test's own.
class ServedDesign {
 public:
  ServedDesign() {
    std::filesystem::remove_all(folder_);
    start();
  }
  ~ServedDesign() {
    stop();
    std::filesystem::remove_all(folder_);
  }

  /// At the same endpoint as before.
  void start() {
    ServeSettings settings;
    settings.store = folder_.string();
    settings.listen = endpoint_;
    auto server = DesignServer::create(settings);
    ASSERT_TRUE(server) << server.error().message;
    server_ = std::move(*server);
    endpoint_ = server_->endpoint();
    fingerprint_ = server_->fingerprint();
    ends_ = false;
    thread_ = std::thread([this] { EXPECT_TRUE(server_->run([this] { return ends_.load(); })); });
  }
  void stop() {
    ends_ = true;
    if (thread_.joinable()) thread_.join();
    server_.reset();
  }

  /// Also while the server is stopped.
  DesignAddress address(Role role) const {
    const StoreFolder folder = StoreFolder::open(folder_).value();
    SqliteOpLog log = SqliteOpLog::open(folder.designs()).value();
    if (!log.find("table").value()) (void)log.create("table");
    const TokenSigner signer = TokenSigner::open(folder.token_key()).value();
    const auto token =
        signer.sign({make_invitation_id().value(), "table", role, wall_milliseconds() + 600'000});
    return {endpoint_.host, endpoint_.port, "table", token.value(), fingerprint_};
  }
  std::string link(Role role) const { return link_text(address(role)); }

 private:
  std::filesystem::path folder_ = own_folder("server");
  Endpoint endpoint_ = {};
  std::string fingerprint_;
  std::unique_ptr<DesignServer> server_;
  std::atomic<bool> ends_ = false;
  std::thread thread_;
};

}  // namespace icome::collab
