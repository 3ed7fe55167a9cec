// The process that parses VRML for a reader of designs; see files/vrml/read/vrml_process.h. Its rights are
// limited by confine(), its answer is defined by vrml_answer.fbs.
#include <unistd.h>

#include <cstring>

#include "files/vrml/read/vrml_confinement.h"
#include "files/vrml/worker/answer.h"
#include "files/vrml/worker/channel.h"
#include "files/vrml/worker/scene_files.h"
#include "files/vrml/worker/scene_walk.h"

namespace icome::files {
namespace {

void answer_with(Channel& channel, Answer& answer, const std::string& error) {
  channel.send(VrmlFrame::Answer, 0, answer.finish(error));
}

void parse(Channel& channel) {
  const std::string path = channel.receive(VrmlFrame::Name);
  const std::string bytes = channel.receive(VrmlFrame::File);
  try {
    Answer answer(bytes.size());
    SceneFiles files(channel, answer);
    SceneFile& design = files.read_design(path, bytes);
    SceneWalk(files, answer).walk(design);
    answer_with(channel, answer, {});
  } catch (const Refusal& refusal) {
    Answer answer(0);
    answer_with(channel, answer, refusal.why);
  }
}

}  // namespace
}  // namespace icome::files

int main() {
  using namespace icome::files;
  Channel channel;
  const std::string bytes = channel.receive(VrmlFrame::Limits);
  VrmlLimits limits;
  if (bytes.size() != sizeof limits) return kVrmlBadFrame;
  std::memcpy(&limits, bytes.data(), sizeof limits);
  SceneFiles::prepare_coin();
  confine(limits);
  parse(channel);
  // Coin's nodes need not be freed one by one.
  ::_exit(0);
}
