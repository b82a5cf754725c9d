#include "agents/sources/source_spec.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/ranges.h>

namespace lifeline::sources {
namespace {

bool is_kind_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
}

/// Reads the whole of `text` as a number; false where anything is left over.
template <typename Number>
bool read_number(std::string_view text, Number& value) {
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  return error == std::errc{} && rest == end && !text.empty();
}

Result<void> add_option(SourceSpec& spec, std::string_view option, std::string_view source) {
  const std::size_t equals = option.find('=');
  if (equals == 0 || equals == std::string_view::npos || equals + 1 == option.size()) {
    return fail(ErrorCode::wrong_use, "source '{}': option '{}' is not of the form key=value",
                source, option);
  }
  const std::string name(option.substr(0, equals));
  if (!spec.options.emplace(name, option.substr(equals + 1)).second) {
    return fail(ErrorCode::wrong_use, "source '{}': option '{}' is given twice", source, name);
  }
  return {};
}

}  // namespace

Result<SourceSpec> parse_source_spec(std::string_view source) {
  const std::size_t colon = source.find(':');
  if (colon == 0 || colon == std::string_view::npos ||
      !std::all_of(source.begin(), source.begin() + static_cast<std::ptrdiff_t>(colon),
                   is_kind_letter)) {
    return fail(ErrorCode::wrong_use,
                "source '{}' does not begin with a kind: write KIND:TARGET?key=value, e.g. "
                "carmen:run.log.gz?prior=odom",
                source);
  }
  SourceSpec spec;
  spec.kind = source.substr(0, colon);
  const std::string_view rest = source.substr(colon + 1);
  const std::size_t mark = rest.rfind('?');
  spec.target = rest.substr(0, mark);
  if (spec.target.empty()) {
    return fail(ErrorCode::wrong_use, "source '{}' names nothing after '{}:'", source, spec.kind);
  }
  std::string_view list = mark == std::string_view::npos ? "" : rest.substr(mark + 1);
  while (!list.empty()) {
    const std::size_t end = std::min(list.find('&'), list.size());
    if (auto added = add_option(spec, list.substr(0, end), source); !added) {
      return forward_error(added);
    }
    list.remove_prefix(std::min(end + 1, list.size()));
  }
  return spec;
}

Result<void> SourceSpec::allow_options(std::initializer_list<std::string_view> names) const {
  for (const auto& [name, value] : options) {
    if (std::find(names.begin(), names.end(), name) == names.end()) {
      std::vector<std::string_view> known(names);
      known.push_back("rate");
      return fail(ErrorCode::wrong_use, "{}: has no option '{}'; there are: {}", kind, name,
                  fmt::join(known, ", "));
    }
  }
  return {};
}

std::string SourceSpec::text(const std::string& name, std::string_view fallback) const {
  const auto found = options.find(name);
  return found == options.end() ? std::string(fallback) : found->second;
}

Result<std::int64_t> SourceSpec::integer(const std::string& name, std::int64_t fallback,
                                         std::int64_t lowest, std::int64_t highest) const {
  const auto found = options.find(name);
  if (found == options.end()) return fallback;
  std::int64_t value = 0;
  if (!read_number(found->second, value) || value < lowest || value > highest) {
    return fail(ErrorCode::wrong_use, "{}: option {}={} is not an integer from {} to {}", kind,
                name, found->second, lowest, highest);
  }
  return value;
}

Result<double> SourceSpec::number(const std::string& name, double fallback, double lowest,
                                  double highest) const {
  const auto found = options.find(name);
  if (found == options.end()) return fallback;
  double value = 0.0;
  if (!read_number(found->second, value) || !std::isfinite(value) || value < lowest ||
      value > highest) {
    return fail(ErrorCode::wrong_use, "{}: option {}={} is not a number from {} to {}", kind, name,
                found->second, lowest, highest);
  }
  return value;
}

Result<std::string> SourceSpec::choice(const std::string& name, std::string_view fallback,
                                       std::initializer_list<std::string_view> choices) const {
  std::string value = text(name, fallback);
  if (std::find(choices.begin(), choices.end(), value) == choices.end()) {
    return fail(ErrorCode::wrong_use, "{}: option {}={} is none of: {}", kind, name, value,
                fmt::join(choices, ", "));
  }
  return value;
}

}  // namespace lifeline::sources
