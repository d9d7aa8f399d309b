#include "app/command.h"

#include <fmt/core.h>
#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>

#include "io/atomic_file.h"

namespace nacre {
namespace {

/// Work shorter than this shows no bar.
constexpr std::chrono::milliseconds kPatience{300};

}  // namespace

void add_common_flags(CLI::App& verb, CommonFlags& flags) {
  verb.add_flag("-q,--quiet", flags.quiet, "Say nothing but warnings and errors");
  verb.add_flag("-v,--verbose", flags.verbose, "Say more");
  verb.add_option("--threads", flags.threads, "Threads to use (default: all)")
      ->check(CLI::Range(1, 4096));
  verb.add_option("--progress", flags.progress, "Progress on standard error")
      ->check(CLI::IsMember({"auto", "always", "never"}))
      ->capture_default_str();
  verb.add_option("--json", flags.json, "Write figures to this file; - is standard output");
}

Reporter::Reporter(const CommonFlags& flags)
    : flags_(flags), started_(std::chrono::steady_clock::now()) {
  if (!flags.json.empty() && flags.json != "-") json_.emplace(flags.json);
  show_progress_ = flags.progress == "always" ||
                   (flags.progress == "auto" && !flags.quiet && isatty(STDERR_FILENO) != 0);
}

Reporter::~Reporter() { clear_progress(); }

void Reporter::say(const std::string& line) {
  clear_progress();
  if (!flags_.quiet) fmt::print(flags_.json == "-" ? stderr : stdout, "{}\n", line);
}

void Reporter::detail(const std::string& line) {
  if (flags_.verbose) say(line);
}

void Reporter::warn(const std::string& line) {
  clear_progress();
  fmt::print(stderr, "nacre: warning: {}\n", line);
}

ProgressCallback Reporter::progress() {
  if (!show_progress_) return {};
  return [this](std::string_view stage, double fraction) {
    if (std::chrono::steady_clock::now() - started_ < kPatience && flags_.progress == "auto")
      return;
    constexpr int kWidth = 30;
    const int done = static_cast<int>(kWidth * fraction);
    fmt::print(stderr, "\r{:<10} [{:<{}}] {:3.0f} %", stage,
               std::string(static_cast<std::size_t>(done), '#'), kWidth, 100.0 * fraction);
    std::fflush(stderr);
    progress_on_screen_ = true;
  };
}

void Reporter::clear_progress() {
  if (!progress_on_screen_) return;
  fmt::print(stderr, "\r{:60}\r", "");
  std::fflush(stderr);
  progress_on_screen_ = false;
}

void Reporter::finish(const nlohmann::ordered_json& figures) {
  clear_progress();
  if (flags_.json.empty()) return;
  const std::string text = figures.dump(2) + "\n";
  if (flags_.json == "-") {
    fmt::print("{}", text);
    return;
  }
  json_->write(text);
  json_->commit();
}

double Stopwatch::lap() {
  const auto now = std::chrono::steady_clock::now();
  const double seconds = std::chrono::duration<double>(now - since_).count();
  since_ = now;
  return seconds;
}

void return_large_blocks() {
#ifdef __GLIBC__
  // Otherwise the limit grows to the size of the largest block that was ever freed.
  constexpr int kLargeBlock = 1 << 20;
  mallopt(M_MMAP_THRESHOLD, kLargeBlock);
#endif
}

void keep_freed_memory() {
#ifdef __GLIBC__
  constexpr int kLargestBlock = 32 << 20;  // the most that glibc takes
  mallopt(M_MMAP_THRESHOLD, kLargestBlock);
  mallopt(M_TRIM_THRESHOLD, 2 * kLargestBlock);
#endif
}

void release_free_memory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

std::size_t peak_rss_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;  // Linux counts in KiB
}

}  // namespace nacre
