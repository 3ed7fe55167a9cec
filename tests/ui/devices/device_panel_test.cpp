#include "ui/devices/device_panel.h"

#include <QCheckBox>
#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QTest>
#include <atomic>

#include "devices/mapping_file.h"
#include "devices/simulated/simulated_device.h"
#include "ui/desktop_test.h"
#include "ui/devices/device_row.h"
#include "ui/devices/pointer_form.h"
#include "ui/panels/wrapped_label.h"
#include "ui/window_test.h"

namespace icome::ui {
namespace {

std::unique_ptr<devices::PointerDevice> simulated(const std::string& name) {
  devices::SimulatedSettings settings;
  settings.info.name = name;
  return std::make_unique<devices::SimulatedDevice>(std::move(settings));
}

/// Two devices that are there and one that is not; "slow" opens when it may, and "broken" never does.
struct FakeWays {
  std::shared_ptr<std::atomic<bool>> may_open = std::make_shared<std::atomic<bool>>(true);
  std::shared_ptr<std::atomic<int>> searches = std::make_shared<std::atomic<int>>(0);

  DeviceWays ways() const {
    DeviceWays ways;
    ways.list = [searches = searches]() -> std::vector<devices::DeviceEntry> {
      ++*searches;
      return {
          {"fake:1", "pointer", "fake", true, "an arm of a test", "fake#1"},
          {"hd", "pointer", "openhaptics", false,
           "libHD.so is missing: install OpenHaptics, and then the maker's driver for the device, and see "
           "that its test program finds the device; after that look again"},
          {"spacemouse", "navigation", "spacemouse", true, "a 3D mouse"}};
    };
    ways.open = [may = may_open](const std::string& address) -> base::Result<session::PointerConnection> {
      while (!may->load()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
      if (address == "broken") return base::fail("it answers to nobody");
      auto mapping = devices::read_mapping(address);
      if (!mapping) return tl::unexpected(mapping.error());
      // The first device of a back-end may be addressed without saying which.
      const std::string identity = address.starts_with("fake") ? "fake#1" : "";
      return session::PointerConnection{address, simulated("Fake Arm"), *mapping, identity};
    };
    return ways;
  }
};

/// The widgets of a type below another; Qt's own search takes those without a meta object for any widget.
template <typename Widget>
std::vector<Widget*> all_in(const QWidget& parent) {
  std::vector<Widget*> found;
  for (QWidget* it : parent.findChildren<QWidget*>())
    if (auto* wanted = dynamic_cast<Widget*>(it)) found.push_back(wanted);
  return found;
}

class DevicePanelTest : public DesktopTest {
 protected:
  DevicePanelTest() : profiles_("XDG_CONFIG_HOME", folder_.path().toUtf8()) {
    panel_ = std::make_unique<DevicePanel>(session(), fake_.ways(), nullptr);
    panel_->setAttribute(Qt::WA_DontShowOnScreen);
    panel_->resize(340, 700);
    panel_->show();
  }

