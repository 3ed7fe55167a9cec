#include "ui/world_tree.h"

namespace icome::ui {

struct WorldTree::Parts {
  session::Session& session;
  std::function<void()> zoom = {};
};

WorldTree::WorldTree(session::Session& session, QWidget* parent)
    : QWidget(parent), parts_(std::make_unique<Parts>(Parts{session, {}})) {}

WorldTree::~WorldTree() = default;

void WorldTree::on_zoom_to(std::function<void()> zoom) { parts_->zoom = std::move(zoom); }
void WorldTree::rename() {}
void WorldTree::search() {}

}  // namespace icome::ui
