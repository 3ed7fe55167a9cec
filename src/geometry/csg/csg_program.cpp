#include "geometry/csg/csg_program.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "geometry/tree/hilbert.h"

namespace icome::geometry {
namespace {

using Kind = CsgAtom::Kind;

constexpr double kBoxMargin = 1e-9;    // boxes are this much larger than what they hold, relatively
constexpr double kAlong = 1e-5;        // rad, between faces that count as flush
constexpr std::size_t kGroup = 4;      // operands of a union below one box
constexpr unsigned kMaxBranches = 64;  // places that may count as either

/// The distance of the point from a mesh and the normal there, in the tree's frame; nothing beyond `reach`.
std::optional<AtomHeight> mesh_height(const CsgAtom& atom, const Vector3& in_atom, double reach) {
  const auto hit = atom.mesh->tree.nearest(in_atom, reach * atom.most_stretch);
  if (!hit) return std::nullopt;
  const TriangleMesh& mesh = atom.mesh->mesh;
  const Vector3& corner = mesh.corner(hit->triangle, 0);
  const Vector3 normal =
      (mesh.corner(hit->triangle, 1) - corner).cross(mesh.corner(hit->triangle, 2) - corner);
  return AtomHeight{(atom.tree_from_atom.linear() * (in_atom - hit->point)).norm(),
                    tree_normal(atom, normal)};
}

}  // namespace

bool behind(const CsgAtom& atom, const Vector3& point) {
  const Vector3 in_atom = atom.atom_from_tree * point;
  if (atom.kind == Kind::Mesh)
    return atom.mesh->tree.bounds().contains(in_atom) && atom.mesh->tree.encloses(in_atom);
  if (atom.kind == Kind::Custom) return atom.custom->inside(in_atom);
  return signed_distance(atom, in_atom) <= 0.0;
}

/// One view of on_surface(): the place, and the side of the atom from which it is looked at.
struct CsgProgram::SidesView {
  std::uint32_t atom;  // the atom that is looked at
  bool from_behind;    // which of its sides is assumed
  const Vector3& place;
  const Vector3& normal;
  double slack;
};

/// Compiles the tree to code. Works on parts: leaves, and operations with any number of operands.
class CsgProgram::Compiler {
 public:
  Compiler(CsgProgram& program, const CsgTree& tree) : program_(program), tree_(tree) {
    if (tree.empty()) return;
    make_parts();
    group_unions();
    mark_relevant();
    emit();
    program_.bounds_ = parts_[root_].box;
  }

 private:
  struct Part {
    bool is_leaf = false;
    CsgOperator op = CsgOperator::Union;           // a difference takes all other operands from the first
    std::vector<std::uint32_t> operands;           // parts
    std::uint32_t first_atom = 0, atom_count = 0;  // of a leaf
    Bounds box;
  };

  static bool is_empty(const Bounds& box) { return box.isEmpty(); }

  Bounds inflated(Bounds box) const {
    if (box.isEmpty() || !box.min().allFinite() || !box.max().allFinite()) return box;
    const double size = std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
    const Vector3 margin = Vector3::Constant(kBoxMargin * size);
    return {box.min() - margin, box.max() + margin};
  }

  // Nodes come children first, so one pass makes all parts; chains of one operation become one part.
  void make_parts() {
    const std::vector<Affine3> tree_from_node = tree_.tree_from_node();
    const std::vector<bool> used = below_root();
    std::vector<std::uint32_t> part_of(tree_.size());
    for (CsgTree::Index i = 0; i < tree_.size(); ++i) {
      if (!used[i]) continue;
      const CsgTree::Node& node = tree_.node(i);
      part_of[i] = node.is_leaf ? leaf_part(CsgLeaf(*node.shape, tree_from_node[i]))
                                : operation_part(node.op, part_of[node.left], part_of[node.right]);
    }
    root_ = part_of[tree_.root()];
  }

