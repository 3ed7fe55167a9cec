#include "ui/forms/operation_form.h"

#include <QCheckBox>
#include <QComboBox>
#include <QLabel>
#include <QPlainTextEdit>
#include <QTest>
#include <algorithm>

#include "ui/desktop_test.h"
#include "ui/forms/operation_arguments.h"
#include "ui/forms/operation_words.h"
#include "ui/forms/quantity_field.h"

namespace icome::ui {
namespace {

using interaction::Operation;
using interaction::Parameter;
using interaction::ParameterKind;
using interaction::Value;
using world::ObjectId;

/// A number that the parameter takes.
double number_for(const Parameter& parameter) {
  for (const double number : {2.0, 1.0, 0.5, parameter.least, parameter.most})
    if (number >= parameter.least && number <= parameter.most) return number;
  return 0.0;
}

Value value_for(const Parameter& parameter, const std::string& object) {
  const double number = number_for(parameter);
  switch (parameter.kind) {
    case ParameterKind::Flag:
      return true;
    case ParameterKind::Number:
    case ParameterKind::Count:
      return number;
    case ParameterKind::Text:
      return "some words";
    case ParameterKind::Texts:
      return Value::List{"some words"};
    case ParameterKind::Picture:
      return "/nowhere/wood.png";
    case ParameterKind::Choice:
      return parameter.choices.back();
    case ParameterKind::Colour:
      return "#ff8000";
    case ParameterKind::Vector:
      return Value::List{number, number, number};
    case ParameterKind::Numbers:
    case ParameterKind::Counts:
      return Value::List{number, number};
    case ParameterKind::Points:
      return Value::List{Value(Value::List(parameter.components, number))};
    case ParameterKind::Object:
      return object;
    case ParameterKind::Objects:
      return Value::List{object};
    case ParameterKind::Records: {
      Value::Fields record;
      const bool chosen = !parameter.fields.empty() && parameter.fields.front().kind == ParameterKind::Choice;
      const std::string choice = chosen ? parameter.fields.front().choices.back() : "";
      for (const Parameter& inner : parameter.fields)
        if (is_asked(inner, choice)) record.emplace_back(inner.name, value_for(inner, object));
      return Value::List{record};
    }
  }
  return {};
}

class OperationFormTest : public DesktopTest {
 protected:
  OperationFormTest() {
    leg_ = create("leg");
    top_ = create("top");
  }

  ObjectId create(const std::string& name) {
    const ObjectId id = session().ids().next<ObjectId>();
    perform(world::CreateObject{id, world().roots().size(), {.name = name}});
    return id;
  }
  OperationForm& show(const Operation& operation) {
    form_ = std::make_unique<OperationForm>(operation, session(), nullptr);
    form_->setAttribute(Qt::WA_DontShowOnScreen);
    form_->resize(320, 900);
    form_->show();
    return *form_;
  }
  /// The widgets of a parameter's row, in its order.
  std::vector<QWidget*> row(const Parameter& parameter) {
    std::vector<QWidget*> widgets;
    for (QWidget* it : form_->findChildren<QWidget*>()) {
      const QString name = it->accessibleName();
      const QString label = label_of(parameter);
      const bool axis = parameter.kind == ParameterKind::Vector && name.size() == label.size() + 2;
      if (name == label || (axis && name.startsWith(label + ' '))) widgets.push_back(it);
    }
    return widgets;
  }
  template <typename Widget>
  Widget& field(const char* name) {
    auto* found = form_->findChild<Widget*>(QString("parameter.") + name);
    EXPECT_TRUE(found) << name;
    return *found;
  }
  static void type(QLineEdit& line, const QString& text) {
    line.setFocus();
    line.selectAll();
    text.isEmpty() ? QTest::keyClick(&line, Qt::Key_Delete) : QTest::keyClicks(&line, text);
  }
  /// Says a value as a person does.
  void say(const Parameter& parameter, const Value& value) {
    const std::vector<QWidget*> widgets = row(parameter);
    ASSERT_FALSE(widgets.empty()) << parameter.name;
    if (auto* box = qobject_cast<QComboBox*>(widgets.front())) {
      box->setCurrentIndex(box->findData(QString::fromStdString(*value.text())));
    } else if (auto* check = qobject_cast<QCheckBox*>(widgets.front())) {
      check->setChecked(*value.flag());
    } else if (auto* text = qobject_cast<QPlainTextEdit*>(widgets.front())) {
      text->setPlainText(QString::fromStdString(json_from_value(value)));
    } else if (dynamic_cast<QuantityField*>(widgets.front())) {
      const Value::List parts = value.list() ? *value.list() : Value::List{value};
      ASSERT_EQ(widgets.size(), parts.size()) << parameter.name;
      for (std::size_t i = 0; i < parts.size(); ++i)
        type(*qobject_cast<QLineEdit*>(widgets[i]), number_text(*parts[i].number(), quantity_of(parameter)));
    } else {
      const bool names = parameter.kind == ParameterKind::Objects;
      const Value& said = names ? value.list()->front() : value;
      type(*qobject_cast<QLineEdit*>(widgets.front()),
           QString::fromStdString(said.text() ? *said.text() : json_from_value(said)));
    }
  }
  Value::Fields fields() {
    auto fields = form_->fields();
    EXPECT_TRUE(fields) << fields.error().message;
    return fields ? *fields : Value::Fields{};
  }
  std::string json() { return json_from_value(fields()); }
  std::string error() {
    const auto fields = form_->fields();
    return fields ? std::string() : fields.error().message;
  }

