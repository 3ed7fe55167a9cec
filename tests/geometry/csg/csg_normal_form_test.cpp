#include "geometry/csg/csg_normal_form.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "base/random.h"
#include "geometry/csg_trees.h"

namespace icome::geometry {
namespace csg_normal_form_test {
namespace {

using Op = CsgOperator;
using Index = CsgTree::Index;

const NormaliseOptions kWhole{.prune = false};
constexpr CsgForm kBothForms[] = {CsgForm::Normal, CsgForm::Subnormal};

// ---- Trees as text, "((A+B)*C)-D" with + union, * intersection; operands are spheres that all overlap ----

class TextReader {
 public:
  explicit TextReader(const std::string& text) : text_(text) {}

  CsgTree read() {
    operand();
    return tree_;
  }

 private:
  Index operand() {
    if (text_[at_] != '(') return tree_.add_leaf(Primitive(Sphere{double(text_[at_++])}));
    ++at_;
    const Index left = operand();
    const char symbol = text_[at_++];
    const Index right = operand();
    ++at_;
    const Op op = symbol == '+' ? Op::Union : symbol == '*' ? Op::Intersection : Op::Difference;
    return tree_.add(op, left, right);
  }

  std::string text_;
  std::size_t at_ = 0;
  CsgTree tree_;
};

CsgTree tree_of(const std::string& text) { return TextReader(text).read(); }

std::string bracketed(const std::string& left, char symbol, const std::string& right) {
  std::string text = "(";
  text += left;
  text += symbol;
  text += right;
  text += ')';
  return text;
}

std::string text_of(const CsgTree& tree, Index index) {
  const CsgTree::Node& node = tree.node(index);
  if (node.is_leaf) return {char(std::get<Sphere>(std::get<Primitive>(*node.shape)).radius)};
  return bracketed(text_of(tree, node.left), "+*-"[int(node.op)], text_of(tree, node.right));
}

std::string text_of(const CsgTree& tree) { return tree.empty() ? "" : text_of(tree, tree.root()); }

// ---- The rules as printed, one application at a time: the reference -----------------------------------

struct Term;
using TermPtr = std::shared_ptr<const Term>;
struct Term {
  char symbol;  // of an operation, or a leaf's letter
  TermPtr left, right;
};

TermPtr operation(const TermPtr& left, char symbol, const TermPtr& right) {
  return std::make_shared<const Term>(Term{symbol, left, right});
}

TermPtr term_of(const CsgTree& tree, Index index) {
  const CsgTree::Node& node = tree.node(index);
  if (node.is_leaf) return std::make_shared<const Term>(Term{text_of(tree, index)[0], nullptr, nullptr});
  return operation(term_of(tree, node.left), "+*-"[int(node.op)], term_of(tree, node.right));
}

std::string text_of(const TermPtr& t) {
  if (!t->left) return {t->symbol};
  return bracketed(text_of(t->left), t->symbol, text_of(t->right));
}

/// What the first rule that fits makes of the term; nothing when none fits.
TermPtr rewritten(const TermPtr& t, bool all_rules) {
  if (!t->left) return nullptr;
  const TermPtr &x = t->left, &r = t->right;
  const char above = t->symbol, right = r->left ? r->symbol : ' ', left = x->left ? x->symbol : ' ';
  const auto make = operation;
  if (above == '-' && right == '+') return make(make(x, '-', r->left), '-', r->right);  // 1
  if (all_rules && above == '*' && right == '+')
    return make(make(x, '*', r->left), '+', make(x, '*', r->right));
  if (above == '-' && right == '*') return make(make(x, '-', r->left), '+', make(x, '-', r->right));  // 3
  if (all_rules && above == '*' && right == '*') return make(make(x, '*', r->left), '*', r->right);
  if (above == '-' && right == '-') return make(make(x, '-', r->left), '+', make(x, '*', r->right));  // 5
  if (!all_rules) return nullptr;
  if (above == '*' && right == '-') return make(make(x, '*', r->left), '-', r->right);               // 6
  if (left == '-' && above == '*') return make(make(x->left, '*', r), '-', x->right);                // 7
  if (left == '+' && above == '-') return make(make(x->left, '-', r), '+', make(x->right, '-', r));  // 8
  if (left == '+' && above == '*') return make(make(x->left, '*', r), '+', make(x->right, '*', r));  // 9
  return nullptr;
}

TermPtr by_the_rules(TermPtr t, bool all_rules) {
  while (const TermPtr next = rewritten(t, all_rules)) t = next;
  if (!t->left) return t;
  const TermPtr left = by_the_rules(t->left, all_rules), right = by_the_rules(t->right, all_rules);
  const TermPtr both = operation(left, t->symbol, right);
  return rewritten(both, all_rules) ? by_the_rules(both, all_rules) : both;
}

/// Unions as they nest, the operands of each product sorted: their order depends on where rules begin.
std::string unions_of(const TermPtr& t) {
  if (t->symbol == '+') return bracketed(unions_of(t->left), '+', unions_of(t->right));
  std::vector<std::string> operands;
  TermPtr end = t;
  for (; end->left; end = end->left) operands.push_back({end->symbol, end->right->symbol});
  operands.push_back({'*', end->symbol});
  std::sort(operands.begin(), operands.end());
  std::string text;
  for (const std::string& operand : operands) text += operand;
  return text;
}

// ---- What a tree must be to be in a form --------------------------------------------------------------

bool has_union(const CsgTree& tree, Index index) {
  for (; !tree.node(index).is_leaf; index = tree.node(index).left) {
    if (tree.node(index).op == Op::Union) return true;
  }
  return false;
}

/// Every node is below the root, has one parent, and only leaves are moved.
void expect_well_made(const CsgTree& tree) {
  if (tree.empty()) return;
  std::vector<int> parents(tree.size(), 0);
  for (Index i = 0; i < tree.size(); ++i) {
    const CsgTree::Node& node = tree.node(i);
    if (node.is_leaf) continue;
    ASSERT_TRUE(node.parent_from_node.matrix().isIdentity(0.0));
    ASSERT_TRUE(node.left < i && node.right < i);
    ++parents[node.left];
    ++parents[node.right];
  }
  EXPECT_EQ(tree.root(), tree.size() - 1);
  EXPECT_EQ(std::count(parents.begin(), parents.end(), 1), std::ptrdiff_t(tree.size()) - 1);
}

void expect_form(const CsgTree& tree, CsgForm form) {
  expect_well_made(tree);
  for (Index i = 0; i < tree.size(); ++i) {
    const CsgTree::Node& node = tree.node(i);
    if (node.is_leaf) continue;
    const bool right_is_leaf = tree.node(node.right).is_leaf;
    EXPECT_TRUE(node.op != Op::Difference || right_is_leaf);
    if (form != CsgForm::Normal || node.op == Op::Union) continue;
    EXPECT_TRUE(right_is_leaf);
    EXPECT_FALSE(has_union(tree, node.left));
    // Rule 7 has put the differences last.
    const CsgTree::Node& left = tree.node(node.left);
    EXPECT_FALSE(node.op == Op::Intersection && !left.is_leaf && left.op == Op::Difference);
  }
}

void expect_equal(const CsgTree& a, const CsgTree& b) {
  ASSERT_EQ(a.size(), b.size());
  if (a.empty()) return;
  EXPECT_EQ(a.root(), b.root());
  for (Index i = 0; i < a.size(); ++i) {
    const CsgTree::Node &m = a.node(i), &n = b.node(i);
    ASSERT_EQ(m.is_leaf, n.is_leaf);
    ASSERT_EQ(m.parent_from_node.matrix(), n.parent_from_node.matrix());
    ASSERT_EQ(m.colour, n.colour);
    if (m.is_leaf) {
      ASSERT_EQ(m.shape->index(), n.shape->index());
      ASSERT_EQ(shape_name(*m.shape), shape_name(*n.shape));
    } else {
      ASSERT_TRUE(m.op == n.op && m.left == n.left && m.right == n.right);
    }
  }
}

CsgTree normalised(const CsgTree& tree, CsgForm form, const NormaliseOptions& options = {}) {
  auto result = normalise(tree, form, options);
  EXPECT_TRUE(result) << result.error().message;
  return result ? result->tree : CsgTree();
}

std::string normal_text(const std::string& text) {
  return text_of(normalised(tree_of(text), CsgForm::Normal, kWhole));
}

std::string subnormal_text(const std::string& text) {
  return text_of(normalised(tree_of(text), CsgForm::Subnormal, kWhole));
}

/// (A1 + B1) * (A2 + B2) * ... : 2^k products of k operands.
CsgTree exploding(int k, double radius = 1.0, double step = 0.0) {
  CsgTree tree;
  Index product = 0;
  for (int i = 0; i < k; ++i) {
    const Index a = tree.add_leaf(Primitive(Sphere{radius}), moved(step * i, 0, 0));
    const Index b = tree.add_leaf(Primitive(Sphere{radius}), moved(step * i, 0.01, 0));
    const Index sum = tree.add(Op::Union, a, b);
    product = i == 0 ? sum : tree.add(Op::Intersection, product, sum);
  }
  return tree;
}

// ---- The rules -------------------------------------------------------------------------------------------

TEST(CsgNormalForm, TheNineRules) {
  EXPECT_EQ(normal_text("(X-(Y+Z))"), "((X-Y)-Z)");
  EXPECT_EQ(normal_text("(X*(Y+Z))"), "((X*Y)+(X*Z))");
  EXPECT_EQ(normal_text("(X-(Y*Z))"), "((X-Y)+(X-Z))");
  EXPECT_EQ(normal_text("(X*(Y*Z))"), "((X*Y)*Z)");
  EXPECT_EQ(normal_text("(X-(Y-Z))"), "((X-Y)+(X*Z))");
  EXPECT_EQ(normal_text("(X*(Y-Z))"), "((X*Y)-Z)");
  EXPECT_EQ(normal_text("((X-Y)*Z)"), "((X*Z)-Y)");
  EXPECT_EQ(normal_text("((X+Y)-Z)"), "((X-Z)+(Y-Z))");
  EXPECT_EQ(normal_text("((X+Y)*Z)"), "((X*Z)+(Y*Z))");
}

TEST(CsgNormalForm, SubnormalKnowsThreeRules) {
  EXPECT_EQ(subnormal_text("(X-(Y+Z))"), "((X-Y)-Z)");
  EXPECT_EQ(subnormal_text("(X-(Y*Z))"), "((X-Y)+(X-Z))");
  EXPECT_EQ(subnormal_text("(X-(Y-Z))"), "((X-Y)+(X*Z))");
  for (const char* other : {"(X*(Y+Z))", "(X*(Y*Z))", "(X*(Y-Z))", "((X-Y)*Z)", "((X+Y)-Z)", "((X+Y)*Z)"}) {
    EXPECT_EQ(subnormal_text(other), other);
  }
}

TEST(CsgNormalForm, WhatIsInFormStays) {
  for (const char* text :
       {"A", "(A-B)", "(A+(B+(C+D)))", "((A+B)+(C+D))", "(((A*B)*C)-D)", "(((A-B)-C)+(D*E))"}) {
    EXPECT_EQ(normal_text(text), text);
    EXPECT_EQ(subnormal_text(text), text);
  }
}

/// A random tree over letters that all overlap, so that nothing is pruned.
std::string random_text(base::Random& random, int leaves, char& letter) {
  if (leaves == 1) return {letter++};
  const int left = 1 + int(random.index(std::uint64_t(leaves - 1)));
  const std::string a = random_text(random, left, letter);
  const char symbol = "+*-"[random.index(3)];
  return bracketed(a, symbol, random_text(random, leaves - left, letter));
}

TEST(CsgNormalForm, IsWhatTheRulesMakeAppliedOneByOne) {
  base::Random random(21);
  for (int i = 0; i < 2000; ++i) {
    char letter = 'A';
    const std::string text = random_text(random, 1 + int(random.index(8)), letter);
    const CsgTree tree = tree_of(text);
    const TermPtr term = term_of(tree, tree.root());
    const CsgTree normal = normalised(tree, CsgForm::Normal, kWhole);
    EXPECT_EQ(unions_of(term_of(normal, normal.root())), unions_of(by_the_rules(term, true))) << text;
    EXPECT_EQ(subnormal_text(text), text_of(by_the_rules(term, false))) << text;
    for (const CsgForm form : kBothForms) {
      EXPECT_EQ(normalise(tree, form)->pruned, 0u) << text;  // that is: the size was foretold
    }
  }
}

// ---- The same solid ----------------------------------------------------------------------------------

/// Points all over a tree of about 1 m, and as near to its leaves' surfaces as rounding permits.
std::vector<Vector3> probes(base::Random& random, const CsgTree& tree, int count) {
  const std::vector<Affine3> frames = tree.tree_from_node();
  std::vector<CsgLeaf> leaves;
  for (Index i = 0; i < tree.size(); ++i) {
    if (tree.node(i).is_leaf) leaves.emplace_back(*tree.node(i).shape, frames[i]);
  }
  std::vector<Vector3> points;
  for (int i = 0; i < count; ++i) {
    const Vector3 point = random.uniform(0.0, 1.5) * random.direction();
    const CsgLeaf& leaf = leaves[random.index(leaves.size())];
    const SurfacePoint near = leaf.inside(point) ? leaf.scp_from_inside(point) : leaf.scp_from_outside(point);
    points.push_back(point);
    points.push_back(near.point);
    points.push_back(near.point + random.uniform(-1e-9, 1e-9) * near.normal);
  }
  return points;
}

TEST(CsgNormalForm, IsTheSameSolid) {
  base::Random random(22);
  std::size_t dropped = 0;
  for (int i = 0; i < 300; ++i) {
    const CsgTree tree = random_tree(random, {.leaves = 1 + random.index(14)});
    const std::vector<Vector3> points = probes(random, tree, 12);
    for (const CsgForm form : kBothForms) {
      for (const bool prune : {false, true}) {
        const auto result = normalise(tree, form, {.prune = prune});
        ASSERT_TRUE(result) << result.error().message;
        expect_form(result->tree, form);
        dropped += result->pruned;
        for (const Vector3& point : points) {
          ASSERT_EQ(inside(result->tree, point), inside(tree, point)) << i << ": " << point.transpose();
        }
      }
    }
  }
  EXPECT_GT(dropped, 100u);
}

TEST(CsgNormalForm, IsTheSameSolidForOperandsThatCoincide) {
  base::Random random(23);
  for (int i = 0; i < 200; ++i) {
    const CsgTree tree =
        random_tree(random, {.leaves = 2 + random.index(8), .transformed = 0.0, .repeated = 0.8});
    for (const CsgForm form : kBothForms) {
      const CsgTree result = normalised(tree, form);
      for (const Vector3& point : probes(random, tree, 20)) {
        ASSERT_EQ(inside(result, point), inside(tree, point));
      }
    }
  }
}

TEST(CsgNormalForm, NormalisingAgainChangesNothing) {
  base::Random random(24);
  for (int i = 0; i < 400; ++i) {
    const CsgTree tree = random_tree(random, {.leaves = 1 + random.index(14)});
    for (const CsgForm form : kBothForms) {
      for (const bool prune : {false, true}) {
        const CsgTree once = normalised(tree, form, {.prune = prune});
        const auto twice = normalise(once, form, {.prune = prune});
        ASSERT_TRUE(twice);
        EXPECT_EQ(twice->pruned, 0u);
        expect_equal(once, twice->tree);
      }
    }
  }
}

TEST(CsgNormalForm, ASolidWithoutItselfIsEmpty) {
  base::Random random(25);
  for (const CsgShape& shape : all_shapes()) {
    CsgTree tree;
    const Affine3 placing = random_affine(random, 0.5);
    const Index a = tree.add_leaf(shape, placing);
    tree.add(Op::Difference, a, tree.add_leaf(shape, placing));
    for (const CsgForm form : kBothForms) {
      const CsgTree result = normalised(tree, form);
      for (const Vector3& point : probes(random, tree, 30)) EXPECT_FALSE(inside(result, point));
    }
  }
}

TEST(CsgNormalForm, TransformsMoveToTheLeaves) {
  CsgTree tree;
  const Index a = tree.add_leaf(Primitive(Sphere{1.0}), moved(1, 0, 0), CsgTree::Colour{1, 0, 0, 1});
  const Index both = tree.add(Op::Union, a, tree.add_leaf(Primitive(Sphere{1.0})), moved(0, 2, 0));
  tree.add(Op::Intersection, both, tree.add_leaf(Primitive(Box{{4, 4, 4}})), moved(0, 0, 3));
  const CsgTree result = normalised(tree, CsgForm::Normal);
  EXPECT_EQ(result.node(0).parent_from_node.translation(), Vector3(1, 2, 3));
  EXPECT_EQ(result.node(0).colour, (CsgTree::Colour{1, 0, 0, 1}));
  EXPECT_EQ(result.node(1).parent_from_node.translation(), Vector3(0, 0, 3));
}

TEST(CsgNormalForm, OnlyWhatIsBelowTheRootIsNormalised) {
  CsgTree tree = tree_of("((A*(B+C))-D)");
  tree.set_root(4);
  EXPECT_EQ(text_of(normalised(tree, CsgForm::Normal)), "((A*B)+(A*C))");
}

TEST(CsgNormalForm, AsATreeItStaysAsItWasMade) {
  base::Random random(26);
  const CsgTree tree = random_tree(random, {.leaves = 20});
  const auto result = normalise(tree, CsgForm::Tree);
  ASSERT_TRUE(result);
  expect_equal(tree, result->tree);
  EXPECT_EQ(result->pruned, 0u);
}

// ---- Pruning -------------------------------------------------------------------------------------------

Index far_ball(CsgTree& tree, double x) { return tree.add_leaf(Primitive(Sphere{1.0}), moved(x, 0, 0)); }

TEST(CsgNormalForm, EmptyStaysEmpty) {
  for (const CsgForm form : {CsgForm::Tree, CsgForm::Normal, CsgForm::Subnormal}) {
    EXPECT_TRUE(normalised(CsgTree(), form).empty());
  }
}

TEST(CsgNormalForm, IntersectionsOfBoxesThatDoNotMeetAreDropped) {
  for (const CsgForm form : kBothForms) {
    CsgTree tree;
    const Index nothing = tree.add(Op::Intersection, far_ball(tree, 0), far_ball(tree, 5));
    EXPECT_TRUE(normalised(tree, form).empty());
    EXPECT_EQ(normalise(tree, form)->pruned, 3u);
    tree.add(Op::Union, nothing, far_ball(tree, 9));
    EXPECT_EQ(normalised(tree, form).size(), 1u);  // a union with nothing is its other side
    EXPECT_EQ(normalise(tree, form)->pruned, 4u);
    EXPECT_EQ(normalised(tree, form, kWhole).size(), 5u);
  }
}

TEST(CsgNormalForm, WhatIsSubtractedFarAwayIsDropped) {
  for (const CsgForm form : kBothForms) {
    CsgTree tree;
    Index solid = far_ball(tree, 0);
    for (const double x : {1.5, 3.0, 5.0}) solid = tree.add(Op::Difference, solid, far_ball(tree, x));
    const auto result = normalise(tree, form);
    EXPECT_EQ(result->tree.size(), 3u);
    EXPECT_EQ(result->pruned, 4u);
  }
}

TEST(CsgNormalForm, BoxesThatTouchMeet) {
  CsgTree tree;
  tree.add(Op::Intersection, far_ball(tree, 0), far_ball(tree, 2));
  EXPECT_EQ(normalised(tree, CsgForm::Normal).size(), 3u);
  EXPECT_TRUE(inside(normalised(tree, CsgForm::Normal), {1, 0, 0}));
}

TEST(CsgNormalForm, HalfSpacesTakePart) {
  CsgTree tree;
  const Index ball = far_ball(tree, 0);
  const Index half = tree.add(Op::Intersection, ball, tree.add_leaf(Primitive(Plane{})));
  const Index below = tree.add_leaf(Primitive(Plane{}), moved(0, 0, -2));
  tree.add(Op::Difference, half, below);
  const CsgTree result = normalised(tree, CsgForm::Normal);
  EXPECT_EQ(result.size(), 3u);  // what lies below z = -2 takes nothing away
  EXPECT_TRUE(inside(result, {0, 0, -0.5}));
  EXPECT_FALSE(inside(result, {0, 0, 0.5}));
}

TEST(CsgNormalForm, OnlyNeighboursAreMultipliedOut) {
  // Two rows of 300 balls, each touched by those beside it in the other row: 90,000 pairs, about 900 near.
  CsgTree tree;
  Index rows[2];
  for (int row = 0; row < 2; ++row) {
    rows[row] = far_ball(tree, 0.5 * row);
    for (int i = 1; i < 300; ++i)
      rows[row] = tree.add(Op::Union, rows[row], far_ball(tree, 2.1 * i + 0.5 * row));
  }
  tree.add(Op::Intersection, rows[0], rows[1]);
  const auto result = normalise(tree, CsgForm::Normal);
  ASSERT_TRUE(result);
  EXPECT_EQ(products(result->tree).size(), 300u + 299u);
  EXPECT_EQ(result->tree.size() + result->pruned, 4u * 90'000 - 1);
}

TEST(CsgNormalForm, DeadEndsAreSeenBeforeTheyMultiply) {
  // The first factor lies on both sides of all others but does not meet them.
  CsgTree tree;
  const Index around = tree.add(Op::Union, far_ball(tree, -50), far_ball(tree, 50));
  Index product = around;
  for (int i = 0; i < 60; ++i) {
    product =
        tree.add(Op::Intersection, product, tree.add(Op::Union, far_ball(tree, 0), far_ball(tree, 0.1)));
  }
  EXPECT_TRUE(normalised(tree, CsgForm::Normal).empty());
}

TEST(CsgNormalForm, AShapeWithoutExtentIsDropped) {
  class Nothing final : public CsgPrimitive {
   public:
    bool inside(const Vector3&) const override { return false; }
    SurfacePoint scp_from_inside(const Vector3& point) const override { return {point, Vector3::UnitZ()}; }
    SurfacePoint scp_from_outside(const Vector3& point) const override { return {point, Vector3::UnitZ()}; }
    Bounds bounds() const override { return {}; }
    TriangleMesh tessellate(double) const override { return {}; }
    std::string name() const override { return "nothing"; }
  };
  CsgTree tree;
  tree.add(Op::Union, tree.add_leaf(std::make_shared<const Nothing>()), tree.add_leaf(Primitive(Plane{})));
  EXPECT_EQ(normalised(tree, CsgForm::Normal).size(), 1u);
  EXPECT_EQ(normalised(tree, CsgForm::Subnormal).size(), 1u);
}

// ---- Growth ----------------------------------------------------------------------------------------------

TEST(CsgNormalForm, GrowsAsTheRulesSay) {
  for (const int k : {1, 4, 8, 12}) {
    const std::size_t products_made = std::size_t(1) << k;
    const CsgTree tree = exploding(k);
    EXPECT_EQ(normalised(tree, CsgForm::Normal).size(), 2 * products_made * std::size_t(k) - 1);
    EXPECT_EQ(normalised(tree, CsgForm::Subnormal).size(), tree.size());
  }
}

TEST(CsgNormalForm, TooLargeIsRefusedByName) {
  for (const bool prune : {false, true}) {
    NormaliseOptions options{.prune = prune, .max_nodes = 100'000};
    const auto refused = normalise(exploding(2000), CsgForm::Normal, options);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("more than 100000 nodes"), std::string::npos);
    EXPECT_NE(refused.error().message.find("subnormal"), std::string::npos);
    const std::size_t size = 2 * 8 * 256 - 1;
    options.max_nodes = size;
    EXPECT_TRUE(normalise(exploding(8), CsgForm::Normal, options));
    options.max_nodes = size - 1;
    EXPECT_FALSE(normalise(exploding(8), CsgForm::Normal, options));
  }
}

TEST(CsgNormalForm, SubnormalFormsExplodeTooAndAreCountedFirst) {
  // ((A - (B * C)) - (B * C)) - ... copies all that is on the left each time.
  const auto doubling = [](int k) {
    CsgTree tree;
    Index solid = far_ball(tree, 0);
    for (int i = 0; i < k; ++i) {
      const Index right = tree.add(Op::Intersection, far_ball(tree, 0.1), far_ball(tree, 0.2));
      solid = tree.add(Op::Difference, solid, right);
    }
    return tree;
  };
  EXPECT_EQ(normalised(doubling(10), CsgForm::Subnormal).size(), 6u * 1024 - 5);
  const auto refused = normalise(doubling(60), CsgForm::Subnormal);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("6.918e+18 nodes"), std::string::npos) << refused.error().message;
}

TEST(CsgNormalForm, LongChainsAreNoTrouble) {
  const std::size_t operations = 100'000 / kLongShare;
  for (const bool left_deep : {true, false}) {
    CsgTree tree = chain(operations, left_deep, {Op::Union});
    for (const Op op : {Op::Union, Op::Intersection, Op::Difference}) {
      for (Index i = 2; i < tree.size(); i += 2) tree.set_operator(i, op);
      for (const CsgForm form : kBothForms) {
        const auto result = normalise(tree, form, {.max_nodes = 4 * tree.size()});
        if (op == Op::Difference && !left_deep && form == CsgForm::Normal) {
          EXPECT_FALSE(result);  // a product for each second operand, of up to half of them
          continue;
        }
        ASSERT_TRUE(result) << result.error().message;
        EXPECT_GE(result->tree.size(), tree.size());
        EXPECT_EQ(inside(result->tree, {0.4, 0, 0}), inside(tree, {0.4, 0, 0}));
      }
    }
  }
}

TEST(CsgNormalForm, LongChainsOfNeighboursArePrunedToThem) {
  // 20,000 boxes in a row, each less the next: only the next meets it.
  CsgTree tree;
  Index all = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Index box = tree.add_leaf(Primitive(Box{{0.3, 0.3, 0.3}}), moved(0.5 * i, 0, 0));
    const Index next = tree.add_leaf(Primitive(Box{{0.3, 0.3, 0.3}}), moved(0.5 * i + 0.5, 0, 0));
    const Index far = tree.add_leaf(Primitive(Box{{0.3, 0.3, 0.3}}), moved(0.5 * i + 1.0, 0, 0));
    const Index less = tree.add(Op::Difference, box, tree.add(Op::Union, next, far));
    all = i == 0 ? less : tree.add(Op::Union, all, less);
  }
  const auto result = normalise(tree, CsgForm::Normal);
  ASSERT_TRUE(result);
  EXPECT_EQ(result->tree.size(), 20'000u * 4 - 1);
  EXPECT_EQ(result->pruned, 20'000u * 2);
}

// ---- Products ------------------------------------------------------------------------------------------

TEST(CsgNormalForm, ProductsListTheOperands) {
  const CsgTree tree = tree_of("((A*(B-C))+D)");
  const std::vector<CsgProduct> parts = products(normalised(tree, CsgForm::Normal));
  ASSERT_EQ(parts.size(), 2u);
  std::string text;
  for (const CsgProduct& product : parts) {
    for (const CsgFactor& factor : product) {
      text += factor.subtracted ? '-' : '*';
      text += char(std::get<Sphere>(std::get<Primitive>(factor.leaf.shape())).radius);
    }
    text += ' ';
  }
  EXPECT_EQ(text, "*A*B-C *D ");
  EXPECT_TRUE(products(CsgTree()).empty());
}

TEST(CsgNormalForm, ProductsAreTheSolid) {
  base::Random random(27);
  for (int i = 0; i < 60; ++i) {
    const CsgTree tree = random_tree(random, {.leaves = 1 + random.index(12)});
    const std::vector<CsgProduct> parts = products(normalised(tree, CsgForm::Normal));
    for (const Vector3& point : probes(random, tree, 10)) {
      const bool held = std::any_of(parts.begin(), parts.end(), [&](const CsgProduct& product) {
        return std::all_of(product.begin(), product.end(), [&](const CsgFactor& factor) {
          return factor.leaf.inside(point) != factor.subtracted;
        });
      });
      ASSERT_EQ(held, inside(tree, point));
    }
  }
}

}  // namespace
}  // namespace csg_normal_form_test
}  // namespace icome::geometry
