#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace lifeline::cli {

/// What a shell can suggest for an option's value.
enum class Suggest { nothing, files, folders, words };

/// An option as completions name it.
struct OptionRow {
  std::vector<std::string> flags;  ///< "--help", "-h"; none of what stands without a name
  std::string description;
  bool takes_value = false;
  bool repeats = false;  ///< may be given more than once
  Suggest suggest = Suggest::nothing;
  std::string value;               ///< the value's name
  std::vector<std::string> words;  ///< to choose from
};

/// A command; the program itself where it has none.
struct CommandRow {
  std::string name;  ///< empty: the program
  std::string description;
  std::vector<OptionRow> options;
  bool takes_files = false;  ///< arguments without a name
};

/// The program's own row, then its commands': the table that --help is made of.
[[nodiscard]] std::vector<CommandRow> completion_table(const CLI::App& app);

}  // namespace lifeline::cli
