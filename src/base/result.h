#pragma once
#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace icome::base {

/// The reason why something that a user asked for could not be done: one sentence that says what to do.
struct Error {
  std::string message;
};

/// A value, or the Error that says why there is none.
template <typename T>
using Result = tl::expected<T, Error>;

/// The failed Result: `return base::fail("bunny.obj: no such file")`.
inline tl::unexpected<Error> fail(std::string message) {
  return tl::unexpected<Error>(Error{std::move(message)});
}

}  // namespace icome::base
