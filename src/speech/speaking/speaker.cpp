#include "speech/speaking/speaker.h"

#include <espeak-ng/speak_lib.h>

#include <chrono>
#include <utility>

#include "sound/sound_output.h"
#include "speech/speaking/espeak.h"

namespace icome::speech {
namespace {

using base::Result;

constexpr auto kLook = std::chrono::milliseconds(10);  // between two looks whether all was played

/// Called by espeak-ng with the samples as it makes them; `events` begin with what spoken_sentence() gave it.
int keep_samples(short* samples, int count, espeak_EVENT* events) {
  constexpr int kGoOn = 0;
  if (samples == nullptr || count <= 0) return kGoOn;
  auto& kept = *static_cast<std::vector<std::int16_t>*>(events->user_data);
  kept.insert(kept.end(), samples, samples + count);
  return kGoOn;
}

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

class SystemLoudspeaker final : public Loudspeaker {
 public:
  explicit SystemLoudspeaker(std::unique_ptr<sound::SoundOutput> output) : output_(std::move(output)) {}

  void play(SpokenSentence sentence) override { output_->play(std::move(sentence.samples)); }
  void stop() override { output_->stop(); }
  bool is_playing() const override { return output_->is_playing(); }
  bool is_lost() const override { return output_->is_lost(); }

 private:
  std::unique_ptr<sound::SoundOutput> output_;
};

}  // namespace

Result<SpokenSentence> spoken_sentence(const std::string& sentence) {
  const Espeak library;
  if (!library.is_there()) return base::fail("espeak-ng has no voice: install the package espeak-ng-data");
  SpokenSentence spoken{library.rate()};
  espeak_SetSynthCallback(&keep_samples);
  const auto made = espeak_Synth(sentence.c_str(), sentence.size() + 1, 0, POS_CHARACTER, 0, espeakCHARS_UTF8,
                                 nullptr, &spoken.samples);
  if (made != EE_OK) return base::fail("espeak-ng cannot say this");
  return spoken;
}

Result<std::unique_ptr<Loudspeaker>> open_loudspeaker(int rate) {
  auto output = sound::SoundOutput::open(rate);
  if (!output) return tl::unexpected(output.error());
  return std::unique_ptr<Loudspeaker>(std::make_unique<SystemLoudspeaker>(std::move(*output)));
}

Speaker::Speaker(OpenLoudspeaker open)
    : open_(std::move(open)), thread_([this](const std::stop_token& stop) { run(stop); }) {}

Speaker::~Speaker() {
  thread_.request_stop();
  waits_.notify_all();
}

void Speaker::say(std::string sentence) {
  {
    const std::lock_guard lock(mutex_);
    if (sentence.empty() && !speaks_ && !told_) return;
    told_ = std::move(sentence);
  }
  waits_.notify_all();
}

bool Speaker::is_about() const {
  const std::lock_guard lock(mutex_);
  return speaks_ || told_ || now() < spoken_at_ + kEcho;
}

bool Speaker::is_speaking() const {
  const std::lock_guard lock(mutex_);
  return speaks_ || told_.has_value();
}

std::string Speaker::problem() const {
  const std::lock_guard lock(mutex_);
  return problem_;
}

void Speaker::run(const std::stop_token& stop) {
  while (true) {
    std::string sentence;
    {
      std::unique_lock lock(mutex_);
      speaks_ = told_.has_value();
      if (!waits_.wait(lock, stop, [this] { return told_.has_value(); })) return;
      sentence = std::exchange(told_, std::nullopt).value();
      speaks_ = true;
    }
    if (!sentence.empty()) speak(sentence, stop);
  }
}

void Speaker::speak(const std::string& sentence, const std::stop_token& stop) {
  auto spoken = spoken_sentence(sentence);
  Result<std::unique_ptr<Loudspeaker>> opened = nullptr;
  if (spoken && loudspeaker_ == nullptr) opened = open_(spoken->rate);
  {
    const std::lock_guard lock(mutex_);
    problem_ = !spoken ? spoken.error().message : !opened ? opened.error().message : "";
    if (!problem_.empty()) return;
  }
  if (*opened != nullptr) loudspeaker_ = std::move(*opened);
  loudspeaker_->play(std::move(*spoken));
  std::unique_lock lock(mutex_);
  while (loudspeaker_->is_playing() && !told_ && !stop.stop_requested())
    waits_.wait_for(lock, stop, kLook, [this] { return told_.has_value(); });
  loudspeaker_->stop();
  spoken_at_ = now();
  if (!loudspeaker_->is_lost()) return;
  problem_ = "The sound output was lost; the next reply looks for it again.";
  loudspeaker_.reset();
}

}  // namespace icome::speech
