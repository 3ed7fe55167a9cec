#pragma once
#include <deque>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/clock.h"
#include "devices/device_news.h"
#include "devices/simulated/simulated_device.h"
#include "session/background_task.h"
#include "session/display/effect_symbols.h"
#include "session/display/render_follower.h"
#include "session/display/workspace_marks.h"
#include "session/elements/scene_menu.h"
#include "session/felt/haptic_follower.h"
#include "session/felt/haptic_loop.h"
#include "session/hands/hand_grab.h"
#include "session/hands/part_grab.h"
#include "session/hands/point_grab.h"
#include "session/hands/pointer_connection.h"
#include "session/hands/target_maker.h"
#include "session/hands/user_interaction.h"
#include "session/revisions.h"
#include "session/session.h"
#include "session/sharing/join_design.h"
#include "session/sharing/people_marks.h"
#include "session/sharing/recent_addresses.h"
#include "session/sharing/shared_design.h"
#include "session/sharing/soft_places.h"
#include "session/storage/autosave_journal.h"
#include "session/storage/claimed_work.h"
#include "session/storage/design_loader.h"
#include "session/storage/design_saver.h"

namespace icome::session {

/// The clock of all motions and changes in sessions, s: the same for hand, eye and main. Any thread.
inline double session_seconds() {
  static const std::int64_t kStart = base::steady_nanoseconds();
  return 1e-9 * double(base::steady_nanoseconds() - kStart);
}

/// What main knows of one pointer beside its place.
struct PointerParts {
  HandGrab grab = {};
  PartGrab part_grab = {};
  PointGrab point_grab = {};
  bool ungrabbed = false;                        // it begins to grab when its button has come up
  std::uint64_t losses = 0;                      // that a person was told of
  std::optional<devices::DeviceNews> news = {};  // of its device, from the first tick on
  std::uint64_t number = 0;                      // PointerUse::number
  std::string address = {};                      // of its device; empty: the session was given it without one
  std::string identity = {};                     // of its device; empty: not known
  bool shows_workspace = false;
  double seen_until = 0.0;  // s, of session_seconds: until then its workspace is shown in any case
};

/// A device on its way out: nobody waits until it is closed.
struct ClosingDevice {
  std::string address = {};
  std::string identity = {};
  const devices::PointerDevice* device = nullptr;        // to be compared only
  std::unique_ptr<BackgroundTask<bool>> task = nullptr;  // null: the servo may still use it
};

/// The parts of a session. All of them are main's, but for those of the session's other threads.
struct SessionParts {
  SessionParts(SessionSettings settings, std::vector<std::unique_ptr<devices::PointerDevice>> devices);
  ~SessionParts();

  // session_history.cpp
  base::Result<void> take_back();

  // session_world.cpp
  base::Result<void> done(base::Result<void> result);
  void open_world(world::World opened, const std::filesystem::path& design,
                  const std::shared_ptr<ClaimedWork>& recovered = nullptr);
  void tell_change(const world::Changes* changes);
  void notify_change(const world::Changes* changes);
  void notify_selection();
  void show(world::SceneId scene);
  world::EditSink sink();

  // session_sharing.cpp
  void begin_sharing(JoinedDesign joined);
  void take_kept_copy(const JoinedDesign& joined);
  void tell_of_conflicts(std::size_t count);
  void leave_shared();
  void close_left();
  void take_shared();
  void mirror(bool own);
  void take_another_world();
  void keep_against_crashes(bool keeps);
  void post_mirrored(world::EditGroup group, bool own);
  base::Result<void> perform_for_all(const world::Edit& edit, const std::string& name, bool goes_on);
  base::Result<void> turn_for_all(bool back);
  base::Result<void> submit_tried();
  void hold_selection();
  void present();
  void renew_people();
  void follow_person();

