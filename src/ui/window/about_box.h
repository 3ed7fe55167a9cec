#pragma once
#include <QDialog>

namespace icome::ui {

/// The about box: the program with its version and licence, and the system that it runs on. `renderer` is the
/// name that OpenGL gives itself on this machine; empty: not known.
class AboutBox final : public QDialog {
 public:
  AboutBox(const QString& renderer, QWidget* parent);
};

}  // namespace icome::ui
