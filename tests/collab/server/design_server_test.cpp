// A server on its threads and clients beside it, over TLS.
#include "collab/server/design_server.h"

#include "collab/client/connection.h"
#include "collab/client/integration.h"
#include "collab/client/joining.h"
#include "collab/link/link_loop.h"
#include "collab/server/served_design.h"
#include "world/sample_world.h"

namespace icome::collab {
namespace {

constexpr std::chrono::milliseconds kPatient{60'000};

class DesignServerTest : public testing::Test {
 protected:
  DesignAddress address(Role role) const { return served_.address(role); }
  static std::unique_ptr<Connection> joined(const DesignAddress& address, const std::string& name) {
    auto connection = Connection::create(address, {make_client_key().value(), name, 0xff, "test"}).value();
    works(*connection, [&] { return connection->talk().state() == ConversationState::Live; });
    return connection;
  }
  static void works(Connection& connection, const std::function<bool()>& done) {
    const auto worked = connection.work_until(
        done, [] { return false; }, kPatient);
    EXPECT_TRUE(worked && *worked) << (worked ? "" : worked.error().message);
  }
  static void saves(Connection& connection) {
    works(connection, [&] { return connection.talk().replica().unacknowledged() == 0; });
  }
  static world::ObjectId makes_box(Connection& connection, const std::string& name) {
    Conversation& talk = connection.talk();
    world::IdSource ids(talk.replica().author(), talk.replica().world().next_number(talk.replica().author()));
    const auto shape = ids.next<world::GeometryId>();
    const auto object = ids.next<world::ObjectId>();
    EXPECT_TRUE(
        talk.perform(world::EditGroup{{world::CreateGeometry{shape, world::box(0.1)},
                                       world::CreateObject{object, 0, {.name = name, .geometry = shape}}}},
                     "Create box"));
    return object;
  }

  ServedDesign served_;
};

TEST_F(DesignServerTest, ShowsToAllWhatOneDoes) {
  const auto ann = joined(address(Role::Edit), "Ann"), bob = joined(address(Role::Edit), "Bob");
  const world::ObjectId box = makes_box(*ann, "box");
  saves(*ann);
  works(*bob, [&] { return bob->talk().replica().world().find(box) != nullptr; });
  EXPECT_EQ(hash(ann->talk().replica().world()), hash(bob->talk().replica().world()));
  EXPECT_EQ(bob->talk().name_of(ann->talk().replica().author()), "Ann");
}

/// Says one thing to a server and waits until that ends the connection.
class RefusedClient final : private LinkEvents {
 public:
  std::string end_after(const DesignAddress& address, const std::string& bytes) {
    loop_ = LinkLoop::create(*this).value();
    frame_ = std::make_shared<const std::string>(bytes);
    ConnectSettings settings;
    settings.endpoint = {address.host, address.port};
    settings.fingerprint = address.fingerprint;
    loop_->connect(settings);
    loop_->run();
    return why_;
  }

 private:
  void opened(LinkId link, const Peer&) override { loop_->send(link, frame_); }
  void received(LinkId, std::string_view) override {}
  void sent(LinkId) override {}
  void closed(LinkId, const std::string& why) override {
    why_ = why;
    loop_->stop();
  }

  std::unique_ptr<LinkLoop> loop_;
  SharedBytes frame_;
  std::string why_;
};

TEST_F(DesignServerTest, EndsTheConnectionOfWhomItRefusesAtOnce) {
  const auto begin = std::chrono::steady_clock::now();
  const std::string why = RefusedClient().end_after(address(Role::Edit), "this is no hello");
  EXPECT_NE(why.find("has ended the connection"), std::string::npos) << why;
  // Its own limits of time are ten seconds and more.
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(8));
}

TEST_F(DesignServerTest, ClientsGoOnByThemselvesWhenItIsBack) {
  const auto ann = joined(address(Role::Edit), "Ann");
  makes_box(*ann, "first");
  saves(*ann);
  served_.stop();
  makes_box(*ann, "while it was away");
  served_.start();
  saves(*ann);
  const auto bob = joined(address(Role::View), "Bob");
  EXPECT_EQ(bob->talk().replica().world().objects().size(), 2U);
}

TEST_F(DesignServerTest, TakesALargeModelInPartsAndGivesItInPieces) {
  const auto ann = joined(address(Role::Edit), "Ann");
  world::World model;
  world::IdSource ids;
  geometry::TriangleMesh mesh;
  constexpr std::uint32_t kSide = 300;
  for (std::uint32_t i = 0; i < kSide * kSide; ++i)
    mesh.positions.push_back({double(i % kSide), double(i / kSide), 0.1 * double(i % 7)});
  for (std::uint32_t y = 0; y + 1 < kSide; ++y)
    for (std::uint32_t x = 0; x + 1 < kSide; ++x)
      mesh.triangles.push_back({y * kSide + x, y * kSide + x + 1, (y + 1) * kSide + x});
  world::add_object(model, ids, "scan", std::make_shared<world::MeshGeometry>(std::move(mesh)));
  Conversation& talk = ann->talk();
  world::IdSource own(talk.replica().author());
  ASSERT_TRUE(talk.perform(integration_of(model, talk.replica().world(), {}, own), "Integrate"));
  saves(*ann);
  const auto bob = joined(address(Role::View), "Bob");
  EXPECT_EQ(hash(bob->talk().replica().world()), hash(ann->talk().replica().world()));
}

TEST_F(DesignServerTest, LetsNobodyChangeWhatAnotherHolds) {
  const auto ann = joined(address(Role::Edit), "Ann"), bob = joined(address(Role::Own), "Bob");
  const world::ObjectId box = makes_box(*ann, "box");
  saves(*ann);
  ann->talk().select(item_of(box));
  works(*ann, [&] { return ann->talk().holds().contains(item_of(box)); });
  works(*bob, [&] { return bob->talk().holds().contains(item_of(box)); });
  const world::Edit move = world::PlaceObject{box, world::at(1, 0, 0)};
  const auto number = bob->talk().perform(move, "Move box");
  ASSERT_FALSE(number);
  EXPECT_EQ(number.error().message, "Ann holds \"box\".");
  // A client that does not look.
  ASSERT_TRUE(bob->talk().replica().perform(move, "Move box"));
  std::optional<Dropped> dropped;
  works(*bob, [&] {
    for (Seen& seen : bob->talk().take_seen())
      if (auto* const it = std::get_if<Dropped>(&seen)) dropped = std::move(*it);
    return dropped.has_value();
  });
  EXPECT_EQ(dropped->why, "Ann holds \"box\".");
  bob->talk().take_away(item_of(box));
  works(*bob, [&] { return !bob->talk().holds().contains(item_of(box)); });
  ASSERT_TRUE(bob->talk().perform(world::PlaceObject{box, world::at(2, 0, 0)}, "Move box"));
  saves(*bob);
  works(*ann, [&] { return ann->talk().replica().sequence() == bob->talk().replica().sequence(); });
  EXPECT_EQ(ann->talk().replica().world().find(box)->parent_from_object.translation().x(), 2.0);
}

}  // namespace
}  // namespace icome::collab
