#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace lifeline::files {

/// Which of `names` somebody may have meant who wrote `wrong`: the one with the fewest letters to
/// change, when that is less than about a third of them, or one that `wrong` is a part of.
[[nodiscard]] std::optional<std::string> nearest_name(std::string_view wrong,
                                                      std::span<const std::string> names);

}  // namespace lifeline::files
