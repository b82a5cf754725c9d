#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/cli/completion.hpp"
#include "common/cli/completion_table.hpp"

namespace lifeline::cli {
namespace {

/// In single quotes.
std::string fish_quoted(const std::string& text) {
  std::string all = "'";
  for (const char c : text) {
    if (c == '\'' || c == '\\') all += '\\';
    all += c;
  }
  return all + "'";
}

std::string fish_value(const OptionRow& option) {
  if (!option.takes_value) return "";
  switch (option.suggest) {
    case Suggest::files:
      return " -r -F";
    case Suggest::folders:
      return " -x -a '(__fish_complete_directories)'";
    case Suggest::words:
      return fmt::format(" -x -a {}", fish_quoted(fmt::format("{}", fmt::join(option.words, " "))));
    case Suggest::nothing:
      break;
  }
  return " -x";
}

/// `start`: "complete -c PROGRAM", with the condition under which the option can be given.
std::string fish_line(const std::string& start, const OptionRow& option) {
  std::string line = start;
  for (const std::string& flag : option.flags)
    line += flag.starts_with("--") ? " -l " + flag.substr(2) : " -s " + flag.substr(1);
  return fmt::format("{}{} -d {}\n", line, fish_value(option), fish_quoted(option.description));
}

}  // namespace

std::string fish_completion(const CLI::App& app, const std::string& program) {
  std::string script =
      fmt::format("# fish completion for {0}; made by `{0} completion fish`.\n", program);
  const std::string start = "complete -c " + program;
  script += start + " -f\n";
  const auto table = completion_table(app);
  for (const CommandRow& command : table) {
    std::string condition;
    if (!command.name.empty()) {
      script += fmt::format("{} -n __fish_use_subcommand -a {} -d {}\n", start, command.name,
                            fish_quoted(command.description));
      condition = fmt::format(" -n '__fish_seen_subcommand_from {}'", command.name);
    } else if (table.size() > 1) {
      condition = " -n __fish_use_subcommand";
    }
    for (const OptionRow& option : command.options) script += fish_line(start + condition, option);
    if (command.takes_files) script += start + condition + " -F\n";
  }
  return script;
}

}  // namespace lifeline::cli
