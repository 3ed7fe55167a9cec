#pragma once
#include <deque>

#include "session/speech/conversation.h"
#include "speech/dialogue/stage.h"

namespace icome::session {

/// A session as sentences refer to it and act on it: its view, hand, selection, files and menu.
class SpokenStage final : public speech::Stage {
 public:
  SpokenStage(Session& session, const ConversationHooks& hooks) : session_(session), hooks_(hooks) {}

  /// Keeps where the hand is at that time, s.
  void keep_hand(double time);

  interaction::View view() const override { return session_.view().now(); }
  std::optional<speech::Pointer> pointer(double time) const override;
  std::vector<world::ObjectId> selection() const override { return session_.selection(); }
  void select(const std::vector<world::ObjectId>& objects) override { session_.select(objects); }
  speech::StageAbilities abilities() const override;
  base::Result<void> save() override;
  base::Result<void> close_design() override;
  base::Result<void> go_to(world::ObjectId id) override;
  std::vector<speech::MenuWords> menu_items() const override;
  std::vector<speech::MenuWords> submenus() const override;
  base::Result<void> open_menu(const std::string& item) override;
  base::Result<void> choose_item(const std::string& item) override;
  bool close_menu() override;

 private:
  struct Moment {
    double time;
    speech::Pointer pointer;
  };

  std::optional<speech::Pointer> pointer_now() const;

  Session& session_;
  const ConversationHooks& hooks_;
  std::deque<Moment> hand_;  // of the last ten seconds
};

}  // namespace icome::session
