#include "agents/hud/hud_options.hpp"

#include <charconv>

namespace lifeline::hud {

Result<Size> parse_size(const std::string& text) {
  Size size;
  const char* const end = text.data() + text.size();
  const auto across = std::from_chars(text.data(), end, size.width);
  if (across.ec == std::errc{} && across.ptr != end && *across.ptr == 'x') {
    const auto down = std::from_chars(across.ptr + 1, end, size.height);
    if (down.ec == std::errc{} && down.ptr == end && size.width >= 160 && size.width <= 3840 &&
        size.height >= 96 && size.height <= 2160 && size.width <= 4 * size.height) {
      return size;
    }
  }
  return fail(ErrorCode::wrong_use,
              "HUD: a size is given as 800x480, from 160x96 to 3840x2160, at "
              "most four times as wide as high");
}

}  // namespace lifeline::hud
