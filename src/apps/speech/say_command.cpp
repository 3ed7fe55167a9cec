#include "apps/speech/say_command.h"

#include <fmt/format.h>

#include <filesystem>
#include <iostream>

#include "apps/design/design_work.h"
#include "apps/interrupt.h"
#include "apps/speech/answer_text.h"
#include "apps/speech/talk.h"
#include "files/design_files.h"

namespace icome::apps {
namespace {

/// Hears one sentence; each is a second after the one before. False: standard output is closed.
bool hear_sentence(Talk& talk, const std::string& sentence, std::size_t number, bool json) {
  const speech::Answer answer = talk.dialogue().hear(sentence, {.now = double(number)});
  const std::string text = json ? interaction::json_from_value(answer_value(answer, talk.world())) + "\n"
                                : answer_text(answer, talk.world());
  return print_answer(text) == 0;
}

base::Result<void> hear_all(Talk& talk, const SayOptions& options) {
  std::size_t number = 0;
  const auto hear = [&](const std::string& sentence) -> base::Result<void> {
    if (interrupted()) return base::fail("interrupted");
    if (!hear_sentence(talk, sentence, number++, options.talk.json))
      return base::fail("the answers cannot be written");
    return {};
  };
  for (const std::string& sentence : options.sentences)
    if (const auto heard = hear(sentence); !heard) return heard;
  std::string line;
  while (options.sentences.empty() && std::getline(std::cin, line)) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    if (const auto heard = hear(line); !heard) return heard;
  }
  return {};
}

base::Result<void> say(const SayOptions& options, StatusLine& status) {
  std::error_code error;
  if (options.out.has_parent_path() && !std::filesystem::is_directory(options.out.parent_path(), error))
    return base::fail(fmt::format("{}: there is no such folder", options.out.parent_path().string()));
  if (!options.out.empty())
    if (const auto able = files::check_can_write(options.out); !able) return able;
  base::Result<HandPath> hand = HandPath{};
  if (!options.pointer.empty()) hand = hand_from_text(options.pointer);
  if (!hand) return tl::unexpected(hand.error());
  auto talk = Talk::open(options.talk, status);
  if (!talk) return tl::unexpected(talk.error());
  (*talk)->stage().hand = *hand;
  const auto save = [&] { return (*talk)->save(options.out, options.force); };
  if (!options.out.empty()) (*talk)->stage().saving = save;
  if (const auto heard = hear_all(**talk, options); !heard) return heard;
  return options.out.empty() ? base::Result<void>() : save();
}

}  // namespace

int run_say(const SayOptions& options) {
  if (!options.sentences.empty()) catch_interrupts();  // else Ctrl-C must end a wait for standard input
  StatusLine status;
  const auto said = say(options, status);
  return said ? 0 : end_without_result(said.error(), status);
}

}  // namespace icome::apps
