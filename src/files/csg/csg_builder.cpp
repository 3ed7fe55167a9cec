#include "files/csg/csg_builder.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <limits>
#include <string_view>
#include <utility>

#include "files/csg/csg_placement.h"
#include "files/csg/csg_shapes.h"
#include "io/byte_watch.h"

namespace icome::files {
namespace {

using geometry::Affine3;
using geometry::CsgTree;
using Index = CsgDocument::Index;
using Statement = CsgDocument::Statement;

constexpr std::size_t kMostRepairNotes = 20;

/// Things of one kind that are reported in one sentence, however many they are.
struct Tally {
  std::size_t count = 0;
  std::string_view first_name = {};
  std::size_t first_line = 0;

  void add(std::string_view name, std::size_t line) {
    if (count++ > 0) return;
    first_name = name;
    first_line = line;
  }
  /// Adds the sentence for one thing, or for several; both may hold {count}, {name} and {line}.
  void tell(std::vector<std::string>& notes, const char* one, const char* many) const {
    if (count == 0) return;
    notes.push_back(fmt::format(fmt::runtime(count == 1 ? one : many), fmt::arg("count", count),
                                fmt::arg("name", first_name), fmt::arg("line", first_line)));
  }
};

class PartGatherer {
 public:
  PartGatherer(const CsgDocument& document, std::size_t max_primitives, io::TimeBudget& time_budget)
      : document_(document), max_primitives_(max_primitives), time_budget_(time_budget) {}

  base::Result<CsgParts> run(std::vector<std::string>& notes);

 private:
  /// An operation whose operands are being examined.
  struct Operation {
    Index statement, end;
    CsgKeyword keyword;
    CsgVolume volume;  // LeftOut until its first operand is known
  };
  /// The effect of a multmatrix or color on all statements in it.
  struct Placement {
    Index end;
    Affine3 tree_from_here;
    bool flat = false;
    std::optional<CsgTree::Colour> colour;
  };

  bool lasts(Index index) {
    return index % 1024 == 0 ? time_budget_.lasts(double(index) / double(result_.end)) : time_budget_.lasts();
  }
  void choose_root();
  bool statement(Index index);
  bool left_out(Index index);
  void close_until(Index statement);
  void deliver(CsgVolume volume);
  void multmatrix(Index index);
  void color(Index index);
  void primitive(Index index, CsgKeyword keyword);
  void leaf(Index index, CsgPart part);
  base::Result<CsgPart> make(Index index, CsgKeyword keyword);
  void fail(Index index, const std::string& message) {
    error_ = document_.error_at(document_.statements()[index].offset, message);
  }
  /// To be called in the order of the text, so that all calls together take one pass.
  std::size_t line_of(Index index);
  void add(Tally& tally, Index index) {
    tally.add(document_.name(document_.statements()[index]), line_of(index));
  }
  void tell(std::vector<std::string>& notes) const;

  const CsgDocument& document_;
  std::size_t max_primitives_;
  io::TimeBudget& time_budget_;
  CsgShapes shapes_;
  CsgParts result_;
  std::vector<Operation> open_;
  std::vector<Placement> placements_;
  base::Error error_;

