#pragma once
#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "files/design.h"
#include "session/background_task.h"

namespace icome::session {

/// Reads designs in the background, one at a time; it has to be polled for the outcome. One thread (main)
/// uses it and never waits but in the destructor. Owns the threads that read: readings that were given up may
/// take a moment to end, and as long as there are several of these, the newest waits for its turn.
class DesignLoader {
 public:
  /// Reads a design, as told by the options: it calls their progress and ends soon when that says stop.
  using Read = std::function<base::Result<files::LoadedDesign>(const files::DesignReadOptions& options)>;

  struct Outcome {
    std::filesystem::path design = {};  // as it was asked for
    /// Nothing: the reading was cancelled.
    std::optional<base::Result<files::LoadedDesign>> result = {};
  };

  DesignLoader();
  /// Cancels the readings under way and waits until their threads have ended.
  ~DesignLoader();
  DesignLoader(const DesignLoader&) = delete;
  DesignLoader& operator=(const DesignLoader&) = delete;

  /// The most readings that are given up and not yet gone from memory. One must not keep others from
  /// being read: it may be on a disk that does not answer.
  static constexpr std::size_t kMostLeaving = 2;

  /// Starts reading; a reading under way is given up, and nothing is told of it.
  void open(const std::filesystem::path& design, const files::DesignReadOptions& options = {});
  /// Starts reading in another way, such as recovered work; `design` only comes back with the outcome.
  void start(const std::filesystem::path& design, Read read, const files::DesignReadOptions& options = {});
  /// Gives the reading up; the next poll tells so at once, though its thread may take a moment to end.
  void cancel();

  /// The part that is done, [0, 1], while a design is being read.
  std::optional<double> part() const;
  /// The outcome of a reading that has ended, once.
  std::optional<Outcome> poll();
  /// Waits until the reading under way has ended, so that poll() tells of it.
  void wait();

 private:
  struct Reading;

  void give_up();
  void begin_when_possible();

  std::unique_ptr<Reading> reading_;               // null: none is under way; it may not have begun
  std::vector<std::unique_ptr<Reading>> leaving_;  // given up, their threads about to end
  std::optional<Outcome> cancelled_;
};

}  // namespace icome::session
