#include "apps/csg/csg_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "apps/csg/csg_options.h"
#include "apps/touch/touch_report.h"

namespace icome::apps {
namespace {

using Json = nlohmann::ordered_json;
using geometry::CsgTree;

Json json_of(const base::Vector3& v) { return {v.x(), v.y(), v.z()}; }

std::string several(std::size_t count, const char* thing) {
  return fmt::format("{} {}{}", grouped(count), thing, count == 1 ? "" : "s");
}

std::string millimetres(const base::Vector3& metres) {
  const base::Vector3 mm = metres * 1e3;
  return fmt::format("{:.6g}, {:.6g}, {:.6g}", mm.x(), mm.y(), mm.z());
}

std::string duration(double seconds) {
  return seconds < 1.0 ? fmt::format("{:.3g} ms", 1e3 * seconds) : fmt::format("{:.2f} s", seconds);
}

/// A row of the table; one without a label continues the one before.
std::string row(const char* label, const std::string& value) {
  return fmt::format("  {:<14}{}\n", label, value);
}

std::string form_text(const CsgFigures& figures) {
  if (figures.form == geometry::CsgForm::Tree) return "tree, as it was read";
  std::string text = fmt::format("{}: {}", name(figures.form), several(figures.form_counted.nodes, "node"));
  if (figures.form == geometry::CsgForm::Normal) text += ", " + several(figures.products, "product");
  return fmt::format("{}, {} pruned, made in {}", text, several(figures.pruned, "node"),
                     duration(figures.form_seconds));
}

}  // namespace

std::size_t count_products(const CsgTree& tree) {
  if (tree.empty()) return 0;
  std::size_t products = 0;
  std::vector<CsgTree::Index> open{tree.root()};
  while (!open.empty()) {
    const CsgTree::Node& node = tree.node(open.back());
    open.pop_back();
    if (!node.is_leaf && node.op == geometry::CsgOperator::Union) {
      open.push_back(node.left);
      open.push_back(node.right);
    } else {
      ++products;
    }
  }
  return products;
}

std::string json_report(const CsgFigures& figures) {
  Json report;
  report["file"] = figures.file;
  report["nodes"] = figures.counted.nodes;
  report["primitives"] = figures.counted.primitives;
  report["depth"] = figures.counted.depth;
  report["form"] = name(figures.form);
  report["form_nodes"] = figures.form_counted.nodes;
  report["pruned"] = figures.pruned;
  report["products"] = figures.form == geometry::CsgForm::Normal ? Json(figures.products) : Json(nullptr);
  report["bounds"] = nullptr;
  if (!figures.bounds.isEmpty())
    report["bounds"] = {{"min", json_of(figures.bounds.min())}, {"max", json_of(figures.bounds.max())}};
  report["read_seconds"] = figures.read_seconds;
  report["form_seconds"] = figures.form_seconds;
  report["notes"] = figures.notes;
  if (figures.mesh) {
    report["mesh"] = {{"file", figures.mesh->file.string()},
                      {"triangles", figures.mesh->triangles},
                      {"cell", figures.mesh->cell},
                      {"error", figures.mesh->error}};
  }
  if (figures.inside) report["inside"] = *figures.inside;
  // A million points are better on one line. Names of files may hold bytes that are not UTF-8.
  return report.dump(figures.inside ? -1 : 2, ' ', false, Json::error_handler_t::replace);
}

std::string mesh_text(const CsgFigures::Mesh& mesh) {
  return fmt::format("{}: {}, at most {} off the surface, cells of {}", mesh.file.string(),
                     several(mesh.triangles, "triangle"), length_text(mesh.error), length_text(mesh.cell));
}

std::string text_report(const CsgFigures& figures) {
  std::string text = row("solid", figures.file);
  text += row("", fmt::format("{}, {}, depth {}", several(figures.counted.primitives, "primitive"),
                              several(figures.counted.nodes, "node"), grouped(figures.counted.depth)));
  for (const std::string& note : figures.notes) text += row("", note);
  text += row("", "read in " + duration(figures.read_seconds));
  text += row("form", form_text(figures));
  if (figures.bounds.isEmpty()) {
    text += row("bounds", "none: the solid is empty");
  } else {
    text += row("bounds", fmt::format("{} to {} mm", millimetres(figures.bounds.min()),
                                      millimetres(figures.bounds.max())));
  }
  if (figures.mesh) text += row("mesh", mesh_text(*figures.mesh));
  return text;
}

}  // namespace icome::apps
