// Writes docs/parameters.md, config/agent.yaml and config/coordinator.yaml anew:
// config_documents DESCRIPTOR_SET PROJECT_FOLDER

#include <cstdio>
#include <filesystem>
#include <string>
#include <utility>

#include "common/files/atomic_file.hpp"
#include "common/files/config_document.hpp"

int main(int argc, char** argv) {
  using lifeline::files::write_file_atomically;
  if (argc != 3) {
    std::fputs("config_documents: give the descriptor set and the project's folder\n", stderr);
    return 2;
  }
  const std::filesystem::path project(argv[2]);
  const auto documents = lifeline::files::make_config_documents(argv[1]);
  if (!documents) {
    std::fprintf(stderr, "%s\n", documents.error().text.c_str());
    return 1;
  }
  for (const auto& [name, text] :
       {std::pair("docs/parameters.md", &documents->parameters_md),
        std::pair("config/agent.yaml", &documents->agent_yaml),
        std::pair("config/coordinator.yaml", &documents->coordinator_yaml)}) {
    if (const auto written = write_file_atomically(project / name, *text); !written) {
      std::fprintf(stderr, "%s\n", written.error().text.c_str());
      return 1;
    }
  }
  return 0;
}
