#pragma once
#include <array>
#include <chrono>
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
#include "interaction/mouse_hand.h"
#include "interaction/navigation.h"
#include "interaction/shaping/shaping.h"
#include "realtime/loop.h"
#include "render/model/render_scene.h"
#include "session/display/display_feed.h"
#include "session/display/part_outlines.h"
#include "session/felt/haptic_representation.h"
#include "session/hands/hand_grab.h"
#include "session/hands/pointer_view.h"
#include "session/hands/surroundings.h"
#include "session/hands/technique_hand.h"
#include "session/representation.h"
#include "session/storage/recovery.h"
#include "world/edit/changes.h"
#include "world/edit/history.h"

namespace icome::session {

struct SessionSettings {
  /// Devices that the session then owns. Without pointers there is one that the mouse drives: a simulated
  /// hand.
  std::vector<std::unique_ptr<devices::PointerDevice>> pointers = {};
  std::unique_ptr<devices::NavigationDevice> navigation = nullptr;  // may be null
  std::unique_ptr<devices::HeadDevice> head = nullptr;              // may be null
  haptics::ServoSettings servo = {};
  /// Further representations of the world besides those for hand and eye, each on a thread of its own.
  std::vector<std::unique_ptr<Representation>> representations = {};
  bool realtime_priority = true;  // asked for; refused, the servo runs as well as it can
  /// The folder in which work in progress is kept against crashes; empty: none.
  std::filesystem::path autosave_folder = {};
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
    NotAsItIs,  // details: things that are not seen, not felt, or not as they are
    Notice,     // such as that the servo has no real-time priority
  };
  Kind kind = Kind::Notice;
  std::string text = {};  // a sentence or two: what happened, and what to do
  std::vector<std::string> details = {};
};

/// The state of the servo loop.
struct ServoHealth {
  bool running = false;
  double rate_hz = 0.0;  // as asked for
  realtime::LoopSummary summary = {};
  std::array<std::uint64_t, realtime::LoopRecorder::kLoadBins> load_histogram = {};  // since the start
  std::string notice = {};  // what the system refused; or empty
};

/// One running workspace without a window (thesis 5.6.1): the world with its history, the servo loop, what is
/// drawn, devices, view, selection, and the journal that keeps work against crashes. Tests, command-line
/// tools, studies and the desktop drive one. Owns all of these and their threads: servo, one for each
/// representation (hand, eye, disk), one for files; the thread that made it is main, and only that one calls
/// it, but for display(). Nothing here waits for a thread unless it says so.
///
/// Everything that is shown and touched lies on the stage: y up, metres. So does the world: designs of
/// formats with z up are turned when they are read, and turned back when they are written.
class Session {
 public:
  /// Starts devices and threads with an empty design. Fails when the servo loop cannot start.
  static base::Result<std::unique_ptr<Session>> create(SessionSettings settings);
  /// Ends all threads; waits for files being written. Work that was not saved stays recoverable unless
  /// close() was called.
  ~Session();

  // The main loop.
  /// Takes in what other threads and devices have brought since the last call, moves the view on, and gives
  /// what a person should be told. Call it some 60 times a second.
  std::vector<SessionEvent> update();
  /// Calls `listener` on main after the world has changed: by these changes, or, when null, to another one.
  /// Several may listen, as long as the session lives; they are called in the order of asking.
  void on_change(std::function<void(const world::Changes*)> listener);
  /// Calls `listener` on main after the selection has changed.
  void on_selection(std::function<void()> listener);

