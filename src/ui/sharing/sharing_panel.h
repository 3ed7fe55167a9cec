#pragma once
#include <QWidget>
#include <functional>
#include <memory>

#include "session/session.h"

namespace icome::ui {

/// Who works on the open design together with the person: their colours, what each holds, their words, and a
/// line to say something. Enter or a double click on a person looks through that one's eyes. Empty where the
/// design is on no server, with a button to open one that is. The session outlives it.
class SharingPanel final : public QWidget {
 public:
  struct Hooks {
    std::function<void()> open = {};  // asks for the address of a design
  };
  SharingPanel(session::Session& session, Hooks hooks, QWidget* parent);
  ~SharingPanel() override;

 protected:
  void showEvent(QShowEvent* event) override;
  void hideEvent(QHideEvent* event) override;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// A dot in a person's colour, 0xRRGGBB.
QIcon dot_of(std::uint32_t colour);
/// The state of the connection in a few words, for the status bar: "table: 2 people, 3 ms"; empty where the
/// design is on no server.
QString sharing_words(const session::Session& session);
/// The state of the connection in sentences.
QString sharing_tip(const session::Session& session);

}  // namespace icome::ui
