#include "apps/effect_options.h"

#include <fmt/format.h>

#include <string_view>

#include "haptics/effects/effect_text.h"
#include "haptics/texture_text.h"

namespace icome::apps {
namespace {

std::string help_entry(std::string_view name, const std::string& usage, std::string_view summary,
                       const std::string& ranges) {
  return fmt::format("  {}{}\n      {}\n      {}\n", name, usage, summary, ranges);
}

}  // namespace

base::Result<void> check_effects(const TouchOptions& options) {
  if (options.texture) {
    if (const auto made = haptics::make_texture(*options.texture); !made)
      return base::fail(fmt::format("--texture \"{}\": {}", *options.texture, made.error().message));
  }
  for (const std::string& text : options.effects) {
    if (const auto made = haptics::make_effect(text); !made)
      return base::fail(fmt::format("--effect \"{}\": {}", text, made.error().message));
  }
  return {};
}

haptics::EffectSet effects_of(const TouchOptions& options) {
  haptics::EffectSet effects;
  for (const std::string& text : options.effects) effects.add(haptics::make_effect(text).value());
  return effects;
}

std::shared_ptr<const haptics::HapticTexture> texture_of(const TouchOptions& options) {
  return options.texture ? haptics::make_texture(*options.texture).value() : nullptr;
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