  // The world.
  const world::World& world() const;
  world::IdSource& ids();
  /// Performs an action called `name` ("Move leg"), which can then be undone.
  base::Result<void> perform(const world::Edit& edit, const std::string& name);
  /// Performs more of the last action, such as the next step of a drag.
  base::Result<void> extend(const world::Edit& edit);
  /// Performs an action that is only tried out, such as a preview: as long as nothing else is done,
  /// take_back() leaves no trace of it (History::trying). Trying another takes its place, at once and without
  /// a moment between them; the edit is then one of the world without what was tried before. A failed one
  /// leaves nothing tried.
  base::Result<void> try_out(const world::Edit& edit, const std::string& name);
  base::Result<void> take_back();
  /// Makes the tried action one like any other.
  void keep_tried();
  base::Result<void> undo();
  base::Result<void> redo();
  const world::History& history() const;

  // Files. Opening and saving go on in the background; update() tells how they end.
  /// Starts an empty design.
  void make_new();
  /// Starts reading; a reading under way is given up. The world stays what it is until all is read.
  void open(const std::filesystem::path& design);
  void cancel_open();
  /// The part that is done, [0, 1], while a design is being read.
  std::optional<double> opening() const;
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
  /// Waits until nothing is being read or written, and all threads have caught up with the world. For tests
  /// and command-line tools.
  void settle();
  /// Ends the work, which is saved or not wanted: nothing of it is kept for recovery.
  void close();

  // Recovery.
  std::vector<RecoverableWork> recoverable() const;
  /// Opens the work instead of the design that it was made of, as modified work on that.
  void recover(const RecoverableWork& work);
  void discard(const RecoverableWork& work);

  // Scenes, selection.
  /// Shows and touches one scene of the world, or all of it.
  void show_scene(world::SceneId scene);
  world::SceneId shown_scene() const;
  // Motions.
  /// Has any object a motion? Looks at all of them.
  bool has_motions() const;
  /// Shows and feels objects where their motions have them, from their beginning on and on; or, as at first
  /// and after another design was opened, where they are at rest. The world stays what it is, and an edit
  /// that puts a moving object elsewhere moves all of its way.
  void play(bool on);
  bool playing() const;
  /// The selected objects, in the order of selecting. Those that are gone are left out by themselves.
  const std::vector<world::ObjectId>& selection() const;
  void select(std::vector<world::ObjectId> objects);
  /// The bounds of the selection (of everything, without one), stage frame.
  base::Bounds selection_bounds() const;

  // The view.
  const interaction::View& view() const;
  void set_view(const interaction::View& view);
  /// Moves the view there softly, over some tenths of a second.
  void fly_to(const interaction::View& view);
  /// Moves the view softly to where everything that is shown is seen.
  void home();
  /// Sets the width over the height of the picture to fit into. Impossible values are passed over.
  void set_aspect(double aspect);
  double aspect() const;
  interaction::NavigationMode navigation_mode() const;
  void set_navigation_mode(interaction::NavigationMode mode);
  /// Sets the look of the world as main wants it; view and selection are put in by the session.
  void set_look(const DisplayWish& look);
  /// The scene on the stage, as main saw it last; never null.
  const render::RenderScenePointer& drawn() const;
  /// The feed of the display thread.
  DisplayFeed& display();

