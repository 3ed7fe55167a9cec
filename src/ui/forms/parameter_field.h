#pragma once
#include <QWidget>
#include <functional>
#include <memory>
#include <vector>

#include "interaction/operations/parameter.h"
#include "world/world.h"

namespace icome::ui {

/// The field for one parameter of an operation. Its widgets are owned by their parent widget; they, the
/// session and the parameter outlive it.
class ParameterField {
 public:
  struct Place {
    std::function<const world::World&()> world;  // in which names of objects are looked up
    QWidget* parent;
    std::function<void()> changed;  // called when the field changes, also while typing
  };

  ParameterField() = default;
  virtual ~ParameterField() = default;
  ParameterField(const ParameterField&) = delete;
  ParameterField& operator=(const ParameterField&) = delete;

  /// The widgets beside the label, from left to right.
  virtual std::vector<QWidget*> widgets() const = 0;
  /// The value in the field, also while it is still being typed; null: none. Fails for text that is none.
  virtual base::Result<interaction::Value> value() const = 0;
  /// Commits the text that is being typed, where that makes a difference.
  virtual void finish_typing() {}
  /// Marks the field as refused, or as not.
  virtual void mark(bool refused);
  /// Takes the selected objects, in fields for objects.
  virtual void follow(const std::vector<world::ObjectId>& /*objects*/) {}
  /// Is the text to be checked while it is being typed?
  virtual bool is_checked_at_once() const { return false; }
};

/// Makes a field that suits the kind of the parameter.
std::unique_ptr<ParameterField> make_parameter_field(const interaction::Parameter& parameter,
                                                     const ParameterField::Place& place);

}  // namespace icome::ui
