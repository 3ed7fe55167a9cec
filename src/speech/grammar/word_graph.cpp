// Patterns become automata with empty steps, one rule after the other; each is made deterministic and
// smallest before others refer to it (Hopcroft and Ullman, Introduction to Automata Theory, 1979, 2.3
// and 3.4).
#include "speech/grammar/word_graph.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

namespace icome::speech {
namespace {

constexpr std::size_t kMostStates = 1'000'000;

using StateSet = std::vector<std::uint32_t>;  // sorted

/// An automaton whose steps may be empty, that is, without a word.
struct Automaton {
  struct Step {
    const std::string* word;  // null: empty
    std::uint32_t to;
  };
  std::vector<std::vector<Step>> states;

  std::uint32_t add() {
    states.emplace_back();
    return std::uint32_t(states.size() - 1);
  }
};

StateSet closed(const Automaton& automaton, StateSet set) {
  for (std::size_t i = 0; i < set.size(); ++i)
    for (const Automaton::Step& step : automaton.states[set[i]])
      if (step.word == nullptr && std::ranges::find(set, step.to) == set.end()) set.push_back(step.to);
  std::ranges::sort(set);
  return set;
}

/// The automaton without empty steps, at most one step of a word from each state. Nothing where that is too
/// large.
std::optional<WordGraph> deterministic(const Automaton& automaton, std::uint32_t begin, std::uint32_t end) {
  WordGraph graph;
  std::map<StateSet, std::uint32_t> numbers;
  std::vector<StateSet> sets;
  const auto number_of = [&](const StateSet& set) {
    const auto [known, is_new] = numbers.try_emplace(set, std::uint32_t(sets.size()));
    if (is_new) sets.push_back(set);
    return known->second;
  };
  number_of(closed(automaton, {begin}));
  for (std::size_t i = 0; i < sets.size(); ++i) {
    if (sets.size() > kMostStates) return std::nullopt;
    const StateSet set = sets[i];
    std::map<std::string_view, StateSet> steps;
    for (const std::uint32_t state : set)
      for (const Automaton::Step& step : automaton.states[state])
        if (step.word != nullptr && std::ranges::find(steps[*step.word], step.to) == steps[*step.word].end())
          steps[*step.word].push_back(step.to);
    WordGraph::State state{std::ranges::binary_search(set, end), {}};
    for (const auto& [word, next] : steps)
      state.next.emplace_back(std::string(word), number_of(closed(automaton, next)));
    graph.states.push_back(std::move(state));
  }
  return graph;
}

/// The classes of states after which the same can be said (Moore 1956): they are told apart by their ends,
/// then by the classes that their words lead to, until nothing more is told apart.
std::vector<std::uint32_t> classes_of(const WordGraph& graph) {
  std::vector<std::uint32_t> classes;
  for (const WordGraph::State& state : graph.states) classes.push_back(state.is_end ? 1 : 0);
  for (std::size_t count = 0, before = 1; count != before;) {
    std::map<WordGraph::State, std::uint32_t> numbers;
    std::vector<std::uint32_t> finer;
    for (const WordGraph::State& state : graph.states) {
      WordGraph::State led = state;
      for (auto& [word, to] : led.next) to = classes[to];
      finer.push_back(numbers.try_emplace(std::move(led), std::uint32_t(numbers.size())).first->second);
    }
    classes = std::move(finer);
    before = std::exchange(count, numbers.size());
  }
  return classes;
}

/// The graph with one state for each class; the first state's is the first.
WordGraph merged(const WordGraph& graph) {
  const std::vector<std::uint32_t> classes = classes_of(graph);
  std::map<std::uint32_t, std::uint32_t> numbers{{classes[0], 0}};
  StateSet order{0};  // a state of each class, in the order in which they are met
  WordGraph small;
  for (std::size_t i = 0; i < order.size(); ++i) {
    WordGraph::State state = graph.states[order[i]];
    for (auto& [word, to] : state.next) {
      const auto [known, is_new] = numbers.try_emplace(classes[to], std::uint32_t(order.size()));
      if (is_new) order.push_back(to);
      to = known->second;
    }
    small.states.push_back(std::move(state));
  }
  return small;
}

std::optional<WordGraph> smallest(const Automaton& automaton, std::uint32_t begin, std::uint32_t end) {
  const auto graph = deterministic(automaton, begin, end);
  return graph ? std::optional(merged(*graph)) : std::nullopt;
}

class GraphBuilder {
 public:
  GraphBuilder(const Grammar& grammar, const std::set<std::string, std::less<>>& shared)
      : grammar_(grammar), shared_(shared) {}

