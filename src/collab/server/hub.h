#pragma once
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "collab/server/audit_log.h"
#include "collab/server/room.h"
#include "collab/server/token.h"

namespace icome::collab {

/// What a hub has done so far, for /metrics.
struct HubCounters {
  std::uint64_t links = 0;  // now
  std::uint64_t rooms = 0;  // now
  std::uint64_t accepted_edits = 0, refused_edits = 0, refused_hellos = 0;
  std::uint64_t frames = 0, frame_bytes = 0, messages = 0;
  std::uint64_t deliveries = 0;  // messages, each counted for all who may have to hear of it
  std::uint64_t commits = 0, committed_edits = 0, failed_commits = 0;
};

/// Limits and times of a hub.
struct HubSettings {
  RoomSettings room = {};
  std::string holder = {};            // names this server in leases of designs; unique
  std::int64_t design_lease = 6'000;  // ms
  /// ms from the connection to a hello; a good one may then wait for a slow disk for as long as that takes
  std::int64_t hello_time = 5'000;
  std::size_t most_hello_bytes = 16U << 10U;  // of a frame before
  double most_messages = 50'000.0;            // a second from one client, and five times as many at once
  std::int64_t idle_time = 30'000;            // ms after which a room without people is closed
  std::uint64_t snapshot_bytes = 4U << 20U;   // of edits behind the saved snapshot before a new one is saved
  std::uint64_t snapshot_edits = 5'000;
};

/// Work for the thread that has the log: what it returns runs on the hub's thread afterwards.
using StorageWork = std::function<std::function<void()>(OpLog& log)>;

/// A server without sockets, threads, disks and clocks: who comes in, the rooms of the designs, and what the
/// log has to do. Whoever owns it brings frames in and out, has StorageWork done in order, one at a time, and
/// says what time it is
/// (`now`: ms on a steady clock, `at`: ms since 1970). One thread.
class Hub {
 public:
  using Audit = std::function<void(const AuditRow&)>;

  /// Another server (HubSettings::holder) has the design that a client wants: takes the connection, with the
  /// frame of its hello, out of the hub's hands, or gives false, and then the client is refused.
  using PassOn = std::function<bool(LinkId link, const std::string& holder, std::string_view hello)>;

  /// `factory` outlives the hub.
  Hub(HubSettings settings, TokenSigner signer, const world::GeometryFactory& factory, Audit audit = {},
      PassOn pass_on = {});

  void opened(LinkId link, const std::string& address, std::int64_t now);
  void received(LinkId link, std::string_view frame, std::int64_t now, std::int64_t at);
  void closed(LinkId link, std::int64_t now);
  /// Call some ten times a second.
  void tick(std::int64_t now, std::int64_t at);
  /// Tells everybody that the server stops, and gives the leases back; done when is_done().
  void stop(std::int64_t now);
  bool is_done() const { return stops_ && links_.empty() && rooms_.empty() && !work_runs_ && work_.empty(); }

  /// Connections that may have something to hear since the last call.
  std::set<LinkId> take_stirred();
  SharedBytes next_frame(LinkId link, std::int64_t now);
  /// Has a question of this client been answered that it waits for? Such a frame is not gathered with others.
  bool has_answer(LinkId link) const;
  /// The reason to end a connection, after its last frame.
  std::optional<std::string> parting(LinkId link) const;
  /// The next work for the log; empty when there is none. The work before it must be done, and what it
  /// returned run. Edits are written down only where the log `may_append`, as more may be gathered first.
  StorageWork next_work(bool may_append = true);
  /// Does the work that next_work() gave last write edits down?
  bool appends() const { return appended_last_; }

  const HubCounters& counters() const { return counters_; }
  /// The reason why the store could not be written within the last seconds; empty where there is none. What
  /// keeps clients away by it lets them try again then.
  const std::string& trouble() const;
  const Room* room(const std::string& design) const;

