#include "world/metal.h"

#include <algorithm>
#include <cmath>

#include "base/srgb.h"

namespace icome::world {

std::array<double, 3> metal_specular(const std::array<double, 3>& base, double metallic) {
  constexpr double kDielectric = 0.04;
  const double metal = std::clamp(metallic, 0.0, 1.0);
  std::array<double, 3> specular{};
  for (std::size_t i = 0; i < 3; ++i) specular[i] = kDielectric + (base[i] - kDielectric) * metal;
  return specular;
}

float metal_of(const Material& material) {
  if (!material.metallic) return 0.0F;
  std::array<double, 3> own{};
  for (std::size_t i = 0; i < 3; ++i) own[i] = base::linear_from_srgb(double(material.diffuse[i]));
  const Colour specular = base::srgb_from_linear(metal_specular(own, double(*material.metallic)));
  constexpr float kNearlyTheSame = 1e-4F;
  for (std::size_t i = 0; i < 3; ++i) {
    if (std::abs(specular[i] - material.specular[i]) > kNearlyTheSame) return 0.0F;
  }
  return std::clamp(*material.metallic, 0.0F, 1.0F);
}

}  // namespace icome::world
