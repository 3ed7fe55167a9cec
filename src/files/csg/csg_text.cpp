#include "files/csg/csg_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/parse_number.h"
#include "io/number_text.h"
#include "io/text_scanner.h"
#include "world/shape/geometry_check.h"

namespace icome::files {
namespace {

using base::Affine3;
using base::Result;
using geometry::CsgOperator;
using geometry::CsgTree;
using geometry::MeshSolid;
using geometry::Vector3;

// A node takes some 200 bytes and may come from ten bytes of text.
constexpr std::size_t kMostNodes = 10'000'000;
constexpr std::string_view kOperators[] = {"union", "intersection", "difference"};

tl::unexpected<base::Error> too_many() {
  return base::fail(
      fmt::format("A CSG tree of more than {} nodes is too large to be kept as text: split it "
                  "into several objects.",
                  kMostNodes));
}

/// Equal to the last bit: zeros with different signs differ.
template <typename Matrix>
bool same_bits(const Matrix& one, const Matrix& other) {
  return std::memcmp(one.data(), other.data(), sizeof(double) * std::size_t(one.size())) == 0;
}

/// Upper bound of the lines, each of which may hold a node.
std::size_t most_lines(std::string_view text) {
  return 1 +
         std::size_t(std::count_if(text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }));
}

class CsgTextWriter {
 public:
  Result<std::string> write(const CsgTree& tree) {
    if (tree.size() > kMostNodes) return too_many();
    if (tree.empty()) return "# nothing\n";
    world::CsgNodeCheck check(tree.size());
    for (CsgTree::Index i = 0; i < tree.size(); ++i) {
      const CsgTree::Node& node = tree.node(i);
      if (std::string why = check.complaint(i, node); !why.empty()) return base::fail(std::move(why));
      if (node.is_leaf) {
        if (const auto named = add_shape(*node.shape); !named) return tl::unexpected(named.error());
      } else {
        text_ += kOperators[std::size_t(node.op)];
        add(node.left);
        add(node.right);
      }
      add_rest(node);
    }
    if (!tree.empty() && tree.root() + 1 != tree.size()) {
      text_ += "root";
      add(tree.root());
      text_ += '\n';
    }
    return std::move(text_);
  }

 private:
  template <typename Number>
  void add(Number number) {
    text_ += ' ';
    io::append_number(text_, number);
  }

  Result<void> add_shape(const geometry::CsgShape& shape) {
    if (const auto* primitive = std::get_if<geometry::Primitive>(&shape)) {
      text_ += geometry::name(*primitive);
      return {};
    }
    const auto* solid = std::get_if<std::shared_ptr<const MeshSolid>>(&shape);
    if (!solid)
      return base::fail(fmt::format("A CSG tree with the primitive \"{}\" of one's own has no text.",
                                    geometry::shape_name(shape)));
    const auto [found, fresh] = meshes_.try_emplace(solid->get(), std::uint32_t(meshes_.size()));
    if (fresh) define(found->second, (*solid)->mesh);
    text_ += "mesh";
    add(found->second);
    return {};
  }

  void define(std::uint32_t number, const geometry::TriangleMesh& mesh) {
    text_ += "define mesh";
    add(number);
    for (const Vector3& position : mesh.positions) {
      text_ += "\nvertex";
      for (const double coordinate : position) add(coordinate);
    }
    for (const auto& triangle : mesh.triangles) {
      text_ += "\ntriangle";
      for (const std::uint32_t vertex : triangle) add(vertex);
    }
    text_ += '\n';
  }

  void add_rest(const CsgTree::Node& node) {
    const Affine3& frame = node.parent_from_node;
    const base::Matrix3 turn = frame.linear();
    const Vector3 shift = frame.translation();
    if (!same_bits<base::Matrix3>(turn, base::Matrix3::Identity())) {
      text_ += " matrix";
      for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 4; ++column) add(frame(row, column));
      }
    } else if (!same_bits<Vector3>(shift, Vector3::Zero())) {
      text_ += " move";
      for (const double part : shift) add(part);
    }
    if (node.colour) {
      text_ += " colour";
      for (const float part : *node.colour) add(part);
    }
    text_ += '\n';
  }

  std::string text_;
  std::unordered_map<const MeshSolid*, std::uint32_t> meshes_;
};

/// Reads line after line; after the first failure the scanner gives nothing more.
class CsgTextReader {
 public:
  explicit CsgTextReader(std::string_view text)
      : scanner_(text, "CSG tree", io::TextScanner::Lines::Matter, '#'), check_(most_lines(text)) {}

  Result<CsgTree> read() {
    while (!scanner_.at_end()) {
      statement(scanner_.word());
      if (scanner_.more_on_line()) scanner_.fail(io::quoted(scanner_.word()) + " is too much on this line");
    }
    if (scanner_.failed()) return tl::unexpected(scanner_.error());
    if (root_) tree_.set_root(*root_);
    return std::move(tree_);
  }

