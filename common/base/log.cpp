#include "common/base/log.hpp"

#include <memory>

#include <spdlog/sinks/stdout_color_sinks.h>
#include <unistd.h>

#include "common/base/terminal.hpp"

namespace lifeline {
namespace {

thread_local bool is_quiet = false;

using ColourSink = spdlog::sinks::stderr_color_sink_mt;

class Sink final : public ColourSink {
 public:
  explicit Sink(spdlog::color_mode mode) : ColourSink(mode) {}
  void log(const spdlog::details::log_msg& message) override {
    if (!is_quiet || message.level >= spdlog::level::err) ColourSink::log(message);
  }
};

}  // namespace

QuietLog::QuietLog() {
  is_quiet = true;
}

QuietLog::~QuietLog() {
  is_quiet = false;
}

void set_up_log(std::string_view name, std::string_view level) {
  auto sink = std::make_shared<Sink>(wants_colour(STDERR_FILENO) ? spdlog::color_mode::always
                                                                 : spdlog::color_mode::never);
  auto logger = std::make_shared<spdlog::logger>(std::string(name), std::move(sink));
  logger->set_pattern("%H:%M:%S.%e %^%l%$ [%n] %v");
  const auto parsed = spdlog::level::from_str(std::string(level));
  logger->set_level(parsed == spdlog::level::off ? spdlog::level::info : parsed);
  spdlog::set_default_logger(std::move(logger));
}

}  // namespace lifeline
