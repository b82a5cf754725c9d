#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>

namespace CLI {
class App;
}

namespace lifeline::bench {

/// What follows a benchmark's name. CLI11, which takes long to compile, stays behind it.
class CommandLine {
 public:
  /// `what` the benchmark tells, for --help.
  CommandLine(const std::string& what, const std::string& name);
  ~CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  /// --out, which every benchmark has: a file that gets its figures as JSON.
  void add_out(std::optional<std::filesystem::path>& into);
  /// An option with a value. T: string, path, optional path, or a number of the types named in
  /// command_line.cpp. Keeps a reference.
  template <typename T>
  void add(const std::string& name, T& into, const std::string& help);
  /// The same for a number within bounds.
  template <typename T>
  void add(const std::string& name, T& into, const std::string& help, T least, T most);
  /// A number that the option alone sets to `usual`.
  void add_count(const std::string& name, std::optional<std::size_t>& into, const std::string& help,
                 std::size_t usual);
  void add_flag(const std::string& name, bool& into, const std::string& help);

  /// An exit status where the benchmark is not to run: 0 for --help, 2 for wrong use.
  [[nodiscard]] std::optional<int> parse(std::span<const char* const> arguments);

 private:
  std::unique_ptr<CLI::App> app_;
};

}  // namespace lifeline::bench
