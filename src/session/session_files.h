#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "session/storage/recovery.h"
#include "world/id.h"

namespace icome::session {

struct SessionParts;

/// The files of a session: opening, saving and recovering designs, in the background; Session::update() tells
/// how each ends. Main's.
class SessionFiles {
 public:
  explicit SessionFiles(SessionParts& parts) : parts_(parts) {}
  SessionFiles(const SessionFiles&) = delete;
  SessionFiles& operator=(const SessionFiles&) = delete;

  /// Starts an empty design.
  void make_new();
  /// Starts reading; a reading under way is given up. The world stays what it is until all is read.
  void open(const std::filesystem::path& design);
  void cancel_open();
  /// The part that is done, [0, 1], while a design is being read.
  std::optional<double> opening() const;
  /// Starts reading a design that was made alone, to be put into this one: its roots come under `parent`, or
  /// to the top, with all that they share, by one action. Where the parent is gone by then, to the top.
  void integrate(const std::filesystem::path& design, world::ObjectId parent);
  /// A design to be put into this one is being read.
  bool integrating() const;
  /// Starts writing the world as it is now; that file is the design's once it is written. A file that another
  /// program has changed since, and a damaged one, are only replaced `anyway`; the event SaveAsks tells.
  void save(const std::filesystem::path& design, bool anyway = false);
  bool saving() const;
  /// The file of the design; empty: it has never been saved.
  const std::filesystem::path& path() const;
  /// Would closing lose something?
  bool modified() const;
  /// The parts that the file does not hold, as its format cannot, in sentences; empty: none, or not saved.
  const std::vector<std::string>& left_out() const;
  /// Ends the work, which is saved or not wanted: nothing of it is kept for recovery.
  void close();
  std::vector<RecoverableWork> recoverable() const;
  /// Opens the work instead of the design that it was made of, as modified work on that.
  void recover(const RecoverableWork& work);
  void discard(const RecoverableWork& work);

 private:
  SessionParts& parts_;
};

}  // namespace icome::session