  CsgDocument::Offset counted_ = 0;
  std::size_t line_ = 1;
  Tally disabled_, background_, flat_, without_volume_, unknown_colours_, clamped_colours_, repaired_;
  std::vector<std::string> root_notes_, repair_notes_;
};

std::size_t PartGatherer::line_of(Index index) {
  const CsgDocument::Offset offset = document_.statements()[index].offset;
  line_ += document_.line_breaks(counted_, offset);
  counted_ = offset;
  return line_;
}

/// Finds the first statement marked '!' that is not disabled: as in OpenSCAD, it alone counts.
void PartGatherer::choose_root() {
  result_.end = static_cast<Index>(document_.statements().size());
  for (Index i = 0; i < result_.end;) {
    const Statement& statement = document_.statements()[i];
    const bool disabled = (statement.modifiers & CsgDocument::Disabled) != 0;
    if (!disabled && (statement.modifiers & CsgDocument::Root) != 0) {
      result_.begin = i;
      result_.end = statement.end;
      root_notes_.push_back(fmt::format("only {} in line {} counts, for it is marked '!'",
                                        document_.name(statement), line_of(i)));
      return;
    }
    i = disabled ? statement.end : i + 1;
  }
}

/// Is the statement marked as left out? A background part counts where it is the root itself.
bool PartGatherer::left_out(Index index) {
  const std::uint8_t modifiers = document_.statements()[index].modifiers;
  if ((modifiers & CsgDocument::Disabled) != 0) {
    add(disabled_, index);
    return true;
  }
  const bool is_root = index == result_.begin && (modifiers & CsgDocument::Root) != 0;
  if ((modifiers & CsgDocument::Background) == 0 || is_root) return false;
  add(background_, index);
  return true;
}

base::Result<CsgParts> PartGatherer::run(std::vector<std::string>& notes) {
  result_.parts.resize(document_.statements().size());
  choose_root();
  open_.push_back({0, result_.end, CsgKeyword::Union, CsgVolume::LeftOut});
  placements_.push_back({std::numeric_limits<Index>::max(), Affine3::Identity(), false, std::nullopt});
  for (Index i = result_.begin; i < result_.end;) {
    if (!lasts(i)) return tl::unexpected(io::interruption());
    close_until(i);
    const bool skip = left_out(i);
    if (!skip && !statement(i)) return tl::unexpected(error_);
    i = skip ? document_.statements()[i].end : i + 1;
  }
  close_until(result_.end);
  tell(notes);
  return std::move(result_);
}

/// Closes the operations and placements that end before this statement.
void PartGatherer::close_until(Index statement) {
  while (open_.size() > 1 && open_.back().end <= statement) {
    const Operation closed = open_.back();
    open_.pop_back();
    const CsgVolume volume = closed.volume == CsgVolume::Some ? CsgVolume::Some : CsgVolume::None;
    result_.parts[closed.statement].volume = volume;
    deliver(volume);
  }
  while (placements_.back().end <= statement) placements_.pop_back();
}

/// Gives the innermost open operation its next operand.
void PartGatherer::deliver(CsgVolume operand) {
  Operation& operation = open_.back();
  const bool first = operation.volume == CsgVolume::LeftOut;
  const bool decides = operation.keyword == CsgKeyword::Intersection ? operand == CsgVolume::None
                       : operation.keyword == CsgKeyword::Difference ? false
                                                                     : operand == CsgVolume::Some;
  if (first || decides) operation.volume = operand;
}

bool PartGatherer::statement(Index index) {
  const Statement& statement = document_.statements()[index];
  const std::string_view name = document_.name(statement);
  const CsgKeyword keyword = csg_keyword(name);
  result_.parts[index].keyword = keyword;
  if (keyword == CsgKeyword::Inexact || keyword == CsgKeyword::Unknown) {
    fail(index, refusal(name, keyword));
  } else if (is_primitive(keyword)) {
    primitive(index, keyword);
  } else {
    open_.push_back({index, statement.end, keyword, CsgVolume::LeftOut});
    if (keyword == CsgKeyword::Multmatrix) multmatrix(index);
    if (keyword == CsgKeyword::Color) color(index);
  }
  return error_.message.empty();
}

void PartGatherer::multmatrix(Index index) {
  const auto matrix = read_matrix(document_, index);
  if (!matrix) {
    error_ = matrix.error();
    return;
  }
  Placement placement = placements_.back();
  placement.end = document_.statements()[index].end;
  placement.tree_from_here = placement.tree_from_here * *matrix;
  if (!placement.tree_from_here.matrix().allFinite())
    return fail(index, "this matrix and those around it multiply to numbers that are too large");
  if (!placement.flat && flattens(placement.tree_from_here)) {
    placement.flat = true;
    add(flat_, index);
  }
  placements_.push_back(placement);
}

void PartGatherer::color(Index index) {
  const auto read = read_colour(document_, index);
  if (!read) {
    error_ = read.error();
    return;
  }
  if (read->unknown_name) add(unknown_colours_, index);
  if (read->clamped) add(clamped_colours_, index);
  Placement placement = placements_.back();
  placement.end = document_.statements()[index].end;
  if (!placement.colour) placement.colour = read->colour;  // the outermost colour counts, as in OpenSCAD
  placements_.push_back(placement);
}

base::Result<CsgPart> PartGatherer::make(Index index, CsgKeyword keyword) {
  switch (keyword) {
    case CsgKeyword::Cube:
      return shapes_.cube(document_, index);
    case CsgKeyword::Sphere:
      return shapes_.sphere(document_, index);
    case CsgKeyword::Cylinder:
      return shapes_.cylinder(document_, index);
    default:
      return read_polyhedron(document_, index, time_budget_);
  }
}

void PartGatherer::primitive(Index index, CsgKeyword keyword) {
  const Statement& statement = document_.statements()[index];
  if (statement.end > index + 1)
    return fail(index + 1,
                fmt::format("'}}' is expected: {} takes nothing between braces", document_.name(statement)));
  auto part = make(index, keyword);
  if (!part) {
    error_ = part.error();
    return;
  }
  if (!part->notes.empty()) {
    add(repaired_, index);
    if (repair_notes_.size() < kMostRepairNotes) {
      repair_notes_.push_back(fmt::format("the polyhedron in line {} was put right: {}", line_of(index),
                                          fmt::join(part->notes, ", ")));
    }
  }
  const bool solid = part->shape.has_value() && !placements_.back().flat;
  if (!part->shape) add(without_volume_, index);
  if (solid) leaf(index, std::move(*part));
  result_.parts[index].volume = solid ? CsgVolume::Some : CsgVolume::None;
  deliver(result_.parts[index].volume);
}

void PartGatherer::leaf(Index index, CsgPart part) {
  const Placement& around = placements_.back();
  const Affine3 tree_from_shape = around.tree_from_here * Eigen::Translation3d(part.centre);
  const geometry::Bounds box = geometry::shape_bounds(*part.shape, tree_from_shape);
  const double farthest =
      kMillimetresPerMetre * box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).maxCoeff();
  const double longest = kMillimetresPerMetre * box.sizes().maxCoeff();
  const std::string_view name = document_.name(document_.statements()[index]);
  if (!(farthest <= kLargestSize)) {
    fail(index, fmt::format("{} reaches {:.3g} mm from the origin; {:.0g} mm is as far as can be touched",
                            name, farthest, kLargestSize));
  } else if (longest < kSmallestSize) {
    fail(index, fmt::format("{} is {:.3g} mm large where it stands; {:.0g} mm is the least", name, longest,
                            kSmallestSize));
  } else if (result_.leaves.size() == max_primitives_) {
    fail(index, fmt::format("there are more than {} primitives: use a simpler model", max_primitives_));
  } else {
    result_.leaves.push_back({index, std::move(*part.shape), tree_from_shape, around.colour});
  }
}

void PartGatherer::tell(std::vector<std::string>& notes) const {
  notes.insert(notes.end(), root_notes_.begin(), root_notes_.end());
  disabled_.tell(
      notes, "{name} in line {line} is left out, for it is disabled by '*'",
      "{count} parts are left out, for they are disabled by '*': the first is {name} in line {line}");
  background_.tell(
      notes, "{name} in line {line} is left out, for '%' makes it background",
      "{count} parts are left out, for '%' makes them background: the first is {name} in line {line}");
  without_volume_.tell(notes, "{name} in line {line} has no volume: it is empty",
                       "{count} shapes have no volume, they are empty: the first is {name} in line {line}");
  flat_.tell(notes, "{name} in line {line} leaves no volume: what is in it is empty",
             "{count} matrices leave no volume, what is in them is empty: the first is in line {line}");
  unknown_colours_.tell(
      notes, "{name} in line {line} has a name that is not known: it does not count",
      "{count} colours have names that are not known, they do not count: the first is in line {line}");
  clamped_colours_.tell(notes, "{name} in line {line} goes beyond 1: it is cut to it",
                        "{count} colours go beyond 1, they are cut to it: the first is in line {line}");
  notes.insert(notes.end(), repair_notes_.begin(), repair_notes_.end());
  if (repaired_.count > repair_notes_.size())
    notes.push_back(fmt::format("{} more polyhedra were put right", repaired_.count - repair_notes_.size()));
}

}  // namespace

base::Result<CsgParts> gather_parts(const CsgDocument& document, std::size_t max_primitives,
                                    std::vector<std::string>& notes, io::TimeBudget& time_budget) {
  return PartGatherer(document, max_primitives, time_budget).run(notes);
}

}  // namespace icome::files
