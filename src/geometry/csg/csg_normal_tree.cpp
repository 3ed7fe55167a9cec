#include <fmt/format.h>

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "geometry/csg/csg_plan.h"

// All nine rules of 5.5.5 at once. Seen as a formula of set algebra in which X - Y is X and not Y, rules 1,
// 3 and 5 move "not" down to the leaves, where every leaf meets it at most once; then rules 2, 8 and 9
// multiply out, and 4, 6 and 7 put each product's operands in line, intersected ones first. A walk that
// chooses a side at each "or" meets the products one after the other, so that boxes can end a product
// before it is made and nothing but the result takes memory. The last factor chooses first, as rule 2
// comes before 9 and rule 1 before 8: the unions then nest as the rules nest them.

namespace icome::geometry {
namespace {

using Index = CsgPlan::Index;

/// A node of the plan, or its complement.
struct Term {
  Index node;
  bool negated;
};

/// Is the term "left or right" (rather than "left and right")?
bool is_choice(const CsgPlan::Node& node, bool negated) { return (node.op == CsgOperator::Union) != negated; }

Term left_of(const CsgPlan::Node& node, bool negated) { return {node.left, negated}; }

Term right_of(const CsgPlan::Node& node, bool negated) {
  return {node.right, negated != (node.op == CsgOperator::Difference)};
}

class Multiplication {
 public:
  Multiplication(const CsgPlan& plan, const NormaliseOptions& options)
      : plan_(plan), options_(options), steps_left_(kStepsPerNode * (options.max_nodes + plan.size())) {}

  base::Result<CsgTree> run() {
    if (plan_.root() == CsgPlan::kNothing) return CsgTree();
    const double whole = normal_size(plan_);
    if (!options_.prune && !(whole <= static_cast<double>(options_.max_nodes)))
      return base::fail(too_large());
    // Counted first: a tree that is refused takes no memory, and one that is made takes no more than it
    // needs.
    if (!pass()) return base::fail(*failure_);
    result_.reserve(size_);
    builds_ = true;
    if (!pass()) return base::fail(*failure_);
    return std::move(result_);
  }

 private:
  // Results within the limit take fewer steps, unless nearly all is dropped late.
  static constexpr std::uint64_t kStepsPerNode = 64;

  /// A list of the terms still to be multiplied by, last first; shared by the choices that branch off.
  struct Pending {
    Term term;
    Index next;
  };

  struct Choice {
    Term second;                  // the side that is taken second
    Index pending;                // the terms that are multiplied by after either side
    std::size_t cells, literals;  // sizes of cells_ and literals_ when the choice was met
    Bounds box;                   // of the product when the choice was met
    bool at_second;
    std::optional<Index> first;  // the tree that the first side became
  };

  /// Visits all products, counts their nodes and, the second time, makes them.
  bool pass() {
    size_ = 0;
    pending_ = CsgPlan::kNothing;
    cells_.clear();
    literals_.clear();
    box_ = plan_.node(plan_.root()).box;
    push({plan_.root(), false});
    do {
      walk_down();
      make_product();
    } while (!failure_ && walk_up());
    return !failure_;
  }

  void push(const Term& term) {
    cells_.push_back({term, pending_});
    pending_ = static_cast<Index>(cells_.size() - 1);
    if (!term.negated) box_ = box_.intersection(plan_.node(term.node).box);
  }

  bool lives() const { return !box_.isEmpty(); }

  /// Walks down to the leaves of one product, taking the first side of each choice.
  void walk_down() {
    while (pending_ != CsgPlan::kNothing && lives() && spend(1)) {
      const Term term = cells_[pending_].term;
      pending_ = cells_[pending_].next;
      const CsgPlan::Node& node = plan_.node(term.node);
      if (term.negated && !boxes_meet(node.box, box_)) continue;  // takes nothing away here
      if (node.is_leaf) {
        literals_.push_back(term);
      } else if (is_choice(node, term.negated)) {
        choices_.push_back({right_of(node, term.negated), pending_, cells_.size(), literals_.size(), box_,
                            false, std::nullopt});
        push(left_of(node, term.negated));
      } else {
        push(left_of(node, term.negated));
        push(right_of(node, term.negated));
      }
    }
  }

