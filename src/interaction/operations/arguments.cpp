#include "interaction/operations/arguments.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "base/parse_number.h"
#include "interaction/operations/looks/colour_names.h"
#include "interaction/operations/near_names.h"

namespace icome::interaction {
namespace {

using base::fail;
using base::Result;
using Check = Result<void>;

/// The largest whole number that is taken as a count.
constexpr double kLargestCount = 9007199254740992.0;  // 2^53

bool is_whole(double number) { return number == std::floor(number) && std::abs(number) <= kLargestCount; }

/// The values that a parameter takes, in words: "a whole number".
std::string wanted(const Parameter& parameter) {
  switch (parameter.kind) {
    case ParameterKind::Flag:
      return "true or false";
    case ParameterKind::Number:
      return "a number";
    case ParameterKind::Count:
      return "a whole number";
    case ParameterKind::Text:
      return "a text";
    case ParameterKind::Texts:
      return "a text, or a list of texts";
    case ParameterKind::Picture:
      return "the name of a picture's file";
    case ParameterKind::Choice:
      return fmt::format("one of {}", fmt::join(parameter.choices, ", "));
    case ParameterKind::Colour:
      return "red, green and blue, each between 0 and 1, such as [1, 0.5, 0], or a text such as \"#ff8000\" "
             "or "
             "\"red\"";
    case ParameterKind::Vector:
      return "three numbers, such as [0, 0.1, 0]";
    case ParameterKind::Numbers:
      return "a list of numbers";
    case ParameterKind::Counts:
      return "a list of whole numbers";
    case ParameterKind::Points:
      return fmt::format("a list of points of {} numbers each", parameter.components);
    case ParameterKind::Object:
      return "the name of an object";
    case ParameterKind::Objects:
      return "the name of an object, or a list of such names";
    case ParameterKind::Records:
      return "a list of {named values}";
  }
  return {};
}

tl::unexpected<base::Error> not_wanted(const Parameter& parameter) {
  return fail(fmt::format("'{}' must be {}", parameter.name, wanted(parameter)));
}

Check check_range(const Parameter& parameter, double number) {
  if (number >= parameter.least && number <= parameter.most) return {};
  if (parameter.most == std::numeric_limits<double>::infinity())
    return fail(fmt::format("'{}' must be {:g} or more, not {:g}", parameter.name, parameter.least, number));
  if (parameter.least == -std::numeric_limits<double>::infinity())
    return fail(fmt::format("'{}' must be {:g} or less, not {:g}", parameter.name, parameter.most, number));
  return fail(fmt::format("'{}' must be between {:g} and {:g}, not {:g}", parameter.name, parameter.least,
                          parameter.most, number));
}

Check check_number(const Parameter& parameter, const Value& value, bool whole) {
  const double* number = value.number();
  if (!number || !std::isfinite(*number) || (whole && !is_whole(*number))) return not_wanted(parameter);
  return check_range(parameter, *number);
}

Check check_numbers(const Parameter& parameter, const Value& value, bool whole, std::size_t count) {
  const Value::List* list = value.list();
  if (!list || (count != 0 && list->size() != count)) return not_wanted(parameter);
  for (const Value& item : *list)
    if (auto good = check_number(parameter, item, whole); !good) return good;
  return {};
}

Check check_points(const Parameter& parameter, const Value& value) {
  const Value::List* list = value.list();
  if (!list) return not_wanted(parameter);
  for (const Value& point : *list)
    if (auto good = check_numbers(parameter, point, false, parameter.components); !good) return good;
  return {};
}

Check check_texts(const Parameter& parameter, const Value& value) {
  if (value.text()) return {};
  const Value::List* list = value.list();
  const auto is_text = [](const Value& item) { return item.text() != nullptr; };
  return list && !list->empty() && std::ranges::all_of(*list, is_text) ? Check() : not_wanted(parameter);
}

Check check_colour(const Parameter& parameter, const Value& value) {
  if (value.text()) {
    const auto colour = colour_from_text(*value.text());
    return colour ? Check() : tl::unexpected(colour.error());
  }
  const auto is_part = [](const Value& part) {
    return part.number() && *part.number() >= 0.0 && *part.number() <= 1.0;
  };
  const Value::List* parts = value.list();
  return parts && parts->size() == 3 && std::ranges::all_of(*parts, is_part) ? Check()
                                                                             : not_wanted(parameter);
}

/// Finds many objects by name, without a search through all objects for each of them.
class ObjectNames {
 public:
  explicit ObjectNames(const world::World& world) : world_(world) {
    for (const auto& [id, object] : world.objects()) {
      const auto [found, fresh] = by_name_.try_emplace(object.name, id);
      if (!fresh) found->second = {};  // several have it
    }
  }

