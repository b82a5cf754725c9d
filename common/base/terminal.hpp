#pragma once

namespace lifeline {

/// Whether output to this open file may be coloured: it is a terminal that can (TERM is not
/// `dumb`), and NO_COLOR is unset or empty (no-color.org).
[[nodiscard]] bool wants_colour(int file);

}  // namespace lifeline
