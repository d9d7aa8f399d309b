#include "io/child_process.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <fstream>

#include "core/error.h"

namespace nacre {
namespace {

constexpr int kPatienceSeconds = 30;

/// Ends this process when it has computed for so long; computing, so that a busy machine does not
/// count.
void limit_time() {
  const itimerval patience{{0, 0}, {kPatienceSeconds, 0}};
  setitimer(ITIMER_PROF, &patience, nullptr);
}

/// Bytes of address space this process has.
std::size_t address_space() {
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

/// Limits what a library may allocate on a damaged file's word.
void limit_memory(std::size_t memory) {
  const std::size_t taken = address_space();
  if (taken == 0) return;  // not known here: then there is no limit
  const rlimit limit{taken + memory, taken + memory};
  setrlimit(RLIMIT_AS, &limit);
}

/// No output, no core file, and the signals that end a process do so.
void make_quiet() {
  const int nowhere = open("/dev/null", O_WRONLY);
  dup2(nowhere, STDOUT_FILENO);
  dup2(nowhere, STDERR_FILENO);
  const rlimit none{0, 0};
  setrlimit(RLIMIT_CORE, &none);
  for (const int number : {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGPROF, SIGPIPE}) {
    std::signal(number, SIG_DFL);
  }
  limit_time();
}

/// Returns false if the other end is gone.
bool write_all(int pipe, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t count = write(pipe, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(count));
  }
  return true;
}

[[noreturn]] void run_child(int pipe, std::size_t memory,
                            const std::function<void(const ByteSink&)>& work) {
  make_quiet();
  limit_memory(memory);
  int status = 0;
  try {
    work([pipe](std::span<const std::byte> bytes) {
      if (!write_all(pipe, bytes)) _exit(1);
      limit_time();
    });
  } catch (const std::exception&) {
    status = 1;
  }
  _exit(status);  // runs nothing that the parent will run when it ends
}

}  // namespace

ChildProcess::ChildProcess(std::size_t memory, const std::function<void(const ByteSink&)>& work) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) {
    throw Error(ErrorCode::Unsupported,
                fmt::format("cannot open a pipe: {}", std::strerror(errno)));
  }
  process_ = fork();
  if (process_ == 0) {
    close(ends[0]);
    run_child(ends[1], memory, work);
  }
  close(ends[1]);
  pipe_ = ends[0];
  if (process_ < 0) {
    close(pipe_);
    throw Error(ErrorCode::Unsupported,
                fmt::format("cannot start a process: {}", std::strerror(errno)));
  }
}

ChildProcess::~ChildProcess() {
  close(pipe_);
  kill(process_, SIGKILL);
  while (waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

bool ChildProcess::read(std::span<std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::read(pipe_, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(count));
  }
  return true;
}

}  // namespace nacre
