#include <exception>
#include <new>

#include "apps/animate/animate_command.h"
#include "apps/command_line.h"
#include "apps/csg/csg_command.h"
#include "apps/design/convert_command.h"
#include "apps/design/edit_command.h"
#include "apps/design/info_command.h"
#include "apps/design/shot_command.h"
#include "apps/desktop/desktop_command.h"
#include "apps/devices/devices_command.h"
#include "apps/head/head_command.h"
#include "apps/menu/menu_command.h"
#include "apps/remote/keep_command.h"
#include "apps/serving/serving_command.h"
#include "apps/sketch/sketch_command.h"
#include "apps/speech/speech_command.h"
#include "apps/stats/stats_command.h"
#include "apps/study/study_command.h"
#include "apps/techniques/techniques_command.h"
#include "apps/terminal.h"
#include "apps/touch/touch_command.h"
#include "apps/track/track_command.h"

int main(int argc, char** argv) {
  try {
    const icome::apps::CommandLine command_line = icome::apps::parse_command_line(argc, argv);
    if (command_line.touch) return icome::apps::run_touch(*command_line.touch);
    if (command_line.csg) return icome::apps::run_csg(*command_line.csg);
    if (command_line.info) return icome::apps::run_info(*command_line.info);
    if (command_line.convert) return icome::apps::run_convert(*command_line.convert);
    if (command_line.edit) return icome::apps::run_edit(*command_line.edit);
    if (command_line.shot) return icome::apps::run_shot(*command_line.shot);
    if (command_line.stats) return icome::apps::run_stats(*command_line.stats);
    if (command_line.study) return icome::apps::run_study(argc, argv, *command_line.study);
    if (command_line.techniques) return icome::apps::run_techniques(*command_line.techniques);
    if (command_line.devices) return icome::apps::run_devices(*command_line.devices);
    if (command_line.serving) return icome::apps::run_serving(*command_line.serving);
    if (command_line.head) return icome::apps::run_head(*command_line.head);
    if (command_line.menu) return icome::apps::run_menu(*command_line.menu);
    if (command_line.speech) return icome::apps::run_speech(*command_line.speech);
    if (command_line.sketch) return icome::apps::run_sketch(*command_line.sketch);
    if (command_line.track) return icome::apps::run_track(*command_line.track);
    if (command_line.animate) return icome::apps::run_animate(*command_line.animate);
    if (command_line.keep) return icome::apps::run_keep(*command_line.keep);
    if (command_line.desktop) return icome::apps::run_desktop_window(argc, argv, *command_line.desktop);
    return command_line.exit_code;
  } catch (const std::bad_alloc&) {
    icome::apps::tell("there is not enough memory for this; close other programs or use a smaller model.");
  } catch (const std::exception& error) {
    icome::apps::tell(error.what());
  }
  return 1;
}
