#pragma once
#include <QLineEdit>
#include <functional>
#include <vector>

#include "interaction/operations/parameter.h"
#include "world/world.h"

class QStringListModel;

namespace icome::ui {

/// A field for the object, or the objects, that an operation takes: the selection, unless a person types
/// names. Emptied, it follows the selection again.
class ObjectField final : public QLineEdit {
 public:
  /// `world` gives the world in which names of objects are looked up.
  ObjectField(const interaction::Parameter& parameter, std::function<const world::World&()> world,
              QWidget* parent);

  void on_change(std::function<void()> changed) { changed_ = std::move(changed); }
  /// Takes the selected objects, which are the value as long as nothing is typed.
  void follow(const std::vector<world::ObjectId>& objects);
  /// The value as operations take it; null: no object.
  interaction::Value value() const;

 private:
  void show_followed();
  void type(const QString& text);
  void offer(const QString& text);

  const interaction::Parameter& parameter_;
  std::function<const world::World&()> world_;
  std::function<void()> changed_ = [] {};
  std::vector<world::ObjectId> followed_ = {};
  bool typed_ = false;
  QStringListModel* offers_;
};

}  // namespace icome::ui
