#pragma once
#include "study/trial_scenes.h"

namespace icome::study {

/// The menu study with a menu that is made of things of the scene, a box for each colour, from which people
/// choose as from any things.
class BoxMenuFolder {
 public:
  BoxMenuFolder() {
    study.task->target = "item-{colour}";
    study.task->wrong = "item-*";
    study.task->near = 0.01;
    study.task->depth = 0.003;
    study.task->vicinity = 0.03;
    study.trials.scenes[0].element.reset();
    std::ofstream room(folder_.path() / "scenes/menu-room.wrl", std::ios::app);
    double height = 0.066;
    for (const char* const colour : {"red", "green", "blue", "yellow", "orange", "purple", "white"}) {
      room << "DEF item-" << colour << " Transform { translation 0.06 " << height
           << " -0.04 children Shape { geometry Box { size 0.09 0.019 0.006 } } }\n";
      height -= 0.021;
    }
  }

  const std::filesystem::path& path() const { return folder_.path(); }
  world::World scene() const { return folder_.scene("menu-room.wrl"); }

 private:
  TemplateFolder folder_{"menu"};

 public:
  Study study = folder_.study();
};

}  // namespace icome::study
