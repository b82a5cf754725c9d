#pragma once

#include <optional>
#include <string>
#include <string_view>

#include <CLI/CLI.hpp>

namespace lifeline::cli {

/// What an option's value is, as help and completion say it (CLI::Option::type_name). Other names,
/// such as SECONDS, are values that nothing can suggest; "a|b|c" are the words to choose from.
inline constexpr const char* kFile = "FILE";
inline constexpr const char* kFolder = "FOLDER";

// Scripts that make a shell complete a program's commands, options and values, made from the same
// table as its --help. They need nothing but the shell.

[[nodiscard]] std::string bash_completion(const CLI::App& app, const std::string& program);
/// To be sourced after compinit, or as the file _PROGRAM of a folder in $fpath.
[[nodiscard]] std::string zsh_completion(const CLI::App& app, const std::string& program);
[[nodiscard]] std::string fish_completion(const CLI::App& app, const std::string& program);

/// Of the shell of that name; empty: there is none for it.
[[nodiscard]] std::optional<std::string> completion_for(std::string_view shell, const CLI::App& app,
                                                        const std::string& program);

}  // namespace lifeline::cli
