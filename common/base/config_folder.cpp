#include "common/base/config_folder.hpp"

#include <cstdlib>
#include <system_error>

namespace lifeline {

Result<std::filesystem::path> config_folder() {
  namespace fs = std::filesystem;
  std::error_code ignored;
  if (const char* chosen = std::getenv("LIFELINE_CONFIG"); chosen != nullptr) {
    if (fs::is_directory(chosen, ignored)) return fs::path(chosen);
    return fail(ErrorCode::not_found, "LIFELINE_CONFIG={}: no such folder", chosen);
  }
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
  for (const fs::path& folder :
       {program.parent_path() / "../../config", program.parent_path() / "../../../config",
        fs::path("/etc/lifeline")}) {
    if (fs::is_directory(folder / "qos", ignored)) return fs::canonical(folder, ignored);
  }
  return fail(ErrorCode::not_found,
              "no configuration folder beside {} nor in /etc/lifeline; set LIFELINE_CONFIG",
              program.string());
}

}  // namespace lifeline
