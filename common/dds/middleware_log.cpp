#include "common/dds/middleware_log.hpp"

#include <memory>
#include <mutex>
#include <utility>

#include "common/base/log.hpp"
#include "common/dds/fastdds_version.hpp"

namespace lifeline::dds {
namespace {

/// Fast DDS logs from a thread of its own; what it says may come late, hence Log::Flush().
struct Kept {
  std::mutex mutex;
  bool capturing = false;
  std::vector<std::string> errors;
};

Kept& kept() {
  static Kept* const instance = new Kept;  // outlives Fast DDS's log thread
  return *instance;
}

class ToSpdlog final : public fast::LogConsumer {
 public:
  void Consume(const fast::Log::Entry& entry) override {
    if (entry.kind != fast::Log::Error) return;
    auto& store = kept();
    {
      const std::lock_guard lock(store.mutex);
      if (store.capturing) {
        store.errors.push_back(entry.message);
        return;
      }
    }
    const char* category = entry.context.category;
    if (auto* logger = spdlog::default_logger_raw(); logger != nullptr) {
      logger->error("dds: {}: {}", category != nullptr ? category : "", entry.message);
    }
  }
};

void set_capturing(bool capturing) {
  fast::Log::Flush();
  auto& store = kept();
  const std::lock_guard lock(store.mutex);
  store.capturing = capturing;
  store.errors.clear();
}

}  // namespace

void route_middleware_log() {
  static std::once_flag once;
  std::call_once(once, [] {
    fast::Log::ClearConsumers();
    fast::Log::SetVerbosity(fast::Log::Error);
    fast::Log::RegisterConsumer(std::make_unique<ToSpdlog>());
  });
}

LogCapture::LogCapture() {
  set_capturing(true);
}
LogCapture::~LogCapture() {
  set_capturing(false);
}

std::vector<std::string> LogCapture::errors() const {
  fast::Log::Flush();
  auto& store = kept();
  const std::lock_guard lock(store.mutex);
  return store.errors;
}

}  // namespace lifeline::dds
