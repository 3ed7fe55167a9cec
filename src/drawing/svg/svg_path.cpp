#include "drawing/svg/svg_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "drawing/svg/svg_scanner.h"
#include "io/text_scanner.h"

namespace icome::drawing {
namespace {

using base::Vector2;
using geometry::CubicBezier;

constexpr std::size_t kMostPathSegments = 10'000'000;
constexpr double kWidestArcPart = std::numbers::pi / 3.0;  // a cubic is off by 2.4e-5 of the radius there
constexpr double kSamePlace = 1e-9;  // of the coordinates: relative steps add up rounding

constexpr double radians_of(double degrees) { return degrees * std::numbers::pi / 180.0; }

/// Follows the commands of path data.
class SvgPathParser {
 public:
  explicit SvgPathParser(std::string_view data) : scanner_(data) {}
  SvgShape parse();

 private:
  std::optional<std::string> run(char command);
  bool draw(char command);
  bool draw_curve(char command);
  bool draw_arc();
  bool read(double& number) {
    const auto found = scanner_.number();
    number = found.value_or(0.0);
    return found.has_value();
  }
  bool read(Vector2& point);
  /// The last control point mirrored in the current point, where the last command was of that kind.
  Vector2 mirrored(char cubic_or_quadratic) const {
    return last_kind_ == cubic_or_quadratic ? Vector2(2.0 * builder_.current() - control_)
                                            : builder_.current();
  }
  std::string fault(char command);

