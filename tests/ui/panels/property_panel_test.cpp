#include "ui/panels/property_panel.h"

#include <QCheckBox>
#include <QComboBox>
#include <QLabel>
#include <QPushButton>
#include <QSlider>
#include <QTest>
#include <QToolTip>
#include <numbers>

#include "base/random.h"
#include "ui/desktop_test.h"
#include "ui/forms/colour_button.h"
#include "ui/forms/quantity_field.h"
#include "ui/forms/text_field.h"
#include "ui/panels/object_properties.h"
#include "world/shape/solid_geometry.h"

namespace icome::ui {
namespace {

using world::ObjectId;

class PropertyPanelTest : public DesktopTest {
 protected:
  PropertyPanelTest() {
    world::IdSource& ids = session().ids();
    shape_ = ids.next<world::GeometryId>();
    material_ = ids.next<world::MaterialId>();
    perform(world::CreateGeometry{shape_,
                                  std::make_shared<world::PrimitiveGeometry>(geometry::Cylinder{0.02, 0.1})});
    perform(world::CreateMaterial{material_, {.name = "Beech"}});
    one_ = create("one", 0.01);
    two_ = create("two", 0.02);
    panel_ = std::make_unique<PropertyPanel>(session(), nullptr);
    panel_->setAttribute(Qt::WA_DontShowOnScreen);
    panel_->resize(320, 900);
    panel_->show();
  }

  ObjectId create(const std::string& name, double x) {
    const ObjectId id = session().ids().next<ObjectId>();
    world::PhysicalObject object{.name = name, .geometry = shape_, .material = material_};
    object.parent_from_object.translation() = base::Vector3(x, 0.0, 0.0);
    perform(world::CreateObject{id, world().roots().size(), object});
    return id;
  }
  void select(std::vector<ObjectId> objects) {
    session().select(std::move(objects));
    QApplication::processEvents();
  }
  template <typename Widget>
  Widget& field(const QString& name) {
    for (Widget* it : panel_->findChildren<Widget*>()) {
      if (it->accessibleName() == name && it->isVisibleTo(panel_.get())) return *it;
    }
    ADD_FAILURE() << "no field " << name.toStdString();
    static Widget* const kNone = nullptr;
    return *kNone;
  }
  bool is_shown(const QString& name) {
    for (QWidget* it : panel_->findChildren<QWidget*>()) {
      if (it->accessibleName() == name && it->isVisibleTo(panel_.get())) return true;
    }
    return false;
  }
  QPushButton& button(const QString& text) {
    for (QPushButton* it : panel_->findChildren<QPushButton*>()) {
      if (it->text().remove('&') == text) return *it;
    }
    ADD_FAILURE() << "no button " << text.toStdString();
    static QPushButton* const kNone = nullptr;
    return *kNone;
  }
  /// Types into a field as a person does.
  void type(QLineEdit& field, const QString& text) {
    field.setFocus();
    field.selectAll();
    QTest::keyClicks(&field, text);
    QTest::keyClick(&field, Qt::Key_Return);
    QApplication::processEvents();
  }
  QString complaint() {
    for (const QLabel* label : panel_->findChildren<QLabel*>()) {
      if (label->accessibleName() == "Why something was refused" && !label->text().isEmpty())
        return label->text();
    }
    return {};
  }
  /// Is this on a label that is seen?
  bool says(const QString& words) {
    for (const QLabel* label : panel_->findChildren<QLabel*>())
      if (label->isVisibleTo(panel_.get()) && label->text().contains(words)) return true;
    return false;
  }
  const world::Material& material() { return *world().find(material_); }
  double radius() {
    const auto& shape = dynamic_cast<const world::PrimitiveGeometry&>(*world().find(shape_)->shape);
    return std::get<geometry::Cylinder>(shape.primitive).radius;
  }

