#pragma once
#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

#include "interaction/operations/operation_runner.h"

namespace icome::interaction {

/// The value of a JSON text that must be good.
inline Value json(std::string_view text) {
  auto value = value_from_json(text);
  if (!value) throw std::runtime_error(value.error().message + ": " + std::string(text));
  return std::move(*value);
}

/// Reads the one picture that there is, "wood.png".
inline base::Result<world::Texture> sample_picture(const std::string& file) {
  if (file != "wood.png") return base::fail(file + ": cannot be read");
  return world::Texture{
      .name = file, .media_type = "image/png", .bytes = std::make_shared<const std::string>("wood")};
}

/// Performs a command that must succeed.
inline Performed performed(OperationRunner& runner, std::string_view command) {
  auto done = runner.perform(json(command));
  if (!done) throw std::runtime_error(done.error().message + ": " + std::string(command));
  return std::move(*done);
}

/// Why a command is refused; empty, failing the test, where it is not, or changes something.
inline std::string refusal(OperationRunner& runner, std::string_view command) {
  const std::uint64_t before = hash(runner.world());
  const auto done = runner.perform(json(command));
  EXPECT_FALSE(done) << command;
  EXPECT_EQ(hash(runner.world()), before) << command;
  return done ? "" : done.error().message;
}

}  // namespace icome::interaction
