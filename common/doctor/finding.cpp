#include "common/doctor/finding.hpp"

#include <algorithm>
#include <iterator>
#include <sstream>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace lifeline::doctor {
namespace {

std::string_view name_of(Level level) {
  switch (level) {
    case Level::ok:
      return "ok";
    case Level::warning:
      return "warning";
    case Level::fault:
      return "fault";
  }
  return "?";
}

std::string_view colour_of(Level level) {
  switch (level) {
    case Level::ok:
      return "\x1b[32m";
    case Level::warning:
      return "\x1b[33m";
    case Level::fault:
      return "\x1b[31m";
  }
  return "";
}

auto count(const Findings& findings, Level level) {
  return std::ranges::count(findings, level, &Finding::level);
}

std::string counted(std::ptrdiff_t number, std::string_view noun) {
  return fmt::format("{} {}{}", number, noun, number == 1 ? "" : "s");
}

}  // namespace

Finding ok(std::string check, std::string where, std::string what) {
  return {Level::ok, std::move(check), std::move(where), std::move(what), ""};
}
Finding warning(std::string check, std::string where, std::string what, std::string advice) {
  return {Level::warning, std::move(check), std::move(where), std::move(what), std::move(advice)};
}
Finding fault(std::string check, std::string where, std::string what, std::string advice) {
  return {Level::fault, std::move(check), std::move(where), std::move(what), std::move(advice)};
}

Findings faults(const std::string& check, const std::string& where, const Error& error) {
  Findings found;
  std::istringstream lines(error.text);
  for (std::string line; std::getline(lines, line);) {
    Finding finding = fault(check, where, line, "");
    if (finding.what.starts_with(where + ": ")) finding.what.erase(0, where.size() + 2);
    if (const auto end = finding.what.rfind("; "); end != std::string::npos) {
      finding.advice = finding.what.substr(end + 2);
      finding.what.erase(end);
    }
    found.push_back(std::move(finding));
  }
  return found;
}

void append(Findings& all, Findings more) {
  std::ranges::move(more, std::back_inserter(all));
}

int exit_status(const Findings& findings) {
  if (count(findings, Level::fault) > 0) return 1;
  return count(findings, Level::warning) > 0 ? 3 : 0;
}

std::string to_text(const Findings& findings, bool coloured) {
  std::string text;
  for (const Finding& finding : findings) {
    text += fmt::format("{}{:<8}{} {:<10} {}: {}\n", coloured ? colour_of(finding.level) : "",
                        name_of(finding.level), coloured ? "\x1b[0m" : "", finding.check,
                        finding.where, finding.what);
    if (!finding.advice.empty()) text += fmt::format("{:>22} {}\n", "->", finding.advice);
  }
  const auto bad = count(findings, Level::fault), poor = count(findings, Level::warning);
  if (bad + poor == 0) return text + "nothing is wrong\n";
  return text + fmt::format("{}, {}\n", counted(bad, "fault"), counted(poor, "warning"));
}

std::string to_json(const Findings& findings) {
  const auto bad = count(findings, Level::fault), poor = count(findings, Level::warning);
  nlohmann::ordered_json json{
      {"outcome", bad > 0 ? "faults" : (poor > 0 ? "warnings" : "ok")},
      {"faults", bad},
      {"warnings", poor},
      {"findings", nlohmann::ordered_json::array()},
  };
  for (const Finding& finding : findings) {
    json["findings"].push_back({{"level", name_of(finding.level)},
                                {"check", finding.check},
                                {"where", finding.where},
                                {"what", finding.what},
                                {"advice", finding.advice}});
  }
  // Names of files and devices may hold anything: what is no UTF-8 is replaced.
  return json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace lifeline::doctor
