#pragma once
#include <QLineEdit>
#include <functional>
#include <vector>

#include "interaction/operations/parameter.h"
#include "world/world.h"

class QStringListModel;

namespace icome::ui {

/// Which object an operation is for, or which ones: those that are selected, as long as nobody types others.
/// Emptied, it follows the selection again.
class ObjectField final : public QLineEdit {
 public:
  /// `world` is what objects are named of.
  ObjectField(const interaction::Parameter& parameter, std::function<const world::World&()> world,
              QWidget* parent);

  void on_change(std::function<void()> changed) { changed_ = std::move(changed); }
  /// What the selection says for it.
  void follow(const std::vector<world::ObjectId>& objects);
  /// As operations take it; null: nothing.
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
