#include <gtest/gtest.h>

#include "session/sessions.h"

namespace icome::session {
namespace {

world::ObjectId add_effect(Session& session, const std::string& text) {
  const auto id = session.ids().next<world::ObjectId>();
  world::PhysicalObject object{.name = text};
  object.fixture = std::make_shared<const world::Fixture>(world::ForceEffect{text, true});
  EXPECT_TRUE(
      session.history().perform(world::CreateObject{id, session.world().roots().size(), object}, "Add"));
  return id;
}

TEST(CappedEffects, AreToldAndNoLongerWhenTheyAreNot) {
  SessionSettings settings = quiet_settings();
  settings.pointers.push_back(hand_at(base::Vector3::Zero()));
  const auto session = start(std::move(settings));
  add_effect(*session, "constant:0,0,0.1");
  const world::ObjectId strong = add_effect(*session, "viscous:500");
  const auto told = [&] { return session->hands().capped_effects().size(); };
  run_until(*session, [&] { return told() == 1; });
  EXPECT_EQ(session->hands().capped_effects().front().id, strong.value);
  EXPECT_NE(session->hands().capped_effects().front().what.find("damping 500 N s/m is felt as"),
            std::string::npos);
  ASSERT_TRUE(session->history().undo());
  run_until(*session, [&] { return told() == 0; });
}

}  // namespace
}  // namespace icome::session
