#pragma once
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "devices/head_device.h"
#include "devices/navigation_device.h"
#include "devices/pointer_device.h"
#include "haptics/servo/servo.h"
#include "interaction/head/head_filter.h"
#include "interaction/head/head_transfer.h"
#include "interaction/screen_view.h"
#include "session/representation.h"
#include "session/session_files.h"
#include "session/session_hands.h"
#include "session/session_history.h"
#include "session/session_menu.h"
#include "session/session_sharing.h"
#include "session/session_stage.h"
#include "session/session_techniques.h"
#include "session/session_view.h"
#include "world/edit/changes.h"

namespace icome::session {

struct SessionSettings {
  /// Devices that the session then owns, used as they are. Without any there is one that the mouse drives: a
  /// simulated hand.
  std::vector<std::unique_ptr<devices::PointerDevice>> pointers = {};
  /// Devices that are connected from the start, as SessionHands::connect() does; the mouse's hand is beside
  /// them.
  std::vector<PointerConnection> connections = {};
  std::unique_ptr<devices::NavigationDevice> navigation = nullptr;  // may be null
  std::unique_ptr<devices::HeadDevice> head = nullptr;              // may be null
  /// How far the eye goes along with the head; nothing: as far as the head does.
  std::optional<interaction::HeadTransfer> head_transfer = interaction::HeadTransfer::of_thesis();
  interaction::HeadFilterSettings head_filter = {};
  interaction::StereoSettings stereo = {};
  bool fish_tank = false;  // the screen is a window into the world
  /// The size of the whole display, m; nothing: as the display tells it.
  std::optional<base::Vector2> display_size = {};
  haptics::ServoSettings servo = {};
  /// Further representations of the world besides those for hand and eye, each on a thread of its own.
  std::vector<std::unique_ptr<Representation>> representations = {};
  bool realtime_priority = true;  // asked for; refused, the servo runs as well as it can
  /// The folder in which work in progress is kept against crashes; empty: none.
  std::filesystem::path autosave_folder = {};
  /// The folder with the designs of servers that are kept for offline work; empty: none can be.
  std::filesystem::path kept_folder = {};
};

/// Something that a person should be told.
struct SessionEvent {
  enum class Kind : std::uint8_t {
    Opened,      // a design was read; details: things skipped or put right
    OpenFailed,  // the world is what it was before
    OpenCancelled,
    Saved,           // all that counts; details: leftovers that the format cannot hold
    SavedInPart,     // the design counts as changed still; details: the losses by the format
    SaveFailed,      // the work is still there, as is the old file
    SaveAsks,        // likewise: a person says whether the file there may be lost, and then saves anyway
    Recovered,       // work of a session that ended without closing
    AutosaveFailed,  // work goes on, but a crash would lose it
    AutosaveResumed,
    DeviceLost,
    DeviceBack,
    Integrated,  // a design was put into this one
    IntegrateFailed,
    ServerLost,  // of a shared design: one works on, and what is done is sent later
    ServerBack,
    SharingEnds,  // the design stays here, as a new one
    Dropped,      // something that one did to a shared design did not come to be
    Floor,        // who has a thing now
    Conflicts,    // SessionSharing::conflicts() are to be chosen for
    NotAsItIs,    // details: things that are not seen, not felt, or not as they are
    Notice,       // such as that the servo has no real-time priority
  };
  Kind kind = Kind::Notice;
  std::string text = {};  // a sentence or two: what happened, and what to do
  std::vector<std::string> details = {};
  std::string device = {};  // the name of the pointer device that it is about; or empty
};

/// One running workspace without a window (thesis 5.6.1): the world with its history, the servo loop, what is
/// drawn, devices, view, selection, and the journal that keeps work against crashes. Tests, command-line
/// tools, studies and the desktop drive one. Owns all of these and their threads: servo, one for each
/// representation (hand, eye, disk), one for files; the thread that made it is main, and only that one calls
/// it, but for SessionView::display(). Nothing here waits for a thread unless it says so.
///
/// Everything that is shown and touched lies on the stage: y up, metres. So does the world: designs of
/// formats with z up are turned when they are read, and turned back when they are written.
class Session {
 public:
  /// Starts devices and threads with an empty design. Fails when the servo loop cannot start.
  static base::Result<std::unique_ptr<Session>> create(SessionSettings settings);
  /// Ends all threads; waits for files being written. Work that was not saved stays recoverable unless
  /// SessionFiles::close() was called.
  ~Session();

  // The main loop.
  /// Takes in what other threads and devices have brought since the last call, moves the view on, and gives
  /// what a person should be told. Call it some 60 times a second.
  std::vector<SessionEvent> update();
  /// Calls `listener` on main after the world has changed: by these changes, or, when null, to another one.
  /// Several may listen, as long as the session lives; they are called in the order of asking.
  void on_change(std::function<void(const world::Changes*)> listener);
  /// While the listeners of on_change() are called: is it for what others did to a shared design?
  bool follows_others() const;
  /// Calls `listener` on main after the selection has changed.
  void on_selection(std::function<void()> listener);

  // The world.
  const world::World& world() const;
  world::IdSource& ids();
  /// Waits until nothing is being read or written, and all threads have caught up with the world. For tests
  /// and command-line tools.
  void settle();
  /// The selected objects, in the order of selecting. Those that are gone are left out by themselves.
  const std::vector<world::ObjectId>& selection() const;
  void select(std::vector<world::ObjectId> objects);

  SessionFiles& files() { return files_; }
  const SessionFiles& files() const { return files_; }
  SessionHistory& history() { return history_; }
  const SessionHistory& history() const { return history_; }
  SessionView& view() { return view_; }
  const SessionView& view() const { return view_; }
  SessionStage& stage() { return stage_; }
  const SessionStage& stage() const { return stage_; }
  SessionHands& hands() { return hands_; }
  const SessionHands& hands() const { return hands_; }
  SessionSharing& sharing() { return sharing_; }
  const SessionSharing& sharing() const { return sharing_; }
  SessionTechniques& techniques() { return techniques_; }
  const SessionTechniques& techniques() const { return techniques_; }
  SessionMenu& menu() { return menu_; }
  const SessionMenu& menu() const { return menu_; }

 private:
  void move_held();
  void move_points();
  void move_held_by_touch();
  explicit Session(std::unique_ptr<SessionParts> parts);
  std::unique_ptr<SessionParts> parts_;
  SessionFiles files_;
  SessionHistory history_;
  SessionView view_;
  SessionStage stage_;
  SessionHands hands_;
  SessionSharing sharing_;
  SessionTechniques techniques_;
  SessionMenu menu_;
};

}  // namespace icome::session
