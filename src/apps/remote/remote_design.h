#pragma once
#include <chrono>
#include <filesystem>
#include <memory>
#include <string>

#include "apps/status_line.h"
#include "base/result.h"
#include "collab/client/connection.h"
#include "collab/client/kept_design.h"
#include "files/design.h"

namespace icome::apps {

// Designs on servers, wherever a command takes a design's file.

/// How long work that has begun waits for a server that is gone to come back.
inline constexpr std::chrono::milliseconds kServerPatience{60'000};

/// Is it the address of a design on a server?
bool is_remote(const std::filesystem::path& design);
/// The name of a design in reports and messages: a file's as it is, an address without its secret.
std::string shown_name(const std::filesystem::path& design);

/// Connects to the design of an address and waits until it is here, showing a person who waits the progress,
/// until Ctrl-C; catch_interrupts() was called.
/// An address without a token takes that of the environment variable ICOME_TOKEN. `only_reads`: nothing will
/// be changed.
base::Result<std::unique_ptr<collab::Connection>> join_design(const std::string& address, StatusLine& status,
                                                              bool only_reads = false);

/// Connects to a design that is kept on this machine, goes on with its copy, and waits until it is here.
/// Where there are conflicts nothing is sent until they are resolved.
base::Result<std::unique_ptr<collab::Connection>> join_design(const collab::DesignAddress& address,
                                                              StatusLine& status,
                                                              const collab::KeptDesign& kept,
                                                              const collab::KeptCopy& copy);

/// Reads the design of an address; where the server is not to be reached, the copy that is kept here, and
/// says so.
base::Result<files::LoadedDesign> fetch_design(const std::string& address, StatusLine& status);

/// A model that was put into a design on a server.
struct SentModel {
  std::uint64_t sequence = 0;  // of the edit that it came by
  std::size_t objects = 0;     // in it
  std::uint64_t bytes = 0;     // of the edit
  std::size_t beside = 0;      // objects that were there before
};
/// Puts a model into the design of an address, under the object of that name (empty: as new roots), and waits
/// until that is durable.
base::Result<SentModel> send_model(const world::World& model, const std::string& address,
                                   const std::string& parent, StatusLine& status);

/// Waits until all that was done is durable, or refused. Fails when it is interrupted or the server is gone
/// for good.
base::Result<void> wait_until_durable(collab::Connection& connection, StatusLine& status);
/// Leaves for good, so that what is held is free at once.
void leave_design(collab::Connection& connection);

}  // namespace icome::apps
