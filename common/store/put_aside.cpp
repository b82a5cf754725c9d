#include "common/store/put_aside.hpp"

#include <system_error>

#include <fmt/format.h>

namespace lifeline::store {
namespace {

bool is_there(const std::filesystem::path& file) {
  std::error_code ignored;
  return std::filesystem::exists(file, ignored);
}

}  // namespace

Result<std::filesystem::path> put_aside(const std::filesystem::path& file, const std::string& why) {
  std::filesystem::path aside;
  for (int number = 1; number <= kMostAside; ++number) {
    aside = fmt::format("{}.{}-{}", file.string(), why, number);
    if (!is_there(aside)) break;
  }
  const std::filesystem::path log = file.string() + "-wal", aside_log = aside.string() + "-wal";
  std::error_code problem;
  std::filesystem::remove(aside_log, problem);
  // The log first: a file without its log lacks its newest commits, a log without its file says
  // nothing.
  if (!problem && is_there(log)) std::filesystem::rename(log, aside_log, problem);
  if (!problem && is_there(file)) std::filesystem::rename(file, aside, problem);
  if (problem) {
    return fail(ErrorCode::unavailable, "{}: cannot be put aside ({}); remove it by hand",
                file.string(), problem.message());
  }
  return aside;
}

}  // namespace lifeline::store
