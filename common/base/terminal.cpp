#include "common/base/terminal.hpp"

#include <cstdlib>
#include <string_view>

#include <unistd.h>

namespace lifeline {

bool wants_colour(int file) {
  const char* refused = std::getenv("NO_COLOR");
  if (refused != nullptr && *refused != '\0') return false;
  const char* kind = std::getenv("TERM");
  if (kind == nullptr || std::string_view(kind) == "dumb") return false;
  return isatty(file) == 1;
}

}  // namespace lifeline
