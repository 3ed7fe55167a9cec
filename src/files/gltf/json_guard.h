#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "base/result.h"

namespace icome::files {

/// Findings about the JSON of a glTF file, before a model is made of it.
struct JsonShape {
  std::size_t values = 0;             // numbers, texts, lists and objects
  std::size_t own_buffers = 0;        // buffers without a uri: the binary part of the file
  std::uint64_t memory_estimate = 0;  // bytes, of the model that is made of it
};

/// Scans the text without keeping it. Fails with a sentence for text that is no JSON (with the line),
/// nests deeper than readers can follow it, or would make a model larger than `memory_limit`.
base::Result<JsonShape> look_at_json(std::string_view json, std::uint64_t memory_limit);

}  // namespace icome::files
