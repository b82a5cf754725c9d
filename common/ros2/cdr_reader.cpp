#include "common/ros2/cdr_reader.hpp"

namespace lifeline::ros2 {

Result<CdrReader> CdrReader::open_cdr(std::span<const std::uint8_t> bytes) {
  constexpr std::size_t kHeaderBytes = 4;  // representation (2), options (2)
  if (bytes.size() < kHeaderBytes) {
    return fail(ErrorCode::bad_data, "{} bytes are too few for a message", bytes.size());
  }
  if (bytes[0] != 0 || bytes[1] > 1) {
    return fail(ErrorCode::bad_data, "encapsulation 0x{:02x}{:02x} is not plain CDR", bytes[0],
                bytes[1]);
  }
  return CdrReader(bytes.subspan(kHeaderBytes), bytes[1] == 0, true);
}

CdrReader CdrReader::open_ros1(std::span<const std::uint8_t> bytes) {
  return CdrReader(bytes, false, false);
}

std::uint64_t CdrReader::take(std::size_t size) {
  if (aligned_) skip((size - at_ % size) % size);
  if (!ok_ || left() < size) {
    ok_ = false;
    return 0;
  }
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < size; ++i) {
    value = value << 8 | bytes_[at_ + (big_endian_ ? i : size - 1 - i)];
  }
  at_ += size;
  return value;
}

void CdrReader::skip(std::size_t size) {
  ok_ = ok_ && size <= left();
  if (ok_) at_ += size;
}

std::vector<float> CdrReader::read_floats(std::size_t most) {
  const std::size_t count = read<std::uint32_t>();
  ok_ = ok_ && count <= most && count <= left() / sizeof(float);
  std::vector<float> values(ok_ ? count : 0);
  for (float& value : values) value = read<float>();
  return values;
}

void CdrReader::skip_floats() {
  const std::size_t count = read<std::uint32_t>();
  skip(count * sizeof(float));
}

std::string CdrReader::read_text(std::size_t most) {
  const std::size_t length = read<std::uint32_t>();
  ok_ = ok_ && length <= most && length <= left();
  if (!ok_) return {};
  const auto* begin = reinterpret_cast<const char*>(bytes_.data()) + at_;
  std::string text(begin, length);
  at_ += length;
  if (aligned_ && text.ends_with('\0')) text.pop_back();
  return text;
}

void CdrReader::skip_text() {
  const std::size_t length = read<std::uint32_t>();
  skip(length);
}

}  // namespace lifeline::ros2