  // session_files.cpp
  void take_opened(DesignLoader::Outcome& outcome);
  void take_integrated(DesignLoader::Outcome& outcome);
  void take_saved(DesignSaver::Outcome& outcome);
  void tell_of_saved(const DesignSaver::Outcome& outcome, const std::vector<std::string>& missing);
  void take_files();
  void finish_saving();

  // session_devices.cpp
  std::optional<std::size_t> mouse() const;
  bool is_mouse(std::size_t pointer) const { return mouse_hand && mouse() == pointer; }
  void take_in_device(PointerConnection connection);
  void take_in_mouse();
  void take_out(std::size_t pointer);
  void remap(std::size_t pointer, const devices::DeviceMapping& mapping);
  void close_gone();
  void renew_capped();
  void follow_view_scale(double dt);

  // session_hands.cpp
  void let_go(std::size_t pointer);
  void let_go_of_technique();
  bool is_held(std::size_t pointer) const;

  // session_view.cpp
  void move_user();
  void go_home();
  void aim(const base::Vector3& position);
  void put(const base::Vector3& position);
  void park();
  void renew_outline();
  void renew_symbols();
  void renew_parts();
  void renew_handles();
  void renew_workspaces();
  void mark_part(const std::optional<MarkedPart>& marked);
  void publish_wish();
  interaction::StereoSettings stereo_now() const;
  void renew_fish_tank();

  // session_techniques.cpp
  TechniqueMoment technique_moment() const;
  base::Pose stage_from_hand(std::size_t pointer) const;
  bool is_hand_there(std::size_t pointer) const;
  void carry_user(const base::Pose& by);
  void feel_held(bool held);
  void hold_by_technique(Session& session);
  void renew_marks(const Session& session);

  // session_menu.cpp
  void use_menu();
  void tell_menu_changes();
  void tell_menu_choices();
  bool is_at_menu(std::size_t pointer) const;
  interaction::ElementFrame menu_frame() const;
  double menu_size(std::optional<std::size_t> hand) const;
  interaction::Ray gaze() const;

  // session.cpp
  void take_in();
  void notice_devices();
  void notice_device(std::size_t pointer);
  void tell(SessionEvent::Kind kind, std::string text, std::vector<std::string> details = {});
  void take_followers();
  void tell_what_is_not_as_it_is();
  bool is_settled() const;
  void start_followers();

  SessionSettings settings;

  world::World world;
  world::History history;
  world::IdSource ids;
  Revisions revisions;
  Surroundings surroundings{world};
  std::uint64_t saved_revision = 0;
  std::vector<std::string> left_out;           // of what was saved last, as its format cannot hold it
  std::deque<std::uint64_t> saving_revisions;  // on their way to disk
  std::uint64_t opened_number = 0;             // of the post with this world
  std::shared_ptr<ClaimedWork> recovering;     // not null: it is what the loader reads
  std::filesystem::path path;
  world::SceneId shown_scene = {};
  std::optional<double> played_since;  // s, of session_seconds; none: motions are not played
  std::vector<world::ObjectId> selection;
  // A listener may add another one while it is called.
  std::deque<std::function<void(const world::Changes*)>> change_listeners;
  std::deque<std::function<void()>> selection_listeners;
  std::vector<SessionEvent> events;  // that update() has not given yet
  std::optional<Edited> performed;   // by the sink, to be posted when the history has it

  DisplayWish look;  // as main wants it, without view and selection
  bool look_is_new = true;
  std::vector<world::ObjectId> outlined;           // the selection, and all below it
  bool outline_is_new = false;                     // it may be
  std::optional<render::SceneOverlay> marks = {};  // of the technique
  std::uint64_t marks_of = 0;                      // hash of what they show
  std::optional<base::Affine3> miniature = {};     // of the technique, from the stage
  UserInteraction user;
  std::int64_t technique_since = 0;  // ns, when the technique was chosen
  std::int64_t moved_at = 0;         // ns, when the user moved last; 0: not yet
  interaction::View drawn_view, drawn_left;
  interaction::StereoSettings stereo;  // as a person has chosen it
  std::optional<bool> asked_stereo;    // a trial's wish, whatever was chosen
  bool fish_tank = false;
  interaction::FishTank screen;
  double view_rests_for = 0.0;  // s
  interaction::View rested_view;
  std::vector<WorkspaceMark> workspaces;  // as they are drawn
  double aspect = 1.5;                    // of the picture
  bool hand_is_aimed = false;             // by the mouse
  /// The place where the mouse's hand lies aside, m, in its device's frame; none while it is aimed.
  std::optional<base::Vector3> parked_at = base::Vector3(base::Vector3::Zero());

