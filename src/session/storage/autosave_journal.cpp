#include "session/storage/autosave_journal.h"

#include <pthread.h>

#include <algorithm>
#include <exception>
#include <utility>

#include "session/storage/autosave_keeper.h"

namespace icome::session {

namespace {

using Clock = std::chrono::steady_clock;

/// Lets the session go on even where there is no memory to keep its work.
template <typename Work>
void guard(AutosaveKeeper& keeper, const Work& work) {
  try {
    work();
  } catch (const std::exception& error) {
    keeper.give_up(std::string("An edit could not be followed (") + error.what() + ").");
  }
}

}  // namespace

AutosaveJournal::AutosaveJournal(EditedQueue::Reader& reader, AutosaveSettings settings) : reader_(reader) {
  thread_ = std::thread([this, settings = std::move(settings)] { run(settings); });
}

AutosaveJournal::~AutosaveJournal() { thread_.join(); }

void AutosaveJournal::run(const AutosaveSettings& settings) {
  pthread_setname_np(pthread_self(), "autosave");
  AutosaveKeeper keeper(settings);
  for (bool more = true; more;) {
    const auto due = keeper.due();
    more = due ? reader_.wait_for(std::max(*due - Clock::now(), Clock::duration::zero())) : reader_.wait();
    take_all(keeper);
    guard(keeper, [&] { keeper.tend(Clock::now()); });
    tell(keeper);
  }
  const bool unwanted = unwanted_.load(std::memory_order_relaxed);
  guard(keeper, [&] { unwanted ? keeper.discard() : keeper.finish(Clock::now()); });
}

void AutosaveJournal::take_all(AutosaveKeeper& keeper) {
  while (const auto edited = reader_.take()) {
    guard(keeper, [&] {
      keeper.follow(*edited, Clock::now());
      keeper.tend(Clock::now());
    });
    tell(keeper);
    followed_.store(edited->number, std::memory_order_release);
  }
}

void AutosaveJournal::tell(const AutosaveKeeper& keeper) {
  const auto& problem = keeper.problem();
  if (kept_ == !problem) return;
  kept_ = !problem;
  state_.publish({kept_, kept_ ? "Unsaved work is kept against a crash again."
                               : "Unsaved work is no longer kept against a crash: " + problem->message +
                                     " Save your design."});
}

std::optional<AutosaveState> AutosaveJournal::news() {
  if (!state_.update() || state_.read().keeping == kept_seen_) return std::nullopt;
  kept_seen_ = state_.read().keeping;
  return state_.read();
}

}  // namespace icome::session
