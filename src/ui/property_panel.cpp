#include "ui/property_panel.h"

namespace icome::ui {

struct PropertyPanel::Parts {
  session::Session& session;
};

PropertyPanel::PropertyPanel(session::Session& session, QWidget* parent)
    : QWidget(parent), parts_(std::make_unique<Parts>(Parts{session})) {}

PropertyPanel::~PropertyPanel() = default;

}  // namespace icome::ui