  template <typename Come>
  bool until(const Come& come) {
    return QTest::qWaitFor(
        [&] {
          session().update();
          return come();
        },
        30'000);
  }
  template <typename Widget>
  Widget* named(const char* name) {
    for (Widget* it : all_in<Widget>(*panel_))
      if (it->accessibleName() == name && it->isVisibleTo(panel_.get())) return it;
    return nullptr;
  }
  QPushButton* button(const char* text) {
    for (QPushButton* it : panel_->findChildren<QPushButton*>())
      if (it->text() == text && it->isVisibleTo(panel_.get())) return it;
    return nullptr;
  }
  bool says(const char* words) {
    for (QLabel* it : panel_->findChildren<QLabel*>())
      if (it->text().contains(words) && it->isVisibleTo(panel_.get())) return true;
    return false;
  }
  void connect_first() {
    ASSERT_TRUE(until([&] { return named<QPushButton>("Connect fake:1"); }));
    named<QPushButton>("Connect fake:1")->click();
    ASSERT_TRUE(until([&] { return session().hands().pointers() == 2 && form(); }));
  }
  PointerForm* form() {
    for (PointerForm* it : all_in<PointerForm>(*panel_))
      if (it->isVisibleTo(panel_.get())) return it;
    return nullptr;
  }

  /// A variable of the environment for as long as this lives.
  class Variable {
   public:
    Variable(const char* name, const QByteArray& value) : name_(name), before_(qgetenv(name)) {
      qputenv(name, value);
    }
    ~Variable() { before_.isNull() ? qunsetenv(name_) : qputenv(name_, before_); }
    Variable(const Variable&) = delete;
    Variable& operator=(const Variable&) = delete;

   private:
    const char* name_;
    QByteArray before_;
  };
  QTemporaryDir folder_;
  Variable profiles_;
  FakeWays fake_;
  std::unique_ptr<DevicePanel> panel_;
};

TEST_F(DevicePanelTest, ListsWhatIsThereAndSaysWhyTheRestIsNot) {
  if (!says("2 devices are there.")) {  // the search may have ended already
    EXPECT_TRUE(says("Looking for devices"));
    EXPECT_FALSE(button("Refresh")->isEnabled());
  }
  ASSERT_TRUE(until([&] { return says("2 devices are there."); }));
  ASSERT_TRUE(until([&] { return says("an arm of a test"); }));
  EXPECT_TRUE(says("libHD.so is missing: install OpenHaptics"));
  EXPECT_TRUE(says("moves the view: a 3D mouse"));
  EXPECT_TRUE(named<QPushButton>("Connect fake:1"));
  EXPECT_FALSE(named<QPushButton>("Connect hd"));
  EXPECT_FALSE(named<QPushButton>("Connect spacemouse"));
  button("Refresh")->click();
  ASSERT_TRUE(until([&] { return *fake_.searches == 2 && button("Refresh")->isEnabled(); }));
  EXPECT_EQ(all_in<DeviceRow>(*panel_).size(), 3U);
}

TEST_F(DevicePanelTest, WordsAreNotCutOff) {
  ASSERT_TRUE(until([&] { return says("libHD.so is missing"); }));
  ASSERT_TRUE(until([&] {
    for (const WrappedLabel* it : all_in<WrappedLabel>(*panel_))
      if (it->isVisibleTo(panel_.get()) && it->height() < it->heightForWidth(it->width())) return false;
    return true;
  }));
}

TEST(WrappedLabel, TakesTheRoomThatItsWordsNeed) {
  QWidget window;
  WrappedLabel label("one", &window);
  window.setAttribute(Qt::WA_DontShowOnScreen);
  window.show();
  label.resize(100, 20);
  const int one = label.minimumHeight();
  EXPECT_GT(one, 0);
  label.say("many words that do not find room in one line of that width, so that there are more of them");
  EXPECT_GE(label.minimumHeight(), 3 * one);
  label.resize(1000, 20);
  EXPECT_EQ(label.minimumHeight(), one);
  label.resize(100, 20);
  label.say("one");
  EXPECT_EQ(label.minimumHeight(), one);
}

TEST_F(DevicePanelTest, ADeviceIsKnownHoweverItWasAddressed) {
  ASSERT_TRUE(until([&] { return named<QPushButton>("Connect fake:1"); }));
  named<QLineEdit>("Address of a device")->setText("fake");
  named<QPushButton>("Connect this address")->click();
  ASSERT_TRUE(until([&] { return form() && named<QPushButton>("Disconnect fake:1"); }));
  named<QPushButton>("Disconnect fake:1")->click();
  EXPECT_EQ(session().hands().pointers(), 1U);
  ASSERT_TRUE(until([&] { return !form() && named<QPushButton>("Connect fake:1"); }));
}

TEST_F(DevicePanelTest, ConnectsAndDisconnectsWhileTheWindowGoesOn) {
  ASSERT_TRUE(until([&] { return named<QPushButton>("Connect fake:1"); }));
  *fake_.may_open = false;
  named<QPushButton>("Connect fake:1")->click();
  ASSERT_TRUE(button("Opening\u2026"));
  EXPECT_FALSE(button("Opening\u2026")->isEnabled());
  int turns = 0;
  ASSERT_TRUE(until([&] { return ++turns > 5; }));  // nobody waits
  EXPECT_EQ(session().hands().pointers(), 1U);
  *fake_.may_open = true;
  ASSERT_TRUE(until([&] { return form(); }));
  ASSERT_EQ(session().hands().pointers(), 2U);
  EXPECT_EQ(session().hands().use(0).address, "fake:1");
  ASSERT_TRUE(
      until([&] { return says("It is ready.") && says("0.00 of 3.3 N") && says("0.0, 0.0, 0.0 mm"); }));
  named<QPushButton>("Disconnect fake:1")->click();
  EXPECT_EQ(session().hands().pointers(), 1U);
  ASSERT_TRUE(until([&] { return !form() && named<QPushButton>("Connect fake:1"); }));
  connect_first();
  button("Disconnect")->click();
  EXPECT_EQ(session().hands().pointers(), 1U);
  ASSERT_TRUE(until([&] { return !form(); }));
}

TEST_F(DevicePanelTest, OpensAnAddressThatIsNotListedAndTellsWhyItCannot) {
  auto* address = named<QLineEdit>("Address of a device");
  ASSERT_TRUE(address);
  address->setText("broken");
  named<QPushButton>("Connect this address")->click();
  ASSERT_TRUE(until([&] { return says("broken: it answers to nobody"); }));
  const auto y_of = [&](const QWidget* it) { return it->mapTo(panel_.get(), QPoint(0, 0)).y(); };
  for (const PanelNote* note : all_in<PanelNote>(*panel_)) {
    if (note->text().contains("broken")) {
      EXPECT_LT(y_of(note), y_of(address) + 100) << "below the list nobody sees it";
    }
  }
  EXPECT_EQ(session().hands().pointers(), 1U);
  address->setText("vrpn:Tracker0@host");
  QTest::keyClick(address, Qt::Key_Return);
  ASSERT_TRUE(until([&] { return form(); }));
  EXPECT_EQ(session().hands().use(0).address, "vrpn:Tracker0@host");
  EXPECT_EQ(address->text(), QString());
  address->setText("vrpn:Tracker0@host");
  named<QPushButton>("Connect this address")->click();
  EXPECT_TRUE(says("is connected already"));
}

TEST_F(DevicePanelTest, ChangesTheMappingAtOnceAndKeepsItInTheProfile) {
  connect_first();
  auto* scale = named<QuantityField>("Scale");
  ASSERT_TRUE(scale);
  scale->setFocus();
  scale->selectAll();
  QTest::keyClicks(scale, "4");
  QTest::keyClick(scale, Qt::Key_Return);
  EXPECT_EQ(session().hands().use(0).mapping->scale, 4.0);
  auto* force = named<QuantityField>("Most force, N");
  QTest::keyClicks(force, "1.5");
  QTest::keyClick(force, Qt::Key_Return);
  EXPECT_EQ(session().hands().use(0).mapping->max_force, 1.5);
  auto* clutch = named<QComboBox>("Clutch");
  clutch->setCurrentIndex(2);
  emit clutch->activated(2);
  EXPECT_EQ(session().hands().use(0).mapping->clutch_button, 1);
  ASSERT_TRUE(until([&] { return session().hands().pointer_info(0).workspace_radius == 0.4; }));
  ASSERT_TRUE(until([&] { return says("400 mm"); }));
  button("Save")->click();
  EXPECT_TRUE(says("Kept in"));
  const auto kept = devices::read_mapping("fake:1");
  ASSERT_TRUE(kept);
  EXPECT_EQ(kept->scale, 4.0);
  EXPECT_EQ(kept->max_force, 1.5);
  EXPECT_EQ(kept->clutch_button, 1);
  EXPECT_FALSE(kept->scale_follows_view);
  // The next time it is used so from the start.
  button("Disconnect")->click();
  ASSERT_TRUE(until([&] { return !form() && named<QPushButton>("Connect fake:1"); }));
  connect_first();
  EXPECT_EQ(session().hands().use(0).mapping->scale, 4.0);
}

TEST_F(DevicePanelTest, RefusesAScaleThatNoDeviceHas) {
  connect_first();
  auto* scale = named<QuantityField>("Scale");
  scale->setFocus();
  scale->selectAll();
  QTest::keyClicks(scale, "0");
  QTest::keyClick(scale, Qt::Key_Return);
  EXPECT_TRUE(says("The scale must be from 0.01 to 100."));
  EXPECT_EQ(session().hands().use(0).mapping->scale, std::nullopt);
  button("Save")->click();
  EXPECT_FALSE(says("Kept in"));
}

TEST_F(DevicePanelTest, TheScaleFollowsTheViewWhereAPersonWantsThat) {
  connect_first();
  interaction::View view;
  view.distance = 6.0;
  session().view().set(view);
  auto* follows = named<QCheckBox>("Scale follows the view");
  ASSERT_TRUE(follows);
  follows->click();
  EXPECT_TRUE(named<QuantityField>("Scale")->isReadOnly());
  const double wanted = 6.0 * std::sin(0.5 * view.field);
  ASSERT_TRUE(
      until([&] { return std::abs(session().hands().pointer_info(0).workspace_radius - wanted) < 1e-9; }));
  auto* shown = named<QCheckBox>("Workspace shown in the scene");
  shown->click();
  EXPECT_TRUE(session().hands().use(0).shows_workspace);
  button("Save")->click();
  EXPECT_TRUE(devices::read_mapping("fake:1")->scale_follows_view);
}

class DevicesInTheWindowTest : public WindowTest {};

TEST_F(DevicesInTheWindowTest, AreAskedForInTheMenuOfTheView) {
  const auto panel = [&] { return all_in<DevicePanel>(*window_).front(); };
  EXPECT_FALSE(panel()->isVisible());
  action("view.devices")->trigger();
  ASSERT_TRUE(until([&] { return panel()->isVisible(); }));
  // What the catalogue lists is there on every machine.
  EXPECT_TRUE(until([&] {
    for (QPushButton* it : panel()->findChildren<QPushButton*>())
      if (it->accessibleName() == "Connect simulated") return true;
    return false;
  }));
}

}  // namespace
}  // namespace icome::ui
