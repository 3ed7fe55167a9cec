#include "study/run/trial_ear.h"

#include "speech/hearing/likely_meant.h"
#include "speech/words/spoken_words.h"

namespace icome::study {

TrialEar::TrialEar(speech::OpenSource source, speech::Ear::MakeRecogniser make)
    : ear_(std::move(source), std::move(make)) {}

base::Result<void> TrialEar::expect(const TrialGoal& goal) {
  auto choices = spoken_choices(goal);
  if (!choices) return tl::unexpected(choices.error());
  choices_ = std::move(*choices);
  expects_since_ = speech::clock_of_ears();
  ear_.expect(choices_->grammar, SpokenChoices::kSentence, SpokenChoices::kSentence);
  return {};
}

bool TrialEar::is_ready() const {
  using Doing = speech::EarState::Doing;
  const Doing doing = ear_.state().doing;
  return choices_ && (doing == Doing::Listening || doing == Doing::Hearing || doing == Doing::Understanding);
}

std::vector<SaidInTrial> TrialEar::take() {
  std::vector<SaidInTrial> all;
  for (const speech::HeardUtterance& utterance : ear_.take())
    if (!utterance.sentences.empty() && utterance.begin >= expects_since_)
      all.push_back(understood(utterance));
  return all;
}

SaidInTrial TrialEar::understood(const speech::HeardUtterance& utterance) const {
  const speech::HearingLimits limits;
  const speech::Heard& likeliest = utterance.sentences.front();
  SaidInTrial said{utterance.begin + likeliest.words.front().begin, utterance.end, likeliest.sentence(),
                   likeliest.score};
  if (likeliest.score < limits.least_score || likeliest.behind > limits.most_behind) return said;
  said.thing = choices_->chosen(speech::spoken_words(said.heard));
  return said;
}

}  // namespace icome::study
