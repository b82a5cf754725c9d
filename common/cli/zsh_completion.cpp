#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/cli/completion.hpp"
#include "common/cli/completion_table.hpp"

namespace lifeline::cli {
namespace {

/// In single quotes.
std::string zsh_quoted(const std::string& text) {
  std::string all = "'";
  for (const char c : text) {
    if (c == '\'') {
      all += "'\\''";
    } else {
      all += c;
    }
  }
  return all + "'";
}

/// With a backslash before what zsh's completion would take for a sign of its own.
std::string zsh_escaped(const std::string& text, std::string_view special) {
  std::string all;
  for (const char c : text) {
    if (special.find(c) != std::string_view::npos) all += '\\';
    all += c;
  }
  return all;
}

std::string zsh_value(const OptionRow& option) {
  if (!option.takes_value) return "";
  std::string action = " ";  // something, and nothing to suggest
  if (option.suggest == Suggest::files) action = "_files";
  if (option.suggest == Suggest::folders) action = "_files -/";
  if (option.suggest == Suggest::words) action = fmt::format("({})", fmt::join(option.words, " "));
  return fmt::format(":{}:{}", zsh_escaped(option.value, ":\\"), action);
}

/// One specification of _arguments for each of the option's names.
std::string specifications(const OptionRow& option) {
  std::string all;
  for (const std::string& flag : option.flags) {
    const bool joins = option.takes_value && flag.starts_with("--");  // --option=value, too
    const std::string once =
        option.repeats ? "*" : fmt::format("({})", fmt::join(option.flags, " "));
    all += " \\\n        " +
           zsh_quoted(fmt::format("{}{}{}[{}]{}", once, flag, joins ? "=" : "",
                                  zsh_escaped(option.description, "[]:\\"), zsh_value(option)));
  }
  return all;
}

std::string arguments_of(const CommandRow& command) {
  std::string call = "_arguments";
  for (const OptionRow& option : command.options) call += specifications(option);
  if (command.takes_files) call += " \\\n        '*:file:_files'";
  return call;
}

constexpr std::string_view kZshCommands = R"(  if (( CURRENT == 2 )); then
    local -a commands=({commands})
    _describe command commands
    {own}
    return
  fi
  local command=$words[2]
  shift words
  (( CURRENT-- ))
  case $command in
{cases}  esac
)";

}  // namespace

std::string zsh_completion(const CLI::App& app, const std::string& program) {
  std::string function = "_" + program;
  std::ranges::replace(function, '-', '_');
  std::vector<std::string> commands;
  std::string own, cases;
  for (const CommandRow& command : completion_table(app)) {
    if (command.name.empty()) {
      own = arguments_of(command);
      continue;
    }
    commands.push_back(
        zsh_quoted(fmt::format("{}:{}", command.name, zsh_escaped(command.description, ":\\"))));
    cases += fmt::format("    {})\n      {} ;;\n", command.name, arguments_of(command));
  }
  std::string script = fmt::format(
      "#compdef {0}\n# zsh completion for {0}; made by `{0} completion zsh`.\n{1}() {{\n", program,
      function);
  const std::string choices = fmt::format("{}", fmt::join(commands, " "));
  script += commands.empty() ? "  " + own + "\n"
                             : fmt::format(kZshCommands, fmt::arg("commands", choices),
                                           fmt::arg("own", own), fmt::arg("cases", cases));
  // As a file of $fpath it is the body of its function; sourced, it says what it is for.
  return script +
         fmt::format(
             "}}\nif [[ $funcstack[1] == _{0} ]]; then {1} \"$@\"; else compdef {1} {0}; fi\n",
             program, function);
}

}  // namespace lifeline::cli
