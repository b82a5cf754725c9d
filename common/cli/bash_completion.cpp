#include <algorithm>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/cli/completion.hpp"
#include "common/cli/completion_table.hpp"

namespace lifeline::cli {
namespace {

// What the shell suggests for a value; empty: nothing.
std::string suggestion(const OptionRow& option) {
  switch (option.suggest) {
    case Suggest::files:
      return "files";
    case Suggest::folders:
      return "folders";
    case Suggest::words:
      return fmt::format("words '{}'", fmt::join(option.words, " "));
    case Suggest::nothing:
      break;
  }
  return "";
}

// One line for each option that takes a value, by what stands before it.
std::string value_cases(const CommandRow& command) {
  std::string cases;
  for (const OptionRow& option : command.options) {
    if (!option.takes_value) continue;
    std::vector<std::string> patterns;
    for (const std::string& flag : option.flags)
      patterns.push_back(fmt::format("'{} {}'", command.name, flag));
    const std::string suggested = suggestion(option);
    cases += fmt::format("    {}) {}return ;;\n", fmt::join(patterns, " | "),
                         suggested.empty() ? "" : suggested + "; ");
  }
  return cases;
}

std::string options_case(const CommandRow& command) {
  std::vector<std::string> flags;
  for (const OptionRow& option : command.options)
    flags.insert(flags.end(), option.flags.begin(), option.flags.end());
  return fmt::format("    '{}') options='{}' takes_files={} ;;\n", command.name,
                     fmt::join(flags, " "), command.takes_files ? "yes" : "");
}

constexpr std::string_view kHead =
    R"(# bash completion for {program}; made by `{program} completion bash`.
{function}() {{
  local current="${{COMP_WORDS[COMP_CWORD]}}" before="${{COMP_WORDS[COMP_CWORD-1]}}" command='' options='' takes_files=''
  words() {{ mapfile -t COMPREPLY < <(compgen -W "$1" -- "$current"); }}
  files() {{ compopt -o filenames 2>/dev/null; mapfile -t COMPREPLY < <(compgen -f -- "$current"); }}
  folders() {{ compopt -o filenames 2>/dev/null; mapfile -t COMPREPLY < <(compgen -d -- "$current"); }}
  COMPREPLY=()
  # --option=value comes as three words.
  if [[ $before == '=' ]]; then before="${{COMP_WORDS[COMP_CWORD-2]}}"; fi
  if [[ $current == '=' ]]; then current=''; fi
)";
constexpr std::string_view kChooseCommand =
    R"(  if ((COMP_CWORD == 1)); then words '{commands} --help'; return; fi
  command="${{COMP_WORDS[1]}}"
)";
constexpr std::string_view kTail = R"(  if [[ $current == -* ]]; then words "$options"
  elif [[ $takes_files ]]; then files; fi
}}
complete -F {function} {program}
)";

}  // namespace

std::string bash_completion(const CLI::App& app, const std::string& program) {
  std::string function = "_" + program;
  std::ranges::replace(function, '-', '_');
  std::vector<std::string> commands;
  std::string values, options;
  for (const CommandRow& command : completion_table(app)) {
    if (!command.name.empty()) commands.push_back(command.name);
    values += value_cases(command);
    options += options_case(command);
  }
  std::string script =
      fmt::format(kHead, fmt::arg("program", program), fmt::arg("function", function));
  const std::string choices = fmt::format("{}", fmt::join(commands, " "));
  if (!commands.empty()) script += fmt::format(kChooseCommand, fmt::arg("commands", choices));
  script += "  case \"$command $before\" in\n" + values + "  esac\n";
  script += "  case \"$command\" in\n" + options + "  esac\n";
  return script + fmt::format(kTail, fmt::arg("program", program), fmt::arg("function", function));
}

}  // namespace lifeline::cli
