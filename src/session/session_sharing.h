#pragma once
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "collab/client/conversation.h"
#include "session/sharing/shared_line.h"

namespace icome::session {

struct SessionParts;

/// Work on a design that is on a server, together with others: joining, people, the floor, and words. While
/// such a design is open, SessionHistory performs for all, and takes back one's own actions only. Main's.
class SessionSharing {
 public:
  explicit SessionSharing(SessionParts& parts) : parts_(parts) {}
  SessionSharing(const SessionSharing&) = delete;
  SessionSharing& operator=(const SessionSharing&) = delete;

  /// Does a text begin as the address of a design does: icome://?
  static bool is_address(const std::string& text);
  /// The address for people, without its secret; or the reason why it is none.
  static base::Result<std::string> shown(const std::string& address);

  /// Begins to join the design of an address, as SessionFiles::open() begins to read: it goes on in the
  /// background, is cancelled in the same way, and the world stays what it is until the design is here. The
  /// others see the person's `name`; empty: that of the environment or the system.
  void open(const std::string& address, const std::string& name = {});
  /// The addresses that were joined last, the newest first; each is a secret.
  const std::vector<std::string>& recent() const;
  void forget(const std::string& address);

  /// The connection with the server of the open design.
  struct State {
    collab::ConversationState connection = collab::ConversationState::Away;
    collab::Role role = collab::Role::View;
    std::string address = {};  // for people, without its secret
    std::string design = {};
    std::optional<std::int64_t> delay = {};  // ms there and back
    std::size_t unsent = 0;                  // own edits that the server has not made durable yet
    std::string why = {};                    // there is no connection
    std::int64_t silence = 0;                // ms since the server was heard last
  };
  /// Nothing: the open design is on no server.
  std::optional<State> state() const;

  /// Is the open design kept on this machine, so that it can be opened without its server?
  bool is_kept() const;
  /// Keeps it from now on, or forgets the copy; an event tells which, or why not: there is no folder for it,
  /// another program works with a kept copy of the same design, or the copy has edits that the server has
  /// not.
  void keep(bool keeps);

  /// A thing that was changed both here, while there was no connection, and by others.
  struct Conflict {
    std::string what = {};        // for people: "leg", "a shape"
    world::ObjectId object = {};  // none: it is no object
    bool is_gone = false;         // others have deleted it: one's own version can only be kept as a copy
    std::string whose = {};       // the person who changed it last; empty: it is not known who
  };
  /// Until they are chosen for, nothing of what was done here is sent.
  std::vector<Conflict> conflicts() const;
  /// A choice for each of them, in order. All that was done without a connection is one action to undo then.
  base::Result<void> resolve(const std::vector<collab::Choice>& choices);

  /// Somebody who is at work in the design.
  struct Colleague {
    std::uint32_t author = 0;
    std::string name = {};
    std::uint32_t colour = 0;  // 0xRRGGBB
    collab::Role role = collab::Role::View;
    bool is_me = false;
    std::vector<world::ObjectId> holds = {};
    bool has_view = false;  // it is known where the person looks
  };
  /// All who are here, oneself first.
  std::vector<Colleague> people() const;

  /// Another who holds an object, itself or one above it.
  struct Holder {
    std::uint32_t author = 0;
    std::string name = {};
    std::uint32_t colour = 0;     // 0xRRGGBB
    world::ObjectId object = {};  // that is held
  };
  std::optional<Holder> holder_of(world::ObjectId object) const;
  /// Asks for an object that another has: one gets it when that gives it back.
  void wait_for(world::ObjectId object);
  /// Takes an object away from whoever has it. Fails for who is no owner of the design.
  base::Result<void> take_away(world::ObjectId object);

  /// The design as all have it, without what is only tried out here.
  const world::World& design() const;

  /// Fails as collab::Conversation::say() does.
  base::Result<void> say(const std::string& text);
  /// All that people said and did, the newest last.
  const std::deque<SharedLine>& lines() const;

  /// Looks at what that person looks at, from there, until follow({}) or a move of one's own; nothing happens
  /// where it is not known.
  void follow(std::optional<std::uint32_t> author);
  std::optional<std::uint32_t> followed() const;

 private:
  SessionParts& parts_;
};

}  // namespace icome::session