  EditedQueue queue;
  DisplayFeed display;
  /// The hand that the mouse drives, always of the last pointer; null: there is none.
  devices::SimulatedDevice* mouse_hand = nullptr;
  HapticLoop hands;
  std::uint64_t pointers_so_far = 0;
  std::vector<PointerParts> pointers;  // of each pointer
  std::vector<ClosingDevice> closing;
  GrabSettings grab_settings;
  std::optional<interaction::Shaping> shaping;           // nothing: objects are dragged
  std::optional<interaction::MarkedHandle> mouse_marks;  // as the mouse's tool says
  interaction::ShapingPicture handles;                   // as they are drawn
  EffectSymbols effects;
  bool symbols_are_new = false;  // they may be
  render::SceneOverlay symbols;  // of the effects, as they are drawn
  PartOutlines part_outlines;
  std::optional<MarkedPart> marked_part;  // as the mouse's tool says, or the hand that drags it
  bool parts_are_new = false;             // outlines may be others
  std::shared_ptr<TargetMaker> target_maker = std::make_shared<TargetMaker>();
  std::shared_ptr<TechniqueHand> technique;  // null: by touch
  SceneMenu menu;
  interaction::ElementFrame menu_pops_up = {};  // there, unless it rests elsewhere
  ElementTheme menu_theme = ElementTheme::Light;
  std::vector<MenuChoice> menu_chosen;  // not told yet
  std::deque<std::function<void(const MenuChoice&)>> menu_listeners;
  std::optional<MenuChoice> menu_changing;  // told last
  std::deque<std::function<void(const MenuChoice*)>> menu_change_listeners;
  std::vector<std::string> menu_troubles;  // not told yet
  std::deque<std::function<void(const std::string&)>> menu_trouble_listeners;
  realtime::LatestValue<FeltVersion> felt;
  /// FeltVersion::capped, or later than that, as the first pointer has become another one.
  std::shared_ptr<const std::vector<haptics::CappedEffect>> capped = nullptr;
  realtime::LatestValue<render::RenderScenePointer> seen;
  std::set<std::string> told;  // of differences from the design, since it was opened
  // The versions whose remarks have been read.
  render::RenderScenePointer looked_at;
  std::shared_ptr<const std::vector<std::string>> listened_to;
  DesignLoader loader;
  DesignLoader integrator;               // of designs to be put into this one
  world::ObjectId integrate_under = {};  // the parent
  DesignSaver saver;
  std::shared_ptr<JoinedDesign> joining = nullptr;             // not null: it is what the loader reads
  std::unique_ptr<SharedDesign> shared = nullptr;              // null: the design is on no server
  std::vector<std::unique_ptr<BackgroundTask<bool>>> leaving;  // connections, in good order
  RecentAddresses addresses;
  bool follows_others = false;                           // the listeners are told of what others did
  SoftPlaces places;                                     // of others
  std::vector<PersonMark> people = {};                   // as they are drawn
  std::vector<render::SceneOutline> held_outlines = {};  // around what others hold
  bool holds_are_new = false;
  std::optional<std::uint32_t> followed = {};  // author
  std::int64_t presented_at = 0;               // ns
  collab::Whereabouts presented = {};
  // Last, as their threads use the rest.
  std::unique_ptr<AutosaveJournal> journal;  // null: nothing is kept against crashes
  std::vector<std::unique_ptr<Follower>> followers;
};

}  // namespace icome::session
