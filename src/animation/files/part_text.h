#pragma once
#include <functional>
#include <span>
#include <string>

#include "animation/project/project_edit.h"
#include "io/key_reader.h"
#include "io/toml_text.h"

namespace icome::animation {

// The parts that projects and edits have in common, as TOML. Cells are named in projects and numbered in
// edits, whose names may change.

using CellWords = std::function<std::string(CellId)>;            // TOML that means a cell
using CellOfWords = std::function<CellId(const io::TomlNode&)>;  // no id: there is no such cell

std::string number_of_cell(CellId id);
CellId numbered_cell(const io::TomlNode& node);

void write_layer(const LayerLook& look, io::TomlFields& fields);
void write_look(const CellLook& look, io::TomlFields& fields);
void write_state(const CellState& state, std::span<const Channel> channels, io::TomlFields& fields);
void write_tracks(const Tracks& tracks, io::TomlFields& fields);
std::string keys_text(Channel channel, const Track& keys);
void write_stage(const Stage& stage, io::TomlFields& fields);
void write_sound(const Sound& sound, io::TomlFields& fields);
void write_constraint(const Constraint& constraint, const CellWords& words, io::TomlFields& fields);
void write_mapping(const Mapping& mapping, const CellWords& words, io::TomlFields& fields);

// Anything wrong is added to the problems, and something harmless returned.
LayerLook read_layer(io::KeyReader& keys);
CellLook read_look(io::KeyReader& keys);
void read_state(io::KeyReader& keys, std::span<const Channel> channels, CellState& state);
Tracks read_tracks(io::KeyReader& keys);
Track read_keys(Channel channel, const io::TomlNode& node, io::Problems& problems);
Stage read_stage(io::KeyReader& keys);
Sound read_sound(io::KeyReader& keys);
Constraint read_constraint(io::KeyReader& keys, const CellOfWords& cells);
Mapping read_mapping(io::KeyReader& keys, const CellOfWords& cells);

/// The name of a channel in files and scripts: "x", "y", "angle", "scale", "opacity" or "picture".
const char* name_of(Channel channel);
const io::Words<Channel>& channel_words();
const io::Words<Ease>& ease_words();
const io::Words<MappingMode>& mapping_words();

}  // namespace icome::animation
