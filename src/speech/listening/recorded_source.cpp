#include <algorithm>
#include <chrono>
#include <filesystem>

#include "speech/hearing/recogniser.h"
#include "speech/hearing/recording.h"
#include "speech/listening/sound_source.h"

namespace icome::speech {
namespace {

class RecordedSource final : public SoundSource {
 public:
  explicit RecordedSource(std::vector<std::int16_t> samples) : samples_(std::move(samples)) {}

  base::Result<std::vector<std::int16_t>> read() override {
    const std::chrono::duration<double> passed = Clock::now() - begun_;
    const auto spoken = std::size_t(passed.count() * kSampleRate);
    std::vector<std::int16_t> came(spoken - read_, 0);
    if (read_ < samples_.size()) {
      const std::size_t count = std::min(came.size(), samples_.size() - read_);
      std::copy_n(samples_.begin() + std::ptrdiff_t(read_), count, came.begin());
    }
    read_ = spoken;
    return came;
  }

 private:
  using Clock = std::chrono::steady_clock;

  std::vector<std::int16_t> samples_;
  Clock::time_point begun_ = Clock::now();
  std::size_t read_ = 0;
};

}  // namespace

base::Result<std::unique_ptr<SoundSource>> open_recording(const std::string& file) {
  auto samples = read_recording(file);
  if (!samples) return tl::unexpected(samples.error());
  if (samples->empty()) return base::fail(file + ": has no sound");
  return std::unique_ptr<SoundSource>(std::make_unique<RecordedSource>(std::move(*samples)));
}

OpenSource source_of(const std::string& name) {
  std::error_code error;
  if (std::filesystem::is_regular_file(name, error)) return [name] { return open_recording(name); };
  return [name] { return open_microphone(name); };
}

}  // namespace icome::speech