 private:
  void statement(std::string_view word) {
    if (word == "vertex") return vertex();
    if (word == "triangle") return triangle();
    finish_mesh();
    if (word == "define") return define();
    if (word == "root") return root();
    if (root_) return scanner_.fail("Nothing may follow the root");
    node(word);
  }

  void define() {
    if (scanner_.word() != "mesh" || scanner_.integer("the number of a mesh") != std::int64_t(meshes_.size()))
      return scanner_.fail(fmt::format("\"define mesh {}\" is expected", meshes_.size()));
    defined_.emplace();
  }
  void vertex() {
    if (!defined_) return scanner_.fail("A vertex must follow \"define mesh\"");
    Vector3& position = defined_->positions.emplace_back();
    for (double& coordinate : position) coordinate = scanner_.number("a coordinate");
  }
  void triangle() {
    if (!defined_) return scanner_.fail("A triangle must follow \"define mesh\"");
    auto& corners = defined_->triangles.emplace_back();
    for (std::uint32_t& corner : corners)
      corner = index("the number of a vertex", defined_->positions.size());
  }
  /// Ends the mesh being read, as another statement begins.
  void finish_mesh() {
    if (!defined_) return;
    std::string why = world::complaint(*defined_);
    if (why.empty() && defined_->triangles.empty()) why = "A mesh in a CSG tree needs triangles";
    if (!why.empty()) return scanner_.fail(why);
    meshes_.push_back(std::make_shared<const MeshSolid>(std::move(*defined_)));
    defined_.reset();
  }

  void root() {
    if (root_) return scanner_.fail("A CSG tree has one root only");
    root_ = index("the number of a node", tree_.size());
  }

  void node(std::string_view word) {
    if (tree_.size() == kMostNodes) return scanner_.fail(too_many().value().message);
    CsgTree::Node made;
    const auto* op = std::find(std::begin(kOperators), std::end(kOperators), word);
    if (op != std::end(kOperators)) {
      made.op = CsgOperator(op - std::begin(kOperators));
      made.left = index("the number of a node", tree_.size());
      made.right = index("the number of a node", tree_.size());
    } else {
      made.is_leaf = true;
      made.shape = shape(word);
    }
    rest(made);
    if (scanner_.failed()) return;
    if (const std::string why = check_.complaint(CsgTree::Index(tree_.size()), made); !why.empty())
      return scanner_.fail(why);
    if (made.is_leaf)
      tree_.add_leaf(*made.shape, made.parent_from_node, made.colour);
    else
      tree_.add(made.op, made.left, made.right, made.parent_from_node);
  }

  geometry::CsgShape shape(std::string_view word) {
    if (word == "mesh") {
      const std::uint32_t number = index("the number of a mesh", meshes_.size());
      if (!scanner_.failed()) return meshes_[number];
      return geometry::Plane{};
    }
    constexpr std::size_t kLongest = 200;  // three numbers, and errors of a readable length
    const auto primitive = geometry::parse_primitive(word.substr(0, kLongest));
    if (primitive) return *primitive;
    scanner_.fail(primitive.error().message);
    return geometry::Plane{};
  }

  void rest(CsgTree::Node& made) {
    bool placed = false;
    while (scanner_.more_on_line()) {
      const std::string_view word = scanner_.word();
      if (word == "move" && !placed) {
        for (int i = 0; i < 3; ++i) made.parent_from_node(i, 3) = scanner_.number("a length");
        placed = true;
      } else if (word == "matrix" && !placed) {
        for (int i = 0; i < 12; ++i) made.parent_from_node(i / 4, i % 4) = scanner_.number("a number");
        placed = true;
      } else if (word == "colour" && made.is_leaf && !made.colour) {
        made.colour.emplace();
        for (float& part : *made.colour) part = colour_part();
      } else {
        return scanner_.fail(io::quoted(word) + " is not expected here");
      }
    }
  }

  /// A part of a colour, not read by way of a double: it would be rounded twice.
  float colour_part() {
    const std::string_view word = scanner_.word();
    const auto part = base::parse_number<float>(word);
    if (!part)
      scanner_.fail(fmt::format("A colour needs four numbers, red, green, blue and alpha, but there is {}",
                                io::quoted(word)));
    return part.value_or(0.0F);
  }

  std::uint32_t index(const char* what, std::size_t count) {
    const std::int64_t number = scanner_.integer(what);
    if (number >= 0 && std::size_t(number) < count) return std::uint32_t(number);
    scanner_.fail(fmt::format("{} is not {}: there are {} so far", number, what, count));
    return 0;
  }

  io::TextScanner scanner_;
  world::CsgNodeCheck check_;
  std::vector<std::shared_ptr<const MeshSolid>> meshes_;
  std::optional<geometry::TriangleMesh> defined_;  // the mesh whose lines are being read
  CsgTree tree_;
  std::optional<CsgTree::Index> root_;
};

}  // namespace

Result<std::string> csg_text(const CsgTree& tree) { return CsgTextWriter().write(tree); }

Result<CsgTree> csg_from_text(std::string_view text) { return CsgTextReader(text).read(); }

}  // namespace icome::files
