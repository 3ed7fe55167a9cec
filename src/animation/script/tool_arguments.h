#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "animation/script/animation_tool.h"

namespace icome::animation {

using interaction::Parameter;
using interaction::ParameterKind;

constexpr double kDegree = 0.017453292519943295;  // rad

// Parameters that several tools have.
Parameter cell_parameter(const char* name, const char* meaning, bool required = true);
Parameter cells_parameter(bool required);
Parameter layer_parameter(bool required = true);
Parameter frame_parameter(const char* name, const char* meaning, bool required = true);
Parameter place_parameter(const char* name, const char* meaning, bool required = false);
Parameter number_parameter(const char* name, const char* meaning, double least, double most);
Parameter text_parameter(const char* name, const char* meaning, bool required = true);
Parameter channels_parameter();
Parameter ease_parameter();

/// The cell of that name, which may be changed if `to_change`. Fails with names that come near, and where its
/// layer is locked.
base::Result<const Cell*> cell_named(const Project& project, const std::string& name, bool to_change = true);
base::Result<const Cell*> cell_of(const Staging& staging, const Arguments& arguments, bool to_change = true);
/// The named cells; all that may be changed where none are named.
base::Result<std::vector<const Cell*>> meant_cells(const Staging& staging, const Arguments& arguments);
/// The layer of that name.
base::Result<const Layer*> layer_named(const Project& project, const std::string& name);
/// The place of two numbers.
base::Result<Vector2> place_of(const Arguments& arguments, std::string_view name);
/// The channels that are named; all where none are.
base::Result<std::vector<Channel>> channels_of(const Arguments& arguments);
Ease ease_of(const Arguments& arguments);
int frame_of(const Arguments& arguments, std::string_view name);

/// The keys of one channel of a cell in some frames; there is one at least.
struct KeyRange {
  const Cell* cell;
  Channel channel;
  int from, to;  // frames, both included
  Track keys;
};
/// "cells", "from", "to" and "channels", and what else a tool needs; and the keys that they mean.
std::vector<Parameter> range_parameters(const std::vector<Parameter>& more);
base::Result<std::vector<KeyRange>> ranges_of(const Staging& staging, const Arguments& arguments);
/// The edit that puts what `change` makes of their keys in the place of each of these.
base::Result<ProjectEdit> for_each_track(const Staging& staging, const Arguments& arguments,
                                         const std::function<Track(Track keys)>& change);

/// The edit that does one thing.
ProjectEdit edit_of(ProjectChange change);

/// Adds what takes a cell away, and before it the constraints and mappings that name it.
void take_cell(const Project& project, CellId id, ProjectEdit& edit);
/// Adds what takes away each constraint that `is_meant`, and the chains that need one of them.
void take_constraints(const Project& project, const std::function<bool(const Constraint&)>& is_meant,
                      ProjectEdit& edit);

/// A name that nothing has yet: the wish, or the wish with a number.
template <typename Taken>
std::string free_name(const std::string& wish, const Taken& is_taken) {
  std::string name = wish;
  for (int number = 2; is_taken(name); ++number) name = wish + " " + std::to_string(number);
  return name;
}

}  // namespace icome::animation
