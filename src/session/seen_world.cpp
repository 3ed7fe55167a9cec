#include "session/seen_world.h"

namespace icome::session {

void SeenWorld::open(const world::World& world, world::SceneId shown) {
  publisher_ = render::ScenePublisher(shown);
  publish(publisher_.publish(world));
}

void SeenWorld::show(const world::World& world, world::SceneId shown) {
  publish(publisher_.show_scene(world, shown));
}

void SeenWorld::follow(const world::World& world, const world::Changes& changes) {
  publish(publisher_.update(world, changes));
}

void SeenWorld::publish(const render::RenderScenePointer& scene) {
  display_.publish(scene);
  newest_.publish(scene);
}

}  // namespace icome::session
