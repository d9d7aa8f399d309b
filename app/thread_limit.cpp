#include "app/thread_limit.h"

#include <tbb/global_control.h>

namespace nacre {

struct ThreadLimit::Control {
  tbb::global_control control;
};

ThreadLimit::ThreadLimit(const CommonFlags& flags) {
  if (flags.threads < 1) return;
  control_.reset(new Control{tbb::global_control(tbb::global_control::max_allowed_parallelism,
                                                 static_cast<std::size_t>(flags.threads))});
}

ThreadLimit::~ThreadLimit() = default;

}  // namespace nacre
