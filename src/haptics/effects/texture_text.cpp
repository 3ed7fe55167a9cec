#include "haptics/effects/texture_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "haptics/effects/parameter_text.h"

namespace icome::haptics {
namespace {

using TexturePointer = std::shared_ptr<const HapticTexture>;
using Numbers = std::vector<double>;

constexpr std::uint64_t kGrainSeed = 1;

// Slopes grow with depth over spacing; steeper ones than these are edges, which belong in the geometry.
constexpr double kMostDepthOfSpacing = 0.5;

constexpr Parameter depth_of_texture(double usual) { return {"DEPTH", "m", 0.0, 0.01, usual}; }
constexpr Parameter spacing_of_texture(double usual) { return {"SPACING", "m", 1e-5, 1.0, usual}; }

constexpr std::array<Parameter, 5> kRidges = {
    depth_of_texture(0.2e-3), spacing_of_texture(2e-3), Parameter{.name = "DX", .usual = 1},
    Parameter{.name = "DY", .usual = 0}, Parameter{.name = "DZ", .usual = 0}};
constexpr std::array<Parameter, 2> kBumps = {depth_of_texture(0.3e-3), spacing_of_texture(3e-3)};
constexpr std::array<Parameter, 2> kGrain = {depth_of_texture(0.1e-3), spacing_of_texture(1e-3)};

base::Result<TexturePointer> ridges_of(const Numbers& n) {
  const Vector3 across(n[2], n[3], n[4]);
  if (across.squaredNorm() == 0.0) return base::fail("the direction 0,0,0 has no length.");
  return std::make_shared<GrooveTexture>(across, n[1], n[0]);
}

base::Result<TexturePointer> bumps_of(const Numbers& n) { return std::make_shared<BumpTexture>(n[1], n[0]); }

base::Result<TexturePointer> grain_of(const Numbers& n) {
  return std::make_shared<GrainTexture>(n[1], n[0], kGrainSeed);
}

struct TextureMaker {
  std::string_view name;
  std::span<const Parameter> parameters;
  base::Result<TexturePointer> (*make)(const Numbers&);
  std::string_view summary;
};

constexpr std::array<TextureMaker, 4> kTextures = {
    TextureMaker{"ridges", kRidges, ridges_of, "parallel waves across the direction DX,DY,DZ"},
    TextureMaker{"grooves", kRidges, ridges_of, "the same as ridges"},
    TextureMaker{"bumps", kBumps, bumps_of, "a lattice of bumps, the same along x, y and z"},
    TextureMaker{"grain", kGrain, grain_of, "irregular, as of cast metal or stone"}};

std::vector<std::string> names_of_textures() {
  std::vector<std::string> names;
  for (const TextureMaker& texture : kTextures) names.emplace_back(texture.name);
  return names;
}

struct ReadTexture {
  const TextureMaker& maker;
  Numbers numbers;  // depth and spacing first
};

base::Result<ReadTexture> read_texture(std::string_view text) {
  const std::size_t colon = text.find(':');
  const std::string_view name = text.substr(0, colon);
  const auto* const maker = std::ranges::find(kTextures, name, &TextureMaker::name);
  if (maker == kTextures.end()) return base::fail(unknown_name("texture", name, names_of_textures()));
  auto numbers =
      read_parameters(colon == std::string_view::npos ? "" : text.substr(colon + 1), maker->parameters);
  if (!numbers) return tl::unexpected(numbers.error());
  const double deep = (*numbers)[0], apart = (*numbers)[1];
  if (deep > kMostDepthOfSpacing * apart) {
    return base::fail(
        fmt::format("DEPTH {:g} m is more than half of SPACING {:g} m: too steep to be felt.", deep, apart));
  }
  return ReadTexture{*maker, std::move(*numbers)};
}

}  // namespace

const std::vector<TextureKind>& texture_kinds() {
  static const std::vector<TextureKind> kKinds = [] {
    std::vector<TextureKind> kinds;
    for (const TextureMaker& it : kTextures)
      kinds.push_back({it.name, usage_of(it.parameters), ranges_of(it.parameters), it.summary});
    return kinds;
  }();
  return kKinds;
}

base::Result<TextureSize> texture_size(std::string_view text) {
  const auto read = read_texture(text);
  if (!read) return tl::unexpected(read.error());
  return TextureSize{read->numbers[0], read->numbers[1]};
}

base::Result<TexturePointer> make_texture(std::string_view text) {
  const auto read = read_texture(text);
  if (!read) return tl::unexpected(read.error());
  return read->maker.make(read->numbers);
}

}  // namespace icome::haptics
