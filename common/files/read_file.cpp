#include "common/files/read_file.hpp"

#include <fstream>
#include <system_error>

namespace lifeline::files {

Result<std::string> read_file(const std::filesystem::path& file, std::size_t max_octets) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) {
    return fail(ErrorCode::not_found, "{}: no such file; check the name", file.string());
  }
  if (!std::filesystem::is_regular_file(status)) {
    return fail(ErrorCode::wrong_use, "{}: not a file; give a file", file.string());
  }
  const auto size = std::filesystem::file_size(file, error);
  if (error || size > max_octets) {
    return fail(ErrorCode::bad_data, "{}: more than {} octets; this is not what is expected here",
                file.string(), max_octets);
  }
  std::ifstream stream(file, std::ios::binary);
  std::string content(size, '\0');
  if (!stream.read(content.data(), static_cast<std::streamsize>(size))) {
    return fail(ErrorCode::unavailable, "{}: cannot be read; check its permissions", file.string());
  }
  return content;
}

}  // namespace lifeline::files
