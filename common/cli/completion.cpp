#include "common/cli/completion.hpp"

namespace lifeline::cli {

std::optional<std::string> completion_for(std::string_view shell, const CLI::App& app,
                                          const std::string& program) {
  if (shell == "bash") return bash_completion(app, program);
  if (shell == "zsh") return zsh_completion(app, program);
  if (shell == "fish") return fish_completion(app, program);
  return std::nullopt;
}

}  // namespace lifeline::cli
