#pragma once
#include <QAction>
#include <QMenu>
#include <functional>
#include <string>

#include "interaction/operations/operation.h"
#include "session/session.h"

namespace icome::ui {

/// The model menu: every operation that is not in the edit menu, each group as a menu of its own. What asks
/// for nothing but objects is performed at once on what is selected. Session and window outlive it.
class OperationActions {
 public:
  struct Hooks {
    std::function<bool()> begin;                             // before the world is touched; false: do not
    std::function<void(const std::string&)> refused;         // why something was not done
    std::function<void(const std::string&)> told;            // what people should know of what was done
    std::function<void(const interaction::Operation&)> ask;  // for what there is to be said
    std::function<void()> find;                              // one of all commands by its name
  };
  OperationActions(session::Session& session, Hooks hooks);
  OperationActions(const OperationActions&) = delete;
  OperationActions& operator=(const OperationActions&) = delete;

  /// `edit` is filled: it has "edit.delete", say, for the operation "delete".
  void fill(QMenu& menu, const QMenu& edit);

 private:
  void add(QMenu& group, const interaction::Operation& operation, QString& taken);
  void choose(const interaction::Operation& operation);

  session::Session& session_;
  Hooks hooks_;
};

}  // namespace icome::ui
