#include "apps/touch/effect_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "base/shown_text.h"
#include "haptics/effects/effect_text.h"
#include "haptics/effects/texture_text.h"

namespace icome::apps {
namespace {

std::string help_entry(std::string_view name, const std::string& usage, std::string_view summary,
                       const std::string& ranges) {
  return fmt::format("  {}{}\n      {}\n      {}\n", name, usage, summary, ranges);
}

/// Collects sentences about what is felt softer, each once.
class CappedFeel {
 public:
  explicit CappedFeel(double rate_hz) : rate_hz_(rate_hz) {}

  void add(const std::string& who, const std::string& what) {
    if (what.empty()) return;
    std::string sentence =
        fmt::format("{}: {}, the most that is stable on this device at {:g} Hz.", who, what, rate_hz_);
    if (std::ranges::find(sentences_, sentence) == sentences_.end())
      sentences_.push_back(std::move(sentence));
  }
  std::vector<std::string> sentences() && { return std::move(sentences_); }

 private:
  double rate_hz_;
  std::vector<std::string> sentences_;
};

}  // namespace

base::Result<void> check_effects(const TouchOptions& options) {
  if (options.texture) {
    if (const auto made = haptics::make_texture(*options.texture); !made)
      return base::fail(
          fmt::format("--texture \"{}\": {}", base::shown_text(*options.texture), made.error().message));
  }
  for (const std::string& text : options.effects) {
    if (const auto made = haptics::make_effect(text); !made)
      return base::fail(fmt::format("--effect \"{}\": {}", base::shown_text(text), made.error().message));
  }
  return {};
}

std::vector<haptics::PlacedEffect> effects_of(const std::vector<TouchModel>& models,
                                              const TouchOptions& options) {
  std::vector<haptics::PlacedEffect> effects;
  for (const std::string& text : options.effects) effects.push_back({.text = text});
  for (const TouchModel& model : models)
    effects.insert(effects.end(), model.effects.begin(), model.effects.end());
  for (std::size_t i = 0; i < effects.size(); ++i) effects[i].id = i + 1;  // two designs may share ids
  return effects;
}

std::shared_ptr<const haptics::HapticTexture> texture_of(const TouchOptions& options) {
  return options.texture ? haptics::make_texture(*options.texture).value() : nullptr;
}

std::vector<std::string> capped_feel(const std::vector<TouchModel>& models, const TouchOptions& options,
                                     const haptics::Servo& servo) {
  CappedFeel capped(options.rate_hz);
  for (const TouchModel& model : models)
    for (const TouchBody& body : model.bodies)
      capped.add(model.name, servo.capped_surface(surface_of(body, options)));
  for (const haptics::CappedEffect& effect : servo.capped_effects())
    capped.add("effect " + base::shown_text(effect.text), effect.what);
  return std::move(capped).sentences();
}

std::string effects_help() {
  std::string help =
      "\nEffects (--effect), world frame; in brackets what may be left out, in parentheses what it is "
      "then:\n";
  for (const haptics::EffectKind& kind : haptics::effect_kinds()) {
    help += help_entry(kind.name, ":" + kind.usage, kind.summary, kind.ranges);
    help += fmt::format("      such as {}\n", kind.example);
  }
  help += "\nTextures (--texture), in the frame of each object:\n";
  for (const haptics::TextureKind& kind : haptics::texture_kinds())
    help += help_entry(kind.name, kind.usage.empty() ? "" : "[:" + kind.usage.substr(1), kind.summary,
                       kind.ranges);
  return help;
}

}  // namespace icome::apps
