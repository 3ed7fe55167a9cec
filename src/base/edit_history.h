#pragma once
#include <algorithm>
#include <functional>
#include <iterator>
#include <utility>
#include <variant>
#include <vector>

#include "base/result.h"

namespace icome::base {

/// Applies the parts of an edit in order, all or none, and gives the edit that takes them back. `applying` is
/// called with each kind of part, and gives the part that takes it back, or why it is refused.
template <typename Edit, typename Applying>
Result<Edit> apply_parts(Applying& applying, const Edit& edit) {
  Edit back;
  for (const auto& part : edit) {
    auto undone = std::visit(applying, part);
    if (!undone) {
      for (auto step = back.rbegin(); step != back.rend(); ++step) std::visit(applying, *step);
      return tl::unexpected(undone.error());
    }
    back.push_back(std::move(*undone));
  }
  std::reverse(back.begin(), back.end());
  return back;
}

/// A value with the edits that were done to it, so that they can be taken back and done again. Edits are
/// applied by `Result<Edit> apply_edit(Value&, const Edit&)` beside the value, which gives the edit that
/// takes one back, and changes nothing where it fails.
template <typename Value, typename Edit>
class EditHistory {
 public:
  explicit EditHistory(Value value) : value_(std::move(value)) {}

  const Value& value() const { return value_; }

  /// Hears each edit that is applied, also those of undo and redo, and may refuse it.
  using Sink = std::function<Result<void>(const Edit& edit)>;
  void set_sink(Sink sink) { sink_ = std::move(sink); }

  /// Applies the edit as one step that can be undone; what was undone before is forgotten. Fails as
  /// apply_edit() and the sink do.
  Result<void> perform(const Edit& edit) {
    auto back = apply_to_all(edit);
    if (!back) return tl::unexpected(back.error());
    undo_.push_back(std::move(*back));
    redo_.clear();
    return {};
  }

  /// All edits that `work` performs are one step that can be undone.
  template <typename Work>
  void as_one_step(Work&& work) {
    const std::size_t before = undo_.size();
    work();
    join_steps(before);
  }

  /// Steps that can be undone.
  std::size_t steps() const { return undo_.size(); }
  /// All steps after the first `before` ones become one.
  void join_steps(std::size_t before) {
    if (undo_.size() <= before + 1) return;
    Edit joined;
    for (; undo_.size() > before; undo_.pop_back())
      std::move(undo_.back().begin(), undo_.back().end(), std::back_inserter(joined));
    undo_.push_back(std::move(joined));
  }

  /// False where there is nothing to take back, or to do again, or the sink refuses.
  bool undo() { return step(undo_, redo_); }
  bool redo() { return step(redo_, undo_); }
  bool can_undo() const { return !undo_.empty(); }
  bool can_redo() const { return !redo_.empty(); }

 private:
  bool step(std::vector<Edit>& from, std::vector<Edit>& to) {
    if (from.empty()) return false;
    auto back = apply_to_all(from.back());
    if (!back) return false;
    from.pop_back();
    to.push_back(std::move(*back));
    return true;
  }

  /// Applies the edit here and tells the sink, or neither.
  Result<Edit> apply_to_all(const Edit& edit) {
    auto back = apply_edit(value_, edit);
    if (!back || !sink_) return back;
    const auto taken = sink_(edit);
    if (taken) return back;
    (void)apply_edit(value_, *back);
    return tl::unexpected(taken.error());
  }

  Value value_;
  std::vector<Edit> undo_;
  std::vector<Edit> redo_;
  Sink sink_;
};

}  // namespace icome::base
