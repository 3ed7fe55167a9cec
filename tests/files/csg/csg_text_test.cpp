#include "files/csg/csg_text.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "files/damage.h"
#include "world/every_edit.h"

namespace icome::files {
namespace {

using base::Affine3;
using base::Vector3;
using geometry::CsgOperator;
using geometry::CsgTree;

std::uint64_t hash(const CsgTree& tree) { return world::CsgGeometry(tree).hash(); }

void expect_same_after_text(const CsgTree& tree) {
  const auto text = csg_text(tree);
  ASSERT_TRUE(text) << text.error().message;
  const auto back = csg_from_text(*text);
  ASSERT_TRUE(back) << back.error().message << "\n" << *text;
  EXPECT_EQ(hash(*back), hash(tree)) << *text;
  EXPECT_EQ(*csg_text(*back), *text);
}

std::string csg_text_error(std::string_view text) {
  const auto tree = csg_from_text(text);
  return tree ? "" : tree.error().message;
}

TEST(CsgText, ReadsAsPeopleWouldWriteIt) {
  CsgTree tree;
  const auto box = tree.add_leaf(geometry::Primitive(geometry::Box{Vector3(0.05, 0.1, 0.15)}),
                                 Affine3(Eigen::Translation3d(0.0, 0.0, 0.05)), {{1.0F, 0.5F, 0.0F, 0.9F}});
  Affine3 turned = Affine3::Identity();
  turned.linear() << 1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0;
  const auto bar = tree.add_leaf(geometry::Primitive(geometry::Cylinder{0.02, 0.4}), turned);
  tree.add(CsgOperator::Difference, box, bar);
  EXPECT_EQ(csg_text(tree).value(),
            "box:0.1x0.2x0.3 move 0 0 0.05 colour 1 0.5 0 0.9\n"
            "cylinder:0.02x0.4 matrix 1 0 0 0 0 0 -1 0 0 1 0 0\n"
            "difference 0 1\n");
}

TEST(CsgText, KeepsEveryKindOfLeafMeshesThatAreSharedAndNodesBesideTheTree) {
  for (const world::GeometryPointer& shape : world::every_shape()) {
    if (const auto* it = dynamic_cast<const world::CsgGeometry*>(shape.get()))
      expect_same_after_text(it->tree);
    if (const auto* it = dynamic_cast<const world::PrimitiveGeometry*>(shape.get())) {
      CsgTree tree;
      tree.add_leaf(it->primitive);
      expect_same_after_text(tree);
    }
  }
  const auto back =
      csg_from_text(csg_text(dynamic_cast<const world::CsgGeometry&>(*world::csg()).tree).value());
  ASSERT_TRUE(back);
  using Mesh = std::shared_ptr<const geometry::MeshSolid>;
  EXPECT_EQ(std::get<Mesh>(*back->node(0).shape), std::get<Mesh>(*back->node(1).shape));
  EXPECT_NE(std::get<Mesh>(*back->node(0).shape), std::get<Mesh>(*back->node(4).shape));
}

TEST(CsgText, KeepsDoublesToTheLastBit) {
  base::Random random(1);
  const auto any = [&] { return random.uniform(-1.0, 1.0) * std::pow(10.0, random.uniform(-20.0, 20.0)); };
  for (int i = 0; i < 200; ++i) {
    CsgTree tree;
    for (CsgTree::Index n = 0; n < 10; ++n) {
      Affine3 frame = Affine3::Identity();
      for (int k = 0; k < 12; ++k) frame(k / 4, k % 4) = random.index(4) == 0 ? -0.0 : any();
      if (n % 3 == 0) frame.linear() = base::Matrix3::Identity();
      if (frame.linear().determinant() == 0.0) continue;
      tree.add_leaf(geometry::Primitive(geometry::Box{
                        {random.uniform(1e-9, 1.0), random.uniform(1.0, 4e5), random.uniform(0.1, 0.2)}}),
                    frame, {{float(random.uniform()), float(any()), -0.0F, 1.0F}});
    }
    expect_same_after_text(tree);
  }
}

TEST(CsgText, TreesMayBeVeryDeep) {
  CsgTree left, right;
  auto top = left.add_leaf(geometry::Primitive(geometry::Sphere{1.0}));
  for (int i = 0; i < 10'000; ++i) {
    const auto leaf = left.add_leaf(geometry::Primitive(geometry::Sphere{0.5}), world::at(i, 0.0, 0.0));
    top = left.add(CsgOperator(i % 3), top, leaf, world::at(0.0, 1e-3, 0.0));
  }
  expect_same_after_text(left);
  top = right.add_leaf(geometry::Primitive(geometry::Sphere{1.0}));
  for (int i = 0; i < 10'000; ++i)
    top = right.add(CsgOperator(i % 3), right.add_leaf(geometry::Primitive(geometry::Sphere{0.5})), top);
  expect_same_after_text(right);
}

TEST(CsgText, ReadsCommentsSpaceAndAnyLineEnds) {
  const auto tree = csg_from_text("  # a ball\r\n\r\nsphere:0.5\tmove 1 +2 3 # there\r\n");
  ASSERT_TRUE(tree) << tree.error().message;
  ASSERT_EQ(tree->size(), 1U);
  EXPECT_EQ(tree->node(0).parent_from_node.translation(), Vector3(1.0, 2.0, 3.0));
  EXPECT_TRUE(csg_from_text("")->empty());
  EXPECT_TRUE(csg_from_text("# nothing")->empty());
}

TEST(CsgText, RefusesWhatIsNoTreeAndNamesTheLine) {
  EXPECT_EQ(csg_text_error("sphere:1\nunion 0 1"),
            "CSG tree:2: 1 is not the number of a node: there are 1 so far");
  EXPECT_NE(
      csg_text_error("sphere:1\nunion 0 0").find("CSG tree:2: A node of a CSG tree can be an operand once"),
      std::string::npos);
  EXPECT_NE(csg_text_error("sphere:0").find("CSG tree:1: \"sphere:0\": "), std::string::npos);
  EXPECT_NE(csg_text_error("blob").find("CSG tree:1: \"blob\" is not a primitive"), std::string::npos);
  EXPECT_NE(csg_text_error("sphere:1 move 1 2\n").find("the line ends where a length is expected"),
            std::string::npos);
  EXPECT_EQ(csg_text_error("sphere:1 move 1 2 3 move 1 2 3"), "CSG tree:1: 'move' is not expected here");
  EXPECT_EQ(csg_text_error("sphere:1 tilt 3"), "CSG tree:1: 'tilt' is not expected here");
  EXPECT_NE(csg_text_error("sphere:1 matrix 1 0 0 0 0 1 0 0 0 0 0 0").find("does not flatten it"),
            std::string::npos);
  EXPECT_NE(csg_text_error("sphere:1 move nan 0 0").find("finite"), std::string::npos);
  EXPECT_NE(csg_text_error("sphere:1 colour 1 1 1").find("A colour needs four numbers"), std::string::npos);
  EXPECT_NE(csg_text_error("sphere:1\nsphere:1\nunion 0 1 colour 1 1 1 1").find(":3: 'colour' is not"),
            std::string::npos);
  EXPECT_EQ(csg_text_error("mesh 0"), "CSG tree:1: 0 is not the number of a mesh: there are 0 so far");
  EXPECT_EQ(csg_text_error("define mesh 1"), "CSG tree:1: \"define mesh 0\" is expected");
  EXPECT_EQ(csg_text_error("define mesh 0\nvertex 0 0 0\nmesh 0"),
            "CSG tree:3: A mesh in a CSG tree needs triangles");
  EXPECT_NE(
      csg_text_error("define mesh 0\nvertex 0 0 0\ntriangle 0 0 1").find("CSG tree:3: 1 is not the number"),
      std::string::npos);
  EXPECT_EQ(csg_text_error("vertex 0 0 0"), "CSG tree:1: A vertex must follow \"define mesh\"");
  EXPECT_EQ(csg_text_error("sphere:1\nroot -1"),
            "CSG tree:2: -1 is not the number of a node: there are 1 so far");
  EXPECT_EQ(csg_text_error("sphere:1\nroot 0\nsphere:1"), "CSG tree:3: Nothing may follow the root");
  EXPECT_EQ(csg_text_error("sphere:1\nsphere:2\nunion 0 99999999999999999999999"),
            "CSG tree:3: '99999999999999999999999' is not the number of a node");
}

class OwnPrimitive final : public geometry::CsgPrimitive {
 public:
  bool inside(const Vector3&) const override { return false; }
  geometry::SurfacePoint scp_from_inside(const Vector3& point) const override { return {point, point}; }
  geometry::SurfacePoint scp_from_outside(const Vector3& point) const override { return {point, point}; }
  base::Bounds bounds() const override { return {}; }
  geometry::TriangleMesh tessellate(double) const override { return {}; }
  std::string name() const override { return "egg"; }
};

TEST(CsgText, RefusesToWriteWhatCouldNotBeReadBack) {
  CsgTree own;
  own.add_leaf(std::make_shared<const OwnPrimitive>());
  ASSERT_FALSE(csg_text(own));
  EXPECT_EQ(csg_text(own).error().message, "A CSG tree with the primitive \"egg\" of one's own has no text.");
  CsgTree flat;
  flat.add_leaf(geometry::Primitive(geometry::Sphere{-1.0}));
  EXPECT_FALSE(csg_text(flat));
}

TEST(CsgText, DamagedTextIsReadOrRefused) {
  constexpr std::string_view kWords[] = {"mesh ", "\n",         "root 0",          "nan",
                                         "-",     "4294967296", "define mesh 0\n", "#"};
  const std::string good = csg_text(dynamic_cast<const world::CsgGeometry&>(*world::csg()).tree).value();
  base::Random random(2);
  int read = 0;
  for (int i = 0; i < 5'000; ++i) {
    const auto tree = csg_from_text(damaged(good, kWords, random));
    if (!tree) {
      EXPECT_TRUE(tree.error().message.starts_with("CSG tree:")) << tree.error().message;
      continue;
    }
    ++read;
    expect_same_after_text(*tree);
  }
  EXPECT_GT(read, 30);
}

}  // namespace
}  // namespace icome::files
