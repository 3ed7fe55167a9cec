#include "ui/cutout/table/table_follower.h"

#include <QLineEdit>
#include <fstream>

#include "cutout/synth/synthetic_table.h"
#include "ui/cutout/cutout_stage.h"

namespace icome::ui {
namespace {

/// A table that is computed, as a folder of pictures.
class TableTest : public CutoutStage {
 protected:
  TableTest() : known_(cutout::usual_triangles(3)), table_(options()) {
    std::filesystem::create_directories(file("frames"));
    for (int i = 0; i < kFrames; ++i) {
      const auto made = table_.make(i);
      truth_.push_back(made.truth);
      std::ofstream(file("frames") / ("f" + std::to_string(i) + ".jpg"), std::ios::binary) << made.jpeg;
    }
    std::ofstream(file("known.toml")) << cutout::known_triangles_text(known_);
    EXPECT_TRUE(cutout::write_table_view(table_.view(), file("view.toml")));
  }
  cutout::SyntheticOptions options() const {
    cutout::SyntheticOptions options;
    options.frames = kFrames;
    options.known = known_;
    options.seed = 5;
    return options;
  }
  TableSettings settings() const {
    return {.source = file("frames").string(),
            .known = file("known.toml"),
            .view = file("view.toml"),
            .rate = 30};
  }
  void fill_panel() {
    for (const auto& [name, value] : {std::pair("table.source", file("frames")),
                                      {"table.known", file("known.toml")},
                                      {"table.view", file("view.toml")}})
      window_->findChild<QLineEdit*>(name)->setText(QString::fromStdString(value.string()));
  }

  static constexpr int kFrames = 20;
  cutout::KnownTriangles known_;
  cutout::SyntheticTable table_;
  std::vector<cutout::FrameTruth> truth_;
};

TEST_F(TableTest, FramesAreSeenAsTheyCome) {
  TableFollower follower;
  std::vector<TableSight> sights;
  follower.on_sight([&](const TableSight& sight) { sights.push_back(sight); });
  ASSERT_TRUE(follower.start(settings()));
  ASSERT_TRUE(until([&] { return follower.state() == TableFollower::State::Ended; }));
  ASSERT_TRUE(until([&] { return !sights.empty() && sights.back().number == std::size_t(kFrames); }));
  EXPECT_GT(sights.size(), std::size_t(kFrames) / 2);
  for (const TableSight& sight : sights) {
    EXPECT_EQ(sight.seen.size(), 3U) << sight.number;
    for (const cutout::Sighting& seen : sight.seen)
      EXPECT_LT((seen.pose.centroid - truth_[sight.number - 1].poses[seen.triangle].centroid).norm(), 2.0);
  }
  EXPECT_FALSE(follower.problem().empty());
}

TEST_F(TableTest, AListThatIsMissingIsToldAtOnceAndASourceLater) {
  TableFollower follower;
  TableSettings wrong = settings();
  wrong.known = file("nothing.toml");
  const auto started = follower.start(wrong);
  ASSERT_FALSE(started);
  EXPECT_NE(started.error().message.find("nothing.toml"), std::string::npos);
  wrong.known.clear();
  const auto unnamed = follower.start(wrong);
  ASSERT_FALSE(unnamed);
  EXPECT_EQ(unnamed.error().message, "Choose the list of known triangles first.");
  TableSettings nowhere = settings();
  nowhere.source = file("no-folder").string();
  ASSERT_TRUE(follower.start(nowhere));
  ASSERT_TRUE(until([&] { return follower.state() == TableFollower::State::Ended; }));
  EXPECT_NE(follower.problem().find("no-folder"), std::string::npos);
}

TEST_F(TableTest, StoppingTakesNoTime) {
  TableFollower follower;
  ASSERT_TRUE(follower.start(settings()));
  ASSERT_TRUE(until([&] { return follower.state() == TableFollower::State::Running; }));
  const auto before = std::chrono::steady_clock::now();
  follower.stop();
  EXPECT_LT(std::chrono::steady_clock::now() - before, std::chrono::seconds(2));
  EXPECT_EQ(follower.state(), TableFollower::State::Off);
}

/// The cell follows the triangle, and what was recorded is there although the frames end before the
/// recording.
TEST_F(TableTest, ATriangleMovesACellAndTheRecordingOutlivesTheFrames) {
  add_cell("boat");
  ASSERT_TRUE(document().perform(
      cutout_command("map", {{"triangle", known_.triangles[0].id}, {"mode", "absolute"}, {"cell", "boat"}})));
  fill_panel();
  Transport& transport = window_->transport();
  transport.set_count_in(0);
  transport.record(std::nullopt);
  window_->table().start();
  ASSERT_TRUE(until([&] { return window_->table().follower().state() == TableFollower::State::Ended; }));
  QCoreApplication::processEvents();
  EXPECT_TRUE(document().is_recording());
  transport.stop();
  const animation::Track& x = cell("boat").tracks[std::size_t(Channel::X)];
  ASSERT_GE(x.size(), 2U);
  // Somewhere along the way that the triangle went.
  const auto map = animation::TableMap::fitting(640, 480, project().stage);
  for (const animation::Key& key : x) {
    double nearest = 1e9;
    for (const cutout::FrameTruth& truth : truth_)
      nearest = std::min(nearest, std::abs(map.to_stage(truth.poses[0].centroid).x() - key.value));
    EXPECT_LT(nearest, 5.0) << key.frame;
  }
  const realtime::LoopSummary delays = window_->table().delays();
  EXPECT_GT(delays.ticks, 3U);
  EXPECT_LT(delays.busy.median, 1.0);
}

}  // namespace
}  // namespace icome::ui