  std::vector<bool> below_root() const {
    std::vector<bool> used(tree_.size(), false);
    used[tree_.root()] = true;
    for (CsgTree::Index i = tree_.root() + 1; i-- > 0;) {
      if (!used[i] || tree_.node(i).is_leaf) continue;
      used[tree_.node(i).left] = used[tree_.node(i).right] = true;
    }
    return used;
  }

  std::uint32_t leaf_part(const CsgLeaf& leaf) {
    Part part;
    part.is_leaf = true;
    part.first_atom = std::uint32_t(program_.atoms_.size());
    for (CsgAtom& atom : geometry::atoms(leaf)) {
      program_.extents_.push_back(shape_bounds(leaf.shape(), atom.atom_from_tree * leaf.tree_from_shape()));
      program_.atoms_.push_back(std::move(atom));
    }
    part.atom_count = std::uint32_t(program_.atoms_.size()) - part.first_atom;
    part.box = inflated(leaf.bounds());
    return add(std::move(part));
  }

  std::uint32_t operation_part(CsgOperator op, std::uint32_t left, std::uint32_t right) {
    if (op == CsgOperator::Union && is_empty(parts_[left].box)) return right;
    if (is_empty(parts_[left].box)) return left;
    if (is_empty(parts_[right].box)) return op == CsgOperator::Intersection ? right : left;
    const Bounds shared = parts_[left].box.intersection(parts_[right].box);
    if (op == CsgOperator::Difference && is_empty(shared)) return left;
    // A left operand of the same operation takes the right one in; a union also takes in the right one's.
    std::uint32_t whole = left;
    if (parts_[left].is_leaf || parts_[left].op != op) {
      Part part;
      part.op = op;
      part.operands = {left};
      part.box = parts_[left].box;
      whole = add(std::move(part));
    }
    if (op == CsgOperator::Union && !parts_[right].is_leaf && parts_[right].op == op) {
      // The smaller list goes into the larger: chains in either direction stay linear.
      if (parts_[right].operands.size() > parts_[whole].operands.size()) {
        std::swap(parts_[right].operands, parts_[whole].operands);
      }
      for (const std::uint32_t operand : parts_[right].operands) parts_[whole].operands.push_back(operand);
    } else {
      parts_[whole].operands.push_back(right);
    }
    if (op == CsgOperator::Union) parts_[whole].box.extend(parts_[right].box);
    if (op == CsgOperator::Intersection) parts_[whole].box = shared;
    return whole;
  }

  std::uint32_t add(Part part) {
    parts_.push_back(std::move(part));
    return std::uint32_t(parts_.size() - 1);
  }

  /// Unions of many get a hierarchy of boxes; the subtracted operands of a difference are a union, too.
  void group_unions() {
    const auto count = parts_.size();
    for (std::uint32_t i = 0; i < count; ++i) {
      if (parts_[i].is_leaf) continue;
      if (parts_[i].op == CsgOperator::Union) {
        parts_[i].operands = grouped(std::move(parts_[i].operands));
      } else if (parts_[i].op == CsgOperator::Difference && parts_[i].operands.size() > kGroup + 1) {
        std::vector<std::uint32_t> taken(parts_[i].operands.begin() + 1, parts_[i].operands.end());
        taken = grouped(std::move(taken));
        parts_[i].operands.resize(1);
        parts_[i].operands.insert(parts_[i].operands.end(), taken.begin(), taken.end());
      }
    }
  }

