#include "world/edit/edit_bytes.h"

#include <flatbuffers/flatbuffers.h>

#include <set>

#include "world/every_edit.h"
#include "world/random_edits.h"
#include "world/shape/geometry_bytes.h"

namespace icome::world {
namespace {

std::string written(const Edit& edit) {
  auto bytes = to_bytes(edit);
  if (!bytes) throw std::runtime_error(bytes.error().message);
  return std::move(*bytes);
}

Edit read_back(std::string_view bytes) {
  auto edit = edit_from_bytes(bytes, GeometryFactory());
  if (!edit) throw std::runtime_error(edit.error().message);
  return std::move(*edit);
}

void expect_not_written(const Edit& edit, const std::string& why) {
  const auto bytes = to_bytes(edit);
  ASSERT_FALSE(bytes) << why;
  EXPECT_NE(bytes.error().message.find(why), std::string::npos) << bytes.error().message;
}

void expect_not_read(std::string_view bytes, const std::string& why) {
  const auto edit = edit_from_bytes(bytes, GeometryFactory());
  ASSERT_FALSE(edit) << why;
  EXPECT_NE(edit.error().message.find(why), std::string::npos) << edit.error().message;
}

/// What bytes may be: an edit that can be written, applied and looked at, or refused with a reason.
void expect_edit_or_reason(std::string_view bytes) {
  const auto edit = edit_from_bytes(bytes, GeometryFactory());
  if (!edit) {
    EXPECT_FALSE(edit.error().message.empty());
    return;
  }
  const auto again = to_bytes(*edit);
  EXPECT_TRUE(again) << again.error().message;
  World world;
  if (!apply(world, *edit)) return;
  for (const auto& [id, geometry] : world.geometries()) (void)geometry.shape->bounds();
  (void)hash(world);
}

TEST(EditBytes, GiveBackEveryKindOfEditAndShape) {
  World one, other;
  std::set<std::size_t> kinds;
  for (const Edit& edit : every_edit()) {
    kinds.insert(edit.what.index());
    const std::string bytes = written(edit);
    const Edit back = read_back(bytes);
    EXPECT_EQ(back.what.index(), edit.what.index());
    EXPECT_EQ(written(back), bytes);
    EXPECT_EQ(written(edit), bytes);
    const Edit inverse = applied(one, edit);
    applied(other, back);
    ASSERT_EQ(hash(one), hash(other)) << "edit of kind " << edit.what.index();
    // What takes it back can be written, too.
    EXPECT_EQ(written(read_back(written(inverse))), written(inverse));
  }
  // No kind of shape of the world itself has changes of its own.
  const Edit amendment = AmendGeometry{{101}, std::string("\0change\xff", 8)};
  kinds.insert(amendment.what.index());
  EXPECT_EQ(std::get<AmendGeometry>(read_back(written(amendment)).what).change,
            std::get<AmendGeometry>(amendment.what).change);
  EXPECT_EQ(kinds.size(), std::variant_size_v<Edit::What>);
}

TEST(EditBytes, GiveBackWhatAWorldRefuses) {
  const ObjectId id{1};
  for (const Edit& edit : std::vector<Edit>{
           CreateGeometry{{1}, nullptr}, ReplaceGeometry{{1}, nullptr},
           CreateTexture{{1}, {"name", "type", nullptr}}, CreateObject{id, 7, {.children = {{2}, {3}}}},
           MoveVertices{{1}, {1, 2, 3}, {{0.0, 0.0, std::numeric_limits<double>::quiet_NaN()}}}}) {
    World one, other;
    const auto refused = apply(one, edit), refused_too = apply(other, read_back(written(edit)));
    ASSERT_FALSE(refused);
    ASSERT_FALSE(refused_too);
    EXPECT_EQ(refused.error().message, refused_too.error().message);
    EXPECT_EQ(written(read_back(written(edit))), written(edit));
  }
}

std::string recipe_read_back(const GeometryPointer& shape) {
  const Edit back = read_back(written(CreateGeometry{{1}, shape}));
  return std::string(recipe_of(*std::get<CreateGeometry>(back.what).shape));
}

TEST(EditBytes, GiveBackRecipes) {
  EXPECT_EQ(recipe_read_back(made_mesh()), recipe_of(*made_mesh()));
  EXPECT_EQ(recipe_read_back(made_mesh(std::string("\0{}\n", 4))), std::string("\0{}\n", 4));
  const std::string longest(kMostRecipeBytes, 'x');
  EXPECT_EQ(recipe_read_back(made_mesh(longest)), longest);
  expect_not_written(CreateGeometry{{1}, made_mesh(longest + "x")}, "1 MiB at most");
}

TEST(EditBytes, OfRecipesThatAreTooLongAreRefused) {
  std::string bytes = written(CreateGeometry{{1}, made_mesh(std::string(kMostRecipeBytes, 'x'))});
  const std::size_t text = bytes.find("xxxx");
  // Its length, and one letter more than it had: the zero behind the text.
  ASSERT_EQ(bytes.substr(text - 4, 4), std::string("\0\0\x10\0", 4));
  bytes[text - 4] = 1;
  bytes[text + kMostRecipeBytes] = 'x';
  const auto edit = edit_from_bytes(bytes, GeometryFactory());
  ASSERT_FALSE(edit);
  EXPECT_FALSE(edit.error().message.empty());
}

/// Bytes of a triangle as they were written before there were recipes.
TEST(EditBytes, OfMeshesWithoutRecipesStayWhatTheyWere) {
  const std::string bytes = *one_triangle()->write();
  EXPECT_EQ(bytes, *made_mesh("")->write());
  const auto back = read_mesh(bytes);
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(recipe_of(**back), "");
  EXPECT_EQ((*back)->hash(), one_triangle()->hash());
}

TEST(EditBytes, ReplayRandomEdits) {
  for (int seed = 0; seed < 200; ++seed) {
    World world, replayed;
    RandomEdits edits{std::uint64_t(seed)};
    for (int i = 0; i < 50; ++i) {
      const Edit edit = edits.next(world);
      const std::string bytes = written(edit);
      if (apply(world, edit)) applied(replayed, read_back(bytes));
    }
    ASSERT_EQ(hash(world), hash(replayed)) << seed;
  }
}

TEST(EditBytes, KeepMeshesOfACsgTreeShared) {
  const Edit back = read_back(written(CreateGeometry{{1}, csg()}));
  const auto& shape = dynamic_cast<const CsgGeometry&>(*std::get<CreateGeometry>(back.what).shape);
  using Solid = std::shared_ptr<const geometry::MeshSolid>;
  EXPECT_EQ(std::get<Solid>(*shape.tree.node(0).shape), std::get<Solid>(*shape.tree.node(1).shape));
  EXPECT_NE(std::get<Solid>(*shape.tree.node(0).shape), std::get<Solid>(*shape.tree.node(4).shape));
}

TEST(EditBytes, CanBeReadFromAnyAddress) {
  for (const Edit& edit : every_edit()) {
    const std::string bytes = written(edit);
    for (const std::size_t offset : {1, 4, 7}) {
      const std::string moved = std::string(offset, '-') + bytes;
      EXPECT_EQ(written(read_back(std::string_view(moved).substr(offset))), bytes);
    }
  }
}

TEST(EditBytes, ThatEndTooEarlyAreRefused) {
  for (const Edit& edit : every_edit()) {
    const std::string bytes = written(edit);
    for (std::size_t length = 0; length < bytes.size(); ++length)
      expect_edit_or_reason(std::string(bytes.data(), length));
  }
  expect_not_read("", "damaged");
  expect_not_read("This is not an edit, but a text that is long enough.", "something else");
}

TEST(EditBytes, ThatAreDamagedAreReadOrRefused) {
  std::vector<std::string> all;
  for (const Edit& edit : every_edit()) all.push_back(written(edit));
  base::Random random(3);
  for (int i = 0; i < 20000; ++i) {
    std::string bytes = all[random.index(all.size())];
    for (std::uint64_t flips = 1 + random.index(3); flips > 0; --flips)
      bytes[random.index(bytes.size())] ^= char(1 + random.index(255));
    expect_edit_or_reason(bytes);
  }
}

TEST(EditBytes, OfShapesThatCannotBeReadAreNotWritten) {
  const auto shaped = [](auto shape) {
    return CreateGeometry{{1}, std::make_shared<decltype(shape)>(std::move(shape))};
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  MeshGeometry mesh(tetrahedron());
  mesh.normals.resize(3);
  expect_not_written(shaped(mesh), "all of its triangles or for none");
  mesh.normals.assign(4, {Vector3::Constant(nan), Vector3::Zero(), Vector3::Zero()});
  expect_not_written(shaped(mesh), "finite");
  mesh.normals.clear();
  mesh.mesh.triangles[2][1] = 4;
  expect_not_written(shaped(mesh), "vertex that is not there");
  expect_not_written(shaped(LoopGeometry({tetrahedron(), {}, {4}})), "vertex that is not there");
  expect_not_written(shaped(LoopGeometry({tetrahedron(), {{0, 7}}, {}})), "vertex that is not there");
  expect_not_written(shaped(PrimitiveGeometry(geometry::Sphere{-1.0})), "between");
  expect_not_written(shaped(PrimitiveGeometry(geometry::Torus{1.0, nan})), "between");
}

geometry::CsgTree two_balls() {
  geometry::CsgTree tree;
  for (int i = 0; i < 2; ++i) tree.add_leaf(geometry::Primitive(geometry::Sphere{1.0}));
  return tree;
}

TEST(EditBytes, OfCsgTreesThatAreNoneAreNotWritten) {
  const auto expect_no_tree = [](const geometry::CsgTree& tree, const std::string& why) {
    expect_not_written(CreateGeometry{{1}, std::make_shared<CsgGeometry>(tree)}, why);
  };
  geometry::CsgTree tree = two_balls();
  tree.set_transform(1, Affine3(Eigen::Scaling(1.0, 0.0, 1.0)));
  expect_no_tree(tree, "flatten");
  tree.set_transform(1, Affine3(Eigen::Scaling(0.0)));
  expect_no_tree(tree, "flatten");
  tree = two_balls();
  tree.add(geometry::CsgOperator::Union, 0, 1);
  tree.add(geometry::CsgOperator::Union, 1, 2);
  expect_no_tree(tree, "once only");
  tree = two_balls();
  tree.add_leaf(std::make_shared<const geometry::MeshSolid>(geometry::TriangleMesh{}));
  expect_no_tree(tree, "needs triangles");
}

/// A primitive of one's own, which knows no way to bytes.
class Egg final : public geometry::CsgPrimitive {
 public:
  bool inside(const Vector3& point) const override { return point.norm() <= 1.0; }
  geometry::SurfacePoint scp_from_inside(const Vector3& point) const override { return {point, point}; }
  geometry::SurfacePoint scp_from_outside(const Vector3& point) const override { return {point, point}; }
  Bounds bounds() const override { return {Vector3::Constant(-1.0), Vector3::Constant(1.0)}; }
  geometry::TriangleMesh tessellate(double /*tolerance*/) const override { return tetrahedron(); }
  std::string name() const override { return "egg"; }
};

TEST(EditBytes, CannotHoldAPrimitiveOfOnesOwn) {
  geometry::CsgTree tree;
  tree.add_leaf(std::make_shared<const Egg>());
  expect_not_written(CreateGeometry{{1}, std::make_shared<CsgGeometry>(tree)}, "\"egg\" in a CSG tree");
}

/// A kind of shape of one's own: a row of posts.
struct Posts final : public Geometry {
  explicit Posts(int number) : count(number) {}
  int count;

  std::string_view kind() const override { return "posts"; }
  Bounds bounds() const override { return {Vector3::Zero(), Vector3(count, 1.0, 1.0)}; }
  std::uint64_t hash() const override { return std::uint64_t(count); }
  std::size_t bytes() const override { return sizeof(*this); }
  base::Result<std::shared_ptr<const MeshGeometry>> triangles(double) const override {
    return base::fail("Posts are only counted.");
  }
  base::Result<std::string> write() const override { return std::string(std::size_t(count), '|'); }
};

TEST(GeometryFactory, ReadsKindsOfOnesOwn) {
  GeometryFactory factory;
  const GeometryFactory::Reader reader = [](std::string_view bytes) -> base::Result<GeometryPointer> {
    if (bytes.find_first_not_of('|') != bytes.npos) return base::fail("These are no posts.");
    return std::make_shared<Posts>(int(bytes.size()));
  };
  ASSERT_TRUE(factory.add("posts", reader));
  EXPECT_FALSE(factory.add("posts", reader));
  EXPECT_FALSE(factory.add("mesh", reader));
  for (const int count : {0, 5}) {
    const std::string bytes = written(CreateGeometry{{1}, std::make_shared<Posts>(count)});
    const auto back = edit_from_bytes(bytes, factory);
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_EQ(std::get<CreateGeometry>(back->what).shape->hash(), std::uint64_t(count));
    EXPECT_EQ(written(*back), bytes);
  }
  std::string bytes = written(CreateGeometry{{1}, std::make_shared<Posts>(5)});
  bytes[bytes.find("||")] = '-';
  const auto broken = edit_from_bytes(bytes, factory);
  ASSERT_FALSE(broken);
  EXPECT_EQ(broken.error().message, "These are no posts.");
}

TEST(GeometryFactory, NamesAKindThatItDoesNotKnow) {
  expect_not_read(written(CreateGeometry{{1}, std::make_shared<Posts>(3)}), "\"posts\"");
}

Edit nested(int groups) {
  Edit edit = DeleteObject{{1}};
  for (int i = 0; i < groups; ++i) edit = EditGroup{{std::move(edit)}};
  return edit;
}

/// Writes edits as no EditWriter would, by the places of fields in edit.fbs.
class HostileWriter {
 public:
  using Table = flatbuffers::Offset<void>;

  Table edit(std::uint8_t kind, Table table) {
    const auto start = builder_.StartTable();
    builder_.AddOffset(6, table);
    builder_.AddElement<std::uint8_t>(4, kind, 0);
    return builder_.EndTable(start);
  }
  Table group(const std::vector<Table>& edits) {
    const auto vector = builder_.CreateVector(edits);
    const auto start = builder_.StartTable();
    builder_.AddOffset(4, vector);
    return edit(22, builder_.EndTable(start));
  }
  Table texture(std::size_t bytes) {
    const auto picture = builder_.CreateVector(std::vector<std::uint8_t>(bytes, 1));
    const auto start = builder_.StartTable();
    builder_.AddOffset(10, picture);
    return edit(15, builder_.EndTable(start));
  }
  std::string finished(Table root) {
    builder_.Finish(root, "EDIT");
    return {reinterpret_cast<const char*>(builder_.GetBufferPointer()), builder_.GetSize()};
  }

 private:
  flatbuffers::FlatBufferBuilder builder_;
};

TEST(EditBytes, NestGroupsSoDeepAndNoDeeper) {
  const std::string deepest = written(nested(kMostNestedGroups));
  EXPECT_EQ(written(read_back(deepest)), deepest);
  expect_not_written(nested(kMostNestedGroups + 1), "64 groups");
  for (const int groups : {64, 65, 100, 300, 100000}) {
    HostileWriter writer;
    auto edit = writer.group({});
    for (int i = 1; i < groups; ++i) edit = writer.group({edit});
    const std::string bytes = writer.finished(edit);
    if (groups == 64) {
      EXPECT_EQ(read_back(bytes).what.index(), std::variant_size_v<Edit::What> - 1);
    } else {
      expect_not_read(bytes, groups < 200 ? "64 groups" : "damaged");
    }
  }
}

TEST(EditBytes, ThatPointToOnePartAgainAndAgainAreRefused) {
  HostileWriter pictures;
  const std::vector<HostileWriter::Table> same(1000, pictures.texture(100000));
  expect_not_read(pictures.finished(pictures.group(same)), "more than they hold");

  HostileWriter doubled;  // 2^50 edits
  auto edit = doubled.group({});
  for (int i = 0; i < 50; ++i) edit = doubled.group({edit, edit});
  expect_not_read(doubled.finished(edit), "damaged");
}

}  // namespace
}  // namespace icome::world
