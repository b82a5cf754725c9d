#include "common/ros2/cdr_writer.hpp"

namespace lifeline::ros2 {
namespace {

constexpr std::size_t kHeaderBytes = 4;

}  // namespace

void CdrWriter::put(std::uint64_t value, std::size_t size) {
  const std::size_t at = bytes_.size() - kHeaderBytes;
  bytes_.resize(bytes_.size() + (size - at % size) % size, 0);
  for (std::size_t i = 0; i < size; ++i) {
    bytes_.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
  }
}

void CdrWriter::write_text(std::string_view text) {
  write_count(text.size() + 1);
  bytes_.insert(bytes_.end(), text.begin(), text.end());
  bytes_.push_back(0);
}

void CdrWriter::write_octets(std::span<const std::uint8_t> octets) {
  write_count(octets.size());
  bytes_.insert(bytes_.end(), octets.begin(), octets.end());
}

}  // namespace lifeline::ros2
