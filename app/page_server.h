#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace nacre {

/// A level whose shell is asked for.
struct LevelRequest {
  double emission = 0.0;  ///< in (0, 1]
  bool draft = false;     ///< whether a quick one will do
};

/// A shell file with that one level.
struct ServedLevel {
  std::vector<std::byte> set;
  bool is_draft = false;  ///< whether asking for another than a draft gives another shell
};

/// The flags of `nacre render`, names and values, for a picture that the page shows.
using PictureRequest = std::vector<std::pair<std::string, std::string>>;

/// What a server gives away, and nothing else: the page, the set it fetches, pictures of it, and
/// where there is a volume the shell of any level.
struct ServedPage {
  std::string html;
  std::vector<std::byte> set;
  /// Empty where there is no volume. A draft may be asked for while another shell is being made.
  std::function<ServedLevel(const LevelRequest& request)> level = {};
  /// A picture, as the page takes it; may throw an `Error`, which is what the page is told. Empty
  /// where none are drawn. May be called from several threads at once.
  std::function<std::vector<std::byte>(const PictureRequest& request)> picture = {};
};

/// Serves on the loopback interface until this process is told to end by SIGINT or SIGTERM.
///
/// Requests that name another host than the loopback one are refused (a page of somebody else's
/// cannot read the set by way of a name of its own). Call it before threads are started: the two
/// signals are then blocked in all of them.
///
/// @param port   0: any that is free
/// @param ready  told the address once requests are answered
/// @throws Error  Unsupported if the port is taken, or in a build without the HTTP library
void serve_page(const ServedPage& served, int port,
                const std::function<void(const std::string& address)>& ready);

/// Blocks SIGINT and SIGTERM in this thread and those it starts, so that `serve_page` waits for
/// them.
void hold_signals();

}  // namespace nacre
