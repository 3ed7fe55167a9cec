#include "geometry/csg/csg_emptiness.h"

#include <deque>
#include <numeric>
#include <utility>
#include <vector>

#include "geometry/csg/csg_part.h"

namespace icome::geometry {
namespace {

constexpr std::size_t kMostLooks = 256;        // at places of the surfaces
constexpr std::size_t kMostTests = 4'000'000;  // tests of atoms, with what a trial of their sides costs
constexpr std::size_t kTrialWork = 64;         // of that, for a part

struct OpenPart {
  Bounds box;
  std::vector<std::uint32_t> atoms;  // whose surfaces may pass it
};

/// Do some places of the atoms' surfaces belong to the solid's? That soon shows that most solids are not
/// empty.
bool shows_surface(const CsgProgram& program) {
  base::Random random(1);
  const std::size_t count = program.atoms().size();
  for (std::size_t look = 0; look < kMostLooks; ++look) {
    const auto atom = std::uint32_t(look < count ? look : random.index(count));
    if (random_place(program, atom, random)) return true;
  }
  return false;
}

void halve(const OpenPart& part, std::deque<OpenPart>& into) {
  int axis = 0;
  part.box.sizes().maxCoeff(&axis);
  for (const bool upper : {false, true}) {
    OpenPart half = part;
    (upper ? half.box.min() : half.box.max())[axis] = part.box.center()[axis];
    into.push_back(std::move(half));
  }
}

}  // namespace

bool proved_empty(const CsgProgram& program) {
  const Bounds& box = program.bounds();
  if (box.isEmpty()) return true;
  if (!box.min().allFinite() || !box.max().allFinite() || shows_surface(program)) return false;
  const double length = largest_coordinate(program);
  std::vector<std::uint32_t> all(program.atoms().size());
  std::iota(all.begin(), all.end(), 0U);
  std::deque<OpenPart> parts{{box, std::move(all)}};
  std::size_t work = 0;
  for (; !parts.empty(); parts.pop_front()) {
    OpenPart& part = parts.front();
    work += part.atoms.size() + kTrialWork;
    if (work > kMostTests) return false;
    part.atoms = open_atoms(program, part.box, part.atoms);
    const PartContent found = content(program, part.box, part.atoms, length);
    if (found.solid && !found.free) return false;
    if (found.solid) halve(part, parts);
  }
  return true;
}

}  // namespace icome::geometry