  /// Adds the chain of the current literals, the intersected ones first. They were found last to first.
  void make_product() {
    made_.reset();
    if (!lives() || failure_ || !spend(literals_.size())) return;
    for (const bool negated : {false, true}) {
      for (std::size_t i = literals_.size(); i-- > 0;) {
        const Term& literal = literals_[i];
        if (literal.negated != negated) continue;
        if (negated && !boxes_meet(plan_.node(literal.node).box, box_)) continue;
        if (!add_operand(literal)) return;
      }
    }
  }

  /// Walks up past the choices that are done and on to the second side of the next; false if there is none.
  bool walk_up() {
    for (; !choices_.empty(); choices_.pop_back()) {
      Choice& choice = choices_.back();
      if (!choice.at_second) {
        choice.at_second = true;
        choice.first = made_;
        cells_.resize(choice.cells);
        literals_.resize(choice.literals);
        pending_ = choice.pending;
        box_ = choice.box;
        push(choice.second);
        return true;
      }
      if (made_ && choice.first) {
        if (!count(1)) return false;
        if (builds_) made_ = result_.add(CsgOperator::Union, *choice.first, *made_);
      } else if (choice.first) {
        made_ = choice.first;
      }
    }
    return false;
  }

  bool add_operand(const Term& literal) {
    if (!count(made_ ? 2 : 1)) return false;
    const Index leaf = builds_ ? plan_.copy_leaf(literal.node, result_) : 0;
    const CsgOperator op = literal.negated ? CsgOperator::Difference : CsgOperator::Intersection;
    made_ = made_ && builds_ ? result_.add(op, *made_, leaf) : leaf;
    return true;
  }

  bool spend(std::uint64_t steps) {
    if (steps <= steps_left_) {
      steps_left_ -= steps;
      return true;
    }
    failure_ = fmt::format(
        "the normal form of this tree takes too much work, although pruning left only {} nodes of it so far; "
        "use the subnormal form or the tree as it is",
        size_);
    return false;
  }

  bool count(std::size_t nodes) {
    size_ += nodes;
    if (size_ <= options_.max_nodes) return true;
    failure_ = too_large();
    return false;
  }

  std::string too_large() const {
    return fmt::format(
        "the normal form of this tree has more than {} nodes ({:.4g} without pruning); use the "
        "subnormal form or the tree as it is, or raise the limit",
        options_.max_nodes, normal_size(plan_));
  }

  const CsgPlan& plan_;
  const NormaliseOptions& options_;
  std::uint64_t steps_left_;

  std::vector<Pending> cells_;
  Index pending_ = CsgPlan::kNothing;
  std::vector<Term> literals_;
  std::vector<Choice> choices_;
  Bounds box_;  // of all that is intersected, pending terms included

  bool builds_ = false;
  std::size_t size_ = 0;  // nodes met in this pass
  CsgTree result_;
  std::optional<Index> made_;  // of the side just finished; nothing when it was dropped
  std::optional<std::string> failure_;
};

/// A term multiplied out: the numbers of its products and of their leaves in all.
struct ProductCount {
  double products, leaves;
};

}  // namespace

double normal_size(const CsgPlan& plan) {
  if (plan.root() == CsgPlan::kNothing) return 0.0;
  const std::vector<CsgPlan::Side> sides = plan.sides();
  std::vector<ProductCount> counts(plan.size(), {1.0, 1.0});
  for (Index i = 0; i <= plan.root(); ++i) {
    const CsgPlan::Node& node = plan.node(i);
    if (sides[i] == CsgPlan::Side::Unused || node.is_leaf) continue;
    const ProductCount& left = counts[node.left];
    const ProductCount& right = counts[node.right];
    if (is_choice(node, sides[i] == CsgPlan::Side::Removed)) {
      counts[i] = {left.products + right.products, left.leaves + right.leaves};
    } else {
      counts[i] = {left.products * right.products,
                   left.leaves * right.products + right.leaves * left.products};
    }
  }
  return 2.0 * counts[plan.root()].leaves - 1.0;
}

base::Result<CsgTree> normal_tree(const CsgPlan& plan, const NormaliseOptions& options) {
  return Multiplication(plan, options).run();
}

}  // namespace icome::geometry