  world::GeometryId shape_;
  world::MaterialId material_;
  ObjectId one_, two_;
  std::unique_ptr<PropertyPanel> panel_;
};

TEST_F(PropertyPanelTest, ShowsWhatSeveralHaveInCommon) {
  select({one_, two_});
  EXPECT_EQ(field<QuantityField>("Position, mm x").text(), "");
  EXPECT_EQ(field<QuantityField>("Position, mm x").placeholderText(), "mixed");
  EXPECT_EQ(field<QuantityField>("Position, mm y").text(), "0");
  EXPECT_EQ(field<QuantityField>("Radius, mm").text(), "20");
  EXPECT_EQ(field<TextField>("Name").placeholderText(), "mixed");
  EXPECT_FALSE(is_shown("Ring radius, mm"));
  EXPECT_FALSE(is_shown("Intensity, %"));
}

TEST_F(PropertyPanelTest, MovesAllThatIsSelectedInOneAction) {
  select({one_, two_});
  type(field<QuantityField>("Position, mm x"), "3 cm");
  EXPECT_DOUBLE_EQ(world().find(one_)->parent_from_object.translation().x(), 0.03);
  EXPECT_DOUBLE_EQ(world().find(two_)->parent_from_object.translation().x(), 0.03);
  EXPECT_EQ(session().history().undo_name(), "Move 2 objects");
  EXPECT_EQ(field<QuantityField>("Position, mm x").text(), "30");
  ASSERT_TRUE(session().history().undo());
  EXPECT_DOUBLE_EQ(world().find(two_)->parent_from_object.translation().x(), 0.02);
}

TEST_F(PropertyPanelTest, ShowsWhatThereIsRoomForAndAllToWhoEdits) {
  select({one_});
  QuantityField& x = field<QuantityField>("Position, mm x");
  type(x, "118.948");
  x.clearFocus();
  x.setMinimumWidth(0);
  x.resize(x.fontMetrics().horizontalAdvance("118.948") / 2 + 16, x.height());
  const QString little = x.text();
  EXPECT_TRUE(QString("118.948").startsWith(little) || little == "119") << little.toStdString();
  EXPECT_LT(little.size(), 7);
  QApplication::setActiveWindow(x.window());
  x.setFocus();
  EXPECT_EQ(x.text(), "118.948");
  x.clearFocus();
  EXPECT_DOUBLE_EQ(world().find(one_)->parent_from_object.translation().x(), 0.118948);
}

TEST_F(PropertyPanelTest, ShowsThatDigitsAreMissing) {
  select({one_});
  QuantityField& x = field<QuantityField>("Position, mm x");
  type(x, "-118948");
  x.clearFocus();
  x.setMinimumWidth(0);
  x.resize(x.fontMetrics().horizontalAdvance("-11894"), x.height());
  EXPECT_TRUE(x.text().endsWith(QChar(0x2026))) << x.text().toStdString();
  QHelpEvent help(QEvent::ToolTip, {2, 2}, x.mapToGlobal(QPoint(2, 2)));
  QCoreApplication::sendEvent(&x, &help);
  EXPECT_TRUE(QToolTip::text().startsWith(x.toolTip())) << QToolTip::text().toStdString();
  EXPECT_TRUE(QToolTip::text().endsWith("\n-118948")) << QToolTip::text().toStdString();
  QToolTip::hideText();
  QApplication::setActiveWindow(x.window());
  x.setFocus();
  EXPECT_EQ(x.text(), "-118948");
  x.clearFocus();
  EXPECT_DOUBLE_EQ(world().find(one_)->parent_from_object.translation().x(), -118.948);
}

TEST_F(PropertyPanelTest, ASpunValueIsOneStepToUndo) {
  select({one_});
  QuantityField& x = field<QuantityField>("Position, mm x");
  x.setFocus();
  for (int i = 0; i < 5; ++i) QTest::keyClick(&x, Qt::Key_Up);
  QTest::keyClick(&x, Qt::Key_Up, Qt::ShiftModifier);
  EXPECT_NEAR(world().find(one_)->parent_from_object.translation().x(), 0.025, 1e-12);
  ASSERT_TRUE(session().history().undo());
  EXPECT_DOUBLE_EQ(world().find(one_)->parent_from_object.translation().x(), 0.01);
  QApplication::processEvents();
  // After something else, spinning begins another action.
  QTest::keyClick(&x, Qt::Key_Up);
  EXPECT_NEAR(world().find(one_)->parent_from_object.translation().x(), 0.011, 1e-12);
  ASSERT_TRUE(session().history().undo());
  EXPECT_DOUBLE_EQ(world().find(one_)->parent_from_object.translation().x(), 0.01);
}

TEST_F(PropertyPanelTest, RefusesAbsurdValuesAtTheField) {
  select({one_});
  for (const char* text : {"0", "-3", "nonsense", "1e400", "5000 km"}) {
    QuantityField& field = this->field<QuantityField>("Radius, mm");
    type(field, text);
    EXPECT_TRUE(field.property("refused").toBool()) << text;
    EXPECT_EQ(field.text(), text);  // still there to be put right
    EXPECT_FALSE(complaint().isEmpty()) << text;
    EXPECT_DOUBLE_EQ(radius(), 0.02);
  }
  QTest::keyClick(&field<QuantityField>("Radius, mm"), Qt::Key_Escape);
  EXPECT_EQ(field<QuantityField>("Radius, mm").text(), "20");
  type(field<QuantityField>("Radius, mm"), "25");
  EXPECT_DOUBLE_EQ(radius(), 0.025);
  EXPECT_EQ(complaint(), "");
  EXPECT_EQ(session().history().undo_name(), "Change radius of one");
}

TEST_F(PropertyPanelTest, AnglesStayAsTheyWereTyped) {
  select({one_});
  type(field<QuantityField>("Rotation, ° y"), "100");
  EXPECT_EQ(field<QuantityField>("Rotation, ° x").text(), "0");
  EXPECT_EQ(field<QuantityField>("Rotation, ° y").text(), "100");
  const base::Matrix3 turn = world().find(one_)->parent_from_object.linear();
  const base::Matrix3 wanted =
      Eigen::AngleAxisd(100.0 / 180.0 * std::numbers::pi, base::Vector3::UnitY()).toRotationMatrix();
  EXPECT_TRUE(turn.isApprox(wanted, 1e-12));
}

TEST_F(PropertyPanelTest, SizeStretchesAlongTheObjectsOwnAxis) {
  select({one_});
  EXPECT_EQ(field<QuantityField>("Size, mm z").text(), "100");
  type(field<QuantityField>("Rotation, ° x"), "30");
  type(field<QuantityField>("Size, mm z"), "150");
  EXPECT_EQ(field<QuantityField>("Size, mm z").text(), "150");
  EXPECT_EQ(field<QuantityField>("Size, mm x").text(), "40");
  EXPECT_NEAR(world().find(one_)->parent_from_object.linear().col(2).norm(), 1.5, 1e-12);
  type(field<QuantityField>("Rotation, ° x"), "0");
  EXPECT_EQ(field<QuantityField>("Size, mm z").text(), "150");
}

TEST_F(PropertyPanelTest, AnEffectIsChangedAndSwitched) {
  select({one_});
  EXPECT_FALSE(is_shown("Force"));
  perform(
      world::ChangeFixture{one_, std::make_shared<const world::Fixture>(world::ForceEffect{"viscous:2"})});
  QApplication::processEvents();
  EXPECT_EQ(field<TextField>("Force").text(), "viscous:2");
  const auto effect = [&] { return std::get<world::ForceEffect>(*world().find(one_)->fixture); };
  type(field<TextField>("Force"), "well:0,0,0,0.01,1.5");
  EXPECT_EQ(effect().text, "well:0,0,0,0.01,1.5");
  EXPECT_EQ(session().history().undo_name(), "Change force of one");
  type(field<TextField>("Force"), "well:0,0,0,0.01");
  EXPECT_TRUE(complaint().contains("number 5")) << complaint().toStdString();
  EXPECT_EQ(effect().text, "well:0,0,0,0.01,1.5");
  field<QCheckBox>("On").click();
  EXPECT_FALSE(effect().on);
}

TEST_F(PropertyPanelTest, AnEffectOfANewerProgramIsToldKeptAndSwitched) {
  select({one_});
  perform(world::ChangeFixture{one_,
                               std::make_shared<const world::Fixture>(world::ForceEffect{"magnet:0,0,0,3"})});
  QApplication::processEvents();
  EXPECT_TRUE(says("It is not felt: there is no effect \"magnet\""));
  field<QCheckBox>("On").click();
  QApplication::processEvents();
  EXPECT_TRUE(complaint().isEmpty()) << complaint().toStdString();
  const auto& effect = std::get<world::ForceEffect>(*world().find(one_)->fixture);
  EXPECT_FALSE(effect.on);
  EXPECT_EQ(effect.text, "magnet:0,0,0,3");
  perform(
      world::ChangeFixture{one_, std::make_shared<const world::Fixture>(world::ForceEffect{"viscous:1"})});
  QApplication::processEvents();
  EXPECT_FALSE(says("It is not felt"));
}

TEST_F(PropertyPanelTest, ADragOfAnEffectsSliderIsFeltAllTheWayAndOneStepToUndo) {
  select({one_});
  const auto text = [&] { return std::get<world::ForceEffect>(*world().find(one_)->fixture).text; };
  perform(world::ChangeFixture{
      one_, std::make_shared<const world::Fixture>(world::ForceEffect{"well:0,0,0.01,0.01,1.5"})});
  QApplication::processEvents();
  EXPECT_FALSE(is_shown("Floor, mm")) << "of a recess";
  EXPECT_EQ(field<QuantityField>("Force, N").text(), "1.5");
  QSlider& force = field<QSlider>("Force, N");
  EXPECT_EQ(force.value(), 150) << "of 500 to 5 N";
  force.setSliderDown(true);
  for (const int step : {200, 250, 300}) {
    force.setSliderPosition(step);
    QApplication::processEvents();
    EXPECT_EQ(text(), "well:0,0,0.01,0.01," + std::string(step == 200 ? "2" : step == 250 ? "2.5" : "3"));
  }
  force.setSliderDown(false);
  EXPECT_EQ(session().history().undo_name(), "Change force of one");
  ASSERT_TRUE(session().history().undo());
  QApplication::processEvents();
  EXPECT_EQ(text(), "well:0,0,0.01,0.01,1.5") << "all of the drag";
  EXPECT_EQ(force.value(), 150);
  force.setSliderDown(true);
  force.setSliderPosition(100);
  force.setSliderDown(false);
  force.setSliderDown(true);
  force.setSliderPosition(50);
  force.setSliderDown(false);
  ASSERT_TRUE(session().history().undo());
  EXPECT_EQ(text(), "well:0,0,0.01,0.01,1") << "two drags are two steps";
}

TEST_F(PropertyPanelTest, ATextureWithDepthAndSpacingIsSaidInWords) {
  const auto feel = [&](const std::string& texture) {
    world::Material changed = material();
    changed.touch.texture = texture;
    perform(world::ChangeMaterial{material_, changed});
    QApplication::processEvents();
    return field<QComboBox>("Texture").currentText();
  };
  select({one_});
  EXPECT_EQ(feel("bumps:0.0006,0.004"), "Bumps, 0.6 mm deep every 4 mm");
  EXPECT_EQ(feel("ridges"), "Ridges, 0.2 mm deep every 2 mm");
  EXPECT_EQ(feel("velvet:1"), "velvet:1 (not known)");
  EXPECT_EQ(feel(""), "Smooth");
}

TEST_F(PropertyPanelTest, TouchKnowsTheDevicesBest) {
  select({one_});
  QuantityField& stiffness = field<QuantityField>("Stiffness, N/m");
  EXPECT_EQ(stiffness.text(), "");
  EXPECT_EQ(stiffness.placeholderText(), "device's best");
  type(stiffness, "0.8 N/mm");
  EXPECT_DOUBLE_EQ(*material().touch.stiffness, 800.0);
  EXPECT_EQ(session().history().undo_name(), "Change stiffness of Beech");
  type(stiffness, "nan");
  EXPECT_DOUBLE_EQ(*material().touch.stiffness, 800.0);
  stiffness.setFocus();
  stiffness.selectAll();
  QTest::keyClick(&stiffness, Qt::Key_Delete);
  QTest::keyClick(&stiffness, Qt::Key_Return);
  EXPECT_FALSE(material().touch.stiffness);
  type(field<QuantityField>("Dynamic friction"), "0.3");
  EXPECT_FALSE(complaint().isEmpty());  // static friction is less
  EXPECT_DOUBLE_EQ(material().touch.dynamic_friction, 0.0);
}

TEST_F(PropertyPanelTest, OwnCopyPartsWaysWithTheOthers) {
  select({one_});
  ASSERT_TRUE(button("Make own copy").isVisibleTo(panel_.get()));
  button("Make own copy").click();
  QApplication::processEvents();
  EXPECT_NE(world().find(one_)->geometry, shape_);
  EXPECT_EQ(world().find(two_)->geometry, shape_);
  EXPECT_FALSE(button("Make own copy").isVisibleTo(panel_.get()));
  type(field<QuantityField>("Radius, mm"), "7");
  EXPECT_DOUBLE_EQ(radius(), 0.02);
  button("Make own material").click();
  EXPECT_NE(world().find(one_)->material, material_);
  EXPECT_EQ(world().find(world().find(one_)->material)->name, "Beech");
}

TEST_F(PropertyPanelTest, ChoosesAmongMaterials) {
  const auto steel = session().ids().next<world::MaterialId>();
  perform(world::CreateMaterial{steel, {.name = "Steel"}});
  select({two_});
  QComboBox& box = field<QComboBox>("Made of");
  const int row = box.findText("Steel");
  ASSERT_GE(row, 0);
  box.setCurrentIndex(row);
  emit box.activated(row);
  EXPECT_EQ(world().find(two_)->material, steel);
  EXPECT_EQ(world().find(one_)->material, material_);
}

TEST_F(PropertyPanelTest, AWheelThatPassesOverTheMaterialChoosesNone) {
  perform(world::CreateMaterial{session().ids().next<world::MaterialId>(), {.name = "Steel"}});
  select({two_});
  QComboBox& box = field<QComboBox>("Made of");
  QWheelEvent wheel({5.0, 5.0}, box.mapToGlobal(QPoint(5, 5)), {}, {0, -120}, Qt::NoButton, {},
                    Qt::NoScrollPhase, false);
  QCoreApplication::sendEvent(&box, &wheel);
  EXPECT_FALSE(wheel.isAccepted());
  EXPECT_EQ(world().find(two_)->material, material_);
}

TEST_F(PropertyPanelTest, FollowsUndoAndSurvivesAnotherWorld) {
  select({one_});
  type(field<TextField>("Name"), "first");
  EXPECT_EQ(world().find(one_)->name, "first");
  ASSERT_TRUE(session().history().undo());
  QApplication::processEvents();
  EXPECT_EQ(field<TextField>("Name").text(), "one");
  perform(world::delete_subtree(world(), one_));
  QApplication::processEvents();
  EXPECT_FALSE(is_shown("Name"));
  session().files().make_new();
  QApplication::processEvents();
  EXPECT_FALSE(is_shown("Name"));
}

TEST(PlaceProperties, EveryTurnIsReadBack) {
  base::Random random(7);
  world::World world;
  world::IdSource ids;
  const auto id = ids.next<ObjectId>();
  ASSERT_TRUE(world::apply(world, world::CreateObject{id, 0, {}}));
  for (int i = 0; i < 300; ++i) {
    base::Affine3 place = base::Affine3::Identity();
    place.linear() = Eigen::AngleAxisd(random.uniform(-3.0, 3.0), random.direction()).toRotationMatrix() *
                     base::Vector3(random.uniform(0.1, 2.0), random.uniform(0.1, 2.0), 1.0).asDiagonal();
    if (i % 10 == 0)
      place.linear() = Eigen::AngleAxisd(std::numbers::pi / 2.0, base::Vector3::UnitY()).matrix();
    ASSERT_TRUE(world::apply(world, world::PlaceObject{id, place}));
    PlaceProperties properties;
    // Setting the angles that are shown changes nothing.
    for (int axis = 0; axis < 3; ++axis) {
      const auto angle = properties.turn(axis).get(world, id);
      const auto edit = properties.turn(axis).set(world, id, *angle);
      ASSERT_TRUE(edit && world::apply(world, *edit));
      EXPECT_TRUE(world.find(id)->parent_from_object.isApprox(place, 1e-9)) << i;
    }
  }
}

TEST(ColourButton, ShowsColoursAsTheyAreDrawn) {
  EXPECT_EQ(screen_colour({1.0F, 0.0F, 0.0F}), QColor(255, 0, 0));
  for (const int channel : {0, 1, 17, 128, 200, 255}) {
    const QColor colour(channel, 255 - channel, 40);
    EXPECT_EQ(screen_colour(world_colour(colour)).rgb(), colour.rgb());
  }
}

}  // namespace
}  // namespace icome::ui
