// Texts that people write: formulas, scripts of operations, study files, elements.
#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>

#include "apps/design/edit_script.h"
#include "fuzz/harness.h"
#include "geometry/implicit/formula.h"
#include "geometry/implicit/plain_formula.h"
#include "interaction/elements/element_file.h"
#include "interaction/elements/element_layout.h"
#include "places.h"
#include "study/definition/study_reader.h"

namespace icome::fuzz {
namespace {

std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Sweeps trust ranges, so these hold all values that there are.
void require_within(const geometry::Formula& formula, const geometry::Formula::Range& range,
                    const base::Vector3& point, double time) {
  const double value = formula.value(point, time);
  require(std::isnan(value) || range.value.contains(value), "ranges hold the values");
  require(!range.total || std::isfinite(value), "what is surely defined has a value");
  require(!range.never || std::isnan(value), "what is surely undefined has none");
}

void run_formula(std::string_view bytes) {
  const std::string text(bytes);
  const auto formula = geometry::Formula::parse(text);
  if (!formula) return require_told(formula.error());
  require(geometry::plain_formula(text).has_value(), "what is a formula is one to the judge");
  constexpr double kTime = 0.5;
  for (const double half : {0.0, 0.1, 3.0}) {
    const base::Vector3 middle(0.3, -0.2, 0.0);
    const auto side = [&](double at) { return geometry::Interval{at - half, at + half}; };
    const geometry::Formula::Box4 box = {
        side(middle.x()), side(middle.y()), side(middle.z()), {kTime, kTime}};
    const geometry::Formula::Range range = formula->range(box);
    for (const double share : {-1.0, -0.3, 0.0, 0.7, 1.0})
      require_within(*formula, range, middle + half * base::Vector3(share, share * share, -share), kTime);
    (void)formula->bend_range(box);
  }
  (void)formula->bend(base::Vector3::Zero(), kTime);
}

void run_script(std::string_view bytes) {
  interaction::OperationRunner runner{world::World()};
  const auto perform = [&](const interaction::Value& command, std::size_t) {
    return runner.perform(command);
  };
  const apps::EditOutcome outcome = apps::perform_script(perform, bytes, true, [](double) { return true; });
  for (const apps::EditError& error : outcome.errors)
    require(!error.message.empty(), "an error says what it is");
}

void run_study(std::string_view bytes) {
  const auto study = study::read_study(bytes, "f");
  if (!study) require_told(study.error());
}

void run_element(std::string_view bytes) {
  const auto element = interaction::read_element(bytes, "f");
  if (!element) return require_told(element.error());
  const auto measure = [](const std::string& text) { return 0.8 * double(text.size()); };
  const auto layout = interaction::lay_out(*element, 0, measure);
  const bool shows_all =
      element->rows == 0 && std::ranges::none_of(element->widgets, [](const interaction::Widget& it) {
        return it.kind == interaction::WidgetKind::List || it.kind == interaction::WidgetKind::Tabs;
      });
  require(!shows_all || layout.widgets.size() == element->widgets.size(), "every widget has its place");
  for (const interaction::LaidWidget& laid : layout.widgets)
    require(laid.centre.allFinite() && laid.half.allFinite(), "places are finite");
}

std::vector<std::string> formula_seeds() {
  return {"x^2 + y^2 + z^2 - 0.0025",
          "z - 0.005*sin(60*x + 3*t)*cos(60*y)",
          "max(abs(x), abs(y), abs(z)) - 0.03",
          "if(x < 0.01 && y > 0 || !(z >= 1), z, z + 0.02)",
          "atan2(y, x)/sqrt(log10(hypot(x, y))) - exp(-pi)",
          "min(1e-3, 2^-x^3, pow(x, 2.5)) - tanh(asin(acos(e)))"};
}
std::vector<std::string> script_seeds() {
  std::vector<std::string> all;
  for (const char* name : {"sheet", "stairs", "tables", "torus-and-cone"})
    all.push_back(text_of(places::project_folder() / "examples" / (std::string(name) + ".jsonl")));
  return all;
}
std::vector<std::string> study_seeds() {
  std::vector<std::string> all;
  for (const char* name : {"blank", "head-tracking", "menu-selection"})
    all.push_back(text_of(places::project_folder() / "data" / "studies" / (std::string(name) + ".toml")));
  return all;
}

std::vector<std::string> element_seeds() {
  std::vector<std::string> all;
  for (const char* name : {"colours", "modelling", "clear", "properties"})
    all.push_back(text_of(places::project_folder() / "data" / "menus" / (std::string(name) + ".toml")));
  return all;
}

constexpr std::array<Harness, 4> kText{{{"formula", run_formula, formula_seeds},
                                        {"script", run_script, script_seeds},
                                        {"study", run_study, study_seeds},
                                        {"element", run_element, element_seeds}}};

}  // namespace

std::span<const Harness> text_harnesses() { return kText; }

}  // namespace icome::fuzz