  /// Nothing where there are too many states.
  std::optional<WordGraph> graph_of(const std::string& rule) {
    Automaton automaton;
    const std::uint32_t begin = automaton.add(), end = automaton.add();
    copies_.clear();
    if (!add_rule(automaton, rule, {begin, end, true})) return std::nullopt;
    return smallest(automaton, begin, end);
  }

 private:
  /// The place of a pattern in an automaton; `last`: the sentence ends with it.
  struct Span {
    std::uint32_t begin, end;
    bool last;
  };

  bool add(Automaton& to, const Pattern& pattern, const Span& span) {
    switch (pattern.kind) {
      case Pattern::Kind::Word:
        to.states[span.begin].push_back({&pattern.text, span.end});
        return true;
      case Pattern::Kind::Tag:
        to.states[span.begin].push_back({nullptr, span.end});
        return true;
      case Pattern::Kind::Rule:
        return add_rule(to, pattern.text == kAnyWords ? std::string(kSuggestedWords) : pattern.text, span);
      case Pattern::Kind::Optional:
        to.states[span.begin].push_back({nullptr, span.end});
        return add(to, pattern.parts.front(), span);
      case Pattern::Kind::Choice:
        return std::ranges::all_of(pattern.parts, [&](const Pattern& part) { return add(to, part, span); });
      case Pattern::Kind::Sequence:
        break;
    }
    std::uint32_t at = span.begin;
    for (const Pattern& part : pattern.parts) {
      const bool last = span.last && &part == &pattern.parts.back();
      const std::uint32_t next = &part == &pattern.parts.back() ? span.end : to.add();
      if (!add(to, part, {at, next, last})) return false;
      at = next;
    }
    return true;
  }

  bool add_rule(Automaton& to, const std::string& rule, const Span& span) {
    if (shared_.contains(rule)) return add_shared(to, rule, span);
    const Pattern* const pattern = grammar_.find(rule);
    if (pattern == nullptr) return true;
    if (refers_to_shared(*pattern)) return add(to, *pattern, span);
    return add_graph(to, rule, *pattern, span);
  }

  bool add_shared(Automaton& to, const std::string& rule, const Span& span) {
    const auto [copy, is_new] = copies_.try_emplace({rule, span.last});
    if (is_new) {
      const Span own{to.add(), to.add(), span.last};
      copy->second = {own.begin, own.end};
      const Pattern* const pattern = grammar_.find(rule);
      if (pattern != nullptr && !add(to, *pattern, own)) return false;
    }
    to.states[span.begin].push_back({nullptr, copy->second.first});
    to.states[copy->second.second].push_back({nullptr, span.end});
    return true;
  }

  /// The rule's own smallest graph, copied.
  bool add_graph(Automaton& to, const std::string& rule, const Pattern& pattern, const Span& span) {
    auto known = graphs_.find(rule);
    if (known == graphs_.end()) {
      Automaton own;
      const std::uint32_t begin = own.add(), end = own.add();
      if (!add(own, pattern, {begin, end, false})) return false;
      auto graph = smallest(own, begin, end);
      if (!graph) return false;
      known = graphs_.emplace(rule, std::move(*graph)).first;
    }
    const WordGraph& graph = known->second;
    const auto first = std::uint32_t(to.states.size());
    if (first + graph.states.size() > kMostStates) return false;
    to.states.resize(first + graph.states.size());
    to.states[span.begin].push_back({nullptr, first});
    for (std::uint32_t i = 0; i < graph.states.size(); ++i) {
      if (graph.states[i].is_end) to.states[first + i].push_back({nullptr, span.end});
      for (const auto& [word, next] : graph.states[i].next)
        to.states[first + i].push_back({&word, first + next});
    }
    return true;
  }

  bool refers_to_shared(const Pattern& pattern) const {
    if (pattern.kind == Pattern::Kind::Rule) {
      if (shared_.contains(pattern.text)) return true;
      const Pattern* const rule = grammar_.find(pattern.text);
      return rule != nullptr && refers_to_shared(*rule);
    }
    return std::ranges::any_of(pattern.parts, [this](const Pattern& part) { return refers_to_shared(part); });
  }

  const Grammar& grammar_;
  const std::set<std::string, std::less<>>& shared_;
  std::map<std::string, WordGraph> graphs_;                                                 // of rules
  std::map<std::pair<std::string, bool>, std::pair<std::uint32_t, std::uint32_t>> copies_;  // begin and end
};

}  // namespace

base::Result<WordGraph> word_graph(const Grammar& grammar, std::string_view rule,
                                   const std::set<std::string, std::less<>>& shared) {
  if (auto graph = GraphBuilder(grammar, shared).graph_of(std::string(rule))) return std::move(*graph);
  return base::fail(
      "there are too many different sentences for the recogniser; take rules out of the vocabulary");
}

}  // namespace icome::speech
