#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace lifeline::cli {

/// What an option's value is, as help and completion say it (CLI::Option::type_name). Other names,
/// such as SECONDS, are values that nothing can suggest; "a|b|c" are the words to choose from.
inline constexpr const char* kFile = "FILE";
inline constexpr const char* kFolder = "FOLDER";

/// A script that makes bash complete a program's commands, options and values, made from the same
/// table as its --help. It needs nothing but bash.
[[nodiscard]] std::string bash_completion(const CLI::App& app, const std::string& program);

}  // namespace lifeline::cli
