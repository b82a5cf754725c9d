#include "common/cli/completion.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace lifeline::cli {
namespace {

std::vector<std::string> flags_of(const CLI::Option& option) {
  std::vector<std::string> flags;
  for (const std::string& name : option.get_lnames()) flags.push_back("--" + name);
  for (const std::string& name : option.get_snames()) flags.push_back("-" + name);
  return flags;
}

bool takes_value(const CLI::Option& option) {
  return option.get_items_expected_max() > 0;
}

// What the shell suggests for a value of this kind; empty: nothing.
std::string suggestion(const std::string& type) {
  if (type == kFile) return "files";
  if (type == kFolder) return "folders";
  if (type.find('|') == std::string::npos) return "";
  std::string words = type;
  std::ranges::replace(words, '|', ' ');
  return fmt::format("words '{}'", words);
}

// One line for each option that takes a value, by what stands before it.
std::string value_cases(const std::string& command, const CLI::App& app) {
  std::string cases;
  for (const CLI::Option* option : app.get_options()) {
    if (!takes_value(*option)) continue;
    std::vector<std::string> patterns;
    for (const std::string& flag : flags_of(*option))
      patterns.push_back(fmt::format("'{} {}'", command, flag));
    if (patterns.empty()) continue;
    const std::string suggested = suggestion(option->get_type_name());
    cases += fmt::format("    {}) {}return ;;\n", fmt::join(patterns, " | "),
                         suggested.empty() ? "" : suggested + "; ");
  }
  return cases;
}

std::string options_case(const std::string& command, const CLI::App& app) {
  std::vector<std::string> flags;
  bool takes_files = false;
  for (const CLI::Option* option : app.get_options()) {
    takes_files = takes_files || option->get_positional();
    for (std::string& flag : flags_of(*option)) flags.push_back(std::move(flag));
  }
  return fmt::format("    '{}') options='{}' takes_files={} ;;\n", command, fmt::join(flags, " "),
                     takes_files ? "yes" : "");
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
  std::string values = value_cases("", app), options = options_case("", app);
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    commands.push_back(command->get_name());
    values += value_cases(command->get_name(), *command);
    options += options_case(command->get_name(), *command);
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
