#pragma once
#include <QStringList>
#include <array>

#include "session/session.h"
#include "ui/forms/quantity_field.h"
#include "ui/panels/edit_run.h"
#include "ui/panels/panel_section.h"
#include "ui/panels/property.h"

namespace icome::ui {

/// Makes rows of a panel that show the values that the selected objects have in common, and change all of
/// them. A row is visible while all have the property. The session and the sections outlive it.
class PropertyBinder {
 public:
  /// The things that a change applies to, and is named after.
  enum class Of : std::uint8_t { Objects, Shapes, Materials, Lights, Viewpoints, Effects };
  /// A row's label, its tooltip, and the verb that names its change: "Move", "Change radius of".
  struct Row {
    QString label = {};
    QString tip = {};
    QString verb = {};
    Of of = Of::Objects;
  };

  explicit PropertyBinder(session::Session& session) : session_(session), run_(session) {}

  void number(PanelSection& section, const Row& row, Quantity quantity, const Property<double>& property);
  /// A number with a slider beside it, from `least` to `most`: dragging is felt and seen at once, and is one
  /// action to undo.
  void slider(PanelSection& section, const Row& row, Quantity quantity, const Property<double>& property,
              double least, double most);
  void triple(PanelSection& section, const Row& row, Quantity quantity,
              const std::array<Property<double>, 3>& properties);
  /// A number that may be missing; `none` tells what that means.
  void maybe_number(PanelSection& section, const Row& row, Quantity quantity,
                    const Property<std::optional<double>>& property, const QString& none);
  void text(PanelSection& section, const Row& row, const Property<std::string>& property);
  void colour(PanelSection& section, const Row& row, const Property<world::Colour>& property);
  void check(PanelSection& section, const Row& row, const Property<bool>& property);
  void choice(PanelSection& section, const Row& row, const Property<int>& property, const QStringList& items);
  /// A choice of the texts, shown in these words; any other text that an object has is shown, too.
  void text_choice(PanelSection& section, const Row& row, const Property<std::string>& property,
                   const std::vector<std::string>& texts, QString (*words)(const std::string& text));
  /// Calls `refresh` whenever the rows are refreshed, for anything else that follows the selection.
  void follow(std::function<void()> refresh) { refreshers_.push_back(std::move(refresh)); }

  /// Shows the present selection in all rows.
  void refresh();
  const Subjects& subjects() const { return subjects_; }
  session::Session& session() const { return session_; }
  /// Name of an action: "Change colour of Beech", "Move 3 objects".
  std::string action(const QString& verb, Of of) const;
  base::Result<void> perform(const void* control, const world::Edit& edit, const std::string& name,
                             bool more = false) {
    return run_.perform(control, edit, name, more);
  }

 private:
  const std::vector<world::ObjectId>& list(Of of) const;
  template <typename Value>
  base::Result<void> set(const void* control, const Row& row, const Property<Value>& property,
                         const Value& value, bool more = false);
  QuantityField* number_field(PanelSection& section, const Row& row, Quantity quantity,
                              const Property<double>& property);

  session::Session& session_;
  EditRun run_;
  Subjects subjects_ = {};
  std::vector<std::function<void()>> refreshers_ = {};
};

}  // namespace icome::ui
