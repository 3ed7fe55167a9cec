// The only source that knows PortAudio.
#include <dlfcn.h>
#include <fmt/format.h>
#include <portaudio.h>

#include <algorithm>
#include <chrono>
#include <mutex>
#include <utility>

#include "sound/sound_output.h"
#include "speech/hearing/recogniser.h"
#include "speech/listening/sound_source.h"

namespace icome::speech {
namespace {

using base::fail;
using base::Result;

/// Sound systems print to standard error what they look for and do not find, which says nothing to people.
void quieten_sound_systems() {
  sound::quieten_alsa();
  // JACK comes with PortAudio or does not.
  using Print = void (*)(const char*);
  for (const char* const name : {"jack_set_error_function", "jack_set_info_function"})
    if (void* const set = dlsym(RTLD_DEFAULT, name))
      reinterpret_cast<void (*)(Print)>(set)([](const char*) {});
}

/// PortAudio looks for devices when it begins; each user begins it anew, so that new devices are found.
class PortAudio {
 public:
  PortAudio() {
    quieten_sound_systems();
    error_ = Pa_Initialize();
  }
  ~PortAudio() {
    if (error_ == paNoError) Pa_Terminate();
  }
  PortAudio(const PortAudio&) = delete;
  PortAudio& operator=(const PortAudio&) = delete;

  bool works() const { return error_ == paNoError; }

 private:
  PaError error_ = paNotInitialized;
};

/// Devices that can be heard.
std::vector<std::pair<std::string, PaDeviceIndex>> inputs() {
  std::vector<std::pair<std::string, PaDeviceIndex>> found;
  for (PaDeviceIndex i = 0; i < Pa_GetDeviceCount(); ++i) {
    const PaDeviceInfo* const info = Pa_GetDeviceInfo(i);
    if (info != nullptr && info->maxInputChannels > 0) found.emplace_back(info->name, i);
  }
  return found;
}

class Microphone final : public SoundSource {
 public:
  ~Microphone() override {
    if (stream_ != nullptr) Pa_CloseStream(stream_);
  }

  Result<void> open(const std::string& name) {
    if (!audio_.works()) return fail("there is no sound system");
    const auto devices = inputs();
    PaDeviceIndex device = Pa_GetDefaultInputDevice();
    if (!name.empty()) {
      const auto found = std::ranges::find(devices, name, &std::pair<std::string, PaDeviceIndex>::first);
      if (found == devices.end()) return fail(no_such(name, devices));
      device = found->second;
    }
    if (device == paNoDevice) return fail("there is no microphone");
    const PaStreamParameters wanted{device, 1, paInt16, Pa_GetDeviceInfo(device)->defaultLowInputLatency,
                                    nullptr};
    constexpr unsigned long kTenMs = kSampleRate / 100;
    PaError error =
        Pa_OpenStream(&stream_, &wanted, nullptr, kSampleRate, kTenMs, paNoFlag, &Microphone::take, this);
    if (error == paNoError) error = Pa_StartStream(stream_);
    if (error == paNoError) return {};
    return fail(fmt::format("the microphone '{}' cannot be heard: {}", Pa_GetDeviceInfo(device)->name,
                            Pa_GetErrorText(error)));
  }

  Result<std::vector<std::int16_t>> read() override {
    std::vector<std::int16_t> samples;
    {
      const std::lock_guard lock(mutex_);
      samples.swap(came_);
    }
    if (samples.empty() && Pa_IsStreamActive(stream_) != 1) return fail("the microphone was lost");
    return samples;
  }

 private:
  static std::string no_such(const std::string& name,
                             const std::vector<std::pair<std::string, PaDeviceIndex>>& devices) {
    std::string names;
    for (const auto& [it, index] : devices) names += (names.empty() ? "" : ", ") + it;
    return fmt::format("there is no microphone '{}'{}", name,
                       names.empty() ? ", and no other" : "; there is " + names);
  }

  /// Called by the sound system, on a thread of its own.
  static int take(const void* input, void*, unsigned long count, const PaStreamCallbackTimeInfo*,
                  PaStreamCallbackFlags, void* self) {
    constexpr std::size_t kMost = 30 * std::size_t(kSampleRate);  // nobody reads: the rest is lost
    auto& microphone = *static_cast<Microphone*>(self);
    const auto* const samples = static_cast<const std::int16_t*>(input);
    const std::lock_guard lock(microphone.mutex_);
    if (samples != nullptr && microphone.came_.size() < kMost)
      microphone.came_.insert(microphone.came_.end(), samples, samples + count);
    return paContinue;
  }

  PortAudio audio_;
  PaStream* stream_ = nullptr;
  std::mutex mutex_;
  std::vector<std::int16_t> came_;
};

}  // namespace

Result<std::unique_ptr<SoundSource>> open_microphone(const std::string& name) {
  auto microphone = std::make_unique<Microphone>();
  if (const auto opened = microphone->open(name); !opened) return tl::unexpected(opened.error());
  return std::unique_ptr<SoundSource>(std::move(microphone));
}

std::vector<std::string> microphones() {
  const PortAudio audio;
  std::vector<std::string> names;
  if (audio.works())
    for (auto& [name, index] : inputs()) names.push_back(name);
  return names;
}

}  // namespace icome::speech
