#include "ui/status_strip.h"

namespace icome::ui {

struct StatusStrip::Parts {
  session::Session& session;
};

StatusStrip::StatusStrip(session::Session& session, QWidget* parent)
    : QWidget(parent), parts_(std::make_unique<Parts>(Parts{session})) {}

StatusStrip::~StatusStrip() = default;

}  // namespace icome::ui
