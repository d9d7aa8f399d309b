#include "app/thread_limit.h"

#include <tbb/global_control.h>

#include <new>

namespace nacre {

struct ThreadLimit::Control {
  explicit Control(std::size_t threads)
      : control(tbb::global_control::max_allowed_parallelism, threads) {}

  tbb::global_control control;
};

ThreadLimit::ThreadLimit(const CommonFlags& flags) {
  if (flags.threads < 1) return;
  control_ = std::make_unique<Control>(static_cast<std::size_t>(flags.threads));
}

ThreadLimit::~ThreadLimit() = default;

struct WorkerThreads::Handle {
  tbb::task_scheduler_handle scheduler{tbb::attach{}};
};

WorkerThreads::WorkerThreads() : handle_(new Handle) {}

WorkerThreads::~WorkerThreads() { tbb::finalize(handle_->scheduler, std::nothrow); }

}  // namespace nacre
