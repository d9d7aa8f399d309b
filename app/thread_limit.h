#pragma once

#include <memory>

#include "app/command.h"

namespace nacre {

/// Holds all parallel work to `--threads` while it lives.
class ThreadLimit {
 public:
  explicit ThreadLimit(const CommonFlags& flags);
  ~ThreadLimit();

  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  struct Control;
  std::unique_ptr<Control> control_;
};

}  // namespace nacre