  // Hands.
  std::size_t pointers() const;
  const PointerView& pointer(std::size_t index) const;
  const devices::DeviceInfo& pointer_info(std::size_t index) const;
  /// Effects that the first pointer feels softer than they were asked for, so that they are stable.
  const std::vector<haptics::CappedEffect>& capped_effects() const;
  /// The object that a pointer touches.
  std::optional<world::ObjectId> touched(std::size_t index) const;
  /// Does the pointer hold something? While button 0 is down, the object that it touched goes along with it
  /// (HandGrab), or the one that the technique holds, with the first pointer.
  bool holds(std::size_t index) const;
  /// Lets hands take hold of points of shapes, not of objects (PointGrab), and shows these; without settings,
  /// not any more. Fails as Shaping::set() does, changing nothing.
  base::Result<void> set_shaping(const std::optional<interaction::ShapingSettings>& settings);
  /// The handles of shapes; null while objects are dragged, not points.
  interaction::Shaping* shaping();
  /// Marks the handle that the mouse is over or holds; each hand marks its own.
  void mark_handle(const std::optional<interaction::MarkedHandle>& marked);
  /// Marks an operand or a projector of the selection, which the mouse is over, or which is dragged.
  void mark_part(const std::optional<MarkedPart>& marked);
  /// The marked part; with a motion, it is dragged, by the mouse or by a hand.
  const std::optional<MarkedPart>& marked_part() const;
  /// Sets how things are moved from now on, and how that feels.
  void set_grab(const GrabSettings& settings);
  const GrabSettings& grab() const;
  /// The surroundings that moved things stop at and snap to.
  Surroundings& surroundings();
  /// Is the first pointer the simulated hand that the mouse drives?
  bool is_mouse_driven() const;
  /// Keeps the first pointer at a place of the stage by springs, where it touches nothing, or lets it go.
  /// Only with GrabSettings::takes_hold set to false: hands that take hold have springs of their own.
  void hold_pointer(const std::optional<base::Vector3>& place);
  /// Servo::give_forces() for all pointers.
  void give_forces(bool given);
  /// Begins to keep every tick of the first pointer, or ends that.
  void trace(bool on);
  /// Ticks since the last call, oldest first, of which some seconds are kept.
  struct Ticks {
    std::vector<PointerView> ticks;
    std::uint64_t lost = 0;                     // ticks in all that found no room
    std::shared_ptr<const TouchedNames> names;  // for PointerView::touched; null before the first
  };
  Ticks take_trace();
  /// Selects, holds and travels with the first two pointers by this technique (thesis chapter 2) from now on,
  /// as TechniqueHand says; without one, by touch. Fails, and changes nothing, for sizes that cannot be.
  base::Result<void> set_technique(const std::optional<interaction::Technique>& technique);
  /// The technique that is used, with its target, held object and marks; null while it is by touch.
  const TechniqueHand* technique() const;
  /// The map from the world to the technique's miniature, where it shows one, stage frame.
  std::optional<base::Affine3> miniature() const;
  /// Records the technique's inputs from now on; it begins anew. Fails without a technique.
  base::Result<void> record_technique();
  /// Ends the recording and gives it; nothing unless it records.
  std::optional<TechniqueHand::Recorded> stop_recording();
  /// Sets the place that the hand of the mouse-driven pointer aims at, stage frame; surfaces may keep it
  /// away. Without effect on other devices.
  void aim_hand(const base::Vector3& position);
  /// Puts that hand there without a way in between, as a pen is lifted and set down elsewhere.
  void put_hand(const base::Vector3& position);
  /// Holds these buttons of that hand down (bit i: button i).
  void hold_hand_buttons(std::uint32_t buttons);
  /// Puts it at the eye, out of sight and touching nothing, and keeps it there until it is aimed or put
  /// again.
  void park_hand();
  /// The first thing that a ray meets of those that can be touched, stage frame.
  struct Picked {
    world::ObjectId object;
    interaction::PickedPoint place;
  };
  std::optional<Picked> pick(const interaction::Ray& ray) const;
  /// The first thing that is seen on the ray: also a symbol of an effect that it passes by a few pixels.
  std::optional<Picked> pick_seen(const interaction::Ray& ray) const;
  /// The operand of a solid, or the projector of a picture, in the selection whose outline the ray passes by
  /// a few pixels, whatever is before it.
  std::optional<PartOutlines::Picked> pick_part(const interaction::Ray& ray) const;
  /// The part whose outline is nearest to a place of the stage, within `reach` (m).
  std::optional<interaction::PlacedPart> part_near(const base::Vector3& place, double reach) const;
  ServoHealth servo() const;
  /// Samples of the first pointer's force since the last call, oldest first, some 200 a second.
  std::vector<ForceSample> take_forces();

 private:
  struct Parts;
  void move_held();
  void move_points();
  void move_held_by_touch();
  explicit Session(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace icome::session
