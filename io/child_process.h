#pragma once

#include <cstddef>
#include <functional>
#include <span>

namespace nacre {

/// Takes what a child process hands back.
using ByteSink = std::function<void(std::span<const std::byte>)>;

/// Work in a process of its own, for a library that ends the whole process on bad input.
///
/// The child is a copy of this process: it sees all memory as it is now and changes none of it. It
/// prints nothing. Whatever ends it (an assertion, a crash, an exception, no memory, half a minute
/// of computing without handing anything back) ends only what `read` can get.
class ChildProcess {
 public:
  /// Starts `work`; what it gives to the sink is read here in order.
  /// @param memory  bytes it may take beyond what this process has; more fails there
  /// @throws Error  Unsupported if no process can be started
  ChildProcess(std::size_t memory, const std::function<void(const ByteSink&)>& work);

  /// Ends the child if it still runs.
  ~ChildProcess();

  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Waits for the next bytes; false if the child ended before it handed all of them back.
  bool read(std::span<std::byte> bytes);

 private:
  int pipe_ = -1;
  int process_ = -1;
};

}  // namespace nacre
