#pragma once
#include <QAction>
#include <QMenu>
#include <functional>
#include <string>

#include "interaction/operations/operation.h"
#include "session/session.h"

namespace icome::ui {

/// The model menu: every operation that is not in the edit menu, with a submenu for each group. Operations
/// that ask only for objects are performed at once on the selection. Session and window outlive it.
class OperationActions {
 public:
  struct Hooks {
    std::function<bool()> begin;                             // asked before an edit; false: do not edit
    std::function<void(const std::string&)> refused;         // tells why something was not done
    std::function<void(const std::string&)> told;            // tells a remark on what was done
    std::function<void(const interaction::Operation&)> ask;  // opens the form for the operation's arguments
    std::function<void()> find;                              // opens the search among all commands
  };
  OperationActions(session::Session& session, Hooks hooks);
  OperationActions(const OperationActions&) = delete;
  OperationActions& operator=(const OperationActions&) = delete;

  /// `edit` must be filled already: an operation such as "delete" is left out where it has "edit.delete".
  void fill(QMenu& menu, const QMenu& edit);

 private:
  void add(QMenu& group, const interaction::Operation& operation, QString& taken);
  void choose(const interaction::Operation& operation);

  session::Session& session_;
  Hooks hooks_;
};

}  // namespace icome::ui
