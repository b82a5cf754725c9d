#include "coordinator/dashboard/readable.hpp"

#include <cstddef>
#include <cstdint>

#include "common/base/printable.hpp"

namespace lifeline::dashboard {
namespace {

// How many octets follow the first one of a character; -1 where none begins so.
int following(unsigned char first) {
  if (first < 0x80) return 0;
  if (first >= 0xC2 && first < 0xE0) return 1;
  if (first >= 0xE0 && first < 0xF0) return 2;
  return first >= 0xF0 && first < 0xF5 ? 3 : -1;
}

bool is_utf8(const std::string& text) {
  for (std::size_t i = 0; i < text.size();) {
    const auto first = static_cast<unsigned char>(text[i++]);
    const int more = following(first);
    if (more < 0 || i + static_cast<std::size_t>(more) > text.size()) return false;
    std::uint32_t code = more == 0 ? first : first & (0x3FU >> static_cast<unsigned>(more));
    for (int k = 0; k < more; ++k) {
      const auto next = static_cast<unsigned char>(text[i++]);
      if ((next & 0xC0U) != 0x80) return false;
      code = (code << 6U) | (next & 0x3FU);
    }
    // Written longer than need be, halves of surrogate pairs, beyond the last character.
    if ((more == 2 && code < 0x800) || (more == 3 && code < 0x10000) || code > 0x10FFFF ||
        (code >= 0xD800 && code < 0xE000)) {
      return false;
    }
  }
  return true;
}

}  // namespace

std::string readable(const std::string& text) {
  return is_utf8(text) ? text : printable(text);
}

}  // namespace lifeline::dashboard