  ObjectId leg_, top_;
  std::unique_ptr<OperationForm> form_;
};

bool is_same(const Value& one, const Value& other) {
  if (one.number() && other.number())
    return std::abs(*one.number() - *other.number()) <= 1e-12 * std::abs(*other.number());
  if (!one.list() || !other.list()) return one == other;
  return std::ranges::equal(*one.list(), *other.list(), is_same);
}

/// All of an operation's parameters, for one choice of its first.
class AllSaid {
 public:
  AllSaid(const Operation& operation, std::string choice)
      : operation_(operation), choice_(std::move(choice)) {}

  bool has(const Parameter& parameter) const { return is_asked(parameter, choice_); }
  Value value(const Parameter& parameter) const {
    const bool first =
        &parameter == &operation_.parameters.front() && parameter.kind == ParameterKind::Choice;
    return first ? Value(choice_) : value_for(parameter, "leg");
  }

 private:
  const Operation& operation_;
  std::string choice_;
};

std::vector<std::string> choices_of(const Operation& operation) {
  if (operation.parameters.empty() || operation.parameters.front().kind != ParameterKind::Choice) return {""};
  return operation.parameters.front().choices;
}

TEST_F(OperationFormTest, WhatIsSaidOfEveryOperationComesBack) {
  for (const Operation& operation : interaction::operations()) {
    for (const std::string& choice : choices_of(operation)) {
      SCOPED_TRACE(operation.name + " " + choice);
      show(operation);
      const AllSaid all(operation, choice);
      for (const Parameter& parameter : operation.parameters)
        if (all.has(parameter)) say(parameter, all.value(parameter));
      const Value::Fields said = fields();
      const auto checked = interaction::Arguments::check(operation.parameters, said, world());
      EXPECT_TRUE(checked) << checked.error().message;
      for (const Parameter& parameter : operation.parameters) {
        const Value* value = interaction::field(said, parameter.name);
        const Value wanted = all.has(parameter) ? all.value(parameter) : Value();
        const Value came = value ? *value : parameter.fallback;
        const bool names = parameter.kind == ParameterKind::Objects && !wanted.is_null();
        const bool same = names ? came == wanted.list()->front() : wanted.is_null() || is_same(came, wanted);
        EXPECT_TRUE(same) << parameter.name << ": " << json_from_value(came) << " for "
                          << json_from_value(wanted);
        EXPECT_EQ(value && !all.has(parameter), false) << parameter.name;
      }
    }
  }
}

TEST_F(OperationFormTest, AFreshFormSaysNothingButWhatHasToBeSaid) {
  for (const Operation& operation : interaction::operations()) {
    SCOPED_TRACE(operation.name);
    show(operation);
    for (const auto& [name, value] : fields()) {
      const auto parameter = std::ranges::find(operation.parameters, name, &Parameter::name);
      ASSERT_NE(parameter, operation.parameters.end()) << name;
      EXPECT_TRUE(parameter->required) << name;
    }
  }
}

Operation made_of(std::vector<Parameter> parameters) {
  return {"make", "Make", "Shape", "Makes.", std::move(parameters)};
}

TEST_F(OperationFormTest, UnitsAreThoseOfPeople) {
  const Operation operation = made_of(
      {{.name = "far", .meaning = "how far it reaches, m", .fallback = 0.1},
       {.name = "turn", .kind = ParameterKind::Vector, .meaning = "an axis, as long as the angle in degrees"},
       {.name = "lean", .meaning = "how much it leans, rad"},
       {.name = "stiffness", .meaning = "N/m; usually 500"},
       {.name = "factor", .meaning = "how many times as large, from 1"}});
  show(operation);
  EXPECT_EQ(label_of(operation.parameters[0]), "Far, mm");
  EXPECT_EQ(label_of(operation.parameters[1]), "Turn, °");
  EXPECT_EQ(label_of(operation.parameters[2]), "Lean, °");
  EXPECT_EQ(label_of(operation.parameters[3]), "Stiffness, N/m");
  EXPECT_EQ(label_of(operation.parameters[4]), "Factor");
  EXPECT_EQ(field<QuantityField>("far").text(), "100");
  EXPECT_EQ(json(), "{}");
  type(field<QuantityField>("far"), "25");
  type(field<QuantityField>("turn"), "90");
  type(field<QuantityField>("stiffness"), "0.8 N/mm");
  EXPECT_EQ(json(), R"({"far":0.025,"turn":[90,0,0],"stiffness":800})");
  type(field<QuantityField>("far"), "3 cm");
  type(field<QuantityField>("lean"), "180");
  const Value::Fields said = fields();
  EXPECT_DOUBLE_EQ(*interaction::field(said, "far")->number(), 0.03);
  EXPECT_DOUBLE_EQ(*interaction::field(said, "lean")->number(), 3.14159265358979323846);
}

TEST_F(OperationFormTest, PartsOfAVectorThatNobodySaysAreNeutral) {
  const Operation operation =
      made_of({{.name = "by", .kind = ParameterKind::Vector, .meaning = "how far, m"},
               {.name = "scale", .kind = ParameterKind::Vector, .meaning = "how many times", .least = 1e-6}});
  show(operation);
  EXPECT_EQ(json(), "{}");
  type(field<QuantityField>("by"), "50");
  type(field<QuantityField>("scale"), "2");
  EXPECT_EQ(json(), R"({"by":[0.05,0,0],"scale":[2,1,1]})");
  type(field<QuantityField>("by"), "");
  EXPECT_EQ(json(), R"({"scale":[2,1,1]})");
}

TEST_F(OperationFormTest, WhatIsNoValueIsMarkedAndExplained) {
  const Operation operation = made_of(
      {{.name = "count", .kind = ParameterKind::Count, .meaning = "how many", .least = 1.0, .most = 9.0},
       {.name = "points", .kind = ParameterKind::Points, .meaning = "corners, m", .components = 2}});
  show(operation);
  for (const char* text : {"0", "10", "2.5", "nonsense", "1e400"}) {
    type(field<QuantityField>("count"), text);
    EXPECT_TRUE(error().starts_with("'count'")) << text << ": " << error();
    EXPECT_TRUE(field<QuantityField>("count").property("refused").toBool()) << text;
  }
  type(field<QuantityField>("count"), "3");
  EXPECT_EQ(json(), R"({"count":3})");
  auto& points = field<QPlainTextEdit>("points");
  const auto note = [&] {
    for (const QLabel* label : form_->findChildren<QLabel*>())
      if (label->accessibleName() == "Why something was refused" && label->isVisible()) return label->text();
    return QString();
  };
  points.setPlainText("[[0, 0], [0.1");
  EXPECT_TRUE(note().startsWith("'points': this is no JSON")) << note().toStdString();
  points.setPlainText("[[0, 0, 0]]");
  EXPECT_EQ(note(), "'points' must be a list of points of 2 numbers each");
  EXPECT_TRUE(points.property("refused").toBool());
  points.setPlainText("[[0, 0], [0.1, 0]]");
  EXPECT_EQ(note(), "");
  EXPECT_FALSE(points.property("refused").toBool());
  EXPECT_EQ(json(), R"({"count":3,"points":[[0,0],[0.1,0]]})");
}

TEST_F(OperationFormTest, AListOfNumbersNeedsNoBrackets) {
  const Operation operation = made_of({{.name = "vertices", .kind = ParameterKind::Counts, .least = 0.0}});
  show(operation);
  type(field<QLineEdit>("vertices"), "0, 3, 7");
  EXPECT_EQ(json(), R"({"vertices":[0,3,7]})");
  type(field<QLineEdit>("vertices"), "[1]");
  EXPECT_EQ(json(), R"({"vertices":[1]})");
  type(field<QLineEdit>("vertices"), "-1");
  EXPECT_FALSE(error().empty());
}

TEST_F(OperationFormTest, OnlyWhatBelongsToTheChoiceIsAsked) {
  const Operation operation =
      made_of({{.name = "shape", .kind = ParameterKind::Choice, .required = true, .choices = {"box", "ball"}},
               {.name = "size", .meaning = "m", .only_for = {"box"}},
               {.name = "radius", .meaning = "m", .only_for = {"ball"}},
               {.name = "name", .kind = ParameterKind::Text}});
  show(operation);
  const auto seen = [&](const char* name) { return field<QWidget>(name).isVisible(); };
  EXPECT_TRUE(seen("size") && !seen("radius") && seen("name"));
  type(field<QuantityField>("size"), "5");
  EXPECT_EQ(json(), R"({"shape":"box","size":0.005})");
  field<QComboBox>("shape").setCurrentIndex(1);
  EXPECT_TRUE(!seen("size") && seen("radius") && seen("name"));
  type(field<QuantityField>("radius"), "7");
  EXPECT_EQ(json(), R"({"shape":"ball","radius":0.007})");
}

TEST_F(OperationFormTest, ObjectsFollowTheSelectionUntilOthersAreNamed) {
  const Operation operation = made_of(
      {{.name = "objects", .kind = ParameterKind::Objects, .required = true},
       {.name = "parent", .kind = ParameterKind::Object, .meaning = "what it belongs to; else to nothing"}});
  session().select({leg_});
  show(operation);
  const auto number = [](ObjectId id) { return "\"#" + std::to_string(id.value) + '"'; };
  auto& objects = field<QLineEdit>("objects");
  EXPECT_EQ(objects.text(), "leg");
  EXPECT_EQ(json(), "{\"objects\":[" + number(leg_) + "]}");
  session().select({top_, leg_});
  form_->follow_selection();
  EXPECT_EQ(objects.text(), "top, leg");
  EXPECT_EQ(json(), "{\"objects\":[" + number(top_) + "," + number(leg_) + "]}");
  EXPECT_EQ(field<QLineEdit>("parent").placeholderText(), "to nothing");
  type(objects, "leg");
  session().select({});
  form_->follow_selection();
  EXPECT_EQ(json(), R"({"objects":"leg"})");
  type(objects, "leg, top");
  EXPECT_EQ(json(), R"({"objects":["leg","top"]})");
  type(objects, "lug");
  EXPECT_EQ(error(), "there is no object named 'lug'; did you mean 'leg'?");
  type(objects, "");
  EXPECT_EQ(json(), "{}");
  session().select({top_});
  form_->follow_selection();
  EXPECT_EQ(objects.text(), "top");
}

TEST(OperationArguments, SelectedObjectsAreSharedOut) {
  const ObjectId one{1}, two{2}, three{3};
  const std::vector<Parameter> parameters = {
      {.name = "object", .kind = ParameterKind::Object, .required = true},
      {.name = "parent", .kind = ParameterKind::Object},
      {.name = "rest", .kind = ParameterKind::Objects, .required = true}};
  using Shares = std::vector<std::vector<ObjectId>>;
  EXPECT_EQ(shares_of(parameters, {}), (Shares{{}, {}, {}}));
  EXPECT_EQ(shares_of(parameters, {one}), (Shares{{one}, {}, {}}));
  EXPECT_EQ(shares_of(parameters, {one, two, three}), (Shares{{one}, {}, {two, three}}));
  const Operation single = made_of({parameters.front()});
  EXPECT_TRUE(asks_only_for_objects(single));
  EXPECT_FALSE(asks_only_for_objects(made_of(parameters)));
  EXPECT_FALSE(completed_fields(single, {}, {}));
  EXPECT_FALSE(completed_fields(single, {}, {one, two}));
  EXPECT_EQ(json_from_value(*completed_fields(single, {}, {two})), R"({"object":"#2"})");
}

TEST(OperationWords, TellWhatIsMeantOtherwise) {
  const auto otherwise = [](const char* meaning) { return otherwise_of({.name = "x", .meaning = meaning}); };
  EXPECT_EQ(otherwise("what it is called; else its shape"), "its shape");
  EXPECT_EQ(otherwise("where it turns, m; else its middle; exact"), "its middle");
  EXPECT_EQ(otherwise("how far"), "");
  EXPECT_EQ(words_of("along-tangent"), "Along tangent");
}

}  // namespace
}  // namespace icome::ui
