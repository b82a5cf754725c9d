#pragma once

#include <cstdint>
#include <initializer_list>
#include <map>
#include <string>
#include <string_view>

#include "common/base/result.hpp"

namespace lifeline::sources {

/// A SOURCE as written on the command line: `kind:target?key=value&key=value`.
///
/// The kind ends at the first ':'. Options begin after the LAST '?', so a target may hold '?' when
/// options follow it (or a bare '?' ends the text). Nothing is escaped: a value holds neither '?'
/// nor '&'.
struct SourceSpec {
  std::string kind;    ///< lower-case letters and digits
  std::string target;  ///< a path, a plan's name, a topic: whatever the kind makes of it
  std::map<std::string, std::string> options;

  /// Refuses an option that is not in `names`, and says which there are. Every kind also has
  /// `rate`, which open_source() takes out before the kind sees the options.
  [[nodiscard]] Result<void> allow_options(std::initializer_list<std::string_view> names) const;

  /// The option's text, or `fallback` where it is not given.
  [[nodiscard]] std::string text(const std::string& name, std::string_view fallback) const;

  /// The option as a decimal integer in [lowest, highest]; wrong_use names option, value and range.
  [[nodiscard]] Result<std::int64_t> integer(const std::string& name, std::int64_t fallback,
                                             std::int64_t lowest, std::int64_t highest) const;

  /// The option as a finite decimal number in [lowest, highest]; the unit is the option's own.
  [[nodiscard]] Result<double> number(const std::string& name, double fallback, double lowest,
                                      double highest) const;

  /// The option as one of `choices`; the error lists them.
  [[nodiscard]] Result<std::string> choice(const std::string& name, std::string_view fallback,
                                           std::initializer_list<std::string_view> choices) const;
};

/// Takes SOURCE apart. wrong_use for a text without kind or target, and for an option without name
/// or value or given twice. Which kinds there are is open_source()'s business.
[[nodiscard]] Result<SourceSpec> parse_source_spec(std::string_view source);

}  // namespace lifeline::sources
