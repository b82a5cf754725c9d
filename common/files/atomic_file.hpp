#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "common/base/result.hpp"

namespace lifeline::files {

/// A file that is written so that whoever reads it, even after a crash, finds the old content or
/// the new one and never a part: to a neighbouring temporary file, flushed to the disk, then
/// renamed. Without commit() nothing is left behind. The folder must exist.
class AtomicFile {
 public:
  [[nodiscard]] static Result<AtomicFile> create(const std::filesystem::path& file);
  ~AtomicFile() { discard(); }
  AtomicFile(AtomicFile&& other) noexcept;
  AtomicFile& operator=(AtomicFile&& other) noexcept;

  /// On failure the file is given up.
  [[nodiscard]] Result<void> append(std::string_view content);
  /// Puts it in its place.
  [[nodiscard]] Result<void> commit();

 private:
  AtomicFile(std::filesystem::path file, std::string temporary, int handle);
  void discard();
  [[nodiscard]] Result<void> give_up(int error);

  std::filesystem::path file_;
  std::string temporary_;
  int handle_ = -1;  ///< -1: committed, or given up
};

/// The same for content that is all there.
[[nodiscard]] Result<void> write_file_atomically(const std::filesystem::path& file,
                                                 std::string_view content);

}  // namespace lifeline::files