  std::vector<std::uint32_t> grouped(std::vector<std::uint32_t> operands) {
    if (operands.size() <= kGroup) return operands;
    std::vector<Eigen::Vector3f> centres;
    for (const std::uint32_t operand : operands) {
      const Vector3 centre = parts_[operand].box.center();
      centres.emplace_back(centre.allFinite() ? Eigen::Vector3f(centre.cast<float>())
                                              : Eigen::Vector3f::Zero());
    }
    std::vector<std::uint32_t> sorted;
    for (const std::uint32_t place : hilbert_order(centres)) sorted.push_back(operands[place]);
    while (sorted.size() > kGroup) {
      std::vector<std::uint32_t> groups;
      for (std::size_t first = 0; first < sorted.size(); first += kGroup) {
        Part part;
        const std::size_t end = std::min(first + kGroup, sorted.size());
        part.operands.assign(sorted.begin() + std::ptrdiff_t(first), sorted.begin() + std::ptrdiff_t(end));
        for (const std::uint32_t operand : part.operands) part.box.extend(parts_[operand].box);
        groups.push_back(add(std::move(part)));
      }
      sorted = std::move(groups);
    }
    return sorted;
  }

  /// Hands the boxes down: an operand's surface matters only where the operation can. Operands of a
  /// difference after the first are touched from within.
  void mark_relevant() {
    struct Visit {
      std::uint32_t part;
      Bounds box;
      bool subtracted;
    };
    program_.relevant_.resize(program_.atoms_.size());
    std::vector<Visit> open{{root_, parts_[root_].box, false}};
    while (!open.empty()) {
      const Visit visit = open.back();
      open.pop_back();
      const Part& part = parts_[visit.part];
      const Bounds box = visit.box.intersection(part.box);
      if (part.is_leaf) {
        for (std::uint32_t i = 0; i < part.atom_count; ++i) {
          program_.relevant_[part.first_atom + i] = box;
          program_.atoms_[part.first_atom + i].subtracted = visit.subtracted;
        }
        continue;
      }
      const bool difference = part.op == CsgOperator::Difference;
      for (std::size_t i = 0; i < part.operands.size(); ++i)
        open.push_back({part.operands[i], box, visit.subtracted != (difference && i > 0)});
    }
  }

  /// Emits the code from its end, so that the targets of forward jumps are known.
  void emit() {
    struct Frame {
      std::uint32_t part;
      std::uint32_t on_true, on_false;
      std::size_t left;     // operands to do
      std::uint32_t start;  // of the code emitted so far
    };
    const auto frame = [&](std::uint32_t part, std::uint32_t on_true, std::uint32_t on_false) {
      const bool any = parts_[part].is_leaf || parts_[part].op == CsgOperator::Union;
      return Frame{part, on_true, on_false, parts_[part].operands.size(), any ? on_false : on_true};
    };
    std::vector<Frame> open{frame(root_, kTrue, kFalse)};
    std::uint32_t result = kFalse;
    while (!open.empty()) {
      Frame& top = open.back();
      const Part& part = parts_[top.part];
      if (part.is_leaf || top.left == 0) {
        result = part.is_leaf ? emit_leaf(part, top.on_true, top.on_false)
                              : emit_box(part, top.start, top.on_false);
        open.pop_back();
        if (!open.empty()) open.back().start = result;
        continue;
      }
      const std::size_t operand = --top.left;
      const std::uint32_t child = part.operands[operand];
      const bool taken = part.op == CsgOperator::Difference && operand > 0;
      // `start` is the beginning of the rest of the operands.
      if (part.op == CsgOperator::Union) {
        open.push_back(frame(child, top.on_true, top.start));
      } else if (taken) {
        open.push_back(frame(child, top.on_false, top.start));
      } else {
        open.push_back(frame(child, top.start, top.on_false));
      }
    }
    program_.start_ = result;
  }

  std::uint32_t emit_leaf(const Part& leaf, std::uint32_t on_true, std::uint32_t on_false) {
    std::uint32_t start = on_true;
    for (std::uint32_t i = leaf.atom_count; i-- > 0;) start = emit({leaf.first_atom + i, start, on_false});
    return emit_box(leaf, start, on_false);
  }

  std::uint32_t emit_box(const Part& part, std::uint32_t on_true, std::uint32_t on_false) {
    if (!part.box.min().allFinite() || !part.box.max().allFinite()) return on_true;
    program_.boxes_.push_back(part.box);
    return emit({std::uint32_t(program_.boxes_.size() - 1) | kBox, on_true, on_false});
  }

