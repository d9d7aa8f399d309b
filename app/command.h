#pragma once

#include <chrono>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "core/progress.h"
#include "io/atomic_file.h"

namespace CLI {
class App;
}

namespace nacre {

/// What every verb has: how much it says, where its figures go, how many threads it may use.
struct CommonFlags {
  bool quiet = false;
  bool verbose = false;
  int threads = 0;                ///< 0: all
  std::string progress = "auto";  ///< auto, always, never
  std::string json;               ///< file for figures; "-" is standard output; empty: none
};

/// Adds -q, -v, --threads, --progress and --json to a verb.
void add_common_flags(CLI::App& verb, CommonFlags& flags);

/// Speaks for a verb while it runs: progress to a terminal, facts to standard output (to standard
/// error when that carries the JSON), figures to the JSON file.
class Reporter {
 public:
  /// @throws Error  BadArgument if the JSON file cannot be created: before the work, not after it
  explicit Reporter(const CommonFlags& flags);
  ~Reporter();

  Reporter(const Reporter&) = delete;
  Reporter& operator=(const Reporter&) = delete;

  /// A line for the user; silent with --quiet.
  void say(const std::string& line);
  /// A line only with --verbose.
  void detail(const std::string& line);
  /// A line on standard error that --quiet does not silence: the result may not be what was meant.
  void warn(const std::string& line);

  /// Draws a bar on standard error if that is a terminal (or with --progress always).
  ProgressCallback progress();

  /// Writes the figures where --json says.
  void finish(const nlohmann::ordered_json& figures);

 private:
  void clear_progress();

  CommonFlags flags_;
  std::optional<AtomicFile> json_;
  bool show_progress_ = false;
  bool progress_on_screen_ = false;
  std::chrono::steady_clock::time_point started_;
};

/// Seconds since it was made or last asked for a lap.
class Stopwatch {
 public:
  double lap();

 private:
  std::chrono::steady_clock::time_point since_ = std::chrono::steady_clock::now();
};

/// Largest resident memory of this process so far, bytes.
std::size_t peak_rss_bytes();

/// Has the allocator give large blocks back to the system when they are freed, and not keep them
/// for later ones: a build's peak is then what it holds, not the sum of what its stages held. To be
/// called first of all.
void return_large_blocks();

/// From now on keeps freed blocks for later ones, against `return_large_blocks`: for pictures one
/// after the other, each of which would else be written to fresh pages (a fifth of a fast frame).
void keep_freed_memory();

/// Gives back what is free all the same.
void release_free_memory();

/// Runs `nacre` with these arguments; returns the exit status of cli.md: 0 done, 1 a check said no,
/// 2 wrong use, 3 bad input, 4 cannot do it here.
int run_nacre(int argc, char** argv);

// The verbs. Each adds itself to the application; its callback sets `status` where it is not 0.
void add_build_verb(CLI::App& app, int& status);
void add_view_verb(CLI::App& app, int& status);
void add_phantom_verb(CLI::App& app, int& status);
void add_reference_verb(CLI::App& app, int& status);
void add_render_verb(CLI::App& app, int& status);
void add_compare_verb(CLI::App& app, int& status);
void add_info_verb(CLI::App& app, int& status);
void add_verify_verb(CLI::App& app, int& status);

}  // namespace nacre
