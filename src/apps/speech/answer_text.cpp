#include "apps/speech/answer_text.h"

#include <fmt/format.h>

namespace icome::apps {
namespace {

using interaction::Value;

const char* word_of(speech::Answer::State state) {
  switch (state) {
    case speech::Answer::State::Done:
      return "done";
    case speech::Answer::State::Asked:
      return "asked";
    case speech::Answer::State::Refused:
      break;
  }
  return "refused";
}

}  // namespace

Value::Fields answer_value(const speech::Answer& answer, const world::World& world) {
  return {{"heard", answer.heard},
          {"accepted", answer.accepted()},
          {"state", word_of(answer.state)},
          {"intent", answer.intent.empty() ? Value() : Value(answer.intent)},
          {"reply", answer.reply},
          {"objects", speech::names_value(world, answer.objects)},
          {"candidates", speech::names_value(world, answer.candidates)},
          {"operations", answer.operations}};
}

std::string answer_text(const speech::Answer& answer, const world::World& world) {
  std::string text = fmt::format("\"{}\"\n  {}\n", answer.heard, answer.reply);
  if (!answer.candidates.empty())
    text += fmt::format("  ({}, from left to right)\n", speech::called_all(world, answer.candidates));
  return text;
}

}  // namespace icome::apps
