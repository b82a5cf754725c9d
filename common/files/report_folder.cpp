#include "common/files/report_folder.hpp"

#include <fstream>
#include <system_error>

namespace lifeline::files {

Result<void> prepare_report_folder(const std::filesystem::path& folder) {
  std::error_code problem;
  std::filesystem::create_directories(folder, problem);
  if (problem) {
    return fail(ErrorCode::unavailable, "report folder {}: {}; give a folder that can be written",
                folder.string(), problem.message());
  }
  const auto probe = folder / ".write-test";
  std::ofstream file(probe);
  file << "x" << std::flush;
  const bool written = file.good();
  file.close();
  std::filesystem::remove(probe, problem);
  if (!written) {
    return fail(ErrorCode::unavailable,
                "report folder {}: no file can be written there; give another with --report",
                folder.string());
  }
  return {};
}

}  // namespace lifeline::files