  SvgScanner scanner_;
  SvgPathBuilder builder_;
  Vector2 origin_ = Vector2::Zero();  // the current point for relative commands, else zero
  Vector2 control_ = Vector2::Zero();
  char last_kind_ = '\0';  // C or Q behind a curve
};

bool SvgPathParser::read(Vector2& point) {
  if (!read(point.x()) || !read(point.y())) return false;
  point += origin_;
  return true;
}

bool SvgPathParser::draw_arc() {
  Vector2 radii, to;
  double turn = 0.0;
  if (!read(radii.x()) || !read(radii.y()) || !read(turn)) return false;
  const auto large = scanner_.flag(), sweep = scanner_.flag();
  if (!large || !sweep || !read(to)) return false;
  builder_.arc_to(radii, radians_of(turn), *large, *sweep, to);
  return true;
}

/// C, S, Q and T.
bool SvgPathParser::draw_curve(char command) {
  const bool is_cubic = command == 'C' || command == 'S';
  const char kind = is_cubic ? 'C' : 'Q';
  const bool is_smooth = command == 'S' || command == 'T';
  Vector2 first = mirrored(kind), second, to;
  if (!is_smooth && !read(first)) return false;
  if (is_cubic && !read(second)) return false;
  if (!read(to)) return false;
  if (is_cubic) builder_.cubic_to(first, second, to);
  if (!is_cubic) builder_.quadratic_to(first, to);
  control_ = is_cubic ? second : first;
  last_kind_ = kind;
  return true;
}

/// Draws one step of a command in upper case; false where its numbers are missing.
bool SvgPathParser::draw(char command) {
  if (std::string_view("CSQT").find(command) != std::string_view::npos) return draw_curve(command);
  last_kind_ = '\0';
  if (command == 'A') return draw_arc();
  Vector2 to = builder_.current();
  if (command == 'H' || command == 'V') {
    double& coordinate = command == 'H' ? to.x() : to.y();
    if (!read(coordinate)) return false;
    coordinate += command == 'H' ? origin_.x() : origin_.y();
  } else if (!read(to)) {
    return false;
  }
  if (command == 'M') builder_.move_to(to);
  if (command != 'M') builder_.line_to(to);
  return true;
}

std::string SvgPathParser::fault(char command) {
  const std::string_view word = scanner_.next_word();
  if (word.empty()) return fmt::format("the path data ends where a number of '{}' is expected", command);
  return fmt::format("{} stands in the path data where a number of '{}' is expected", io::quoted(word),
                     command);
}

/// Runs a command as often as numbers follow. Returns what is wrong, if anything.
std::optional<std::string> SvgPathParser::run(char letter) {
  const bool is_relative = letter >= 'a';
  char command = is_relative ? char(letter - 'a' + 'A') : letter;
  if (command == 'Z') {
    builder_.close();
    last_kind_ = '\0';
    return std::nullopt;
  }
  if (std::string_view("MLHVCSQTA").find(command) == std::string_view::npos)
    return fmt::format("the path data has no command '{}'", letter);
  do {
    origin_ = is_relative ? builder_.current() : Vector2::Zero();
    if (!draw(command)) return fault(letter);
    if (builder_.segment_count() > kMostPathSegments)
      return fmt::format("the path has more than {} segments", kMostPathSegments);
    if (command == 'M') command = 'L';  // more points behind a move are lines
  } while (!scanner_.at_end() &&
           std::string_view("0123456789+-.").find(scanner_.rest().front()) != std::string_view::npos);
  return std::nullopt;
}

SvgShape SvgPathParser::parse() {
  std::optional<std::string> fault;
  bool is_first = true;
  while (!fault && !scanner_.at_end()) {
    const char letter = scanner_.letter();
    if (letter == '\0')
      fault = io::quoted(scanner_.next_word()) + " stands in the path data where a command is expected";
    else if (std::exchange(is_first, false) && letter != 'M' && letter != 'm')
      fault = fmt::format("the path data begins with '{}'; it must begin with M", letter);
    else
      fault = run(letter);
  }
  return {builder_.take(), fault.value_or("")};
}

/// An ellipse by its centre, and the part of it that an arc runs through.
struct ArcPart {
  Eigen::Affine2d arc_from_circle;  // the unit circle
  double from, sweep;               // rad on the circle
};

/// SVG 2, appendix B.2.4. Precondition: radii above 0 and two places.
ArcPart centred(const Vector2& from, Vector2 radii, double turn, bool large, bool sweep, const Vector2& to) {
  const Eigen::Rotation2Dd rotation(turn);
  const Vector2 half = rotation.inverse() * ((from - to) / 2.0);
  const double need = std::hypot(half.x() / radii.x(), half.y() / radii.y());
  if (need > 1.0) radii *= need;
  // On the unit circle the chord has half the length `reach`; its middle lies off the centre.
  const Vector2 chord = half.cwiseQuotient(radii);
  const double reach = chord.norm();
  const double off = std::sqrt(std::max(0.0, 1.0 - reach * reach)) * (large == sweep ? -1.0 : 1.0);
  const Vector2 centre =
      reach > 0.0 ? Vector2(off / reach * Vector2(chord.y(), -chord.x())) : Vector2::Zero();
  const Vector2 start = chord - centre, end = -chord - centre;
  ArcPart part;
  part.from = std::atan2(start.y(), start.x());
  part.sweep = std::atan2(end.y(), end.x()) - part.from;
  constexpr double kTurn = 2.0 * std::numbers::pi;
  if (sweep && part.sweep < 0.0) part.sweep += kTurn;
  if (!sweep && part.sweep > 0.0) part.sweep -= kTurn;
  const Vector2 middle = (from + to) / 2.0 + rotation * centre.cwiseProduct(radii);
  part.arc_from_circle = Eigen::Translation2d(middle) * rotation * Eigen::Scaling(radii);
  return part;
}

}  // namespace

void SvgPathBuilder::append(const CubicBezier& segment) {
  if (!is_drawing_) {
    subpaths_.emplace_back();
    start_ = segment.points[0];
  }
  is_drawing_ = true;
  subpaths_.back().segments.push_back(segment);
  current_ = segment.points[3];
  ++segments_;
}

void SvgPathBuilder::move_to(const Vector2& to) {
  start_ = current_ = to;
  is_drawing_ = false;
  is_moved_ = true;
}

void SvgPathBuilder::line_to(const Vector2& to) { append(CubicBezier::line(current_, to)); }

void SvgPathBuilder::cubic_to(const Vector2& control1, const Vector2& control2, const Vector2& to) {
  append({{current_, control1, control2, to}});
}

void SvgPathBuilder::quadratic_to(const Vector2& control, const Vector2& to) {
  append({{current_, Vector2((current_ + 2.0 * control) / 3.0), Vector2((to + 2.0 * control) / 3.0), to}});
}

void SvgPathBuilder::arc_to(const Vector2& radii, double turn, bool large, bool sweep, const Vector2& to) {
  const Vector2 positive = radii.cwiseAbs();
  if (to == current_) return;
  if (!(positive.minCoeff() > 0.0)) return line_to(to);
  const ArcPart arc = centred(current_, positive, turn, large, sweep, to);
  if (!std::isfinite(arc.sweep) || !arc.arc_from_circle.matrix().allFinite()) return line_to(to);
  const int count = std::max(1, int(std::ceil(std::abs(arc.sweep) / kWidestArcPart - kSamePlace)));
  const double step = arc.sweep / count, handle = 4.0 / 3.0 * std::tan(step / 4.0);
  for (int i = 0; i < count; ++i) {
    const double a = arc.from + i * step, b = a + step;
    const Vector2 from(std::cos(a), std::sin(a)), end(std::cos(b), std::sin(b));
    const Vector2 control1 = arc.arc_from_circle * Vector2(from + handle * Vector2(-from.y(), from.x()));
    const Vector2 control2 = arc.arc_from_circle * Vector2(end - handle * Vector2(-end.y(), end.x()));
    cubic_to(control1, control2, i + 1 == count ? to : Vector2(arc.arc_from_circle * end));
  }
}

void SvgPathBuilder::close() {
  // A place that is closed at once is a dot (SVG 2, 11.4).
  if (!is_drawing_ && is_moved_) line_to(start_);
  if (!is_drawing_) return;
  const double size = std::max(start_.cwiseAbs().maxCoeff(), current_.cwiseAbs().maxCoeff());
  if ((current_ - start_).norm() > kSamePlace * size) line_to(start_);
  subpaths_.back().segments.back().points[3] = start_;
  subpaths_.back().closed = true;
  move_to(start_);
  is_moved_ = false;
}

std::vector<SvgSubpath> SvgPathBuilder::take() { return std::move(subpaths_); }

SvgShape parse_svg_path(std::string_view data) { return SvgPathParser(data).parse(); }

}  // namespace icome::drawing
