#include "common/cli/completion_table.hpp"

#include <sstream>

#include "common/cli/completion.hpp"

namespace lifeline::cli {
namespace {

OptionRow row_of(const CLI::Option& option) {
  OptionRow row;
  for (const std::string& name : option.get_lnames()) row.flags.push_back("--" + name);
  for (const std::string& name : option.get_snames()) row.flags.push_back("-" + name);
  row.description = option.get_description();
  row.takes_value = option.get_items_expected_max() > 0;
  row.repeats = option.get_items_expected_max() > 1;
  row.value = option.get_type_name();
  if (row.value == kFile) row.suggest = Suggest::files;
  if (row.value == kFolder) row.suggest = Suggest::folders;
  if (row.value.find('|') != std::string::npos) {
    row.suggest = Suggest::words;
    std::istringstream choices(row.value);
    for (std::string word; std::getline(choices, word, '|');) row.words.push_back(word);
  }
  return row;
}

CommandRow row_of(const CLI::App& app, const std::string& name) {
  CommandRow row{name, app.get_description(), {}, false};
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_positional()) row.takes_files = true;
    OptionRow each = row_of(*option);
    if (!each.flags.empty()) row.options.push_back(std::move(each));
  }
  return row;
}

}  // namespace

std::vector<CommandRow> completion_table(const CLI::App& app) {
  std::vector<CommandRow> table{row_of(app, "")};
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    table.push_back(row_of(*command, command->get_name()));
  return table;
}

}  // namespace lifeline::cli