 private:
  struct Joining {
    LinkId link = 0;
    Hello hello;
    Invitation invitation;
  };
  /// A design that is being opened, is open, or is given up.
  struct OpenDesign {
    std::string name;
    std::uint64_t fence = 0;
    std::unique_ptr<Room> room;      // null: being opened
    std::vector<Joining> joining;    // who waits for that
    std::int64_t lease_asked = 0;    // ms, when the lease was last renewed
    std::int64_t idle_since = 0;     // ms
    std::uint64_t logged_bytes = 0;  // since the saved snapshot
    std::uint64_t logged_edits = 0;
    std::uint64_t snapshot_sequence = 0;  // saved
    bool is_saving = false;
    bool is_stirred = false;  // in stirred_designs_
    std::set<LinkId> links;   // who is in the room
  };
  using OpenDesignPointer = std::shared_ptr<OpenDesign>;
  struct Link {
    std::string address;
    std::int64_t hello_until = 0;
    OpenDesignPointer design;  // null: no good hello yet
    Invitation invitation;
    std::string asks_for;  // the name of a design, which may not be there
    std::string name;
    std::uint32_t author = 0;
    bool is_checked = false;  // a hello has come
    SharedBytes last_frame;   // of a connection that ends before it is in a room
    std::optional<std::string> parting;
    double messages = 0.0;  // spent of what it may send at once
    std::int64_t messages_at = 0;
  };

  /// Work that waits for its turn.
  struct Queued {
    StorageWork work;
    std::uint64_t after_appends = 0;  // so many appends must be done before
  };

  void note_trouble(const std::string& why);
  void take_hello(LinkId id, Link& link, Hello hello);
  void refuse(LinkId id, Link& link, const std::string& why, Parting code);
  void ask_to_join(const OpenDesignPointer& design, const Joining& joining);
  void join(const OpenDesignPointer& design, const Joining& joining, const AuthorRow& author);
  OpenDesignPointer open(const std::string& name);
  void give_up(const OpenDesignPointer& design, const std::string& why, Parting code,
               const std::string& holder = {});
  bool has_passed_on(const Joining& joining, const std::string& holder);
  void stir(const OpenDesignPointer& design);
  bool spends_too_much(Link& link) const;
  std::optional<std::string> end_of_invitation(const Link& link) const;
  void end_invitations();
  bool has_entries() const;
  StorageWork append_work();
  void appended(const std::vector<OpenDesignPointer>& designs, const std::vector<Append>& batches,
                const std::vector<std::optional<AppendError>>& errors);
  void keep_lease(const OpenDesignPointer& design);
  void save_snapshot_if_due(const OpenDesignPointer& design);
  bool is_over(const OpenDesign& design) const;
  void close_rooms();
  void ask_for_revoked();
  void note(const std::string& what, const Link& link, const std::string& detail = {});

  HubSettings settings_;
  TokenSigner signer_;
  const world::GeometryFactory& factory_;
  Audit audit_;
  PassOn pass_on_;
  std::map<LinkId, Link> links_;
  std::map<std::string, OpenDesignPointer> rooms_;  // by the design's name
  std::set<LinkId> stirred_;
  std::vector<OpenDesignPointer> stirred_designs_;
  std::deque<Queued> work_;
  std::uint64_t appends_ = 0;  // done
  bool work_runs_ = false;
  bool appended_last_ = false;
  bool asks_for_revoked_ = false;
  std::uint64_t revoked_version_ = ~std::uint64_t{0};
  std::set<std::string> revoked_;
  bool stops_ = false;
  std::uint32_t next_guest_ = kFirstGuest;
  std::int64_t now_ = 0, at_ = 0;                // ms, of the last call that said so
  std::int64_t asked_for_revoked_ = -1'000'000;  // ms
  HubCounters counters_;
  std::string trouble_;
  std::int64_t trouble_until_ = 0;  // ms
};

}  // namespace icome::collab
