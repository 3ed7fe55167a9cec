#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "speech/grammar/grammar.h"

namespace icome::speech {

/// The sentences of a rule as ways through a graph: the smallest deterministic one, in which whatever can be
/// said next in the same ways is one state. State 0 is the beginning. A plain value.
struct WordGraph {
  struct State {
    bool is_end = false;  // may a sentence end here?
    std::vector<std::pair<std::string, std::uint32_t>>
        next;  // words, in alphabetical order, and their states

    auto operator<=>(const State&) const = default;
  };
  std::vector<State> states;
};

/// The graph of the rule. Of the rules that `shared` names only one copy is made for all places at which a
/// sentence goes on after them, and one for those at its end: the graph stays small, but after such a rule it
/// may also go on as it does elsewhere. Fails where it would have more than a million states. Precondition:
/// Grammar::check(rule).
base::Result<WordGraph> word_graph(const Grammar& grammar, std::string_view rule,
                                   const std::set<std::string, std::less<>>& shared = {});

}  // namespace icome::speech