  Result<world::ObjectId> find(const std::string& name) const {
    const bool may_be_more = name.starts_with('#') || name.find('/') != std::string::npos;
    const auto found = by_name_.find(name);
    if (!may_be_more && found != by_name_.end() && found->second) return found->second;
    return named_object(world_, name);
  }

 private:
  const world::World& world_;
  std::unordered_map<std::string_view, world::ObjectId> by_name_;
};

Check check_objects(const Parameter& parameter, const Value& value, const world::World& world) {
  const auto outcome = [](const Result<world::ObjectId>& found) {
    return found ? Check() : tl::unexpected(found.error());
  };
  if (value.text()) return outcome(named_object(world, *value.text()));
  const Value::List* list = value.list();
  if (parameter.kind == ParameterKind::Object || !list || list->empty()) return not_wanted(parameter);
  const ObjectNames names(world);
  for (const Value& name : *list) {
    if (!name.text()) return not_wanted(parameter);
    if (auto good = outcome(names.find(*name.text())); !good) return good;
  }
  return {};
}

Check check_records(const Parameter& parameter, const Value& value, const world::World& world) {
  const Value::List* list = value.list();
  if (!list) return not_wanted(parameter);
  for (std::size_t i = 0; i < list->size(); ++i) {
    if (!(*list)[i].fields()) return not_wanted(parameter);
    const auto record = Arguments::check(parameter.fields, *(*list)[i].fields(), world);
    if (!record)
      return fail(fmt::format("'{}', number {}: {}", parameter.name, i + 1, record.error().message));
  }
  return {};
}

Check check_value(const Parameter& parameter, const Value& value, const world::World& world) {
  switch (parameter.kind) {
    case ParameterKind::Flag:
      return value.flag() ? Check() : not_wanted(parameter);
    case ParameterKind::Number:
      return check_number(parameter, value, false);
    case ParameterKind::Count:
      return check_number(parameter, value, true);
    case ParameterKind::Text:
    case ParameterKind::Picture:
      return value.text() ? Check() : not_wanted(parameter);
    case ParameterKind::Texts:
      return check_texts(parameter, value);
    case ParameterKind::Choice:
      return value.text() && std::ranges::count(parameter.choices, *value.text()) > 0 ? Check()
                                                                                      : not_wanted(parameter);
    case ParameterKind::Colour:
      return check_colour(parameter, value);
    case ParameterKind::Vector:
      return check_numbers(parameter, value, false, 3);
    case ParameterKind::Numbers:
      return check_numbers(parameter, value, false, 0);
    case ParameterKind::Counts:
      return check_numbers(parameter, value, true, 0);
    case ParameterKind::Points:
      return check_points(parameter, value);
    case ParameterKind::Object:
    case ParameterKind::Objects:
      return check_objects(parameter, value, world);
    case ParameterKind::Records:
      return check_records(parameter, value, world);
  }
  return {};
}

const Parameter* parameter_named(const std::vector<Parameter>& parameters, std::string_view name) {
  const auto found = std::ranges::find(parameters, name, &Parameter::name);
  return found == parameters.end() ? nullptr : &*found;
}

/// The choice made for the first parameter, on which others may depend; empty where it is no Choice.
std::string chosen(const std::vector<Parameter>& parameters, const Value::Fields& said) {
  if (parameters.empty() || parameters.front().kind != ParameterKind::Choice) return {};
  const Value* value = field(said, parameters.front().name);
  if (!value) value = &parameters.front().fallback;
  return value->text() ? *value->text() : "";
}

bool is_for(const Parameter& parameter, const std::string& choice) {
  return parameter.only_for.empty() || std::ranges::count(parameter.only_for, choice) > 0;
}

Check check_known(const std::vector<Parameter>& parameters, const Value::Fields& said,
                  const std::string& choice) {
  for (const auto& [name, value] : said) {
    const Parameter* parameter = parameter_named(parameters, name);
    if (!parameter) {
      std::vector<std::string> names;
      for (const Parameter& known : parameters)
        if (is_for(known, choice)) names.push_back(known.name);
      return fail(fmt::format("there is no '{}'{}", name, suggestion(name, names)));
    }
    if (!is_for(*parameter, choice))
      return fail(fmt::format("'{}' is nothing that '{}' has; it is for {}", name, choice,
                              fmt::join(parameter->only_for, ", ")));
  }
  return {};
}

std::string path_of(const world::World& world, world::ObjectId id) {
  std::string path;
  for (const auto* object = world.find(id); object; object = world.find(object->parent))
    path = path.empty() ? object->name : object->name + "/" + path;
  return path;
}

/// "table/leg, table/seat, ...", so that people see what there is.
std::string some_paths(const world::World& world, const std::vector<world::ObjectId>& objects) {
  constexpr std::size_t kMostNames = 5;
  std::vector<std::string> paths;
  for (std::size_t i = 0; i < std::min(objects.size(), kMostNames); ++i)
    paths.push_back(fmt::format("'{}' (#{})", path_of(world, objects[i]), objects[i].value));
  return fmt::format("{}{}", fmt::join(paths, ", "), objects.size() > kMostNames ? " and others" : "");
}

/// Does the path name the object, by its own name at the end and the names of those above it before that?
bool ends_path(const world::World& world, const world::PhysicalObject& object, std::string_view path) {
  if (object.name == path) return true;
  if (object.name.empty() || !path.ends_with(object.name)) return false;
  path.remove_suffix(object.name.size());
  const world::PhysicalObject* parent = world.find(object.parent);
  return parent && path.ends_with('/') && ends_path(world, *parent, path.substr(0, path.size() - 1));
}

world::ObjectId numbered(const world::World& world, std::string_view name) {
  if (!name.starts_with('#')) return {};
  world::ObjectId id;
  id.value = base::parse_number<std::uint64_t>(name.substr(1)).value_or(id.value);
  return world.find(id) ? id : world::ObjectId();
}

}  // namespace

Result<Arguments> Arguments::check(const std::vector<Parameter>& parameters, const Value::Fields& fields,
                                   const world::World& world, PictureReader pictures) {
  if (!parameters.empty())
    if (const Value* first = field(fields, parameters.front().name))
      if (const auto good = check_value(parameters.front(), *first, world); !good)
        return tl::unexpected(good.error());
  const std::string choice = chosen(parameters, fields);
  if (const auto known = check_known(parameters, fields, choice); !known)
    return tl::unexpected(known.error());
  for (const Parameter& parameter : parameters) {
    const Value* value = field(fields, parameter.name);
    if (!value && parameter.required && is_for(parameter, choice))
      return fail(fmt::format("'{}' is missing: {}", parameter.name, parameter.meaning));
    if (!value) continue;
    if (const auto good = check_value(parameter, *value, world); !good) return tl::unexpected(good.error());
  }
  Arguments arguments;
  arguments.parameters_ = &parameters;
  arguments.given_ = &fields;
  arguments.world_ = &world;
  arguments.pictures_ = std::move(pictures);
  return arguments;
}

const Value* Arguments::find(std::string_view name) const {
  if (const Value* value = field(*given_, name)) return value;
  const Parameter* parameter = parameter_named(*parameters_, name);
  return parameter && !parameter->fallback.is_null() ? &parameter->fallback : nullptr;
}

const Value& Arguments::at(std::string_view name) const { return *find(name); }

bool Arguments::flag(std::string_view name) const { return *at(name).flag(); }
double Arguments::number(std::string_view name) const { return *at(name).number(); }
std::int64_t Arguments::count(std::string_view name) const { return std::int64_t(*at(name).number()); }
const std::string& Arguments::text(std::string_view name) const { return *at(name).text(); }

std::vector<std::string> Arguments::texts(std::string_view name) const {
  if (at(name).text()) return {text(name)};
  std::vector<std::string> texts;
  for (const Value& item : *at(name).list()) texts.push_back(*item.text());
  return texts;
}

world::Colour Arguments::colour(std::string_view name) const {
  if (const std::string* text = at(name).text()) return colour_from_text(*text).value_or(world::Colour{});
  const std::vector<double> parts = numbers(name);
  return {float(parts[0]), float(parts[1]), float(parts[2])};
}

Vector3 Arguments::vector(std::string_view name) const {
  const std::vector<double> parts = numbers(name);
  return {parts[0], parts[1], parts[2]};
}

std::vector<double> Arguments::numbers(std::string_view name) const {
  std::vector<double> numbers;
  for (const Value& item : *at(name).list()) numbers.push_back(*item.number());
  return numbers;
}

std::vector<std::uint32_t> Arguments::counts(std::string_view name) const {
  std::vector<std::uint32_t> counts;
  for (const Value& item : *at(name).list()) {
    // Numbers too large for an index become the largest, which names nothing: the operation says so.
    constexpr double kMost = std::numeric_limits<std::uint32_t>::max();
    counts.push_back(std::uint32_t(std::min(*item.number(), kMost)));
  }
  return counts;
}

std::vector<Vector2> Arguments::points2(std::string_view name) const {
  std::vector<Vector2> points;
  for (const Value& point : *at(name).list())
    points.emplace_back(*(*point.list())[0].number(), *(*point.list())[1].number());
  return points;
}

std::vector<Vector3> Arguments::points3(std::string_view name) const {
  std::vector<Vector3> points;
  for (const Value& point : *at(name).list())
    points.emplace_back(*(*point.list())[0].number(), *(*point.list())[1].number(),
                        *(*point.list())[2].number());
  return points;
}

world::ObjectId Arguments::object(std::string_view name) const {
  return named_object(*world_, *at(name).text()).value_or(world::ObjectId());
}

std::vector<world::ObjectId> Arguments::objects(std::string_view name) const {
  if (at(name).text()) return {object(name)};
  const ObjectNames names(*world_);
  std::vector<world::ObjectId> objects;
  std::unordered_set<world::ObjectId> taken;
  for (const Value& item : *at(name).list()) {
    const auto found = names.find(*item.text());
    if (found && taken.insert(*found).second) objects.push_back(*found);
  }
  return objects;
}

std::vector<Arguments> Arguments::records(std::string_view name) const {
  std::vector<Arguments> records;
  const Parameter* parameter = parameter_named(*parameters_, name);
  for (const Value& item : *at(name).list()) {
    Arguments record;
    record.parameters_ = &parameter->fields;
    record.given_ = item.fields();
    record.world_ = world_;
    record.pictures_ = pictures_;
    records.push_back(record);
  }
  return records;
}

Result<world::Texture> Arguments::picture(std::string_view name) const {
  if (!pictures_) return fail(fmt::format("'{}': no files are read here", name));
  return pictures_(text(name));
}

Result<world::ObjectId> named_object(const world::World& world, std::string_view name) {
  if (const world::ObjectId id = numbered(world, name)) return id;
  std::vector<world::ObjectId> found;
  for (const auto& [id, object] : world.objects())
    if (ends_path(world, object, name)) found.push_back(id);
  std::ranges::sort(found);
  if (found.size() == 1) return found.front();
  if (found.size() > 1)
    return fail(fmt::format("there are {} objects named '{}': {}; name one by its path or its number",
                            found.size(), name, some_paths(world, found)));
  std::vector<std::string> names;
  for (const auto& [id, object] : world.objects()) names.push_back(object.name);
  return fail(fmt::format("there is no object named '{}'{}", name, suggestion(name, names)));
}

}  // namespace icome::interaction
