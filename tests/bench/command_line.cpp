#include "tests/bench/command_line.hpp"

#include <cstdint>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace lifeline::bench {

CommandLine::CommandLine(const std::string& what, const std::string& name)
    : app_(std::make_unique<CLI::App>(what, "lifeline bench " + name)) {}

CommandLine::~CommandLine() = default;

void CommandLine::add_out(std::optional<std::filesystem::path>& into) {
  add("--out", into, "file that gets the figures as JSON");
}

template <typename T>
void CommandLine::add(const std::string& name, T& into, const std::string& help) {
  app_->add_option(name, into, help)->capture_default_str();
}

template <typename T>
void CommandLine::add(const std::string& name, T& into, const std::string& help, T least, T most) {
  app_->add_option(name, into, help)->check(CLI::Range(least, most))->capture_default_str();
}

template void CommandLine::add(const std::string&, std::string&, const std::string&);
template void CommandLine::add(const std::string&, std::filesystem::path&, const std::string&);
template void CommandLine::add(const std::string&, std::optional<std::filesystem::path>&,
                               const std::string&);
template void CommandLine::add(const std::string&, std::uint64_t&, const std::string&);
template void CommandLine::add(const std::string&, int&, const std::string&, int, int);
template void CommandLine::add(const std::string&, double&, const std::string&, double, double);
template void CommandLine::add(const std::string&, std::uint64_t&, const std::string&,
                               std::uint64_t, std::uint64_t);

void CommandLine::add_count(const std::string& name, std::optional<std::size_t>& into,
                            const std::string& help, std::size_t usual) {
  app_->add_option(name, into, help)->expected(0, 1)->default_str(fmt::to_string(usual));
}

void CommandLine::add_flag(const std::string& name, bool& into, const std::string& help) {
  app_->add_flag(name, into, help);
}

std::optional<int> CommandLine::parse(std::span<const char* const> arguments) {
  std::vector<std::string> reversed(arguments.rbegin(), arguments.rend());
  try {
    app_->parse(std::move(reversed));
  } catch (const CLI::ParseError& end) {
    return app_->exit(end) == 0 ? 0 : 2;
  }
  return std::nullopt;
}

}  // namespace lifeline::bench
