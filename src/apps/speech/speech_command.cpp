#include "apps/speech/speech_command.h"

#include "apps/speech/listen_command.h"
#include "apps/speech/say_command.h"
#include "apps/speech/voice_command.h"

namespace icome::apps {

int run_speech(const SpeechOptions& options) {
  if (options.task == "say") return run_say(options.say);
  return options.task == "voice" ? run_voice(options.voice) : run_listen(options.listen);
}

}  // namespace icome::apps
