#pragma once
#include <cstdint>
#include <map>
#include <optional>

#include "collab/client/conversation.h"

namespace icome::session {

/// The places of others' pointers, views and heads, which come some 30 times a second, at any moment: each
/// goes on evenly from where it is to where it was told last.
class SoftPlaces {
 public:
  /// Takes in what is new, and moves on to this moment (s). Does anything move, come or go?
  bool update(const collab::Conversation& talk, double now);

  /// By author, at the moment of update().
  const std::map<std::uint32_t, collab::Whereabouts>& now() const { return now_; }

 private:
  struct Way {
    collab::Whereabouts from, to;
    std::int64_t told = 0;  // ms, of the conversation's clock
    double begin = 0.0;     // s
    double length = 0.0;    // s
    bool arrived = true;
  };
  std::map<std::uint32_t, Way> ways_;
  std::map<std::uint32_t, collab::Whereabouts> now_;
};

}  // namespace icome::session
