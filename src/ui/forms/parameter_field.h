#pragma once
#include <QWidget>
#include <functional>
#include <memory>
#include <vector>

#include "interaction/operations/parameter.h"
#include "world/world.h"

namespace icome::ui {

/// Where one parameter of an operation is said. Its widgets belong to the widget that they are put on; they,
/// the session and the parameter outlive it.
class ParameterField {
 public:
  struct Place {
    std::function<const world::World&()> world;  // that objects are named of
    QWidget* parent;
    std::function<void()> changed;  // something else has been said, maybe not to its end
  };

  ParameterField() = default;
  virtual ~ParameterField() = default;
  ParameterField(const ParameterField&) = delete;
  ParameterField& operator=(const ParameterField&) = delete;

  /// What stands beside the label, from left to right.
  virtual std::vector<QWidget*> widgets() const = 0;
  /// What is said, also where it is still being typed; null: nothing. Fails for what is no such value.
  virtual base::Result<interaction::Value> value() const = 0;
  /// Takes what is being typed as said, where that makes a difference.
  virtual void finish_typing() {}
  /// Shows why it was refused, in its own way.
  virtual void mark(bool refused);
  /// What the selection says for it.
  virtual void follow(const std::vector<world::ObjectId>& /*objects*/) {}
  /// Said with text that is better checked while it is typed.
  virtual bool is_checked_at_once() const { return false; }
};

/// A field that suits the kind of the parameter.
std::unique_ptr<ParameterField> make_parameter_field(const interaction::Parameter& parameter,
                                                     const ParameterField::Place& place);

}  // namespace icome::ui