  std::uint32_t emit(const Instruction& instruction) {
    program_.code_.push_back(instruction);
    return std::uint32_t(program_.code_.size() - 1);
  }

  CsgProgram& program_;
  const CsgTree& tree_;
  std::vector<Part> parts_;
  std::uint32_t root_ = 0;
};

CsgProgram::CsgProgram(const CsgTree& tree) { Compiler(*this, tree); }

bool CsgProgram::inside(const Vector3& point) const {
  std::uint32_t at = start_;
  while (at < kFalse) {
    const Instruction& test = code_[at];
    const bool yes = (test.test & kBox) != 0 ? boxes_[test.test & ~kBox].contains(point)
                                             : behind(atoms_[test.test], point);
    at = yes ? test.on_true : test.on_false;
  }
  return at == kTrue;
}

CsgProgram::Side CsgProgram::side(std::uint32_t atom, const SidesView& view) const {
  const auto decided = [](bool in) { return in ? Side::In : Side::Out; };
  if (atom == view.atom) return decided(view.from_behind);
  const CsgAtom& it = atoms_[atom];
  const Vector3 in_atom = it.atom_from_tree * view.place;
  AtomHeight near{};
  if (it.kind == Kind::Mesh) {
    const auto height = mesh_height(it, in_atom, view.slack);
    if (!height || height->height > view.slack) return decided(behind(it, view.place));
    near = *height;
  } else {
    const double distance = signed_distance(it, in_atom);
    if (std::abs(distance) > view.slack * it.most_stretch) return decided(distance <= 0.0);
    near = height_in_tree(it, in_atom);
    if (std::abs(near.height) > view.slack) return decided(distance <= 0.0);
  }
  if (near.normal.cross(view.normal).norm() > kAlong) return Side::Either;
  return decided(view.from_behind == (near.normal.dot(view.normal) > 0.0));
}

/// Can the program end in `wanted`, where some sides count as either? Follows both ways then, each once.
bool CsgProgram::possible(bool wanted, const SidesView& view) const {
  std::array<std::uint32_t, kMaxBranches> forks;  // instructions at which both ways have been taken up
  std::array<std::uint32_t, kMaxBranches> open;
  unsigned forked = 0;
  unsigned waiting = 0;
  open[waiting++] = start_;
  while (waiting > 0) {
    std::uint32_t at = open[--waiting];
    while (at < kFalse) {
      const Instruction& test = code_[at];
      if ((test.test & kBox) != 0) {
        at = boxes_[test.test & ~kBox].contains(view.place) ? test.on_true : test.on_false;
        continue;
      }
      const Side side = this->side(test.test, view);
      if (side == Side::Either) {
        if (std::find(forks.begin(), forks.begin() + forked, at) != forks.begin() + forked) break;
        // Out of room for more ways: what is not disproved counts as possible, a wall rather than a hole.
        if (forked == kMaxBranches) return true;
        forks[forked++] = at;
        open[waiting++] = test.on_false;
      }
      at = side == Side::Out ? test.on_false : test.on_true;
    }
    if ((wanted && at == kTrue) || (!wanted && at == kFalse)) return true;
  }
  return false;
}

bool CsgProgram::on_surface(std::uint32_t atom, const Vector3& place, const Vector3& normal,
                            double slack) const {
  // A subtracted atom's solid lies in front of it.
  const bool solid_behind = !atoms_[atom].subtracted;
  return possible(true, {atom, solid_behind, place, normal, slack}) &&
         possible(false, {atom, !solid_behind, place, normal, slack});
}

std::size_t CsgProgram::bytes() const {
  return sizeof(*this) + code_.capacity() * sizeof(Instruction) + atoms_.capacity() * sizeof(CsgAtom) +
         (boxes_.capacity() + relevant_.capacity() + extents_.capacity()) * sizeof(Bounds);
}

}  // namespace icome::geometry
