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

/// While it lives parallel work may be done; its end waits until every thread that did some has
/// ended too. A thread that outlives `main` runs on while the libraries it used are taken down.
class WorkerThreads {
 public:
  WorkerThreads();
  ~WorkerThreads();

  WorkerThreads(const WorkerThreads&) = delete;
  WorkerThreads& operator=(const WorkerThreads&) = delete;

 private:
  struct Handle;
  std::unique_ptr<Handle> handle_;
};

}  // namespace nacre
