#include "deploy/demo/programs.hpp"

#include <system_error>

namespace lifeline::demo {
namespace {

using std::filesystem::path;

Result<void> need(const path& file, const char* advice) {
  std::error_code ignored;
  if (std::filesystem::is_regular_file(file, ignored)) return {};
  return fail(ErrorCode::not_found, "{}: no such file; {}", file.string(), advice);
}

}  // namespace

Result<Programs> find_programs(const path& self, const path& config) {
  Programs programs{self.parent_path() / "lifeline-agent",
                    self.parent_path() / "lifeline-coordinator", config / "qos/loopback.xml"};
  for (const path& program : {programs.agent, programs.coordinator}) {
    if (auto found = need(program, "./lifeline build makes it"); !found)
      return forward_error(found);
  }
  if (auto found = need(programs.qos, "is this a whole checkout?"); !found) {
    return forward_error(found);
  }
  return programs;
}

}  // namespace lifeline::demo
