#include "report/peer_process.h"

#include <fmt/core.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <sstream>

#include "core/error.h"

namespace nacre {
namespace {

/// Starts a shell command whose standard input and output are the socket.
/// @return  its process, or -1
int start(const std::string& command, int socket) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, socket, STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, socket, STDOUT_FILENO);
  std::string shell = "sh";
  std::string flag = "-c";
  std::string line = "exec " + command;
  const std::array<char*, 4> arguments{shell.data(), flag.data(), line.data(), nullptr};
  pid_t process = -1;
  const int failed = posix_spawn(&process, "/bin/sh", &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  return failed == 0 ? process : -1;
}

}  // namespace

/// The running program and our end of the line to it.
struct PeerProcess::Child {
  int socket = -1;
  int process = -1;

  Child() = default;
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() {
    if (socket >= 0) ::close(socket);  // it ends when nobody can tell it anything any more
    if (process >= 0) waitpid(process, nullptr, 0);
  }
};

PeerProcess::PeerProcess(const std::string& command)
    : command_(command), child_(std::make_unique<Child>()) {
  std::array<int, 2> ends{};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) lost();
  child_->socket = ends[0];
  child_->process = start(command, ends[1]);
  ::close(ends[1]);
  if (child_->process < 0 || line() != "ready") lost();
}

PeerProcess::~PeerProcess() = default;

void PeerProcess::lost() const {
  throw Error(ErrorCode::Unsupported,
              fmt::format("{}: found no answer, expected a program that draws", command_));
}

void PeerProcess::read(void* bytes, std::size_t count) {
  auto* to = static_cast<char*>(bytes);
  while (count > 0) {
    const ssize_t got = recv(child_->socket, to, count, 0);
    if (got <= 0) lost();
    to += got;
    count -= static_cast<std::size_t>(got);
  }
}

std::string PeerProcess::line() {
  std::string text;
  for (char c = 0;;) {
    read(&c, 1);
    if (c == '\n') return text;
    text += c;
  }
}

PeerFrame PeerProcess::draw(const PeerRecipe& recipe, std::size_t view) {
  const std::string order = fmt::format("{} {} {}\n", recipe.caster, recipe.step, view);
  if (send(child_->socket, order.data(), order.size(), MSG_NOSIGNAL) < 0) lost();
  std::istringstream answer(line());
  std::string word;
  answer >> word;
  if (word != "picture") {
    std::getline(answer >> std::ws, word);
    throw Error(ErrorCode::Unsupported, word);
  }
  PeerFrame frame;
  int width = 0;
  int height = 0;
  answer >> frame.seconds >> width >> height;
  std::getline(answer >> std::ws, frame.device);
  constexpr int kMost = 32768;
  if (width < 1 || height < 1 || width > kMost || height > kMost) lost();
  frame.picture = make_image(width, height);
  read(frame.picture.pixels.data(), frame.picture.pixels.size() * sizeof(float));
  return frame;
}

}  // namespace nacre
