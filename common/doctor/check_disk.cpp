#include "common/doctor/check_disk.hpp"

#include <array>
#include <cerrno>
#include <cstdlib>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

namespace lifeline::doctor {
namespace {

namespace fs = std::filesystem;

// Large enough that a disk without a free block refuses it.
constexpr std::size_t kProbeOctets = 65536;
constexpr std::uintmax_t kParticipants = 16;  ///< segments of shared memory that may be needed

/// The folder, or the nearest above it that is there.
fs::path existing(fs::path folder) {
  std::error_code problem;
  while (!fs::exists(folder, problem) && folder.has_relative_path()) folder = folder.parent_path();
  return folder.empty() ? "." : folder;
}

/// What the system says when a file is written there; 0 where it can be.
int write_error(const fs::path& folder) {
  std::string name = (folder / ".lifeline-doctor.XXXXXX").string();
  const int file = mkostemp(name.data(), O_CLOEXEC);
  if (file < 0) return errno;
  static constexpr std::array<char, kProbeOctets> kProbe{};
  int error = 0;
  const ssize_t size = write(file, kProbe.data(), kProbe.size());
  if (size < 0) error = errno;
  if (error == 0 && size < static_cast<ssize_t>(kProbe.size())) error = ENOSPC;
  if (error == 0 && fsync(file) != 0) error = errno;
  close(file);
  unlink(name.c_str());
  return error;
}

std::string megabytes(std::uintmax_t octets) {
  return fmt::format("{:.0f} MB", static_cast<double>(octets) / 1e6);
}

Finding judge_room(const std::string& check, const std::string& where, const std::string& facts,
                   std::uintmax_t free_octets, const DiskNeed& need) {
  const std::string room = fmt::format("{}, {} free", facts, megabytes(free_octets));
  if (free_octets < need.fault_octets) {
    return fault(check, where, room + ": not enough for a mission",
                 fmt::format("free at least {}", megabytes(need.fault_octets)));
  }
  if (free_octets < need.warning_octets)
    return warning(check, where, room, fmt::format("{} are safe", megabytes(need.warning_octets)));
  return ok(check, where, room);
}

}  // namespace

Findings check_folder(const std::string& check, const fs::path& folder, const std::string& setting,
                      const DiskNeed& need) {
  const std::string where = folder.string();
  std::error_code problem;
  const fs::path there = existing(fs::absolute(folder, problem));
  if (!fs::is_directory(there, problem)) {
    return {fault(check, where, there.string() + " is no folder",
                  "give another folder with " + setting)};
  }
  if (const int error = write_error(there); error != 0) {
    return {fault(check, where,
                  fmt::format("nothing can be written to {}: {}", there.string(),
                              std::generic_category().message(error)),
                  "free space or change its owner, or give another folder with " + setting)};
  }
  const auto space = fs::space(there, problem);
  if (problem) return {ok(check, where, "can be written")};
  const bool is_made = fs::exists(folder, problem);
  return {
      judge_room(check, where, is_made ? "can be written" : "will be made", space.available, need)};
}

Findings check_shared_memory(const dds::ProfileFacts& profile, const fs::path& root) {
  if (!profile.shared_memory) return {};
  const std::string check = "memory";
  const fs::path folder = root / "dev/shm";
  const std::string where = "/dev/shm";
  std::error_code problem;
  if (!fs::is_directory(folder, problem)) {
    return {fault(check, where, "is not there, but the QoS profiles use shared memory",
                  "mount it (mount -t tmpfs tmpfs /dev/shm), or take profiles of UDP alone, as all "
                  "shipped ones are")};
  }
  if (const int error = write_error(folder); error != 0) {
    return {fault(check, where, "cannot be written: " + std::generic_category().message(error),
                  "chmod 1777 /dev/shm, or take profiles of UDP alone")};
  }
  const auto space = fs::space(folder, problem);
  const std::uintmax_t need = profile.segment_octets;
  return {judge_room(check, where, "can be written", problem ? 0 : space.available,
                     {2 * need, kParticipants * need})};
}

}  // namespace lifeline::doctor
