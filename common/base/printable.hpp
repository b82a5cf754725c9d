#pragma once

#include <algorithm>
#include <string>

namespace lifeline {

/// Text from outside, as one line of a log or an error may hold it: whatever is no printable ASCII
/// character becomes '?'.
[[nodiscard]] inline std::string printable(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return text;
}

}  // namespace lifeline
