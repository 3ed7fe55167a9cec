#pragma once
#include <QDialog>

namespace icome::ui {

/// What the program is, its version and licence, and what it runs on. `renderer` is what OpenGL calls itself
/// on this machine; empty: not known.
class AboutBox final : public QDialog {
 public:
  AboutBox(const QString& renderer, QWidget* parent);
};

}  // namespace icome::ui
