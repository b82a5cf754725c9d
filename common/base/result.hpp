#pragma once

#include <string>
#include <utility>

#include <fmt/format.h>
#include <tl/expected.hpp>

namespace lifeline {

/// What kind of failure the environment gave us. Programs map it to their exit status; nothing else
/// branches on it.
enum class ErrorCode {
  wrong_use,  ///< the caller asked for something that does not exist or makes no sense: exit status
              ///< 2
  not_found,  ///< a file, device or topic is not there
  bad_data,   ///< something came in that cannot be decoded
  unsupported,  ///< well-formed, but outside of what this version handles
  unavailable,  ///< the operating system, the network or the middleware refused
};

/// A failure of the environment. The text names the thing, the place and what to do about it, in
/// one line.
struct Error {
  ErrorCode code;
  std::string text;
};

/// A value, or the environment's failure to give it. Outcomes are data and bugs are assertions:
/// neither is an Error.
template <typename T>
using Result = tl::expected<T, Error>;

/// Builds the failure branch of a Result: `return fail(ErrorCode::not_found, "{}: no such file",
/// path);`
template <typename... Args>
[[nodiscard]] tl::unexpected<Error> fail(ErrorCode code, fmt::format_string<Args...> text,
                                         Args&&... args) {
  return tl::unexpected<Error>(Error{code, fmt::format(text, std::forward<Args>(args)...)});
}

/// Hands an error of one Result on to another type of Result.
template <typename T>
[[nodiscard]] tl::unexpected<Error> forward_error(const Result<T>& failed) {
  return tl::unexpected<Error>(failed.error());
}

}  // namespace lifeline
